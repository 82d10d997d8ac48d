//! The canvas of a web page: a browser's only context, WebGL 1, the closest relative of OpenGL 2.1.

use super::super::Gl;
use super::super::faults::Fault;
use super::super::legacy::{self, Legacy};
use super::info::LEAST_SUBPIXEL_BITS;
use super::{Attempt, Backend, ContextInfo};
use crate::error::{Error, Result};
use crate::scene::Size;
use glow::HasContext;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{HtmlCanvasElement, WebGlContextAttributes, WebGlRenderingContext};

/// Debugging's name of the renderer behind WebGL, WEBGL_debug_renderer_info.
const UNMASKED_RENDERER: u32 = 0x9246;

/// A canvas and its context.
pub(crate) struct Context {
    canvas: HtmlCanvasElement,
    pub(super) gl: Rc<Gl>,
}

/// A canvas's context is always current.
pub(crate) struct Current<'a> {
    _context: &'a Context,
}

impl Drop for Current<'_> {
    /// WebGL has nothing to release. The driver's twin stops being current here.
    fn drop(&mut self) {}
}

/// Without a canvas no context opens.
pub fn attempts(_: Backend) -> Vec<Attempt> {
    Vec::new()
}

/// The page provides its canvas, the only choice.
pub fn witnesses() -> [Backend; 2] {
    [Backend::Auto; 2]
}

impl Context {
    /// Returns an error, because a page provides its canvas.
    pub(crate) fn open(_: Backend, _: Option<Fault>) -> Result<Self> {
        let attempts = vec!["WebGL: it needs a canvas; use Renderer::on_canvas".to_owned()];
        Err(Error::NoContext { attempts })
    }

    /// The canvas is the only context.
    pub(crate) fn open_for(_: Backend, _: Option<Fault>, _: Size, _: &[&str]) -> Option<Self> {
        None
    }

    /// Opens the context of a canvas that has no other.
    pub(crate) fn on_canvas(canvas: HtmlCanvasElement) -> Result<Self> {
        let refused = |reason: &str| Error::NoContext { attempts: vec![format!("WebGL: {reason}")] };
        let attributes = WebGlContextAttributes::new();
        attributes.set_alpha(true);
        attributes.set_depth(true);
        attributes.set_stencil(false);
        attributes.set_antialias(false);
        attributes.set_premultiplied_alpha(false);
        let found = canvas.get_context_with_context_options("webgl", &attributes);
        let raw = found.ok().flatten().and_then(|context| context.dyn_into::<WebGlRenderingContext>().ok());
        let raw = raw.ok_or_else(|| refused("this browser has none, or it is switched off"))?;
        // Checked before glow, which assumes that every query is answered.
        if raw.is_context_lost() {
            return Err(refused("the context was lost at once"));
        }
        let gl = load(raw).map_err(|reason| refused(&reason))?;
        Ok(Self { canvas, gl: Rc::new(gl) })
    }

    /// Resizes the canvas; an error if the size exceeds the context's limits.
    pub(crate) fn resize(&mut self, size: Size) -> Result<()> {
        if !self.draws(size) {
            return Err(self.too_large(size, self.info().largest_picture));
        }
        self.canvas.set_width(size.width);
        self.canvas.set_height(size.height);
        // A browser short of memory makes the drawing buffer smaller and reports it only here.
        let [width, height] = self.gl.legacy.surface();
        match (width, height) == (size.width, size.height) || self.gl.legacy.is_lost() {
            true => Ok(()),
            false => Err(self.too_large(size, Size { width, height })),
        }
    }

    /// A canvas's context is already current.
    pub(crate) fn enter(&self) -> Result<Current<'_>> {
        Ok(Current { _context: self })
    }
}

/// Loads a context's functions and properties; the error says why the context cannot serve.
fn load(raw: WebGlRenderingContext) -> std::result::Result<Gl, String> {
    let named = raw.get_extension("WEBGL_debug_renderer_info").ok().flatten().is_some();
    let glow = Rc::new(glow::Context::from_webgl1_context(raw.clone()));
    let has = |name: &str| glow.supported_extensions().contains(name);
    if !has("OES_element_index_uint") {
        return Err("it draws models of up to 65,536 vertices only (no OES_element_index_uint)".to_owned());
    }
    // Clears errors from before the context was lost and restored. SAFETY: as for any query; a broken browser could report errors
    // for ever, hence the bound.
    (0..16).take_while(|_| unsafe { glow.get_error() } != glow::NO_ERROR).count();
    // glow does not request these extensions.
    let has_floats = ["OES_texture_float", "WEBGL_color_buffer_float"].iter().all(|name| turn_on(&raw, name));
    let has_halves = ["OES_texture_half_float", "EXT_color_buffer_half_float"].iter().all(|name| turn_on(&raw, name));
    turn_on(&raw, "EXT_float_blend");
    turn_on(&raw, "OES_standard_derivatives");
    // SAFETY: every WebGL context answers these queries.
    let (text, integer) =
        unsafe { (|name: u32| glow.get_parameter_string(name), |name: u32| glow.get_parameter_i32(name)) };
    let (mut viewport, mut line_width) = ([0; 2], [0.0; 2]);
    // SAFETY: as above; both have two numbers.
    unsafe {
        glow.get_parameter_i32_slice(glow::MAX_VIEWPORT_DIMS, &mut viewport);
        glow.get_parameter_f32_slice(legacy::ALIASED_LINE_WIDTH_RANGE, &mut line_width);
    }
    let draw_buffers = if turn_on(&raw, "WEBGL_draw_buffers") { integer(glow::MAX_DRAW_BUFFERS) } else { 1 };
    let largest_texture = integer(glow::MAX_TEXTURE_SIZE).max(0) as u32;
    let limit = |viewport: i32| (viewport.max(0) as u32).min(largest_texture);
    let info = ContextInfo {
        backend: "webgl",
        device: "WebGL".to_owned(),
        vendor: text(glow::VENDOR),
        renderer: text(if named { UNMASKED_RENDERER } else { glow::RENDERER }),
        version: text(glow::VERSION),
        glsl_version: text(glow::SHADING_LANGUAGE_VERSION),
        alpha_bits: integer(legacy::ALPHA_BITS),
        depth_bits: integer(legacy::DEPTH_BITS),
        aliased_line_width: line_width,
        smooth_line_width: [0.0; 2],
        aliased_point_size: [1.0; 2],
        smooth_point_size: [0.0; 2],
        largest_texture,
        texture_units: integer(glow::MAX_TEXTURE_IMAGE_UNITS).max(0) as u32,
        largest_viewport: Size { width: viewport[0].max(0) as u32, height: viewport[1].max(0) as u32 },
        largest_picture: Size { width: limit(viewport[0]), height: limit(viewport[1]) },
        framebuffer_objects: true,
        draw_buffers: draw_buffers.max(0) as u32,
        float_targets: has_floats && has_halves,
        subpixel_bits: integer(glow::SUBPIXEL_BITS).max(LEAST_SUBPIXEL_BITS) as u32,
        timer_queries: false,
    };
    info.lacks_bits().map_or(Ok(()), Err)?;
    let gl = Gl {
        legacy: Legacy::new(glow.clone(), raw),
        glow,
        immediate: Err("glBegin".to_owned()),
        info,
        live_objects: Cell::new(0),
        replaced_shaders: RefCell::default(),
        lost: Cell::new(None),
    };
    gl.check("asking the context about itself").map_err(|error| error.to_string())?;
    Ok(gl)
}

/// Turns an extension on; returns whether it exists.
fn turn_on(raw: &WebGlRenderingContext, name: &str) -> bool {
    raw.get_extension(name).is_ok_and(|extension| extension.map(JsValue::from).is_some())
}
