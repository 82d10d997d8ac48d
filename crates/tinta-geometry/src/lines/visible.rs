//! Decides the visibility of lines: trees over faces and lines, cuts, and rules for what hides what.

pub(super) mod bundles;
pub(super) mod cover;
pub(super) mod covered_lines;
pub(super) mod contact;
pub(super) mod crossings;
mod half_planes;
pub(super) mod intersections;
pub(super) mod interval;
pub(super) mod line_index;
pub(super) mod nearest_faces;
pub(super) mod occluder_probe;
pub(super) mod occluders;
pub(super) mod outline;
pub(super) mod overlapping_lines;
pub(super) mod reference;
pub(super) mod search;
pub(super) mod visibility;
