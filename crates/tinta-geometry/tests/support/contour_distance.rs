//! The distance between drawn lines and a true contour, pixels. Tests of the library and its benchmarks include this file.

use glam::DVec2;

/// Distance between compared points of lines, pixels.
const STEP_PX: f64 = 0.25;

/// The distance between drawn lines and a true contour, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContourDistance {
    /// The largest distance of a point of the true contour from all drawn lines.
    pub missed_px: f64,
    /// The largest distance of a point of a drawn line from the true contour.
    pub invented_px: f64,
    /// Mean distance of the drawn lines from the true contour, weighted by length.
    pub mean_px: f64,
}

impl ContourDistance {
    /// The Hausdorff distance: the larger of the two.
    pub(crate) fn hausdorff_px(&self) -> f64 {
        self.missed_px.max(self.invented_px)
    }
}

/// Returns the distance between drawn lines and a true contour. If either is empty, the other is infinitely far from it.
pub(crate) fn distance(drawn: &[[DVec2; 2]], truth: &[Vec<DVec2>]) -> ContourDistance {
    let pieces = |line: &Vec<DVec2>| line.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>();
    let truth: Vec<[DVec2; 2]> = truth.iter().flat_map(pieces).collect();
    let (missed_px, _) = farthest(&truth, drawn);
    let (invented_px, mean_px) = farthest(drawn, &truth);
    ContourDistance { missed_px, invented_px, mean_px }
}

/// The largest and the mean distance of some lines' points from other lines.
fn farthest(from: &[[DVec2; 2]], to: &[[DVec2; 2]]) -> (f64, f64) {
    let (mut largest, mut sum, mut length) = (0.0f64, 0.0, 0.0);
    for [a, b] in from {
        let steps = (a.distance(*b) / STEP_PX).ceil().max(1.0);
        for step in 0..=steps as usize {
            let point = a.lerp(*b, step as f64 / steps);
            let nearest = to.iter().map(|ends| square_to(point, *ends)).fold(f64::INFINITY, f64::min).sqrt();
            largest = largest.max(nearest);
            sum += nearest * a.distance(*b) / (steps + 1.0);
        }
        length += a.distance(*b);
    }
    (largest, if length > 0.0 { sum / length } else { 0.0 })
}

/// The squared distance of a point from a line.
fn square_to(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let share = if square > 0.0 { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    point.distance_squared(a + along * share)
}
