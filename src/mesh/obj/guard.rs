//! Between an OBJ file and tobj: hands on one sound line at a time and keeps what tobj does not tell.

use super::super::NONE;
use super::super::soup::Corner;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{self, BufRead, Read};

/// A reader over a file's bytes.
pub struct Guard<'a> {
    rest: &'a [u8],
    line: Cow<'a, str>,
    /// How much of `line` was handed on.
    taken: usize,
    /// The line handed on last, 1-based.
    pub line_number: u64,
    /// Vertices, texture coordinates and normals so far.
    pub position_count: u32,
    pub texture_count: u32,
    pub normal_count: u32,
    /// The corners of the faces handed on, by the file's own numbers.
    pub corners: Vec<Corner>,
    /// How many corners each of those faces has.
    pub polygon_sizes: Vec<u32>,
    /// The materials named.
    pub materials: BTreeSet<String>,
    /// Faces of fewer than three corners, not handed on.
    pub degenerate_faces: usize,
    /// Faces with an index out of range, not handed on.
    pub out_of_range_faces: usize,
}

impl<'a> Guard<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            line: Cow::Borrowed(""),
            taken: 0,
            line_number: 0,
            position_count: 0,
            texture_count: 0,
            normal_count: 0,
            corners: Vec::new(),
            polygon_sizes: Vec::new(),
            materials: BTreeSet::new(),
            degenerate_faces: 0,
            out_of_range_faces: 0,
        }
    }

    /// Moves on to the next line worth handing to tobj; an empty `line` means the end.
    fn advance(&mut self) {
        self.taken = 0;
        while let Some(line) = self.next_logical_line() {
            if let Some(line) = self.accept(line) {
                self.line = line;
                return;
            }
        }
        self.line = Cow::Borrowed("");
    }

    /// The next line with those that continue it joined; what is not UTF-8 is replaced, as only names can hold it.
    fn next_logical_line(&mut self) -> Option<Cow<'a, str>> {
        let mut piece = String::from_utf8_lossy(self.next_physical_line()?);
        let Some(mut text) = continued(&piece) else { return Some(piece) };
        let mut joined = String::new();
        loop {
            joined.push_str(text);
            joined.push(' ');
            piece = String::from_utf8_lossy(self.next_physical_line().unwrap_or_default());
            match continued(&piece) {
                Some(more) => text = more,
                None => {
                    joined.push_str(&piece);
                    return Some(Cow::Owned(joined));
                }
            }
        }
    }

    fn next_physical_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.line_number += 1;
        let end = self.rest.iter().position(|byte| *byte == b'\n').map_or(self.rest.len(), |end| end + 1);
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        Some(line)
    }

    /// Notes what a line declares; returns what tobj shall see of it, ending in a newline.
    fn accept(&mut self, line: Cow<'a, str>) -> Option<Cow<'a, str>> {
        // tobj splits at the same, Unicode's, white space.
        let mut words = line.split_whitespace();
        match words.next()? {
            "v" => {
                self.position_count += 1;
                // Beyond three numbers a fourth is a weight, more are colours, which tobj wants on every vertex or none.
                if without_comment(&line).split_whitespace().count() > 5 {
                    let numbers: Vec<&str> = words.take(3).collect();
                    return Some(Cow::Owned(format!("v {}\n", numbers.join(" "))));
                }
            }
            "vt" => self.texture_count += 1,
            "vn" => self.normal_count += 1,
            "f" => {
                if !self.accept_face(without_comment(&line).split_whitespace().skip(1)) {
                    return None;
                }
            }
            "o" | "g" => return Some(ended(line)),
            word @ ("usemtl" | "mtllib") => {
                // Names may hold '#' and blanks; tobj wants exactly one blank before them.
                let name = line.trim_start()[word.len()..].trim();
                if word == "usemtl" {
                    self.materials.insert(name.to_owned());
                }
                return (!name.is_empty()).then(|| Cow::Owned(format!("{word} {name}\n")));
            }
            _ => return None,
        }
        if line.contains('#') {
            return Some(Cow::Owned(format!("{}\n", without_comment(&line))));
        }
        Some(ended(line))
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
            let (Ok(position), Ok(texture), Ok(normal), None) = (
                index(fields.next(), self.position_count),
                index(fields.next(), self.texture_count),
                index(fields.next(), self.normal_count),
                fields.next(),
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
}

/// A 1-based or negative, relative index as a 0-based one; [`NONE`] - 1 for what can never be in range.
fn resolve(number: i64, count: u32) -> u32 {
    let index = if number < 0 { i64::from(count).saturating_add(number) } else { number - 1 };
    u32::try_from(index).unwrap_or(NONE - 1).min(NONE - 1)
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

/// A line that goes on in the next one, without its backslash.
fn continued(line: &str) -> Option<&str> {
    line.trim_end().strip_suffix('\\').filter(|text| !text.contains('#'))
}

fn ended(line: Cow<'_, str>) -> Cow<'_, str> {
    if line.ends_with('\n') { line } else { Cow::Owned(format!("{line}\n")) }
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
        Ok(&self.line.as_bytes()[self.taken..])
    }

    fn consume(&mut self, count: usize) {
        self.taken += count;
    }
}
