//! A glTF file's materials: base colours and their pictures, in files or in the file itself.

use super::buffers::Buffers;
use super::extensions;
use super::uri::{self, Uri};
use crate::mesh::{EmbeddedPicture, Material, TextureAlpha};
use glam::{Mat2, Vec2};
use gltf_json::Root;
use gltf_json::extensions::texture::TextureTransform;
use gltf_json::material::AlphaMode;
use gltf_json::texture::Info;
use gltf_json::validation::Checked;
use serde::Deserialize;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// Kinds of pictures that only extensions allow.
const OF_EXTENSIONS: [&str; 4] = ["image/webp", "image/avif", "image/ktx2", "image/vnd-ms.dds"];

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
#[derive(Default)]
pub(super) struct Materials {
    pub list: Vec<Material>,
    /// For each of them the texture coordinates of its picture, or why it cannot be drawn, for those who draw it.
    pub coordinates: Vec<Result<Coordinates, String>>,
    /// Their parts that are not drawn.
    pub left_out: LeftOut,
}

/// Counts of materials' parts that no style draws.
#[derive(Default)]
pub(super) struct LeftOut {
    /// Pictures that only an extension knows, of formats that only one allows, or at unsupported addresses.
    pub pictures: usize,
    /// Textures that name no picture.
    pub empty_textures: usize,
    /// Materials that emit light.
    pub emission: usize,
    /// Black ones among those: the light that they emit is their colour.
    pub emission_as_color: usize,
}

/// A picture of the file.
#[derive(Clone)]
enum Image {
    File(PathBuf),
    Embedded(Arc<EmbeddedPicture>),
}

/// A colour, red, green, blue as linear light, alpha, and the picture that it is a factor of.
struct Source<'a> {
    factor: [f32; 4],
    texture: Option<&'a Info>,
}

/// The light that a material reflects.
fn base(material: &gltf_json::Material) -> Source<'_> {
    let gloss = material.extensions.as_ref().and_then(|all| all.pbr_specular_glossiness.as_ref());
    let metal = &material.pbr_metallic_roughness;
    match gloss {
        Some(gloss) => Source { factor: gloss.diffuse_factor.0, texture: gloss.diffuse_texture.as_ref() },
        None => Source { factor: metal.base_color_factor.0, texture: metal.base_color_texture.as_ref() },
    }
}

/// The light that a material emits, if any.
fn emission(material: &gltf_json::Material) -> Result<Option<Source<'_>>, String> {
    #[derive(Deserialize)]
    #[serde(rename_all = "camelCase")]
    struct Strength {
        emissive_strength: Option<f32>,
    }
    let others = material.extensions.as_ref().map(|extensions| &extensions.others);
    let said: Option<Strength> = extensions::said(others, "KHR_materials_emissive_strength")?;
    let strength = said.and_then(|said| said.emissive_strength).unwrap_or(1.0);
    let [red, green, blue] = material.emissive_factor.0.map(|channel| channel * strength);
    let factor = [red, green, blue, 1.0];
    let is_dark = [red, green, blue].iter().all(|channel| *channel <= 0.0 || channel.is_nan());
    Ok((!is_dark).then_some(Source { factor, texture: material.emissive_texture.as_ref() }))
}

impl Materials {
    pub(super) fn of(root: &Root, buffers: &Buffers<'_>, path: &str) -> Self {
        let mut images = Images::of(root, buffers, path);
        let mut materials = Self::default();
        for (number, material) in root.materials.iter().enumerate() {
            let name = material.name.clone().unwrap_or_else(|| format!("material {number}"));
            let read = materials.left_out.source(material).and_then(|source| {
                let image = source.texture.map_or(Ok(None), |texture| images.picture(texture))?;
                materials.list.push(drawn(material, name, source.factor, image));
                Ok(source.texture.map_or(Coordinates::DEFAULT, Coordinates::of))
            });
            materials.list.resize_with(number + 1, Material::default);
            materials.coordinates.push(read);
        }
        let left_out = &mut materials.left_out;
        (left_out.pictures, left_out.empty_textures) = (images.unread.len(), images.empty.len());
        materials
    }
}

impl LeftOut {
    /// The colour that a material is drawn in: the light that it reflects, or emits if it is opaque and black.
    fn source<'a>(&mut self, material: &'a gltf_json::Material) -> Result<Source<'a>, String> {
        let base = base(material);
        let Some(emission) = emission(material)? else { return Ok(base) };
        let is_black = base.factor[..3].iter().all(|channel| *channel <= 0.0);
        let is_opaque = matches!(material.alpha_mode, Checked::Valid(AlphaMode::Opaque));
        match is_black && is_opaque {
            true => self.emission_as_color += 1,
            false => self.emission += 1,
        }
        Ok(if is_black && is_opaque { emission } else { base })
    }
}

/// The drawn material, in a colour of linear light and alpha, perhaps the factor of a picture.
fn drawn(material: &gltf_json::Material, name: String, factor: [f32; 4], image: Option<Image>) -> Material {
    let alpha = if factor[3].is_finite() { factor[3].clamp(0.0, 1.0) } else { 1.0 };
    let cutoff = material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
    let mode = match material.alpha_mode {
        Checked::Valid(mode) => mode,
        Checked::Invalid => AlphaMode::Opaque,
    };
    // Nothing of it is drawn: it shows the paper.
    let is_left_out = mode == AlphaMode::Mask && alpha < cutoff;
    let (texture, embedded) = match image.filter(|_| !is_left_out) {
        None => (None, None),
        Some(Image::File(name)) => (Some(name), None),
        Some(Image::Embedded(picture)) => (None, Some(picture)),
    };
    let [red, green, blue, _] = factor.map(to_srgb);
    let color = if is_left_out { [1.0; 3] } else { [red, green, blue] };
    let mut drawn =
        Material { name, color: Some(color), texture, embedded, texture_color: Some(color), ..Material::default() };
    match mode {
        AlphaMode::Mask => drawn.texture_alpha = TextureAlpha::Cutoff((cutoff / alpha * 255.0).ceil() as u8),
        AlphaMode::Blend => drawn.blend(alpha),
        AlphaMode::Opaque => {}
    }
    drawn
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

/// The file's pictures, each taken once.
struct Images<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    path: &'a str,
    known: HashMap<usize, Image>,
    /// The textures whose pictures are not read.
    unread: HashSet<usize>,
    /// The textures without any.
    empty: HashSet<usize>,
    /// Bytes that pictures may still take out of buffers: they do not overlap, and so are not more than those.
    room: usize,
}

impl<'a> Images<'a> {
    fn of(root: &'a Root, buffers: &'a Buffers<'a>, path: &'a str) -> Self {
        let (unread, empty) = (HashSet::new(), HashSet::new());
        Self { root, buffers, path, known: HashMap::new(), unread, empty, room: buffers.all_bytes() }
    }

    /// The picture of a texture; `None` where none is read.
    fn picture(&mut self, texture: &Info) -> Result<Option<Image>, String> {
        let index = texture.index;
        let texture =
            self.root.get(index).ok_or_else(|| format!("its texture {index} does not exist; export it again"))?;
        let others = texture.extensions.iter().flat_map(|extensions| extensions.others.values());
        let image = match texture.source.value() as u32 {
            u32::MAX if others.filter_map(|value| value.get("source")).next().is_none() => {
                self.empty.insert(index.value());
                return Ok(None);
            }
            u32::MAX => None,
            number => self.image(number as usize)?,
        };
        if image.is_none() {
            self.unread.insert(index.value());
        }
        Ok(image)
    }

    /// A picture by its number; `None` if it is of a format that only an extension allows, or lies on the net.
    fn image(&mut self, number: usize) -> Result<Option<Image>, String> {
        if let Some(known) = self.known.get(&number) {
            return Ok(Some(known.clone()));
        }
        let image = self
            .root
            .images
            .get(number)
            .ok_or_else(|| format!("its picture {number} does not exist; export it again"))?;
        if image.mime_type.as_ref().is_some_and(|kind| OF_EXTENSIONS.contains(&kind.0.as_str())) {
            return Ok(None);
        }
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
        assert_eq!([to_srgb(-1.0), to_srgb(7.0), to_srgb(f32::NAN)], [0.0, 1.0, 1.0]);
    }

    use super::super::tests::{load, triangle};
    use serde_json::{Value, json};

    fn with_material(material: &Value) -> crate::mesh::LoadedModel {
        let mut file = triangle();
        file["materials"][0] = material.clone();
        file["images"] = json!([{"uri": "data:image/png;base64,AAAA"}]);
        file["textures"] = json!([{"source": 0}, {}]);
        load(&file).unwrap()
    }

    #[test]
    fn light_that_a_black_material_emits_is_its_colour_and_other_light_is_said() {
        let black = json!({"baseColorFactor": [0, 0, 0, 1], "baseColorTexture": {"index": 0}});
        let as_color = "t.gltf: not drawn: 1 black material's emission as light (drawn as its colour)";
        let said = "t.gltf: not drawn: 1 material's emission";
        let strength = json!({"KHR_materials_emissive_strength": {"emissiveStrength": 0.25}});
        for (material, color, remark) in [
            (json!({"pbrMetallicRoughness": black, "emissiveFactor": [1, 0, 0]}), [1.0, 0.0, 0.0], as_color),
            (
                json!({"pbrMetallicRoughness": black, "emissiveFactor": [1, 0, 0.0], "extensions": strength}),
                [to_srgb(0.25), 0.0, 0.0],
                as_color,
            ),
            (json!({"pbrMetallicRoughness": black, "emissiveFactor": [0, 0, 0]}), [0.0; 3], ""),
            (json!({"emissiveFactor": [0, 0, 0], "emissiveTexture": {"index": 0}}), [1.0; 3], ""),
            (json!({"emissiveFactor": [1, 0, 0]}), [1.0; 3], said),
        ] {
            let loaded = with_material(&material);
            assert_eq!(loaded.mesh.materials[0].color, Some(color), "{material}");
            assert_eq!(loaded.remarks.join(" "), remark, "{material}");
        }
        // A label: black, its letters as light.
        let label = json!({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}, "emissiveFactor": [1, 1, 1],
            "emissiveTexture": {"index": 0}});
        let material = &with_material(&label).mesh.materials[0];
        assert!(material.embedded.is_some());
        assert_eq!((material.color, material.texture_color), (Some([1.0; 3]), Some([1.0; 3])));
    }

    #[test]
    fn a_texture_without_a_picture_is_said_as_that() {
        let loaded = with_material(&json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}));
        assert!(!loaded.mesh.materials[0].has_texture());
        assert_eq!(loaded.remarks, ["t.gltf: not drawn: 1 texture that names no picture"]);
    }
}
