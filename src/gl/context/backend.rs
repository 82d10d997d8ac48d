//! The ways to a context, and the outcomes of attempts.

use super::ContextInfo;
use serde::Serialize;

tinta_geometry::choices! {
    /// The way to an OpenGL context. Recipes and scripts may name every backend on every system; a backend of another system
    /// fails when it is opened.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Backend {
        /// This system's backends, in this order: WGL, CGL, EGL, OSMesa, EGL's surfaceless platform. The first that works draws;
        /// the next that can draws pictures too large for it.
        #[default]
        Auto = "auto",
        /// EGL on a device, without a window system; hardware first.
        Egl = "egl",
        /// EGL on Mesa's surfaceless platform: another screen of the same driver, for two contexts that need not take turns.
        Surfaceless = "surfaceless",
        /// Mesa's off-screen library; Mesa 25.1 removed it.
        OsMesa = "osmesa",
        /// Windows' own, with a hidden window.
        Wgl = "wgl",
        /// CGL, on macOS.
        Cgl = "cgl",
    }
}

/// An attempt to open a context.
#[derive(Debug, Clone, Serialize)]
pub struct Attempt {
    /// The library, and the device if there are several.
    pub device: String,
    /// The result: the context, or the reason for its failure.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// The outcome of an attempt.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// The context works.
    Context(Box<ContextInfo>),
    /// The reason for its failure.
    Error(String),
}
