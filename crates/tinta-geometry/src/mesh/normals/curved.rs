//! Finds the facets that approximate a surface with double curvature, as a figure's do, rather than a machine part's flat
//! faces.
//!
//! In: a surface's triangles and edges. Out: the answer for each triangle, the same throughout a patch: all faces connected
//! over edges below the smoothing angle. A surface has double curvature at a vertex if the angles around it do not add up to a
//! full turn (its Gaussian curvature); on a plane, a cylinder or a cone they do. A patch is curved if most of its area lies at
//! such vertices.

use super::incidence::Incidence;
use crate::disjoint_sets::DisjointSets;
use crate::threads::{filled, in_parallel, threads_for};
use glam::DVec3;
use std::f64::consts::TAU;
use std::ops::Range;

/// Least double curvature, as a share of the square of all turns of the edges around a vertex: on a sphere the share is about
/// 0.1, on a cylinder only the rounding of a file's digits.
const BENDS: f64 = 0.01;

/// A surface's triangles with their unit normals, areas, and angles at their corners.
pub(super) struct Faces<'a> {
    pub triangles: &'a [[u32; 3]],
    pub normals: &'a [DVec3],
    pub areas: &'a [f64],
    pub angles: &'a [f64],
}

/// An edge of two faces.
pub(super) struct Edge {
    pub ends: [u32; 2],
    pub faces: [u32; 2],
}

/// Returns for each triangle whether it lies in a curved patch; `edges` are those of two triangles, each once, in several lists.
pub(super) fn curved(faces: &Faces<'_>, edges: &[Vec<Edge>], incidence: &Incidence, cos_smooth: f64) -> Vec<bool> {
    let (count, vertices) = (faces.triangles.len(), incidence.vertices());
    let turn = |edge: &Edge| {
        let [normal, other] = edge.faces.map(|face| faces.normals[face as usize]);
        let cosine = normal.dot(other);
        (cosine >= cos_smooth).then(|| normal.cross(other).length().atan2(cosine))
    };
    let turns_of = |lists: Range<usize>| edges[lists].iter().flatten().map(turn).collect::<Vec<Option<f64>>>();
    let found = in_parallel(edges.len(), edges.len(), turns_of);
    let mut patches = DisjointSets::new(count);
    let (mut turns, mut at_vertex) = (vec![0.0; vertices], vec![0; vertices]);
    for (Edge { ends, faces: of }, turn) in edges.iter().flatten().zip(found.into_iter().flatten()) {
        let Some(turn) = turn else { continue };
        patches.join(*of);
        for end in ends {
            turns[*end as usize] += turn;
            at_vertex[*end as usize] += 1;
        }
    }
    // Where there are as many such edges as triangles neither a sharp edge nor the surface's end is.
    let bends = filled(vertices, threads_for(count), false, |vertex| {
        let corners = incidence.corners(vertex);
        let angle = || corners.iter().map(|corner| faces.angles[*corner as usize]).sum::<f64>();
        corners.len() == at_vertex[vertex] && (TAU - angle()).abs() > BENDS * turns[vertex] * turns[vertex]
    });
    let mut areas = vec![[0.0; 2]; count];
    for (face, triangle) in faces.triangles.iter().enumerate() {
        let bent = triangle.iter().filter(|vertex| bends[**vertex as usize]).count() as f64 / 3.0;
        let [all, of_curved] = &mut areas[patches.root(face as u32) as usize];
        *all += faces.areas[face];
        *of_curved += faces.areas[face] * bent;
    }
    (0..count as u32)
        .map(|face| areas[patches.root(face) as usize])
        .map(|[all, of_curved]| of_curved > 0.5 * all)
        .collect()
}
