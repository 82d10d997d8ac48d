//! The contrast-enhanced texture (CET; Valente 2007, sections 2.1.3 and 3.1, figures 2 and 3). In it charcoal's grains thin out
//! from the darkest tone, t = 0, to the lightest, t = 1.
//!
//! Black pixels are scattered over a white picture, each is moved along t to t^m, and the result is blurred.

use super::blur::{Rows, gaussian};
use super::generator::{Generator, Numbers};
use super::{DEFAULT_SIZE, check_size, opaque};
use crate::error::{Error, Result};
use crate::picture::Picture;
use crate::scene::Size;
use crate::tolerances::ROW_EDGE;
use serde::Serialize;

/// Settings of the contrast-enhanced texture.
///
/// Its pictures have t = 0 in their bottom row and s = 0 in their left column, as GL draws a texture upright.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContrastTexture {
    /// Pixels along s and t. Default 512 x 512; the text gives none (errata V7). More gives finer grain.
    pub size: Size,
    /// Share of black pixels before they are moved, percent. Default 60: the text says "density 60" without a unit, which is read
    /// as percent here (errata V10). More is darker.
    pub density_percent: f64,
    /// The exponent m of t^m, at least 1. Default 5.5, the middle one of figure 3's three (1.3, 5.5, 15); the text does not say
    /// which one it draws with. More gathers the grains at the darkest tones and leaves fewer in the drawing.
    pub exponent: f64,
    /// Standard deviation of the final blur, pixels. Default 0.8; the text gives none (errata V7). More is softer.
    pub blur_px: f64,
    /// Seed of the random numbers. Default 0; another seed gives another texture of the same kind.
    pub seed: u64,
    /// Source of the random numbers. Default SplitMix64, ours; the text uses its platform's `rand()`.
    pub random: Generator,
}

/// The exponents of figure 3, from left to right.
const PUBLISHED_EXPONENTS: [f64; 3] = [1.3, 5.5, 15.0];

/// The largest blur, pixels; a larger one would leave no grain.
const LARGEST_BLUR_PX: f64 = 100.0;

impl Default for ContrastTexture {
    fn default() -> Self {
        Self {
            size: DEFAULT_SIZE,
            density_percent: 60.0,
            exponent: PUBLISHED_EXPONENTS[1],
            blur_px: 0.8,
            seed: 0,
            random: Generator::SplitMix,
        }
    }
}

/// The number of black pixels at each place after they were moved, before the blur.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grains {
    /// Pixels along s and t.
    pub size: Size,
    /// A count for each pixel, row by row from the top, which is t = 1.
    pub counts: Vec<u16>,
}

impl Grains {
    /// Returns the share of pixels with a grain, from 0 to 1.
    #[cfg(test)]
    pub(crate) fn black_share(&self) -> f64 {
        self.counts.iter().filter(|count| **count > 0).count() as f64 / self.counts.len() as f64
    }

    /// Returns a picture with black grains on white.
    pub fn picture(&self) -> Picture {
        opaque(self.size, self.counts.iter().map(|count| [if *count > 0 { 0 } else { u8::MAX }; 3]))
    }
}

impl ContrastTexture {
    /// Returns the textures of figure 3 in this size, from this seed: exponents 1.3, 5.5 and 15 at density 60.
    pub fn figure_3(size: Size, seed: u64) -> [Self; 3] {
        PUBLISHED_EXPONENTS.map(|exponent| Self { size, seed, exponent, ..Self::default() })
    }

    /// Returns the texture of figure 2: the grains of density 60 as scattered, neither moved nor blurred.
    pub fn figure_2(size: Size, seed: u64) -> Self {
        Self { size, seed, exponent: 1.0, blur_px: 0.0, ..Self::default() }
    }

    /// Makes the texture.
    ///
    /// It repeats along s, where the drawing's random numbers cross the edge. It does not repeat along t: there the blur ends
    /// with the picture (ours, errata V11). Otherwise the darkest row would mix with the lightest and put specks into the lights.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] by the option's name for an invalid value.
    pub fn picture(&self) -> Result<Picture> {
        let grains = self.grains()?;
        let white: Vec<f32> = grains.counts.iter().map(|count| if *count > 0 { 0.0 } else { 255.0 }).collect();
        let blurred = gaussian(&white, self.size, self.blur_px, Rows::Clamp);
        Ok(opaque(self.size, blurred.iter().map(|value| [value.round() as u8; 3])))
    }

    /// Returns the texture before its blur.
    ///
    /// # Errors
    ///
    /// As [`ContrastTexture::picture`].
    pub(crate) fn grains(&self) -> Result<Grains> {
        self.check()?;
        let mut numbers = Numbers::new(self.random, self.seed, "contrast");
        let Size { width, height } = self.size;
        // This many of 2^32 numbers make a pixel black.
        let black = (self.density_percent / 100.0 * (1u64 << 32) as f64).round() as u64;
        let mut counts = vec![0u16; self.size.pixel_count()];
        for row in 0..height {
            for column in 0..width {
                let [darkness, within] = numbers.pair();
                if u64::from(darkness) < black {
                    let within = f64::from(within) / (1u64 << 32) as f64;
                    let row_from_top = height - 1 - self.moved(f64::from(row) + within);
                    counts[(row_from_top * width + column) as usize] += 1;
                }
            }
        }
        Ok(Grains { size: self.size, counts })
    }

    /// Returns the row that t^m moves a grain into; rows count from t = 0.
    ///
    /// A grain lies at a random place within its pixel, which is ours (errata V9). If all grains of a row lay in its middle, they
    /// would move together and leave empty rows between them: stripes in the lights.
    fn moved(&self, row: f64) -> u32 {
        let height = f64::from(self.size.height);
        let moved = (row / height).powf(self.exponent) * height;
        // Near the edge of two rows the last bit of a library's `pow` must not decide.
        let nearest = moved.round();
        let settled = if (moved - nearest).abs() < ROW_EDGE { nearest } else { moved };
        (settled as u32).min(self.size.height - 1)
    }

    fn check(&self) -> Result<()> {
        check_size(self.size)?;
        if !(0.0..=100.0).contains(&self.density_percent) {
            return Err(Error::value(
                "density",
                self.density_percent,
                "the density is a percentage of pixels, from 0 to 100",
            ));
        }
        if !(self.exponent >= 1.0 && self.exponent.is_finite()) {
            return Err(Error::value(
                "cet-exponent",
                self.exponent,
                "the exponent is a finite number of at least 1; 1 moves nothing",
            ));
        }
        if !(0.0..=LARGEST_BLUR_PX).contains(&self.blur_px) {
            return Err(Error::value(
                "cet-blur",
                self.blur_px,
                format!("the blur is a number of pixels from 0 to {LARGEST_BLUR_PX}"),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_exponent(exponent: f64) -> ContrastTexture {
        ContrastTexture { exponent, ..ContrastTexture::default() }
    }

    #[test]
    fn before_they_are_moved_the_share_of_black_is_the_density() {
        for density_percent in [0.0, 10.0, 60.0, 100.0] {
            let texture = ContrastTexture { density_percent, ..with_exponent(1.0) };
            let share = texture.grains().unwrap().black_share();
            // The standard deviation of a share of 262,144 pixels is below 0.001.
            assert!((share - density_percent / 100.0).abs() < 0.004, "{density_percent}: {share}");
        }
    }

    /// The mean t of all grains; grains that share a pixel count separately.
    fn mean_t(grains: &Grains) -> f64 {
        let rows = grains.counts.chunks_exact(grains.size.width as usize).rev().enumerate();
        let (count, sum) = rows.fold((0.0, 0.0), |(count, sum), (row, counts)| {
            let here: f64 = counts.iter().map(|count| f64::from(*count)).sum();
            (count + here, sum + here * (row as f64 + 0.5))
        });
        sum / count / f64::from(grains.size.height)
    }

    #[test]
    fn the_mean_of_the_mass_is_that_of_t_to_the_power_of_m() {
        for exponent in [1.0, 1.3, 2.0, 5.5, 15.0] {
            let mean = mean_t(&with_exponent(exponent).grains().unwrap());
            let expected = 1.0 / (exponent + 1.0);
            assert!((mean - expected).abs() < 0.002, "{exponent}: {mean}, expected {expected}");
        }
    }

    #[test]
    fn in_each_row_the_share_of_black_follows_from_what_is_moved_there() {
        let texture = ContrastTexture { size: Size { width: 4096, height: 64 }, ..with_exponent(5.5) };
        let grains = texture.grains().unwrap();
        let edge = |row: i32| (f64::from(row) / 64.0).powf(1.0 / 5.5) * 64.0;
        for row in 0..64 {
            // Each row contributes the part between its two edges, at their places before they were moved.
            let (low, high) = (edge(row), edge(row + 1));
            let part = |from: i32| (high.min(f64::from(from + 1)) - low.max(f64::from(from))).max(0.0);
            let white: f64 = (0..64).map(|from| 1.0 - 0.6 * part(from)).product();
            let expected = 1.0 - white;
            let counts = &grains.counts[(63 - row) as usize * 4096..][..4096];
            let share = counts.iter().filter(|count| **count > 0).count() as f64 / 4096.0;
            assert!((share - expected).abs() < 0.035, "row {row}: {share}, expected {expected}");
        }
    }

    #[test]
    fn from_the_middle_of_their_pixels_grains_leave_most_rows_empty_and_from_anywhere_within_none() {
        for (exponent, empty) in [(5.5, 287), (15.0, 394)] {
            let texture = with_exponent(exponent);
            let mut has_grain = [false; 512];
            (0..512).for_each(|row| has_grain[texture.moved(f64::from(row) + 0.5) as usize] = true);
            assert_eq!(has_grain.iter().filter(|has_grain| !**has_grain).count(), empty, "m = {exponent}");
            let grains = texture.grains().unwrap();
            let rows = grains.counts.chunks_exact(512);
            let ours = rows.filter(|counts| counts.iter().all(|count| *count == 0)).count();
            assert_eq!(ours, 0, "m = {exponent}");
        }
    }

    #[test]
    fn moving_loses_no_grain_and_a_larger_exponent_leaves_more_white() {
        let grains = |exponent| with_exponent(exponent).grains().unwrap();
        let total = |grains: &Grains| grains.counts.iter().map(|count| u64::from(*count)).sum::<u64>();
        assert_eq!(total(&grains(1.0)), total(&grains(15.0)));
        let shares: Vec<f64> = PUBLISHED_EXPONENTS.iter().map(|exponent| grains(*exponent).black_share()).collect();
        assert!(shares.is_sorted_by(|a, b| a > b), "{shares:?}");
    }

    #[test]
    fn the_blur_keeps_the_mean_and_does_not_join_the_darkest_row_to_the_lightest() {
        let texture = with_exponent(15.0);
        let (sharp, soft) = (texture.grains().unwrap().picture(), texture.picture().unwrap());
        let mean = |picture: &Picture| {
            picture.pixels.chunks_exact(4).map(|pixel| f64::from(pixel[0])).sum::<f64>() / 512.0 / 512.0
        };
        assert!((mean(&sharp) - mean(&soft)).abs() < 1.0);
        // The bottom row is black throughout; the top row should be 6 % black.
        let row = |y: i64| (0..512).map(|x| f64::from(soft.pixel(x, y)[0])).sum::<f64>() / 512.0;
        assert!(row(511) < 10.0 && row(0) > 225.0, "{} {}", row(511), row(0));
    }

    #[test]
    fn it_repeats_along_s() {
        let soft = ContrastTexture { blur_px: 3.0, ..with_exponent(1.3) }.picture().unwrap();
        let step = |a: i64, b: i64| -> f64 {
            let difference = |y: i64| f64::from(soft.pixel(a, y)[0].abs_diff(soft.pixel(b, y)[0]));
            (0..512).map(difference).sum::<f64>() / 512.0
        };
        assert!(step(511, 0) < step(200, 201) * 1.3, "{} {}", step(511, 0), step(200, 201));
    }

    #[test]
    fn one_seed_is_one_texture_and_another_another() {
        let with_seed = |seed| ContrastTexture { seed, ..ContrastTexture::default() }.picture().unwrap();
        assert_eq!(with_seed(3), with_seed(3));
        assert_ne!(with_seed(3), with_seed(4));
    }

    #[test]
    fn nonsense_is_refused_by_the_options_name() {
        let base = ContrastTexture::default;
        let refused = |texture: ContrastTexture| texture.picture().unwrap_err().to_string();
        for density_percent in [-1.0, 100.5, f64::NAN] {
            assert!(refused(ContrastTexture { density_percent, ..base() }).starts_with("density "));
        }
        for exponent in [0.5, f64::INFINITY, f64::NAN] {
            assert!(refused(ContrastTexture { exponent, ..base() }).starts_with("cet-exponent "));
        }
        for blur_px in [-0.1, 1e9, f64::NAN] {
            assert!(refused(ContrastTexture { blur_px, ..base() }).starts_with("cet-blur "));
        }
        for (width, height) in [(0, 5), (5, 0), (4097, 5)] {
            let size = Size { width, height };
            assert!(refused(ContrastTexture { size, ..base() }).starts_with("size "));
        }
    }
}
