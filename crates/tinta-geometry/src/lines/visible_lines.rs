//! The lines of a scene, as they were found.

use super::segment::LineSegment;
use crate::edges::ClassCounts;
use crate::error::{Error, Result};
use crate::lines::smooth::visibility_events::VisibilityChanges;
use crate::scene::Size;
use serde::Serialize;

/// The lines of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleLines {
    /// The picture's size.
    pub size: Size,
    /// All pieces with any length inside the picture and between the near and the far plane, in a stable order: by
    /// object, then edge, then along it; then intersections, then form lines, then smooth contours, by object and face.
    pub segments: Vec<LineSegment>,
    /// How many edges there are of each class, each counted in its first one.
    pub edges: ClassCounts,
    /// How many triangles others cover in one plane, as in models made to be seen from both sides; each region counts once.
    pub covered_triangles: usize,
    /// Where along silhouettes what is seen begins and ends, if that was asked for.
    pub changes: Option<VisibilityChanges>,
    /// How many lines are missing because the time was over before they were decided: none but after
    /// [`Progress::within_or_part`](super::Progress::within_or_part). What is there is as in the whole.
    pub undecided: usize,
    /// Whether the time was over before what is too short to be a line was left out, so that all of it is there: not but after
    /// [`Progress::within_or_part`](super::Progress::within_or_part) and [`VisibleLines::without_specks_with_progress`].
    pub has_specks: bool,
    /// How it went.
    pub times: LineTimes,
}

/// Milliseconds of the clock, and what they went by.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct LineTimes {
    /// Mending, edge list, classes that do not depend on the view, the faces' hierarchy.
    pub topology_ms: f64,
    /// Which faces are seen from which side, and the edges between them.
    pub silhouette_ms: f64,
    /// Intersections, cuts and rays.
    pub visibility_ms: f64,
    /// Boxes of faces, lines and groups of them that were looked at for that: the same on every machine for the same scene.
    pub compared: u64,
}

impl VisibleLines {
    /// What files say of lines of which some are missing, see [`VisibleLines::undecided`], or specks are left.
    pub fn partial_note(&self) -> Option<String> {
        let lines = if self.undecided == 1 { "1 line was" } else { &format!("{} lines were", self.undecided) };
        let specks = "specks were left out";
        let before = match (self.undecided > 0, self.has_specks) {
            (false, false) => return None,
            (true, false) => format!("{lines} decided"),
            (false, true) => specks.to_string(),
            (true, true) => format!("{lines} decided and {specks}"),
        };
        Some(format!("partial: the time was over before {before}"))
    }

    /// Refuses lines that no drawing can hold: not finite, or outside the picture.
    pub fn check(&self) -> Result<()> {
        let limits = [self.size.width, self.size.height].map(f64::from);
        // What rounds to the border is on it.
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
