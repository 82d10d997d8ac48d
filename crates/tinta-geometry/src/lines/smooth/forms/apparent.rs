//! The view-dependent curvature (Judd et al. 2007): how fast the normal turns per step in the picture.

use super::trace::Crest;
use crate::curvature::{Curvature, Curvatures};
use crate::mesh::Mesh;
use crate::threads::filled;
use glam::DVec3;

/// Least cosine between normal and view at which lines are traced: at the contour the view-dependent curvature is
/// unbounded.
pub(super) const LEAST_COSINE: f64 = 0.02;

/// The largest view-dependent curvature at each vertex, with its direction on the surface and its growth along that
/// direction.
pub(super) fn crests(
    mesh: &Mesh,
    curvatures: &Curvatures,
    cosines: &[f64],
    to_eye: impl Fn(usize) -> DVec3 + Sync,
    threads: usize,
) -> Vec<Crest> {
    let all = curvatures.all();
    let seen = filled(all.len(), threads, (0.0, DVec3::ZERO), |vertex| strongest(&all[vertex], to_eye(vertex)));
    // The mean of the gradients in the faces around each vertex, weighted by area.
    let mut gradients = vec![(DVec3::ZERO, 0.0); all.len()];
    for (vertices, triangle) in curvatures.corners().iter().zip(&mesh.triangles) {
        // Beyond the contour the view-dependent curvature falls again.
        let is_front = vertices.map(|vertex| cosines[vertex as usize] > 0.0);
        if is_front != [is_front[0]; 3] {
            continue;
        }
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        let product = (b - a).cross(c - a);
        let length = product.length();
        let Some(normal) = product.try_normalize() else { continue };
        let strength = vertices.map(|vertex| seen[vertex as usize].0);
        // Twice the area times the gradient.
        let gradient = normal.cross((c - b) * strength[0] + (a - c) * strength[1] + (b - a) * strength[2]);
        for vertex in vertices {
            let (sum, area) = &mut gradients[*vertex as usize];
            *sum += gradient;
            *area += length;
        }
    }
    filled(all.len(), threads, Crest::default(), |vertex| {
        let ((strength, direction), (gradient, area)) = (seen[vertex], gradients[vertex]);
        let growth = if area > 0.0 { (gradient / area).dot(direction) } else { 0.0 };
        Crest { strength, direction, growth }
    })
}

/// The largest singular value of the view-dependent curvature, and its direction on the surface, a unit vector.
///
/// A step s in the picture is P⁻¹ s on the surface: longer by 1 / cos along the view's part in the tangent plane,
/// unchanged across it. The normal turns by Q s = S P⁻¹ s.
fn strongest(at: &Curvature, to_eye: DVec3) -> (f64, DVec3) {
    let cosine = to_eye.dot(at.normal);
    let along = (to_eye - at.normal * cosine).try_normalize().unwrap_or(at.directions[0]);
    let across = at.normal.cross(along);
    let longer = 1.0 / cosine.abs().max(LEAST_COSINE);
    let (a, b, c) = (at.second([along; 2]), at.second([along, across]), at.second([across; 2]));
    // QᵀQ, and its larger value.
    let [p, q, r] = [longer * longer * (a * a + b * b), longer * b * (a + c), b * b + c * c];
    let (half, radius) = (0.5 * (p - r), (0.5 * (p - r)).hypot(q));
    let turn = if radius > 0.0 { half / radius } else { 1.0 };
    let (x, y) = ((0.5 * (1.0 + turn)).max(0.0).sqrt(), (0.5 * (1.0 - turn)).max(0.0).sqrt().copysign(q));
    ((0.5 * (p + r) + radius).sqrt(), (along * (x * longer) + across * y).normalize_or_zero())
}
