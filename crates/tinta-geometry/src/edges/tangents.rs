//! Tangent edges: where two different surfaces meet without a crease, such as a plane and a rounding.
//!
//! In: a [`Mesh`], its [`EdgeList`], the faces' normals. Out: the edges, ascending. A patch's border between creases is drawn whole or not
//! at all, so that a rounding of changing radius is not drawn where a cylinder happens to fit.

use super::EdgeList;
use super::fitted_surfaces::{FLAT, Kind};
use super::patches::{Patch, Patches};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, NONE};

/// Largest angle between two surfaces that meet smoothly, as a share of the turn between the edge's faces.
const SMOOTH: f64 = 0.1;

/// The least difference of two surfaces' curvatures, as a share of the sum of their curvatures.
const DIFFERENT: f64 = 0.25;

/// Least share of tangent edges in a border.
const WHOLE: f64 = 0.75;

/// A smooth edge between a patch and its neighbour.
struct Border {
    patch: u32,
    edge: u32,
    is_tangent: bool,
}

/// The tangent edges of a mesh, ascending.
pub(super) fn tangents(mesh: &Mesh, edges: &EdgeList, normals: &[[f64; 3]], smooth: f64, threads: usize) -> Vec<u32> {
    let patches = Patches::new(mesh, edges, normals, smooth, threads);
    let mut borders = Vec::new();
    for edge in 0..edges.len() as u32 {
        let Some((turn, faces)) = patches.smooth(edge) else { continue };
        let sides = faces.map(|face| patches.of_faces[face as usize]);
        if sides[0] != sides[1] {
            let is_tangent = !sides.contains(&NONE) && is_tangent(&patches, edge, turn, faces);
            let known = sides.into_iter().filter(|patch| *patch != NONE);
            borders.extend(known.map(|patch| Border { patch, edge, is_tangent }));
        }
    }
    let mut ends: Vec<([u32; 2], u32)> = Vec::new();
    for (at, border) in borders.iter().enumerate() {
        ends.extend(edges.positions[border.edge as usize].map(|end| ([border.patch, end], at as u32)));
    }
    ends.sort_unstable();
    let mut joined = DisjointSets::new(borders.len());
    let meeting = ends.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    meeting.for_each(|pair| joined.join([pair[0].1, pair[1].1]));
    let mut lengths = vec![[0.0; 2]; borders.len()];
    for (at, border) in borders.iter().enumerate() {
        let [from, to] = patches.ends_of(border.edge);
        lengths[joined.root(at as u32) as usize][usize::from(border.is_tangent)] += from.distance(to);
    }
    let mut is_whole = |at: usize| {
        let [others, tangents] = lengths[joined.root(at as u32) as usize];
        tangents >= WHOLE * (others + tangents)
    };
    // Both of a tangent edge's patches have it, one after the other.
    let both = (1..borders.len()).filter(|at| borders[*at].is_tangent && borders[at - 1].edge == borders[*at].edge);
    both.filter(|at| is_whole(at - 1) && is_whole(*at)).map(|at| borders[at].edge).collect()
}

/// Whether the surfaces of an edge's two faces are smooth there, and not the same.
fn is_tangent(patches: &Patches<'_>, edge: u32, turn: f64, faces: [u32; 2]) -> bool {
    let [first, second] = faces.map(|face| &patches.all[patches.of_faces[face as usize] as usize]);
    let [from, to] = patches.ends_of(edge);
    let is_smooth = [from, to].into_iter().all(|end| {
        let [one, other] = [first, second].map(|patch| patch.surface.at(end).1);
        one.cross(other).length() <= SMOOTH * turn.max(FLAT)
    });
    // Whether a corner beyond the edge lies off the surface of the edge's other face.
    let differs = |(face, patch): (u32, &Patch)| {
        patches.corners(face).into_iter().filter(|corner| *corner != from && *corner != to).any(|corner| {
            let height = (corner - from).cross(to - from).length() / from.distance(to);
            patch.surface.at(corner).0.abs() > DIFFERENT * turn * height
        })
    };
    let are_planes = [first, second].iter().all(|patch| patch.surface.kind == Kind::Plane);
    is_smooth && !are_planes && [(faces[0], second), (faces[1], first)].into_iter().any(differs)
}
