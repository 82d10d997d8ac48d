//! Bounding boxes around groups of a mesh's vertices.

use crate::mesh::VertexArrays;
use glam::Vec3;

/// Least number of vertices per box: smaller boxes are tighter, but more numerous.
const LEAST_IN_BOX: usize = 64;

/// Largest number of boxes per mesh: each adds eight points to project in every picture.
const MOST_BOXES: usize = 512;

/// Boxes around a mesh's vertices, grouped in drawing order, and one around the positions of its curves and points, in scene
/// radii from the mesh's centre.
pub(super) fn boxes(arrays: &VertexArrays, free: &[Vec3]) -> Vec<[Vec3; 2]> {
    let each = LEAST_IN_BOX.max(arrays.vertices.len().div_ceil(MOST_BOXES));
    let around = |points: &mut dyn Iterator<Item = Vec3>| {
        points.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
    };
    let points = |vertices: &[[f32; 6]]| around(&mut vertices.iter().map(|vertex| Vec3::from_slice(vertex)));
    let mut boxes: Vec<[Vec3; 2]> = arrays.vertices.chunks(each).map(points).collect();
    if !free.is_empty() {
        boxes.push(around(&mut free.iter().copied()));
    }
    boxes
}
