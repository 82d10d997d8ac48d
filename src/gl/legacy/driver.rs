//! The fixed-function entry points of OpenGL 2.1 that glow lacks, loaded by name into one small table.

use super::FIXED_UNITS;
use glow::HasContext;
use std::ffi::{CStr, c_char, c_void};

/// The pipeline draws steps without a program.
pub(in crate::gl) const HAS_PIPELINE: bool = true;

/// Whether the depth buffer can be copied into a texture.
pub(in crate::gl) const COPIES_DEPTH: bool = true;

/// The texture target of a plan's tables.
pub(in crate::gl) const TABLE_TARGET: u32 = glow::TEXTURE_1D;

/// Luminance and alpha, 8 bits each.
pub(in crate::gl) const TABLE_TEXELS: u32 = 0x8045;

/// Opaque pictures, 8 bits a channel.
pub(in crate::gl) const PICTURE_TEXELS: u32 = glow::RGB8;

/// Whether a texture that repeats has to have powers of two for sides.
pub(in crate::gl) const REPEATS_POWERS_OF_TWO_ONLY: bool = false;

/// The format and the type of texels drawn into: 8 bits, then floating point of 16 and 32 bits.
pub(in crate::gl) const DRAWN_TEXELS: [(u32, u32); 3] =
    [(glow::RGBA8, glow::UNSIGNED_BYTE), (glow::RGBA16F, glow::FLOAT), (glow::RGBA32F, glow::FLOAT)];

/// A depth buffer of 24 bits, and its attachment point.
pub(in crate::gl) const DEPTH_BUFFER: (u32, u32) = (glow::DEPTH_COMPONENT24, glow::DEPTH_ATTACHMENT);

/// A depth texture: internal format, format and type.
pub(in crate::gl) const DEPTH_TEXELS: [u32; 3] = [glow::DEPTH_COMPONENT24, glow::DEPTH_COMPONENT, glow::UNSIGNED_INT];

/// `GL_SMOOTH_LINE_WIDTH_RANGE`
pub(in crate::gl) const SMOOTH_LINE_WIDTH_RANGE: u32 = 0x0B22;
/// `GL_SMOOTH_POINT_SIZE_RANGE`
pub(in crate::gl) const SMOOTH_POINT_SIZE_RANGE: u32 = 0x0B12;
/// `GL_ALIASED_POINT_SIZE_RANGE`
pub(in crate::gl) const ALIASED_POINT_SIZE_RANGE: u32 = 0x846D;
/// `GL_GENERATE_MIPMAP`
const GENERATE_MIPMAP: u32 = 0x8191;
/// `GL_VERTEX_ARRAY`
const VERTEX_ARRAY: u32 = 0x8074;
/// `GL_NORMAL_ARRAY`
const NORMAL_ARRAY: u32 = 0x8075;
/// `GL_COLOR_ARRAY`
const COLOR_ARRAY: u32 = 0x8076;
/// `GL_TEXTURE_COORD_ARRAY`
const TEXTURE_COORD_ARRAY: u32 = 0x8078;
/// `GL_TEXTURE_ENV`
const TEXTURE_ENV: u32 = 0x2300;
/// `GL_TEXTURE_ENV_MODE`
const TEXTURE_ENV_MODE: u32 = 0x2200;
/// `GL_MODULATE`
const MODULATE: i32 = 0x2100;

type EnumFunction = unsafe extern "system" fn(u32);
type LoadMatrix = unsafe extern "system" fn(*const f32);
type Color = unsafe extern "system" fn(f32, f32, f32, f32);
type VertexPointer = unsafe extern "system" fn(i32, u32, i32, *const c_void);
type NormalPointer = unsafe extern "system" fn(u32, i32, *const c_void);
type TextureEnvironment = unsafe extern "system" fn(u32, u32, i32);
type PointSize = unsafe extern "system" fn(f32);
type GetString = unsafe extern "system" fn(u32) -> *const c_char;
type ResetStatus = unsafe extern "system" fn() -> u32;

/// The functions, each with the type of the specification.
pub(in crate::gl) struct Legacy {
    matrix_mode: EnumFunction,
    load_matrix: LoadMatrix,
    color: Color,
    enable_client_state: EnumFunction,
    disable_client_state: EnumFunction,
    client_active_texture: EnumFunction,
    vertex_pointer: VertexPointer,
    normal_pointer: NormalPointer,
    color_pointer: VertexPointer,
    texture_coordinate_pointer: VertexPointer,
    texture_environment: TextureEnvironment,
    point_size: PointSize,
    get_string: GetString,
    reset_status: Option<ResetStatus>,
}

impl Legacy {
    /// Every driver of OpenGL 2.1 has them.
    pub(in crate::gl) fn has_depth_textures(&self) -> bool {
        true
    }

    /// Loads the table; the error names the first function the driver does not have.
    ///
    /// # Safety
    ///
    /// `load` returns null or the address of the GL function of that name for the current context.
    pub(in crate::gl) unsafe fn load(mut load: impl FnMut(&CStr) -> *const c_void) -> Result<Self, String> {
        let mut find = |name: &'static CStr| {
            let address = load(name);
            if address.is_null() {
                return Err(format!("the driver has no {}, which OpenGL 2.1 requires", name.to_string_lossy()));
            }
            Ok(address)
        };
        // SAFETY: each address is that of the function named, whose C type is the one in the table.
        unsafe {
            Ok(Self {
                matrix_mode: std::mem::transmute::<*const c_void, EnumFunction>(find(c"glMatrixMode")?),
                load_matrix: std::mem::transmute::<*const c_void, LoadMatrix>(find(c"glLoadMatrixf")?),
                color: std::mem::transmute::<*const c_void, Color>(find(c"glColor4f")?),
                enable_client_state: std::mem::transmute::<*const c_void, EnumFunction>(find(c"glEnableClientState")?),
                disable_client_state: std::mem::transmute::<*const c_void, EnumFunction>(find(
                    c"glDisableClientState",
                )?),
                client_active_texture: std::mem::transmute::<*const c_void, EnumFunction>(find(
                    c"glClientActiveTexture",
                )?),
                vertex_pointer: std::mem::transmute::<*const c_void, VertexPointer>(find(c"glVertexPointer")?),
                normal_pointer: std::mem::transmute::<*const c_void, NormalPointer>(find(c"glNormalPointer")?),
                color_pointer: std::mem::transmute::<*const c_void, VertexPointer>(find(c"glColorPointer")?),
                texture_coordinate_pointer: std::mem::transmute::<*const c_void, VertexPointer>(find(
                    c"glTexCoordPointer",
                )?),
                texture_environment: std::mem::transmute::<*const c_void, TextureEnvironment>(find(c"glTexEnvi")?),
                point_size: std::mem::transmute::<*const c_void, PointSize>(find(c"glPointSize")?),
                get_string: std::mem::transmute::<*const c_void, GetString>(find(c"glGetString")?),
                reset_status: None,
            })
        }
    }

    /// Adds the function of ARB_robustness, for [`Legacy::reset_status`].
    ///
    /// # Safety
    ///
    /// As [`Legacy::load`], and the context has the extension: drivers give addresses even for functions they lack.
    pub(in crate::gl) unsafe fn load_robustness(&mut self, mut load: impl FnMut(&CStr) -> *const c_void) {
        // The extension's own name, then that of KHR_robustness and OpenGL 4.5.
        let names = [c"glGetGraphicsResetStatusARB", c"glGetGraphicsResetStatus"];
        if let Some(address) = names.into_iter().map(&mut load).find(|address| !address.is_null()) {
            // SAFETY: the address is that of the function named, whose C type this is.
            self.reset_status = Some(unsafe { std::mem::transmute::<*const c_void, ResetStatus>(address) });
        }
    }

    /// glGetGraphicsResetStatusARB: why the context is lost. GL_NO_ERROR if it is not lost or the cause is unknown.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn reset_status(&self) -> u32 {
        // SAFETY: the caller's promise.
        self.reset_status.map_or(glow::NO_ERROR, |reset_status| unsafe { reset_status() })
    }

    /// glGetString; `None` where the context does not know the name, or is lost.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn string(&self, name: u32) -> Option<String> {
        // SAFETY: the caller's promise; GL's strings end with 0 and live as long as the context.
        unsafe {
            let text = (self.get_string)(name);
            (!text.is_null()).then(|| CStr::from_ptr(text).to_string_lossy().into_owned())
        }
    }

    /// glMatrixMode and glLoadMatrixf: `mode` is [`MODELVIEW`](super::MODELVIEW) or [`PROJECTION`](super::PROJECTION).
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn load_matrix(&self, mode: u32, matrix: &glam::Mat4) {
        // SAFETY: the caller's promise; the matrix is 16 floats, column by column.
        unsafe {
            (self.matrix_mode)(mode);
            (self.load_matrix)(matrix.as_ref().as_ptr());
        }
    }

    /// glColor4f.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn color(&self, [red, green, blue, alpha]: [f32; 4]) {
        // SAFETY: the caller's promise.
        unsafe { (self.color)(red, green, blue, alpha) }
    }

    /// Positions and normals interleaved, three floats each, from the start of the bound array buffer; no colours, no texture
    /// coordinates.
    ///
    /// # Safety
    ///
    /// The context is current and the buffer bound to GL_ARRAY_BUFFER holds such vertices.
    pub(in crate::gl) unsafe fn position_and_normal_arrays(&self) {
        const STRIDE: i32 = 24;
        // SAFETY: the caller's promise; with a buffer bound the pointers are offsets into it.
        unsafe {
            self.no_texture_coordinates();
            (self.disable_client_state)(COLOR_ARRAY);
            (self.enable_client_state)(VERTEX_ARRAY);
            (self.enable_client_state)(NORMAL_ARRAY);
            (self.vertex_pointer)(3, glow::FLOAT, STRIDE, std::ptr::null());
            (self.normal_pointer)(glow::FLOAT, STRIDE, std::ptr::without_provenance(12));
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
            self.no_texture_coordinates();
            (self.disable_client_state)(COLOR_ARRAY);
            (self.enable_client_state)(VERTEX_ARRAY);
            (self.disable_client_state)(NORMAL_ARRAY);
            (self.vertex_pointer)(4, glow::FLOAT, 0, std::ptr::null());
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
            (self.client_active_texture)(glow::TEXTURE0 + unit);
            (self.enable_client_state)(TEXTURE_COORD_ARRAY);
            (self.texture_coordinate_pointer)(numbers, glow::FLOAT, 0, std::ptr::null());
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
            (self.enable_client_state)(COLOR_ARRAY);
            (self.color_pointer)(4, glow::FLOAT, 0, std::ptr::null());
        }
    }

    unsafe fn no_texture_coordinates(&self) {
        for unit in 0..FIXED_UNITS {
            // SAFETY: the caller's promise.
            unsafe {
                (self.client_active_texture)(glow::TEXTURE0 + unit);
                (self.disable_client_state)(TEXTURE_COORD_ARRAY);
            }
        }
    }

    /// Multiplies the active texture unit's colour with what came before it, where no fragment shader runs.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn modulate(&self) {
        // SAFETY: the caller's promise.
        unsafe { (self.texture_environment)(TEXTURE_ENV, TEXTURE_ENV_MODE, MODULATE) }
    }

    /// glPointSize.
    ///
    /// # Safety
    ///
    /// The context is current; the size is above 0.
    pub(in crate::gl) unsafe fn point_size(&self, size_px: f32) {
        // SAFETY: the caller's promise.
        unsafe { (self.point_size)(size_px) }
    }

    /// Programs need no further parts before linking.
    pub(in crate::gl) fn before_linking(&self, _: &glow::Context, _: glow::Program) {}

    /// The driver's pipeline already knows the bound program.
    pub(in crate::gl) fn program_bound(&self, _: glow::Program) {}

    /// Forgets a deleted program.
    pub(in crate::gl) fn program_deleted(&self, _: glow::Program) {}

    /// Makes GL compute the smaller levels of the texture just bound at each upload of the largest: the way of GL 1.4 to 2.1.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn keep_mipmaps(&self, gl: &glow::Context) {
        // SAFETY: the caller's promise.
        unsafe { gl.tex_parameter_i32(glow::TEXTURE_2D, GENERATE_MIPMAP, 1) }
    }

    /// They already exist.
    ///
    /// # Safety
    ///
    /// The context is current.
    pub(in crate::gl) unsafe fn make_mipmaps(&self, _: &glow::Context) {}

    /// glDrawBuffers.
    ///
    /// # Safety
    ///
    /// The context is current and has that many.
    pub(in crate::gl) unsafe fn draw_buffers(&self, gl: &glow::Context, buffers: &[u32]) {
        // SAFETY: the caller's promise.
        unsafe { gl.draw_buffers(buffers) }
    }

    /// glDrawElements of 32-bit indices.
    ///
    /// # Safety
    ///
    /// The context is current, the indices lie within the bound buffers.
    pub(in crate::gl) unsafe fn draw_elements(&self, gl: &glow::Context, mode: u32, count: i32, first_byte: i32) {
        // SAFETY: the caller's promise.
        unsafe { gl.draw_elements(mode, count, glow::UNSIGNED_INT, first_byte) }
    }

    /// glDrawArrays.
    ///
    /// # Safety
    ///
    /// The context is current, the vertices lie within the bound buffers.
    pub(in crate::gl) unsafe fn draw_arrays(&self, gl: &glow::Context, mode: u32, first: i32, count: i32) {
        // SAFETY: the caller's promise.
        unsafe { gl.draw_arrays(mode, first, count) }
    }

    /// Reads a texture of this size that was copied from colour or depth: glGetTexImage, four bytes a pixel or one of depth.
    ///
    /// # Safety
    ///
    /// The context is current, the texture bound, and the memory of its size.
    pub(in crate::gl) unsafe fn read_texture(
        &self,
        gl: &glow::Context,
        _: glow::Texture,
        _: [i32; 2],
        is_depth: bool,
        pixels: &mut [u8],
    ) {
        let format = if is_depth { glow::DEPTH_COMPONENT } else { glow::RGBA };
        // SAFETY: the caller's promise; rows are packed without gaps.
        unsafe {
            let target = glow::PixelPackData::Slice(Some(pixels));
            gl.get_tex_image(glow::TEXTURE_2D, 0, format, glow::UNSIGNED_BYTE, target);
        }
    }
}
