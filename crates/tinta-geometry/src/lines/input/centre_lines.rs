//! Centre lines: the axes of round surfaces as a draughtsman draws them, over all other lines.
//!
//! In: a [`LineInput`] and its decided lines. Out: a line along each axis, or a cross where it is seen end-on. It counts as visible
//! where a visible line touches its surface, or the middle of a face of it is seen; and where no other line is drawn.

use crate::edges::{Axis, Class};
use crate::lines::eye::cast::nearest_hits;
use crate::lines::eye::image::Image;
use crate::lines::eye::space::Space;
use crate::lines::input::line_input::LineInput;
use crate::lines::segment::LineSegment;
use glam::DVec3;
use std::collections::HashSet;

/// How far a line goes beyond its surface, as a share of the scene's radius; at most the surface's own radius.
const BEYOND: f64 = 0.02;

/// How much nearer than its own face another one must be to hide it, as a share of the radius.
const SAME: f64 = 1e-6;

/// Sine of the largest angle between an axis and the line of sight at which it is seen end-on: 10 degrees.
const END_ON: f64 = 0.174;

/// Adds the centre lines of all parts that have them.
pub(in crate::lines) fn add_centre_lines(input: &LineInput<'_>, segments: &mut Vec<LineSegment>) {
    let LineInput { scene, settings, scene_parts, space, objects, faces, .. } = input;
    if !settings.classes.contains(Class::Centre) {
        return;
    }
    let seen = segments.iter().filter(|segment| segment.is_visible);
    let seen = seen.flat_map(|segment| segment.edge.into_iter().flatten().map(|end| (segment.object, end)));
    let (seen, is_alone) = (seen.collect::<HashSet<(u32, u32)>>(), segments.is_empty());
    for (number, object) in objects.iter().enumerate() {
        let edges = scene.edges(object.object);
        let mesh = edges.mesh();
        for axis in edges.axes() {
            let parts = axis.faces.iter().map(|face| scene_parts.of_face(number, mesh, *face));
            let Some(part) = parts.into_iter().find(|part| scene_parts.classes(*part).contains(Class::Centre)) else {
                continue;
            };
            let world = |point: DVec3| point + object.object.offset;
            let is_seen = |face: &u32| {
                let corners = mesh.triangles[*face as usize];
                if corners.iter().any(|corner| seen.contains(&(number as u32, mesh.file_vertices[*corner as usize]))) {
                    return true;
                }
                let corners = corners.map(|corner| mesh.positions[corner as usize]);
                let middle = space.view(world(corners.iter().sum::<DVec3>() / 3.0));
                let (px, _) = space.project(middle);
                let nearest =
                    nearest_hits(space, faces, None, px).into_iter().map(|hit| hit.depth).fold(f64::INFINITY, f64::min);
                -middle.z <= nearest + space.noise + SAME * axis.radius
            };
            let is_visible = is_alone || axis.faces.iter().any(is_seen);
            let middle = world(axis.ends[0].midpoint(axis.ends[1]));
            let sight = if space.is_perspective() { middle - scene.camera.eye } else { scene.camera.backward() };
            let image = |ends: [DVec3; 2]| Image::of(space, ends.map(|end| space.view(world(end))));
            for image in strokes(axis, (space, scene.radius), sight, image) {
                let Some(inside) = image.inside(space.size, 0.0) else { continue };
                let ends_px = inside.map(|place| image.at(place));
                let segment = LineSegment::new(Class::Centre, ends_px, image.ends_world(space, inside));
                segments.push(LineSegment { is_visible, object: number as u32, part, ..segment });
            }
        }
    }
}

/// The line along an axis, or a cross where it is seen end-on. A cross lies as the world's axes do, which are those of
/// most parts, and a sphere's as the picture's.
fn strokes(
    axis: &Axis,
    (space, size): (&Space, f64),
    sight: DVec3,
    image: impl Fn([DVec3; 2]) -> Option<Image>,
) -> Vec<Image> {
    let Axis { ends, direction, radius, .. } = axis;
    let line = |[from, to]: [DVec3; 2], along: DVec3| {
        let beyond = along * radius.min(BEYOND * size);
        image([from - beyond, to + beyond])
    };
    let arms = match *direction == DVec3::ZERO {
        true => [DVec3::X, DVec3::Y].map(|axis| space.world_direction(axis)),
        false => {
            let across = |axis: &DVec3| -axis.dot(*direction).abs();
            let least = DVec3::AXES.into_iter().max_by(|a, b| across(a).total_cmp(&across(b))).unwrap_or(DVec3::X);
            let first = least.reject_from_normalized(*direction).normalize_or_zero();
            [first, direction.cross(first)]
        }
    };
    let middle = ends[0].midpoint(ends[1]);
    let cross = arms.map(|arm| line([middle - arm * radius, middle + arm * radius], arm));
    let along = line(*ends, *direction);
    let is_end_on = *direction == DVec3::ZERO || sight.cross(*direction).length() <= END_ON * sight.length();
    if is_end_on { cross.into_iter().flatten().collect() } else { along.into_iter().collect() }
}
