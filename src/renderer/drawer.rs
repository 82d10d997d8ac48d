//! One context and its resources: plans go in, frames come out.

use crate::error::{Error, Result};
use crate::gl::context::{Context, Current};
use crate::gl::execute::Resources;
use crate::limits::{DRAWN_AT_ONCE_PIXELS, TILE_SIDE_PX};
use crate::picture::Picture;
use crate::plan::{Format, Output, Pass, Plan, Step, Target, Tile, TileLimits};
use crate::scene::{Rectangle, Scene, Size};
use std::collections::HashMap;

/// A context, its GL objects, and the memory that its pictures are read back into.
pub(super) struct Drawer {
    // Dropped with the context current: see `Drop`.
    pub(super) resources: Resources,
    pub(super) context: Context,
    /// Size of the context's surface: the picture's size times the plan's supersampling, or a tile's.
    pub(super) surface: Option<Size>,
    pixels: Vec<u8>,
    /// Largest surface to draw at once, if below the context's largest.
    confined_to: Option<Size>,
}

impl Drawer {
    pub(super) fn new(context: Context) -> Self {
        let resources = Resources::new(context.gl());
        Self { resources, context, surface: None, pixels: Vec::new(), confined_to: None }
    }

    /// Draws larger surfaces in tiles of at most this size.
    pub(super) fn confine(&mut self, largest: Option<Size>) {
        self.confined_to = largest;
    }

    /// Whether it draws surfaces of this size in one piece.
    pub(super) fn draws_at_once(&self, surface: Size) -> bool {
        let is_within = |limit: Size| surface.width <= limit.width && surface.height <= limit.height;
        self.context.draws(surface)
            && surface.pixel_count() <= DRAWN_AT_ONCE_PIXELS
            && self.confined_to.is_none_or(is_within)
    }

    /// Returns the tiles of a surface of this size, drawn one after the other; `None` if it cannot be drawn.
    pub(super) fn tiles(&self, plan: &Plan, surface: Size) -> Option<Vec<Tile>> {
        match self.draws_at_once(surface) {
            true => Some(vec![Tile::whole(surface)]),
            false => plan.tiles(surface, self.limits()),
        }
    }

    fn limits(&self) -> TileLimits {
        let info = self.context.info();
        let least = |a: Size, b: Size| Size { width: a.width.min(b.width), height: a.height.min(b.height) };
        let side = Size { width: TILE_SIDE_PX, height: TILE_SIDE_PX };
        let surface = least(self.confined_to.unwrap_or(side), info.largest_picture);
        TileLimits { surface, viewport: info.largest_viewport }
    }

    /// Returns the error that explains why a surface of this size cannot be drawn.
    fn refusal(&self, scene: &Scene, plan: &Plan) -> Error {
        let info = self.context.info();
        let limits = TileLimits { surface: info.largest_picture, ..self.limits() };
        let limit = plan.largest_surface(limits).unwrap_or(info.largest_picture);
        if plan.supersample == 1 {
            return Error::PictureTooLarge {
                width: scene.size.width,
                height: scene.size.height,
                limit_width: limit.width,
                limit_height: limit.height,
                renderer: info.renderer.clone(),
            };
        }
        let largest = Size { width: limit.width / plan.supersample, height: limit.height / plan.supersample };
        let problem = format!(
            "{} draws {limit} pixels at most, which leaves {largest} with this; ask for a smaller --size or less of it",
            info.renderer
        );
        Error::value("supersample", plan.supersample, problem)
    }

    fn resize(&mut self, surface: Size) -> Result<()> {
        self.context.resize(surface)?;
        self.pixels = memory(surface.pixel_count() * 4)?;
        self.surface = Some(surface);
        Ok(())
    }

    /// Runs work on a plan that was checked for this scene, with the context current.
    pub(super) fn with_context<T>(
        &mut self,
        scene: &Scene,
        plan: &Plan,
        work: impl FnOnce(&mut Frame<'_>) -> Result<T>,
    ) -> Result<T> {
        scene.check_precision()?;
        let whole = scene.size.times(plan.supersample);
        let tiles = self.tiles(plan, whole).ok_or_else(|| self.refusal(scene, plan))?;
        let longest = |side: fn(&Tile) -> u32| tiles.iter().map(side).max().unwrap_or(1);
        let surface = Size { width: longest(|tile| tile.drawn.width), height: longest(|tile| tile.drawn.height) };
        if self.surface != Some(surface) {
            self.resize(surface)?;
        }
        let current: Current<'_> = self.context.enter()?;
        let result = self.resources.prepare(scene, plan).and_then(|()| {
            work(&mut Frame { resources: &mut self.resources, pixels: &mut self.pixels, tiles, scene, plan })
        });
        let explained = self.resources.explain("drawing", result);
        if explained.is_err() {
            // The next picture must not use half-made resources.
            self.resources.clear();
        }
        drop(current);
        explained
    }

    /// Uses these texts as shaders in place of all earlier ones; if one of these is refused, the earlier ones stay.
    pub(super) fn replace_shaders(&mut self, shaders: &HashMap<String, String>) -> Result<()> {
        let _current = self.context.enter()?;
        let before = self.resources.replace_shaders(shaders.clone());
        // Sorted, to report the same one of several mistakes every time.
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
            // The driver is gone with its objects; deleting them now would call GL without a context.
            Err(_) => self.resources.forget(),
        }
    }
}

impl Drop for Drawer {
    fn drop(&mut self) {
        self.release();
    }
}

/// Returns this many bytes of 0, or an error if memory is short.
fn memory(bytes: usize) -> Result<Vec<u8>> {
    let mut memory = Vec::new();
    memory.try_reserve_exact(bytes).map_err(|_| Error::gl("reading the picture back", "not enough memory"))?;
    memory.resize(bytes, 0);
    Ok(memory)
}

/// A picture in progress, its context current.
pub(super) struct Frame<'a> {
    pub(super) resources: &'a mut Resources,
    pub(super) pixels: &'a mut Vec<u8>,
    /// The tiles, drawn one after the other.
    pub(super) tiles: Vec<Tile>,
    scene: &'a Scene,
    plan: &'a Plan,
}

impl Frame<'_> {
    /// Carries out the plan, tile by tile.
    pub(super) fn all_steps(&mut self, tile: Tile) -> Result<()> {
        self.resources.begin_tile(self.plan, tile)?;
        for pass in &self.plan.passes {
            self.resources.begin(pass.target, pass.scissor)?;
            pass.steps.iter().try_for_each(|step| self.resources.step(self.scene, step))?;
        }
        Ok(())
    }

    /// Carries out one step of a tile and puts its result, or for a copy the copy, into its place.
    pub(super) fn step(
        &mut self,
        pass: &Pass,
        step: &Step,
        tile: Tile,
        times: u32,
        canvas: &mut Assembly,
    ) -> Result<()> {
        self.resources.begin(pass.target, pass.scissor)?;
        self.resources.step(self.scene, step)?;
        // Before reading: a failed copy leaves a texture of another size.
        self.resources.check(pass.name)?;
        let (part, place) = shrunk(tile, times);
        match step {
            Step::CopyFramebuffer | Step::CopyDepth => {
                let size = tile.size();
                let copied = &mut self.pixels[..size.pixel_count() * 4];
                self.resources.read_copy(step, size, copied);
                canvas.put(place, &cut(copied, size, part));
            }
            Step::Clear { .. } | Step::ClearEach { .. } | Step::Draw(_) => {
                self.resources.read_framebuffer(part, &mut self.pixels[..part.pixel_count() * 4]);
                canvas.put(place, self.pixels);
            }
        }
        self.resources.check(pass.name)
    }

    /// Carries out one step of a picture in one piece and reads what the target then holds in some pixels.
    pub(super) fn step_values(&mut self, pass: &Pass, step: &Step, part: Rectangle) -> Result<StepValues> {
        self.resources.begin(pass.target, pass.scissor)?;
        self.resources.step(self.scene, step)?;
        let (formats, has_depth) = match pass.target {
            Target::Framebuffer => (vec![Format::Unorm8], true),
            Target::Textures(to) => (to.colors.iter().map(|color| color.format).collect(), to.has_depth),
        };
        let colors =
            (0..).zip(formats).map(|(number, format)| self.resources.read_colors(number, format, part)).collect();
        let depth = if has_depth { self.resources.read_depth(part) } else { Vec::new() };
        self.resources.check(pass.name)?;
        Ok(StepValues { part, colors, depth })
    }

    /// Reads back a tile's part of the picture.
    pub(super) fn read_back(&mut self, tile: Tile) -> Result<Rectangle> {
        self.resources.begin(self.plan.picture_target(), None)?;
        let (part, place) = shrunk(tile, self.plan.supersample);
        self.resources.read_framebuffer(part, &mut self.pixels[..part.pixel_count() * 4]);
        self.resources.check("drawing").map(|()| place)
    }

    /// Draws all tiles.
    pub(super) fn picture(&mut self, output: Output) -> Result<Picture> {
        let mut canvas = Assembly::new(self.scene.size)?;
        for tile in self.tiles.clone() {
            self.all_steps(tile)?;
            let place = self.read_back(tile)?;
            canvas.put(place, self.pixels);
        }
        let picture = canvas.picture;
        Ok(match output {
            Output::Rgba => picture,
            Output::Rgb => picture.opaque(),
            Output::AlphaAsGrey => picture.alpha_as_grey(),
        })
    }
}

/// Returns the rectangle of the picture within a tile, and its place in the picture.
fn shrunk(tile: Tile, times: u32) -> (Rectangle, Rectangle) {
    let by_times = |Rectangle { x, y, width, height }: Rectangle| {
        let [x, y, width, height] = [x, y, width, height].map(|number| number / times);
        Rectangle { x, y, width, height }
    };
    let Rectangle { x, y, .. } = tile.drawn;
    let part = Rectangle { x: tile.kept.x - x, y: tile.kept.y - y, ..tile.kept };
    (by_times(part), by_times(tile.kept))
}

/// Cuts a rectangle out of rows of pixels.
fn cut(pixels: &[u8], size: Size, part: Rectangle) -> Vec<u8> {
    let rows = pixels.chunks_exact(size.width as usize * 4).skip(part.y as usize).take(part.height as usize);
    rows.flat_map(|row| &row[part.x as usize * 4..][..part.width as usize * 4]).copied().collect()
}

/// GL's numbers after one step, in some pixels of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct StepValues {
    /// The pixels.
    pub part: Rectangle,
    /// For each texture of the target, or the framebuffer: red, green, blue and alpha of each pixel, bottom row first.
    pub colors: Vec<Vec<[f32; 4]>>,
    /// The depth of each pixel, 0 to 1; empty if the target has no depth buffer, and in a browser.
    pub depth: Vec<f32>,
}

/// A picture assembled from parts.
pub(super) struct Assembly {
    pub(super) picture: Picture,
}

impl Assembly {
    pub(super) fn new(size: Size) -> Result<Self> {
        Ok(Self { picture: Picture { size, pixels: memory(size.pixel_count() * 4)? } })
    }

    /// Puts GL's rows, bottom row first, into their place.
    pub(super) fn put(&mut self, place: Rectangle, pixels: &[u8]) {
        let Size { width, height } = self.picture.size;
        let (length, start) = (place.width as usize * 4, place.x as usize * 4);
        for (row, source) in (place.y..place.y + place.height).zip(pixels.chunks_exact(length)) {
            let from_top = (height - 1 - row) as usize;
            let target = from_top * width as usize * 4 + start;
            self.picture.pixels[target..target + length].copy_from_slice(source);
        }
    }
}
