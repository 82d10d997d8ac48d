//! Which other lines lie on one in the picture: mostly none, so that they are looked for once and not piece by piece.

use super::image::Image;
use super::visibility::{Lines, PARTS_OF_PICTURE};

/// Lines that lie on one somewhere.
pub(super) enum Beside {
    /// These.
    Few(Vec<usize>),
    /// So many that they are looked for where they matter.
    Many,
}

/// From how many on there are many.
const MANY: usize = 12;

impl Beside {
    pub(super) const NONE: Self = Self::Few(Vec::new());

    pub(super) fn are_none(&self) -> bool {
        matches!(self, Self::Few(lines) if lines.is_empty())
    }
}

impl Lines<'_> {
    /// The wanted lines that lie on one in what of it is between two places.
    pub(super) fn beside(&self, index: usize, image: &Image, inside: [f64; 2]) -> Beside {
        let touch_px = image.touch_px(self.space);
        let mut found: Vec<usize> = Vec::new();
        let mut are_many = false;
        for part in image.parts(inside, self.space.size.max_element() / PARTS_OF_PICTURE) {
            are_many |= self.any_beside(image, &Beside::Many, part, |other_index| {
                let Some(other) = self.images[other_index].filter(|_| other_index != index) else { return false };
                let lies_on_it = || image.overlap(&other, touch_px.max(other.touch_px(self.space))).is_some();
                if !found.contains(&other_index) && lies_on_it() {
                    found.push(other_index);
                }
                found.len() >= MANY
            });
            if are_many {
                return Beside::Many;
            }
        }
        Beside::Few(found)
    }

    /// Calls `visit` with each line that may lie on a part of one, perhaps several times, until it returns true; returns whether
    /// it did. Lines that lie on it have its direction.
    pub(super) fn any_beside(
        &self,
        image: &Image,
        beside: &Beside,
        part: [f64; 2],
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        match beside {
            Beside::Few(lines) => lines.iter().any(|line| visit(*line)),
            Beside::Many => {
                let touch_px = image.touch_px(self.space);
                let mut directions = image.directions(touch_px);
                directions.any(|directions| self.beside.any(&image.part_box(part, touch_px, directions), &mut visit))
            }
        }
    }
}
