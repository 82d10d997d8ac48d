//! The squares that fill the picture: the values at their corners, and what they are drawn with.

use crate::plan::Geometry;
use crate::tolerances::BACKGROUND_DISTANCE;
use glam::{Mat4, Vec3, Vec4};

/// Position and normal of each corner: the background square, then the screen square at the near plane.
pub(super) const SQUARES: [[f32; 6]; 8] = [
    [-1.0, -1.0, 0.0, 0.0, 0.0, 1.0],
    [1.0, -1.0, 0.0, 0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [-1.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [-1.0, -1.0, -1.0, 0.0, 0.0, 1.0],
    [1.0, -1.0, -1.0, 0.0, 0.0, 1.0],
    [1.0, 1.0, -1.0, 0.0, 0.0, 1.0],
    [-1.0, 1.0, -1.0, 0.0, 0.0, 1.0],
];

/// A square that fills the picture: its corners, and what they are drawn with.
pub(crate) struct Square {
    /// The number of its first corner.
    pub(super) first: u32,
    /// Position and normal of each corner, counter-clockwise from the lower left.
    pub(crate) corners: &'static [[f32; 6]],
    /// Red, green, blue, alpha.
    pub(crate) color: [f32; 4],
    pub(crate) view_from_square: Mat4,
    pub(crate) clip_from_view: Mat4,
}

impl Square {
    /// Returns the square that this geometry is; `None` for others.
    pub(crate) fn of(geometry: &Geometry) -> Option<Self> {
        let (first, color, view_from_square, clip_from_view) = match geometry {
            Geometry::BackgroundSquare { color } => {
                let far_away = Mat4::from_translation(Vec3::new(0.0, 0.0, -BACKGROUND_DISTANCE));
                // x and y unchanged, depth that of the far plane: a parallel projection that fills the picture.
                let flat = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::ZERO, Vec4::new(0.0, 0.0, 1.0, 1.0));
                (0, *color, far_away, flat)
            }
            Geometry::ScreenSquare | Geometry::PictureSquare => (4, [1.0; 4], Mat4::IDENTITY, Mat4::IDENTITY),
            Geometry::Objects(_) | Geometry::Edges { .. } => return None,
        };
        let corners = &SQUARES[first as usize..first as usize + 4];
        Some(Self { first, corners, color, view_from_square, clip_from_view })
    }
}
