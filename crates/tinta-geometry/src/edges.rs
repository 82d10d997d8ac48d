//! The edge list of a mesh: each edge once with its faces, and from it the lines worth drawing.
//!
//! In: a [`Mesh`](crate::mesh::Mesh). Out: [`EdgeList`] (the edges), [`Classes`] (the boundary, crease, non-manifold and seam
//! edges, independent of the view) and [`Silhouettes`] (the edges between front and back faces, for an [`Eye`]). Dachsbacher,
//! *Beethoven aus Bits und Bytes*, section "Inking"; errata D1 to D5 and D10.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::edges::{ClassSet, Classes, CreaseAngle};
//! use tinta_geometry::{EdgeList, LoadOptions, load};
//!
//! let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
//! let edges = EdgeList::new(&mesh);
//! let counts = Classes::new(&mesh, &edges, CreaseAngle::default(), ClassSet::EDGES).counts();
//! assert_eq!((counts.boundary, counts.crease), (4, 8));
//! # Ok(())
//! # }
//! ```

mod axes;
mod build;
mod classes;
mod cracks;
mod edge_list;
mod fitted_surfaces;
mod flat_faces;
mod lasting_creases;
mod mesh_edges;
mod orientation;
mod patches;
mod silhouette;
mod smooth;
mod tangents;
mod usual_angles;

pub(crate) use axes::Axis;
pub(crate) use lasting_creases::{LastingCreases, pair};

pub use classes::{Class, ClassCounts, ClassSet, Classes, CreaseAngle};
pub use cracks::cracks;
pub use edge_list::{EdgeList, Incidence};
pub use mesh_edges::MeshEdges;
pub use orientation::{Eye, Side, side_of_face};
pub use silhouette::{SilhouetteRule, Silhouettes};
pub use smooth::Shell;
pub(crate) use smooth::SmoothSurface;
