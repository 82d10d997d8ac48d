//! Ways along strokes from one place to another near it, for [slivers' sides](super): the shortest first, by A*, over the
//! places where strokes touch.
//!
//! A stroke leads from each place on it to the next on either side. On a long stroke these are looked for no farther than a way may reach, about
//! a stroke's width; what lies on a short one, and which strokes go through a place, is found when it is first asked for and kept. So each way
//! costs what is on it and beside it, however much else lies in the picture.

use super::{Branch, JOINED_PX, Stroke, Strokes};
use crate::bvh::add_steps;
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

/// Places looked at for one way; where there are more, there is none, and what might have gone stays.
const MOST_PLACES: usize = 512;

/// Up to which length all meetings on a stroke are found at once, pixels.
const SHORT_PX: f64 = 8.0;

/// The ends of the way, among places that are meetings otherwise.
const FROM: usize = usize::MAX - 1;
const TO: usize = usize::MAX;

/// A meeting on a stroke, with its distance from the stroke's first end.
type Along = (f64, usize);

/// What is known of places; nothing of those that nobody has asked about.
pub(super) struct Ways {
    meetings: MeetingGrid,
    /// On each short stroke the meetings in their order along it.
    on_strokes: Vec<Option<Box<[Along]>>>,
    /// The strokes through each meeting.
    through: Vec<Option<Box<[usize]>>>,
}

/// The meetings by the cell of the picture in which they lie, row by row: about one in each.
struct MeetingGrid {
    cell_px: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's begin among all, and where the last one's end.
    starts: Vec<u32>,
    meetings: Vec<u32>,
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
        Self {
            meetings: MeetingGrid::new(strokes),
            on_strokes: vec![None; strokes.strokes.len()],
            through: vec![None; strokes.ends.len()],
        }
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
                let known = &mut self.on_strokes[stroke];
                let at = (here, px(here));
                let next = self.meetings.next_on(known, strokes, &strokes.strokes[stroke], at, least - length);
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

impl MeetingGrid {
    fn new(strokes: &Strokes<'_>) -> Self {
        let count = strokes.ends.len();
        let cell_px = (strokes.border.element_product() / count.max(1) as f64).sqrt();
        let [columns, rows] = strokes.border.to_array().map(|side| (side / cell_px).ceil().max(1.0) as usize);
        let mut grid = Self { cell_px, columns, rows, starts: vec![0; columns * rows + 1], meetings: vec![0; count] };
        let cell_of = |grid: &Self, meeting: usize| {
            let [column, row] = grid.cell(strokes.place(meeting));
            row * columns + column
        };
        for meeting in 0..count {
            let cell = cell_of(&grid, meeting);
            grid.starts[cell] += 1;
        }
        // Each cell's end first, then as they are put in from behind its start.
        let mut end = 0;
        for start in &mut grid.starts {
            end += *start;
            *start = end;
        }
        for meeting in (0..count).rev() {
            let cell = cell_of(&grid, meeting);
            grid.starts[cell] -= 1;
            let place = grid.starts[cell] as usize;
            grid.meetings[place] = meeting as u32;
        }
        grid
    }

    /// Column and row; of a place beside the picture those of the nearest cell.
    fn cell(&self, px: DVec2) -> [usize; 2] {
        let at = |px: f64, count: usize| ((px / self.cell_px).max(0.0) as usize).min(count - 1);
        [at(px.x, self.columns), at(px.y, self.rows)]
    }

    /// The meetings in the cells between two places.
    fn between(&self, low: DVec2, high: DVec2) -> impl Iterator<Item = usize> {
        let ([left, top], [right, bottom]) = (self.cell(low), self.cell(high));
        (top..=bottom).flat_map(move |row| {
            let [first, end] = [left, right + 1].map(|column| self.starts[row * self.columns + column] as usize);
            add_steps((end - first) as u64 + 1);
            self.meetings[first..end].iter().map(|meeting| *meeting as usize)
        })
    }

    /// The meetings on a stroke next before and after a place on it, which may be a meeting, as far as they are within reach; `known`
    /// are all on a short one.
    fn next_on(
        &self,
        known: &mut Option<Box<[Along]>>,
        strokes: &Strokes<'_>,
        stroke: &Stroke,
        (here, px): (usize, DVec2),
        reach: f64,
    ) -> [Option<usize>; 2] {
        let along = px.distance(stroke.ends[0]);
        if stroke.length > SHORT_PX {
            return neighbours(&self.on_stroke(strokes, stroke, [along - reach, along + reach]), here, along);
        }
        neighbours(
            known.get_or_insert_with(|| self.on_stroke(strokes, stroke, [0.0, stroke.length]).into()),
            here,
            along,
        )
    }

    /// The meetings on a stroke in their order along it, from one distance from its first end to another.
    fn on_stroke(&self, strokes: &Strokes<'_>, stroke: &Stroke, range: [f64; 2]) -> Vec<Along> {
        let [start, end] = stroke.ends;
        let direction = (end - start).normalize_or_zero();
        let [from, to] = range.map(|along| start + direction * along.clamp(0.0, stroke.length));
        let (low, high) = (from.min(to) - 2.0 * JOINED_PX, from.max(to) + 2.0 * JOINED_PX);
        let mut on_it = Vec::new();
        for meeting in self.between(low, high) {
            let place = strokes.place(meeting);
            if stroke.distance(place) <= JOINED_PX {
                on_it.push((place.distance(start), meeting));
            }
        }
        on_it.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        on_it
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
}
