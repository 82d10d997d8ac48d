//! The fixed-function pipeline of OpenGL 2.1: its matrices, current colour and vertex arrays.
//!
//! A driver of OpenGL 2.1 has it, and glow lacks its functions: `src/gl/legacy/driver.rs` loads them by name. Browsers lack it:
//! `src/gl/legacy/browser.rs` keeps the same state and passes it to shaders. Both have the same methods.

#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod driver;

#[cfg(target_arch = "wasm32")]
pub(super) use browser::*;
#[cfg(not(target_arch = "wasm32"))]
pub(super) use driver::*;

/// `GL_MODELVIEW`
pub(super) const MODELVIEW: u32 = 0x1700;
/// `GL_PROJECTION`
pub(super) const PROJECTION: u32 = 0x1701;
/// `GL_POINT_SMOOTH`
pub(super) const POINT_SMOOTH: u32 = 0x0B10;
/// `GL_LUMINANCE_ALPHA`
pub(super) const LUMINANCE_ALPHA: u32 = 0x190A;
/// `GL_RGBA` as the internal format the article copies to.
pub(super) const RGBA: u32 = 0x1908;
/// `GL_QUADS`
pub(super) const QUADS: u32 = 0x0007;
/// `GL_ALPHA_BITS`
pub(super) const ALPHA_BITS: u32 = 0x0D55;
/// `GL_DEPTH_BITS`
pub(super) const DEPTH_BITS: u32 = 0x0D56;
/// `GL_ALIASED_LINE_WIDTH_RANGE`
pub(super) const ALIASED_LINE_WIDTH_RANGE: u32 = 0x846E;

/// Texture units that plans use without a fragment shader; every driver of OpenGL 2.1 has two.
pub(super) const FIXED_UNITS: u32 = 2;
