//! Centre lines: the axes of round surfaces as a draughtsman draws them, over all other lines.
//!
//! In: a [`LineInput`] and its decided lines. Out: a line along each axis, or a cross where it is seen end-on. It counts as visible
//! where any visible line touches its surface.

use crate::edges::{Axis, Class};
use crate::lines::eye::image::Image;
use crate::lines::eye::space::Space;
use crate::lines::input::line_input::LineInput;
use crate::lines::segment::LineSegment;
use glam::DVec3;
use std::collections::HashSet;

/// How far a line goes beyond its surface, as a share of the scene's radius; at most the surface's own radius.
const BEYOND: f64 = 0.02;

/// Adds the centre lines of all parts that have them.
pub(in crate::lines) fn add_centre_lines(input: &LineInput<'_>, segments: &mut Vec<LineSegment>) {
    let LineInput { scene, settings, scene_parts, space, objects, .. } = input;
    if !settings.classes.contains(Class::Centre) {
        return;
    }
    let seen = segments.iter().filter(|segment| segment.is_visible);
    let seen = seen.flat_map(|segment| segment.edge.into_iter().flatten().map(|end| (segment.object, end)));
    let seen: HashSet<(u32, u32)> = seen.collect();
    for (number, object) in objects.iter().enumerate() {
        let edges = scene.edges(object.object);
        let mesh = edges.mesh();
        for axis in edges.axes() {
            let part = scene_parts.of_face(number, mesh, axis.faces[0]);
            if !scene_parts.classes(part).contains(Class::Centre) {
                continue;
            }
            let corners = axis.faces.iter().flat_map(|face| mesh.triangles[*face as usize]);
            let is_visible = corners
                .map(|corner| (number as u32, mesh.file_vertices[corner as usize]))
                .any(|end| seen.contains(&end));
            let image = |ends: [DVec3; 2]| Image::of(space, ends.map(|end| space.view(end + object.object.offset)));
            for image in strokes(axis, (space, scene.radius), image) {
                let Some(inside) = image.inside(space.size, 0.0) else { continue };
                let ends_px = inside.map(|place| image.at(place));
                let segment = LineSegment::new(Class::Centre, ends_px, image.ends_world(space, inside));
                segments.push(LineSegment { is_visible, object: number as u32, part, ..segment });
            }
        }
    }
}

/// The line along an axis, or a cross where that is shorter than both of the cross's. A cross lies as the world's axes do, which are those of
/// most parts, and a sphere's as the picture's.
fn strokes(axis: &Axis, (space, size): (&Space, f64), image: impl Fn([DVec3; 2]) -> Option<Image>) -> Vec<Image> {
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
    let length = |image: &Option<Image>| image.map_or(0.0, |image| image.length());
    let is_end_on = length(&along) < cross.iter().map(length).fold(f64::INFINITY, f64::min);
    if is_end_on { cross.into_iter().flatten().collect() } else { along.into_iter().collect() }
}
