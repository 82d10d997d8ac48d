//! Ways to an OpenGL 2.1 context without a window, tried in order, each attempt remembered; in a browser, a canvas's.
//!
//! Each system has its own: WGL on Windows, CGL on macOS, EGL elsewhere and where such a library is. OSMesa needs none of them.

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

use serde::Serialize;

tinta_geometry::choices! {
    /// Which way to take. Those of other systems are refused with a sentence when they are asked for: a recipe or a script that
    /// names one is understood everywhere.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Backend {
        /// Those of this system, in this order: WGL, CGL, EGL, OSMesa, EGL's surfaceless platform. The first that works; for pictures
        /// too large for it the next that draws them.
        #[default]
        Auto = "auto",
        /// EGL on a device, without a window system; hardware first.
        Egl = "egl",
        /// EGL on Mesa's surfaceless platform: another screen of the same driver, so that two contexts need not take turns.
        Surfaceless = "surfaceless",
        /// Mesa's off-screen library, which Mesa has no more since 25.1.
        OsMesa = "osmesa",
        /// Windows' own, beside a window that is never shown.
        Wgl = "wgl",
        /// That of macOS.
        Cgl = "cgl",
    }
}

/// One way that was tried.
#[derive(Debug, Clone, Serialize)]
pub struct Attempt {
    /// The library, and the device where there is a choice.
    pub device: String,
    /// What came of it: the context, or why there is none.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of an attempt.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It works.
    Context(Box<ContextInfo>),
    /// Why it does not.
    Error(String),
}
