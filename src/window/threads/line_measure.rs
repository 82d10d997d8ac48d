//! How the window measures lines: with functions of a higher package.

use crate::error::Result;
use crate::lines::Progress;
use crate::renderer::Renderer;
use crate::scene::Scene;
use crate::styles::Style;

/// Draws a style's lines: how dark each pixel is.
pub(crate) type DrawInk = fn(&mut Renderer, &Scene, &Style) -> Result<Option<Darkness>>;

/// Scores several pictures of lines of one scene.
pub(crate) type ScoreInk = fn(&Scene, Vec<Darkness>, &Progress) -> Result<Vec<LineScore>>;

/// How dark each pixel is, row by row from the top, 255 for black.
pub type Darkness = Vec<u8>;

/// Measures a style's lines against the exact ones.
#[derive(Debug, Clone, Copy)]
pub struct LineMeasure {
    /// `None` for a style without lines.
    pub ink: DrawInk,
    /// A score for each picture.
    pub scores: ScoreInk,
}

/// How far lines are from the exact ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineScore {
    /// Harmonic mean of recall and precision, 0 to 1.
    pub f1: f64,
    /// Share of the exact lines that are drawn, 0 to 1.
    pub recall: f64,
    /// Share of the ink that lies on exact lines, 0 to 1.
    pub precision: f64,
    /// Mean distance from the ink to the exact lines, pixels; `None` without ink.
    pub mean_px: Option<f64>,
}
