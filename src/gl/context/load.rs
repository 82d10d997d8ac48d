//! Loads a context's functions and queries its properties.

use super::super::Gl;
use super::super::faults::Faults;
use super::super::immediate::Immediate;
use super::super::legacy::{self, Legacy};
use super::info::{ContextInfo, LEAST_SUBPIXEL_BITS};
use super::platform::Platform;
#[cfg(any(target_os = "macos", test))]
use super::surface_framebuffer::SurfaceFramebuffer;
use crate::error::Error;
use crate::scene::Size;
use glow::HasContext;
use std::cell::{Cell, RefCell};
use std::ffi::CStr;
use std::rc::Rc;

/// Returns the two numbers at the start of a GL_VERSION.
fn version_numbers(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.split(['.', ' ']).map(|number| number.parse().ok());
    Some((numbers.next()??, numbers.next()??))
}

/// Loads GL for the current context and queries its properties; the error says why the context cannot serve.
pub(super) fn load_functions(
    platform: &dyn Platform,
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
    // Checked first, because glow assumes that a context knows its version. SAFETY: the context is current.
    let version = unsafe { legacy.string(glow::VERSION) }.ok_or("it reports no version")?;
    match version_numbers(&version) {
        Some((major, minor)) if (major, minor) >= (2, 1) => {}
        Some(_) => return Err(format!("it is OpenGL {version}, older than 2.1")),
        None => return Err(format!("it reports the version {version:?}, which is not one of OpenGL")),
    }
    // SAFETY: as above.
    let glow = unsafe { glow::Context::from_loader_function_cstr(load) };
    // Before the queries about the framebuffer.
    #[cfg(any(target_os = "macos", test))]
    let own_surface = platform.lacks_surface().then(|| SurfaceFramebuffer::new(&glow)).transpose()?;
    let has = |name: &str| glow.supported_extensions().contains(name);
    if has("GL_ARB_robustness") || has("GL_KHR_robustness") {
        // SAFETY: as above; the context has the extension.
        unsafe { legacy.load_robustness(load) };
    }
    let info = queried(&glow, &legacy, platform.largest_surface(), backend, device);
    // SAFETY: as above.
    let immediate = unsafe { Immediate::load(load) };
    let (live_objects, lost) = (Cell::new(0), Cell::new(None));
    let gl = Gl {
        glow: Rc::new(glow),
        legacy,
        immediate,
        info,
        #[cfg(any(target_os = "macos", test))]
        surface: own_surface,
        live_objects,
        replaced_shaders: RefCell::default(),
        lost,
    };
    // A core profile answers the queries about alpha and lines with an error: it lacks features that the articles use.
    gl.check("asking the context about itself").map_err(|error| match error {
        Error::ContextLost { what, .. } => format!("the context was lost at once ({what})"),
        _ => "it is not a compatibility context".to_owned(),
    })?;
    gl.info.lacks_bits().map_or(Ok(()), Err)?;
    Ok(gl)
}

/// The properties of the current context.
fn queried(glow: &glow::Context, legacy: &Legacy, surface: Size, backend: &'static str, device: String) -> ContextInfo {
    let has = |name: &str| glow.supported_extensions().contains(name);
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
    let limit = |viewport: i32, surface: u32| (viewport.min(texture).max(0) as u32).min(surface);
    let version = glow.version();
    let version = (version.major, version.minor);
    let timer_queries = version >= (3, 3) || has("GL_ARB_timer_query") || has("GL_EXT_timer_query");
    let framebuffer_objects = version >= (3, 0) || has("GL_ARB_framebuffer_object");
    let float_targets = framebuffer_objects && (version >= (3, 0) || has("GL_ARB_texture_float"));
    ContextInfo {
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
        largest_viewport: Size { width: viewport[0].max(0) as u32, height: viewport[1].max(0) as u32 },
        largest_picture: Size { width: limit(viewport[0], surface.width), height: limit(viewport[1], surface.height) },
        framebuffer_objects,
        draw_buffers: integer(glow::MAX_DRAW_BUFFERS).max(0) as u32,
        float_targets,
        subpixel_bits: integer(glow::SUBPIXEL_BITS).max(LEAST_SUBPIXEL_BITS) as u32,
        timer_queries,
    }
}
