//! Compares the lines of two drawings: drawn by both, or by only one.
//!
//! Takes two pictures of lines alone (dark on light, or ink by its alpha); returns counts and a map of agreement. A pixel of ink
//! counts as drawn by both if the other drawing has ink within a tolerance: lines of different width or half a pixel apart look
//! the same.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta_lab::compare::{Agreement, InkMask};
//! use tinta::{Picture, Size};
//!
//! let size = Size { width: 3, height: 1 };
//! let [ink, paper] = [[0, 0, 0, 255], [255; 4]];
//! let lines = |pixels: [[u8; 4]; 3]| InkMask::of(&Picture { size, pixels: pixels.concat() });
//! let both = Agreement::of(&lines([ink, paper, paper]), &lines([paper, ink, paper]), 1);
//! // A pixel beside is the same line within a tolerance of one pixel.
//! assert_eq!(both.map(|both| both.numbers.only_left_px), Some(0));
//! # Ok(())
//! # }
//! ```

use glam::DVec2;
use serde::Serialize;
use tinta::picture::Picture;
use tinta::pixel::INK_FROM;
use tinta::scene::Size;

/// The ink pixels of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InkMask {
    /// The picture's size.
    pub size: Size,
    /// Row by row from the top.
    pub ink: Vec<bool>,
}

impl InkMask {
    /// Pixels covered by at least a quarter of ink, to include faint lines: on white by the pixel's largest difference from white
    /// in any channel, on a transparent ground by its alpha.
    pub fn of(lines: &Picture) -> Self {
        let is_transparent = lines.pixels.chunks_exact(4).any(|pixel| pixel[3] < u8::MAX);
        let is_ink = |pixel: &[u8]| match is_transparent {
            true => pixel[3] >= INK_FROM,
            false => u8::MAX - pixel[..3].iter().copied().min().unwrap_or_default() >= INK_FROM,
        };
        Self { size: lines.size, ink: lines.pixels.chunks_exact(4).map(is_ink).collect() }
    }

    /// A mask of these pixels' darkness, of 255, row by row from the top: ink is at least a quarter dark.
    pub(crate) fn of_darkness(size: Size, darkness: &[u8]) -> Self {
        Self::of_darkness_from(size, darkness, INK_FROM)
    }

    /// The same, with another least darkness of ink.
    pub(crate) fn of_darkness_from(size: Size, darkness: &[u8], from: u8) -> Self {
        Self { size, ink: darkness.iter().map(|darkness| *darkness >= from).collect() }
    }

    /// The ink of the pixels whose middles satisfy a condition.
    #[must_use]
    pub(crate) fn kept(mut self, holds: impl Fn(DVec2) -> bool) -> Self {
        let width = self.size.width as usize;
        for (index, ink) in self.ink.iter_mut().enumerate().filter(|(_, ink)| **ink) {
            *ink = holds(DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5));
        }
        self
    }

    /// The ink that another mask of the same size has too.
    #[must_use]
    pub(crate) fn and(mut self, other: &Self) -> Self {
        self.ink.iter_mut().zip(&other.ink).for_each(|(ink, other)| *ink &= *other);
        self
    }

    /// The pixels that contain points, given from the upper left corner, y down; points outside the picture are left out.
    pub(crate) fn of_points(size: Size, points: impl Iterator<Item = DVec2>) -> Self {
        let mut ink = vec![false; size.pixel_count()];
        for point in points {
            let (x, y) = (point.x.floor(), point.y.floor());
            if x >= 0.0 && y >= 0.0 && x < f64::from(size.width) && y < f64::from(size.height) {
                ink[y as usize * size.width as usize + x as usize] = true;
            }
        }
        Self { size, ink }
    }

    /// Number of pixels that are ink in one and not in the other.
    pub(crate) fn differing(&self, other: &Self) -> usize {
        self.ink.iter().zip(&other.ink).filter(|(ink, other)| ink != other).count()
    }

    /// Number of pixels with ink.
    pub fn count(&self) -> usize {
        self.ink.iter().filter(|ink| **ink).count()
    }

    /// Number of ink pixels without ink of the other picture, of the same size, within `radius_px`: ink that did not merely move.
    pub(crate) fn count_far_from(&self, other: &Self, radius_px: u32) -> usize {
        self.ink.iter().zip(other.grown(radius_px)).filter(|(ink, near)| **ink && !near).count()
    }

    /// The pixels whose middle lies within `radius_px` of the middle of a pixel with ink.
    fn grown(&self, radius_px: u32) -> Vec<bool> {
        let radius = i64::from(radius_px);
        let disc: Vec<(i64, i64)> = (-radius..=radius)
            .flat_map(|y| (-radius..=radius).map(move |x| (x, y)))
            .filter(|(x, y)| x * x + y * y <= radius * radius)
            .collect();
        let (width, height) = (i64::from(self.size.width), i64::from(self.size.height));
        let mut grown = vec![false; self.ink.len()];
        for (index, _) in self.ink.iter().enumerate().filter(|(_, ink)| **ink) {
            let (x, y) = (index as i64 % width, index as i64 / width);
            for (dx, dy) in &disc {
                let (x, y) = (x + dx, y + dy);
                if (0..width).contains(&x) && (0..height).contains(&y) {
                    grown[(y * width + x) as usize] = true;
                }
            }
        }
        grown
    }
}

/// Who drew a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnBy {
    /// Neither of them.
    Neither,
    /// One has ink here, the other within the tolerance.
    Both,
    /// Only the left drawing.
    Left,
    /// Only the right drawing.
    Right,
}

/// How far two drawings' lines agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Each pixel, row by row from the top.
    pub pixels: Vec<DrawnBy>,
    /// The counts.
    pub numbers: AgreementNumbers,
}

/// The number of ink pixels, and of those that the other drawing shares.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AgreementNumbers {
    /// Distance within which ink counts as the same, pixels.
    pub tolerance_px: u32,
    /// Ink of the left drawing.
    pub left_px: usize,
    /// Ink of the right drawing.
    pub right_px: usize,
    /// Ink of the left drawing without ink of the right one near it.
    pub only_left_px: usize,
    /// Ink of the right drawing without ink of the left one near it.
    pub only_right_px: usize,
    /// Share of the left drawing's ink that the right one has too, 0 to 1; `None` without ink.
    pub left_shared: Option<f64>,
    /// Share of the right drawing's ink that the left one has too.
    pub right_shared: Option<f64>,
}

impl Agreement {
    /// Compares two masks of one size; `None` if they are not.
    pub fn of(left: &InkMask, right: &InkMask, tolerance_px: u32) -> Option<Self> {
        if left.size != right.size {
            return None;
        }
        let (near_left, near_right) = (left.grown(tolerance_px), right.grown(tolerance_px));
        let drawn = |index: usize| match (left.ink[index], right.ink[index]) {
            (false, false) => DrawnBy::Neither,
            (true, true) => DrawnBy::Both,
            (true, false) if near_right[index] => DrawnBy::Both,
            (false, true) if near_left[index] => DrawnBy::Both,
            (true, false) => DrawnBy::Left,
            (false, true) => DrawnBy::Right,
        };
        let pixels: Vec<DrawnBy> = (0..left.ink.len()).map(drawn).collect();
        let count = |wanted| pixels.iter().filter(|drawn| **drawn == wanted).count();
        let (left_px, right_px) = (left.count(), right.count());
        let (only_left_px, only_right_px) = (count(DrawnBy::Left), count(DrawnBy::Right));
        let shared = |all: usize, only: usize| (all > 0).then(|| 1.0 - only as f64 / all as f64);
        let numbers = AgreementNumbers {
            tolerance_px,
            left_px,
            right_px,
            only_left_px,
            only_right_px,
            left_shared: shared(left_px, only_left_px),
            right_shared: shared(right_px, only_right_px),
        };
        Some(Self { pixels, numbers })
    }

    /// The map in colours, on white.
    pub fn picture(&self, size: Size) -> Picture {
        let color = |drawn: &DrawnBy| match drawn {
            DrawnBy::Neither => [255; 3],
            DrawnBy::Both => BOTH_COLOR,
            DrawnBy::Left => LEFT_COLOR,
            DrawnBy::Right => RIGHT_COLOR,
        };
        let pixels = self.pixels.iter().map(color).flat_map(|[red, green, blue]| [red, green, blue, u8::MAX]);
        Picture { size, pixels: pixels.collect() }
    }
}

/// Ink of both drawings: dark grey. Colour-blind eyes can distinguish the three colours (Okabe and Ito).
pub(crate) const BOTH_COLOR: [u8; 3] = [60, 60, 60];
/// Ink that only the left drawing has: vermilion.
pub(crate) const LEFT_COLOR: [u8; 3] = [213, 94, 0];
/// Ink that only the right drawing has: blue.
pub(crate) const RIGHT_COLOR: [u8; 3] = [0, 114, 178];

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size { width: 20, height: 10 };

    /// Vertical lines at these columns.
    fn lines(columns: &[u32]) -> Picture {
        let pixels = (0..SIZE.height).flat_map(|_| 0..SIZE.width).flat_map(|x| {
            let grey = if columns.contains(&x) { 0 } else { 255 };
            [grey, grey, grey, 255]
        });
        Picture { size: SIZE, pixels: pixels.collect() }
    }

    fn agreement(left: &[u32], right: &[u32], tolerance_px: u32) -> AgreementNumbers {
        Agreement::of(&InkMask::of(&lines(left)), &InkMask::of(&lines(right)), tolerance_px).unwrap().numbers
    }

    #[test]
    fn lines_within_the_tolerance_are_the_same_and_others_are_not() {
        let numbers = agreement(&[3, 10], &[5, 17], 2);
        assert_eq!((numbers.left_px, numbers.right_px), (20, 20));
        assert_eq!((numbers.only_left_px, numbers.only_right_px), (10, 10));
        assert_eq!((numbers.left_shared, numbers.right_shared), (Some(0.5), Some(0.5)));
        assert_eq!(agreement(&[3, 10], &[5, 17], 1).left_shared, Some(0.0));
        assert_eq!(agreement(&[3, 10], &[3, 10], 0).left_shared, Some(1.0));
        assert_eq!(agreement(&[], &[3], 2).left_shared, None);
    }

    #[test]
    fn the_map_colours_each_kind() {
        let agreement = Agreement::of(&InkMask::of(&lines(&[3, 10])), &InkMask::of(&lines(&[3, 17])), 2).unwrap();
        let picture = agreement.picture(SIZE);
        let at = |x| picture.pixel(x, 5);
        assert_eq!(
            [at(3), at(10), at(17), at(0)].map(|[r, g, b, _]| [r, g, b]),
            [BOTH_COLOR, LEFT_COLOR, RIGHT_COLOR, [255; 3]]
        );
        let narrow = InkMask { size: Size { width: 1, height: 1 }, ink: vec![true] };
        assert_eq!(Agreement::of(&narrow, &InkMask::of(&lines(&[])), 1), None);
    }

    #[test]
    fn ink_on_nothing_counts_by_its_alpha() {
        let mut picture = lines(&[3]);
        picture.pixels.chunks_exact_mut(4).for_each(|pixel| pixel.copy_from_slice(&[0, 0, 0, 0]));
        picture.pixels[3] = 255;
        picture.pixels[7] = 60;
        assert_eq!(InkMask::of(&picture).count(), 1);
    }
}
