//! Labels as drawn texts: place, size and colour.

use crate::edges::Class;
#[cfg(feature = "pdf")]
use crate::error::{Error, Result};
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
    pub color: Color,
}

/// The height of all labels' letters, pixels.
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
        DrawnLabel { text: &label.text, at_px, left: 0.0, color: settings.color(layer) }
    };
    labels.iter().filter(|label| settings.draws(label.is_visible) && !label.text.is_empty()).map(drawn).collect()
}

/// The width of a text in the standard font Helvetica, in heights of its letters. Letters beyond ASCII count as wide as most.
#[cfg(feature = "pdf")]
pub(in crate::lines) fn width(win_ansi: &[u8]) -> f64 {
    /// Thousandths, from the space on.
    const WIDTHS: [u16; 95] = [
        278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556,
        556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667,
        556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333, 556,
        556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722,
        500, 500, 500, 334, 260, 334, 584,
    ];
    let of = |byte: &u8| usize::from(*byte).checked_sub(32).and_then(|at| WIDTHS.get(at)).copied().unwrap_or(556);
    win_ansi.iter().map(|byte| f64::from(of(byte)) / 1000.0).sum()
}

/// Returns a text's bytes in the encoding of PDF's standard fonts, WinAnsi (ISO 32000-1, annex D).
///
/// # Errors
///
/// [`Error::Setting`] for letters that these fonts lack.
#[cfg(feature = "pdf")]
pub(in crate::lines) fn win_ansi(text: &str) -> Result<Vec<u8>> {
    /// The letters of 0x80 to 0x9F that are none of Latin 1.
    const OTHERS: [char; 32] = [
        '€', '\0', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\0', 'Ž', '\0', '\0', '‘', '’', '“', '”',
        '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\0', 'ž', 'Ÿ',
    ];
    let byte = |letter: char| match letter {
        '\t' | '\n' | '\r' => Some(b' '),
        ' '..='~' | '\u{a0}'..='\u{ff}' => u8::try_from(letter).ok(),
        '\0' => None,
        _ => OTHERS.iter().position(|other| *other == letter).map(|place| 0x80 + place as u8),
    };
    let encoded: Option<Vec<u8>> = text.chars().map(byte).collect();
    encoded.ok_or_else(|| {
        let shown: String = text.chars().take(40).collect();
        Error::value("labels", shown, "a PDF's standard fonts lack some of its letters; write it as .svg")
    })
}

#[cfg(all(test, feature = "pdf"))]
mod tests {
    use super::*;

    #[test]
    fn texts_have_the_widths_of_helvetica() {
        // Adobe's metrics: H 722, e 556, i 222, g 556, h 556, t 278.
        assert!((width(b"Height") - 2.89).abs() < 1e-12);
        assert!((width(b"-0.5~") - (333.0 + 556.0 + 278.0 + 556.0 + 584.0) / 1000.0).abs() < 1e-12);
        assert_eq!(width(b""), 0.0);
    }

    #[test]
    fn western_letters_have_bytes_and_others_are_refused_with_the_remedy() {
        assert_eq!(win_ansi("Höhe 3 €\n–").unwrap(), b"H\xf6he 3 \x80 \x96");
        assert!(win_ansi("").unwrap().is_empty());
        for text in ["λ", "山", "\u{1}", "\u{81}", "a\0"] {
            assert!(win_ansi(text).unwrap_err().to_string().contains("write it as .svg"), "{text:?}");
        }
    }
}
