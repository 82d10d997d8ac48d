//! Random meshes and eyes that proptest shrinks.

use crate::support::shapes::mesh;
use glam::DVec3;
use proptest::prelude::*;
use tinta::Mesh;
use tinta::edges::Eye;

/// Triangles of any three positions on a coarse grid, many in one plane.
pub fn random_mesh(positions: usize, faces: usize) -> impl Strategy<Value = Mesh> {
    let position =
        prop::array::uniform3(-8i32..8).prop_map(|[x, y, z]| DVec3::new(x.into(), y.into(), z.into()) * 0.37);
    let corner = 0..positions as u32;
    let triangle =
        [corner.clone(), corner.clone(), corner].prop_filter("three corners", |[a, b, c]| a != b && b != c && c != a);
    (prop::collection::vec(position, positions), prop::collection::vec(triangle, 1..faces))
        .prop_map(|(positions, triangles)| mesh(positions, triangles))
}

/// Points and directions on a coarse grid.
pub fn random_eye() -> impl Strategy<Value = Eye> {
    let vector =
        prop::array::uniform3(-20i32..20).prop_map(|[x, y, z]| DVec3::new(x.into(), y.into(), z.into()) * 0.25);
    (vector, any::<bool>()).prop_map(|(vector, parallel)| match parallel {
        true => Eye::Direction(if vector == DVec3::ZERO { DVec3::Z } else { vector }),
        false => Eye::Point(vector),
    })
}
