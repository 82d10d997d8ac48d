//! One context with what it holds: plans go in, frames come out.

use crate::error::{Error, Result};
use crate::gl::context::{Context, Current};
use crate::gl::execute::Resources;
use crate::picture::Picture;
use crate::plan::{Output, Plan};
use crate::scene::{Scene, Size};
use std::collections::HashMap;

/// A context, its GL objects, and the memory that its pictures are read back into.
pub(super) struct Drawer {
    // Dropped with the context current: see `Drop`.
    pub(super) resources: Resources,
    pub(super) context: Context,
    /// Of the context's surface: the picture's size times the plan's supersampling.
    pub(super) surface: Option<Size>,
    pixels: Vec<u8>,
}

impl Drawer {
    pub(super) fn new(context: Context) -> Self {
        Self { resources: Resources::new(context.gl()), context, surface: None, pixels: Vec::new() }
    }

    fn resize(&mut self, surface: Size, supersample: u32) -> Result<()> {
        let limit = self.context.info().largest_picture;
        if supersample > 1 && !self.context.draws(surface) {
            let largest = Size { width: limit.width / supersample, height: limit.height / supersample };
            let problem = format!(
                "{} draws {limit} pixels at most, which leaves {largest} with this; ask for a smaller --size or less \
                 of it",
                self.context.info().renderer
            );
            return Err(Error::value("supersample", supersample, problem));
        }
        self.context.resize(surface)?;
        let bytes = surface.pixel_count() * 4;
        self.pixels = Vec::new();
        self.pixels
            .try_reserve_exact(bytes)
            .map_err(|_| Error::gl("reading the picture back", "there is not enough memory"))?;
        self.pixels.resize(bytes, 0);
        self.surface = Some(surface);
        Ok(())
    }

    /// Works on a plan that was found sound for this scene, with the context current.
    pub(super) fn with_context<T>(
        &mut self,
        scene: &Scene,
        plan: &Plan,
        work: impl FnOnce(&mut Frame<'_>) -> Result<T>,
    ) -> Result<T> {
        let surface = scene.size.times(plan.supersample);
        if self.surface != Some(surface) {
            self.resize(surface, plan.supersample)?;
        }
        let current: Current<'_> = self.context.enter()?;
        let result = self
            .resources
            .prepare(scene, plan)
            .and_then(|()| work(&mut Frame { resources: &mut self.resources, pixels: &mut self.pixels, scene, plan }));
        let explained = self.resources.explain("drawing", result);
        if explained.is_err() {
            // What was half made must not be taken for whole by the next picture.
            self.resources.clear();
        }
        drop(current);
        explained
    }

    /// Uses these texts as shaders, and no others; those before stay where one of these is refused.
    pub(super) fn replace_shaders(&mut self, shaders: &HashMap<String, String>) -> Result<()> {
        let _current = self.context.enter()?;
        let before = self.resources.replace_shaders(shaders.clone());
        // In a fixed order: of several mistakes the same one is said every time.
        let mut paths: Vec<&String> = shaders.keys().collect();
        paths.sort();
        let compiled = paths.into_iter().try_for_each(|path| self.resources.compile(path));
        if compiled.is_err() {
            self.resources.replace_shaders(before);
        }
        self.resources.explain("compiling shaders", compiled)
    }

    pub(super) fn release(&mut self) {
        match self.context.enter() {
            Ok(_current) => self.resources.clear(),
            // The driver is gone and its objects with it; deleting them now would be calling GL without a context.
            Err(_) => self.resources.forget(),
        }
    }
}

impl Drop for Drawer {
    fn drop(&mut self) {
        self.release();
    }
}

/// A picture in the making, its context current.
pub(super) struct Frame<'a> {
    pub(super) resources: &'a mut Resources,
    pub(super) pixels: &'a mut Vec<u8>,
    scene: &'a Scene,
    plan: &'a Plan,
}

impl Frame<'_> {
    pub(super) fn all_steps(&mut self) -> Result<()> {
        for pass in &self.plan.passes {
            self.resources.begin(pass.target, pass.scissor)?;
            pass.steps.iter().try_for_each(|step| self.resources.step(self.scene, step))?;
        }
        Ok(())
    }

    pub(super) fn read_back(&mut self) -> Result<()> {
        let size = self.scene.size;
        self.resources.begin(self.plan.picture_target(), None)?;
        self.resources.read_framebuffer(size, &mut self.pixels[..size.pixel_count() * 4]);
        self.resources.check("drawing")
    }

    pub(super) fn picture(&self, output: Output) -> Picture {
        let picture = Picture::from_bottom_up(self.scene.size, &self.pixels[..self.scene.size.pixel_count() * 4]);
        match output {
            Output::Rgba => picture,
            Output::Rgb => picture.opaque(),
            Output::AlphaAsGrey => picture.alpha_as_grey(),
        }
    }
}
