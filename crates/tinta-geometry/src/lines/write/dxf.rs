//! Writes lines as DXF: a layer for each class, in it the chained polylines, each once.
//!
//! Input: [`VisibleLines`] and [`DrawingSettings`]. Output: ASCII DXF of release 12, the oldest that programs for CAD, laser cutters and
//! plotters still read; it has neither curves nor fills. Coordinates are millimetres if the drawing has a size on paper, else
//! pixels, from the lower left corner, y up. Source: Autodesk, *AutoCAD 2012 DXF Reference*. The crate `dxf` was rejected: it brings
//! 30 others and writes the time and random identifiers, while equal drawings have equal bytes here.

use crate::error::Result;
use crate::lines::VisibleLines;
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::drawn_layers::{Drawing, DrawnLayer};
use crate::lines::drawing::page::{PAGE_DECIMALS, Page};
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::drawing::text::decimal;
use crate::lines::write::strokes::polylines;
use crate::scene::Color;
use glam::DVec2;
use std::fmt::{Display, Write};

/// The number of the unit of coordinates.
const MILLIMETRES: u8 = 4;

/// The longest name of a layer.
const LONGEST_NAME: usize = 31;

/// The layer of labels.
const LABELS: &str = "labels";

/// AutoCAD's numbers of colours that need no palette, red, green and blue; 7 is black on a white ground and white on a black one.
const COLORS: [(u8, [f32; 3]); 9] = [
    (7, [0.0, 0.0, 0.0]),
    (7, [1.0, 1.0, 1.0]),
    (1, [1.0, 0.0, 0.0]),
    (2, [1.0, 1.0, 0.0]),
    (3, [0.0, 1.0, 0.0]),
    (4, [0.0, 1.0, 1.0]),
    (5, [0.0, 0.0, 1.0]),
    (6, [1.0, 0.0, 1.0]),
    (8, [0.5, 0.5, 0.5]),
];

/// Returns the lines as a DXF file, without spurs and specks.
///
/// # Errors
///
/// Those of [`crate::lines::svg`].
pub fn dxf(lines: &VisibleLines, settings: &DrawingSettings) -> Result<String> {
    let lines = lines.without_specks(settings)?;
    dxf_of_paths(&lines, chain(&lines.segments), None, settings)
}

/// Returns the given lines as a DXF file, with the paths that [`chain`] made of them, and the strokes of the given areas; fills are
/// left out.
///
/// # Errors
///
/// Those of [`dxf`].
pub(crate) fn dxf_of_paths(
    lines: &VisibleLines,
    paths: Vec<LinePath>,
    areas: Option<&Areas>,
    settings: &DrawingSettings,
) -> Result<String> {
    let settings = &DrawingSettings { tapers: false, ..settings.clone() };
    let drawing = Drawing::new(lines, paths, areas, settings)?;
    let mut out = Text { out: String::new(), page: &drawing.page };
    let mut layers: Vec<(String, Color)> = drawing.layers.iter().map(|layer| (name(layer), layer.color)).collect();
    if let Some(label) = drawing.labels.first() {
        layers.push((LABELS.to_owned(), label.color));
    }
    out.begin(&layers);
    for (layer, (name, _)) in drawing.layers.iter().zip(&layers) {
        for polyline in polylines(layer) {
            out.polyline(name, &polyline.points_px, polyline.is_closed);
        }
    }
    for label in &drawing.labels {
        out.pair(0, "TEXT");
        out.pair(8, LABELS);
        out.point(label.at_px);
        let height = out.length(label.height_px);
        out.pair(40, &height);
        out.pair(1, in_ascii(label.text));
    }
    out.pair(0, "ENDSEC");
    out.pair(0, "EOF");
    Ok(out.out)
}

/// The name of a layer: with that of its parts if the format allows it.
fn name(layer: &DrawnLayer) -> String {
    let label = layer.label().replace(' ', "-");
    let is_plain = label.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '-' || letter == '_');
    if is_plain && label.len() <= LONGEST_NAME { label } else { layer.id() }
}

/// The number of the nearest colour.
fn color_number(Color(color): Color) -> u8 {
    let distance = |other: [f32; 3]| other.iter().zip(color).map(|(a, b)| (a - b).powi(2)).sum::<f32>();
    let nearest = COLORS.into_iter().min_by(|(_, a), (_, b)| distance(*a).total_cmp(&distance(*b)));
    nearest.map_or(7, |(number, _)| number)
}

/// A label in ASCII on one line: other letters by their numbers, and none that begin a code of DXF.
fn in_ascii(text: &str) -> String {
    let mut ascii = String::new();
    for letter in text.chars() {
        match letter {
            '^' => ascii.push_str("^ "),
            '%' => ascii.push_str("%%%"),
            ' '..='~' => ascii.push(letter),
            _ if letter.is_control() => ascii.push(' '),
            _ => letter.encode_utf16(&mut [0; 2]).iter().for_each(|unit| {
                let _ = write!(ascii, "\\U+{unit:04X}");
            }),
        }
    }
    ascii
}

/// A file so far: pairs of a code and a value, a line each.
struct Text<'a> {
    out: String,
    page: &'a Page,
}

impl Text<'_> {
    fn pair(&mut self, code: u16, value: impl Display) {
        let _ = writeln!(self.out, "{code}\n{value}");
    }

    /// A length on the page.
    fn length(&self, px: f64) -> String {
        decimal(px / self.page.units.px_per_mm.unwrap_or(1.0), PAGE_DECIMALS)
    }

    /// Writes a point of the picture's plane, y down, as one of the page, y up.
    fn point(&mut self, px: DVec2) {
        let DVec2 { x, y } = px - self.page.origin_px;
        let [x, y] = [x, self.page.extent_px.y - y].map(|px| self.length(px));
        self.pair(10, x);
        self.pair(20, y);
    }

    /// Writes everything before the lines.
    fn begin(&mut self, layers: &[(String, Color)]) {
        let section = |out: &mut Self, name: &str| {
            out.pair(0, "SECTION");
            out.pair(2, name);
        };
        let table = |out: &mut Self, name: &str, count: usize| {
            out.pair(0, "TABLE");
            out.pair(2, name);
            out.pair(70, count);
        };
        section(self, "HEADER");
        self.pair(9, "$ACADVER");
        self.pair(1, "AC1009");
        // Newer than release 12, whose readers skip variables that they do not know; without it some take inches.
        if self.page.units.px_per_mm.is_some() {
            self.pair(9, "$INSUNITS");
            self.pair(70, MILLIMETRES);
        }
        let lower_left = self.page.origin_px + DVec2::new(0.0, self.page.extent_px.y);
        let upper_right = self.page.origin_px + DVec2::new(self.page.extent_px.x, 0.0);
        for (name, corner) in [("$EXTMIN", lower_left), ("$EXTMAX", upper_right)] {
            self.pair(9, name);
            self.point(corner);
        }
        self.pair(0, "ENDSEC");
        section(self, "TABLES");
        table(self, "LTYPE", 1);
        for (code, value) in
            [(0, "LTYPE"), (2, "CONTINUOUS"), (70, "0"), (3, "Solid line"), (72, "65"), (73, "0"), (40, "0")]
        {
            self.pair(code, value);
        }
        self.pair(0, "ENDTAB");
        table(self, "LAYER", layers.len());
        for (name, color) in layers {
            self.pair(0, "LAYER");
            self.pair(2, name);
            self.pair(70, 0);
            self.pair(62, color_number(*color));
            self.pair(6, "CONTINUOUS");
        }
        self.pair(0, "ENDTAB");
        self.pair(0, "ENDSEC");
        section(self, "ENTITIES");
    }

    /// Writes a polyline, or a point if it has no length.
    fn polyline(&mut self, layer: &str, points_px: &[DVec2], is_closed: bool) {
        if points_px.iter().all(|point| Some(point) == points_px.first()) {
            self.pair(0, "POINT");
            self.pair(8, layer);
            points_px.iter().take(1).for_each(|point| self.point(*point));
            return;
        }
        self.pair(0, "POLYLINE");
        self.pair(8, layer);
        // Vertices follow.
        self.pair(66, 1);
        self.pair(70, u8::from(is_closed));
        for point in points_px {
            self.pair(0, "VERTEX");
            self.pair(8, layer);
            self.point(*point);
        }
        self.pair(0, "SEQEND");
        self.pair(8, layer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_the_number_of_the_nearest_and_labels_are_ascii() {
        let numbers =
            [[0.0; 3], [1.0; 3], [0.9, 0.1, 0.0], [0.0, 0.0, 0.6], [0.45; 3]].map(|it| color_number(Color(it)));
        assert_eq!(numbers, [7, 7, 1, 5, 8]);
        assert_eq!(in_ascii("Ø 5 %\n^λ"), "\\U+00D8 5 %%% ^ \\U+03BB");
        assert_eq!(in_ascii("\u{1F600}"), "\\U+D83D\\U+DE00");
    }
}
