//! STL: text through the stl_io crate, binary here, where the crate would want a copy of the file.
//!
//! The file's facet normals are not used: the corners' order says the same and is what edges are found by.

use super::soup::{Corner, Soup};
use crate::bytes::Bytes;
use crate::error::{Error, Result};
use crate::files::shown;
use crate::limits::STL_LINE_BYTES;
use crate::threads::{listed, threads_for};
use glam::DVec3;
use std::io::Cursor;

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;

/// Whether a file's length is what its facet count says: the one sure sign of binary STL, which may begin with `solid`.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    whole_length(bytes) == Some(bytes.len() as u64)
}

/// Whether the beginning of a file reads like text STL.
pub(super) fn is_text(head: &[u8]) -> bool {
    head.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !head.contains(&0)
}

fn facet_count(bytes: &[u8]) -> Option<usize> {
    let field = bytes.get(80..HEADER_BYTES)?;
    Some(u32::from_le_bytes([field[0], field[1], field[2], field[3]]) as usize)
}

/// How long a binary file of so many facets is; more than some machines' memory can be.
fn whole_length(bytes: &[u8]) -> Option<u64> {
    Some(HEADER_BYTES as u64 + facet_count(bytes)? as u64 * FACET_BYTES as u64)
}

/// Reads an STL file's bytes. `path` is for messages.
pub(super) fn read(bytes: &[u8], path: &str) -> Result<Soup> {
    let damaged = |error: std::io::Error| {
        Error::model(path, format!("it is damaged ({}); export it again", shown(&error.to_string())))
    };
    let mut non_finite = Vec::new();
    // Some programs leave a few bytes behind the last facet.
    let holds_all = whole_length(bytes).is_some_and(|length| bytes.len() as u64 >= length);
    let text = is_text(&bytes[..bytes.len().min(4096)]);
    if is_binary(bytes) || (holds_all && !text) {
        return Ok(binary(bytes));
    }
    if !text {
        return Err(Error::model(path, truncated(bytes)));
    }
    let whole = one_solid(&String::from_utf8_lossy(bytes), path, &mut non_finite)?.into_bytes();
    let mut cursor = Cursor::new(whole);
    let mut soup = Soup::default();
    for facet in stl_io::create_stl_reader(&mut cursor).map_err(damaged)? {
        for vertex in facet.map_err(damaged)?.vertices {
            soup.corners.push(Corner::at(soup.positions.len() as u32));
            soup.positions.push(DVec3::from_array(vertex.0.map(f64::from)));
        }
    }
    non_finite.into_iter().for_each(|index: usize| soup.positions[index] = DVec3::NAN);
    Ok(soup)
}

/// A binary file's facets, which are all there.
fn binary(bytes: &[u8]) -> Soup {
    let count = facet_count(bytes).unwrap_or_default();
    let facets = bytes.get(HEADER_BYTES..).and_then(|facets| facets.get(..count * FACET_BYTES)).unwrap_or_default();
    let threads = threads_for(count);
    let positions = listed(count, 3, threads, |range, positions| {
        for facet in facets[range.start * FACET_BYTES..range.end * FACET_BYTES].chunks_exact(FACET_BYTES) {
            let mut facet = Bytes(facet);
            let [_normal, corners @ ..]: [Option<[f32; 3]>; 4] = std::array::from_fn(|_| facet.floats());
            positions.extend(corners.map(|corner| DVec3::from_array(corner.unwrap_or_default().map(f64::from))));
        }
        Some(())
    });
    let corners = listed(count, 3, threads, |range, corners| {
        corners.extend((range.start * 3..range.end * 3).map(|corner| Corner::at(corner as u32)));
        Some(())
    });
    Soup { positions: positions.unwrap_or_default(), corners: corners.unwrap_or_default(), ..Soup::default() }
}

/// Text STL the way stl_io wants it: one named solid without facet normals, and without numbers that are not finite, whose
/// vertices are noted instead. stl_io reads the first solid of a file only and stops at the first normal that is not one.
fn one_solid(text: &str, path: &str, non_finite: &mut Vec<usize>) -> Result<String> {
    let mut whole = "solid x\n".to_owned();
    let mut vertex_count = 0;
    let mut last = "";
    let lower = text.to_ascii_lowercase();
    for (number, line) in (1..).zip(lower.lines()).map(|(number, line)| (number, line.trim())) {
        if line.is_empty() {
            continue;
        }
        let mut words = line.split_whitespace();
        last = words.next().unwrap_or_default();
        match last {
            "solid" | "endsolid" => continue,
            "facet" => whole.push_str("facet normal 0 0 0"),
            "vertex" if words.by_ref().filter_map(|word| word.parse::<f32>().ok()).any(|x| !x.is_finite()) => {
                non_finite.push(vertex_count);
                whole.push_str("vertex 0 0 0");
            }
            // stl_io makes a text of every word.
            _ if line.len() > STL_LINE_BYTES => {
                return Err(Error::model(
                    path,
                    "it is longer than any line of an STL file; the file is damaged, export it again",
                )
                .at(Some(number)));
            }
            _ => whole.push_str(line),
        }
        vertex_count += usize::from(last == "vertex");
        whole.push('\n');
    }
    if last != "endsolid" {
        return Err(Error::model(path, "it does not end with endsolid; it is damaged or cut off, export it again"));
    }
    whole.push_str("endsolid x\n");
    Ok(whole)
}

fn truncated(bytes: &[u8]) -> String {
    match facet_count(bytes) {
        Some(count) => format!(
            "its header promises {count} triangles in {} bytes but the file has {}; it is damaged or cut off, export it again",
            HEADER_BYTES + count * FACET_BYTES,
            bytes.len()
        ),
        None => format!("{} bytes are too few for an STL file; export it again", bytes.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binary(header: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, 0);
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0u8; 12]);
            triangle.as_flattened().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend([0u8; 2]);
        }
        bytes
    }

    const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];

    #[test]
    fn binary_files_are_read_also_when_their_header_begins_with_solid() {
        for header in [b"made by a test".as_slice(), b"solid but binary"] {
            let soup = read(&binary(header, &[TRIANGLE; 2]), "t.stl").unwrap();
            assert_eq!(soup.positions.len(), 6);
            assert_eq!(soup.positions[5], DVec3::new(0.0, 1.0, 0.5));
        }
    }

    #[test]
    fn text_files_are_read_with_and_without_a_name() {
        for name in ["", " a name"] {
            let text = format!(
                "SOLID{name}\nFacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\nendsolid\n"
            );
            let soup = read(text.as_bytes(), "t.stl").unwrap();
            assert_eq!(soup.positions[2], DVec3::new(0.0, 1.0, 0.5));
        }
    }

    #[test]
    fn all_solids_of_a_text_file_are_read_whatever_their_normals() {
        let solid = |x: &str| {
            format!(
                "solid a\nfacet normal nan nan nan\nouter loop\nvertex {x} 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
            )
        };
        let soup = read((solid("2") + &solid("inf")).as_bytes(), "t.stl").unwrap();
        assert_eq!(soup.positions.len(), 6);
        assert_eq!(soup.positions[0].x, 2.0);
        assert!(soup.positions[3].is_nan());
    }

    #[test]
    fn lines_without_end_are_refused_by_number_and_not_quoted_without_end() {
        let facet = format!("solid x\nsolidfacet {}\nendsolid x\n", "\u{4} ".repeat(400));
        let message = read(facet.as_bytes(), "t.stl").unwrap_err().to_string();
        assert!(message.starts_with("t.stl: it is damaged (") && message.len() < 1000, "{message}");
        let vertex = format!("solid x\nfacet normal 0 0 1\nouter loop\nvertex{}\nendsolid x\n", " 0".repeat(1_000_000));
        let message = read(vertex.as_bytes(), "t.stl").unwrap_err().to_string();
        assert!(message.starts_with("t.stl: line 4: it is longer than any line"), "{message}");
    }

    #[test]
    fn a_cut_off_file_is_refused_with_both_sizes() {
        let mut bytes = binary(b"x", &[TRIANGLE; 2]);
        bytes.truncate(150);
        let message = read(&bytes, "t.stl").unwrap_err().to_string();
        assert!(message.contains("promises 2 triangles in 184 bytes but the file has 150"), "{message}");
        assert!(read(b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "t.stl").is_err());
    }
}
