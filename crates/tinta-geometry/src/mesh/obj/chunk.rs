//! One piece of an OBJ file: its statements' declarations, or a sentence for an unreadable line.
//!
//! Pieces are read in parallel. Each gets the number of vertices declared before it: negative indices count from there, and the
//! others must stay below.

use super::super::NONE;
use super::super::soup::{Corner, direction};
use super::lines::{Lines, plain, resolve};
use super::quick;
use glam::{DVec3, Vec2, Vec3};
use std::ops::{Add, AddAssign};

/// The counts of declarations before a place in a file.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    pub lines: u64,
    pub positions: u32,
    pub textures: u32,
    pub normals: u32,
}

impl Counts {
    /// Counts a text's declarations.
    pub(super) fn of(text: &str) -> Self {
        let mut counts = Self::default();
        let mut lines = Lines::new(text);
        for line in lines.by_ref() {
            // The beginning of most lines is enough, without the word's end.
            match line.as_bytes() {
                [b'f', ..] => {}
                [b'v', b' ', ..] => counts.positions += 1,
                [b'v', b't', b' ', ..] => counts.textures += 1,
                [b'v', b'n', b' ', ..] => counts.normals += 1,
                _ => match line.split_whitespace().next() {
                    Some("v") => counts.positions += 1,
                    Some("vt") => counts.textures += 1,
                    Some("vn") => counts.normals += 1,
                    _ => {}
                },
            }
        }
        Self { lines: lines.number, ..counts }
    }
}

impl Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            lines: self.lines + other.lines,
            positions: self.positions + other.positions,
            textures: self.textures + other.textures,
            normals: self.normals + other.normals,
        }
    }
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// A statement about the materials or the part of the following faces.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Naming {
    /// The following faces have this material.
    Use(String),
    /// Materials are described in this file.
    Library(String),
    /// The following faces belong to this object.
    Object(String),
    /// The following faces belong to this group; of several, all names.
    Group(String),
}

/// A line that cannot be read.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Problem {
    /// Its number in the file, from 1.
    pub line: u64,
    /// The expected content.
    pub what: &'static str,
}

/// A piece's contents, in order.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    pub positions: Vec<DVec3>,
    pub normals: Vec<Vec3>,
    pub texture_coordinates: Vec<Vec2>,
    /// The colours after positions: empty, or those of the first positions; [`NO_COLOR`] for a position without one.
    pub colors: Vec<[f32; 3]>,
    /// The corners of all sound faces, by the file's own numbers from 0.
    pub corners: Vec<Corner>,
    /// The number of those faces.
    pub polygons: usize,
    /// Each face's number of corners; empty while all have three.
    pub polygon_sizes: Vec<u32>,
    /// The materials and parts named, each with the number of the piece's faces before it.
    pub namings: Vec<(usize, Naming)>,
    /// Faces of fewer than three corners, left out.
    pub degenerate_faces: usize,
    /// Faces with a vertex out of range, left out.
    pub out_of_range_faces: usize,
    /// Corners whose normal and whose texture coordinate are out of range; they are kept without it.
    pub lost: [usize; 2],
    /// Free-form curves and surfaces, left out.
    pub free_form: [usize; 2],
    /// The segments of lines and the single points, by the file's own numbers from 0.
    pub segments: Vec<[u32; 2]>,
    pub points: Vec<u32>,
}

impl Chunk {
    /// Reads a piece's text; `before` and `here` count the file's declarations before it and in it.
    pub(super) fn read(text: &str, before: Counts, here: Counts) -> Result<Self, Problem> {
        let mut piece = Self {
            positions: Vec::with_capacity(here.positions as usize),
            normals: Vec::with_capacity(here.normals as usize),
            texture_coordinates: Vec::with_capacity(here.textures as usize),
            ..Self::default()
        };
        let mut lines = Lines::new(text);
        while let Some(line) = lines.next() {
            piece.take(&line, before).map_err(|what| Problem { line: before.lines + lines.number, what })?;
        }
        Ok(piece)
    }

    fn take(&mut self, line: &str, before: Counts) -> Result<(), &'static str> {
        if self.take_quickly(line.as_bytes(), before) {
            return Ok(());
        }
        let text = line.trim_start();
        let Some(keyword) = text.split_whitespace().next() else { return Ok(()) };
        let rest = &text[keyword.len()..];
        match keyword {
            "v" => {
                let (point, color) = position(&plain(rest))?;
                if let Some(color) = color {
                    self.colors.resize(self.positions.len(), NO_COLOR);
                    self.colors.push(color);
                }
                self.positions.push(point);
            }
            "vt" => {
                let [u, v] = numbers(&plain(rest)).ok_or("a texture coordinate is not two numbers")?;
                self.texture_coordinates.push(Vec2::new(u as f32, v as f32));
            }
            "vn" => {
                let normal = numbers(&plain(rest)).ok_or("a normal is not three numbers")?;
                self.normals.push(direction(DVec3::from_array(normal)));
            }
            // The second is the name in the format of 1992.
            "f" | "fo" => self.take_face(&plain(rest), before)?,
            "p" | "l" => self.take_line(&plain(rest), before, keyword == "l")?,
            "curv" | "cdc" => self.free_form[0] += 1,
            "surf" | "cdp" | "bzp" | "bsp" => self.free_form[1] += 1,
            "usemtl" | "mtllib" => {
                // Names may hold '#' and blanks.
                let (name, naming) = (rest.trim(), if keyword == "usemtl" { Naming::Use } else { Naming::Library });
                if !name.is_empty() {
                    self.namings.push((self.polygons, naming(name.to_owned())));
                }
            }
            "o" | "g" => {
                let naming = if keyword == "o" { Naming::Object } else { Naming::Group };
                self.name_part(naming(rest.trim().to_owned()));
            }
            _ => {}
        }
        Ok(())
    }

    /// Records a part of the following faces, in place of a group without faces.
    fn name_part(&mut self, naming: Naming) {
        if matches!(self.namings.last(), Some((before, Naming::Group(_))) if *before == self.polygons) {
            self.namings.pop();
        }
        self.namings.push((self.polygons, naming));
    }

    /// Reads a line of the common form; returns whether it was one.
    fn take_quickly(&mut self, line: &[u8], before: Counts) -> bool {
        match line {
            [b'v', b' ', rest @ ..] => {
                let Some(point) = quick::vertex(rest) else { return false };
                self.positions.push(point);
            }
            [b'f', b' ', rest @ ..] => {
                let start = self.corners.len();
                match quick::face(rest, self.so_far(before), &mut self.corners) {
                    Some(count @ 3..) => self.end_face(count),
                    _ => {
                        self.corners.truncate(start);
                        return false;
                    }
                }
            }
            _ => return false,
        }
        true
    }

    /// Returns the number of positions, texture coordinates and normals so far.
    fn so_far(&self, before: Counts) -> [u32; 3] {
        [
            before.positions + self.positions.len() as u32,
            before.textures + self.texture_coordinates.len() as u32,
            before.normals + self.normals.len() as u32,
        ]
    }

    /// Counts a face whose corners are recorded.
    fn end_face(&mut self, count: usize) {
        if count != 3 || !self.polygon_sizes.is_empty() {
            self.polygon_sizes.resize(self.polygons, 3);
            self.polygon_sizes.push(count as u32);
        }
        self.polygons += 1;
    }

    /// Records the vertices of a line as its segments, or as single points: those of a statement of points, and a line of one.
    /// Counts a statement with a vertex out of range as faulty.
    fn take_line(&mut self, text: &str, before: Counts, is_line: bool) -> Result<(), &'static str> {
        let [positions, ..] = self.so_far(before);
        let position = |word: &str| {
            let number = word.split('/').next().unwrap_or_default();
            resolve(number.as_bytes(), positions).filter(|index| *index != NONE)
        };
        let vertices: Option<Vec<u32>> = text.split_ascii_whitespace().map(position).collect();
        let vertices = vertices.ok_or("a line or a point is not a list of vertex numbers")?;
        if vertices.iter().any(|vertex| *vertex >= positions) {
            self.out_of_range_faces += 1;
        } else if is_line && vertices.len() > 1 {
            self.segments.extend(vertices.windows(2).map(|pair| [pair[0], pair[1]]));
        } else {
            self.points.extend(vertices);
        }
        Ok(())
    }

    /// Records a face's corners, or counts it as faulty if it has too few or one out of range.
    fn take_face(&mut self, text: &str, before: Counts) -> Result<(), &'static str> {
        let [positions, textures, normals] = self.so_far(before);
        let start = self.corners.len();
        let (mut is_in_range, mut lost) = (true, [0, 0]);
        for word in text.split_ascii_whitespace() {
            let mut fields = word.as_bytes().split(|byte| *byte == b'/');
            let mut index = |count: u32| fields.next().map_or(Some(NONE), |field| resolve(field, count));
            let corner = (index(positions), index(textures), index(normals));
            let ((Some(position), Some(texture), Some(normal)), None) = (corner, fields.next()) else {
                return Err("a face is not a list of vertex numbers");
            };
            is_in_range &= position < positions;
            let within = |index: u32, count: u32, lost: &mut usize| {
                let is_lost = index != NONE && index >= count;
                *lost += usize::from(is_lost);
                if is_lost { NONE } else { index }
            };
            let normal = within(normal, normals, &mut lost[0]);
            let texture = within(texture, textures, &mut lost[1]);
            self.corners.push(Corner { position, normal, texture });
        }
        let count = self.corners.len() - start;
        if count < 3 || !is_in_range {
            self.corners.truncate(start);
            *(if is_in_range { &mut self.degenerate_faces } else { &mut self.out_of_range_faces }) += 1;
            return Ok(());
        }
        self.lost = [self.lost[0] + lost[0], self.lost[1] + lost[1]];
        self.end_face(count);
        Ok(())
    }
}

/// A vertex without a colour.
pub(super) const NO_COLOR: [f32; 3] = [f32::NAN; 3];

/// Reads three numbers, and divides them by a fourth, the weight, if it is the last. If more follow, the next three are a
/// colour.
fn position(text: &str) -> Result<(DVec3, Option<[f32; 3]>), &'static str> {
    const NO_VERTEX: &str = "a vertex is not three numbers";
    let mut words = text.split_ascii_whitespace();
    let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
    let (Some(x), Some(y), Some(z)) = (number(), number(), number()) else { return Err(NO_VERTEX) };
    let point = DVec3::new(x, y, z);
    let rest: Vec<&str> = words.take(3).collect();
    match rest.as_slice() {
        [weight] => match weight.parse::<f64>() {
            Ok(0.0) => Err("a vertex has weight 0"),
            Ok(weight) => Ok((point / weight, None)),
            Err(_) => Err(NO_VERTEX),
        },
        [red, green, blue] => {
            let channels = [red, green, blue].map(|word| word.parse().unwrap_or(f32::NAN));
            Ok((point, channels.iter().all(|channel| channel.is_finite()).then_some(channels)))
        }
        _ => Ok((point, None)),
    }
}

/// The first numbers of a line; more may follow.
fn numbers<const COUNT: usize>(text: &str) -> Option<[f64; COUNT]> {
    let mut words = text.split_ascii_whitespace();
    let mut numbers = [0.0; COUNT];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    Some(numbers)
}
