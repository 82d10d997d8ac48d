//! The exact lines of the view, found and painted on a thread of their own.
//!
//! In: a [`LineJob`], all values. Out: ink to be laid over a picture of the same view. One view's lines are looked for at a time.
//! When the view changes meanwhile they are given up if only a picture of the same view can take them; lines that are a picture
//! by themselves are finished and shown, and those of the newest view are next.

use super::draw::Job;
use super::line_style::LineStyle;
use super::paint::{over, painted};
use super::report::{Report, Reporter};
use crate::error::Result;
use crate::lines::{Progress, VisibleLines, strokes};
use crate::picture::Picture;
use crate::renderer::milliseconds_since;
use crate::scene::{Scene, SceneSettings, Size};
use std::sync::Arc;
use std::time::Instant;

/// Whose lines are wanted, drawn how.
#[derive(Debug, Clone)]
pub struct LineJob {
    /// The view; what else is drawn of it does not matter.
    pub view: Job,
    /// Which lines, and how they look.
    pub style: LineStyle,
}

impl LineJob {
    /// Whether it would draw the same as another.
    pub fn is_same(&self, other: &Self) -> bool {
        self.style == other.style && self.view.is_of_same_picture(&other.view)
    }

    fn ink(&self, progress: &Progress) -> Result<Picture> {
        ink(&self.view.scene()?, &self.style, progress)
    }
}

/// A scene's lines on nothing.
///
/// # Errors
///
/// As [`VisibleLines::with_progress`] and [`strokes`].
pub(super) fn ink(scene: &Scene, style: &LineStyle, progress: &Progress) -> Result<Picture> {
    let lines = VisibleLines::with_progress(scene, &style.wanted(), progress)?;
    Ok(painted(&strokes(&lines, &style.drawing)?, scene.size))
}

/// Lines that were found.
#[derive(Debug)]
pub struct Found {
    /// Whose they are.
    pub job: LineJob,
    /// They on nothing.
    pub ink: Picture,
    /// What that took, milliseconds.
    pub ms: f64,
}

impl Found {
    /// They as a picture by themselves.
    pub fn alone(&self) -> Picture {
        over(&self.ink, &ground(self.ink.size, &self.job.view.settings))
    }
}

/// What is behind lines that are a picture by themselves.
pub(super) fn ground(size: Size, settings: &SceneSettings) -> Picture {
    let pixel = settings.background.clear_color().map(|channel| (channel * 255.0).round() as u8);
    Picture { size, pixels: pixel.repeat(size.pixel_count()) }
}

/// The lines of the view that is shown.
#[derive(Debug, Default)]
pub struct ExactLines {
    found: Option<Found>,
    /// Whose lines are being looked for.
    finding: Option<(LineJob, Arc<Progress>)>,
    /// Whose cannot be found, and why.
    refused: Option<(LineJob, String)>,
    /// Counts what was found.
    pub number: u64,
}

impl ExactLines {
    /// The last that were found.
    pub fn found(&self) -> Option<&Found> {
        self.found.as_ref()
    }

    /// Whether lines are being looked for.
    pub fn is_finding(&self) -> bool {
        self.finding.is_some()
    }

    /// Whether these lines are there, are being looked for, or cannot be found.
    pub fn is_begun(&self, job: &LineJob) -> bool {
        let found = self.found.as_ref().map(|found| &found.job);
        let finding = self.finding.as_ref().map(|(job, _)| job);
        let refused = self.refused.as_ref().map(|(job, _)| job);
        [found, finding, refused].into_iter().flatten().any(|begun| begun.is_same(job))
    }

    /// Why lines that were wanted are not there.
    pub fn problem(&self) -> Option<&str> {
        self.refused.as_ref().map(|(_, problem)| problem.as_str())
    }

    /// Wants these lines or none. `is_picture`: they are shown by themselves, so that those of a view before are worth having.
    pub fn ask(&mut self, wanted: Option<LineJob>, is_picture: bool, reporter: &Reporter) {
        let is_wanted = |job: &LineJob| wanted.as_ref().is_some_and(|wanted| wanted.is_same(job));
        if !self.refused.as_ref().is_some_and(|(job, _)| is_wanted(job)) {
            self.refused = None;
        }
        if let Some((job, progress)) = &self.finding {
            // Its thread says so when it has ended.
            if !is_wanted(job) && (!is_picture || wanted.is_none()) {
                progress.cancel();
            }
            return;
        }
        let is_known = self.found.as_ref().is_some_and(|found| is_wanted(&found.job)) || self.refused.is_some();
        if let (Some(job), false) = (wanted, is_known) {
            self.start(job, reporter.clone());
        }
    }

    fn start(&mut self, job: LineJob, reporter: Reporter) {
        let progress = Arc::new(Progress::default());
        self.finding = Some((job.clone(), progress.clone()));
        let work = move || {
            let start = Instant::now();
            let found = job.ink(&progress).map(|ink| Found { ms: milliseconds_since(start), ink, job });
            reporter.say(Report::Lines(Box::new(found)));
        };
        if let Err(error) = std::thread::Builder::new().name("lines".to_owned()).spawn(work) {
            let problem = format!("no thread to find lines on could be started ({error}); close other programs");
            self.refused = self.finding.take().map(|(job, _)| (job, problem));
        }
    }

    /// Takes what a thread has found.
    pub fn take(&mut self, found: Result<Found>) {
        let Some((job, progress)) = self.finding.take() else { return };
        match found {
            Ok(found) => {
                self.found = Some(found);
                self.number += 1;
            }
            Err(_) if progress.is_cancelled() => {}
            Err(error) => self.refused = Some((job, error.to_string())),
        }
    }

    /// Gives up what is going on.
    pub fn cancel(&self) {
        if let Some((_, progress)) = &self.finding {
            progress.cancel();
        }
    }
}
