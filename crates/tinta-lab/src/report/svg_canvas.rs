//! An SVG to draw on in pixels: the one file that knows how plotters draws.

use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::{CoordTranslate, Shift};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;
use tinta::error::{Error, Result};

/// Text: the page gives these two colours others in the dark.
pub(super) const INK: RGBColor = RGBColor(0, 0, 0);
pub(super) const BACKGROUND: RGBColor = RGBColor(255, 255, 255);
/// Lines behind everything, and axes.
pub(super) const FAINT: RGBColor = RGBColor(226, 226, 226);
pub(super) const MIDDLE: RGBColor = RGBColor(136, 136, 136);

/// How a text lies about its point, level with its middle.
#[derive(Debug, Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Greatest width of a text, pixels, for a font size in pixels: plotters has no better estimate without a font.
pub(super) fn text_width(text: &str, size_px: f64) -> f64 {
    text.chars().count() as f64 * size_px * 0.56
}

/// Lines of a text wider than the available width, broken at spaces, and within a word only if the word alone is too wide.
pub(super) fn wrapped(text: &str, size_px: f64, room_px: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let longest = ((room_px / text_width("m", size_px)) as usize).max(1);
    let words = text.split_whitespace().flat_map(|word| {
        let characters: Vec<char> = word.chars().collect();
        characters.chunks(longest).map(|part| part.iter().collect::<String>()).collect::<Vec<_>>()
    });
    for word in words {
        match lines.last_mut() {
            Some(line) if text_width(line, size_px) + text_width(&word, size_px) + size_px / 2.0 <= room_px => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// The picture being drawn.
pub(super) struct SvgCanvas<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
}

impl<'a> SvgCanvas<'a> {
    /// An empty one that will be written into `svg`.
    pub(super) fn new(svg: &'a mut String, width_px: u32, height_px: u32) -> Result<Self> {
        let area = SVGBackend::with_string(svg, (width_px, height_px)).into_drawing_area();
        drawn(area.fill(&BACKGROUND))?;
        Ok(Self { area })
    }

    /// Ends the picture; the text is complete afterwards.
    pub(super) fn finish(self) -> Result<()> {
        drawn(self.area.present())
    }

    pub(super) fn line(&self, points: &[(f64, f64)], color: RGBColor, width_px: u32) -> Result<()> {
        let points: Vec<(i32, i32)> = points.iter().map(|point| pixel(*point)).collect();
        drawn(self.area.draw(&PathElement::new(points, color.stroke_width(width_px))))
    }

    pub(super) fn polygon(&self, points: &[(f64, f64)], color: RGBColor) -> Result<()> {
        let points: Vec<(i32, i32)> = points.iter().map(|point| pixel(*point)).collect();
        drawn(self.area.draw(&Polygon::new(points, color.filled())))
    }

    pub(super) fn circle(&self, middle: (f64, f64), radius_px: u32, style: ShapeStyle) -> Result<()> {
        drawn(self.area.draw(&Circle::new(pixel(middle), radius_px, style)))
    }

    pub(super) fn text(&self, at: (f64, f64), anchor: Anchor, text: &str, size_px: f64, is_bold: bool) -> Result<()> {
        let horizontal = match anchor {
            Anchor::Start => HPos::Left,
            Anchor::Middle => HPos::Center,
            Anchor::End => HPos::Right,
        };
        let style = if is_bold { FontStyle::Bold } else { FontStyle::Normal };
        // The backend divides sizes by this.
        let font = FontDesc::new(FontFamily::SansSerif, size_px * 1.24, style);
        let style = font.color(&INK).pos(Pos::new(horizontal, VPos::Center));
        // plotters escapes XML's special characters, but not those that XML forbids.
        let text = text.replace(tinta_geometry::markup::is_unprintable, "\u{FFFD}");
        drawn(self.area.draw(&Text::new(text, pixel(at), style)))
    }
}

/// Two logarithmic axes over a rectangle of pixels.
pub(super) struct Axes(Cartesian2d<LogCoord<f64>, LogCoord<f64>>);

impl Axes {
    pub(super) fn new(x: Range<f64>, y: Range<f64>, x_px: Range<i32>, y_px: Range<i32>) -> Self {
        let log = |range: Range<f64>| -> LogCoord<f64> { range.log_scale().into() };
        Self(Cartesian2d::new(log(x), log(y), (x_px, y_px)))
    }

    /// The pixel of a time and an error.
    pub(super) fn pixel(&self, x: f64, y: f64) -> (f64, f64) {
        let (x, y) = self.0.translate(&(x, y));
        (x.into(), y.into())
    }
}

fn pixel((x, y): (f64, f64)) -> (i32, i32) {
    (x.round() as i32, y.round() as i32)
}

/// Drawing into memory does not fail; if it did, the plot would be the file that cannot be written.
fn drawn<T, E: std::error::Error>(result: std::result::Result<T, E>) -> Result<T> {
    result.map_err(|error| Error::output("plot", format!("it cannot be drawn ({error})")))
}
