//! EGL on a device, without a window system, through glutin.

use super::pbuffer::{Makes, Pbuffer};
use crate::scene::Size;
use glutin::api::egl::{device, display::Display};
use glutin::config::{AsRawConfig, ConfigSurfaceTypes, RawConfig};
use glutin::display::{AsRawDisplay, RawDisplay};
use libloading::Library;
use std::ffi::{CStr, c_void};
use std::sync::OnceLock;

/// The library's names, in the order glutin tries them.
#[cfg(not(windows))]
pub(super) const LIBRARIES: [&str; 2] = ["libEGL.so.1", "libEGL.so"];
#[cfg(windows)]
pub(super) const LIBRARIES: [&str; 2] = ["libEGL.dll", "atioglxx.dll"];

/// The EGL functions called here and by glutin, which assumes that a library of this name has them.
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

/// Checks once that the library exists and is EGL.
pub(super) fn check_library() -> Result<(), String> {
    static CHECKED: OnceLock<Result<(), String>> = OnceLock::new();
    let check = || {
        let mut reasons = Vec::new();
        for name in LIBRARIES {
            // SAFETY: loading EGL runs its initialisers, which have no preconditions.
            let library = match unsafe { Library::new(name) } {
                // Never unloaded, like glutin's own.
                Ok(library) => Box::leak(Box::new(library)),
                Err(error) => {
                    reasons.push(error.to_string());
                    continue;
                }
            };
            for function in FUNCTIONS {
                // SAFETY: this looks the symbol up without calling it.
                let found = unsafe { library.get::<*const c_void>(function.to_bytes_with_nul()) };
                found.map_err(|error| format!("the library lacks a function ({error})"))?;
            }
            return Ok(());
        }
        Err(format!("the library cannot be loaded ({})", reasons.join("; ")))
    };
    CHECKED.get_or_init(check).clone()
}

/// An EGL device.
pub(super) struct Device {
    device: device::Device,
    /// The name to display: EGL and the device's own name.
    pub name: String,
}

/// Returns the devices, hardware before software.
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

/// Opens a compatibility context of this version of OpenGL on this device with a surface of one pixel.
pub(super) fn open(device: &Device, version: (u8, u8)) -> Result<Pbuffer<()>, String> {
    // SAFETY: the device was given by EGL and no native display handle is passed.
    let display = unsafe { Display::with_device(&device.device, None) }
        .map_err(|error| format!("opening the display failed ({error})"))?;
    let display = glutin::display::Display::Egl(display);
    let makes = Makes { display, window: None, surfaces: ConfigSurfaceTypes::PBUFFER, hint: "" };
    Pbuffer::open(makes, version, largest_surface, ())
}

/// Returns EGL's limits for the sides of pbuffers.
fn largest_surface(display: &glutin::display::Display, config: &glutin::config::Config) -> Size {
    // On other systems displays and configs have further kinds; these are EGL's.
    #[cfg_attr(not(windows), expect(irrefutable_let_patterns, reason = "EGL is all there is"))]
    let (glutin::display::Display::Egl(egl), RawDisplay::Egl(raw), RawConfig::Egl(config)) =
        (display, display.raw_display(), config.raw_config())
    else {
        return Size { width: u32::MAX, height: u32::MAX };
    };
    let limit = |attribute: u32| {
        let mut value = 0;
        // SAFETY: display and config are alive, and the attribute is one integer.
        let known = unsafe { egl.egl().GetConfigAttrib(raw.cast(), config.cast(), attribute as i32, &mut value) };
        // Some drivers leave it at 0, meaning no limit.
        if known == 0 || value <= 0 { u32::MAX } else { value as u32 }
    };
    const MAX_PBUFFER_HEIGHT: u32 = 0x302A;
    const MAX_PBUFFER_WIDTH: u32 = 0x302C;
    Size { width: limit(MAX_PBUFFER_WIDTH), height: limit(MAX_PBUFFER_HEIGHT) }
}
