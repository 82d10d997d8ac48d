//! EGL on a device, without a window system, through glutin.

use super::driver::{NotCurrent, Platform};
use crate::scene::Size;
use glutin::api::egl::{config::Config, context::PossiblyCurrentContext, device, display::Display, surface::Surface};
use glutin::config::{Api, AsRawConfig, ConfigSurfaceTypes, ConfigTemplateBuilder, GlConfig, RawConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentGlContext, Robustness, Version,
};
use glutin::display::{AsRawDisplay, GlDisplay, RawDisplay};
use glutin::error::ErrorKind;
use glutin::surface::{PbufferSurface, SurfaceAttributesBuilder};
use libloading::Library;
use std::ffi::{CStr, c_void};
use std::num::NonZeroU32;
use std::sync::OnceLock;

/// The library's names, in the order glutin tries them.
#[cfg(not(windows))]
pub(super) const LIBRARIES: [&str; 2] = ["libEGL.so.1", "libEGL.so"];
#[cfg(windows)]
pub(super) const LIBRARIES: [&str; 2] = ["libEGL.dll", "atioglxx.dll"];

/// What of it is called here and by glutin, which takes for granted that a library of this name has it.
const FUNCTIONS: [&CStr; 15] = [
    c"eglBindAPI",
    c"eglChooseConfig",
    c"eglCreateContext",
    c"eglCreatePbufferSurface",
    c"eglDestroyContext",
    c"eglDestroySurface",
    c"eglGetConfigAttrib",
    c"eglGetCurrentContext",
    c"eglGetError",
    c"eglGetProcAddress",
    c"eglInitialize",
    c"eglMakeCurrent",
    c"eglQueryString",
    c"eglQuerySurface",
    c"eglTerminate",
];

/// Makes sure that the library is there and is EGL, once.
pub(super) fn check_library() -> Result<(), String> {
    static CHECKED: OnceLock<Result<(), String>> = OnceLock::new();
    let check = || {
        let mut reasons = Vec::new();
        for name in LIBRARIES {
            // SAFETY: loading EGL runs its initialisers, which have no preconditions.
            let library = match unsafe { Library::new(name) } {
                // It stays for the life of the process, as glutin's own.
                Ok(library) => Box::leak(Box::new(library)),
                Err(error) => {
                    reasons.push(error.to_string());
                    continue;
                }
            };
            for function in FUNCTIONS {
                // SAFETY: the symbol is only looked for.
                let found = unsafe { library.get::<*const c_void>(function.to_bytes_with_nul()) };
                found.map_err(|error| format!("the library lacks a function ({error})"))?;
            }
            return Ok(());
        }
        Err(format!("the library cannot be loaded ({})", reasons.join("; ")))
    };
    CHECKED.get_or_init(check).clone()
}

/// A device EGL knows.
pub(super) struct Device {
    device: device::Device,
    /// For people: EGL and what the device calls itself.
    pub name: String,
}

/// The devices, hardware before software.
pub(super) fn devices() -> Result<Vec<Device>, String> {
    check_library()?;
    let found = device::Device::query_devices().map_err(|error| format!("no devices ({error})"))?;
    let is_software = |device: &device::Device| device.extensions().contains("EGL_MESA_device_software");
    let mut devices: Vec<device::Device> = found.collect();
    devices.sort_by_key(is_software);
    if devices.is_empty() {
        return Err("no devices".to_owned());
    }
    Ok(devices
        .into_iter()
        .enumerate()
        .map(|(number, device)| {
            let path = device.drm_render_device_node_path().or(device.drm_device_node_path());
            let kind = match (path, is_software(&device)) {
                (Some(path), _) => format!(" {}", path.display()),
                (None, true) => " software".to_owned(),
                (None, false) => String::new(),
            };
            Device { name: format!("EGL device {number}{kind}"), device }
        })
        .collect())
}

/// A context with its pbuffer.
pub(super) struct EglContext {
    // Declared, and so dropped, before the display they belong to.
    context: PossiblyCurrentContext,
    surface: Surface<PbufferSurface>,
    size: Size,
    config: Config,
    display: Display,
}

impl EglContext {
    /// A compatibility context of this version of OpenGL on this device with a surface of one pixel.
    pub(super) fn open(device: &Device, (major, minor): (u8, u8)) -> Result<Self, String> {
        let step = |what: &'static str| move |error: glutin::error::Error| format!("{what} failed ({error})");
        // SAFETY: the device was given by EGL and no native display handle is passed.
        let display = unsafe { Display::with_device(&device.device, None) }.map_err(step("opening the display"))?;
        let template = ConfigTemplateBuilder::new()
            .with_alpha_size(8)
            .with_depth_size(24)
            .with_stencil_size(0)
            .with_surface_type(ConfigSurfaceTypes::PBUFFER)
            .with_api(Api::OPENGL)
            .build();
        // SAFETY: the display is alive and the template names no native window.
        let configs = unsafe { display.find_configs(template) }.map_err(step("asking for framebuffer formats"))?;
        let config = configs
            .filter(|config| config.alpha_size() == 8 && config.depth_size() >= 24 && !config.float_pixels())
            .min_by_key(|config| (config.num_samples(), config.depth_size(), config.stencil_size()))
            .ok_or("it has no off-screen format with 8 alpha and 24 depth bits")?;
        let create = |robustness: Robustness| {
            let api = ContextApi::OpenGl(Some(Version::new(major, minor)));
            let attributes =
                ContextAttributesBuilder::new().with_context_api(api).with_robustness(robustness).build(None);
            // SAFETY: config and display belong together; no native window is involved.
            unsafe { display.create_context(&config, &attributes) }
        };
        // One that says when it is lost where the driver has such, which software does not; else any.
        let context = create(Robustness::RobustLoseContextOnReset)
            .or_else(|_| create(Robustness::NotRobust))
            .map_err(|error| format!("making a GL {major}.{minor} context failed ({error})"))?;
        let size = Size { width: 1, height: 1 };
        let surface = create_surface(&display, &config, size)?;
        Ok(Self { context: context.treat_as_possibly_current(), surface, size, config, display })
    }
}

impl Platform for EglContext {
    fn resize(&mut self, size: Size) -> Result<(), String> {
        if size != self.size {
            self.surface = create_surface(&self.display, &self.config, size)?;
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
        // Fails only if the display is gone, and then there is nothing to release.
        let _ = self.context.make_not_current_in_place();
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        self.display.get_proc_address(name)
    }

    fn largest_surface(&self) -> Size {
        // Elsewhere displays and configs may be of other kinds; these are EGL's.
        #[cfg_attr(not(windows), expect(irrefutable_let_patterns, reason = "EGL is all there is"))]
        let (RawDisplay::Egl(display), RawConfig::Egl(config)) = (self.display.raw_display(), self.config.raw_config())
        else {
            return Size { width: u32::MAX, height: u32::MAX };
        };
        let limit = |attribute: u32| {
            let mut value = 0;
            // SAFETY: display and config are alive, and the attribute is one integer.
            let known = unsafe {
                self.display.egl().GetConfigAttrib(display.cast(), config.cast(), attribute as i32, &mut value)
            };
            // Some drivers leave it at 0 and mean "no limit of its own".
            if known == 0 || value <= 0 { u32::MAX } else { value as u32 }
        };
        const MAX_PBUFFER_HEIGHT: u32 = 0x302A;
        const MAX_PBUFFER_WIDTH: u32 = 0x302C;
        Size { width: limit(MAX_PBUFFER_WIDTH), height: limit(MAX_PBUFFER_HEIGHT) }
    }
}

fn create_surface(display: &Display, config: &Config, size: Size) -> Result<Surface<PbufferSurface>, String> {
    let side = |pixels: u32| NonZeroU32::new(pixels).ok_or("a surface of no pixels");
    let attributes = SurfaceAttributesBuilder::<PbufferSurface>::new().build(side(size.width)?, side(size.height)?);
    // SAFETY: the config is the display's and was asked for with pbuffer support.
    unsafe { display.create_pbuffer_surface(config, &attributes) }
        .map_err(|error| format!("making an off-screen surface of {size} pixels failed ({error})"))
}
