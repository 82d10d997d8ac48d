//! Shortest paths along strokes between two nearby places, for [slivers' sides](super): A* over the places where
//! strokes touch.
//!
//! A stroke connects each place on it to the next on either side. The places on a stroke, and the strokes through a
//! place, are computed on first use and cached. The cost of a search depends on its surroundings only, not on the
//! size of the picture.

use super::strokes::{Branch, Stroke, Strokes};
use crate::bvh::add_steps;
use crate::tolerances::JOINED_PX;
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Most places visited in one search; beyond that no path is found, and the segments stay.
const MOST_PLACES: usize = 512;

/// The search's start and end, among places that are otherwise meetings.
const FROM: usize = usize::MAX - 1;
const TO: usize = usize::MAX;

/// A meeting on a stroke, with its distance from the stroke's first end.
type Along = (f64, usize);

/// Cached places and the state of the current search.
pub(super) struct ShortestPaths {
    meetings: MeetingGrid,
    /// The meetings on each stroke, in order.
    on_strokes: Vec<Option<Box<[Along]>>>,
    /// The strokes through each meeting.
    through: Vec<Option<Box<[usize]>>>,
    /// The places that the current search has reached.
    reached: Vec<Reached>,
    /// For each meeting, the last search that reached it and its index among the reached places of that search.
    known: Vec<[u32; 2]>,
    way: u32,
}

/// The meetings by grid cell of the picture, row by row: about one per cell.
struct MeetingGrid {
    cell_px: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's meetings begin in the list, and where the last cell's end.
    starts: Vec<u32>,
    meetings: Vec<u32>,
    /// The positions of the meetings.
    places: Vec<DVec2>,
}

/// A reached place: the path's length, the previous reached place, and the stroke between them.
#[derive(Clone, Copy)]
struct Reached {
    place: usize,
    length: f64,
    by: Option<(usize, usize)>,
    is_done: bool,
}

/// A reached place to expand; the one with the shortest estimated path comes first.
#[derive(PartialEq)]
struct Open {
    /// The path to it plus the straight distance to the end.
    length: f64,
    place: usize,
    number: usize,
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

impl ShortestPaths {
    pub(super) fn new(strokes: &Strokes<'_>) -> Self {
        Self {
            meetings: MeetingGrid::new(strokes),
            on_strokes: vec![None; strokes.strokes.len()],
            through: vec![None; strokes.ends.len()],
            reached: Vec::new(),
            known: vec![[0; 2]; strokes.ends.len()],
            way: 0,
        }
    }

    /// Records a path to a place if it is shorter than the known one; then returns the place's index among the
    /// reached ones.
    fn reach(&mut self, place: usize, length: f64, by: Option<(usize, usize)>) -> Option<usize> {
        let reached = Reached { place, length, by, is_done: false };
        let known = match place {
            // The end is the only place without a meeting that may be reached again.
            FROM | TO => self.reached.iter().position(|reached| reached.place == place),
            meeting => Some(self.known[meeting]).filter(|[way, _]| *way == self.way).map(|[_, number]| number as usize),
        };
        match known {
            Some(number) if length < self.reached[number].length => self.reached[number] = reached,
            Some(_) => return None,
            None => {
                if place < FROM {
                    self.known[place] = [self.way, self.reached.len() as u32];
                }
                self.reached.push(reached);
            }
        }
        Some(known.unwrap_or(self.reached.len() - 1))
    }

    /// The strokes of the shortest path between two places beside a branch, if they are as wide and also too short;
    /// `None` if none exists.
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
        let [mut through_from, through_to] = [from, to].map(|place| Box::from(strokes.through(place, 2.0 * JOINED_PX)));
        let px = |place: usize| match place {
            FROM => from,
            TO => to,
            meeting => strokes.place(meeting),
        };
        self.way += 1;
        self.reached.clear();
        self.reach(FROM, 0.0, None);
        let mut open = BinaryHeap::from([Open { length: from.distance(to), place: FROM, number: 0 }]);
        while let Some(Open { place: here, number, .. }) = open.pop() {
            if here == TO {
                return Some(self.way_back(number));
            }
            let Reached { length, is_done, .. } = &mut self.reached[number];
            if std::mem::replace(is_done, true) {
                continue;
            }
            let length = *length;
            if self.reached.len() > MOST_PLACES {
                return None;
            }
            let through = match here {
                FROM => std::mem::take(&mut through_from),
                meeting => {
                    self.through[meeting].take().unwrap_or_else(|| strokes.through(px(meeting), JOINED_PX).into())
                }
            };
            for &stroke in through.iter().filter(|stroke| is_way(**stroke)) {
                let on_it =
                    self.on_strokes[stroke].get_or_insert_with(|| self.meetings.on_stroke(&strokes.strokes[stroke]));
                let next = neighbours(on_it, here, px(here).distance(strokes.strokes[stroke].ends[0]));
                let to = through_to.contains(&stroke).then_some(TO);
                for next in next.into_iter().flatten().chain(to) {
                    let length = length + px(here).distance(px(next));
                    let over = length + px(next).distance(px(TO));
                    let is_near = over < least;
                    if let Some(number) = is_near.then(|| self.reach(next, length, Some((number, stroke)))).flatten() {
                        open.push(Open { length: over, place: next, number });
                    }
                }
            }
            if here != FROM {
                self.through[here] = Some(through);
            }
        }
        None
    }

    /// The strokes by which a place was reached, the last one first.
    fn way_back(&self, number: usize) -> Vec<usize> {
        let mut strokes = Vec::new();
        let mut by = self.reached[number].by;
        while let Some((before, stroke)) = by {
            strokes.push(stroke);
            by = self.reached[before].by;
        }
        strokes
    }
}

impl MeetingGrid {
    fn new(strokes: &Strokes<'_>) -> Self {
        let count = strokes.ends.len();
        let cell_px = (strokes.border.element_product() / count.max(1) as f64).sqrt();
        let [columns, rows] = strokes.border.to_array().map(|side| (side / cell_px).ceil().max(1.0) as usize);
        let (starts, meetings) = (vec![0; columns * rows + 1], vec![0; count]);
        let mut grid = Self { cell_px, columns, rows, starts, meetings, places: Vec::new() };
        let cell_of = |grid: &Self, meeting: usize| {
            let [column, row] = grid.cell(strokes.place(meeting));
            row * columns + column
        };
        for meeting in 0..count {
            let cell = cell_of(&grid, meeting);
            grid.starts[cell] += 1;
        }
        // First the end of each cell; filling a cell from its end leaves its start.
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
        grid.places = grid.meetings.iter().map(|meeting| strokes.place(*meeting as usize)).collect();
        grid
    }

    /// Column and row; for a place outside the picture, those of the nearest cell.
    fn cell(&self, px: DVec2) -> [usize; 2] {
        let at = |px: f64, count: usize| ((px / self.cell_px).max(0.0) as usize).min(count - 1);
        [at(px.x, self.columns), at(px.y, self.rows)]
    }

    /// The meetings on a stroke, in order.
    fn on_stroke(&self, stroke: &Stroke) -> Box<[Along]> {
        const MARGIN: f64 = 2.0 * JOINED_PX;
        let [start, end] = stroke.ends;
        let (low, high) = (start.min(end) - MARGIN, start.max(end) + MARGIN);
        let ([left, top], [right, bottom]) = (self.cell(low), self.cell(high));
        let along = end - start;
        let mut on_it = Vec::new();
        for row in top..=bottom {
            // The stretch of the stroke near this row, and its cells.
            let (mut from_x, mut to_x) = (low.x, high.x);
            if along.y != 0.0 && top < bottom {
                let share = |y: f64| ((y - start.y) / along.y).clamp(0.0, 1.0);
                let of_border = |row: usize, margin: f64| match row {
                    row if row == top && margin < 0.0 => low.y,
                    row if row == bottom + 1 => high.y,
                    row => row as f64 * self.cell_px + margin,
                };
                let [a, b] =
                    [of_border(row, -MARGIN), of_border(row + 1, MARGIN)].map(|y| start.x + along.x * share(y));
                (from_x, to_x) = (a.min(b) - MARGIN, a.max(b) + MARGIN);
            }
            let [left, right] =
                [self.cell(DVec2::new(from_x, 0.0))[0].max(left), self.cell(DVec2::new(to_x, 0.0))[0].min(right)];
            let [first, end] = [left, right + 1].map(|column| self.starts[row * self.columns + column] as usize);
            add_steps((end - first) as u64 + 1);
            for (meeting, place) in self.meetings[first..end].iter().zip(&self.places[first..end]) {
                if stroke.distance(*place) <= JOINED_PX {
                    on_it.push((place.distance(start), *meeting as usize));
                }
            }
        }
        on_it.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        on_it.into()
    }
}

/// The meetings on a stroke before and after a place; the place may be one of them.
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
    /// The strokes within this distance of a place.
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

    fn place(&self, meeting: usize) -> DVec2 {
        let end = self.ends[meeting][0] as usize;
        self.strokes[end / 2].ends[end % 2]
    }
}
