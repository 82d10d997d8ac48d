//! Smooth silhouettes for drawing with a depth buffer: where the smooth surface turns away, and how far lines must
//! move towards the eye to be visible.
//!
//! A contour runs through faces that may be turned away from the eye. Adjacent faces then hide it, although the
//! smooth surface would not. Exact lines solve this with a contour's summit. A depth buffer stores one depth per
//! pixel, so each end is moved towards the eye instead. The plane through the eye, the end and its normal cuts the
//! mesh in a line. The search follows this line towards the eye to the last place, within the length of an edge,
//! where it comes in front of the end. The end moves to that depth. Its place in the picture stays the same.

use crate::edges::{CreaseAngle, SilhouetteRule};
use crate::lines::eye::space::Space;
use crate::lines::input::object_edges::{Edges, ObjectEdges};
use crate::lines::smooth::contour_visibility::MOST_FACES;
use crate::lines::smooth::contours::{ContourPiece, Contours, ObjectSurface, OnEdge};
use crate::mesh::NONE;
use crate::scene::Scene;
use crate::threads::{filled, threads_for};
use glam::DVec3;
use std::collections::HashMap;

/// The smooth silhouette of one object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SmoothSilhouette {
    /// Whole edges, ascending: sharp ones between flat faces of which exactly one is seen from the front.
    pub edges: Vec<u32>,
    /// Parts of sharp edges next to curved faces, by edge: start and end as shares of the edge from its lower to its
    /// higher position.
    pub edge_parts: Vec<(u32, [f64; 2])>,
    /// Segments through faces, in mesh coordinates, moved towards the eye so far that adjacent faces of their object
    /// do not hide them. Segments that meet share an end bit for bit.
    pub pieces: Vec<[DVec3; 2]>,
}

impl SmoothSilhouette {
    /// Returns the silhouette parts of an edge, in order; none if the whole edge is silhouette or none of it.
    pub fn parts_of(&self, edge: u32) -> impl Iterator<Item = [f64; 2]> {
        let first = self.edge_parts.partition_point(|(other, _)| *other < edge);
        self.edge_parts[first..].iter().take_while(move |(other, _)| *other == edge).map(|(_, part)| *part)
    }
}

/// Returns the smooth silhouette of each object of a scene. Edges above `crease_angle` are sharp. Parts that a closed
/// shell hides of itself are omitted.
pub fn smooth_silhouettes(scene: &Scene, crease_angle: CreaseAngle) -> Vec<SmoothSilhouette> {
    let space = Space::of(scene);
    let objects = ObjectEdges::all(scene, |_, object| Edges::OfScene(scene.edges(object)));
    let mut positions = Vec::with_capacity(scene.objects.iter().map(|object| object.mesh.positions.len()).sum());
    for object in &scene.objects {
        let own = &object.mesh.positions;
        let view = |index: usize| space.view(own[index] + object.offset);
        positions.extend(filled(own.len(), threads_for(own.len()), DVec3::ZERO, view));
    }
    let is_before = |position: &DVec3| -position.z < space.near;
    let is_cut_by_near = positions.iter().any(is_before) && !positions.iter().all(is_before);
    let contours = Contours::new(scene, &space, &positions, is_cut_by_near, &objects, crease_angle);
    let mut found = Vec::with_capacity(objects.len());
    for (object, surface) in objects.iter().zip(&contours.surfaces) {
        let edges = object.edges.get();
        let mut silhouette = SmoothSilhouette::default();
        silhouette.edges = edges.silhouette(scene.eye(object.object, SilhouetteRule::Exact), SilhouetteRule::Exact);
        silhouette
            .edges
            .retain(|edge| matches!(surface.on_edge(&space, &positions, edges.list(), *edge), OnEdge::ByFaces));
        silhouette.edge_parts = surface.edge_parts.clone();
        found.push(silhouette);
    }
    // Segments that meet are followed from the same face, so they still meet.
    let mut moved: HashMap<(u32, [u64; 3]), DVec3> = HashMap::new();
    let is_seen = |piece: &&ContourPiece| !contours.is_inside(piece);
    for piece in contours.pieces.iter().filter(is_seen) {
        let number = piece.object as usize;
        let (object, surface) = (&objects[number], &contours.surfaces[number]);
        let ends = [0, 1].map(|end| {
            let key = (piece.object, piece.ends[end].to_array().map(f64::to_bits));
            *moved.entry(key).or_insert_with(|| {
                space.world(before_own_faces(&space, &positions, object, surface, piece, end)) - object.object.offset
            })
        });
        found[number].pieces.push(ends);
    }
    found
}

/// The end of a segment in eye space, moved towards the eye until adjacent faces do not hide it.
fn before_own_faces(
    space: &Space,
    positions: &[DVec3],
    object: &ObjectEdges<'_>,
    surface: &ObjectSurface,
    piece: &ContourPiece,
    end: usize,
) -> DVec3 {
    let (start, normal) = (piece.ends[end], piece.normals[end]);
    if -start.z <= space.near {
        return start;
    }
    let list = object.edges.get().list();
    let to_eye = space.to_eye(start).normalize_or_zero();
    let plane = to_eye.cross(normal);
    // Across the line of sight, towards the side where the surface extends beyond the end.
    let across = plane.cross(to_eye).normalize_or_zero();
    let outwards = if (across.dot(normal) > 0.0) == piece.bends_away { across } else { -across };
    let reach = surface.longest_side(positions, piece.face);
    let (mut face, mut came) = (piece.face, NONE);
    let (mut height, mut nearer, mut moved) = (0.0, 0.0, 0.0);
    for _ in 0..MOST_FACES {
        let Some(exit) = surface.exit(positions, face, came, [start, plane], to_eye) else { break };
        if -exit.point.z < space.near {
            break;
        }
        let (height_before, nearer_before): (f64, f64) = (height, nearer);
        height = outwards.dot(exit.point - start);
        nearer = to_eye.dot(exit.point - start);
        if height <= 0.0 && height_before > 0.0 {
            moved = nearer_before + (nearer - nearer_before) * (height_before / (height_before - height));
        }
        let is_near = exit.point.distance(start) < reach;
        let next = list.faces(exit.edge).iter().find(|other| **other != face);
        let next = next.filter(|_| (is_near || height > 0.0) && !surface.surface.is_sharp[exit.edge as usize]);
        let Some(next) = next else { break };
        (face, came) = (*next, exit.edge);
    }
    start + to_eye * f64::clamp(moved, 0.0, -start.z - space.near)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::lines::eye::cast::first_hit;
    use crate::lines::eye::faces::Faces;
    use crate::lines::smooth::closed_forms::ClosedForm;
    use crate::lines::smooth::contours::between;
    use crate::lines::smooth_tests::{camera, cylinder, found, scene, smooth};
    use crate::mesh::{LoadOptions, load};
    use glam::DVec2;

    fn px(scene: &Scene, piece: [DVec3; 2]) -> [DVec2; 2] {
        let space = Space::of(scene);
        piece.map(|end| space.project(space.view(end + scene.objects[0].offset)).0)
    }

    #[test]
    fn the_pieces_of_an_ellipsoid_are_one_ring_in_the_picture_where_the_exact_lines_are() {
        for parallel in [false, true] {
            let mesh = ClosedForm::ellipsoid(1.0, 0.6, 1.4).mesh(2_000, 0.2).unwrap();
            let scene = scene(mesh, crate::camera::CameraSettings { parallel, ..camera(30.0, 15.0) });
            let silhouette = &smooth_silhouettes(&scene, smooth().crease_angle)[0];
            assert!(silhouette.edges.is_empty() && silhouette.edge_parts.is_empty());
            assert!(silhouette.pieces.len() > 80, "{}", silhouette.pieces.len());
            let mut ends: HashMap<[u64; 3], usize> = HashMap::new();
            for end in silhouette.pieces.as_flattened() {
                *ends.entry(end.to_array().map(f64::to_bits)).or_default() += 1;
            }
            assert_eq!(ends.values().filter(|count| **count != 2).count(), 0);
            let lines = found(&scene, &smooth());
            let drawn: Vec<[DVec2; 2]> = lines
                .segments
                .iter()
                .filter(|segment| segment.class == Class::Silhouette && segment.is_visible)
                .map(|segment| segment.ends_px)
                .collect();
            assert_eq!(drawn.len(), silhouette.pieces.len());
            for piece in &silhouette.pieces {
                let own = px(&scene, *piece);
                let is_same = |other: &[DVec2; 2]| {
                    let distance = |a: DVec2, b: DVec2| a.distance(b);
                    distance(own[0], other[0]).max(distance(own[1], other[1])) < 1e-6
                        || distance(own[0], other[1]).max(distance(own[1], other[0])) < 1e-6
                };
                assert!(drawn.iter().any(is_same), "{own:?}");
            }
        }
    }

    #[test]
    fn no_face_beside_a_contour_hides_it() {
        for (form, jitter) in [
            (ClosedForm::ellipsoid(1.0, 1.0, 1.0), 0.2),
            (ClosedForm::Torus { ring: 1.0, tube: 0.4 }, 0.0),
            (ClosedForm::Torus { ring: 1.0, tube: 0.4 }, 0.2),
        ] {
            let scene = scene(form.mesh(4_000, jitter).unwrap(), camera(30.0, 65.0));
            let space = Space::of(&scene);
            let faces = Faces::new(&space, &[(&scene.objects[0], scene.objects[0].mesh.clone())]);
            let hidden = |end: &DVec3| {
                let view = space.view(*end);
                let hit = first_hit(&space, &faces, None, space.project(view).0);
                hit.is_some_and(|hit| hit.depth < -view.z - 1e-5)
            };
            let silhouette = &smooth_silhouettes(&scene, smooth().crease_angle)[0];
            let ends = silhouette.pieces.as_flattened();
            let count = ends.iter().filter(|end| hidden(end)).count();
            assert_eq!(count, 0, "{form:?} {jitter}: of {} ends", ends.len());
            // Many points on the surface itself are hidden.
            let lines = found(&scene, &smooth());
            let unmoved: Vec<DVec3> = lines
                .segments
                .iter()
                .filter(|line| line.class == Class::Silhouette && line.is_visible)
                .flat_map(|line| line.ends_world)
                .collect();
            let share = unmoved.iter().filter(|end| hidden(end)).count() as f64 / unmoved.len() as f64;
            assert!(share > 0.15, "{form:?} {jitter}: {share} of {} ends", unmoved.len());
        }
    }

    #[test]
    fn of_flat_faces_whole_edges_are_silhouette_and_of_a_cylinder_half_its_rims() {
        let options = LoadOptions::default();
        let gear = load("../../models/gear.obj", &options).unwrap().mesh;
        let gear = scene(gear, camera(30.0, 15.0));
        let all_sharp = CreaseAngle::from_degrees(2.0).unwrap();
        let silhouette = &smooth_silhouettes(&gear, all_sharp)[0];
        let (edges, eye) = (gear.edges(&gear.objects[0]), gear.eye(&gear.objects[0], SilhouetteRule::Exact));
        assert_eq!(silhouette.edges, edges.silhouette(eye, SilhouetteRule::Exact));
        assert!(silhouette.edge_parts.is_empty() && silhouette.pieces.is_empty());
        let view = crate::camera::CameraSettings { parallel: true, ..camera(11.0, 30.0) };
        let rolled = scene(cylinder(48), view);
        let silhouette = &smooth_silhouettes(&rolled, smooth().crease_angle)[0];
        // Two straight contours along the side, and half of each rim: the half where exactly one of side and end
        // shows its front. Where a contour ends, a part of an edge may belong to it. All of it is visible.
        let edges = rolled.edges(&rolled.objects[0]).list();
        let shares: f64 = silhouette.edge_parts.iter().map(|(_, [from, to])| to - from).sum();
        assert!(shares > 46.0 && shares < 48.0 + 1e-9, "{shares}");
        assert!(silhouette.edges.is_empty() && (4..=6).contains(&silhouette.pieces.len()));
        let mesh = &rolled.objects[0].mesh;
        let of_edges = silhouette.edge_parts.iter().map(|(edge, part)| {
            let [low, high] = edges.positions()[*edge as usize].map(|position| mesh.positions[position as usize]);
            part.map(|share| between(low, high, share))
        });
        let all = of_edges.chain(silhouette.pieces.iter().copied()).map(|piece| px(&rolled, piece));
        let length: f64 = all.map(|[a, b]| a.distance(b)).sum();
        let lines = found(&rolled, &smooth());
        let exact = lines.segments.iter().filter(|line| line.class == Class::Silhouette && line.is_visible);
        let exact: f64 = exact.map(|line| line.ends_px[0].distance(line.ends_px[1])).sum();
        assert!((length - exact).abs() < 1e-6, "{length} {exact}");
    }
}
