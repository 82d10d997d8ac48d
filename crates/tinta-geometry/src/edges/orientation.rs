//! Decides exactly which side of a face the eye sees.
//!
//! In perspective the side is the sign of Shewchuk's orient3d, from the `robust` crate. In parallel projection it is the sign
//! of the determinant of two sides of the face and the direction to the eye. That is computed here: first in f64 with an error
//! bound, then, if undecided, as an exact sum.

use glam::DVec3;
use robust::{Coord3D, orient3d};

/// A viewpoint, in the mesh's own coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Eye {
    /// Perspective: the eye's position.
    Point(DVec3),
    /// Parallel projection: the direction towards the eye, of any length but 0.
    Direction(DVec3),
}

/// The side of a face that an eye sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Its corners are counter-clockwise from this side.
    Front,
    /// The other side.
    Back,
    /// Neither: the eye lies in the face's plane, or the face has no area.
    Edge,
}

impl Side {
    fn of_sign(sign: f64) -> Self {
        match sign {
            sign if sign > 0.0 => Self::Front,
            sign if sign < 0.0 => Self::Back,
            _ => Self::Edge,
        }
    }
}

/// Returns the side of a face that the eye sees: the sign of its determinant in exact arithmetic.
///
/// Exact for all f64 whose products of three neither overflow nor underflow: magnitudes between 1e-70 and 1e70, and 0.
pub fn side_of_face(corners: [DVec3; 3], eye: Eye) -> Side {
    match eye {
        Eye::Point(eye) => {
            let [a, b, c, eye] = [corners[0], corners[1], corners[2], eye].map(|DVec3 { x, y, z }| Coord3D { x, y, z });
            // orient3d is positive below the plane, where the corners are clockwise.
            Side::of_sign(-orient3d(a, b, c, eye))
        }
        Eye::Direction(direction) => Side::of_sign(parallel_sign(corners, direction)),
    }
}

/// A number with the sign of (b - a) x (c - a) . direction.
fn parallel_sign([a, b, c]: [DVec3; 3], direction: DVec3) -> f64 {
    let (u, v) = (b - a, c - a);
    let determinant = direction.dot(u.cross(v));
    let products = |i: usize, j: usize| (u[i] * v[j]).abs() + (u[j] * v[i]).abs();
    let magnitude = direction.abs().dot(DVec3::new(products(1, 2), products(2, 0), products(0, 1)));
    // Seven roundings on the longest way from the coordinates to the determinant, each of half an epsilon at most.
    if determinant.abs() > magnitude * (8.0 * f64::EPSILON) {
        return determinant;
    }
    let mut sum = ExactSum { components: [0.0; MOST_COMPONENTS], count: 0 };
    for (p, q) in [(a, b), (b, c), (c, a)] {
        // Along an axis, where faces are most often seen edge-on, two thirds are products with 0.
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)].into_iter().filter(|(i, ..)| direction[*i] != 0.0) {
            sum.add_product(direction[i], p[j], q[k]);
            sum.add_product(-direction[i], p[k], q[j]);
        }
    }
    sum.largest()
}

/// A sum of f64 numbers without rounding: components that do not overlap, smallest first (Shewchuk 1997).
struct ExactSum {
    components: [f64; MOST_COMPONENTS],
    count: usize,
}

/// Eighteen products of three numbers make seventy-two numbers, and each adds at most one component.
const MOST_COMPONENTS: usize = 72;

impl ExactSum {
    /// Adds x y z.
    fn add_product(&mut self, x: f64, y: f64, z: f64) {
        let (high, low) = two_product(x, y);
        for part in [low, high] {
            let (high, low) = two_product(part, z);
            self.add(low);
            self.add(high);
        }
    }

    fn add(&mut self, number: f64) {
        let mut carried = number;
        let mut kept = 0;
        for index in 0..self.count {
            let (sum, rest) = two_sum(carried, self.components[index]);
            if rest != 0.0 {
                self.components[kept] = rest;
                kept += 1;
            }
            carried = sum;
        }
        if carried != 0.0 {
            self.components[kept] = carried;
            kept += 1;
        }
        self.count = kept;
    }

    /// The largest component, whose sign is the sum's; 0 for 0.
    fn largest(&self) -> f64 {
        if self.count > 0 { self.components[self.count - 1] } else { 0.0 }
    }
}

/// a b as a rounded product and what rounding took from it.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// a + b as a rounded sum and what rounding took from it (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}
