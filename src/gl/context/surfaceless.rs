//! EGL on Mesa's surfaceless platform: the same driver as EGL's devices, with a separate display and so a separate screen.
//!
//! Two contexts of one software driver's screen must take turns (`context_lock`). A context here and one of a device need not,
//! nor need OSMesa's; unlike OSMesa, this platform exists wherever EGL does. glutin lacks this display, hence the calls by name.

use super::egl;
use super::platform::{NotCurrent, Platform};
use crate::scene::Size;
use libloading::Library;
use std::ffi::{CStr, c_char, c_void};
use std::ptr;
use std::sync::OnceLock;

type Handle = *mut c_void;
type BindApi = unsafe extern "system" fn(u32) -> u32;
type ChooseConfig = unsafe extern "system" fn(Handle, *const i32, *mut Handle, i32, *mut i32) -> u32;
type CreateContext = unsafe extern "system" fn(Handle, Handle, Handle, *const i32) -> Handle;
type CreateSurface = unsafe extern "system" fn(Handle, Handle, *const i32) -> Handle;
type Destroy = unsafe extern "system" fn(Handle, Handle) -> u32;
type GetConfigAttribute = unsafe extern "system" fn(Handle, Handle, i32, *mut i32) -> u32;
type GetError = unsafe extern "system" fn() -> i32;
type GetPlatformDisplay = unsafe extern "system" fn(u32, Handle, *const i32) -> Handle;
type GetProcAddress = unsafe extern "system" fn(*const c_char) -> *const c_void;
type Initialize = unsafe extern "system" fn(Handle, *mut i32, *mut i32) -> u32;
type MakeCurrent = unsafe extern "system" fn(Handle, Handle, Handle, Handle) -> u32;
type QueryString = unsafe extern "system" fn(Handle, i32) -> *const c_char;

const ALPHA_SIZE: i32 = 0x3021;
const BLUE_SIZE: i32 = 0x3022;
const GREEN_SIZE: i32 = 0x3023;
const RED_SIZE: i32 = 0x3024;
const DEPTH_SIZE: i32 = 0x3025;
const STENCIL_SIZE: i32 = 0x3026;
const MAX_PBUFFER_HEIGHT: i32 = 0x302A;
const MAX_PBUFFER_WIDTH: i32 = 0x302C;
const SAMPLES: i32 = 0x3031;
const SURFACE_TYPE: i32 = 0x3033;
const PBUFFER_BIT: i32 = 1;
const NONE: i32 = 0x3038;
const RENDERABLE_TYPE: i32 = 0x3040;
const OPENGL_BIT: i32 = 8;
const EXTENSIONS: i32 = 0x3055;
const HEIGHT: i32 = 0x3056;
const WIDTH: i32 = 0x3057;
const CONTEXT_MAJOR_VERSION: i32 = 0x3098;
const CONTEXT_MINOR_VERSION: i32 = 0x30FB;
const CONTEXT_LOST: i32 = 0x300E;
const OPENGL_API: u32 = 0x30A2;
const PLATFORM_SURFACELESS: u32 = 0x31DD;

/// The functions of the library used here, and its surfaceless display, which stays open for the life of the process.
struct Egl {
    bind_api: BindApi,
    choose_config: ChooseConfig,
    create_context: CreateContext,
    create_pbuffer: CreateSurface,
    destroy_context: Destroy,
    destroy_surface: Destroy,
    get_config_attribute: GetConfigAttribute,
    get_error: GetError,
    get_proc_address: GetProcAddress,
    make_current: MakeCurrent,
    display: Handle,
}

// SAFETY: EGL's functions may be called from any thread, and the display is one of its names.
unsafe impl Send for Egl {}
// SAFETY: as above; this code changes no fields.
unsafe impl Sync for Egl {}

fn opened() -> Result<&'static Egl, String> {
    static EGL: OnceLock<Result<Egl, String>> = OnceLock::new();
    EGL.get_or_init(Egl::open).as_ref().map_err(Clone::clone)
}

impl Egl {
    fn open() -> Result<Self, String> {
        egl::check_library()?;
        // SAFETY: it is loaded already and never unloaded.
        let library = egl::LIBRARIES.iter().find_map(|name| unsafe { Library::new(name) }.ok());
        let library: &'static Library = Box::leak(Box::new(library.ok_or("the library cannot be loaded")?));
        let find = |name: &CStr| {
            // SAFETY: this looks the symbol up without calling it.
            let found = unsafe { library.get::<*const c_void>(name.to_bytes_with_nul()) };
            found.map(|symbol| *symbol).map_err(|error| format!("the library lacks a function ({error})"))
        };
        // SAFETY: these are the types of EGL 1.4's functions of these names. EGL_EXT_platform_base's function is looked up only
        // if the library reports the extension.
        unsafe {
            let query_string = std::mem::transmute::<*const c_void, QueryString>(find(c"eglQueryString")?);
            let extensions = query_string(ptr::null_mut(), EXTENSIONS);
            let extensions = if extensions.is_null() { c"" } else { CStr::from_ptr(extensions) };
            let has = |name: &str| extensions.to_string_lossy().split_whitespace().any(|word| word == name);
            if !has("EGL_EXT_platform_base") || !has("EGL_MESA_platform_surfaceless") {
                return Err("the library has no surfaceless platform (EGL_MESA_platform_surfaceless)".to_owned());
            }
            let get_proc_address = std::mem::transmute::<*const c_void, GetProcAddress>(find(c"eglGetProcAddress")?);
            let get_platform_display = get_proc_address(c"eglGetPlatformDisplayEXT".as_ptr());
            if get_platform_display.is_null() {
                return Err("the library lacks eglGetPlatformDisplayEXT".to_owned());
            }
            let get_platform_display = std::mem::transmute::<*const c_void, GetPlatformDisplay>(get_platform_display);
            let initialize = std::mem::transmute::<*const c_void, Initialize>(find(c"eglInitialize")?);
            let found = Self {
                bind_api: std::mem::transmute::<*const c_void, BindApi>(find(c"eglBindAPI")?),
                choose_config: std::mem::transmute::<*const c_void, ChooseConfig>(find(c"eglChooseConfig")?),
                create_context: std::mem::transmute::<*const c_void, CreateContext>(find(c"eglCreateContext")?),
                create_pbuffer: std::mem::transmute::<*const c_void, CreateSurface>(find(c"eglCreatePbufferSurface")?),
                destroy_context: std::mem::transmute::<*const c_void, Destroy>(find(c"eglDestroyContext")?),
                destroy_surface: std::mem::transmute::<*const c_void, Destroy>(find(c"eglDestroySurface")?),
                get_config_attribute: std::mem::transmute::<*const c_void, GetConfigAttribute>(find(
                    c"eglGetConfigAttrib",
                )?),
                get_error: std::mem::transmute::<*const c_void, GetError>(find(c"eglGetError")?),
                get_proc_address,
                make_current: std::mem::transmute::<*const c_void, MakeCurrent>(find(c"eglMakeCurrent")?),
                display: get_platform_display(PLATFORM_SURFACELESS, ptr::null_mut(), ptr::null()),
            };
            if found.display.is_null() {
                return Err(found.failed("asking for the display"));
            }
            match initialize(found.display, ptr::null_mut(), ptr::null_mut()) {
                0 => Err(found.failed("opening the display")),
                _ => Ok(found),
            }
        }
    }

    /// Returns an error text with EGL's number.
    fn failed(&self, what: &str) -> String {
        // SAFETY: a query of this thread's last error has no preconditions.
        format!("{what} failed (0x{:X})", unsafe { (self.get_error)() })
    }

    fn attribute(&self, config: Handle, name: i32) -> i32 {
        let mut value = 0;
        // SAFETY: display and config are alive, and the attribute is one integer; an unknown attribute stays 0.
        unsafe { (self.get_config_attribute)(self.display, config, name, &mut value) };
        value
    }

    fn config(&self) -> Result<Handle, String> {
        const MOST: usize = 256;
        let (mut configs, mut count) = ([ptr::null_mut(); MOST], 0);
        let [red, green, blue, alpha] = [RED_SIZE, GREEN_SIZE, BLUE_SIZE, ALPHA_SIZE].map(|name| [name, 8]);
        let kinds = [[SURFACE_TYPE, PBUFFER_BIT], [RENDERABLE_TYPE, OPENGL_BIT], [DEPTH_SIZE, 24], [NONE, NONE]];
        let wanted = [[red, green, blue, alpha], kinds].concat().concat();
        // SAFETY: the list ends with EGL_NONE, and the buffer has room for the requested number of configs.
        let asked = unsafe {
            (self.choose_config)(self.display, wanted.as_ptr(), configs.as_mut_ptr(), MOST as i32, &mut count)
        };
        if asked == 0 {
            return Err(self.failed("asking for framebuffer formats"));
        }
        let found = configs.iter().take(usize::try_from(count).unwrap_or_default());
        let fits = found.filter(|config| {
            [RED_SIZE, GREEN_SIZE, BLUE_SIZE, ALPHA_SIZE].iter().all(|name| self.attribute(**config, *name) == 8)
        });
        fits.min_by_key(|config| [SAMPLES, DEPTH_SIZE, STENCIL_SIZE].map(|name| self.attribute(**config, name)))
            .copied()
            .ok_or_else(|| "it has no off-screen format with 8 alpha and 24 depth bits".to_owned())
    }

    fn pbuffer(&self, config: Handle, size: Size) -> Result<Handle, String> {
        let attributes = [WIDTH, size.width as i32, HEIGHT, size.height as i32, NONE];
        // SAFETY: the config is the display's, and the list ends with EGL_NONE.
        let surface = unsafe { (self.create_pbuffer)(self.display, config, attributes.as_ptr()) };
        match surface.is_null() {
            true => Err(self.failed(&format!("making an off-screen surface of {size} pixels"))),
            false => Ok(surface),
        }
    }
}

/// A context with its pbuffer.
pub(super) struct SurfacelessContext {
    egl: &'static Egl,
    config: Handle,
    context: Handle,
    surface: Handle,
    size: Size,
}

impl SurfacelessContext {
    /// Opens a compatibility context of this version of OpenGL with a surface of one pixel.
    pub(super) fn open((major, minor): (u8, u8)) -> Result<Self, String> {
        let egl = opened()?;
        let config = egl.config()?;
        let attributes = [CONTEXT_MAJOR_VERSION, i32::from(major), CONTEXT_MINOR_VERSION, i32::from(minor), NONE];
        // SAFETY: display and config belong together, the context shares no objects, and the list ends with EGL_NONE.
        let context = unsafe {
            (egl.bind_api)(OPENGL_API);
            (egl.create_context)(egl.display, config, ptr::null_mut(), attributes.as_ptr())
        };
        if context.is_null() {
            return Err(egl.failed(&format!("making a GL {major}.{minor} context")));
        }
        let size = Size { width: 1, height: 1 };
        let mut opened = Self { egl, config, context, surface: ptr::null_mut(), size };
        opened.surface = egl.pbuffer(config, size)?;
        Ok(opened)
    }

    fn destroy_surface(&mut self) {
        let surface = std::mem::replace(&mut self.surface, ptr::null_mut());
        if !surface.is_null() {
            // SAFETY: the surface is the display's, alive, and not current.
            unsafe { (self.egl.destroy_surface)(self.egl.display, surface) };
        }
    }
}

impl Platform for SurfacelessContext {
    fn resize(&mut self, size: Size) -> Result<(), String> {
        if size != self.size {
            let surface = self.egl.pbuffer(self.config, size)?;
            self.destroy_surface();
            (self.surface, self.size) = (surface, size);
        }
        Ok(())
    }

    fn make_current(&self) -> Result<(), NotCurrent> {
        // SAFETY: context and surface are alive and of this display; the context belongs to this thread.
        let made = unsafe {
            (self.egl.bind_api)(OPENGL_API);
            (self.egl.make_current)(self.egl.display, self.surface, self.surface, self.context)
        };
        if made != 0 {
            return Ok(());
        }
        // SAFETY: a query of this thread's last error has no preconditions.
        let error = unsafe { (self.egl.get_error)() };
        Err(NotCurrent { is_lost: error == CONTEXT_LOST, reason: format!("it cannot be made current (0x{error:X})") })
    }

    fn release(&self) {
        // SAFETY: no surface and no context: EGL releases both.
        unsafe { (self.egl.make_current)(self.egl.display, ptr::null_mut(), ptr::null_mut(), ptr::null_mut()) };
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        // SAFETY: the name ends with 0.
        unsafe { (self.egl.get_proc_address)(name.as_ptr()) }
    }

    fn largest_surface(&self) -> Size {
        // Some drivers leave it at 0, meaning no limit.
        let limit = |name: i32| u32::try_from(self.egl.attribute(self.config, name)).unwrap_or_default();
        let [width, height] = [MAX_PBUFFER_WIDTH, MAX_PBUFFER_HEIGHT].map(|name| match limit(name) {
            0 => u32::MAX,
            limit => limit,
        });
        Size { width, height }
    }
}

impl Drop for SurfacelessContext {
    fn drop(&mut self) {
        self.destroy_surface();
        // SAFETY: the context is alive and, without guards, not current.
        unsafe { (self.egl.destroy_context)(self.egl.display, self.context) };
    }
}
