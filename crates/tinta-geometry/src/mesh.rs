//! A model as triangles over welded positions, with its normals, texture coordinates and materials.
//!
//! In: a file's polygons (`Soup`, one reader per format). Out: [`Mesh`], shared by all later steps: the edge list needs the
//! welded positions, GL the corners' normals, the reference lines the f64 coordinates. Positions stay in f64 and in the file's
//! own units; the scene recentres and scales them for GL.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::{LoadOptions, load};
//!
//! let loaded = load("../../models/gear.obj", &LoadOptions::default())?;
//! assert_eq!(loaded.mesh.triangles.len(), 1880);
//! assert!(loaded.remarks.is_empty(), "nothing is wrong with it");
//! # Ok(())
//! # }
//! ```

mod build;
mod coincident;
mod curves;
mod curves_of_soup;
pub(crate) mod defects;
mod folder;
mod format;
mod frame;
mod left_out;
#[cfg(feature = "gltf")]
mod gltf;
mod hilbert;
pub mod load;
mod up_axis_guess;
mod md2;
mod normals;
mod number;
mod obj;
mod options;
pub(crate) mod outside;
mod other_diagonals;
mod pattern;
mod pieces;
mod ply;
mod same_polygons;
mod section;
mod shells;
mod sides;
mod skin;
mod soup;
mod stl;
mod take_normals;
mod text;
mod three_ds;
#[cfg(feature = "3mf")]
mod three_mf;
mod triangle_mesh;
mod triangulate;
mod vertices;
mod weld;

pub use curves::Curves;
pub use defects::Defects;
pub use format::{Format, is_model_name};
pub use frame::ModelFrame;
#[cfg(feature = "gltf")]
pub use gltf::camera as gltf_camera;
pub use load::{LoadedModel, load, load_watched, read_as, read_bytes, refuse_address};
pub use options::{LoadOptions, LoadStage, Normals, UpAxis};
pub use pattern::Pattern;
pub(crate) use pattern::PatternMatches;
pub(crate) use section::double_area;
pub use section::{Cut, SECTION, SectionPlane, SectionPlanes};
pub(crate) use shells::Shells;
pub use triangle_mesh::{EmbeddedPicture, Material, Mesh, NONE, NamedPart, TextureAlpha, bounds};
pub(crate) use triangle_mesh::{face_normals, triangle_normal};
pub(crate) use up_axis_guess::hull;
pub use vertices::{Part, VertexArrays};
pub(crate) use weld::weld;
