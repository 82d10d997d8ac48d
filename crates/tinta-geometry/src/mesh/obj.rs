//! Wavefront OBJ, with MTL colours and textures.
//!
//! The file is cut between lines into pieces, which are read at the same time on all cores: first what each piece declares
//! is counted, so that each then knows its faces' indices. tobj, which reads the MTL files, reads the tests' second
//! opinion of the OBJ files too (`twin.rs`): for everybody's files it takes three times as long on one core, stops at the
//! first index out of range, knows no line numbers and invents normals for corners that have none.

#[cfg(test)]
mod agreement;
mod lines;
mod piece;
mod quick;
#[cfg(test)]
mod twin;

use super::folder::Folder;
use super::soup::Soup;
use super::{Material, NONE, skin};
use crate::error::{Error, Result};
use crate::files::{Failure, shown};
use crate::limits::{MATERIAL_FILE_BYTES, MATERIAL_FILES, MATERIALS};
use crate::threads::{cores, in_chunks};
use piece::{Counts, Naming, Piece};
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

/// How much of a file is read in one go. Much less than a core's share, as another core opens the GL context meanwhile.
const PIECE_BYTES: usize = 1 << 20;

/// The text of a material library with its files, or a sentence why there is none; a name that is no file is taken for several
/// names with blanks between them. Empty where there is nothing to look in.
fn library<'a>(folder: &Folder<'a>, name: &str) -> std::result::Result<(Cow<'a, [u8]>, Vec<PathBuf>), String> {
    if !folder.is_some() {
        return Ok((Cow::Borrowed(b""), Vec::new()));
    }
    let read = |name: &str| folder.read_library(name, MATERIAL_FILE_BYTES);
    let several = || -> Option<Vec<Cow<'_, [u8]>>> { name.split_whitespace().map(|name| read(name).ok()).collect() };
    let failure = match read(name) {
        Ok(text) => return Ok((text, folder.place_of(name).into_iter().collect())),
        Err(failure) => failure,
    };
    match several() {
        Some(texts) => {
            let files = name.split_whitespace().filter_map(|name| folder.place_of(name)).collect();
            Ok((Cow::Owned(texts.join(&b'\n')), files))
        }
        None => Err(match failure {
            Failure::Outside => {
                format!("{}; its faces get the default colour", skin::outside("material file", name))
            }
            Failure::TooLarge(_) | Failure::NoMemory(_) => {
                format!("the material file {}: {}", shown(name), failure.problem("a material file"))
            }
            _ => format!("the material file {} is missing; its faces get the default colour", shown(name)),
        }),
    }
}

/// Whether the beginning of a file reads like OBJ: text with a line of one of its statements.
pub(super) fn looks_like(head: &[u8]) -> bool {
    const STATEMENTS: [&[u8]; 10] = [b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"vp"];
    !head.contains(&0)
        && head.split(|byte| *byte == b'\n').any(|line| {
            let word = line.trim_ascii_start().split(u8::is_ascii_whitespace).next().unwrap_or_default();
            STATEMENTS.contains(&word)
        })
}

/// Reads an OBJ file's bytes. `path` is for messages; `remarks` gets a sentence for each missing material file.
pub(super) fn read(bytes: &[u8], path: &str, folder: &Folder<'_>, remarks: &mut Vec<String>) -> Result<Soup> {
    let soup = read_in_pieces(bytes, PIECE_BYTES, path, folder, remarks)?;
    if ends_in_a_face(bytes) {
        remarks.push(format!("{path}: its last line is a face without three corners; the file may be cut off"));
    }
    Ok(soup)
}

/// The same, of pieces of about `length` bytes; what comes out does not depend on it.
fn read_in_pieces(
    bytes: &[u8],
    length: usize,
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    let pieces = lines::pieces(bytes, length);
    let counted = in_chunks(pieces.len(), 1, cores(), |piece| {
        // What is not UTF-8 can only be in names.
        let text = String::from_utf8_lossy(pieces[piece.start]);
        let counts = Counts::of(&text);
        (text, counts)
    });
    let starts: Vec<Counts> = counted
        .iter()
        .scan(Counts::default(), |before, (_, counts)| Some(std::mem::replace(before, *before + *counts)))
        .collect();
    let pieces = in_chunks(pieces.len(), 1, cores(), |piece| {
        let (text, counts) = &counted[piece.start];
        Piece::read(text, starts[piece.start], *counts)
    });
    let pieces: std::result::Result<Vec<Piece>, piece::Problem> = pieces.into_iter().collect();
    let pieces = pieces.map_err(|problem| {
        Error::model(path, format!("{}; correct this line or export the model again", problem.what))
            .at(Some(problem.line))
    })?;
    let free_form = pieces
        .iter()
        .fold([0, 0], |[curves, surfaces], piece: &Piece| [curves + piece.free_form[0], surfaces + piece.free_form[1]]);
    let (mut soup, namings) = joined(pieces);
    if let Some(left_out) = free_form_in_words(free_form) {
        if soup.corners.is_empty() {
            return Err(Error::model(path, format!("it has no faces but {left_out}; export it as polygons")));
        }
        remarks.push(format!("{path}: {left_out} not drawn; to see them, export them as polygons"));
    }
    put_on_materials(&mut soup, &namings, path, folder, remarks)?;
    Ok(soup)
}

/// Whether the last line has no end, and is a face of fewer than three corners.
fn ends_in_a_face(bytes: &[u8]) -> bool {
    let start = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let words = bytes[start..].split(|byte| byte.is_ascii_whitespace()).filter(|word| !word.is_empty());
    let words: Vec<&[u8]> = words.take(4).collect();
    matches!(words.as_slice(), [b"f", corners @ ..] if corners.len() < 3)
}

/// `2 free-form surfaces and 1 free-form curve`; `None` for none.
fn free_form_in_words([curves, surfaces]: [usize; 2]) -> Option<String> {
    let words = |count: usize, what: &str| {
        let plural = if count == 1 { "" } else { "s" };
        (count > 0).then(|| format!("{count} free-form {what}{plural}"))
    };
    let all: Vec<String> = [words(surfaces, "surface"), words(curves, "curve")].into_iter().flatten().collect();
    (!all.is_empty()).then(|| all.join(" and "))
}

/// All pieces as one, and the materials named with how many faces come before each.
fn joined(pieces: Vec<Piece>) -> (Soup, Vec<(usize, Naming)>) {
    let mut soup = Soup::default();
    let mut namings = Vec::new();
    let mut polygons = 0;
    let has_only_triangles = pieces.iter().all(|piece| piece.polygon_sizes.is_empty());
    soup.positions.reserve_exact(pieces.iter().map(|piece| piece.positions.len()).sum());
    soup.corners.reserve_exact(pieces.iter().map(|piece| piece.corners.len()).sum());
    for mut piece in pieces {
        soup.positions.append(&mut piece.positions);
        soup.normals.append(&mut piece.normals);
        soup.texture_coordinates.append(&mut piece.texture_coordinates);
        soup.corners.append(&mut piece.corners);
        namings.extend(piece.namings.into_iter().map(|(before, naming)| (polygons + before, naming)));
        polygons += piece.polygons;
        if !has_only_triangles {
            soup.polygon_sizes.append(&mut piece.polygon_sizes);
            soup.polygon_sizes.resize(polygons, 3);
        }
        soup.defects.degenerate_triangles += piece.degenerate_faces;
        soup.defects.out_of_range_faces += piece.out_of_range_faces;
    }
    (soup, namings)
}

/// Reads the material files named and gives the faces their materials.
fn put_on_materials(
    soup: &mut Soup,
    namings: &[(usize, Naming)],
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<()> {
    let mut found = Vec::new();
    // A name's material is the one that was read last, but only for faces that come after it.
    let mut numbers: HashMap<String, usize> = HashMap::new();
    let (mut libraries, mut used) = (HashSet::new(), HashSet::new());
    let mut missing = Vec::new();
    let mut current = NONE;
    for (before, naming) in namings {
        match naming {
            // Exporters name one file before every part.
            Naming::Library(name) if !libraries.insert(name.as_str()) => {}
            Naming::Library(_) if libraries.len() > MATERIAL_FILES => {
                let problem = format!("it names more than {MATERIAL_FILES} material files; merge them");
                return Err(Error::model(path, problem));
            }
            Naming::Library(name) => {
                let (text, files) = library(folder, name).unwrap_or_else(|sentence| {
                    missing.push(sentence);
                    (Cow::Borrowed(b""), Vec::new())
                });
                soup.files.extend(files);
                let text = sound_material_lines(&text, MATERIALS - found.len())
                    .ok_or_else(|| Error::model(path, format!("it has more than {MATERIALS} materials; merge some")))?;
                let (more, more_numbers) = tobj::load_mtl_buf(&mut text.as_slice()).map_err(|error| {
                    Error::model(path, format!("its materials cannot be read ({})", shown(&error.to_string())))
                })?;
                numbers.extend(more_numbers.into_iter().map(|(name, number)| (name, found.len() + number)));
                found.extend(more);
            }
            Naming::Use(name) => {
                soup.polygon_materials.resize(*before, current);
                current = numbers.get(name).map_or(NONE, |number| *number as u32);
                used.insert(name.as_str());
            }
        }
    }
    if !used.is_empty() {
        soup.polygon_materials.resize(soup.polygon_count(), current);
    }
    let unknown = used.iter().filter(|name| !numbers.contains_key(**name)).count();
    // A missing file's materials are missing with it: counted once, said once.
    soup.defects.missing_materials = unknown.max(missing.len());
    if unknown > 0 && missing.is_empty() {
        remarks.push(format!(
            "{path}: {unknown} of the materials it uses are in no material file; their faces get the default colour"
        ));
    }
    skin::remark(path, missing, "material files are missing or were not read", remarks);
    soup.materials = found.into_iter().map(material).collect();
    Ok(())
}

fn material(material: tobj::Material) -> Material {
    Material {
        name: material.name,
        color: material.diffuse.map(|color| color.map(|channel| channel.clamp(0.0, 1.0) as f32)),
        texture: material.diffuse_texture.map(PathBuf::from),
        texture_within: None,
        embedded: None,
    }
}

/// Only the material statements used here, and only where they are complete: tobj panics on `Kd 1`. `None` where there are
/// more than `most` materials.
fn sound_material_lines(text: &[u8], most: usize) -> Option<Vec<u8>> {
    let (mut sound, mut count) = (String::new(), 0);
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
            count += usize::from(keyword == "newmtl");
            let rest = if keyword == "map_Kd" { texture_name(rest) } else { rest.trim() };
            // tobj cuts names at fixed columns, so exactly one blank goes before them.
            sound.push_str(&format!("{keyword} {rest}\n"));
        }
    }
    (count <= most).then(|| sound.into_bytes())
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec2};

    fn soup(text: &str) -> Soup {
        read(text.as_bytes(), "test.obj", &Folder::of_files(&[]), &mut Vec::new()).unwrap()
    }

    fn message(text: &str) -> String {
        read(text.as_bytes(), "test.obj", &Folder::of_files(&[]), &mut Vec::new()).unwrap_err().to_string()
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
    fn free_form_statements_are_said_and_the_old_name_of_a_face_is_understood() {
        let free = "cstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nend\ncurv 0 1 1 2 3 4\ncurv 0 1 4 3 2 1\nend\n";
        let mut remarks = Vec::new();
        let text = format!("{SQUARE}{free}fo 1 2 3 4\n");
        let soup = read(text.as_bytes(), "test.obj", &Folder::of_files(&[]), &mut remarks).unwrap();
        assert_eq!(soup.corners.len(), 4);
        let sentence =
            "test.obj: 1 free-form surface and 2 free-form curves not drawn; to see them, export them as polygons";
        assert_eq!(remarks, [sentence]);
        let alone = message(&format!("{SQUARE}bzp 1 2 3 4\n"));
        assert_eq!(alone, "test.obj: it has no faces but 1 free-form surface; export it as polygons");
    }

    #[test]
    fn a_file_that_ends_within_a_face_is_said_to_be_cut_off() {
        for (end, is_cut) in
            [("f 1 ", true), ("f", true), ("f 1 2", true), ("f 1 2 3", false), ("f 1 2\n", false), ("", false)]
        {
            let mut remarks = Vec::new();
            let text = format!("{SQUARE}f 1 2 3\n{end}");
            read(text.as_bytes(), "test.obj", &Folder::of_files(&[]), &mut remarks).unwrap();
            let sentence = "test.obj: its last line is a face without three corners; the file may be cut off";
            assert_eq!(remarks, if is_cut { vec![sentence] } else { vec![] }, "{end:?}");
        }
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
            "test.obj: line 3: a vertex is not three numbers; correct this line or export the model again"
        );
        assert!(message(&format!("{SQUARE}f 1 b 3\n")).contains("line 5: a face"));
        assert!(message("v 1 2").contains("line 1"));
    }

    #[test]
    fn materials_are_kept_with_colour_and_texture_and_half_a_colour_does_not_panic() {
        let text = format!("mtllib m.mtl\n{SQUARE}usemtl red\nf 1 2 3\nusemtl none\nf 1 3 4\n");
        let mtl = b"newmtl red\nKd 1 0.5 0\nmap_Kd skin.png\nKd 1\nKa x\n";
        let soup = read(text.as_bytes(), "t.obj", &Folder::of_files(&[("t.mtl", mtl)]), &mut Vec::new()).unwrap();
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
            let mtl = sound_material_lines(format!("newmtl a\nmap_Kd\t{statement}\r\n").as_bytes(), 9).unwrap();
            let soup = read(text.as_bytes(), "t.obj", &Folder::of_files(&[("t.mtl", &mtl)]), &mut Vec::new()).unwrap();
            assert_eq!(soup.materials[0].texture, Some(PathBuf::from(name)));
        }
    }

    #[test]
    fn material_names_with_hash_signs_blanks_and_tabs_are_found_and_unknown_ones_counted() {
        let text = format!("mtllib a b.mtl\n{SQUARE}  usemtl\tMaterial_#25 x\nf 1 2 3 # red\nusemtl other\nf 1 3 4\n");
        let mtl = b"newmtl Material_#25 x\nKd 1 0 7\n";
        let soup = read(text.as_bytes(), "t.obj", &Folder::of_files(&[("t.mtl", mtl)]), &mut Vec::new()).unwrap();
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
    fn unusual_white_space_separates_words() {
        for space in ['\u{b}', '\u{a0}', '\u{3000}', '\t'] {
            let soup = soup(&format!("{SQUARE}f 1{space}2{space}3\nf 1 3 4\n"));
            let positions: Vec<u32> = soup.corners.iter().map(|corner| corner.position).collect();
            assert_eq!(positions, [0, 1, 2, 0, 2, 3], "{space:?}");
        }
    }

    #[test]
    fn a_material_file_that_is_a_device_is_not_read() {
        let text = format!("mtllib /dev/zero\n{SQUARE}f 1 2 3\n");
        let soup = read(text.as_bytes(), "t.obj", &Folder::of("/t.obj", true), &mut Vec::new()).unwrap();
        assert_eq!(soup.defects.missing_materials, 1);
    }

    #[test]
    fn a_missing_material_file_is_remarked_and_counted() {
        let mut remarks = Vec::new();
        let text = format!("mtllib no-such.mtl\n{SQUARE}f 1 2 3\n");
        let soup = read(text.as_bytes(), "t.obj", &Folder::of("/nowhere/t.obj", false), &mut remarks).unwrap();
        assert_eq!(soup.defects.missing_materials, 1);
        assert!(remarks[0].starts_with("t.obj: the material file no-such.mtl"), "{remarks:?}");
    }
}
