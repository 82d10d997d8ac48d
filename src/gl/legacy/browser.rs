//! The fixed-function pipeline for WebGL, which draws with shaders alone. Its state is kept here and passed to the shaders as
//! uniforms and attributes; [`crate::glsl::es`] names them.

use super::{FIXED_UNITS, MODELVIEW, PROJECTION, QUADS};
use crate::glsl::es::{ATTRIBUTES, UNIFORMS};
use glam::{Mat3, Mat4};
use glow::HasContext;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::js_sys::Array;
use web_sys::{WebGlRenderingContext, WebglDrawBuffers};

/// The shaders in `glsl/fixed/` draw steps without a program.
pub(in crate::gl) const HAS_PIPELINE: bool = false;

/// Whether the depth buffer can be copied into a texture; a texture can be the depth buffer instead.
pub(in crate::gl) const COPIES_DEPTH: bool = false;

/// The texture target of a plan's tables: a picture one texel high.
pub(in crate::gl) const TABLE_TARGET: u32 = glow::TEXTURE_2D;

/// Luminance and alpha, 8 bits each.
pub(in crate::gl) const TABLE_TEXELS: u32 = super::LUMINANCE_ALPHA;

/// The format of uploaded pictures, 8 bits a channel.
pub(in crate::gl) const PICTURE_TEXELS: u32 = glow::RGBA;

/// Whether a texture that repeats has to have powers of two for sides.
pub(in crate::gl) const REPEATS_POWERS_OF_TWO_ONLY: bool = true;

/// `GL_HALF_FLOAT_OES`
const HALF_FLOAT: u32 = 0x8D61;

/// The format and the type of texels drawn into: 8 bits, then floating point of 16 and 32 bits.
pub(in crate::gl) const DRAWN_TEXELS: [(u32, u32); 3] =
    [(glow::RGBA, glow::UNSIGNED_BYTE), (glow::RGBA, HALF_FLOAT), (glow::RGBA, glow::FLOAT)];

/// A depth buffer of 24 bits, and its attachment point: WebGL has them only with a stencil.
pub(in crate::gl) const DEPTH_BUFFER: (u32, u32) = (glow::DEPTH_STENCIL, glow::DEPTH_STENCIL_ATTACHMENT);

/// A depth texture: internal format, format and type.
pub(in crate::gl) const DEPTH_TEXELS: [u32; 3] = [glow::DEPTH_STENCIL, glow::DEPTH_STENCIL, glow::UNSIGNED_INT_24_8];

/// The attributes' locations, in the order of [`ATTRIBUTES`].
const VERTEX: u32 = 0;
const NORMAL: u32 = 1;
const COLOR: u32 = 2;
const COORDINATES: u32 = 3;

/// The locations of [`UNIFORMS`] in a program.
type Locations = [Option<glow::UniformLocation>; UNIFORMS.len()];

/// The pipeline's state.
pub(in crate::gl) struct Legacy {
    gl: Rc<glow::Context>,
    /// The same context, for queries that glow lacks.
    raw: WebGlRenderingContext,
    view_from_object: Cell<Mat4>,
    clip_from_view: Cell<Mat4>,
    program: Cell<Option<glow::Program>>,
    locations: RefCell<HashMap<glow::Program, Locations>>,
    /// Indices that split squares of four corners into triangles, and the number of squares they cover.
    squares: Cell<Option<(glow::Buffer, u32)>>,
}

impl Legacy {
    pub(in crate::gl) fn new(gl: Rc<glow::Context>, raw: WebGlRenderingContext) -> Self {
        Self {
            gl,
            raw,
            view_from_object: Cell::new(Mat4::IDENTITY),
            clip_from_view: Cell::new(Mat4::IDENTITY),
            program: Cell::new(None),
            locations: RefCell::default(),
            squares: Cell::new(None),
        }
    }

    /// Whether the context is lost.
    pub(in crate::gl) fn is_lost(&self) -> bool {
        self.raw.is_context_lost()
    }

    /// Whether textures can be depth buffers.
    pub(in crate::gl) fn has_depth_textures(&self) -> bool {
        matches!(self.raw.get_extension("WEBGL_depth_texture"), Ok(Some(_)))
    }

    /// The width and height of the current drawing surface, pixels.
    pub(in crate::gl) fn surface(&self) -> [u32; 2] {
        [self.raw.drawing_buffer_width(), self.raw.drawing_buffer_height()].map(|side| side.max(0) as u32)
    }

    /// Why the context is lost, GL_NO_ERROR if it is not.
    ///
    /// # Safety
    ///
    /// None; the driver's twin asks the driver.
    pub(in crate::gl) unsafe fn reset_status(&self) -> u32 {
        if self.raw.is_context_lost() { glow::UNKNOWN_CONTEXT_RESET } else { glow::NO_ERROR }
    }

    /// glMatrixMode and glLoadMatrixf: `mode` is [`MODELVIEW`](super::MODELVIEW) or [`PROJECTION`](super::PROJECTION).
    ///
    /// # Safety
    ///
    /// None; the driver's twin calls the driver.
    pub(in crate::gl) unsafe fn load_matrix(&self, mode: u32, matrix: &Mat4) {
        debug_assert!(mode == MODELVIEW || mode == PROJECTION);
        if mode == MODELVIEW { self.view_from_object.set(*matrix) } else { self.clip_from_view.set(*matrix) }
    }

    /// glColor4f.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn color(&self, [red, green, blue, alpha]: [f32; 4]) {
        // SAFETY: the caller's promise.
        unsafe { self.gl.vertex_attrib_4_f32(COLOR, red, green, blue, alpha) }
    }

    /// Positions and normals interleaved, three floats each, from the start of the bound array buffer; no colours, no texture
    /// coordinates.
    ///
    /// # Safety
    ///
    /// The context is current and the buffer bound to GL_ARRAY_BUFFER holds such vertices.
    pub(in crate::gl) unsafe fn position_and_normal_arrays(&self) {
        const STRIDE: i32 = 24;
        // SAFETY: the caller's promise.
        unsafe {
            self.no_others();
            self.gl.enable_vertex_attrib_array(NORMAL);
            self.gl.vertex_attrib_pointer_f32(VERTEX, 3, glow::FLOAT, false, STRIDE, 0);
            self.gl.vertex_attrib_pointer_f32(NORMAL, 3, glow::FLOAT, false, STRIDE, 12);
        }
    }

    /// Positions in clip space, four floats each, from the start of the bound array buffer, and nothing else.
    ///
    /// # Safety
    ///
    /// As [`Legacy::position_and_normal_arrays`].
    pub(in crate::gl) unsafe fn clip_position_array(&self) {
        // SAFETY: as above.
        unsafe {
            self.no_others();
            self.gl.disable_vertex_attrib_array(NORMAL);
            self.gl.vertex_attrib_pointer_f32(VERTEX, 4, glow::FLOAT, false, 0, 0);
        }
    }

    /// Texture coordinates of a unit, this many floats per vertex, from the start of the bound array buffer.
    ///
    /// # Safety
    ///
    /// The context is current and the bound buffer holds them for all vertices that will be drawn.
    pub(in crate::gl) unsafe fn texture_coordinate_array(&self, unit: u32, numbers: i32) {
        // SAFETY: as above.
        unsafe {
            self.gl.enable_vertex_attrib_array(COORDINATES + unit);
            self.gl.vertex_attrib_pointer_f32(COORDINATES + unit, numbers, glow::FLOAT, false, 0, 0);
        }
    }

    /// Colours, four floats a vertex, from the start of the bound array buffer; until other arrays are set.
    ///
    /// # Safety
    ///
    /// As [`Legacy::texture_coordinate_array`].
    pub(in crate::gl) unsafe fn color_array(&self) {
        // SAFETY: as above.
        unsafe {
            self.gl.enable_vertex_attrib_array(COLOR);
            self.gl.vertex_attrib_pointer_f32(COLOR, 4, glow::FLOAT, false, 0, 0);
        }
    }

    unsafe fn no_others(&self) {
        // SAFETY: the caller's promise.
        unsafe {
            self.gl.enable_vertex_attrib_array(VERTEX);
            for place in COLOR..COORDINATES + FIXED_UNITS {
                self.gl.disable_vertex_attrib_array(place);
            }
        }
    }

    /// The shaders multiply.
    ///
    /// # Safety
    ///
    /// None; the driver's twin calls the driver.
    pub(in crate::gl) unsafe fn modulate(&self) {}

    /// Points are a pixel wide; wider ones are drawn as squares.
    ///
    /// # Safety
    ///
    /// None; the driver's twin calls the driver.
    pub(in crate::gl) unsafe fn point_size(&self, _: f32) {}

    /// Sets the attributes' locations.
    pub(in crate::gl) fn before_linking(&self, gl: &glow::Context, program: glow::Program) {
        for (place, (.., name)) in (0..).zip(ATTRIBUTES) {
            // SAFETY: the context is current, the program alive.
            unsafe { gl.bind_attrib_location(program, place, name) };
        }
    }

    /// Records the program that the following draws use.
    pub(in crate::gl) fn program_bound(&self, program: glow::Program) {
        self.program.set(Some(program));
    }

    /// WebGL needs no call before a picture is uploaded.
    ///
    /// # Safety
    ///
    /// None; the driver's twin calls the driver.
    pub(in crate::gl) unsafe fn keep_mipmaps(&self, _: &glow::Context) {}

    /// Makes the smaller levels of the texture just uploaded.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn make_mipmaps(&self, gl: &glow::Context) {
        // SAFETY: the caller's promise.
        unsafe { gl.generate_mipmap(glow::TEXTURE_2D) }
    }

    /// glDrawBuffers, by the extension itself: glow 0.17 passes it a list within a list, which names no buffer.
    ///
    /// # Safety
    ///
    /// None; the driver's twin calls the driver.
    pub(in crate::gl) unsafe fn draw_buffers(&self, _: &glow::Context, buffers: &[u32]) {
        if let Ok(Some(extension)) = self.raw.get_extension("WEBGL_draw_buffers") {
            let list: Array = buffers.iter().map(|buffer| JsValue::from(*buffer)).collect();
            extension.unchecked_into::<WebglDrawBuffers>().draw_buffers_webgl(&list);
        }
    }

    /// glDrawElements of 32-bit indices.
    ///
    /// # Safety
    ///
    /// The context is current, the indices lie within the bound buffers.
    pub(in crate::gl) unsafe fn draw_elements(&self, gl: &glow::Context, mode: u32, count: i32, first_byte: i32) {
        // SAFETY: the caller's promise.
        unsafe {
            self.hand_over(gl);
            gl.draw_elements(mode, count, glow::UNSIGNED_INT, first_byte);
        }
    }

    /// glDrawArrays; squares as two triangles each.
    ///
    /// # Safety
    ///
    /// The context is current, the vertices lie within the bound buffers.
    pub(in crate::gl) unsafe fn draw_arrays(&self, gl: &glow::Context, mode: u32, first: i32, count: i32) {
        // SAFETY: the caller's promise; the squares' indices reach as far as the vertices do.
        unsafe {
            self.hand_over(gl);
            if mode != QUADS {
                return gl.draw_arrays(mode, first, count);
            }
            self.bind_squares(gl, (first + count) as u32 / 4);
            let first_byte = first / 4 * 6 * size_of::<u32>() as i32;
            gl.draw_elements(glow::TRIANGLES, count / 4 * 6, glow::UNSIGNED_INT, first_byte);
        }
    }

    /// Binds indices for at least this many squares.
    unsafe fn bind_squares(&self, gl: &glow::Context, count: u32) {
        let present = self.squares.get().filter(|(_, reach)| *reach >= count);
        // SAFETY: the caller's promise: the context is current.
        unsafe {
            if let Some((buffer, _)) = present {
                return gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(buffer));
            }
            let Ok(buffer) = self.squares.get().map_or_else(|| gl.create_buffer(), |(buffer, _)| Ok(buffer)) else {
                return;
            };
            let reach = count.next_power_of_two();
            let indices: Vec<u32> =
                (0..reach).flat_map(|it| [0, 1, 3, 1, 2, 3].map(|corner| it * 4 + corner)).collect();
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(buffer));
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&indices), glow::DYNAMIC_DRAW);
            self.squares.set(Some((buffer, reach)));
        }
    }

    /// Sets the uniforms through which the bound program reads the pipeline's state.
    unsafe fn hand_over(&self, gl: &glow::Context) {
        let Some(program) = self.program.get() else { return };
        let mut all = self.locations.borrow_mut();
        // SAFETY: the caller's promise: the context is current, the program bound.
        let locations = all
            .entry(program)
            .or_insert_with(|| UNIFORMS.map(|(.., name)| unsafe { gl.get_uniform_location(program, name) }));
        let (view_from_object, clip_from_view) = (self.view_from_object.get(), self.clip_from_view.get());
        let normal = Mat3::from_mat4(view_from_object).as_dmat3().inverse().transpose().as_mat3();
        let [model_view, projection, both, normals] = &*locations;
        // SAFETY: as above; uniforms that the program lacks are skipped.
        unsafe {
            gl.uniform_matrix_4_f32_slice(model_view.as_ref(), false, view_from_object.as_ref());
            gl.uniform_matrix_4_f32_slice(projection.as_ref(), false, clip_from_view.as_ref());
            gl.uniform_matrix_4_f32_slice(both.as_ref(), false, (clip_from_view * view_from_object).as_ref());
            gl.uniform_matrix_3_f32_slice(normals.as_ref(), false, normal.as_ref());
        }
    }

    /// Forgets a deleted program, whose name may be reused.
    pub(in crate::gl) fn program_deleted(&self, program: glow::Program) {
        self.locations.borrow_mut().remove(&program);
    }

    /// Reads a texture of this size that was copied from colour, four bytes a pixel; depth cannot be copied here.
    ///
    /// # Safety
    ///
    /// The context is current, the texture alive, and the memory of its size.
    pub(in crate::gl) unsafe fn read_texture(
        &self,
        gl: &glow::Context,
        texture: glow::Texture,
        size: [i32; 2],
        _is_depth: bool,
        pixels: &mut [u8],
    ) {
        // SAFETY: the caller's promise; rows are packed without gaps.
        unsafe {
            let Ok(framebuffer) = gl.create_framebuffer() else { return };
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let (target, attachment) = (glow::FRAMEBUFFER, glow::COLOR_ATTACHMENT0);
            gl.framebuffer_texture_2d(target, attachment, glow::TEXTURE_2D, Some(texture), 0);
            let memory = glow::PixelPackData::Slice(Some(pixels));
            gl.read_pixels(0, 0, size[0], size[1], glow::RGBA, glow::UNSIGNED_BYTE, memory);
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            gl.delete_framebuffer(framebuffer);
        }
    }
}
