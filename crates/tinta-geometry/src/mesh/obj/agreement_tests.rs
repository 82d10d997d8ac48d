//! Tests that tobj reads sound files alike, and that the pieces a file is cut into do not affect the result.

use super::super::NONE;
use super::super::folder::Folder;
use super::super::soup::direction;
use super::read_in_pieces;
use glam::{DVec3, Vec2, Vec3};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A face: its corners' positions, normals and texture coordinates, and the name of its material.
type Face = (Vec<(DVec3, Option<Vec3>, Option<Vec2>)>, Option<String>);

/// The faces that this reader finds, in pieces of a length.
fn ours(bytes: &[u8], length: usize, folder: &Folder<'_>) -> Vec<Face> {
    let soup = read_in_pieces(bytes, length, "a.obj", folder, &mut Vec::new()).unwrap();
    let mut corners = soup.corners.iter();
    let faces = (0..soup.polygon_count()).map(|number| {
        let size = soup.polygon_sizes.get(number).map_or(3, |size| *size as usize);
        let corners = corners.by_ref().take(size).map(|corner| {
            let normal = soup.normals.get(corner.normal as usize).copied();
            (
                soup.positions[corner.position as usize],
                normal,
                soup.texture_coordinates.get(corner.texture as usize).copied(),
            )
        });
        let material = soup.polygon_materials.get(number).filter(|material| **material != NONE);
        (corners.collect(), material.map(|material| soup.materials[*material as usize].name.clone()))
    });
    faces.collect()
}

/// The faces that tobj finds.
fn tobjs(bytes: &[u8], folder: &Folder<'_>) -> Vec<Face> {
    let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..tobj::LoadOptions::default() };
    let library = |name: &Path| tobj::load_mtl_buf(&mut &*folder.read(name, u64::MAX).unwrap_or_default());
    let (models, materials) = tobj::load_obj_buf(&mut &*bytes, &options, library).unwrap();
    let materials = materials.unwrap();
    let of_mesh = |mesh: tobj::Mesh| {
        let three = |numbers: &[f64], index: u32| DVec3::from_slice(&numbers[index as usize * 3..]);
        let two = |index: u32| [0, 1].map(|place| mesh.texcoords[index as usize * 2 + place] as f32);
        let corner = |place: usize| {
            let normal = mesh.normal_indices.get(place).map(|index| direction(three(&mesh.normals, *index)));
            let texture = mesh.texcoord_indices.get(place).map(|index| Vec2::from_array(two(*index)));
            (three(&mesh.positions, mesh.indices[place]), normal, texture)
        };
        let material = mesh.material_id.map(|material| materials[material].name.clone());
        let all: Vec<_> = (0..mesh.indices.len()).map(corner).collect();
        let mut rest = &all[..];
        let mut faces: Vec<Face> = Vec::new();
        while !rest.is_empty() {
            let (face, others) = rest.split_at(mesh.face_arities.get(faces.len()).map_or(3, |size| *size as usize));
            faces.push((face.to_vec(), material.clone()));
            rest = others;
        }
        faces
    };
    models.into_iter().flat_map(|model| of_mesh(model.mesh)).collect()
}

/// Compared as text, in which a NaN equals itself.
fn assert_same(bytes: &[u8], length: usize, folder: &Folder<'_>) {
    let [ours, tobjs] = [ours(bytes, length, folder), tobjs(bytes, folder)].map(|faces| format!("{faces:?}"));
    assert!(ours == tobjs, "{:.900}\n{ours:.900}\n{tobjs:.900}", String::from_utf8_lossy(bytes));
}

/// What is read of a text in pieces of a length, remarks too, or the sentence why nothing is.
fn understood(bytes: &[u8], length: usize, folder: &Folder<'_>) -> String {
    let mut remarks = Vec::new();
    let soup = read_in_pieces(bytes, length, "a.obj", folder, &mut remarks);
    format!("{:?}", soup.map(|soup| (soup, remarks)).map_err(|error| error.to_string()))
}

#[test]
fn every_model_at_hand_is_read_as_tobj_reads_it() {
    let public = std::env::var_os("TINTA_MODELS").map_or_else(|| "../shared/models".into(), PathBuf::from);
    for folder in [PathBuf::from("models"), public] {
        let Ok(entries) = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(&folder)) else {
            // Past the test harness, which would keep it to itself.
            let _ = writeln!(std::io::stderr(), "SKIPPED models in {}: none there", folder.display());
            continue;
        };
        let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        for path in paths.filter(|path| path.extension() == Some("obj".as_ref())) {
            let bytes = std::fs::read(&path).unwrap();
            // tobj takes a line of several points for a polygon.
            let lines = bytes.split_inclusive(|byte| *byte == b'\n');
            let bytes = lines.filter(|line| !line.starts_with(b"l ")).collect::<Vec<_>>().concat();
            assert_same(&bytes, 10_000, &Folder::of(path.to_str().unwrap(), true));
        }
    }
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(3000))]

    /// Statements without a fault.
    #[test]
    fn sound_texts_are_read_as_tobj_reads_them(
        statements in proptest::collection::vec((0usize..14, proptest::collection::vec(0usize..100, 3..7)), 0..40),
        kind in 0usize..4,
        length in 1usize..200,
    ) {
        // tobj gives corners without a normal those of others, where there are any.
        let (has_texture, has_normals) = (kind & 1 == 1, kind & 2 == 2);
        let mut text = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\n".to_owned();
        text.push_str(if has_texture { "vt 0 1\n" } else { "" });
        text.push_str(if has_normals { "vn 0 0 1\n" } else { "" });
        let mut counts = [3, 1, 1];
        for (keyword, words) in statements {
            let keyword = ["v", "v", "vt", "vn", "f", "f", "f", "f", "usemtl", "o", "g", "# f", "", "s"][keyword];
            if keyword == "vt" && !has_texture || keyword == "vn" && !has_normals {
                continue;
            }
            let number = |word: &usize| ["0", "-1.5", "2e-3", ".25", "7.", "+3", "1234567.8901234567"][word % 7];
            let index = |word: usize, of: usize| match word % 2 {
                0 => (word % counts[of] + 1).to_string(),
                _ => format!("-{}", word % counts[of] + 1),
            };
            let corner = |word: &usize| {
                let (position, texture, normal) = (index(*word, 0), index(word / 3, 1), index(word / 5, 2));
                match kind {
                    0 => position,
                    1 => format!("{position}/{texture}"),
                    2 => format!("{position}//{normal}"),
                    _ => format!("{position}/{texture}/{normal}"),
                }
            };
            let words: Vec<String> = match keyword {
                "v" | "vn" => words[..3].iter().map(number).map(str::to_owned).collect(),
                "vt" => words[..2].iter().map(number).map(str::to_owned).collect(),
                "f" => words.iter().map(corner).collect(),
                "usemtl" => vec![["red", "blue#1"][words[0] % 2].to_owned()],
                _ => words.iter().map(usize::to_string).collect(),
            };
            text.push_str(&format!("{keyword} {}{}", words.join(" "), if words.len() == 5 { "\r\n" } else { "\n" }));
            if let Some(of) = ["v", "vt", "vn"].iter().position(|counted| *counted == keyword) {
                counts[of] += 1;
            }
        }
        let materials = Folder::of_files(&[("t.mtl", b"newmtl red\nKd 1 0 0\nnewmtl blue#1\nmap_Kd a.png\n")]);
        assert_same(text.as_bytes(), length, &materials);
    }

    /// Statements of words that are mostly right, any white space between them, in pieces of any length.
    #[test]
    fn any_text_is_read_alike_in_pieces_and_whole(
        statements in proptest::collection::vec((0usize..12, proptest::collection::vec((0usize..40, 0usize..30), 0..7), 0usize..12), 0..24),
        length in 1usize..200,
    ) {
        const BLANKS: [&str; 8] = ["\t", "  ", "\u{b}", "\u{a0}", "\u{3000}", "\\\n", " \\\r\n ", "\\ \n\t"];
        const ENDS: [&str; 8] = ["\r\n", "\n\n", " # an end\n", "#\\\n", " \\\n", "\r", " \u{85}\n", "\\\u{a0}\n"];
        const RARE: [&str; 14] =
            ["-9", "1/", "1/2/", "//1", "+2", "1e999", "-", "x", "1/2/3/4", "0", "99999999999", "nan", "#", "é"];
        let mut text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 1\nvn 0 0 1\nf 1 2 3\n".to_owned();
        for (keyword, words, end) in statements {
            let keyword = ["v", "v", "v", "vt", "vn", "f", "f", "f", "usemtl", "mtllib", "o", "#"][keyword];
            text.push_str(keyword);
            // As many words as there must be, mostly.
            let wanted = match keyword {
                "v" | "vn" => 3,
                "vt" => 2,
                _ => words.len(),
            };
            for index in 0..if end == 0 { words.len() } else { wanted } {
                let (word, blank) = words.get(index).copied().unwrap_or((3, 20));
                text.push_str(BLANKS.get(blank).copied().unwrap_or(" "));
                match keyword {
                    _ if word < RARE.len() && end < 2 => text.push_str(RARE[word]),
                    "f" => text.push_str(["1", "2", "3", "-1", "-2", "-3", "1/1", "2/-1/1", "3//1", "4", "5"][word % 11]),
                    "usemtl" | "mtllib" => text.push_str(["red", "blue#1", "a"][word % 3]),
                    _ => text.push_str(["0", "-1.5", "2e-3", ".25", "7.", "+3", "1234567.8901234567"][word % 7]),
                }
            }
            text.push_str(ENDS.get(end).copied().unwrap_or("\n"));
        }
        let materials = Folder::of_files(&[("t.mtl", b"newmtl red\nKd 1 0 0\nnewmtl blue#1\nmap_Kd a.png\n")]);
        let [pieces, whole] = [length, usize::MAX].map(|length| understood(text.as_bytes(), length, &materials));
        assert!(pieces == whole, "{text}\n{pieces:.900}\n{whole:.900}");
    }
}
