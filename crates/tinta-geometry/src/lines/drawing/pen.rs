//! Orders and directs paths for a plotter to shorten pen-up travel, and cuts dashes into separate lines.
//!
//! The pen always moves to the nearest start of an undrawn path. An open path may start at either end, a closed one
//! at any of its points. A k-d tree of the starts, with the number left in each part, finds the nearest in O(log n).
//! Unlike a grid it stays fast when most of the picture is drawn.

use crate::lines::LinePath;
use glam::DVec2;
use std::ops::Range;

/// Sorts paths for a pen that starts in the upper left corner.
pub(in crate::lines) fn in_pen_order(mut paths: Vec<LinePath>) -> Vec<LinePath> {
    let mut beginnings = Beginnings::new(&paths);
    let mut order = Vec::with_capacity(paths.len());
    let mut pen = DVec2::ZERO;
    while let Some(Beginning { path, point, .. }) = beginnings.nearest(pen) {
        beginnings.take(path);
        let chosen = &mut paths[path];
        if chosen.is_closed {
            chosen.rotate(point);
        } else if point != 0 {
            chosen.reverse();
        }
        pen = match chosen.is_closed {
            true => chosen.points_px.first(),
            false => chosen.points_px.last(),
        }
        .copied()
        .unwrap_or(pen);
        order.push(path);
    }
    let mut paths: Vec<Option<LinePath>> = paths.into_iter().map(Some).collect();
    order.into_iter().filter_map(|path| paths[path].take()).collect()
}

/// A possible start of a path.
#[derive(Clone, Copy)]
struct Beginning {
    at: [f64; 2],
    path: usize,
    point: usize,
}

/// A k-d tree: the middle element of each part divides the rest, by x and y in turn.
struct Beginnings {
    tree: Vec<Beginning>,
    /// The number of starts left in the part that each element divides.
    left: Vec<usize>,
    is_taken: Vec<bool>,
    /// Each path's places in the tree, path by path.
    places: Vec<(usize, usize)>,
}

impl Beginnings {
    fn new(paths: &[LinePath]) -> Self {
        let mut tree = Vec::new();
        for (path, line) in paths.iter().enumerate() {
            let last = line.points_px.len().saturating_sub(1);
            let can_begin = |point: &usize| line.is_closed || *point == 0 || *point == last;
            let points = line.points_px.iter().enumerate().filter(|(point, _)| can_begin(point));
            tree.extend(points.map(|(point, at)| Beginning { at: at.to_array(), path, point }));
        }
        let count = tree.len();
        divide(&mut tree, 0);
        let mut places: Vec<(usize, usize)> =
            tree.iter().enumerate().map(|(place, beginning)| (beginning.path, place)).collect();
        places.sort_unstable();
        let mut left = vec![0; count];
        count_parts(0..count, &mut left);
        Self { tree, left, is_taken: vec![false; paths.len()], places }
    }

    fn nearest(&self, pen: DVec2) -> Option<Beginning> {
        let mut best = None;
        self.search(0..self.tree.len(), 0, pen.to_array(), &mut best);
        best.map(|(_, place)| self.tree[place])
    }

    fn search(&self, part: Range<usize>, axis: usize, pen: [f64; 2], best: &mut Option<(f64, usize)>) {
        let middle = middle(&part);
        if part.is_empty() || self.left[middle] == 0 {
            return;
        }
        let Beginning { at, path, .. } = self.tree[middle];
        let [x, y] = [at[0] - pen[0], at[1] - pen[1]];
        let squared = x * x + y * y;
        // Only a nearer start replaces the best, so thousands of lines from one point are not all visited each time.
        let is_better = |squared: f64, best: &Option<(f64, usize)>| best.is_none_or(|(least, _)| squared < least);
        if !self.is_taken[path] && is_better(squared, best) {
            *best = Some((squared, middle));
        }
        let across = pen[axis] - at[axis];
        let [low, high] = [part.start..middle, middle + 1..part.end];
        let [near, far] = if across < 0.0 { [low, high] } else { [high, low] };
        self.search(near, 1 - axis, pen, best);
        if is_better(across * across, best) {
            self.search(far, 1 - axis, pen, best);
        }
    }

    /// Removes all starts of a path, once it is drawn.
    fn take(&mut self, path: usize) {
        self.is_taken[path] = true;
        let first = self.places.partition_point(|(other, _)| *other < path);
        for (_, place) in self.places[first..].iter().take_while(|(other, _)| *other == path) {
            let mut part = 0..self.tree.len();
            loop {
                let middle = middle(&part);
                self.left[middle] -= 1;
                match place.cmp(&middle) {
                    std::cmp::Ordering::Less => part.end = middle,
                    std::cmp::Ordering::Equal => break,
                    std::cmp::Ordering::Greater => part.start = middle + 1,
                }
            }
        }
    }
}

fn middle(part: &Range<usize>) -> usize {
    part.start + part.len() / 2
}

/// Builds the tree of a part; path numbers break ties, so every run gives the same tree.
fn divide(part: &mut [Beginning], axis: usize) {
    if part.len() < 2 {
        return;
    }
    let middle = part.len() / 2;
    let (low, _, high) = part.select_nth_unstable_by(middle, |a, b| {
        a.at[axis].total_cmp(&b.at[axis]).then((a.path, a.point).cmp(&(b.path, b.point)))
    });
    divide(low, 1 - axis);
    divide(high, 1 - axis);
}

fn count_parts(part: Range<usize>, left: &mut [usize]) {
    if part.is_empty() {
        return;
    }
    let middle = middle(&part);
    left[middle] = part.len();
    count_parts(part.start..middle, left);
    count_parts(middle + 1..part.end, left);
}

/// Cuts a path into dashes with gaps between them, of these lengths in turn, all above 0, because plotter programs ignore an
/// SVG's dashes.
pub(in crate::lines) fn dashes(path: &LinePath, pattern_px: &[f64]) -> Vec<LinePath> {
    let mut lengths = pattern_px.iter().copied().cycle();
    let mut next = move || lengths.next().unwrap_or(f64::INFINITY);
    let count = path.points_px.len();
    let begin = |point: DVec2, piece: usize| LinePath {
        points_px: vec![point],
        is_closed: false,
        segments: vec![piece],
        ..LinePath { points_px: Vec::new(), segments: Vec::new(), ..path.clone() }
    };
    let mut dashes: Vec<LinePath> = Vec::new();
    let mut dash: Option<LinePath> = path.points_px.first().zip(path.segments.first()).map(|(p, s)| begin(*p, *s));
    let mut rest = next();
    for (k, piece) in path.segments.iter().enumerate() {
        let [a, b] = [path.points_px[k], path.points_px[(k + 1) % count]];
        let length = a.distance(b);
        if let Some(dash) = &mut dash
            && dash.segments.last() != Some(piece)
        {
            dash.segments.push(*piece);
        }
        let mut done = 0.0;
        while length - done > rest {
            done += rest;
            let point = a + (b - a) * (done / length);
            match dash.take() {
                Some(mut whole) => {
                    whole.points_px.push(point);
                    dashes.push(whole);
                }
                None => dash = Some(begin(point, *piece)),
            }
            rest = next();
        }
        rest -= length - done;
        if let Some(dash) = &mut dash {
            dash.points_px.push(b);
        }
    }
    dashes.extend(dash.filter(|dash| dash.points_px.len() > 1));
    dashes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;

    fn path(points: &[[f64; 2]], is_closed: bool) -> LinePath {
        let points_px: Vec<DVec2> = points.iter().map(|point| DVec2::from_array(*point)).collect();
        let segments = (0..points.len() - usize::from(!is_closed)).collect();
        LinePath {
            class: Class::Crease,
            is_visible: true,
            is_outline: false,
            object: 0,
            look: 0,
            points_px,
            is_closed,
            segments,
        }
    }

    /// Points scattered by a simple generator, the same on every platform.
    fn scattered(count: usize) -> Vec<LinePath> {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24) * 1000.0
        };
        (0..count)
            .map(|k| {
                let [x, y] = [next(), next()];
                path(&[[x, y], [x + 3.0, y], [x, y + 2.0]], k % 3 == 0)
            })
            .collect()
    }

    #[test]
    fn the_nearest_beginning_is_found_whatever_is_taken() {
        let paths = scattered(300);
        let mut left: Vec<bool> = vec![true; paths.len()];
        let mut beginnings = Beginnings::new(&paths);
        let mut pen = DVec2::new(500.0, 400.0);
        while let Some(found) = beginnings.nearest(pen) {
            let distances = paths.iter().enumerate().filter(|(path, _)| left[*path]).flat_map(|(_, path)| {
                let last = path.points_px.len() - 1;
                let can_begin = move |k: usize| path.is_closed || k == 0 || k == last;
                path.points_px.iter().enumerate().filter(move |(k, _)| can_begin(*k)).map(|(_, at)| at.distance(pen))
            });
            let nearest = distances.fold(f64::MAX, f64::min);
            assert!(left[found.path]);
            assert_eq!(DVec2::from_array(found.at).distance(pen), nearest);
            left[found.path] = false;
            beginnings.take(found.path);
            pen = DVec2::from_array(found.at);
        }
        assert!(left.iter().all(|is_left| !is_left));
    }

    #[test]
    fn the_order_keeps_every_path_and_spares_most_of_the_way() {
        let travel = |paths: &[LinePath]| {
            let end = |path: &LinePath| path.points_px[if path.is_closed { 0 } else { path.points_px.len() - 1 }];
            paths.windows(2).map(|pair| end(&pair[0]).distance(pair[1].points_px[0])).sum::<f64>()
        };
        let paths = scattered(2000);
        let ordered = in_pen_order(paths.clone());
        assert_eq!(ordered.len(), paths.len());
        assert!(travel(&ordered) < travel(&paths) * 0.05, "{} {}", travel(&ordered), travel(&paths));
        assert_eq!(ordered, in_pen_order(paths));
    }

    #[test]
    fn a_hundred_thousand_lines_from_one_point_do_not_take_for_ever() {
        let line = |k: u32| path(&[[0.0, 0.0], [f64::from(k % 300) + 1.0, f64::from(k / 300)]], false);
        assert_eq!(in_pen_order((0..100_000).map(line).collect()).len(), 100_000);
    }

    #[test]
    fn dashes_go_round_corners_and_keep_their_lengths() {
        let corner = path(&[[0.0, 0.0], [10.0, 0.0], [10.0, 7.0]], false);
        let pieces = dashes(&corner, &[4.0, 3.0]);
        let shapes: Vec<Vec<[f64; 2]>> =
            pieces.iter().map(|dash| dash.points_px.iter().map(|point| point.to_array()).collect()).collect();
        let expected = vec![
            vec![[0.0, 0.0], [4.0, 0.0]],
            vec![[7.0, 0.0], [10.0, 0.0], [10.0, 1.0]],
            vec![[10.0, 4.0], [10.0, 7.0]],
        ];
        assert_eq!(shapes, expected);
        let of: Vec<&[usize]> = pieces.iter().map(|dash| &dash.segments[..]).collect();
        assert_eq!(of, [&[0][..], &[0, 1], &[1]]);
        let square = path(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], true);
        let length = |dash: &LinePath| dash.points_px.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
        let total: f64 = dashes(&square, &[1.0, 1.0]).iter().map(length).sum();
        assert!((total - 8.0).abs() < 1e-9 && dashes(&square, &[1.0, 1.0]).iter().all(|dash| !dash.is_closed));
    }
}
