//! A segment of a line.

use crate::edges::Class;
use crate::lines::drawing::layers::Layer;
use glam::{DVec2, DVec3};

/// A segment of a line: it has one class, and is visible or hidden as a whole.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LineSegment {
    /// Its class; if it has several, the first in the order of [`Class::ALL`].
    pub class: Class,
    /// Whether it is visible.
    pub is_visible: bool,
    /// Whether it belongs to the outline: it is visible, and on at least one side there is only background. Always
    /// `false` unless [`LineSettings::finds_outline`](super::LineSettings::finds_outline) is set. A drawing drops
    /// runs too short to read, see [`VisibleLines::without_specks`](super::VisibleLines::without_specks).
    pub is_outline: bool,
    /// Whether there is only background on its right and on its left, looking from its first end to its second.
    pub background: [bool; 2],
    /// Whether it is hidden, a ghost's or a stroke of a cut, and overlapped in the picture by a line drawn in its place: a hidden line by
    /// a visible one or one of an earlier class, a ghost's by a solid part's or another ghost's, a stroke by any or another stroke.
    pub is_covered: bool,
    /// Its ends in the picture: pixels from the upper left corner, y down. Segments that meet at a vertex have
    /// bit-identical ends there. Both ends of a point are the same.
    pub ends_px: [DVec2; 2],
    /// Its ends in world coordinates.
    pub ends_world: [DVec3; 2],
    /// The mesh edge or the segment of a curve that it lies on, as two 0-based vertex numbers of the file; for a point
    /// the same number twice. `None` for intersections, form lines and smooth contours, which run through faces.
    pub edge: Option<[u32; 2]>,
    /// The angle between the normals of its two faces, degrees; `None` for an edge without exactly two faces of
    /// non-zero area.
    pub angle_degrees: Option<f64>,
    /// The number of its object in the scene.
    pub object: u32,
    /// The number of its part in [`VisibleLines::parts`](super::VisibleLines::parts).
    pub part: u32,
    /// The number of its style in [`VisibleLines::looks`](super::VisibleLines::looks).
    pub look: u32,
}

impl LineSegment {
    /// A visible line of the first object, with nothing else known of it.
    pub(in crate::lines) fn new(class: Class, ends_px: [DVec2; 2], ends_world: [DVec3; 2]) -> Self {
        Self { class, is_visible: true, ends_px, ends_world, ..Self::default() }
    }

    /// The layer that draws it.
    pub(crate) fn layer(&self) -> Layer {
        Layer::of(self.class, self.is_visible, self.is_outline)
    }
}
