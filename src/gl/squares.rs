//! The squares that fill the picture, and the values at their corners.

use super::execute::Resources;
use super::immediate::{Places, Vertices};
use super::legacy::{self, MODELVIEW, PROJECTION};
use super::objects::Buffer;
use crate::error::Result;
use crate::plan::{Geometry, Submission};
use crate::tolerances::BACKGROUND_DISTANCE;
use glam::{Mat4, Vec3, Vec4};

/// Position and normal of each corner: the background square, then the screen square at the near plane.
const SQUARES: [[f32; 6]; 8] = [
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
    first: u32,
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

impl Resources {
    /// Uploads them unless they are already uploaded.
    pub(super) fn upload_squares(&mut self) -> Result<()> {
        if self.squares.is_none() {
            self.squares = Some(Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&SQUARES))?);
        }
        Ok(())
    }

    /// Draws a square.
    pub(super) fn draw_square(&self, square: &Square) -> Result<()> {
        // SAFETY: the context is current.
        unsafe {
            self.gl.legacy.load_matrix(PROJECTION, &self.in_tile(square.clip_from_view));
            self.gl.legacy.load_matrix(MODELVIEW, &square.view_from_square);
            self.gl.legacy.color(square.color);
        }
        self.draw_corners(legacy::QUADS, square.first, 4)
    }

    /// Draws some corners of the squares.
    pub(super) fn draw_corners(&self, mode: u32, first: u32, count: u32) -> Result<()> {
        if self.submission != Submission::Buffers {
            let indices: Vec<u32> = (first..first + count).collect();
            let places = Places::PositionsAndNormals(&SQUARES);
            return self.gl.draw_in_immediate_mode(&Vertices::new(mode, places, &indices));
        }
        if let Some(squares) = &self.squares {
            squares.bind();
        }
        // SAFETY: the context is current and the bound buffer holds both squares, four vertices each.
        unsafe {
            self.gl.legacy.position_and_normal_arrays();
            self.gl.legacy.draw_arrays(&self.gl.glow, mode, first as i32, count as i32);
        }
        Ok(())
    }
}
