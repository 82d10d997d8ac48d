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

/// Lines that were found.
#[derive(Debug)]
pub struct Found {
    /// The job that they belong to.
    pub job: LineJob,
    /// The lines.
    pub strokes: Vec<Strokes>,
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
