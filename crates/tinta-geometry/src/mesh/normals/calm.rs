//! Vertices' normals brought half-way to the mean of their neighbours': borders of tones then follow the shape rather than its
//! facets.
//!
//! Only vertices within a curved surface take part (`curved.rs`), away from creases that last and open rims: flat faces,
//! cylinders and cones of machine parts keep theirs exactly. One round reaches as far as one edge, which keeps relief wider
//! than a facet. Neighbours count less the more they differ.

use super::incidence::Incidence;
use super::persistent_creases::PersistentCreases;
use crate::mesh::NONE;
use crate::threads::{filled, threads_for};
use glam::{DVec3, Vec3};

/// How far a normal moves to the mean: what alternates from vertex to vertex goes, and nothing overshoots.
const SHARE: f64 = 0.5;

/// Moves those of `normals` that begin at number `first`; `triangle_normals` has each corner's number.
pub(super) fn calm(
    triangles: &[[u32; 3]],
    incidence: &Incidence,
    lasting: &PersistentCreases,
    cos_smooth: f64,
    first: u32,
    normals: &mut [Vec3],
    triangle_normals: &[[u32; 3]],
) {
    if !lasting.is_curved.contains(&true) {
        return;
    }
    let number = |corner: u32| triangle_normals[corner as usize / 3][corner as usize % 3];
    let vertices = lasting.vertices.len();
    let threads = threads_for(triangles.len());
    let curved = filled(vertices, threads, NONE, |vertex| match incidence.corners(vertex) {
        [one, ..] if lasting.vertices[vertex] || number(*one) < first => NONE,
        corners @ [one, ..]
            if corners.iter().all(|it| number(*it) == number(*one) && lasting.is_curved[*it as usize / 3]) =>
        {
            number(*one)
        }
        _ => NONE,
    });
    let normal = |vertex: usize| normals[curved[vertex] as usize].as_dvec3();
    let calmed = filled(vertices, threads, Vec3::ZERO, |vertex| {
        if curved[vertex] == NONE {
            return Vec3::ZERO;
        }
        let own = normal(vertex);
        let (mut sum, mut weights, mut odd) = (DVec3::ZERO, 0.0, 0);
        // Each neighbour once for each face that both have.
        for other in incidence.corners(vertex).iter().flat_map(|corner| triangles[*corner as usize / 3]) {
            if other as usize == vertex {
                continue;
            }
            // On one side only the mean leans to that side: beside a crease and at an open rim, where a neighbour comes only once.
            if curved[other as usize] == NONE {
                return own.as_vec3();
            }
            odd ^= other;
            let other = normal(other as usize);
            let weight = (own.dot(other) - cos_smooth).max(0.0);
            (sum, weights) = (sum + weight * other, weights + weight);
        }
        let has_all_around = odd == 0 && weights > 0.0;
        let mixed = if has_all_around { own.lerp(sum / weights, SHARE).normalize_or(own) } else { own };
        // No face may turn away from the normal of its corner.
        let fronts = |normal: DVec3| {
            incidence.corners(vertex).iter().all(|it| lasting.face_normals[*it as usize / 3].dot(normal) > 0.0)
        };
        if fronts(mixed) { mixed.as_vec3() } else { own.as_vec3() }
    });
    for (number, normal) in curved.into_iter().zip(calmed).filter(|(number, _)| *number != NONE) {
        normals[number as usize] = normal;
    }
}
