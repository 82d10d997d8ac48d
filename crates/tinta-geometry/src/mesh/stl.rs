//! STL, text and binary.
//!
//! The file's facet normals are not used: the corners' order says the same and is what edges are found by. Of a text only the
//! vertices and the ends of facets count, whatever programs write around them: capitals, blanks before `solid`, `end loop` for
//! `endloop`, a name or none.

use super::number::number;
use super::soup::{Corner, Soup};
use super::text;
use crate::bytes::Bytes;
use crate::error::{Error, Result};
use crate::threads::{listed, threads_for};
use glam::DVec3;

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;

/// Whether a file's length is what its facet count says: the one sure sign of binary STL, which may begin with `solid`.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    whole_length(bytes) == Some(bytes.len() as u64)
}

/// Whether a file is STL, by its length or its beginning.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    is_binary(bytes) || is_text(bytes)
}

/// Whether the beginning of a file reads like text STL: `solid`, perhaps below comments.
fn is_text(bytes: &[u8]) -> bool {
    let head = text::head(bytes);
    let mut lines = head.split(|byte| b"\r\n".contains(byte)).map(<[u8]>::trim_ascii_start);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"));
    let is_solid = |line: &[u8]| line.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    first.is_some_and(is_solid) && !head.contains(&0)
}

const NO_VERTEX: &str = "a vertex is not three numbers; correct this line or export the model again";
const NO_TRIANGLE: &str = "the facet before it does not have three vertices; correct it or export the model again";

fn facet_count(bytes: &[u8]) -> Option<usize> {
    let field = bytes.get(80..HEADER_BYTES)?;
    Some(u32::from_le_bytes([field[0], field[1], field[2], field[3]]) as usize)
}

/// How long a binary file of so many facets is; more than some machines' memory can be.
fn whole_length(bytes: &[u8]) -> Option<u64> {
    Some(HEADER_BYTES as u64 + facet_count(bytes)? as u64 * FACET_BYTES as u64)
}

/// Reads an STL file's bytes. `path` is for messages; `remarks` gets a sentence where a text has no end, or a binary file more than
/// its header promises.
pub(super) fn read(bytes: &[u8], path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    if is_binary(bytes) {
        return Ok(binary(&bytes[HEADER_BYTES..]));
    }
    let is_text = is_text(bytes);
    if let (false, Some((facets, rest, count))) = (is_text, longer(bytes)) {
        let (mut soup, has) = (binary(&facets), facets.len() / FACET_BYTES);
        let promise = format!("{count} {}", if count == 1 { "triangle" } else { "triangles" });
        remarks.extend(soup.note_more(path, &promise, [count, has], rest));
        return Ok(soup);
    }
    if !is_text {
        return Err(Error::model(path, truncated(bytes)));
    }
    let bytes = text::with_newlines(bytes);
    let (soup, has_end) = facets(&bytes).map_err(|(line, problem)| Error::model(path, problem).at(line))?;
    if !has_end {
        remarks.push(format!("{path}: it does not end with endsolid; the file may be cut off"));
    }
    Ok(soup)
}

/// All facets of a text, whatever solid they belong to, and whether the last solid ends; else the line at fault, and a sentence.
fn facets(text: &[u8]) -> std::result::Result<(Soup, bool), (Option<u64>, &'static str)> {
    let mut soup = Soup::default();
    let (mut is_in_solid, mut is_in_facet) = (false, false);
    for (line_number, line) in (1..).zip(text.split(|byte| *byte == b'\n')) {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let keyword = words.next().unwrap_or_default().to_ascii_lowercase();
        let ended =
            if keyword == b"end" { words.clone().next().unwrap_or_default().to_ascii_lowercase() } else { vec![] };
        match (keyword.as_slice(), ended.as_slice()) {
            (b"vertex", _) => {
                let mut coordinate = || number::<f32>(std::str::from_utf8(words.next()?).ok()?).map(f64::from);
                let (Some(x), Some(y), Some(z)) = (coordinate(), coordinate(), coordinate()) else {
                    return Err((Some(line_number), NO_VERTEX));
                };
                soup.corners.push(Corner::at(soup.positions.len() as u32));
                soup.positions.push(DVec3::new(x, y, z));
            }
            (b"facet" | b"endfacet" | b"endsolid", _) | (_, b"facet" | b"solid")
                if !soup.positions.len().is_multiple_of(3) =>
            {
                return Err((Some(line_number), NO_TRIANGLE));
            }
            (b"solid", _) => is_in_solid = true,
            (b"facet", _) => is_in_facet = true,
            (b"endfacet", _) | (_, b"facet") => is_in_facet = false,
            (b"endsolid", _) | (_, b"solid") => is_in_solid = false,
            _ => {}
        }
    }
    match is_in_facet && is_in_solid {
        false => Ok((soup, !is_in_solid)),
        true => Err((None, "it ends within a facet; it is damaged or cut off, export it again")),
    }
}

/// The facets of a binary file that is longer than its header's count, what follows them, and that count. They are those of all
/// files that were joined, or as many as the size has room for, or have as many bytes behind each as it says, or are those promised.
fn longer(file: &[u8]) -> Option<(Vec<u8>, &[u8], usize)> {
    let (mut joined, mut rest) = (Vec::new(), file);
    let length_of = |bytes: &[u8]| usize::try_from(whole_length(bytes)?).ok();
    while let Some(length) = length_of(rest).filter(|length| joined.is_empty() || *length > HEADER_BYTES) {
        let Some((own, behind)) = rest.split_at_checked(length) else { break };
        joined.push(&own[HEADER_BYTES..]);
        rest = behind;
    }
    let (first, all) = (*joined.first()?, &file[HEADER_BYTES..]);
    let count = first.len() / FACET_BYTES;
    let facets = match all.len() % FACET_BYTES {
        _ if rest.is_empty() => Some(joined.concat()),
        0 => Some(all.to_vec()),
        _ => apart(Bytes(all), count),
    };
    Some(facets.map_or_else(|| (first.to_vec(), &all[first.len()..], count), |facets| (facets, &[][..], count)))
}

/// So many facets with bytes between them, as many as each says at its end; `None` if the file does not end with them.
fn apart(mut file: Bytes<'_>, count: usize) -> Option<Vec<u8>> {
    let mut facets = Vec::new();
    for _ in 0..count {
        let facet = file.take(FACET_BYTES)?;
        facets.extend(facet);
        // Nothing need follow the last.
        Bytes(&facet[FACET_BYTES - 2..]).u16().and_then(|bytes| file.take(bytes.into()));
    }
    file.0.is_empty().then_some(facets)
}

/// The soup of facets.
fn binary(facets: &[u8]) -> Soup {
    let count = facets.len() / FACET_BYTES;
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
    use crate::mesh::Defects;

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
            let soup = read(&binary(header, &[TRIANGLE; 2]), "t.stl", &mut Vec::new()).unwrap();
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
            let soup = read(text.as_bytes(), "t.stl", &mut Vec::new()).unwrap();
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
        let text = solid("2") + &solid("inf") + &solid("-nan(ind)") + &solid("-1.#IND");
        let soup = read(text.as_bytes(), "t.stl", &mut Vec::new()).unwrap();
        assert_eq!(soup.positions.len(), 12);
        assert_eq!(soup.positions[0].x, 2.0);
        assert!([3, 6, 9].iter().all(|vertex| !soup.positions[*vertex].is_finite()));
    }

    /// A text's positions and the remarks about it.
    fn of_text(text: &str) -> std::result::Result<(usize, usize), String> {
        let mut remarks = Vec::new();
        let soup = read(text.as_bytes(), "t.stl", &mut remarks).map_err(|error| error.to_string())?;
        Ok((soup.corners.len(), remarks.len()))
    }

    const FACET: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n";

    #[test]
    fn what_programs_write_around_the_facets_does_no_harm() {
        let apart = FACET.replace("endloop", "end loop").replace("endfacet", "END facet");
        for text in [
            format!("solid x\n{FACET}endsolid x\n"),
            format!(" solid\n{FACET}endsolid\n"),
            format!("# made by a test\n\nsolid\n{FACET}endsolid\n"),
            format!("\n\t\nsolid x\n{FACET}\n  \nendsolid"),
            format!("solid x\n{FACET}end solid x\n"),
            format!("solid x\n{apart}endsolid x\n"),
            format!("solid x\ncolor 1 0 0\n{FACET}endsolid x\n"),
            format!("solid {}\n{FACET}endsolid\n", "x".repeat(3000)),
            format!("solid x\n{FACET}endsolid x\n").replace('\n', "\r"),
            format!("solid x\n{FACET}endsolid x\n").replace('\n', "\r\n"),
        ] {
            assert_eq!(of_text(&text), Ok((3, 0)), "{text}");
        }
        let no_end = format!("solid x\n{FACET}");
        assert_eq!(of_text(&no_end), Ok((3, 1)), "a remark, for all of its facets are whole");
    }

    #[test]
    fn a_text_that_ends_within_a_facet_or_has_one_of_other_corners_is_refused() {
        let corner = "vertex 0 0 0\n";
        for (text, sentence) in [
            ("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "line 4: a vertex is not three numbers"),
            ("solid x\nfacet normal 0 0 1\nouter loop\n", "it ends within a facet"),
            (&format!("solid x\nfacet\n{corner}{corner}endfacet\nendsolid x\n"), "line 5: the facet before it"),
            (&format!("solid x\nfacet\n{}endfacet\nendsolid x\n", corner.repeat(4)), "line 7: the facet before it"),
            (&format!("solid x\nfacet\n{}", corner.repeat(3)), "it ends within a facet"),
            ("solid x\nfacet\nvertex 0 0 x\n", "line 3: a vertex is not three numbers"),
        ] {
            let message = of_text(text).unwrap_err();
            assert!(message.starts_with("t.stl: ") && message.contains(sentence), "{message}");
        }
    }

    /// A file's triangles, its remarks and what `--strict` counts; of each triangle the third corner must be right.
    fn of_binary(bytes: &[u8]) -> (usize, Vec<String>, usize) {
        let mut remarks = Vec::new();
        let soup = read(bytes, "t.stl", &mut remarks).unwrap();
        assert!(soup.positions.chunks(3).all(|corners| corners[2] == DVec3::new(0.0, 1.0, 0.5)));
        assert_eq!(soup.defects, Defects { unpromised: soup.defects.unpromised, ..Defects::default() });
        (soup.corners.len() / 3, remarks, soup.defects.unpromised)
    }

    #[test]
    fn what_a_file_holds_beyond_its_count_is_read_where_it_is_facets_and_said() {
        let three = binary(b"x", &[TRIANGLE; 3]);
        let promising = |count: u32, more: &[u8]| {
            let mut file = [three.as_slice(), more].concat();
            file[80..84].copy_from_slice(&count.to_le_bytes());
            of_binary(&file)
        };
        let said = |words: &str| vec![format!("t.stl: its header promises {words}")];
        assert_eq!(promising(3, b""), (3, vec![], 0));
        assert_eq!(promising(1, b""), (3, said("1 triangle, the file has 3"), 2));
        assert_eq!(promising(0, b""), (3, said("0 triangles, the file has 3"), 3));
        // Files joined into one; as many headers as facets have room in are no facets.
        assert_eq!(promising(3, &binary(b"y", &[TRIANGLE; 2])), (5, said("3 triangles, the file has 5"), 2));
        let more = binary(b"y", &[TRIANGLE]).repeat(25);
        assert_eq!(promising(3, &more), (28, said("3 triangles, the file has 28"), 25));
        for padding in [&[0; 2][..], b"\r\n", &[0; 84], &[0; 168]] {
            assert_eq!(promising(3, padding), (3, vec![], 0));
        }
        for more in [&b"end"[..], &three[..90]] {
            assert_eq!(promising(3, more), (3, said("3 triangles; what follows them is not read"), 1));
        }
    }

    #[test]
    fn bytes_between_facets_are_passed_over_where_each_says_how_many() {
        let record = |between: u16| {
            let facet = &binary(b"", &[TRIANGLE])[HEADER_BYTES..];
            [&facet[..48], &between.to_le_bytes(), &vec![7; between.into()]].concat()
        };
        let file = |records: &[Vec<u8>]| [&[0; 80][..], &3u32.to_le_bytes(), &records.concat()].concat();
        let all = file(&[record(4), record(0), record(300)]);
        assert_eq!(of_binary(&all), (3, vec![], 0));
        assert_eq!(of_binary(&all[..all.len() - 300]), (3, vec![], 0), "only between them");
        // Colours in the same place mean nothing.
        let colors = [record(4), record(4), record(4)].map(|record| record[..FACET_BYTES].to_vec());
        assert_eq!(of_binary(&file(&colors)), (3, vec![], 0));
    }

    #[test]
    fn a_cut_off_file_is_refused_with_both_sizes() {
        let mut bytes = binary(b"x", &[TRIANGLE; 2]);
        bytes.truncate(150);
        let message = read(&bytes, "t.stl", &mut Vec::new()).unwrap_err().to_string();
        assert!(message.contains("promises 2 triangles in 184 bytes but the file has 150"), "{message}");
    }
}
