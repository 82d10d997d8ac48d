//! The squares that fill the picture, and the values at their corners.

use super::execute::Resources;
use super::immediate::{Places, Vertices};
use super::legacy::{self, MODELVIEW, PROJECTION};
use super::objects::Buffer;
use crate::error::Result;
use crate::plan::Submission;
use glam::Mat4;

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

impl Resources {
    /// Uploads them unless they are already uploaded.
    pub(super) fn upload_squares(&mut self) -> Result<()> {
        if self.squares.is_none() {
            self.squares = Some(Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&SQUARES))?);
        }
        Ok(())
    }

    /// Draws the square that starts at this corner.
    pub(super) fn draw_square(
        &self,
        first: u32,
        color: [f32; 4],
        view_from_square: &Mat4,
        clip_from_view: &Mat4,
    ) -> Result<()> {
        // SAFETY: the context is current.
        unsafe {
            self.gl.legacy.load_matrix(PROJECTION, clip_from_view);
            self.gl.legacy.load_matrix(MODELVIEW, view_from_square);
            self.gl.legacy.color(color);
        }
        self.draw_corners(legacy::QUADS, first, 4)
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
