//! A pixel explained: every step of a plan recomputed for one pixel, beside the values that the driver left there.
//!
//! In: a [`Plan`], and what GL held after each of its steps ([`crate::Renderer::step_values`]). Out: the triangles that cover the
//! pixel, their varyings, each statement of the shaders with its value, the depth test, the blending and the value written. Each
//! step starts from the driver's own values, so an error does not travel from pass to pass.

mod explainer;
mod fragment;
mod recomputation;
mod textures;
mod triangles;
mod verdict;

pub use explainer::{Explainer, PixelStep, is_background};
pub use fragment::{Corner, Fragment};
pub use recomputation::{Filtering, Recomputation};
pub use tinta_glsl::{Base, Event, Mistake, Precision, Sample, Texel, Type, Value, What};
pub use verdict::{AgainstLines, Flip, INK_FROM, LINE_TOLERANCE_PX, Verdict, against_lines};
