//! Finds the facets that approximate a surface with double curvature, as a figure's do, rather than a machine part's flat
//! faces.
//!
//! In: a surface's triangles and edges. Out: the answer for each triangle, the same throughout a patch: all faces connected
//! over edges below the smoothing angle. A surface has double curvature at a vertex if the angles around it do not add up to a
//! full turn (its Gaussian curvature); on a plane, a cylinder or a cone they do. A patch is curved if most of its area lies at
//! such vertices, in facets with a bulge below the width of `print`'s outline.

use super::denoise_normals::Faces;
use super::incidence::{Incidence, angle_at};
use crate::disjoint_sets::DisjointSets;
use crate::threads::{filled, threads_for};
use std::f64::consts::TAU;

/// Least double curvature, as a share of the square of all turns of the edges around a vertex: on a sphere the share is about
/// 0.1, on a cylinder only the rounding of a file's digits.
const BENDS: f64 = 0.01;

/// The most that a surface bulges from a facet, in shares of the diagonal of the model's box.
const BULGE: f64 = 0.003;

/// The mean area of facets that are too small to be seen, in squares of that diagonal: the patches of `denoise_normals.rs` are as large.
const UNSEEN: f64 = 9e-6;

/// An edge of two faces.
pub(super) struct Edge {
    pub ends: [u32; 2],
    pub faces: [u32; 2],
}

/// Returns for each triangle whether it lies in a curved patch; `edges` are those of two triangles, each once.
pub(super) fn curved<'a, I: Iterator<Item = &'a Edge>>(
    faces: &Faces<'_>,
    edges: impl Fn() -> I,
    incidence: &Incidence,
    diagonal: f64,
    cos_smooth: f64,
) -> Vec<bool> {
    let (count, vertices) = (faces.triangles.len(), faces.positions.len());
    if faces.areas.iter().sum::<f64>() < UNSEEN * diagonal * diagonal * count as f64 {
        return vec![false; count];
    }
    let mut patches = DisjointSets::new(count);
    let (mut turns, mut at_vertex) = (vec![0.0; vertices], vec![0; vertices]);
    let mut largest = vec![0.0f64; count];
    for Edge { ends, faces: of } in edges() {
        let [normal, other] = of.map(|face| faces.normals[face as usize]);
        if normal.dot(other) < cos_smooth {
            continue;
        }
        patches.join(*of);
        let turn = normal.cross(other).length().atan2(normal.dot(other));
        of.iter().for_each(|face| largest[*face as usize] = largest[*face as usize].max(turn));
        for end in ends {
            turns[*end as usize] += turn;
            at_vertex[*end as usize] += 1;
        }
    }
    // Where there are as many such edges as triangles neither a sharp edge nor the surface's end is.
    let bends = filled(vertices, threads_for(count), false, |vertex| {
        let corners = incidence.corners(vertex);
        let angle = || corners.iter().map(|corner| angle_at(faces.positions, faces.triangles, *corner)).sum::<f64>();
        corners.len() == at_vertex[vertex] && (TAU - angle()).abs() > BENDS * turns[vertex] * turns[vertex]
    });
    let mut areas = vec![[0.0; 2]; count];
    for (face, triangle) in faces.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|vertex| faces.positions[vertex as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        // An arc whose ends turn by half of that angle each lies an eighth of its chord's length times it from the chord.
        let is_close = longest * largest[face] < 8.0 * BULGE * diagonal;
        let bent = triangle.iter().filter(|vertex| bends[**vertex as usize]).count() as f64 / 3.0;
        let [all, of_curved] = &mut areas[patches.root(face as u32) as usize];
        *all += faces.areas[face];
        *of_curved += if is_close { faces.areas[face] * bent } else { 0.0 };
    }
    (0..count as u32)
        .map(|face| areas[patches.root(face) as usize])
        .map(|[all, of_curved]| of_curved > 0.5 * all)
        .collect()
}
