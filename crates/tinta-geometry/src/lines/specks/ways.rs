//! Ways along strokes from one place to another near it, for [slivers' sides](super): the shortest first, by A*, over the
//! places where strokes touch.
//!
//! A stroke leads from each place on it to the next on either side. What lies on a stroke, and which strokes go through a place,
//! is found when it is first asked for and kept, so that each way costs what is on it and beside it, however much else lies
//! within its reach.

use super::{Branch, JOINED_PX, Strokes};
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

/// Places looked at for one way; where there are more, there is none, and what might have gone stays.
const MOST_PLACES: usize = 512;

/// The ends of the way, among places that are meetings otherwise.
const FROM: usize = usize::MAX - 1;
const TO: usize = usize::MAX;

/// A meeting on a stroke, with its distance from the stroke's first end.
type Along = (f64, usize);

/// What is known of strokes and places; nothing of those that nobody has asked about.
pub(super) struct Ways {
    /// On each stroke the meetings in their order along it.
    on_strokes: Vec<Option<Box<[Along]>>>,
    /// The strokes through each meeting.
    through: Vec<Option<Box<[usize]>>>,
}

/// How a place was reached: by how long a way, and from which other place along which stroke at last.
#[derive(Clone, Copy)]
struct Reached {
    length: f64,
    by: Option<(usize, usize)>,
    is_done: bool,
}

/// A place to go on from; the one with the shortest way over it comes first.
#[derive(PartialEq)]
struct Open {
    /// The way to it, and from there straight on.
    length: f64,
    place: usize,
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.length.total_cmp(&self.length).then(other.place.cmp(&self.place))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ways {
    pub(super) fn new(strokes: &Strokes<'_>) -> Self {
        Self { on_strokes: vec![None; strokes.strokes.len()], through: vec![None; strokes.ends.len()] }
    }

    /// The strokes of the shortest way between two places beside a branch, as wide and also too short; `None` where there is none.
    pub(super) fn shortest(
        &mut self,
        strokes: &Strokes<'_>,
        branch: &Branch,
        [from, to]: [DVec2; 2],
        may_use: impl Fn(usize) -> bool,
    ) -> Option<Vec<usize>> {
        let least = strokes.least(branch, |stroke| stroke.least_side);
        let width = branch.strokes.iter().map(|stroke| strokes.strokes[*stroke].width).fold(0.0, f64::max);
        let is_way = |stroke: usize| strokes.strokes[stroke].width >= width && may_use(stroke);
        let [through_from, through_to] = [from, to].map(|place| strokes.through(place, 2.0 * JOINED_PX));
        let px = |place: usize| match place {
            FROM => from,
            TO => to,
            meeting => strokes.place(meeting),
        };
        let mut reached = HashMap::from([(FROM, Reached { length: 0.0, by: None, is_done: false })]);
        let mut open = BinaryHeap::from([Open { length: from.distance(to), place: FROM }]);
        while let Some(Open { place: here, .. }) = open.pop() {
            if here == TO {
                return Some(way_back(&reached));
            }
            let Some(at) = reached.get_mut(&here).filter(|at| !at.is_done) else { continue };
            at.is_done = true;
            let length = at.length;
            if reached.len() > MOST_PLACES {
                return None;
            }
            let through = match here {
                FROM => &through_from[..],
                meeting => {
                    &**self.through[meeting].get_or_insert_with(|| strokes.through(px(meeting), JOINED_PX).into())
                }
            };
            for &stroke in through.iter().filter(|stroke| is_way(**stroke)) {
                let on_it = self.on_strokes[stroke].get_or_insert_with(|| strokes.on_stroke(stroke).into());
                let next = neighbours(on_it, here, px(here).distance(strokes.strokes[stroke].ends[0]));
                let to = through_to.contains(&stroke).then_some(TO);
                for next in next.into_iter().flatten().chain(to) {
                    let length = length + px(here).distance(px(next));
                    let over = length + px(next).distance(px(TO));
                    let is_shorter = reached.get(&next).is_none_or(|known| length < known.length);
                    if over < least && is_shorter {
                        reached.insert(next, Reached { length, by: Some((here, stroke)), is_done: false });
                        open.push(Open { length: over, place: next });
                    }
                }
            }
        }
        None
    }
}

/// The strokes by which the end was reached, the last one first.
fn way_back(reached: &HashMap<usize, Reached>) -> Vec<usize> {
    let mut strokes = Vec::new();
    let mut place = TO;
    while let Some((before, stroke)) = reached.get(&place).and_then(|at| at.by) {
        strokes.push(stroke);
        place = before;
    }
    strokes
}

/// The meetings on a stroke before and after a place, which may be one of them.
fn neighbours(on_it: &[Along], here: usize, along: f64) -> [Option<usize>; 2] {
    let first = on_it.partition_point(|(other, _)| *other < along);
    let equal =
        on_it[first..].iter().take_while(|(other, _)| *other == along).position(|(_, meeting)| *meeting == here);
    let (before, after) = match equal {
        Some(step) => (first + step, first + step + 1),
        None => (first, first),
    };
    let meeting = |index: usize| on_it.get(index).map(|(_, meeting)| *meeting);
    [before.checked_sub(1).and_then(meeting), meeting(after)]
}

impl Strokes<'_> {
    /// The strokes that go by a place so near.
    fn through(&self, place: DVec2, reach: f64) -> Vec<usize> {
        let mut through = Vec::new();
        self.any_near([place; 2], reach, |stroke| {
            if self.strokes[stroke].distance(place) <= reach {
                through.push(stroke);
            }
            false
        });
        through.sort_unstable();
        through.dedup();
        through
    }

    /// Where a meeting is.
    fn place(&self, meeting: usize) -> DVec2 {
        let end = self.ends[meeting][0] as usize;
        self.strokes[end / 2].ends[end % 2]
    }

    /// The meetings on a stroke in their order along it.
    fn on_stroke(&self, number: usize) -> Vec<Along> {
        let stroke = &self.strokes[number];
        let mut on_it = Vec::new();
        for part in stroke.parts() {
            self.any_near(part, JOINED_PX, |other| {
                for end in [other * 2, other * 2 + 1] {
                    let place = self.strokes[other].ends[end % 2];
                    if stroke.distance(place) <= JOINED_PX {
                        on_it.push((place.distance(stroke.ends[0]), self.meetings[end]));
                    }
                }
                false
            });
        }
        on_it.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        on_it.dedup();
        on_it
    }
}
