//! A glTF file's two shapes, plain JSON or GLB, and the JSON with the gltf-json crate's types.
//!
//! GLB is taken apart here: the crate's own function (1.4) takes 12 from the header's length without asking whether it is more,
//! and refuses chunks that the standard says to pass over.

use super::super::text;
use super::extensions::tidied;
use crate::bytes::Bytes;
use crate::files::shown;
use crate::limits::{MATERIALS, MEMORY_FACTOR, MEMORY_SLACK_BYTES};
use gltf_json::{Camera, Root};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};

/// How GLB begins, glTF in one file.
const GLB_MAGIC: &[u8] = b"glTF";

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

/// A file's parts.
pub(super) struct Parts<'a> {
    pub json: &'a [u8],
    /// What GLB has behind the JSON.
    pub data: Option<&'a [u8]>,
    /// What follows GLB's end.
    pub unread: &'a [u8],
}

/// Whether the beginning of a file is that of GLB or reads like glTF's JSON.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    const WORDS: [&[u8]; 6] =
        [b"\"asset\"", b"\"accessors\"", b"\"buffers\"", b"\"bufferViews\"", b"\"meshes\"", b"\"nodes\""];
    let head = text::head(bytes);
    let has_words = || WORDS.iter().any(|word| memchr::memmem::find(head, word).is_some());
    head.starts_with(GLB_MAGIC) || head.trim_ascii_start().starts_with(b"{") && has_words()
}

/// Takes a file apart.
pub(super) fn open(file: &[u8]) -> Result<Parts<'_>, String> {
    if !file.starts_with(GLB_MAGIC) {
        return Ok(Parts { json: file, data: None, unread: &[] });
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
    let json = json.ok_or("it has no chunk of JSON; it is damaged, export it again")?;
    Ok(Parts { json, data, unread: bytes.0 })
}

/// The JSON with its types, unchecked: indices may be out of range.
pub(super) fn parse(json: &[u8]) -> Result<Root, String> {
    // An object may have two bytes in the file and hundreds in memory.
    let (objects, members) = (memchr::memchr_iter(b'{', json).count(), memchr::memchr_iter(b',', json).count());
    let needed = objects.saturating_mul(OBJECT_BYTES).saturating_add(members.saturating_mul(MEMBER_BYTES));
    let count = materials(json, objects);
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
    let root = Root::from_slice(json).or_else(|error| {
        let root: Option<Value> = serde_json::from_slice(json).ok();
        let other = root.as_ref().and_then(version).filter(|version| !is_read(version));
        root.and_then(|root| mended(tidied(root)).ok()).ok_or_else(|| match other {
            Some(version) => old(&version),
            None => {
                format!("its JSON is not valid glTF ({}); it is damaged, export it again", shown(&error.to_string()))
            }
        })
    })?;
    match &root.asset.version {
        version if !is_read(version) => Err(old(version)),
        _ => Ok(root),
    }
}

/// How many materials JSON of so many objects has at most; they are counted only where they may be too many.
fn materials(json: &[u8], objects: usize) -> usize {
    #[derive(Deserialize, Default)]
    struct MaterialList {
        #[serde(default)]
        materials: Vec<IgnoredAny>,
    }
    match objects > MATERIALS {
        false => objects,
        true => serde_json::from_slice::<MaterialList>(json).unwrap_or_default().materials.len(),
    }
}

/// Reads JSON that can be drawn and that the crate refuses: in forms that the standard allows, scenes without a list of nodes, `4.0`
/// for `4`, or with faults in parts that are never drawn.
fn mended(mut root: Value) -> Result<Root, serde_json::Error> {
    for (list, member) in
        [("scenes", "nodes"), ("meshes", "primitives"), ("animations", "channels"), ("animations", "samplers")]
    {
        let items = root.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
        for object in items.filter_map(Value::as_object_mut) {
            object.entry(member).or_insert_with(|| Value::Array(Vec::new()));
        }
    }
    let cameras = root.get_mut("cameras").and_then(Value::as_array_mut).into_iter().flatten();
    cameras
        .filter(|camera| Camera::deserialize(&**camera).is_err())
        .for_each(|camera| *camera = json!({"type": "none"}));
    serde_json::from_value(root)
}

/// The version that a file names, or 1.0 if it names none and its meshes or accessors have names as in glTF 1 instead of numbers.
fn version(root: &Value) -> Option<String> {
    match root.get("asset").and_then(|asset| asset.get("version")) {
        Some(Value::String(text)) => Some(text.clone()),
        Some(other) => Some(other.to_string()),
        None => ["accessors", "meshes"]
            .into_iter()
            .any(|list| root.get(list).is_some_and(Value::is_object))
            .then(|| "1.0".to_owned()),
    }
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
    fn faults_in_what_is_never_drawn_refuse_nothing() {
        let whole = load(&triangle()).unwrap();
        let pointer =
            json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/translation"}}});
        let animation =
            json!([{"channels": [{"sampler": 0, "target": pointer}], "samplers": [{"input": 0, "output": 0}]}]);
        let missing =
            json!([triangle()["buffers"][0], {"uri": "no.bin", "byteLength": 9}, {"uri": "data:no", "byteLength": 9}]);
        let unused = json!([triangle()["materials"][0], {"pbrMetallicRoughness": {"baseColorTexture": {"index": 7}}}]);
        let remark = |what: &str| format!("t.gltf: not drawn: 1 {what}");
        let (said, camera) = (remark("animation (drawn in its rest pose)"), remark("camera"));
        for (place, value, remark) in [
            ("/animations", animation, said.as_str()),
            ("/cameras", json!([{"type": "perspective", "perspective": {"yfov": 1}}]), camera.as_str()),
            ("/cameras", json!([{"type": "perspective", "perspective": {"znear": "near"}}]), camera.as_str()),
            ("/materials/0/normalTexture", json!({}), ""),
            ("/materials/0/occlusionTexture", json!({"index": "none"}), ""),
            ("/materials/0/doubleSided", json!(1), ""),
            ("/materials/0/pbrMetallicRoughness/metallicFactor", json!("shiny"), ""),
            ("/samplers", json!({"wrapS": {}}), ""),
            ("/asset/generator", json!(4), ""),
            ("/accessors/0/min", json!("0 0 0"), ""),
            ("/meshes/1", json!({"name": "unused"}), ""),
            ("/buffers", missing, ""),
            ("/materials", unused, ""),
        ] {
            let mut file = triangle();
            let (object, member) = place.rsplit_once('/').unwrap();
            match file.pointer_mut(object).unwrap() {
                Value::Array(list) => list.push(value.clone()),
                object => object[member] = value.clone(),
            }
            let read = load(&file).unwrap_or_else(|error| panic!("{place} {value}: {error}"));
            assert_eq!(read.remarks.join(" "), remark, "{place} {value}");
            assert_eq!(
                (read.mesh.positions, read.mesh.triangles),
                (whole.mesh.positions.clone(), whole.mesh.triangles.clone())
            );
        }
        let mut file = triangle();
        file["nodes"][1]["name"] = json!(5);
        assert_eq!(load(&file).unwrap().mesh.parts[1].name, "5");
        // Parts that are drawn must be right.
        for (place, value, sentence) in [
            ("/meshes/0/primitives/0/material", json!(1), "its texture 7 does not exist"),
            ("/bufferViews/0/buffer", json!(1), "no.bin"),
            ("/meshes/0/primitives/0/indices", json!("none"), "its JSON is not valid glTF"),
        ] {
            let mut file = triangle();
            *file.pointer_mut(place).unwrap() = value;
            file["buffers"].as_array_mut().unwrap().push(json!({"uri": "no.bin", "byteLength": 102}));
            let materials = file["materials"].as_array_mut().unwrap();
            materials.push(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 7}}}));
            assert!(problem(&file).contains(sentence), "{}", problem(&file));
        }
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
