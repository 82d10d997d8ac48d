//! Faces that lie on each other, one each way: a thin part modelled as two sheets, as the wings of many games' models are.
//!
//! In: a mesh. Out: the number of pairs whose wrong side may show in a picture. If both sheets have the same corners, chance
//! decides; if the file's coarse coordinates have moved one through the other, the wrong side is nearer. A thin but solid plate
//! is no such pair: each of its faces lies behind the other's back.
//!
//! ```
//! use tinta_geometry::{LoadOptions, Mesh, doubled::doubled_faces, glam::DVec3};
//!
//! let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
//! let leaf = Mesh::of_triangles("a leaf", corners, &[[0, 1, 2], [2, 1, 0]], &LoadOptions::default())?;
//! assert_eq!(doubled_faces(&leaf), 1);
//! # Ok::<(), tinta_geometry::Error>(())
//! ```

use crate::bvh::{Box3, BoxTree};
use crate::limits::DOUBLED_FACES;
use crate::mesh::{Mesh, outside::pairs, triangle_normal};
use crate::tolerances::{DOUBLED, DOUBLED_AREA};
use glam::DVec3;

/// Most tested pairs with nearby middles, as a multiple of the faces: a sound mesh has hardly any.
const PAIRS_OF_A_FACE: usize = 100;

/// A face, its middle and how near another must come.
struct Face {
    number: u32,
    corners: [DVec3; 3],
    middle: DVec3,
    near: f64,
}

/// Returns the number of pairs of faces that lie on each other, one each way, do not keep their sides apart, and may be seen. Faces
/// too small to matter in a picture do not count, nor do meshes of more than [`DOUBLED_FACES`] faces.
pub fn doubled_faces(mesh: &Mesh) -> usize {
    if mesh.triangles.len() > DOUBLED_FACES {
        return 0;
    }
    let (low, high) = mesh.bounds();
    let origin = (low + high) * 0.5;
    let face = |(number, triangle): (u32, &[u32; 3])| {
        let corners @ [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize] - origin);
        let shortest = a.distance(b).min(b.distance(c)).min(c.distance(a));
        Face { number, corners, middle: (a + b + c) / 3.0, near: shortest * DOUBLED }
    };
    let faces: Vec<Face> = (0..).zip(&mesh.triangles).map(face).collect();
    let area = |face: &Face| {
        let [a, b, c] = face.corners;
        (b - a).cross(c - a).length()
    };
    let least: f64 = faces.iter().map(area).sum::<f64>() * DOUBLED_AREA;
    let faces: Vec<Face> = faces.into_iter().filter(|face| area(face) > least).collect();
    let boxes: Vec<Box3> =
        faces.iter().map(|face| Box3::new(face.middle - face.near, face.middle + face.near)).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let (mut doubled, mut looked_at) = (Vec::new(), 0);
    tree.pairs(|first, second| {
        let [first, second] = [first, second].map(|place| &faces[order[place as usize] as usize]);
        if are_doubled(first, second) {
            doubled.push([first.number, second.number]);
        }
        looked_at += 1;
        looked_at > faces.len().saturating_mul(PAIRS_OF_A_FACE)
    });
    pairs(&mesh.triangles, &mesh.positions, doubled).len()
}

/// Whether the corners of two faces lie near each other, in opposite order, and the second is not behind the first's back.
fn are_doubled(first: &Face, second: &Face) -> bool {
    let (near, [a, b, c]) = (first.near.min(second.near), first.corners);
    let [p, q, r] = second.corners;
    // Round the other way from each corner of the second.
    let turned = [[p, r, q], [q, p, r], [r, q, p]];
    let near_corners =
        turned.iter().find(|corners| [a, b, c].iter().zip(*corners).all(|(one, other)| one.distance(*other) < near));
    let (Some(corners), Some(normal)) = (near_corners, triangle_normal([a, b, c])) else { return false };
    // Shared corners do not tell which face is in front.
    let apart = [a, b, c].into_iter().zip(corners).filter(|(one, other)| one != *other);
    let in_front: Vec<f64> = apart.map(|(one, other)| (*other - one).dot(normal)).collect();
    in_front.is_empty() || in_front.iter().any(|distance| *distance > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::LoadOptions;

    fn doubled(corners: &[[f64; 3]], triangles: &[[u32; 3]]) -> usize {
        let corners = corners.iter().map(|corner| DVec3::from_array(*corner)).collect();
        doubled_faces(&Mesh::of_triangles("a leaf", corners, triangles, &LoadOptions::default()).unwrap())
    }

    #[test]
    fn faces_with_the_same_corners_are_counted_once_a_pair() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(doubled(&corners, &[[0, 1, 2], [0, 1, 3]]), 0);
        assert_eq!(doubled(&corners, &[[0, 1, 2], [2, 1, 0]]), 1);
        assert_eq!(doubled(&corners, &[[0, 1, 2], [0, 2, 1], [3, 1, 0], [1, 3, 0]]), 2);
        // The same from the same side is dropped when it is read.
        assert_eq!(doubled(&corners, &[[0, 1, 2], [1, 2, 0]]), 0);
    }

    #[test]
    fn two_sheets_that_pass_through_each_other_are_doubled_and_a_thin_plate_is_not() {
        let sheets = |distance: f64, tilt: f64| {
            let upper = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            let lower = upper.map(|[x, y, _]| [x, y, tilt * (x + y) - distance]);
            doubled(&[upper, lower].concat(), &[[0, 1, 2], [3, 5, 4]])
        };
        assert_eq!(sheets(0.02, 0.0), 0, "the lower one is below, as its back says");
        assert_eq!(sheets(-0.02, 0.0), 1, "the lower one is above");
        assert_eq!(sheets(0.02, 0.04), 1, "they cross");
        assert_eq!(sheets(-0.5, 0.0), 0, "they are far apart");
    }

    /// Closed boxes of these sides in a row along x, so far apart, wound outwards; and where each is written once more,
    /// turned round.
    fn boxes(count: u32, sides: [f64; 3], apart: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let corner = |number: u32, corner: u32| {
            let at = |axis: usize| f64::from(corner >> axis & 1) * sides[axis];
            [at(0) + f64::from(number) * (sides[0] + apart), at(1), at(2)]
        };
        let quads: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let corners = (0..count).flat_map(|number| (0..8).map(move |place| (number, place)));
        let triangles = (0..count).flat_map(|number| quads.map(|quad| quad.map(|place| place + number * 8)));
        (
            corners.map(|(number, place)| corner(number, place)).collect(),
            triangles.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        )
    }

    #[test]
    fn fences_blinds_and_louvres_have_none_and_the_same_written_twice_have_all() {
        for (name, (corners, triangles)) in [
            ("fence", boxes(30, [0.02, 1.0, 0.02], 0.02)),
            ("blind", boxes(30, [0.005, 1.0, 0.05], 0.03)),
            ("louvres", boxes(100, [0.0005, 1.0, 0.01], 0.002)),
        ] {
            assert_eq!(doubled(&corners, &triangles), 0, "{name}");
            let other_sides = triangles.iter().map(|[a, b, c]| [*c, *b, *a]);
            let twice: Vec<[u32; 3]> = triangles.iter().copied().chain(other_sides).collect();
            let least_seen = doubled(&corners, &twice);
            assert!(least_seen * 3 >= triangles.len(), "{name}: {least_seen} of {}", triangles.len());
        }
        // Louvres without thickness, all wound alike.
        let slat = |number: u32| {
            let y = f64::from(number) * 0.002;
            [[0.0, y, 0.0], [1.0, y, 0.0], [1.0, y + 0.001, 0.01], [0.0, y + 0.001, 0.01]]
        };
        let corners: Vec<[f64; 3]> = (0..500).flat_map(slat).collect();
        let triangles: Vec<[u32; 3]> =
            (0..500).map(|number| number * 4).flat_map(|at| [[at, at + 1, at + 2], [at, at + 2, at + 3]]).collect();
        assert_eq!(doubled(&corners, &triangles), 0);
    }

    #[test]
    fn pairs_inside_touching_solids_do_not_count_and_pairs_outside_do() {
        /// Boxes that share their sides along x, and one more pair of faces with these corners.
        fn with_pair(more: [[f64; 3]; 3]) -> (usize, usize) {
            let (mut corners, mut triangles) = boxes(3, [1.0; 3], 0.0);
            let first = corners.len() as u32;
            corners.extend(more);
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 1]]);
            let corners = corners.iter().map(|corner| DVec3::from_array(*corner)).collect();
            let mesh = Mesh::of_triangles("boxes", corners, &triangles, &LoadOptions::default()).unwrap();
            (doubled_faces(&mesh), mesh.defects.doubled_triangles)
        }
        let inside = [[0.2, 0.2, 0.2], [0.8, 0.3, 0.2], [0.3, 0.8, 0.6]];
        assert_eq!(with_pair(inside), (0, 0), "nor in one of them");
        let shifted = |by: f64| inside.map(|[x, y, z]| [x, y + by, z]);
        assert_eq!(with_pair(shifted(5.0)), (1, 1), "beside them");
        assert_eq!(with_pair(shifted(0.7)), (1, 1), "with its middle outside");
        // A lid of an open box closes it, but the other side of it is outside.
        let (corners, mut triangles) = boxes(1, [1.0; 3], 0.0);
        let lid: Vec<[u32; 3]> = triangles[2..4].iter().map(|[a, b, c]| [*c, *b, *a]).collect();
        triangles.extend(lid);
        assert_eq!(doubled(&corners, &triangles), 2);
        let inward: Vec<[u32; 3]> = boxes(2, [1.0; 3], 0.0).1.iter().map(|[a, b, c]| [*c, *b, *a]).collect();
        assert_eq!(doubled(&boxes(2, [1.0; 3], 0.0).0, &inward), 0, "whatever their winding");
    }

    #[test]
    fn closed_models_have_none() {
        for name in ["gear", "open-box", "ant", "bust", "pawn"] {
            let path = format!("../../models/{name}.obj");
            let mesh = crate::mesh::load(&path, &LoadOptions::default()).unwrap().mesh;
            assert_eq!(doubled_faces(&mesh), 0, "{name}");
        }
    }
}
