//! How the exact lines are best laid over a drawing of theirs: a small shift, a little larger or smaller, mirrored or upside down.
//!
//! Other programs put a model's middle elsewhere by a pixel, and count rows from below. Anything more is an error of the drawing or of
//! the camera, and stays one.

use super::distances::Distances;
use crate::compare::InkMask;
use crate::measure::{INK_FROM, Ink, Reference};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::fmt::{Display, Formatter};
use tinta::scene::Size;

/// Farthest shift, as a share of the picture's diagonal.
pub(crate) const LARGEST_SHIFT: f64 = 0.05;

/// Most that the lines are made larger or smaller.
pub(crate) const LARGEST_SCALE: f64 = 1.1;

/// A place beyond this share of the diagonal is as far as any: where lines lack, they must not pull.
const FARTHEST: f64 = 0.03;

/// How much nearer a mirrored drawing's lines must be to count, as a share: symmetric models are their own mirror image.
const MIRROR_GAIN: f64 = 0.8;

/// Number of points of lines and of ink tested, first for every start, then for the best of each mirroring.
const POINTS: [usize; 2] = [300, 2000];

/// The smallest step, pixels.
const LEAST_STEP_PX: f64 = 0.01;

/// The transformation from the exact lines' picture to the drawing, around the picture's middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// How much larger the drawing is.
    pub scale: f64,
    /// How far it is shifted to the right and down, pixels, once it is scaled.
    pub shift_px: [f64; 2],
    /// Whether left and right are exchanged.
    pub is_mirrored: bool,
    /// Whether top and bottom are exchanged.
    pub is_upside_down: bool,
    middle_px: [f64; 2],
}

impl Fit {
    /// The best one within the limits, by the mean distance between lines and ink both ways.
    pub(crate) fn of(ink: &Ink, reference: &Reference) -> Self {
        let lines: Vec<DVec2> = reference.samples.iter().map(|sample| sample.px).collect();
        let inked: Vec<DVec2> = ink.pixels(INK_FROM).map(|(_, middle)| middle).collect();
        let still = Self::new(ink.size, [false; 2]);
        if lines.is_empty() || inked.is_empty() {
            return still;
        }
        let distances = [&lines, &inked].map(|points| {
            Distances::to(&InkMask::of_points(ink.size, points.iter().copied()), FARTHEST * diagonal(ink.size))
        });
        let points = |count: usize| Points {
            lines: some(&lines, count),
            ink: some(&inked, count),
            to_line: &distances[0],
            to_ink: &distances[1],
        };
        let [few, many] = POINTS.map(points);
        let mut best: Option<(f64, Self)> = None;
        for mirrors in [[false, false], [true, false], [false, true], [true, true]] {
            let start = Self::new(ink.size, mirrors);
            let starts = [start, start.onto(&lines, &inked, ink.size)];
            let found = starts.map(|start| few.improved(start, ink.size));
            let found = found.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(start, |(_, fit)| fit);
            let (cost, fit) = many.improved(found, ink.size);
            if best.is_none_or(|(least, _)| cost < least * MIRROR_GAIN) {
                best = Some((cost, fit));
            }
        }
        best.map_or(still, |(_, fit)| fit)
    }

    /// Where a place of the exact lines' picture lies in the drawing, pixels from the upper left corner.
    pub(crate) fn apply(&self, px: DVec2) -> DVec2 {
        let middle = DVec2::from_array(self.middle_px);
        middle + (px - middle) * self.mirrors() * self.scale + DVec2::from_array(self.shift_px)
    }

    fn new(size: Size, [is_mirrored, is_upside_down]: [bool; 2]) -> Self {
        let middle_px = [f64::from(size.width) * 0.5, f64::from(size.height) * 0.5];
        Self { scale: 1.0, shift_px: [0.0; 2], is_mirrored, is_upside_down, middle_px }
    }

    fn mirrors(&self) -> DVec2 {
        let sign = |is_exchanged: bool| if is_exchanged { -1.0 } else { 1.0 };
        DVec2::new(sign(self.is_mirrored), sign(self.is_upside_down))
    }

    /// Where a place of the drawing lies among the lines.
    fn undo(&self, px: DVec2) -> DVec2 {
        let middle = DVec2::from_array(self.middle_px);
        middle + (px - middle - DVec2::from_array(self.shift_px)) * self.mirrors() / self.scale
    }

    /// The same, moved to give the boxes around lines and ink one middle and one size, as far as the limits allow.
    fn onto(self, lines: &[DVec2], ink: &[DVec2], size: Size) -> Self {
        let bounds = |points: &mut dyn Iterator<Item = DVec2>| {
            points.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], px| [low.min(px), high.max(px)])
        };
        let [low, high] = bounds(&mut lines.iter().map(|px| self.apply(*px)));
        let [ink_low, ink_high] = bounds(&mut ink.iter().copied());
        let scale = (ink_high - ink_low).length() / (high - low).length().max(1e-9);
        let middle = DVec2::from_array(self.middle_px);
        let scaled = Self { scale, ..self }.within(size);
        let shift = (ink_low + ink_high) * 0.5 - (middle + ((low + high) * 0.5 - middle) * scaled.scale);
        Self { shift_px: shift.to_array(), ..scaled }.within(size)
    }

    /// The nearest one that is allowed.
    fn within(self, size: Size) -> Self {
        let farthest = LARGEST_SHIFT * diagonal(size);
        Self {
            scale: self.scale.clamp(1.0 / LARGEST_SCALE, LARGEST_SCALE),
            shift_px: DVec2::from_array(self.shift_px).clamp_length_max(farthest).to_array(),
            ..self
        }
    }
}

impl Display for Fit {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let mirrored = match (self.is_mirrored, self.is_upside_down) {
            (false, false) => "",
            (true, false) => "left and right exchanged, ",
            (false, true) => "top and bottom exchanged, ",
            (true, true) => "turned by half, ",
        };
        let [right, down] = self.shift_px;
        write!(f, "{mirrored}moved {right:.2} px to the right and {down:.2} px down, {:.4} times as large", self.scale)
    }
}

fn diagonal(size: Size) -> f64 {
    f64::from(size.width).hypot(f64::from(size.height))
}

/// At most so many of the points, evenly chosen.
fn some(points: &[DVec2], count: usize) -> Vec<DVec2> {
    let step = points.len().div_ceil(count).max(1);
    points.iter().copied().step_by(step).collect()
}

/// The points between which distances are taken.
struct Points<'a> {
    lines: Vec<DVec2>,
    ink: Vec<DVec2>,
    to_line: &'a Distances,
    to_ink: &'a Distances,
}

impl Points<'_> {
    /// Mean distance, both ways together, pixels of the drawing.
    fn cost(&self, fit: &Fit) -> f64 {
        let to_ink = self.lines.iter().map(|px| self.to_ink.at(fit.apply(*px))).sum::<f64>();
        let to_line = self.ink.iter().map(|px| self.to_line.at(fit.undo(*px)) * fit.scale).sum::<f64>();
        to_ink / self.lines.len() as f64 + to_line / self.ink.len() as f64
    }

    /// The best near a start, by ever smaller steps to the sides and in size.
    fn improved(&self, start: Fit, size: Size) -> (f64, Fit) {
        let half = diagonal(size) * 0.5;
        let (mut best, mut fit) = (self.cost(&start), start);
        let mut step_px = LARGEST_SHIFT * half;
        while step_px >= LEAST_STEP_PX {
            let moves = [
                [1.0, 0.0, 0.0],
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
                [0.0, 0.0, 1.0],
                [0.0, 0.0, -1.0],
            ];
            let mut is_better = false;
            for [right, down, larger] in moves {
                let [x, y] = fit.shift_px;
                let shift_px = [x + right * step_px, y + down * step_px];
                let other = Fit { shift_px, scale: fit.scale + larger * step_px / half, ..fit }.within(size);
                let cost = self.cost(&other);
                if cost < best {
                    (best, fit, is_better) = (cost, other, true);
                }
            }
            if !is_better {
                step_px *= 0.5;
            }
        }
        (best, fit)
    }
}
