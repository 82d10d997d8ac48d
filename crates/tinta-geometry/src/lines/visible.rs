//! Decides the visibility of lines: faces in eye space, trees over faces and lines, cuts and rays.

pub(super) mod bundles;
pub(super) mod cast;
pub(super) mod cover;
pub(super) mod crossings;
pub(super) mod doubled;
pub(super) mod projected_face;
mod face_pair;
pub(super) mod faces;
mod half_planes;
pub(super) mod image;
pub(super) mod intersections;
pub(super) mod interval;
pub(super) mod line_index;
pub(super) mod nearest_faces;
pub(super) mod occluder_probe;
pub(super) mod occluders;
pub(super) mod outline;
pub(super) mod overlapping_lines;
pub(super) mod planes;
pub(super) mod pyramid;
pub(super) mod ranges;
pub(super) mod reference;
pub(super) mod search;
pub(super) mod space;
pub(super) mod thresholds;
pub(super) mod visibility;
