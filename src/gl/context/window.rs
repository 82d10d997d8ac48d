//! A window's OpenGL context, which egui paints its shapes with, and the window itself.
//!
//! [`crate::Renderer`] draws the models without a window and passes their pictures as textures. So a pane's pixels do not depend
//! on the window system's buffers, and a picture can have any size.

use super::context_lock::ContextLock;
#[cfg(windows)]
use super::{context_lock::OF_WGL, is_software};
use crate::error::{Error, Result};
use crate::picture::Picture;
use crate::scene::Size;
use glutin::config::{Api, Config, ConfigTemplateBuilder, GlConfig};
use glutin::context::{ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentContext};
use glutin::context::{PossiblyCurrentGlContext, Version};
use glutin::display::{Display, DisplayApiPreference, GetGlDisplay, GlDisplay};
use glutin::surface::{GlSurface, Surface, SwapInterval, WindowSurface};
use glutin_winit::GlWindow;
use std::num::NonZeroU32;
use std::sync::Arc;
use winit::event_loop::ActiveEventLoop;
use winit::raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::window::{Window, WindowAttributes};

/// The colour behind everything, where egui paints nothing.
const GROUND: [f32; 4] = [0.2, 0.2, 0.2, 1.0];

/// The window's context, its surface, and its painter.
pub(crate) struct WindowGl {
    // Dropped in this order, each before the object it was made from.
    painter: egui_glow::Painter,
    surface: Surface<WindowSurface>,
    context: PossiblyCurrentContext,
    /// Shared with the contexts that draw models if they use the same software driver's screen, as on Windows. Elsewhere the
    /// window has a separate display.
    lock: Option<&'static ContextLock>,
}

/// Shapes on their way to the screen.
pub(crate) struct Shapes {
    /// The shapes to paint.
    pub primitives: Vec<egui::ClippedPrimitive>,
    /// Textures to make, change and release.
    pub textures: egui::TexturesDelta,
    /// The window's pixels per egui point.
    pub pixels_per_point: f32,
}

impl WindowGl {
    /// Opens a window with a context of OpenGL 2.1, in the compatibility profile where the system has one.
    ///
    /// # Errors
    ///
    /// [`Error::NoWindow`] with the reason.
    pub(crate) fn open(event_loop: &ActiveEventLoop, attributes: WindowAttributes) -> Result<(Window, Self)> {
        Self::try_open(event_loop, attributes).map_err(|reason| Error::NoWindow { reason })
    }

    fn try_open(
        event_loop: &ActiveEventLoop,
        attributes: WindowAttributes,
    ) -> std::result::Result<(Window, Self), String> {
        // First where the display's format does not depend on the window, as X11 requires.
        #[cfg(not(windows))]
        let (window, config) = {
            #[cfg(not(target_os = "macos"))]
            super::egl::check_library().map_err(|reason| format!("EGL: {reason}"))?;
            let config = config(event_loop, None)?;
            let window = glutin_winit::finalize_window(event_loop, attributes, &config)
                .map_err(|error| format!("making the window failed ({error})"))?;
            (window, config)
        };
        // On Windows it does.
        #[cfg(windows)]
        let (window, config) = {
            let window =
                event_loop.create_window(attributes).map_err(|error| format!("making the window failed ({error})"))?;
            let config = config(event_loop, Some(&window))?;
            (window, config)
        };
        let handle = window.window_handle().map_err(|error| format!("the window has no handle ({error})"))?;
        let display = config.display();
        let attributes = ContextAttributesBuilder::new()
            .with_context_api(ContextApi::OpenGl(Some(Version::new(2, 1))))
            .build(Some(handle.as_raw()));
        #[cfg(windows)]
        let guard = OF_WGL.lock();
        // SAFETY: display, config and window handle belong together, and the window is alive.
        let context = unsafe { display.create_context(&config, &attributes) }
            .map_err(|error| format!("making a GL 2.1 context failed ({error})"))?;
        let surface_attributes = window
            .build_surface_attributes(Default::default())
            .map_err(|error| format!("the window has no surface ({error})"))?;
        // SAFETY: the attributes hold the handle of a window that outlives the surface: `Viewer`'s window drops it first.
        let surface = unsafe { display.create_window_surface(&config, &surface_attributes) }
            .map_err(|error| format!("making the window's surface failed ({error})"))?;
        let context = context
            .make_current(&surface)
            .map_err(|error| format!("the window's context cannot be made current ({error})"))?;
        // SAFETY: the context is current, and the addresses are its own.
        let gl = unsafe { egui_glow::glow::Context::from_loader_function_cstr(|name| display.get_proc_address(name)) };
        #[cfg(windows)]
        let lock = {
            use egui_glow::glow::{HasContext, RENDERER};
            // SAFETY: the context is current; every context has this name.
            is_software(&unsafe { gl.get_parameter_string(RENDERER) }).then_some(&OF_WGL)
        };
        #[cfg(not(windows))]
        let lock = None;
        // A frame that waits for the screen would delay drawings that need the lock. Without the wait frames appear at once, with
        // no drawback.
        if lock.is_none() {
            let _ = surface.set_swap_interval(&context, SwapInterval::Wait(NonZeroU32::MIN));
        }
        let painter = egui_glow::Painter::new(Arc::new(gl), "", None, false)
            .map_err(|error| format!("the window's OpenGL cannot show panels ({error})"))?;
        let mut opened = Self { painter, surface, context, lock };
        opened.release();
        #[cfg(windows)]
        drop(guard);
        Ok((window, opened))
    }

    /// The largest side of a texture, pixels.
    pub(crate) fn largest_texture(&self) -> usize {
        self.painter.max_texture_side()
    }

    /// Makes the surface as large as the window is now.
    pub(crate) fn resize(&mut self, size: Size) {
        if let (Some(width), Some(height)) = (NonZeroU32::new(size.width), NonZeroU32::new(size.height)) {
            self.surface.resize(&self.context, width, height);
        }
    }

    /// Paints a frame of this size and shows it; returns its pixels if `is_wanted`.
    ///
    /// # Errors
    ///
    /// [`Error::Gl`] when the context or the surface is gone.
    pub(crate) fn paint(&mut self, size: Size, shapes: &Shapes, is_wanted: bool) -> Result<Option<Picture>> {
        let failed = |what: &str| {
            let during = format!("{what} the window");
            move |error: glutin::error::Error| Error::gl(during, error.to_string())
        };
        let _guard = self.lock.map(ContextLock::lock);
        self.context.make_current(&self.surface).map_err(failed("painting"))?;
        let pixels = [size.width, size.height];
        self.painter.clear(pixels, GROUND);
        self.painter.paint_and_update_textures(pixels, shapes.pixels_per_point, &shapes.primitives, &shapes.textures);
        let picture = is_wanted.then(|| {
            let image = self.painter.read_screen_rgba(pixels);
            let pixels = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b(), u8::MAX]).collect();
            Picture { size, pixels }
        });
        let swapped = self.surface.swap_buffers(&self.context).map_err(failed("showing"));
        self.release();
        swapped.map(|()| picture)
    }

    /// Contexts of several libraries may live in this process: none stays current while another may be entered.
    fn release(&mut self) {
        // Fails only if the display is gone; then nothing needs releasing.
        let _ = self.context.make_not_current_in_place();
    }
}

impl Drop for WindowGl {
    fn drop(&mut self) {
        let _guard = self.lock.map(ContextLock::lock);
        // Without its context the driver has already released its objects.
        if self.context.make_current(&self.surface).is_ok() {
            self.painter.destroy();
            self.release();
        }
    }
}

/// Returns the display's plainest format, or on Windows the window's. glutin-winit's builder assumes that one exists.
fn config(event_loop: &ActiveEventLoop, window: Option<&Window>) -> std::result::Result<Config, String> {
    let handle = event_loop.display_handle().map_err(|error| format!("the display has no handle ({error})"))?;
    let window = window.map(HasWindowHandle::window_handle).transpose();
    let window = window.map_err(|error| format!("the window has no handle ({error})"))?.map(|window| window.as_raw());
    #[cfg(windows)]
    let preference = DisplayApiPreference::Wgl(window);
    #[cfg(target_os = "macos")]
    let preference = DisplayApiPreference::Cgl;
    #[cfg(not(any(windows, target_os = "macos")))]
    let preference = DisplayApiPreference::Egl;
    // SAFETY: the handles are those of the event loop's connection, which outlives the display, and of a window that is alive.
    let display = unsafe { Display::new(handle.as_raw(), preference) }
        .map_err(|error| format!("the display has no OpenGL ({error})"))?;
    let mut template = ConfigTemplateBuilder::new().with_alpha_size(0).with_api(Api::OPENGL);
    if let Some(window) = window {
        template = template.compatible_with_native_window(window);
    }
    // SAFETY: the display is alive, and so is the template's window, if any.
    let configs = unsafe { display.find_configs(template.build()) }
        .map_err(|error| format!("the display has no format that OpenGL can draw in ({error})"))?;
    configs
        .min_by_key(|config| (config.num_samples(), config.depth_size(), config.stencil_size(), config.alpha_size()))
        .ok_or_else(|| "the display has no format that OpenGL can draw in".to_owned())
}
