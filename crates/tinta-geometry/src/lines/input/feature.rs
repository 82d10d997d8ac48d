//! A line before its visibility is decided.

use crate::edges::Class;
use crate::lines::visible::faces::Own;
use glam::DVec3;

/// A line in eye space.
#[derive(Debug, Clone)]
pub(in crate::lines) struct Feature {
    /// The class that it is drawn as; `None` for a line that only hides others.
    pub class: Option<Class>,
    /// Whether a surface ends or turns away at it, so things behind may appear or disappear there.
    pub occludes: bool,
    pub object: u32,
    pub own: Own,
    pub ends: [DVec3; 2],
    /// The distance below which positions of its object coincide, file units.
    pub weld: f64,
    /// The planes with many faces that contain the line.
    pub planes: [u32; 2],
    /// The plane that contains all faces at the line.
    pub plane: u32,
    /// Its vertex numbers in the file.
    pub edge: Option<[u32; 2]>,
    pub angle_degrees: Option<f64>,
}
