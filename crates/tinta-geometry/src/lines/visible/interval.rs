//! A stretch of a line that is visible or hidden as a whole.

use crate::edges::Class;
use crate::lines::eye::image::Image;
use crate::lines::segment::LineSegment;
use glam::DVec3;

/// A stretch of a line that is visible or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Interval {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    /// Whether only background lies beside it: on the right and on the left, in its direction.
    pub background: [bool; 2],
}

impl Interval {
    /// Adds a stretch to those before it along a line; joins it to the last one if both meet and are alike.
    pub(in crate::lines) fn add_to(self, stretches: &mut Vec<Self>) {
        match stretches.last_mut() {
            Some(last)
                if last.to == self.from && (last.is_visible, last.background) == (self.is_visible, self.background) =>
            {
                last.to = self.to;
            }
            _ => stretches.push(self),
        }
    }

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
