//! A part of a line that is visible or hidden as a whole.

use crate::edges::Class;
use crate::lines::eye::image::Image;
use crate::lines::segment::LineSegment;
use glam::DVec3;

/// A part of a line that is visible or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Interval {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    /// Whether only background lies beside it: on the right and on the left, in its direction.
    pub background: [bool; 2],
}

impl Interval {
    /// The segment of a line's image, given its ends in the world.
    pub(in crate::lines) fn segment(&self, class: Class, image: &Image, ends_world: [DVec3; 2]) -> LineSegment {
        LineSegment {
            is_visible: self.is_visible,
            is_outline: self.background != [false; 2],
            background: self.background,
            ..LineSegment::new(class, [self.from, self.to].map(|place| image.at(place)), ends_world)
        }
    }
}
