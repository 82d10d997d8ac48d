//! Where in the picture a ray may come into a shell through a hole: a coarse grid over the holes' caps.

use super::Sight;
use crate::threads::filled;
use glam::{DVec2, DVec3, Vec3};

/// Cells of the grid's side.
const SIDE: usize = 64;

/// What f32 may be off by in a point's place in the picture, as a share of its distance from the eye.
const NOISE: f64 = 1e-6;

/// The part of the picture plane that caps cover which may show their fronts.
pub(super) struct Openings {
    low: DVec2,
    cells_per_unit: DVec2,
    rows: [u64; SIDE],
    is_empty: bool,
}

/// A rectangle of the picture plane: what lies before the eye at a distance of 1, or in parallel projection around it.
#[derive(Debug, Clone, Copy)]
struct Rectangle {
    low: DVec2,
    high: DVec2,
}

impl Openings {
    /// Of caps, each by its corners; GL may move what it draws by `margin`.
    pub(super) fn new(sight: &Sight, caps: impl Iterator<Item = [Vec3; 3]>, margin: f64) -> Self {
        let around = |cap: [Vec3; 3]| Rectangle::around(sight, cap.iter().map(|corner| corner.as_dvec3()), margin);
        let rectangles: Vec<Rectangle> = caps.map(around).collect();
        let low = rectangles.iter().fold(DVec2::INFINITY, |low, rectangle| low.min(rectangle.low));
        let high = rectangles.iter().fold(DVec2::NEG_INFINITY, |high, rectangle| high.max(rectangle.high));
        let cells_per_unit = DVec2::splat(SIDE as f64) / (high - low);
        let mut openings = Self { low, cells_per_unit, rows: [0; SIDE], is_empty: rectangles.is_empty() };
        for rectangle in &rectangles {
            if let Some((rows, columns)) = openings.cells(rectangle) {
                openings.rows[rows].iter_mut().for_each(|row| *row |= columns);
            }
        }
        openings
    }

    /// Whether each box may be seen through a hole; no list where there is none.
    pub(super) fn boxes_that_may_show(&self, sight: &Sight, boxes: &[[Vec3; 2]], threads: usize) -> Vec<bool> {
        let may_show = |number: usize| {
            let rectangle = Rectangle::around_box(sight, boxes[number].map(|corner| corner.as_dvec3()));
            self.cells(&rectangle).is_some_and(|(rows, columns)| self.rows[rows].iter().any(|row| row & columns != 0))
        };
        filled(if self.is_empty { 0 } else { boxes.len() }, threads, false, may_show)
    }

    /// The grid's rows and, as bits, columns that a rectangle touches; all of them for one that is none.
    fn cells(&self, rectangle: &Rectangle) -> Option<(std::ops::RangeInclusive<usize>, u64)> {
        let [low, high] = [rectangle.low, rectangle.high].map(|corner| (corner - self.low) * self.cells_per_unit);
        if !(low.is_finite() && high.is_finite()) {
            return Some((0..=SIDE - 1, u64::MAX));
        }
        let last = (SIDE - 1) as f64;
        if low.max_element() > SIDE as f64 || high.min_element() < 0.0 {
            return None;
        }
        let [low, high] = [low, high].map(|corner| corner.clamp(DVec2::ZERO, DVec2::splat(last)).as_u64vec2());
        let columns = (u64::MAX << low.x) & (u64::MAX >> (SIDE as u64 - 1 - high.x));
        Some((low.y as usize..=high.y as usize, columns))
    }
}

impl Rectangle {
    fn around(sight: &Sight, points: impl Iterator<Item = DVec3>, margin: f64) -> Self {
        let (low, high) = points.map(|point| sight.on_picture_plane(point)).fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            // A point at the eye's height has no place there, and makes a rectangle that is none.
            |(low, high), place| if place.is_finite() { (low.min(place), high.max(place)) } else { (place, place) },
        );
        let margin = margin + NOISE * (1.0 + low.abs().max(high.abs()).max_element());
        Self { low: low - margin, high: high + margin }
    }

    /// One around all that a box may cover, a little larger than it need be.
    fn around_box(sight: &Sight, [low, high]: [DVec3; 2]) -> Self {
        let (middle, half) = ((low + high) * 0.5 - sight.eye, (high - low) * 0.5);
        let [x, y, z] = sight.axes.map(|axis| [axis.dot(middle), axis.abs().dot(half)]);
        let corner = DVec2::new(x[0], y[0]);
        let (low, high) = (corner - DVec2::new(x[1], y[1]), corner + DVec2::new(x[1], y[1]));
        if sight.is_parallel {
            return Self { low, high };
        }
        // A place is farther out the nearer it is to the eye.
        let (nearest, farthest) = (-z[0] - z[1], -z[0] + z[1]);
        if nearest <= 0.0 {
            return Self { low: DVec2::NAN, high: DVec2::NAN };
        }
        let by_depth = |place: DVec2, outer: DVec2, inner: DVec2| DVec2::select(place.cmplt(DVec2::ZERO), outer, inner);
        let (near, far) = (place_of(nearest), place_of(farthest));
        Self { low: low * by_depth(low, near, far), high: high * by_depth(high, far, near) }
    }
}

fn place_of(depth: f64) -> DVec2 {
    DVec2::splat(1.0 / depth)
}
