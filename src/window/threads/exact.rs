//! Finds and paints the exact lines of the view on a separate thread.
//!
//! Takes a [`LineJob`], all values, and returns strokes to lay over a picture of the same view. It searches one view's lines at a
//! time. If the view changes meanwhile, the search stops where only a picture of the same view can use the lines. Lines drawn
//! alone are finished and shown, then the search for the newest view starts. Strokes keep their ids from view to view, to count
//! how many stayed.

use crate::error::Result;
use crate::lines::{LineSettings, Progress, StrokeIds, Strokes};
use crate::renderer::milliseconds_since;
use crate::request::{Request, Wanted};
use crate::scene::Scene;
use crate::styles::{LineStyle, Show, Style};
use crate::window::threads::line_job::{Found, LineJob, Stayed};
use crate::window::threads::report::{Report, Reporter};
use std::collections::HashSet;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

impl LineJob {
    /// The lines, and how many of their strokes belong to the view before.
    fn find(&self, ids: &Mutex<Option<Kept>>, progress: &Progress) -> Result<(Vec<Strokes>, Stayed)> {
        let scene = self.view.scene()?;
        let drawn = request(&self.style).drawn_lines(scene, Wanted::default(), progress)?;
        let (scene, lines) = (&drawn.scene, &drawn.lines);
        let mut kept = ids.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same = |kept: &Kept| Arc::ptr_eq(&kept.scene, &self.view.scene) && kept.settings == self.style.wanted();
        if !kept.as_ref().is_some_and(is_same) {
            *kept = None;
        }
        let kept = kept.get_or_insert_with(|| Kept {
            scene: self.view.scene.clone(),
            settings: self.style.wanted(),
            ids: StrokeIds::new(scene, &self.style.wanted()),
            strokes: HashSet::new(),
        });
        let strokes: HashSet<u32> = kept.ids.next(scene, lines).iter().filter_map(|path| path.stroke).collect();
        let stayed = strokes.intersection(&kept.strokes).count();
        let stayed = Stayed { count: strokes.len(), new: strokes.len() - stayed, gone: kept.strokes.len() - stayed };
        kept.strokes = strokes;
        // As in the file: a path that ends where a stroke does would restart its dashes.
        Ok((drawn.strokes()?, stayed))
    }
}

/// The strokes of the previous view, with their settings and models.
#[derive(Debug)]
struct Kept {
    scene: Arc<Scene>,
    settings: LineSettings,
    ids: StrokeIds,
    strokes: HashSet<u32>,
}

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
    /// The strokes that the next view's strokes are matched with.
    kept: Arc<Mutex<Option<Kept>>>,
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
        let kept = self.kept.clone();
        let work = move || {
            let start = Instant::now();
            let found = job.find(&kept, &progress);
            let found = found.map(|(strokes, stayed)| Found { ms: milliseconds_since(start), strokes, stayed, job });
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SceneSettings, Size};
    use crate::window::{Job, Orbit};
    use crate::{LoadOptions, load};

    #[test]
    fn strokes_stay_from_view_to_view_until_the_settings_change() {
        let mesh = Arc::new(load("builtin:gear", &LoadOptions::default()).unwrap().mesh);
        let settings = SceneSettings { size: Size { width: 160, height: 160 }, ..SceneSettings::default() };
        let scene = Arc::new(Scene::new(vec![mesh], &settings).unwrap());
        let (mut orbit, kept) = (Orbit::default(), Mutex::new(None));
        let find = |orbit: &Orbit, style: LineStyle| {
            let (scene, orbit, settings) = (scene.clone(), orbit.clone(), settings.clone());
            let view = Job {
                scene,
                orbit,
                settings,
                drawings: Vec::new(),
                lines_over: [None, None],
                is_coarse: false,
                keeps_patches: false,
            };
            LineJob { view, style }.find(&kept, &Progress::default()).unwrap().1
        };
        let first = find(&orbit, LineStyle::default());
        assert!(first.count > 20 && (first.new, first.gone) == (first.count, 0), "{first:?}");
        let same = find(&orbit, LineStyle::default());
        assert_eq!((same.count, same.new, same.gone), (first.count, 0, 0));
        orbit.turn(0.01, 0.0);
        let turned = find(&orbit, LineStyle::default());
        assert!(turned.new * 5 < turned.count && turned.gone * 5 < turned.count, "{turned:?}");
        let mut creases = LineStyle::default();
        creases.lines.classes = crate::edges::ClassSet::of(&[crate::edges::Class::Crease]);
        let other = find(&orbit, creases);
        assert_eq!((other.new, other.gone), (other.count, 0), "other lines are other strokes");
        assert_eq!(turned.text(), format!("{} strokes, {} new, {} gone", turned.count, turned.new, turned.gone));
    }
}
