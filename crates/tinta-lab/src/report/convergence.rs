//! Error against the number of triangles, for lines compared with the contour of a smooth surface: a plot for each surface, and
//! the order of convergence of each setting.

use super::frame::{MARGIN, Scale, Shape, grid, short, spread};
use super::labels::Rectangle;
use super::marks;
use super::settings::short_names;
use super::svg_canvas::{Anchor, SvgCanvas, text_width};
use crate::measure::{Against, Row};
use plotters::style::RGBColor;
use tinta::error::Result;
use tinta::styles::StyleName;

/// A setting's errors on the meshes of one surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The surface's name.
    pub surface: String,
    /// The setting's short name.
    pub name: String,
    /// The style.
    pub style: String,
    /// Whether these are the published program's settings.
    pub is_faithful: bool,
    /// Triangles and error, pixels, by triangles: the larger of the mean distances from ink to contour and from contour to ink.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// The power of the edges' length by which the error falls from the first mesh to the last.
    pub fn order(&self) -> Option<f64> {
        let (first, last) = (self.points.first()?, self.points.last()?);
        // Edges are as long as the root of a triangle's area.
        let order = 2.0 * (first.1 / last.1).ln() / (last.0 / first.0).ln();
        order.is_finite().then_some(order)
    }

    /// Its entry in the key.
    fn described(&self) -> String {
        let errors: Vec<String> = self.points.iter().map(|point| short(point.1)).collect();
        let order = self.order().map_or(String::new(), |order| format!(", order {order:.2}"));
        format!("{}: {} px{order}", self.name, errors.join(", "))
    }
}

/// A curve for each setting and surface that was measured with two meshes at least.
pub fn curves(rows: &[&Row]) -> Vec<Curve> {
    let names = short_names(rows);
    let mut curves: Vec<Curve> = Vec::new();
    for row in rows {
        let Some(lines) = row.lines.as_ref().filter(|lines| lines.against == Against::Smooth) else { continue };
        let (Some([to_ink, _]), Some([to_contour, _])) = (lines.reference_to_ink_px, lines.ink_to_reference_px) else {
            continue;
        };
        let surface = row.model.trim_start_matches("builtin:").split(':').next().unwrap_or_default();
        let name = &names[&super::settings::setting_key(row)];
        let point = (row.triangles as f64, to_ink.max(to_contour));
        match curves.iter_mut().find(|curve| curve.surface == surface && curve.name == *name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve {
                surface: surface.to_owned(),
                name: name.clone(),
                style: row.style.clone(),
                is_faithful: row.is_faithful,
                points: vec![point],
            }),
        }
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve.points.dedup_by_key(|point| point.0);
    }
    curves.retain(|curve| curve.points.len() > 1);
    curves
}

/// The surfaces of curves, in order.
pub(super) fn surfaces(curves: &[Curve]) -> Vec<&str> {
    let mut surfaces: Vec<&str> = curves.iter().map(|curve| curve.surface.as_str()).collect();
    surfaces.dedup();
    let mut seen = Vec::new();
    surfaces.retain(|surface| {
        !seen.contains(surface) && {
            seen.push(*surface);
            true
        }
    });
    surfaces
}

/// Colour of the lines between marks.
const BETWEEN: RGBColor = RGBColor(170, 170, 170);

/// The plot of one surface: the published settings, exact lines and inking; the table has all.
///
/// # Errors
///
/// [`tinta::Error::File`] should the drawing fail.
pub(super) fn plot(curves: &[Curve], surface: &str, shape: Shape) -> Result<String> {
    let is_shown = |curve: &&Curve| {
        curve.surface == surface
            && (curve.is_faithful
                || [StyleName::Lines, StyleName::Inking].iter().any(|style| style.name() == curve.style))
    };
    let mut shown: Vec<&Curve> = curves.iter().filter(is_shown).collect();
    let last = |curve: &Curve| curve.points.last().map_or(0.0, |point| point.1);
    shown.sort_by(|a, b| last(b).total_cmp(&last(a)));
    let layout = shape.layout();
    let key: Vec<Vec<String>> = shown.iter().map(|curve| layout.entry(&curve.described())).collect();
    let top = MARGIN + layout.title * 1.4 + layout.line_height() * 1.5;
    // Room for the numbers of curves that end in one place.
    let right = layout.width - MARGIN - 16.0 * shown.len().min(6) as f64;
    let inner = Rectangle { left: layout.left, top, right, bottom: top + layout.height };
    let key_top = inner.bottom + layout.line_height() * 3.2;
    let all = || shown.iter().flat_map(|curve| curve.points.iter());
    let scale = Scale {
        time_ms: spread(all().map(|point| point.0)),
        error: spread(all().map(|point| point.1).filter(|error| *error > 0.0)),
        zero: None,
    };
    let axes = scale.axes(&inner);
    let title = format!("Convergence on the {surface}");
    let mut svg = String::new();
    let canvas = SvgCanvas::new(&mut svg, layout.width as u32, layout.below_key(key_top, &key).ceil() as u32)?;
    let names = ["\u{2191} mean distance from the true contour, px", "triangles \u{2192}"].map(str::to_owned);
    layout.name(&canvas, &inner, &title, &[], &names)?;
    grid(&canvas, &axes, &scale, &inner, &layout)?;
    let mut taken: Vec<Rectangle> = Vec::new();
    for (number, curve) in shown.iter().enumerate() {
        let points: Vec<(f64, f64)> =
            curve.points.iter().map(|point| axes.pixel(point.0, point.1.max(scale.error.start))).collect();
        canvas.line(&points, BETWEEN, 1)?;
        for point in &points {
            marks::draw(&canvas, &curve.style, *point, curve.is_faithful)?;
        }
        // Its number right of the last mark, or beside existing numbers.
        let label = (number + 1).to_string();
        let Some((x, y)) = points.last().copied() else { continue };
        let mut place = Rectangle {
            left: x + 8.0,
            top: y - 8.0,
            right: x + 10.0 + text_width(&label, layout.text),
            bottom: y + 8.0,
        };
        while taken.iter().any(|other| other.overlaps(&place)) {
            place.left += 16.0;
            place.right += 16.0;
        }
        canvas.text((place.left, y), Anchor::Start, &label, layout.text, false)?;
        taken.push(place);
    }
    layout.draw_key(&canvas, key_top, &key)?;
    canvas.finish()?;
    let what = format!("<svg role=\"img\" aria-label=\"{title}\" ");
    Ok(svg.replacen("<svg ", &what, 1))
}
