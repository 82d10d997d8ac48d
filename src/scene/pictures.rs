//! The pictures on a mesh's materials.

use crate::error::Result;
use crate::limits::{MEMORY_FACTOR, MODEL_PICTURES_BYTES};
use crate::mesh::{EmbeddedPicture, Material};
use crate::picture::Picture;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

/// Where a material's picture is read from.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Source<'a> {
    /// A file, and the folder that it must lie in.
    File(&'a Path, Option<&'a Path>),
    /// The model's own file: the picture's place in memory, which materials share.
    Embedded(*const EmbeddedPicture),
}

/// The materials' pictures, each file read once, all of them together within [`MODEL_PICTURES_BYTES`].
pub fn read(materials: &[Material]) -> Result<Vec<Option<Arc<Picture>>>> {
    let mut known: HashMap<Source<'_>, Arc<Picture>> = HashMap::new();
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
        let picture = match known.entry(source) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(place) => {
                let most = MODEL_PICTURES_BYTES.max(file_bytes.saturating_mul(MEMORY_FACTOR as u64));
                let most = most.saturating_sub(bytes);
                let (picture, size) = match (source, &material.embedded) {
                    (Source::Embedded(_), Some(file)) => {
                        (Picture::from_bytes_of(&file.bytes, &file.name, most)?, file.bytes.len() as u64)
                    }
                    (Source::File(path, within), _) => Picture::read_within(path, within, most)?,
                    (Source::Embedded(_), None) => continue,
                };
                file_bytes += size;
                bytes += picture.pixels.len() as u64;
                place.insert(Arc::new(picture)).clone()
            }
        };
        pictures.push(Some(picture));
    }
    Ok(pictures)
}
