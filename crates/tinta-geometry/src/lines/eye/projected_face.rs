//! Faces' images in the picture: by one product each, how far inside of each side a pixel is, and the key of the face's plane there.

use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::tolerances::IMAGE_ROUNDING;
use glam::DVec2;

/// A face's image. Meaningless for faces that reach through the near plane.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct ProjectedFace {
    /// Each side's unit vector inwards, and its product with points on the side. Side `k` goes from corner `k` to the next.
    inwards: [DVec2; 3],
    starts_px: [f64; 3],
    /// The sides' lengths. A side without length has no direction.
    pub lengths_px: [f64; 3],
    /// The largest rounding error of a distance.
    pub rounding_px: f64,
    /// The plane's key at the picture's corner, and its gradient. Not finite for a face without area.
    key: f64,
    growth: DVec2,
}

impl ProjectedFace {
    pub(in crate::lines) fn of(space: &Space, faces: &Faces, place: u32) -> Self {
        Self::of_corners(space, faces.corners(place).map(|corner| space.project(corner)))
    }

    /// Returns the image of a face from the pixels and keys of its corners.
    pub(in crate::lines) fn of_corners(space: &Space, corners: [(DVec2, f64); 3]) -> Self {
        let (points, [key_a, key_b, key_c]) = (corners.map(|(px, _)| px), corners.map(|(_, key)| key));
        let (u, v) = (points[1] - points[0], points[2] - points[0]);
        let area = u.perp_dot(v);
        let reach = points.iter().map(|px| px.abs().max_element()).fold(space.size.max_element(), f64::max);
        let sides = [0, 1, 2].map(|side| points[(side + 1) % 3] - points[side]);
        let lengths_px = sides.map(DVec2::length);
        let inwards = [0, 1, 2].map(|side| sides[side].perp() * (area.signum() / lengths_px[side]));
        let starts_px = [0, 1, 2].map(|side| inwards[side].dot(points[side]));
        let (to_b, to_c) = (key_b - key_a, key_c - key_a);
        let growth = DVec2::new(to_b * v.y - to_c * u.y, to_c * u.x - to_b * v.x) / area;
        Self {
            inwards,
            starts_px,
            lengths_px,
            rounding_px: reach * IMAGE_ROUNDING,
            key: key_a - growth.dot(points[0]),
            growth,
        }
    }

    /// Each side's unit vector inwards, and its product with a pixel on the side.
    pub(in crate::lines) fn sides(&self) -> impl Iterator<Item = (DVec2, f64)> {
        self.inwards.into_iter().zip(self.starts_px)
    }

    /// How far inside of a side a pixel is.
    pub(in crate::lines) fn inside(&self, side: usize, px: DVec2) -> f64 {
        self.inwards[side].dot(px) - self.starts_px[side]
    }

    /// The key of the face's plane at a pixel.
    pub(in crate::lines) fn key(&self, px: DVec2) -> f64 {
        self.key + self.growth.dot(px)
    }

    /// How the key grows along the picture's axes, for each pixel.
    pub(in crate::lines) fn growth(&self) -> DVec2 {
        self.growth
    }
}
