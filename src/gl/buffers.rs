//! Scene data on the device: meshes, lists of faces, paint, edges.

use super::objects::Buffer;
use crate::culling::DrawnFaces;
use crate::mesh::{Mesh, Part};
use crate::plan::{EdgeRun, Mark};
use glam::DVec3;
use std::sync::Arc;

/// The ends of some edges on the device, one run after the other.
pub(super) struct EdgeIndices {
    pub(super) runs: Arc<Vec<EdgeRun>>,
    pub(super) mark: Mark,
    /// The indices of each run.
    pub(super) indices: Vec<Vec<u32>>,
    /// All indices in one buffer.
    pub(super) buffer: Buffer,
    /// The vertices of each run with separate vertices.
    pub(super) own_vertices: Vec<Option<Buffer>>,
}

/// A mesh on the device.
pub(super) struct MeshBuffers {
    pub(super) mesh: Arc<Mesh>,
    pub(super) unit: f64,
    pub(super) centre: DVec3,
    pub(super) vertex_count: usize,
    pub(super) vertices: Buffer,
    pub(super) texture_coordinates: Option<Buffer>,
    pub(super) indices: Buffer,
    pub(super) parts: Vec<Part>,
}

/// Some of an object's faces on the device.
pub(super) struct FaceIndices {
    pub(super) list: Arc<DrawnFaces>,
    pub(super) buffer: Buffer,
}

/// A value for each of an object's vertices on the device: its texture coordinate or its colour.
pub(super) struct OfVertices<T> {
    pub(super) list: Arc<Vec<T>>,
    pub(super) buffer: Buffer,
}
