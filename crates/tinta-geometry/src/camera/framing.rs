//! The choice of the picture's centre.
//!
//! Input: points relative to a camera's first target, x right, y up, z towards the eye. Output: the shift of the
//! target.

use crate::tolerances::{FRAME_FILL, OUTLINE_FILL};
use glam::{DVec2, DVec3};

crate::choices! {
    /// The centre of the picture if neither eye nor target is given.
    #[derive(Default)]
    pub enum Framing {
        /// The middle of the scene's bounding box; it stays when the scene turns.
        #[default]
        Middle = "middle",
        /// The middle of the visible outline, which then fills the picture up to the margin.
        Outline = "outline",
    }
}

impl Framing {
    /// Filled share of the picture's half-width and half-height.
    pub(super) fn fill(self) -> f64 {
        match self {
            Self::Middle => FRAME_FILL,
            Self::Outline => OUTLINE_FILL,
        }
    }
}

/// The shift across the view that centres the points in a parallel projection.
pub(super) fn middle_of_parallel(points: impl Iterator<Item = DVec3>) -> DVec2 {
    let [low, high] = points.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], point| {
        [low.min(point.truncate()), high.max(point.truncate())]
    });
    low * 0.5 + high * 0.5
}

/// Like [`middle_of_parallel`], for a perspective projection with the eye as near as possible. The picture of the
/// points is centred in both directions and reaches the margin in one.
///
/// `tan_half` is the tangent of half the field of view, horizontally and vertically.
pub(super) fn middle_of_perspective(points: impl Iterator<Item = DVec3> + Clone, tan_half: DVec2) -> DVec2 {
    let tan_half = tan_half * OUTLINE_FILL;
    // The planes through the picture's sides touch the points. Only the position of each pair of planes is unknown.
    let none = [DVec2::NEG_INFINITY; 2];
    let [after, before] = points.clone().fold(none, |[after, before], point| {
        let (across, depth) = (point.truncate(), tan_half * point.z);
        [after.max(depth + across), before.max(depth - across)]
    });
    let distance = ((after + before) / (2.0 * tan_half)).max_element();
    DVec2::new(
        centred(points.clone().map(|point| (point.x, distance - point.z))),
        centred(points.map(|point| (point.y, distance - point.z))),
    )
}

/// Most steps of the search: each moves to another pair of outermost points, and few such pairs exist.
const STEPS: usize = 32;

/// The position of the eye from which both outermost points appear equally far out; points come with their depth from
/// the eye's plane.
fn centred(points: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let mut eye = 0.0;
    let mut bounds = [f64::NEG_INFINITY, f64::INFINITY];
    for _ in 0..STEPS {
        let none = [(f64::NEG_INFINITY, 0.0, 1.0); 2];
        let [right, left] = points.clone().fold(none, |[right, left], (at, depth)| {
            let outermost = |best: (f64, f64, f64), seen: f64| if seen > best.0 { (seen, at, depth) } else { best };
            [outermost(right, (at - eye) / depth), outermost(left, (eye - at) / depth)]
        });
        // Moving the eye to the right moves every point to the left.
        bounds = if right.0 > left.0 { [eye, bounds[1]] } else { [bounds[0], eye] };
        let mut next = (right.1 * left.2 + left.1 * right.2) / (right.2 + left.2);
        if !(bounds[0]..=bounds[1]).contains(&next) {
            next = bounds[0] * 0.5 + bounds[1] * 0.5;
        }
        if !next.is_finite() || next == eye {
            break;
        }
        eye = next;
    }
    eye
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_looked_at_straight_and_a_pair_from_its_middle() {
        assert_eq!(centred([(3.0, 5.0)].into_iter()), 3.0);
        assert_eq!(centred([(3.0, 5.0), (-1.0, 5.0)].into_iter()), 1.0);
        // The nearer point appears larger: (3 - e) / 1 = (e + 1) / 3.
        assert_eq!(centred([(3.0, 1.0), (-1.0, 3.0)].into_iter()), 2.0);
        assert_eq!(middle_of_parallel([DVec3::ZERO, DVec3::new(4.0, -2.0, 7.0)].into_iter()), DVec2::new(2.0, -1.0));
    }
}
