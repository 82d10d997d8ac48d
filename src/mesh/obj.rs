//! Wavefront OBJ through the tobj crate, with MTL colours and textures.
//!
//! tobj stops at the first index out of range, knows no line numbers and invents normals for corners that have none.
//! So it reads through a [`Guard`]: a `BufRead` that hands on one sound line at a time, knows where it is, and notes
//! each corner's own indices, by which the file's vertex order survives.

mod guard;

use super::soup::{Corner, Soup};
use super::{Material, NONE};
use crate::error::{Error, Result};
use glam::{DVec3, Vec2, Vec3};
use guard::Guard;
use std::borrow::Cow;
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// Where material files are looked for.
pub enum Materials {
    /// In the model's folder.
    Beside(PathBuf),
    /// In this text, whatever name the model asks for.
    Text(&'static [u8]),
}

impl Materials {
    /// The text of a material library; a name that is no file is taken for several names with blanks between them.
    fn find(&self, name: &Path) -> Option<Cow<'static, [u8]>> {
        let folder = match self {
            Self::Text(text) => return Some(Cow::Borrowed(text)),
            Self::Beside(folder) => folder,
        };
        // Only files: a pipe or device would never end.
        let read = |name: &Path| {
            let path = folder.join(name);
            path.metadata().ok().filter(|metadata| metadata.is_file()).and_then(|_| std::fs::read(path).ok())
        };
        let several = || {
            let texts: Vec<Vec<u8>> = name.to_str()?.split_whitespace().map_while(|name| read(name.as_ref())).collect();
            (texts.len() == name.to_str()?.split_whitespace().count()).then(|| texts.join(&b'\n'))
        };
        read(name).or_else(several).map(Cow::Owned)
    }
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
    // What is not UTF-8 can only be in names.
    let text = String::from_utf8_lossy(bytes);
    let mut guard = Guard::new(&text);
    let missing_files = RefCell::new(Vec::new());
    let load_material = |name: &Path| {
        let text = materials.find(name).unwrap_or_else(|| {
            missing_files.borrow_mut().push(name.display().to_string());
            Cow::Borrowed(b"")
        });
        tobj::load_mtl_buf(&mut sound_material_lines(&text).as_slice())
    };
    let (models, found) = tobj::load_obj_buf(&mut guard, &options, load_material).map_err(|error| Error::Model {
        path: path.to_owned(),
        line: Some(guard.line_number),
        problem: in_words(&error),
    })?;
    let found = found.map_err(|error| Error::model(path, format!("its materials cannot be read ({error})")))?;
    let missing_files = missing_files.into_inner();
    remarks.extend(
        missing_files
            .iter()
            .map(|name| format!("{path}: the material file {name} is not there; its faces get the default colour")),
    );
    let unknown = guard.materials.iter().filter(|name| !found.iter().any(|material| material.name == **name)).count();
    let mut soup = into_soup(guard, &models, path)?;
    // A missing file's materials are missing with it: counted once, said once.
    soup.defects.missing_materials = unknown.max(missing_files.len());
    if unknown > 0 && missing_files.is_empty() {
        remarks.push(format!(
            "{path}: {unknown} of the materials it uses are in no material file; their faces get the default colour"
        ));
    }
    soup.materials = found.into_iter().map(material).collect();
    Ok(soup)
}

fn material(material: tobj::Material) -> Material {
    Material {
        name: material.name,
        color: material.diffuse.map(|color| color.map(|channel| channel.clamp(0.0, 1.0) as f32)),
        texture: material.diffuse_texture.map(PathBuf::from),
    }
}

/// Only the material statements used here, and only where they are complete: tobj panics on `Kd 1`.
fn sound_material_lines(text: &[u8]) -> Vec<u8> {
    let mut sound = String::new();
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    for line in String::from_utf8_lossy(text).lines() {
        let line = line.trim();
        let mut words = line.split_whitespace();
        let number = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        let (keyword, rest) = (words.next().unwrap_or_default(), line.split_once(char::is_whitespace));
        let keep = match keyword {
            "newmtl" | "map_Kd" => words.next().is_some(),
            "Kd" => words.take(3).filter_map(number).count() == 3,
            _ => false,
        };
        if let (true, Some((_, rest))) = (keep, rest) {
            let rest = if keyword == "map_Kd" { texture_name(rest) } else { rest.trim() };
            // tobj cuts names at fixed columns, so exactly one blank goes before them.
            sound.push_str(&format!("{keyword} {rest}\n"));
        }
    }
    sound.into_bytes()
}

/// The file's name, which may hold blanks, behind a texture statement's options and between its quotes, if it has any.
fn texture_name(statement: &str) -> &str {
    let mut rest = statement.trim();
    while let Some((option, mut after)) = rest.split_once(char::is_whitespace) {
        let (least, most) = match option.to_ascii_lowercase().as_str() {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-boost" | "-bm" | "-cc" | "-clamp" | "-imfchan" | "-texres" | "-type" => (1, 1),
            _ => break,
        };
        // One to three numbers may follow; the last word is the name in any case.
        for place in 0..most {
            let Some((word, next)) = after.trim_start().split_once(char::is_whitespace) else { break };
            if place >= least && word.parse::<f64>().is_err() {
                break;
            }
            after = next;
        }
        rest = after.trim_start();
    }
    let quoted = rest.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map(str::trim);
    quoted.filter(|name| !name.is_empty()).unwrap_or(rest)
}

fn in_words(error: &tobj::LoadError) -> String {
    let what = match error {
        tobj::LoadError::PositionParseError | tobj::LoadError::ColorParseError => "a vertex is not three numbers",
        tobj::LoadError::ScalingByZeroError => "a vertex has weight 0",
        tobj::LoadError::NormalParseError => "a normal is not three numbers",
        tobj::LoadError::TexcoordParseError => "a texture coordinate is not two numbers",
        tobj::LoadError::FaceParseError => "a face is not a list of vertex numbers",
        _ => return format!("it cannot be read ({error}); export it again"),
    };
    format!("{what}; mend this line or export the model again")
}

/// Puts tobj's numbers where the file's own indices say.
fn into_soup(guard: Guard<'_>, models: &[tobj::Model], path: &str) -> Result<Soup> {
    let read: usize = models.iter().map(|model| model.mesh.indices.len()).sum();
    if read != guard.corners.len() {
        return Err(Error::model(path, "its faces are read in two ways; export it again in plain OBJ"));
    }
    let mut soup = Soup {
        positions: vec![DVec3::ZERO; guard.position_count as usize],
        normals: vec![Vec3::ZERO; guard.normal_count as usize],
        texture_coordinates: vec![Vec2::ZERO; guard.texture_count as usize],
        ..Soup::default()
    };
    let mut corners = guard.corners.iter();
    for tobj::Model { mesh, .. } in models {
        for (local, corner) in (0..mesh.indices.len()).zip(corners.by_ref()) {
            let Corner { position, normal, texture } = *corner;
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
    if guard.polygon_sizes.iter().any(|size| *size != 3) {
        soup.polygon_sizes = guard.polygon_sizes;
    }
    soup.corners = guard.corners;
    soup.defects.degenerate_triangles = guard.degenerate_faces;
    soup.defects.out_of_range_faces = guard.out_of_range_faces;
    Ok(soup)
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
    fn texture_names_stand_behind_options_and_may_hold_blanks_and_backslashes() {
        let names = [
            ("skin.png", "skin.png"),
            ("-s 1 1 1 skin.png", "skin.png"),
            ("-s 2 skin.png", "skin.png"),
            ("-o 0.5 0 my skin.png", "my skin.png"),
            ("-blendu on -mm 0 1  -clamp off art\\my skin.png ", "art\\my skin.png"),
            ("-t 1 2 3 4.png", "4.png"),
            ("-s 1 1 1 2 faces.png", "2 faces.png"),
            ("\"my skin.png\"", "my skin.png"),
            ("-s 1 1 1", "1"),
            ("-clamp", "-clamp"),
        ];
        for (statement, name) in names {
            assert_eq!(texture_name(statement), name, "{statement}");
            let text = format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3\n");
            let mtl = sound_material_lines(format!("newmtl a\nmap_Kd\t{statement}\r\n").as_bytes());
            let mtl: &'static [u8] = mtl.leak();
            let soup = read(text.as_bytes(), "t.obj", &Materials::Text(mtl), &mut Vec::new()).unwrap();
            assert_eq!(soup.materials[0].texture, Some(PathBuf::from(name)));
        }
    }

    #[test]
    fn material_names_with_hash_signs_blanks_and_tabs_are_found_and_unknown_ones_counted() {
        let text = format!("mtllib a b.mtl\n{SQUARE}  usemtl\tMaterial_#25 x\nf 1 2 3 # red\nusemtl other\nf 1 3 4\n");
        let mtl = b"newmtl Material_#25 x\nKd 1 0 7\n";
        let soup = read(text.as_bytes(), "t.obj", &Materials::Text(mtl), &mut Vec::new()).unwrap();
        assert_eq!(soup.polygon_materials, [0, NONE]);
        assert_eq!(soup.materials[0].color, Some([1.0, 0.0, 1.0]), "colours end at 1");
        assert_eq!(soup.defects.missing_materials, 1);
    }

    #[test]
    fn vertex_colours_on_some_vertices_are_no_error() {
        let soup = soup("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1 2 3 4 5\nf 1 2 3\n");
        assert_eq!(soup.positions[2], DVec3::Y);
    }

    #[test]
    fn unusual_white_space_separates_words_for_guard_and_tobj_alike() {
        for space in ['\u{b}', '\u{a0}', '\u{3000}', '\t'] {
            let soup = soup(&format!("{SQUARE}f 1{space}2{space}3\nf 1 3 4\n"));
            let positions: Vec<u32> = soup.corners.iter().map(|corner| corner.position).collect();
            assert_eq!(positions, [0, 1, 2, 0, 2, 3], "{space:?}");
        }
    }

    #[test]
    fn a_material_file_that_is_a_device_is_not_read() {
        let text = format!("mtllib /dev/zero\n{SQUARE}f 1 2 3\n");
        let soup = read(text.as_bytes(), "t.obj", &Materials::Beside("/".into()), &mut Vec::new()).unwrap();
        assert_eq!(soup.defects.missing_materials, 1);
    }

    #[test]
    fn a_missing_material_file_is_remarked_and_counted() {
        let mut remarks = Vec::new();
        let text = format!("mtllib no-such.mtl\n{SQUARE}f 1 2 3\n");
        let soup = read(text.as_bytes(), "t.obj", &Materials::Beside("/nowhere".into()), &mut remarks).unwrap();
        assert_eq!(soup.defects.missing_materials, 1);
        assert!(remarks[0].starts_with("t.obj: the material file no-such.mtl"), "{remarks:?}");
    }
}
