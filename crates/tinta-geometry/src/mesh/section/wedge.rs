//! Cuts a mesh by several planes: the part in front of all of them goes.
//!
//! The faces are split at every plane first, so those cut away are whole faces. The cap on a plane is that of a cut by it alone,
//! where it lies in front of all others: its rings are cut at each of them in turn and closed along the line of both planes.

use super::cutter::{Cutter, OpenSide};
use super::{Curves, Cut, SectionPlane, clipped};
use crate::mesh::{Mesh, PatternMatches};
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};

impl Mesh {
    /// Cuts away the mesh in front of all of several planes with normals of length 1.
    pub(super) fn cut_by_all(
        &self,
        planes: &[SectionPlane],
        uncut: &[(PatternMatches, bool)],
        spacing: f64,
        tolerance: f64,
    ) -> (Self, Cut) {
        let split = planes.iter().fold(self.clone(), |mesh, plane| mesh.split(plane, uncut, tolerance));
        let sides = |plane: &SectionPlane| split.positions.iter().map(|point| plane.side(*point, tolerance)).collect();
        let sides: Vec<Vec<f64>> = planes.iter().map(sides).collect();
        let mut cutter = Cutter::new(&split, vec![0.0; split.positions.len()], uncut, true);
        let is_away = cutter.drop_wedge(planes, &sides);
        let curves = behind_any(&self.curves, planes, tolerance);
        if !is_away && curves.segments == self.curves.segments && curves.points == self.curves.points {
            return (self.clone(), Cut::Missed);
        }
        let (mut is_closed, mut strokes) = (true, Vec::new());
        for (number, plane) in planes.iter().enumerate() {
            let mut alone = Cutter::new(&split, sides[number].clone(), uncut, false);
            alone.clip_faces(plane.normal);
            let mut open = alone.open_sides();
            for other in (0..planes.len()).filter(|other| *other != number) {
                let mut line = Line { cutter: &mut cutter, plane, other: &planes[other], tolerance };
                open.values_mut().for_each(|sides| line.clip(sides));
            }
            open.retain(|_, sides| !sides.is_empty());
            let (is_whole, more) = cutter.close(open, plane.normal, spacing);
            is_closed &= is_whole;
            strokes.extend(more);
        }
        let mut curves = curves;
        curves.add_hatching(&strokes, &mut cutter.next_vertex);
        let mesh = cutter.finished(&split, curves);
        let cut = Cut::of(&mesh, is_closed);
        (mesh, cut)
    }
}

/// How far a point on a plane is counted away from it: so little that a curve that begins there keeps its length.
const JUST_BEHIND: f64 = 1e-200;

/// The curves and points that lie behind any of some planes.
fn behind_any(curves: &Curves, planes: &[SectionPlane], tolerance: f64) -> Curves {
    let [plane, others @ ..] = planes else {
        return Curves::default();
    };
    let sides: Vec<f64> = curves.positions.iter().map(|point| plane.side(*point, tolerance)).collect();
    let next_vertex = curves.file_vertices.iter().max().map_or(0, |vertex| vertex + 1);
    let mut kept = clipped(curves, &sides, next_vertex);
    if sides.iter().any(|side| *side > 0.0) {
        let turned: Vec<f64> = sides.iter().map(|side| if *side == 0.0 { JUST_BEHIND } else { -side }).collect();
        kept.add(behind_any(&clipped(curves, &turned, next_vertex), others, tolerance));
    }
    kept
}

/// The line in a plane where it meets another.
struct Line<'a> {
    cutter: &'a mut Cutter,
    plane: &'a SectionPlane,
    other: &'a SectionPlane,
    tolerance: f64,
}

impl Line<'_> {
    /// Keeps the parts of these sides' rings in front of the other plane, and closes them along the line.
    fn clip(&mut self, sides: &mut Vec<OpenSide>) {
        let mut kept: Vec<OpenSide> = Vec::with_capacity(sides.len());
        // Sides that begin at a position less those that end there.
        let mut balance: BTreeMap<u32, i32> = BTreeMap::new();
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        for side in sides.drain(..) {
            let [from, to] = side.ends;
            let [of_from, of_to] = side.ends.map(|end| self.side(end));
            let ends = if of_from * of_to < 0.0 {
                let [low, high] = [from.min(to), from.max(to)];
                let middle = *middles.entry([low, high]).or_insert_with(|| {
                    let [of_low, of_high] = [low, high].map(|end| self.side(end));
                    let [a, b] = [low, high].map(|end| self.cutter.position(end));
                    self.cutter.add_position(a.lerp(b, of_low / (of_low - of_high)))
                });
                if of_from > 0.0 { [from, middle] } else { [middle, to] }
            } else {
                side.ends
            };
            if ends.iter().any(|end| self.side(*end) > 0.0) {
                *balance.entry(ends[0]).or_default() += 1;
                *balance.entry(ends[1]).or_default() -= 1;
                kept.push(OpenSide { ends, ..side });
            }
        }
        let along = self.other.normal.cross(self.plane.normal);
        let mut open: Vec<(f64, u32, i32)> = balance
            .into_iter()
            .filter(|(_, count)| *count != 0)
            .map(|(end, count)| (along.dot(self.cutter.position(end)), end, count))
            .collect();
        open.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        // Where a ring left the front it goes on along the line, to where one comes back.
        let mut waiting: Vec<u32> = Vec::new();
        let from = kept.first().map_or(0, |side| side.from);
        for (_, end, count) in open {
            for _ in 0..-count {
                waiting.push(end);
            }
            for _ in 0..count {
                let Some(start) = waiting.pop() else { continue };
                kept.push(OpenSide { ends: [start, end], from });
            }
        }
        *sides = kept;
    }

    fn side(&self, position: u32) -> f64 {
        self.other.side(self.cutter.position(position), self.tolerance)
    }
}

impl Cutter {
    /// Keeps the faces that lie behind any plane; of those in a plane the ones that look to its front. Returns whether a face goes.
    fn drop_wedge(&mut self, planes: &[SectionPlane], sides: &[Vec<f64>]) -> bool {
        let mut is_away = false;
        for face in 0..self.face_count() {
            let is_in_front = |(plane, sides): (&SectionPlane, &Vec<f64>)| {
                let of_corners = self.corners(face).map(|corner| sides[corner as usize]);
                match of_corners.iter().all(|side| *side == 0.0) {
                    true => !self.looks_to(face, plane.normal),
                    false => of_corners.iter().all(|side| *side >= 0.0),
                }
            };
            let goes = !self.is_whole[face] && planes.iter().zip(sides).all(is_in_front);
            is_away |= goes;
            if !goes {
                self.keep_whole(face);
            }
        }
        is_away
    }
}

impl SectionPlane {
    /// How far a point lies in front of a plane whose normal has length 1; 0 within a tolerance.
    pub(super) fn side(&self, point: DVec3, tolerance: f64) -> f64 {
        let distance = self.normal.dot(point) - self.offset;
        if distance.abs() <= tolerance { 0.0 } else { distance }
    }
}
