//! The boxes around a mesh's vertices.

use crate::mesh::VertexArrays;
use glam::Vec3;

/// Vertices in a box at least: fewer make tighter boxes and more of them.
const LEAST_IN_BOX: usize = 64;

/// Boxes of a mesh at most: each is eight points to project in each picture.
const MOST_BOXES: usize = 512;

/// The boxes around a mesh's vertices, neighbours in drawing order together, in scene radii from the mesh's centre.
pub(super) fn boxes(arrays: &VertexArrays) -> Vec<[Vec3; 2]> {
    let each = LEAST_IN_BOX.max(arrays.vertices.len().div_ceil(MOST_BOXES));
    let around = |vertices: &[[f32; 6]]| {
        let points = vertices.iter().map(|vertex| Vec3::from_slice(vertex));
        points.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
    };
    arrays.vertices.chunks(each).map(around).collect()
}
