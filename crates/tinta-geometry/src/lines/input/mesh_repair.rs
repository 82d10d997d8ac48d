//! Repairs a mesh before its lines are found.
//!
//! - Of faces that [cover one another](crate::lines::input::covered_faces), as in surfaces modelled from both sides, one
//!   set stays. The others would turn every edge into one with four faces.
//! - Faces with a corner on the opposite side are removed if they touch others: they are lines.
//! - Faces are split at [T-junctions](crate::lines::input::split_t_junctions), so no line crosses a surface that
//!   looks whole. The unsplit face still hides other lines: its many slivers would hide the same, only more slowly.
//!
//! Cracks wider than `--weld` and six digits of a coordinate stay open.

use crate::disjoint_sets::DisjointSets;
use crate::edges::EdgeList;
use crate::lines::input::coplanar::{Ending, Kinds, Planar, ending_faces};
use crate::lines::input::covered_faces::covered_faces;
use crate::lines::input::face_subset::keep_faces;
use crate::lines::input::split_t_junctions::{SplitMesh, chains, split_at_junctions};
use crate::mesh::Mesh;
use crate::threads::{in_chunks, threads_for};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

pub(in crate::lines) struct RepairedMesh {
    /// The faces that hide others, without repeated ones.
    pub shape: Arc<Mesh>,
    /// The mesh whose edges become lines: its faces are split at vertices on their sides.
    pub split: Arc<Mesh>,
    /// Its edges, each with the faces that end there.
    pub edges: EdgeList,
    /// The edges along which a surface passes through a polygon that has a diagonal there, each with a face of the shape of either.
    pub crossings: Vec<(u32, [u32; 2])>,
    /// For each split face, the face of the shape that it is a part of.
    pub whole_faces: Vec<u32>,
    /// The vertices on each split edge, in order.
    pub on_edges: BTreeMap<[u32; 2], Vec<u32>>,
    /// Number of covered faces that were removed.
    pub covered: usize,
}

/// Tells which faces of a mesh hide nothing.
type IsGhost<'a> = &'a dyn Fn(&Mesh, u32) -> bool;

/// Returns the repaired mesh; `None` if it needs no repair. Ghosts and other faces do not cover one another.
pub(in crate::lines) fn repaired(
    mesh: &Arc<Mesh>,
    edges: &EdgeList,
    ghosts: Option<IsGhost<'_>>,
) -> Option<RepairedMesh> {
    let lines = faces_without_height(mesh, edges);
    let mut shape = WorkingMesh { mesh: mesh.clone(), edges: Cow::Borrowed(edges) };
    shape.leave_out(&lines);
    let covered = match ghosts {
        None => covered_faces(&shape.mesh, &shape.edges, &chains(&shape.mesh, &shape.edges)),
        Some(is_ghost) => [true, false]
            .into_iter()
            .flat_map(|are_ghosts| covered_among(&shape.mesh, |face| is_ghost(&shape.mesh, face) == are_ghosts))
            .collect(),
    };
    shape.leave_out(&covered);
    let split = split_at_junctions(&shape.mesh, &shape.edges);
    let WorkingMesh { mesh: shape, edges } = shape;
    let edges = split.as_ref().map_or(edges, |split| Cow::Owned(EdgeList::new(&split.mesh)));
    let split_mesh = split.as_ref().map_or(&*shape, |split| &split.mesh);
    let is_ghost = |face: u32| ghosts.is_some_and(|is_ghost| is_ghost(split_mesh, face));
    let whole = |face: u32| split.as_ref().map_or(face, |split| split.whole_faces[face as usize]);
    let ending = ending_faces(split_mesh, &edges, &Kinds { whole: &whole, is_ghost: &is_ghost });
    if lines.is_empty() && covered.is_empty() && split.is_none() && ending.is_empty() {
        return None;
    }
    let mut edges = edges.into_owned();
    let crossing = |ending: &Ending| Some((ending.edge, ending.crossing?.map(whole)));
    let crossings = ending.iter().filter_map(crossing).collect();
    edges.set_faces(split_mesh, ending.iter().map(|ending| (ending.edge, ending.faces.as_slice())));
    let covered = covered.len();
    Some(match split {
        Some(SplitMesh { mesh, whole_faces, on_edges }) => {
            RepairedMesh { shape, split: Arc::new(mesh), edges, crossings, whole_faces, on_edges, covered }
        }
        None => {
            let whole_faces = (0..shape.triangles.len() as u32).collect();
            RepairedMesh {
                split: shape.clone(),
                edges,
                crossings,
                shape,
                whole_faces,
                on_edges: BTreeMap::new(),
                covered,
            }
        }
    })
}

/// The covered faces among some of a mesh.
fn covered_among(mesh: &Mesh, is_of_them: impl Fn(u32) -> bool) -> Vec<u32> {
    let numbers: Vec<u32> = (0..mesh.triangles.len() as u32).filter(|face| is_of_them(*face)).collect();
    let some = keep_faces(mesh, is_of_them);
    let edges = EdgeList::new(&some);
    covered_faces(&some, &edges, &chains(&some, &edges)).into_iter().map(|face| numbers[face as usize]).collect()
}

/// A mesh with some of its faces removed, and its edges.
struct WorkingMesh<'a> {
    mesh: Arc<Mesh>,
    edges: Cow<'a, EdgeList>,
}

impl WorkingMesh<'_> {
    fn leave_out(&mut self, faces: &HashSet<u32>) {
        if !faces.is_empty() {
            self.mesh = Arc::new(keep_faces(&self.mesh, |face| !faces.contains(&face)));
            self.edges = Cow::Owned(EdgeList::new(&self.mesh));
        }
    }
}

/// Faces with their third corner on the opposite side that share a side or a polygon with a face that has a height, or with
/// another such face. Others are wires and are drawn.
fn faces_without_height(mesh: &Mesh, edges: &EdgeList) -> HashSet<u32> {
    let planar = Planar::new(mesh);
    let has_height = |face: u32| {
        let [a, b, c] = planar.corners(face);
        let mut sides = [a.distance(b), b.distance(c), c.distance(a)];
        sides.sort_unstable_by(f64::total_cmp);
        !planar.is_on_line(planar.normal(face).length() / sides[2].max(f64::MIN_POSITIVE), sides[0])
    };
    let found = in_chunks(mesh.triangles.len(), FACES_A_THREAD, threads_for(mesh.triangles.len()), |faces| {
        faces.map(|face| face as u32).filter(|face| !has_height(*face)).collect::<Vec<u32>>()
    });
    let found = found.concat();
    if found.is_empty() {
        return HashSet::new();
    }
    // All faces with a height are one.
    let with_height = found.len() as u32;
    let number = |face: u32| found.binary_search(&face).map_or(with_height, |at| at as u32);
    let mut sets = DisjointSets::new(found.len() + 1);
    for edge in 0..edges.len() as u32 {
        edges.faces(edge).windows(2).for_each(|pair| sets.join([number(pair[0]), number(pair[1])]));
    }
    for face in 1..mesh.triangles.len() as u32 {
        if mesh.file_face(face - 1) == mesh.file_face(face) {
            sets.join([number(face - 1), number(face)]);
        }
    }
    let surface = sets.root(with_height);
    found.iter().copied().filter(|face| sets.root(number(*face)) == surface).collect()
}

/// Faces per batch of a thread.
const FACES_A_THREAD: usize = 8192;
