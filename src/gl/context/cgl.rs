//! CGL on macOS: a context without a surface, drawing into a framebuffer object (`surface_framebuffer`).
//!
//! The system's legacy profile is OpenGL 2.1 with GLSL 1.20, as the articles need. glutin's CGL requests a core profile first and
//! needs the main thread, hence the calls by name. This was compiled and never run: see docs/guide/installing.md.

use super::platform::{NotCurrent, Platform};
use crate::scene::Size;
use libloading::Library;
use std::ffi::{CStr, c_char, c_void};
use std::ptr;
use std::sync::OnceLock;

type Handle = *mut c_void;
type ChoosePixelFormat = unsafe extern "C" fn(*const i32, *mut Handle, *mut i32) -> i32;
type CreateContext = unsafe extern "C" fn(Handle, Handle, *mut Handle) -> i32;
type Destroy = unsafe extern "C" fn(Handle) -> i32;
type ErrorString = unsafe extern "C" fn(i32) -> *const c_char;

/// The system's path of it, which need not exist as a file.
const LIBRARY: &str = "/System/Library/Frameworks/OpenGL.framework/OpenGL";

const COLOR_SIZE: i32 = 8;
const ALPHA_SIZE: i32 = 11;
const DEPTH_SIZE: i32 = 12;
const ALLOW_OFFLINE_RENDERERS: i32 = 96;
const OPENGL_PROFILE: i32 = 99;
const LEGACY_PROFILE: i32 = 0x1000;

/// The library and its functions used here.
struct Cgl {
    library: &'static Library,
    choose_pixel_format: ChoosePixelFormat,
    create_context: CreateContext,
    destroy_context: Destroy,
    destroy_pixel_format: Destroy,
    error_string: ErrorString,
    set_current_context: Destroy,
}

fn opened() -> Result<&'static Cgl, String> {
    static CGL: OnceLock<Result<Cgl, String>> = OnceLock::new();
    CGL.get_or_init(Cgl::open).as_ref().map_err(Clone::clone)
}

impl Cgl {
    fn open() -> Result<Self, String> {
        // SAFETY: loading the system's OpenGL runs its initialisers, which have no preconditions.
        let library = unsafe { Library::new(LIBRARY) };
        let library = library.map_err(|error| format!("the library cannot be loaded ({error})"))?;
        // Never unloaded.
        let library: &'static Library = Box::leak(Box::new(library));
        let find = |name: &CStr| {
            // SAFETY: this looks the symbol up without calling it.
            let found = unsafe { library.get::<*const c_void>(name.to_bytes_with_nul()) };
            found.map(|symbol| *symbol).map_err(|error| format!("the library lacks a function ({error})"))
        };
        // SAFETY: these are the types that OpenGL/CGLTypes.h and OpenGL/OpenGL.h give the functions of these names.
        unsafe {
            Ok(Self {
                library,
                choose_pixel_format: std::mem::transmute::<*const c_void, ChoosePixelFormat>(find(
                    c"CGLChoosePixelFormat",
                )?),
                create_context: std::mem::transmute::<*const c_void, CreateContext>(find(c"CGLCreateContext")?),
                destroy_context: std::mem::transmute::<*const c_void, Destroy>(find(c"CGLDestroyContext")?),
                destroy_pixel_format: std::mem::transmute::<*const c_void, Destroy>(find(c"CGLDestroyPixelFormat")?),
                error_string: std::mem::transmute::<*const c_void, ErrorString>(find(c"CGLErrorString")?),
                set_current_context: std::mem::transmute::<*const c_void, Destroy>(find(c"CGLSetCurrentContext")?),
            })
        }
    }

    fn in_words(&self, error: i32) -> String {
        // SAFETY: every number is a valid argument; the texts end with 0 and are static.
        unsafe {
            let text = (self.error_string)(error);
            if text.is_null() { error.to_string() } else { CStr::from_ptr(text).to_string_lossy().into_owned() }
        }
    }
}

/// A context that has no surface.
pub(super) struct CglContext {
    cgl: &'static Cgl,
    context: Handle,
}

impl CglContext {
    /// Opens a context of the legacy profile, which is always 2.1; a higher version is refused.
    pub(super) fn open((major, minor): (u8, u8)) -> Result<Self, String> {
        let failed = |reason: String| format!("making a GL {major}.{minor} context failed ({reason})");
        if (major, minor) > (2, 1) {
            return Err(failed("its legacy profile is OpenGL 2.1".to_owned()));
        }
        let cgl = opened()?;
        let wanted = [COLOR_SIZE, 24, ALPHA_SIZE, 8, DEPTH_SIZE, 24, ALLOW_OFFLINE_RENDERERS];
        let wanted = [&wanted[..], &[OPENGL_PROFILE, LEGACY_PROFILE, 0]].concat();
        let (mut format, mut count, mut context) = (ptr::null_mut(), 0, ptr::null_mut());
        // SAFETY: the list ends with 0. The format is released once, after the context was made from it; the context keeps the
        // data it needs.
        let error = unsafe {
            match (cgl.choose_pixel_format)(wanted.as_ptr(), &mut format, &mut count) {
                0 if format.is_null() => return Err("it has no format with 8 alpha and 24 depth bits".to_owned()),
                0 => {
                    let error = (cgl.create_context)(format, ptr::null_mut(), &mut context);
                    (cgl.destroy_pixel_format)(format);
                    error
                }
                error => error,
            }
        };
        match error {
            0 => Ok(Self { cgl, context }),
            error => Err(failed(cgl.in_words(error))),
        }
    }
}

impl Platform for CglContext {
    /// The context has no surface; its framebuffer object is enlarged elsewhere.
    fn resize(&mut self, _: Size) -> Result<(), String> {
        Ok(())
    }

    fn make_current(&self) -> Result<(), NotCurrent> {
        // SAFETY: the context is alive.
        match unsafe { (self.cgl.set_current_context)(self.context) } {
            0 => Ok(()),
            error => {
                let reason = format!("it cannot be made current ({})", self.cgl.in_words(error));
                Err(NotCurrent { is_lost: false, reason })
            }
        }
    }

    fn release(&self) {
        // SAFETY: no context: the system releases this one.
        unsafe { (self.cgl.set_current_context)(ptr::null_mut()) };
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        // SAFETY: this looks the symbol up without calling it.
        let found = unsafe { self.cgl.library.get::<*const c_void>(name.to_bytes_with_nul()) };
        found.map_or(ptr::null(), |symbol| *symbol)
    }

    fn largest_surface(&self) -> Size {
        Size { width: u32::MAX, height: u32::MAX }
    }

    fn lacks_surface(&self) -> bool {
        true
    }
}

impl Drop for CglContext {
    fn drop(&mut self) {
        // SAFETY: the context is alive and, without guards, not current.
        unsafe { (self.cgl.destroy_context)(self.context) };
    }
}
