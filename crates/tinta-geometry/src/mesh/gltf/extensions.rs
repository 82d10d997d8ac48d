//! glTF's extensions: those that are read, those that may be left out, and their values.

use crate::files::shown;
use gltf_json::Root;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value};

/// Marks edges to draw.
pub(crate) const EDGES: &str = "EXT_mesh_primitive_edge_visibility";

/// Places copies of a node's mesh.
pub(super) const INSTANCES: &str = "EXT_mesh_gpu_instancing";

/// Hides a node and all below it; cameras there still look.
pub(super) const VISIBILITY: &str = "KHR_node_visibility";

/// Extensions that are read, or that do not affect the drawing.
const UNDERSTOOD: [&str; 9] = [
    "EXT_mesh_primitive_restart",
    "KHR_mesh_primitive_restart",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_xmp_json_ld",
    EDGES,
    INSTANCES,
    VISIBILITY,
];

/// Extensions that hold data in a compressed form which is not read.
const COMPRESSED: [&str; 3] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Rejects a file that requires an unsupported extension, and advises how to avoid it.
pub(super) fn refuse_unknown(root: &Root) -> Result<(), String> {
    match root.extensions_required.iter().find(|name| !is_understood(name) && !is_of_surfaces(name)) {
        None => Ok(()),
        Some(name) => Err(needed(name)),
    }
}

/// The sentence about a file that cannot be drawn without an extension.
fn needed(name: &str) -> String {
    let remedy = match COMPRESSED.contains(&name) {
        true => "decompress it, for instance with: gltf-transform copy IN.glb OUT.glb",
        false => "export it without that extension",
    };
    format!("it needs the extension {}, which tinta does not read; {remedy}", shown(name))
}

/// Rejects data that only a compressed form has, if these extensions name one.
pub(super) fn refuse_compressed(others: Option<&Map<String, Value>>) -> Result<(), String> {
    match COMPRESSED.iter().find(|name| others.is_some_and(|others| others.contains_key(**name))) {
        None => Ok(()),
        Some(name) => Err(needed(name)),
    }
}

/// The extensions in use that are not drawn. Of compressed data there is another form, or the file is refused; where no picture is
/// left out, others stand in for those of extensions.
pub(super) fn not_drawn(root: &Root, has_pictures: bool) -> impl Iterator<Item = &str> {
    let is_drawn = move |name: &str| is_understood(name) || !has_pictures && pictures_remedy(name).is_some();
    let names = root.extensions_used.iter().map(String::as_str);
    names.filter(move |name| !is_drawn(name) && !COMPRESSED.contains(name))
}

/// How to get pictures that are read out of a file with this extension; `None` if it has none.
pub(super) fn pictures_remedy(name: &str) -> Option<&'static str> {
    match name {
        "KHR_texture_basisu" => Some("save its pictures as PNG, for instance with: gltf-transform ktxdecompress"),
        "EXT_texture_webp" | "EXT_texture_avif" => {
            Some("save its pictures as PNG, for instance with: gltf-transform png")
        }
        "MSFT_texture_dds" => Some("save its pictures as PNG"),
        _ => None,
    }
}

fn is_understood(extension: &str) -> bool {
    // Material extensions add to the base colour in ways that no style here draws.
    UNDERSTOOD.contains(&extension) || extension.starts_with("KHR_materials_")
}

/// Whether an extension affects pictures, materials, lights or animations alone: without it every line is right.
fn is_of_surfaces(extension: &str) -> bool {
    let subject = extension.split('_').nth(1).unwrap_or_default();
    ["texture", "image", "materials", "lights", "techniques", "technique", "animation"].contains(&subject)
}

/// The value of an object's extension; `None` if it has none of that name.
pub(super) fn said<T: DeserializeOwned>(others: Option<&Map<String, Value>>, name: &str) -> Result<Option<T>, String> {
    let Some(value) = others.and_then(|others| others.get(name)) else { return Ok(None) };
    let said = serde_json::from_value(tidied(value.clone()));
    said.map(Some).map_err(|error| format!("its {name} is damaged ({}); export it again", shown(&error.to_string())))
}

/// JSON as the crate takes it: whole numbers without a point, because the standard allows `4.0` for `4`; numbers as names as text;
/// without members that nothing here reads, whose faults refuse nothing.
pub(super) fn tidied(value: Value) -> Value {
    /// Beyond it not every whole number is a float.
    const MOST: f64 = 9_007_199_254_740_992.0;
    const UNREAD: &str = "channels copyright doubleSided generator glossinessFactor magFilter max metallicFactor \
        metallicRoughnessTexture min minFilter minVersion normalTexture occlusionTexture roughnessFactor sampler samplers skeleton \
        specularFactor specularGlossinessTexture wrapS wrapT";
    match value {
        Value::Number(number) if number.is_f64() => {
            let whole = number.as_f64().filter(|float| float.fract() == 0.0 && float.abs() <= MOST);
            Value::Number(whole.map_or(number, |float| Number::from(float as i64)))
        }
        Value::Array(list) => Value::Array(list.into_iter().map(tidied).collect()),
        Value::Object(object) => {
            let read = object.into_iter().filter(|(key, _)| !UNREAD.split(' ').any(|unread| unread == key));
            let tidied = read.map(|(key, value)| match tidied(value) {
                Value::Number(name) if key == "name" => (key, Value::String(name.to_string())),
                value => (key, value),
            });
            Value::Object(tidied.collect())
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{add_accessor, add_floats, load, problem, triangle};
    use serde_json::json;

    #[test]
    fn compressed_data_without_any_other_is_refused_with_how_to_decompress_it() {
        let sentence = "t.gltf: it needs the extension KHR_draco_mesh_compression, which tinta does not read; decompress it, \
                        for instance with: gltf-transform copy IN.glb OUT.glb";
        let mut file = triangle();
        file["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
        let draco = json!({"bufferView": 0, "attributes": {"POSITION": 0}});
        file["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": draco});
        // With other data, that is drawn, all of it.
        let loaded = load(&file).unwrap();
        assert_eq!((loaded.mesh.triangles.len(), loaded.remarks.len()), (1, 0), "{:?}", loaded.remarks);
        for missing in [0, 3] {
            let mut file = file.clone();
            file["accessors"][missing].as_object_mut().unwrap().remove("bufferView");
            assert_eq!(problem(&file), sentence, "accessor {missing}");
        }
        let mut file = triangle();
        file["buffers"][0] = json!({"byteLength": 102, "extensions": {"EXT_meshopt_compression": {"fallback": true}}});
        assert!(problem(&file).contains("it needs the extension EXT_meshopt_compression"), "{}", problem(&file));
        file["buffers"][0] = json!({"byteLength": 102});
        assert!(problem(&file).contains("its buffer 0 names no data"), "{}", problem(&file));
    }

    #[test]
    fn the_largest_index_begins_a_new_strip_loop_or_fan() {
        let with = |mode: u8, indices: &[u8]| {
            let mut file = triangle();
            let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.0, 0.0];
            let positions = add_floats(&mut file, "VEC3", &corners);
            let indices = add_accessor(&mut file, 5121, "SCALAR", indices.len(), indices);
            file["extensionsUsed"] = json!(["KHR_mesh_primitive_restart"]);
            file["meshes"][0]["primitives"] =
                json!([{"attributes": {"POSITION": positions}, "indices": indices, "mode": mode}]);
            let loaded = load(&file).unwrap();
            assert!(loaded.remarks.is_empty(), "{:?}", loaded.remarks);
            (loaded.mesh.triangles.len(), loaded.mesh.curves.segments.len())
        };
        let runs = [0, 1, 2, 255, 3, 4, 5, 255, 255];
        assert_eq!([2, 3, 5, 6].map(|mode| with(mode, &runs)), [(0, 6), (0, 4), (2, 0), (2, 0)]);
        // Of strips every other triangle is turned, in each from its beginning.
        assert_eq!(with(5, &[0, 1, 2, 3, 255, 1, 4, 3, 5]), (4, 0));
    }

    #[test]
    fn extensions_for_surfaces_alone_do_not_refuse_a_model_and_others_do() {
        for (extension, remedy) in [
            ("EXT_texture_webp", "; save its pictures as PNG, for instance with: gltf-transform png"),
            ("KHR_texture_basisu", "; save its pictures as PNG, for instance with: gltf-transform ktxdecompress"),
            ("MSFT_texture_dds", "; save its pictures as PNG"),
            ("XX_image_of_mine", ""),
        ] {
            let mut file = triangle();
            file["extensionsUsed"] = json!([extension]);
            file["extensionsRequired"] = json!([extension]);
            file["images"] = json!([{"uri": "data:image/webp;base64,AAAA", "mimeType": "image/webp"}]);
            file["textures"] = json!([{"extensions": {extension: {"source": 0}}}, {"source": 0}]);
            let remark = |texture: usize| {
                let mut file = file.clone();
                file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": texture});
                let loaded = load(&file).unwrap();
                assert_eq!(loaded.mesh.triangles.len(), 1);
                assert!(!loaded.mesh.materials[0].has_texture());
                loaded.remarks.join(" ")
            };
            let sentence = format!(
                "t.gltf: not drawn: 1 picture in an unsupported format or at an unsupported address, the extension \
                 {extension}{remedy}"
            );
            assert_eq!([remark(0), remark(1)], [sentence.clone(), sentence]);
        }
        for extension in ["XX_of_mine", "EXT_structural_metadata", "MSFT_lod"] {
            let mut file = triangle();
            file["extensionsRequired"] = json!([extension]);
            let sentence =
                format!("t.gltf: it needs the extension {extension}, which tinta does not read; export it without");
            assert!(problem(&file).starts_with(&sentence), "{}", problem(&file));
        }
    }
}
