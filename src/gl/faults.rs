//! Fault injection: imitates a failing driver, for tests and for `tinta stress`.
//!
//! GL's functions are loaded by name, so a context made with a [`Fault`] gets stand-ins for a few of them. They count, fail when
//! it is their turn, and otherwise call the driver's. All other code and the driver stay the same. Each such context counts
//! separately. Contexts without a fault are unaffected, on the same thread or another.

#[cfg(not(target_arch = "wasm32"))]
mod stand_ins;

#[cfg(not(target_arch = "wasm32"))]
pub(super) use stand_ins::{Faults, set_current};

/// The fault to simulate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The driver refuses to make a context: an OpenGL version that does not exist is requested.
    ContextRefused,
    /// The driver refuses to compile a shader, the one after `after` others: it gets an invalid text.
    ShaderRefused {
        /// Number of shaders compiled before.
        after: u32,
    },
    /// Device memory runs out once: GL_OUT_OF_MEMORY for the texture, buffer or renderbuffer after `after` others.
    OutOfMemory {
        /// Number of allocations that succeed before.
        after: u32,
    },
    /// The context is lost, as after a device reset, after `after` uploads, clears and draws. From then on every call does
    /// nothing, and every query for errors returns GL_CONTEXT_LOST (KHR_robustness).
    ContextLost {
        /// Number of calls that succeed before.
        after: u32,
    },
    /// The same, but only the reset status reports it (ARB_robustness).
    ContextReset {
        /// Number of calls that succeed before.
        after: u32,
    },
    /// The driver lacks glBegin, as in a core profile, and has everything else.
    NoImmediateMode,
}
