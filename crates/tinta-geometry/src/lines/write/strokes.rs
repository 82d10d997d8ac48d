//! A drawing as strokes, for painting in a window without a file.
//!
//! Input: [`VisibleLines`] and [`DrawingSettings`]. Output: the contents of [`crate::lines::svg`], layer by layer,
//! with dashes as separate polylines.

use crate::error::Result;
use crate::lines::VisibleLines;
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::drawn_layers::{Drawing, DrawnLayer, GHOST_OPACITY, points_of};
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::length::Units;
use crate::lines::drawing::pen::dashes;
use crate::lines::drawing::settings::DrawingSettings;
use crate::scene::Color;
use glam::DVec2;

/// The strokes of a layer, with round ends and joins. The layer is painted as a whole, so opacity does not add up at
/// crossings.
#[derive(Debug, Clone, PartialEq)]
pub struct Strokes {
    /// The layer.
    pub layer: Layer,
    /// Its colour.
    pub color: Color,
    /// Their width, pixels.
    pub width_px: f64,
    /// Their width in millimetres; `None` if the drawing has no size on paper.
    pub width_mm: Option<f64>,
    /// Their opacity; 1 is opaque.
    pub opacity: f32,
    /// The strokes.
    pub polylines: Vec<Polyline>,
    /// The middle lines of tapered ends, pixels, from the full width to the point.
    pub tips: Vec<Vec<DVec2>>,
}

/// A stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    /// Pixels from the picture's upper left corner, y down; a closed stroke does not repeat its first point.
    pub points_px: Vec<DVec2>,
    /// Whether the last point is joined to the first.
    pub is_closed: bool,
}

impl Polyline {
    /// Its length, pixels.
    pub fn length_px(&self) -> f64 {
        let closing = self.points_px.first().zip(self.points_px.last()).filter(|_| self.is_closed);
        let along = self.points_px.windows(2).map(|pair| pair[0].distance(pair[1]));
        along.sum::<f64>() + closing.map_or(0.0, |(first, last)| first.distance(*last))
    }
}

/// Returns the strokes of a drawing from the lowest layer to the highest, without spurs and specks.
///
/// # Errors
///
/// Those of [`crate::lines::svg`].
pub fn strokes(lines: &VisibleLines, settings: &DrawingSettings) -> Result<Vec<Strokes>> {
    let lines = lines.without_specks(settings)?;
    strokes_of_paths(&lines, chain(&lines.segments), None, settings)
}

/// Returns the strokes of the given lines, with the paths that [`chain`] made of them, and those of the given areas; fills are
/// left out.
///
/// # Errors
///
/// Those of [`crate::lines::svg`].
pub fn strokes_of_paths(
    lines: &VisibleLines,
    paths: Vec<LinePath>,
    areas: Option<&Areas>,
    settings: &DrawingSettings,
) -> Result<Vec<Strokes>> {
    Ok(strokes_of(&Drawing::new(lines, paths, areas, settings)?))
}

/// The strokes of a drawing.
pub(in crate::lines) fn strokes_of(drawing: &Drawing<'_>) -> Vec<Strokes> {
    drawing.layers.iter().map(|layer| of_layer(layer, drawing.page.units)).collect()
}

/// The polylines of a layer, each dash one.
pub(in crate::lines) fn polylines(drawn: &DrawnLayer) -> Vec<Polyline> {
    let of_path = |path: &LinePath| match drawn.dash_px.is_empty() {
        false => dashes(path, &drawn.dash_px)
            .into_iter()
            .map(|dash| Polyline { points_px: dash.points_px, is_closed: false })
            .collect(),
        true => vec![Polyline { points_px: points_of(path), is_closed: path.is_closed }],
    };
    drawn.paths.iter().flat_map(of_path).collect()
}

fn of_layer(drawn: &DrawnLayer, units: Units) -> Strokes {
    Strokes {
        layer: drawn.layer,
        color: drawn.color,
        width_px: drawn.width_px,
        width_mm: units.px_per_mm.map(|px| drawn.width_px / px),
        opacity: if drawn.is_ghost { GHOST_OPACITY } else { 1.0 },
        polylines: polylines(drawn),
        tips: drawn.tips.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::lines::{HiddenLines, LineSegment, LineTimes};
    use crate::scene::Size;

    /// A visible crease of 90 pixels, and a hidden one below it.
    fn lines() -> VisibleLines {
        let segment = |y: f64, is_visible: bool| LineSegment {
            class: Class::Crease,
            is_visible,
            is_outline: false,
            background: [false; 2],
            is_covered: false,
            ends_px: [DVec2::new(5.0, y), DVec2::new(95.0, y)],
            ends_world: [5.0, 95.0].map(|x| glam::DVec3::new(x, y, 0.0)),
            edge: Some([0, 1]),
            angle_degrees: Some(90.0),
            object: 0,
            part: 0,
            look: 0,
        };
        VisibleLines {
            size: Size { width: 100, height: 100 },
            segments: vec![segment(20.0, true), segment(60.0, false)],
            edges: Default::default(),
            changes: None,
            px_per_mm: None,
            covered_triangles: 0,
            labels: Vec::new(),
            parts: Vec::new(),
            looks: Vec::new(),
            times: LineTimes::default(),
        }
    }

    fn of(hidden: HiddenLines) -> Vec<Strokes> {
        strokes(&lines(), &DrawingSettings { hidden, ..DrawingSettings::default() }).unwrap()
    }

    #[test]
    fn hidden_lines_are_strokes_only_where_they_are_asked_for_and_lie_below() {
        let [visible] = &of(HiddenLines::None)[..] else { panic!("one layer") };
        assert_eq!((visible.layer, visible.width_px, visible.opacity), (Layer::Visible(Class::Crease), 2.0, 1.0));
        assert_eq!(visible.polylines[0].points_px, [DVec2::new(5.0, 20.0), DVec2::new(95.0, 20.0)]);
        let [hidden, above] = &of(HiddenLines::Ghost)[..] else { panic!("two layers") };
        assert_eq!((hidden.layer, hidden.opacity), (Layer::Hidden(Class::Crease), GHOST_OPACITY));
        assert_eq!(above, visible);
    }

    #[test]
    fn dashes_are_strokes_of_their_own_as_long_as_the_file_says() {
        let [hidden, _] = &of(HiddenLines::Dashed)[..] else { panic!("two layers") };
        // One pixel wide: 90 pixels hold eight whole dashes of 6 pixels with gaps of 5, and a dash of 2.
        assert_eq!(hidden.width_px, 1.0);
        let ends = hidden.polylines.iter().map(|dash| [dash.points_px[0].x, dash.points_px[1].x]);
        let expected = (0..9).map(|dash| 5.0 + 11.0 * f64::from(dash)).map(|start| [start, (start + 6.0).min(95.0)]);
        for ([a, b], [from, to]) in ends.clone().zip(expected.clone()) {
            assert!((a - from).abs() < 1e-9 && (b - to).abs() < 1e-9, "{a} to {b} instead of {from} to {to}");
        }
        assert_eq!(ends.count(), expected.count());
    }
}
