//! The lines of a scene before their visibility is decided: edges by class, ends of surfaces, intersections.

use crate::bvh::NO_GROUP;
use crate::edges::{Class, ClassCounts, ClassSet, CreaseAngle, EdgeList, Incidence, SilhouetteRule};
use crate::error::Result;
use crate::lines::eye::space::at_depth;
use crate::lines::input::edge_classes::{CREASES, EdgeClasses};
use crate::lines::input::feature::{Feature, Own};
use crate::lines::input::line_input::{LineInput, OCCLUDING, asked};
use crate::lines::input::normal_creases::creased_shares;
use crate::lines::input::object_edges::ObjectEdges;
use crate::lines::sight::Intersection;
use crate::lines::smooth::contours::{Contours, ObjectSurface, OnEdge, between};
use crate::memory;
use crate::mesh::{Mesh, triangle_normal};
use crate::ranges::with_gaps;
use glam::DVec3;

impl LineInput<'_> {
    /// The edges of all objects that are drawn or hide others, in a stable order, and the number of drawn ones in each
    /// class. With smooth contours, only the silhouette pieces of sharp edges are drawn as silhouette; the edges that hide
    /// others are the same.
    pub(in crate::lines) fn edge_features(&self, contours: Option<&Contours>) -> (Vec<Feature>, ClassCounts) {
        let crease_angles = self.scene_parts.crease_angles();
        let (mut features, mut counts) = (Vec::new(), ClassCounts::default());
        for (number, object) in self.objects.iter().enumerate() {
            let edges = EdgesOfObject::new(self, number, object, &crease_angles);
            let surface = contours.map(|contours| &contours.surfaces[number]);
            for edge in edges.candidates() {
                edges.add(edge, surface, &mut features, &mut counts);
            }
        }
        (features, counts)
    }
}

/// The edges of an object, with what each is.
struct EdgesOfObject<'a> {
    input: &'a LineInput<'a>,
    number: usize,
    object: &'a ObjectEdges<'a>,
    mesh: &'a Mesh,
    list: &'a EdgeList,
    crease_angles: &'a [CreaseAngle],
    classes: EdgeClasses,
    /// Edges between front and back, edges of faces seen edge-on, and edges where only ghosts continue a surface; ascending.
    silhouette: Vec<u32>,
    edge_on: Vec<u32>,
    at_ghosts: Vec<u32>,
}

impl<'a> EdgesOfObject<'a> {
    fn new(
        input: &'a LineInput<'a>,
        number: usize,
        object: &'a ObjectEdges<'a>,
        crease_angles: &'a [CreaseAngle],
    ) -> Self {
        let edges = object.edges.get();
        let classes = EdgeClasses::new(edges, &input.settings, crease_angles, asked(&input.settings));
        let silhouette = object.silhouette(input.scene.eye(object.object, SilhouetteRule::Exact));
        let (mesh, list) = (edges.mesh(), edges.list());
        let (edge_on, at_ghosts) = (Vec::new(), Vec::new());
        let mut all =
            Self { input, number, object, mesh, list, crease_angles, classes, silhouette, edge_on, at_ghosts };
        let numbers = object.first_face..object.first_face + object.shape().triangles.len() as u32;
        let edges = || 0..list.len() as u32;
        // A surface may turn from front to back at a face seen edge-on without any single edge between the two.
        if input.faces.edge_on.iter().any(|number| numbers.contains(number)) {
            let is_edge_on = |face: &u32| input.faces.edge_on.binary_search(&all.number_of(*face)).is_ok();
            all.edge_on = edges().filter(|edge| list.faces(*edge).iter().any(is_edge_on)).collect();
        }
        if input.scene_parts.has_ghosts() {
            all.at_ghosts = edges().filter(|edge| all.ends_at_ghosts(*edge)).collect();
        }
        all
    }

    /// The edges that may be drawn or hide others, ascending.
    fn candidates(&self) -> impl Iterator<Item = u32> {
        let mut all = [&self.classes.marked()[..], &self.silhouette, &self.edge_on, &self.at_ghosts].concat();
        all.sort();
        all.dedup();
        all.into_iter().filter(|edge| !self.object.is_within_a_face(*edge))
    }

    /// The scene's number of the face that holds a face of the list.
    fn number_of(&self, face: u32) -> u32 {
        self.object.first_face + self.object.whole_face(face)
    }

    /// The scene's part of a face.
    fn part_of(&self, face: u32) -> u32 {
        self.input.scene_parts.of_face(self.number, self.mesh, face)
    }

    /// Whether a surface ends at an edge, since only ghosts continue it.
    fn ends_at_ghosts(&self, edge: u32) -> bool {
        let mut ghosts = self.list.faces(edge).iter().map(|face| self.input.scene_parts.is_ghost(self.part_of(*face)));
        let first = ghosts.next();
        ghosts.any(|is_ghost| Some(is_ghost) != first)
    }

    /// Adds an edge, in pieces where its class changes along it.
    fn add(&self, edge: u32, surface: Option<&ObjectSurface>, features: &mut Vec<Feature>, counts: &mut ClassCounts) {
        let LineInput { settings, faces, space, scene_parts, .. } = self.input;
        let at_edge = self.list.faces(edge);
        let part = scene_parts.owner(at_edge.iter().map(|face| self.part_of(*face)));
        let wanted = match settings.joins_parts && self.object.is_seam_of_parts(edge) {
            true => ClassSet::default(),
            false => scene_parts.classes(part),
        };
        let (of_edge, creased) = self.classes_of(edge, scene_parts.look_of(part), wanted);
        let is_ghost = scene_parts.is_ghost(part);
        let is_end = || !of_edge.and(OCCLUDING).is_empty() || self.edge_on.binary_search(&edge).is_ok();
        // The surface that ends at ghosts may belong to another part than the edge.
        let occludes = self.at_ghosts.binary_search(&edge).is_ok() || (!is_ghost && is_end());
        let on_edge =
            surface.map_or(OnEdge::ByFaces, |surface| surface.on_edge(space, &faces.positions, self.list, edge));
        let mut pieces = pieces_by_class(of_edge, on_edge, wanted);
        if !creased.is_empty() {
            pieces = with_creases(&pieces, &creased);
        }
        if let Some(class) = pieces.iter().filter_map(|(class, _)| *class).min() {
            *counts.of(class) += 1;
        }
        let ends = self.list.positions()[edge as usize];
        let own = ends.map(|position| position + self.object.first_position);
        let [low, high] = own.map(|position| faces.positions[position as usize]);
        let mut planes = at_edge.iter().map(|face| faces.plane(self.number_of(*face)));
        let two = [planes.next().unwrap_or(NO_GROUP), planes.next().unwrap_or(NO_GROUP)];
        let is_flat = at_edge.len() == 1 || two[0] == two[1] && planes.all(|plane| plane == two[0]);
        for (class, [from, to]) in pieces.into_iter().filter(|(class, _)| class.is_some() || occludes) {
            features.push(Feature {
                class,
                occludes,
                object: self.number as u32,
                part,
                is_ghost,
                weld: faces.weld(self.object.first_position),
                planes: two,
                plane: if is_flat { two[0] } else { NO_GROUP },
                edge: Some(ends.map(|position| self.mesh.file_vertices[position as usize])),
                angle_degrees: self.angle(edge),
                ..Feature::new(Own::Edge(own), [from, to].map(|share| between(low, high, share)))
            });
        }
    }

    /// The classes of an edge, and where along it the normals make a crease.
    fn classes_of(&self, edge: u32, look: u32, wanted: ClassSet) -> (ClassSet, Vec<[f64; 2]>) {
        let (mut of_edge, may_be_crease) = self.classes.of(edge, look);
        let mut creased = Vec::new();
        if self.input.settings.creases_by_normals {
            if may_be_crease && of_edge.contains(Class::Normal) && wanted.contains(Class::Crease) {
                creased = creased_shares(self.mesh, self.list, edge, self.crease_angles[look as usize].cosine);
            }
            of_edge = of_edge.without(&CREASES);
        }
        let by_edge_on = self.edge_on.binary_search(&edge).ok().and_then(|_| self.at_edge_on(edge));
        match by_edge_on.unwrap_or_else(|| self.silhouette.binary_search(&edge).is_ok()) {
            true => (of_edge.or(ClassSet::of(&[Class::Silhouette])), creased),
            false => (of_edge, creased),
        }
    }

    /// Whether an edge with at least one edge-on face is silhouette, independent of rounding. From slightly to one side
    /// such a face shows its front, from the other its back: the edge is silhouette from one of both. Two edge-on faces
    /// at an edge are coplanar; if they are folded onto each other, one of them always faces away.
    fn at_edge_on(&self, edge: u32) -> Option<bool> {
        let &[first, second] = self.list.faces(edge) else { return None };
        let is_edge_on = |face: u32| self.input.faces.edge_on_for_sure.binary_search(&self.number_of(face)).is_ok();
        match (is_edge_on(first), is_edge_on(second)) {
            (false, false) => None,
            (true, true) => Some(self.angle(edge).is_some_and(|degrees| degrees > 90.0)),
            _ => Some(true),
        }
    }

    /// The angle between the two faces of an edge, for one orientation, degrees.
    fn angle(&self, edge: u32) -> Option<f64> {
        let &[first, second] = self.list.faces(edge) else { return None };
        let corners = |face: u32| self.mesh.triangles[face as usize].map(|it| self.mesh.positions[it as usize]);
        let (first, second) = (triangle_normal(corners(first))?, triangle_normal(corners(second))?);
        let is_reversed = self.list.incidence()[edge as usize] == Incidence::InnerReversed;
        Some(degrees_between(first, if is_reversed { -second } else { second }))
    }
}

/// The pieces of an edge, and the class that each is drawn as, if any.
fn pieces_by_class(of_edge: ClassSet, on_edge: OnEdge, wanted: ClassSet) -> Vec<(Option<Class>, [f64; 2])> {
    let drawn = |with: &[Class]| {
        let others = of_edge.classes().filter(|class| *class != Class::Silhouette);
        others.fold(ClassSet::of(with), |set, class| set.or(ClassSet::of(&[class]))).and(wanted).first()
    };
    let other = drawn(&[]);
    let (turned, silhouette) = match on_edge {
        OnEdge::ByFaces => return vec![(of_edge.and(wanted).first(), [0.0, 1.0])],
        OnEdge::Shares(shares) => (drawn(&[Class::Silhouette]), shares),
        OnEdge::OfContour(shares) => (None, shares),
    };
    let pieces = with_gaps([0.0, 1.0], &silhouette).into_iter();
    pieces.map(|(share, is_turned)| (if is_turned { turned } else { other }, share)).collect()
}

/// Pieces of an edge, cut where the normals begin and end to make a crease, and drawn as creases there unless their class comes before.
fn with_creases(pieces: &[(Option<Class>, [f64; 2])], creased: &[[f64; 2]]) -> Vec<(Option<Class>, [f64; 2])> {
    let mut cut = Vec::new();
    for (class, [from, to]) in pieces {
        let inner = creased.as_flattened().iter().copied().filter(|share| from < share && share < to);
        let places: Vec<f64> = std::iter::once(*from).chain(inner).chain([*to]).collect();
        for ends in places.windows(2) {
            let middle = f64::midpoint(ends[0], ends[1]);
            let is_creased = creased.iter().any(|[start, end]| (*start..=*end).contains(&middle));
            let crease = is_creased.then_some(Class::Crease);
            cut.push((class.iter().copied().chain(crease).min(), [ends[0], ends[1]]));
        }
    }
    cut
}

impl LineInput<'_> {
    /// The intersections of faces whose parts have this class, or the class of lines between parts; counts them.
    pub(in crate::lines) fn intersection_features(
        &self,
        intersections: &[Intersection],
        counts: &mut ClassCounts,
    ) -> Vec<Feature> {
        let Self { faces, objects, scene_parts, .. } = self;
        let mut feature = |intersection: &Intersection| {
            let numbers = intersection.faces.map(|face| faces.numbers[face as usize]);
            let places = numbers.map(|number| faces.in_object(number));
            let of_faces = places.map(|(object, face)| scene_parts.of_face(object, objects[object].shape(), face));
            let part = scene_parts.owner(of_faces.into_iter());
            // The object and its part in the file.
            let in_file =
                |(object, face): (usize, u32)| (object, objects[object].shape().triangle_parts.get(face as usize));
            let is_of_one = in_file(places[0]) == in_file(places[1]);
            let between = ClassSet::of(if is_of_one { &[] } else { &[Class::Part] });
            let class = between.or(ClassSet::of(&[Class::Intersection])).and(scene_parts.classes(part)).first()?;
            *counts.of(class) += 1;
            let [first, second] = intersection.faces.map(|face| triangle_normal(faces.corners(face)));
            Some(Feature {
                class: Some(class),
                object: places[0].0 as u32,
                part,
                is_ghost: of_faces.into_iter().any(|part| scene_parts.is_ghost(part)),
                weld: faces.weld(faces.triangles[intersection.faces[0] as usize][0]),
                planes: numbers.map(|number| faces.plane(number)),
                angle_degrees: first.zip(second).map(|(first, second)| degrees_between(first, second)),
                ..Feature::new(Own::Faces(intersection.faces), intersection.ends)
            })
        };
        intersections.iter().filter_map(&mut feature).collect()
    }

    /// The curves and points of all objects, lifted by [`LineSettings::on_surface`](crate::lines::LineSettings::on_surface); counts them.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`](crate::Error::Setting) for more than memory holds.
    pub(in crate::lines) fn free_features(&self, counts: &mut ClassCounts) -> Result<Vec<Feature>> {
        /// Of a line, its image, its piece and its path, measured.
        const BYTES: usize = 800;
        let Self { space, objects, scene_parts, settings, .. } = self;
        let is_wanted =
            |object: usize, class: Class| scene_parts.classes(scene_parts.of_curves(object)).contains(class);
        for (number, object) in objects.iter().enumerate() {
            let curves = &object.object.mesh.curves;
            counts.curve += if is_wanted(number, Class::Curve) { curves.segments.len() } else { 0 };
            counts.point += if is_wanted(number, Class::Point) { curves.points.len() } else { 0 };
        }
        let count = counts.curve + counts.point;
        memory::LINES.check(count.saturating_mul(BYTES), memory::free())?;
        let mut features = Vec::with_capacity(count);
        for (number, object) in objects.iter().enumerate() {
            let curves = &object.object.mesh.curves;
            let view = |position: u32| {
                let world = curves.positions[position as usize] + object.object.offset;
                space.lifted(space.view(world), settings.on_surface)
            };
            let free = |class: Class, part: u32, positions: [u32; 2]| Feature {
                class: Some(class),
                object: number as u32,
                part,
                edge: Some(positions.map(|position| curves.file_vertices[position as usize])),
                ..Feature::new(Own::Free, positions.map(view))
            };
            let (part, of_cut) = (scene_parts.of_curves(number), scene_parts.of_cut(number));
            let (own, strokes) = curves.segments.split_at(curves.segments.len() - curves.hatching);
            if is_wanted(number, Class::Curve) {
                features.extend(own.iter().map(|ends| free(Class::Curve, part, *ends)));
            }
            if scene_parts.classes(of_cut).contains(Class::Curve) {
                features.extend(strokes.iter().map(|ends| free(Class::Curve, of_cut, *ends)));
            }
            if is_wanted(number, Class::Point) {
                features.extend(curves.points.iter().map(|point| free(Class::Point, part, [*point; 2])));
            }
        }
        Ok(features)
    }

    /// The lines where the near plane cuts faces: things behind appear there.
    pub(in crate::lines) fn near_plane_features(&self) -> impl Iterator<Item = Feature> {
        let cut = |face: &u32| {
            let corners = self.faces.corners(*face);
            let mut points =
                (0..3).filter_map(|side| at_depth([corners[side], corners[(side + 1) % 3]], self.space.near));
            let ends = [points.next()?, points.next()?];
            Some(Feature { occludes: true, ..Feature::new(Own::Faces([*face; 2]), ends) })
        };
        self.faces.cut_by_near.iter().filter_map(cut)
    }
}

/// The angle between two unit vectors, degrees; precise for small angles too.
fn degrees_between(first: DVec3, second: DVec3) -> f64 {
    first.cross(second).length().atan2(first.dot(second)).to_degrees()
}
