//! WGL on Windows, through glutin: a pbuffer, and a window that is never shown, which Windows wants a context to be made for.

use super::driver::{NotCurrent, Platform};
use crate::scene::Size;
use glutin::api::wgl::{config::Config, context::PossiblyCurrentContext, display::Display, surface::Surface};
use glutin::config::{Api, ConfigSurfaceTypes, ConfigTemplateBuilder, GlConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentGlContext, Robustness, Version,
};
use glutin::display::GlDisplay;
use glutin::error::ErrorKind;
use glutin::surface::{PbufferSurface, SurfaceAttributesBuilder};
use raw_window_handle::{RawDisplayHandle, RawWindowHandle, Win32WindowHandle, WindowsDisplayHandle};
use std::ffi::{CStr, c_void};
use std::num::{NonZeroIsize, NonZeroU32};
use std::ptr;
use windows_sys::Win32::Foundation::HWND;
use windows_sys::Win32::System::LibraryLoader::GetModuleHandleW;
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CS_OWNDC, CreateWindowExW, DefWindowProcW, DestroyWindow, RegisterClassW, WNDCLASSW, WS_CLIPCHILDREN,
    WS_CLIPSIBLINGS, WS_DISABLED, WS_POPUP,
};
use windows_sys::w;

/// A window that is never shown. Windows ties it to the thread that made it, to which a context belongs too.
struct HiddenWindow {
    window: HWND,
    handle: RawWindowHandle,
}

impl HiddenWindow {
    fn open() -> Result<Self, String> {
        let failed = || format!("making a hidden window failed ({})", std::io::Error::last_os_error());
        let name = w!("tinta off-screen");
        // SAFETY: the names end with 0 and live for ever; the class is that of this program, with Windows' own procedure. That it
        // is there already is no error worth looking at: the window then has it.
        let (instance, window) = unsafe {
            let instance = GetModuleHandleW(ptr::null());
            let class = WNDCLASSW {
                style: CS_OWNDC,
                lpfnWndProc: Some(DefWindowProcW),
                hInstance: instance,
                lpszClassName: name,
                ..std::mem::zeroed()
            };
            RegisterClassW(&class);
            let style = WS_POPUP | WS_DISABLED | WS_CLIPCHILDREN | WS_CLIPSIBLINGS;
            let none = ptr::null_mut();
            (instance, CreateWindowExW(0, name, name, style, 0, 0, 1, 1, none, none, instance, ptr::null()))
        };
        let mut handle = Win32WindowHandle::new(NonZeroIsize::new(window as isize).ok_or_else(failed)?);
        handle.hinstance = NonZeroIsize::new(instance as isize);
        Ok(Self { window, handle: handle.into() })
    }
}

impl Drop for HiddenWindow {
    fn drop(&mut self) {
        // SAFETY: the window is ours, of this thread, and nothing uses it afterwards.
        unsafe { DestroyWindow(self.window) };
    }
}

/// A context with its pbuffer.
pub(super) struct WglContext {
    // Declared, and so dropped, in this order: each before what it was made from.
    context: PossiblyCurrentContext,
    surface: Surface<PbufferSurface>,
    size: Size,
    config: Config,
    display: Display,
    _window: HiddenWindow,
}

impl WglContext {
    /// A compatibility context of this version of OpenGL with a surface of one pixel.
    pub(super) fn open((major, minor): (u8, u8)) -> Result<Self, String> {
        let step = |what: &'static str| move |error: glutin::error::Error| format!("{what} failed ({error})");
        let window = HiddenWindow::open()?;
        let display = RawDisplayHandle::Windows(WindowsDisplayHandle::new());
        // SAFETY: the window is alive, and its handle has the instance that it was made by.
        let display = unsafe { Display::new(display, Some(window.handle)) }.map_err(step("opening the display"))?;
        let template = ConfigTemplateBuilder::new()
            .with_alpha_size(8)
            .with_depth_size(24)
            .with_stencil_size(0)
            .with_surface_type(ConfigSurfaceTypes::WINDOW | ConfigSurfaceTypes::PBUFFER)
            .compatible_with_native_window(window.handle)
            .with_api(Api::OPENGL)
            .build();
        // SAFETY: the display and the template's window are alive.
        let configs = unsafe { display.find_configs(template) }.map_err(step("asking for framebuffer formats"))?;
        let config = configs
            .filter(|config| config.alpha_size() == 8 && config.depth_size() >= 24 && !config.float_pixels())
            .min_by_key(|config| (config.num_samples(), config.depth_size(), config.stencil_size()))
            .ok_or("it has no off-screen format with 8 alpha and 24 depth bits")?;
        let create = |robustness: Robustness| {
            let api = ContextApi::OpenGl(Some(Version::new(major, minor)));
            let attributes = ContextAttributesBuilder::new()
                .with_context_api(api)
                .with_robustness(robustness)
                .build(Some(window.handle));
            // SAFETY: config, display and window belong together and are alive.
            unsafe { display.create_context(&config, &attributes) }
        };
        // One that says when it is lost where the driver has such; else any.
        let context = create(Robustness::RobustLoseContextOnReset)
            .or_else(|_| create(Robustness::NotRobust))
            .map_err(|error| format!("making a GL {major}.{minor} context failed ({error})"))?;
        let size = Size { width: 1, height: 1 };
        let surface = create_surface(&display, &config, size)?;
        Ok(Self { context: context.treat_as_possibly_current(), surface, size, config, display, _window: window })
    }
}

impl Platform for WglContext {
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
        // Fails only where the display is gone, and then there is nothing to release.
        let _ = self.context.make_not_current_in_place();
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        self.display.get_proc_address(name)
    }

    /// Making one says where the limit is; what the driver's viewport and textures allow is asked elsewhere.
    fn largest_surface(&self) -> Size {
        Size { width: u32::MAX, height: u32::MAX }
    }
}

fn create_surface(display: &Display, config: &Config, size: Size) -> Result<Surface<PbufferSurface>, String> {
    let side = |pixels: u32| NonZeroU32::new(pixels).ok_or("a surface of no pixels");
    let attributes = SurfaceAttributesBuilder::<PbufferSurface>::new().build(side(size.width)?, side(size.height)?);
    // SAFETY: the config is the display's and was asked for with pbuffer support.
    unsafe { display.create_pbuffer_surface(config, &attributes) }.map_err(|error| {
        format!(
            "making an off-screen surface of {size} pixels failed ({error}); Windows' own OpenGL has none, a graphics card's driver \
             or Mesa's for Windows has"
        )
    })
}
