//! The visible and hidden lines of a scene.

use super::labels::Label;
use super::parts::scene_parts::ScenePart;
use super::parts::style::PartStyle;
use super::segment::LineSegment;
use crate::edges::ClassCounts;
use crate::error::{Error, Result};
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::smooth::visibility_events::VisibilityChanges;
use crate::scene::Size;
use serde::Serialize;
use std::borrow::Cow;

/// The visible and hidden lines of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VisibleLines {
    /// The picture's size, pixels.
    pub size: Size,
    /// All segments that have length inside the picture and between the near and far planes. The order is stable: by
    /// object, then edge, then along the edge; then intersections, form lines and smooth contours, by object and
    /// face.
    pub segments: Vec<LineSegment>,
    /// The labels of points inside the picture, in the points' order.
    pub labels: Vec<Label>,
    /// The parts of the models: their names and styles.
    pub parts: Vec<ScenePart>,
    /// The different styles of parts; the first is that of parts without a rule.
    pub looks: Vec<PartStyle>,
    /// Number of edges in each class; an edge counts in the first of its classes.
    pub edges: ClassCounts,
    /// Number of triangles covered by coplanar ones, as in models made to be seen from both sides; each region counts
    /// once.
    pub covered_triangles: usize,
    /// Where along silhouettes visibility begins and ends, if
    /// [`LineSettings::counts_changes`](super::LineSettings::counts_changes) is set.
    pub changes: Option<VisibilityChanges>,
    /// Pixels of a millimetre on paper, of a drawing to scale.
    pub px_per_mm: Option<f64>,
    /// Time and work of each step.
    pub times: LineTimes,
}

/// Wall-clock times in milliseconds, and the work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct LineTimes {
    /// Repair, edge list, view-independent classes, and the hierarchy of faces.
    pub topology_ms: f64,
    /// Front and back faces, and the edges between them.
    pub silhouette_ms: f64,
    /// Intersections, cuts and rays.
    pub visibility_ms: f64,
    /// Bounding boxes of faces, lines and groups tested for visibility: the same on every machine for the same scene.
    pub compared: u64,
}

impl VisibleLines {
    /// Returns no lines in a picture of this size.
    pub fn none(size: Size) -> Self {
        Self { size, ..Self::default() }
    }

    /// The settings of a drawing for lines of a style, by its number in `looks`.
    pub fn drawing<'d>(&self, look: u32, drawing: &'d DrawingSettings) -> Cow<'d, DrawingSettings> {
        self.looks.get(look as usize).map_or(Cow::Borrowed(drawing), |look| look.drawing(drawing))
    }

    /// The settings of a drawing for each style; at least one.
    pub(in crate::lines) fn drawings<'d>(&self, drawing: &'d DrawingSettings) -> Vec<Cow<'d, DrawingSettings>> {
        (0..self.looks.len().max(1) as u32).map(|look| self.drawing(look, drawing)).collect()
    }

    /// Refuses lines that cannot be drawn: not finite, or outside the picture.
    pub fn check(&self) -> Result<()> {
        let limits = [self.size.width, self.size.height].map(f64::from);
        // Values that round to the border count as on it.
        let is_inside = |value: f64, limit: f64| value > -5e-4 && value < limit + 5e-4;
        for (number, segment) in self.segments.iter().enumerate() {
            let mut points = segment.ends_px.iter();
            let is_drawable = points.all(|point| is_inside(point.x, limits[0]) && is_inside(point.y, limits[1]));
            if !is_drawable || segment.angle_degrees.is_some_and(|angle| !angle.is_finite()) {
                let [a, b] = segment.ends_px;
                return Err(Error::Lines {
                    problem: format!(
                        "line {number} from {a} to {b}: it is not a number or leaves the picture; this is a bug in \
                         tinta: report it with the model"
                    ),
                });
            }
        }
        Ok(())
    }
}
