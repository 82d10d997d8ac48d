//! The edges of a mesh, each once, with the faces at each.

/// Each edge of a mesh once, with its faces.
///
/// Edges are numbered by their lower position, and those of one position by first appearance in the faces' order: the same
/// mesh gives the same numbers whatever the number of threads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EdgeList {
    pub(super) positions: Vec<[u32; 2]>,
    /// The two faces of an inner edge, the lower number first; one face twice where there are not exactly two.
    pub(super) faces: Vec<[u32; 2]>,
    pub(super) incidence: Vec<Incidence>,
    /// The faces of each non-manifold edge, by its number, ascending.
    pub(super) non_manifold: Vec<(u32, Vec<u32>)>,
    pub(super) degenerate_faces: usize,
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
