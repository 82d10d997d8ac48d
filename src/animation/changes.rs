//! The changed part of a picture that an animation has to store.

use crate::scene::Size;

/// A part of a picture, pixels from the left and the top; at least one pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rectangle {
    pub left: u32,
    pub top: u32,
    pub size: Size,
}

impl Rectangle {
    /// Returns the smallest rectangle around all pixels, by index, for which `is_wanted` is true; one pixel if none matches.
    pub(super) fn around(size: Size, is_wanted: impl Fn(usize) -> bool) -> Self {
        let width = size.width as usize;
        let (mut left, mut right, mut top, mut bottom) = (width, 0, None, 0);
        for y in 0..size.height as usize {
            let wanted = |x: &usize| is_wanted(y * width + x);
            let Some(first) = (0..width).find(wanted) else { continue };
            left = left.min(first);
            right = (right.max(first)..width).rfind(wanted).unwrap_or(first).max(right);
            top.get_or_insert(y);
            bottom = y;
        }
        let Some(top) = top else { return Self { left: 0, top: 0, size: Size { width: 1, height: 1 } } };
        let size = Size { width: (right - left + 1) as u32, height: (bottom - top + 1) as u32 };
        Self { left: left as u32, top: top as u32, size }
    }

    /// The whole picture.
    pub(super) fn whole(size: Size) -> Self {
        Self { left: 0, top: 0, size }
    }

    /// Returns the rectangle of changes from one picture's RGBA pixels to another's of the same size.
    pub(super) fn changed(size: Size, before: &[u8], after: &[u8]) -> Self {
        Self::around(size, |index| before[index * 4..][..4] != after[index * 4..][..4])
    }

    /// Returns its rows as ranges of pixel indices in a picture of this width.
    pub(super) fn rows(self, width: u32) -> impl Iterator<Item = std::ops::Range<usize>> {
        (0..self.size.height as usize).map(move |row| {
            let start = (self.top as usize + row) * width as usize + self.left as usize;
            start..start + self.size.width as usize
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rectangle_is_as_small_as_can_be() {
        let size = Size { width: 7, height: 5 };
        for a in 0..35usize {
            for b in 0..35usize {
                let found = Rectangle::around(size, |index| index == a || index == b);
                let (x, y) = ([a % 7, b % 7], [a / 7, b / 7]);
                let expected = Rectangle {
                    left: x[0].min(x[1]) as u32,
                    top: y[0].min(y[1]) as u32,
                    size: Size { width: x[0].abs_diff(x[1]) as u32 + 1, height: y[0].abs_diff(y[1]) as u32 + 1 },
                };
                assert_eq!(found, expected);
                assert_eq!(
                    found.rows(7).flatten().filter(|index| [a, b].contains(index)).count(),
                    1 + usize::from(a != b)
                );
            }
        }
    }

    #[test]
    fn nothing_wanted_is_one_pixel_and_everything_the_whole() {
        let size = Size { width: 3, height: 2 };
        assert_eq!(Rectangle::around(size, |_| false).size, Size { width: 1, height: 1 });
        assert_eq!(Rectangle::around(size, |_| true), Rectangle::whole(size));
        assert_eq!(Rectangle::changed(size, &[1; 24], &[1; 24]).size, Size { width: 1, height: 1 });
    }
}
