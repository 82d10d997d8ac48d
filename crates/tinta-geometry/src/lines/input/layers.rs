//! One layer of a region of a plane that polygons cover several times.
//!
//! Input: the polygons by their stretches of edges. Output: some of them that cover the region once, if the search finds any.

use crate::tolerances::CONTACT;
use glam::DVec2;
use std::collections::HashMap;

/// A stretch of an edge by its ends, the lower number first, and how often a polygon lies to its left: 1, or -1 to its right.
pub(super) type Side = ([u32; 2], i32);

/// One layer of a region, while it is assembled.
struct Covering<'a> {
    /// For each polygon its sides.
    sides: &'a [&'a [Side]],
    at_piece: HashMap<[u32; 2], Vec<(usize, i32)>>,
    /// For each polygon its triangles.
    flat: Vec<Vec<[DVec2; 3]>>,
    /// The distance below which positions coincide, file units.
    weld: f64,
    kept: Vec<usize>,
    tries: usize,
}

/// Most polygons of a region that is split into layers: each is compared with all, recursively.
const MOST_IN_LAYERS: usize = 1000;

/// Most polygons tried for one layer.
const MOST_TRIES: usize = 100_000;

/// The numbers of some polygons that cover a region once, which all of them cover several times; `None` if the search finds none.
pub(super) fn one_layer(sides: &[&[Side]], flat: Vec<Vec<[DVec2; 3]>>, weld: f64) -> Option<Vec<usize>> {
    if sides.len() > MOST_IN_LAYERS {
        return None;
    }
    let mut at_piece: HashMap<[u32; 2], Vec<(usize, i32)>> = HashMap::new();
    for (index, of_polygon) in sides.iter().enumerate() {
        of_polygon.iter().for_each(|(piece, side)| at_piece.entry(*piece).or_default().push((index, *side)));
    }
    let balance = |at_piece: &[(usize, i32)]| at_piece.iter().map(|(_, side)| *side).sum::<i32>().signum();
    let mut rim: Vec<Side> = at_piece.iter().map(|(piece, at_piece)| (*piece, balance(at_piece))).collect();
    rim.retain(|(_, side)| *side != 0);
    rim.sort_unstable();
    let mut layer = Covering { sides, at_piece, flat, weld, kept: Vec::new(), tries: MOST_TRIES };
    layer.fill(rim).then_some(layer.kept)
}

impl Covering<'_> {
    /// Adds polygons until each of these stretches has one on the given side, and each stretch of the added ones another on the
    /// other side. Adds nothing if there are no such polygons.
    fn fill(&mut self, mut open: Vec<Side>) -> bool {
        while let Some((piece, side)) = open.pop() {
            let on_side = self.at_piece[&piece].iter().filter(|(_, of_polygon)| *of_polygon == side);
            let on_side: Vec<usize> = on_side.map(|(polygon, _)| *polygon).collect();
            if on_side.iter().any(|polygon| self.kept.contains(polygon)) {
                continue;
            }
            return on_side.into_iter().any(|polygon| self.fill_with(polygon, &open));
        }
        true
    }

    /// Adds a polygon and what then must follow; adds nothing if that fails.
    fn fill_with(&mut self, polygon: usize, open: &[Side]) -> bool {
        if self.tries == 0 || self.kept.iter().any(|other| self.overlap(polygon, *other)) {
            return false;
        }
        self.tries -= 1;
        let before = self.kept.len();
        self.kept.push(polygon);
        let is_inner = |piece: &[u32; 2]| self.at_piece[piece].iter().map(|(_, side)| side).sum::<i32>() == 0;
        let across = self.sides[polygon].iter().filter(|(piece, _)| is_inner(piece));
        let more = open.iter().copied().chain(across.map(|(piece, side)| (*piece, -side))).collect();
        let is_filled = self.fill(more);
        if !is_filled {
            self.kept.truncate(before);
        }
        is_filled
    }

    fn overlap(&self, first: usize, second: usize) -> bool {
        let of_second = &self.flat[second];
        self.flat[first].iter().any(|one| of_second.iter().any(|other| overlap(*one, *other, self.weld)))
    }
}

/// Whether two coplanar triangles overlap by more than a strip of this width along a side.
pub(super) fn overlap(first: [DVec2; 3], second: [DVec2; 3], distance: f64) -> bool {
    let is_apart = |one: [DVec2; 3], other: [DVec2; 3]| {
        let turn = (one[1] - one[0]).perp_dot(one[2] - one[0]).signum();
        (0..3).any(|side| {
            let (from, along) = (one[side], one[(side + 1) % 3] - one[side]);
            let inward = along.perp() * turn;
            let margin = (distance + CONTACT * along.length()) * along.length();
            other.iter().all(|corner| inward.dot(*corner - from) <= margin)
        })
    };
    !is_apart(first, second) && !is_apart(second, first)
}
