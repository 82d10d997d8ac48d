//! WGL on Windows, through glutin: a pbuffer, and a hidden window, which Windows needs to make a context.

use super::pbuffer::{Makes, Pbuffer};
use crate::scene::Size;
use glutin::api::wgl::display::Display;
use glutin::config::ConfigSurfaceTypes;
use raw_window_handle::{RawDisplayHandle, RawWindowHandle, Win32WindowHandle, WindowsDisplayHandle};
use std::num::NonZeroIsize;
use std::ptr;
use windows_sys::Win32::Foundation::HWND;
use windows_sys::Win32::System::LibraryLoader::GetModuleHandleW;
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CS_OWNDC, CreateWindowExW, DefWindowProcW, DestroyWindow, RegisterClassW, WNDCLASSW, WS_CLIPCHILDREN,
    WS_CLIPSIBLINGS, WS_DISABLED, WS_POPUP,
};
use windows_sys::w;

/// A hidden window. Windows ties it to the thread that made it, as it does contexts.
pub(super) struct HiddenWindow {
    window: HWND,
    handle: RawWindowHandle,
}

impl HiddenWindow {
    fn open() -> Result<Self, String> {
        let failed = || format!("making a hidden window failed ({})", std::io::Error::last_os_error());
        let name = w!("tinta off-screen");
        // SAFETY: the names end with 0 and are static; the class is this program's, with Windows' own procedure. An already
        // registered class is no error: the window then uses it.
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

/// A compatibility context of this version of OpenGL with a surface of one pixel.
pub(super) fn open(version: (u8, u8)) -> Result<Pbuffer<HiddenWindow>, String> {
    let window = HiddenWindow::open()?;
    let display = RawDisplayHandle::Windows(WindowsDisplayHandle::new());
    // SAFETY: the window is alive, and its handle has the instance that it was made by.
    let display = unsafe { Display::new(display, Some(window.handle)) }
        .map_err(|error| format!("opening the display failed ({error})"))?;
    let makes = Makes {
        display: glutin::display::Display::Wgl(display),
        window: Some(window.handle),
        surfaces: ConfigSurfaceTypes::WINDOW | ConfigSurfaceTypes::PBUFFER,
        hint: "; Windows' own OpenGL has none, a graphics card's driver or Mesa's for Windows has",
    };
    // A failed pbuffer shows its limit; another check covers the driver's viewport and textures.
    Pbuffer::open(makes, version, |_, _| Size { width: u32::MAX, height: u32::MAX }, window)
}
