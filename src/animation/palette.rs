//! The colours of a GIF's frames, at most 256.
//!
//! Pictures with that few colours are stored exactly. Others get the colours they need most, and mix the rest from two of them in
//! a pattern that stays fixed on the screen. One palette serves frame after frame until it fits one too badly, because a new
//! palette for each frame would make tones flicker.

use super::quantize::{Histogram, Mix, PackedColor, choose, distance, mix};
use std::collections::HashMap;

/// The index of the transparent colour in pictures with holes. It is the first, so added colours do not move it.
pub(super) const TRANSPARENT: u8 = 0;

pub(super) struct Palette {
    transparent: bool,
    /// The table, including the transparent entry.
    colors: Vec<PackedColor>,
    /// All colours found while this table was in use.
    known: HashMap<PackedColor, Mix>,
    is_exact: bool,
    /// Mean square error of the picture that the table was made for.
    error: f64,
}

/// A table is kept while a picture's mean square error is at most this many times that of the picture it was made for …
const WORSE: f64 = 1.5;

/// … or not more than this, a difference of one step in one colour.
const UNSEEN: f64 = 1.0;

/// A colour that covers this share of the picture is a flat tone, which must not be mixed.
const FLAT_SHARE: f64 = 1.0 / 64.0;

/// Most colours remembered; a new table forgets them.
const MOST_KNOWN: usize = 1 << 20;

impl Palette {
    pub(super) fn new(transparent: bool) -> Self {
        let colors = vec![0; usize::from(transparent)];
        Self { transparent, colors, known: HashMap::default(), is_exact: true, error: 0.0 }
    }

    /// Forgets all colours except the transparent entry.
    fn clear(&mut self) {
        *self = Self::new(self.transparent);
    }

    /// Adapts the palette to these RGBA pixels; those with alpha 0 are ignored.
    pub(super) fn fit(&mut self, pixels: &[u8]) {
        let histogram = histogram(pixels);
        let room = 256 - usize::from(self.transparent);
        let new = histogram.iter().filter(|(color, _)| !self.known.contains_key(color)).count();
        if self.is_exact && self.colors.len() + new <= 256 {
            self.add_exactly(&histogram);
        } else if histogram.len() <= room {
            self.clear();
            self.add_exactly(&histogram);
        } else if self.is_exact || self.known.len() + new > MOST_KNOWN || !self.serves(&histogram) {
            self.clear();
            self.is_exact = false;
            self.colors.extend(choose(&histogram, room));
            self.add_mixed(&histogram);
            self.error = self.mean_error(&histogram);
        }
    }

    fn add_exactly(&mut self, histogram: &Histogram) {
        for (color, _) in histogram {
            let first = self.colors.len() as u8;
            if !self.known.contains_key(color) {
                self.known.insert(*color, Mix { first, second: first, share: 0 });
                self.colors.push(*color);
            }
        }
    }

    fn add_mixed(&mut self, histogram: &Histogram) {
        let first_color = usize::from(self.transparent);
        for (color, _) in histogram {
            self.known.entry(*color).or_insert_with(|| mix(*color, &self.colors, first_color));
        }
    }

    /// Whether the present table suits another picture.
    fn serves(&mut self, histogram: &Histogram) -> bool {
        self.add_mixed(histogram);
        let pixels: f64 = histogram.iter().map(|(_, count)| f64::from(*count)).sum();
        let flat = histogram.iter().filter(|(_, count)| f64::from(*count) >= pixels * FLAT_SHARE);
        flat.clone().all(|(color, _)| self.nearest(*color) == *color)
            && self.mean_error(histogram) <= (self.error * WORSE).max(UNSEEN)
    }

    fn nearest(&self, color: PackedColor) -> PackedColor {
        self.known.get(&color).map_or(color, |mix| self.colors[usize::from(mix.first)])
    }

    fn mean_error(&self, histogram: &Histogram) -> f64 {
        let square =
            |(color, count): &(PackedColor, u32)| f64::from(distance(*color, self.nearest(*color))) * f64::from(*count);
        let pixels: f64 = histogram.iter().map(|(_, count)| f64::from(*count)).sum();
        histogram.iter().map(square).sum::<f64>() / pixels
    }

    /// Appends the indices of a row of pixels that begins at this place of the screen.
    pub(super) fn map_row<'a>(&self, pixels: impl Iterator<Item = &'a [u8]>, left: u32, y: u32, to: &mut Vec<u8>) {
        // Neighbours often have the same colour.
        let mut last = (PackedColor::MAX, Mix { first: TRANSPARENT, second: TRANSPARENT, share: 0 });
        for (x, pixel) in (left..).zip(pixels) {
            if pixel[3] == 0 {
                to.push(TRANSPARENT);
                continue;
            }
            let color = packed(pixel);
            if color != last.0 {
                last = (color, self.known.get(&color).copied().unwrap_or(last.1));
            }
            let Mix { first, second, share } = last.1;
            to.push(if threshold(x, y) < share { second } else { first });
        }
    }

    /// Returns the table as red, green and blue bytes.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.colors.iter().flat_map(|color| color.to_be_bytes().into_iter().skip(1)).collect()
    }
}

fn packed(pixel: &[u8]) -> PackedColor {
    u32::from_be_bytes([0, pixel[0], pixel[1], pixel[2]])
}

/// Returns the colours in order, with the number of pixels of each.
fn histogram(pixels: &[u8]) -> Histogram {
    let kept = pixels.chunks_exact(4).filter(|pixel| pixel[3] > 0);
    let mut colors: Vec<PackedColor> = kept.map(packed).collect();
    colors.sort_unstable();
    colors.chunk_by(|a, b| a == b).map(|run| (run[0], run.len() as u32)).collect()
}

/// Bayer's ordered pattern of 8 x 8 pixels: each number from 0 to 63 once.
fn threshold(x: u32, y: u32) -> u8 {
    (0..3).fold(0, |sum, bit| (sum << 2) | ((((x ^ y) >> bit & 1) << 1 | (y >> bit & 1)) as u8))
}
