//! Whether a polygon's sides cross each other: earcut takes the square of the corners' number or more where they do.
//!
//! The sides are laid into a grid whose cells are twice as wide as a side is long, and compared within each cell. A polygon with
//! hundreds of sides a cell takes earcut as long, and counts as crossing itself.

use glam::DVec2;
use robust::{Coord, orient2d};

/// Width of a cell in mean lengths of sides.
const CELL_WIDTH: f64 = 2.0;

/// Most cells that a side lies in, on average.
const CELLS_A_SIDE: usize = 8;

/// Most sides that a side is compared with, on average.
const PAIRS_A_SIDE: usize = 512;

/// Whether no two sides of a polygon cross. Sides may touch and lie on one another, as where a hole is joined to the rim.
pub fn is_simple(points: &[DVec2]) -> bool {
    let side = |index: u32| [points[index as usize], points[(index as usize + 1) % points.len()]];
    let low = points.iter().fold(DVec2::INFINITY, |low, point| low.min(*point));
    let length: f64 = (0..points.len() as u32).map(side).map(|[from, to]| from.distance(to)).sum();
    let scale = points.len() as f64 / (length * CELL_WIDTH).max(f64::MIN_POSITIVE);
    // A closed polygon is at least twice as long as it is wide, so that a quarter of its corners' number is enough cells.
    let cell = |coordinate: f64| coordinate as u32;

    let mut places: Vec<(u64, u32)> = Vec::new();
    for index in 0..points.len() as u32 {
        let [from, to] = side(index).map(|point| (point - low) * scale);
        let (lower, upper) = if from.y <= to.y { (from, to) } else { (to, from) };
        for row in cell(lower.y)..=cell(upper.y) {
            // Where the side enters the row and where it leaves it.
            let at = |y: f64| match upper.y - lower.y {
                0.0 => [lower.x, upper.x],
                height => [lower.x + (upper.x - lower.x) * ((y - lower.y) / height).clamp(0.0, 1.0); 2],
            };
            let ([a, b], [c, d]) = (at(f64::from(row)), at(f64::from(row) + 1.0));
            for column in cell(a.min(b).min(c).min(d))..=cell(a.max(b).max(c).max(d)) {
                places.push((u64::from(row) << 32 | u64::from(column), index));
            }
            if places.len() > points.len() * CELLS_A_SIDE {
                return false;
            }
        }
    }
    places.sort_unstable();
    let mut pairs = 0;
    for sides in places.chunk_by(|a, b| a.0 == b.0) {
        pairs += sides.len() * sides.len() / 2;
        if pairs > points.len() * PAIRS_A_SIDE {
            return false;
        }
        let crosses = |number: usize| {
            let one = side(sides[number].1);
            sides[..number].iter().any(|other| cross(one, side(other.1)))
        };
        if (0..sides.len()).any(crosses) {
            return false;
        }
    }
    true
}

/// Whether two sides cross in a point inside both.
fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let turn = |a: DVec2, b: DVec2, c: DVec2| {
        let [a, b, c] = [a, b, c].map(|point| Coord { x: point.x, y: point.y });
        orient2d(a, b, c)
    };
    a.min(b).cmple(c.max(d)).all()
        && c.min(d).cmple(a.max(b)).all()
        && turn(a, b, c) * turn(a, b, d) < 0.0
        && turn(c, d, a) * turn(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(count: u32, radius: impl Fn(u32) -> f64) -> Vec<DVec2> {
        let turn = |i: u32| f64::from(i) / f64::from(count) * std::f64::consts::TAU;
        (0..count).map(|i| DVec2::from_angle(turn(i)) * radius(i)).collect()
    }

    #[test]
    fn a_star_is_simple_until_two_of_its_corners_change_places() {
        let mut star = ring(3000, |i| 1.0 + f64::from(i % 2) * 0.1);
        assert!(is_simple(&star));
        for place in [0, 1000, 2997] {
            star.swap(place, place + 2);
            assert!(!is_simple(&star), "{place}");
            star.swap(place, place + 2);
        }
        star.reverse();
        assert!(is_simple(&star));
    }

    #[test]
    fn a_hole_joined_to_its_rim_is_simple_and_a_knot_is_not() {
        let mut keyhole = ring(1000, |_| 2.0);
        keyhole.push(DVec2::X * 2.0);
        keyhole.extend(ring(1000, |_| 1.0).into_iter().rev());
        keyhole.insert(1001, DVec2::X);
        assert!(is_simple(&keyhole));
        let knot: Vec<DVec2> = (0..2000u32)
            .map(|i| [2_654_435_761, 2_246_822_519].map(|factor: u32| f64::from(i.wrapping_mul(factor))))
            .map(DVec2::from_array)
            .collect();
        assert!(!is_simple(&knot));
    }

    #[test]
    fn polygons_without_extent_do_not_panic() {
        assert!(is_simple(&[DVec2::ZERO; 50]));
        is_simple(&(0..50).map(|i| DVec2::X * f64::from(i % 7)).collect::<Vec<_>>());
    }
}
