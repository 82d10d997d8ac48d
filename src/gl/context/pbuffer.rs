//! A context that draws into a pbuffer, through glutin: by EGL on a device, by WGL on Windows.

use super::platform::{NotCurrent, Platform};
use crate::scene::Size;
use glutin::config::{Api, Config, ConfigSurfaceTypes, ConfigTemplateBuilder, GlConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentContext, PossiblyCurrentGlContext,
    Robustness, Version,
};
use glutin::display::{Display, GlDisplay};
use glutin::error::ErrorKind;
use glutin::surface::{PbufferSurface, Surface, SurfaceAttributesBuilder};
use raw_window_handle::RawWindowHandle;
use std::ffi::{CStr, c_void};
use std::num::NonZeroU32;

/// The objects that a context is made from.
pub(super) struct Makes {
    pub display: Display,
    /// The window that the context is made for, alive as long as the context.
    pub window: Option<RawWindowHandle>,
    pub surfaces: ConfigSurfaceTypes,
    /// The hint for the error where pbuffers are missing.
    pub hint: &'static str,
}

/// A context with its pbuffer.
pub(super) struct Pbuffer<Kept> {
    // Declared, and so dropped, in this order: each before the object it was made from.
    context: PossiblyCurrentContext,
    surface: Surface<PbufferSurface>,
    size: Size,
    largest: Size,
    config: Config,
    makes: Makes,
    _kept: Kept,
}

impl<Kept> Pbuffer<Kept> {
    /// Opens a compatibility context of this version of OpenGL with a surface of one pixel; `kept` is dropped after it.
    pub(super) fn open(
        makes: Makes,
        (major, minor): (u8, u8),
        largest: impl FnOnce(&Display, &Config) -> Size,
        kept: Kept,
    ) -> Result<Self, String> {
        let template = ConfigTemplateBuilder::new()
            .with_alpha_size(8)
            .with_depth_size(24)
            .with_stencil_size(0)
            .with_surface_type(makes.surfaces)
            .with_api(Api::OPENGL);
        let template = match makes.window {
            Some(window) => template.compatible_with_native_window(window),
            None => template,
        };
        // SAFETY: the display is alive, and so is the template's window if it names one.
        let configs = unsafe { makes.display.find_configs(template.build()) }
            .map_err(|error| format!("asking for framebuffer formats failed ({error})"))?;
        let config = configs
            .filter(|config| config.alpha_size() == 8 && config.depth_size() >= 24 && !config.float_pixels())
            .min_by_key(|config| (config.num_samples(), config.depth_size(), config.stencil_size()))
            .ok_or("it has no off-screen format with 8 alpha and 24 depth bits")?;
        let create = |robustness: Robustness| {
            let api = ContextApi::OpenGl(Some(Version::new(major, minor)));
            let attributes =
                ContextAttributesBuilder::new().with_context_api(api).with_robustness(robustness).build(makes.window);
            // SAFETY: config, display and window belong together and are alive.
            unsafe { makes.display.create_context(&config, &attributes) }
        };
        // Preferably a context that reports its loss, which software drivers lack; otherwise any.
        let context = create(Robustness::RobustLoseContextOnReset)
            .or_else(|_| create(Robustness::NotRobust))
            .map_err(|error| format!("making a GL {major}.{minor} context failed ({error})"))?;
        let size = Size { width: 1, height: 1 };
        let surface = makes.create_surface(&config, size)?;
        let largest = largest(&makes.display, &config);
        Ok(Self { context: context.treat_as_possibly_current(), surface, size, largest, config, makes, _kept: kept })
    }
}

impl Makes {
    fn create_surface(&self, config: &Config, size: Size) -> Result<Surface<PbufferSurface>, String> {
        let side = |pixels: u32| NonZeroU32::new(pixels).ok_or("a surface of no pixels");
        let attributes = SurfaceAttributesBuilder::<PbufferSurface>::new().build(side(size.width)?, side(size.height)?);
        // SAFETY: the config is the display's and was chosen with pbuffer support.
        unsafe { self.display.create_pbuffer_surface(config, &attributes) }
            .map_err(|error| format!("making an off-screen surface of {size} pixels failed ({error}){}", self.hint))
    }
}

impl<Kept> Platform for Pbuffer<Kept> {
    fn resize(&mut self, size: Size) -> Result<(), String> {
        if size != self.size {
            self.surface = self.makes.create_surface(&self.config, size)?;
            self.size = size;
        }
        Ok(())
    }

    fn make_current(&self) -> Result<(), NotCurrent> {
        self.context.make_current(&self.surface).map_err(|error| NotCurrent {
            is_lost: matches!(error.error_kind(), ErrorKind::ContextLost),
            reason: format!("it cannot be made current ({error})"),
        })
    }

    fn release(&self) {
        // Fails only if the display is gone; then nothing needs releasing.
        let _ = self.context.make_not_current_in_place();
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        self.makes.display.get_proc_address(name)
    }

    fn largest_surface(&self) -> Size {
        self.largest
    }
}
