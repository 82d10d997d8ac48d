//! The edge list of a mesh: each edge once with its faces, and from it the lines worth drawing.
//!
//! In: a [`Mesh`]. Out: [`EdgeList`] (which edges there are), [`Classes`] (which are boundary, crease, non-manifold or a
//! seam, whatever the view) and [`Silhouettes`] (which separate front from back faces, for an [`Eye`]). Dachsbacher,
//! *Beethoven aus Bits und Bytes*, section "Inking"; errata D1 to D5 and D10.

mod build;
mod classes;
mod cones;
mod mesh_edges;
mod orientation;
mod silhouette;

pub use classes::{Class, ClassCounts, ClassSet, Classes, CreaseAngle};
pub use cones::NormalCones;
pub use mesh_edges::MeshEdges;
pub use orientation::{Eye, Side, side_of_face};
pub use silhouette::{SilhouetteRule, Silhouettes};

use crate::mesh::Mesh;
use std::sync::{Mutex, PoisonError};

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

/// Faces below which a second thread costs more than it brings.
const FACES_WORTH_A_THREAD: usize = 100_000;

/// How many threads work on so many faces is worth.
fn threads_for(faces: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    cores.min(faces / FACES_WORTH_A_THREAD).max(1)
}

/// Cuts `0..count` into at most `pieces` ranges of nearly one length.
fn ranges(count: usize, pieces: usize) -> Vec<std::ops::Range<usize>> {
    let length = count.div_ceil(pieces.max(1)).max(1);
    (0..count).step_by(length).map(|start| start..(start + length).min(count)).collect()
}

/// Puts `value` of each number into a list, each thread its own piece of it in place.
///
/// `blank` is what zeroed memory means: the system then hands out the list's pages where they are first written.
fn filled<T: Copy + Send>(count: usize, threads: usize, blank: T, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut list = vec![blank; count];
    let length = count.div_ceil(threads.max(1)).max(1);
    let pieces = Mutex::new(list.chunks_mut(length).enumerate());
    // Every thread takes pieces while there are any, this one too: where no other can be had, it does them all.
    let fill = || {
        let next = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
        while let Some((piece, places)) = next() {
            places.iter_mut().enumerate().for_each(|(index, place)| *place = value(piece * length + index));
        }
    };
    std::thread::scope(|scope| {
        let others: Vec<_> =
            (1..threads).map_while(|_| std::thread::Builder::new().spawn_scoped(scope, fill).ok()).collect();
        fill();
        for other in others {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
    list
}

/// Does `work` for each piece of `0..count`, one thread each, and returns the results in order.
fn in_parallel<T: Send>(count: usize, threads: usize, work: impl Fn(std::ops::Range<usize>) -> T + Sync) -> Vec<T> {
    let mut pieces = ranges(count, threads);
    let Some(last) = pieces.pop() else { return Vec::new() };
    let work = &work;
    std::thread::scope(|scope| {
        let others: Vec<_> = pieces
            .into_iter()
            .map(|piece| {
                let started = std::thread::Builder::new().spawn_scoped(scope, {
                    let piece = piece.clone();
                    move || work(piece)
                });
                // Where no thread can be had, this one does it all.
                started.map_err(|_| piece)
            })
            .collect();
        let last = work(last);
        let join = |started: Result<std::thread::ScopedJoinHandle<'_, T>, _>| match started {
            Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(piece) => work(piece),
        };
        others.into_iter().map(join).chain([last]).collect()
    })
}
