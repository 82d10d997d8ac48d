//! Whether a polygon's sides cross each other: earcut takes the square of the corners' number or more where they do.
//!
//! A line sweeps over the plane and keeps the sides it meets in order; the first crossing is between neighbours (Shamos and
//! Hoey, "Geometric Intersection Problems", 1976). It stops at the first crossing. Exact predicates decide the order, so sides
//! may touch and overlap. Time grows with n log n, whatever the polygon.

use glam::DVec2;
use robust::{Coord, orient2d};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::ops::Bound::{Excluded, Unbounded};

/// Whether no two sides of a polygon cross. Sides may touch and lie on one another, as where a hole is joined to the rim.
pub(super) fn is_simple(points: &[DVec2]) -> bool {
    let sides: Vec<Side> = (0..points.len()).filter_map(|index| Side::new(points, index)).collect();
    let begins = sides.iter().map(|side| (side.left, Event::Begin, side));
    let ends = sides.iter().map(|side| (side.right, Event::End, side));
    let mut events: Vec<(DVec2, Event, &Side)> = begins.chain(ends).collect();
    events.sort_unstable_by(|one, other| {
        by_place(one.0, other.0).then(one.1.cmp(&other.1)).then(one.2.number.cmp(&other.2.number))
    });

    let mut met: BTreeSet<&Side> = BTreeSet::new();
    for (_, event, side) in events {
        if event == Event::End {
            met.remove(side);
        }
        let below = met.range::<&Side, _>((Unbounded, Excluded(&side))).next_back();
        let above = met.range::<&Side, _>((Excluded(&side), Unbounded)).next();
        let is_crossed = match event {
            Event::Begin => [below, above].into_iter().flatten().any(|other| cross(side, other)),
            Event::End => below.zip(above).is_some_and(|(below, above)| cross(below, above)),
        };
        if is_crossed {
            return false;
        }
        if event == Event::Begin {
            met.insert(side);
        }
    }
    true
}

/// The line's events. Where sides end others begin after them: until then only those are kept that can still cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Event {
    End,
    Begin,
}

/// A side of some length, from left to right or, where it is upright, from below.
#[derive(Debug)]
struct Side {
    left: DVec2,
    right: DVec2,
    number: usize,
}

impl Side {
    fn new(points: &[DVec2], number: usize) -> Option<Self> {
        let (from, to) = (points[number], points[(number + 1) % points.len()]);
        match by_place(from, to) {
            Ordering::Less => Some(Self { left: from, right: to, number }),
            Ordering::Greater => Some(Self { left: to, right: from, number }),
            Ordering::Equal => None,
        }
    }

    /// Above 0 for a point left of the side, which is above it, and 0 for one in line with it.
    fn turn(&self, point: DVec2) -> f64 {
        turn(self.left, self.right, point)
    }
}

/// From the lower to the upper of two sides that one line meets and that do not cross before it.
impl Ord for Side {
    fn cmp(&self, other: &Self) -> Ordering {
        if by_place(other.left, self.left) == Ordering::Less {
            return other.cmp(self).reverse();
        }
        // The other begins here or further on: how it lies there, and if that is on this side, where it goes.
        let turn = match self.turn(other.left) {
            0.0 => self.turn(other.right),
            turn => turn,
        };
        // Overlapping sides may have any consistent order.
        0.0.partial_cmp(&turn).unwrap_or(Ordering::Equal).then(self.number.cmp(&other.number))
    }
}

impl PartialOrd for Side {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Side {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Side {}

/// Above 0 where `c` lies to the left of the way from `a` to `b`, 0 where it lies in line with it, below 0 to the right.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|point| Coord { x: point.x, y: point.y });
    orient2d(a, b, c)
}

/// The order in which the line reaches points: from left to right, and as if it leant a little, from below.
fn by_place(one: DVec2, other: DVec2) -> Ordering {
    // 0 and -0 are the same place.
    (one.x + 0.0).total_cmp(&(other.x + 0.0)).then((one.y + 0.0).total_cmp(&(other.y + 0.0)))
}

/// Whether two sides cross in a point inside both.
fn cross(one: &Side, other: &Side) -> bool {
    one.turn(other.left) * one.turn(other.right) < 0.0 && other.turn(one.left) * other.turn(one.right) < 0.0
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
    fn polygons_without_extent_do_not_cross_themselves() {
        assert!(is_simple(&[DVec2::ZERO; 50]));
        assert!(is_simple(&(0..50).map(|i| DVec2::X * f64::from(i % 7)).collect::<Vec<_>>()));
        assert!(is_simple(&(0..50).map(|i| DVec2::ONE * f64::from(i * i % 7)).collect::<Vec<_>>()));
    }

    #[test]
    fn long_teeth_and_stars_of_any_number_of_corners_are_simple_whichever_way_they_are_turned() {
        for count in [4, 64, 1028, 8000, 32_768, 100_001] {
            let tooth = |i: u32| f64::from(matches!(i % 4, 1 | 2)) - f64::from(i == 0 || i == count - 1);
            let comb: Vec<DVec2> = (0..count).map(|i| DVec2::new(f64::from(i) / f64::from(count), tooth(i))).collect();
            for (turn, star) in [(0.0, 1e-6), (0.7, 0.01), (1.5, 0.9)] {
                let turned = |points: &[DVec2]| -> Vec<DVec2> {
                    points.iter().map(|point| DVec2::from_angle(turn).rotate(*point)).collect()
                };
                assert!(is_simple(&turned(&comb)), "comb of {count} by {turn}");
                let star = ring(count, |i| if i % 2 == 1 && count % 2 == 0 { star } else { 1.0 });
                assert!(is_simple(&turned(&star)), "star of {count} by {turn}");
                let mut crossed = turned(&comb);
                let last = crossed.len() - 1;
                crossed.swap(last / 2, last / 2 + 2);
                assert_eq!(is_simple(&crossed), count < 6, "crossed comb of {count} by {turn}");
            }
        }
    }

    proptest::proptest! {
        #![proptest_config(proptest::test_runner::Config { cases: 20_000, failure_persistence: None, ..Default::default() })]

        /// On a small lattice nearly everything touches, overlaps or lies in line.
        #[test]
        fn the_sweep_finds_what_comparing_all_pairs_finds(
            corners in proptest::collection::vec((0i32..5, 0i32..4), 0..10),
            shear in 0i32..3,
        ) {
            let points: Vec<DVec2> =
                corners.iter().map(|(x, y)| DVec2::new(f64::from(x + shear * y), f64::from(*y))).collect();
            let sides: Vec<Side> = (0..points.len()).filter_map(|index| Side::new(&points, index)).collect();
            let all_pairs = sides.iter().enumerate().all(|(place, side)| sides[..place].iter().all(|other| !cross(side, other)));
            proptest::prop_assert_eq!(is_simple(&points), all_pairs);
        }
    }
}
