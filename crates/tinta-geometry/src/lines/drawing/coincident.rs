//! Lines that coincide in a written file, each kept once.
//!
//! In: the paths of a drawing's layers. Out: the same without the stretches that run along a path of a higher layer, or an earlier
//! path of the same one, when all are rounded to the decimals of a file. Visibility joins lines that touch; those a thousandth of a pixel apart are
//! two lines in space, and one in a file.

use crate::edges::Class;
use crate::lines::drawing::chain::LinePath;
use crate::lines::drawing::simplify::simplified_places;
use crate::lines::drawing::text::in_steps;
use glam::{DVec2, I64Vec2};
use std::collections::{BTreeMap, HashMap};

/// Removes repeated stretches from layers, the lowest first.
pub(super) fn keep_once<'a>(layers: impl DoubleEndedIterator<Item = &'a mut Vec<LinePath>>) {
    let mut drawn: HashMap<Line, Stretches> = HashMap::new();
    for paths in layers.rev() {
        *paths = std::mem::take(paths).into_iter().flat_map(|path| what_is_new(path, &mut drawn)).collect();
    }
}

/// A straight line through points of a file: its direction without a common factor, and its distance from the origin along it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Line {
    along: I64Vec2,
    offset: i128,
}

/// The line of a stretch of a path, and its ends on it; `None` if it is a point in a file.
fn on_line(from: DVec2, to: DVec2) -> Option<(Line, [i64; 2])> {
    let [from, to] = [from, to].map(in_steps);
    let way = to - from;
    let factor = greatest_common_divisor(way.x.unsigned_abs(), way.y.unsigned_abs()) as i64;
    if factor == 0 {
        return None;
    }
    let along = way / factor * if (way.x, way.y) < (0, 0) { -1 } else { 1 };
    let [x, y] = [from.x, from.y].map(i128::from);
    let offset = i128::from(along.x) * y - i128::from(along.y) * x;
    let ends = if along.x.abs() >= along.y.abs() { [from.x, to.x] } else { [from.y, to.y] };
    Some((Line { along, offset }, ends))
}

fn greatest_common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

/// The drawn parts of a line: disjoint stretches, each from its lower end to its higher one.
#[derive(Default)]
struct Stretches(BTreeMap<i64, i64>);

impl Stretches {
    /// Adds a stretch; returns the parts of it that are new and longer than a step, ascending.
    fn add(&mut self, whole: [i64; 2]) -> Vec<[i64; 2]> {
        let [mut low, mut high] = whole;
        let met = self.0.range(..=high).rev().take_while(|(_, end)| **end >= low);
        let mut met: Vec<[i64; 2]> = met.map(|(start, end)| [*start, *end]).collect();
        met.reverse();
        let (mut new, mut from) = (Vec::new(), low);
        for [start, end] in met {
            new.push([from, start]);
            from = from.max(end);
            self.0.remove(&start);
            (low, high) = (low.min(start), high.max(end));
        }
        new.push([from, whole[1]]);
        self.0.insert(low, high);
        new.retain(|part| part[1] - part[0] > 1 || *part == whole);
        new
    }
}

/// The parts of a path that are not drawn yet.
fn what_is_new(path: LinePath, drawn: &mut HashMap<Line, Stretches>) -> Vec<LinePath> {
    let count = path.points_px.len();
    if path.class == Class::Point || count < 2 {
        return vec![path];
    }
    let mut places = simplified_places(&path.points_px, path.is_closed);
    if path.is_closed {
        places.push(count);
    }
    let mut parts = Parts { path: &path, open: Vec::new() };
    let mut is_whole = true;
    for stretch in places.windows(2).map(|pair| [pair[0], pair[1]]) {
        let [from, to] = stretch.map(|place| path.points_px[place % count]);
        let Some((line, [start, end])) = on_line(from, to) else {
            parts.add_point(stretch);
            continue;
        };
        let ascending = [start.min(end), start.max(end)];
        let mut new = drawn.entry(line).or_default().add(ascending);
        is_whole &= new == [ascending];
        if start > end {
            new.reverse();
            new.iter_mut().for_each(|part| part.reverse());
        }
        let share = |at: i64| (at - start) as f64 / (end - start) as f64;
        new.into_iter().for_each(|part| parts.add(stretch, part.map(share)));
    }
    if is_whole { vec![path] } else { parts.paths() }
}

/// Parts of a path that stay, in its order.
struct Parts<'a> {
    path: &'a LinePath,
    open: Vec<LinePath>,
}

impl Parts<'_> {
    /// Adds the part between two shares of the stretch from one point to another.
    fn add(&mut self, [first, last]: [usize; 2], [from, to]: [f64; 2]) {
        let points = &self.path.points_px;
        let [start, end] = [first, last].map(|place| points[place % points.len()]);
        let share = |place: usize| match place {
            _ if place == last => 1.0,
            _ => (points[place] - start).dot(end - start) / (end - start).length_squared(),
        };
        let at = |share: f64| match share {
            0.0 => start,
            1.0 => end,
            _ => start.lerp(end, share),
        };
        let (points_px, segments) = (vec![at(from)], Vec::new());
        let mut part = LinePath { points_px, segments, is_closed: false, ..*self.path };
        for place in (first..last).filter(|place| place + 1 == last || share(place + 1) > from) {
            part.segments.push(self.path.segments[place]);
            let is_last = place + 1 == last || share(place + 1) >= to;
            part.points_px.push(if is_last { at(to) } else { points[place + 1] });
            if is_last {
                break;
            }
        }
        match self.open.last_mut().filter(|before| before.points_px.last() == part.points_px.first()) {
            Some(before) => append(before, part),
            None => self.open.push(part),
        }
    }

    /// Adds a stretch that is a point in a file to what ends at it.
    fn add_point(&mut self, [first, last]: [usize; 2]) {
        let start = self.path.points_px[first];
        if self.open.last().is_some_and(|before| before.points_px.last() == Some(&start)) {
            self.add([first, last], [0.0, 1.0]);
        }
    }

    /// The parts; those that meet where a closed path begins are one.
    fn paths(mut self) -> Vec<LinePath> {
        let begin = self.open.first().and_then(|path| path.points_px.first());
        let end = self.open.last().and_then(|path| path.points_px.last());
        let meets = self.path.is_closed && self.open.len() > 1 && begin == end;
        if let Some(mut last) = self.open.pop_if(|_| meets) {
            let first = &mut self.open[0];
            std::mem::swap(first, &mut last);
            append(first, last);
        }
        self.open
    }
}

/// Continues a path by one that begins where it ends.
fn append(path: &mut LinePath, next: LinePath) {
    path.points_px.extend(next.points_px.into_iter().skip(1));
    path.segments.extend(next.segments);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[[f64; 2]], is_closed: bool) -> LinePath {
        let points_px: Vec<DVec2> = points.iter().copied().map(DVec2::from_array).collect();
        let segments = (0..points_px.len() - usize::from(!is_closed)).collect();
        LinePath { points_px, segments, is_closed, ..LinePath::of_stroke(vec![DVec2::ZERO; 2]) }
    }

    /// The points of the paths of each layer, as a file has them.
    fn once(mut layers: Vec<Vec<LinePath>>) -> Vec<Vec<Vec<[f64; 2]>>> {
        keep_once(layers.iter_mut());
        let points = |path: &LinePath| {
            assert_eq!(path.segments.len() + usize::from(!path.is_closed), path.points_px.len(), "{path:?}");
            path.points_px.iter().map(|point| in_steps(*point).as_dvec2().to_array().map(|value| value / 1e3)).collect()
        };
        layers.iter().map(|paths| paths.iter().map(points).collect()).collect()
    }

    #[test]
    fn of_lines_that_a_file_writes_alike_the_highest_stays() {
        let high = path(&[[5.0, 1.0002], [5.0, 9.0]], false);
        let low = path(&[[5.0004, 9.0003], [4.9997, 1.0]], false);
        let written = vec![vec![[5.0, 1.0], [5.0, 9.0]]];
        assert_eq!(once(vec![vec![low.clone()], vec![high.clone()]]), [vec![], written.clone()]);
        assert_eq!(once(vec![vec![high.clone(), low]]), [written]);
        let beside = path(&[[5.001, 1.0], [5.001, 9.0]], false);
        assert_eq!(once(vec![vec![high, beside]])[0].len(), 2, "a step apart");
    }

    #[test]
    fn of_lines_that_coincide_in_part_the_rest_stays() {
        let wall = path(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], true);
        let line = path(&[[2.0, 0.0002], [3.0, 0.0003]], false);
        // The closed path is open now, and one.
        let open = vec![[3.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0], [2.0, 0.0]];
        assert_eq!(once(vec![vec![line.clone(), wall.clone()]])[0], [vec![[2.0, 0.0], [3.0, 0.0]], open]);
        // In the other order nothing of the line is left.
        assert_eq!(once(vec![vec![wall, line]])[0].len(), 1);
        let slant = path(&[[0.0, 0.0], [2.0, 1.0], [4.0, 2.0], [6.0, 3.0]], false);
        let middle = path(&[[5.0, 2.5], [1.0, 0.5]], false);
        let rest = [vec![[0.0, 0.0], [1.0, 0.5]], vec![[5.0, 2.5], [6.0, 3.0]]];
        assert_eq!(once(vec![vec![middle, slant]])[0][1..], rest);
    }

    #[test]
    fn a_line_that_turns_back_on_itself_is_drawn_once() {
        let there_and_back = path(&[[1.0, 1.0], [1.0, 8.0], [1.0004, 8.0], [1.0004, 1.0]], false);
        assert_eq!(once(vec![vec![there_and_back]]), [[[[1.0, 1.0], [1.0, 8.0], [1.0, 8.0]]]]);
        let dot = path(&[[1.0, 1.0], [1.0002, 1.0]], false);
        assert_eq!(once(vec![vec![dot]])[0].len(), 1, "a dot alone stays");
    }
}
