//! The ways to a context, and what came of those tried.

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
    /// The result: the context, or the reason for its failure.
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
