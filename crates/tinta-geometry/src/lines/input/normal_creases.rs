//! Creases of shading: the parts of an edge where the normals on its two sides, interpolated along it, differ by more than an angle.

use crate::edges::{EdgeList, Incidence};
use crate::mesh::Mesh;
use glam::DVec3;

/// Pieces that an edge is searched in: the angle along one rises and falls at most a few times.
const PIECES: usize = 16;

/// The parts of an edge, as shares from its first position to its second, where the cosine of the angle between the normals of its two
/// faces is less than `cosine`; in ascending order.
pub(super) fn creased_shares(mesh: &Mesh, list: &EdgeList, edge: u32, cosine: f64) -> Vec<[f64; 2]> {
    let &[first, second] = list.faces(edge) else { return Vec::new() };
    let ends = list.positions()[edge as usize];
    let Some(sides) = normals(mesh, first, ends).zip(normals(mesh, second, ends)) else { return Vec::new() };
    let turned = if list.incidence()[edge as usize] == Incidence::InnerReversed { -1.0 } else { 1.0 };
    // Above 0 where there is a crease.
    let excess = |share: f64| {
        let [first, second] = [sides.0, sides.1].map(|[from, to]| from.lerp(to, share).normalize_or_zero());
        cosine - turned * first.dot(second)
    };
    let crossing = |mut inside: f64, mut outside: f64| {
        while (inside - outside).abs() > 1e-6 {
            let middle = f64::midpoint(inside, outside);
            if excess(middle) > 0.0 { inside = middle } else { outside = middle }
        }
        inside
    };
    let mut parts: Vec<[f64; 2]> = Vec::new();
    let mut start = (excess(0.0) > 0.0).then_some(0.0);
    for piece in 1..=PIECES {
        let [before, here] = [piece - 1, piece].map(|number| number as f64 / PIECES as f64);
        match (start, excess(here) > 0.0) {
            (None, true) => start = Some(crossing(here, before)),
            (Some(from), false) => {
                parts.push([from, crossing(before, here)]);
                start = None;
            }
            _ => {}
        }
    }
    parts.extend(start.map(|from| [from, 1.0]));
    parts
}

/// A face's normals at two of its positions; `None` if it has none.
fn normals(mesh: &Mesh, face: u32, ends: [u32; 2]) -> Option<[DVec3; 2]> {
    let (corners, numbers) = (mesh.triangles[face as usize], mesh.triangle_normals.get(face as usize)?);
    let normal = |position: u32| {
        let corner = corners.iter().position(|corner| *corner == position)?;
        Some(mesh.normals.get(numbers[corner] as usize)?.as_dvec3().normalize_or_zero())
    };
    Some([normal(ends[0])?, normal(ends[1])?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::MeshEdges;
    use glam::Vec3;
    use std::sync::Arc;

    /// Two triangles in a plane at an edge from 0 to 1; their normals there turn apart by these angles, degrees.
    fn parts(apart: [f32; 2], limit: f64) -> Vec<[f64; 2]> {
        let turned = |degrees: f32| Vec3::new(0.0, degrees.to_radians().sin(), degrees.to_radians().cos());
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.5, -1.0, 0.0]].map(DVec3::from_array);
        let normals = [apart[0] / 2.0, apart[1] / 2.0, -apart[0] / 2.0, -apart[1] / 2.0].map(turned);
        let mesh = Mesh {
            positions: positions.to_vec(),
            triangles: vec![[0, 1, 2], [1, 0, 3]],
            normals: normals.to_vec(),
            triangle_normals: vec![[0, 1, 0], [3, 2, 2]],
            ..Mesh::triangle()
        };
        let edges = MeshEdges::new(Arc::new(mesh));
        let list = edges.list();
        let edge = list.positions().iter().position(|ends| *ends == [0, 1]).unwrap() as u32;
        creased_shares(edges.mesh(), list, edge, limit.to_radians().cos())
    }

    #[test]
    fn a_crease_ends_where_its_normals_are_that_near() {
        let near = |found: &[[f64; 2]], expected: &[[f64; 2]]| {
            let pairs = found.iter().flatten().zip(expected.iter().flatten());
            assert!(found.len() == expected.len() && pairs.clone().all(|(a, b)| (a - b).abs() < 1e-5), "{found:?}");
        };
        near(&parts([90.0, 90.0], 45.0), &[[0.0, 1.0]]);
        near(&parts([20.0, 20.0], 45.0), &[]);
        // tan(22.5°) = t sin 45° / (1 - t + t cos 45°) at t = 1/2.
        near(&parts([0.0, 90.0], 45.0), &[[0.5, 1.0]]);
        near(&parts([90.0, 0.0], 45.0), &[[0.0, 0.5]]);
        // The sides change places on the way, and are alike in the middle.
        let crossed = parts([90.0, -90.0], 45.0);
        assert!(matches!(crossed[..], [[0.0, a], [b, 1.0]] if (a + b - 1.0).abs() < 1e-5 && a < b), "{crossed:?}");
    }
}
