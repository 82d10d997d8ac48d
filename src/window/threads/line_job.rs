//! The requested exact lines and the found ones: values that the viewer and its line thread exchange.

use crate::lines::{Raster, Strokes, raster_of_strokes};
use crate::picture::Picture;
use crate::styles::LineStyle;
use crate::window::threads::job::Job;

/// The requested lines and how to draw them.
#[derive(Debug, Clone)]
pub struct LineJob {
    /// The view; other contents of the job do not matter.
    pub view: Job,
    /// The lines and their appearance.
    pub style: LineStyle,
}

/// How the strokes of a view are those of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stayed {
    /// Strokes in this view.
    pub count: usize,
    /// The number of these that are new in this view; all in a first view.
    pub new: usize,
    /// Those of the one before that are not in this one.
    pub gone: usize,
}

impl Stayed {
    /// For the panel.
    pub(in crate::window) fn text(self) -> String {
        let Self { count, new, gone } = self;
        format!("{count} strokes, {new} new, {gone} gone")
    }
}

/// Lines that were found.
#[derive(Debug)]
pub struct Found {
    /// The job that they belong to.
    pub job: LineJob,
    /// The lines.
    pub strokes: Vec<Strokes>,
    /// How many of their strokes are those of the view before.
    pub stayed: Stayed,
    /// Time taken, milliseconds.
    pub ms: f64,
}

impl Found {
    /// The lines alone as a picture.
    pub fn alone(&self) -> Picture {
        let settings = &self.job.view.settings;
        let Raster { size, pixels } = raster_of_strokes(&self.strokes, settings.size, settings.background);
        Picture { size, pixels }
    }
}

impl LineJob {
    /// Whether it would draw the same as another.
    pub fn is_same(&self, other: &Self) -> bool {
        self.style == other.style && self.view.is_of_same_picture(&other.view)
    }
}
