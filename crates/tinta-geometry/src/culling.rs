//! The faces that GL's own culling discards, found before GL computes their vertices.
//!
//! In: an object's arrays and a view's projection. Out: the arrays' indices without those faces. GL decides by the sign of a
//! face's area in window coordinates, after moving the vertices to sub-pixels. A face is left out only if that sign is certain,
//! so the picture stays the same byte for byte.
//!
//! ```
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, culling::faces_not_culled, load};
//!
//! let mesh = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([mesh], &SceneSettings::default())?;
//! let arrays = scene.arrays(&scene.objects[0]);
//! let clip_from_object = scene.clip_from_view() * scene.view_from_object(&scene.objects[0], arrays.centre);
//! let drawn = faces_not_culled(arrays, clip_from_object, scene.size, 8).unwrap();
//! assert_eq!(drawn.indices.len() + drawn.left_out * 3, arrays.indices.len());
//! # Ok::<(), tinta_geometry::Error>(())
//! ```

use crate::mesh::{Part, VertexArrays};
use crate::threads::{filled, threads_for, threads_for_items};
use crate::tolerances::{CLIP_ROUNDING, SUBPIXEL_STEPS};
use crate::values::Size;
use glam::{Mat4, Vec2, Vec3, Vec3Swizzles, Vec4Swizzles};

/// The faces that a view needs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DrawnFaces {
    /// The arrays' indices, in unchanged order, without the faces left out.
    pub indices: Vec<u32>,
    /// The runs of these that share a material.
    pub parts: Vec<Part>,
    /// Number of faces left out.
    pub left_out: usize,
}

/// Returns the faces of an object that may not be culled; `None` if all of them are drawn.
///
/// `clip_from_object` takes the arrays' coordinates to clip space, `surface` is the size drawn into, pixels (the picture's times
/// its supersampling), and GL places vertices to 2^-`subpixel_bits` of a pixel (GL_SUBPIXEL_BITS; 8 on Mesa, 4 at least).
pub fn faces_not_culled(
    arrays: &VertexArrays,
    clip_from_object: Mat4,
    surface: Size,
    subpixel_bits: u32,
) -> Option<DrawnFaces> {
    let half = Vec2::new(surface.width as f32, surface.height as f32) * 0.5;
    let places = window_places(arrays, clip_from_object, half);
    let moved = moved(subpixel_bits) + CLIP_ROUNDING as f32 * half.max_element();
    let count = arrays.indices.len() / 3;
    let is_culled = filled(count, threads_for(count), false, |face| {
        let [a, b, c] = [0, 1, 2].map(|corner| places[arrays.indices[face * 3 + corner] as usize].xy());
        // More than a picture's width outside, each driver cuts faces off at different places.
        let farthest =
            [a, b, c].map(|place| ((place - half) / half).abs().max_element()).into_iter().fold(0.0, f32::max);
        let (first, second) = (b - a, c - a);
        let most = moved * (first.abs().element_sum() + second.abs().element_sum()) + 4.0 * moved * moved;
        // False for a face with a vertex without a place.
        first.perp_dot(second) < -2.0 * most && farthest < 2.0
    });
    let left_out = is_culled.iter().filter(|is_culled| **is_culled).count();
    (left_out > 0).then(|| without(arrays, &is_culled, left_out))
}

/// How far GL may have moved a vertex to its sub-pixels, pixels.
pub(crate) fn moved(subpixel_bits: u32) -> f32 {
    SUBPIXEL_STEPS as f32 * 0.5f32.powi(subpixel_bits.min(24) as i32)
}

/// Returns the vertices' places in the window, pixels, and their depths from 0 to 1; NaN for a vertex that the near or far plane may
/// cut off.
pub(crate) fn window_places(arrays: &VertexArrays, clip_from_object: Mat4, half: Vec2) -> Vec<Vec3> {
    let threads = threads_for_items(arrays.vertices.len());
    filled(arrays.vertices.len(), threads, Vec3::ZERO, |vertex| {
        let [x, y, z, ..] = arrays.vertices[vertex];
        let clip = clip_from_object * Vec3::new(x, y, z).extend(1.0);
        let is_between = clip.w > 0.0 && clip.z > -clip.w && clip.z < clip.w;
        let place = clip.xyz() / clip.w;
        if is_between { (place.xy() * half + half).extend(place.z * 0.5 + 0.5) } else { Vec3::NAN }
    })
}

/// The arrays' faces in their order, without those marked.
pub(crate) fn without(arrays: &VertexArrays, is_culled: &[bool], left_out: usize) -> DrawnFaces {
    let mut indices = Vec::with_capacity(arrays.indices.len() - left_out * 3);
    let mut parts = Vec::with_capacity(arrays.parts.len());
    for part in &arrays.parts {
        let first = indices.len() as u32;
        let (begin, end) = (part.first as usize, (part.first + part.count) as usize);
        let faces = arrays.indices[begin..end].chunks_exact(3).zip(&is_culled[begin / 3..end / 3]);
        faces.filter(|(_, is_culled)| !**is_culled).for_each(|(corners, _)| indices.extend_from_slice(corners));
        let count = indices.len() as u32 - first;
        if count > 0 {
            parts.push(Part { first, count, ..*part });
        }
    }
    DrawnFaces { indices, parts, left_out }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, NONE, load};
    use crate::scene::{Scene, SceneSettings};

    fn drawn(model: &str, size: Size, subpixel_bits: u32) -> (VertexArrays, Option<DrawnFaces>) {
        let mesh = load(model, &LoadOptions::default()).unwrap().mesh;
        let scene = Scene::new([mesh], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
        let arrays = scene.arrays(&scene.objects[0]);
        let clip_from_object = scene.clip_from_view() * scene.view_from_object(&scene.objects[0], arrays.centre);
        (arrays.clone(), faces_not_culled(arrays, clip_from_object, size, subpixel_bits))
    }

    #[test]
    fn every_part_of_the_ant_keeps_its_material_and_its_order() {
        let (arrays, drawn) = drawn("../../models/ant.obj", Size { width: 160, height: 160 }, 8);
        let drawn = drawn.unwrap();
        assert!(drawn.left_out * 3 > arrays.indices.len() / 4, "{}", drawn.left_out);
        assert_eq!(drawn.indices.len() + drawn.left_out * 3, arrays.indices.len());
        let mut all = arrays.indices.chunks_exact(3);
        assert!(drawn.indices.chunks_exact(3).all(|corners| all.any(|one| one == corners)), "in the arrays' order");
        let mut materials = vec![NONE; arrays.vertices.len()];
        for part in &arrays.parts {
            for vertex in &arrays.indices[part.first as usize..][..part.count as usize] {
                materials[*vertex as usize] = part.material;
            }
        }
        let mut next = 0;
        for part in &drawn.parts {
            assert_eq!(part.first, next);
            next += part.count;
            let own = &drawn.indices[part.first as usize..][..part.count as usize];
            assert!(part.count > 0 && own.iter().all(|vertex| materials[*vertex as usize] == part.material));
        }
        assert_eq!(next as usize, drawn.indices.len());
    }

    #[test]
    fn the_coarser_the_pixels_the_fewer_faces_are_surely_culled() {
        let left_out = |side: u32, bits: u32| {
            let (_, drawn) = drawn("../../models/ant.obj", Size { width: side, height: side }, bits);
            drawn.map_or(0, |drawn| drawn.left_out)
        };
        assert!(left_out(512, 8) > left_out(64, 8) && left_out(64, 8) > left_out(64, 4));
        assert_eq!(left_out(1, 0), 0);
    }
}
