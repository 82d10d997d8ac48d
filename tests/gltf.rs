//! glTF files written here: every way to store a box, and what a reader must make of each, worked out by hand.

use crate::cli::{Folder, tinta};
use crate::hostile::{one_line, refused, scene};
use crate::support::{public_models, renderer, skip};
use base64::Engine;
use glam::{DVec2, DVec3, dvec3};
use serde_json::{Value, json};
use tinta::mesh::{Loaded, NONE, read_bytes};
use tinta::{Backend, LoadOptions, Mesh, Result, Style, StyleName, load};

/// A glTF file as it grows.
struct File {
    json: Value,
    data: Vec<u8>,
}

impl File {
    fn new() -> Self {
        Self { json: json!({"asset": {"version": "2.0"}}), data: Vec::new() }
    }

    /// Adds to one of the file's lists and returns the place in it.
    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        let start = self.data.len();
        self.data.extend(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()}))
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": component, "type": kind, "count": count}))
    }

    fn floats(&mut self, kind: &str, numbers: &[f32]) -> usize {
        let size = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(&bytes_of(numbers), 5126, kind, numbers.len() / size)
    }

    fn shorts(&mut self, numbers: &[u16]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, "SCALAR", numbers.len())
    }

    /// The file's buffer with this address, or as GLB has it.
    fn with_buffer(&self, uri: Option<&str>) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = match uri {
            Some(uri) => json!([{"byteLength": self.data.len(), "uri": uri}]),
            None => json!([{"byteLength": self.data.len()}]),
        };
        serde_json::to_vec(&json).unwrap()
    }

    fn text(&self) -> Vec<u8> {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.data);
        self.with_buffer(Some(&format!("data:application/octet-stream;base64,{data}")))
    }

    fn binary(&self) -> Vec<u8> {
        glb(self.with_buffer(None), &self.data)
    }

    fn load(&self) -> Result<Loaded> {
        read_bytes(&self.text(), "file.gltf", b"", &LoadOptions::default())
    }

    fn mesh(&self) -> Mesh {
        self.load().unwrap().mesh
    }

    fn problem(&self) -> String {
        self.load().map(|loaded| loaded.mesh.positions.len()).unwrap_err().to_string()
    }
}

fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

fn glb(mut json: Vec<u8>, data: &[u8]) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut data = data.to_vec();
    data.resize(data.len().next_multiple_of(4), 0);
    let word = |number: usize| (number as u32).to_le_bytes();
    let header = [b"glTF".as_slice(), &word(2), &word(12 + 8 + json.len() + 8 + data.len())].concat();
    [header.as_slice(), &word(json.len()), b"JSON", &json, &word(data.len()), b"BIN\0", &data].concat()
}

/// The six sides of the box from -1 to 1: normals and corners, counter-clockwise from outside.
fn sides() -> Vec<(DVec3, [DVec3; 4])> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let side = |(axis, sign): (usize, f64)| {
        let normal = axes[axis] * sign;
        let (u, v) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3] * sign);
        (normal, [normal - u - v, normal + u - v, normal + u + v, normal - u + v])
    };
    (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]).map(side).collect()
}

const SQUARE: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

fn flat(points: impl IntoIterator<Item = DVec3>) -> Vec<f32> {
    points.into_iter().flat_map(|point| point.as_vec3().to_array()).collect()
}

/// The mesh of the box with normals and texture coordinates, in no node yet.
fn add_box(file: &mut File) -> usize {
    let positions = flat(sides().into_iter().flat_map(|(_, corners)| corners));
    let normals = flat(sides().into_iter().flat_map(|(normal, _)| [normal; 4]));
    let indices: Vec<u16> = (0..6).flat_map(|side| [0, 1, 2, 0, 2, 3].map(|corner| side * 4 + corner)).collect();
    let [position, normal] = [&positions, &normals].map(|numbers| file.floats("VEC3", numbers));
    let coordinate = file.floats("VEC2", SQUARE.repeat(6).as_flattened());
    let indices = file.shorts(&indices);
    let attributes = json!({"POSITION": position, "NORMAL": normal, "TEXCOORD_0": coordinate});
    file.push("meshes", json!({"primitives": [{"attributes": attributes, "indices": indices}]}))
}

fn box_file() -> File {
    let mut file = File::new();
    let mesh = add_box(&mut file);
    file.push("nodes", json!({"mesh": mesh}));
    file
}

/// A square in z = 0 with these attributes besides and this in its primitive.
fn square_file(positions: usize, more: Value, file: &mut File) {
    let mut primitive = json!({"attributes": {"POSITION": positions}});
    more.as_object().unwrap().iter().for_each(|(key, value)| match key.as_str() {
        "attributes" => {
            value.as_object().unwrap().iter().for_each(|(name, value)| primitive["attributes"][name] = value.clone());
        }
        _ => primitive[key] = value.clone(),
    });
    let mesh = file.push("meshes", json!({"primitives": [primitive]}));
    file.push("nodes", json!({"mesh": mesh}));
}

fn volume(mesh: &Mesh) -> f64 {
    let corners = mesh.triangles.iter().map(|corners| corners.map(|index| mesh.positions[index as usize]));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn has(mesh: &Mesh, point: DVec3) -> bool {
    mesh.positions.iter().any(|position| position.distance(point) < 1e-6)
}

#[test]
fn the_same_box_comes_out_of_json_with_a_file_or_with_its_data_and_out_of_glb() {
    let (file, folder) = (box_file(), Folder::new());
    folder.file("a box.bin", &file.data);
    let beside = folder.file("box.gltf", &file.with_buffer(Some("a%20box.bin")));
    let loaded = load(&beside, &LoadOptions::default()).unwrap();
    assert_eq!(loaded.files, [std::path::PathBuf::from(folder.path("a box.bin"))]);
    let binary = load(&folder.file("box.glb", &file.binary()), &LoadOptions::default()).unwrap();
    let text = load(&folder.file("text.gltf", &file.text()), &LoadOptions::default()).unwrap();
    for Loaded { mesh, remarks, .. } in [&loaded, &binary, &text] {
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

/// A picture of four colours as PNG.
fn picture() -> Vec<u8> {
    let pixels = [200u8, 40, 40, 40, 200, 40, 40, 40, 200, 200, 200, 40];
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_raw(2, 2, pixels.to_vec()).unwrap().write_to(&mut png, image::ImageFormat::Png).unwrap();
    png.into_inner()
}

#[test]
fn a_box_draws_the_same_picture_as_the_same_box_in_obj() {
    let folder = Folder::new();
    folder.file("skin.png", &picture());
    folder.file("box.mtl", b"newmtl a\nKd 0.5 0.25 1\nmap_Kd skin.png\n");
    let obj = load(&folder.file("box.obj", box_obj().as_bytes()), &LoadOptions::default()).unwrap().mesh;
    // What a screen shows as these shares is less light than they.
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
            let mut draw = |mesh: &Mesh| renderer.render(&scene(mesh.clone()), style).unwrap();
            let (from_obj, from_gltf) = (draw(&obj), draw(&gltf));
            assert_eq!(from_obj.difference(&from_gltf).unwrap().pixels, 0, "{style:?}");
            seen.push(from_obj);
        }
    }
    assert!(seen[0].difference(&seen[2]).unwrap().pixels > 1000, "styles draw differently");
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
        let Loaded { mesh, remarks, .. } = file.load().unwrap();
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
        // A strip that stands still for two triangles, and a fan.
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
    // Points and lines beside it are said, not drawn.
    let mut file = box_file();
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    for mode in 0..4 {
        primitives.push(json!({"attributes": {"POSITION": 0, "COLOR_0": 0}, "mode": mode}));
    }
    let loaded = file.load().unwrap();
    assert_eq!(loaded.mesh.triangles.len(), 12);
    assert_eq!(loaded.remarks, ["file.gltf: not drawn: 4 primitives of points or lines"]);
}

#[test]
fn sparse_strided_and_quantised_positions_come_out_where_they_should() {
    let square = [DVec3::ZERO, DVec3::X, DVec3::Y];
    // Sparse over nothing: zeros but for two of three.
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
    // What the mesh's node says does not count; the joints lie at (0, 0, 8) and (0, 4, 8), bound at (0, 0, 0) and (0, 4, 0).
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
    assert_eq!(loaded.remarks, ["file.gltf: not drawn: 1 animation (it is drawn as it rests)"]);
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
        refused(&tinta(&["edges", &model]), &["box.gltf: the data file", "outside its folder", "--allow-external"]);
        let output = tinta(&["edges", &model, "--allow-external"]);
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()), "{uri}");
    }
    let loaded = load(&folder.file("model/box.glb", &file.binary()), &LoadOptions::default()).unwrap();
    assert!(!loaded.mesh.materials[0].has_texture());
    one_line(&format!("{}\n", loaded.remarks.join(" ")), &["the picture ../skin.png lies outside", "--allow-external"]);
    for (uri, sentence) in [
        ("https://example.org/box.bin", "it names https://example.org/box.bin, and only files are read"),
        ("file:///etc/passwd", "only files are read"),
        ("no-such.bin", "its data file no-such.bin is not there"),
        ("data:;base64,!!!!", "broken base64"),
    ] {
        refused(&tinta(&["edges", &folder.file("model/box.gltf", &file.with_buffer(Some(uri)))]), &[sentence]);
    }
    // Out of memory no file is read at all.
    let bytes = file.with_buffer(Some(&absolute));
    let message = read_bytes(&bytes, "m.gltf", b"", &LoadOptions { allow_external: true, ..LoadOptions::default() });
    assert!(message.unwrap_err().to_string().contains("which is not read from here; export it as GLB"));
}

#[test]
fn extensions_that_are_needed_and_not_read_are_named_with_what_to_do() {
    let folder = Folder::new();
    for (extension, remedy) in [
        ("KHR_draco_mesh_compression", "gltf-transform copy"),
        ("EXT_meshopt_compression", "gltf-transform copy"),
        ("KHR_texture_basisu", "gltf-transform ktxdecompress"),
        ("XX_of_mine", "export it without"),
    ] {
        let mut file = box_file();
        file.json["extensionsRequired"] = json!(["KHR_materials_unlit", extension]);
        let model = folder.file("box.glb", &file.binary());
        refused(&tinta(&["edges", &model]), &["box.glb: it needs the extension", extension, remedy]);
    }
    let mut file = box_file();
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit", "XX_of_mine"]);
    file.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}));
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(0);
    let said = file.load().unwrap().remarks;
    assert_eq!(said, ["file.gltf: not drawn: colours at vertices, 1 camera, the extension XX_of_mine"]);
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
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        file.json.pointer_mut(parent).unwrap()[key] = value;
        let message = file.problem();
        assert!(message.starts_with("file.gltf: ") && message.contains(sentence), "{pointer}: {message}");
        assert!(message.len() < 300 && !message.contains('\n'), "{message}");
    };
    let huge = json!(u64::MAX);
    change("/asset/version", json!("1.0"), "glTF 1.0; only glTF 2 is read");
    change("/meshes/0/primitives/0/mode", json!(99), "primitives that glTF does not have");
    change("/meshes/0/primitives/0/material", json!(7), "materials that are not in it");
    change("/meshes/0/primitives/0/indices", json!(99), "its accessor 99 is not in it");
    change("/meshes/0/primitives/0/attributes", json!({"NORMAL": 1}), "triangles without positions");
    change("/meshes/0/primitives/0/attributes/NORMAL", json!(3), "numbers an element where 3 are needed");
    change("/accessors/0/count", huge.clone(), "take more than 20 times");
    change("/accessors/0/count", json!(25), "its accessor 0 reaches beyond its buffer view");
    change("/accessors/1/count", json!(23), "has 23 elements where 24 are needed");
    change("/accessors/0/byteOffset", huge.clone(), "its accessor 0 reaches beyond");
    change("/accessors/0/componentType", json!(1), "numbers of a kind that glTF does not have");
    change("/accessors/0/type", json!("VEC9"), "numbers of a kind that glTF does not have");
    change("/accessors/3/count", huge.clone(), "take more than 20 times");
    change("/bufferViews/0/byteLength", huge.clone(), "its buffer view 0 reaches beyond");
    change("/bufferViews/0/byteOffset", huge.clone(), "its buffer view 0 reaches beyond");
    change("/bufferViews/0/byteStride", json!(0), "its accessor 0 reaches beyond");
    change("/bufferViews/0/byteStride", json!(11), "its accessor 0 reaches beyond");
    change("/bufferViews/0/byteStride", huge, "its accessor 0 reaches beyond");
    change("/bufferViews/0/buffer", json!(9), "its buffer 9 is not in it");
    change("/nodes/0/mesh", json!(9), "its mesh 9 is not in it");
    change("/nodes/0/children", json!([0]), "go round in a circle");
    change("/nodes/0/children", json!([9]), "its node 9 is not in it");
    change("/nodes", json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]), "its node 2 lies below two others");
    change("/nodes", json!([{"mesh": 0}, {"children": [2]}, {"children": [1]}]), "go round in a circle");
    change("/nodes/0/skin", json!(9), "its skin 9 is not in it");
    change("/skins/0/joints", json!([9]), "not in it");
    change("/scene", json!(9), "its scene 9 is not in it");
    change("/scenes/0/nodes", json!([9]), "its node 9 is not in it");
    change("/textures/0/source", json!(9), "its picture 9 is not in it");
    change("/images", json!([{}]), "its picture 0 is neither in it nor beside it");
    change("/materials/0/pbrMetallicRoughness/baseColorTexture/index", json!(9), "its texture 9 is not in it");
    change("/meshes", json!("none"), "its JSON is not glTF's");
    change("/nodes", json!([]), "its node 0 is not in it");
}

#[test]
fn glb_that_is_cut_off_anywhere_or_lies_about_its_length_is_refused() {
    let whole = box_file().binary();
    let message = |bytes: &[u8]| {
        let read = read_bytes(bytes, "cut.glb", b"", &LoadOptions::default());
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
    assert!(with(4, 1).contains("GLB of version 1"));
    for length in [0, 11, u32::MAX] {
        assert!(with(8, length).contains(&format!("its header promises {length} bytes")), "{length}");
    }
    assert!(with(12, u32::MAX).contains("chunks is cut off"));
    assert!(with(16, 7).contains("no chunk of JSON"));
}

#[test]
fn nodes_that_repeat_a_mesh_beyond_reason_and_trees_beyond_depth_are_refused_at_once() {
    // Each of 30,000 nodes shows a box: 360,000 triangles out of 400 KB are drawn, 100 times as many are not.
    let mut file = File::new();
    let mesh = add_box(&mut file);
    file.json["nodes"] = Value::Array(vec![json!({"mesh": mesh}); 30_000]);
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    *primitives = vec![primitives[0].clone(); 100];
    let message = file.problem();
    assert!(message.contains("its nodes draw 720000 vertices and 36000000 triangles"), "{message}");

    let mut file = File::new();
    let mesh = add_box(&mut file);
    let mut nodes: Vec<Value> = (1..5000).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": mesh}));
    file.json["nodes"] = Value::Array(nodes);
    assert!(file.problem().contains("more than 4096 levels deep"));

    // Two bytes an object: refused before they are read.
    let many = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", "{},".repeat(200_000));
    let message = read_bytes(many.as_bytes(), "many.gltf", b"", &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("holds 200003 objects"), "{message}");
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
