//! A small picture of what a view shows, for shares of what is seen: each pixel has the face that is nearest to the eye and its
//! normal, on the side that is seen.
//!
//! In: a scene. Out: samples, as exact as a share of a picture must be. Faces that reach through the near plane are left out.

use crate::lines::eye::space::Space;
use crate::scene::Scene;
use glam::{DVec2, DVec3, Vec3};

/// The longest side of the picture, pixels.
const LONGEST: f64 = 320.0;

/// What a pixel shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// The object and its face.
    pub object: u32,
    pub face: u32,
    /// The weights of the face's corners.
    pub weights: [f32; 3],
    /// The normal in the eye's space, as the corners' are interpolated.
    pub normal: Vec3,
}

/// The picture.
pub(super) struct SeenNormals {
    pub width: usize,
    /// Row by row.
    pub samples: Vec<Option<Sample>>,
}

/// The corner of a face: its place in the small picture, its key, and its normal.
#[derive(Clone, Copy)]
struct Corner {
    px: DVec2,
    key: f64,
    normal: Vec3,
}

impl SeenNormals {
    pub(super) fn of(scene: &Scene) -> Self {
        let space = Space::of(scene);
        let scale = Self::scale(&space);
        let [width, height] = (space.size * scale).ceil().max(DVec2::ONE).to_array().map(|side| side as usize);
        let mut seen = Self { width, samples: vec![None; width * height] };
        let mut keys = vec![f64::INFINITY; width * height];
        for (number, object) in (0..).zip(&scene.objects) {
            let mesh = &object.mesh;
            let view = |position: &DVec3| space.view(*position + object.offset);
            let points: Vec<DVec3> = mesh.positions.iter().map(view).collect();
            for (face, (triangle, normals)) in (0..).zip(mesh.triangles.iter().zip(&mesh.triangle_normals)) {
                let at = triangle.map(|position| points[position as usize]);
                if at.iter().any(|point| -point.z <= space.near) {
                    continue;
                }
                let corners = [0, 1, 2].map(|corner| {
                    let (px, key) = space.project(at[corner]);
                    Corner { px: px * scale, key, normal: mesh.normals[normals[corner] as usize] }
                });
                seen.draw(&mut keys, [number, face], corners, &space);
            }
        }
        seen
    }

    /// How large this picture is beside the scene's.
    pub(super) fn scale(space: &Space) -> f64 {
        (LONGEST / space.size.max_element()).min(1.0)
    }

    /// Draws a face where it is nearer than what is there.
    fn draw(&mut self, keys: &mut [f64], [object, face]: [u32; 2], [a, b, c]: [Corner; 3], space: &Space) {
        let double_area = (b.px - a.px).perp_dot(c.px - a.px);
        let size = DVec2::new(self.width as f64, (self.samples.len() / self.width) as f64);
        let low = (a.px.min(b.px).min(c.px) - 0.5).ceil().max(DVec2::ZERO);
        let high = (a.px.max(b.px).max(c.px) - 0.5).floor().min(size - 1.0);
        // Most faces of a fine mesh have no pixel's middle in them.
        if double_area == 0.0 || high.x < low.x || high.y < low.y {
            return;
        }
        // The picture's y points down.
        let side = if double_area < 0.0 { 1.0 } else { -1.0 };
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |from: Corner, to: Corner| (to.px - from.px).perp_dot(middle - from.px) / double_area;
                let weights = [share(b, c), share(c, a), share(a, b)];
                let key = a.key * weights[0] + b.key * weights[1] + c.key * weights[2];
                let pixel = y * self.width + x;
                if weights.iter().any(|weight| *weight < 0.0) || key >= keys[pixel] {
                    continue;
                }
                keys[pixel] = key;
                let normal = a.normal * weights[0] as f32 + b.normal * weights[1] as f32 + c.normal * weights[2] as f32;
                let normal = space.direction(normal.as_dvec3()).as_vec3() * side;
                self.samples[pixel] =
                    Some(Sample { object, face, weights: weights.map(|weight| weight as f32), normal });
            }
        }
    }
}
