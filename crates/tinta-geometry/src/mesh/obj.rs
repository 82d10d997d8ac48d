//! Wavefront OBJ, with MTL colours and textures.
//!
//! The file is cut between lines into pieces, which all cores read in parallel. A first pass counts each piece's declarations,
//! which gives each piece its faces' indices. tobj is only the tests' second opinion on sound files: it takes three times as
//! long on one core, stops at the first index out of range, knows no line numbers and invents normals for corners that have
//! none.

#[cfg(test)]
mod agreement_tests;
mod lines;
mod material_files;
mod emission;
mod materials;
mod chunk;
mod parts;
mod quick;

use super::folder::Folder;
use super::soup::Soup;
use super::text;
use crate::error::{Error, Result};
use crate::threads::{cores, in_chunks};
use chunk::{Chunk, Counts, Naming, Place};

/// Size of a piece. Much less than a core's share, because another core opens the GL context meanwhile.
const PIECE_BYTES: usize = 1 << 20;

/// Whether the beginning of a file reads like OBJ: text with a line of one of its statements.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let head = text::head(bytes);
    const STATEMENTS: [&[u8]; 10] = [b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"vp"];
    !head.contains(&0)
        && head.split(|byte| matches!(byte, b'\n' | b'\r')).any(|line| {
            let word = line.trim_ascii_start().split(u8::is_ascii_whitespace).next().unwrap_or_default();
            STATEMENTS.contains(&word)
        })
}

/// Reads an OBJ file's bytes. `path` is for messages; `remarks` gets a sentence for each missing material file.
pub(super) fn read(bytes: &[u8], path: &str, folder: &Folder<'_>, remarks: &mut Vec<String>) -> Result<Soup> {
    let bytes = &*text::with_newlines(bytes);
    let soup = read_in_pieces(bytes, PIECE_BYTES, path, folder, remarks)?;
    if ends_in_a_face(bytes) {
        remarks.push(format!("{path}: its last line is a face without three corners; the file may be cut off"));
    }
    Ok(soup)
}

/// Reads pieces of about `length` bytes; the result does not depend on the length.
fn read_in_pieces(
    bytes: &[u8],
    length: usize,
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    let pieces = lines::pieces(bytes, length);
    let counted = in_chunks(pieces.len(), 1, cores(), |piece| {
        // Only names may contain invalid UTF-8.
        let text = String::from_utf8_lossy(pieces[piece.start]);
        let counts = Counts::of(&text);
        (text, counts)
    });
    let mut all = Counts::default();
    let mut starts = Vec::with_capacity(counted.len());
    for (_, counts) in &counted {
        starts.push(all);
        all += *counts;
    }
    let pieces = in_chunks(pieces.len(), 1, cores(), |piece| {
        let (text, here) = &counted[piece.start];
        Chunk::read(text, Place { before: starts[piece.start], here: *here, all })
    });
    let pieces: std::result::Result<Vec<Chunk>, chunk::Problem> = pieces.into_iter().collect();
    let pieces = pieces.map_err(|problem| {
        Error::model(path, format!("{}; correct this line or export the model again", problem.what))
            .at(Some(problem.line))
    })?;
    let free_form = pieces
        .iter()
        .fold([0, 0], |[curves, surfaces], piece: &Chunk| [curves + piece.free_form[0], surfaces + piece.free_form[1]]);
    let (mut soup, namings) = joined(pieces);
    if let Some(left_out) = free_form_in_words(free_form) {
        if soup.corners.is_empty() {
            return Err(Error::model(path, format!("it has no faces but {left_out}; export it as polygons")));
        }
        remarks.push(format!("{path}: {left_out} not drawn; to see them, export them as polygons"));
    }
    parts::put_on(&mut soup, &namings);
    materials::put_on(&mut soup, &namings, path, folder, remarks)?;
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

/// Joins all pieces, and returns the named materials and parts with the number of faces before each.
fn joined(pieces: Vec<Chunk>) -> (Soup, Vec<(usize, Naming)>) {
    let mut soup = Soup::default();
    let (mut namings, mut painted) = (Vec::new(), Vec::new());
    let mut polygons = 0;
    let has_only_triangles = pieces.iter().all(|piece| piece.polygon_sizes.is_empty());
    soup.positions.reserve_exact(pieces.iter().map(|piece| piece.positions.len()).sum());
    soup.corners.reserve_exact(pieces.iter().map(|piece| piece.corners.len()).sum());
    let has_colors = pieces.iter().any(|piece| !piece.colors.is_empty());
    for mut piece in pieces {
        if has_colors {
            piece.colors.resize(piece.positions.len(), chunk::NO_COLOR);
            soup.colors.append(&mut piece.colors);
        }
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
        soup.defects.unusable_normals += piece.lost[0];
        soup.defects.unusable_texture_coordinates += piece.lost[1];
        soup.segments.append(&mut piece.segments);
        soup.points.append(&mut piece.points);
        painted.append(&mut piece.painted);
    }
    make_shares(&mut soup.colors);
    if !has_colors && !painted.is_empty() {
        painted.resize(soup.positions.len(), [1.0; 3]);
        soup.colors = painted;
    }
    (soup, namings)
}

/// Converts colours to shares of full light: of 1, or of 255 if any channel is above 1. Vertices without a colour are white.
fn make_shares(colors: &mut [[f32; 3]]) {
    let full = if colors.as_flattened().iter().any(|channel| *channel > 1.0) { 255.0 } else { 1.0 };
    for channel in colors.as_flattened_mut() {
        *channel = if channel.is_nan() { 1.0 } else { (*channel / full).clamp(0.0, 1.0) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::NONE;
    use glam::{DVec3, Vec2};
    use std::path::PathBuf;

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
        let soup = soup(&format!("{SQUARE}f 1 2 9\nf 0 1 2\nf -9 1 2\nf 1 2 3\nf 1 2\n"));
        assert_eq!(soup.corners.len(), 3);
        assert_eq!(soup.defects.out_of_range_faces, 3);
        assert_eq!(soup.defects.degenerate_triangles, 1);
    }

    #[test]
    fn faces_keep_their_corners_where_normals_and_texture_coordinates_are_not_there() {
        let soup = soup(&format!("{SQUARE}vn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf 1//2 2//1 3\nf 1/7 2 9/7\n"));
        let corners: Vec<_> = soup.corners.iter().map(|own| [own.position, own.texture, own.normal]).collect();
        let quad = [0, 1, 2, 3].map(|position| [position, NONE, 0]);
        assert_eq!(corners, [&quad[..], &[[0, NONE, NONE], [1, NONE, 0], [2, NONE, NONE]]].concat());
        let defects = &soup.defects;
        assert_eq!(
            [defects.unusable_normals, defects.unusable_texture_coordinates, defects.out_of_range_faces],
            [1, 4, 1]
        );
        let mesh = soup.into_mesh("t.obj", &crate::LoadOptions::default()).unwrap();
        assert_eq!(mesh.triangles.len(), 3);
    }

    #[test]
    fn points_and_lines_are_read_whether_there_are_faces_or_not() {
        let text = format!("{SQUARE}l 1/7 2\np 1 -1\nl 2 3 4 # open\nl 4\n");
        for faces in ["", "f 1 2 3\n"] {
            let soup = soup(&format!("{text}{faces}"));
            assert_eq!(soup.segments, [[0, 1], [1, 2], [2, 3]]);
            assert_eq!(soup.points, [0, 3, 3]);
            let mesh = soup.into_mesh("t.obj", &crate::LoadOptions::default()).unwrap();
            assert_eq!((mesh.curves.segments.len(), mesh.curves.points.len()), (3, 3));
            assert!(mesh.defects.is_empty(), "a curve uses its vertices: {}", mesh.defects);
            assert_eq!(mesh.triangles.len(), usize::from(!faces.is_empty()));
        }
    }

    #[test]
    fn bad_lines_are_counted_or_said_and_the_others_kept() {
        let soup = soup(&format!("{SQUARE}v nan 0 0\nl 1 9\np 0\nl 1 5\nl 2 2\nl 1 2\n"));
        assert_eq!((soup.defects.out_of_range_faces, soup.segments.len()), (2, 3));
        let mesh = soup.into_mesh("t.obj", &crate::LoadOptions::default()).unwrap();
        assert_eq!((mesh.curves.segments.len(), mesh.defects.non_finite_vertices), (1, 1));
        let sentence = "line 5: a line or a point is not a list of vertex numbers";
        assert!(message(&format!("{SQUARE}l 1 x\n")).contains(sentence));
    }

    #[test]
    fn negative_indices_count_from_where_they_stand() {
        let soup = soup("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -1 -2 -3\n");
        let positions: Vec<u32> = soup.corners.iter().map(|corner| corner.position).collect();
        assert_eq!(positions, [2, 1, 0, 5, 4, 3]);
    }

    #[test]
    fn carriage_returns_alone_end_lines() {
        let text = format!("{SQUARE}f 1 2 3\n").replace('\n', "\r");
        assert_eq!(soup(&text).corners.len(), 3);
        assert!(looks_like(b"# a model\rv 1 2 3\r"));
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
        let mtl = b"newmtl red\nKd 1 0.5 0\nmap_Kd skin.png\nKd 1 0\nKa x\n";
        let soup = read(text.as_bytes(), "t.obj", &Folder::of_files(&[("t.mtl", mtl)]), &mut Vec::new()).unwrap();
        assert_eq!(soup.polygon_materials, [0, NONE]);
        assert_eq!(soup.materials[0].color, Some([1.0, 0.5, 0.0]));
        assert_eq!(soup.materials[0].texture, Some(PathBuf::from("skin.png")));
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
    fn colours_behind_vertices_are_shares_of_1_or_bytes_and_vertices_without_are_white() {
        let colors = |text: &str| {
            // Cut between any two lines, too.
            let read = |length| {
                read_in_pieces(text.as_bytes(), length, "t.obj", &Folder::of_files(&[]), &mut Vec::new()).unwrap()
            };
            let soup = read(1 << 20);
            assert_eq!(read(1).colors, soup.colors, "{text}");
            assert_eq!(soup.positions[2], DVec3::Y);
            soup.colors
        };
        let white = [1.0; 3];
        let shares = colors("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nv 1 1 0 0 0.25 -1\nf 1 2 3\n");
        assert_eq!(shares, [[1.0, 0.5, 0.0], white, white, [0.0, 0.25, 0.0]]);
        let bytes = colors("v 0 0 0\nv 1 0 0 255 51 1 # red\nv 0 1 0 0 102 0 255\nf 1 2 3\n");
        assert_eq!(bytes, [white, [1.0, 0.2, 1.0 / 255.0], [0.0, 0.4, 0.0]]);
        assert!(colors("v 0 0 0\nv 1 0 0 1\nv 0 1 0 1 0\nf 1 2 3\n").is_empty(), "a weight, and nothing known");
        assert_eq!(colors("v 0 0 0 1 x 0\nv 1 0 0 0 0 0\nv 0 1 0\nf 1 2 3\n"), [white, [0.0; 3], white]);
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
