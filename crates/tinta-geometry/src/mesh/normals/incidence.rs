//! The triangle corners that meet at each position.

use glam::DVec3;
use std::ops::Range;

/// For every position the triangle corners that meet there, as `3 * triangle + corner`.
pub(in crate::mesh) struct Incidence {
    starts: Vec<u32>,
    /// The corners at all vertices, one after the other.
    pub(super) all_corners: Vec<u32>,
}

impl Incidence {
    pub(in crate::mesh) fn new(position_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0u32; position_count + 1];
        for index in triangles.as_flattened() {
            starts[*index as usize + 1] += 1;
        }
        for vertex in 0..position_count {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut all_corners = vec![0u32; triangles.len() * 3];
        for (corner, index) in triangles.as_flattened().iter().enumerate() {
            let slot = &mut next[*index as usize];
            all_corners[*slot as usize] = corner as u32;
            *slot += 1;
        }
        Self { starts, all_corners }
    }

    /// How many vertices there are.
    pub(super) fn vertices(&self) -> usize {
        self.starts.len() - 1
    }

    /// The corners at some vertices, one after the other.
    pub(super) fn corners_of(&self, vertices: &Range<usize>) -> &[u32] {
        &self.all_corners[self.starts[vertices.start] as usize..self.starts[vertices.end] as usize]
    }

    /// The corners at a vertex.
    pub(in crate::mesh) fn corners(&self, vertex: usize) -> &[u32] {
        &self.all_corners[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// A face's angle at one of its corners, radians.
pub(super) fn angle_at(positions: &[DVec3], triangles: &[[u32; 3]], corner: u32) -> f64 {
    let triangle = triangles[corner as usize / 3];
    let [at, next, previous] = [0, 1, 2].map(|step| positions[triangle[(corner as usize % 3 + step) % 3] as usize]);
    let (to_next, to_previous) = (next - at, previous - at);
    to_next.cross(to_previous).length().atan2(to_next.dot(to_previous))
}
