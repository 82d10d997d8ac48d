//! A glTF file's materials: base colours and their pictures, in files or in the file itself.

use super::buffers::Buffers;
use super::uri::{self, Uri};
use crate::limits::MATERIALS;
use crate::mesh::{EmbeddedPicture, Material, TextureAlpha};
use glam::{Mat2, Vec2};
use gltf_json::material::AlphaMode;
use gltf_json::texture::Info;
use gltf_json::validation::Checked;
use gltf_json::{Root, extensions::texture::TextureTransform};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The texture coordinates of a primitive that a material reads, and their change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coordinates {
    /// The number after `TEXCOORD_`.
    pub set: u32,
    /// Their factor, applied before the offset, both in the file's sense, v downwards.
    matrix: Mat2,
    offset: Vec2,
    /// Whether it changes them.
    pub is_changed: bool,
}

impl Coordinates {
    pub(super) const DEFAULT: Self = Self { set: 0, matrix: Mat2::IDENTITY, offset: Vec2::ZERO, is_changed: false };

    fn of(texture: &Info) -> Self {
        let transform = texture.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
        let Some(TextureTransform { offset, rotation, scale, tex_coord, .. }) = transform else {
            return Self { set: texture.tex_coord, ..Self::DEFAULT };
        };
        let (sine, cosine) = rotation.0.sin_cos();
        // KHR_texture_transform: translation * rotation * scale, clockwise as v points down.
        let matrix =
            Mat2::from_cols(Vec2::new(cosine, -sine), Vec2::new(sine, cosine)) * Mat2::from_diagonal(scale.0.into());
        Self { set: tex_coord.unwrap_or(texture.tex_coord), matrix, offset: offset.0.into(), is_changed: true }
    }

    /// Texture coordinates as this program has them, origin at the lower left.
    pub(super) fn to_lower_left(self, file: Vec2) -> Vec2 {
        let Vec2 { x, y } = if self.is_changed { self.matrix * file + self.offset } else { file };
        Vec2::new(x, 1.0 - y)
    }
}

/// A file's materials.
pub(super) struct Materials {
    pub list: Vec<Material>,
    /// For each of them the texture coordinates of its picture.
    pub coordinates: Vec<Coordinates>,
    /// Pictures that only an extension knows, or that are neither files nor in the file.
    pub unread_pictures: usize,
}

/// A picture of the file.
#[derive(Clone)]
enum Image {
    File(PathBuf),
    Embedded(Arc<EmbeddedPicture>),
}

impl Materials {
    pub(super) fn of(root: &Root, buffers: &Buffers<'_>, path: &str) -> Result<Self, String> {
        if root.materials.len() > MATERIALS {
            return Err(format!("it has more than {MATERIALS} materials; merge some"));
        }
        let mut images = Images { root, buffers, path, known: HashMap::new(), room: buffers.all_bytes() };
        let mut materials = Self { list: Vec::new(), coordinates: Vec::new(), unread_pictures: 0 };
        for (number, material) in root.materials.iter().enumerate() {
            let gloss = material.extensions.as_ref().and_then(|all| all.pbr_specular_glossiness.as_ref());
            let metal = &material.pbr_metallic_roughness;
            let (factor, texture) = match gloss {
                Some(gloss) => (gloss.diffuse_factor.0, gloss.diffuse_texture.as_ref()),
                None => (metal.base_color_factor.0, metal.base_color_texture.as_ref()),
            };
            let image = match texture {
                None => None,
                Some(texture) => {
                    let image = images.of(texture)?;
                    materials.unread_pictures += usize::from(image.is_none());
                    image
                }
            };
            let alpha = if factor[3].is_finite() { factor[3].clamp(0.0, 1.0) } else { 1.0 };
            let cutoff = material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
            let mode = match material.alpha_mode {
                Checked::Valid(mode) => mode,
                Checked::Invalid => AlphaMode::Opaque,
            };
            // Nothing of it is drawn: it shows the paper.
            let is_left_out = mode == AlphaMode::Mask && alpha < cutoff;
            let image = image.filter(|_| !is_left_out);
            let (texture_file, embedded) = match image {
                None => (None, None),
                Some(Image::File(name)) => (Some(name), None),
                Some(Image::Embedded(picture)) => (None, Some(picture)),
            };
            let [red, green, blue, _] = factor.map(to_srgb);
            let color = if is_left_out { [1.0; 3] } else { [red, green, blue] };
            let mut known = Material {
                name: material.name.clone().unwrap_or_else(|| format!("material {number}")),
                color: Some(color),
                texture: texture_file,
                texture_within: None,
                embedded,
                texture_color: Some(color),
                texture_alpha: TextureAlpha::Ignored,
            };
            match mode {
                AlphaMode::Mask => known.texture_alpha = TextureAlpha::Cutoff((cutoff / alpha * 255.0).ceil() as u8),
                AlphaMode::Blend => known.blend(alpha),
                AlphaMode::Opaque => {}
            }
            materials.list.push(known);
            materials.coordinates.push(texture.map_or(Coordinates::DEFAULT, Coordinates::of));
        }
        Ok(materials)
    }
}

/// How many materials are not opaque.
pub(super) fn see_through(root: &Root) -> usize {
    let modes = root.materials.iter().map(|material| &material.alpha_mode);
    modes.filter(|mode| !matches!(mode, Checked::Valid(AlphaMode::Opaque))).count()
}

/// A share of light as the share of a byte that shows it: sRGB, as all other colours of models here.
pub(super) fn to_srgb(linear: f32) -> f32 {
    let linear = if linear.is_finite() { f64::from(linear.clamp(0.0, 1.0)) } else { 1.0 };
    (if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }) as f32
}

/// The share of light of an sRGB value in [0, 1].
pub(crate) fn to_linear(srgb: f32) -> f32 {
    let srgb = f64::from(srgb);
    (if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }) as f32
}

/// The file's pictures, each taken once.
struct Images<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    path: &'a str,
    known: HashMap<usize, Image>,
    /// Bytes that pictures may still take out of buffers: they do not overlap, and so are not more than those.
    room: usize,
}

impl Images<'_> {
    /// The picture of a texture; `None` where only an extension has it, or it lies on the net.
    fn of(&mut self, texture: &Info) -> Result<Option<Image>, String> {
        let index = texture.index;
        let texture =
            self.root.get(index).ok_or_else(|| format!("its texture {index} does not exist; export it again"))?;
        let number = texture.source.value();
        if number == u32::MAX as usize {
            return Ok(None);
        }
        if let Some(known) = self.known.get(&number) {
            return Ok(Some(known.clone()));
        }
        let image = self
            .root
            .images
            .get(number)
            .ok_or_else(|| format!("its picture {number} does not exist; export it again"))?;
        let embedded = |bytes| {
            Image::Embedded(Arc::new(EmbeddedPicture { name: format!("{}: picture {number}", self.path), bytes }))
        };
        let image = match (&image.uri, image.buffer_view) {
            (_, Some(view)) => {
                let bytes = self.buffers.view(self.root, view)?;
                self.room =
                    self.room.checked_sub(bytes.len()).ok_or("its pictures share their bytes; export it again")?;
                embedded(bytes.to_vec())
            }
            (Some(uri), None) => match uri::parse(uri) {
                Ok(Uri::Data(bytes)) => embedded(bytes),
                Ok(Uri::File(name)) => Image::File(name.into()),
                // A model without its picture is still one.
                Err(_) => return Ok(None),
            },
            (None, None) => {
                return Err(format!("its picture {number} is neither in it nor beside it; export it again"));
            }
        };
        self.known.insert(number, image.clone());
        Ok(Some(image))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_light_become_bytes_as_screens_show_them() {
        for (linear, byte) in [(0.0, 0.0), (0.002, 6.59), (0.212_230_76, 127.0), (0.5, 187.516), (1.0, 255.0)] {
            assert!((to_srgb(linear) * 255.0 - byte).abs() < 0.01, "{linear}: {}", to_srgb(linear) * 255.0);
        }
        for byte in 0..=255u8 {
            let srgb = f32::from(byte) / 255.0;
            assert!((to_srgb(to_linear(srgb)) - srgb).abs() < 1e-6, "{byte}");
        }
        assert_eq!([to_srgb(-1.0), to_srgb(7.0), to_srgb(f32::NAN)], [0.0, 1.0, 1.0]);
    }
}
