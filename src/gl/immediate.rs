//! glBegin to glEnd: the calls that passed vertices to GL before buffers. They are loaded by name, as glow lacks them.
//!
//! In: vertices in main memory, in drawing order. Out: the same picture as with buffers, by a call for each vertex and attribute.
//! Only data that a draw reads is sent: normals to shaders, texture coordinates to the units that have them.

use super::legacy::FIXED_UNITS;
use std::ffi::{CStr, c_void};

type Mode = unsafe extern "system" fn(u32);
type End = unsafe extern "system" fn();
type Floats = unsafe extern "system" fn(*const f32);
type FloatsOf = unsafe extern "system" fn(u32, *const f32);

/// The functions, each with the type of the specification.
pub(super) struct Immediate {
    begin: Mode,
    end: End,
    vertex_3: Floats,
    vertex_4: Floats,
    normal: Floats,
    color: Floats,
    coordinate: Floats,
    coordinate_of: FloatsOf,
}

/// Vertices in drawing order.
pub(super) struct Vertices<'a> {
    /// GL_TRIANGLES, GL_LINES, …
    pub mode: u32,
    /// The places of the vertices.
    pub places: Places<'a>,
    /// The indices of the places, in order.
    pub indices: &'a [u32],
    /// The colour of each place; `None` for the current colour.
    pub colors: Option<&'a [[f32; 4]]>,
    /// The texture coordinates of each place, by texture unit.
    pub coordinates: [Option<&'a [[f32; 2]]>; FIXED_UNITS as usize],
}

/// The places of vertices.
#[derive(Clone, Copy)]
pub(super) enum Places<'a> {
    /// Positions, with normals behind them that are not sent.
    Positions(&'a [[f32; 6]]),
    /// Positions and normals.
    PositionsAndNormals(&'a [[f32; 6]]),
    /// Positions in clip space.
    Clip(&'a [[f32; 4]]),
}

impl<'a> Vertices<'a> {
    /// Vertices without colours and texture coordinates.
    pub(super) fn new(mode: u32, places: Places<'a>, indices: &'a [u32]) -> Self {
        Self { mode, places, indices, colors: None, coordinates: [None; FIXED_UNITS as usize] }
    }
}

impl Immediate {
    /// Loads the table; the error is the name of the first function the driver does not have.
    ///
    /// # Safety
    ///
    /// `load` returns null or the address of the GL function of that name for the current context.
    #[cfg_attr(target_arch = "wasm32", expect(dead_code, reason = "browsers have no such calls"))]
    pub(super) unsafe fn load(mut load: impl FnMut(&CStr) -> *const c_void) -> std::result::Result<Self, String> {
        let mut find = |name: &'static CStr| {
            let address = load(name);
            if address.is_null() { Err(name.to_string_lossy().into_owned()) } else { Ok(address) }
        };
        // SAFETY: each address is that of the function named, whose C type is the one in the table.
        unsafe {
            Ok(Self {
                begin: std::mem::transmute::<*const c_void, Mode>(find(c"glBegin")?),
                end: std::mem::transmute::<*const c_void, End>(find(c"glEnd")?),
                vertex_3: std::mem::transmute::<*const c_void, Floats>(find(c"glVertex3fv")?),
                vertex_4: std::mem::transmute::<*const c_void, Floats>(find(c"glVertex4fv")?),
                normal: std::mem::transmute::<*const c_void, Floats>(find(c"glNormal3fv")?),
                color: std::mem::transmute::<*const c_void, Floats>(find(c"glColor4fv")?),
                coordinate: std::mem::transmute::<*const c_void, Floats>(find(c"glTexCoord2fv")?),
                coordinate_of: std::mem::transmute::<*const c_void, FloatsOf>(find(c"glMultiTexCoord2fv")?),
            })
        }
    }

    /// Draws the vertices.
    ///
    /// # Safety
    ///
    /// The context is current, and nothing stands between glBegin and glEnd.
    pub(super) unsafe fn send(&self, vertices: &Vertices<'_>) {
        // SAFETY: the caller's promise; the arrays' types give every pointer as many numbers as the function's name says.
        unsafe {
            (self.begin)(vertices.mode);
            for index in vertices.indices {
                let index = *index as usize;
                if let Some(colors) = vertices.colors {
                    (self.color)(colors[index].as_ptr());
                }
                if let Some(coordinates) = vertices.coordinates[0] {
                    (self.coordinate)(coordinates[index].as_ptr());
                }
                for (unit, coordinates) in (0..).zip(vertices.coordinates).skip(1) {
                    if let Some(coordinates) = coordinates {
                        (self.coordinate_of)(glow::TEXTURE0 + unit, coordinates[index].as_ptr());
                    }
                }
                match vertices.places {
                    Places::Positions(places) => (self.vertex_3)(places[index].as_ptr()),
                    Places::PositionsAndNormals(places) => {
                        (self.normal)(places[index][3..].as_ptr());
                        (self.vertex_3)(places[index].as_ptr());
                    }
                    Places::Clip(places) => (self.vertex_4)(places[index].as_ptr()),
                }
            }
            (self.end)();
        }
    }
}
