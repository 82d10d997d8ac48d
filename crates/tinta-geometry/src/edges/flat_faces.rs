//! Flat faces of several triangles. Parts of machines, furniture and buildings are made of them; figures and scans have few.
//!
//! In: a [`Mesh`] and its [`EdgeList`]. Out: which triangles are part of one, and their share of the surface.

use super::EdgeList;
use crate::mesh::{Mesh, face_normals};
use crate::threads::threads_for;
use crate::tolerances::FLAT_FACE;
use glam::DVec3;

/// Returns for each triangle whether a neighbour lies in its plane.
pub(super) fn flat_faces(mesh: &Mesh, edges: &EdgeList) -> Vec<bool> {
    let normals = face_normals(mesh, threads_for(mesh.triangles.len()));
    let mut is_flat = vec![false; normals.len()];
    for edge in 0..edges.len() as u32 {
        let &[first, second] = edges.faces(edge) else { continue };
        let [one, other] = [first, second].map(|face| DVec3::from_array(normals[face as usize]));
        if one.dot(other).abs() > FLAT_FACE {
            (is_flat[first as usize], is_flat[second as usize]) = (true, true);
        }
    }
    is_flat
}

/// The area of flat faces, and of all, in units of the model's own.
pub(super) fn areas(mesh: &Mesh, is_flat: &[bool]) -> [f64; 2] {
    mesh.triangles.iter().zip(is_flat).fold([0.0; 2], |[flat, all], (face, is_flat)| {
        let area = mesh.corners(face).map_or(0.0, |[a, b, c]| (b - a).cross(c - a).length() * 0.5);
        [if *is_flat { flat + area } else { flat }, all + area]
    })
}
