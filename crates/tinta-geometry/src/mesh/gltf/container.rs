//! A glTF file's two shapes, plain JSON or GLB, and the JSON with the gltf-json crate's types.
//!
//! GLB is taken apart here: the crate's own function (1.4) takes 12 from the header's length without asking whether it is more,
//! and refuses chunks that the standard says to pass over.

use super::super::format::GLB_MAGIC;
use super::extensions::with_whole_numbers;
use crate::bytes::Bytes;
use crate::files::shown;
use crate::limits::{MATERIALS, MEMORY_FACTOR, MEMORY_SLACK_BYTES};
use gltf_json::Root;
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt::Formatter;

const HEADER_BYTES: usize = 12;
const VERSION: u32 = 2;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const DATA_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");

/// Most memory that one object of the JSON becomes, bytes, lists that grow to twice their length among it.
pub(super) const OBJECT_BYTES: usize = 1024;

/// The same of a material, the largest object by far.
pub(super) const MATERIAL_BYTES: usize = 2560;

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

/// The JSON with its types, unchecked: indices may be out of range.
pub(super) fn parse(json: &[u8]) -> Result<Root, String> {
    // An object may have two bytes in the file and hundreds in memory.
    let (objects, members) = (memchr::memchr_iter(b'{', json).count(), memchr::memchr_iter(b',', json).count());
    let needed = objects.saturating_mul(OBJECT_BYTES).saturating_add(members.saturating_mul(MEMBER_BYTES));
    let materials = materials(json, objects);
    let count = materials.as_ref().map_or(0, |count| *count);
    if count > MATERIALS {
        return Err(format!("it has more than {MATERIALS} materials; merge some"));
    }
    let needed = needed.saturating_add(count * (MATERIAL_BYTES - OBJECT_BYTES));
    if needed > json.len().saturating_mul(MEMORY_FACTOR).saturating_add(MEMORY_SLACK_BYTES) {
        return Err(format!(
            "its JSON of {} bytes holds {objects} objects, which take more than {MEMORY_FACTOR} times that in memory; \
             export it with its data in a binary part",
            json.len()
        ));
    }
    let read = |_| Root::from_slice(json).or_else(|error| mended(json).map_err(|_| error));
    let root = materials.and_then(read).map_err(|error| {
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

/// How many materials JSON of so many objects has at most; they are counted only where they may be too many.
fn materials(json: &[u8], objects: usize) -> Result<usize, serde_json::Error> {
    #[derive(Deserialize)]
    struct Counted {
        #[serde(default)]
        materials: Vec<IgnoredAny>,
    }
    match objects > MATERIALS {
        false => Ok(objects),
        true => serde_json::from_slice(json).map(|Counted { materials }| materials.len()),
    }
}

/// Reads JSON in forms that the standard allows and the crate refuses: scenes without a list of nodes, `4.0` for `4`.
fn mended(json: &[u8]) -> Result<Root, serde_json::Error> {
    let mut root = with_whole_numbers(serde_json::from_slice(json)?);
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

#[cfg(test)]
mod tests {
    use super::super::tests::{load, problem, triangle};
    use crate::limits::MATERIALS;
    use serde_json::{Value, json};

    /// Writes every whole number with a decimal point, as some programs do.
    fn with_decimals(value: &mut Value) {
        match value {
            Value::Number(number) => *value = number.as_f64().unwrap().into(),
            Value::Array(list) => list.iter_mut().for_each(with_decimals),
            Value::Object(object) => object.values_mut().for_each(with_decimals),
            _ => {}
        }
    }

    #[test]
    fn whole_numbers_may_be_written_as_decimals_anywhere() {
        let whole = load(&triangle()).unwrap();
        let mut all = triangle();
        with_decimals(&mut all);
        assert!(all.to_string().contains("\"count\":3.0") && all.to_string().contains("\"componentType\":5126.0"));
        let read = load(&all).unwrap();
        assert_eq!((read.mesh, read.remarks), (whole.mesh, whole.remarks));
        // Other numbers stay errors.
        let mut half = triangle();
        half["accessors"][0]["count"] = 2.5.into();
        let message = load(&half).unwrap_err().to_string();
        assert!(message.contains("invalid type: floating point `2.5`, expected u64"), "{message}");
    }

    #[test]
    fn many_small_parts_are_read_and_too_many_materials_are_refused_before_they_are() {
        // Of each part some ten objects, as CAD programs write them.
        let mut file = triangle();
        let part = file["meshes"][0].clone();
        file["meshes"] = Value::Array(vec![part; 10_000]);
        let node =
            |number: usize| json!({"mesh": number, "name": format!("part {number}"), "translation": [number, 0, 0]});
        file["nodes"] = (0..10_000).map(node).collect();
        file["scenes"] = json!([{"nodes": (0..10_000).collect::<Vec<usize>>()}]);
        file["accessors"].as_array_mut().unwrap().extend(vec![
            json!({"bufferView": 0, "count": 3, "componentType": 5126,
            "type": "VEC3"});
            30_000
        ]);
        file["bufferViews"].as_array_mut().unwrap().extend(vec![json!({"buffer": 0, "byteLength": 36}); 30_000]);
        assert_eq!(load(&file).unwrap().mesh.triangles.len(), 10_000);
        let mut file = triangle();
        file["materials"] = Value::Array(vec![json!({}); MATERIALS + 1]);
        assert_eq!(problem(&file), "t.gltf: it has more than 16384 materials; merge some");
    }
}
