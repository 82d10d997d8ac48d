//! Ways to an OpenGL 2.1 context without a window, tried in order, each attempt remembered.

mod egl;
mod osmesa;
#[cfg(feature = "window")]
pub(crate) mod window;

use super::Gl;
use super::faults::{self, Fault, Faults};
use super::legacy::{self, Legacy};
use crate::error::{Error, Result};
use crate::names::find;
use crate::scene::Size;
use glow::HasContext;
use serde::Serialize;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, c_void};
use std::rc::Rc;
use std::str::FromStr;

/// The OpenGL that contexts are asked for.
const VERSION: (u8, u8) = (2, 1);

/// One that no driver has, for [`Fault::ContextRefused`].
const NO_VERSION: (u8, u8) = (9, 9);

/// Fewest bits of the depth buffer: with fewer, surfaces of a fitted scene show through each other.
const DEPTH_BITS: i32 = 24;

/// Sub-pixel bits that OpenGL 2.1 promises.
const LEAST_SUBPIXEL_BITS: i32 = 4;

/// Which way to take.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// EGL, then OSMesa: the first that works.
    #[default]
    Auto,
    /// EGL on a device, without a window system; hardware first.
    Egl,
    /// Mesa's off-screen library.
    OsMesa,
}

impl Backend {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] = [("auto", Self::Auto), ("egl", Self::Egl), ("osmesa", Self::OsMesa)];
}

impl FromStr for Backend {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}

/// Whether this GL_RENDERER draws on the processor.
pub fn is_software(renderer: &str) -> bool {
    let renderer = renderer.to_lowercase();
    ["llvmpipe", "softpipe", "swrast", "swiftshader", "software", "gdi generic"].iter().any(|n| renderer.contains(n))
}

/// What a context says about itself.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContextInfo {
    /// `egl` or `osmesa`.
    pub backend: &'static str,
    /// The library, and the device where there is a choice.
    pub device: String,
    /// GL_VENDOR
    pub vendor: String,
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION
    pub version: String,
    /// GL_SHADING_LANGUAGE_VERSION
    pub glsl_version: String,
    /// Bits of the framebuffer's alpha, which holds the map's depth.
    pub alpha_bits: i32,
    /// Bits of the depth buffer.
    pub depth_bits: i32,
    /// Narrowest and widest line without smoothing, pixels.
    pub aliased_line_width: [f32; 2],
    /// Narrowest and widest smoothed line, pixels.
    pub smooth_line_width: [f32; 2],
    /// Smallest and largest point without smoothing, pixels.
    pub aliased_point_size: [f32; 2],
    /// Smallest and largest smoothed point, pixels.
    pub smooth_point_size: [f32; 2],
    /// Largest width and height of a texture, pixels.
    pub largest_texture: u32,
    /// How many textures a fragment shader can read; OpenGL 2.1 promises 2.
    pub texture_units: u32,
    /// Largest picture, pixels: the smallest of viewport, texture and surface limits.
    pub largest_picture: Size,
    /// Whether passes can draw into textures (ARB_framebuffer_object).
    pub framebuffer_objects: bool,
    /// Into how many of them at once (ARB_draw_buffers).
    pub draw_buffers: u32,
    /// Whether passes can draw into floating-point textures.
    pub float_targets: bool,
    /// Bits to which a vertex is placed within a pixel; OpenGL promises 4.
    pub subpixel_bits: u32,
    /// Whether passes can be timed on the device.
    pub timer_queries: bool,
}

impl ContextInfo {
    /// Whether it draws on the processor: then work done here before drawing takes from drawing's own time.
    pub fn is_software(&self) -> bool {
        is_software(&self.renderer)
    }

    /// Whether GL draws lines, and points to join them, this wide; what is narrower or wider it draws at the nearest width it
    /// can.
    pub fn draws_edges(&self, width_px: f32, is_smooth: bool) -> bool {
        let ranges = match is_smooth {
            false => [self.aliased_line_width, self.aliased_point_size],
            true => [self.smooth_line_width, self.smooth_point_size],
        };
        ranges.iter().all(|[narrowest, widest]| (*narrowest..=*widest).contains(&width_px))
    }
}

/// One way that was tried.
#[derive(Debug, Clone, Serialize)]
pub struct Attempt {
    /// The library, and the device where there is a choice.
    pub device: String,
    /// What came of it: the context, or why there is none.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of an attempt.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It works.
    Context(Box<ContextInfo>),
    /// Why it does not.
    Error(String),
}

/// A context with its loaded functions; current on this thread only between [`Context::enter`] and its guard's end.
pub(crate) struct Context {
    platform: Platform,
    gl: Rc<Gl>,
    faults: Option<Rc<Faults>>,
}

/// Why a context cannot be made current.
struct NotCurrent {
    is_lost: bool,
    reason: String,
}

/// The platforms' contexts.
enum Platform {
    Egl(egl::EglContext),
    OsMesa(osmesa::OsMesaContext),
}

/// A way not yet tried.
enum Candidate {
    Egl(egl::Device),
    OsMesa,
    /// A whole platform that is not there, and why.
    Missing {
        device: String,
        reason: String,
    },
}

impl Candidate {
    fn all(backend: Backend) -> Vec<Self> {
        let mut candidates = Vec::new();
        if backend != Backend::OsMesa {
            match egl::devices() {
                Ok(devices) => candidates.extend(devices.into_iter().map(Self::Egl)),
                Err(reason) => candidates.push(Self::Missing { device: "EGL".to_owned(), reason }),
            }
        }
        if backend != Backend::Egl {
            candidates.push(Self::OsMesa);
        }
        candidates
    }

    fn name(&self) -> String {
        match self {
            Self::Egl(device) => device.name.clone(),
            Self::OsMesa => osmesa::name(),
            Self::Missing { device, .. } => device.clone(),
        }
    }

    fn open(self, fault: Option<Fault>) -> std::result::Result<Context, String> {
        let device = self.name();
        let version = if fault == Some(Fault::ContextRefused) { NO_VERSION } else { VERSION };
        let (platform, backend) = match self {
            Self::Egl(found) => (Platform::Egl(egl::EglContext::open(&found, version)?), "egl"),
            Self::OsMesa => (Platform::OsMesa(osmesa::OsMesaContext::open(version)?), "osmesa"),
            Self::Missing { reason, .. } => return Err(reason),
        };
        Context::load(platform, backend, device, fault)
    }
}

/// Tries every way of this backend and tells what came of each.
pub fn attempts(backend: Backend) -> Vec<Attempt> {
    Candidate::all(backend)
        .into_iter()
        .map(|candidate| {
            let device = candidate.name();
            let outcome = match candidate.open(None) {
                Ok(context) => Outcome::Context(Box::new(context.info().clone())),
                Err(reason) => Outcome::Error(reason),
            };
            Attempt { device, outcome }
        })
        .collect()
}

impl Context {
    /// The first way of this backend that works.
    pub fn open(backend: Backend) -> Result<Self> {
        Self::open_with(backend, None)
    }

    /// The same, with something that will go wrong.
    pub fn open_with(backend: Backend, fault: Option<Fault>) -> Result<Self> {
        let mut attempts = Vec::new();
        for candidate in Candidate::all(backend) {
            let name = candidate.name();
            match candidate.open(fault) {
                Ok(context) => return Ok(context),
                Err(reason) => attempts.push(format!("{name}: {reason}")),
            }
        }
        Err(Error::NoContext { attempts })
    }

    fn load(
        platform: Platform,
        backend: &'static str,
        device: String,
        fault: Option<Fault>,
    ) -> std::result::Result<Self, String> {
        let faults = fault.map(|fault| Rc::new(Faults::new(fault)));
        platform.make_current().map_err(|failed| failed.reason)?;
        let current = Current::new(&platform, faults.as_ref());
        let loaded = load_functions(&platform, faults.as_deref(), backend, device);
        drop(current);
        Ok(Self { platform, gl: Rc::new(loaded?), faults })
    }

    pub fn info(&self) -> &ContextInfo {
        &self.gl.info
    }

    pub fn gl(&self) -> &Rc<Gl> {
        &self.gl
    }

    /// Makes the surface this large; refuses what the context cannot draw.
    pub fn resize(&mut self, size: Size) -> Result<()> {
        let limit = self.info().largest_picture;
        if size.width > limit.width || size.height > limit.height {
            return Err(Error::PictureTooLarge {
                width: size.width,
                height: size.height,
                limit_width: limit.width,
                limit_height: limit.height,
                renderer: self.info().renderer.clone(),
            });
        }
        let resized = match &mut self.platform {
            Platform::Egl(context) => context.resize(size),
            Platform::OsMesa(context) => context.resize(size),
        };
        resized.map_err(|reason| Error::gl(format!("making a surface of {size} pixels"), reason))
    }

    /// Makes the context current until the guard is dropped. Contexts of both platforms share one dispatch table inside
    /// Mesa, so none is left current when another may be entered.
    pub fn enter(&self) -> Result<Current<'_>> {
        self.platform.make_current().map_err(|NotCurrent { is_lost, reason }| {
            let during = "making the context current";
            match is_lost {
                true => Error::ContextLost { during: during.to_owned(), what: reason },
                false => Error::gl(during, reason),
            }
        })?;
        Ok(Current::new(&self.platform, self.faults.as_ref()))
    }
}

/// While it lives its context is current.
pub(crate) struct Current<'a> {
    platform: &'a Platform,
}

impl<'a> Current<'a> {
    fn new(platform: &'a Platform, faults: Option<&Rc<Faults>>) -> Self {
        faults::set_current(faults);
        Self { platform }
    }
}

impl Drop for Current<'_> {
    fn drop(&mut self) {
        faults::set_current(None);
        self.platform.release();
    }
}

impl Platform {
    fn make_current(&self) -> std::result::Result<(), NotCurrent> {
        match self {
            Self::Egl(context) => context.make_current(),
            Self::OsMesa(context) => context.make_current(),
        }
    }

    fn release(&self) {
        match self {
            Self::Egl(context) => context.release(),
            Self::OsMesa(context) => context.release(),
        }
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        match self {
            Self::Egl(context) => context.proc_address(name),
            Self::OsMesa(context) => context.proc_address(name),
        }
    }

    fn largest_surface(&self) -> Size {
        match self {
            Self::Egl(context) => context.largest_surface(),
            Self::OsMesa(context) => context.largest_surface(),
        }
    }
}

/// The two numbers a GL_VERSION begins with.
fn version_numbers(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.split(['.', ' ']).map(|number| number.parse().ok());
    Some((numbers.next()??, numbers.next()??))
}

/// Loads GL for the current context and asks it about itself; an error is why it cannot serve.
fn load_functions(
    platform: &Platform,
    faults: Option<&Faults>,
    backend: &'static str,
    device: String,
) -> std::result::Result<Gl, String> {
    let load = |name: &CStr| {
        let address = platform.proc_address(name);
        faults.map_or(address, |faults| faults.load(name, address))
    };
    // SAFETY: the platform's context is current, and its loader returns GL functions of that context.
    let mut legacy = unsafe { Legacy::load(load) }?;
    // Before anything else is asked: glow takes for granted that a context knows its version.
    // SAFETY: the context is current.
    let version = unsafe { legacy.string(glow::VERSION) }.ok_or("it does not know its own version")?;
    match version_numbers(&version) {
        Some((major, minor)) if (major, minor) >= (2, 1) => {}
        Some(_) => return Err(format!("it is OpenGL {version}, older than 2.1")),
        None => return Err(format!("it calls itself {version:?}, which is no version of OpenGL")),
    }
    // SAFETY: as above.
    let glow = unsafe { glow::Context::from_loader_function_cstr(load) };
    let has = |name: &str| glow.supported_extensions().contains(name);
    if has("GL_ARB_robustness") || has("GL_KHR_robustness") {
        // SAFETY: as above; the context has the extension.
        unsafe { legacy.load_robustness(load) };
    }
    let text = |name: u32| {
        // SAFETY: the context is current; `name` is one of the string names of GL 2.1.
        unsafe { legacy.string(name) }.unwrap_or_default()
    };
    let integer = |name: u32| {
        // SAFETY: the context is current; `name` is a parameter of one integer.
        unsafe { glow.get_parameter_i32(name) }
    };
    let range = |name: u32| {
        let mut range = [0.0; 2];
        // SAFETY: the context is current; `name` is a parameter of two numbers.
        unsafe { glow.get_parameter_f32_slice(name, &mut range) };
        range
    };
    let mut viewport = [0; 2];
    // SAFETY: the context is current; the parameter has two integers.
    unsafe { glow.get_parameter_i32_slice(glow::MAX_VIEWPORT_DIMS, &mut viewport) };
    let texture = integer(glow::MAX_TEXTURE_SIZE);
    let surface = platform.largest_surface();
    let limit = |viewport: i32, surface: u32| (viewport.min(texture).max(0) as u32).min(surface);
    let version = glow.version();
    let version = (version.major, version.minor);
    let timer_queries = version >= (3, 3) || has("GL_ARB_timer_query") || has("GL_EXT_timer_query");
    let framebuffer_objects = version >= (3, 0) || has("GL_ARB_framebuffer_object");
    let float_targets = framebuffer_objects && (version >= (3, 0) || has("GL_ARB_texture_float"));
    let info = ContextInfo {
        backend,
        device,
        vendor: text(glow::VENDOR),
        renderer: text(glow::RENDERER),
        version: text(glow::VERSION),
        glsl_version: text(glow::SHADING_LANGUAGE_VERSION),
        alpha_bits: integer(legacy::ALPHA_BITS),
        depth_bits: integer(legacy::DEPTH_BITS),
        aliased_line_width: range(legacy::ALIASED_LINE_WIDTH_RANGE),
        smooth_line_width: range(legacy::SMOOTH_LINE_WIDTH_RANGE),
        aliased_point_size: range(legacy::ALIASED_POINT_SIZE_RANGE),
        smooth_point_size: range(legacy::SMOOTH_POINT_SIZE_RANGE),
        largest_texture: texture.max(0) as u32,
        texture_units: integer(glow::MAX_TEXTURE_IMAGE_UNITS).max(0) as u32,
        largest_picture: Size { width: limit(viewport[0], surface.width), height: limit(viewport[1], surface.height) },
        framebuffer_objects,
        draw_buffers: integer(glow::MAX_DRAW_BUFFERS).max(0) as u32,
        float_targets,
        subpixel_bits: integer(glow::SUBPIXEL_BITS).max(LEAST_SUBPIXEL_BITS) as u32,
        timer_queries,
    };
    let (live_objects, lost) = (Cell::new(0), Cell::new(None));
    let gl = Gl { glow, legacy, info, live_objects, replaced_shaders: RefCell::default(), lost };
    // A core profile answers the questions about alpha and lines with an error: it lacks what the papers use.
    gl.check("asking the context about itself").map_err(|error| match error {
        Error::ContextLost { what, .. } => format!("the context was lost at once ({what})"),
        _ => "it is not a compatibility context".to_owned(),
    })?;
    if gl.info.alpha_bits < 8 || gl.info.depth_bits < DEPTH_BITS {
        return Err(format!(
            "its framebuffer has {} alpha and {} depth bits, fewer than 8 and {DEPTH_BITS}",
            gl.info.alpha_bits, gl.info.depth_bits
        ));
    }
    Ok(gl)
}
