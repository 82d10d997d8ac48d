//! The picture's pixels on an integer grid.

use super::snap::{LARGEST, Point, Segment, ordered};
use crate::ranges::between;
use glam::DVec2;

/// Steps of a grid over a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Steps a pixel: a power of two, so that pixels are points of the grid.
    steps: f64,
    /// Pixels.
    size: DVec2,
}

impl Grid {
    /// The finest grid over a picture of this size in pixels: in one of 512, steps of 2^-20 pixels.
    pub(super) fn over(size: DVec2) -> Self {
        let steps = (LARGEST as f64 / size.max_element()).log2().floor().exp2();
        Self { steps, size }
    }

    pub(super) fn point(&self, px: DVec2) -> Point {
        (px * self.steps).round().as_i64vec2()
    }

    pub(super) fn px(&self, steps: DVec2) -> DVec2 {
        steps / self.steps
    }

    /// Twice an area in steps, as pixels.
    pub(super) fn area_px(&self, twice: i128) -> f64 {
        twice as f64 / (2.0 * self.steps * self.steps)
    }

    /// The part of a segment inside the picture, given in pixels; `None` where none is.
    pub(super) fn segment(&self, [from, to]: [DVec2; 2]) -> Option<Segment> {
        if !(from.is_finite() && to.is_finite()) {
            return None;
        }
        let along = to - from;
        let range = between([0.0, 1.0], from.x, along.x, [0.0, self.size.x])?;
        let [first, last] = between(range, from.y, along.y, [0.0, self.size.y])?;
        let at = |place: f64, end: DVec2, is_end: bool| {
            let px = if is_end { end } else { from + along * place };
            self.point(px.clamp(DVec2::ZERO, self.size))
        };
        Some(ordered(at(first, from, first == 0.0), at(last, to, last == 1.0)))
    }

    /// The picture's four sides.
    pub(super) fn frame(&self) -> [Segment; 4] {
        let far = self.point(self.size);
        let corners = [Point::ZERO, Point::new(far.x, 0), far, Point::new(0, far.y)];
        [0, 1, 2, 3].map(|side| ordered(corners[side], corners[(side + 1) % 4]))
    }
}
