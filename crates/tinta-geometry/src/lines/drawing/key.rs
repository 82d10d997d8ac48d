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
    /// The height of its letters, in those of labels.
    pub size: f64,
    /// Its colour.
    pub color: Color,
}

impl KeyText {
    /// The text as drawings have it whose labels have letters of this height.
    pub(super) fn drawn(&self, of_labels_px: f64) -> DrawnLabel<'_> {
        let height_px = self.size * of_labels_px;
        let at_px = self.at_px + DVec2::Y * (self.below * height_px);
        DrawnLabel { text: &self.text, at_px, left: self.left, height_px, color: self.color }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::drawing::areas::Areas;
    use crate::lines::drawing::fills::{Fill, FillGroup};
    use crate::lines::regions::Surface;
    use crate::lines::{DrawingSettings, VisibleLines, svg_of_paths};
    use crate::scene::Size;

    fn areas() -> Areas {
        let group = |object: u32, opacity: f32| {
            let loops = vec![vec![DVec2::ZERO, DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0)]];
            let surface = Surface { object, material: None, tone: None, face: Some(7) };
            let fills = vec![Fill { surface, color: Color([1.0, 0.0, 0.0]), loops, trap: Vec::new() }];
            FillGroup { opacity, ..FillGroup::of(object, crate::mesh::NONE, fills) }
        };
        let text = |left: f64, below: f64, size: f64| {
            let (text, at_px) = ("Height".to_owned(), DVec2::new(50.0, 20.0));
            KeyText { text, at_px, left, below, size, color: Color([0.0; 3]) }
        };
        let boxes = vec![([DVec2::new(10.0, 2.0), DVec2::new(30.0, 8.0)], Color([0.0, 0.0, 1.0]))];
        let keys = vec![Key { boxes, texts: vec![text(0.0, 0.0, 1.0), text(0.5, 1.0, 1.0), text(1.0, -0.5, 2.0)] }];
        let fills = vec![group(0, 1.0), group(1, 0.5), group(2, 0.5), group(3, 0.25)];
        Areas { fills, keys, ..Areas::default() }
    }

    #[test]
    fn a_key_lies_above_areas_of_which_neighbours_of_one_opacity_are_one_group() {
        let lines = VisibleLines::none(Size { width: 100, height: 60 });
        let svg = svg_of_paths(&lines, Vec::new(), Some(&areas()), &DrawingSettings::default()).unwrap();
        let at = |text: &str| svg.find(text).unwrap_or_else(|| panic!("{text} in {svg}"));
        assert_eq!(svg.matches("<g opacity=").count(), 2);
        let order = ["fill-0", r#"<g opacity="0.5">"#, "fill-1", "fill-2", r#"<g opacity="0.25">"#, "fill-3"].map(at);
        assert!(order.is_sorted(), "{order:?}");
        assert!(order[5] < at(r##"<rect x="10" y="2" width="20" height="6" fill="#0000ff"/>"##));
        at(r##"<text x="50" y="20" fill="#000000">Height</text>"##);
        at(r##"<text x="50" y="32" text-anchor="middle" fill="#000000">Height</text>"##);
        at(r##"<text x="50" y="8" text-anchor="end" font-size="24" fill="#000000">Height</text>"##);
        assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
    }

    #[cfg(feature = "pdf")]
    #[test]
    fn a_pdf_has_a_form_for_each_opacity_and_texts_moved_by_their_widths() {
        let lines = VisibleLines::none(Size { width: 100, height: 60 });
        let pdf =
            crate::lines::write::pdf::pdf_of_paths(&lines, Vec::new(), Some(&areas()), &DrawingSettings::default())
                .unwrap();
        let pdf = String::from_utf8_lossy(&pdf);
        assert_eq!(pdf.matches("/S /Transparency").count(), 2, "{pdf}");
        for state in ["/ca 0.5", "/ca 0.25"] {
            assert_eq!(pdf.matches(state).count(), 1, "{state}");
        }
        // "Height" is 6770 / 2048 ems of 12 pixels wide, and of 24.
        for place in ["12 Tf", "50 20 Tm", "30.166016 32 Tm", "24 Tf", "-29.335938 8 Tm"] {
            assert!(pdf.contains(place), "{place} in {pdf}");
        }
    }
}
