//! The objects of a scene with their edges, from the original or the repaired mesh.

use crate::curvature::Curvatures;
use crate::edges::{Eye, Incidence, MeshEdges, Side, SilhouetteRule, side_of_face};
use crate::lines::input::mesh_repair::{self, RepairedMesh};
use crate::lines::smooth::forms::settings::FormSettings;
use crate::mesh::{Mesh, triangle_normal};
use crate::scene::{Object, Scene};
use crate::tolerances::CONTACT;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

pub(in crate::lines) struct ObjectEdges<'a> {
    pub object: &'a Object,
    pub edges: Edges<'a>,
    /// Its first position and its first face among those of all objects.
    pub first_position: u32,
    pub first_face: u32,
}

/// The edges of the scene's mesh or of a repaired one.
pub(in crate::lines) enum Edges<'a> {
    OfScene(&'a MeshEdges),
    Repaired(Arc<RepairedEdges>),
}

/// The edges of a repaired mesh, with the faces that hide others.
pub(in crate::lines) struct RepairedEdges {
    edges: MeshEdges,
    shape: Arc<Mesh>,
    crossings: Vec<(u32, [u32; 2])>,
    whole_faces: Vec<u32>,
    /// Edges with two faces, at least one of which was split, ascending.
    at_split_faces: Vec<u32>,
    on_edges: BTreeMap<[u32; 2], Vec<u32>>,
    /// The largest distance of a vertex from the edge that it splits, file units.
    beside: f64,
    covered: usize,
}

impl RepairedEdges {
    pub(in crate::lines) fn new(repaired: RepairedMesh) -> Self {
        let RepairedMesh { shape, split, edges, crossings, whole_faces, on_edges, covered } = repaired;
        let edges = MeshEdges::with_list(split, edges);
        let is_split = |face: &u32| {
            let whole = whole_faces[*face as usize];
            edges.mesh().triangles[*face as usize] != shape.triangles[whole as usize]
        };
        let is_at_one = |edge: &u32| matches!(edges.list().faces(*edge), faces @ [_, _] if faces.iter().any(is_split));
        let at_split_faces = (0..edges.list().len() as u32).filter(is_at_one).collect();
        let position = |vertex: &u32| shape.positions[*vertex as usize];
        let distances = on_edges.iter().flat_map(|([start, end], vertices)| {
            let (start, end) = (position(start), position(end));
            vertices
                .iter()
                .map(move |vertex| (end - start).normalize_or_zero().cross(position(vertex) - start).length())
        });
        let beside = distances.fold(0.0, f64::max);
        Self { edges, shape, crossings, whole_faces, at_split_faces, on_edges, beside, covered }
    }

    /// Whether exactly one of the two faces at an edge is seen from the front. For split faces the whole face
    /// decides, because rounding tilts its parts.
    fn is_silhouette(&self, edge: u32, eye: Eye) -> bool {
        let &[first, second] = self.edges.list().faces(edge) else { return false };
        let side = |face: u32| {
            let corners = self.shape.triangles[self.whole_faces[face as usize] as usize];
            side_of_face(corners.map(|corner| self.shape.positions[corner as usize]), eye)
        };
        // For the opposite orientation the second face shows its back.
        let is_reversed = self.edges.list().incidence()[edge as usize] == Incidence::InnerReversed;
        let front_of_second = if is_reversed { Side::Back } else { Side::Front };
        (side(first) == Side::Front) != (side(second) == front_of_second)
    }
}

impl Edges<'_> {
    pub(in crate::lines) fn get(&self) -> &MeshEdges {
        match self {
            Self::OfScene(edges) => edges,
            Self::Repaired(repaired) => &repaired.edges,
        }
    }
}

impl<'a> ObjectEdges<'a> {
    /// The objects of a scene, each with the edges that `edges` returns for it.
    pub(in crate::lines) fn all(scene: &'a Scene, mut edges: impl FnMut(usize, &'a Object) -> Edges<'a>) -> Vec<Self> {
        let (mut first_position, mut first_face) = (0, 0);
        let of_object = |(number, object): (usize, &'a Object)| {
            let found = Self { object, edges: edges(number, object), first_position, first_face };
            first_position += found.shape().positions.len() as u32;
            first_face += found.shape().triangles.len() as u32;
            found
        };
        scene.objects.iter().enumerate().map(of_object).collect()
    }
}

impl ObjectEdges<'_> {
    /// The faces that hide others.
    pub(in crate::lines) fn shape(&self) -> &Arc<Mesh> {
        match &self.edges {
            Edges::OfScene(edges) => edges.mesh(),
            Edges::Repaired(repaired) => &repaired.shape,
        }
    }

    /// The curvature of the smooth surface, for form lines.
    pub(in crate::lines) fn curvatures(&self, scene: &Scene, settings: &FormSettings) -> Arc<Curvatures> {
        match &self.edges {
            Edges::OfScene(_) => scene.curvatures(self.object, settings.smoothing),
            Edges::Repaired(repaired) => {
                let edges = &repaired.edges;
                Arc::new(Curvatures::of_form(edges.mesh(), edges.list(), settings.smoothing))
            }
        }
    }

    /// The face of the shape that contains this face of the edge list.
    pub(in crate::lines) fn whole_face(&self, face: u32) -> u32 {
        match &self.edges {
            Edges::OfScene(_) => face,
            Edges::Repaired(repaired) => repaired.whole_faces[face as usize],
        }
    }

    /// Whether faces were split at vertices on their edges.
    pub(in crate::lines) fn has_split_edges(&self) -> bool {
        matches!(&self.edges, Edges::Repaired(repaired) if !repaired.on_edges.is_empty())
    }

    /// The vertices at which an edge of the shape was split, in order; the edge is given with its lower position
    /// first.
    pub(in crate::lines) fn on_edge(&self, edge: [u32; 2]) -> &[u32] {
        match &self.edges {
            Edges::OfScene(_) => &[],
            Edges::Repaired(repaired) => repaired.on_edges.get(&edge).map_or(&[], Vec::as_slice),
        }
    }

    /// How far vertices lie beside the edges that they split, file units.
    pub(in crate::lines) fn beside(&self) -> f64 {
        match &self.edges {
            Edges::OfScene(_) => 0.0,
            Edges::Repaired(repaired) => repaired.beside,
        }
    }

    /// The exact silhouette edges for an eye, ascending.
    pub(in crate::lines) fn silhouette(&self, eye: Eye) -> Vec<u32> {
        let mut silhouette = self.edges.get().silhouette(eye, SilhouetteRule::Exact);
        if let Edges::Repaired(repaired) = &self.edges {
            let at_split_faces = &repaired.at_split_faces;
            silhouette.retain(|edge| at_split_faces.binary_search(edge).is_err());
            silhouette.extend(at_split_faces.iter().filter(|edge| repaired.is_silhouette(**edge, eye)));
            silhouette.sort_unstable();
        }
        silhouette
    }

    /// Number of covered faces of the mesh that were removed.
    pub(in crate::lines) fn covered(&self) -> usize {
        match &self.edges {
            Edges::OfScene(_) => 0,
            Edges::Repaired(repaired) => repaired.covered,
        }
    }

    /// Whether an edge runs through the inside of a split face and no other face ends there.
    pub(in crate::lines) fn is_within_a_face(&self, edge: u32) -> bool {
        let Edges::Repaired(repaired) = &self.edges else { return false };
        matches!(*repaired.edges.list().faces(edge), [first, second] if self.whole_face(first) == self.whole_face(second))
    }

    /// The edges, each by its ends, along which two faces of the shape pass through one another, one of them with a diagonal of its
    /// polygon there.
    pub(in crate::lines) fn crossings(&self) -> impl Iterator<Item = ([u32; 2], [u32; 2])> {
        let crossings = match &self.edges {
            Edges::OfScene(_) => &[][..],
            Edges::Repaired(repaired) => &repaired.crossings,
        };
        let positions = self.edges.get().list().positions();
        crossings.iter().map(|(edge, faces)| (positions[*edge as usize], *faces))
    }

    /// Whether coplanar faces of one material and two parts meet at an edge, and all other faces at it lie behind them.
    pub(in crate::lines) fn is_seam_of_parts(&self, edge: u32) -> bool {
        let (list, mesh) = (self.edges.get().list(), self.edges.get().mesh());
        let of = |list: &[u32], face: u32| list.get(face as usize).copied();
        let at_edge = list.faces(edge);
        let are_joined = |first: u32, second: u32| {
            of(&mesh.triangle_parts, first) != of(&mesh.triangle_parts, second)
                && of(&mesh.triangle_materials, first) == of(&mesh.triangle_materials, second)
                && self.lie_flat(edge, &[first, second])
        };
        let mut pairs = at_edge.iter().flat_map(|first| at_edge.iter().map(|second| [*first, *second]));
        let Some(joined) = pairs.find(|[first, second]| first < second && are_joined(*first, *second)) else {
            return false;
        };
        let ends = list.positions()[edge as usize];
        let start = mesh.positions[ends[0] as usize];
        let Some(outwards) =
            triangle_normal(mesh.triangles[joined[0] as usize].map(|corner| mesh.positions[corner as usize]))
        else {
            return false;
        };
        let is_behind = |face: u32| {
            let third = mesh.triangles[face as usize].into_iter().find(|corner| !ends.contains(corner));
            third.is_some_and(|third| (mesh.positions[third as usize] - start).dot(outwards) < 0.0)
        };
        at_edge.iter().filter(|face| !joined.contains(face)).all(|face| is_behind(*face))
    }

    /// Whether two faces at an edge are coplanar, on opposite sides of it.
    fn lie_flat(&self, edge: u32, faces: &[u32]) -> bool {
        let &[first, second] = faces else { return false };
        let (edges, mesh) = (self.edges.get(), self.edges.get().mesh());
        let ends = edges.list().positions()[edge as usize];
        let [from, to] = ends.map(|end| mesh.positions[end as usize]);
        // The normals as if both faces had the same direction around the edge: opposite for faces on opposite sides.
        let normal = |face: u32| {
            let third = mesh.triangles[face as usize].into_iter().find(|corner| !ends.contains(corner))?;
            (to - from).cross(mesh.positions[third as usize] - from).try_normalize()
        };
        normal(first).zip(normal(second)).is_some_and(|(first, second)| (first + second).length() <= CONTACT)
    }
}

/// Tells which faces hide nothing, by the number of the object, the mesh and its face.
pub(in crate::lines) type IsGhost<'a> = &'a (dyn Fn(usize, &Mesh, u32) -> bool + Sync);

/// For each face that may hide others, by its number in the scene, whether it hides nothing.
pub(in crate::lines) fn ghost_faces(objects: &[ObjectEdges<'_>], is_ghost: IsGhost<'_>) -> Vec<bool> {
    let of_object = |(number, object): (usize, &ObjectEdges<'_>)| {
        let shape = object.shape().clone();
        (0..shape.triangles.len() as u32).map(move |face| is_ghost(number, &shape, face))
    };
    objects.iter().enumerate().flat_map(of_object).collect()
}

/// The scene's objects with their edges, repaired if needed; objects with the same mesh share them. Ghosts are repaired apart:
/// none of them stands for a face that hides others.
pub(in crate::lines) fn object_edges<'a>(scene: &'a Scene, ghosts: Option<IsGhost<'_>>) -> Vec<ObjectEdges<'a>> {
    let mut known: HashMap<*const Mesh, Option<Arc<RepairedEdges>>> = HashMap::new();
    ObjectEdges::all(scene, |number, object| {
        let of_mesh = |mesh: &Mesh, face: u32| ghosts.is_some_and(|is_ghost| is_ghost(number, mesh, face));
        let of_mesh = ghosts.is_some().then_some(&of_mesh as &dyn Fn(&Mesh, u32) -> bool);
        let (mesh, edges) = (&object.mesh, scene.edges(object));
        let repair = || {
            mesh_repair::repaired(mesh, edges.list(), of_mesh).map(|repaired| Arc::new(RepairedEdges::new(repaired)))
        };
        match known.entry(Arc::as_ptr(mesh)).or_insert_with(repair) {
            None => Edges::OfScene(edges),
            Some(edges) => Edges::Repaired(edges.clone()),
        }
    })
}
