//! Ways to an OpenGL 2.1 context without a window, tried in order with a record of each attempt; in a browser, a canvas's
//! context.
//!
//! WGL on Windows, CGL on macOS, EGL elsewhere and wherever its library exists. OSMesa needs none of them.

mod backend;
#[cfg(target_arch = "wasm32")]
mod canvas;
#[cfg(target_os = "macos")]
mod cgl;
#[cfg(not(target_arch = "wasm32"))]
mod context_lock;
#[cfg(not(target_arch = "wasm32"))]
mod driver;
#[cfg(not(any(target_arch = "wasm32", target_os = "macos")))]
mod egl;
mod info;
#[cfg(not(target_arch = "wasm32"))]
mod load;
#[cfg(not(target_arch = "wasm32"))]
mod osmesa;
#[cfg(not(any(target_arch = "wasm32", target_os = "macos")))]
mod pbuffer;
#[cfg(not(target_arch = "wasm32"))]
mod platform;
#[cfg(any(target_os = "macos", test))]
mod surface_framebuffer;
#[cfg(all(unix, not(target_os = "macos")))]
mod surfaceless;
#[cfg(all(test, unix, not(target_os = "macos")))]
mod tests;
#[cfg(windows)]
mod wgl;
#[cfg(feature = "window")]
pub(crate) mod window;

pub use backend::{Attempt, Backend, Outcome};
#[cfg(target_arch = "wasm32")]
pub(crate) use canvas::{Context, Current};
#[cfg(target_arch = "wasm32")]
pub use canvas::{attempts, witnesses};
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
pub(crate) use driver::each;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use driver::{Context, Current};
#[cfg(not(target_arch = "wasm32"))]
pub use driver::{attempts, witnesses};
pub use info::{ContextInfo, is_software};
#[cfg(any(target_os = "macos", test))]
pub(in crate::gl) use surface_framebuffer::SurfaceFramebuffer;

use super::Gl;
use crate::error::Error;
use crate::scene::Size;
use std::rc::Rc;

impl Context {
    /// Whether surfaces of this size are within its limits.
    pub(crate) fn draws(&self, surface: Size) -> bool {
        let limit = self.info().largest_picture;
        surface.width <= limit.width && surface.height <= limit.height
    }

    pub(crate) fn info(&self) -> &ContextInfo {
        &self.gl.info
    }

    pub(crate) fn gl(&self) -> &Rc<Gl> {
        &self.gl
    }

    /// The error for a surface of this size, where the largest is another.
    fn too_large(&self, size: Size, limit: Size) -> Error {
        Error::PictureTooLarge {
            width: size.width,
            height: size.height,
            limit_width: limit.width,
            limit_height: limit.height,
            renderer: self.info().renderer.clone(),
        }
    }
}
