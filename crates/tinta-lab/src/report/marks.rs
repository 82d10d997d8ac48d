//! A style's mark in the plots, taken from its row.

use super::svg_canvas::{BACKGROUND, SvgCanvas};
use plotters::style::{Color, RGBColor};
use std::f64::consts::{PI, TAU};
use tinta::error::Result;
use tinta::styles::{Mark, Outline, StyleName};

/// Half a mark's size, pixels.
pub(super) const RADIUS: f64 = 6.0;

/// The mark of all others.
const OTHER: Mark = Mark { rgb: [90; 3], outline: Outline::Circle };

/// The marks as the legend has them.
fn marks() -> impl Iterator<Item = (&'static str, Mark)> {
    StyleName::ALL.into_iter().filter_map(|(name, style)| Some((name, style.info().mark?)))
}

/// The mark's place in the legend; a style unknown here comes last.
pub(super) fn rank(style: &str) -> usize {
    marks().position(|(name, _)| name == style).unwrap_or(usize::MAX)
}

/// Draws a style's mark, filled or hollow.
pub(super) fn draw(canvas: &SvgCanvas<'_>, style: &str, middle: (f64, f64), is_filled: bool) -> Result<()> {
    let Mark { rgb: [red, green, blue], outline } =
        marks().find(|(name, _)| *name == style).map_or(OTHER, |(_, mark)| mark);
    let color = RGBColor(red, green, blue);
    let fill = if is_filled { color } else { BACKGROUND };
    let mut corners = match outline {
        Outline::Circle => {
            canvas.circle(middle, RADIUS as u32 - 1, fill.filled())?;
            return canvas.circle(middle, RADIUS as u32 - 1, color.stroke_width(2));
        }
        Outline::Polygon { corners, turn } => {
            (0..corners).map(|corner| (RADIUS, turn + TAU * corner as f64 / corners as f64)).collect::<Vec<_>>()
        }
        Outline::Star => (0..10)
            .map(|corner| (if corner % 2 == 0 { RADIUS + 1.0 } else { RADIUS * 0.5 }, PI * f64::from(corner) / 5.0))
            .collect(),
    };
    corners.push(corners[0]);
    let corners: Vec<(f64, f64)> = corners
        .into_iter()
        .map(|(radius, angle)| (middle.0 + radius * angle.sin(), middle.1 - radius * angle.cos()))
        .collect();
    canvas.polygon(&corners, fill)?;
    canvas.line(&corners, color, 2)
}
