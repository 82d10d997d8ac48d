//! Ways to an OpenGL 2.1 context without a window, tried in order, each attempt remembered; in a browser, a canvas's.

#[cfg(target_arch = "wasm32")]
mod canvas;
#[cfg(not(target_arch = "wasm32"))]
mod context_lock;
#[cfg(not(target_arch = "wasm32"))]
mod driver;
#[cfg(not(target_arch = "wasm32"))]
mod egl;
mod info;
#[cfg(not(target_arch = "wasm32"))]
mod load;
#[cfg(not(target_arch = "wasm32"))]
mod osmesa;
#[cfg(test)]
mod tests;
#[cfg(feature = "window")]
pub(crate) mod window;

#[cfg(target_arch = "wasm32")]
pub use canvas::attempts;
#[cfg(target_arch = "wasm32")]
pub(crate) use canvas::{Context, Current};
#[cfg(not(target_arch = "wasm32"))]
pub use driver::attempts;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use driver::{Context, Current};
pub use info::{ContextInfo, is_software};

use serde::Serialize;

/// Which way to take.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Backend {
    /// EGL, then OSMesa: the first that works; for pictures too large for it the next that draws them.
    #[default]
    Auto,
    /// EGL on a device, without a window system; hardware first.
    Egl,
    /// Mesa's off-screen library.
    OsMesa,
}

impl Backend {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] = [("auto", Self::Auto), ("egl", Self::Egl), ("osmesa", Self::OsMesa)];
}

tinta_geometry::choices!(Backend);

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
