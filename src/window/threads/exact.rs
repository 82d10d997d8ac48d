//! Finds and paints the exact lines of the view on a separate thread.
//!
//! Takes a [`LineJob`], all values, and returns strokes to lay over a picture of the same view. It searches one view's lines at a
//! time. If the view changes meanwhile, the search stops where only a picture of the same view can use the lines. Lines drawn
//! alone are finished and shown, then the search for the newest view starts.

use crate::error::Result;
use crate::lines::Progress;
use crate::renderer::milliseconds_since;
use crate::request::{Request, Wanted};
use crate::styles::{LineStyle, Show, Style};
use crate::window::threads::line_job::{Found, LineJob};
use crate::window::threads::report::{Report, Reporter};
use std::sync::Arc;
use std::time::Instant;

/// The request of the command line's drawing of these lines.
pub(in crate::window) fn request(style: &LineStyle) -> Request {
    Request::of_picture(&Style::Lines(LineStyle { areas: None, ..style.clone() }), Show::Final)
}

/// The lines of the view that is shown.
#[derive(Debug, Default)]
pub struct ExactLines {
    found: Option<Found>,
    /// The current search.
    finding: Option<(LineJob, Arc<Progress>)>,
    /// The lines that failed, and why.
    refused: Option<(LineJob, String)>,
    /// Counts the results.
    pub number: u64,
}

impl ExactLines {
    /// The last that were found.
    pub fn found(&self) -> Option<&Found> {
        self.found.as_ref()
    }

    /// Whether a search for lines is running.
    pub(in crate::window) fn is_finding(&self) -> bool {
        self.finding.is_some()
    }

    /// Whether these lines are found, being found, or failed.
    pub(in crate::window) fn is_begun(&self, job: &LineJob) -> bool {
        let found = self.found.as_ref().map(|found| &found.job);
        let finding = self.finding.as_ref().map(|(job, _)| job);
        let refused = self.refused.as_ref().map(|(job, _)| job);
        [found, finding, refused].into_iter().flatten().any(|begun| begun.is_same(job))
    }

    /// The reason why requested lines are missing.
    pub fn problem(&self) -> Option<&str> {
        self.refused.as_ref().map(|(_, problem)| problem.as_str())
    }

    /// Requests these lines, or none. `is_picture` means that they are shown alone, and that those of a previous view are useful
    /// too.
    pub fn ask(&mut self, wanted: Option<LineJob>, is_picture: bool, reporter: &Reporter) {
        let is_wanted = |job: &LineJob| wanted.as_ref().is_some_and(|wanted| wanted.is_same(job));
        if !self.refused.as_ref().is_some_and(|(job, _)| is_wanted(job)) {
            self.refused = None;
        }
        if let Some((job, progress)) = &self.finding {
            // Its thread reports its end.
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
            // As in the file: a path that ends where a stroke does would restart its dashes.
            let strokes = job.view.scene().and_then(|scene| {
                request(&job.style).still(scene, true)?.drawn_lines(Wanted::default(), &progress)?.strokes()
            });
            let found = strokes.map(|strokes| Found { ms: milliseconds_since(start), strokes, job });
            reporter.say(Report::Lines(Box::new(found)));
        };
        if let Err(error) = std::thread::Builder::new().name("lines".to_owned()).spawn(work) {
            let problem = format!("no thread to find lines on could be started ({error}); close other programs");
            self.refused = self.finding.take().map(|(job, _)| (job, problem));
        }
    }

    /// Takes a thread's result.
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

    /// Cancels the running search.
    pub fn cancel(&self) {
        if let Some((_, progress)) = &self.finding {
            progress.cancel();
        }
    }
}
