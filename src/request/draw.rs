//! From a request to a picture or lines.

use super::around::Around;
use super::drawing::DrawnLines;
use super::emptiness::empty_remark;
use super::{ModelCache, Request, Resolved, Session, WantedLines, ignored_remark};
use crate::clock::Instant;
use crate::error::{Error, Result};
use crate::glsl;
use crate::lines::{Phase, Progress};
use crate::mesh::{LoadStage, Mesh};
use crate::picture::Picture;
use crate::plan::Plan;
use crate::plan::prune::{IdleRule, Omission, PrunedPlan, prune};
use crate::renderer::{Renderer, milliseconds_since};
use crate::styles::{Below, is_of_vectors};
use crate::threads::both;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A picture, and how it was made.
#[derive(Debug)]
pub struct DrawnPicture {
    /// The request and the scene.
    pub resolved: Resolved,
    /// The files read besides the models' own files.
    pub files: Vec<PathBuf>,
    /// The style's plan for the scene, before pruning.
    pub published: Plan,
    /// The executed plan.
    pub plan: Plan,
    /// The omissions, with reasons.
    pub omissions: Vec<Omission>,
    /// The rules that omitted nothing, with reasons.
    pub kept: Vec<IdleRule>,
    /// Remarks for the user, a sentence each.
    pub remarks: Vec<String>,
    /// The shadow and the lines around the plan's picture.
    pub around: Around,
    /// The picture.
    pub picture: Picture,
    /// How long it took.
    pub times: Times,
}

/// How long the stages took, milliseconds.
#[derive(Debug, Clone, Default)]
pub struct Times {
    /// Reading the models and making meshes.
    pub load_ms: f64,
    /// Each stage's part of that.
    pub stages: Vec<(LoadStage, f64)>,
    /// Vertex arrays.
    pub arrays_ms: f64,
    /// Plan and pruning.
    pub plan_ms: f64,
    /// Exact lines over the picture.
    pub lines_ms: f64,
    /// Opening the context; 0 if it was open.
    pub context_ms: f64,
    /// Drawing one triangle meanwhile; `None` where the models were read before.
    pub warm_up_ms: Option<f64>,
    /// The first frame.
    pub first_frame_ms: f64,
}

/// The models of a request.
#[derive(Debug)]
pub struct ReadModels {
    /// Their meshes.
    pub meshes: Vec<Arc<Mesh>>,
    /// The files read besides the models' own.
    pub files: Vec<PathBuf>,
    /// Time of each stage of reading, for all models together, milliseconds.
    pub stages: Vec<(LoadStage, f64)>,
    /// How long all of it took, milliseconds.
    pub ms: f64,
}

/// A picture ready to draw, with its plan and the exact lines over it.
struct PlannedPicture {
    resolved: Resolved,
    files: Vec<PathBuf>,
    published: Plan,
    around: Around,
    times: Times,
}

impl Request {
    /// Reads the models and draws their lines and areas, without OpenGL.
    ///
    /// # Errors
    ///
    /// Those of reading, and of the settings with this scene; [`Error::Cancelled`] where `progress` was.
    pub fn lines(&self, session: &Session, wanted: WantedLines, progress: &Progress) -> Result<DrawnLines> {
        let ReadModels { meshes, files, ms: load_ms, .. } = self.models(&session.models)?;
        let drawn = self.resolve(meshes, true)?.drawn_lines(wanted, progress)?;
        Ok(DrawnLines { files, load_ms, ..drawn })
    }

    /// Reads the models.
    ///
    /// # Errors
    ///
    /// Those of the readers.
    pub fn models(&self, cache: &ModelCache) -> Result<ReadModels> {
        let start = Instant::now();
        let mut models = ReadModels { meshes: Vec::new(), files: Vec::new(), stages: Vec::new(), ms: 0.0 };
        let read = self.load_options()?;
        for path in &self.models {
            let model = cache.read(path, &read)?;
            models.meshes.push(model.mesh.clone());
            models.files.extend(model.files.iter().cloned());
            for (stage, ms) in &model.stages {
                match models.stages.iter_mut().find(|(other, _)| other == stage) {
                    Some((_, sum)) => *sum += ms,
                    None => models.stages.push((*stage, *ms)),
                }
            }
        }
        models.ms = milliseconds_since(start);
        Ok(models)
    }

    /// The shaders to draw with instead of those built in, by their paths.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a folder without shaders, and those of `glsl::check_folder`.
    pub fn shaders(&self) -> Result<HashMap<String, String>> {
        let Some(folder) = &self.glsl else { return Ok(HashMap::new()) };
        glsl::check_folder(folder)?;
        let shaders = glsl::in_folder(Path::new(folder));
        if shaders.is_empty() {
            let problem = "it holds no changed shader; lay it out like glsl/, for example phong/phong.frag";
            return Err(Error::value("glsl", folder, problem));
        }
        Ok(shaders)
    }

    /// The session's context for this request, with its shaders.
    ///
    /// # Errors
    ///
    /// Those of [`Session::renderer`], [`Request::shaders`] and [`Renderer::replace_shaders`].
    pub fn renderer<'a>(&self, session: &'a mut Session) -> Result<&'a mut Renderer> {
        let shaders = self.shaders()?;
        let renderer = session.renderer(self.backend)?;
        if renderer.replaced_shaders() != shaders {
            renderer.replace_shaders(shaders).map_err(|error| match (error, &self.glsl) {
                // Named by the folder that it is in.
                (Error::Shader { path, log }, Some(folder)) => {
                    Error::value("glsl", folder, format!("{path} does not compile ({log})"))
                }
                (error, _) => error,
            })?;
        }
        Ok(renderer)
    }

    /// Reads the models and puts the scene together while the session's context opens, if it is not open yet.
    ///
    /// # Errors
    ///
    /// Those of [`Request::models`], [`Request::resolve`], [`Resolved::plan`] and [`Request::renderer`].
    pub fn resolved_and_renderer<'a>(&self, session: &'a mut Session) -> Result<(Resolved, &'a mut Renderer)> {
        let (_, loaded) = self.ready(session, &Progress::default());
        Ok((loaded?.resolved, self.renderer(session)?))
    }

    /// Reads the models and draws their picture of passes.
    ///
    /// # Errors
    ///
    /// Those of [`Request::lines`], and of the way to OpenGL.
    pub fn picture(&self, session: &mut Session, progress: &Progress) -> Result<DrawnPicture> {
        self.refuse_vectors_options()?;
        let (Times { context_ms, warm_up_ms, .. }, loaded) = self.ready(session, progress);
        let PlannedPicture { resolved, files, published, around, times } = loaded?;
        let drawn = resolved.drawn_picture(published, around, self.renderer(session)?)?;
        let Times { plan_ms, first_frame_ms, .. } = drawn.times;
        let plan_ms = times.plan_ms + plan_ms;
        Ok(DrawnPicture { files, times: Times { plan_ms, first_frame_ms, context_ms, warm_up_ms, ..times }, ..drawn })
    }

    /// Reads the models and gets a renderer ready meanwhile, unless the session has one.
    fn ready(&self, session: &mut Session, progress: &Progress) -> (Times, Result<PlannedPicture>) {
        let backend = self.backend;
        if session.has(backend) {
            return (Times::default(), self.planned(&session.models, session.submission, progress));
        }
        let shared = &*session;
        let (models, submission) = (&shared.models, shared.submission);
        let load = || self.planned(models, submission, progress);
        // Opening the context takes as long as reading a large model: both run in parallel. The renderer stays on this thread, as
        // GL requires.
        let (opened, loaded) = std::thread::scope(|scope| {
            // Without a second thread, one after the other.
            let Ok(loading) = std::thread::Builder::new().spawn_scoped(scope, load) else {
                let loaded = load();
                return (self.open(shared, || true), loaded);
            };
            let opened = self.open(shared, || loading.is_finished());
            match loading.join() {
                Ok(loaded) => (opened, loaded),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        });
        match opened {
            Ok((renderer, times)) => {
                session.keep(backend, renderer);
                (times, loaded)
            }
            // Errors of the models come first.
            Err(error) => (Times::default(), loaded.and(Err(error))),
        }
    }

    /// Opens the context and, if the models are not there yet, warms it up.
    fn open(&self, session: &Session, models_are_read: impl Fn() -> bool) -> Result<(Renderer, Times)> {
        let start = Instant::now();
        let mut renderer = session.open(self.backend)?;
        let mut times = Times { context_ms: milliseconds_since(start), ..Times::default() };
        if !models_are_read() {
            let start = Instant::now();
            let pruning = self.pruning.pruning(&renderer);
            if let Below::Passes(style) = self.contents(false)?.below {
                renderer.warm_up(&self.scene, &style, self.show, pruning.as_ref())?;
            }
            times.warm_up_ms = Some(milliseconds_since(start));
        }
        Ok((renderer, times))
    }

    /// Reads the models, puts the scene together and plans it, which finds its edges where the style draws them.
    fn planned(
        &self,
        cache: &ModelCache,
        submission: crate::plan::Submission,
        progress: &Progress,
    ) -> Result<PlannedPicture> {
        let ReadModels { meshes, files, stages, ms: load_ms } = self.models(cache)?;
        let resolved = self.resolve(meshes, false)?;
        let passes = || -> Result<(Plan, Times)> {
            let start = Instant::now();
            resolved.lit().make_arrays();
            let arrays_ms = milliseconds_since(start);
            let start = Instant::now();
            let published = Plan { submission, ..resolved.plan()? };
            Ok((published, Times { arrays_ms, plan_ms: milliseconds_since(start), ..Times::default() }))
        };
        let (around, planned) = both(|| resolved.around(progress), passes);
        let (around, (published, times)) = (around?, planned?);
        progress.begin(Phase::Drawing, 0);
        let times = Times { load_ms, stages, lines_ms: around.found_ms, ..times };
        Ok(PlannedPicture { resolved, files, published, around, times })
    }
}

impl Resolved {
    /// Returns the plan as published, and pruned of everything that cannot change the picture.
    ///
    /// # Errors
    ///
    /// Those of [`Resolved::plan`] and `Renderer::choose_context`.
    pub fn plans(&self, renderer: &mut Renderer) -> Result<(Plan, PrunedPlan)> {
        let published = self.plan()?;
        let pruned = self.pruned(&published, renderer)?;
        Ok((published, pruned))
    }

    /// Prunes a plan of everything that cannot change the picture.
    fn pruned(&self, published: &Plan, renderer: &mut Renderer) -> Result<PrunedPlan> {
        renderer.choose_context(self.lit(), published)?;
        Ok(match self.request.pruning.pruning(renderer) {
            Some(pruning) => prune(published, self.lit(), &pruning),
            None => PrunedPlan { plan: published.clone(), omissions: Vec::new(), kept: Vec::new() },
        })
    }

    /// Draws the picture of passes, with its shadow and lines.
    ///
    /// # Errors
    ///
    /// Those of [`Resolved::plans`], [`Resolved::around`] and [`Renderer::draw`].
    pub fn picture(&self, renderer: &mut Renderer) -> Result<Picture> {
        let (_, PrunedPlan { plan, .. }) = self.plans(renderer)?;
        self.around(&Progress::default())?.drawn(self, &plan, renderer)
    }

    /// Draws a plan, pruned of everything that cannot change the picture, between the ground and exact lines.
    ///
    /// # Errors
    ///
    /// Those of [`Resolved::plans`] and [`Renderer::draw`].
    pub fn drawn_picture(self, published: Plan, around: Around, renderer: &mut Renderer) -> Result<DrawnPicture> {
        let mut times = Times::default();
        let start = Instant::now();
        let PrunedPlan { plan, omissions, kept } = self.pruned(&published, renderer)?;
        times.plan_ms = milliseconds_since(start);
        let mut remarks = self.picture_remarks(&plan, renderer);
        let start = Instant::now();
        let mut picture = renderer.draw(self.lit(), &plan)?;
        times.first_frame_ms = milliseconds_since(start);
        around.put(&plan, &mut picture);
        remarks.extend(empty_remark(self.lit(), &published, Some(&around), &picture, renderer)?);
        let files = Vec::new();
        Ok(DrawnPicture { resolved: self, files, published, plan, omissions, kept, remarks, around, picture, times })
    }

    /// Returns remarks on the picture that a plan draws, a sentence each.
    pub(crate) fn picture_remarks(&self, plan: &Plan, renderer: &Renderer) -> Vec<String> {
        let (Request { style, options, .. }, scene) = (&self.request, &self.scene);
        let has_strokes = self.contents.has_strokes();
        let has_no_effect = |option: &&String| {
            let is_drawn = has_strokes || self.request.is_of_look(option);
            !is_drawn && is_of_vectors(option, style.style_name()) && !self.request.is_of_surfaces(option)
        };
        let of_vectors = options.keys().filter(has_no_effect);
        let mut remarks = if self.contents.is_hatched() { self.contents.remarks(scene) } else { style.remarks(scene) };
        remarks.extend(renderer.remarks(plan));
        remarks.extend(if has_strokes { scene.far_remark() } else { style.curves_remark(scene) });
        remarks.extend(scene.cut_remark().filter(|_| self.request.scene.camera.near.is_none()));
        remarks.extend(ignored_remark(of_vectors.map(String::as_str), &[style.name()]));
        remarks
    }
}
