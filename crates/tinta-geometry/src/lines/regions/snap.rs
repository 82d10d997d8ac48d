//! Snap rounding: segments on an integer grid, cut wherever they cross or nearly touch.
//!
//! In: segments between grid points. Out: segments that meet only at their ends. Each grid point that is an end, or that is
//! nearest to a crossing, is *hot*: every segment that passes through its unit square is bent to its middle (Hobby 1999; Guibas
//! and Marimont 1998). Nothing moves farther than a grid step, no segment passes over a point, and all predicates are exact.

use crate::bvh::{Box3, BoxTree, NodeSelection};
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::memory::{DrawingWork, free};
use crate::threads::{cores, in_chunks, sort_by, spread_chunks};
use glam::{DVec2, I64Vec2};

/// A point of the grid. Coordinates stay below [`LARGEST`], so that products of two differences fit.
pub(super) type Point = I64Vec2;

/// Largest coordinate.
pub(super) const LARGEST: i64 = 1 << 29;

/// A segment, its lower end in lexicographic order first.
pub(super) type Segment = [Point; 2];

/// Memory that a planar map takes for each piece of a segment: its cut, two half-edges, their loops, its box in the hierarchy.
const PIECE_BYTES: usize = 256;

/// Items that a thread takes at once.
const CHUNK: usize = 2048;

/// Returns a segment with its lower end first.
pub(super) fn ordered(a: Point, b: Point) -> Segment {
    if lower(a, b) { [a, b] } else { [b, a] }
}

/// Whether a point comes before another in lexicographic order.
pub(super) fn lower(a: Point, b: Point) -> bool {
    (a.x, a.y) < (b.x, b.y)
}

/// Positive where a point lies left of the line from `from` to `to`, with y up.
pub(super) fn turn([from, to]: Segment, point: Point) -> i64 {
    (to - from).perp_dot(point - from)
}

/// Cuts segments at all crossings and hot points. Leaves out segments of no length and repeated ones.
///
/// # Errors
///
/// Those of [`Progress::go_on`], and [`crate::Error::Setting`] if the pieces need more memory than is free.
pub(super) fn snapped(mut segments: Vec<Segment>, asked: DrawingWork, progress: &Progress) -> Result<Vec<Segment>> {
    segments.retain(|[a, b]| a != b);
    sort(&mut segments);
    let (tree, order) = BoxTree::new(&segments.iter().map(around).collect::<Vec<_>>());
    let segments: Vec<Segment> = order.into_iter().map(|index| segments[index as usize]).collect();
    progress.go_on()?;
    let all = NodeSelection::default();
    let node_pairs = tree.node_pairs(&all);
    let found = spread_chunks(node_pairs.len(), 8, cores(), |range| {
        let mut found = SegmentMeetings::default();
        tree.pairs_below(&node_pairs[range], &all, &mut |first, second| {
            found.compare(&segments, first, second);
            found.count.is_multiple_of(1024) && progress.is_over()
        });
        found
    });
    progress.go_on()?;
    let count: usize = found.iter().map(|found| found.cuts.len() + 2 * found.crossings.len()).sum();
    asked.check((segments.len() + count) * PIECE_BYTES, free())?;
    let mut cuts: Vec<(u32, Point)> = found.iter().flat_map(|found| &found.cuts).copied().collect();
    let mut crossings: Vec<Point> = found.iter().flat_map(|found| &found.crossings).copied().collect();
    drop(found);
    crossings.sort_unstable_by_key(|point| (point.x, point.y));
    crossings.dedup();
    let at_crossings = in_chunks(crossings.len(), CHUNK, cores(), |range| {
        let mut cuts = Vec::new();
        for point in crossings[range].iter().copied().take_while(|_| !progress.is_over()) {
            tree.any(&around(&[point, point]), |place| {
                if passes(segments[place as usize], point) {
                    cuts.push((place, point));
                }
                false
            });
        }
        cuts
    });
    progress.go_on()?;
    cuts.extend(at_crossings.into_iter().flatten());
    let along = |(place, point): &(u32, Point)| {
        let [from, to] = segments[*place as usize];
        (*place, (to - from).dot(*point - from))
    };
    sort_by(&mut cuts, cores(), |a, b| along(a).cmp(&along(b)));
    let mut pieces = Vec::with_capacity(segments.len() + cuts.len());
    let mut cuts = cuts.into_iter().peekable();
    for (place, [from, to]) in (0u32..).zip(segments) {
        let mut last = from;
        while let Some((_, point)) = cuts.next_if(|(cut, _)| *cut == place) {
            pieces.push(ordered(last, point));
            last = point;
        }
        pieces.push(ordered(last, to));
    }
    pieces.retain(|[a, b]| a != b);
    sort(&mut pieces);
    Ok(pieces)
}

/// Sorts segments and leaves out repeated ones.
fn sort(segments: &mut Vec<Segment>) {
    sort_by(segments, cores(), |[a, b], [c, d]| (a.x, a.y, b.x, b.y).cmp(&(c.x, c.y, d.x, d.y)));
    segments.dedup();
}

/// The box of a segment with the unit squares of its ends.
fn around([a, b]: &Segment) -> Box3 {
    let flat = |point: Point| point.as_dvec2();
    let margin = DVec2::splat(0.5);
    Box3::new((flat(a.min(*b)) - margin).extend(0.0), (flat(a.max(*b)) + margin).extend(0.0))
}

/// Where segments meet.
#[derive(Default)]
struct SegmentMeetings {
    /// Ends of segments that other segments pass, with the place of the segment that passes.
    cuts: Vec<(u32, Point)>,
    /// The grid points nearest to crossings.
    crossings: Vec<Point>,
    count: u32,
}

impl SegmentMeetings {
    fn compare(&mut self, segments: &[Segment], first: u32, second: u32) {
        self.count = self.count.wrapping_add(1);
        let [one, other] = [first, second].map(|place| segments[place as usize]);
        let ends_of_other = other.map(|point| turn(one, point));
        let ends_of_one = one.map(|point| turn(other, point));
        for (place, segment, points, turns) in [(first, one, other, ends_of_other), (second, other, one, ends_of_one)] {
            for (point, turn) in points.into_iter().zip(turns) {
                if !segment.contains(&point) && passes_at(segment, point, turn) {
                    self.cuts.push((place, point));
                }
            }
        }
        let apart = |[a, b]: [i64; 2]| a > 0 && b < 0 || a < 0 && b > 0;
        if apart(ends_of_other) && apart(ends_of_one) {
            self.crossings.push(crossing(one, ends_of_one));
        }
    }
}

/// Whether a segment passes through the unit square of a point.
fn passes(segment: Segment, point: Point) -> bool {
    passes_at(segment, point, turn(segment, point))
}

/// Like [`passes`], where the segment's [`turn`] at the point is known. A line that touches a corner of the square counts as if
/// the squares lay an arbitrarily small step to the lower left, and a smaller one down: so every place has one square.
fn passes_at([from, to]: Segment, point: Point, turn: i64) -> bool {
    let (low, high, along) = (from.min(to), from.max(to), to - from);
    let is_beside = point.cmplt(low).any() || point.cmpgt(high).any();
    let reach = along.x.abs() + along.y.abs();
    match (2 * turn.abs()).cmp(&reach) {
        _ if is_beside => false,
        std::cmp::Ordering::Less => true,
        std::cmp::Ordering::Greater => false,
        std::cmp::Ordering::Equal => {
            let step = if along.y != 0 { along.y.signum() } else { -along.x.signum() };
            step != turn.signum()
        }
    }
}

/// The grid point nearest to a crossing; halves round up. `turns` are those of the segment's ends around the other segment.
fn crossing([from, to]: Segment, turns: [i64; 2]) -> Point {
    let [before, total] = [turns[0], turns[0] - turns[1]].map(i128::from);
    let (before, total) = (before * total.signum(), total.abs());
    let at = |from: i64, to: i64| {
        let way = i128::from(to - from) * before;
        from + (2 * way + total).div_euclid(2 * total) as i64
    };
    Point::new(at(from.x, to.x), at(from.y, to.y))
}
