//! Lasting creases: those of the surface, without the single chance folds of its faces, as on scans.
//!
//! In: a [`Mesh`], its [`EdgeList`] and the creases. Out: the lasting ones. A crease continues in the straightest one at its
//! end, if it turns by less than 45 degrees there. It is lasting if it is closed or long, or if a flat face of several
//! triangles ends at it, as at all edges of a part.

use super::EdgeList;
use crate::mesh::{Mesh, triangle_normal};
use glam::DVec3;

/// Least length of a lasting crease, as a share of the diagonal of the model's box.
const LEAST_LENGTH: f64 = 0.06;

/// The cosine of the largest turn along one crease.
const STRAIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The least cosine between triangles of one flat face: half a degree, as exported planes keep.
const FLAT: f64 = 0.99996;

/// Most creases at a position; more of them do not continue.
const MOST_CREASES: usize = 16;

/// Returns for each edge whether it is a lasting crease.
pub(crate) fn lasting_creases(mesh: &Mesh, edges: &EdgeList, is_crease: impl Fn(u32) -> bool) -> Vec<bool> {
    let is_flat = flat_faces(mesh, edges);
    let creases: Vec<u32> = (0..edges.len() as u32).filter(|edge| is_crease(*edge)).collect();
    let end = |end: usize| edges.positions()[creases[end / 2] as usize][end % 2];
    let place = |end_number: usize| mesh.positions[end(end_number) as usize];
    let length = |crease: usize| place(2 * crease).distance(place(2 * crease + 1));
    // Ends are numbered: crease `k` has ends `2k` and `2k + 1`.
    let mut partners: Vec<Option<usize>> = vec![None; creases.len() * 2];
    let mut ends: Vec<usize> = (0..creases.len() * 2).collect();
    ends.sort_unstable_by_key(|number| (end(*number), *number));
    for meeting in ends.chunk_by(|a, b| end(*a) == end(*b)).filter(|meeting| meeting.len() <= MOST_CREASES) {
        let away = |number: usize| (place(number ^ 1) - place(number)).normalize_or_zero();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (index, first) in meeting.iter().enumerate() {
            let cosines = meeting[index + 1..].iter().map(|second| (away(*first).dot(away(*second)), *first, *second));
            pairs.extend(cosines.filter(|(cosine, ..)| *cosine < -STRAIGHT));
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, first, second) in pairs {
            if partners[first].is_none() && partners[second].is_none() {
                (partners[first], partners[second]) = (Some(second), Some(first));
            }
        }
    }
    let (low, high) = mesh.bounds();
    let least = LEAST_LENGTH * (high - low).length();
    let mut lasts = vec![false; edges.len()];
    let mut is_known = vec![false; creases.len()];
    for first in 0..creases.len() {
        let mut begin = 2 * first;
        let mut is_closed = false;
        while let Some(partner) = partners[begin].filter(|_| !is_known[first] && !is_closed) {
            begin = partner ^ 1;
            is_closed = begin == 2 * first;
        }
        let (mut chain, mut all) = (Vec::new(), 0.0);
        let mut next = Some(begin);
        while let Some(number) = next.filter(|number| !is_known[number / 2]) {
            is_known[number / 2] = true;
            chain.push(creases[number / 2]);
            all += length(number / 2);
            next = partners[number ^ 1];
        }
        let ends_flat = |edge: &u32| edges.faces(*edge).iter().any(|face| is_flat[*face as usize]);
        let is_long = is_closed || all >= least;
        chain.into_iter().filter(|edge| is_long || ends_flat(edge)).for_each(|edge| lasts[edge as usize] = true);
    }
    lasts
}

/// Returns for each face whether a neighbour lies in its plane.
fn flat_faces(mesh: &Mesh, edges: &EdgeList) -> Vec<bool> {
    let normal = |face: u32| mesh.corners(&mesh.triangles[face as usize]).and_then(triangle_normal);
    let normals: Vec<DVec3> =
        (0..mesh.triangles.len() as u32).map(|face| normal(face).unwrap_or(DVec3::ZERO)).collect();
    let mut is_flat = vec![false; mesh.triangles.len()];
    for edge in 0..edges.len() as u32 {
        let &[first, second] = edges.faces(edge) else { continue };
        if normals[first as usize].dot(normals[second as usize]).abs() > FLAT {
            (is_flat[first as usize], is_flat[second as usize]) = (true, true);
        }
    }
    is_flat
}
