//! The viewer without its window: the state, its worker threads, and their latest results.
//!
//! The window calls [`Viewer::take_reports`] when it wakes, hands over events, and paints the result. Each drawing thread draws
//! one picture. When the picture is finished and outdated, the thread gets the next job. The newest request is always at most one
//! picture away, and no thread draws while the state stays the same.

use crate::error::{Error, Result};
use crate::gl::{Backend, ContextInfo};
use crate::picture::Picture;
use crate::request::{LINES_AT_ONCE_MS, Request};
use crate::scene::Scene;
use crate::styles::Show;
use crate::window::threads::cost::Costs;
use crate::window::threads::exact::ExactLines;
use crate::window::threads::explain::{PixelAnswer, PixelJob};
use crate::window::threads::job::{Drawing, Job, Lines};
use crate::window::threads::line_measure::LineMeasure;
use crate::window::threads::load::Loader;
use crate::window::threads::render_threads::{LostThread, RenderThreads};
use crate::window::threads::report::{LoadedModels, Stage};
use crate::window::threads::report::{Report, Reporter};
use crate::window::threads::save::{Surroundings, save};
use crate::window::threads::watch;
use crate::window::values::compose::composed;
use crate::window::values::event::{Effect, Save, Side, ViewerEvent};
use crate::window::values::line_style::LinesShown;
use crate::window::values::state::ViewerState;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// How the viewer is started.
#[derive(Debug, Clone)]
pub struct ViewerOptions {
    /// The first state; its models are read at once.
    pub state: ViewerState,
    /// The OpenGL backend for the pictures; the window has another.
    pub backend: Backend,
    /// A folder laid out like `glsl/` with the shaders to use, reloaded when they change.
    pub shaders: Option<PathBuf>,
    /// Where files are written.
    pub folder: PathBuf,
    /// How lines are measured. Without one their error is not shown.
    pub line_measure: Option<LineMeasure>,
}

/// The viewer.
pub struct Viewer {
    /// The shown state.
    pub state: ViewerState,
    /// The cost of the shown styles.
    pub costs: Costs,
    /// The exact lines of the view, where a side shows them.
    pub lines: ExactLines,
    /// The pixel under the pointer.
    pub explained: PixelAnswer,
    /// The current stage of loading.
    pub stage: Option<Stage>,
    /// A shader that was refused, with the driver's log.
    pub shader_log: Option<String>,
    /// The current problem with the models or the picture.
    pub problem: Option<String>,
    /// Whether the user is moving the view just now.
    pub is_moving: bool,
    surroundings: Surroundings,
    line_measure: Option<LineMeasure>,
    scene: Option<Arc<Scene>>,
    drawings: Vec<Drawing>,
    /// Counts changes of the picture; a window compares it to know when to repaint.
    pub picture_number: u64,
    /// The job that the drawings are of.
    drawn: Option<Job>,
    /// Its number.
    drawn_number: u64,
    is_pricing: bool,
    reporter: Reporter,
    reports: Receiver<Report>,
    render_threads: RenderThreads,
    /// Those that write files.
    saving_threads: Vec<JoinHandle<()>>,
    loader: Loader,
    watched: Sender<Vec<PathBuf>>,
    loads_going_on: u64,
    /// The drawing threads' final error, after they ended.
    gone: Option<Error>,
}

impl std::fmt::Debug for Viewer {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Viewer").field("state", &self.state).finish_non_exhaustive()
    }
}

/// The option of strokes that stand for tones.
const HATCH: &str = "hatch";

/// The message where the dialogue gave no file, as it does at once where the system has none.
const NOTHING_CHOSEN: &str = "no file was chosen; if no dialogue appeared, type the path, or install zenity";

impl Viewer {
    /// Starts the threads and reads the models; `wake` is called from them when there is news.
    ///
    /// # Errors
    ///
    /// [`Error::Gl`] when the system cannot start a thread.
    pub fn start(options: ViewerOptions, wake: impl Fn() + Send + Sync + 'static) -> Result<Self> {
        let no_thread = |error: std::io::Error| Error::gl("starting the window's threads", error.to_string());
        let (sender, reports) = channel();
        let reporter = Reporter::new(sender, wake);
        let mut render_threads = RenderThreads::start(options.backend, reporter.clone()).map_err(no_thread)?;
        if let Some(folder) = &options.shaders {
            // One that has ended will say why.
            let _ = render_threads.replace_shaders(crate::glsl::in_folder(folder));
        }
        let watched = watch::start(options.shaders.clone(), reporter.clone()).map_err(no_thread)?;
        let loader = Loader::new(reporter.clone());
        let surroundings = Surroundings {
            load: options.state.requests[0].read.clone(),
            backend: options.backend,
            folder: options.folder,
            files: Vec::new(),
            context: None,
            names: Default::default(),
        };
        let mut viewer = Self {
            state: options.state,
            costs: Costs::default(),
            lines: ExactLines::default(),
            explained: PixelAnswer::default(),
            stage: None,
            shader_log: None,
            problem: None,
            is_moving: false,
            surroundings,
            line_measure: options.line_measure,
            scene: None,
            drawings: Vec::new(),
            picture_number: 0,
            drawn: None,
            drawn_number: 0,
            is_pricing: false,
            reporter,
            reports,
            render_threads,
            saving_threads: Vec::new(),
            loader,
            watched,
            loads_going_on: 0,
            gone: None,
        };
        viewer.open(viewer.state.models.clone());
        Ok(viewer)
    }

    /// Applies an event and returns its effect outside the viewer.
    pub fn event(&mut self, event: ViewerEvent) -> Option<Effect> {
        if event == ViewerEvent::Dismiss {
            (self.problem, self.shader_log) = (None, None);
        }
        let effect = self.state.update(event);
        match effect {
            Some(Effect::Open(models)) => self.open(models),
            Some(Effect::Browse) => crate::window::threads::dialogue::choose(&self.state.models, self.reporter.clone()),
            Some(Effect::Save(kind)) => self.save(kind),
            effect @ Some(Effect::FullScreen(_) | Effect::Quit) => return effect,
            None => {}
        }
        None
    }

    /// Whether a sentence covers the picture that [`ViewerEvent::Dismiss`] takes away.
    pub(in crate::window) fn has_problem(&self) -> bool {
        self.problem.is_some() || self.shader_log.is_some()
    }

    /// Takes the threads' reports; returns whether it received any.
    ///
    /// # Errors
    ///
    /// The error that keeps the drawing thread from drawing at all.
    pub(crate) fn take_reports(&mut self) -> Result<bool> {
        let mut is_news = false;
        while let Ok(report) = self.reports.try_recv() {
            self.take(report);
            is_news = true;
        }
        self.gone.take().map_or(Ok(is_news), Err)
    }

    /// Waits for news and takes them, for recordings that are played step by step.
    ///
    /// # Errors
    ///
    /// As [`Viewer::take_reports`].
    pub fn wait(&mut self) -> Result<()> {
        if let Ok(report) = self.reports.recv() {
            self.take(report);
        }
        self.take_reports().map(drop)
    }

    /// Waits until all that was started is done and the picture of the state is there.
    ///
    /// # Errors
    ///
    /// As [`Viewer::take_reports`].
    pub fn rest(&mut self) -> Result<()> {
        self.take_reports()?;
        self.ask();
        while !self.is_at_rest() {
            self.wait()?;
            self.ask();
        }
        Ok(())
    }

    /// Requests the picture of the state if it is missing, and otherwise its cost. Call it after events.
    pub fn ask(&mut self) {
        let Some(job) = self.job() else { return };
        let is_picture = self.shows(LinesShown::Alone);
        self.lines.ask(self.line_job(&job), is_picture, &self.reporter);
        if let Some(pixel) = self.explained.next(self.pixel_job(&job)) {
            let sent = self.render_threads.explain(pixel);
            self.check(sent);
        }
        if !self.is_pricing {
            self.ask_for_drawings(job);
        }
    }

    fn ask_for_drawings(&mut self, job: Job) {
        let newest = self.render_threads.newest();
        let is_asked = newest.or(self.drawn.as_ref()).is_some_and(|newest| newest.does_for(&job));
        let sent = if !is_asked {
            // Other models, and pictures of another size, come one by one.
            let is_moving = newest.zip(self.drawn.as_ref()).is_some_and(|(newest, drawn)| {
                [newest, drawn].iter().all(|other| other.is_of_same_scene_and_size(&job))
            });
            self.render_threads.draw(job, is_moving)
        } else if newest.is_none()
            && self.state.has_price
            && !job.drawings.is_empty()
            && !job.is_coarse
            && self.costs.sides.is_empty()
            && self.problem.is_none()
        {
            self.is_pricing = true;
            self.render_threads.measure_cost(job, self.line_measure)
        } else {
            Ok(())
        };
        self.check(sent);
    }

    /// Whether the state's picture is finished or being drawn, and likewise any lines shown alone.
    pub fn is_asked(&self) -> bool {
        let Some(job) = self.job() else { return true };
        let newest = self.render_threads.newest().or(self.drawn.as_ref());
        let has_lines = || self.line_job(&job).is_none_or(|lines| self.lines.is_begun(&lines));
        newest.is_some_and(|newest| newest.does_for(&job)) && (!self.shows(LinesShown::Alone) || has_lines())
    }

    /// Whether a picture is being drawn.
    pub(in crate::window) fn is_drawing(&self) -> bool {
        self.render_threads.newest().is_some()
    }

    /// Whether the viewer is idle: no reading, drawing or measuring.
    pub(in crate::window) fn is_at_rest(&self) -> bool {
        let is_working = self.is_drawing() || self.is_pricing || self.costs.is_measuring() || self.lines.is_finding();
        let is_working = is_working || self.explained.is_asking();
        self.loads_going_on == 0 && !is_working
    }

    /// A side's picture, with the exact lines if it shows them.
    pub(crate) fn picture(&self, side: Side) -> Option<&Picture> {
        match self.lines.found().and_then(|found| found.of_side(side)) {
            Some((_, Lines::Alone(alone))) if self.state.lines_shown(side) == LinesShown::Alone => Some(alone),
            _ => self.drawing(side).map(|drawing| &drawing.picture),
        }
    }

    /// A side's picture by its style, with the time it took.
    pub(crate) fn drawing(&self, side: Side) -> Option<&Drawing> {
        self.drawings.iter().find(|drawing| drawing.side == side)
    }

    /// The drawing area as shown, once a picture exists.
    pub fn shown(&self) -> Option<Picture> {
        composed(&self.state, |side| self.picture(side).cloned())
    }

    /// The drawing context's own description.
    pub fn context(&self) -> Option<&ContextInfo> {
        self.surroundings.context.as_deref()
    }

    /// The models' triangles.
    pub fn triangle_count(&self) -> Option<usize> {
        self.scene.as_ref().map(|scene| scene.triangle_count())
    }

    /// The drawing job of the state.
    pub(crate) fn job(&self) -> Option<Job> {
        let mut job = Job {
            scene: self.scene.clone()?,
            orbit: self.state.orbit.clone(),
            settings: self.state.scene_settings(),
            drawings: Vec::new(),
            has_strokes: [false; 2],
            found: [None, None],
            is_coarse: self.is_moving && self.state.is_coarse_while_moving,
            keeps_patches: false,
        };
        for side in self.state.sides() {
            let (mut drawn, shown) = (self.state.drawn(*side), self.state.lines_shown(*side));
            if shown == LinesShown::Alone {
                continue;
            }
            let found = self.lines.found().filter(|found| Arc::ptr_eq(&found.job.scene, &job.scene));
            match found.and_then(|found| Some((found, found.of_side(*side)?))) {
                Some((found, (request, Lines::Around(around)))) if *request == drawn => {
                    let is_of_view = found.job.is_of_same_picture(&job);
                    job.has_strokes[*side as usize] = is_of_view || found.ms < LINES_AT_ONCE_MS;
                    job.found[*side as usize] = is_of_view.then(|| around.clone());
                    // They have the size of a fine picture.
                    job.is_coarse &= !is_of_view;
                }
                _ => {}
            }
            if !job.has_strokes[*side as usize] {
                // Until slow strokes are found, tones stand for themselves, without the style's own borders, which would flicker.
                drawn.options.remove(HATCH);
            }
            job.keeps_patches |= self.is_moving && drawn.style.far_tones().is_some();
            job.drawings.push((*side, drawn));
        }
        Some(job)
    }

    /// The pixel to explain: a side's finished picture of the style that it shows, if that has shaders.
    fn pixel_job(&self, view: &Job) -> Option<PixelJob> {
        let (side, pixel) = self.state.pointed.filter(|_| self.state.explains && !self.is_moving)?;
        let size = view.settings.size;
        let has_it = pixel[0] < size.width && pixel[1] < size.height;
        let (_, request) = view.drawings.iter().find(|(drawn, _)| *drawn == side)?;
        let mut request = Request { show: Show::Final, ..request.clone() };
        request.options.remove(HATCH);
        has_it.then(|| PixelJob { view: view.of(vec![(side, request)]), pixel })
    }

    /// The lines to find: those of the sides that show them.
    fn line_job(&self, job: &Job) -> Option<Job> {
        // Lines that are drawn at once with the picture need no search of their own while the model moves.
        let is_wanted = |side: &&Side| match self.state.lines_shown(**side) {
            LinesShown::None => false,
            LinesShown::Over => !(self.is_moving && job.has_strokes[**side as usize]),
            LinesShown::Alone => true,
        };
        let drawings: Vec<_> =
            self.state.sides().iter().filter(is_wanted).map(|side| (*side, self.state.drawn(*side))).collect();
        (!drawings.is_empty()).then(|| job.of(drawings))
    }

    /// Whether a side that is seen shows this of the exact lines.
    fn shows(&self, lines: LinesShown) -> bool {
        self.state.sides().iter().any(|side| self.state.lines_shown(*side) == lines)
    }

    /// The command lines that draw the active side: its style's picture, its exact lines.
    pub fn commands(&self) -> Vec<std::result::Result<String, String>> {
        let Some(job) = self.job() else { return Vec::new() };
        let command = |save: Save, output: &str| {
            let (state, side) = (&self.state, self.state.active);
            let command = crate::window::threads::save::command(state, &job, &self.surroundings, save, side, output);
            command.map_err(|error| error.to_string())
        };
        let (picture, lines) = ((Save::Picture, "drawing.png"), (Save::Lines, "drawing.svg"));
        let made_of = match self.state.lines_shown(self.state.active) {
            LinesShown::None => vec![picture],
            LinesShown::Over => vec![picture, lines],
            LinesShown::Alone => vec![lines],
        };
        made_of.into_iter().map(|(save, output)| command(save, output)).collect()
    }

    fn check(&mut self, sent: std::result::Result<(), LostThread>) {
        if sent.is_err() && self.gone.is_none() {
            self.gone = Some(Error::gl("drawing", "a drawing thread has ended"));
        }
    }

    fn open(&mut self, models: Vec<String>) {
        self.loads_going_on += 1;
        self.stage = Some(Stage { text: "starting to read".to_owned(), share: 0.0 });
        let (read, rules) = (self.state.requests[0].read.clone(), self.state.part_rules(Side::Left));
        if let Err(error) = self.loader.start(models, read, rules) {
            self.loads_going_on -= 1;
            self.stage = None;
            self.problem =
                Some(format!("no thread to read the model on could be started ({error}); close other programs"));
        }
    }

    fn save(&mut self, kind: Save) {
        // Written files are never coarse.
        let job = self.job().map(Job::at_rest);
        let is_shown = self.drawn.as_ref().is_some_and(|drawn| !drawn.is_coarse);
        let Some(job) = job.filter(|_| is_shown) else {
            self.state.message = Some("no picture to save yet; wait until one is drawn".to_owned());
            return;
        };
        let (state, shown, surroundings) = (self.state.clone(), self.shown(), self.surroundings.clone());
        let reporter = self.reporter.clone();
        let work = move || {
            let saved = save(&state, &job, shown.as_ref(), &surroundings, kind);
            reporter.say(Report::Saved(saved.map_or_else(|error| error.to_string(), |text| format!("saved {text}"))));
        };
        self.state.message = Some("saving".to_owned());
        self.saving_threads.retain(|thread| !thread.is_finished());
        match std::thread::Builder::new().name("saving".to_owned()).spawn(work) {
            Ok(thread) => self.saving_threads.push(thread),
            Err(_) => {
                self.state.message = Some("no thread to save on could be started; close other programs".to_owned());
            }
        }
    }

    fn take(&mut self, report: Report) {
        match report {
            Report::Renderer(thread, context) => {
                self.render_threads.opened(thread, &context);
                self.surroundings.context.get_or_insert(context);
            }
            Report::NoRenderer(thread, error) => {
                if !self.render_threads.lost(thread) {
                    self.gone = Some(error);
                }
            }
            Report::Drawn { thread, drawings, shader_log } => {
                if shader_log.is_some() {
                    self.shader_log = shader_log;
                }
                if let Some(job) = self.done(thread) {
                    self.drawn(job, drawings);
                }
            }
            Report::NotDrawn(thread, error) => {
                if let Some(job) = self.done(thread) {
                    // Not requested again until the state changes; the last picture stays.
                    self.drawn = Some(job);
                    self.problem = Some(error.to_string());
                }
            }
            Report::Cost { scene, costs } => {
                self.is_pricing = false;
                let is_current = self.job().zip(self.drawn.as_ref()).is_some_and(|(job, drawn)| job.is_same(drawn));
                if is_current {
                    self.costs.take(*scene, costs, self.line_measure, self.reporter.clone());
                }
            }
            Report::NotPriced(error) => {
                self.is_pricing = false;
                self.problem = Some(error.to_string());
            }
            Report::Explained(answer) => self.explained.take(*answer),
            Report::ShadersTaken => {
                self.shader_log = None;
                self.explained.forget();
                self.drawn = None;
            }
            // Those before them are still used.
            Report::ShadersRefused(error) => self.shader_log = Some(error.to_string()),
            Report::Stage(number, stage) => {
                if self.loader.is_last(number) {
                    self.stage = Some(stage);
                }
            }
            Report::Loaded(number, loaded) => self.loaded(number, *loaded),
            Report::NotLoaded(number, error) => {
                self.loads_going_on -= 1;
                if self.loader.is_last(number) {
                    self.stage = None;
                    self.problem = Some(error.to_string());
                }
            }
            Report::Measured(number, errors) => self.costs.measured(number, errors),
            Report::Lines(found) => {
                self.lines.take(*found);
                self.picture_number += 1;
            }
            Report::Chosen(models) if models.is_empty() => self.state.message = Some(NOTHING_CHOSEN.to_owned()),
            Report::Chosen(models) => self.open(models),
            Report::ModelChanged => self.open(self.state.models.clone()),
            Report::ShadersChanged(shaders) => {
                let sent = self.render_threads.replace_shaders(shaders);
                self.check(sent);
            }
            Report::Saved(text) => self.state.message = Some(text),
        }
    }

    fn loaded(&mut self, number: u64, loaded: LoadedModels) {
        let LoadedModels { models, options, files, scene, remarks } = loaded;
        self.loads_going_on -= 1;
        if !self.loader.is_last(number) {
            return;
        }
        self.stage = None;
        self.problem = None;
        self.state.message = (!remarks.is_empty()).then(|| remarks.join("; "));
        if models != self.state.models {
            self.state.update(ViewerEvent::Reset);
        }
        let _ = self.watched.send(files.clone());
        (self.surroundings.files, self.surroundings.load) = (files, options);
        self.state.models = models;
        let request = &self.state.requests[0];
        if self.scene.is_none() && request.scene.camera.view == self.state.orbit.view {
            self.state.orbit.look_from(request.suited_view(&scene));
        }
        self.scene = Some(scene);
        self.costs.view_changed();
    }

    /// The job that a thread has done, unless a later one is shown already.
    fn done(&mut self, thread: usize) -> Option<Job> {
        let (number, job) = self.render_threads.done(thread)?;
        let is_news = number > self.drawn_number;
        self.drawn_number = self.drawn_number.max(number);
        is_news.then_some(job)
    }

    fn drawn(&mut self, job: Job, drawings: Vec<Drawing>) {
        match self.drawn.as_ref().is_some_and(|before| before.is_of_same_picture(&job)) {
            true => self.costs.style_changed(),
            false => self.costs.view_changed(),
        }
        self.drawn = Some(job);
        // Sides that show exact lines alone need no new picture.
        if !drawings.is_empty() || !self.drawings.is_empty() {
            self.picture_number += 1;
        }
        self.drawings = drawings;
        self.problem = None;
    }
}

impl Drop for Viewer {
    /// Waits for files that are being written.
    fn drop(&mut self) {
        self.costs.view_changed();
        self.lines.cancel();
        for thread in self.saving_threads.drain(..) {
            // A panicked thread has printed its message.
            let _ = thread.join();
        }
    }
}
