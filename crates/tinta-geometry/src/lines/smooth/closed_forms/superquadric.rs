//! A superquadric: the sum of the coordinates, each divided by its half axis and raised to an even power, is 1. It is
//! convex, so its contour is one closed curve and fully visible.

use super::curve::{Curve, HALVINGS};
use crate::edges::Eye;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A point of the superquadric with half axes of 1, in a direction.
pub(super) fn unit_point(direction: DVec3, power: u32) -> DVec3 {
    let power = power as i32;
    let sum: f64 = direction.to_array().iter().map(|number| number.powi(power)).sum();
    direction * sum.powf(-1.0 / f64::from(power))
}

/// The contour: because the surface is convex, it turns away at exactly one angle in each direction around the line
/// to the eye.
pub(super) fn contour(half_axes: DVec3, power: u32, eye: Eye) -> Curve {
    // With half axes of 1, the normal is each coordinate to the power minus one, and its product with the point is 1.
    let (eye, least) = match eye {
        Eye::Point(eye) => (eye / half_axes, 1.0),
        Eye::Direction(direction) => (direction / half_axes, 0.0),
    };
    let axis = eye.normalize();
    let (first, second) = axis.any_orthonormal_pair();
    Box::new(move |place: f64| {
        let (sine, cosine) = (place * TAU).sin_cos();
        let aside = first * cosine + second * sine;
        let point = |angle: f64| unit_point(axis * angle.cos() + aside * angle.sin(), power);
        let (mut front, mut back) = (0.0, PI);
        for _ in 0..HALVINGS {
            let middle = (front + back) * 0.5;
            let at = point(middle);
            let normal = DVec3::from_array(at.to_array().map(|number| number.powi(power as i32 - 1)));
            if normal.dot(eye) > least { front = middle } else { back = middle }
        }
        point((front + back) * 0.5) * half_axes
    })
}
