//! Drawings while the model moves, coarser than at rest if the user allows it.
//!
//! Takes a style and a size; returns a faster style with nearly the same picture, at half the width and height, and a picture of
//! the first size with each pixel twice as wide and high.

use crate::picture::Picture;
use crate::scene::Size;
use crate::settings::HasSettings;
use crate::styles::{Style, StyleName};

/// The factor for width and height.
const DIVISOR: u32 = 2;

/// The size that is drawn.
pub(in crate::window) fn size(size: Size) -> Size {
    Size { width: size.width.div_ceil(DIVISOR), height: size.height.div_ceil(DIVISOR) }
}

/// The style that is drawn: without the faces that look away, without larger pictures to shrink, and the three passes' picture
/// by `mrt`, with one pass over the geometry.
pub(in crate::window) fn style(style: &Style) -> Style {
    let of_mrt = || Style::with_options(StyleName::Mrt, &style.to_options().ok()?).ok();
    let mut coarse = match style.style_name() {
        StyleName::ThreePass => of_mrt().unwrap_or_else(|| style.clone()),
        _ => style.clone(),
    };
    for (name, value) in [("cull", "back"), ("supersample", "1")] {
        if let Some(setting) = Style::table().find(&coarse, name) {
            let mut changed = coarse.clone();
            // Where it cannot be coarser it does not change.
            if setting.set(&mut changed, value).is_ok() {
                coarse = changed;
            }
        }
    }
    coarse
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

    #[test]
    fn every_style_has_a_coarse_form_and_the_three_passes_are_drawn_at_once() {
        for (name, of) in StyleName::of_passes() {
            let coarse = style(&Style::named(of));
            let is_other = of == StyleName::ThreePass;
            assert_eq!(coarse.name(), if is_other { "mrt" } else { name });
            assert_eq!(style(&coarse), coarse, "{name}");
        }
        let mut tones = Style::named(StyleName::ThreePass);
        Style::table().find(&tones, "tones").unwrap().set(&mut tones, "2").unwrap();
        let Style::Mrt(mrt) = style(&tones) else { panic!("mrt") };
        assert_eq!((mrt.tones.count, mrt.cull_back_faces), (2, true));
    }
}
