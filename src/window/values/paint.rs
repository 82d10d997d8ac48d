//! Exact lines as a picture to lay over another.

use crate::lines::{Raster, Strokes, raster_of_strokes};
use crate::picture::Picture;
use crate::scene::{Background, Size};

/// Strokes on a transparent ground.
pub fn painted(strokes: &[Strokes], size: Size) -> Picture {
    let Raster { size, pixels } = raster_of_strokes(strokes, size, Background::Transparent);
    Picture { size, pixels }
}

/// A picture with ink over it; the picture alone if their sizes differ.
pub fn over(ink: &Picture, picture: &Picture) -> Picture {
    if ink.size != picture.size {
        return picture.clone();
    }
    let mut pixels = picture.pixels.clone();
    for (pixel, ink) in pixels.chunks_exact_mut(4).zip(ink.pixels.chunks_exact(4)).filter(|(_, ink)| ink[3] > 0) {
        let [opacity, below] = [ink[3], pixel[3]].map(f32::from);
        let below = below * (1.0 - opacity / 255.0);
        let alpha = opacity + below;
        for (channel, ink) in pixel.iter_mut().zip(&ink[..3]) {
            *channel = ((f32::from(*ink) * opacity + f32::from(*channel) * below) / alpha).round() as u8;
        }
        pixel[3] = alpha.round() as u8;
    }
    Picture { size: picture.size, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::lines::{Layer, Polyline};
    use crate::scene::Color;
    use glam::DVec2;

    const SIZE: Size = Size { width: 100, height: 60 };

    #[test]
    fn a_higher_layer_lies_over_a_lower_one_and_ink_over_a_picture() {
        let stroke = |color: [f32; 3], ends: [[f64; 2]; 2], width_px: f64| Strokes {
            layer: Layer::Visible(Class::Crease),
            color: Color(color),
            width_px,
            width_mm: None,
            opacity: 1.0,
            polylines: vec![Polyline { points_px: ends.map(DVec2::from_array).to_vec(), is_closed: false }],
        };
        let red = stroke([1.0, 0.0, 0.0], [[5.0, 20.0], [95.0, 20.0]], 4.0);
        let black = stroke([0.0; 3], [[50.0, 5.0], [50.0, 55.0]], 2.0);
        let ink = painted(&[red, black], SIZE);
        let white = Picture { size: SIZE, pixels: vec![255; SIZE.pixel_count() * 4] };
        let shown = over(&ink, &white);
        let pixel = |x: usize, y: usize| shown.pixels[(y * 100 + x) * 4..][..4].to_vec();
        assert_eq!(pixel(30, 20), [255, 0, 0, 255]);
        assert_eq!(pixel(50, 20), [0, 0, 0, 255]);
        assert_eq!(pixel(30, 40), [255; 4]);
        let small = Picture { size: Size { width: 1, height: 1 }, pixels: vec![9; 4] };
        assert_eq!(over(&ink, &small), small);
    }
}
