//! Lines that double the outline: all along, their ink runs into its ink. At a face seen nearly edge-on, its far side is the outline
//! and its near side a line beside it; drawn both, they are one line too wide.
//!
//! In: strokes. Out: those to remove. A line ends where three strokes or more meet, or where the outline begins: it goes as a whole
//! or not at all. It must be longer than the distance within which its ink touches the outline's, and hold no piece of it together.

use super::strokes::{Stroke, Strokes};
use crate::disjoint_sets::DisjointSets;
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::ranges::{between, gaps, united};
use crate::threads::{cores, in_chunks};
use crate::tolerances::JOINED_PX;
use glam::DVec2;

/// Strokes that a thread tests at once.
const CHUNK: usize = 2048;

impl Strokes<'_> {
    /// The strokes of all lines that double the outline.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`].
    pub(super) fn doubled(&self, progress: &Progress) -> Result<Vec<usize>> {
        let widest =
            self.strokes.iter().filter(|stroke| stroke.is_outline).map(|stroke| stroke.width).fold(0.0, f64::max);
        if widest == 0.0 {
            return Ok(Vec::new());
        }
        let reaches = in_chunks(self.strokes.len(), CHUNK, cores(), |range| {
            let strokes = range.take_while(|_| !progress.is_over());
            strokes.map(|number| self.reach_if_doubled(number, widest)).collect::<Vec<_>>()
        });
        progress.go_on()?;
        let reaches = reaches.concat();
        let mut lines = DisjointSets::new(self.strokes.len());
        for ends in &self.ends {
            if let [a, b] = ends[..] {
                let [a, b] = [a / 2, b / 2];
                if [a, b].iter().all(|number| !self.strokes[*number as usize].is_outline) {
                    lines.join([a, b]);
                }
            }
        }
        // Of each line its length, and the largest of its reaches; `None` where a part of it lies elsewhere.
        let mut of_lines = vec![(0.0, Some(0.0_f64)); self.strokes.len()];
        for (number, (stroke, reach)) in self.strokes.iter().zip(&reaches).enumerate() {
            let (length, farthest) = &mut of_lines[lines.root(number as u32) as usize];
            *length += stroke.length;
            *farthest = farthest.zip(*reach).map(|(farthest, reach)| farthest.max(reach));
        }
        let is_doubled = |number: &usize| {
            let (length, reach) = of_lines[lines.root(*number as u32) as usize];
            reach.is_some_and(|reach| length > reach)
        };
        Ok((0..self.strokes.len()).filter(is_doubled).collect())
    }

    /// Within which distance of the outline's middle the ink of a stroke touches it, if it does all along; `widest` is the largest
    /// width of the outline.
    fn reach_if_doubled(&self, number: usize, widest: f64) -> Option<f64> {
        let stroke = &self.strokes[number];
        if stroke.is_outline || stroke.least == 0.0 {
            return None;
        }
        let mut near: Vec<[f64; 2]> = Vec::new();
        let mut reach = 0.0_f64;
        self.any_near(stroke.ends, (widest + stroke.width) / 2.0, |other| {
            let other = &self.strokes[other];
            if other.is_outline && other.look == stroke.look {
                reach = reach.max((other.width + stroke.width) / 2.0);
                near.extend(stroke.beside(other, (other.width + stroke.width) / 2.0));
            }
            false
        });
        let is_gap = |gap: &[f64; 2]| (gap[1] - gap[0]) * stroke.length > JOINED_PX;
        let runs_along = !near.is_empty() && !gaps([0.0, 1.0], &united(near)).iter().any(is_gap);
        (runs_along && !self.holds_outline(stroke)).then_some(reach)
    }

    /// Whether a piece of the outline ends on a stroke, and no other piece continues it there.
    fn holds_outline(&self, stroke: &Stroke) -> bool {
        self.any_near(stroke.ends, JOINED_PX, |piece| {
            let is_end = |end: &DVec2| self.strokes[piece].is_outline && stroke.distance(*end) <= JOINED_PX;
            self.strokes[piece].ends.into_iter().filter(is_end).any(|end| {
                let goes_on = |other: usize| {
                    other != piece && self.strokes[other].is_outline && self.strokes[other].distance(end) <= JOINED_PX
                };
                !self.any_near([end; 2], JOINED_PX, goes_on)
            })
        })
    }
}

impl Stroke {
    /// The parts of this stroke, as shares of it, that are no farther from another one than a distance: beside it, or around its ends.
    fn beside(&self, other: &Self, distance: f64) -> impl Iterator<Item = [f64; 2]> {
        let along = (other.ends[1] - other.ends[0]).normalize_or_zero();
        let way = self.ends[1] - self.ends[0];
        let from = self.ends[0] - other.ends[0];
        let range = between([0.0, 1.0], along.perp_dot(from), along.perp_dot(way), [-distance, distance]);
        let strip = range.and_then(|range| between(range, along.dot(from), along.dot(way), [0.0, other.length]));
        let discs = other.ends.map(|center| {
            let from = self.ends[0] - center;
            // The roots of |from + place * way| = distance.
            let (square, half) = (way.length_squared(), from.dot(way));
            let root = (half * half - square * (from.length_squared() - distance * distance)).sqrt();
            let range = [(-half - root) / square, (-half + root) / square].map(|place| place.clamp(0.0, 1.0));
            (range[0] < range[1]).then_some(range)
        });
        strip.into_iter().chain(discs.into_iter().flatten())
    }
}
