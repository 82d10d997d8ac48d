//! A scene in the eye's space: its faces, the images of lines and faces, rays, crossings of two faces, a buffer of depths.
//!
//! In: a [`Scene`](crate::scene::Scene). Exact lines ([`visible`](crate::lines::visible)) and areas
//! ([`regions`](crate::lines::regions)) both stand on it.

pub(super) mod cast;
pub(super) mod face_pair;
pub(super) mod faces;
pub(super) mod image;
pub(super) mod pieces;
mod planes;
pub(super) mod projected_face;
pub(super) mod pyramid;
pub(super) mod space;
pub(super) mod touch;
