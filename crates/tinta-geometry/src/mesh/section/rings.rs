//! Directed sides in a plane joined into rings, and rings into outlines with their holes.

use glam::DVec2;
use robust::{Coord, orient2d};
use std::collections::HashMap;

/// Joins sides into closed rings; returns whether no side is left over.
///
/// Where several rings meet in a corner, each turns as far left as it can. With the solid at the left of all sides, a hole that
/// touches its outline becomes one ring with it, and two outlines that touch stay two.
pub(super) fn rings(sides: &[[u32; 2]], in_plane: impl Fn(u32) -> DVec2) -> (Vec<Vec<u32>>, bool) {
    let mut after: HashMap<u32, Vec<u32>> = HashMap::new();
    sides.iter().rev().for_each(|[from, to]| after.entry(*from).or_default().push(*to));
    let (mut rings, mut is_closed) = (Vec::new(), true);
    for [start, second] in sides {
        if !after.get(start).is_some_and(|nexts| nexts.contains(second)) {
            continue;
        }
        let mut path = vec![*start];
        let (mut before, mut corner) = (*start, *second);
        loop {
            let Some(nexts) = after.get_mut(&corner).filter(|nexts| !nexts.is_empty()) else {
                is_closed = false;
                after.entry(*start).and_modify(|nexts| nexts.retain(|next| next != second));
                break;
            };
            let next = nexts.remove(leftmost(nexts, before, corner, &in_plane));
            if [corner, next] == [*start, *second] {
                rings.push(path);
                break;
            }
            path.push(corner);
            (before, corner) = (corner, next);
        }
    }
    (rings, is_closed)
}

/// The number of the next corner that is met first clockwise from the way back.
fn leftmost(nexts: &[u32], before: u32, corner: u32, in_plane: &impl Fn(u32) -> DVec2) -> usize {
    if nexts.len() == 1 {
        return 0;
    }
    let [back, middle] = [before, corner].map(in_plane);
    let turn = |from: DVec2, to: DVec2| {
        let [a, b, c] = [middle, from, to].map(|DVec2 { x, y }| Coord { x, y });
        orient2d(a, b, c)
    };
    // Whether a way lies within half a turn clockwise from the way back, which itself comes last.
    let is_near = |to: DVec2| turn(back, to) < 0.0 || turn(back, to) == 0.0 && (to - middle).dot(back - middle) < 0.0;
    let ways: Vec<DVec2> = nexts.iter().map(|next| in_plane(*next)).collect();
    let comes_before = |first: DVec2, second: DVec2| match (is_near(first), is_near(second)) {
        (true, false) => true,
        (false, true) => false,
        _ => turn(first, second) < 0.0,
    };
    (1..ways.len()).fold(0, |best, at| if comes_before(ways[at], ways[best]) { at } else { best })
}

/// Twice a ring's area, positive counter-clockwise.
pub(crate) fn double_area(ring: &[DVec2]) -> f64 {
    (1..ring.len().saturating_sub(1)).map(|at| (ring[at] - ring[0]).perp_dot(ring[at + 1] - ring[0])).sum()
}

/// Whether a ring goes around a point.
fn encloses(ring: &[DVec2], point: DVec2) -> bool {
    let crosses = |at: &usize| {
        let (a, b) = (ring[*at] - point, ring[(at + 1) % ring.len()] - point);
        (a.y > 0.0) != (b.y > 0.0) && (a.perp_dot(b) > 0.0) == (b.y > a.y)
    };
    (0..ring.len()).filter(crosses).count() % 2 == 1
}

/// The counter-clockwise rings, each with its holes: the clockwise rings that no smaller one encloses.
pub(super) fn nested(rings: &[Vec<DVec2>]) -> Vec<(usize, Vec<usize>)> {
    let areas: Vec<f64> = rings.iter().map(|ring| double_area(ring)).collect();
    let mut nested: Vec<(usize, Vec<usize>)> =
        (0..rings.len()).filter(|ring| areas[*ring] > 0.0).map(|ring| (ring, Vec::new())).collect();
    for hole in (0..rings.len()).filter(|ring| areas[*ring] <= 0.0) {
        // Between two vertices, where no loop that touches this one in a vertex is met.
        let inner = (rings[hole][0] + rings[hole][1]) * 0.5;
        let around =
            nested.iter_mut().filter(|(outer, _)| areas[*outer] > -areas[hole] && encloses(&rings[*outer], inner));
        if let Some((_, holes)) = around.min_by(|a, b| areas[a.0].total_cmp(&areas[b.0])) {
            holes.push(hole);
        }
    }
    nested
}
