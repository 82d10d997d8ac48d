//! Normals of a smooth surface where it ends, at its open rims.
//!
//! A position on a rim has faces on one side only. Their mean is the normal of a point inside the surface, with an error of
//! first order: as much as the surface bends within half an edge. Elsewhere the error is of second order. Here a linear
//! function on the tangent plane is fitted to the normals of inner positions within two rings, and evaluated at the rim
//! position. If too few exist, as on a cylinder of one row of faces, the mean stays. Creases keep their means: in real models
//! many creases begin and end in the middle of a smooth surface, and fitted normals broke more contours there.

use super::super::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::tolerances::FLAT;
use glam::{DMat3, DVec3};
use std::collections::HashMap;

/// Fewest inner positions of a fit, one more than the numbers it finds for each coordinate.
const FEWEST: usize = 4;

/// Most faces searched around a position: with more, as at a hub, the mean stays.
const MOST_FACES: usize = 64;

/// Least determinant of a fit with scaled unknowns: below it the positions lie along a line.
const LEAST_DETERMINANT: f64 = 1e-4;

/// Least cosine between a mean and the fitted normal: below it the faces do not lie on one smooth surface.
const LEAST_AGREEMENT: f64 = 0.9;

/// Returns the changed normals at open rims, by their numbers.
pub(super) fn normals(
    mesh: &Mesh,
    edges: &EdgeList,
    is_sharp: &[bool],
    units: &[DVec3],
    positions: &[u32],
    corners: &[[u32; 3]],
) -> Vec<(u32, DVec3)> {
    let (mut is_rim, mut is_at_sharp_edge) = (vec![false; mesh.positions.len()], vec![false; mesh.positions.len()]);
    for edge in (0..edges.len()).filter(|edge| is_sharp[*edge]) {
        for position in edges.positions()[edge] {
            is_rim[position as usize] |= edges.incidence()[edge] == Incidence::Boundary;
            is_at_sharp_edge[position as usize] = true;
        }
    }
    let is_inner = |position: &u32| !is_at_sharp_edge[*position as usize];
    if !mesh.triangles.as_flattened().iter().any(is_inner) || !is_rim.contains(&true) {
        return Vec::new();
    }
    // The faces around every normal at a rim or next to one.
    let mut faces_of: HashMap<u32, Vec<u32>> = HashMap::new();
    let is_near = |triangle: &[u32; 3]| triangle.iter().any(|position| is_rim[*position as usize]);
    for (face, _) in mesh.triangles.iter().enumerate().filter(|(_, triangle)| is_near(triangle)) {
        corners[face].iter().filter(|number| **number != NONE).for_each(|number| {
            faces_of.entry(*number).or_default();
        });
    }
    for (face, numbers) in corners.iter().enumerate() {
        for number in numbers {
            if let Some(faces) = faces_of.get_mut(number) {
                faces.push(face as u32);
            }
        }
    }
    let mut numbers: Vec<u32> =
        faces_of.keys().copied().filter(|number| is_rim[positions[*number as usize] as usize]).collect();
    numbers.sort_unstable();
    let faces_of = |number: u32| faces_of.get(&number).filter(|faces| faces.len() <= MOST_FACES).into_iter().flatten();
    let inner_around = |number: &u32| {
        let mut around: Vec<u32> = faces_of(*number)
            .flat_map(|face| corners[*face as usize])
            .flat_map(faces_of)
            .flat_map(|face| corners[*face as usize])
            .filter(|other| *other != NONE && is_inner(&positions[*other as usize]))
            .collect();
        around.sort_unstable();
        around.dedup();
        around
    };
    let place = |number: u32| mesh.positions[positions[number as usize] as usize];
    let found = numbers.iter().filter_map(|number| {
        let own = place(*number);
        let samples: Vec<(DVec3, DVec3)> =
            inner_around(number).into_iter().map(|other| (place(other) - own, units[other as usize])).collect();
        fitted(&samples, units[*number as usize]).map(|normal| (*number, normal))
    });
    found.collect()
}

/// Fits the normal at a position to inner positions, relative to it, with their normals; `None` if the mean of the faces is as
/// good.
fn fitted(samples: &[(DVec3, DVec3)], mean: DVec3) -> Option<DVec3> {
    let (across, up) = mean.try_normalize()?.any_orthonormal_pair();
    let is_flat = samples.iter().all(|(_, normal)| normal.distance(mean) <= FLAT);
    let size = samples.iter().map(|(place, _)| place.length()).fold(0.0, f64::max);
    if samples.len() < FEWEST || is_flat || size <= 0.0 {
        return None;
    }
    // The normal equations of N(u, v) = N0 + u A + v B, u and v of about 1.
    let (mut matrix, mut sums) = (DMat3::ZERO, [DVec3::ZERO; 3]);
    for (place, normal) in samples {
        let row = DVec3::new(1.0, place.dot(across) / size, place.dot(up) / size);
        matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        for (sum, share) in sums.iter_mut().zip(row.to_array()) {
            *sum += *normal * share;
        }
    }
    let count = samples.len() as f64;
    if (matrix * (1.0 / count)).determinant() < LEAST_DETERMINANT {
        return None;
    }
    let first = matrix.inverse().transpose().x_axis;
    let normal = (sums[0] * first.x + sums[1] * first.y + sums[2] * first.z).try_normalize()?;
    (normal.dot(mean) >= LEAST_AGREEMENT).then_some(normal)
}

#[cfg(test)]
mod tests {
    use crate::edges::{CreaseAngle, EdgeList, SmoothSurface};
    use crate::mesh::{LoadOptions, Mesh};
    use glam::DVec3;

    fn surface(mesh: &Mesh) -> SmoothSurface {
        SmoothSurface::new(mesh, &EdgeList::new(mesh), CreaseAngle::of_drawings())
    }

    /// A piece of a sphere, open all around, with so many cells each way; the largest error of its normals, a sine.
    fn error(cells: u32) -> f64 {
        let count = cells + 1;
        let place = |number: u32| f64::from(number) / f64::from(cells) - 0.4;
        let positions: Vec<DVec3> = (0..count * count)
            .map(|number| DVec3::new(place(number % count), 1.0, place(number / count)).normalize())
            .collect();
        let quads = (0..cells * cells).map(|cell| cell / cells * count + cell % cells);
        let triangles: Vec<[u32; 3]> = quads
            .flat_map(|corner| [[corner, corner + count, corner + count + 1], [corner, corner + count + 1, corner + 1]])
            .collect();
        let mesh = Mesh::of_triangles("a cap", positions, &triangles, &LoadOptions::default()).unwrap();
        let surface = surface(&mesh);
        // At the sheet's own corners there are too few inner positions.
        let is_corner = |position: u32| {
            [position % count, position / count].iter().all(|number| *number < 2 || *number > cells - 2)
        };
        let errors = surface.normals.iter().zip(&surface.normal_positions);
        let errors = errors.filter(|(_, position)| !is_corner(**position));
        errors.map(|(normal, position)| normal.cross(mesh.positions[*position as usize]).length()).fold(0.0, f64::max)
    }

    #[test]
    fn the_normals_at_a_rim_are_of_second_order() {
        let (coarse, fine) = (error(12), error(48));
        let order = (coarse / fine).log2() / 2.0;
        assert!(fine < 2e-3 && order > 1.8, "{coarse} {fine}: order {order}");
    }

    #[test]
    fn a_hub_of_very_many_faces_and_a_flat_sheet_keep_their_means() {
        // A shallow cone: one position in the middle of 20,000 faces, all others at the rim.
        let count = 20_000u32;
        let around = |number: u32| {
            let angle = f64::from(number) / f64::from(count) * std::f64::consts::TAU;
            DVec3::new(angle.cos(), 0.0, angle.sin())
        };
        let positions: Vec<DVec3> = (0..count).map(around).chain([DVec3::Y * 0.1]).collect();
        let triangles: Vec<[u32; 3]> = (0..count).map(|number| [count, (number + 1) % count, number]).collect();
        let mesh = Mesh::of_triangles("a cone", positions, &triangles, &LoadOptions::default()).unwrap();
        let surface = surface(&mesh);
        assert!(surface.normals.iter().all(|normal| normal.is_normalized() && normal.y > 0.9));
    }
}
