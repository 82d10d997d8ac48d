//! The stand-ins for a driver's functions.

use super::Fault;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ffi::{CStr, CString, c_char, c_void};
use std::rc::Rc;

/// The kind of GL call that a stand-in replaces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Call {
    /// A call that allocates device memory.
    Allocation,
    /// A call that changes the picture.
    Drawing,
    /// A call that does nothing once the context is lost.
    Other,
}

/// A context's fault and its progress.
pub(in crate::gl) struct Faults {
    fault: Fault,
    counted: Cell<u32>,
    /// The error that glGetError returns next, before it asks the driver.
    pending: Cell<u32>,
    /// The driver's own functions.
    real: RefCell<HashMap<CString, *const c_void>>,
}

thread_local! {
    /// The faults of the context that is current on this thread.
    static CURRENT: RefCell<Option<Rc<Faults>>> = const { RefCell::new(None) };
}

/// Selects the stand-ins to call: those of the context just made current, or none.
pub(in crate::gl) fn set_current(faults: Option<&Rc<Faults>>) {
    CURRENT.with(|current| current.replace(faults.cloned()));
}

impl Faults {
    pub(in crate::gl) fn new(fault: Fault) -> Self {
        Self { fault, counted: Cell::new(0), pending: Cell::new(glow::NO_ERROR), real: RefCell::default() }
    }

    /// Returns the address to call a GL function at: a stand-in's for some functions, the driver's for the others.
    pub(in crate::gl) fn load(&self, name: &CStr, real: *const c_void) -> *const c_void {
        if self.fault == Fault::NoImmediateMode && name == c"glBegin" {
            return std::ptr::null();
        }
        match stand_in(name) {
            Some(stand_in) if !real.is_null() => {
                self.real.borrow_mut().insert(name.to_owned(), real);
                stand_in
            }
            _ => real,
        }
    }

    fn is_lost(&self) -> bool {
        matches!(self.fault, Fault::ContextLost { after } | Fault::ContextReset { after } if self.counted.get() > after)
    }

    /// Counts a call; returns whether it reaches the driver.
    fn allows(&self, call: Call) -> bool {
        let count = || self.counted.set(self.counted.get().saturating_add(1));
        match self.fault {
            Fault::ContextLost { .. } | Fault::ContextReset { .. } => {
                if call != Call::Other && !self.is_lost() {
                    count();
                }
                !self.is_lost()
            }
            Fault::OutOfMemory { after } if call == Call::Allocation => {
                count();
                let has_room = self.counted.get() != after.saturating_add(1);
                if !has_room {
                    self.pending.set(glow::OUT_OF_MEMORY);
                }
                has_room
            }
            Fault::OutOfMemory { .. }
            | Fault::ContextRefused
            | Fault::ShaderRefused { .. }
            | Fault::NoImmediateMode => true,
        }
    }
}

/// The current context's faults; a stand-in is called only while there is one.
fn current() -> Option<Rc<Faults>> {
    CURRENT.with(|current| current.borrow().clone())
}

/// The driver's function of this name, unless the fault keeps the call from it.
fn allowed(name: &CStr, call: Call) -> Option<*const c_void> {
    let faults = current()?;
    if !faults.allows(call) {
        return None;
    }
    faults.real.borrow().get(name).copied()
}

/// Defines functions with the C types of the specification. When it is their turn to fail they do nothing and return 0.
macro_rules! stand_ins {
    ($($gl:literal $name:ident $call:ident ($($argument:ident: $kind:ty),*) $(-> $result:ty)?;)*) => {
        $(
            unsafe extern "system" fn $name($($argument: $kind),*) $(-> $result)? {
                match allowed($gl, Call::$call) {
                    // SAFETY: the driver's function of this name has this type, and its arguments are the caller's.
                    Some(real) => unsafe {
                        std::mem::transmute::<*const c_void, unsafe extern "system" fn($($kind),*) $(-> $result)?>(real)(
                            $($argument),*
                        )
                    },
                    None => Default::default(),
                }
            }
        )*

        fn stand_in(name: &CStr) -> Option<*const c_void> {
            $(if name == $gl { return Some($name as *const c_void); })*
            match name.to_bytes() {
                b"glGetError" => Some(get_error as *const c_void),
                b"glShaderSource" => Some(shader_source as *const c_void),
                b"glGetGraphicsResetStatus" | b"glGetGraphicsResetStatusARB" => Some(reset_status as *const c_void),
                _ => None,
            }
        }
    };
}

stand_ins! {
    c"glBufferData" buffer_data Allocation (target: u32, size: isize, data: *const c_void, usage: u32);
    c"glTexImage1D" tex_image_1d Allocation (target: u32, level: i32, internal: i32, width: i32, border: i32, format: u32,
        kind: u32, texels: *const c_void);
    c"glTexImage2D" tex_image_2d Allocation (target: u32, level: i32, internal: i32, width: i32, height: i32, border: i32,
        format: u32, kind: u32, texels: *const c_void);
    c"glCopyTexImage2D" copy_tex_image_2d Allocation (target: u32, level: i32, internal: u32, x: i32, y: i32, width: i32,
        height: i32, border: i32);
    c"glRenderbufferStorage" renderbuffer_storage Allocation (target: u32, internal: u32, width: i32, height: i32);
    c"glClear" clear Drawing (buffers: u32);
    c"glDrawArrays" draw_arrays Drawing (mode: u32, first: i32, count: i32);
    c"glDrawElements" draw_elements Drawing (mode: u32, count: i32, kind: u32, first: *const c_void);
    c"glReadPixels" read_pixels Other (x: i32, y: i32, width: i32, height: i32, format: u32, kind: u32, data: *mut c_void);
    c"glCreateShader" create_shader Other (kind: u32) -> u32;
    c"glCreateProgram" create_program Other () -> u32;
}

unsafe extern "system" fn get_error() -> u32 {
    let Some(faults) = current() else { return glow::NO_ERROR };
    if faults.is_lost() {
        return if matches!(faults.fault, Fault::ContextLost { .. }) { glow::CONTEXT_LOST } else { glow::NO_ERROR };
    }
    let pending = faults.pending.replace(glow::NO_ERROR);
    let real = faults.real.borrow().get(c"glGetError").copied();
    match real {
        Some(real) if pending == glow::NO_ERROR => {
            // SAFETY: the driver's function of this name has this type.
            unsafe { std::mem::transmute::<*const c_void, unsafe extern "system" fn() -> u32>(real)() }
        }
        _ => pending,
    }
}

unsafe extern "system" fn reset_status() -> u32 {
    match current() {
        Some(faults) if faults.is_lost() && matches!(faults.fault, Fault::ContextReset { .. }) => {
            glow::GUILTY_CONTEXT_RESET
        }
        _ => glow::NO_ERROR,
    }
}

unsafe extern "system" fn shader_source(shader: u32, count: i32, texts: *const *const c_char, lengths: *const i32) {
    type ShaderSource = unsafe extern "system" fn(u32, i32, *const *const c_char, *const i32);
    let Some(real) = allowed(c"glShaderSource", Call::Other) else { return };
    // SAFETY: the driver's function of this name has this type.
    let real = unsafe { std::mem::transmute::<*const c_void, ShaderSource>(real) };
    let is_refused = current().is_some_and(|faults| match faults.fault {
        Fault::ShaderRefused { after } => faults.counted.replace(faults.counted.get().saturating_add(1)) == after,
        _ => false,
    });
    let refused = c"#version 120\n#error refused on purpose\n".as_ptr();
    // SAFETY: the caller's arguments, or one text that ends with 0 and no lengths.
    unsafe {
        match is_refused {
            true => real(shader, 1, &refused, std::ptr::null()),
            false => real(shader, count, texts, lengths),
        }
    }
}
