//! Where faces pass through one another.
//!
//! Two faces do if each has corners on both sides of the other's plane and their parts of the line common to both planes
//! overlap. Corners nearer to a plane than what counts as touching are taken to lie above it: a box that stands on a plane
//! does not intersect it, and where vertices lie exactly on another surface its line is found once, on one side.

use super::faces::Faces;
use super::space::Space;
use crate::threads::{cores, in_chunks};
use crate::tolerances::CONTACT;
use glam::DVec3;

/// A piece of line common to two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Intersection {
    /// The lower number first.
    pub faces: [u32; 2],
    /// In the eye's space.
    pub ends: [DVec3; 2],
}

/// A place where an edge passes through a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piercing {
    /// The edge's positions, the lower number first.
    pub edge: [u32; 2],
    /// In the eye's space.
    pub point: DVec3,
}

/// All intersections of a scene's faces, by their faces' numbers, and where edges pierce faces.
pub(super) fn intersections(space: &Space, faces: &Faces) -> (Vec<Intersection>, Vec<Piercing>) {
    const GROUPS: usize = 512;
    let parts = in_chunks(faces.tree.group_count(), GROUPS, cores(), |groups| {
        let mut found = Vec::new();
        faces.tree.pairs(groups, |first, second| {
            let pair = [first.min(second), first.max(second)];
            found.extend(Pair::new(space, faces, pair).and_then(|pair| pair.meeting()));
        });
        found
    });
    let mut found: Vec<Meeting> = parts.concat();
    found.sort_unstable_by_key(|meeting| meeting.intersection.faces);
    let piercings = found.iter().flat_map(|meeting| meeting.piercings).flatten().collect();
    (found.into_iter().filter(|meeting| meeting.is_line).map(|meeting| meeting.intersection).collect(), piercings)
}

/// Where two faces meet.
#[derive(Clone, Copy)]
struct Meeting {
    intersection: Intersection,
    /// Whether it is long enough to be a line: needles have no intersection worth one, but their edges are cut all the same.
    is_line: bool,
    piercings: [Option<Piercing>; 2],
}

/// Two faces of which each has corners on both sides of the other's plane.
struct Pair<'a> {
    faces: &'a Faces,
    numbers: [u32; 2],
    /// Each face's corners' distances from the other's plane times the length of its normal, 0 where they touch it.
    distances: [[f64; 3]; 2],
    /// Along both planes.
    direction: DVec3,
    /// The place in each face of the one corner they share.
    shared: Option<[usize; 2]>,
    /// Length below which nothing is a line.
    shortest: f64,
}

/// Where a side of one face passes the other's plane.
#[derive(Clone, Copy)]
struct Crossing {
    /// Along the common line.
    along: f64,
    piercing: Piercing,
}

impl<'a> Pair<'a> {
    fn new(space: &Space, faces: &'a Faces, numbers: [u32; 2]) -> Option<Self> {
        let [f, g] = numbers.map(|face| faces.triangles[face as usize]);
        let mut shared = None;
        let mut shared_count = 0;
        for (i, corner) in f.iter().enumerate() {
            if let Some(j) = g.iter().position(|other| other == corner) {
                shared = Some([i, j]);
                shared_count += 1;
            }
        }
        // Neighbours along an edge have that in common and nothing else, unless they lie on one another.
        if shared_count > 1 {
            return None;
        }
        let corners = numbers.map(|face| faces.corners(face));
        let normal_of = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let second_normal = normal_of(corners[1]);
        let longest = |[a, b, c]: [DVec3; 3]| {
            (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared())
        };
        let contact = CONTACT * longest(corners[0]).min(longest(corners[1])).sqrt() + 4.0 * space.noise;
        let distances_from = |plane: [DVec3; 3], normal: DVec3, points: [DVec3; 3], own: Option<usize>| {
            let touching = contact * normal.length();
            let mut distances = [0.0; 3];
            let (mut below, mut above) = (0, 0);
            for (index, point) in points.iter().enumerate() {
                if own == Some(index) {
                    continue;
                }
                let distance = normal.dot(*point - plane[0]);
                if distance < -touching {
                    below += 1;
                    distances[index] = distance;
                } else {
                    above += 1;
                    distances[index] = if distance > touching { distance } else { 0.0 };
                }
            }
            (below > 0 && above > 0).then_some(distances)
        };
        let first = distances_from(corners[1], second_normal, corners[0], shared.map(|[i, _]| i))?;
        let first_normal = normal_of(corners[0]);
        let second = distances_from(corners[0], first_normal, corners[1], shared.map(|[_, j]| j))?;
        let direction = first_normal.cross(second_normal);
        Some(Self { faces, numbers, distances: [first, second], direction, shared, shortest: contact })
    }

    fn meeting(&self) -> Option<Meeting> {
        let mut is_line = true;
        let (low, high) = match self.shared {
            None => {
                let [first, second] = [self.both_crossings(0)?, self.both_crossings(1)?];
                let low = if first.0.along >= second.0.along { first.0 } else { second.0 };
                let high = if first.1.along <= second.1.along { first.1 } else { second.1 };
                // Where an edge passes through an edge, rounding must not lose the cut.
                if low.along - high.along > self.shortest * self.direction.length() {
                    return None;
                }
                is_line = low.along < high.along;
                (low.piercing, high.piercing)
            }
            Some([i, j]) => {
                let start = self.faces.corners(self.numbers[0])[i];
                let from_start = start.dot(self.direction);
                let first = self.crossing(0, (i + 1) % 3, (i + 2) % 3)?;
                let second = self.crossing(1, (j + 1) % 3, (j + 2) % 3)?;
                let (first_way, second_way) = (first.along - from_start, second.along - from_start);
                if (first_way > 0.0) != (second_way > 0.0) {
                    return None;
                }
                let nearer = if first_way.abs() <= second_way.abs() { first } else { second };
                // The shared corner is no piercing: both edges there end anyway.
                let at_corner = Piercing { edge: [u32::MAX; 2], point: start };
                (at_corner, nearer.piercing)
            }
        };
        let piercings = [low, high].map(|piercing| (piercing.edge[0] != u32::MAX).then_some(piercing));
        is_line &= low.point.distance(high.point) > self.shortest;
        Some(Meeting {
            intersection: Intersection { faces: self.numbers, ends: [low.point, high.point] },
            is_line,
            piercings,
        })
    }

    /// Where a face's rim passes the other's plane: the lower place along the common line first.
    fn both_crossings(&self, face: usize) -> Option<(Crossing, Crossing)> {
        let mut crossings = (0..3).filter_map(|corner| self.crossing(face, corner, (corner + 1) % 3));
        let (first, second) = (crossings.next()?, crossings.next()?);
        Some(if first.along <= second.along { (first, second) } else { (second, first) })
    }

    /// Where the side between two corners of a face passes the other's plane, if it does.
    fn crossing(&self, face: usize, from: usize, to: usize) -> Option<Crossing> {
        let numbers = self.faces.triangles[self.numbers[face] as usize];
        // Of two faces that share the side both get the same point, bit for bit.
        let (from, to) = if numbers[from] < numbers[to] { (from, to) } else { (to, from) };
        let (start, end) = (self.distances[face][from], self.distances[face][to]);
        if (start < 0.0) == (end < 0.0) {
            return None;
        }
        let positions = [numbers[from], numbers[to]].map(|number| self.faces.positions[number as usize]);
        let point = positions[0] + (positions[1] - positions[0]) * (start / (start - end));
        let piercing = Piercing { edge: [numbers[from], numbers[to]], point };
        Some(Crossing { along: point.dot(self.direction), piercing })
    }
}
