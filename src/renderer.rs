//! A GL context and its resources: scenes and styles go in, pictures and times come out.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use std::sync::{Arc, Mutex};
//! use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Size, Style, StyleName, load};
//!
//! let mesh = load("builtin:gear", &LoadOptions::default())?.mesh;
//! let settings = SceneSettings { size: Size { width: 64, height: 64 }, ..Default::default() };
//! let scene = Scene::new(vec![Arc::new(mesh)], &settings)?;
//! let mut renderer = Renderer::new(Backend::Auto)?;
//! let picture = renderer.render(&scene, &Style::named(StyleName::ThreePass))?;
//! assert_eq!(picture.pixels.len(), 64 * 64 * 4);
//! # Ok(())
//! # }
//! ```

mod drawer;
mod own_shaders;

use crate::camera::CameraSettings;
use crate::clock::Instant;
pub use crate::clock::milliseconds_since;
use crate::error::{Error, Result};
use crate::gl::context::Context;
use crate::gl::{Backend, ContextInfo, Fault};
use crate::limits::DRAWN_AT_ONCE_PIXELS;
use crate::mesh::Mesh;
use crate::picture::Picture;
use crate::plan::prune::{Pruning, prune};
use crate::plan::{Draw, Geometry, LineDrawing, Plan, Program, Step};
use crate::scene::{ObjectIdentity, Scene, SceneSettings, Size};
use crate::styles::{Show, Style};
use crate::values::Rectangle;
pub use drawer::StepValues;
use drawer::{Assembly, Drawer, Frame};
use serde::Serialize;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// How long a graphics card works before a frame is timed, milliseconds. An NVIDIA H100 goes from 345 to 1980 MHz within 200.
const RAISING_CLOCK_MS: f64 = 500.0;

/// Draws scenes. Keeps meshes, shaders and textures between pictures; belongs to the thread that made it. While it draws,
/// renderers of other threads with the same software driver wait, because Mesa fails when they draw at once.
///
/// After an error it holds nothing and can draw the next picture, unless its context is lost. Then every further call returns
/// [`Error::ContextLost`], and a new renderer has to be made.
///
/// A picture that is too large for its context is drawn in tiles. With [`Backend::Auto`] the first other context that can draw it
/// in one piece draws it instead; that context is opened then and kept. The first context still draws smaller pictures.
pub struct Renderer {
    backend: Backend,
    fault: Option<Fault>,
    /// The context opened first, and those opened for larger pictures.
    drawers: Vec<Drawer>,
    /// Which of them draws.
    used: usize,
    /// Largest surface to draw at once, if below the contexts' largest.
    confined_to: Option<Size>,
    /// As in [`Pruning`].
    rest: Arc<Mutex<Option<(ObjectIdentity, u32)>>>,
}

impl std::fmt::Debug for Renderer {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // GL's objects have no text.
        out.debug_struct("Renderer").field("surface", &self.drawers[self.used].surface).finish_non_exhaustive()
    }
}

/// The times of one pass.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PassTime {
    /// The pass's name in the plan.
    pub name: &'static str,
    /// CPU clock milliseconds from before its first call until GL has finished it; the median over the frames.
    pub cpu_ms: f64,
    /// Milliseconds by a timer query on the device; the median over the frames; `None` without timer queries.
    pub gpu_ms: Option<f64>,
}

/// GL's picture after one step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepPicture {
    /// The pass's name.
    pub pass: &'static str,
    /// The step's name.
    pub step: &'static str,
    /// The target's contents after the step: the first of several textures, or for a copy the copy; exactly GL's bytes.
    pub picture: Picture,
}

impl Renderer {
    /// Opens a context.
    ///
    /// # Errors
    ///
    /// [`Error::NoContext`] with every attempt when none of this backend's ways works.
    pub fn new(backend: Backend) -> Result<Self> {
        Self::open(backend, None)
    }

    /// Opens a context in which a fault occurs: for tests and `tinta stress`.
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn with_fault(backend: Backend, fault: Fault) -> Result<Self> {
        Self::open(backend, Some(fault))
    }

    /// Draws on a canvas of a browser's page, by WebGL; the page shows the last picture drawn.
    ///
    /// # Errors
    ///
    /// [`Error::NoContext`] if the browser has no WebGL or lacks a needed part of it.
    #[cfg(target_arch = "wasm32")]
    pub fn on_canvas(canvas: web_sys::HtmlCanvasElement) -> Result<Self> {
        Ok(Self::with(Backend::Auto, None, Context::on_canvas(canvas)?))
    }

    /// Draws with one already open context, and no other.
    #[cfg(any(test, all(feature = "cli", not(target_arch = "wasm32"))))]
    pub(crate) fn of(context: Context) -> Self {
        Self::with(Backend::Egl, None, context)
    }

    fn with(backend: Backend, fault: Option<Fault>, context: Context) -> Self {
        let drawers = vec![Drawer::new(context)];
        Self { backend, fault, drawers, used: 0, confined_to: None, rest: Arc::default() }
    }

    /// Probes whether the driver follows OpenGL. Consumes the renderer, because the probes change its context's state.
    #[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
    pub(crate) fn probe(mut self) -> Result<Vec<crate::gl::probe::Probe>> {
        use crate::gl::probe::{SIDE, probes};
        let drawer = self.drawer();
        drawer.release();
        drawer.context.resize(Size { width: SIDE, height: SIDE })?;
        let _current = drawer.context.enter()?;
        probes(drawer.context.gl())
    }

    /// Copies depth as OpenGL does, or takes it as a browser has to.
    #[cfg(test)]
    pub(crate) fn copy_depth(&mut self, copies_depth: bool) {
        self.drawers.iter_mut().for_each(|drawer| drawer.resources.copy_depth(copies_depth));
    }

    fn open(backend: Backend, fault: Option<Fault>) -> Result<Self> {
        Ok(Self::with(backend, fault, Context::open(backend, fault)?))
    }

    /// Draws larger surfaces in tiles of at most this size, which takes less memory and more time.
    /// `None`, the default, draws the largest tiles that the contexts can.
    ///
    /// ```
    /// # fn main() -> tinta::Result<()> {
    /// use std::sync::{Arc, Mutex};
    /// use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Size, Style, StyleName, load};
    ///
    /// let mesh = load("builtin:gear", &LoadOptions::default())?.mesh;
    /// let settings = SceneSettings { size: Size { width: 500, height: 300 }, ..Default::default() };
    /// let scene = Scene::new(vec![Arc::new(mesh)], &settings)?;
    /// let mut renderer = Renderer::new(Backend::Auto)?;
    /// renderer.confine(Some(Size { width: 256, height: 256 }));
    /// let picture = renderer.render(&scene, &Style::named(StyleName::ThreePass))?;
    /// assert_eq!(picture.size, scene.size);
    /// # Ok(())
    /// # }
    /// ```
    pub fn confine(&mut self, largest: Option<Size>) {
        self.confined_to = largest;
        self.drawers.iter_mut().for_each(|drawer| drawer.confine(largest));
    }

    /// Returns the properties of the context that was chosen last.
    pub fn context(&self) -> &ContextInfo {
        self.drawers[self.used].context.info()
    }

    /// Chooses the context for a plan by its size. Every drawing does this automatically; call it before [`Renderer::context`],
    /// [`Renderer::remarks`] or [`Renderer::pruning`] to learn how the plan will be drawn. Pruned or not, a plan has one size.
    ///
    /// # Errors
    ///
    /// [`Error::ContextLost`] where a context was lost.
    pub(crate) fn choose_context(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let surface = scene.size.times(plan.supersample);
        self.used = 0;
        self.drawer().resources.refuse_if_lost("drawing")?;
        if self.backend != Backend::Auto || self.confined_to.is_some() || self.drawer().draws_at_once(surface) {
            return Ok(());
        }
        if let Some(known) = self.drawers.iter().position(|drawer| drawer.draws_at_once(surface)) {
            self.used = known;
            return self.drawer().resources.refuse_if_lost("drawing");
        }
        if surface.pixel_count() > DRAWN_AT_ONCE_PIXELS && self.drawer().tiles(plan, surface).is_some() {
            return Ok(());
        }
        let devices: Vec<&str> = self.drawers.iter().map(|drawer| drawer.context.info().device.as_str()).collect();
        if let Some(context) = Context::open_for(self.backend, self.fault, surface, &devices) {
            let mut drawer = Drawer::new(context);
            drawer.confine(self.confined_to);
            drawer.resources.replace_shaders(self.drawers[0].resources.given_shaders());
            self.drawers.push(drawer);
        }
        // One piece is better than tiles. If neither works, the largest context refuses the picture.
        let fitness = |number: &usize| {
            let drawer = &self.drawers[*number];
            let largest = drawer.context.info().largest_picture.pixel_count();
            // Of the contexts that draw tiles the first is as good as any.
            let in_tiles = drawer.tiles(plan, surface).map(|_| usize::MAX);
            (drawer.draws_at_once(surface), in_tiles.unwrap_or(largest))
        };
        self.used = (0..self.drawers.len()).rev().max_by_key(fitness).unwrap_or(0);
        Ok(())
    }

    /// Returns the deviations from the plan in this context's drawing, a sentence each.
    pub fn remarks(&self, plan: &Plan) -> Vec<String> {
        let info = self.context();
        let mut remarks: Vec<String> = Vec::new();
        for (_, step) in plan.steps() {
            let Step::Draw(Draw { geometry: Geometry::Edges { width_px, is_smooth, line_drawing, .. }, .. }) = step
            else {
                continue;
            };
            if *line_drawing == LineDrawing::Gl && !info.draws_edges(*width_px, *is_smooth) {
                let [[least_line, widest_line], [least_point, widest_point]] = match is_smooth {
                    false => [info.aliased_line_width, info.aliased_point_size],
                    true => [info.smooth_line_width, info.smooth_point_size],
                };
                let larger = match plan.supersample {
                    1 => String::new(),
                    times => format!(", to be shrunk {times} times,"),
                };
                let remark = format!(
                    "lines of {width_px} px{larger} are drawn as quads: {} draws lines of {least_line} to {widest_line} and \
                     points of {least_point} to {widest_point} px",
                    info.renderer
                );
                if !remarks.contains(&remark) {
                    remarks.push(remark);
                }
            }
        }
        remarks.extend(own_shaders::remarks(plan, &self.replaced_shaders()));
        remarks
    }

    /// Returns settings to prune plans for this renderer: every rule that saves time with this context. They assume nothing of
    /// replaced shaders, so call this again after [`Renderer::replace_shaders`].
    pub fn pruning(&self) -> Pruning {
        let info = self.context();
        Pruning {
            keep: Vec::new(),
            is_software: info.is_software(),
            subpixel_bits: info.subpixel_bits,
            replaced_shaders: self.drawers[self.used].resources.replaced_shaders(),
            rest: self.rest.clone(),
        }
    }

    /// Draws a few pixels of one triangle as `style` will draw at this size, pruned or not. The driver then compiles its shaders
    /// now, for example while another thread still reads a large model.
    ///
    /// # Errors
    ///
    /// As [`Renderer::render`].
    pub fn warm_up(
        &mut self,
        settings: &SceneSettings,
        style: &Style,
        show: Show,
        pruning: Option<&Pruning>,
    ) -> Result<()> {
        let camera = CameraSettings::default();
        let scene =
            Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings { copies: 1, camera, ..settings.clone() })?;
        // The plan may need data that the triangle lacks, such as a texture; the models may have it.
        let Ok(plan) = style.plan(&scene, show) else { return Ok(()) };
        // Warm up only the shaders that the drawing will use.
        let mut plan = pruning.map_or_else(|| plan.clone(), |pruning| prune(&plan, &scene, pruning).plan);
        confine(&mut plan, scene.size);
        self.with_context(&scene, &plan, |frame| frame.all_steps(frame.tiles[0]))
    }

    /// Draws a scene in a style, pruned: without steps that cannot change the picture.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] from the style, [`Error::PictureTooLarge`], [`Error::Shader`], [`Error::Gl`].
    pub fn render(&mut self, scene: &Scene, style: &Style) -> Result<Picture> {
        let plan = style.plan(scene, Show::Final)?;
        self.choose_context(scene, &plan)?;
        self.draw(scene, &prune(&plan, scene, &self.pruning()).plan)
    }

    /// Carries out a plan made for this scene.
    ///
    /// # Errors
    ///
    /// [`Error::Plan`] before anything is drawn, [`Error::PictureTooLarge`], [`Error::Shader`], [`Error::Gl`].
    pub fn draw(&mut self, scene: &Scene, plan: &Plan) -> Result<Picture> {
        self.with_context(scene, plan, |frame| frame.picture(plan.output))
    }

    /// Draws `frames` frames after `warm_up` unmeasured ones and returns each one's milliseconds, read-back included.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub fn time_frames(&mut self, scene: &Scene, plan: &Plan, warm_up: usize, frames: usize) -> Result<Vec<f64>> {
        self.with_context(scene, plan, |frame| {
            let mut one = || {
                let start = Instant::now();
                for tile in frame.tiles.clone() {
                    frame.all_steps(tile)?;
                    frame.read_back(tile)?;
                }
                Ok(milliseconds_since(start))
            };
            for _ in 0..warm_up {
                one()?;
            }
            (0..frames).map(|_| one()).collect()
        })
    }

    /// Draws frames until a graphics card has raised its clock, which it lowers at rest; a program that draws has none.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub fn raise_clock(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let start = Instant::now();
        while !self.context().is_software() && milliseconds_since(start) < RAISING_CLOCK_MS {
            self.time_frames(scene, plan, 0, 10)?;
        }
        Ok(())
    }

    /// Draws `frames` frames pass by pass, GL finishing each, and returns the passes' median times.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub fn time_passes(&mut self, scene: &Scene, plan: &Plan, frames: usize) -> Result<Vec<PassTime>> {
        if frames == 0 {
            return Err(Error::value("frames", "0", "at least one frame is needed to time one"));
        }
        self.choose_context(scene, plan)?;
        let has_timers = self.context().timer_queries;
        self.with_context(scene, plan, |frame| {
            let mut times: Vec<(Vec<f64>, Vec<f64>)> = vec![Default::default(); plan.passes.len()];
            for _ in 0..frames {
                let mut sums = vec![(0.0, has_timers.then_some(0.0)); plan.passes.len()];
                for tile in frame.tiles.clone() {
                    frame.resources.begin_tile(plan, tile)?;
                    for (pass, (cpu_ms, gpu_ms)) in plan.passes.iter().zip(&mut sums) {
                        let timer = if has_timers { Some(frame.resources.timer()?) } else { None };
                        let start = Instant::now();
                        timer.iter().for_each(|timer| timer.begin());
                        frame.resources.begin(pass.target, pass.scissor)?;
                        for step in &pass.steps {
                            frame.resources.step(scene, step)?;
                        }
                        timer.iter().for_each(|timer| timer.end());
                        frame.resources.finish();
                        *cpu_ms += milliseconds_since(start);
                        *gpu_ms = timer.map(|timer| gpu_ms.unwrap_or_default() + timer.milliseconds());
                    }
                }
                for ((cpu_ms, gpu_ms), (cpu, gpu)) in sums.into_iter().zip(&mut times) {
                    cpu.push(cpu_ms);
                    gpu.extend(gpu_ms);
                }
            }
            let row = |(pass, (cpu, gpu)): (&crate::plan::Pass, (Vec<f64>, Vec<f64>))| PassTime {
                name: pass.name,
                cpu_ms: median(cpu).unwrap_or_default(),
                gpu_ms: median(gpu),
            };
            Ok(plan.passes.iter().zip(times).map(row).collect())
        })
    }

    /// Draws one frame and returns what GL held after each step.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub fn step_pictures(&mut self, scene: &Scene, plan: &Plan) -> Result<Vec<StepPicture>> {
        self.with_context(scene, plan, |frame| {
            let mut canvases = Vec::new();
            for (number, tile) in frame.tiles.clone().into_iter().enumerate() {
                frame.resources.begin_tile(plan, tile)?;
                let steps = plan.passes.iter().flat_map(|pass| pass.steps.iter().map(move |step| (pass, step)));
                for (place, (pass, step)) in steps.enumerate() {
                    let is_final = matches!(step, Step::Draw(Draw { geometry: Geometry::PictureSquare, .. }));
                    let times = if is_final { plan.supersample } else { 1 };
                    if number == 0 {
                        let whole = if is_final { scene.size } else { tile.whole };
                        canvases.push((pass.name, step.name(), Assembly::new(whole)?));
                    }
                    frame.step(pass, step, tile, times, &mut canvases[place].2)?;
                }
            }
            let picture = |(pass, step, canvas): (_, _, Assembly)| StepPicture { pass, step, picture: canvas.picture };
            Ok(canvases.into_iter().map(picture).collect())
        })
    }

    /// Draws one frame and returns what GL held in these pixels of the surface after each step, in the order of
    /// [`Plan::steps`]. A browser gives no depth back.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`]; also if the picture is too large for one piece.
    pub fn step_values(&mut self, scene: &Scene, plan: &Plan, part: Rectangle) -> Result<Vec<StepValues>> {
        self.with_context(scene, plan, |frame| {
            let &[tile] = frame.tiles.as_slice() else {
                return Err(Error::value(
                    "size",
                    scene.size,
                    "this is read back in one piece; ask for a smaller picture",
                ));
            };
            frame.resources.begin_tile(plan, tile)?;
            let steps = plan.passes.iter().flat_map(|pass| pass.steps.iter().map(move |step| (pass, step)));
            steps.map(|(pass, step)| frame.step_values(pass, step, part)).collect()
        })
    }

    /// Uses these texts as shaders, by their paths below `glsl/`. They replace the built-in ones of the same path, or add new
    /// ones for plans that name them in a [`Program`]. Shaders from earlier calls that are missing now are dropped. A vertex
    /// shader's path ends with `.vert`. All are compiled at once to report mistakes before the next picture. Facts that styles
    /// state of built-in shaders do not hold for their replacements; [`Renderer::pruning`] accounts for this.
    ///
    /// # Errors
    ///
    /// [`Error::Shader`] with the driver's log; the earlier shaders then remain.
    pub fn replace_shaders(&mut self, shaders: HashMap<String, String>) -> Result<()> {
        self.drawers.iter().try_for_each(|drawer| drawer.resources.refuse_if_lost("replacing shaders"))?;
        let before = self.replaced_shaders();
        let replaced = self.drawers.iter_mut().try_for_each(|drawer| drawer.replace_shaders(&shaders));
        if replaced.is_err() {
            // They compiled before.
            self.drawers.iter_mut().try_for_each(|drawer| drawer.replace_shaders(&before))?;
        }
        replaced
    }

    /// The shaders of [`Renderer::replace_shaders`], by their paths.
    pub(crate) fn replaced_shaders(&self) -> HashMap<String, String> {
        self.drawers[0].resources.given_shaders()
    }

    /// Compiles a single shader of `glsl/`, to test whether this driver accepts it.
    ///
    /// # Errors
    ///
    /// [`Error::Shader`] with the driver's log.
    pub fn compile_shader(&mut self, path: &'static str) -> Result<()> {
        let Drawer { resources, context, .. } = self.drawer();
        resources.refuse_if_lost("compiling a shader")?;
        let _current = context.enter()?;
        let compiled = resources.compile(path);
        resources.explain("compiling a shader", compiled)
    }

    /// Returns the shaders linked so far: those of the plans drawn.
    pub fn programs(&self) -> Vec<Program> {
        self.drawers[self.used].resources.programs()
    }

    /// Returns how many GL objects this renderer holds: constant from frame to frame of one scene and plan.
    pub fn live_objects(&self) -> usize {
        self.drawers.iter().map(|drawer| drawer.resources.live_objects()).sum()
    }

    /// Deletes everything the renderer holds and returns how many GL objects are still alive: 0, unless there is a leak.
    pub fn close(mut self) -> usize {
        self.drawers.iter_mut().for_each(Drawer::release);
        self.live_objects()
    }

    fn drawer(&mut self) -> &mut Drawer {
        &mut self.drawers[self.used]
    }

    fn with_context<T>(
        &mut self,
        scene: &Scene,
        plan: &Plan,
        work: impl FnOnce(&mut Frame<'_>) -> Result<T>,
    ) -> Result<T> {
        self.choose_context(scene, plan)?;
        plan.check(scene).map_err(|flaw| Error::Plan { flaw: Box::new(flaw) })?;
        self.drawer().with_context(scene, plan, work)
    }
}

/// Confines a plan's drawing to a few pixels in the middle: enough for the driver to prepare its shaders and states.
fn confine(plan: &mut Plan, size: Size) {
    const SIDE: u32 = 16;
    let Size { width, height } = size.times(plan.supersample);
    let (x, y) = (width.saturating_sub(SIDE) / 2, height.saturating_sub(SIDE) / 2);
    let few = Rectangle { x, y, width: SIDE.min(width), height: SIDE.min(height) };
    for pass in &mut plan.passes {
        pass.scissor = Some(few);
        for step in &mut pass.steps {
            if let Step::Draw(draw) = step {
                draw.scissor = None;
            }
        }
    }
}

/// Processor time of all threads of this process so far, milliseconds; `None` where the system does not tell it. On a software
/// renderer the load of other programs changes it far less than the clock's time.
pub fn processor_milliseconds() -> Option<f64> {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Some(time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 * 1e-6)
    }
    #[cfg(not(unix))]
    None
}

/// Returns the middle value, or the mean of the two middle ones; `None` for an empty list.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => None,
        count if count % 2 == 1 => Some(values[middle]),
        _ => Some((values[middle - 1] + values[middle]) * 0.5),
    }
}

#[cfg(test)]
mod tests {
    use super::median;

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(Vec::new()), None);
    }
}
