//! Wavefront OBJ through the tobj crate, with MTL colours and textures.
//!
//! tobj stops at the first index out of range, knows no line numbers and invents normals for corners that have none.
//! So it reads through a [`Guard`]: a `BufRead` that hands on one sound line at a time, knows where it is, and notes
//! each corner's own indices, by which the file's vertex order survives.

use super::soup::{Corner, Soup};
use super::{Material, NONE};
use crate::error::{Error, Result};
use glam::{DVec3, Vec2, Vec3};
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{self, BufRead, Read};
use std::path::{Path, PathBuf};

/// Where material files are looked for.
pub enum Materials {
    /// In the model's folder.
    Beside(PathBuf),
    /// In this text, whatever name the model asks for.
    Text(&'static [u8]),
}

/// Whether the beginning of a file reads like OBJ: text with a line of one of its statements.
pub fn looks_like(head: &[u8]) -> bool {
    const STATEMENTS: [&[u8]; 10] = [b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"vp"];
    !head.contains(&0)
        && head.split(|byte| *byte == b'\n').any(|line| {
            let word = line.trim_ascii_start().split(u8::is_ascii_whitespace).next().unwrap_or_default();
            STATEMENTS.contains(&word)
        })
}

/// Reads an OBJ file's bytes. `path` is for messages; `remarks` gets a sentence for each missing material file.
pub fn read(bytes: &[u8], path: &str, materials: &Materials, remarks: &mut Vec<String>) -> Result<Soup> {
    let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..tobj::LoadOptions::default() };
    let mut guard = Guard::new(bytes);
    let missing = RefCell::new(Vec::new());
    let load_material = |name: &Path| {
        let text = match materials {
            Materials::Text(text) => Some(Cow::Borrowed(*text)),
            Materials::Beside(folder) => std::fs::read(folder.join(name)).ok().map(Cow::Owned),
        };
        if text.is_none() {
            missing.borrow_mut().push(name.display().to_string());
        }
        tobj::load_mtl_buf(&mut sound_material_lines(&text.unwrap_or_default()).as_slice())
    };
    let (models, materials) = tobj::load_obj_buf(&mut guard, &options, load_material).map_err(|error| {
        Error::Model { path: path.to_owned(), line: Some(guard.line_number), problem: in_words(&error) }
    })?;
    let missing = missing.into_inner();
    remarks.extend(
        missing
            .iter()
            .map(|name| format!("{path}: material file {name} is not there; its faces get the default colour")),
    );
    let materials = materials.map_err(|error| Error::model(path, format!("its materials cannot be read ({error})")))?;
    let mut soup = guard.into_soup(&models);
    soup.defects.missing_materials += missing.len();
    soup.materials = materials.into_iter().map(material).collect();
    Ok(soup)
}

fn material(material: tobj::Material) -> Material {
    Material {
        name: material.name,
        color: material.diffuse.map(|color| color.map(|channel| channel as f32)),
        texture: material.diffuse_texture.map(PathBuf::from),
    }
}

/// Only the material statements used here, and only where they are complete: tobj panics on `Kd 1`.
fn sound_material_lines(text: &[u8]) -> Vec<u8> {
    let mut sound = String::new();
    for line in String::from_utf8_lossy(text).lines() {
        let mut words = line.split_whitespace();
        let keep = match words.next() {
            Some("newmtl" | "map_Kd") => words.next().is_some(),
            Some("Kd") => words.by_ref().take(3).filter_map(|word| word.parse::<f32>().ok()).count() == 3,
            _ => false,
        };
        if keep {
            sound.push_str(line.trim());
            sound.push('\n');
        }
    }
    sound.into_bytes()
}

fn in_words(error: &tobj::LoadError) -> String {
    let what = match error {
        tobj::LoadError::PositionParseError | tobj::LoadError::ColorParseError => "a vertex is not three numbers",
        tobj::LoadError::ScalingByZeroError => "a vertex has weight 0",
        tobj::LoadError::NormalParseError => "a normal is not three numbers",
        tobj::LoadError::TexcoordParseError => "a texture coordinate is not two numbers",
        tobj::LoadError::FaceParseError => "a face is not a list of vertex numbers",
        tobj::LoadError::MaterialParseError => "a material is used without a name",
        _ => return format!("it cannot be read ({error}); export it again"),
    };
    format!("{what}; mend this line or export the model again")
}

/// Feeds tobj line by line and keeps what tobj does not tell.
struct Guard<'a> {
    rest: &'a [u8],
    line: Cow<'a, [u8]>,
    /// How much of `line` was handed on.
    taken: usize,
    line_number: u64,
    position_count: u32,
    texture_count: u32,
    normal_count: u32,
    corners: Vec<Corner>,
    polygon_sizes: Vec<u32>,
    degenerate_faces: usize,
    out_of_range_faces: usize,
}

impl<'a> Guard<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            line: Cow::Borrowed(&[]),
            taken: 0,
            line_number: 0,
            position_count: 0,
            texture_count: 0,
            normal_count: 0,
            corners: Vec::new(),
            polygon_sizes: Vec::new(),
            degenerate_faces: 0,
            out_of_range_faces: 0,
        }
    }

    /// Moves on to the next line worth handing to tobj; an empty `line` means the end.
    fn advance(&mut self) {
        self.taken = 0;
        while let Some(line) = self.next_logical_line() {
            if self.accept(&line) {
                self.line = line;
                return;
            }
        }
        self.line = Cow::Borrowed(&[]);
    }

    /// The next line without its comment, continued lines joined, ending in a newline, valid UTF-8.
    fn next_logical_line(&mut self) -> Option<Cow<'a, [u8]>> {
        let mut line = self.next_physical_line()?;
        if !line.ends_with(b"\n") || line.contains(&b'#') || line.ends_with(b"\\\n") || line.ends_with(b"\\\r\n") {
            let mut joined = line.into_owned();
            while let Some(start) = continuation(&joined) {
                joined.truncate(start);
                joined.push(b' ');
                match self.next_physical_line() {
                    Some(next) => joined.extend_from_slice(&next),
                    None => break,
                }
            }
            let end = joined.iter().position(|byte| *byte == b'#').unwrap_or(joined.len());
            joined.truncate(end);
            if !joined.ends_with(b"\n") {
                joined.push(b'\n');
            }
            line = Cow::Owned(joined);
        }
        if std::str::from_utf8(&line).is_err() {
            line = Cow::Owned(String::from_utf8_lossy(&line).into_owned().into_bytes());
        }
        Some(line)
    }

    fn next_physical_line(&mut self) -> Option<Cow<'a, [u8]>> {
        if self.rest.is_empty() {
            return None;
        }
        self.line_number += 1;
        let end = self.rest.iter().position(|byte| *byte == b'\n').map_or(self.rest.len(), |end| end + 1);
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        Some(Cow::Borrowed(line))
    }

    /// Notes what a line declares; whether tobj shall see it.
    fn accept(&mut self, line: &[u8]) -> bool {
        let Ok(text) = std::str::from_utf8(line) else { return false };
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.position_count += 1,
            Some("vt") => self.texture_count += 1,
            Some("vn") => self.normal_count += 1,
            Some("f") => return self.accept_face(words),
            Some("o" | "g" | "usemtl" | "mtllib") => {}
            _ => return false,
        }
        true
    }

    /// Notes a face's corners. Faces with too few corners or indices out of range are counted and kept from tobj;
    /// what is not a number goes to tobj, which says so.
    fn accept_face<'t>(&mut self, words: impl Iterator<Item = &'t str>) -> bool {
        let start = self.corners.len();
        let mut in_range = true;
        for word in words {
            let mut fields = word.split('/');
            let index = |field: Option<&str>, count: u32| match field {
                None | Some("") => Ok(NONE),
                Some(text) => text.parse::<i64>().map(|number| resolve(number, count)),
            };
            let (Ok(position), Ok(texture), Ok(normal)) = (
                index(fields.next(), self.position_count),
                index(fields.next(), self.texture_count),
                index(fields.next(), self.normal_count),
            ) else {
                self.corners.truncate(start);
                return true;
            };
            in_range &= position < self.position_count
                && (texture == NONE || texture < self.texture_count)
                && (normal == NONE || normal < self.normal_count);
            self.corners.push(Corner { position, normal, texture });
        }
        let count = self.corners.len() - start;
        if count < 3 || !in_range {
            self.corners.truncate(start);
            *(if in_range { &mut self.degenerate_faces } else { &mut self.out_of_range_faces }) += 1;
            return false;
        }
        self.polygon_sizes.push(count as u32);
        true
    }

    /// Puts tobj's numbers where the file's own indices say.
    fn into_soup(self, models: &[tobj::Model]) -> Soup {
        let mut soup = Soup {
            positions: vec![DVec3::ZERO; self.position_count as usize],
            normals: vec![Vec3::ZERO; self.normal_count as usize],
            texture_coordinates: vec![Vec2::ZERO; self.texture_count as usize],
            ..Soup::default()
        };
        let mut corner = 0;
        for model in models {
            let mesh = &model.mesh;
            for local in 0..mesh.indices.len() {
                let Corner { position, normal, texture } = self.corners[corner];
                corner += 1;
                let from = mesh.indices[local] as usize * 3;
                soup.positions[position as usize] = DVec3::from_slice(&mesh.positions[from..from + 3]);
                if normal != NONE {
                    let from = mesh.normal_indices[local] as usize * 3;
                    soup.normals[normal as usize] = DVec3::from_slice(&mesh.normals[from..from + 3]).as_vec3();
                }
                if texture != NONE {
                    let from = mesh.texcoord_indices[local] as usize * 2;
                    let [u, v] = [mesh.texcoords[from], mesh.texcoords[from + 1]].map(|number| number as f32);
                    soup.texture_coordinates[texture as usize] = Vec2::new(u, v);
                }
            }
            let polygons = if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { mesh.face_arities.len() };
            let material = mesh.material_id.map_or(NONE, |id| id as u32);
            soup.polygon_materials.resize(soup.polygon_materials.len() + polygons, material);
        }
        if self.polygon_sizes.iter().any(|size| *size != 3) {
            soup.polygon_sizes = self.polygon_sizes;
        }
        soup.corners = self.corners;
        soup.defects.degenerate_triangles = self.degenerate_faces;
        soup.defects.out_of_range_faces = self.out_of_range_faces;
        soup
    }
}

/// A 1-based or negative, relative index as a 0-based one; [`NONE`] - 1 for what can never be in range.
fn resolve(number: i64, count: u32) -> u32 {
    let index = if number < 0 { i64::from(count) + number } else { number - 1 };
    u32::try_from(index).unwrap_or(NONE - 1).min(NONE - 1)
}

/// Where a line that goes on in the next one has its backslash.
fn continuation(line: &[u8]) -> Option<usize> {
    let text = line.trim_ascii_end();
    (text.ends_with(b"\\") && !text.contains(&b'#')).then(|| text.len() - 1)
}

impl Read for Guard<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(out)?;
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for Guard<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken >= self.line.len() {
            self.advance();
        }
        Ok(&self.line[self.taken..])
    }

    fn consume(&mut self, count: usize) {
        self.taken += count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(text: &str) -> Soup {
        read(text.as_bytes(), "test.obj", &Materials::Text(b""), &mut Vec::new()).unwrap()
    }

    fn message(text: &str) -> String {
        read(text.as_bytes(), "test.obj", &Materials::Text(b""), &mut Vec::new()).unwrap_err().to_string()
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn vertices_keep_the_files_order_whatever_order_faces_name_them_in() {
        let soup = soup(&format!("{SQUARE}f 4 3 2\no other\nf 3 1 2\n"));
        assert_eq!(soup.positions[3], DVec3::Y);
        assert_eq!(soup.positions[0], DVec3::ZERO);
        let positions: Vec<u32> = soup.corners.iter().map(|corner| corner.position).collect();
        assert_eq!(positions, [3, 2, 1, 2, 0, 1]);
    }

    #[test]
    fn comments_continued_lines_negative_indices_and_windows_line_ends_are_understood() {
        let soup = soup("v 0 0 0 # a corner\r\nv 1 0 \\\r\n 0\r\nv 1 1 0\r\nf -3 -2 \\\n -1 # all of it");
        assert_eq!(soup.positions[1], DVec3::X);
        assert_eq!(soup.corners.len(), 3);
    }

    #[test]
    fn faces_out_of_range_are_counted_and_the_others_kept() {
        let soup =
            soup(&format!("{SQUARE}f 1 2 9\nf 0 1 2\nf 1/7 2/7 3/7\nf 1//2 2//2 3//2\nf -9 1 2\nf 1 2 3\nf 1 2\n"));
        assert_eq!(soup.corners.len(), 3);
        assert_eq!(soup.defects.out_of_range_faces, 5);
        assert_eq!(soup.defects.degenerate_triangles, 1);
    }

    #[test]
    fn corners_without_a_normal_are_not_given_anothers() {
        let soup = soup(&format!("{SQUARE}vn 0 0 1\nvt 0.25 0.5\nf 1//1 2 3/1\n"));
        let normals: Vec<u32> = soup.corners.iter().map(|corner| corner.normal).collect();
        assert_eq!(normals, [0, NONE, NONE]);
        assert_eq!(soup.texture_coordinates[soup.corners[2].texture as usize], Vec2::new(0.25, 0.5));
    }

    #[test]
    fn what_is_not_a_number_is_an_error_with_its_line() {
        assert_eq!(
            message("v 0 0 0\n\nv 0 x 0\n"),
            "test.obj: line 3: a vertex is not three numbers; mend this line or export the model again"
        );
        assert!(message(&format!("{SQUARE}f 1 b 3\n")).contains("line 5: a face"));
        assert!(message("v 1 2").contains("line 1"));
    }

    #[test]
    fn materials_are_kept_with_colour_and_texture_and_half_a_colour_does_not_panic() {
        let text = format!("mtllib m.mtl\n{SQUARE}usemtl red\nf 1 2 3\nusemtl none\nf 1 3 4\n");
        let mtl = b"newmtl red\nKd 1 0.5 0\nmap_Kd skin.png\nKd 1\nKa x\n";
        let soup = read(text.as_bytes(), "t.obj", &Materials::Text(mtl), &mut Vec::new()).unwrap();
        assert_eq!(soup.polygon_materials, [0, NONE]);
        assert_eq!(soup.materials[0].color, Some([1.0, 0.5, 0.0]));
        assert_eq!(soup.materials[0].texture, Some(PathBuf::from("skin.png")));
    }

    #[test]
    fn a_missing_material_file_is_remarked_and_counted() {
        let mut remarks = Vec::new();
        let text = format!("mtllib no-such.mtl\n{SQUARE}f 1 2 3\n");
        let soup = read(text.as_bytes(), "t.obj", &Materials::Beside("/nowhere".into()), &mut remarks).unwrap();
        assert_eq!(soup.defects.missing_materials, 1);
        assert!(remarks[0].starts_with("t.obj: material file no-such.mtl"), "{remarks:?}");
    }
}
