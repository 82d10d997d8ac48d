//! A picture for a page with many pictures: as many colours as a size limit allows.

use super::Picture;
use std::collections::BTreeSet;

/// Fewest bits per channel: with fewer, grey tones show steps even in grain.
const FEWEST_BITS: u32 = 4;

/// Most colours of a file with a colour table.
const TABLE: usize = 256;

impl Picture {
    /// Returns the picture as an opaque PNG, with as many bits per channel as a file of `most_bytes` allows, or the fewest that
    /// still look good. `None` for a picture without pixels.
    pub fn small_png(&self, most_bytes: usize) -> Option<Vec<u8>> {
        let of = |bits| self.with_bits(bits);
        (FEWEST_BITS + 1..=8).rev().filter_map(of).find(|bytes| bytes.len() <= most_bytes).or_else(|| of(FEWEST_BITS))
    }

    /// A table of few colours takes the fewest bytes.
    fn with_bits(&self, bits: u32) -> Option<Vec<u8>> {
        let steps = (1u32 << bits) - 1;
        let nearest = |value: u8| (((u32::from(value) * steps + 127) / 255) * 255 / steps) as u8;
        let reduced = |pixel: &[u8]| [nearest(pixel[0]), nearest(pixel[1]), nearest(pixel[2])];
        let colors: Vec<[u8; 3]> = self.pixels.chunks_exact(4).map(reduced).collect();
        let table: Vec<[u8; 3]> = colors.iter().copied().collect::<BTreeSet<_>>().into_iter().collect();
        if table.len() <= TABLE { self.with_table(&table, &colors) } else { self.without_table(&colors) }
    }

    fn with_table(&self, table: &[[u8; 3]], colors: &[[u8; 3]]) -> Option<Vec<u8>> {
        let indices: Option<Vec<u8>> = colors
            .iter()
            .map(|color| table.binary_search(color).ok().and_then(|index| u8::try_from(index).ok()))
            .collect();
        self.png(png::ColorType::Indexed, Some(table.concat()), png::Filter::NoFilter, &indices?)
    }

    fn without_table(&self, colors: &[[u8; 3]]) -> Option<Vec<u8>> {
        self.png(png::ColorType::Rgb, None, png::Filter::Adaptive, &colors.concat())
    }

    fn png(&self, color: png::ColorType, table: Option<Vec<u8>>, filter: png::Filter, data: &[u8]) -> Option<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.width, self.size.height);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        if let Some(table) = table {
            encoder.set_palette(table);
        }
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_filter(filter);
        // Writing into memory fails only for pictures without pixels.
        encoder.write_header().ok()?.write_image_data(data).ok()?;
        Some(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Size;

    fn read(bytes: &[u8]) -> Vec<u8> {
        image::load_from_memory(bytes).unwrap().into_rgba8().into_raw()
    }

    #[test]
    fn a_picture_of_few_colours_is_kept_as_it_is() {
        let size = Size { width: 16, height: 9 };
        let pixels: Vec<u8> = (0..size.pixel_count()).flat_map(|number| [number as u8, 7, 200, 255]).collect();
        let picture = Picture { size, pixels };
        assert_eq!(read(&picture.small_png(100_000).unwrap()), picture.pixels);
    }

    #[test]
    fn one_of_many_colours_loses_nothing_while_it_fits_and_half_a_step_of_four_bits_at_most() {
        let size = Size { width: 64, height: 64 };
        let pixel = |number: usize| [(number * 37) as u8, (number / 3) as u8, (number * number / 7) as u8, 255];
        let picture = Picture { size, pixels: (0..size.pixel_count()).flat_map(pixel).collect() };
        let whole = picture.small_png(usize::MAX).unwrap();
        assert_eq!(read(&whole), picture.pixels);
        let small = picture.small_png(0).unwrap();
        let worst = read(&small).iter().zip(&picture.pixels).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(small.len() < whole.len() && (1..=9).contains(&worst), "{worst} of 255, {} bytes", small.len());
    }
}
