//! Draws settings, times them in turn and measures them.

use super::error_picture::error_picture;
use super::ink::Ink;
use super::reference::Reference;
use super::tones::ReferenceLight;
use super::{Conditions, FrameTimes, PassRow, Row, RunTime};
use tinta::edges::{ClassSet, Classes, MeshEdges, SilhouetteRule, Silhouettes};
use tinta::error::{Error, Result};
use tinta::lines::LineSettings;
use tinta::lines::closed_forms::ClosedForm;
use tinta::picture::Picture;
use tinta::pixel::LineTolerance;
use tinta::plan::{Plan, Submission};
use tinta::renderer::{Renderer, milliseconds_since};
use tinta::scene::{Scene, Size};
use tinta::styles::{Show, Style};
use tinta_geometry::clock::Instant;

/// A style with settings, and the user's options for it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredStyle {
    /// The style.
    pub style: Style,
    /// How its vertices are handed to GL.
    pub submission: Submission,
    /// Its options for `tinta render`.
    pub options: String,
    /// Whether these are the published program's own.
    pub is_faithful: bool,
}

/// A scene with its references.
#[derive(Debug)]
pub struct Subject {
    /// The model as the user named it.
    pub model: String,
    /// The scene, on a white background.
    pub scene: Scene,
    /// Its lines.
    pub reference: Reference,
    /// Its light.
    pub light: ReferenceLight,
    /// Reading the model, milliseconds.
    pub load_ms: f64,
    /// Finding its edges, milliseconds.
    pub edges_ms: f64,
}

/// A measured setting.
#[derive(Debug)]
pub struct Measurement {
    /// The numbers.
    pub row: Row,
    /// The style's drawing.
    pub drawing: Picture,
    /// Agreed ink black, missed lines red, false ink blue, ignored ink grey; `None` without lines.
    pub error_picture: Option<Picture>,
}

/// How settings are measured: repetitions and tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureSettings {
    /// Distance within which ink and line count as the same.
    pub tolerance: LineTolerance,
    /// Frames of each setting that are timed. Default 21.
    pub frames: usize,
    /// The machine's name in the rows.
    pub machine: String,
}

impl Default for MeasureSettings {
    fn default() -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let machine = format!("{} {}, {threads} threads", std::env::consts::OS, std::env::consts::ARCH);
        Self { tolerance: LineTolerance::default(), frames: 21, machine }
    }
}

impl MeasureSettings {
    /// Refuses nonsense, before any work.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for zero frames.
    pub fn check(&self) -> Result<()> {
        match self.frames {
            0 => Err(Error::value("frames", "0", "at least one frame is needed to time one")),
            _ => Ok(()),
        }
    }
}

/// Frames drawn before any are timed.
const WARM_UP: usize = 2;

/// Frames of a setting that follow one another before the next one's turn.
const FRAMES_A_TURN: usize = 3;

impl Subject {
    /// Finds a scene's references.
    ///
    /// # Errors
    ///
    /// As [`Reference::of`].
    pub fn new(model: &str, scene: Scene, load_ms: f64) -> Result<Self> {
        let reference = Reference::of(&scene, &LineSettings::as_published())?;
        Self::with_reference(model, scene, reference, load_ms)
    }

    /// Like [`Subject::new`], with lines compared with the contour of the surface that the scene's only object is a mesh of.
    ///
    /// # Errors
    ///
    /// As [`Reference::of_surface`].
    pub fn of_surface(model: &str, scene: Scene, surface: &ClosedForm, load_ms: f64) -> Result<Self> {
        let reference = Reference::of_surface(&scene, surface)?;
        Self::with_reference(model, scene, reference, load_ms)
    }

    fn with_reference(model: &str, scene: Scene, reference: Reference, load_ms: f64) -> Result<Self> {
        let light = ReferenceLight::of(&scene);
        let start = Instant::now();
        for object in &scene.objects {
            let edges = MeshEdges::new(object.mesh.clone());
            Classes::new(&object.mesh, edges.list(), reference.crease_angle, ClassSet::EDGES);
            Silhouettes::new(&object.mesh, edges.list());
        }
        let edges_ms = milliseconds_since(start);
        Ok(Self { model: model.to_owned(), scene, reference, light, load_ms, edges_ms })
    }

    /// A row without a style, errors and times, drawn without GL.
    pub(crate) fn row(&self, how: &MeasureSettings) -> Row {
        let Size { width, height } = self.scene.size;
        Row {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: how.machine.clone(),
            renderer: "none".to_owned(),
            gl_version: String::new(),
            conditions: Conditions::now(),
            model: self.model.clone(),
            triangles: self.scene.triangle_count(),
            size: [width, height],
            style: String::new(),
            options: String::new(),
            is_faithful: false,
            is_pruned: false,
            has_own_reference: false,
            lines: None,
            tones: None,
            time: RunTime::new([self.load_ms, 0.0, 0.0], FrameTimes::default(), Vec::new()),
        }
    }
}

/// A setting on its way.
struct Contestant {
    plan: Plan,
    frames: FrameTimes,
    measured: Measurement,
}

/// The step that [`measure`] has just finished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasureStep {
    /// A setting was drawn and its errors measured: one for each setting.
    Errors,
    /// Some frames of a setting were timed: [`turns`] for each setting that could be drawn.
    Turn,
}

/// Measures settings on a subject: their errors one by one, their frames in turns, which makes a busy moment hit all of them.
/// `step` receives each step. A setting that cannot draw this scene is left out, and the reason returned with the rows.
///
/// # Errors
///
/// As [`Renderer::draw`].
pub fn measure(
    renderer: &mut Renderer,
    subject: &Subject,
    settings: &[MeasuredStyle],
    how: &MeasureSettings,
    mut step: impl FnMut(MeasureStep),
) -> Result<(Vec<Measurement>, Vec<String>)> {
    let (mut contestants, mut left_out) = (Vec::new(), Vec::new());
    for setting in settings {
        match contestant(renderer, subject, setting, how) {
            Ok(contestant) => contestants.push(contestant),
            Err(error @ (Error::Setting { .. } | Error::Settings { .. })) => {
                let reason = error.with_dashes();
                left_out.push(format!("{}: {} is left out ({reason})", subject.model, setting.options));
            }
            Err(error) => return Err(error),
        }
        step(MeasureStep::Errors);
    }
    // Looking for errors took the processor alone.
    if let Some(first) = contestants.first() {
        renderer.raise_clock(&subject.scene, &first.plan)?;
    }
    for turn in 0..turns(how.frames) {
        let frames = FRAMES_A_TURN.min(how.frames - turn * FRAMES_A_TURN);
        for contestant in &mut contestants {
            let Contestant { plan, frames: times, .. } = contestant;
            renderer.time_frames(&subject.scene, plan, 0, 1)?;
            (0..frames).try_for_each(|_| times.add_frame(renderer, &subject.scene, plan))?;
            step(MeasureStep::Turn);
        }
    }
    for contestant in &mut contestants {
        let passes = renderer.time_passes(&subject.scene, &contestant.plan, FRAMES_A_TURN)?;
        let row = |pass: tinta::renderer::PassTime| PassRow {
            name: pass.name.to_owned(),
            cpu_ms: pass.cpu_ms,
            gpu_ms: pass.gpu_ms,
        };
        let RunTime { load_ms, edges_ms, plan_ms, .. } = contestant.measured.row.time;
        let (frames, passes) = (std::mem::take(&mut contestant.frames), passes.into_iter().map(row).collect());
        contestant.measured.row.time = RunTime::new([load_ms, edges_ms, plan_ms], frames, passes);
    }
    Ok((contestants.into_iter().map(|contestant| contestant.measured).collect(), left_out))
}

/// The number of turns that time so many frames of a setting.
pub fn turns(frames: usize) -> usize {
    frames.div_ceil(FRAMES_A_TURN)
}

/// How many frames are drawn in a turn: those that are timed, and one before them.
pub fn frames_a_turn(frames: usize) -> usize {
    1 + frames.min(FRAMES_A_TURN)
}

/// A setting's errors, its plan, and its first frame.
fn contestant(
    renderer: &mut Renderer,
    subject: &Subject,
    setting: &MeasuredStyle,
    how: &MeasureSettings,
) -> Result<Contestant> {
    let scene = &subject.scene;
    let style = &setting.style;
    let start = Instant::now();
    let plan = Plan { submission: setting.submission, ..style.plan(scene, Show::Final)? };
    let plan_ms = milliseconds_since(start);
    let drawing = renderer.draw(scene, &plan)?;
    renderer.time_frames(scene, &plan, WARM_UP, 1)?;
    let ink = Ink::of_style(renderer, scene, style)?;
    let shown = shading_of(style);
    let tones = match style {
        Style::Inking(_) | Style::Dietrich(_) => None,
        _ => {
            let picture = renderer.draw(scene, &style.plan(scene, shown)?)?;
            subject.light.error(&picture, style, scene, &subject.reference)?
        }
    };
    let tolerance_px = how.tolerance.px(scene.size);
    let edges_ms = if matches!(style, Style::Inking(_)) { subject.edges_ms } else { 0.0 };
    let context = renderer.context();
    let row = Row {
        renderer: context.renderer.clone(),
        gl_version: context.version.clone(),
        style: style.name().to_owned(),
        options: setting.options.clone(),
        is_faithful: setting.is_faithful,
        has_own_reference: matches!(style, Style::Inking(inking) if inking.silhouette == SilhouetteRule::Exact),
        lines: ink.as_ref().map(|ink| ink.error(&subject.reference, tolerance_px)),
        tones,
        time: RunTime::new([subject.load_ms, edges_ms, plan_ms], FrameTimes::default(), Vec::new()),
        ..subject.row(how)
    };
    let error_picture = ink.map(|ink| error_picture(&ink, &subject.reference, tolerance_px));
    Ok(Contestant { plan, frames: FrameTimes::default(), measured: Measurement { row, drawing, error_picture } })
}

/// The picture of a style that its shading alone makes.
pub(crate) fn shading_of(style: &Style) -> Show {
    if style.has_tones() { Show::Tones } else { Show::Final }
}
