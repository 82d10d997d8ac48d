//! Which of two drawings is right where one of them has ink alone, by the exact lines.

use crate::compare::{Agreement, DrawnBy};
use crate::measure::Reference;
use tinta::glam::DVec2;

/// Of the ink that the left and the right side draw alone, the pixels within the tolerance of an exact visible line: of the reference, or
/// of a crease softer than its own.
pub(super) fn alone_on_lines(agreement: &Agreement, reference: &Reference, tolerance_px: f64) -> [usize; 2] {
    let width = reference.size.width as usize;
    let is_on_line = |index: usize| {
        let middle = DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
        reference.distance_px(middle).min(reference.distance_to_ignored_px(middle)) <= tolerance_px
    };
    [DrawnBy::Left, DrawnBy::Right].map(|side| {
        let alone = agreement.pixels.iter().enumerate().filter(|(_, drawn)| **drawn == side);
        alone.filter(|(index, _)| is_on_line(*index)).count()
    })
}
