//! The paper under the drawing. It is ours, because the text does not specify one (errata V7).
//!
//! A sheet of drawing paper lit flatly from the upper left: its tooth (fine and coarse grain) as relief, fibres in the pulp,
//! cloudy where it is thicker, slightly yellow. It repeats in both directions.

use super::blur::{Rows, gaussian};
use super::generator::{Generator, Numbers};
use super::{DEFAULT_SIZE, check_size, opaque};
use crate::error::Result;
use crate::picture::Picture;
use crate::scene::Size;
use serde::Serialize;

/// Settings of the paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperTexture {
    /// Pixels. Default 512 x 512. Grain and fibres keep their size in pixels: more is a larger sheet, not a sharper one.
    pub size: Size,
    /// Seed of the random numbers. Default 0; another seed gives another sheet.
    pub seed: u64,
    /// Source of the random numbers. Default SplitMix64, ours.
    pub random: Generator,
}

impl Default for PaperTexture {
    fn default() -> Self {
        Self { size: DEFAULT_SIZE, seed: 0, random: Generator::SplitMix }
    }
}

/// The sheet's colour where it is flat: red, green, blue of 255.
const COLOR: [f32; 3] = [245.0, 242.0, 233.0];

/// How strongly each part changes red, green and blue: thick and shaded places are a little warmer.
const TINT: [f32; 3] = [0.94, 1.0, 1.1];

/// Strength of each part, as standard deviation in steps of 255.
const RELIEF: f32 = 3.6;
const TOOTH: f32 = 1.5;
const FIBRES: f32 = 1.0;
const CLOUDS: f32 = 1.1;

/// Details smaller than this in a picture of paper count as its tooth, pixels.
const COARSEST_TOOTH_PX: f64 = 4.5;

/// Steps of 255 per standard deviation of the height.
const HEIGHT_STEP: f32 = 56.0;

impl PaperTexture {
    /// Returns the height of the paper at each place, as grey: 128 in the middle, lighter is higher.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] for an unsupported size.
    pub fn height(&self) -> Result<Picture> {
        check_size(self.size)?;
        let mut random = Numbers::new(self.random, self.seed, "paper");
        let [fine, coarse] = tooth_of_two_sizes(self.size, &mut random);
        let fibres = fibres_of(self.size, &mut random);
        let height: Vec<f32> = fine.iter().zip(&coarse).map(|(fine, coarse)| fine + 0.45 * coarse).collect();
        Ok(as_greys(self.size, &surface(&standardised(height), &fibres)))
    }

    /// Makes the texture.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] for an unsupported size.
    pub fn picture(&self) -> Result<Picture> {
        check_size(self.size)?;
        let size = self.size;
        let mut random = Numbers::new(self.random, self.seed, "paper");
        let tooth = tooth(size, &mut random);
        let fibres = fibres_of(size, &mut random);
        let clouds = clouds(size, &mut random);
        let relief = standardised(slope(&surface(&tooth, &fibres), size));
        let colors = (0..size.pixel_count()).map(|at| {
            let change = RELIEF * relief[at] + TOOTH * tooth[at] + FIBRES * fibres[at] + CLOUDS * clouds[at];
            [0, 1, 2].map(|channel| (COLOR[channel] + TINT[channel] * change).round().clamp(0.0, 255.0) as u8)
        });
        Ok(opaque(size, colors))
    }
}

/// Returns the apparent height of a picture of paper: how much lighter each place is than its surroundings.
pub fn height_of(paper: &Picture) -> Picture {
    let light: Vec<f32> = paper.pixels.chunks_exact(4).map(|pixel| f32::from(pixel[1])).collect();
    let around = gaussian(&light, paper.size, COARSEST_TOOTH_PX, Rows::Wrap);
    as_greys(paper.size, &light.iter().zip(around).map(|(light, around)| light - around).collect::<Vec<f32>>())
}

/// Converts heights, in standard deviations, to grey.
fn as_greys(size: Size, heights: &[f32]) -> Picture {
    let grey = |height: f32| (128.0 + HEIGHT_STEP * height).round().clamp(0.0, 255.0) as u8;
    opaque(size, standardised(heights.to_vec()).into_iter().map(|height| [grey(height); 3]))
}

/// The fibres, softened.
fn fibres_of(size: Size, random: &mut Numbers) -> Vec<f32> {
    standardised(gaussian(&fibres(size, random), size, 0.6, Rows::Wrap))
}

/// Fibres lie on the surface and so add to its height.
fn surface(tooth: &[f32], fibres: &[f32]) -> Vec<f32> {
    tooth.iter().zip(fibres).map(|(tooth, fibre)| tooth + 0.3 * fibre).collect()
}

/// Returns the height of the surface: grain of two sizes.
fn tooth(size: Size, random: &mut Numbers) -> Vec<f32> {
    let [fine, coarse] = tooth_of_two_sizes(size, random);
    standardised(fine.iter().zip(&coarse).map(|(fine, coarse)| 0.55 * fine + coarse).collect())
}

fn tooth_of_two_sizes(size: Size, random: &mut Numbers) -> [Vec<f32>; 2] {
    [between(size, random, 0.8, 1.8), between(size, random, 1.7, COARSEST_TOOTH_PX)]
}

/// Returns noise with details between two sizes, pixels.
fn between(size: Size, random: &mut Numbers, finest_px: f64, coarsest_px: f64) -> Vec<f32> {
    let noise: Vec<f32> = (0..size.pixel_count()).map(|_| random.signed()).collect();
    let fine = gaussian(&noise, size, finest_px, Rows::Wrap);
    let coarse = gaussian(&noise, size, coarsest_px, Rows::Wrap);
    standardised(fine.iter().zip(coarse).map(|(fine, coarse)| fine - coarse).collect())
}

/// Draws fibres a pixel wide that bend a little, some lighter and some darker than the pulp.
fn fibres(size: Size, random: &mut Numbers) -> Vec<f32> {
    const PIXELS_PER_FIBRE: usize = 260;
    const BEND: f32 = 0.07;
    let (width, height) = (size.width as f32, size.height as f32);
    let mut values = vec![0.0f32; size.pixel_count()];
    for _ in 0..size.pixel_count().div_ceil(PIXELS_PER_FIBRE) {
        let (mut x, mut y) = (random.share() * width, random.share() * height);
        let (mut along_x, mut along_y) = direction(random);
        let bend = BEND * random.signed();
        let steps = 16.0 + 54.0 * random.share() * random.share();
        let strength = random.signed();
        let mut step = 0.0;
        while step < steps {
            // Thin at both ends.
            let body = 1.0 - (2.0 * step / steps - 1.0) * (2.0 * step / steps - 1.0);
            splat(&mut values, size, x, y, strength * body);
            (x, y) = (x + along_x, y + along_y);
            (along_x, along_y) = normalised(along_x - bend * along_y, along_y + bend * along_x);
            step += 1.0;
        }
    }
    values
}

/// Adds a value at a place between four pixels, shared among them.
fn splat(values: &mut [f32], size: Size, x: f32, y: f32, value: f32) {
    let (column, row) = (x.floor(), y.floor());
    let (right, down) = (x - column, y - row);
    for (step_x, step_y, share) in [
        (0, 0, (1.0 - right) * (1.0 - down)),
        (1, 0, right * (1.0 - down)),
        (0, 1, (1.0 - right) * down),
        (1, 1, right * down),
    ] {
        let at_x = (column as i64 + step_x).rem_euclid(i64::from(size.width)) as usize;
        let at_y = (row as i64 + step_y).rem_euclid(i64::from(size.height)) as usize;
        values[at_y * size.width as usize + at_x] += share * value;
    }
}

/// Returns a unit vector, from a point in the unit disc, because sine and cosine differ between platforms.
fn direction(random: &mut Numbers) -> (f32, f32) {
    loop {
        let (x, y) = (random.signed(), random.signed());
        let square = x * x + y * y;
        if (1e-4..=1.0).contains(&square) {
            return normalised(x, y);
        }
    }
}

fn normalised(x: f32, y: f32) -> (f32, f32) {
    let length = (x * x + y * y).sqrt();
    (x / length, y / length)
}

/// Soft large noise: lattices of random numbers, each twice as fine and half as strong as the one before.
fn clouds(size: Size, random: &mut Numbers) -> Vec<f32> {
    const LARGEST_PX: u32 = 96;
    let mut values = vec![0.0f32; size.pixel_count()];
    for octave in 0..3 {
        let cell = (LARGEST_PX >> octave) as f32;
        let strength = 1.0 / (1u32 << octave) as f32;
        let cells = |side: u32| ((side as f32 / cell).round() as usize).max(1);
        let (columns, rows) = (cells(size.width), cells(size.height));
        let lattice: Vec<f32> = (0..columns * rows).map(|_| random.signed()).collect();
        let (across, down) = (steps(size.width, columns), steps(size.height, rows));
        for (row, (top, bottom, share_y)) in values.chunks_exact_mut(size.width as usize).zip(down) {
            let mix = |column: usize| {
                let (above, below) = (lattice[top * columns + column], lattice[bottom * columns + column]);
                above + (below - above) * share_y
            };
            let line: Vec<f32> = (0..columns).map(mix).collect();
            for (value, (left, right, share_x)) in row.iter_mut().zip(&across) {
                *value += strength * (line[*left] + (line[*right] - line[*left]) * share_x);
            }
        }
    }
    standardised(values)
}

/// Returns for each pixel of a side the lattice points before and after it, and its smoothed position between them.
fn steps(side: u32, cells: usize) -> Vec<(usize, usize, f32)> {
    let step = |pixel: u32| {
        let at = pixel as f32 * cells as f32 / side as f32;
        let before = (at.floor() as usize).min(cells - 1);
        let share = at - before as f32;
        (before, (before + 1) % cells, share * share * (3.0 - 2.0 * share))
    };
    (0..side).map(step).collect()
}

/// Returns how much the surface rises towards the upper left: light from there falls on the opposite slopes.
fn slope(height: &[f32], size: Size) -> Vec<f32> {
    let (width, rows) = (size.width as usize, size.height as usize);
    let at = |x: usize, y: usize| height[y % rows * width + x % width];
    let pixels = (0..rows).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels.map(|(x, y)| at(x + 1, y + 1) - at(x + width - 1, y + rows - 1)).collect()
}

/// Returns the values with mean 0 and standard deviation 1; all 0 if they are constant.
fn standardised(mut values: Vec<f32>) -> Vec<f32> {
    let count = values.len() as f64;
    let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / count;
    let variance =
        values.iter().map(|value| (f64::from(*value) - mean) * (f64::from(*value) - mean)).sum::<f64>() / count;
    let scale = if variance > 1e-12 { 1.0 / variance.sqrt() } else { 0.0 };
    values.iter_mut().for_each(|value| *value = ((f64::from(*value) - mean) * scale) as f32);
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper(width: u32, height: u32) -> Picture {
        PaperTexture { size: Size { width, height }, seed: 1, ..PaperTexture::default() }.picture().unwrap()
    }

    /// Mean difference of neighbouring columns (or rows) `a` and `b`.
    fn step(picture: &Picture, a: i64, b: i64, columns: bool) -> f64 {
        let value = |line: i64, along: i64| {
            let (x, y) = if columns { (line, along) } else { (along, line) };
            f64::from(picture.pixel(x, y)[1])
        };
        (0..512).map(|along| (value(a, along) - value(b, along)).abs()).sum::<f64>() / 512.0
    }

    #[test]
    fn its_edges_meet() {
        let picture = paper(512, 512);
        for columns in [true, false] {
            let inside = (0..511).map(|line| step(&picture, line, line + 1, columns)).sum::<f64>() / 511.0;
            let seam = step(&picture, 511, 0, columns);
            assert!(seam < inside * 1.2, "the seam differs by {seam}, other neighbours by {inside}");
        }
    }

    #[test]
    fn it_is_light_and_warm_with_a_visible_grain() {
        let picture = paper(512, 512);
        let mean = |channel: usize| {
            picture.pixels.chunks_exact(4).map(|pixel| f64::from(pixel[channel])).sum::<f64>() / 512.0 / 512.0
        };
        let [red, green, blue] = [mean(0), mean(1), mean(2)];
        assert!(red > green && green > blue && blue > 220.0, "{red} {green} {blue}");
        let variance = picture.pixels.chunks_exact(4).map(|pixel| (f64::from(pixel[1]) - green).powi(2)).sum::<f64>();
        let deviation = (variance / 512.0 / 512.0).sqrt();
        assert!((3.0..7.0).contains(&deviation), "{deviation}");
    }

    #[test]
    fn every_size_gives_a_sheet() {
        for (width, height) in [(1, 1), (1, 7), (5, 1), (33, 17), (300, 200)] {
            assert_eq!(paper(width, height).pixels.len(), (width * height * 4) as usize);
        }
        assert_eq!(paper(64, 64), paper(64, 64));
    }
}
