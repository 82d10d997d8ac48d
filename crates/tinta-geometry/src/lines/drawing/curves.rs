//! Fits cubic Bézier curves to polylines within a given error.
//!
//! Input: a [`LinePath`] and the largest error in pixels. Output: [`Step`]s from its first point. The path is cut at
//! its corners, which stay. Between two corners a smooth curve of cubics passes through the points (Bessel tangents).
//! From each point one cubic by kurbo follows it as far as it can: kurbo's best fit of a whole path never ends for some
//! noisy paths. Each cubic is compared with the polyline, in both
//! directions; one that is too far away ends earlier, and two points give a straight line. The error bound therefore
//! holds whatever the fit does, and straight lines stay straight.

use crate::lines::drawing::chain::LinePath;
use crate::lines::drawing::simplify::simplified;
use crate::tolerances::STRAIGHT_PX;
use glam::DVec2;
use kurbo::simplify::SimplifyBezPath;
use kurbo::{BezPath, CubicBez, ParamCurve, Point, fit_to_cubic};

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// A straight line to a point, pixels.
    Line(DVec2),
    /// A cubic Bézier curve: two control points and its end, pixels.
    Curve([DVec2; 3]),
}

/// Smallest and largest error of a fit, pixels. Below the smallest, coordinates with three decimals are too coarse.
pub(in crate::lines) const FIT_PX: std::ops::RangeInclusive<f64> = 0.01..=100.0;

/// Cosine of the least angle at a corner, 35 degrees; smaller turns become curves if these are close enough.
const CORNER_COSINE: f64 = 0.819;

/// Most segments that one curve follows.
const MOST_SEGMENTS: usize = 200;

/// Samples of each curve, for each segment that it follows, that are compared with the polyline.
const SAMPLES: usize = 12;

/// Part of the error reserved for rounding to three decimals and for omitted points on straight lines.
const RESERVED_PX: f64 = 2.0 * STRAIGHT_PX;

/// Share of the error that the fit may use by its own estimate.
const ESTIMATED: f64 = 0.7;

/// Returns a path's first point and curves at most `error_px` from it; a closed path returns to that point.
pub fn fitted(path: &LinePath, error_px: f64) -> (DVec2, Vec<Step>) {
    let mut points = simplified(&path.points_px, path.is_closed);
    points.dedup();
    let Some(first) = points.first().copied() else { return (DVec2::ZERO, Vec::new()) };
    if points.len() == 1 && !path.is_closed {
        return (first, vec![Step::Line(first)]);
    }
    if points.len() < 3 {
        return (first, points[1..].iter().map(|point| Step::Line(*point)).collect());
    }
    let tolerance = (error_px - RESERVED_PX).max(0.0);
    let corner = |points: &[DVec2], at: usize| {
        let count = points.len();
        let (before, after) = (points[(at + count - 1) % count], points[(at + 1) % count]);
        let [into, out] = [points[at] - before, after - points[at]].map(DVec2::normalize_or_zero);
        into.dot(out) < CORNER_COSINE
    };
    let mut is_smooth_ring = false;
    if path.is_closed {
        // A closed path begins at a corner, or is a ring without one.
        let begin = (0..points.len()).find(|at| corner(&points, *at));
        is_smooth_ring = begin.is_none();
        points.rotate_left(begin.unwrap_or(0));
        points.push(points[0]);
    }
    let inner = (1..points.len() - 1).filter(|at| corner(&points, *at));
    let cuts: Vec<usize> = [0].into_iter().chain(inner).chain([points.len() - 1]).collect();
    let mut steps = Vec::new();
    for cut in cuts.windows(2) {
        let run = &points[cut[0]..=cut[1]];
        fit(run, &tangents(run, is_smooth_ring), tolerance, &mut steps);
    }
    (points[0], steps)
}

/// The tangents of a smooth curve at its points, per unit of length (Bessel).
fn tangents(points: &[DVec2], is_ring: bool) -> Vec<DVec2> {
    let last = points.len() - 1;
    let slope = |from: usize| (points[from + 1] - points[from]) / points[from].distance(points[from + 1]);
    let length = |from: usize| points[from].distance(points[from + 1]);
    let between = |before: usize, after: usize| {
        let (h, k) = (length(before), length(after));
        (slope(before) * k + slope(after) * h) / (h + k)
    };
    let mut tangents: Vec<DVec2> = (1..last).map(|at| between(at - 1, at)).collect();
    let [start, end] = if is_ring {
        [between(last - 1, 0); 2]
    } else if last > 1 {
        // A parabola through the first three points, and through the last three.
        [slope(0) * 2.0 - tangents[0], slope(last - 1) * 2.0 - tangents[last - 2]]
    } else {
        [slope(0); 2]
    };
    tangents.insert(0, start);
    tangents.push(end);
    tangents.into_iter().map(DVec2::normalize_or_zero).collect()
}

/// Adds the steps of a stretch without corners, each as long as one curve stays close enough.
fn fit(points: &[DVec2], tangents: &[DVec2], tolerance: f64, steps: &mut Vec<Step>) {
    let last = points.len() - 1;
    let mut smooth = BezPath::new();
    smooth.move_to(point(points[0]));
    for at in 1..=last {
        let third = points[at - 1].distance(points[at]) / 3.0;
        let controls = [points[at - 1] + tangents[at - 1] * third, points[at] - tangents[at] * third];
        smooth.curve_to(point(controls[0]), point(controls[1]), point(points[at]));
    }
    let smooth = SimplifyBezPath::new(smooth);
    let curve = |from: usize, to: usize| {
        let range = from as f64 / last as f64..to as f64 / last as f64;
        let (found, _) = fit_to_cubic(&smooth, range, tolerance * ESTIMATED).filter(|_| from + 1 < to)?;
        // The exact ends, so that adjacent curves meet.
        let curve = CubicBez { p0: point(points[from]), p3: point(points[to]), ..found };
        is_near(&curve, &points[from..=to], tolerance).then_some(curve)
    };
    let mut from = 0;
    while from < last {
        // Of ends twice as far each the farthest that one curve reaches, then between it and the next.
        let farthest = last.min(from + MOST_SEGMENTS);
        let ends: Vec<usize> =
            (1..).map(|power| from + (1 << power)).take_while(|to| *to < farthest).chain([farthest]).collect();
        let reached = ends.iter().enumerate().rev().find_map(|(at, to)| Some((at, *to, curve(from, *to)?)));
        let (mut good, mut best) = reached.map_or((from + 1, None), |(_, to, found)| (to, Some(found)));
        let mut bad = reached.map_or(ends[0], |(at, ..)| ends.get(at + 1).copied().unwrap_or(good + 1));
        while good + 1 < bad {
            let to = usize::midpoint(good, bad);
            match curve(from, to) {
                Some(found) => (good, best) = (to, Some(found)),
                None => bad = to,
            }
        }
        let step = |CubicBez { p1, p2, p3, .. }| Step::Curve([p1, p2, p3].map(vector));
        steps.push(best.map_or(Step::Line(points[good]), step));
        from = good;
    }
}

/// Whether a curve and a polyline stay within the tolerance of each other.
fn is_near(curve: &CubicBez, points: &[DVec2], tolerance: f64) -> bool {
    let samples = SAMPLES * (points.len() - 1);
    let drawn: Vec<DVec2> = (0..=samples).map(|sample| vector(curve.eval(sample as f64 / samples as f64))).collect();
    all_near(&drawn, points, tolerance) && all_near(points, &drawn, tolerance)
}

/// Whether all points of one polyline, and the midpoints between them, are close to another.
fn all_near(points: &[DVec2], line: &[DVec2], tolerance: f64) -> bool {
    let middles = points.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5);
    points.iter().copied().chain(middles).all(|point| {
        let square = line.windows(2).map(|ends| square_to(point, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min);
        square <= tolerance * tolerance
    })
}

/// The squared distance of a point from a line.
fn square_to(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let share = if square > 0.0 { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    point.distance_squared(a + along * share)
}

fn point(DVec2 { x, y }: DVec2) -> Point {
    Point::new(x, y)
}

fn vector(Point { x, y }: Point) -> DVec2 {
    DVec2::new(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use std::f64::consts::TAU;

    fn path(points_px: Vec<DVec2>, is_closed: bool) -> LinePath {
        let (class, segments) = (Class::Silhouette, Vec::new());
        LinePath { class, is_visible: true, is_outline: false, object: 0, look: 0, points_px, is_closed, segments }
    }

    /// Dense points along the drawn path.
    fn drawn((first, steps): &(DVec2, Vec<Step>)) -> Vec<DVec2> {
        let mut points = vec![*first];
        for step in steps {
            let from = points[points.len() - 1];
            match step {
                Step::Line(to) => points.extend((1..=400).map(|k| from.lerp(*to, f64::from(k) / 400.0))),
                Step::Curve([first, second, end]) => {
                    let curve = CubicBez::new(point(from), point(*first), point(*second), point(*end));
                    points.extend((1..=400).map(|k| vector(curve.eval(f64::from(k) / 400.0))));
                }
            }
        }
        points
    }

    fn farthest(points: &[DVec2], line: &[DVec2]) -> f64 {
        let square =
            |point: &DVec2| line.windows(2).map(|ends| square_to(*point, [ends[0], ends[1]])).fold(f64::MAX, f64::min);
        points.iter().map(square).fold(0.0, f64::max).sqrt()
    }

    #[track_caller]
    fn assert_within(points: &[DVec2], is_closed: bool, error_px: f64) -> Vec<Step> {
        let fit = fitted(&path(points.to_vec(), is_closed), error_px);
        let mut line = points.to_vec();
        if is_closed {
            line.push(points[0]);
        }
        let curve = drawn(&fit);
        let (there, back) = (farthest(&curve, &line), farthest(&line, &curve));
        assert!(there <= error_px && back <= error_px, "{there} {back} of {error_px} px, {} steps", fit.1.len());
        fit.1
    }

    #[test]
    fn a_circle_of_many_points_is_a_few_curves_within_the_error() {
        let circle: Vec<DVec2> =
            (0..180).map(|k| DVec2::from_angle(f64::from(k) / 180.0 * TAU) * 100.0 + 256.0).collect();
        for (error_px, most) in [(0.5, 8), (0.1, 12), (0.05, 16)] {
            let steps = assert_within(&circle, true, error_px);
            assert!(steps.len() <= most, "{} steps at {error_px}", steps.len());
            assert!(steps.iter().all(|step| matches!(step, Step::Curve(_))));
        }
    }

    #[test]
    fn straight_lines_stay_and_so_do_corners() {
        let corners = [[10.0, 10.0], [200.0, 10.0], [200.0, 90.0], [10.0, 90.0]].map(DVec2::from_array);
        assert_eq!(
            fitted(&path(corners.to_vec(), false), 1.0).1,
            corners[1..].iter().map(|to| Step::Line(*to)).collect::<Vec<_>>()
        );
        assert_eq!(fitted(&path(corners.to_vec(), true), 1.0).1.len(), 4);
        let line: Vec<DVec2> = (0..50).map(|k| DVec2::new(3.0, 1.0) * f64::from(k)).collect();
        assert_eq!(fitted(&path(line.clone(), false), 1.0), (line[0], vec![Step::Line(line[49])]));
        // An arc between two corners.
        let arc =
            (0..=40).map(|k| DVec2::new(100.0, 100.0) + DVec2::from_angle(f64::from(k) / 40.0 * TAU / 2.0) * 60.0);
        let half_disc: Vec<DVec2> = arc.collect();
        let steps = assert_within(&half_disc, true, 0.2);
        assert!(steps.contains(&Step::Line(half_disc[0])), "{steps:?}");
    }

    #[test]
    fn noise_walks_and_spirals_stay_within_the_error() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
        };
        let noisy: Vec<DVec2> = (0..300)
            .map(|k| DVec2::new(f64::from(k), 40.0 + 10.0 * (f64::from(k) / 30.0).sin() + 0.3 * random()))
            .collect();
        let spiral: Vec<DVec2> =
            (0..400).map(|k| DVec2::from_angle(f64::from(k) * 0.1) * f64::from(k) * 0.5 + 256.0).collect();
        let coarse: Vec<DVec2> =
            (0..12).map(|k| DVec2::from_angle(f64::from(k) / 12.0 * TAU) * 200.0 + 256.0).collect();
        let (mut at, mut angle) = (DVec2::ZERO, 0.0);
        let mut step = |_| {
            angle += random() * 0.6;
            at += DVec2::from_angle(angle) * (0.5 + 0.5 * random());
            at
        };
        let walk: Vec<DVec2> = (0..300).map(&mut step).collect();
        for error_px in [0.02, 0.1, 0.5, 2.0] {
            assert_within(&walk, false, error_px);
            assert_within(&noisy, false, error_px);
            assert_within(&spiral, false, error_px);
            assert_within(&coarse, true, error_px);
        }
    }

    #[test]
    fn what_is_hardly_a_path_is_still_one() {
        for points in [vec![DVec2::ZERO], vec![DVec2::ZERO, DVec2::X], vec![DVec2::ZERO, DVec2::X, DVec2::ZERO]] {
            for is_closed in [false, true] {
                let (_, steps) = fitted(&path(points.clone(), is_closed), 0.5);
                assert!(steps.len() <= 3 && drawn(&(points[0], steps)).iter().all(|point| point.is_finite()));
            }
        }
    }
}
