//! Lines of the smooth surface that the faces approximate: contours and their visibility, form lines, closed forms
//! for comparison.

pub mod closed_forms;
pub(super) mod contour_visibility;
pub(super) mod contours;
pub(super) mod cusps;
pub(super) mod forms;
pub(super) mod silhouettes;
pub(super) mod visibility_events;
