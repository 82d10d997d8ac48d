//! OpenGL 2.1: contexts without a window, the fixed-function calls glow lacks, objects with owners, plans carried out.
//!
//! All `unsafe` code of the drawing is here. In: a [`crate::plan::Plan`] and a [`crate::scene::Scene`]. Out: pixels and times.
//! It knows no style. Every `unsafe` block here rests on two facts, which its comment names: the functions'
//! context is current on this thread, and the objects passed are alive.
//!
//! ```
//! use tinta::gl::context::{Attempt, Outcome, attempts};
//!
//! // Every way to a context on this machine, and its outcome.
//! for Attempt { device, outcome } in attempts(tinta::Backend::Auto) {
//!     match outcome {
//!         Outcome::Context(info) => println!("{device}: {}", info.renderer),
//!         Outcome::Error(reason) => println!("{device}: {reason}"),
//!     }
//! }
//! ```

#![expect(unsafe_code, reason = "OpenGL is a C interface; this module wraps all of it")]

mod buffers;
pub mod context;
mod edges;
pub(crate) mod execute;
mod faults;
pub(crate) mod fixed_function;
mod immediate;
mod legacy;
mod meshes;
mod objects;
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
pub(crate) mod probe;
mod quads;
mod smooth_edges;
mod sources;
pub(crate) mod square;
mod squares;
mod targets;
mod textures;

pub use context::{Attempt, Backend, ContextInfo, is_software};
pub use faults::Fault;

use crate::error::{Error, Result};
use crate::plan::Submission;
use glow::HasContext;
use immediate::{Immediate, Vertices};
use legacy::Legacy;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

/// WebGL's name for GL_CONTEXT_LOST.
const CONTEXT_LOST_WEBGL: u32 = 0x9242;

/// One context's loaded GL functions, its information, and the number of its live objects.
pub(crate) struct Gl {
    glow: Rc<glow::Context>,
    legacy: Legacy,
    /// The calls that draw without buffers; otherwise the name of the first function that the driver lacks.
    immediate: std::result::Result<Immediate, String>,
    info: ContextInfo,
    /// The framebuffer object that replaces the surface in a context without one.
    #[cfg(any(target_os = "macos", test))]
    surface: Option<context::SurfaceFramebuffer>,
    live_objects: Cell<usize>,
    /// Shaders used instead of those built in, by their paths below `glsl/`.
    replaced_shaders: RefCell<HashMap<String, String>>,
    /// If the context is lost, the source of that report.
    lost: Cell<Option<&'static str>>,
}

impl Gl {
    /// The context's own framebuffer: 0, or the framebuffer object that replaces it.
    fn own_framebuffer(&self) -> Option<glow::Framebuffer> {
        #[cfg(any(target_os = "macos", test))]
        return self.surface.as_ref().map(context::SurfaceFramebuffer::id);
        #[cfg(not(any(target_os = "macos", test)))]
        None
    }

    /// Sets whether faces turned away are skipped.
    fn cull(&self, skips_back_faces: bool) {
        // SAFETY: the context is current; the names are of GL 2.1.
        unsafe {
            match skips_back_faces {
                true => self.glow.enable(glow::CULL_FACE),
                false => self.glow.disable(glow::CULL_FACE),
            }
        }
    }

    /// The functions of immediate mode, if the driver has them.
    fn immediate(&self) -> Result<&Immediate> {
        self.immediate.as_ref().map_err(|missing| {
            let problem = format!(
                "{} has no {missing}, which programs of 2001 used to draw; leave this out, buffers draw the same picture",
                self.info.renderer
            );
            Error::value("submission", Submission::Immediate, problem)
        })
    }

    /// Draws vertices by glBegin and glEnd, if the driver has them.
    fn draw_in_immediate_mode(&self, vertices: &Vertices<'_>) -> Result<()> {
        let immediate = self.immediate()?;
        // SAFETY: the context is current, and only this code calls glBegin and glEnd, in pairs.
        unsafe { immediate.send(vertices) };
        Ok(())
    }

    /// Returns an error if the context is lost.
    pub(crate) fn refuse_if_lost(&self, during: &str) -> Result<()> {
        match self.lost.get() {
            None => Ok(()),
            Some(what) => Err(Error::ContextLost { during: during.to_owned(), what: what.to_owned() }),
        }
    }

    /// Returns GL's error since the last call, if any, as ours. A lost context takes precedence over other errors.
    pub(crate) fn check(&self, during: &str) -> Result<()> {
        // SAFETY: the context is current: only its holder calls this, between make_current and release.
        let code = unsafe { self.glow.get_error() };
        // SAFETY: as above; the table holds only functions that the driver has.
        match unsafe { self.legacy.reset_status() } {
            glow::NO_ERROR if [glow::CONTEXT_LOST, CONTEXT_LOST_WEBGL].contains(&code) => {
                self.lost.set(Some("GL_CONTEXT_LOST"))
            }
            glow::NO_ERROR => {}
            glow::GUILTY_CONTEXT_RESET => self.lost.set(Some("GL_GUILTY_CONTEXT_RESET")),
            glow::INNOCENT_CONTEXT_RESET => self.lost.set(Some("GL_INNOCENT_CONTEXT_RESET")),
            _ => self.lost.set(Some("GL_UNKNOWN_CONTEXT_RESET")),
        }
        self.refuse_if_lost(during)?;
        if code == glow::NO_ERROR {
            return Ok(());
        }
        // One call may leave several flags; clear them all before the next. SAFETY: as above. A broken driver could report errors
        // for ever, hence the bound.
        (0..16).take_while(|_| unsafe { self.glow.get_error() } != glow::NO_ERROR).count();
        let what = match code {
            glow::INVALID_ENUM => "GL_INVALID_ENUM".to_owned(),
            glow::INVALID_VALUE => "GL_INVALID_VALUE".to_owned(),
            glow::INVALID_OPERATION => "GL_INVALID_OPERATION".to_owned(),
            glow::INVALID_FRAMEBUFFER_OPERATION => "GL_INVALID_FRAMEBUFFER_OPERATION".to_owned(),
            glow::OUT_OF_MEMORY => "GL_OUT_OF_MEMORY".to_owned(),
            other => format!("GL error {other:#06x}"),
        };
        Err(Error::gl(during, what))
    }
}
