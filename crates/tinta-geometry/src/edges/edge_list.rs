//! The edges of a mesh, each once, with the faces at each.

use crate::mesh::Mesh;
use std::collections::HashMap;

/// Each edge of a mesh once, with its faces.
///
/// Edges are numbered by their lower position, then by first appearance in the faces' order. The number of threads does not
/// affect the numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EdgeList {
    pub(super) positions: Vec<[u32; 2]>,
    /// The two faces of an inner edge, the lower number first; one face twice for any other number of faces.
    pub(super) faces: Vec<[u32; 2]>,
    pub(super) incidence: Vec<Incidence>,
    /// The faces of each non-manifold edge, by its number, ascending.
    pub(super) non_manifold: Vec<(u32, Vec<u32>)>,
    pub(super) degenerate_faces: usize,
}

/// How an edge's faces are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Incidence {
    /// One face.
    Boundary,
    /// Two faces that run along it in opposite directions, as consistently oriented neighbours do.
    Inner,
    /// Two faces that run along it in the same direction: one is reversed against the other.
    InnerReversed,
    /// Three faces or more.
    NonManifold,
}

impl EdgeList {
    /// Number of edges.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether the list is empty.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Each edge's two positions in the mesh, the lower number first.
    pub fn positions(&self) -> &[[u32; 2]] {
        &self.positions
    }

    /// How each edge's faces are arranged.
    pub fn incidence(&self) -> &[Incidence] {
        &self.incidence
    }

    /// Returns an edge's faces, ascending; empty for an unknown edge.
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

    /// Returns the number of inner edges whose faces are wound against each other: 0 on a consistently oriented surface.
    pub fn reversed_edges(&self) -> usize {
        self.incidence.iter().filter(|incidence| **incidence == Incidence::InnerReversed).count()
    }

    /// Returns the number of faces without edges, which repeat a position or name one that does not exist.
    pub fn degenerate_faces(&self) -> usize {
        self.degenerate_faces
    }

    /// The edges with three faces or more, each with its faces; ascending.
    pub(crate) fn non_manifold(&self) -> impl Iterator<Item = (u32, &[u32])> {
        self.non_manifold.iter().map(|(edge, faces)| (*edge, faces.as_slice()))
    }

    /// Replaces the faces of some edges with three faces or more by one or more of them.
    pub(crate) fn set_faces<'a>(&mut self, mesh: &Mesh, changed: impl Iterator<Item = (u32, &'a [u32])>) {
        let mut crowded = HashMap::new();
        for (edge, faces) in changed {
            let [low, high] = self.positions[edge as usize];
            let runs_up = |face: u32| {
                let [a, b, c] = mesh.triangles[face as usize];
                [[a, b], [b, c], [c, a]].contains(&[low, high])
            };
            let (of_edge, incidence) = match *faces {
                [first] => ([first; 2], Incidence::Boundary),
                [first, second] if runs_up(first) == runs_up(second) => ([first, second], Incidence::InnerReversed),
                [first, second] => ([first, second], Incidence::Inner),
                _ => {
                    crowded.insert(edge, faces);
                    continue;
                }
            };
            self.faces[edge as usize] = of_edge;
            self.incidence[edge as usize] = incidence;
        }
        self.non_manifold.retain(|(edge, _)| self.incidence[*edge as usize] == Incidence::NonManifold);
        for (edge, faces) in &mut self.non_manifold {
            if let Some(fewer) = crowded.get(edge) {
                *faces = fewer.to_vec();
            }
        }
    }
}
