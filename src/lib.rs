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
//! but for what calls libassimp (cargo feature `assimp`) and a look at standard output before `main` (cargo feature `cli`).
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

// Floors, from the ground up: a module uses those above it in this list and none below (`tests/floors.rs`).

// What everything stands on.
pub mod limits;
pub mod tolerances;
pub mod error;
mod bytes;
mod clock;
mod choice;
mod files;
mod markup;
mod random;
mod threads;
pub mod output;
mod values;
pub mod settings;

// Geometry, without GL: from a file to the lines that are seen.
pub mod picture;
pub mod camera;
pub mod mesh;
pub mod edges;
mod bvh;
pub mod hiding;
pub mod scene;
pub mod lines;

// What to draw, as data.
pub mod glsl;
pub mod plan;
pub mod textures;
pub mod styles;

// Drawing it.
pub mod gl;
pub mod renderer;
pub mod animation;

// How a picture is asked for again.
pub mod preset;
pub mod shell;
pub mod recipe;
pub mod compare;
pub mod record;

// What it is worth.
#[cfg(feature = "measuring")]
pub mod contact_sheet;
#[cfg(feature = "measuring")]
pub mod measure;
#[cfg(feature = "measuring")]
pub mod report;
#[cfg(feature = "measuring")]
pub mod figures;
#[cfg(feature = "measuring")]
pub mod stress;

// Many at once, by hand, and by the command line, which speaks of the library as any program does.
#[cfg(feature = "cli")]
pub mod batch;
#[cfg(feature = "window")]
pub mod window;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "cli")]
extern crate self as tinta;

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
