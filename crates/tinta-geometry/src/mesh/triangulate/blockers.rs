//! A tree of a polygon's corners that finds those in a triangle: boxes in boxes, split at the middle of the longer side.
//!
//! The tree stays unchanged while the polygon shrinks; only the set of counted corners changes.

use super::simple_polygon::turn;
use glam::DVec2;
use std::ops::Range;

/// Most corners of a leaf, about.
const LEAF_CORNERS: usize = 8;

/// By how much a box must be outside of a triangle to be passed over, as twice an area. Corners are within 4 of one another,
/// whose products are rounded by less; passing over fewer costs time only.
const CLEARLY_OUTSIDE: f64 = 1e-13;

/// The tree.
pub(super) struct Blockers<'a> {
    points: &'a [DVec2],
    /// Corners in the order of the leaves.
    order: Vec<u32>,
    /// Where each corner stands in that order.
    place: Vec<u32>,
    /// Whether each corner counts.
    counts: Vec<bool>,
    /// How many leaves there are, a power of two. The node `i` is above `2 i` and `2 i + 1`, the root is 1.
    leaves: usize,
    nodes: Vec<Node>,
}

/// A box and how many of the corners in it count.
#[derive(Clone, Copy)]
struct Node {
    low: DVec2,
    high: DVec2,
    count: u32,
}

impl<'a> Blockers<'a> {
    /// Builds a tree of corners, none of them counted yet.
    pub(super) fn new(points: &'a [DVec2]) -> Self {
        let leaves = (points.len() / LEAF_CORNERS).next_power_of_two();
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        let mut nodes = vec![Node { low: DVec2::ZERO, high: DVec2::ZERO, count: 0 }; 2 * leaves];
        for (node, place) in nodes.iter_mut().enumerate().skip(1) {
            let range = range(node, points.len());
            let corners = &mut order[range.clone()];
            let at = |corner: &u32| points[*corner as usize];
            let low = corners.iter().map(at).fold(DVec2::INFINITY, DVec2::min);
            let high = corners.iter().map(at).fold(DVec2::NEG_INFINITY, DVec2::max);
            *place = Node { low, high, count: 0 };
            let middle = self::range(2 * node, points.len()).end - range.start;
            if node < leaves && middle < corners.len() {
                let axis = usize::from((high - low).x < (high - low).y);
                corners.select_nth_unstable_by(middle, |one, other| at(one)[axis].total_cmp(&at(other)[axis]));
            }
        }
        let mut place = vec![0; points.len()];
        order.iter().zip(0..).for_each(|(corner, number)| place[*corner as usize] = number);
        Self { points, order, place, counts: vec![false; points.len()], leaves, nodes }
    }

    /// Says whether a corner counts.
    pub(super) fn set(&mut self, corner: u32, counts: bool) {
        if std::mem::replace(&mut self.counts[corner as usize], counts) == counts {
            return;
        }
        let mut node = self.leaf(self.place[corner as usize] as usize);
        while node > 0 {
            let count = &mut self.nodes[node].count;
            *count = if counts { *count + 1 } else { *count - 1 };
            node /= 2;
        }
    }

    /// Whether any that counts lies in a triangle that goes round to the left, not at one of its corners; `touching` says
    /// whether the triangle's sides are in it.
    pub(super) fn any_in(&self, [a, b, c]: [DVec2; 3], touching: bool) -> bool {
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let sides = [(a, b), (b, c), (c, a)];
        let is_in = |point: DVec2| {
            let is_left =
                |(from, to)| if touching { turn(from, to, point) >= 0.0 } else { turn(from, to, point) > 0.0 };
            point.cmpge(low).all()
                && point.cmple(high).all()
                && point != a
                && point != b
                && point != c
                && sides.into_iter().all(is_left)
        };
        let may_hold = |node: &Node| {
            let is_near = |(from, to): (DVec2, DVec2)| {
                let along = to - from;
                // The box's corner that is furthest to the left.
                let left = DVec2::select(DVec2::new(-along.y, along.x).cmpge(DVec2::ZERO), node.high, node.low);
                along.perp_dot(left - from) >= -CLEARLY_OUTSIDE
            };
            node.count > 0 && node.low.cmple(high).all() && node.high.cmpge(low).all() && sides.into_iter().all(is_near)
        };
        let mut nodes = vec![1];
        while let Some(node) = nodes.pop() {
            if !may_hold(&self.nodes[node]) {
                continue;
            }
            if node < self.leaves {
                nodes.extend([2 * node, 2 * node + 1]);
                continue;
            }
            let corners = &self.order[range(node, self.points.len())];
            let is_there = |corner: &u32| self.counts[*corner as usize] && is_in(self.points[*corner as usize]);
            if corners.iter().any(is_there) {
                return true;
            }
        }
        false
    }

    /// The leaf that holds this place of the order.
    fn leaf(&self, place: usize) -> usize {
        // The last leaf that begins there or before it.
        self.leaves + ((place + 1) * self.leaves - 1) / self.points.len()
    }
}

/// The places of the order that a node holds: the whole for the root, and half of it, rounded down, for each of the next two.
fn range(node: usize, count: usize) -> Range<usize> {
    let level = node.ilog2();
    let number = node - (1 << level);
    let place = |number: usize| (count * number) >> level;
    place(number)..place(number + 1)
}
