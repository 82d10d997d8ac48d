//! glTF files written here, for tests that read them.

use base64::Engine;
use glam::DVec3;
use serde_json::{Value, json};
use tinta::mesh::{LoadedModel, read_bytes};
use tinta::{LoadOptions, Mesh, Result};

/// A glTF file as it grows.
pub struct File {
    pub json: Value,
    pub data: Vec<u8>,
}

impl File {
    pub fn new() -> Self {
        Self { json: json!({"asset": {"version": "2.0"}}), data: Vec::new() }
    }

    /// Adds to one of the file's lists and returns the place in it.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        let start = self.data.len();
        self.data.extend(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()}))
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": component, "type": kind, "count": count}))
    }

    pub fn floats(&mut self, kind: &str, numbers: &[f32]) -> usize {
        let size = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(&bytes_of(numbers), 5126, kind, numbers.len() / size)
    }

    pub fn shorts(&mut self, numbers: &[u16]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, "SCALAR", numbers.len())
    }

    /// The file's buffer with this address, or as GLB has it.
    pub fn with_buffer(&self, uri: Option<&str>) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = match uri {
            Some(uri) => json!([{"byteLength": self.data.len(), "uri": uri}]),
            None => json!([{"byteLength": self.data.len()}]),
        };
        serde_json::to_vec(&json).unwrap()
    }

    pub fn text(&self) -> Vec<u8> {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.data);
        self.with_buffer(Some(&format!("data:application/octet-stream;base64,{data}")))
    }

    pub fn binary(&self) -> Vec<u8> {
        glb(self.with_buffer(None), &self.data)
    }

    pub fn load(&self) -> Result<LoadedModel> {
        read_bytes(&self.text(), "file.gltf", &[], &LoadOptions::default())
    }

    pub fn mesh(&self) -> Mesh {
        self.load().unwrap().mesh
    }

    pub fn problem(&self) -> String {
        self.load().map(|loaded| loaded.mesh.positions.len()).unwrap_err().to_string()
    }
}

pub fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

pub fn glb(mut json: Vec<u8>, data: &[u8]) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut data = data.to_vec();
    data.resize(data.len().next_multiple_of(4), 0);
    let word = |number: usize| (number as u32).to_le_bytes();
    let header = [b"glTF".as_slice(), &word(2), &word(12 + 8 + json.len() + 8 + data.len())].concat();
    [header.as_slice(), &word(json.len()), b"JSON", &json, &word(data.len()), b"BIN\0", &data].concat()
}

/// The six sides of the box from -1 to 1: normals and corners, counter-clockwise from outside.
pub fn sides() -> Vec<(DVec3, [DVec3; 4])> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let side = |(axis, sign): (usize, f64)| {
        let normal = axes[axis] * sign;
        let (u, v) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3] * sign);
        (normal, [normal - u - v, normal + u - v, normal + u + v, normal - u + v])
    };
    (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]).map(side).collect()
}

pub const SQUARE: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

pub fn flat(points: impl IntoIterator<Item = DVec3>) -> Vec<f32> {
    points.into_iter().flat_map(|point| point.as_vec3().to_array()).collect()
}

/// The mesh of the box with normals and texture coordinates, in no node yet.
pub fn add_box(file: &mut File) -> usize {
    let positions = flat(sides().into_iter().flat_map(|(_, corners)| corners));
    let normals = flat(sides().into_iter().flat_map(|(normal, _)| [normal; 4]));
    let indices: Vec<u16> = (0..6).flat_map(|side| [0, 1, 2, 0, 2, 3].map(|corner| side * 4 + corner)).collect();
    let [position, normal] = [&positions, &normals].map(|numbers| file.floats("VEC3", numbers));
    let coordinate = file.floats("VEC2", SQUARE.repeat(6).as_flattened());
    let indices = file.shorts(&indices);
    let attributes = json!({"POSITION": position, "NORMAL": normal, "TEXCOORD_0": coordinate});
    file.push("meshes", json!({"primitives": [{"attributes": attributes, "indices": indices}]}))
}

pub fn box_file() -> File {
    let mut file = File::new();
    let mesh = add_box(&mut file);
    file.push("nodes", json!({"mesh": mesh}));
    file
}

/// A square in z = 0 with these additional attributes and this in its primitive.
pub fn square_file(positions: usize, more: Value, file: &mut File) {
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

pub fn volume(mesh: &Mesh) -> f64 {
    let corners = mesh.triangles.iter().map(|corners| corners.map(|index| mesh.positions[index as usize]));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

pub fn has(mesh: &Mesh, point: DVec3) -> bool {
    mesh.positions.iter().any(|position| position.distance(point) < 1e-6)
}

/// A picture of four colours as PNG.
pub fn picture() -> Vec<u8> {
    let pixels = [200u8, 40, 40, 40, 200, 40, 40, 40, 200, 200, 200, 40];
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_raw(2, 2, pixels.to_vec()).unwrap().write_to(&mut png, image::ImageFormat::Png).unwrap();
    png.into_inner()
}
