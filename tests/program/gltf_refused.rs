//! glTF files that are refused, or need permission to be read, each with a sentence that gives the remedy.

use crate::program::{assert_refused, one_line, tinta};
use crate::support::Folder;
use crate::support::gltf_files::*;
use serde_json::{Value, json};
use tinta::mesh::read_bytes;
use tinta::{LoadOptions, load};

#[test]
fn data_and_pictures_outside_the_models_folder_are_followed_only_when_asked_to() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("model")).unwrap();
    let mut file = box_file();
    file.push("images", json!({"uri": "../skin.png"}));
    file.push("textures", json!({"source": 0}));
    file.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    folder.file("box.bin", &file.data);
    folder.file("skin.png", &picture());
    let absolute = folder.path("box.bin");
    for uri in ["../box.bin", "..%2Fbox.bin", &absolute] {
        let model = folder.file("model/box.gltf", &file.with_buffer(Some(uri)));
        assert_refused(
            &tinta(&["info", &model]),
            &["box.gltf: the data file", "outside its folder", "--allow-external"],
        );
        let output = tinta(&["info", &model, "--allow-external"]);
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()), "{uri}");
    }
    let loaded = load(&folder.file("model/box.glb", &file.binary()), &LoadOptions::default()).unwrap();
    assert!(!loaded.mesh.materials[0].has_texture());
    one_line(&format!("{}\n", loaded.remarks.join(" ")), &["the picture ../skin.png is outside", "--allow-external"]);
    for (uri, sentence) in [
        ("https://example.org/box.bin", "it refers to https://example.org/box.bin, but only files are read"),
        ("file:///etc/passwd", "only files are read"),
        ("no-such.bin", "its data file no-such.bin is missing"),
        ("data:;base64,!!!!", "broken base64"),
    ] {
        assert_refused(&tinta(&["info", &folder.file("model/box.gltf", &file.with_buffer(Some(uri)))]), &[sentence]);
    }
    // From memory no file is read at all.
    let bytes = file.with_buffer(Some(&absolute));
    let message = read_bytes(&bytes, "m.gltf", &[], &LoadOptions { allow_external: true, ..LoadOptions::default() });
    assert!(message.unwrap_err().to_string().contains("which is not read; give both files or a GLB"));
}

#[test]
fn extensions_that_are_needed_and_not_read_are_named_with_what_to_do() {
    let folder = Folder::new();
    for (extension, remedy) in [
        ("KHR_draco_mesh_compression", "gltf-transform copy"),
        ("EXT_meshopt_compression", "gltf-transform copy"),
        ("XX_of_mine", "export it without"),
    ] {
        let mut file = box_file();
        file.json["extensionsRequired"] = json!(["KHR_materials_unlit", extension]);
        let model = folder.file("box.glb", &file.binary());
        assert_refused(&tinta(&["info", &model]), &["box.glb: it needs the extension", extension, remedy]);
    }
    let mut file = box_file();
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit", "XX_of_mine"]);
    file.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}));
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(0);
    let said = file.load().unwrap().remarks;
    assert_eq!(said, ["file.gltf: not drawn: 1 camera, the extension XX_of_mine"]);
}

#[test]
fn the_first_version_is_named_with_what_to_do_however_it_says_so() {
    let problem = |file: Value| {
        let bytes = serde_json::to_vec(&file).unwrap();
        read_bytes(&bytes, "truck.gltf", &[], &LoadOptions::default()).map(|_| ()).unwrap_err().to_string()
    };
    let remedy = "and only glTF 2 is read; convert it, for instance with: gltf-pipeline -i IN.gltf -o OUT.glb";
    let (accessors, meshes) = (json!({"accessor_21": {"count": 3}}), json!({"Geometry-mesh002": {"primitives": []}}));
    for asset in [
        json!({"version": "1.0", "profile": {"api": "WebGL", "version": "1.0"}, "premultipliedAlpha": true}),
        json!({"version": 1.0}),
        json!({"generator": "collada2gltf"}),
        json!(null),
    ] {
        let file = json!({"asset": asset, "accessors": accessors, "meshes": meshes, "nodes": {}});
        assert_eq!(problem(file), format!("truck.gltf: it is glTF 1.0, {remedy}"));
    }
    let version = |version: Value| problem(json!({"asset": {"version": version}, "meshes": []}));
    assert_eq!(version(json!("1.1")), format!("truck.gltf: it is glTF 1.1, {remedy}"));
    assert!(version(json!("3.0")).ends_with("it is glTF 3.0, and only glTF 2 is read; export it as glTF 2"));
    let damaged = problem(json!({"asset": {"version": "2.0"}, "accessors": accessors}));
    assert!(damaged.contains("its JSON is not valid glTF"), "{damaged}");
}

#[test]
fn files_that_lie_about_themselves_are_refused_in_a_sentence() {
    let change = |pointer: &str, value: Value, sentence: &str| {
        let mut file = box_file();
        file.push("scenes", json!({"nodes": [0]}));
        file.push("skins", json!({"joints": [0]}));
        file.json["nodes"][0]["skin"] = json!(0);
        file.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
        file.push("textures", json!({"source": 0}));
        file.push("images", json!({"uri": "a.png"}));
        // What no primitive has refuses nothing.
        file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        file.json.pointer_mut(parent).unwrap()[key] = value;
        let message = file.problem();
        assert!(message.starts_with("file.gltf: ") && message.contains(sentence), "{pointer}: {message}");
        assert!(message.len() < 300 && !message.contains('\n'), "{message}");
    };
    let huge = json!(u64::MAX);
    change(
        "/asset/version",
        json!("1.0"),
        "it is glTF 1.0, and only glTF 2 is read; convert it, for instance with: gltf-pipeline",
    );
    change("/meshes/0/primitives/0/mode", json!(99), "primitives of an unknown kind");
    change("/meshes/0/primitives/0/material", json!(7), "materials that do not exist");
    change("/meshes/0/primitives/0/indices", json!(99), "its accessor 99 does not exist");
    change("/meshes/0/primitives/0/attributes", json!({"NORMAL": 1}), "primitives without positions");
    change("/meshes/0/primitives/0/attributes/NORMAL", json!(3), "numbers per element where 3 are needed");
    change("/accessors/0/count", huge.clone(), "take more than 20 times");
    change("/accessors/0/count", json!(25), "its accessor 0 reaches beyond its buffer view");
    change("/accessors/1/count", json!(23), "has 23 elements where 24 are needed");
    change("/accessors/0/byteOffset", huge.clone(), "its accessor 0 reaches beyond");
    change("/accessors/0/componentType", json!(1), "its accessor 0 has an unknown type");
    change("/accessors/0/type", json!("VEC9"), "its accessor 0 has an unknown type");
    change("/accessors/3/count", huge.clone(), "take more than 20 times");
    change("/bufferViews/0/byteLength", huge.clone(), "its buffer view 0 reaches beyond");
    change("/bufferViews/0/byteOffset", huge.clone(), "its buffer view 0 reaches beyond");
    change("/bufferViews/0/byteStride", json!(11), "its accessor 0 reaches beyond");
    change("/bufferViews/0/byteStride", huge, "its accessor 0 reaches beyond");
    change("/bufferViews/0/buffer", json!(9), "its buffer 9 does not exist");
    change("/nodes/0/mesh", json!(9), "its mesh 9 does not exist");
    change("/nodes/0/children", json!([0]), "form a cycle");
    change("/nodes/0/children", json!([9]), "its node 9 does not exist");
    change("/nodes", json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]), "its node 2 has two parents");
    change("/nodes", json!([{"mesh": 0}, {"children": [2]}, {"children": [1]}]), "form a cycle");
    change("/nodes/0/skin", json!(9), "its skin 9 does not exist");
    change("/skins/0/joints", json!([9]), "its node 9 does not exist");
    change("/scene", json!(9), "its scene 9 does not exist");
    change("/scenes/0/nodes", json!([9]), "its node 9 does not exist");
    change("/textures/0/source", json!(9), "its picture 9 does not exist");
    change("/images", json!([{}]), "its picture 0 is neither in it nor beside it");
    change("/materials/0/pbrMetallicRoughness/baseColorTexture/index", json!(9), "its texture 9 does not exist");
    change("/meshes", json!("none"), "its JSON is not valid glTF");
    change("/nodes", json!([]), "its node 0 does not exist");
    change("/scenes/0/nodes", json!([]), "its scene does not show its mesh; export it with a node that does");
    change("/scenes", json!([{"name": "empty"}]), "its scene does not show its mesh; export it with a node that does");
}

#[test]
fn glb_that_is_cut_off_anywhere_or_lies_about_its_length_is_refused() {
    let whole = box_file().binary();
    let message = |bytes: &[u8]| {
        let read = read_bytes(bytes, "cut.glb", &[], &LoadOptions::default());
        read.map(|loaded| loaded.mesh.triangles.len()).unwrap_err().to_string()
    };
    for length in (4..whole.len()).step_by(13) {
        let message = message(&whole[..length]);
        assert!(message.starts_with("cut.glb: its header") && !message.contains('\n'), "{length}: {message}");
    }
    let with = |place: usize, number: u32| {
        let mut bytes = whole.clone();
        bytes[place..place + 4].copy_from_slice(&number.to_le_bytes());
        message(&bytes)
    };
    assert!(with(4, 1).contains("it is glTF 1.0, and only glTF 2 is read"));
    assert!(with(4, 3).contains("it is GLB version 3; only version 2 is read"));
    for length in [0, 11, u32::MAX] {
        assert!(with(8, length).contains(&format!("its header promises {length} bytes")), "{length}");
    }
    assert!(with(12, u32::MAX).contains("chunks is cut off"));
    assert!(with(16, 7).contains("no chunk of JSON"));
}

#[test]
fn nodes_that_repeat_a_mesh_beyond_reason_and_trees_beyond_depth_are_refused_at_once() {
    // Each of 30,000 nodes shows 3,000 boxes: more triangles than are counted, out of a megabyte.
    let mut file = File::new();
    let mesh = add_box(&mut file);
    file.json["nodes"] = Value::Array(vec![json!({"mesh": mesh}); 30_000]);
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    *primitives = vec![primitives[0].clone(); 3000];
    let message = file.problem();
    assert!(message.contains("its nodes draw 720000 vertices and 1080000000 triangles, of which at most"), "{message}");

    let mut file = File::new();
    let mesh = add_box(&mut file);
    let mut nodes: Vec<Value> = (1..5000).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": mesh}));
    file.json["nodes"] = Value::Array(nodes);
    assert!(file.problem().contains("more than 4096 levels deep"));

    // Two bytes an object: refused before they are read.
    let many = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", "{},".repeat(200_000));
    let message = read_bytes(many.as_bytes(), "many.gltf", &[], &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("holds 200003 objects"), "{message}");
}
