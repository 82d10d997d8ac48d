//! The edge list of a mesh: each edge once with its faces, and from it the lines worth drawing.
//!
//! In: a [`Mesh`]. Out: [`EdgeList`] (which edges there are), [`Classes`] (which are boundary, crease, non-manifold or a
//! seam, whatever the view) and [`Silhouettes`] (which separate front from back faces, for an [`Eye`]). Dachsbacher,
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

mod build;
mod classes;
mod cracks;
mod lasting;
mod mesh_edges;
mod orientation;
mod outside;
mod silhouette;
mod smooth;

pub(crate) use lasting::lasting_creases;

pub use classes::{Class, ClassCounts, ClassSet, Classes, CreaseAngle};
pub use cracks::cracks;
pub use mesh_edges::MeshEdges;
pub use orientation::{Eye, Side, side_of_face};
pub use silhouette::{SilhouetteRule, Silhouettes};
pub use smooth::{Shell, SmoothSurface};

use crate::mesh::Mesh;
use crate::threads::threads_for;

/// Each edge of a mesh once, with its faces.
///
/// Edges are numbered by their lower position, and those of one position by first appearance in the faces' order: the same
/// mesh gives the same numbers whatever the number of threads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EdgeList {
    positions: Vec<[u32; 2]>,
    /// The two faces of an inner edge, the lower number first; one face twice where there are not exactly two.
    faces: Vec<[u32; 2]>,
    incidence: Vec<Incidence>,
    /// The faces of each non-manifold edge, by its number, ascending.
    non_manifold: Vec<(u32, Vec<u32>)>,
    degenerate_faces: usize,
}

/// How an edge's faces lie to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Incidence {
    /// One face.
    Boundary,
    /// Two faces that run along it in opposite directions, as neighbours of one orientation do.
    Inner,
    /// Two faces that run along it in the same direction: one is turned inside out against the other.
    InnerReversed,
    /// Three faces or more.
    NonManifold,
}

impl EdgeList {
    /// Builds the list in time linear in the faces, on as many threads as the machine has and the mesh is worth.
    pub fn new(mesh: &Mesh) -> Self {
        Self::with_threads(mesh, threads_for(mesh.triangles.len()))
    }

    /// As [`EdgeList::new`] with a number of threads, at least 1; the result is the same for all of them.
    ///
    /// Faces that name a position twice or one that does not exist have no edges; [`EdgeList::degenerate_faces`] counts
    /// them.
    pub fn with_threads(mesh: &Mesh, threads: usize) -> Self {
        build::edge_list(&mesh.triangles, mesh.positions.len() as u32, threads.max(1))
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no edge.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Each edge's two positions in the mesh, the lower number first.
    pub fn positions(&self) -> &[[u32; 2]] {
        &self.positions
    }

    /// How each edge's faces lie to it.
    pub fn incidence(&self) -> &[Incidence] {
        &self.incidence
    }

    /// An edge's faces, ascending; empty for an edge there is not.
    pub fn faces(&self, edge: u32) -> &[u32] {
        match self.incidence.get(edge as usize) {
            None => &[],
            Some(Incidence::Boundary) => &self.faces[edge as usize][..1],
            Some(Incidence::Inner | Incidence::InnerReversed) => &self.faces[edge as usize],
            Some(Incidence::NonManifold) => {
                let found = self.non_manifold.binary_search_by_key(&edge, |(edge, _)| *edge);
                found.map_or(&[], |index| &self.non_manifold[index].1)
            }
        }
    }

    /// Inner edges whose two faces are wound against each other: none on a surface of one orientation.
    pub fn reversed_edges(&self) -> usize {
        self.incidence.iter().filter(|incidence| **incidence == Incidence::InnerReversed).count()
    }

    /// Faces without edges: they name a position twice, or one that does not exist.
    pub fn degenerate_faces(&self) -> usize {
        self.degenerate_faces
    }
}
