//! Paints strokes: exact lines as pixels, antialiased, with round ends and joins.
//!
//! Takes [`Strokes`] from the lowest layer to the highest, and returns a [`Picture`] with colours multiplied by alpha, to lay
//! over another. A pixel's share of a stroke is the covered part of a pixel's width across the stroke: exact along a straight
//! line, approximate at ends and joins. Within a layer the largest share counts: strokes that cross or join do not add up.

use crate::lines::Strokes;
use crate::picture::Picture;
use crate::scene::{Color, Size};
use glam::DVec2;

/// Strokes on a transparent ground.
pub fn painted(strokes: &[Strokes], size: Size) -> Picture {
    let mut pixels = vec![0; size.pixel_count() * 4];
    let mut layer = Layer::new(size);
    for of_layer in strokes {
        for polyline in &of_layer.polylines {
            let points = &polyline.points_px;
            let closing = polyline.is_closed.then(|| points.last().zip(points.first())).flatten();
            let pairs = points.windows(2).map(|pair| (&pair[0], &pair[1])).chain(closing);
            pairs.for_each(|(a, b)| layer.stroke([*a, *b], of_layer.width_px * 0.5));
        }
        layer.blend_into(&mut pixels, of_layer.color, of_layer.opacity);
    }
    Picture { size, pixels }
}

/// A picture with ink over it; the picture alone if their sizes differ.
pub fn over(ink: &Picture, picture: &Picture) -> Picture {
    if ink.size != picture.size {
        return picture.clone();
    }
    let mut pixels = picture.pixels.clone();
    for (pixel, ink) in pixels.chunks_exact_mut(4).zip(ink.pixels.chunks_exact(4)).filter(|(_, ink)| ink[3] > 0) {
        let left = u32::from(u8::MAX - ink[3]);
        for (channel, ink) in pixel.iter_mut().zip(ink) {
            let behind = (u32::from(*channel) * left + 127) / 255;
            *channel = ink.saturating_add(behind as u8);
        }
    }
    Picture { size: picture.size, pixels }
}

/// How much of each pixel a layer's strokes cover.
struct Layer {
    size: Size,
    shares: Vec<f32>,
    /// Rows with strokes in them.
    is_used: Vec<bool>,
}

impl Layer {
    fn new(size: Size) -> Self {
        Self { size, shares: vec![0.0; size.pixel_count()], is_used: vec![false; size.height as usize] }
    }

    /// A straight stroke with round ends.
    fn stroke(&mut self, [a, b]: [DVec2; 2], radius: f64) {
        // Half a pixel beyond the stroke a pixel's middle is too far for its width to reach it.
        let reach = radius + 0.5;
        let along = b - a;
        let squared = along.length_squared();
        let rows = pixels(a.y.min(b.y) - reach, a.y.max(b.y) + reach, self.size.height);
        for row in rows {
            let y = row as f64 + 0.5;
            // The part of the stroke that is near enough to this row.
            let at = |y: f64| if along.y == 0.0 { 0.0 } else { ((y - a.y) / along.y).clamp(0.0, 1.0) };
            let [from, to] = if along.y == 0.0 { [0.0, 1.0] } else { [at(y - reach), at(y + reach)] };
            let [x, other] = [a.x + along.x * from, a.x + along.x * to];
            let start = row * self.size.width as usize;
            for column in pixels(x.min(other) - reach, x.max(other) + reach, self.size.width) {
                let point = DVec2::new(column as f64 + 0.5, y);
                let share = if squared == 0.0 { 0.0 } else { ((point - a).dot(along) / squared).clamp(0.0, 1.0) };
                let distance = point.distance(a + along * share);
                let covered = (distance + 0.5).min(radius) - (distance - 0.5).max(-radius);
                let covered = covered.clamp(0.0, 1.0) as f32;
                let pixel = &mut self.shares[start + column];
                *pixel = pixel.max(covered);
            }
            self.is_used[row] = true;
        }
    }

    /// Lays the layer over the pixels and empties it.
    fn blend_into(&mut self, pixels: &mut [u8], color: Color, opacity: f32) {
        let width = self.size.width as usize;
        let bytes = color.0.map(|channel| (channel * 255.0).round());
        let rows = pixels.chunks_exact_mut(width * 4).zip(self.shares.chunks_exact_mut(width));
        for ((row, shares), is_used) in rows.zip(&mut self.is_used) {
            if !std::mem::take(is_used) {
                continue;
            }
            for (pixel, share) in row.chunks_exact_mut(4).zip(shares) {
                let alpha = std::mem::take(share) * opacity;
                if alpha <= 0.0 {
                    continue;
                }
                for (index, channel) in pixel.iter_mut().enumerate() {
                    let ink = bytes.get(index).copied().unwrap_or(255.0);
                    *channel = (ink * alpha + f32::from(*channel) * (1.0 - alpha)).round() as u8;
                }
            }
        }
    }
}

/// The pixels that this range touches, of so many.
fn pixels(from: f64, to: f64, count: u32) -> std::ops::Range<usize> {
    let inside = |value: f64| value.clamp(0.0, f64::from(count)) as usize;
    inside(from.floor())..inside(to.ceil())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::lines::{Layer as LineLayer, Polyline};
    use std::f64::consts::PI;

    const SIZE: Size = Size { width: 100, height: 60 };

    fn strokes(points: &[[f64; 2]], width_px: f64, is_closed: bool) -> Strokes {
        let points_px = points.iter().map(|point| DVec2::from_array(*point)).collect();
        Strokes {
            layer: LineLayer::Visible(Class::Crease),
            color: Color([0.0; 3]),
            width_px,
            width_mm: None,
            opacity: 1.0,
            polylines: vec![Polyline { points_px, is_closed }],
        }
    }

    fn alpha(picture: &Picture, x: usize, y: usize) -> u8 {
        picture.pixels[(y * SIZE.width as usize + x) * 4 + 3]
    }

    /// Ink in all, pixels.
    fn area(picture: &Picture) -> f64 {
        picture.pixels.chunks_exact(4).map(|pixel| f64::from(pixel[3]) / 255.0).sum()
    }

    #[test]
    fn a_stroke_along_whole_rows_covers_these_and_no_other() {
        let picture = painted(&[strokes(&[[5.0, 20.0], [95.0, 20.0]], 2.0, false)], SIZE);
        assert!((6..94).all(|x| [19, 20].iter().all(|y| alpha(&picture, x, *y) == 255)));
        assert!((0..100).all(|x| [18, 21].iter().all(|y| alpha(&picture, x, *y) == 0)));
        // Half a pixel wide in the middle of a row: half of the row, no ink beside it.
        let thin = painted(&[strokes(&[[5.0, 20.5], [95.0, 20.5]], 0.5, false)], SIZE);
        assert_eq!([19, 20, 21].map(|y| alpha(&thin, 50, y)), [0, 128, 0]);
    }

    #[test]
    fn ink_is_as_much_as_the_strokes_area_whatever_their_direction_and_width() {
        for width in [0.7, 1.0, 2.0, 5.0] {
            for (dx, dy) in [(60.0, 0.0), (55.0, 13.3), (31.0, 40.0), (-60.0, 40.0), (0.0, 41.0)] {
                let a = if dx < 0.0 { [80.3, 8.7] } else { [10.3, 8.7] };
                let picture = painted(&[strokes(&[a, [a[0] + dx, a[1] + dy]], width, false)], SIZE);
                let expected = dx.hypot(dy) * width + PI * width * width / 4.0;
                let ratio = area(&picture) / expected;
                assert!((ratio - 1.0).abs() < 0.05, "{width} {dx},{dy}: {ratio}");
            }
        }
    }

    #[test]
    fn strokes_that_cross_or_close_do_not_add_up_and_opacity_is_the_layers() {
        let square = [[20.0, 10.0], [60.0, 10.0], [60.0, 50.0], [20.0, 50.0]];
        let open = painted(&[strokes(&square, 2.0, false)], SIZE);
        let closed = painted(&[strokes(&square, 2.0, true)], SIZE);
        // 40 pixels of two, without the quarter discs and squares of the ends.
        let added = area(&closed) - area(&open);
        assert!((added - (80.0 - 2.0 * (1.0 + PI / 4.0))).abs() < 0.5, "{added}");
        let mut twice = strokes(&square, 2.0, true);
        twice.polylines.extend(strokes(&square, 2.0, true).polylines);
        assert_eq!(painted(std::slice::from_ref(&twice), SIZE), closed);
        let faint = painted(&[Strokes { opacity: 0.3, ..twice }], SIZE);
        assert_eq!(faint.pixels.chunks_exact(4).map(|pixel| pixel[3]).max(), Some(77));
    }

    #[test]
    fn a_higher_layer_lies_over_a_lower_one_and_ink_over_a_picture() {
        let red = Strokes { color: Color([1.0, 0.0, 0.0]), ..strokes(&[[5.0, 20.0], [95.0, 20.0]], 4.0, false) };
        let black = strokes(&[[50.0, 5.0], [50.0, 55.0]], 2.0, false);
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

    #[test]
    fn strokes_that_leave_the_picture_are_cut_at_its_border() {
        let picture = painted(&[strokes(&[[-50.0, -20.0], [300.0, 90.0]], 3.0, false)], SIZE);
        assert!(area(&picture) > 50.0);
        assert_eq!(area(&painted(&[strokes(&[[-5.0, -9.0], [-7.0, 80.0]], 3.0, false)], SIZE)), 0.0);
    }
}
