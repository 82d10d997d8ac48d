//! Every way to store a box in glTF, and the expected mesh of each, worked out by hand.

use crate::support::gltf_files::*;
use crate::support::{Folder, public_models, renderer, scene_of_mesh, skip};
use glam::{DVec2, DVec3, dvec3};
use serde_json::{Value, json};
use std::sync::Arc;
use tinta::mesh::{LoadedModel, NONE};
use tinta::scene::Surface;
use tinta::{Backend, CameraSettings, LoadOptions, Mesh, Scene, SceneSettings, Size, Style, StyleName, load};

#[test]
fn the_same_box_comes_out_of_json_with_a_file_or_with_its_data_and_out_of_glb() {
    let (file, folder) = (box_file(), Folder::new());
    folder.file("a box.bin", &file.data);
    let beside = folder.file("box.gltf", &file.with_buffer(Some("a%20box.bin")));
    let loaded = load(&beside, &LoadOptions::default()).unwrap();
    assert_eq!(loaded.files, [std::path::PathBuf::from(folder.path("a box.bin"))]);
    let binary = load(&folder.file("box.glb", &file.binary()), &LoadOptions::default()).unwrap();
    let text = load(&folder.file("text.gltf", &file.text()), &LoadOptions::default()).unwrap();
    for LoadedModel { mesh, remarks, .. } in [&loaded, &binary, &text] {
        assert_eq!((mesh.positions.len(), mesh.triangles.len(), mesh.normals.len()), (8, 12, 24));
        assert!(mesh.positions.iter().all(|position| position.abs() == DVec3::ONE));
        assert_eq!(volume(mesh), 8.0);
        assert!(mesh.defects.is_empty() && remarks.is_empty(), "{remarks:?}");
        assert!(mesh.triangle_texture_coordinates.as_flattened().iter().all(|index| *index != NONE));
        assert_eq!(Mesh { name: String::new(), ..mesh.clone() }, Mesh { name: String::new(), ..text.mesh.clone() });
    }
    // The first corner of the first side is at the lower left of its picture.
    let first = text.mesh.triangle_texture_coordinates[0][0] as usize;
    assert_eq!(text.mesh.texture_coordinates[first].to_array(), [0.0, 0.0]);
}

/// The box as OBJ, with this material file.
fn box_obj() -> String {
    let mut text = "mtllib box.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n".to_owned();
    for (normal, corners) in sides() {
        corners.iter().for_each(|corner| text.push_str(&format!("v {} {} {}\n", corner.x, corner.y, corner.z)));
        text.push_str(&format!("vn {} {} {}\n", normal.x, normal.y, normal.z));
    }
    text.push_str("usemtl a\n");
    for side in 0..6 {
        for [a, b, c] in [[1, 2, 3], [1, 3, 4]] {
            let corner = |corner: i32| format!("{}/{corner}/{}", side * 4 + corner, side + 1);
            text.push_str(&format!("f {} {} {}\n", corner(a), corner(b), corner(c)));
        }
    }
    text
}

#[test]
fn a_box_draws_the_same_picture_as_the_same_box_in_obj() {
    let folder = Folder::new();
    folder.file("skin.png", &picture());
    folder.file("box.mtl", b"newmtl a\nKd 0.5 0.25 1\nmap_Kd skin.png\n");
    let obj = load(&folder.file("box.obj", box_obj().as_bytes()), &LoadOptions::default()).unwrap().mesh;
    // The screen's values for these shares; the light is less.
    let linear = |share: f64| ((share + 0.055) / 1.055).powf(2.4);
    let mut renderer = renderer(Backend::Auto);
    let mut seen = Vec::new();
    for is_embedded in [false, true] {
        let mut file = box_file();
        let image = match is_embedded {
            false => json!({"uri": "skin.png"}),
            true => {
                let view = file.view(&picture());
                json!({"bufferView": view, "mimeType": "image/png"})
            }
        };
        file.push("images", image);
        file.push("textures", json!({"source": 0}));
        file.push(
            "materials",
            json!({"pbrMetallicRoughness": {
            "baseColorFactor": [linear(0.5), linear(0.25), 1, 1], "baseColorTexture": {"index": 0}}}),
        );
        file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let gltf = load(&folder.file("box.glb", &file.binary()), &LoadOptions::default()).unwrap().mesh;
        assert!(gltf.materials[0].has_texture());
        let color = gltf.materials[0].color.unwrap();
        assert!(color.iter().zip([0.5, 0.25, 1.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{color:?}");
        let mut inking = Style::named(StyleName::Inking);
        if let Style::Inking(inking) = &mut inking {
            inking.has_texture = true;
        }
        let styles = [Style::named(StyleName::ThreePass), Style::named(StyleName::Phong), inking];
        for style in &styles {
            let mut draw = |mesh: &Mesh| renderer.render(&scene_of_mesh(mesh.clone()), style).unwrap();
            let (from_obj, from_gltf) = (draw(&obj), draw(&gltf));
            assert_eq!(from_obj.difference(&from_gltf).unwrap().pixels, 0, "{style:?}");
            seen.push(from_obj);
        }
    }
    assert!(seen[0].difference(&seen[2]).unwrap().pixels > 1000, "styles draw differently");
}

#[test]
fn what_other_programs_write_against_the_standard_does_no_harm() {
    let whole = box_file().mesh();
    let changed = |change: &dyn Fn(&mut File)| {
        let mut file = box_file();
        change(&mut file);
        file.load().unwrap()
    };
    let no_stride = changed(&|file| file.json["bufferViews"][0]["byteStride"] = json!(0));
    assert_eq!(no_stride.mesh.positions, whole.positions);
    let other_scene = changed(&|file| {
        file.push("scenes", json!({"name": "empty"}));
        file.push("scenes", json!({"nodes": [0]}));
        file.json["scene"] = json!(1);
    });
    assert_eq!(other_scene.mesh.positions, whole.positions);
    let techniques = changed(&|file| {
        for list in ["extensionsUsed", "extensionsRequired"] {
            file.push(list, json!("KHR_techniques_webgl"));
        }
    });
    assert_eq!(techniques.mesh.positions, whole.positions);
    assert_eq!(techniques.remarks, ["file.gltf: not drawn: the extension KHR_techniques_webgl"]);
}

#[test]
fn a_picture_is_multiplied_with_the_base_colour_and_white_where_its_alpha_leaves_it_out() {
    let folder = Folder::new();
    let texels = [[128, 128, 128, 255], [255, 255, 255, 255], [0, 0, 0, 0], [0, 0, 0, 255]];
    // Quarters of many texels, as their borders are mixed.
    let quarter = |x: u32, y: u32| image::Rgba(texels[(y / 8 * 2 + x / 8) as usize]);
    let skin = image::RgbaImage::from_fn(16, 16, quarter);
    skin.save(folder.path("skin.png")).unwrap();
    let mut renderer = renderer(Backend::Auto);
    let mut at_quarters = |alpha: &str, share: f64| {
        let mut file = File::new();
        let positions = file.floats("VEC3", &[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0]);
        let coordinates = file.floats("VEC2", SQUARE.as_flattened());
        let indices = file.shorts(&[0, 1, 2, 0, 2, 3]);
        let more = json!({"attributes": {"TEXCOORD_0": coordinates}, "indices": indices, "material": 0});
        square_file(positions, more, &mut file);
        file.push("images", json!({"uri": "skin.png"}));
        file.push("textures", json!({"source": 0}));
        let metal = json!({"baseColorFactor": [1, 0, 0, share], "baseColorTexture": {"index": 0}});
        file.push("materials", json!({"pbrMetallicRoughness": metal, "alphaMode": alpha}));
        let mesh = load(&folder.file("square.gltf", &file.text()), &LoadOptions::default()).unwrap().mesh;
        let view = "front".parse().unwrap();
        let camera = CameraSettings { view, ..CameraSettings::default() };
        let settings = SceneSettings { camera, surface: Surface::Textured, ..SceneSettings::default() };
        let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
        let picture = renderer.render(&scene, &Style::named(StyleName::Ink)).unwrap();
        let Size { width, height } = picture.size;
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[x, y]: [u32; 2]| {
            let at = |place: u32, side: u32| side / 2 - side / 8 + place * side / 4;
            let pixel = &picture.pixels[((at(y, height) * width + at(x, width)) * 4) as usize..][..4];
            [pixel[0], pixel[1], pixel[2]]
        })
    };
    for (alpha, hidden) in [("OPAQUE", 0.0), ("MASK", 1.0), ("BLEND", 1.0)] {
        let [half, whole, left_out, black] = at_quarters(alpha, 1.0);
        let red = f64::from(whole[0]);
        assert!(red > 100.0 && whole[1] < 80 && whole[2] < 80, "{alpha}: {whole:?}");
        assert!((f64::from(half[0]) / red - 128.0 / 255.0).abs() < 0.02, "{alpha}: {half:?} of {whole:?}");
        assert!((f64::from(left_out[0]) / red - hidden).abs() < 0.02, "{alpha}: {left_out:?} of {whole:?}");
        assert!(black[0] < 5, "{alpha}: {black:?}");
    }
    // The factor's alpha, too.
    let red = f64::from(at_quarters("OPAQUE", 1.0)[1][0]);
    for (alpha, share) in [("MASK", 0.3), ("BLEND", 0.0)] {
        let all = at_quarters(alpha, share);
        assert!(all.as_flattened().iter().all(|it| (f64::from(*it) / red - 1.0).abs() < 0.02), "{alpha}: {all:?}");
    }
    assert_eq!(at_quarters("MASK", 0.6), at_quarters("MASK", 1.0), "above the cutoff");
    let [_, whole, left_out, black] = at_quarters("BLEND", 0.5).map(|pixel| pixel.map(|it| f64::from(it) / red));
    assert!((whole[0] - 1.0).abs() < 0.02 && (whole[1] - 0.5).abs() < 0.02, "{whole:?}");
    assert!(left_out.iter().all(|it| (it - 1.0).abs() < 0.02), "{left_out:?}");
    assert!(black.iter().all(|it| (it - 0.5).abs() < 0.02), "{black:?}");
}

#[test]
fn nodes_move_turn_scale_and_mirror_what_is_below_them() {
    let half = 0.5f64.sqrt();
    // Child: moved by 3 along x. Parent: twice as long along x, then a quarter turn about z, then moved by (0, 0, 5).
    let matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1];
    for (mirror, sign) in [(1.0, 1.0), (-1.0, -1.0)] {
        let mut file = File::new();
        let mesh = add_box(&mut file);
        file.push(
            "nodes",
            json!({"children": [1], "scale": [2.0 * mirror, 1, 1], "rotation": [0, 0, half, half],
            "translation": [0, 0, 5]}),
        );
        file.push("nodes", json!({"mesh": mesh, "matrix": matrix}));
        // Not in the scene.
        file.push("nodes", json!({"mesh": mesh, "translation": [100, 0, 0]}));
        file.push("scenes", json!({"nodes": [2]}));
        file.push("scenes", json!({"nodes": [0]}));
        file.json["scene"] = json!(1);
        let LoadedModel { mesh, remarks, .. } = file.load().unwrap();
        assert_eq!(remarks, ["file.gltf: not drawn: 1 other scene"]);
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12));
        // (x, y, z) goes to (-y, 2 (x + 3), z + 5), with the mirror to (-y, -2 (x + 3), z + 5).
        for x in [-1.0, 1.0] {
            for y in [-1.0, 1.0] {
                assert!(has(&mesh, dvec3(-y, sign * 2.0 * (x + 3.0), 6.0)), "{x} {y}: {:?}", mesh.positions);
            }
        }
        assert!((volume(&mesh) - 16.0).abs() < 1e-5, "{sign}: faces look outwards: {}", volume(&mesh));
        for (triangle, normals) in mesh.triangles.iter().zip(&mesh.triangle_normals) {
            let [a, b, c] = triangle.map(|index| mesh.positions[index as usize]);
            let normal = mesh.normals[normals[0] as usize].as_dvec3();
            assert!((b - a).cross(c - a).normalize().distance(normal) < 1e-6, "{sign}: {normal}");
        }
    }
}

#[test]
fn one_mesh_in_several_nodes_is_drawn_in_each() {
    let mut file = File::new();
    let mesh = add_box(&mut file);
    for x in 0..5 {
        file.push("nodes", json!({"mesh": mesh, "translation": [x * 4, 0, 0]}));
    }
    let mesh = file.mesh();
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (40, 60));
    assert!((volume(&mesh) - 40.0).abs() < 1e-9);
}

#[test]
fn triangles_strips_and_fans_of_indices_of_every_size_or_of_none() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
    let points = |order: [usize; 4]| flat(order.map(|corner| corners[corner]));
    let area = |mesh: &Mesh| -> f64 {
        let corners = mesh.triangles.iter().map(|corners| corners.map(|index| mesh.positions[index as usize]));
        corners.map(|[a, b, c]| (b - a).cross(c - a).z / 2.0).sum()
    };
    let cases: [(u32, [usize; 4], &[u8], u32); 6] = [
        (4, [0, 1, 2, 3], &[0, 1, 2, 0, 2, 3], 1),
        (4, [0, 1, 2, 3], &[0, 1, 2, 0, 2, 3], 2),
        (4, [0, 1, 2, 3], &[0, 1, 2, 0, 2, 3], 4),
        (5, [0, 1, 3, 2], &[], 0),
        // A strip with two degenerate triangles, and a fan.
        (5, [0, 1, 3, 2], &[0, 0, 0, 1, 3, 2], 1),
        (6, [0, 1, 2, 3], &[1, 2, 3, 0], 1),
    ];
    for (mode, order, indices, size) in cases {
        let mut file = File::new();
        let positions = file.floats("VEC3", &points(order));
        let mut primitive = json!({"mode": mode});
        if size > 0 {
            let order = if mode == 5 { vec![0, 0, 0, 1, 2, 3] } else { indices.to_vec() };
            let bytes: Vec<u8> = order.iter().flat_map(|index| [*index, 0, 0, 0][..size as usize].to_vec()).collect();
            let component = [0, 5121, 5123, 0, 5125][size as usize];
            primitive["indices"] = json!(file.accessor(&bytes, component, "SCALAR", order.len()));
        }
        square_file(positions, primitive, &mut file);
        let mesh = file.mesh();
        assert_eq!((mesh.triangles.len(), area(&mesh)), (2, 1.0), "mode {mode}, {size} bytes");
        assert!(mesh.defects.is_empty(), "{}", mesh.defects);
    }
    // Points and lines beside it are read.
    let mut file = box_file();
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    for mode in 0..4 {
        primitives.push(json!({"attributes": {"POSITION": 0, "COLOR_0": 0}, "mode": mode}));
    }
    let loaded = file.load().unwrap();
    assert_eq!(loaded.mesh.triangles.len(), 12);
    let vertices = loaded.mesh.curves.positions.len();
    let counts = [loaded.mesh.curves.points.len(), loaded.mesh.curves.segments.len()];
    assert_eq!(counts, [vertices, vertices / 2 + vertices + vertices - 1], "points; lines, a loop, a strip");
    assert!(loaded.remarks.is_empty(), "{:?}", loaded.remarks);
}

#[test]
fn sparse_strided_and_quantised_positions_come_out_where_they_should() {
    let square = [DVec3::ZERO, DVec3::X, DVec3::Y];
    // Sparse over nothing: zeros except two of three.
    let mut file = File::new();
    let (places, values) = (file.view(&[1, 0, 2, 0]), file.view(&bytes_of(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0])));
    let sparse =
        json!({"count": 2, "indices": {"bufferView": places, "componentType": 5123}, "values": {"bufferView": values}});
    let positions =
        file.push("accessors", json!({"componentType": 5126, "type": "VEC3", "count": 3, "sparse": sparse}));
    square_file(positions, json!({}), &mut file);
    assert_eq!(file.mesh().positions, square);
    // Sparse over something, where the third is replaced.
    let mut file = File::new();
    let (places, values) = (file.view(&[2]), file.view(&bytes_of(&[0.0, 1.0, 0.0])));
    let positions = file.floats("VEC3", &flat([DVec3::ZERO, DVec3::X, DVec3::splat(7.0)]));
    file.json["accessors"][positions]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": places, "componentType": 5121}, "values": {"bufferView": values}});
    square_file(positions, json!({}), &mut file);
    assert_eq!(file.mesh().positions, square);
    // Interleaved with normals, 24 bytes a vertex; the last ends with the view.
    let mut file = File::new();
    let rows: Vec<f32> = square.iter().flat_map(|point| flat([*point, DVec3::Z])).collect();
    let view = file.view(&bytes_of(&rows));
    file.json["bufferViews"][view]["byteStride"] = json!(24);
    let accessor = |offset: u32| json!({"bufferView": view, "byteOffset": offset, "componentType": 5126, "type": "VEC3", "count": 3});
    let positions = file.push("accessors", accessor(0));
    let normals = file.push("accessors", accessor(12));
    square_file(positions, json!({"attributes": {"NORMAL": normals}}), &mut file);
    let mesh = file.mesh();
    assert_eq!((mesh.positions, mesh.normals.len(), mesh.normals[0].z), (square.to_vec(), 3, 1.0));
    // KHR_mesh_quantization: shares of 32767 in shorts with a padding, made larger by the node.
    let mut file = File::new();
    let shorts = [[0i16, 0, 0, 9], [32767, 0, 0, 9], [0, -32768, 0, 9]];
    let view = file.view(&shorts.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>());
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    let accessor = json!({"bufferView": view, "componentType": 5122, "normalized": true, "type": "VEC3", "count": 3});
    let positions = file.push("accessors", accessor);
    square_file(positions, json!({}), &mut file);
    file.json["nodes"][0]["scale"] = json!([4, 4, 4]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_eq!(file.mesh().positions, [DVec3::ZERO, DVec3::X * 4.0, DVec3::NEG_Y * 4.0]);
}

#[test]
fn skins_stand_in_their_joints_and_morphs_as_far_as_their_weights_say() {
    let mut file = File::new();
    let positions = file.floats("VEC3", &flat([DVec3::ZERO, DVec3::X, DVec3::Y]));
    let joints = file.accessor(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], 5121, "VEC4", 3);
    // The third vertex follows both, one three times as much as the other.
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.25, 0.75, 0.0, 0.0]);
    square_file(positions, json!({"attributes": {"JOINTS_0": joints, "WEIGHTS_0": weights}}), &mut file);
    // The mesh node's transform does not count; the joints lie at (0, 0, 8) and (0, 4, 8), bound at (0, 0, 0) and (0, 4, 0).
    file.json["nodes"][0]["translation"] = json!([100, 100, 100]);
    file.json["nodes"][0]["skin"] = json!(0);
    file.push("nodes", json!({"children": [2], "translation": [0, 0, 8]}));
    file.push("nodes", json!({"translation": [0, 4, 0], "scale": [3, 3, 3]}));
    let unbound = |y: f32| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -y, 0.0, 1.0];
    let bound = file.floats("MAT4", [unbound(0.0), unbound(4.0)].as_flattened());
    file.push("skins", json!({"joints": [1, 2], "inverseBindMatrices": bound}));
    // Joint 1 keeps (x, y, z + 8); joint 2 makes (3x, 3 (y - 4) + 4, 3z + 8).
    let third = dvec3(0.0, 0.25 + 0.75 * -5.0, 8.0);
    assert_eq!(file.mesh().positions, [dvec3(0.0, 0.0, 8.0), dvec3(3.0, -8.0, 8.0), third]);

    let mut file = File::new();
    let positions = file.floats("VEC3", &flat([DVec3::ZERO, DVec3::X, DVec3::Y]));
    let targets = [DVec3::Z * 4.0, DVec3::X].map(|step| file.floats("VEC3", &flat([step; 3])));
    let targets = json!([{"POSITION": targets[0]}, {"POSITION": targets[1]}]);
    square_file(positions, json!({"targets": targets}), &mut file);
    assert_eq!(file.mesh().positions[0], DVec3::ZERO);
    file.json["meshes"][0]["weights"] = json!([0.25, 0]);
    assert_eq!(file.mesh().positions, [DVec3::Z, dvec3(1.0, 0.0, 1.0), dvec3(0.0, 1.0, 1.0)]);
    file.json["nodes"][0]["weights"] = json!([0.5, 2]);
    file.push("animations", json!({"channels": [], "samplers": []}));
    let loaded = file.load().unwrap();
    assert_eq!(loaded.mesh.positions[0], dvec3(2.0, 0.0, 2.0));
    assert_eq!(loaded.remarks, ["file.gltf: not drawn: 1 animation (drawn in its rest pose)"]);
}

#[test]
fn texture_coordinates_are_those_that_the_material_names_and_are_moved_as_it_says() {
    let mut file = box_file();
    let second = file.floats("VEC2", &[0.25f32, 0.5].repeat(24));
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(second);
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    file.push("images", json!({"uri": "skin.png"}));
    file.push("textures", json!({"source": 0}));
    let mut texture = |info: Value| {
        file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": info}}]);
        let mesh = file.mesh();
        mesh.texture_coordinates[mesh.triangle_texture_coordinates[0][0] as usize].as_dvec2()
    };
    let near = |a: DVec2, b: [f64; 2]| assert!(a.distance(b.into()) < 1e-6, "{a} {b:?}");
    near(texture(json!({"index": 0})), [0.0, 0.0]);
    near(texture(json!({"index": 0, "texCoord": 1})), [0.25, 0.5]);
    let with = |transform: Value| json!({"index": 0, "extensions": {"KHR_texture_transform": transform}});
    near(texture(with(json!({"texCoord": 1}))), [0.25, 0.5]);
    // (0.25, 0.5) scaled to (0.5, 2), moved to (0.6, 2.2); v counts downwards in the file.
    near(texture(with(json!({"texCoord": 1, "scale": [2, 4], "offset": [0.1, 0.2]}))), [0.6, 1.0 - 2.2]);
    // A quarter turn counter-clockwise takes u upwards, which is -v there: (u, v) to (v, -u).
    let quarter = std::f64::consts::FRAC_PI_2;
    near(texture(with(json!({"texCoord": 1, "rotation": quarter}))), [0.5, 1.25]);
}

#[test]
fn public_models_in_gltf_are_read_where_there_are_any() {
    let Some(folder) = public_models() else { return };
    let mut waiting = vec![folder];
    let mut found = 0;
    while let Some(folder) = waiting.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
            if path.is_dir() {
                waiting.push(path);
            } else if ["gltf", "glb"].contains(&extension) {
                let loaded = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap();
                assert!(!loaded.mesh.triangles.is_empty(), "{}", path.display());
                found += 1;
            }
        }
    }
    if found == 0 {
        skip("public models in glTF: there is none among them");
    }
}

#[test]
fn a_camera_has_no_size() {
    let camera = |above: serde_json::Value, own: serde_json::Value| {
        let mut file = box_file();
        file.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 0.7, "znear": 1}}));
        let place = json!({"translation": [1, 2, 3], "rotation": [0.0, 0.6, 0.0, 0.8]});
        let mut merged = |extra: serde_json::Value, more: serde_json::Value| {
            let mut node = place.as_object().unwrap().clone();
            node.extend(extra.as_object().unwrap().clone());
            node.extend(more.as_object().unwrap().clone());
            file.push("nodes", node.into())
        };
        let child = merged(own, json!({"camera": 0}));
        let top = merged(above, json!({"children": [child]}));
        file.push("scenes", json!({"nodes": [top]}));
        tinta::mesh::gltf_camera(file.text().as_ref()).unwrap().unwrap()
    };
    let plain = camera(json!({}), json!({}));
    for scale in [[1.0, 1.0, -1.0], [-1.0, -1.0, -1.0], [1.0, -1.0, 1.0], [5.0, 0.1, 2.0], [0.0, 0.0, 0.0]] {
        assert_eq!(camera(json!({}), json!({"scale": scale})), plain, "{scale:?}");
    }
    // A node above moves it.
    let moved = camera(json!({"scale": [2.0, 2.0, 2.0]}), json!({}));
    assert_ne!(moved.0.eye, plain.0.eye);
    assert_eq!(moved.0.up, plain.0.up);
}
