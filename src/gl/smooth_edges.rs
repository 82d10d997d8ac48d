//! Smoothed lines and points for drivers without them: squares whose pixels fade with their coverage.
//!
//! In: edges' ends in clip space. Out: corners at their places on the screen, each with the place of its line or point. The
//! shaders `glsl/fixed/smooth-*.frag` compute each pixel's coverage from that, as Mesa's own smoothing does, and so draw the same
//! picture.

use super::execute::Resources;
use super::fixed_function;
use super::legacy::{MODELVIEW, PROJECTION, QUADS};
use super::meshes::of_another_scene;
use super::objects::Buffer;
use super::quads::behind_near_plane;
use crate::error::Result;
use crate::plan::{EdgeRun, Mark, Value};
use crate::scene::{Scene, Size};
use glam::{Mat4, Vec2, Vec3, Vec4};
use std::collections::HashSet;

/// How far a square extends beyond the covered pixels, pixels. A driver places corners on a grid of a sixteenth at the coarsest.
const SPARE_PX: f32 = 0.5;

/// Corners, four per line or point.
#[derive(Debug, Default, PartialEq)]
struct Corners {
    /// In clip space, with w = 1: the values below are then constant over a square.
    places: Vec<[f32; 4]>,
    /// The start of the line or the middle of the point, pixels from the lower left, and its depth as clip space's w.
    firsts: Vec<[f32; 3]>,
    /// The end of the line.
    seconds: Vec<[f32; 3]>,
}

impl Corners {
    fn push(&mut self, corners: [(Vec2, f32); 4], ends: [Vec3; 2], half_size: Vec2) {
        for (place, depth) in corners {
            let place = place / half_size - 1.0;
            self.places.push([place.x, place.y, depth, 1.0]);
            self.firsts.push(ends[0].to_array());
            self.seconds.push(ends[1].to_array());
        }
    }
}

/// Returns a point's place, pixels from the lower left, and its depth.
fn on_screen(point: Vec4, half_size: Vec2) -> (Vec2, f32) {
    ((Vec2::new(point.x, point.y) / point.w + 1.0) * half_size, point.z / point.w)
}

fn half_size(size: Size) -> Vec2 {
    Vec2::new(size.width as f32, size.height as f32) * 0.5
}

/// Lines of this width, with the margin they fade over.
fn lines(ends: impl Iterator<Item = [Vec4; 2]>, size: Size, width_px: f32) -> Corners {
    let (half_size, mut corners) = (half_size(size), Corners::default());
    for [a, b] in ends.filter_map(behind_near_plane) {
        let (w_a, w_b) = (a.w, b.w);
        let ((a, depth_a), (b, depth_b)) = (on_screen(a, half_size), on_screen(b, half_size));
        let along = (b - a).try_normalize().unwrap_or(Vec2::X);
        let beyond = along * (0.5 + SPARE_PX);
        let side = along.perp() * (width_px.max(1.0) * 0.5 + 0.5 + SPARE_PX);
        // Mesa's lines keep their ends' depth half a pixel beyond them.
        let spare = (depth_b - depth_a) / (a.distance(b) + 1.0) * SPARE_PX;
        let (depth_a, depth_b) = (depth_a - spare, depth_b + spare);
        let four = [
            (a - beyond - side, depth_a),
            (b + beyond - side, depth_b),
            (b + beyond + side, depth_b),
            (a - beyond + side, depth_a),
        ];
        corners.push(four, [a.extend(w_a), b.extend(w_b)], half_size);
    }
    corners
}

/// Makes points of this size.
fn points(ends: impl Iterator<Item = Vec4>, size: Size, size_px: f32) -> Corners {
    let (half_size, mut corners) = (half_size(size), Corners::default());
    let reach = (size_px * 0.5).max(1.0) + SPARE_PX;
    for point in ends.filter(|point| point.w > 0.0 && point.z >= -point.w) {
        let (middle, depth) = on_screen(point, half_size);
        let corner = |x: f32, y: f32| (middle + Vec2::new(x, y) * reach, depth);
        let four = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        corners.push(four, [middle.extend(point.w); 2], half_size);
    }
    corners
}

impl Resources {
    /// Draws the equivalent of GL_LINE_SMOOTH and GL_POINT_SMOOTH with the bound program of [`fixed_function::smooth`].
    pub(super) fn draw_smooth_edges(
        &mut self,
        scene: &Scene,
        runs: &[EdgeRun],
        mark: Mark,
        width_px: f32,
    ) -> Result<()> {
        if let Some(program) = self.programs.get_mut(&fixed_function::smooth(mark)) {
            program.set("width".into(), Value::Float(width_px));
        }
        for run in runs {
            let object = scene.objects.get(run.object).ok_or_else(of_another_scene)?;
            let arrays = scene.arrays(object);
            let clip_from_object = scene.clip_from_view() * scene.view_from_object(object, arrays.centre);
            let in_clip_space = |vertex: u32| {
                let [x, y, z, ..] = *run.vertices(arrays).get(vertex as usize)?;
                Some(clip_from_object * Vec3::new(x, y, z).extend(1.0))
            };
            let corners = match mark {
                Mark::Lines => {
                    let ends = run.ends.iter().filter_map(|[a, b]| Some([in_clip_space(*a)?, in_clip_space(*b)?]));
                    lines(ends, self.tile.whole, width_px)
                }
                Mark::Points => {
                    let mut known = HashSet::new();
                    let once = run.ends.as_flattened().iter().filter(|end| known.insert(**end));
                    points(once.filter_map(|end| in_clip_space(*end)), self.tile.whole, width_px)
                }
            };
            self.draw_corners_of(corners, run.color)?;
        }
        Ok(())
    }

    fn draw_corners_of(&self, mut corners: Corners, color: [f32; 4]) -> Result<()> {
        // A fragment's place is counted from the tile's corner.
        let corner = [self.tile.drawn.x, self.tile.drawn.y].map(|number| number as f32);
        for end in corners.firsts.iter_mut().chain(&mut corners.seconds) {
            (end[0], end[1]) = (end[0] - corner[0], end[1] - corner[1]);
        }
        let upload = |bytes: &[u8]| Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytes);
        let places = upload(bytemuck::cast_slice(&corners.places))?;
        let firsts = upload(bytemuck::cast_slice(&corners.firsts))?;
        let seconds = upload(bytemuck::cast_slice(&corners.seconds))?;
        // SAFETY: the context is current; each bound buffer has an entry for every vertex that is drawn.
        unsafe {
            let legacy = &self.gl.legacy;
            legacy.load_matrix(PROJECTION, &self.in_tile(Mat4::IDENTITY));
            legacy.load_matrix(MODELVIEW, &Mat4::IDENTITY);
            legacy.color(color);
            places.bind();
            legacy.clip_position_array();
            firsts.bind();
            legacy.texture_coordinate_array(0, 3);
            seconds.bind();
            legacy.texture_coordinate_array(1, 3);
            legacy.draw_arrays(&self.gl.glow, QUADS, 0, corners.places.len() as i32);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
