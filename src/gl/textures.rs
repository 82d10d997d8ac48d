//! The textures of plans and materials on the device, kept while they are in use.

use super::Gl;
use super::legacy;
use super::objects::Texture;
use crate::error::{Error, Result};
use crate::picture::{MaterialPictures, Picture};
use crate::plan::{Plan, PlanTable, Sampling, Step};
use crate::scene::{Object, Scene, Size};
use glow::HasContext;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;
use std::sync::Arc;

/// The uploaded textures.
#[derive(Default)]
pub(super) struct Textures {
    /// The tables of the last plan that had any; its numbers index them.
    tables: Vec<(PlanTable, Texture)>,
    pictures: HashMap<Key, (Arc<Picture>, Texture)>,
    /// The keys of the plan's pictures.
    plan_pictures: Vec<Key>,
    white: Option<Texture>,
    materials: MaterialPictures,
}

/// A picture's place in memory, and how it is read.
type Key = (*const Picture, Sampling);

impl Textures {
    /// Uploads the missing textures that this plan reads, and releases the others.
    pub(super) fn prepare(&mut self, gl: &Rc<Gl>, scene: &Scene, plan: &Plan) -> Result<()> {
        if !plan.tables.is_empty() && !self.tables.iter().map(|(table, _)| table).eq(&plan.tables) {
            self.tables.clear();
            for table in &plan.tables {
                self.tables.push((table.clone(), upload_table(gl, table)?));
            }
        }
        let mut wanted: Vec<(Arc<Picture>, Sampling)> =
            plan.pictures.iter().map(|picture| (picture.picture.clone(), picture.sampling)).collect();
        let of_materials = plan.steps().find_map(|(_, step)| match step {
            Step::Draw(draw) => draw.material_unit(),
            _ => None,
        });
        if let Some((_, is_averaged)) = of_materials {
            if self.white.is_none() {
                let size = Size { width: 1, height: 1 };
                self.white = Some(upload(gl, &Picture { size, pixels: vec![u8::MAX; 4] }, Sampling::NearestClamped)?);
            }
            self.materials.prepare(scene, is_averaged.then(|| scene.size.times(plan.supersample)))?;
            for object in &scene.objects {
                let materials = 0..object.mesh.materials.len() as u32;
                let pictures = materials.filter_map(|material| self.materials.of(object, material));
                wanted.extend(pictures.map(|picture| (picture.clone(), Sampling::LinearRepeated)));
            }
        }
        let keys: Vec<Key> = wanted.iter().map(|(picture, sampling)| (Arc::as_ptr(picture), *sampling)).collect();
        self.pictures.retain(|key, _| keys.contains(key));
        for (key, (picture, sampling)) in keys.iter().zip(wanted) {
            if let Entry::Vacant(place) = self.pictures.entry(*key) {
                let texture = upload(gl, &picture, sampling)?;
                place.insert((picture, texture));
            }
        }
        self.plan_pictures = keys[..plan.pictures.len()].to_vec();
        Ok(())
    }

    /// The plan's table of this number.
    pub(super) fn table(&self, number: usize) -> Option<&Texture> {
        self.tables.get(number).map(|(_, texture)| texture)
    }

    /// The plan's picture of this number.
    pub(super) fn picture(&self, number: usize) -> Option<&Texture> {
        self.pictures.get(self.plan_pictures.get(number)?).map(|(_, texture)| texture)
    }

    /// One white texel.
    pub(super) fn white(&self) -> Option<&Texture> {
        self.white.as_ref()
    }

    /// Binds a material's picture, or white if it has none.
    pub(super) fn bind_material(&self, object: &Object, material: u32, unit: u32) {
        let picture = self.materials.of(object, material);
        let texture = picture.and_then(|it| self.pictures.get(&(Arc::as_ptr(it), Sampling::LinearRepeated)));
        if let Some(texture) = texture.map(|(_, texture)| texture).or(self.white()) {
            texture.bind(unit);
        }
    }
}

/// Uploads a picture as a texture, lowest row first, as GL counts; opaque, because alpha would be multiplied into the drawing.
fn upload(gl: &Rc<Gl>, picture: &Picture, sampling: Sampling) -> Result<Texture> {
    let Size { width, height } = picture.size;
    let largest = gl.info.largest_texture;
    if width.max(height) > largest {
        let what = format!("a texture of {} pixels; this driver takes {largest} at most", picture.size);
        return Err(Error::gl("uploading a picture", what));
    }
    let has_powers = width.is_power_of_two() && height.is_power_of_two();
    if legacy::REPEATS_POWERS_OF_TWO_ONLY && sampling != Sampling::NearestClamped && !has_powers {
        return upload(gl, &picture.with_powers_of_two(), sampling);
    }
    let texture = Texture::new(gl, glow::TEXTURE_2D, sampling)?;
    let row = width as usize * 4;
    let rows: Vec<u8> = picture.clone().opaque().pixels.chunks_exact(row).rev().flatten().copied().collect();
    let texels = glow::PixelUnpackData::Slice(Some(&rows));
    // SAFETY: the context is current, the texture bound, rows are packed without gaps and of the size given.
    unsafe {
        gl.glow.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            legacy::PICTURE_TEXELS as i32,
            width as i32,
            height as i32,
            0,
            glow::RGBA,
            glow::UNSIGNED_BYTE,
            texels,
        );
        if sampling == Sampling::MipmapRepeated {
            gl.legacy.make_mipmaps(&gl.glow);
        }
    }
    gl.check("uploading a picture")?;
    Ok(texture)
}

fn upload_table(gl: &Rc<Gl>, table: &PlanTable) -> Result<Texture> {
    let texture = Texture::new(gl, legacy::TABLE_TARGET, Sampling::NearestClamped)?;
    let texels = glow::PixelUnpackData::Slice(Some(table.texels.as_flattened()));
    let (format, kind, width) = (legacy::LUMINANCE_ALPHA, glow::UNSIGNED_BYTE, table.texels.len() as i32);
    let stored = legacy::TABLE_TEXELS as i32;
    // SAFETY: the context is current, the texture bound, and the texels are two bytes each, packed.
    unsafe {
        match legacy::TABLE_TARGET {
            glow::TEXTURE_2D => gl.glow.tex_image_2d(glow::TEXTURE_2D, 0, stored, width, 1, 0, format, kind, texels),
            target => gl.glow.tex_image_1d(target, 0, stored, width, 0, format, kind, texels),
        }
    }
    Ok(texture)
}
