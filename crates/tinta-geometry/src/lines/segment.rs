//! A piece of a line.

use crate::edges::Class;
use crate::lines::drawing::layers::Layer;
use glam::{DVec2, DVec3};

/// A piece of a line of one class that is seen or hidden as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSegment {
    /// Its class; of several the first in the order of [`Class::ALL`].
    pub class: Class,
    /// Whether it is seen.
    pub is_visible: bool,
    /// Whether it is drawn as outline: it is seen and has nothing but background on one side at least; `false` throughout unless outlines
    /// were asked for. A drawing leaves out runs that are too short to read, see [`VisibleLines::without_specks`](super::VisibleLines::without_specks).
    pub is_outline: bool,
    /// On which sides it has nothing but background, on its right and on its left, seen from its first end.
    pub background: [bool; 2],
    /// Whether it is hidden and another line lies on it in the picture, a visible one or a hidden one of an earlier class: that one is
    /// drawn in its place. `false` throughout where lines are missing, see [`VisibleLines::undecided`](super::VisibleLines::undecided).
    pub is_covered: bool,
    /// Where it begins and ends in the picture: pixels from the upper left corner, y down. Pieces that meet at a vertex have
    /// bit for bit the same end there.
    pub ends_px: [DVec2; 2],
    /// The same ends in the world.
    pub ends_world: [DVec3; 2],
    /// The mesh edge it is part of: two vertices by their 0-based numbers in the file; `None` where faces intersect, and for form
    /// lines and smooth contours, which run through faces.
    pub edge: Option<[u32; 2]>,
    /// The angle between its two faces' normals, degrees; `None` for an edge without exactly two faces with area.
    pub angle_degrees: Option<f64>,
    /// The object in the scene.
    pub object: u32,
}

impl LineSegment {
    /// The layer it is drawn in.
    pub fn layer(&self) -> Layer {
        Layer::of(self.class, self.is_visible, self.is_outline)
    }
}
