//! The part of tinta that needs no OpenGL: reads model files into meshes, builds their edges, computes a scene's exact visible
//! lines and writes them as SVG.
//!
//! ```text
//! model file ─► Mesh ─► EdgeList ─► Scene ─► VisibleLines (exact, f64) ─► SVG
//! ```
//!
//! This crate also declares every setting, once, beside its struct: see [`settings`].
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

// Floors, from the ground up: a module uses those above it in this list and none below (`tests/documents/floors.rs`). Items hidden from
// the documentation are shared with tinta and may change without notice.

// The foundation.
#[doc(hidden)]
pub mod limits;
#[doc(hidden)]
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
mod ranges;
mod thresholds;
#[doc(hidden)]
pub mod markup;
#[doc(hidden)]
pub mod threads;
#[doc(hidden)]
pub mod values;
pub mod settings;
mod bvh;

// From a file to visible lines.
pub mod camera;
pub mod mesh;
pub mod edges;
#[doc(hidden)]
pub mod curvature;
#[doc(hidden)]
pub mod culling;
pub mod scene;
#[doc(hidden)]
pub mod hidden_faces;
pub mod lines;

pub use camera::{Camera, CameraSettings, View};
pub use edges::EdgeList;
pub use error::{Error, FileKind, ParseError, Result};
/// The vectors and matrices of the public types.
pub use glam;
pub use lines::{DrawingSettings, LineSettings, VisibleLines};
pub use mesh::{LoadOptions, Mesh, load};
pub use scene::{Background, Color, Scene, SceneSettings, Size};
