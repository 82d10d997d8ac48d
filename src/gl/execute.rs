//! Plans carried out, step by step; every draw sets all the state it needs.

use super::Gl;
use super::legacy::{self, MODELVIEW, PROJECTION};
use super::objects::{Buffer, Program, Shader, Texture, TimerQuery};
use crate::error::{Error, Result};
use crate::mesh::{Mesh, Part, VertexArrays};
use crate::plan::{self, Depth, Draw, Geometry, Plan, Step};
use crate::scene::{Color, Scene, Size};
use crate::tolerances::BACKGROUND_DISTANCE;
use glam::{DVec3, Mat4, Vec3, Vec4};
use glow::HasContext;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The GL objects of a renderer, kept between pictures. Its methods need the context current.
pub struct Resources {
    gl: Rc<Gl>,
    programs: HashMap<plan::Program, Program>,
    meshes: Vec<MeshBuffers>,
    squares: Option<Buffer>,
    border_map: Option<Texture>,
    tone_table: Option<(plan::ToneTable, Texture)>,
}

/// A mesh on the device.
struct MeshBuffers {
    mesh: Arc<Mesh>,
    unit: f64,
    centre: DVec3,
    vertices: Buffer,
    indices: Buffer,
    parts: Vec<Part>,
}

/// Position and normal of each corner: the background square, then the screen square at the near plane.
const SQUARES: [[f32; 6]; 8] = [
    [-1.0, -1.0, 0.0, 0.0, 0.0, 1.0],
    [1.0, -1.0, 0.0, 0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [-1.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [-1.0, -1.0, -1.0, 0.0, 0.0, 1.0],
    [1.0, -1.0, -1.0, 0.0, 0.0, 1.0],
    [1.0, 1.0, -1.0, 0.0, 0.0, 1.0],
    [-1.0, 1.0, -1.0, 0.0, 0.0, 1.0],
];

impl Resources {
    pub fn new(gl: &Rc<Gl>) -> Self {
        Self {
            gl: gl.clone(),
            programs: HashMap::new(),
            meshes: Vec::new(),
            squares: None,
            border_map: None,
            tone_table: None,
        }
    }

    /// Compiles, uploads and sets up whatever this plan needs that is not there yet, and lets go of other scenes' meshes.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let gl = self.gl.clone();
        // SAFETY: the context is current; these are state calls of GL 2.1 with valid names.
        unsafe {
            gl.glow.viewport(0, 0, scene.size.width as i32, scene.size.height as i32);
            gl.glow.pixel_store_i32(glow::PACK_ALIGNMENT, 1);
            gl.glow.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
            for capability in [glow::DITHER, glow::SCISSOR_TEST] {
                gl.glow.disable(capability);
            }
            gl.glow.color_mask(true, true, true, true);
        }
        self.upload_meshes(scene)?;
        if self.squares.is_none() {
            self.squares = Some(Buffer::new(&gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&SQUARES))?);
        }
        if let Some(table) = &plan.tone_table
            && self.tone_table.as_ref().is_none_or(|(present, _)| present != table)
        {
            self.tone_table = Some((table.clone(), upload_tone_table(&gl, table)?));
        }
        for (_, step) in plan.steps() {
            if let Step::Draw(draw) = step
                && !self.programs.contains_key(&draw.program)
            {
                self.programs.insert(draw.program.clone(), Program::new(&gl, &draw.program)?);
            }
        }
        gl.check("setting up")
    }

    fn upload_meshes(&mut self, scene: &Scene) -> Result<()> {
        let is_used = |buffers: &MeshBuffers| {
            buffers.unit == scene.radius && scene.objects.iter().any(|object| Arc::ptr_eq(&object.mesh, &buffers.mesh))
        };
        self.meshes.retain(is_used);
        for object in &scene.objects {
            if self.find_mesh(&object.mesh).is_none() {
                self.meshes.push(MeshBuffers::new(&self.gl, &object.mesh, scene.radius, scene.arrays(object))?);
            }
        }
        Ok(())
    }

    fn find_mesh(&self, mesh: &Arc<Mesh>) -> Option<&MeshBuffers> {
        self.meshes.iter().find(|buffers| Arc::ptr_eq(&buffers.mesh, mesh))
    }

    /// Carries out one step of a prepared plan.
    pub fn step(&mut self, scene: &Scene, step: &Step) -> Result<()> {
        match step {
            Step::Clear { color: [red, green, blue, alpha] } => {
                // SAFETY: the context is current. Clearing obeys the masks, so both are opened.
                unsafe {
                    self.gl.glow.depth_mask(true);
                    self.gl.glow.clear_color(*red, *green, *blue, *alpha);
                    self.gl.glow.clear_depth_f64(1.0);
                    self.gl.glow.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
                }
                Ok(())
            }
            Step::Draw(draw) => self.draw(scene, draw),
            Step::CopyFramebuffer => self.copy_framebuffer(scene.size),
        }
    }

    fn copy_framebuffer(&mut self, size: Size) -> Result<()> {
        if self.border_map.is_none() {
            self.border_map = Some(Texture::new(&self.gl, glow::TEXTURE_2D)?);
        }
        if let Some(texture) = &self.border_map {
            texture.bind(0);
            let (width, height) = (size.width as i32, size.height as i32);
            // SAFETY: the context is current and the texture bound; the rectangle is the whole framebuffer.
            unsafe { self.gl.glow.copy_tex_image_2d(glow::TEXTURE_2D, 0, legacy::RGBA, 0, 0, width, height, 0) };
        }
        Ok(())
    }

    fn draw(&mut self, scene: &Scene, draw: &Draw) -> Result<()> {
        self.set_state(draw);
        for (unit, (_, texture)) in draw.textures.iter().enumerate() {
            let texture = match texture {
                plan::Texture::BorderMap => self.border_map.as_ref(),
                plan::Texture::ToneTable => self.tone_table.as_ref().map(|(_, texture)| texture),
            };
            texture.ok_or_else(|| Error::gl("drawing", "a plan reads a texture before it is made"))?.bind(unit as u32);
        }
        let program = self
            .programs
            .get_mut(&draw.program)
            .ok_or_else(|| Error::gl("drawing", "a plan was carried out without being prepared"))?;
        program.bind();
        for uniform in &draw.uniforms {
            program.set(uniform.name, uniform.value);
        }
        for (unit, (sampler, _)) in draw.textures.iter().enumerate() {
            program.set_sampler(sampler, unit as u32);
        }
        match draw.geometry {
            Geometry::Objects => self.draw_objects(scene),
            Geometry::BackgroundSquare { color } => {
                let far_away = Mat4::from_translation(Vec3::new(0.0, 0.0, -BACKGROUND_DISTANCE));
                // x and y as they are, depth that of the far plane: a parallel projection that fills the picture.
                let flat = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::ZERO, Vec4::new(0.0, 0.0, 1.0, 1.0));
                self.draw_square(0, color, &far_away, &flat);
            }
            Geometry::ScreenSquare => self.draw_square(4, [1.0; 4], &Mat4::IDENTITY, &Mat4::IDENTITY),
        }
        Ok(())
    }

    fn set_state(&self, draw: &Draw) {
        let gl = &self.gl.glow;
        // SAFETY: the context is current; the names are of GL 2.1.
        unsafe {
            match draw.depth {
                Depth::TestAndWrite => {
                    gl.enable(glow::DEPTH_TEST);
                    gl.depth_func(glow::LESS);
                    gl.depth_mask(true);
                }
                Depth::Ignore => {
                    gl.disable(glow::DEPTH_TEST);
                    gl.depth_mask(false);
                }
            }
            if draw.cull_back_faces {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::BACK);
                gl.front_face(glow::CCW);
            } else {
                gl.disable(glow::CULL_FACE);
            }
            if draw.blend {
                gl.enable(glow::BLEND);
                // Colour as the paper blends; alpha adds up to the picture's coverage, which plain blending would square.
                gl.blend_func_separate(
                    glow::SRC_ALPHA,
                    glow::ONE_MINUS_SRC_ALPHA,
                    glow::ONE,
                    glow::ONE_MINUS_SRC_ALPHA,
                );
            } else {
                gl.disable(glow::BLEND);
            }
        }
    }

    fn draw_objects(&self, scene: &Scene) {
        let legacy = &self.gl.legacy;
        let clip_from_view = scene.clip_from_view();
        // SAFETY: the context is current.
        unsafe { legacy.load_matrix(PROJECTION, &clip_from_view) };
        let mut bound: Option<*const Mesh> = None;
        for object in &scene.objects {
            let Some(buffers) = self.find_mesh(&object.mesh) else { continue };
            if bound != Some(Arc::as_ptr(&object.mesh)) {
                buffers.vertices.bind();
                buffers.indices.bind();
                // SAFETY: the context is current and the bound buffer holds interleaved positions and normals.
                unsafe { legacy.position_and_normal_arrays() };
                bound = Some(Arc::as_ptr(&object.mesh));
            }
            // SAFETY: the context is current.
            unsafe { legacy.load_matrix(MODELVIEW, &scene.view_from_object(object, buffers.centre)) };
            for part in &buffers.parts {
                let Color([red, green, blue]) = scene.material_color(&object.mesh, part.material);
                // SAFETY: the context is current.
                unsafe { legacy.color([red, green, blue, 1.0]) };
                // SAFETY: the context is current; the part lies within the bound index buffer, whose indices lie within the
                // bound vertex buffer, both by construction of `VertexArrays`.
                unsafe {
                    let first_byte = part.first as i32 * size_of::<u32>() as i32;
                    self.gl.glow.draw_elements(glow::TRIANGLES, part.count as i32, glow::UNSIGNED_INT, first_byte);
                }
            }
        }
    }

    fn draw_square(&self, first: i32, color: [f32; 4], view_from_square: &Mat4, clip_from_view: &Mat4) {
        if let Some(squares) = &self.squares {
            squares.bind();
        }
        // SAFETY: the context is current and the bound buffer holds both squares, four vertices each.
        unsafe {
            self.gl.legacy.position_and_normal_arrays();
            self.gl.legacy.load_matrix(PROJECTION, clip_from_view);
            self.gl.legacy.load_matrix(MODELVIEW, view_from_square);
            self.gl.legacy.color(color);
            self.gl.glow.draw_arrays(legacy::QUADS, first, 4);
        }
    }

    /// Reads the framebuffer, RGBA8, bottom row first, into memory of exactly that size.
    pub fn read_framebuffer(&self, size: Size, pixels: &mut [u8]) {
        assert_eq!(pixels.len(), size.pixel_count() * 4, "memory for {size} pixels");
        let (width, height) = (size.width as i32, size.height as i32);
        let target = glow::PixelPackData::Slice(Some(pixels));
        // SAFETY: the context is current, rows are packed without gaps, and the memory has the size asserted.
        unsafe { self.gl.glow.read_pixels(0, 0, width, height, glow::RGBA, glow::UNSIGNED_BYTE, target) };
    }

    /// Reads the texture the framebuffer was last copied to, as [`Resources::read_framebuffer`] does.
    pub fn read_border_map(&self, size: Size, pixels: &mut [u8]) {
        assert_eq!(pixels.len(), size.pixel_count() * 4, "memory for {size} pixels");
        if let Some(texture) = &self.border_map {
            texture.bind(0);
            let target = glow::PixelPackData::Slice(Some(pixels));
            // SAFETY: the context is current, the bound texture was copied from a framebuffer of this size.
            unsafe { self.gl.glow.get_tex_image(glow::TEXTURE_2D, 0, glow::RGBA, glow::UNSIGNED_BYTE, target) };
        }
    }

    /// Waits until everything is drawn.
    pub fn finish(&self) {
        // SAFETY: the context is current.
        unsafe { self.gl.glow.finish() }
    }

    /// A timer, for contexts that have them.
    pub fn timer(&self) -> Result<TimerQuery> {
        TimerQuery::new(&self.gl)
    }

    /// Returns GL's error since the last check.
    pub fn check(&self, during: &str) -> Result<()> {
        self.gl.check(during)
    }

    /// Compiles a shader by itself and lets go of it.
    pub fn compile(&self, path: &'static str) -> Result<()> {
        let kind = if path.ends_with(".vert") { glow::VERTEX_SHADER } else { glow::FRAGMENT_SHADER };
        Shader::new(&self.gl, kind, path).map(drop)
    }

    /// Deletes everything; the context must be current.
    pub fn clear(&mut self) {
        *self = Self::new(&self.gl.clone());
    }

    /// Lets go of everything without a word to GL, for a context that is lost.
    pub fn forget(&mut self) {
        std::mem::forget(std::mem::replace(self, Self::new(&self.gl.clone())));
    }

    /// How many GL objects are alive.
    pub fn live_objects(&self) -> usize {
        self.gl.live_objects.get()
    }
}

impl MeshBuffers {
    fn new(gl: &Rc<Gl>, mesh: &Arc<Mesh>, unit: f64, arrays: &VertexArrays) -> Result<Self> {
        Ok(Self {
            mesh: mesh.clone(),
            unit,
            centre: arrays.centre,
            vertices: Buffer::new(gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&arrays.vertices))?,
            indices: Buffer::new(gl, glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&arrays.indices))?,
            parts: arrays.parts.clone(),
        })
    }
}

fn upload_tone_table(gl: &Rc<Gl>, table: &plan::ToneTable) -> Result<Texture> {
    let texture = Texture::new(gl, glow::TEXTURE_1D)?;
    let texels = glow::PixelUnpackData::Slice(Some(table.texels.as_flattened()));
    // SAFETY: the context is current, the texture bound, and the texels are two bytes each, packed.
    unsafe {
        gl.glow.tex_image_1d(
            glow::TEXTURE_1D,
            0,
            legacy::LUMINANCE8_ALPHA8 as i32,
            table.texels.len() as i32,
            0,
            legacy::LUMINANCE_ALPHA,
            glow::UNSIGNED_BYTE,
            texels,
        );
    }
    Ok(texture)
}
