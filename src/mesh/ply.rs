//! PLY, text and binary, through the ply-rs-bw crate: vertices with normals and texture coordinates, polygon faces.

use super::NONE;
use super::soup::{Corner, Soup};
use crate::error::{Error, Result};
use glam::{DVec3, Vec2, Vec3};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult};

/// Reads a PLY file's bytes. `path` is for messages.
pub fn read(bytes: &[u8], path: &str) -> Result<Soup> {
    if !bytes.starts_with(b"ply") {
        return Err(Error::model(
            path,
            "it does not begin like a PLY file; it is damaged or misnamed, export it again",
        ));
    }
    let mut reader = Reader::new(bytes);
    let text = bytes[..bytes.len().min(256)].windows(12).any(|words| words == b"format ascii");
    let damaged = |error: ParseError| Error::Model {
        path: path.to_owned(),
        // In a binary file the crate counts elements, not lines.
        line: error.line().filter(|_| text).map(|line| line as u64),
        problem: format!("it is damaged or cut off ({}); export it again", cause(&error)),
    };
    let header = Parser::<Ignored>::new().read_header(&mut reader).map_err(damaged)?;
    check_header(&header).map_err(|problem| Error::model(path, problem))?;
    let mut soup = Soup::default();
    let mut faces: Vec<Face> = Vec::new();
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                let has = |property: &str| element.properties.contains_key(property);
                let has_normals = ["nx", "ny", "nz"].into_iter().all(has);
                let has_texture = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]]
                    .into_iter()
                    .any(|names| names.into_iter().all(has));
                let vertices: Vec<Vertex> =
                    Parser::new().read_payload_for_element(&mut reader, element, &header).map_err(damaged)?;
                soup.positions = vertices.iter().map(|vertex| vertex.position).collect();
                if has_normals {
                    soup.normals = vertices.iter().map(|vertex| vertex.normal).collect();
                }
                if has_texture {
                    soup.texture_coordinates = vertices.iter().map(|vertex| vertex.texture).collect();
                }
            }
            "face" => {
                faces = Parser::new().read_payload_for_element(&mut reader, element, &header).map_err(damaged)?;
            }
            _ => {
                Parser::<Ignored>::new().read_payload_for_element(&mut reader, element, &header).map_err(damaged)?;
            }
        }
    }
    add_faces(&mut soup, &faces);
    Ok(soup)
}

/// Refuses what would otherwise be misread or never end.
fn check_header(header: &Header) -> std::result::Result<(), &'static str> {
    // An element without properties takes no bytes, so any number of them fits into any file.
    if header.elements.values().any(|element| element.properties.is_empty() && element.count > 0) {
        return Err("its header has an element without properties; export it again");
    }
    let has = |element: &str, property: &str| {
        header.elements.get(element).is_some_and(|element| element.properties.contains_key(property))
    };
    if !["x", "y", "z"].into_iter().all(|axis| has("vertex", axis)) {
        return Err("its vertices have no x, y and z; export it again");
    }
    if header.elements.contains_key("face") && !has("face", "vertex_indices") && !has("face", "vertex_index") {
        return Err("its faces have no list of vertex_indices; export it again");
    }
    if header.elements.contains_key("tristrips") {
        return Err("its faces are triangle strips, which are not read; export it with single faces");
    }
    Ok(())
}

fn add_faces(soup: &mut Soup, faces: &[Face]) {
    let count = soup.positions.len() as i64;
    for face in faces {
        if face.vertices.iter().any(|index| !(0..count).contains(index)) {
            soup.defects.out_of_range_faces += 1;
        } else if face.vertices.len() < 3 {
            soup.defects.degenerate_triangles += 1;
        } else {
            let with = |used: bool, index: u32| if used { index } else { NONE };
            soup.corners.extend(face.vertices.iter().map(|&index| Corner {
                position: index as u32,
                normal: with(!soup.normals.is_empty(), index as u32),
                texture: with(!soup.texture_coordinates.is_empty(), index as u32),
            }));
            soup.polygon_sizes.push(face.vertices.len() as u32);
        }
    }
}

/// The crate's message without the line number, which ours has, and without the line itself.
fn cause(error: &ParseError) -> String {
    let message = error.to_string();
    let message = match message.strip_prefix("Line ").and_then(|rest| rest.split_once(": ")) {
        Some((_, message)) => message,
        None => &message,
    };
    // Where its grammar fails the crate adds that grammar's own debugging text.
    let plain = message.lines().next().unwrap_or_default().split("ParseError").next().unwrap_or_default();
    plain.trim_end_matches([':', '.', ' ', '\t']).chars().take(120).collect()
}

#[derive(Default)]
struct Vertex {
    position: DVec3,
    normal: Vec3,
    texture: Vec2,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(number) = scalar(&property) else { return PropertyAccessResult::Ignored };
        match name {
            "x" => self.position.x = number,
            "y" => self.position.y = number,
            "z" => self.position.z = number,
            "nx" => self.normal.x = number as f32,
            "ny" => self.normal.y = number as f32,
            "nz" => self.normal.z = number as f32,
            "u" | "s" | "texture_u" => self.texture.x = number as f32,
            "v" | "t" | "texture_v" => self.texture.y = number as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct Face {
    vertices: Vec<i64>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name != "vertex_indices" && name != "vertex_index" {
            return PropertyAccessResult::Ignored;
        }
        self.vertices = match property {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

/// An element nobody asked for: read past, nothing kept.
struct Ignored;

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}

fn scalar(property: &Property) -> Option<f64> {
    Some(match property {
        Property::Char(number) => f64::from(*number),
        Property::UChar(number) => f64::from(*number),
        Property::Short(number) => f64::from(*number),
        Property::UShort(number) => f64::from(*number),
        Property::Int(number) => f64::from(*number),
        Property::UInt(number) => f64::from(*number),
        Property::Float(number) => f64::from(*number),
        Property::Double(number) => *number,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "ply\nformat ascii 1.0\ncomment test\nelement vertex 4\nproperty float x\nproperty float y\n\
        property double z\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n\
        element edge 1\nproperty int a\nend_header\n";

    #[test]
    fn a_text_file_with_polygons_and_foreign_elements_is_read() {
        let text = format!("{HEADER}0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3 9\n3 0 1 7 9\n5\n");
        let soup = read(text.as_bytes(), "t.ply").unwrap();
        assert_eq!(soup.positions[2], DVec3::new(1.0, 1.0, 0.5));
        assert_eq!(soup.polygon_sizes, [4]);
        assert_eq!(soup.defects.out_of_range_faces, 1);
    }

    #[test]
    fn a_cut_off_file_is_an_error_with_its_line() {
        let message = read(format!("{HEADER}0 0 0\n1 0\n").as_bytes(), "t.ply").unwrap_err().to_string();
        assert!(message.starts_with("t.ply: line 15: it is damaged or cut off"), "{message}");
    }

    #[test]
    fn headers_that_cannot_be_a_model_are_refused_with_the_reason() {
        let refused = |header: &str, reason: &str| {
            let text = format!("ply\nformat ascii 1.0\n{header}end_header\n");
            let message = read(text.as_bytes(), "t.ply").unwrap_err().to_string();
            assert!(message.contains(reason), "{message}");
            assert!(!message.contains('{'), "{message}");
        };
        let xyz = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
        refused("element vertex 1\nproperty float x\nproperty float y\n", "no x, y and z");
        refused(&format!("{xyz}element face 1\nproperty int a\n"), "no list of vertex_indices");
        refused(&format!("{xyz}element tristrips 1\nproperty list int int vertex_indices\n"), "triangle strips");
        refused("forma", "damaged");
    }

    #[test]
    fn a_header_that_promises_billions_is_refused_without_the_memory() {
        let text = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n\
            property float z\nend_header\nabc";
        assert!(read(text.as_bytes(), "t.ply").is_err());
        let text = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nend_header\n";
        let message = read(text.as_bytes(), "t.ply").unwrap_err().to_string();
        assert!(message.contains("element without properties"), "{message}");
    }
}
