//! A picture to paint rectangles, pictures, segments and text into. The one file that sets text into pictures: DejaVu, which is in the
//! program, with antialiased outlines.

use ab_glyph::{Font as _, FontRef, PxScale, ScaleFont, point};
use glam::DVec2;
use tinta::picture::Picture;
use tinta::scene::Size;

/// Paper, frames, text and lesser text.
pub(crate) const BACKGROUND: [u8; 4] = [255; 4];
pub(crate) const FRAME: [u8; 4] = [200, 200, 200, 255];
pub(crate) const TEXT: [u8; 3] = [28, 28, 30];
pub(crate) const SOFT: [u8; 3] = [92, 92, 99];

/// One size of a font.
pub(crate) struct Face {
    /// `None` were the font broken; then texts are left out.
    font: Option<FontRef<'static>>,
    scale: PxScale,
}

impl Face {
    /// The font in this size, pixels of its em.
    pub(crate) fn new(file: &'static [u8], em_px: f32) -> Self {
        let font = FontRef::try_from_slice(file).ok();
        // ab_glyph's scale is that of a line's height.
        let lines_a_em = font.as_ref().and_then(|font| Some(font.height_unscaled() / font.units_per_em()?));
        Self { font, scale: PxScale::from(em_px * lines_a_em.unwrap_or(1.0)) }
    }

    /// Height of a line, pixels.
    pub(crate) fn height(&self) -> u32 {
        self.scale.y.ceil() as u32
    }

    /// Width of a text, pixels.
    pub(crate) fn width(&self, text: &str) -> u32 {
        self.places(text).1.ceil() as u32
    }

    /// The glyphs of a text, each with its distance from the left, and the width of all.
    fn places(&self, text: &str) -> (Vec<(ab_glyph::GlyphId, f32)>, f32) {
        let Some(font) = &self.font else { return (Vec::new(), 0.0) };
        let font = font.as_scaled(self.scale);
        let (mut left, mut places): (f32, Vec<(ab_glyph::GlyphId, f32)>) = (0.0, Vec::new());
        for character in text.chars() {
            let known = font.glyph_id(character);
            let glyph = if known.0 == 0 { font.glyph_id('?') } else { known };
            left += places.last().map_or(0.0, |(before, _)| font.kern(*before, glyph));
            places.push((glyph, left));
            left += font.h_advance(glyph);
        }
        (places, left)
    }
}

/// A picture that is painted.
pub(crate) struct Canvas {
    pub(crate) picture: Picture,
}

impl Canvas {
    /// A blank one.
    pub(crate) fn new(size: Size) -> Self {
        Self { picture: Picture { size, pixels: BACKGROUND.repeat(size.pixel_count()) } }
    }

    /// Makes it this high, if it is less.
    pub(crate) fn reach(&mut self, height: u32) {
        let Size { width, height: before } = self.picture.size;
        let size = Size { width, height: height.max(before) };
        let rows = Size { width, height: size.height - before };
        self.picture.pixels.extend(BACKGROUND.repeat(rows.pixel_count()));
        self.picture.size = size;
    }

    fn set(&mut self, x: u32, y: u32, pixel: [u8; 4]) {
        let Size { width, height } = self.picture.size;
        if x < width && y < height {
            let start = (y as usize * width as usize + x as usize) * 4;
            self.picture.pixels[start..start + 4].copy_from_slice(&pixel);
        }
    }

    /// Fills a rectangle.
    pub(crate) fn fill(&mut self, left: u32, top: u32, size: Size, pixel: [u8; 4]) {
        for y in top..top + size.height {
            (left..left + size.width).for_each(|x| self.set(x, y, pixel));
        }
    }

    /// Outlines a rectangle, inside of it.
    pub(crate) fn outline(&mut self, left: u32, top: u32, size: Size, thickness: u32, pixel: [u8; 4]) {
        let Size { width, height } = size;
        let (across, down) = (Size { width, height: thickness }, Size { width: thickness, height });
        let (right, bottom) = ((left + width).saturating_sub(thickness), (top + height).saturating_sub(thickness));
        for (left, top, size) in [(left, top, across), (left, bottom, across), (left, top, down), (right, top, down)] {
            self.fill(left, top, size, pixel);
        }
    }

    /// Draws a segment, antialiased, within a rectangle given by its corner and size.
    pub(crate) fn segment(
        &mut self,
        [from, to]: [DVec2; 2],
        thickness: f64,
        color: [u8; 3],
        ([left, top], size): ([u32; 2], Size),
    ) {
        let along = to - from;
        let reach = thickness * 0.5 + 1.0;
        let bounds = |axis: usize, first: u32, count: u32| {
            let (low, high) = (from[axis].min(to[axis]) - reach, from[axis].max(to[axis]) + reach);
            let (first, end) = (f64::from(first), f64::from(first + count));
            (low.clamp(first, end) as u32)..(high.ceil().clamp(first, end) as u32)
        };
        for y in bounds(1, top, size.height) {
            for x in bounds(0, left, size.width) {
                let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let length = along.length_squared();
                let share = if length == 0.0 { 0.0 } else { ((place - from).dot(along) / length).clamp(0.0, 1.0) };
                let distance = place.distance(from + along * share);
                let cover = (thickness * 0.5 + 0.5 - distance).clamp(0.0, 1.0);
                self.ink(x, y, color, cover as f32);
            }
        }
    }

    /// A transparent picture shows the sheet's background.
    pub(crate) fn paste(&mut self, left: u32, top: u32, picture: &Picture) {
        for y in 0..picture.size.height {
            for x in 0..picture.size.width {
                let [red, green, blue, alpha] = picture.pixel(x.into(), y.into());
                let over = |channel: u8| (255 - (255 - u32::from(channel)) * u32::from(alpha) / 255) as u8;
                self.set(left + x, top + y, [over(red), over(green), over(blue), u8::MAX]);
            }
        }
    }

    /// Lays ink of this share over a pixel.
    fn ink(&mut self, x: u32, y: u32, [red, green, blue]: [u8; 3], share: f32) {
        let behind = self.picture.pixel(x.into(), y.into());
        let mixed = |ink: u8, channel: usize| {
            (f32::from(ink) * share + f32::from(behind[channel]) * (1.0 - share)).round() as u8
        };
        self.set(x, y, [mixed(red, 0), mixed(green, 1), mixed(blue, 2), u8::MAX]);
    }

    /// Writes a line of text; letters missing in the font become a question mark.
    pub(crate) fn write(&mut self, left: u32, top: u32, text: &str, face: &Face, ink: [u8; 3]) {
        let Some(font) = &face.font else { return };
        let baseline = top as f32 + font.as_scaled(face.scale).ascent().round();
        for (glyph, place) in face.places(text).0 {
            let at = glyph.with_scale_and_position(face.scale, point(left as f32 + place, baseline));
            let Some(outline) = font.outline_glyph(at) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, share| {
                let [x, y] = [corner.x + x as f32, corner.y + y as f32];
                if x >= 0.0 && y >= 0.0 {
                    self.ink(x as u32, y as u32, ink, share.min(1.0));
                }
            });
        }
    }
}

/// A picture made to fit into a square, and its scale: each pixel is the mean of those that it covers.
pub(crate) fn fitted(picture: &Picture, side: u32) -> (Picture, f64) {
    let Size { width, height } = picture.size;
    let scale = f64::from(side) / f64::from(width.max(height));
    let scaled = |count: u32| ((f64::from(count) * scale).round() as u32).max(1);
    let size = Size { width: scaled(width), height: scaled(height) };
    let range = |at: u32, count: u32| {
        let first = ((f64::from(at) / scale) as u32).min(count - 1);
        first..((f64::from(at + 1) / scale) as u32).clamp(first + 1, count)
    };
    let mut pixels = Vec::with_capacity(size.pixel_count() * 4);
    for y in 0..size.height {
        for x in 0..size.width {
            let (columns, rows) = (range(x, width), range(y, height));
            let count = (columns.len() * rows.len()) as u32;
            let mut sums = [0_u32; 4];
            for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
                let pixel = picture.pixel(column.into(), row.into());
                sums.iter_mut().zip(pixel).for_each(|(sum, channel)| *sum += u32::from(channel));
            }
            pixels.extend(sums.map(|sum| ((sum + count / 2) / count) as u8));
        }
    }
    (Picture { size, pixels }, scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_picture_keeps_its_shape_and_its_mean_colour() {
        for (width, height) in [(512, 512), (1000, 300), (7, 20), (1, 1), (368, 368)] {
            let size = Size { width, height };
            let pixels: Vec<u8> = (0..size.pixel_count()).flat_map(|place| [(place * 37 % 251) as u8; 4]).collect();
            let picture = Picture { size, pixels };
            let (small, scale) = fitted(&picture, 368);
            assert_eq!(small.size.width.max(small.size.height), 368);
            assert!((f64::from(small.size.width) - f64::from(width) * scale).abs() <= 0.5, "{size}");
            let mean = |picture: &Picture| {
                picture.pixels.iter().map(|byte| f64::from(*byte)).sum::<f64>() / picture.pixels.len() as f64
            };
            assert!((mean(&small) - mean(&picture)).abs() < 3.0, "{size}: {} {}", mean(&small), mean(&picture));
        }
    }

    #[test]
    fn a_text_is_as_wide_as_its_letters_and_every_letter_is_in_the_font_or_a_question_mark() {
        let face = Face::new(dejavu::sans::regular(), 16.0);
        assert!(face.font.is_some());
        assert_eq!(face.width(""), 0);
        let [one, two] = ["n", "nn"].map(|text| face.places(text).1);
        assert!((two - 2.0 * one).abs() < 1e-3, "{one} {two}");
        assert!(face.places("AV").1 < face.places("A").1 + face.places("V").1, "what leans together is closer");
        assert_eq!(face.places("\u{10ffff}"), face.places("?"));
        // An em of 16 pixels: DejaVu's x is 1120 of 2048 units high.
        let size = Size { width: 40, height: 40 };
        let mut canvas = Canvas::new(size);
        canvas.write(4, 4, "x", &face, [0; 3]);
        let has_ink = |y: u32| (0..40).any(|x| canvas.picture.pixel(x, y.into())[0] < 128);
        let rows: Vec<u32> = (0..40).filter(|y| has_ink(*y)).collect();
        assert!(rows.len() == 9 || rows.len() == 8, "8.75 pixels: {rows:?}");
    }

    #[test]
    fn a_segment_covers_its_length_times_its_thickness_and_stays_within_its_rectangle() {
        let size = Size { width: 60, height: 60 };
        let darkness = |ends: [[f64; 2]; 2], within| {
            let mut canvas = Canvas::new(size);
            canvas.segment(ends.map(DVec2::from), 3.0, [0; 3], within);
            canvas.picture.pixels.chunks_exact(4).map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).sum::<f64>()
        };
        let all = ([0, 0], size);
        for (ends, length) in [([[10.0, 20.0], [50.0, 20.0]], 40.0), ([[10.0, 10.0], [40.0, 50.0]], 50.0)] {
            let expected = 3.0 * length + std::f64::consts::PI * 1.5 * 1.5;
            assert!((darkness(ends, all) / expected - 1.0).abs() < 0.03, "{ends:?}");
        }
        let right = ([30, 0], Size { width: 30, height: 60 });
        let half = darkness([[10.0, 20.0], [50.0, 20.0]], right);
        assert!((half - (60.0 + std::f64::consts::PI * 1.125)).abs() < 2.0, "{half}");
        assert_eq!(darkness([[-90.0, -5.0], [-10.0, -5.0]], all), 0.0);
    }
}
