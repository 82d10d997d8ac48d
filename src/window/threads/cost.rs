//! Each style's frame time and line error, measured while the window is idle.
//!
//! The exact lines of a view take longer than its picture: a separate thread finds them, and gives up as soon as the view
//! changes.

use crate::error::Result;
use crate::lines::Progress;
use crate::renderer::PassTime;
use crate::scene::Scene;
use crate::window::threads::job::Cost;
use crate::window::threads::line_measure::{LineMeasure, LineScore};
use crate::window::threads::report::{Report, Reporter};
use crate::window::values::event::Side;
use std::sync::Arc;

/// The measurements of the shown picture.
#[derive(Debug, Default)]
pub struct Costs {
    /// Each side's style with the times of its passes and its lines' error, if known.
    pub sides: Vec<SideCost>,
    /// All measurements in this view, for the plot.
    pub history: Vec<Point>,
    /// The measurement in progress.
    measuring: Option<Arc<Progress>>,
    number: u64,
}

/// A side's cost.
#[derive(Debug, Clone)]
pub struct SideCost {
    /// The side.
    pub side: Side,
    /// The style's name.
    pub style: &'static str,
    /// A whole frame, from the style's plan to the picture read back, milliseconds by the clock.
    pub frame_ms: f64,
    /// Each pass and its time.
    pub passes: Vec<PassTime>,
    /// Its lines' error; `None` until it is known and for a style without lines.
    pub error: Option<LineScore>,
    /// Whether it draws lines.
    pub has_lines: bool,
}

/// A style's time and error.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The style's name.
    pub style: &'static str,
    /// A whole frame, milliseconds.
    pub ms: f64,
    /// One less F1: 0 where ink and lines are the same.
    pub error: f64,
}

/// Most points kept.
const MOST_POINTS: usize = 64;

impl Costs {
    /// The view has changed: forgets everything and cancels the measurement in progress.
    pub(in crate::window) fn view_changed(&mut self) {
        self.style_changed();
        self.history.clear();
    }

    /// Forgets the styles' measurements; the plot keeps this view's measurements.
    pub(in crate::window) fn style_changed(&mut self) {
        self.sides.clear();
        self.number += 1;
        if let Some(progress) = self.measuring.take() {
            progress.cancel();
        }
    }

    /// The time of a side's frame, milliseconds, if it has been measured.
    pub(crate) fn frame_ms(&self, side: Side) -> Option<f64> {
        self.sides.iter().find(|cost| cost.side == side).map(|cost| cost.frame_ms)
    }

    /// Whether a search for exact lines is running.
    pub(in crate::window) fn is_measuring(&self) -> bool {
        self.measuring.is_some()
    }

    /// Takes a picture's cost and starts to measure its lines.
    pub(crate) fn take(&mut self, scene: Scene, costs: Vec<Cost>, measure: Option<LineMeasure>, reporter: Reporter) {
        self.style_changed();
        let mut inks = Vec::new();
        for Cost { side, style, frame_ms, passes, has_lines, ink } in costs {
            self.sides.push(SideCost { side, style, frame_ms, passes, error: None, has_lines });
            inks.extend(ink.map(|ink| (side, ink)));
        }
        let Some(measure) = measure.filter(|_| !inks.is_empty()) else { return };
        let progress = Arc::new(Progress::default());
        self.measuring = Some(progress.clone());
        let number = self.number;
        let work = move || {
            // Cancelled, or a scene without lines: the result is empty.
            let errors = errors(measure, &scene, inks, &progress).unwrap_or_default();
            reporter.say(Report::Measured(number, errors));
        };
        if std::thread::Builder::new().name("measuring".to_owned()).spawn(work).is_err() {
            self.measuring = None;
        }
    }

    /// Takes the measurements, unless the view has changed since.
    pub(crate) fn measured(&mut self, number: u64, errors: Vec<(Side, LineScore)>) {
        if number != self.number {
            return;
        }
        self.measuring = None;
        for (side, error) in errors {
            if let Some(side_cost) = self.sides.iter_mut().find(|side_cost| side_cost.side == side) {
                let point = Point { style: side_cost.style, ms: side_cost.frame_ms, error: 1.0 - error.f1 };
                self.history.push(point);
                side_cost.error = Some(error);
            }
        }
        let surplus = self.history.len().saturating_sub(MOST_POINTS);
        self.history.drain(..surplus);
    }
}

fn errors(
    measure: LineMeasure,
    scene: &Scene,
    inks: Vec<(Side, Vec<u8>)>,
    progress: &Progress,
) -> Result<Vec<(Side, LineScore)>> {
    let (sides, inks): (Vec<Side>, Vec<Vec<u8>>) = inks.into_iter().unzip();
    Ok(sides.into_iter().zip((measure.scores)(scene, inks, progress)?).collect())
}
