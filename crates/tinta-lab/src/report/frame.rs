//! The frame of a plot with two logarithmic axes: its title, its axes and their grid, the key below it.

use super::labels::Rectangle;
use super::settings::Point;
use super::svg_canvas::{Anchor, Axes, FAINT, MIDDLE, SvgCanvas, text_width, wrapped};
use std::ops::Range;
use tinta::error::Result;

/// The destination of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A file, or a page on a screen: names stand beside their points.
    Wide,
    /// A phone: numbers stand beside the points, their names below.
    Narrow,
}

/// Sizes in pixels.
pub(super) struct Layout {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) left: f64,
    pub(super) text: f64,
    pub(super) title: f64,
}

pub(super) const MARGIN: f64 = 12.0;

/// How far an entry of the key lies from the margin, behind its number.
const KEY_INDENT: f64 = 26.0;

impl Shape {
    pub(super) fn layout(self) -> Layout {
        match self {
            Self::Wide => Layout { width: 880.0, height: 420.0, left: 80.0, text: 14.0, title: 18.0 },
            Self::Narrow => Layout { width: 360.0, height: 300.0, left: 64.0, text: 12.0, title: 15.0 },
        }
    }
}

impl Layout {
    pub(super) fn line_height(&self) -> f64 {
        self.text * 1.4
    }

    pub(super) fn room(&self) -> f64 {
        self.width - 2.0 * MARGIN
    }

    /// An entry of the key, in lines.
    pub(super) fn entry(&self, text: &str) -> Vec<String> {
        wrapped(text, self.text, self.room() - KEY_INDENT)
    }

    /// Where the picture ends if it ends with a key.
    pub(super) fn below_key(&self, top: f64, key: &[Vec<String>]) -> f64 {
        top + self.line_height() * (key.iter().map(Vec::len).sum::<usize>() as f64 + 0.3)
    }

    /// Writes the title, the lines below it, and the names of the axes: the upright one, then the other.
    pub(super) fn name(
        &self,
        canvas: &SvgCanvas<'_>,
        inner: &Rectangle,
        title: &str,
        below: &[String],
        [upright, level]: &[String; 2],
    ) -> Result<()> {
        let text = |at: (f64, f64), anchor: Anchor, text: &str| canvas.text(at, anchor, text, self.text, false);
        canvas.text((MARGIN, MARGIN + self.title * 0.7), Anchor::Start, title, self.title, true)?;
        for (line, words) in below.iter().enumerate() {
            let y = MARGIN + self.title * 1.4 + self.line_height() * (line as f64 + 0.6);
            text((MARGIN, y), Anchor::Start, words)?;
        }
        text((MARGIN, inner.top - self.line_height() * 0.7), Anchor::Start, upright)?;
        text((inner.right, inner.bottom + self.line_height() * 2.0), Anchor::End, level)
    }

    /// Writes the entries of the key, numbered from 1.
    pub(super) fn draw_key(&self, canvas: &SvgCanvas<'_>, top: f64, key: &[Vec<String>]) -> Result<()> {
        let mut y = top;
        for (index, lines) in key.iter().enumerate() {
            canvas.text((MARGIN + 18.0, y), Anchor::End, &(index + 1).to_string(), self.text, true)?;
            for line in lines {
                canvas.text((MARGIN + KEY_INDENT, y), Anchor::Start, line, self.text, false)?;
                y += self.line_height();
            }
        }
        Ok(())
    }
}

/// The range of the axes.
pub(super) struct Scale {
    pub(super) time_ms: Range<f64>,
    pub(super) error: Range<f64>,
    /// The place of zero error, which a logarithmic axis lacks.
    pub(super) zero: Option<f64>,
}

impl Scale {
    pub(super) fn of(points: &[Point]) -> Self {
        let time_ms = spread(points.iter().map(|point| point.time_ms));
        let mut error = spread(points.iter().map(|point| point.error).filter(|error| *error > 0.0));
        let mut zero = None;
        if points.iter().any(|point| point.error <= 0.0) {
            let decades = (error.end / error.start).log10();
            let below = 10_f64.powf(decades * 0.1);
            zero = Some(error.start / below);
            error.start /= below * below.sqrt();
        }
        Self { time_ms, error, zero }
    }

    pub(super) fn axes(&self, inner: &Rectangle) -> Axes {
        let pixels = |range: Range<f64>| range.start as i32..range.end as i32;
        let (x, y) = (pixels(inner.left..inner.right), pixels(inner.bottom..inner.top));
        Axes::new(self.time_ms.clone(), self.error.clone(), x, y)
    }

    pub(super) fn drawn_error(&self, error: f64) -> f64 {
        self.zero.filter(|_| error <= 0.0).unwrap_or(error)
    }
}

/// From the least to the largest with some room, at least two thirds of a decade.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (least, largest) = values
        .map(f64::log10)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, largest), value| (least.min(value), largest.max(value)));
    if least > largest {
        return 0.001..1.0;
    }
    let room = ((largest - least) * 0.06).max(0.33 - (largest - least) / 2.0);
    10_f64.powf(least - room)..10_f64.powf(largest + room)
}

/// Round numbers in the range and their names; those between the named ones get a line only.
fn ticks(range: &Range<f64>) -> Vec<(f64, Option<String>)> {
    let decades = (range.end / range.start).log10();
    let mut ticks = Vec::new();
    for exponent in range.start.log10().floor() as i32..=range.end.log10().ceil() as i32 {
        for digit in 1..10 {
            let value = f64::from(digit) * 10_f64.powi(exponent);
            if !(range.start..=range.end).contains(&value) {
                continue;
            }
            let is_named = digit == 1 || decades < 0.9 || (decades < 2.5 && (digit == 2 || digit == 5));
            let decimals = (-exponent).max(0) as usize;
            ticks.push((value, is_named.then(|| format!("{value:.decimals$}"))));
        }
    }
    ticks
}

pub(super) fn grid(
    canvas: &SvgCanvas<'_>,
    axes: &Axes,
    scale: &Scale,
    inner: &Rectangle,
    layout: &Layout,
) -> Result<()> {
    let text = |at: (f64, f64), anchor: Anchor, text: &str| canvas.text(at, anchor, text, layout.text, false);
    let (time, error) = (scale.time_ms.start, scale.error.start);
    let mut free_from = f64::NEG_INFINITY;
    for (value, name) in ticks(&scale.time_ms) {
        let (x, _) = axes.pixel(value, error);
        canvas.line(&[(x, inner.top), (x, inner.bottom)], FAINT, 1)?;
        let half = name.as_ref().map_or(0.0, |name| text_width(name, layout.text) / 2.0);
        if let Some(name) = name.filter(|_| x - half > free_from && x + half < layout.width) {
            canvas.line(&[(x, inner.bottom), (x, inner.bottom + 4.0)], MIDDLE, 1)?;
            text((x, inner.bottom + layout.text), Anchor::Middle, &name)?;
            free_from = x + half + 6.0;
        }
    }
    let first_error = scale.zero.map_or(error, |zero| zero * (zero / error));
    let errors = ticks(&(first_error..scale.error.end)).into_iter();
    let zero = scale.zero.map(|zero| (zero, Some("0".to_owned())));
    let mut free_below = f64::INFINITY;
    for (value, name) in zero.into_iter().chain(errors) {
        let (_, y) = axes.pixel(time, value);
        canvas.line(&[(inner.left, y), (inner.right, y)], FAINT, 1)?;
        if let Some(name) = name.filter(|_| y + layout.text / 2.0 < free_below) {
            canvas.line(&[(inner.left - 4.0, y), (inner.left, y)], MIDDLE, 1)?;
            text((inner.left - 8.0, y), Anchor::End, &name)?;
            free_below = y - layout.text / 2.0 - 2.0;
        }
    }
    canvas.line(&[(inner.left, inner.top), (inner.left, inner.bottom), (inner.right, inner.bottom)], MIDDLE, 1)
}

/// Three digits.
pub(super) fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let digits = 2 - number.abs().log10().floor() as i32;
    format!("{number:.*}", digits.clamp(0, 9) as usize)
}
