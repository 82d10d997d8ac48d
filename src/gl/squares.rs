//! The squares that fill the picture, on the device, and their drawing.

use super::execute::Resources;
use super::immediate::{Places, Vertices};
use super::legacy::{self, MODELVIEW, PROJECTION};
use super::objects::Buffer;
use super::square::{SQUARES, Square};
use crate::error::Result;
use crate::plan::Submission;

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
