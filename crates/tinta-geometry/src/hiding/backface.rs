//! Back faces: those that GL's own culling discards, found before their vertices are computed with.
//!
//! GL decides by the sign of a face's area in window coordinates, whose vertices it has placed on sub-pixels. A face is left
//! out where that sign is certain.

use super::selection::select;
use super::{DrawnFaces, ObjectView};
use crate::threads::{filled, threads_for};
use crate::tolerances::{CLIP_ROUNDING, SUBPIXEL_STEPS};
use crate::values::Size;
use glam::{Vec2, Vec3};

/// The faces of an object that are not surely culled, on a surface of so many pixels, by a GL that places vertices to
/// 2^-`subpixel_bits` of a pixel; `None` where all of them are drawn.
pub fn faces_not_culled(seen: &ObjectView<'_>, surface: Size, subpixel_bits: u32) -> Option<DrawnFaces> {
    let arrays = seen.arrays;
    let half = Vec2::new(surface.width as f32, surface.height as f32) * 0.5;
    let places = window_places(seen, surface, true);
    // How far GL may have moved a vertex: its sub-pixels, and what f32 makes of a coordinate.
    let moved =
        SUBPIXEL_STEPS as f32 * 0.5f32.powi(subpixel_bits.min(24) as i32) + CLIP_ROUNDING as f32 * half.max_element();
    let drawn = select(arrays, |_, corners| {
        let [a, b, c] = [0, 1, 2].map(|corner| places[corners[corner] as usize]);
        // Beyond a picture's width outside drivers cut faces off at places of their own choice.
        let farthest =
            [a, b, c].map(|place| ((place - half) / half).abs().max_element()).into_iter().fold(0.0, f32::max);
        let (first, second) = (b - a, c - a);
        let most = moved * (first.abs().element_sum() + second.abs().element_sum()) + 4.0 * moved * moved;
        // Written so that a face with a vertex without a place is drawn.
        let is_culled = first.perp_dot(second) < -2.0 * most && farthest < 2.0;
        !is_culled
    });
    (drawn.left_out > 0).then_some(drawn)
}

/// Where an object's vertices lie in the window, pixels; no numbers for one behind the eye, and if asked for none for one that
/// the near or far plane may cut off.
pub(super) fn window_places(seen: &ObjectView<'_>, surface: Size, only_between_planes: bool) -> Vec<Vec2> {
    let arrays = seen.arrays;
    let half = Vec2::new(surface.width as f32, surface.height as f32) * 0.5;
    let threads = threads_for(arrays.vertices.len());
    filled(arrays.vertices.len(), threads, Vec2::ZERO, |vertex| {
        let [x, y, z, ..] = arrays.vertices[vertex];
        let clip = seen.clip_from_object * Vec3::new(x, y, z).extend(1.0);
        let is_between = !only_between_planes || clip.z > -clip.w && clip.z < clip.w;
        if clip.w > 0.0 && is_between { Vec2::new(clip.x, clip.y) / clip.w * half + half } else { Vec2::NAN }
    })
}
