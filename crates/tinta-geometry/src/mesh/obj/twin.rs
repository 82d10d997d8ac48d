//! A second OBJ reader to test the first against: tobj's, behind a reader that hands on one sound line at a time and keeps what
//! tobj does not tell. It read everybody's files once; what it shares with the reader now is MTL files and the mesh made.

use super::super::folder::Folder;
use super::super::soup::{Corner, Soup, direction};
use super::super::{NONE, skin};
use super::materials::{described, library};
use crate::error::{Error, Result};
use glam::{DVec3, Vec2, Vec3};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::{self, BufRead, Read};
use std::path::Path;

/// What a read makes of a file; vertices, normals and texture coordinates that no face names are zero.
pub(super) fn read(bytes: &[u8], path: &str, folder: &Folder<'_>, remarks: &mut Vec<String>) -> Result<Soup> {
    let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..tobj::LoadOptions::default() };
    // What is not UTF-8 can only be in names.
    let text = String::from_utf8_lossy(bytes);
    let mut guard = Guard::new(&text);
    let missing_files = RefCell::new(Vec::new());
    let known = RefCell::new(BTreeSet::new());
    let files = RefCell::new(Vec::new());
    let materials = RefCell::new(Vec::new());
    let load_material = |name: &Path| {
        let text = match known.borrow_mut().insert(name.to_path_buf()) {
            true => match library(folder, name.to_str().unwrap()) {
                Ok((text, found)) => {
                    files.borrow_mut().extend(found);
                    text
                }
                Err(sentence) => {
                    missing_files.borrow_mut().push(sentence);
                    Cow::Borrowed(b"".as_slice())
                }
            },
            false => Cow::Borrowed(b"".as_slice()),
        };
        let more = described(&text, usize::MAX).unwrap().into_iter().map(|one| one.material).collect::<Vec<_>>();
        let named = |name: &String| tobj::Material { name: name.clone(), ..tobj::Material::default() };
        let list = more.iter().map(|material| named(&material.name)).collect();
        let numbers = more.iter().map(|material| material.name.clone()).zip(0..).collect();
        materials.borrow_mut().extend(more);
        Ok((list, numbers))
    };
    let (models, found) = tobj::load_obj_buf(&mut guard, &options, load_material)
        .map_err(|error| Error::model(path, in_words(&error)).at(Some(guard.line_number)))?;
    let found = found.map_err(|error| Error::model(path, format!("its materials cannot be read ({error})")))?;
    let missing_files = missing_files.into_inner();
    let unknown = guard.materials.iter().filter(|name| !found.iter().any(|material| material.name == **name)).count();
    let mut soup = into_soup(guard, &models, path)?;
    // A missing file's materials are missing with it: counted once, said once.
    soup.defects.missing_materials = unknown.max(missing_files.len());
    if unknown > 0 && missing_files.is_empty() {
        let (are, their) = if unknown == 1 { ("is", "its") } else { ("are", "their") };
        remarks.push(format!(
            "{path}: {unknown} of the materials it uses {are} in no material file; {their} faces get the default colour"
        ));
    }
    skin::remark(path, missing_files, "", remarks);
    soup.materials = materials.into_inner();
    soup.files = files.into_inner();
    Ok(soup)
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
    format!("{what}; correct this line or export the model again")
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
                soup.normals[normal as usize] = direction(DVec3::from_slice(&mesh.normals[from..from + 3]));
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
    (soup.defects.unusable_normals, soup.defects.unusable_texture_coordinates) = (guard.lost[0], guard.lost[1]);
    soup.points_and_lines = guard.points_and_lines;
    Ok(soup)
}

/// A reader over a file's text.
struct Guard<'a> {
    rest: &'a str,
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
    /// Faces with a vertex out of range, not handed on.
    pub out_of_range_faces: usize,
    /// Normals and texture coordinates out of range, not handed on.
    pub lost: [usize; 2],
    /// Statements of points and lines.
    pub points_and_lines: usize,
}

impl<'a> Guard<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self {
            rest: text,
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
            lost: [0, 0],
            points_and_lines: 0,
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

    /// The next line with those that continue it joined.
    fn next_logical_line(&mut self) -> Option<Cow<'a, str>> {
        let mut piece = self.next_physical_line()?;
        let Some(mut text) = continued(piece) else { return Some(Cow::Borrowed(piece)) };
        let mut joined = String::new();
        loop {
            joined.push_str(text);
            joined.push(' ');
            piece = self.next_physical_line().unwrap_or_default();
            match continued(piece) {
                Some(more) => text = more,
                None => {
                    joined.push_str(piece);
                    return Some(Cow::Owned(joined));
                }
            }
        }
    }

    fn next_physical_line(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        self.line_number += 1;
        let end = self.rest.bytes().position(|byte| byte == b'\n').map_or(self.rest.len(), |end| end + 1);
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        Some(line)
    }

    /// Notes what a line declares; returns what tobj shall see of it, ending in a newline.
    fn accept(&mut self, line: Cow<'a, str>) -> Option<Cow<'a, str>> {
        let keyword = line.split_whitespace().next()?;
        match keyword {
            "v" | "vt" | "vn" | "f" => self.accept_numbers(plain(line)),
            "o" | "g" => Some(ended(line)),
            "p" | "l" => {
                self.points_and_lines += 1;
                None
            }
            "usemtl" | "mtllib" => {
                // Names may hold '#' and blanks; tobj wants exactly one blank before them.
                let name = line.trim_start()[keyword.len()..].trim();
                if keyword == "usemtl" && !name.is_empty() {
                    self.materials.insert(name.to_owned());
                }
                (!name.is_empty()).then(|| Cow::Owned(format!("{keyword} {name}\n")))
            }
            _ => None,
        }
    }

    /// A line of numbers without its comment, its words separated by ASCII blanks.
    fn accept_numbers(&mut self, line: Cow<'a, str>) -> Option<Cow<'a, str>> {
        let mut words = line.split_ascii_whitespace();
        match words.next()? {
            "v" => {
                self.position_count += 1;
                // Beyond three numbers a fourth is a weight, more are colours, which tobj wants on every vertex or none.
                let mut numbers = words.clone();
                if numbers.by_ref().take(4).count() == 4 && numbers.next().is_some() {
                    return Some(Cow::Owned(format!("v {}\n", words.take(3).collect::<Vec<_>>().join(" "))));
                }
            }
            "vt" => self.texture_count += 1,
            "vn" => self.normal_count += 1,
            _ => {
                let (start, lost) = (self.corners.len(), self.lost);
                if !self.accept_face(words) {
                    return None;
                }
                if lost != self.lost {
                    let words: Vec<String> = self.corners[start..].iter().map(written).collect();
                    return Some(Cow::Owned(format!("f {}\n", words.join(" "))));
                }
            }
        }
        Some(ended(line))
    }

    /// Notes a face's corners. Faces with too few corners or indices out of range are counted and kept from tobj;
    /// what is not a number goes to tobj, which says so.
    fn accept_face<'t>(&mut self, words: impl Iterator<Item = &'t str>) -> bool {
        let start = self.corners.len();
        let (mut in_range, mut lost) = (true, [0, 0]);
        for word in words {
            let mut fields = word.as_bytes().split(|byte| *byte == b'/');
            let mut index = |count: u32| fields.next().map_or(Some(NONE), |field| resolve(field, count));
            let corner = (index(self.position_count), index(self.texture_count), index(self.normal_count));
            let ((Some(position), Some(mut texture), Some(mut normal)), None) = (corner, fields.next()) else {
                self.corners.truncate(start);
                return true;
            };
            in_range &= position < self.position_count;
            for (index, count, place) in [(&mut normal, self.normal_count, 0), (&mut texture, self.texture_count, 1)] {
                if *index != NONE && *index >= count {
                    *index = NONE;
                    lost[place] += 1;
                }
            }
            self.corners.push(Corner { position, normal, texture });
        }
        let count = self.corners.len() - start;
        if count < 3 || !in_range {
            self.corners.truncate(start);
            *(if in_range { &mut self.degenerate_faces } else { &mut self.out_of_range_faces }) += 1;
            return false;
        }
        self.lost = [self.lost[0] + lost[0], self.lost[1] + lost[1]];
        self.polygon_sizes.push(count as u32);
        true
    }
}

/// A corner as a file writes it.
fn written(corner: &Corner) -> String {
    let field = |index: u32| if index == NONE { String::new() } else { (index + 1).to_string() };
    match corner {
        Corner { texture: NONE, normal: NONE, .. } => field(corner.position),
        Corner { normal: NONE, .. } => format!("{}/{}", field(corner.position), field(corner.texture)),
        _ => format!("{}/{}/{}", field(corner.position), field(corner.texture), field(corner.normal)),
    }
}

/// A 1-based or negative, relative index as a 0-based one: [`NONE`] for an empty field, [`NONE`] - 1 for what can never be
/// in range, `None` for what is no whole number.
fn resolve(field: &[u8], count: u32) -> Option<u32> {
    let (negative, digits) = match field {
        [] => return Some(NONE),
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let number =
        digits.iter().fold(0i64, |number, digit| number.saturating_mul(10).saturating_add(i64::from(digit - b'0')));
    let index = if negative { i64::from(count) - number } else { number - 1 };
    Some(u32::try_from(index).unwrap_or(NONE - 1).min(NONE - 1))
}

/// A line without its comment. Other white space than ASCII's, at which tobj splits too, becomes a blank.
fn plain(line: Cow<'_, str>) -> Cow<'_, str> {
    const VERTICAL_TAB: u8 = 0x0b;
    if line.is_ascii() && !line.bytes().any(|byte| byte == b'#' || byte == VERTICAL_TAB) {
        return line;
    }
    let text = line.split('#').next().unwrap_or_default();
    Cow::Owned(text.split_whitespace().collect::<Vec<_>>().join(" "))
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
