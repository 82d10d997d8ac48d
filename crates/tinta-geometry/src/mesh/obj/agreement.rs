//! Tests that this reader and [`twin`] understand files alike, whatever pieces they are cut into.

use super::super::NONE;
use super::super::folder::Folder;
use super::super::soup::Soup;
use super::{read_in_pieces, twin};
use crate::error::Result;
use glam::{DVec3, Vec2, Vec3};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The parts of a soup that mean anything, and what was remarked; or the sentence why there is none.
type Understood = std::result::Result<(Soup, Vec<String>), String>;

/// Both readers' opinions of a text, that of the pieces' for a piece's length.
fn both(bytes: &[u8], length: usize, folder: &Folder<'_>) -> [Understood; 2] {
    let understood = |read: &dyn Fn(&mut Vec<String>) -> Result<Soup>| {
        let mut remarks = Vec::new();
        read(&mut remarks).map(|soup| (meaning(soup), remarks)).map_err(|error| error.to_string())
    };
    [
        understood(&|remarks| read_in_pieces(bytes, length, "a.obj", folder, remarks)),
        understood(&|remarks| twin::read(bytes, "a.obj", folder, remarks)),
    ]
}

/// The twin knows only what faces name, and no colours, and writes out that no face has a material.
fn meaning(mut soup: Soup) -> Soup {
    fn keep<T: Copy>(values: &mut [T], named: impl Iterator<Item = u32>, zero: T) {
        let named: BTreeSet<u32> = named.collect();
        (0..).zip(values).filter(|(index, _)| !named.contains(index)).for_each(|(_, value)| *value = zero);
    }
    keep(&mut soup.positions, soup.corners.iter().map(|corner| corner.position), DVec3::ZERO);
    keep(&mut soup.normals, soup.corners.iter().map(|corner| corner.normal), Vec3::ZERO);
    keep(&mut soup.texture_coordinates, soup.corners.iter().map(|corner| corner.texture), Vec2::ZERO);
    soup.polygon_materials.resize(soup.polygon_count(), NONE);
    soup.colors.clear();
    soup
}

/// Compared as text, in which a number that is none equals itself.
fn assert_same(bytes: &[u8], length: usize, folder: &Folder<'_>) {
    let [ours, twins] = both(bytes, length, folder).map(|understood| format!("{understood:?}"));
    // A fourth field that is empty is what the twin's two halves do not agree on.
    if !twins.contains("read in two ways") {
        assert!(ours == twins, "{}\n{ours:.900}\n{twins:.900}", String::from_utf8_lossy(bytes));
    }
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
            assert_same(&bytes, 10_000, &Folder::of(path.to_str().unwrap(), true));
        }
    }
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(3000))]

    /// Statements of words that are mostly right, any white space between them, in pieces of any length.
    #[test]
    fn any_text_is_read_as_tobj_reads_it(
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
        assert_same(text.as_bytes(), length, &materials);
    }
}
