//! Labels as drawn texts: place, size and colour.

use crate::edges::Class;
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::length::Units;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::labels::Label;
use crate::scene::Color;
use glam::DVec2;

/// Height of the letters, pixels without a size on paper and millimetres with one: ten points.
const HEIGHT_PX: f64 = 12.0;
const HEIGHT_MM: f64 = 3.53;

/// Gap between a point's dot and its text, and how far the base line lies below the point, in letter heights.
const GAP: f64 = 0.25;
const BASELINE: f64 = 0.35;

/// A text to write.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::lines) struct DrawnLabel<'a> {
    pub text: &'a str,
    /// A point of its base line, pixels, y down.
    pub at_px: DVec2,
    /// The share of its width that lies to the left of that point.
    pub left: f64,
    /// Of its letters.
    pub height_px: f64,
    pub color: Color,
}

/// The height of labels' letters, pixels.
pub(in crate::lines) fn height_px(units: Units) -> f64 {
    units.px_per_mm.map_or(HEIGHT_PX, |px| px * HEIGHT_MM)
}

/// The labels that a drawing shows, to the right of their points.
pub(in crate::lines) fn drawn_labels<'a>(
    labels: &'a [Label],
    settings: &DrawingSettings,
    units: Units,
) -> Vec<DrawnLabel<'a>> {
    let height = height_px(units);
    let drawn = |label: &'a Label| {
        let layer = Layer::of(Class::Point, label.is_visible, false);
        let right = settings.width_px(layer, units) * 0.5 + GAP * height;
        let at_px = label.px + DVec2::new(right, BASELINE * height);
        DrawnLabel { text: &label.text, at_px, left: 0.0, height_px: height, color: settings.color(layer) }
    };
    labels.iter().filter(|label| settings.draws(label.is_visible) && !label.text.is_empty()).map(drawn).collect()
}
