//! Cuts a mesh by planes and closes the cut.
//!
//! In: a [`Mesh`] and [`SectionPlane`]s. Out: the faces behind the plane, and caps over the rings where they end at it. Faces that
//! the plane crosses are clipped; neighbours share the new vertices, so a closed mesh stays closed. Each closed shell is capped for
//! itself, with its hollows, whichever way the file winds it. Several planes cut away the part in front of all of them (`wedge.rs`).

mod caps;
mod cutter;
mod hatching;
mod rings;
mod wedge;

use super::{Curves, Mesh, NONE, Pattern, PatternMatches};
use crate::error::{Error, Result};
use crate::settings::{Kind, Problem, Value};
use crate::tolerances::ON_PLANE;
use cutter::Cutter;
pub use cutter::SECTION;
use glam::DVec3;
pub(crate) use rings::double_area;

const NO_PLANE: &str = "its numbers must be finite, and its normal not 0";

const AXES: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];

/// A plane: all points whose product with `normal` is `offset`. Everything with a larger product is cut away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPlane {
    /// Its normal, of any length above 0.
    pub normal: DVec3,
    /// The product of its points with the normal, file units.
    pub offset: f64,
    /// Whether its axes are those of the model's file as read, and its cut is hatched; otherwise it is in world space. Its text then
    /// begins with `SectionPlane::OF_FILE`.
    pub is_of_file: bool,
}

/// How far points computed on a plane lie off it, as a share of the largest coordinate: some fifty roundings.
const ROUNDED: f64 = 1e-14;

/// Planes that cut away the part in front of all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionPlanes(pub Vec<SectionPlane>);

impl SectionPlanes {
    /// The separator of two planes in a text.
    pub(super) const BETWEEN: &str = "; ";

    /// The text with the planes' axes those of the model's file.
    pub fn of_file(text: &str) -> String {
        let of_file = |plane: &str| match plane.contains('=') && !plane.starts_with(SectionPlane::OF_FILE) {
            true => SectionPlane::OF_FILE.to_owned() + plane,
            false => plane.to_owned(),
        };
        text.split(';').map(|plane| of_file(plane.trim())).collect::<Vec<_>>().join(Self::BETWEEN)
    }
}

impl Value for SectionPlanes {
    fn kind() -> Kind {
        SectionPlane::kind()
    }

    fn text(&self) -> String {
        self.0.iter().map(SectionPlane::text).collect::<Vec<_>>().join(Self::BETWEEN)
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        text.split(';').map(|plane| SectionPlane::parse(plane.trim())).collect::<std::result::Result<_, _>>().map(Self)
    }
}

/// Spacing of a cut's hatching where none is given, as a share of the cut model's diagonal.
const SPACING: f64 = 1.0 / 60.0;

/// How a plane is written.
const USAGE: &str = "write an axis, x, y or z, and where it is cut, such as x=12, or a normal and a number, such as 1,1,0=5; for a \
                     half-section give --section twice";

impl Value for SectionPlane {
    fn kind() -> Kind {
        Kind::Text { offered: &["x=0", "y=0", "z=0"], example: "x=0" }
    }

    fn text(&self) -> String {
        let axis = AXES.iter().find(|(_, axis)| *axis == self.normal);
        let normal = axis.map_or_else(|| self.normal.text(), |(name, _)| (*name).to_owned());
        let of_file = if self.is_of_file { Self::OF_FILE } else { "" };
        format!("{of_file}{normal}={}", self.offset)
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        let problem = || meant(text).map_or_else(|| USAGE.to_owned(), |meant| format!("did you mean {meant}?"));
        let (is_of_file, text) = text.strip_prefix(Self::OF_FILE).map_or((false, text), |text| (true, text));
        let (normal, offset) = text.split_once('=').ok_or_else(problem)?;
        let axis = AXES.iter().find(|(name, _)| *name == normal.trim());
        let normal = match axis {
            Some((_, axis)) => *axis,
            None => DVec3::parse(normal.trim()).map_err(|_| problem())?,
        };
        let offset: f64 = offset.trim().parse().map_err(|_| problem())?;
        let plane = Self { normal, offset, is_of_file };
        if plane.unit().is_none() {
            return Err(NO_PLANE.to_owned().into());
        }
        Ok(plane)
    }
}

/// The plane that a mistyped one means, such as `X: 3`.
fn meant(text: &str) -> Option<String> {
    let text = text.strip_prefix(SectionPlane::OF_FILE).unwrap_or(text).to_lowercase();
    let (sign, text) = text.strip_prefix('-').map_or(("", &*text), |text| ("-", text));
    let axis = text.chars().next().filter(|axis| ('x'..='z').contains(axis))?;
    let number = text[1..].trim_start_matches([' ', '=', ':', '+']);
    let offset: f64 = if number.is_empty() { 0.0 } else { number.parse().ok()? };
    offset.is_finite().then(|| format!("{sign}{axis}={offset}"))
}

impl SectionPlane {
    /// How the text of a plane begins whose axes are the file's.
    pub(crate) const OF_FILE: &str = "file:";

    /// The same plane in world space, into which a file's axes are turned so.
    pub(super) fn in_world(&self, turn: impl Fn(DVec3) -> DVec3) -> Self {
        Self { normal: if self.is_of_file { turn(self.normal) } else { self.normal }, ..*self }
    }

    /// The same plane with a normal of length 1; `None` if its numbers give no plane.
    fn unit(&self) -> Option<Self> {
        let length = self.normal.length();
        let unit = Self { normal: self.normal / length, offset: self.offset / length, ..*self };
        (unit.normal.is_finite() && unit.offset.is_finite()).then_some(unit)
    }
}

/// How planes cut a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// No part of the mesh lies in front of all planes.
    Missed,
    /// Caps close all of the cut.
    Closed,
    /// The surface is open or winds both ways, and part of the cut has no cap.
    Open,
    /// The whole mesh lies in front of the planes: no face, curve or point is left.
    Gone,
}

impl Cut {
    /// How planes cut what is left of a mesh, with caps that close all of the cut or not.
    fn of(left: &Mesh, is_closed: bool) -> Self {
        match left.is_empty() {
            true => Self::Gone,
            false if is_closed => Self::Closed,
            false => Self::Open,
        }
    }
}

impl Mesh {
    /// Cuts away the mesh in front of all of some planes in world space, and closes the cut with faces of the part [`SECTION`].
    /// `hatching` is the spacing of the strokes on the cut, file units; 0 draws none, `None` chooses one.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] if a plane is none.
    pub fn section(self, planes: &[SectionPlane], hatching: Option<f64>) -> Result<(Self, Cut)> {
        self.section_except(planes, hatching, &[])
    }

    /// The same; parts stay whole of which the last of these patterns says so.
    ///
    /// # Errors
    ///
    /// As [`Mesh::section`].
    pub(super) fn section_except(
        self,
        planes: &[SectionPlane],
        hatching: Option<f64>,
        uncut: &[(Pattern, bool)],
    ) -> Result<(Self, Cut)> {
        let unit = |plane: &SectionPlane| plane.unit().ok_or_else(|| Error::setting("section", NO_PLANE));
        let given = planes.iter().map(unit).collect::<Result<Vec<_>>>()?;
        let (low, high) = self.extent();
        let size = (high - low).length();
        let (spacing, tolerance) = (hatching.unwrap_or(size * SPACING), size * ON_PLANE);
        let mut planes: Vec<SectionPlane> = Vec::new();
        for plane in given {
            let is_it = |other: &SectionPlane| {
                plane.normal.distance(other.normal) <= ON_PLANE && (plane.offset - other.offset).abs() <= tolerance
            };
            if !planes.iter().any(is_it) {
                planes.push(plane);
            }
        }
        let uncut: Vec<(PatternMatches, bool)> =
            uncut.iter().rev().map(|(pattern, is_whole)| (pattern.named(&self), *is_whole)).collect();
        match planes.as_slice() {
            [] => Ok((self, Cut::Missed)),
            [plane] => Ok(self.cut(plane, &uncut, spacing, tolerance)),
            several => {
                // Far from the origin, points computed on a plane are rounded to either side of it.
                let farthest = low.abs().max(high.abs()).max_element();
                Ok(self.cut_by_all(several, &uncut, spacing, tolerance.max(farthest * ROUNDED)))
            }
        }
    }

    /// The mesh with the faces that a plane crosses in two parts.
    fn split(&self, plane: &SectionPlane, uncut: &[(PatternMatches, bool)], tolerance: f64) -> Self {
        let sides = self.positions.iter().map(|point| plane.side(*point, tolerance)).collect();
        let mut cutter = Cutter::new(self, sides, uncut, true);
        cutter.clip_faces(plane.normal);
        cutter.finished(self, self.curves.clone())
    }

    /// Cuts away the mesh in front of a plane. Positions within the tolerance lie in the plane.
    fn cut(&self, plane: &SectionPlane, uncut: &[(PatternMatches, bool)], spacing: f64, tolerance: f64) -> (Self, Cut) {
        let sides = |points: &[DVec3]| points.iter().map(|point| plane.side(*point, tolerance)).collect::<Vec<f64>>();
        let (sides, of_curves) = (sides(&self.positions), sides(&self.curves.positions));
        if sides.iter().chain(&of_curves).all(|side| *side <= 0.0) {
            return (self.clone(), Cut::Missed);
        }
        let mut cutter = Cutter::new(self, sides, uncut, false);
        cutter.clip_faces(plane.normal);
        let (is_closed, strokes) = cutter.close(cutter.open_sides(), plane.normal, spacing);
        let mut curves = clipped(&self.curves, &of_curves, cutter.next_vertex);
        curves.add_hatching(&strokes, &mut cutter.next_vertex);
        let mesh = cutter.finished(self, curves);
        let cut = Cut::of(&mesh, is_closed);
        (mesh, cut)
    }
}

/// The curves and points behind the plane.
fn clipped(curves: &Curves, sides: &[f64], mut next_vertex: u32) -> Curves {
    let mut kept =
        Curves { segments: Vec::new(), points: Vec::new(), labels: Vec::new(), hatching: 0, ..curves.clone() };
    for [a, b] in &curves.segments {
        let [side_a, side_b] = [a, b].map(|end| sides[*end as usize]);
        if side_a <= 0.0 && side_b <= 0.0 {
            kept.segments.push([*a, *b]);
        } else if side_a * side_b < 0.0 {
            let [first, second] = [a, b].map(|end| curves.positions[*end as usize]);
            kept.positions.push(first.lerp(second, side_a / (side_a - side_b)));
            kept.file_vertices.push(next_vertex);
            next_vertex += 1;
            let middle = kept.positions.len() as u32 - 1;
            kept.segments.push(if side_a < 0.0 { [*a, middle] } else { [middle, *b] });
        }
    }
    for (number, point) in curves.points.iter().enumerate().filter(|(_, point)| sides[**point as usize] <= 0.0) {
        let texts = curves.labels.iter().filter(|(of, _)| *of == number as u32);
        kept.labels.extend(texts.map(|(_, text)| (kept.points.len() as u32, text.clone())));
        kept.points.push(*point);
    }
    // Only the positions still used: the camera frames them all.
    let mut number = vec![NONE; kept.positions.len()];
    let mut positions = Vec::new();
    let mut file_vertices = Vec::new();
    for end in kept.segments.as_flattened_mut().iter_mut().chain(&mut kept.points) {
        let slot = &mut number[*end as usize];
        if *slot == NONE {
            *slot = positions.len() as u32;
            positions.push(kept.positions[*end as usize]);
            file_vertices.push(kept.file_vertices[*end as usize]);
        }
        *end = *slot;
    }
    Curves { positions, file_vertices, ..kept }
}
