//! Edges of meshes, silhouettes and sections. One binary, to link once.

extern crate tinta_geometry as tinta;

mod edges;
#[cfg(feature = "gltf")]
mod hidden_faces;
mod random;
mod section;
mod silhouettes;
mod tangents;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
