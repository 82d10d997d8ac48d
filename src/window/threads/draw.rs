//! A rendering thread: it owns a renderer, takes jobs and answers with pictures. The window stays responsive meanwhile.
//!
//! Takes a [`Job`], all values; returns the pictures that `tinta render` draws with the same settings, byte for byte, because it
//! is the same renderer with the same plans.

use crate::error::{Error, Result};
use crate::gl::{Backend, ContextInfo};
use crate::lines::Progress;
use crate::picture::Picture;
use crate::pixel::{Explanation, around};
use crate::plan::Plan;
use crate::renderer::{Renderer, StepValues, median, milliseconds_since};
use crate::request::{Request, Resolved};
use crate::scene::{Rectangle, Scene};
use crate::styles::{Show, StyleName};
use crate::window::threads::coarse;
use crate::window::threads::explain::PixelJob;
use crate::window::threads::job::{Cost, Drawing, Job};
use crate::window::threads::line_measure::LineMeasure;
use crate::window::threads::report::{Report, Reporter};
use crate::window::values::event::Side;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Instant;

/// A command for a drawing thread.
pub(in crate::window) enum Order {
    /// Draw this.
    Draw(Box<Job>),
    /// Time this and draw its lines alone.
    MeasureCost(Box<Job>, Option<LineMeasure>),
    /// Explain this pixel.
    Explain(Box<PixelJob>),
    /// Use these shaders instead of those built in, by their paths below `glsl/`.
    Shaders(HashMap<String, String>),
}

/// Number of frames that time a pass.
const TIMED_FRAMES: usize = 5;

/// How far from an explained pixel others can be explained without another drawing.
const REACH_PX: u32 = 96;

/// What the steps of a picture left around a pixel, for the pixels beside it.
#[derive(Debug)]
struct ReadBack {
    job: PixelJob,
    view: Resolved,
    plan: Plan,
    values: Vec<StepValues>,
}

impl ReadBack {
    /// Whether a pixel, counted from the lower left, can be explained from it.
    fn has(&self, at: [u32; 2]) -> bool {
        let needed = around(at, self.view.scene.size, 0);
        let holds = |part: Rectangle| {
            let is_within = |from: u32, count: u32, of: u32, held: u32| from >= of && from + count <= of + held;
            is_within(needed.x, needed.width, part.x, part.width)
                && is_within(needed.y, needed.height, part.y, part.height)
        };
        self.values.iter().all(|values| holds(values.part))
    }
}

/// A renderer with possibly replaced shaders.
#[derive(Debug)]
pub struct Drawer {
    read_back: Option<ReadBack>,
    renderer: Renderer,
    shaders: HashMap<String, String>,
    /// Whether the driver has drawn with them.
    are_tried: bool,
    /// Those that it drew with last.
    good_shaders: HashMap<String, String>,
    warmed: Option<WarmScene>,
    /// The light of the tones in the last view of these models.
    light: Option<(Arc<Scene>, [f32; 3])>,
}

/// The models and pictures that the driver has compiled and uploaded.
#[derive(Debug)]
struct WarmScene {
    /// The models drawn last.
    scene: Arc<Scene>,
    /// Their pictures drawn before.
    pictures: Vec<(StyleName, Show)>,
}

impl Drawer {
    /// Opens a context.
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn new(backend: Backend) -> Result<Self> {
        let renderer = Renderer::new(backend)?;
        let (shaders, good_shaders) = (HashMap::new(), HashMap::new());
        Ok(Self { read_back: None, renderer, shaders, are_tried: true, good_shaders, warmed: None, light: None })
    }

    /// The context's own description.
    pub(crate) fn context(&self) -> &ContextInfo {
        self.renderer.context()
    }

    /// How many GL objects it holds.
    pub fn live_objects(&self) -> usize {
        self.renderer.live_objects()
    }

    /// Replaces shaders by the texts given here.
    ///
    /// # Errors
    ///
    /// As [`Renderer::replace_shaders`].
    pub(crate) fn replace_shaders(&mut self, shaders: HashMap<String, String>) -> Result<()> {
        (self.read_back, self.warmed) = (None, None);
        self.renderer.replace_shaders(shaders.clone())?;
        self.shaders = shaders;
        self.are_tried = false;
        Ok(())
    }

    /// Draws a job's pictures; after a shader that does not link, uses the previous ones and returns its log.
    ///
    /// # Errors
    ///
    /// As [`Renderer::render`].
    pub fn draw(&mut self, job: &Job) -> Result<(Vec<Drawing>, Option<String>)> {
        match self.draw_once(job) {
            Err(error @ Error::Shader { .. }) if !self.are_tried => {
                self.read_back = None;
                self.shaders = self.good_shaders.clone();
                self.are_tried = true;
                self.renderer.replace_shaders(self.shaders.clone())?;
                Ok((self.draw_once(job)?, Some(error.to_string())))
            }
            Ok(drawings) => {
                if !self.are_tried {
                    self.good_shaders = self.shaders.clone();
                    self.are_tried = true;
                }
                Ok((drawings, None))
            }
            Err(error) => Err(error),
        }
    }

    fn draw_once(&mut self, job: &Job) -> Result<Vec<Drawing>> {
        let scene = job.scene()?;
        let draw = |(side, request): &(Side, Request)| {
            let mut request = request.clone();
            if job.is_coarse {
                request.style = crate::styles::coarse(&request.style);
            }
            let view = self.resolved(job, &scene, &request)?;
            let around = match &job.found[*side as usize] {
                None if job.has_strokes[*side as usize] => Some(Arc::new(view.around(&Progress::default())?)),
                found => found.clone(),
            };
            // The time is that of a frame, not of the driver's compiling and uploading before the first one.
            if self.is_first(job, request.style.style_name(), request.show) {
                self.passes(&view)?;
            }
            let start = Instant::now();
            let picture = match around {
                Some(around) => around.drawn(&view, &view.plans(&mut self.renderer)?.1.plan, &mut self.renderer)?,
                None => self.passes(&view)?,
            };
            let frame_ms = milliseconds_since(start);
            let picture = if job.is_coarse { coarse::enlarged(&picture, job.settings.size) } else { picture };
            Ok(Drawing { side: *side, picture, frame_ms })
        };
        job.drawings.iter().map(draw).collect()
    }

    /// Whether a picture of these models is drawn for the first time; it is not from now on.
    fn is_first(&mut self, job: &Job, style: StyleName, show: Show) -> bool {
        let warmed = self.warmed.take().filter(|warmed| Arc::ptr_eq(&warmed.scene, &job.scene));
        let mut warmed = warmed.unwrap_or_else(|| WarmScene { scene: job.scene.clone(), pictures: Vec::new() });
        let is_first = !warmed.pictures.contains(&(style, show));
        warmed.pictures.extend(is_first.then_some((style, show)));
        self.warmed = Some(warmed);
        is_first
    }

    /// A view's picture without strokes.
    fn passes(&mut self, view: &Resolved) -> Result<Picture> {
        let (_, pruned) = view.plans(&mut self.renderer)?;
        self.renderer.draw(view.lit(), &pruned.plan)
    }

    /// A job's picture of a scene. While the view moves, its light stays.
    fn resolved(&mut self, job: &Job, scene: &Scene, request: &Request) -> Result<Resolved> {
        let request = job.request(request);
        let before = self.light.as_ref().filter(|(models, _)| Arc::ptr_eq(models, &job.scene)).map(|(_, light)| *light);
        let view = match job.keeps_patches {
            true => request.moving(scene.clone(), before, false)?,
            false => request.still(scene.clone(), false)?,
        };
        self.light = view.light().map(|light| (job.scene.clone(), light)).or(self.light.take());
        Ok(view)
    }

    /// Explains a pixel.
    ///
    /// # Errors
    ///
    /// As [`Explanation::of`].
    pub(crate) fn explain(&mut self, job: &PixelJob) -> Result<Explanation> {
        let height = job.view.settings.size.height;
        let at = [job.pixel[0], height - 1 - job.pixel[1]];
        let is_known = self.read_back.as_ref().is_some_and(|known| known.job.view.is_same(&job.view) && known.has(at));
        if let (Some((_, request)), false) = (job.view.drawings.first(), is_known) {
            self.read_back = None;
            let view = self.resolved(&job.view, &job.view.scene()?, request)?;
            let plan = view.plan()?;
            let values = self.renderer.step_values(view.lit(), &plan, around(at, view.scene.size, REACH_PX))?;
            self.read_back = Some(ReadBack { job: job.clone(), view, plan, values });
        }
        let Some(ReadBack { view, plan, values, .. }) = &self.read_back else {
            return Err(Error::gl("explaining a pixel", "nothing was read back"));
        };
        Explanation::of_values(&view.request.style, view.lit(), (plan, values), &self.renderer, job.pixel)
    }

    /// Times a job's pictures and their passes, and draws the lines of final pictures alone.
    ///
    /// # Errors
    ///
    /// As [`Renderer::render`].
    pub(crate) fn measure_cost(&mut self, job: &Job, measure: Option<LineMeasure>) -> Result<(Scene, Vec<Cost>)> {
        let scene = job.scene()?;
        let mut costs = Vec::new();
        for (side, request) in &job.drawings {
            let view = self.resolved(job, &scene, request)?;
            let (_, pruned) = view.plans(&mut self.renderer)?;
            let passes = self.renderer.time_passes(view.lit(), &pruned.plan, TIMED_FRAMES)?;
            let frame = |_| {
                let start = Instant::now();
                self.passes(&view).map(|_| milliseconds_since(start))
            };
            let frames: Result<Vec<f64>> = (0..TIMED_FRAMES).map(frame).collect();
            let frame_ms = median(frames?).unwrap_or_default();
            let style = &request.style;
            let has_own_lines = request.show == Show::Final && !view.contents.has_strokes();
            let ink = match measure.filter(|_| has_own_lines) {
                Some(measure) => (measure.ink)(&mut self.renderer, &scene, style)?,
                None => None,
            };
            let has_lines = style.style_name().has_lines();
            costs.push(Cost { side: *side, style: style.name(), frame_ms, passes, has_lines, ink });
        }
        Ok((scene, costs))
    }
}

/// Starts a thread, which names itself by its number. It ends when its orders do, and must be waited for then: a driver does
/// not bear a program's end while it draws.
pub(in crate::window) fn start(
    backend: Backend,
    number: usize,
    reporter: Reporter,
) -> std::io::Result<(Sender<Order>, JoinHandle<()>)> {
    let (orders, taken) = channel();
    let thread = std::thread::Builder::new().name("drawing".to_owned());
    let thread = thread.spawn(move || work(backend, number, &taken, &reporter))?;
    Ok((orders, thread))
}

fn work(backend: Backend, number: usize, orders: &Receiver<Order>, reporter: &Reporter) {
    let mut drawer = match Drawer::new(backend) {
        Ok(drawer) => drawer,
        Err(error) => return reporter.say(Report::NoRenderer(number, error)),
    };
    reporter.say(Report::Renderer(number, Box::new(drawer.context().clone())));
    // Until the viewer lets go of its end.
    while let Ok(order) = orders.recv() {
        reporter.say(match order {
            Order::Draw(job) => match drawer.draw(&job) {
                Ok((drawings, shader_log)) => Report::Drawn { thread: number, drawings, shader_log },
                Err(error) => Report::NotDrawn(number, error),
            },
            Order::MeasureCost(job, measure) => match drawer.measure_cost(&job, measure) {
                Ok((scene, costs)) => Report::Cost { scene: Box::new(scene), costs },
                Err(error) => Report::NotPriced(error),
            },
            Order::Explain(job) => Report::Explained(Box::new(drawer.explain(&job))),
            Order::Shaders(shaders) => match drawer.replace_shaders(shaders) {
                Ok(()) => Report::ShadersTaken,
                Err(error) => Report::ShadersRefused(error),
            },
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, load};
    use crate::orbit::Orbit;
    use crate::scene::{SceneSettings, Size};

    #[test]
    fn a_picture_is_first_once_for_each_style_and_model_and_new_shaders() {
        let mesh = Arc::new(load("builtin:open-box", &LoadOptions::default()).unwrap().mesh);
        let settings = SceneSettings { size: Size { width: 16, height: 16 }, ..SceneSettings::default() };
        let scene = || Arc::new(Scene::new(vec![mesh.clone()], &settings).unwrap());
        let drawings = vec![(Side::Left, Request::of_style(StyleName::Phong))];
        let job = Job {
            scene: scene(),
            orbit: Orbit::default(),
            settings: settings.clone(),
            drawings,
            has_strokes: [false; 2],
            found: [None, None],
            is_coarse: false,
            keeps_patches: false,
        };
        let mut drawer = Drawer::new(Backend::Auto).unwrap();
        drawer.draw(&job).unwrap();
        assert!(!drawer.is_first(&job, StyleName::Phong, Show::Final));
        assert!(drawer.is_first(&job, StyleName::ThreePass, Show::Final));
        assert!(drawer.is_first(&job, StyleName::ThreePass, Show::Borders));
        assert!(drawer.is_first(&Job { scene: scene(), ..job.clone() }, StyleName::Phong, Show::Final));
        drawer.draw(&job).unwrap();
        drawer.replace_shaders(HashMap::new()).unwrap();
        assert!(drawer.is_first(&job, StyleName::Phong, Show::Final));
    }
}
