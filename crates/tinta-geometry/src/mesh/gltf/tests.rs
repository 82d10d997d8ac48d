//! Small files of this format for the readers' common tests, and what memory its JSON takes.

use super::container::{MATERIAL_BYTES, OBJECT_BYTES};
use crate::LoadOptions;
use crate::mesh::{LoadedModel, read_bytes};
use base64::Engine;
use gltf_json as json;
use serde_json::Value;

/// A triangle with a normal, texture coordinates, a material and a node that moves it; as JSON with its data in it.
pub(crate) fn json() -> Vec<u8> {
    let uri = base64::engine::general_purpose::STANDARD.encode(data());
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1],"scale":[2,2,2]}},{{"mesh":0,"translation":[1,0,0],"rotation":[0,0,0,1]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3,"material":0}}]}}],
        "materials":[{{"name":"red","pbrMetallicRoughness":{{"baseColorFactor":[1,0,0,1]}}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
        {{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":0,"byteOffset":72,"componentType":5126,"count":3,"type":"VEC2"}},
        {{"bufferView":0,"byteOffset":96,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":102}}],
        "buffers":[{{"byteLength":102,"uri":"data:application/octet-stream;base64,{uri}"}}]}}"#
    )
    .into_bytes()
}

/// The same as GLB.
pub(crate) fn binary() -> Vec<u8> {
    let text = String::from_utf8(json()).unwrap();
    let start = text.find(",\"uri\"").unwrap();
    let mut json = format!("{}}}]}}", &text[..start]).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut data = data();
    data.resize(data.len().next_multiple_of(4), 0);
    let length = 12 + 8 + json.len() + 8 + data.len();
    let words = |numbers: [usize; 2]| numbers.map(|number| (number as u32).to_le_bytes()).concat();
    let chunk = |kind: &[u8; 4], chunk: &[u8]| [(chunk.len() as u32).to_le_bytes().as_slice(), kind, chunk].concat();
    [b"glTF".as_slice(), &words([2, length]), &chunk(b"JSON", &json), &chunk(b"BIN\0", &data)].concat()
}

/// The same triangle as a value to change.
pub(super) fn triangle() -> Value {
    serde_json::from_slice(&json()).unwrap()
}

/// Adds an accessor with its data and returns its number.
pub(super) fn add_accessor(file: &mut Value, component: u32, kind: &str, count: usize, data: &[u8]) -> usize {
    let uri = base64::engine::general_purpose::STANDARD.encode(data);
    let uri = format!("data:application/octet-stream;base64,{uri}");
    let mut push = |list: &str, value: Value| {
        let list = file[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    };
    let buffer = push("buffers", serde_json::json!({"byteLength": data.len(), "uri": uri}));
    let view = push("bufferViews", serde_json::json!({"buffer": buffer, "byteLength": data.len()}));
    let accessor = serde_json::json!({"bufferView": view, "componentType": component, "count": count, "type": kind});
    push("accessors", accessor)
}

/// Adds an accessor of floats and returns its number.
pub(super) fn add_floats(file: &mut Value, kind: &str, numbers: &[f32]) -> usize {
    let size = if kind == "VEC4" { 4 } else { 3 };
    let data: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    add_accessor(file, 5126, kind, numbers.len() / size, &data)
}

pub(super) fn load(file: &Value) -> crate::Result<LoadedModel> {
    read_bytes(&serde_json::to_vec(file).unwrap(), "t.gltf", &[], &LoadOptions::default())
}

/// The sentence about a file that is refused.
pub(super) fn problem(file: &Value) -> String {
    load(file).map(|loaded| loaded.mesh.triangles.len()).unwrap_err().to_string()
}

fn data() -> Vec<u8> {
    let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let normals = [0.0, 0.0, 1.0].repeat(3);
    let coordinates = [0.0, 1.0, 1.0, 1.0, 0.0, 0.0];
    let floats = [positions.as_slice(), &normals, &coordinates].concat();
    let indices = [0u16, 1, 2];
    floats.iter().flat_map(|x: &f32| x.to_le_bytes()).chain(indices.iter().flat_map(|i| i.to_le_bytes())).collect()
}

#[test]
fn an_object_of_the_json_takes_no_more_memory_than_is_counted_for_it() {
    let sizes = [
        size_of::<json::Accessor>(),
        size_of::<json::Animation>(),
        size_of::<json::animation::Channel>(),
        size_of::<json::animation::Sampler>(),
        size_of::<json::Buffer>(),
        size_of::<json::buffer::View>(),
        size_of::<json::Camera>(),
        size_of::<json::Image>(),
        size_of::<json::Mesh>(),
        size_of::<json::mesh::Primitive>(),
        size_of::<json::Node>(),
        size_of::<json::Scene>(),
        size_of::<json::Skin>(),
        size_of::<json::Texture>(),
        size_of::<json::texture::Sampler>(),
    ];
    let largest = sizes.into_iter().max().unwrap();
    // A list that grows holds its old half and its new whole at once.
    assert!((200..=OBJECT_BYTES / 3).contains(&largest), "{largest}");
    assert!(size_of::<json::Material>() <= MATERIAL_BYTES / 3, "{}", size_of::<json::Material>());
}
