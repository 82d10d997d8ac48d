//! The fixed-function entry points of OpenGL 2.1 that glow lacks, loaded by name into one small table.

use std::ffi::{CStr, c_void};

/// `GL_MODELVIEW`
pub const MODELVIEW: u32 = 0x1700;
/// `GL_PROJECTION`
pub const PROJECTION: u32 = 0x1701;
/// `GL_VERTEX_ARRAY`
pub const VERTEX_ARRAY: u32 = 0x8074;
/// `GL_NORMAL_ARRAY`
pub const NORMAL_ARRAY: u32 = 0x8075;
/// `GL_LUMINANCE_ALPHA`
pub const LUMINANCE_ALPHA: u32 = 0x190A;
/// `GL_LUMINANCE8_ALPHA8`
pub const LUMINANCE8_ALPHA8: u32 = 0x8045;
/// `GL_RGBA` as the internal format the paper copies to.
pub const RGBA: u32 = 0x1908;
/// `GL_QUADS`
pub const QUADS: u32 = 0x0007;
/// `GL_ALPHA_BITS`
pub const ALPHA_BITS: u32 = 0x0D55;
/// `GL_DEPTH_BITS`
pub const DEPTH_BITS: u32 = 0x0D56;
/// `GL_SMOOTH_LINE_WIDTH_RANGE`
pub const SMOOTH_LINE_WIDTH_RANGE: u32 = 0x0B22;
/// `GL_ALIASED_LINE_WIDTH_RANGE`
pub const ALIASED_LINE_WIDTH_RANGE: u32 = 0x846E;

type Enumerated = unsafe extern "system" fn(u32);
type LoadMatrix = unsafe extern "system" fn(*const f32);
type Color = unsafe extern "system" fn(f32, f32, f32, f32);
type VertexPointer = unsafe extern "system" fn(i32, u32, i32, *const c_void);
type NormalPointer = unsafe extern "system" fn(u32, i32, *const c_void);

/// The functions, each of the type the specification gives it.
pub struct Legacy {
    matrix_mode: Enumerated,
    load_matrix: LoadMatrix,
    color: Color,
    enable_client_state: Enumerated,
    vertex_pointer: VertexPointer,
    normal_pointer: NormalPointer,
}

impl Legacy {
    /// Loads the table; the error names the first function the driver does not have.
    ///
    /// # Safety
    ///
    /// `load` returns null or the address of the GL function of that name for the current context.
    pub unsafe fn load(mut load: impl FnMut(&CStr) -> *const c_void) -> Result<Self, String> {
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
                matrix_mode: std::mem::transmute::<*const c_void, Enumerated>(find(c"glMatrixMode")?),
                load_matrix: std::mem::transmute::<*const c_void, LoadMatrix>(find(c"glLoadMatrixf")?),
                color: std::mem::transmute::<*const c_void, Color>(find(c"glColor4f")?),
                enable_client_state: std::mem::transmute::<*const c_void, Enumerated>(find(c"glEnableClientState")?),
                vertex_pointer: std::mem::transmute::<*const c_void, VertexPointer>(find(c"glVertexPointer")?),
                normal_pointer: std::mem::transmute::<*const c_void, NormalPointer>(find(c"glNormalPointer")?),
            })
        }
    }

    /// glMatrixMode and glLoadMatrixf: `mode` is [`MODELVIEW`] or [`PROJECTION`].
    ///
    /// # Safety
    ///
    /// The context is current.
    pub unsafe fn load_matrix(&self, mode: u32, matrix: &glam::Mat4) {
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
    pub unsafe fn color(&self, [red, green, blue, alpha]: [f32; 4]) {
        // SAFETY: the caller's promise.
        unsafe { (self.color)(red, green, blue, alpha) }
    }

    /// Positions and normals interleaved, three floats each, from the start of the bound array buffer.
    ///
    /// # Safety
    ///
    /// The context is current and the buffer bound to GL_ARRAY_BUFFER holds such vertices.
    pub unsafe fn position_and_normal_arrays(&self) {
        const STRIDE: i32 = 24;
        // SAFETY: the caller's promise; with a buffer bound the pointers are offsets into it.
        unsafe {
            (self.enable_client_state)(VERTEX_ARRAY);
            (self.enable_client_state)(NORMAL_ARRAY);
            (self.vertex_pointer)(3, glow::FLOAT, STRIDE, std::ptr::null());
            (self.normal_pointer)(glow::FLOAT, STRIDE, std::ptr::without_provenance(12));
        }
    }
}
