//! tinta: historical non-photorealistic pipelines as their authors published them, on OpenGL 2.1: the cartoon of
//! Evangelista et al. 2005, ink and paint of Dachsbacher, charcoal of Valente 2007; and their error against their run time.
//!
//! Data flows one way, and every arrow is a plain value:
//!
//! ```text
//! model file ─► Mesh ─► EdgeList ─► Scene ─┬─► Style::plan ─► Plan ─► Renderer (gl::execute) ─► Picture ─┐
//!                                          └─► VisibleLines (exact, f64) ─► SVG, reference ──────────────┴─► Row ─► report
//! ```
//!
//! Styles know no GL and `gl` knows no style; only a [`plan::Plan`] lies between them. All `unsafe` code is in [`gl`],
//! but for what calls libassimp (cargo feature `assimp`).
//! Everything else is tested without a context, a window or a clock.
//!
//! ```no_run
//! use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Style, StyleName, load};
//!
//! # fn main() -> tinta::Result<()> {
//! let bust = load("builtin:bust", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([bust], &SceneSettings::default())?;
//! let style = Style::named(StyleName::ThreePass);
//! Renderer::new(Backend::Auto)?.render(&scene, &style)?.save("bust.png")
//! # }
//! ```

pub mod animation;
pub mod batch;
pub mod camera;
pub mod compare;
pub mod edges;
pub mod error;
pub mod figures;
pub mod gl;
pub mod glsl;
pub mod hiding;
pub mod limits;
pub mod lines;
pub mod measure;
pub mod mesh;
pub mod output;
pub mod picture;
pub mod plan;
pub mod preset;
pub mod recipe;
pub mod record;
pub mod renderer;
pub mod report;
pub mod scene;
pub mod settings;
pub mod sheet;
pub mod shell;
pub mod stress;
pub mod styles;
pub mod textures;
pub mod tolerances;
#[cfg(feature = "window")]
pub mod window;

mod bytes;
mod files;
mod markup;
mod names;
mod random;
mod threads;

pub use animation::{AnimationTarget, AnimationWriter};
pub use camera::{Camera, CameraSettings, View};
pub use edges::EdgeList;
pub use error::{Error, ParseError, Result};
pub use gl::Backend;
/// The vectors and matrices that the public types are made of.
pub use glam;
pub use lines::{LineSettings, SvgSettings, VisibleLines};
pub use mesh::{LoadOptions, Mesh, load};
pub use output::TextTarget;
pub use picture::{Picture, Target};
pub use preset::Preset;
pub use recipe::Recipe;
pub use renderer::Renderer;
pub use scene::{Background, Color, Scene, SceneSettings, Size};
pub use styles::{Show, Style, StyleName};
