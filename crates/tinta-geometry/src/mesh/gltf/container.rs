//! A glTF file's two shapes, plain JSON or GLB, and the JSON with the gltf-json crate's types.
//!
//! GLB is taken apart here: the crate's own function (1.4) takes 12 from the header's length without asking whether it is more,
//! and refuses chunks that the standard says to pass over.

use super::super::format::GLB_MAGIC;
use crate::bytes::Bytes;
use crate::files::shown;
use crate::limits::{MEMORY_FACTOR, MEMORY_SLACK_BYTES};
use gltf_json::Root;
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt::Formatter;

const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
const VERSION: u32 = 2;
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
    if version != VERSION {
        return Err(match version {
            1 => old("1.0"),
            _ => format!("it is GLB version {version}; only version 2 is read, export it again"),
        });
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

/// Returns a GLB file of this JSON and data, whose length is a multiple of 4; `None` beyond 4 GiB.
pub(crate) fn glb_container(json: &[u8], data: &[u8]) -> Option<Vec<u8>> {
    let json_length = json.len().next_multiple_of(4);
    let length = HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json_length + data.len();
    let mut file = Vec::with_capacity(length);
    file.extend_from_slice(GLB_MAGIC);
    for number in [VERSION, length.try_into().ok()?, json_length.try_into().ok()?, JSON_CHUNK] {
        file.extend_from_slice(&number.to_le_bytes());
    }
    file.extend_from_slice(json);
    file.resize(HEADER_BYTES + CHUNK_HEADER_BYTES + json_length, b' ');
    for number in [data.len().try_into().ok()?, DATA_CHUNK] {
        file.extend_from_slice(&u32::to_le_bytes(number));
    }
    file.extend_from_slice(data);
    Some(file)
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
    let root = Root::from_slice(json).or_else(|error| {
        // Optional by the standard, and not by the crate.
        if error.to_string().starts_with("missing field `nodes`") { with_nodes(json) } else { Err(error) }
    });
    let root = root.map_err(|error| {
        let version = serde_json::from_slice::<Versioned>(json).ok().and_then(Versioned::version);
        match version {
            Some(version) if !is_read(&version) => old(&version),
            _ => format!("its JSON is not valid glTF ({}); it is damaged, export it again", shown(&error.to_string())),
        }
    })?;
    match &root.asset.version {
        version if !is_read(version) => Err(old(version)),
        _ => Ok(root),
    }
}

/// The JSON with a list of nodes in scenes that have none.
fn with_nodes(json: &[u8]) -> Result<Root, serde_json::Error> {
    let mut root: serde_json::Value = serde_json::from_slice(json)?;
    let scenes = root.get_mut("scenes").and_then(|scenes| scenes.as_array_mut());
    for scene in scenes.into_iter().flatten().filter_map(|scene| scene.as_object_mut()) {
        scene.entry("nodes").or_insert_with(|| serde_json::Value::Array(Vec::new()));
    }
    serde_json::from_value(root)
}

/// Whether this is the version that is read.
fn is_read(version: &str) -> bool {
    version == "2" || version.starts_with("2.")
}

/// The sentence about a file of another version.
fn old(version: &str) -> String {
    let remedy = match version.starts_with('1') {
        true => "convert it, for instance with: gltf-pipeline -i IN.gltf -o OUT.glb",
        false => "export it as glTF 2",
    };
    format!("it is glTF {}, and only glTF 2 is read; {remedy}", shown(version))
}

/// The only parts read of an unsupported file.
#[derive(Deserialize)]
struct Versioned {
    asset: Option<AssetVersion>,
    accessors: Option<Named>,
    meshes: Option<Named>,
}

#[derive(Deserialize)]
struct AssetVersion {
    version: Option<serde_json::Value>,
}

impl Versioned {
    /// What it says; where it says nothing, 1.0 if its meshes or accessors have names as in glTF 1 instead of numbers.
    fn version(self) -> Option<String> {
        let said = self.asset.and_then(|asset| asset.version).map(|version| match version {
            serde_json::Value::String(text) => text,
            other => other.to_string(),
        });
        let is_first = [self.accessors, self.meshes].into_iter().flatten().any(|Named(is_named)| is_named);
        said.or_else(|| is_first.then(|| "1.0".to_owned()))
    }
}

/// Whether members have names, as in an object, or are a list.
struct Named(bool);

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = Named;

            fn expecting(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
                out.write_str("an object or a list")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut members: M) -> Result<Named, M::Error> {
                while members.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
                Ok(Named(true))
            }

            fn visit_seq<S: SeqAccess<'de>>(self, mut members: S) -> Result<Named, S::Error> {
                while members.next_element::<IgnoredAny>()?.is_some() {}
                Ok(Named(false))
            }
        }
        from.deserialize_any(Either)
    }
}
