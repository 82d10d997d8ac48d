//! The lines of a scene before their visibility is decided: objects with repaired meshes, edges by class, other
//! features.

pub(super) mod candidates;
pub(super) mod centre_lines;
mod coplanar;
pub(super) mod covered_faces;
mod edge_classes;
pub(super) mod face_subset;
pub(super) mod feature;
pub(super) mod features;
mod layers;
pub(super) mod line_input;
pub(super) mod mesh_repair;
mod normal_creases;
pub(super) mod object_edges;
pub(super) mod overlaps;
pub(super) mod split_t_junctions;
