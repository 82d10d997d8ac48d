//! The part of tinta that needs no OpenGL: reads model files into meshes, builds their edges, and computes the exact visible
//! lines of a scene, as SVG.
//!
//! ```text
//! model file ─► Mesh ─► EdgeList ─► Scene ─► VisibleLines (exact, f64) ─► SVG
//! ```
//!
//! The settings of everything are declared here as well, each once, beside the struct it sets: see [`settings`].
//!
//! ```
//! use tinta_geometry::{LineSettings, LoadOptions, Scene, SceneSettings, DrawingSettings, VisibleLines, lines, load};
//!
//! # fn main() -> tinta_geometry::Result<()> {
//! let gear = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([gear], &SceneSettings::default())?;
//! let visible = VisibleLines::of(&scene, &LineSettings::default())?;
//! let svg = lines::svg(&visible, &DrawingSettings::default())?;
//! assert!(svg.starts_with("<?xml") && svg.contains("<path"));
//! # Ok(())
//! # }
//! ```

#![deny(unreachable_pub)]

// Floors, from the ground up: a module uses those above it in this list and none below (`tests/floors.rs`).
// What is hidden from the documentation is shared with tinta, and may change without a word.

// What everything stands on.
pub mod limits;
pub mod tolerances;
pub mod error;
#[doc(hidden)]
pub mod bytes;
#[doc(hidden)]
pub mod clock;
#[doc(hidden)]
pub mod choice;
#[doc(hidden)]
pub mod files;
mod memory;
mod disjoint_sets;
#[doc(hidden)]
pub mod markup;
#[doc(hidden)]
pub mod threads;
#[doc(hidden)]
pub mod values;
pub mod settings;

// From a file to the lines that are seen.
pub mod camera;
pub mod mesh;
pub mod edges;
pub mod curvature;
mod bvh;
pub mod culling;
pub mod doubled;
pub mod scene;
pub mod lines;

pub use camera::{Camera, CameraSettings, View};
pub use edges::EdgeList;
pub use error::{Error, FileKind, ParseError, Result};
/// The vectors and matrices that the public types are made of.
pub use glam;
pub use lines::{DrawingSettings, LineSettings, VisibleLines};
pub use mesh::{LoadOptions, Mesh, load};
pub use scene::{Background, Color, Scene, SceneSettings, Size};
