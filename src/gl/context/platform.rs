//! The interface of a platform: a context and the surface it draws into.

use crate::scene::Size;
use std::ffi::{CStr, c_void};

/// Why a context cannot be made current.
pub(super) struct NotCurrent {
    pub(super) is_lost: bool,
    pub(super) reason: String,
}

/// A platform's context with the surface it draws into.
pub(super) trait Platform {
    /// Makes the surface this large. The context is not current.
    fn resize(&mut self, size: Size) -> std::result::Result<(), String>;

    /// Makes the context current on this thread.
    fn make_current(&self) -> std::result::Result<(), NotCurrent>;

    /// Stops it being current.
    fn release(&self);

    /// The address of a GL function, or null. The context is current.
    fn proc_address(&self, name: &CStr) -> *const c_void;

    /// The largest surface, if the platform has its own limit.
    fn largest_surface(&self) -> Size;

    /// Whether the context lacks a surface and needs a framebuffer object in its place.
    #[cfg_attr(not(any(target_os = "macos", test)), expect(dead_code, reason = "only contexts of macOS do"))]
    fn lacks_surface(&self) -> bool {
        false
    }
}
