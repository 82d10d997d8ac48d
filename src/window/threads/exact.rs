//! Finds the exact lines of the view, and strokes that stand for tones, on a separate thread.
//!
//! Takes a [`Job`], all values, and returns what lies around its pictures, or lines alone as pictures. It searches one view at a
//! time. If the view changes meanwhile, the search stops where only a picture of the same view can use the lines. Lines drawn
//! alone are finished and shown, then the search for the newest view starts.

use crate::error::Result;
use crate::lines::{Progress, Raster, raster_of_strokes};
use crate::picture::Picture;
use crate::renderer::milliseconds_since;
use crate::request::Request;
use crate::styles::Style;
use crate::window::threads::job::{FoundLines, Job, Lines};
use crate::window::threads::report::{Report, Reporter};
use std::sync::Arc;
use std::time::Instant;

/// Finds the lines of a job.
fn find(job: &Job, progress: &Progress) -> Result<FoundLines> {
    let (start, scene) = (Instant::now(), job.scene()?);
    let mut lines: Vec<Lines> = Vec::new();
    for (number, (_, drawing)) in job.drawings.iter().enumerate() {
        // Two sides of the same lines need one search.
        let known = job.drawings[..number].iter().position(|(_, other)| other == drawing);
        lines.push(match known {
            Some(known) => lines[known].clone(),
            None => of_request(job.request(drawing), scene.clone(), progress)?,
        });
    }
    Ok(FoundLines { ms: milliseconds_since(start), lines, job: job.clone() })
}

fn of_request(mut request: Request, scene: crate::scene::Scene, progress: &Progress) -> Result<Lines> {
    let Style::Lines(style) = &mut request.style else {
        return Ok(Lines::Around(Arc::new(request.still(scene, false)?.around(progress)?)));
    };
    style.areas = None;
    let view = request.still(scene, false)?;
    // As in the file: a path that ends where a stroke does would restart its dashes.
    let strokes = view.drawn_lines(Default::default(), progress)?.strokes()?;
    let Raster { size, pixels } = raster_of_strokes(&strokes, view.scene.size, view.scene.background);
    Ok(Lines::Alone(Picture { size, pixels }))
}

/// The lines of the view that is shown.
#[derive(Debug, Default)]
pub struct ExactLines {
    found: Option<FoundLines>,
    /// The current search.
    finding: Option<(Job, Arc<Progress>)>,
    /// The lines that failed, and why.
    refused: Option<(Job, String)>,
}

impl ExactLines {
    /// The last that were found.
    pub(crate) fn found(&self) -> Option<&FoundLines> {
        self.found.as_ref()
    }

    /// Whether a search for lines is running.
    pub(in crate::window) fn is_finding(&self) -> bool {
        self.finding.is_some()
    }

    /// Whether these lines are found, being found, or failed.
    pub(in crate::window) fn is_begun(&self, job: &Job) -> bool {
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
    pub(crate) fn ask(&mut self, wanted: Option<Job>, is_picture: bool, reporter: &Reporter) {
        let is_wanted = |job: &Job| wanted.as_ref().is_some_and(|wanted| wanted.is_same(job));
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

    fn start(&mut self, job: Job, reporter: Reporter) {
        let progress = Arc::new(Progress::default());
        self.finding = Some((job.clone(), progress.clone()));
        let work = move || reporter.say(Report::Lines(Box::new(find(&job, &progress))));
        if let Err(error) = std::thread::Builder::new().name("lines".to_owned()).spawn(work) {
            let problem = format!("no thread to find lines on could be started ({error}); close other programs");
            self.refused = self.finding.take().map(|(job, _)| (job, problem));
        }
    }

    /// Takes a thread's result.
    pub(crate) fn take(&mut self, found: Result<FoundLines>) {
        let Some((job, progress)) = self.finding.take() else { return };
        match found {
            Ok(found) => self.found = Some(found),
            Err(_) if progress.is_cancelled() => {}
            Err(error) => self.refused = Some((job, error.to_string())),
        }
    }

    /// Cancels the running search.
    pub(crate) fn cancel(&self) {
        if let Some((_, progress)) = &self.finding {
            progress.cancel();
        }
    }
}
