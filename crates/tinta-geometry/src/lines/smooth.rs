//! Lines of the smooth surface that the faces stand for: contours and their visibility, form lines, closed forms to compare with.

pub mod closed_forms;
pub(super) mod contour_visibility;
pub(super) mod contours;
pub(super) mod cusps;
pub(super) mod forms;
pub(super) mod silhouettes;
pub(super) mod visibility_events;
