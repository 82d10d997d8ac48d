//! Leaves out what is too short to be a line: specks, barbs, and strokes that lie under the ink of others.
//!
//! In: pieces of lines, how wide each is drawn and how short is too short. Out: the pieces that stay. Pieces hang together
//! where they have an end in common, bit for bit; they touch where an end of one comes within [`JOINED_PX`] of the other, as
//! where a line ends behind a nearer one. Three things go:
//!
//! - a *speck*: all that hangs together is shorter than too short and touches the rest at one place at most;
//! - a *barb*: from an end that is free, where nothing hangs or touches, to the first fork, likewise;
//! - a *sliver's side*: what touches the rest at two places that stay joined by lines as wide and also shorter than too short,
//!   so that these lie under the same ink.
//!
//! So what closes a line stays: an outline has no free end, and of its parts only such go that another way round closes.
//! Nothing is left out because something else was: a long line never goes bit by bit.

mod ways;

use super::layers::Layer;
use super::length::Units;
use super::outline::readable;
use super::progress::{Phase, Progress};
use super::svg::SvgSettings;
use super::{LineSegment, VisibleLines};
use crate::bvh::{Box3, BoxTree, steps};
use crate::error::{Error, Result};
use crate::threads::{cores, in_chunks};
use crate::tolerances::JOINED_PX;
use glam::DVec2;
use ways::Ways;

impl VisibleLines {
    /// The lines without spurs and specks as a drawing's settings ask: what is shorter than [`SvgSettings::min_length`]. Where settings say
    /// something of the outline, what cannot be read as outline is none: beside slits narrower than it, and in runs shorter than four
    /// of its widths.
    ///
    /// # Errors
    ///
    /// As [`SvgSettings::check`] and [`VisibleLines::check`].
    pub fn without_specks(&self, settings: &SvgSettings) -> Result<Self> {
        self.without_specks_with_progress(settings, &Progress::default())
    }

    /// The same, telling how far it is.
    ///
    /// # Errors
    ///
    /// Also [`Error::Cancelled`] and, but where a part is asked for, [`Error::OutOfTime`].
    pub fn without_specks_with_progress(&self, settings: &SvgSettings, progress: &Progress) -> Result<Self> {
        settings.check()?;
        self.check()?;
        let units = super::drawing::page(self, settings).units;
        let segments = match settings.tells_outline() {
            true => readable(&self.segments, settings.width_px(Layer::Outline, units), progress),
            false => self.segments.clone(),
        };
        let mut keeps = vec![true; segments.len()];
        // Hidden lines lie in layers of their own, which may be switched off.
        for is_visible in [true, false] {
            let strokes: Vec<Stroke> = segments
                .iter()
                .enumerate()
                .filter(|(_, segment)| segment.is_visible == is_visible && !segment.is_covered)
                .map(|(number, segment)| Stroke::new(number, segment, settings, units))
                .collect();
            let border = DVec2::new(f64::from(self.size.width), f64::from(self.size.height));
            match Strokes::new(&strokes, border).too_short(progress) {
                Ok(all) => all.into_iter().for_each(|stroke| keeps[strokes[stroke].number] = false),
                // Some of them would depend on the machine.
                Err(Error::OutOfTime { asked_for_part: true, .. }) => {
                    return Ok(Self { has_specks: true, segments, ..self.clone_without_segments() });
                }
                Err(error) => return Err(error),
            }
        }
        let kept = segments.into_iter().zip(keeps).filter(|(_, keeps)| *keeps).map(|(segment, _)| segment);
        Ok(Self { segments: kept.collect(), ..self.clone_without_segments() })
    }

    fn clone_without_segments(&self) -> Self {
        Self {
            size: self.size,
            segments: Vec::new(),
            edges: self.edges,
            changes: self.changes.clone(),
            covered_triangles: self.covered_triangles,
            undecided: self.undecided,
            has_specks: self.has_specks,
            times: self.times,
        }
    }
}

/// A piece as it is drawn.
struct Stroke {
    /// Its place among all pieces.
    number: usize,
    ends: [DVec2; 2],
    length: f64,
    width: f64,
    /// Below which length it is too short by itself.
    least: f64,
    /// Below which length it is too short for one side of something.
    least_side: f64,
}

impl Stroke {
    fn new(number: usize, segment: &LineSegment, settings: &SvgSettings, units: Units) -> Self {
        let layer: Layer = segment.layer();
        let ends = segment.ends_px;
        Self {
            number,
            ends,
            length: ends[0].distance(ends[1]),
            width: settings.width_px(layer, units),
            least: settings.min_length_px(layer, units),
            least_side: settings.min_length_px(layer, units).min(settings.width_px(layer, units)),
        }
    }

    /// Its ends, or those of parts of it: the box of a long one that is aslant holds much else.
    fn parts(&self) -> impl Iterator<Item = [DVec2; 2]> + use<> {
        /// Pixels.
        const LONGEST: f64 = 8.0;
        let ([a, b], count) = (self.ends, (self.length / LONGEST).ceil().max(1.0));
        let at = move |part: f64| if part == count { b } else { a + (b - a) * (part / count) };
        (0..count as usize).map(move |part| [at(part as f64), at(part as f64 + 1.0)])
    }

    /// Distance from a point.
    fn distance(&self, point: DVec2) -> f64 {
        let along = self.ends[1] - self.ends[0];
        let square = along.length_squared();
        let share = if square > 0.0 { ((point - self.ends[0]).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
        point.distance(self.ends[0] + along * share)
    }
}

/// Pieces, where they hang together, and a tree that finds neighbours.
struct Strokes<'a> {
    strokes: &'a [Stroke],
    /// The picture's lower right corner: lines end at its border without being free.
    border: DVec2,
    /// The meeting at each end: stroke `k` has ends `2k` and `2k + 1`.
    meetings: Vec<usize>,
    /// The ends at each meeting.
    ends: Vec<Vec<u32>>,
    tree: BoxTree,
    /// Strokes by the places of their parts in the tree.
    order: Vec<u32>,
}

/// Strokes that hang together and may be too short as a whole, from one end to another.
struct Branch {
    strokes: Vec<usize>,
    length: f64,
}

/// Branches whose neighbours a thread looks at at once.
const LOOKED_AT_ONCE: usize = 2048;

/// Which length of a stroke is meant.
type Least = fn(&Stroke) -> f64;

impl<'a> Strokes<'a> {
    fn new(strokes: &'a [Stroke], border: DVec2) -> Self {
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

    /// All that go.
    fn too_short(&self, progress: &Progress) -> Result<Vec<usize>> {
        progress.begin(Phase::TooShort, 0);
        progress.go_on_drawing()?;
        let mut is_gone = vec![false; self.strokes.len()];
        let wholes = self.small_wholes();
        let barbs = self.barbs();
        let loose: Vec<&Branch> = wholes.iter().chain(&barbs).collect();
        let goes = in_chunks(loose.len(), LOOKED_AT_ONCE, cores(), |range| {
            let goes =
                |branch: usize| progress.go_on_drawing().is_ok() && self.places_touched(loose[branch]).len() <= 1;
            range.map(goes).collect::<Vec<bool>>()
        });
        progress.go_on_drawing()?;
        for (branch, _) in loose.iter().zip(goes.concat()).filter(|(_, goes)| *goes) {
            branch.strokes.iter().for_each(|stroke| is_gone[*stroke] = true);
        }
        let spans = self.spans();
        let is_side = |branch: &&Branch| branch.length < self.least(branch, |stroke| stroke.least_side);
        let mut sides: Vec<&Branch> = wholes.iter().filter(is_side).chain(&spans).collect();
        sides.sort_by(|a, b| a.length.total_cmp(&b.length));
        let places_touched = in_chunks(sides.len(), LOOKED_AT_ONCE, cores(), |range| {
            let places = |side: usize| match progress.go_on_drawing() {
                Ok(()) => <[DVec2; 2]>::try_from(self.places_touched(sides[side])).ok(),
                Err(_) => None,
            };
            range.map(places).collect::<Vec<_>>()
        });
        progress.go_on_drawing()?;
        let mut is_needed = vec![false; self.strokes.len()];
        let mut ways = Ways::new(self);
        progress.begin(Phase::TooShort, sides.len());
        let mut before = steps();
        for (branch, places) in sides.into_iter().zip(places_touched.into_iter().flatten()) {
            progress.go_on_drawing()?;
            let now = steps();
            progress.advance(1, now.wrapping_sub(before));
            before = now;
            if branch.strokes.iter().any(|stroke| is_needed[*stroke] || is_gone[*stroke]) {
                continue;
            }
            let Some([from, to]) = places else { continue };
            let may_use = |stroke: usize| !is_gone[stroke] && !branch.strokes.contains(&stroke);
            if let Some(route) = ways.shortest(self, branch, [from, to], may_use) {
                route.into_iter().for_each(|stroke| is_needed[stroke] = true);
                branch.strokes.iter().for_each(|stroke| is_gone[*stroke] = true);
            }
        }
        Ok((0..self.strokes.len()).filter(|stroke| is_gone[*stroke]).collect())
    }

    fn meeting(&self, end: u32) -> &[u32] {
        &self.ends[self.meetings[end as usize]]
    }

    /// The least length of what a branch is made of.
    fn least(&self, branch: &Branch, least: Least) -> f64 {
        branch.strokes.iter().map(|stroke| least(&self.strokes[*stroke])).fold(f64::INFINITY, f64::min)
    }

    /// From an end on to the next meeting of one or of more than two; `None` once it is long enough, and for a ring.
    fn branch(&self, from: u32, least: Least) -> Option<(Branch, u32)> {
        let mut branch = Branch { strokes: Vec::new(), length: 0.0 };
        let mut least_length = f64::INFINITY;
        let mut end = from;
        loop {
            let number = end as usize / 2;
            branch.strokes.push(number);
            branch.length += self.strokes[number].length;
            least_length = least_length.min(least(&self.strokes[number]));
            // A stroke's other end.
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

    /// What hangs together and is too short as a whole.
    fn small_wholes(&self) -> Vec<Branch> {
        let mut is_seen = vec![false; self.strokes.len()];
        // What meets somewhere is asked for once: of lines around one corner all meet there.
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

    /// From every free end to the first fork.
    fn barbs(&self) -> Vec<Branch> {
        let begins = |end: &u32| self.meeting(*end).len() == 1;
        let all = (0..self.strokes.len() as u32 * 2).filter(begins);
        let branches = all.filter_map(|end| self.branch(end, |stroke| stroke.least));
        branches.filter(|(_, end)| self.meeting(*end).len() > 2).map(|(branch, _)| branch).collect()
    }

    /// From every fork to the next one.
    fn spans(&self) -> Vec<Branch> {
        let is_fork = |end: &u32| self.meeting(*end).len() > 2;
        let all = (0..self.strokes.len() as u32 * 2).filter(is_fork);
        let branches = all.filter_map(|end| Some((end, self.branch(end, |stroke| stroke.least_side)?)));
        // Each is found from both its ends.
        branches.filter(|(from, (_, to))| is_fork(to) && from < to).map(|(_, (branch, _))| branch).collect()
    }

    /// The places at which a branch hangs on the rest, touches it or ends at the picture's border; of more than two only three.
    fn places_touched(&self, branch: &Branch) -> Vec<DVec2> {
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

    /// Calls `visit` with each stroke of which the box of a part comes so near to that of two points, perhaps several times, until
    /// it returns true; returns whether it did.
    fn any_near(&self, [a, b]: [DVec2; 2], distance: f64, mut visit: impl FnMut(usize) -> bool) -> bool {
        let query = Box3::new((a.min(b) - distance).extend(0.0), (a.max(b) + distance).extend(0.0));
        self.tree.any(&query, |place| visit(self.order[place as usize] as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::super::progress::Progress;
    use super::super::{LineSettings, VisibleLines};
    use super::*;
    use crate::mesh::Mesh;
    use crate::scene::{Scene, SceneSettings};
    use std::time::Duration;

    #[test]
    fn where_a_part_is_wanted_and_the_time_is_over_specks_stay_and_that_is_said() {
        let scene = Scene::new(vec![Mesh::triangle()], &SceneSettings::default()).unwrap();
        let whole = VisibleLines::of(&scene, &LineSettings::default()).unwrap();
        let settings = SvgSettings { min_length: Some("2000".parse().unwrap()), ..SvgSettings::default() };
        let ended = |progress: &Progress| whole.without_specks_with_progress(&settings, progress);
        let part = ended(&Progress::exactly_within_or_part(Duration::ZERO)).unwrap();
        assert_eq!(part, VisibleLines { has_specks: true, ..whole.clone() });
        let note = "partial: the time was over before specks were left out";
        assert_eq!(part.partial_note().as_deref(), Some(note));
        let enough = ended(&Progress::exactly_within_or_part(Duration::from_secs(3_600))).unwrap();
        assert_eq!((enough.partial_note(), enough.segments.len() < whole.segments.len()), (None, true));
    }
}
