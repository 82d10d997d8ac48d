//! Cuts ears off a polygon of many corners one after another, and finds each quickly.
//!
//! A corner whose triangle holds no other corner is an ear. Cutting it off can make ears only of its two neighbours, so each
//! corner is tested a few times (Eberly, "Triangulation by Ear Clipping"). A tree finds the corners inside a triangle. earcut
//! tests all corners after each ear, which takes minutes for some polygons of 32,768 corners. Exact predicates decide which
//! corners remain and turn left, so a polygon whose sides do not cross always has an ear.

use super::blockers::Blockers;
use super::simple_polygon::turn;
use glam::DVec2;
use std::collections::VecDeque;

/// Splits a counter-clockwise polygon whose sides do not cross into triangles of corner numbers: two fewer than it has corners,
/// or even fewer if it has no area.
pub(super) fn cut_ears(points: &[DVec2], out: &mut Vec<[u32; 3]>) {
    let mut ring = Ring::new(points);
    let mut waiting: VecDeque<u32> = ring.corners().into();
    let mut is_waiting = vec![true; points.len()];
    let mut changed = Vec::new();
    let mut touching_blocks = true;
    while ring.count > 3 {
        let Some(corner) = waiting.pop_front() else {
            // Only a polygon that touches itself or has straight corners left gets here.
            let dropped = ring.corners().into_iter().filter(|corner| ring.drop_straight(*corner)).count();
            if dropped == 0 && !std::mem::replace(&mut touching_blocks, false) {
                return;
            }
            waiting = ring.corners().into();
            waiting.iter().for_each(|corner| is_waiting[*corner as usize] = true);
            continue;
        };
        is_waiting[corner as usize] = false;
        if !ring.has(corner) || !ring.is_ear(corner, touching_blocks) {
            continue;
        }
        out.push(ring.triangle(corner));
        ring.remove(corner, &mut changed);
        for neighbour in changed.drain(..) {
            if !std::mem::replace(&mut is_waiting[neighbour as usize], true) {
                waiting.push_back(neighbour);
            }
        }
    }
    let last = ring.start;
    if ring.turn(last) > 0.0 {
        out.push(ring.triangle(last));
    }
}

/// The remaining polygon.
struct Ring<'a> {
    points: &'a [DVec2],
    /// Each corner's neighbours, before it and after it; a removed corner is its own neighbour.
    neighbours: Vec<[u32; 2]>,
    /// A remaining corner.
    start: u32,
    count: usize,
    /// The corners that do not turn left: a triangle that holds any corner holds one of them.
    blockers: Blockers<'a>,
}

impl<'a> Ring<'a> {
    /// Keeps all corners except useless ones: repeated corners and the tips of spikes without area.
    fn new(points: &'a [DVec2]) -> Self {
        let count = points.len() as u32;
        let neighbours = (0..count).map(|i| [(i + count - 1) % count, (i + 1) % count]).collect();
        let blockers = Blockers::new(points);
        let mut ring = Self { points, neighbours, start: 0, count: points.len(), blockers };
        let mut corners = ring.corners();
        ring.settle(&mut corners);
        ring
    }

    fn has(&self, corner: u32) -> bool {
        self.neighbours[corner as usize][1] != corner
    }

    fn corners(&self) -> Vec<u32> {
        let next = |corner: &u32| Some(self.neighbours[*corner as usize][1]).filter(|next| *next != self.start);
        std::iter::successors(Some(self.start), next).collect()
    }

    fn triangle(&self, corner: u32) -> [u32; 3] {
        let [before, after] = self.neighbours[corner as usize];
        [before, corner, after]
    }

    fn places(&self, corner: u32) -> [DVec2; 3] {
        self.triangle(corner).map(|corner| self.points[corner as usize])
    }

    fn turn(&self, corner: u32) -> f64 {
        let [a, b, c] = self.places(corner);
        turn(a, b, c)
    }

    fn is_ear(&self, corner: u32, touching_blocks: bool) -> bool {
        self.turn(corner) > 0.0 && !self.blockers.any_in(self.places(corner), touching_blocks)
    }

    /// Removes a corner and any that become useless; `changed` gets the corners whose turn changes.
    fn remove(&mut self, corner: u32, changed: &mut Vec<u32>) {
        changed.extend(self.unlink(corner));
        self.settle(changed);
    }

    /// Removes a corner at which the polygon goes straight; returns whether it did.
    fn drop_straight(&mut self, corner: u32) -> bool {
        let is_straight = self.count > 3 && self.has(corner) && self.turn(corner) == 0.0;
        if is_straight {
            self.remove(corner, &mut Vec::new());
        }
        is_straight
    }

    /// Records these corners' turns, and removes one after another those at which the polygon turns back on itself: a spike
    /// without area would look like an ear at its bends. The list gets the neighbours of the removed corners.
    fn settle(&mut self, corners: &mut Vec<u32>) {
        let mut next = 0;
        while let Some(corner) = corners.get(next).copied() {
            next += 1;
            if !self.has(corner) {
                continue;
            }
            let ([a, b, c], turn) = (self.places(corner), self.turn(corner));
            if self.count > 3 && turn == 0.0 && (b - a).dot(c - b) <= 0.0 {
                corners.extend(self.unlink(corner));
            } else {
                self.blockers.set(corner, turn <= 0.0);
            }
        }
    }

    /// Removes a corner and returns its neighbours.
    fn unlink(&mut self, corner: u32) -> [u32; 2] {
        let [before, after] = self.neighbours[corner as usize];
        self.neighbours[before as usize][1] = after;
        self.neighbours[after as usize][0] = before;
        self.neighbours[corner as usize] = [corner; 2];
        self.blockers.set(corner, false);
        self.count -= 1;
        if self.start == corner {
            self.start = after;
        }
        [before, after]
    }
}
