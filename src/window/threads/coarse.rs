//! Drawings while the model moves, coarser than at rest if the user allows it.
//!
//! Takes a size; returns half its width and height, and a picture of the first size with each pixel twice as wide and high. The styles
//! are those of [`crate::styles::coarse`].

use crate::picture::Picture;
use crate::scene::Size;

/// The factor for width and height.
const DIVISOR: u32 = 2;

/// The size that is drawn.
pub(in crate::window) fn size(size: Size) -> Size {
    Size { width: size.width.div_ceil(DIVISOR), height: size.height.div_ceil(DIVISOR) }
}

/// A picture of this size from the one that was drawn.
pub(in crate::window) fn enlarged(picture: &Picture, size: Size) -> Picture {
    let row_bytes = picture.size.width as usize * 4;
    let mut pixels = Vec::with_capacity(size.pixel_count() * 4);
    for y in 0..size.height {
        let row = &picture.pixels[(y / DIVISOR) as usize * row_bytes..][..row_bytes];
        let start = pixels.len();
        row.chunks_exact(4).for_each(|pixel| (0..DIVISOR).for_each(|_| pixels.extend_from_slice(pixel)));
        pixels.truncate(start + size.width as usize * 4);
    }
    Picture { size, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pixel_is_two_by_two_and_an_odd_size_is_cut() {
        let large = Size { width: 5, height: 3 };
        let small = size(large);
        assert_eq!(small, Size { width: 3, height: 2 });
        let pixels = (1..=6).flat_map(|number| [number; 4]).collect();
        let picture = enlarged(&Picture { size: small, pixels }, large);
        let numbers: Vec<u8> = picture.pixels.chunks_exact(4).map(|pixel| pixel[0]).collect();
        assert_eq!(numbers, [1, 1, 2, 2, 3, 1, 1, 2, 2, 3, 4, 4, 5, 5, 6]);
        assert_eq!(picture.size, large);
    }
}
