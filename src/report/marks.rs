//! A style's mark in the plots: a colour and a shape, so that neither is needed alone.

use super::canvas::{BACKGROUND, Canvas};
use crate::error::Result;
use plotters::style::{Color, RGBColor};
use std::f64::consts::{PI, TAU};

/// Half a mark's size, pixels.
pub(super) const RADIUS: f64 = 6.0;

/// The colours can be told apart by the colour-blind (Okabe and Ito 2008) and be seen on white and near black.
const MARKS: [(&str, RGBColor, Outline); 9] = [
    ("phong", RGBColor(128, 128, 128), Outline::Circle),
    ("three-pass", RGBColor(31, 131, 201), Outline::Polygon { corners: 4, turn: PI / 4.0 }),
    ("two-pass", RGBColor(213, 94, 0), Outline::Polygon { corners: 3, turn: 0.0 }),
    ("mrt", RGBColor(86, 180, 233), Outline::Polygon { corners: 5, turn: PI }),
    ("inking", RGBColor(0, 158, 115), Outline::Polygon { corners: 4, turn: 0.0 }),
    ("dietrich", RGBColor(204, 121, 167), Outline::Polygon { corners: 3, turn: PI }),
    ("charcoal", RGBColor(140, 109, 90), Outline::Polygon { corners: 5, turn: 0.0 }),
    ("sand", RGBColor(184, 137, 11), Outline::Polygon { corners: 6, turn: 0.0 }),
    ("lines", RGBColor(123, 92, 214), Outline::Star),
];

#[derive(Clone, Copy)]
enum Outline {
    Circle,
    Polygon {
        corners: usize,
        /// Of the first corner from the top, radians.
        turn: f64,
    },
    Star,
}

/// The mark's place in the legend; a style unknown here comes last.
pub(super) fn rank(style: &str) -> usize {
    MARKS.iter().position(|(name, ..)| *name == style).unwrap_or(MARKS.len())
}

/// Draws a style's mark, filled or hollow.
pub(super) fn draw(canvas: &Canvas<'_>, style: &str, middle: (f64, f64), is_filled: bool) -> Result<()> {
    let (_, color, outline) = MARKS.get(rank(style)).copied().unwrap_or(("", RGBColor(90, 90, 90), Outline::Circle));
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
