//! One piece of an OBJ file: its statements' declarations, or a sentence for an unreadable line.
//!
//! Pieces are read in parallel. Each gets the number of vertices declared before it, from where negative indices count, and the
//! number in the whole file, because a face may come before its vertices.

use super::super::NONE;
use super::super::number::number;
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

/// A piece's place: the declarations before it, in it and in the whole file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub before: Counts,
    pub here: Counts,
    pub all: Counts,
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
    /// The colours that ZBrush writes as comments, in the order of the file's positions.
    pub painted: Vec<[f32; 3]>,
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
    /// Reads a piece's text.
    pub(super) fn read(text: &str, place: Place) -> Result<Self, Problem> {
        let mut piece = Self {
            positions: Vec::with_capacity(place.here.positions as usize),
            normals: Vec::with_capacity(place.here.normals as usize),
            texture_coordinates: Vec::with_capacity(place.here.textures as usize),
            ..Self::default()
        };
        let mut lines = Lines::new(text);
        while let Some(line) = lines.next() {
            piece.take(&line, place).map_err(|what| Problem { line: place.before.lines + lines.number, what })?;
        }
        Ok(piece)
    }

    fn take(&mut self, line: &str, place: Place) -> Result<(), &'static str> {
        if self.take_quickly(line.as_bytes(), place.all) {
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
            "f" | "fo" => self.take_face(&plain(rest), place)?,
            "p" | "l" => self.take_line(&plain(rest), place, keyword == "l")?,
            "#MRGB" => self.painted.extend(rest.trim().as_bytes().as_chunks::<8>().0.iter().map_while(painted)),
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
    fn take_quickly(&mut self, line: &[u8], all: Counts) -> bool {
        match line {
            [b'v', b' ', rest @ ..] => {
                let Some(point) = quick::vertex(rest) else { return false };
                self.positions.push(point);
            }
            [b'f', b' ', rest @ ..] => {
                let start = self.corners.len();
                match quick::face(rest, [all.positions, all.textures, all.normals], &mut self.corners) {
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
    fn take_line(&mut self, text: &str, place: Place, is_line: bool) -> Result<(), &'static str> {
        let [positions, ..] = self.so_far(place.before);
        let position = |word: &str| {
            let number = word.split('/').next().unwrap_or_default();
            resolve(number.as_bytes(), positions).filter(|index| *index != NONE)
        };
        let vertices: Option<Vec<u32>> = text.split_ascii_whitespace().map(position).collect();
        let vertices = vertices.ok_or("a line or a point is not a list of vertex numbers")?;
        if vertices.iter().any(|vertex| *vertex >= place.all.positions) {
            self.out_of_range_faces += 1;
        } else if is_line && vertices.len() > 1 {
            self.segments.extend(vertices.windows(2).map(|pair| [pair[0], pair[1]]));
        } else {
            self.points.extend(vertices);
        }
        Ok(())
    }

    /// Records a face's corners, or counts it as faulty if it has too few or one out of range.
    fn take_face(&mut self, text: &str, Place { before, all, .. }: Place) -> Result<(), &'static str> {
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
            is_in_range &= position < all.positions;
            let within = |index: u32, count: u32, lost: &mut usize| {
                let is_lost = index != NONE && index >= count;
                *lost += usize::from(is_lost);
                if is_lost { NONE } else { index }
            };
            let normal = within(normal, all.normals, &mut lost[0]);
            let texture = within(texture, all.textures, &mut lost[1]);
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
    let mut next = || words.next().and_then(number);
    let (Some(x), Some(y), Some(z)) = (next(), next(), next()) else { return Err(NO_VERTEX) };
    let point = DVec3::new(x, y, z);
    let rest: Vec<&str> = words.take(3).collect();
    match rest.as_slice() {
        [weight] => match number(weight) {
            Some(0.0) => Err("a vertex has weight 0"),
            Some(weight) => Ok((point / weight, None)),
            None => Err(NO_VERTEX),
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
    for slot in &mut numbers {
        *slot = number(words.next()?)?;
    }
    Some(numbers)
}

/// A vertex of ZBrush's as eight hexadecimal digits: mask, red, green, blue.
fn painted(digits: &[u8; 8]) -> Option<[f32; 3]> {
    let [_, red, green, blue] = u32::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?.to_be_bytes();
    Some([red, green, blue].map(|channel| f32::from(channel) / 255.0))
}

#[cfg(test)]
mod tests {
    use super::super::super::folder::Folder;
    use super::super::super::soup::Soup;
    use super::super::read_in_pieces;
    use crate::LoadOptions;

    /// Read whole; cut between any two lines it must be the same.
    fn soup(text: &str) -> Soup {
        let read =
            |length| read_in_pieces(text.as_bytes(), length, "t.obj", &Folder::of_files(&[]), &mut Vec::new()).unwrap();
        assert_eq!(format!("{:?}", read(1)), format!("{:?}", read(1 << 20)), "{text}");
        read(1 << 20)
    }

    #[test]
    fn faces_lines_and_points_may_come_before_their_vertices() {
        const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
        for (face, count) in
            [("1 2 3", 3), ("1/1/1 2/1/1 3/1/1", 3), ("1//1 2 3 # all", 3), ("1 2 4", 0), ("0 1 2", 0), ("-1 -2 -3", 0)]
        {
            let soup = soup(&format!("f {face}\nl 1 2\np 3\nl 1 -0\n{VERTICES}"));
            assert_eq!((soup.corners.len(), soup.segments.len(), soup.points.len()), (count, 1, 1), "{face}");
            assert_eq!(soup.defects.out_of_range_faces, 1 + usize::from(count == 0), "{face}");
            assert_eq!(soup.defects.unusable_normals + soup.defects.unusable_texture_coordinates, 0, "{face}");
        }
        let between = soup("v 0 0 0\nv 1 0 0\nf -2 2 3\nv 0 1 0\nv 0 0 1\nf -1 -2 1\n");
        let positions: Vec<u32> = between.corners.iter().map(|corner| corner.position).collect();
        assert_eq!(positions, [0, 1, 2, 3, 2, 0], "negative numbers count from where they stand");
    }

    #[test]
    fn numbers_that_are_none_in_any_librarys_spelling_cost_their_own_vertex_or_normal_alone() {
        for none in ["nan", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#INF", "-1.#INF00", "1.#J"] {
            let text = format!(
                "v 0 0 0\nv 1 0 0 # 1.#INF\nv 0 1 0\nv {none} 0 {none} # unused\nvn {none} {none} {none}\nvt {none} 0\n\
                 f 1/1/1 2//1 3//1\n"
            );
            let mesh = soup(&text).into_mesh("t.obj", &LoadOptions::default()).unwrap();
            assert_eq!((mesh.triangles.len(), mesh.positions.len()), (1, 3), "{none}");
            let defects = &mesh.defects;
            let counts = (defects.non_finite_vertices, defects.unusable_normals, defects.unusable_texture_coordinates);
            assert_eq!(counts, (1, 3, 1), "{none}");
        }
    }

    #[test]
    fn colours_that_zbrush_writes_as_comments_are_the_vertices() {
        let painted = "#MRGB ffff0000FF0033ff\n#MRGB 00000000\n";
        for text in [
            format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{painted}f 1 2 3\n"),
            format!("{painted}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ] {
            assert_eq!(soup(&text).colors, [[1.0, 0.0, 0.0], [0.0, 0.2, 1.0], [0.0; 3]]);
        }
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let white = [1.0; 3];
        assert_eq!(soup(&format!("#MRGB ff000000xfffffff\n{vertices}")).colors, [[0.0; 3], white, white]);
        assert!(soup(&format!("#MRGB x\n# MRGB ffff0000\n{vertices}")).colors.is_empty());
    }
}
