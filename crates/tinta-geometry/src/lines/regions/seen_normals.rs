//! A small picture of a view, for shares of the visible surface: each pixel has the face nearest to the eye and its normal, on the
//! visible side.
//!
//! In: a scene. Out: samples, as exact as a share of a picture must be. Faces that reach through the near plane are left out.

use crate::lines::eye::space::Space;
use crate::scene::{Object, Scene};
use crate::threads::{filled, in_parallel, threads_for, threads_for_items};
use glam::{DVec2, Vec3};

/// The longest side of the picture, pixels.
const LONGEST: f64 = 256.0;

/// The surface at a pixel.
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
#[derive(Debug, Clone)]
pub struct SeenNormals {
    pub(super) width: usize,
    /// Each pixel's distance from the eye, as its key; row by row.
    keys: Vec<f64>,
    /// Row by row.
    pub(super) samples: Vec<Option<Sample>>,
}

/// The corner of a face: its place in the small picture, NaN before the near plane; its key, and its normal.
#[derive(Clone, Copy)]
struct Corner {
    px: DVec2,
    key: f64,
    normal: Vec3,
}

impl SeenNormals {
    /// Draws a scene.
    pub fn of(scene: &Scene) -> Self {
        let space = Space::of(scene);
        let size = (space.size * scale(&space)).ceil().max(DVec2::ONE);
        let [width, height] = size.to_array().map(|side| side as usize);
        let mut seen = Self { width, keys: vec![f64::INFINITY; width * height], samples: vec![None; width * height] };
        for (number, object) in (0..).zip(&scene.objects) {
            let mesh = &object.mesh;
            let places = places(object, &space);
            let drawn = |faces: std::ops::Range<usize>| {
                let mut drawn = Self { width, keys: seen.keys.clone(), samples: vec![None; width * height] };
                for face in faces {
                    let (triangle, normals) = (mesh.triangles[face], mesh.triangle_normals[face]);
                    let corners = [0, 1, 2].map(|corner| {
                        let (px, key) = places[triangle[corner] as usize];
                        Corner { px, key, normal: mesh.normals[normals[corner] as usize] }
                    });
                    drawn.draw([number, face as u32], corners, &space);
                }
                drawn
            };
            let threads = threads_for(mesh.triangles.len());
            for drawn in in_parallel(mesh.triangles.len(), threads, drawn) {
                for (pixel, (key, sample)) in drawn.keys.into_iter().zip(drawn.samples).enumerate() {
                    if key < seen.keys[pixel] {
                        (seen.keys[pixel], seen.samples[pixel]) = (key, sample);
                    }
                }
            }
        }
        seen
    }

    /// Draws a face wherever no nearer one is.
    fn draw(&mut self, [object, face]: [u32; 2], [a, b, c]: [Corner; 3], space: &Space) {
        let double_area = (b.px - a.px).perp_dot(c.px - a.px);
        let size = DVec2::new(self.width as f64, (self.samples.len() / self.width) as f64);
        let low = (a.px.min(b.px).min(c.px) - 0.5).ceil().max(DVec2::ZERO);
        let high = (a.px.max(b.px).max(c.px) - 0.5).floor().min(size - 1.0);
        // Most faces of a fine mesh have no pixel's middle in them.
        if double_area.is_nan() || double_area == 0.0 || high.x < low.x || high.y < low.y {
            return;
        }
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |from: Corner, to: Corner| (to.px - from.px).perp_dot(middle - from.px) / double_area;
                let weights = [share(b, c), share(c, a), share(a, b)];
                let key = a.key * weights[0] + b.key * weights[1] + c.key * weights[2];
                let pixel = y * self.width + x;
                if weights.iter().any(|weight| *weight < 0.0) || key >= self.keys[pixel] {
                    continue;
                }
                self.keys[pixel] = key;
                let weights = weights.map(|weight| weight as f32);
                let normal = a.normal * weights[0] + b.normal * weights[1] + c.normal * weights[2];
                let normal =
                    space.direction(normal.as_dvec3()).as_vec3() * if is_back(double_area) { -1.0 } else { 1.0 };
                self.samples[pixel] = Some(Sample { object, face, weights, normal });
            }
        }
    }
}

/// The places of an object's positions in the small picture, and their keys; NaN before the near plane.
pub(super) fn places(object: &Object, space: &Space) -> Vec<(DVec2, f64)> {
    let positions = &object.mesh.positions;
    let scale = scale(space);
    filled(positions.len(), threads_for_items(positions.len()), (DVec2::ZERO, 0.0), |position| {
        let point = space.view(positions[position] + object.offset);
        if -point.z <= space.near {
            return (DVec2::NAN, f64::NAN);
        }
        let (px, key) = space.project(point);
        (px * scale, key)
    })
}

/// Whether a face is seen from behind, by twice its area in the picture, whose y points down.
pub(super) fn is_back(double_area: f64) -> bool {
    double_area > 0.0
}

/// How large the small picture is beside the scene's.
fn scale(space: &Space) -> f64 {
    (LONGEST / space.size.max_element()).min(1.0)
}
