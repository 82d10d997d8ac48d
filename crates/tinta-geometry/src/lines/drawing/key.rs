//! A key to the colours of areas: rectangles and texts above all lines, such as a scalar bar with its numbers.

use crate::lines::drawing::drawn_labels::DrawnLabel;
use crate::scene::Color;
use glam::DVec2;

/// A key to the colours of areas.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Key {
    /// Upper left and lower right corner, pixels, and colour, in the order in which they are painted.
    pub boxes: Vec<([DVec2; 2], Color)>,
    /// The texts.
    pub texts: Vec<KeyText>,
}

/// A text of a key.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyText {
    /// Its letters.
    pub text: String,
    /// Its place, pixels, y down.
    pub at_px: DVec2,
    /// The share of its width that lies to the left of its place.
    pub left: f64,
    /// How far its base line lies below its place, in heights of letters.
    pub below: f64,
    /// Its colour.
    pub color: Color,
}

impl KeyText {
    /// The text as drawings have it, with letters of this height.
    pub(super) fn drawn(&self, height_px: f64) -> DrawnLabel<'_> {
        let at_px = self.at_px + DVec2::Y * (self.below * height_px);
        DrawnLabel { text: &self.text, at_px, left: self.left, color: self.color }
    }
}
