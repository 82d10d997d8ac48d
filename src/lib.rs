//! Draws 3D models as cartoons, ink, charcoal and exact line art, the way texts of 2001 to 2007 published it, on OpenGL 2.1.
//!
//! The published programs run as printed: the cartoon of Evangelista et al. 2005, ink and paint of Dachsbacher, charcoal of
//! Valente 2007. The crate adds corrected versions, exact visible lines without OpenGL, and the error of every style against its
//! run time.
//!
//! # A picture
//!
//! Load a model, put it into a scene, choose a style, and draw. No display is needed:
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
//!
//! # Exact lines
//!
//! The visible lines of a scene, computed in f64 without OpenGL, as SVG. The crate [`tinta_geometry`] has this part alone:
//!
//! ```
//! use tinta::{LineSettings, LoadOptions, Scene, SceneSettings, DrawingSettings, VisibleLines, lines, load};
//!
//! # fn main() -> tinta::Result<()> {
//! let gear = load("builtin:gear", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([gear], &SceneSettings::default())?;
//! let visible = VisibleLines::of(&scene, &LineSettings::default())?;
//! let svg = lines::svg(&visible, &DrawingSettings::default())?;
//! assert!(svg.contains("<path"));
//! # Ok(())
//! # }
//! ```
//!
//! # Settings
//!
//! Styles, scenes, reading, lines and SVG are structs with defaults: set a field, or read options by the names that the command
//! line and presets use.
//!
//! ```
//! use tinta::settings::{HasSettings, OptionValue, Options};
//! use tinta::{SceneSettings, Style};
//!
//! # fn main() -> tinta::Result<()> {
//! let options: Options = [("style", "inking"), ("line-width", "3")]
//!     .map(|(name, value)| (name.to_owned(), OptionValue::text(value)))
//!     .into();
//! let style = Style::from_options(&options)?;
//! assert_eq!(style.to_options()?, options);
//!
//! let mut scene = SceneSettings { copies: 4, ..SceneSettings::default() };
//! scene.camera.fov_y_degrees = 30.0;
//! # Ok(())
//! # }
//! ```
//!
//! # Where to look
//!
//! | for | see |
//! |---|---|
//! | reading models, or making one from triangles | [`mesh`], [`load()`], [`Mesh::of_triangles`] |
//! | cameras and sizes | [`camera`], [`SceneSettings`], [`View`] |
//! | edges by class, silhouettes | [`edges`], [`EdgeList`] |
//! | exact lines, SVG, hidden lines | [`lines`], [`VisibleLines`] |
//! | styles and their buffers | [`styles`], [`Style`], [`Show`] |
//! | a style of your own | [`plan`], and `examples/own_style.rs` |
//! | contexts, drawing, timing | [`Backend`], [`renderer`], [`Renderer`] |
//! | pictures and animations | [`picture`], [`animation`] |
//! | one drawing from layers of options, as every door asks for it | [`request`] |
//! | presets, and pictures that can be made again | [`preset`], [`recipe`] |
//!
//! # What is stable
//!
//! What these pages show follows semantic versioning: structs of settings may gain fields and enums variants in a minor version, so
//! end literals with `..Default::default()`, and matches with `_`. Everything else that is public is shared by tinta's own packages
//! and may change at any time.
//!
//! # How it is built
//!
//! Data flows one way, and every arrow is a plain value:
//!
//! ```text
//! model file ─► Mesh ─► EdgeList ─► Scene ─┬─► Style::plan ─► Plan ─► Renderer (gl::execute) ─► Picture ─┐
//!                                          └─► VisibleLines (exact, f64) ─► SVG, reference ──────────────┴─► Row ─► report
//! ```
//!
//! Styles know no GL and `gl` knows no style; only a [`plan::Plan`] lies between them. All `unsafe` code is in `gl`, except a
//! check of standard output before `main` (cargo feature `cli`). Everything else is tested without a context, a window or a
//! clock.
//!
//! # Cargo features
//!
//! The default ones, `cli` and `window`, bring the program, and 176 crates instead of 71 (`cargo tree -e normal --no-dedupe`). For the
//! library alone turn them off with `default-features = false`, and choose:
//!
//! | feature | what it brings |
//! |---|---|
//! | `3mf` | 3MF models |
//! | `gltf` | glTF models, JPEG pictures |
//! | `pdf` | drawings as PDF |
//! | `cli` | the command line and its batches; brings `3mf`, `gltf` and `pdf` |
//! | `window` | the window; brings `3mf` and `gltf` |
//!
//! `examples/embedding/` is a program that uses tinta in this way.
//! Error against run time is measured by the package `tinta-lab`, which lies above this one.

#![deny(unreachable_pub)]

// Floors, from the ground up: a module uses only those above it in this list (`tests/documents/floors.rs`).

// Geometry without GL: from a file to visible lines. A separate crate with its own list of floors.
use tinta_geometry::{bytes, clock, files, markup, threads, values};
#[doc(no_inline)]
pub use tinta_geometry::{camera, edges, error, lines, scene, settings};
#[doc(hidden)]
pub use tinta_geometry::{choice, culling, hidden_faces, limits, tolerances};

#[doc(hidden)]
pub mod random;
#[doc(hidden)]
pub mod output;
mod builtin;
pub mod mesh;
pub mod picture;

// What to draw, as data.
#[doc(hidden)]
pub mod glsl;
pub mod plan;
#[doc(hidden)]
pub mod textures;
pub mod styles;

// Drawing it.
#[doc(hidden)]
pub mod gl;
pub mod renderer;
#[doc(hidden)]
pub mod pixel;
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
#[doc(hidden)]
pub mod drivers;
#[doc(hidden)]
pub mod orbit;
#[doc(hidden)]
pub mod keys;
pub mod animation;

// Presets, which reproduce the settings of a picture.
pub mod preset;
#[doc(hidden)]
pub mod shell;
pub mod recipe;
#[doc(hidden)]
pub mod record;
pub mod request;

// What pages of HTML begin with.
#[doc(hidden)]
pub mod page;

// Many at once, by hand, and by the command line, which speaks of the library as any program does.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod batch;
#[cfg(feature = "window")]
#[doc(hidden)]
pub mod window;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "cli")]
extern crate self as tinta;

pub use animation::{AnimationTarget, AnimationWriter};
pub use camera::{Camera, CameraSettings, View};
pub use edges::EdgeList;
pub use error::{Error, FileKind, ParseError, Result};
pub use gl::Backend;
/// The vectors and matrices that the public types are made of.
pub use glam;
pub use lines::{DrawingSettings, LineSettings, VisibleLines};
pub use mesh::{LoadOptions, Mesh, load};
pub use output::TextTarget;
pub use picture::{Picture, Target};
pub use preset::Preset;
pub use recipe::Recipe;
pub use renderer::Renderer;
pub use request::Request;
pub use scene::{Background, Color, Scene, SceneSettings, Size};
pub use styles::{Show, Style, StyleName};
