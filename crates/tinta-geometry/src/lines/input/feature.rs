//! A line before its visibility is known.

use crate::edges::Class;
use crate::lines::visible::faces::Own;
use glam::DVec3;

/// A line in the eye's space.
#[derive(Debug, Clone)]
pub(in crate::lines) struct Feature {
    /// What it is drawn as; `None` for one that is not wanted and only hides others.
    pub class: Option<Class>,
    /// Whether a surface ends or turns away at it, so that what is behind may appear or disappear there.
    pub occludes: bool,
    pub object: u32,
    pub own: Own,
    pub ends: [DVec3; 2],
    /// The distance below which its object's positions count as one, file units.
    pub weld: f64,
    /// Planes of many faces in which the line lies.
    pub planes: [u32; 2],
    /// The one in which all faces at the line lie.
    pub plane: u32,
    /// Vertices in the file.
    pub edge: Option<[u32; 2]>,
    pub angle_degrees: Option<f64>,
}
