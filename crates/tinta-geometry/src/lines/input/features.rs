//! The lines of a scene before their visibility is decided: edges by class, ends of surfaces, intersections.

use crate::bvh::NO_GROUP;
use crate::edges::{Class, ClassCounts, ClassSet, EdgeList, Incidence, SilhouetteRule};
use crate::error::Result;
use crate::lines::LineSettings;
use crate::lines::input::feature::Feature;
use crate::lines::input::normal_creases::creased_parts;
use crate::lines::input::object_edges::ObjectEdges;
use crate::lines::input::part_classes::{CREASES, PartClasses};
use crate::lines::parts::scene_parts::SceneParts;
use crate::lines::smooth::contours::{Contours, OnEdge, between};
use crate::lines::visible::faces::{Faces, Own, near_crossing};
use crate::lines::visible::intersections::Intersection;
use crate::lines::visible::space::Space;
use crate::memory;
use crate::mesh::{Mesh, triangle_normal};
use crate::scene::Scene;
use glam::DVec3;
use std::ops::Range;

/// Classes at which a surface ends or turns away.
const OCCLUDING: ClassSet = ClassSet::of(&[Class::Boundary, Class::NonManifold, Class::Silhouette]);

/// The classes of a mesh's edges that these settings need.
pub(in crate::lines) fn asked(settings: &LineSettings) -> ClassSet {
    let of_normals = match settings.creases_by_normals && settings.classes.contains(Class::Crease) {
        true => ClassSet::of(&[Class::Normal]),
        false => ClassSet::default(),
    };
    let of_contours = if settings.has_smooth_contours() { ClassSet::of(&[Class::Crease]) } else { ClassSet::default() };
    settings.classes.or(OCCLUDING).or(of_contours).or(of_normals).and(ClassSet::EDGES)
}

/// The edges of all parts that are drawn or hide others, in a stable order, and the number of drawn ones in each
/// class. With smooth contours, only the silhouette parts of sharp edges are drawn as silhouette; the edges that hide
/// others are the same.
pub(in crate::lines) fn edge_features(
    scene: &Scene,
    space: &Space,
    faces: &Faces,
    (parts, scene_parts): (&[ObjectEdges<'_>], &SceneParts),
    contours: Option<&Contours>,
    settings: &LineSettings,
) -> (Vec<Feature>, ClassCounts) {
    let crease_angles = scene_parts.crease_angles();
    let mut features = Vec::new();
    let mut counts = ClassCounts::default();
    let (mut first_position, mut first_face) = (0, 0);
    for (number, part) in parts.iter().enumerate() {
        let edges = part.edges.get();
        let list = edges.list();
        let classes = PartClasses::new(edges, settings, &crease_angles, asked(settings));
        let silhouette = part.silhouette(scene.eye(part.object, SilhouetteRule::Exact));
        let (mesh, first_number) = (edges.mesh(), first_face);
        let part_of = |face: &u32| scene_parts.of_face(number, mesh, *face);
        let is_ghost = |face: &u32| scene_parts.is_ghost(part_of(face));
        // A surface ends where only ghosts continue it.
        let ends_at_ghosts = |edge: &u32| {
            let mut ghosts = list.faces(*edge).iter().map(is_ghost);
            let first = ghosts.next();
            ghosts.any(|is_ghost| Some(is_ghost) != first)
        };
        let at_ghosts: Vec<u32> = match scene_parts.has_ghosts() {
            true => (0..list.len() as u32).filter(ends_at_ghosts).collect(),
            false => Vec::new(),
        };
        let number_of = |face: u32| first_number + part.whole_face(face);
        first_face += part.shape().triangles.len() as u32;
        let edge_on = edges_of_edge_on_faces(faces, list, first_number..first_face, number_of);
        let marked = classes.marked();
        let found = merged(merged(marked.iter().copied(), silhouette.iter().copied()), edge_on.iter().copied());
        for edge in merged(found, at_ghosts.iter().copied()) {
            if part.is_within_a_face(edge) {
                continue;
            }
            let of_part = scene_parts.owner(list.faces(edge).iter().map(part_of));
            let look = scene_parts.look_of(of_part);
            let wanted = match settings.joins_parts && part.is_seam_of_parts(edge) {
                true => ClassSet::default(),
                false => scene_parts.classes(of_part),
            };
            let (mut of_edge, may_be_crease) = classes.of(edge, look);
            let mut creased = Vec::new();
            if settings.creases_by_normals {
                if may_be_crease && of_edge.contains(Class::Normal) && wanted.contains(Class::Crease) {
                    creased = creased_parts(mesh, list, edge, crease_angles[look as usize].cosine);
                }
                of_edge = of_edge.without(&CREASES);
            }
            let by_edge_on = match edge_on.binary_search(&edge) {
                Ok(_) => at_edge_on(faces, mesh, list, edge, number_of),
                Err(_) => None,
            };
            if by_edge_on.unwrap_or_else(|| silhouette.binary_search(&edge).is_ok()) {
                of_edge = of_edge.or(ClassSet::of(&[Class::Silhouette]));
            }
            let is_of_ghost = scene_parts.is_ghost(of_part);
            let is_end = || !of_edge.and(OCCLUDING).is_empty() || edge_on.binary_search(&edge).is_ok();
            // The surface that ends at ghosts may belong to another part than the edge.
            let occludes = at_ghosts.binary_search(&edge).is_ok() || (!is_of_ghost && is_end());
            let on_edge = contours.map_or(OnEdge::ByFaces, |contours| {
                contours.parts[number].on_edge(space, &faces.positions, list, edge)
            });
            let mut parts_by_class = parts_by_class(of_edge, on_edge, wanted);
            if !creased.is_empty() {
                parts_by_class = with_creases(&parts_by_class, &creased);
            }
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
                    part: of_part,
                    is_ghost: is_of_ghost,
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

/// The parts of an edge, and the class that each is drawn as, if any.
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

/// Parts of an edge cut where its creased parts begin and end, and those drawn as creases unless their class comes before.
fn with_creases(parts: &[(Option<Class>, [f64; 2])], creased: &[[f64; 2]]) -> Vec<(Option<Class>, [f64; 2])> {
    let mut cut = Vec::new();
    for (class, [from, to]) in parts {
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

/// The planes of the first two faces at an edge.
fn planes_of(faces: &Faces, at_edge: &[u32], number_of: impl Fn(u32) -> u32) -> [u32; 2] {
    let plane = |index: usize| at_edge.get(index).map_or(NO_GROUP, |face| faces.plane(number_of(*face)));
    [plane(0), plane(1)]
}

/// The plane of all faces at an edge, if they share one with many faces.
fn plane_of(faces: &Faces, at_edge: &[u32], number_of: impl Fn(u32) -> u32) -> u32 {
    let planes = at_edge.iter().map(|face| faces.plane(number_of(*face)));
    planes.reduce(|first, second| if first == second { first } else { NO_GROUP }).unwrap_or(NO_GROUP)
}

/// The intersections of faces whose parts have this class, or the class of lines between parts; counts them.
pub(in crate::lines) fn intersection_features(
    faces: &Faces,
    (parts, scene_parts): (&[ObjectEdges<'_>], &SceneParts),
    intersections: &[Intersection],
    counts: &mut ClassCounts,
) -> Vec<Feature> {
    let starts: Vec<u32> = parts
        .iter()
        .scan(0, |next, part| Some(std::mem::replace(next, *next + part.shape().triangles.len() as u32)))
        .collect();
    let object_of = |number: u32| starts.partition_point(|start| *start <= number) - 1;
    let part_of = |face: u32| {
        let number = faces.numbers[face as usize];
        let object = object_of(number);
        scene_parts.of_face(object, parts[object].shape(), number - starts[object])
    };
    // The object and its part in the file.
    let in_file = |face: u32| {
        let number = faces.numbers[face as usize];
        let object = object_of(number);
        (object, parts[object].shape().triangle_parts.get((number - starts[object]) as usize))
    };
    let mut feature = |intersection: &Intersection| {
        let of_faces = intersection.faces.map(part_of);
        let part = scene_parts.owner(of_faces.into_iter());
        let [first, second] = intersection.faces.map(in_file);
        let between = ClassSet::of(if first == second { &[] } else { &[Class::Part] });
        let class = between.or(ClassSet::of(&[Class::Intersection])).and(scene_parts.classes(part)).first()?;
        *counts.of(class) += 1;
        let [first, second] = intersection.faces.map(|face| triangle_normal(faces.corners(face)));
        Some(Feature {
            class: Some(class),
            occludes: false,
            object: object_of(faces.numbers[intersection.faces[0] as usize]) as u32,
            part,
            is_ghost: of_faces.into_iter().any(|part| scene_parts.is_ghost(part)),
            own: Own::Faces(intersection.faces),
            ends: intersection.ends,
            weld: faces.weld(faces.triangles[intersection.faces[0] as usize][0]),
            planes: intersection.faces.map(|face| faces.plane(faces.numbers[face as usize])),
            plane: NO_GROUP,
            edge: None,
            angle_degrees: first.zip(second).map(|(first, second)| degrees_between(first, second)),
        })
    };
    intersections.iter().filter_map(&mut feature).collect()
}

/// The curves and points of all parts, lifted by [`LineSettings::on_surface`]; counts them.
///
/// # Errors
///
/// [`Error::Setting`](crate::Error::Setting) for more than memory holds.
pub(in crate::lines) fn free_features(
    space: &Space,
    (parts, scene_parts): (&[ObjectEdges<'_>], &SceneParts),
    settings: &LineSettings,
    counts: &mut ClassCounts,
) -> Result<Vec<Feature>> {
    /// Of a line, its image, its piece and its path, measured.
    const BYTES: usize = 800;
    let is_wanted = |object: usize, class: Class| scene_parts.classes(scene_parts.of_curves(object)).contains(class);
    for (number, part) in parts.iter().enumerate() {
        let curves = &part.object.mesh.curves;
        counts.curve += if is_wanted(number, Class::Curve) { curves.segments.len() } else { 0 };
        counts.point += if is_wanted(number, Class::Point) { curves.points.len() } else { 0 };
    }
    let count = counts.curve + counts.point;
    memory::check_lines(count.saturating_mul(BYTES), memory::free())?;
    let mut features = Vec::with_capacity(count);
    for (number, part) in parts.iter().enumerate() {
        let curves = &part.object.mesh.curves;
        let view = |position: u32| {
            let world = curves.positions[position as usize] + part.object.offset;
            space.lifted(space.view(world), settings.on_surface)
        };
        let free = |class: Class, positions: [u32; 2]| Feature {
            class: Some(class),
            occludes: false,
            object: number as u32,
            part: scene_parts.of_curves(number),
            is_ghost: false,
            own: Own::Free,
            ends: positions.map(view),
            weld: 0.0,
            planes: [NO_GROUP; 2],
            plane: NO_GROUP,
            edge: Some(positions.map(|position| curves.file_vertices[position as usize])),
            angle_degrees: None,
        };
        if is_wanted(number, Class::Curve) {
            features.extend(curves.segments.iter().map(|ends| free(Class::Curve, *ends)));
        }
        if is_wanted(number, Class::Point) {
            features.extend(curves.points.iter().map(|point| free(Class::Point, [*point; 2])));
        }
    }
    Ok(features)
}

/// The lines where the near plane cuts faces: things behind appear there.
pub(in crate::lines) fn near_plane_features(space: &Space, faces: &Faces) -> Vec<Feature> {
    let cut = |face: &u32| {
        let corners = faces.corners(*face);
        let mut points = (0..3).filter_map(|side| near_crossing(space, corners[side], corners[(side + 1) % 3]));
        Some(Feature {
            class: None,
            occludes: true,
            object: 0,
            part: 0,
            is_ghost: false,
            own: Own::Faces([*face; 2]),
            ends: [points.next()?, points.next()?],
            weld: 0.0,
            planes: [NO_GROUP; 2],
            plane: NO_GROUP,
            edge: None,
            angle_degrees: None,
        })
    };
    faces.cut_by_near.iter().filter_map(cut).collect()
}

/// Edges of faces seen edge-on: a surface may turn from front to back there without any single edge between the two.
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

/// Whether an edge with at least one edge-on face is silhouette, independent of rounding. From slightly to one side
/// such a face shows its front, from the other its back: the edge is silhouette from one of both. Two edge-on faces
/// at an edge are coplanar; if they are folded onto each other, one of them always faces away.
fn at_edge_on(faces: &Faces, mesh: &Mesh, list: &EdgeList, edge: u32, number_of: impl Fn(u32) -> u32) -> Option<bool> {
    let &[first, second] = list.faces(edge) else { return None };
    let is_edge_on = |face: u32| faces.edge_on_for_sure.binary_search(&number_of(face)).is_ok();
    match (is_edge_on(first), is_edge_on(second)) {
        (false, false) => None,
        (true, true) => Some(angle(mesh, list, edge).is_some_and(|degrees| degrees > 90.0)),
        _ => Some(true),
    }
}

/// The angle between the two faces of an edge, for one orientation, degrees.
fn angle(mesh: &Mesh, list: &EdgeList, edge: u32) -> Option<f64> {
    let &[first, second] = list.faces(edge) else { return None };
    let normal =
        |face: u32| triangle_normal(mesh.triangles[face as usize].map(|corner| mesh.positions[corner as usize]));
    let (first, second) = (normal(first)?, normal(second)?);
    let is_reversed = list.incidence()[edge as usize] == Incidence::InnerReversed;
    Some(degrees_between(first, if is_reversed { -second } else { second }))
}

/// The angle between two unit vectors, degrees; precise for small angles too.
fn degrees_between(first: DVec3, second: DVec3) -> f64 {
    first.cross(second).length().atan2(first.dot(second)).to_degrees()
}

/// Merges two ascending sequences, each number once.
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
