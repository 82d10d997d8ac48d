//! The error of a picture's tones against those of rays cast in f64.
//!
//! The shaders compute light at the vertices and interpolate; so does this, in f64, with the corners' weights of the point
//! that a ray through the pixel's middle meets.

use super::ToneError;
use super::reference::Reference;
use crate::lines::{Hit, first_hits};
use crate::picture::Picture;
use crate::scene::Scene;
use crate::styles::Tones;
use glam::{DMat3, DVec2, DVec3};

/// Pixels nearer to a visible line than this are counted apart: there one renderer's pixel may lie on another surface.
const RIM_PX: f64 = 1.0;

/// Where the papers' light stands, eye space, scene radii.
const LIGHT: DVec3 = DVec3::ONE;

/// Differences up to this come from rounding a colour twice, of 255.
const ROUNDING: f64 = 1.5;

/// The light on what is seen at each pixel: diffuse and specular, in [0, 1].
pub struct ReferenceLight {
    /// Row by row from the top.
    hits: Vec<Option<Hit>>,
    light: Vec<[f64; 2]>,
    /// The surfaces' colours, of 255.
    colors: Vec<[f64; 3]>,
}

impl ReferenceLight {
    /// Casts a ray through every pixel.
    pub fn of(scene: &Scene) -> Self {
        let hits = first_hits(scene);
        let view = scene.camera.view_from_world();
        let rotation = DMat3::from_mat4(view);
        let light = |hit: &Hit| {
            let object = &scene.objects[hit.object as usize];
            let (mesh, face) = (&object.mesh, hit.face as usize);
            let (mut diffuse, mut reflected, mut to_eye) = (0.0, DVec3::ZERO, DVec3::ZERO);
            for corner in 0..3 {
                let position = mesh.positions[mesh.triangles[face][corner] as usize] + object.offset;
                let point = rotation * (position - scene.camera.eye) / scene.radius;
                let normal = rotation * mesh.normals[mesh.triangle_normals[face][corner] as usize].as_dvec3();
                let normal = normal.normalize_or_zero();
                let towards_light = (LIGHT - point).normalize_or_zero();
                let weight = hit.weights[corner];
                diffuse += weight * ((towards_light.dot(normal) + 1.0) * 0.5).max(0.0);
                reflected += weight * (2.0 * towards_light.dot(normal) * normal - towards_light).normalize_or_zero();
                to_eye += weight * (-point).normalize_or_zero();
            }
            [diffuse, reflected.normalize_or_zero().dot(to_eye.normalize_or_zero()).max(0.0)]
        };
        let color = |hit: &Hit| {
            let mesh = &scene.objects[hit.object as usize].mesh;
            let material = mesh.triangle_materials.get(hit.face as usize).copied().unwrap_or(crate::mesh::NONE);
            scene.material_color(mesh, material).0.map(|channel| f64::from(channel) * 255.0)
        };
        Self {
            light: hits.iter().map(|hit| hit.as_ref().map_or([0.0; 2], light)).collect(),
            colors: hits.iter().map(|hit| hit.as_ref().map_or([0.0; 3], color)).collect(),
            hits,
        }
    }

    /// The error of a picture of tones without lines.
    pub fn error(&self, picture: &Picture, tones: &Tones, reference: &Reference) -> ToneError {
        let width = picture.size.width as usize;
        // Inner pixels first, then those at the rim: how many, how many differ.
        let mut counts = [[0usize; 2]; 2];
        let (mut sum, mut largest) = (0.0, 0.0f64);
        for (index, pixel) in
            picture.pixels.chunks_exact(4).enumerate().filter(|(index, _)| self.hits[*index].is_some())
        {
            let middle = DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            let is_rim = reference.distance_px(middle) <= RIM_PX;
            let [diffuse, specular] = self.light[index];
            let tone = f64::from(tones.tone(diffuse as f32, specular as f32));
            let difference = (0..3)
                .map(|channel| (self.colors[index][channel] * tone - f64::from(pixel[channel])).abs())
                .fold(0.0, f64::max);
            let [count, differing] = &mut counts[usize::from(is_rim)];
            *count += 1;
            *differing += usize::from(difference > ROUNDING);
            if !is_rim {
                sum += difference;
                largest = largest.max(difference);
            }
        }
        let [inner, rim] = counts;
        let share = |[count, differing]: [usize; 2]| if count > 0 { differing as f64 / count as f64 } else { 0.0 };
        ToneError {
            inner_px: inner[0],
            inner_differing: Some(share(inner)),
            rim_px: rim[0],
            rim_differing: Some(share(rim)),
            mean_difference: if inner[0] > 0 { sum / inner[0] as f64 } else { 0.0 },
            largest_difference: largest,
        }
    }
}
