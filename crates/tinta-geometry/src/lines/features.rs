//! The lines of a scene before their visibility is known: edges by class, places where surfaces end, intersections.

use super::LineSettings;
use super::contours::{Contours, OnEdge, between};
use super::faces::{Faces, Own, near_crossing};
use super::intersections::Intersection;
use super::mend::Mended;
use super::space::Space;
use crate::bvh::NO_FAMILY;
use crate::edges::{
    Class, ClassCounts, ClassSet, Classes, EdgeList, Eye, Incidence, MeshEdges, Side, SilhouetteRule, lasting_creases,
    side_of_face,
};
use crate::mesh::{Mesh, triangle_normal};
use crate::scene::{Object, Scene};
use crate::tolerances::CONTACT;
use glam::DVec3;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// A line in the eye's space.
#[derive(Debug, Clone)]
pub(super) struct Feature {
    /// What it is drawn as; `None` for one that is not wanted and only hides others.
    pub class: Option<Class>,
    /// Whether a surface ends or turns away at it, so that what is behind may appear or disappear there.
    pub occludes: bool,
    pub object: u32,
    pub own: Own,
    pub ends: [DVec3; 2],
    /// The distance below which its object's positions count as one, file units.
    pub weld: f64,
    /// Planes of many faces in which the line lies.
    pub planes: [u32; 2],
    /// The one in which all faces at the line lie.
    pub plane: u32,
    /// Vertices in the file.
    pub edge: Option<[u32; 2]>,
    pub angle_degrees: Option<f64>,
}

/// An object with its edges.
pub(super) struct Part<'a> {
    pub object: &'a Object,
    pub edges: Edges<'a>,
}

/// The edges of the scene's own mesh, or of a mended one.
pub(super) enum Edges<'a> {
    OfScene(&'a MeshEdges),
    Mended(Arc<MendedEdges>),
}

/// The edges of a mended mesh with the faces that hide.
pub(super) struct MendedEdges {
    edges: MeshEdges,
    shape: Arc<Mesh>,
    whole_faces: Vec<u32>,
    /// Edges of two faces, one of which at least is a part of a face, ascending.
    at_split_faces: Vec<u32>,
    on_edges: BTreeMap<[u32; 2], Vec<u32>>,
    covered: usize,
}

impl MendedEdges {
    pub(super) fn new(mended: Mended) -> Self {
        let Mended { shape, split, whole_faces, on_edges, covered } = mended;
        let edges = MeshEdges::new(split);
        let is_split = |face: &u32| {
            let whole = whole_faces[*face as usize];
            edges.mesh().triangles[*face as usize] != shape.triangles[whole as usize]
        };
        let is_at_one = |edge: &u32| matches!(edges.list().faces(*edge), faces @ [_, _] if faces.iter().any(is_split));
        let at_split_faces = (0..edges.list().len() as u32).filter(is_at_one).collect();
        Self { edges, shape, whole_faces, at_split_faces, on_edges, covered }
    }

    /// Whether of the two faces at an edge one is seen from the front and the other is not: of split faces the whole decides, for
    /// rounding turns their parts.
    fn is_silhouette(&self, edge: u32, eye: Eye) -> bool {
        let &[first, second] = self.edges.list().faces(edge) else { return false };
        let side = |face: u32| {
            let corners = self.shape.triangles[self.whole_faces[face as usize] as usize];
            side_of_face(corners.map(|corner| self.shape.positions[corner as usize]), eye)
        };
        // Turned the other way round, the second face shows its back.
        let is_reversed = self.edges.list().incidence()[edge as usize] == Incidence::InnerReversed;
        let front_of_second = if is_reversed { Side::Back } else { Side::Front };
        (side(first) == Side::Front) != (side(second) == front_of_second)
    }
}

impl Edges<'_> {
    pub(super) fn get(&self) -> &MeshEdges {
        match self {
            Self::OfScene(edges) => edges,
            Self::Mended(mended) => &mended.edges,
        }
    }
}

impl Part<'_> {
    /// The faces that hide.
    pub(super) fn shape(&self) -> &Arc<Mesh> {
        match &self.edges {
            Edges::OfScene(edges) => edges.mesh(),
            Edges::Mended(mended) => &mended.shape,
        }
    }

    /// Of a face of the edge list the number of the one in the shape that it is a part of.
    pub(super) fn whole_face(&self, face: u32) -> u32 {
        match &self.edges {
            Edges::OfScene(_) => face,
            Edges::Mended(mended) => mended.whole_faces[face as usize],
        }
    }

    /// Whether faces were split at vertices on their edges.
    pub(super) fn has_split_edges(&self) -> bool {
        matches!(&self.edges, Edges::Mended(mended) if !mended.on_edges.is_empty())
    }

    /// The vertices on an edge of the shape where its faces were split, in their order along it; the edge's lower position first.
    pub(super) fn on_edge(&self, edge: [u32; 2]) -> &[u32] {
        match &self.edges {
            Edges::OfScene(_) => &[],
            Edges::Mended(mended) => mended.on_edges.get(&edge).map_or(&[], Vec::as_slice),
        }
    }

    /// The exact silhouette edges for an eye, ascending.
    fn silhouette(&self, eye: Eye) -> Vec<u32> {
        let mut silhouette = self.edges.get().silhouette(eye, SilhouetteRule::Exact);
        if let Edges::Mended(mended) = &self.edges {
            let at_split_faces = &mended.at_split_faces;
            silhouette.retain(|edge| at_split_faces.binary_search(edge).is_err());
            silhouette.extend(at_split_faces.iter().filter(|edge| mended.is_silhouette(**edge, eye)));
            silhouette.sort_unstable();
        }
        silhouette
    }

    /// How many of the mesh's faces others cover, which were left out.
    pub(super) fn covered(&self) -> usize {
        match &self.edges {
            Edges::OfScene(_) => 0,
            Edges::Mended(mended) => mended.covered,
        }
    }

    /// Whether an edge runs through the inside of a face that was split. What lies on that face may have an edge there, too: it counts for
    /// itself, and is none where two faces lie flat on either side.
    pub(super) fn is_within_a_face(&self, edge: u32) -> bool {
        if matches!(self.edges, Edges::OfScene(_)) {
            return false;
        }
        let mut faces = self.edges.get().list().faces(edge).to_vec();
        faces.sort_unstable_by_key(|face| self.whole_face(*face));
        let of_wholes = faces.chunk_by(|a, b| self.whole_face(*a) == self.whole_face(*b));
        let others: Vec<u32> = of_wholes.filter(|parts| parts.len() != 2).flatten().copied().collect();
        others.len() < faces.len() && (others.is_empty() || self.lie_flat(edge, &others))
    }

    /// Whether two faces at an edge lie in one plane on either side of it.
    fn lie_flat(&self, edge: u32, faces: &[u32]) -> bool {
        let &[first, second] = faces else { return false };
        let (edges, mesh) = (self.edges.get(), self.edges.get().mesh());
        let ends = edges.list().positions()[edge as usize];
        let [from, to] = ends.map(|end| mesh.positions[end as usize]);
        // The normals as if both turned the same way round the edge: opposite ones where they lie on either side.
        let normal = |face: u32| {
            let third = mesh.triangles[face as usize].into_iter().find(|corner| !ends.contains(corner))?;
            (to - from).cross(mesh.positions[third as usize] - from).try_normalize()
        };
        normal(first).zip(normal(second)).is_some_and(|(first, second)| (first + second).length() <= CONTACT)
    }
}

/// Classes at which a surface ends or turns away.
const OCCLUDING: ClassSet = ClassSet::of(&[Class::Boundary, Class::NonManifold, Class::Silhouette]);

/// Classes of edges that may have to last.
const CREASES: [Class; 3] = [Class::Crease, Class::ConvexCrease, Class::ConcaveCrease];

/// Of each edge of a mesh whether it is a crease that lasts, where only such are drawn.
fn lasting(edges: &MeshEdges, classes: &Classes, settings: &LineSettings) -> Option<Vec<bool>> {
    let is_crease = |edge: u32| !classes.of_edges[edge as usize].and(ClassSet::of(&CREASES)).is_empty();
    settings.lasting_creases.then(|| lasting_creases(edges.mesh(), edges.list(), is_crease))
}

/// The classes of a mesh's edges that have to be known for some settings.
pub(super) fn asked(settings: &LineSettings) -> ClassSet {
    let of_contours = if settings.has_smooth_contours() { ClassSet::of(&[Class::Crease]) } else { ClassSet::default() };
    settings.classes.or(OCCLUDING).or(of_contours).and(ClassSet::EDGES)
}

/// The edges of all parts that are wanted or hide others, in a stable order, and how many are wanted of each class. With smooth
/// contours only sharp edges are drawn as silhouette, as far as they are; what hides others is the same.
pub(super) fn edge_features(
    scene: &Scene,
    space: &Space,
    faces: &Faces,
    parts: &[Part<'_>],
    contours: Option<&Contours>,
    settings: &LineSettings,
) -> (Vec<Feature>, ClassCounts) {
    let mut features = Vec::new();
    let mut counts = ClassCounts::default();
    let (mut first_position, mut first_face) = (0, 0);
    for (number, part) in parts.iter().enumerate() {
        let edges = part.edges.get();
        let list = edges.list();
        let classes = edges.classes(settings.crease_angle, asked(settings));
        let silhouette = part.silhouette(scene.eye(part.object, SilhouetteRule::Exact));
        let (mesh, first_number) = (edges.mesh(), first_face);
        let lasting = lasting(edges, &classes, settings);
        let number_of = |face: u32| first_number + part.whole_face(face);
        first_face += part.shape().triangles.len() as u32;
        let edge_on = edges_of_edge_on_faces(faces, list, first_number..first_face, number_of);
        for edge in merged(merged(classes.marked.iter().copied(), silhouette.iter().copied()), edge_on.iter().copied())
        {
            let mut of_edge = classes.of_edges[edge as usize];
            if part.is_within_a_face(edge) {
                continue;
            }
            if lasting.as_ref().is_some_and(|lasting| !lasting[edge as usize]) {
                of_edge = of_edge.without(&CREASES);
            }
            let by_edge_on = match edge_on.binary_search(&edge) {
                Ok(_) => at_edge_on(faces, mesh, list, edge, number_of),
                Err(_) => None,
            };
            if by_edge_on.unwrap_or_else(|| silhouette.binary_search(&edge).is_ok()) {
                of_edge = of_edge.or(ClassSet::of(&[Class::Silhouette]));
            }
            let occludes = !of_edge.and(OCCLUDING).is_empty() || edge_on.binary_search(&edge).is_ok();
            let on_edge = contours.map_or(OnEdge::ByFaces, |contours| {
                contours.parts[number].on_edge(space, &faces.positions, list, edge)
            });
            let parts_by_class = parts_by_class(of_edge, on_edge, settings.classes);
            if let Some(class) = parts_by_class.iter().filter_map(|(class, _)| *class).min() {
                *counts.of(class) += 1;
            }
            for (class, [from, to]) in parts_by_class {
                if class.is_none() && !occludes {
                    continue;
                }
                let ends = list.positions()[edge as usize];
                let [low, high] = ends.map(|position| faces.positions[(position + first_position) as usize]);
                features.push(Feature {
                    class,
                    occludes,
                    object: number as u32,
                    own: Own::Edge(ends.map(|position| position + first_position)),
                    ends: [from, to].map(|share| between(low, high, share)),
                    weld: faces.weld(first_position),
                    planes: planes_of(faces, list.faces(edge), number_of),
                    plane: plane_of(faces, list.faces(edge), number_of),
                    edge: Some(ends.map(|position| mesh.file_vertices[position as usize])),
                    angle_degrees: angle(mesh, list, edge),
                });
            }
        }
        first_position += mesh.positions.len() as u32;
    }
    (features, counts)
}

/// From where to where an edge is drawn as which class, if as one.
fn parts_by_class(of_edge: ClassSet, on_edge: OnEdge, wanted: ClassSet) -> Vec<(Option<Class>, [f64; 2])> {
    let drawn = |with: &[Class]| {
        let others = of_edge.classes().filter(|class| *class != Class::Silhouette);
        others.fold(ClassSet::of(with), |set, class| set.or(ClassSet::of(&[class]))).and(wanted).first()
    };
    let other = drawn(&[]);
    let (turned, silhouette) = match on_edge {
        OnEdge::ByFaces => return vec![(of_edge.and(wanted).first(), [0.0, 1.0])],
        OnEdge::Parts(parts) => (drawn(&[Class::Silhouette]), parts),
        OnEdge::OfContour(parts) => (None, parts),
    };
    let mut parts = Vec::new();
    let mut from = 0.0;
    for part in silhouette {
        if part[0] > from {
            parts.push((other, [from, part[0]]));
        }
        parts.push((turned, part));
        from = part[1];
    }
    if from < 1.0 {
        parts.push((other, [from, 1.0]));
    }
    parts
}

/// The planes of the first two faces at an edge.
fn planes_of(faces: &Faces, at_edge: &[u32], number_of: impl Fn(u32) -> u32) -> [u32; 2] {
    let plane = |index: usize| at_edge.get(index).map_or(NO_FAMILY, |face| faces.plane(number_of(*face)));
    [plane(0), plane(1)]
}

/// The plane in which all faces at an edge lie, if they lie in one of many faces.
fn plane_of(faces: &Faces, at_edge: &[u32], number_of: impl Fn(u32) -> u32) -> u32 {
    let planes = at_edge.iter().map(|face| faces.plane(number_of(*face)));
    planes.reduce(|first, second| if first == second { first } else { NO_FAMILY }).unwrap_or(NO_FAMILY)
}

/// The lines where faces intersect, as features.
pub(super) fn intersection_features(faces: &Faces, parts: &[Part<'_>], intersections: &[Intersection]) -> Vec<Feature> {
    let starts: Vec<u32> = parts
        .iter()
        .scan(0, |next, part| Some(std::mem::replace(next, *next + part.shape().triangles.len() as u32)))
        .collect();
    let feature = |intersection: &Intersection| {
        let [first, second] = intersection.faces.map(|face| triangle_normal(faces.corners(face)));
        Feature {
            class: Some(Class::Intersection),
            occludes: false,
            object: (starts.partition_point(|start| *start <= faces.numbers[intersection.faces[0] as usize]) - 1)
                as u32,
            own: Own::Faces(intersection.faces),
            ends: intersection.ends,
            weld: faces.weld(faces.triangles[intersection.faces[0] as usize][0]),
            planes: intersection.faces.map(|face| faces.plane(faces.numbers[face as usize])),
            plane: NO_FAMILY,
            edge: None,
            angle_degrees: first.zip(second).map(|(first, second)| degrees_between(first, second)),
        }
    };
    intersections.iter().map(feature).collect()
}

/// Where faces are cut off by the near plane: what is behind appears there.
pub(super) fn near_plane_features(space: &Space, faces: &Faces) -> Vec<Feature> {
    let cut = |face: &u32| {
        let corners = faces.corners(*face);
        let mut points = (0..3).filter_map(|side| near_crossing(space, corners[side], corners[(side + 1) % 3]));
        Some(Feature {
            class: None,
            occludes: true,
            object: 0,
            own: Own::Faces([*face; 2]),
            ends: [points.next()?, points.next()?],
            weld: 0.0,
            planes: [NO_FAMILY; 2],
            plane: NO_FAMILY,
            edge: None,
            angle_degrees: None,
        })
    };
    faces.cut_by_near.iter().filter_map(cut).collect()
}

/// Edges of the faces that are seen edge-on: there a surface that faces the eye may go over into one that does not, without
/// any single edge between the two.
fn edges_of_edge_on_faces(
    faces: &Faces,
    list: &EdgeList,
    numbers: Range<u32>,
    number_of: impl Fn(u32) -> u32,
) -> Vec<u32> {
    let is_edge_on = |face: &u32| faces.edge_on.binary_search(&number_of(*face)).is_ok();
    if faces.edge_on.iter().any(|number| numbers.contains(number)) {
        (0..list.len() as u32).filter(|edge| list.faces(*edge).iter().any(is_edge_on)).collect()
    } else {
        Vec::new()
    }
}

/// Whether an edge is silhouette, if one of its two faces at least is seen edge-on, whatever the last digit says of it: to an eye
/// just beside this one such a face shows its front or its back, so that the edge is silhouette to one of both. Two edge-on
/// faces at an edge lie in one plane; where they are folded onto one another, one of both is always turned away.
fn at_edge_on(faces: &Faces, mesh: &Mesh, list: &EdgeList, edge: u32, number_of: impl Fn(u32) -> u32) -> Option<bool> {
    let &[first, second] = list.faces(edge) else { return None };
    let is_edge_on = |face: u32| faces.edge_on_for_sure.binary_search(&number_of(face)).is_ok();
    match (is_edge_on(first), is_edge_on(second)) {
        (false, false) => None,
        (true, true) => Some(angle(mesh, list, edge).is_some_and(|degrees| degrees > 90.0)),
        _ => Some(true),
    }
}

/// The angle between an edge's two faces, of one orientation, degrees.
fn angle(mesh: &Mesh, list: &EdgeList, edge: u32) -> Option<f64> {
    let &[first, second] = list.faces(edge) else { return None };
    let normal =
        |face: u32| triangle_normal(mesh.triangles[face as usize].map(|corner| mesh.positions[corner as usize]));
    let (first, second) = (normal(first)?, normal(second)?);
    let is_reversed = list.incidence()[edge as usize] == Incidence::InnerReversed;
    Some(degrees_between(first, if is_reversed { -second } else { second }))
}

/// The angle between two unit vectors, exact also where it is small.
fn degrees_between(first: DVec3, second: DVec3) -> f64 {
    first.cross(second).length().atan2(first.dot(second)).to_degrees()
}

/// Two ascending sequences as one, each number once.
fn merged(first: impl Iterator<Item = u32>, second: impl Iterator<Item = u32>) -> impl Iterator<Item = u32> {
    let (mut first, mut second) = (first.peekable(), second.peekable());
    std::iter::from_fn(move || {
        let next = match (first.peek(), second.peek()) {
            (Some(a), Some(b)) => *a.min(b),
            (Some(a), None) => *a,
            (None, Some(b)) => *b,
            (None, None) => return None,
        };
        first.next_if_eq(&next);
        second.next_if_eq(&next);
        Some(next)
    })
}
