//! Models, read from files or built in: all of [`tinta_geometry::mesh`], and the models that need no file.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::{LoadOptions, load};
//!
//! let loaded = load("builtin:gear", &LoadOptions::default())?;
//! assert_eq!(loaded.mesh.triangles.len(), 1880);
//! assert!(loaded.remarks.is_empty(), "nothing is wrong with it");
//! # Ok(())
//! # }
//! ```

pub use crate::builtin::{BUILTINS, Builtin, NamedBuiltin, builtin, load, load_watched};
pub use tinta_geometry::mesh::*;
