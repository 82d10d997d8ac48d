//! The error of a picture's shading against that of rays cast in f64.
//!
//! Values that the shaders compute at the vertices and interpolate are computed at the corners here too, in f64, and weighted by
//! the place in the triangle where a ray through the pixel's middle hits.

use super::ToneError;
use super::reference::Reference;
use super::shading::{Shading, Surface};
use super::tone_borders::ToneBorders;
use glam::{DMat3, DVec2, DVec3};
use std::sync::{Arc, Mutex, PoisonError};
use tinta::error::Result;
use tinta::lines::{Hit, ToneRule, first_hits};
use tinta::mesh::NONE;
use tinta::picture::Picture;
use tinta::scene::Scene;
use tinta::styles::Style;

/// Pixels nearer to a visible line than this are counted apart: there one renderer's pixel may lie on another surface.
const RIM_PX: f64 = 1.0;

/// The place of the articles' light, eye space, scene radii.
const LIGHT: DVec3 = DVec3::ONE;

/// Differences up to this come from rounding a colour twice, of 255.
const ROUNDING: f64 = 1.5;

/// The visible surface at each pixel.
#[derive(Debug)]
pub struct ReferenceLight {
    /// Row by row from the top.
    surfaces: Vec<Option<Surface>>,
    /// The exact borders of tones by rules already asked for: most settings of a style share theirs.
    borders: Mutex<Vec<(ToneRule, Arc<ToneBorders>)>>,
}

impl ReferenceLight {
    /// Casts a ray through every pixel.
    pub fn of(scene: &Scene) -> Self {
        let rotation = DMat3::from_mat4(scene.camera.view_from_world());
        let (width, height) = (scene.size.width as usize, scene.size.height as usize);
        let surface = |(index, hit): (usize, Option<Hit>)| {
            let mut surface = surface(scene, &rotation, &hit?);
            let (x, y) = ((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            surface.place = DVec2::new(x / width as f64, 1.0 - y / height as f64);
            Some(surface)
        };
        let surfaces = first_hits(scene).into_iter().enumerate().map(surface).collect();
        Self { surfaces, borders: Mutex::default() }
    }

    /// The exact borders of a style's tones; `None` for a style without.
    fn borders(&self, style: &Style, scene: &Scene) -> Result<Option<Arc<ToneBorders>>> {
        let Some(rule) = style.vectors(scene.size).and_then(|contents| contents.rule(scene)) else { return Ok(None) };
        let mut known = self.borders.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, borders)) = known.iter().find(|(of, _)| *of == rule) {
            return Ok(Some(Arc::clone(borders)));
        }
        let borders = Arc::new(ToneBorders::of(&rule, scene)?);
        known.push((rule, Arc::clone(&borders)));
        Ok(Some(borders))
    }

    /// A style's shading by these rays on white, as GL would draw it without error; `None` for one that is not computed here.
    ///
    /// # Errors
    ///
    /// The style's own errors if its textures cannot be made.
    pub fn picture(&self, style: &Style, scene: &Scene) -> Result<Option<Picture>> {
        let Some(shading) = Shading::of(style, scene)? else { return Ok(None) };
        let pixel = |surface: &Option<Surface>| match surface {
            None => [u8::MAX; 4],
            Some(surface) => {
                let [red, green, blue] =
                    (shading.color(surface) * 255.0).round().to_array().map(|channel| channel as u8);
                [red, green, blue, u8::MAX]
            }
        };
        Ok(Some(Picture { size: scene.size, pixels: self.surfaces.iter().flat_map(pixel).collect() }))
    }

    /// The error of a style's picture without lines; `None` for a style whose shading is not computed here.
    ///
    /// # Errors
    ///
    /// The style's own errors if its textures cannot be made.
    pub fn error(
        &self,
        picture: &Picture,
        style: &Style,
        scene: &Scene,
        reference: &Reference,
    ) -> Result<Option<ToneError>> {
        let Some(shading) = Shading::of(style, scene)? else { return Ok(None) };
        let width = picture.size.width as usize;
        // Inner pixels first, then those at the rim: how many, how many differ.
        let mut counts = [[0usize; 2]; 2];
        let (mut sum, mut largest) = (0.0, 0.0f64);
        for (index, pixel) in picture.pixels.chunks_exact(4).enumerate() {
            let Some(surface) = &self.surfaces[index] else { continue };
            let middle = DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            let is_rim = reference.distance_px(middle) <= RIM_PX;
            let drawn = DVec3::new(f64::from(pixel[0]), f64::from(pixel[1]), f64::from(pixel[2]));
            let difference = (shading.color(surface) * 255.0 - drawn).abs().max_element();
            let [count, differing] = &mut counts[usize::from(is_rim)];
            *count += 1;
            *differing += usize::from(difference > ROUNDING);
            if !is_rim {
                sum += difference;
                largest = largest.max(difference);
            }
        }
        let [inner, rim] = counts;
        let borders = match &shading {
            Shading::Tones(tones) => {
                let colors: Vec<Option<[f64; 3]>> =
                    self.surfaces.iter().map(|surface| surface.map(|surface| surface.color.to_array())).collect();
                let exact = self.borders(style, scene)?;
                exact.and_then(|exact| exact.error(picture, tones, &colors, (reference, RIM_PX)))
            }
            _ => None,
        };
        let share = |[count, differing]: [usize; 2]| {
            let share = if count > 0 { differing as f64 / count as f64 } else { 0.0 };
            shading.is_of_tones().then_some(share)
        };
        Ok(Some(ToneError {
            inner_px: inner[0],
            inner_differing: share(inner),
            rim_px: rim[0],
            rim_differing: share(rim),
            mean_difference: if inner[0] > 0 { sum / inner[0] as f64 } else { 0.0 },
            largest_difference: largest,
            borders,
        }))
    }
}

/// The surface at a hit; its place in the picture is left open.
fn surface(scene: &Scene, rotation: &DMat3, hit: &Hit) -> Surface {
    let object = &scene.objects[hit.object as usize];
    let (mesh, face) = (&object.mesh, hit.face as usize);
    let (mut diffuse, mut reflected, mut to_eye) = (0.0, DVec3::ZERO, DVec3::ZERO);
    let (mut middle, mut middle_normal) = (DVec3::ZERO, DVec3::ZERO);
    for corner in 0..3 {
        let position = mesh.positions[mesh.triangles[face][corner] as usize] + object.offset;
        let point = *rotation * (position - scene.camera.eye) / scene.radius;
        let normal = *rotation * mesh.normals[mesh.triangle_normals[face][corner] as usize].as_dvec3();
        let normal = normal.normalize_or_zero();
        let towards_light = (LIGHT - point).normalize_or_zero();
        let weight = hit.weights[corner];
        diffuse += weight * ((towards_light.dot(normal) + 1.0) * 0.5).max(0.0);
        reflected += weight * (2.0 * towards_light.dot(normal) * normal - towards_light).normalize_or_zero();
        to_eye += weight * (-point).normalize_or_zero();
        middle += weight * point;
        middle_normal += weight * normal;
    }
    let specular = reflected.normalize_or_zero().dot(to_eye.normalize_or_zero()).max(0.0);
    let material = mesh.triangle_materials.get(face).copied().unwrap_or(NONE);
    let texture = mesh.triangle_texture_coordinates.get(face).map(|corners| {
        let coordinate = |corner: usize| {
            let own = mesh.texture_coordinates.get(corners[corner] as usize).copied().unwrap_or_default();
            own.as_dvec2() * hit.weights[corner]
        };
        (coordinate(0) + coordinate(1) + coordinate(2), hit.object as usize, material as usize)
    });
    let color = scene.material_color(mesh, material).0.map(f64::from);
    Surface {
        point: middle,
        normal: middle_normal,
        light: [diffuse, specular],
        color: DVec3::from_array(color),
        texture,
        place: DVec2::ZERO,
    }
}
