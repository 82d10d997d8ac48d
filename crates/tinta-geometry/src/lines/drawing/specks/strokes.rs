//! Line segments as drawn strokes, and their connections.

use crate::bvh::{Box3, BoxTree};
use crate::lines::LineSegment;
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::length::Units;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::drawing::simplify::distance;
use crate::tolerances::JOINED_PX;
use glam::DVec2;

/// A segment as it is drawn.
pub(super) struct Stroke {
    /// Its index among all segments.
    pub number: usize,
    pub ends: [DVec2; 2],
    pub length: f64,
    pub width: f64,
    /// Whether it is part of the outline.
    pub is_outline: bool,
    /// The style of its part.
    pub look: u32,
    /// Length below which it is too short alone.
    pub least: f64,
    /// Length below which it is too short for one side of a sliver.
    pub least_side: f64,
}

impl Stroke {
    pub(super) fn new(number: usize, segment: &LineSegment, settings: &DrawingSettings, units: Units) -> Self {
        let layer: Layer = segment.layer();
        let ends = segment.ends_px;
        Self {
            number,
            ends,
            length: ends[0].distance(ends[1]),
            width: settings.width_px(layer, units),
            is_outline: segment.is_outline,
            look: segment.look,
            least: settings.min_length_px(layer, units),
            least_side: settings.min_length_px(layer, units).min(settings.width_px(layer, units)),
        }
    }

    /// Its ends, or those of parts of it: the bounding box of a long diagonal stroke holds many others.
    pub(super) fn parts(&self) -> impl Iterator<Item = [DVec2; 2]> + use<> {
        /// Pixels.
        const LONGEST: f64 = 8.0;
        let ([a, b], count) = (self.ends, (self.length / LONGEST).ceil().max(1.0));
        let at = move |part: f64| if part == count { b } else { a + (b - a) * (part / count) };
        (0..count as usize).map(move |part| [at(part as f64), at(part as f64 + 1.0)])
    }

    pub(super) fn distance(&self, point: DVec2) -> f64 {
        distance(self.ends, point)
    }
}

/// Strokes, their connections, and a tree that finds neighbours.
pub(super) struct Strokes<'a> {
    pub strokes: &'a [Stroke],
    /// The picture's lower right corner: lines that end at its border are not free.
    pub border: DVec2,
    /// The meeting at each end: stroke `k` has ends `2k` and `2k + 1`.
    pub meetings: Vec<usize>,
    /// The ends at each meeting.
    pub ends: Vec<Vec<u32>>,
    pub tree: BoxTree,
    /// The strokes of the parts in the tree, in the tree's order.
    pub order: Vec<u32>,
}

/// Connected strokes that may be too short as a whole, in order from one end to the other.
pub(super) struct Branch {
    pub strokes: Vec<usize>,
    pub length: f64,
}

impl<'a> Strokes<'a> {
    pub(super) fn new(strokes: &'a [Stroke], border: DVec2) -> Self {
        let place = |end: usize| (strokes[end / 2].ends[end % 2] + 0.0).to_array().map(f64::to_bits);
        let mut sorted: Vec<usize> = (0..strokes.len() * 2).collect();
        sorted.sort_unstable_by_key(|end| (place(*end), *end));
        let mut meetings = vec![0; sorted.len()];
        let mut ends: Vec<Vec<u32>> = Vec::new();
        for group in sorted.chunk_by(|a, b| place(*a) == place(*b)) {
            group.iter().for_each(|end| meetings[*end] = ends.len());
            ends.push(group.iter().map(|end| *end as u32).collect());
        }
        let mut parts: Vec<(Box3, u32)> = Vec::with_capacity(strokes.len());
        for (number, stroke) in strokes.iter().enumerate() {
            parts.extend(stroke.parts().map(|ends| (Box3::around(ends.map(|end| end.extend(0.0))), number as u32)));
        }
        let (tree, order) = BoxTree::new(&parts.iter().map(|(around, _)| *around).collect::<Vec<Box3>>());
        let order = order.into_iter().map(|part| parts[part as usize].1).collect();
        Self { strokes, border, meetings, ends, tree, order }
    }

    pub(super) fn least(&self, branch: &Branch, least: Least) -> f64 {
        branch.strokes.iter().map(|stroke| least(&self.strokes[*stroke])).fold(f64::INFINITY, f64::min)
    }

    /// The branch from an end to the next free end or fork; `None` if it is long enough, or a ring.
    pub(super) fn branch(&self, from: u32, least: Least) -> Option<(Branch, u32)> {
        let mut branch = Branch { strokes: Vec::new(), length: 0.0 };
        let mut least_length = f64::INFINITY;
        let mut end = from;
        loop {
            let number = end as usize / 2;
            branch.strokes.push(number);
            branch.length += self.strokes[number].length;
            least_length = least_length.min(least(&self.strokes[number]));
            // The stroke's other end.
            end ^= 1;
            if branch.length >= least_length {
                return None;
            }
            match self.meeting(end) {
                [a, b] if *a / 2 != *b / 2 => end = if *a == end { *b } else { *a },
                _ => return Some((branch, end)),
            }
            if end == from {
                return None;
            }
        }
    }

    /// Connected sets that are too short as a whole.
    pub(super) fn small_wholes(&self) -> Vec<Branch> {
        let mut is_seen = vec![false; self.strokes.len()];
        // Each meeting is visited once, because all lines around a corner share it.
        let mut is_met = vec![false; self.ends.len()];
        let mut wholes = Vec::new();
        for first in 0..self.strokes.len() {
            if is_seen[first] {
                continue;
            }
            is_seen[first] = true;
            let mut whole = Branch { strokes: vec![first], length: 0.0 };
            let mut next = 0;
            while let Some(&number) = whole.strokes.get(next) {
                next += 1;
                whole.length += self.strokes[number].length;
                for end in [number * 2, number * 2 + 1] {
                    if std::mem::replace(&mut is_met[self.meetings[end]], true) {
                        continue;
                    }
                    for neighbour in self.meeting(end as u32).iter().map(|end| *end as usize / 2) {
                        if !is_seen[neighbour] {
                            is_seen[neighbour] = true;
                            whole.strokes.push(neighbour);
                        }
                    }
                }
            }
            if whole.length < self.least(&whole, |stroke| stroke.least) {
                wholes.push(whole);
            }
        }
        wholes
    }

    /// The branches from every free end to the first fork.
    pub(super) fn barbs(&self) -> Vec<Branch> {
        let begins = |end: &u32| self.meeting(*end).len() == 1;
        let all = (0..self.strokes.len() as u32 * 2).filter(begins);
        let branches = all.filter_map(|end| self.branch(end, |stroke| stroke.least));
        branches.filter(|(_, end)| self.meeting(*end).len() > 2).map(|(branch, _)| branch).collect()
    }

    /// The branches from every fork to the next one.
    pub(super) fn spans(&self) -> Vec<Branch> {
        let is_fork = |end: &u32| self.meeting(*end).len() > 2;
        let all = (0..self.strokes.len() as u32 * 2).filter(is_fork);
        let branches = all.filter_map(|end| Some((end, self.branch(end, |stroke| stroke.least_side)?)));
        // Each is found from both its ends.
        branches.filter(|(from, (_, to))| is_fork(to) && from < to).map(|(_, (branch, _))| branch).collect()
    }

    /// The places where a branch meets the rest, touches it or ends at the picture's border; at most three.
    pub(super) fn places_touched(&self, branch: &Branch) -> Vec<DVec2> {
        let mut places: Vec<DVec2> = Vec::new();
        let add = |places: &mut Vec<DVec2>, place: DVec2| {
            if places.iter().all(|known| known.distance(place) > 2.0 * JOINED_PX) {
                places.push(place);
            }
            places.len() > 2
        };
        for &number in &branch.strokes {
            let stroke = &self.strokes[number];
            let is_on_border =
                |end: &DVec2| end.min_element() <= JOINED_PX || (self.border - *end).min_element() <= JOINED_PX;
            let are_many = stroke.ends.into_iter().filter(is_on_border).any(|end| add(&mut places, end));
            let are_many = are_many
                || self.any_near(stroke.ends, JOINED_PX, |other_number| {
                    if branch.strokes.contains(&other_number) {
                        return false;
                    }
                    let other = &self.strokes[other_number];
                    let own = stroke.ends.into_iter().filter(|end| other.distance(*end) <= JOINED_PX);
                    let others = other.ends.into_iter().filter(|end| stroke.distance(*end) <= JOINED_PX);
                    own.chain(others).any(|end| add(&mut places, end))
                });
            if are_many {
                break;
            }
        }
        places
    }

    /// Calls `visit` with strokes near a segment until it returns true; returns whether it did. A stroke is near if
    /// the bounding box of a part of it is within `distance` of the segment's; it may be visited more than once.
    pub(super) fn any_near(&self, [a, b]: [DVec2; 2], distance: f64, mut visit: impl FnMut(usize) -> bool) -> bool {
        let query = Box3::new((a.min(b) - distance).extend(0.0), (a.max(b) + distance).extend(0.0));
        self.tree.any(&query, |place| visit(self.order[place as usize] as usize))
    }
}

/// Selects one of a stroke's least lengths.
pub(super) type Least = fn(&Stroke) -> f64;
