//! The pictures on a mesh's materials, as their files hold them or averaged for a view.

use super::Picture;
use super::averaged::average;
use crate::error::Result;
use crate::limits::{MEMORY_FACTOR, MODEL_PICTURES_BYTES};
use crate::mesh::{EmbeddedPicture, Material, TextureAlpha};
use crate::scene::{Object, ObjectIdentity, Scene, Size};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

/// The source of a material's picture.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Source<'a> {
    /// A file, and the folder that must contain it.
    File(&'a Path, Option<&'a Path>),
    /// The model's own file: the picture's place in memory, which materials share.
    Embedded(*const EmbeddedPicture),
}

/// A material's picture: as read and as shown.
type MaterialPicture = [Arc<Picture>; 2];

/// The pictures on the materials of a scene's objects, each read once for all copies of an object.
#[derive(Debug, Default)]
pub struct MaterialPictures(Vec<(ObjectIdentity, Vec<Option<MaterialPicture>>)>);

impl MaterialPictures {
    /// Reads a scene's missing pictures and releases unused ones. Those finer than the pixels are averaged if the size of the surface
    /// that the scene is drawn into is given, pixels.
    ///
    /// # Errors
    ///
    /// [`Error::File`](crate::Error::File) when one cannot be read.
    pub fn prepare(&mut self, scene: &Scene, surface: Option<Size>) -> Result<()> {
        self.0.retain(|(identity, _)| scene.objects.iter().any(|object| identity.is_of(object)));
        for object in &scene.objects {
            if self.0.iter().all(|(identity, _)| !identity.is_of(object)) {
                let read = material_pictures(&object.mesh.materials)?.into_iter();
                self.0.push((object.identity(), read.map(|read| read.map(|read| [read.clone(), read])).collect()));
            }
        }
        for (identity, pictures) in &mut self.0 {
            let mut sizes: Vec<Option<Size>> =
                pictures.iter().map(|it| it.as_ref().map(|[read, _]| read.size)).collect();
            if let Some(surface) = surface {
                average(&mut sizes, scene, scene.objects.iter().filter(|object| identity.is_of(object)), surface);
            }
            for ([read, shown], size) in pictures.iter_mut().flatten().zip(sizes.into_iter().flatten()) {
                if shown.size != size {
                    *shown = if size == read.size { read.clone() } else { Arc::new(read.reduced(size)) };
                }
            }
        }
        Ok(())
    }

    /// Returns the picture that an object shows on a material; `None` where it has none, or before [`MaterialPictures::prepare`].
    pub fn of(&self, object: &Object, material: u32) -> Option<&Arc<Picture>> {
        let (_, pictures) = self.0.iter().find(|(identity, _)| identity.is_of(object))?;
        pictures.get(material as usize)?.as_ref().map(|[_, shown]| shown)
    }
}

/// Returns a mesh's pictures, by material. Each file is read once, and together they stay within [`MODEL_PICTURES_BYTES`]; `None`
/// for a material without one.
///
/// # Errors
///
/// [`Error::File`](crate::Error::File) when one cannot be read.
pub fn material_pictures(materials: &[Material]) -> Result<Vec<Option<Arc<Picture>>>> {
    let mut known: HashMap<(Source<'_>, TextureAlpha), Arc<Picture>> = HashMap::new();
    let (mut file_bytes, mut bytes) = (0u64, 0u64);
    let mut pictures = Vec::with_capacity(materials.len());
    for material in materials {
        let source = match (&material.texture, &material.embedded) {
            (Some(path), _) => Source::File(path, material.texture_within.as_deref()),
            (None, Some(picture)) => Source::Embedded(Arc::as_ptr(picture)),
            (None, None) => {
                pictures.push(None);
                continue;
            }
        };
        let picture = match known.entry((source, material.texture_alpha)) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(place) => {
                let most = MODEL_PICTURES_BYTES.max(file_bytes.saturating_mul(MEMORY_FACTOR as u64));
                let most = most.saturating_sub(bytes);
                let (mut picture, size) = match (source, &material.embedded) {
                    (Source::Embedded(_), Some(file)) => {
                        (Picture::from_bytes_of(&file.bytes, &file.name, most)?, file.bytes.len() as u64)
                    }
                    (Source::File(path, within), _) => Picture::read_within(path, within, most)?,
                    (Source::Embedded(_), None) => continue,
                };
                flatten(&mut picture, material.texture_alpha);
                file_bytes += size;
                bytes += picture.pixels.len() as u64;
                place.insert(Arc::new(picture)).clone()
            }
        };
        pictures.push(Some(picture));
    }
    Ok(pictures)
}

/// Blends a texture's transparent parts with white.
fn flatten(picture: &mut Picture, alpha: TextureAlpha) {
    const WHITE: u32 = 255;
    let factor = if let TextureAlpha::Blended(factor) = alpha { factor } else { [u8::MAX; 4] };
    let times = |own: u8, factor: u8| (u32::from(own) * u32::from(factor) + WHITE / 2) / WHITE;
    let share = |own: u8| match alpha {
        TextureAlpha::Ignored => WHITE,
        TextureAlpha::Cutoff(least) => {
            if own < least {
                0
            } else {
                WHITE
            }
        }
        TextureAlpha::Blended([.., factor]) => times(own, factor),
    };
    for [red, green, blue, own] in picture.pixels.as_chunks_mut::<4>().0 {
        let share = share(*own);
        for (channel, factor) in [red, green, blue].into_iter().zip(factor) {
            *channel = ((times(*channel, factor) * share + WHITE * (WHITE - share) + WHITE / 2) / WHITE) as u8;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Size;

    #[test]
    fn what_a_textures_alpha_leaves_out_is_white() {
        let pixels = [[10, 20, 30, 255], [10, 20, 30, 0], [0, 100, 200, 51]];
        let flat = |alpha| {
            let size = Size { width: 3, height: 1 };
            let mut picture = Picture { size, pixels: pixels.concat() };
            flatten(&mut picture, alpha);
            picture.pixels.chunks(4).map(|texel| [texel[0], texel[1], texel[2]]).collect::<Vec<_>>()
        };
        let [first, second, third] = pixels.map(|[red, green, blue, _]| [red, green, blue]);
        assert_eq!(flat(TextureAlpha::Ignored), [first, second, third]);
        assert_eq!(flat(TextureAlpha::Cutoff(51)), [first, [255; 3], third]);
        assert_eq!(flat(TextureAlpha::Cutoff(52)), [first, [255; 3], [255; 3]]);
        assert_eq!(flat(TextureAlpha::Blended([255; 4])), [first, [255; 3], [204, 224, 244]]);
        assert_eq!(flat(TextureAlpha::Blended([255, 255, 255, 0])), [[255; 3]; 3]);
        assert_eq!(flat(TextureAlpha::Blended([255, 51, 0, 51]))[0], [206, 205, 204]);
    }
}
