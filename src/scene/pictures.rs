//! The pictures on a mesh's materials.

use crate::error::Result;
use crate::limits::{MEMORY_FACTOR, MODEL_PICTURES_BYTES};
use crate::mesh::Material;
use crate::picture::Picture;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

/// The materials' pictures, each file read once, all of them together within [`MODEL_PICTURES_BYTES`].
pub fn read(materials: &[Material]) -> Result<Vec<Option<Arc<Picture>>>> {
    let mut known: HashMap<(&Path, Option<&Path>), Arc<Picture>> = HashMap::new();
    let (mut file_bytes, mut bytes) = (0u64, 0u64);
    let mut pictures = Vec::with_capacity(materials.len());
    for Material { texture, texture_within, .. } in materials {
        let Some(path) = texture else {
            pictures.push(None);
            continue;
        };
        let key = (path.as_path(), texture_within.as_deref());
        let picture = match known.entry(key) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(place) => {
                let most = MODEL_PICTURES_BYTES.max(file_bytes.saturating_mul(MEMORY_FACTOR as u64));
                let (picture, size) = Picture::read_within(path, key.1, most.saturating_sub(bytes))?;
                file_bytes += size;
                bytes += picture.pixels.len() as u64;
                place.insert(Arc::new(picture)).clone()
            }
        };
        pictures.push(Some(picture));
    }
    Ok(pictures)
}
