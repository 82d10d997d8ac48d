//! Executes plans step by step; every draw sets all the state it needs.

use super::Gl;
use super::buffers::{EdgeIndices, FaceIndices, MeshBuffers, OfVertices};
use super::fixed_function;
use super::legacy;
use super::objects::{Buffer, Program, Shader, TimerQuery};
use super::sources;
use super::square::Square;
use super::targets::{Targets, clear_each};
use super::textures::Textures;
use crate::error::{Error, Result};
use crate::glsl;
use crate::plan::{self, Blend, Depth, Draw, Format, Geometry, LineDrawing, Plan, Step, Submission, Target, Tile};
use crate::scene::{Rectangle, Scene, Size};
use glam::Mat4;
use glow::HasContext;
use std::collections::HashMap;
use std::rc::Rc;

/// The GL objects of a renderer, kept between pictures. Its methods need the context current.
pub(crate) struct Resources {
    pub(super) gl: Rc<Gl>,
    pub(super) programs: HashMap<plan::Program, Program>,
    pub(super) meshes: Vec<MeshBuffers>,
    /// The lists of faces of this plan's draws.
    pub(super) faces: Vec<FaceIndices>,
    /// The texture coordinates and colours of their paint.
    pub(super) coordinates: Vec<OfVertices<[f32; 2]>>,
    pub(super) colors: Vec<OfVertices<[f32; 4]>>,
    pub(super) squares: Option<Buffer>,
    /// The tile of the whole surface, whose size is the picture's or a multiple of it.
    pub(super) tile: Tile,
    /// The factor from the picture's sides to the whole's.
    supersample: u32,
    targets: Targets,
    pass_scissor: Option<Rectangle>,
    /// Whether the steps draw into textures instead of the framebuffer.
    into_textures: bool,
    pub(super) textures: Textures,
    /// Whether the driver draws steps without shaders, as in OpenGL 2.1; otherwise equivalent shaders draw them.
    pub(super) has_pipeline: bool,
    /// The edges last drawn, as indices on the device.
    pub(super) edges: Vec<EdgeIndices>,
    /// How the current plan passes vertices.
    pub(super) submission: Submission,
}

impl Resources {
    pub(crate) fn new(gl: &Rc<Gl>) -> Self {
        Self {
            gl: gl.clone(),
            programs: HashMap::new(),
            meshes: Vec::new(),
            faces: Vec::new(),
            coordinates: Vec::new(),
            colors: Vec::new(),
            squares: None,
            tile: Tile::whole(Size { width: 1, height: 1 }),
            supersample: 1,
            targets: Targets::default(),
            pass_scissor: None,
            into_textures: false,
            textures: Textures::default(),
            has_pipeline: legacy::HAS_PIPELINE,
            edges: Vec::new(),
            submission: Submission::Buffers,
        }
    }

    /// Compiles, uploads and sets up whatever this plan still lacks, and releases other scenes' meshes.
    pub(crate) fn prepare(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let gl = self.gl.clone();
        // SAFETY: the context is current; these are state calls of GL 2.1 with valid names.
        unsafe {
            gl.glow.pixel_store_i32(glow::PACK_ALIGNMENT, 1);
            gl.glow.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
            gl.glow.disable(glow::DITHER);
            gl.glow.color_mask(true, true, true, true);
        }
        if plan.submission != Submission::Buffers {
            gl.immediate()?;
        }
        self.submission = plan.submission;
        self.upload_meshes(scene)?;
        self.upload_faces(scene, plan)?;
        self.upload_paint(plan)?;
        self.upload_squares()?;
        self.textures.prepare(&gl, scene, plan)?;
        for (_, step) in plan.steps() {
            if let Step::Draw(draw) = step
                && draw.textures.len() > gl.info.texture_units as usize
            {
                let what = format!(
                    "the style reads {} textures at once, this driver allows {}; use another style or --backend",
                    draw.textures.len(),
                    gl.info.texture_units
                );
                return Err(Error::gl("setting up", what));
            }
            if let Step::Draw(draw) = step
                && let Some(program) = fixed_function::program_of(draw, self.has_pipeline)
                && !self.programs.contains_key(&program)
            {
                let linked = Program::new(&gl, &program)?;
                self.programs.insert(program, linked);
            }
        }
        gl.check("setting up")
    }

    /// Selects the part of a prepared plan that the following steps draw: all of it, or one tile.
    pub(crate) fn begin_tile(&mut self, plan: &Plan, tile: Tile) -> Result<()> {
        self.tile = tile;
        self.supersample = plan.supersample;
        self.targets.prepare(&self.gl.clone(), plan, tile.size())
    }

    /// Selects the target of the following steps of a prepared plan, and the pixels they may change.
    pub(crate) fn begin(&mut self, target: Target, scissor: Option<Rectangle>) -> Result<()> {
        self.pass_scissor = scissor;
        self.into_textures = matches!(target, Target::Textures(_));
        self.targets.begin(&self.gl, target)
    }

    /// Carries out one step of a prepared plan.
    pub(crate) fn step(&mut self, scene: &Scene, step: &Step) -> Result<()> {
        self.set_scissor(match step {
            Step::Draw(draw) => draw.scissor.or(self.pass_scissor),
            _ => self.pass_scissor,
        });
        match step {
            Step::Clear { color, depth } => {
                let mut buffers = 0;
                // SAFETY: the context is current. Clearing obeys the depth mask, so it is opened.
                unsafe {
                    if let Some([red, green, blue, alpha]) = *color {
                        self.gl.glow.clear_color(red, green, blue, alpha);
                        buffers |= glow::COLOR_BUFFER_BIT;
                    }
                    if *depth {
                        self.gl.glow.depth_mask(true);
                        self.gl.glow.clear_depth(1.0);
                        buffers |= glow::DEPTH_BUFFER_BIT;
                    }
                    self.gl.glow.clear(buffers);
                }
                Ok(())
            }
            Step::ClearEach { colors } => {
                clear_each(&self.gl, colors);
                Ok(())
            }
            Step::Draw(draw) => self.draw(scene, draw),
            Step::CopyFramebuffer => self.targets.copy_color(&self.gl, self.tile.size(), self.copied_part()),
            Step::CopyDepth => self.targets.copy_depth(&self.gl, self.tile.size(), self.copied_part()),
        }
    }

    /// Copies depth, or takes it as in a browser.
    #[cfg(test)]
    pub(crate) fn copy_depth(&mut self, copies_depth: bool) {
        self.targets = Targets::copying_depth(copies_depth);
    }

    fn draw(&mut self, scene: &Scene, draw: &Draw) -> Result<()> {
        let Tile { drawn, viewport, .. } = self.tile;
        // As far left and below as the tile lies right and above of the viewport's corner.
        let corner = [viewport.x as i32 - drawn.x as i32, viewport.y as i32 - drawn.y as i32];
        let [x, y, width, height] = match draw.geometry {
            Geometry::PictureSquare => {
                [0, 0, drawn.width / self.supersample, drawn.height / self.supersample].map(|number| number as i32)
            }
            _ => [corner[0], corner[1], viewport.width as i32, viewport.height as i32],
        };
        // SAFETY: the context is current; tiles keep the size within its limits.
        unsafe { self.gl.glow.viewport(x, y, width, height) };
        self.set_state(draw);
        self.bind_textures(draw)?;
        self.bind_program(draw)?;
        match &draw.geometry {
            Geometry::Objects(paint) => {
                self.check_back_faces(draw)?;
                let material_unit = draw.material_unit().map(|(unit, _)| unit as u32);
                if material_unit.is_some_and(|unit| unit >= legacy::FIXED_UNITS) {
                    return Err(Error::gl("drawing", "a plan reads the models' own pictures by a third unit"));
                }
                self.draw_objects(scene, draw, paint, material_unit)?;
            }
            Geometry::Edges { runs, mark, width_px, is_smooth, line_drawing } => {
                let by_gl = self.gl.info.draws_edges(*width_px, *is_smooth) && (self.has_pipeline || !*is_smooth);
                let as_quads = *line_drawing == LineDrawing::Quads || !by_gl;
                if as_quads && *is_smooth && *line_drawing == LineDrawing::Gl && !self.has_pipeline {
                    self.draw_smooth_edges(scene, runs, *mark, *width_px)?;
                } else if as_quads {
                    self.draw_edge_quads(scene, runs, *mark, *width_px)?;
                } else {
                    self.draw_edges(scene, runs, *mark, *width_px, *is_smooth)?;
                }
            }
            square => {
                if let Some(square) = Square::of(square) {
                    self.draw_square(&square)?;
                }
            }
        }
        Ok(())
    }

    /// Converts a projection of the whole picture to this tile's viewport.
    pub(super) fn in_tile(&self, clip_from_view: Mat4) -> Mat4 {
        self.tile.clip_from_picture().map_or(clip_from_view, |tile| tile * clip_from_view)
    }

    fn bind_textures(&self, draw: &Draw) -> Result<()> {
        for (unit, (_, texture)) in draw.textures.iter().enumerate() {
            let texture = match texture {
                plan::Texture::BorderMap => self.targets.border_map(),
                plan::Texture::Drawn(name) => self.targets.drawn(*name),
                plan::Texture::DepthMap => self.targets.depth_map(),
                plan::Texture::Table(number) => self.textures.table(*number),
                plan::Texture::Picture(number) => self.textures.picture(*number),
                plan::Texture::Material { .. } => self.textures.white(),
            };
            texture
                .ok_or_else(|| Error::gl("drawing", "a plan was carried out without being checked"))?
                .bind(unit as u32);
        }
        if !self.has_pipeline {
            return Ok(());
        }
        let is_fixed = draw.program.as_ref().is_none_or(|program| program.fragments.is_empty());
        for unit in 0..legacy::FIXED_UNITS {
            // SAFETY: the context is current; the names are of GL 2.1, whose drivers have two units.
            unsafe {
                self.gl.glow.active_texture(glow::TEXTURE0 + unit);
                if is_fixed && draw.textures.len() > unit as usize {
                    self.gl.glow.enable(glow::TEXTURE_2D);
                    self.gl.legacy.modulate();
                } else {
                    self.gl.glow.disable(glow::TEXTURE_2D);
                }
            }
        }
        Ok(())
    }

    fn bind_program(&mut self, draw: &Draw) -> Result<()> {
        let Some(drawing) = fixed_function::program_of(draw, self.has_pipeline) else {
            // SAFETY: the context is current; no program is the fixed-function pipeline.
            unsafe { self.gl.glow.use_program(None) };
            return Ok(());
        };
        let program = self
            .programs
            .get_mut(&drawing)
            .ok_or_else(|| Error::gl("drawing", "a plan was carried out without being prepared"))?;
        program.bind(self.into_textures);
        for uniform in &draw.uniforms {
            program.set(uniform.name.clone(), self.tile.value(uniform.value));
        }
        for (unit, (sampler, _)) in (0..).zip(&draw.textures) {
            program.set_sampler(fixed_function::sampler(draw, &drawing, unit).unwrap_or(sampler), unit);
        }
        Ok(())
    }

    /// The rectangle that a copying step copies: the whole tile, or the part its pass is confined to; pixels outside are never
    /// read.
    fn copied_part(&self) -> Option<Rectangle> {
        self.pass_scissor.and_then(|scissor| self.tile.part(scissor))
    }

    fn set_scissor(&self, scissor: Option<Rectangle>) {
        const NOTHING: Rectangle = Rectangle { x: 0, y: 0, width: 0, height: 0 };
        // The surface may be larger than a tile.
        let confined = scissor.or((!self.tile.is_whole()).then_some(self.tile.drawn));
        // SAFETY: the context is current; the rectangle's numbers are below 2^31, as the surface's are.
        unsafe {
            match confined.map(|scissor| self.tile.part(scissor).unwrap_or(NOTHING)) {
                Some(Rectangle { x, y, width, height }) => {
                    self.gl.glow.enable(glow::SCISSOR_TEST);
                    self.gl.glow.scissor(x as i32, y as i32, width as i32, height as i32);
                }
                None => self.gl.glow.disable(glow::SCISSOR_TEST),
            }
        }
    }

    fn set_state(&self, draw: &Draw) {
        let gl = &self.gl.glow;
        // SAFETY: the context is current; the names are of GL 2.1.
        unsafe {
            if self.has_pipeline {
                // Driver settings can smooth every polygon; C. Dachsbacher's article warns of this (errata D13).
                gl.disable(glow::POLYGON_SMOOTH);
            }
            match draw.depth {
                Depth::TestAndWrite | Depth::TestOnly | Depth::Equal => {
                    gl.enable(glow::DEPTH_TEST);
                    gl.depth_func(if draw.depth == Depth::Equal { glow::EQUAL } else { glow::LESS });
                    gl.depth_mask(draw.depth == Depth::TestAndWrite);
                }
                Depth::Ignore => {
                    gl.disable(glow::DEPTH_TEST);
                    gl.depth_mask(false);
                }
            }
            gl.front_face(glow::CCW);
            self.set_sides(draw);
            match draw.polygon_offset {
                Some([factor, units]) => {
                    gl.enable(glow::POLYGON_OFFSET_FILL);
                    gl.polygon_offset(factor, units);
                }
                None => gl.disable(glow::POLYGON_OFFSET_FILL),
            }
            match draw.blend {
                Blend::Replace => gl.disable(glow::BLEND),
                Blend::Over => {
                    gl.enable(glow::BLEND);
                    // Colour blends as in the article. Alpha adds up to the picture's coverage; plain blending would square it.
                    gl.blend_func_separate(
                        glow::SRC_ALPHA,
                        glow::ONE_MINUS_SRC_ALPHA,
                        glow::ONE,
                        glow::ONE_MINUS_SRC_ALPHA,
                    );
                }
                Blend::Multiply => {
                    gl.enable(glow::BLEND);
                    gl.blend_func_separate(glow::DST_COLOR, glow::ZERO, glow::ZERO, glow::ONE);
                }
            }
        }
    }

    /// Reads this part of the framebuffer, RGBA8, bottom row first, into memory of exactly that size.
    pub(crate) fn read_framebuffer(&self, part: Rectangle, pixels: &mut [u8]) {
        assert_eq!(pixels.len(), part.pixel_count() * 4, "memory for {part:?}");
        let [x, y, width, height] = [part.x, part.y, part.width, part.height].map(|number| number as i32);
        let target = glow::PixelPackData::Slice(Some(pixels));
        // SAFETY: the context is current, rows are packed without gaps, and the memory has the size asserted.
        unsafe { self.gl.glow.read_pixels(x, y, width, height, glow::RGBA, glow::UNSIGNED_BYTE, target) };
    }

    /// Reads these pixels of the target's texture of this number and format, 0 for the framebuffer, as numbers: red, green, blue,
    /// alpha, bottom row first.
    pub(crate) fn read_colors(&self, number: u32, format: Format, part: Rectangle) -> Vec<[f32; 4]> {
        let mut values = vec![[0.0; 4]; part.pixel_count()];
        // A browser reads bytes as bytes only.
        let mut bytes = match legacy::HAS_PIPELINE || format != Format::Unorm8 {
            true => Vec::new(),
            false => vec![[0_u8; 4]; part.pixel_count()],
        };
        let [x, y, width, height] = [part.x, part.y, part.width, part.height].map(|number| number as i32);
        let (kind, memory): (u32, &mut [u8]) = match bytes.is_empty() {
            true => (glow::FLOAT, bytemuck::cast_slice_mut(&mut values)),
            false => (glow::UNSIGNED_BYTE, bytes.as_flattened_mut()),
        };
        let pixels = glow::PixelPackData::Slice(Some(memory));
        // SAFETY: the context is current, rows are packed without gaps, and the memory has four numbers of this kind a pixel. The
        // texture read by default is chosen again.
        unsafe {
            if self.into_textures {
                self.gl.glow.read_buffer(glow::COLOR_ATTACHMENT0 + number);
            }
            self.gl.glow.read_pixels(x, y, width, height, glow::RGBA, kind, pixels);
            if self.into_textures {
                self.gl.glow.read_buffer(glow::COLOR_ATTACHMENT0);
            }
        }
        for (value, read) in values.iter_mut().zip(bytes) {
            *value = read.map(|byte| f32::from(byte) / 255.0);
        }
        values
    }

    /// Reads these pixels of the target's depth buffer, bottom row first; it must have one. In a browser none.
    pub(crate) fn read_depth(&self, part: Rectangle) -> Vec<f32> {
        if !legacy::HAS_PIPELINE {
            return Vec::new();
        }
        let mut values = vec![0.0; part.pixel_count()];
        let [x, y, width, height] = [part.x, part.y, part.width, part.height].map(|number| number as i32);
        let pixels = glow::PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut values)));
        // SAFETY: the context is current, rows are packed without gaps, and the memory has a float a pixel.
        unsafe { self.gl.glow.read_pixels(x, y, width, height, glow::DEPTH_COMPONENT, glow::FLOAT, pixels) };
        values
    }

    /// Reads the texture that this copying step filled, as [`Resources::read_framebuffer`] does; depth becomes grey.
    pub(crate) fn read_copy(&self, step: &Step, size: Size, pixels: &mut [u8]) {
        assert_eq!(pixels.len(), size.pixel_count() * 4, "memory for {size} pixels");
        let is_depth = *step == Step::CopyDepth;
        let copied = if is_depth { self.targets.depth_map() } else { self.targets.border_map() };
        let Some(texture) = copied else { return };
        texture.bind(0);
        let bytes = if is_depth { size.pixel_count() } else { pixels.len() };
        let sides = [size.width as i32, size.height as i32];
        // SAFETY: the context is current, the bound texture was copied from a framebuffer of this size; rows are packed
        // without gaps and the memory has one byte a pixel for depth, four for colour.
        unsafe { self.gl.legacy.read_texture(&self.gl.glow, texture.id(), sides, is_depth, &mut pixels[..bytes]) };
        if is_depth {
            for pixel in (0..bytes).rev() {
                let grey = pixels[pixel];
                pixels[pixel * 4..][..4].copy_from_slice(&[grey, grey, grey, u8::MAX]);
            }
        }
    }

    /// Returns the shaders linked so far.
    pub(crate) fn programs(&self) -> Vec<plan::Program> {
        self.programs.keys().cloned().collect()
    }

    /// Waits until GL has drawn everything.
    pub(crate) fn finish(&self) {
        // SAFETY: the context is current.
        unsafe { self.gl.glow.finish() }
    }

    /// Makes a timer, in contexts that have them.
    pub(crate) fn timer(&self) -> Result<TimerQuery> {
        TimerQuery::new(&self.gl)
    }

    /// Returns GL's error since the last check.
    pub(crate) fn check(&self, during: &str) -> Result<()> {
        self.gl.check(during)
    }

    /// Returns an error if the context is lost.
    pub(crate) fn refuse_if_lost(&self, during: &str) -> Result<()> {
        self.gl.refuse_if_lost(during)
    }

    /// Returns the result of some work, or GL's own error if the work reported none. A lost context explains any other error.
    pub(crate) fn explain<T>(&self, during: &str, result: Result<T>) -> Result<T> {
        match (result, self.check(during)) {
            (Err(lost @ Error::ContextLost { .. }), _) | (_, Err(lost @ Error::ContextLost { .. })) => Err(lost),
            (Err(error), _) => Err(error),
            (Ok(value), checked) => checked.map(|()| value),
        }
    }

    /// Uses these texts for the shaders they name, and relinks all programs when they are next needed. Returns the texts used so
    /// far.
    pub(crate) fn replace_shaders(&mut self, shaders: HashMap<String, String>) -> HashMap<String, String> {
        self.programs.clear();
        self.gl.replaced_shaders.replace(shaders)
    }

    /// Returns the replaced shader texts, by path.
    pub(crate) fn given_shaders(&self) -> HashMap<String, String> {
        self.gl.replaced_shaders.borrow().clone()
    }

    /// Returns the built-in shaders that other texts replace, sorted by path.
    pub(crate) fn replaced_shaders(&self) -> Vec<String> {
        let replaced = self.gl.replaced_shaders.borrow();
        let is_other = |(path, text): &(&String, &String)| glsl::source(path).is_some_and(|built_in| built_in != *text);
        let mut paths: Vec<String> = replaced.iter().filter(is_other).map(|(path, _)| path.clone()).collect();
        paths.sort();
        paths
    }

    /// Compiles a single shader and releases it. In a browser, which compiles only whole programs, the shader is only rewritten.
    pub(crate) fn compile(&self, path: &str) -> Result<()> {
        let source = sources::of_shader(&self.gl, path)?;
        if legacy::HAS_PIPELINE { Shader::new(&self.gl, &source).map(drop) } else { Ok(()) }
    }

    /// Deletes everything; the context must be current.
    pub(crate) fn clear(&mut self) {
        *self = Self::new(&self.gl.clone());
    }

    /// Drops everything without calling GL, for a lost context.
    pub(crate) fn forget(&mut self) {
        std::mem::forget(std::mem::replace(self, Self::new(&self.gl.clone())));
    }

    /// Returns the number of live GL objects.
    pub(crate) fn live_objects(&self) -> usize {
        self.gl.live_objects.get()
    }
}

#[cfg(test)]
mod tests;
