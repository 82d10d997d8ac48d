//! Chains line segments into polylines that a pen draws in one stroke.
//!
//! Input: the segments of [`crate::lines::VisibleLines`]. Output: [`LinePath`]s. Two segments of one layer, object and
//! style are joined where their ends coincide bit for bit. Where more than two meet, the straightest continuations are
//! joined first. Meetings are found by sorting the ends, in O(n log n). Only sums, products and square roots decide,
//! so every platform gives the same paths.

use crate::edges::Class;
use crate::lines::LineSegment;
use crate::lines::drawing::layers::Layer;
use glam::DVec2;
use std::cmp::Ordering;

/// Segments drawn as one line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinePath {
    /// Their class; an outline's segments may have several, of which this is one.
    pub class: Class,
    /// Whether they are visible.
    pub is_visible: bool,
    /// Whether they belong to the outline.
    pub is_outline: bool,
    /// Their object's number in the scene.
    pub object: u32,
    /// The number of their style in [`VisibleLines::looks`](super::super::VisibleLines::looks).
    pub look: u32,
    /// Their ends in order, pixels, y down; a closed path does not repeat its first point.
    pub points_px: Vec<DVec2>,
    /// Whether the last point is joined to the first.
    pub is_closed: bool,
    /// Indices of the segments in the chained list: segment `k` goes from point `k` to the next.
    pub segments: Vec<usize>,
}

impl LinePath {
    /// A stroke of a tone: it consists of no segments, so its class and object mean nothing.
    pub(in crate::lines) fn of_stroke(points_px: Vec<DVec2>) -> Self {
        Self { is_visible: true, points_px, ..Self::default() }
    }

    pub(in crate::lines) fn layer(&self) -> Layer {
        Layer::of(self.class, self.is_visible, self.is_outline)
    }

    pub(in crate::lines) fn reverse(&mut self) {
        self.points_px.reverse();
        self.segments.reverse();
        if self.is_closed {
            // The closing segment stays last: the points now begin where they ended.
            self.points_px.rotate_right(1);
        }
    }

    /// Makes another point the first of a closed path.
    pub(in crate::lines) fn rotate(&mut self, first: usize) {
        self.points_px.rotate_left(first);
        self.segments.rotate_left(first);
    }
}

/// Marks an end that is joined to none.
const FREE: usize = usize::MAX;

/// Candidates tried on each side of the straight continuation; up to nine ends at a meeting are all tried.
const TRIED: usize = 4;

/// An end of a segment. Segment `k` has ends `2k` and `2k + 1`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct End {
    object: u32,
    look: u32,
    layer: Layer,
    x: u64,
    y: u64,
    number: usize,
}

impl End {
    fn meets(&self, other: &Self) -> bool {
        (self.object, self.look, self.layer, self.x, self.y)
            == (other.object, other.look, other.layer, other.x, other.y)
    }
}

/// Joins segments to paths, in the order of each path's first segment. Omits segments without length, except
/// points, and hidden ones that other lines replace.
pub fn chain(segments: &[LineSegment]) -> Vec<LinePath> {
    let partners = partners(segments);
    let mut is_drawn = vec![false; segments.len()];
    let mut paths = Vec::new();
    for first in 0..segments.len() {
        if !is_drawn[first] && is_drawn_itself(&segments[first]) {
            paths.push(walk(segments, &partners, first, &mut is_drawn));
        }
    }
    paths
}

fn is_drawn_itself(segment: &LineSegment) -> bool {
    !segment.is_covered && (segment.class == Class::Point || segment.ends_px[0] != segment.ends_px[1])
}

fn position(segments: &[LineSegment], end: usize) -> DVec2 {
    segments[end / 2].ends_px[end % 2]
}

/// For each end the end that it is joined to, or [`FREE`].
fn partners(segments: &[LineSegment]) -> Vec<usize> {
    let mut ends = Vec::with_capacity(segments.len() * 2);
    // A point is a path of its own.
    let is_joined = |segment: &LineSegment| is_drawn_itself(segment) && segment.class != Class::Point;
    for (index, segment) in segments.iter().enumerate().filter(|(_, segment)| is_joined(segment)) {
        for (which, point) in segment.ends_px.iter().enumerate() {
            // Adding 0 turns -0 into 0, which is the same place.
            let [x, y] = [point.x, point.y].map(|value| (value + 0.0).to_bits());
            let layer = segment.layer();
            let LineSegment { object, look, .. } = *segment;
            ends.push(End { object, look, layer, x, y, number: index * 2 + which });
        }
    }
    ends.sort_unstable();
    let mut partners = vec![FREE; segments.len() * 2];
    for meeting in ends.chunk_by(End::meets) {
        match meeting {
            [_] => (),
            [a, b] => join(&mut partners, a.number, b.number),
            many => join_straightest(segments, many, &mut partners),
        }
    }
    partners
}

fn join(partners: &mut [usize], a: usize, b: usize) {
    partners[a] = b;
    partners[b] = a;
}

/// Joins the ends of one meeting in pairs, the straightest continuations first.
fn join_straightest(segments: &[LineSegment], meeting: &[End], partners: &mut [usize]) {
    // The direction in which each end leaves the meeting, and its place on a circle of circumference 4.
    let mut leaving: Vec<(f64, DVec2, usize)> = meeting
        .iter()
        .map(|end| {
            let away = position(segments, end.number ^ 1) - position(segments, end.number);
            let direction = away.normalize_or_zero();
            (place_on_circle(direction), direction, end.number)
        })
        .collect();
    leaving.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let count = leaving.len();
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (index, (place, direction, number)) in leaving.iter().enumerate() {
        let straight_on = (place + 2.0) % 4.0;
        let nearest = leaving.partition_point(|(place, ..)| *place < straight_on);
        for step in 0..count.min(2 * TRIED + 1) {
            let other = (nearest + count * TRIED + step - TRIED) % count;
            if other != index {
                let (_, other_direction, other_number) = leaving[other];
                // -1 is straight on, 1 is back.
                let cosine = direction.dot(other_direction);
                pairs.push((cosine, (*number).min(other_number), (*number).max(other_number)));
            }
        }
    }
    pairs.sort_unstable_by(|a, b| match a.0.total_cmp(&b.0) {
        Ordering::Equal => (a.1, a.2).cmp(&(b.1, b.2)),
        order => order,
    });
    for (_, a, b) in pairs {
        if partners[a] == FREE && partners[b] == FREE {
            join(partners, a, b);
        }
    }
}

/// A number in [0, 4) that grows with the direction's angle. It avoids trigonometry, which differs between platforms.
fn place_on_circle(direction: DVec2) -> f64 {
    let DVec2 { x, y } = direction;
    let sum = x.abs() + y.abs();
    if sum == 0.0 {
        return 0.0;
    }
    match (x >= 0.0, y >= 0.0) {
        (true, true) => y / sum,
        (false, true) => 1.0 - x / sum,
        (false, false) => 2.0 - y / sum,
        (true, false) => (3.0 + x / sum) % 4.0,
    }
}

/// The path through segment `first`, in that segment's direction.
fn walk(segments: &[LineSegment], partners: &[usize], first: usize, is_drawn: &mut [bool]) -> LinePath {
    let mut begin = first * 2;
    let mut is_closed = false;
    while partners[begin] != FREE {
        begin = partners[begin] ^ 1;
        if begin == first * 2 {
            is_closed = true;
            break;
        }
    }
    let mut points_px = vec![position(segments, begin)];
    let mut pieces = Vec::new();
    loop {
        is_drawn[begin / 2] = true;
        pieces.push(begin / 2);
        points_px.push(position(segments, begin ^ 1));
        begin = partners[begin ^ 1];
        if begin == FREE || is_drawn[begin / 2] {
            break;
        }
    }
    if is_closed {
        points_px.pop();
    }
    let LineSegment { class, is_visible, is_outline, object, look, .. } = segments[first];
    LinePath { class, is_visible, is_outline, object, look, points_px, is_closed, segments: pieces }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(a: [f64; 2], b: [f64; 2]) -> LineSegment {
        LineSegment {
            class: Class::Crease,
            is_visible: true,
            is_outline: false,
            background: [false; 2],
            is_covered: false,
            ends_px: [a.into(), b.into()],
            ends_world: [a, b].map(|[x, y]| glam::DVec3::new(x, y, 0.0)),
            edge: Some([0, 1]),
            angle_degrees: None,
            object: 0,
            part: 0,
            look: 0,
        }
    }

    #[test]
    fn a_square_in_any_order_and_direction_is_one_closed_path() {
        let corners = [[1.0, 1.0], [9.0, 1.0], [9.0, 9.0], [1.0, 9.0]];
        let side = |i: usize| segment(corners[i], corners[(i + 1) % 4]);
        let turned = |i: usize| segment(corners[(i + 1) % 4], corners[i]);
        let paths = chain(&[side(2), turned(0), side(3), turned(1)]);
        assert_eq!(paths.len(), 1);
        assert!(paths[0].is_closed);
        assert_eq!(paths[0].segments, [0, 2, 1, 3]);
        let around = [[9.0, 9.0], [1.0, 9.0], [1.0, 1.0], [9.0, 1.0]].map(DVec2::from_array);
        assert_eq!(paths[0].points_px, around);
    }

    #[test]
    fn at_a_t_the_straight_line_goes_on() {
        let stem = segment([5.0, 5.0], [5.0, 9.0]);
        let (left, right) = (segment([1.0, 5.0], [5.0, 5.0]), segment([9.0, 5.0], [5.0, 5.0]));
        let paths = chain(&[stem, left, right]);
        let shapes: Vec<&[usize]> = paths.iter().map(|path| &path.segments[..]).collect();
        assert_eq!(shapes, [&[0][..], &[1, 2]]);
    }

    #[test]
    fn where_many_lines_cross_each_goes_straight_on() {
        let spoke = |k: u32| {
            let angle = f64::from(k) / 200.0 * std::f64::consts::TAU;
            segment([50.0, 50.0], [50.0 + 40.0 * angle.cos(), 50.0 + 40.0 * angle.sin()])
        };
        let paths = chain(&(0..200).map(spoke).collect::<Vec<_>>());
        assert_eq!(paths.len(), 100);
        for path in paths {
            assert_eq!(path.segments[0].abs_diff(path.segments[1]), 100, "{:?}", path.segments);
        }
    }

    #[test]
    fn lines_over_one_another_and_loops_at_a_meeting_are_followed_to_their_end() {
        let twice = [segment([1.0, 1.0], [5.0, 1.0]), segment([1.0, 1.0], [5.0, 1.0])];
        let paths = chain(&twice);
        assert!(paths.len() == 1 && paths[0].is_closed && paths[0].points_px.len() == 2);
        // A loop that returns to where two other lines meet.
        let a = [50.0, 50.0];
        let around = [[a, [60.0, 60.0]], [[60.0, 60.0], [40.0, 60.0]], [[40.0, 60.0], a]];
        let through = [[[10.0, 50.0], a], [a, [90.0, 50.0]]];
        let pieces: Vec<LineSegment> = around.iter().chain(&through).map(|[a, b]| segment(*a, *b)).collect();
        let paths = chain(&pieces);
        let shapes: Vec<(bool, &[usize])> = paths.iter().map(|path| (path.is_closed, &path.segments[..])).collect();
        assert_eq!(shapes, [(true, &[0, 1, 2][..]), (false, &[3, 4])]);
    }

    #[test]
    fn classes_visibilities_and_objects_are_not_joined() {
        let meet = || [segment([1.0, 1.0], [2.0, 2.0]), segment([2.0, 2.0], [3.0, 1.0])];
        assert_eq!(chain(&meet()).len(), 1);
        let changes: [fn(&mut LineSegment); 5] = [
            |s| s.class = Class::Boundary,
            |s| s.is_visible = false,
            |s| s.is_outline = true,
            |s| s.object = 1,
            |s| s.look = 1,
        ];
        for change in changes {
            let mut segments = meet();
            change(&mut segments[1]);
            assert_eq!(chain(&segments).len(), 2);
        }
        let mut outline = meet().map(|segment| LineSegment { is_outline: true, ..segment });
        outline[1].class = Class::Boundary;
        assert_eq!(chain(&outline).len(), 1, "an outline goes on whatever its classes are");
        let mut segments = meet();
        segments[0].ends_px[1].x = 2.0_f64.next_up();
        assert_eq!(chain(&segments).len(), 2, "ends that only nearly meet");
        let negative = [segment([-0.0, 1.0], [2.0, 2.0]), segment([0.0, 1.0], [3.0, 1.0])];
        assert_eq!(chain(&negative).len(), 1, "0 and -0 are the same place");
    }

    #[test]
    fn every_piece_is_in_one_path_and_every_path_holds_together() {
        // A grid of streets, with meetings of two, three and four segments.
        let mut segments = Vec::new();
        for i in 0..20 {
            for j in 0..20 {
                let at = |i: i32, j: i32| [f64::from(i), f64::from(j)];
                segments.push(segment(at(i, j), at(i + 1, j)));
                segments.push(segment(at(i, j + 1), at(i, j)));
            }
        }
        segments.push(segment([3.0, 3.0], [3.0, 3.0]));
        let paths = chain(&segments);
        let mut seen: Vec<usize> = paths.iter().flat_map(|path| path.segments.clone()).collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..800).collect::<Vec<_>>());
        for path in &paths {
            let count = path.points_px.len();
            for (k, piece) in path.segments.iter().enumerate() {
                let ends = segments[*piece].ends_px;
                let step = [path.points_px[k], path.points_px[(k + 1) % count]];
                assert!(ends == step || [ends[1], ends[0]] == step);
            }
        }
        assert!(paths.is_sorted_by_key(|path| path.segments.iter().min().copied()));
        assert!(paths.len() < 50, "{}", paths.len());
    }

    #[test]
    fn a_path_turned_round_keeps_its_pieces_between_their_points() {
        let corners = [[1.0, 1.0], [9.0, 1.0], [9.0, 9.0]];
        let mut path = chain(&[0, 1, 2].map(|i| segment(corners[i], corners[(i + 1) % 3]))).remove(0);
        path.rotate(1);
        path.reverse();
        assert_eq!(path.segments, [0, 2, 1]);
        let order = [[9.0, 1.0], [1.0, 1.0], [9.0, 9.0]].map(DVec2::from_array);
        assert_eq!(path.points_px, order);
    }
}
