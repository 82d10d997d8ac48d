//! Bounding boxes around groups of a mesh's vertices.

use crate::mesh::VertexArrays;
use glam::Vec3;

/// Least number of vertices per box: smaller boxes are tighter, but more numerous.
const LEAST_IN_BOX: usize = 64;

/// Largest number of boxes per mesh: each adds eight points to project in every picture.
const MOST_BOXES: usize = 512;

/// Boxes around a mesh's vertices, grouped in drawing order, in scene radii from the mesh's centre.
pub(super) fn boxes(arrays: &VertexArrays) -> Vec<[Vec3; 2]> {
    let each = LEAST_IN_BOX.max(arrays.vertices.len().div_ceil(MOST_BOXES));
    let around = |vertices: &[[f32; 6]]| {
        let points = vertices.iter().map(|vertex| Vec3::from_slice(vertex));
        points.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
    };
    arrays.vertices.chunks(each).map(around).collect()
}
