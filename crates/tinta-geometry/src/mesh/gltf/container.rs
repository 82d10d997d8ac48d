//! A glTF file's two shapes, JSON by itself or GLB, and the JSON with the gltf-json crate's types.
//!
//! GLB is taken apart here: the crate's own function (1.4) takes 12 from the header's length without asking whether it is more,
//! and refuses chunks that the standard says to pass over.

use super::super::format::GLB_MAGIC;
use crate::bytes::Bytes;
use crate::files::shown;
use crate::limits::{MEMORY_FACTOR, MEMORY_SLACK_BYTES};
use gltf_json::{Asset, Root};

const HEADER_BYTES: usize = 12;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const DATA_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");

/// Most memory that one object of the JSON becomes, bytes, lists that grow to twice their length among it.
pub(super) const OBJECT_BYTES: usize = 2048;

/// The same of a member of a list.
const MEMBER_BYTES: usize = 64;

/// The JSON and, in GLB, the data that follows it.
pub(super) fn open(file: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    if !file.starts_with(GLB_MAGIC) {
        return Ok((file, None));
    }
    let mut bytes = Bytes(file);
    bytes.take(GLB_MAGIC.len());
    let (Some(version), Some(length)) = (bytes.u32(), bytes.u32()) else {
        return Err(format!("its header has {HEADER_BYTES} bytes but the file has {}; export it again", file.len()));
    };
    if version != 2 {
        return Err(format!("it is GLB version {version}; only version 2 is read, export it again"));
    }
    let body = (length as usize).checked_sub(HEADER_BYTES).and_then(|length| bytes.take(length));
    let Some(body) = body else {
        let has = file.len();
        return Err(format!(
            "its header promises {length} bytes but the file has {has}; it is damaged or cut off, export it again"
        ));
    };
    let mut body = Bytes(body);
    let (mut json, mut data) = (None, None);
    while let (Some(length), Some(kind)) = (body.u32(), body.u32()) {
        let Some(chunk) = body.take(length as usize) else {
            return Err("one of its chunks is cut off; export it again".to_owned());
        };
        match kind {
            JSON_CHUNK if json.is_none() => json = Some(chunk),
            DATA_CHUNK if data.is_none() => data = Some(chunk),
            _ => {}
        }
    }
    Ok((json.ok_or("it has no chunk of JSON; it is damaged, export it again")?, data))
}

/// The JSON with its types, unchecked: indices may be out of range.
pub(super) fn parse(json: &[u8]) -> Result<Root, String> {
    // An object may have two bytes in the file and hundreds in memory.
    let (objects, members) = (memchr::memchr_iter(b'{', json).count(), memchr::memchr_iter(b',', json).count());
    let needed = objects.saturating_mul(OBJECT_BYTES).saturating_add(members.saturating_mul(MEMBER_BYTES));
    if needed > json.len().saturating_mul(MEMORY_FACTOR).saturating_add(MEMORY_SLACK_BYTES) {
        return Err(format!(
            "its JSON of {} bytes holds {objects} objects, which take more than {MEMORY_FACTOR} times that in memory; \
             export it with its data in a binary part",
            json.len()
        ));
    }
    let root = Root::from_slice(json).map_err(|error| {
        let version = serde_json::from_slice::<Versioned>(json).map(|file| file.asset.version);
        match version {
            Ok(version) if !version.starts_with("2.") => old(&version),
            _ => format!("its JSON is not valid glTF ({}); it is damaged, export it again", shown(&error.to_string())),
        }
    })?;
    match &root.asset.version {
        version if !version.starts_with("2.") => Err(old(version)),
        _ => Ok(root),
    }
}

fn old(version: &str) -> String {
    format!("it is glTF {}; only glTF 2 is read, export it as glTF 2", shown(version))
}

/// All that is asked of a file that is not understood.
#[derive(serde::Deserialize)]
struct Versioned {
    asset: Asset,
}
