//! A pixel explained: every step of a plan recomputed for one pixel, beside the values that the driver left there.
//!
//! In: a [`Plan`](crate::plan::Plan), and what GL held after each of its steps ([`crate::Renderer::step_values`]). Out: the triangles that cover the
//! pixel, their varyings, each statement of the shaders with its value, the depth test, the blending and the value written. Each
//! step starts from the driver's own values, so an error does not travel from pass to pass.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::pixel::{Explainer, Recomputation};
//! use tinta::scene::Rectangle;
//! use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName, load};
//!
//! let gear = load("builtin:gear", &LoadOptions::default())?.mesh;
//! let size = Size { width: 32, height: 32 };
//! let scene = Scene::new([gear], &SceneSettings { size, ..SceneSettings::default() })?;
//! let plan = Style::named(StyleName::ThreePass).plan(&scene, Show::Final)?;
//! let mut renderer = Renderer::new(Backend::Auto)?;
//! let values = renderer.step_values(&scene, &plan, Rectangle { x: 0, y: 0, width: 32, height: 32 })?;
//!
//! let how = Recomputation::like(renderer.context());
//! let steps = Explainer::new(&scene, &plan, &values, how)?.pixel([16, 16], true)?;
//! let border = steps.last().expect("the last step");
//! assert_eq!(border.pass, "border");
//! assert!(border.fragments[0].events.iter().any(|event| event.line == 21));
//! # Ok(())
//! # }
//! ```

mod explainer;
mod explanation;
mod listing;
mod fragment;
mod recomputation;
mod textures;
mod tolerance;
mod triangles;
mod verdict;

pub(crate) use explainer::is_background;
pub use explainer::{Explainer, PixelStep};
pub use explanation::{Explanation, around, tap};
pub use fragment::{Corner, Fragment};
pub use listing::{LineState, ListedLine};
pub use recomputation::{Filtering, Recomputation};
pub use tinta_glsl::{Base, Comparison, Event, Mistake, Precision, Sample, Texel, Type, Value, What};
pub use tolerance::LineTolerance;
pub(crate) use verdict::against_lines;
pub use verdict::{AgainstLines, Flip, INK_FROM, Verdict, flips};
