//! The noise texture: each pixel a random red, green and blue (Valente 2007, section 3.1), read where GLSL has no `noise`.

use super::generator::{Generator, Numbers};
use super::{DEFAULT_SIZE, check_size, opaque};
use crate::error::Result;
use crate::picture::Picture;
use crate::scene::Size;
use serde::Serialize;

/// Settings of the noise texture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoiseTexture {
    /// Pixels. Default 512 x 512. A texture as large as the drawing gives every pixel a separate number.
    pub size: Size,
    /// Seed of the random numbers. Default 0; another seed gives another texture of the same kind.
    pub seed: u64,
    /// Source of the random numbers. Default SplitMix64, ours; the text uses its platform's `rand()`.
    pub random: Generator,
}

impl Default for NoiseTexture {
    fn default() -> Self {
        Self { size: DEFAULT_SIZE, seed: 0, random: Generator::SplitMix }
    }
}

impl NoiseTexture {
    /// Makes the texture.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] for an unsupported size.
    pub fn picture(&self) -> Result<Picture> {
        check_size(self.size)?;
        let mut numbers = Numbers::new(self.random, self.seed, "noise");
        Ok(opaque(self.size, (0..self.size.pixel_count()).map(|_| numbers.color())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_of_every_channel_is_as_frequent_as_the_others() {
        for (name, random) in Generator::ALL {
            let picture = NoiseTexture { random, ..NoiseTexture::default() }.picture().unwrap();
            for channel in 0..3 {
                let mut counts = [0u32; 256];
                picture.pixels.chunks_exact(4).for_each(|pixel| counts[usize::from(pixel[channel])] += 1);
                // 1024 expected with a standard deviation of 32.
                assert!(counts.iter().all(|count| (860..1190).contains(count)), "{name} {counts:?}");
            }
        }
    }

    #[test]
    fn neighbours_and_channels_are_independent_whatever_the_generator() {
        for (name, random) in Generator::ALL {
            let picture = NoiseTexture { random, ..NoiseTexture::default() }.picture().unwrap();
            let value = |index: usize| f64::from(picture.pixels[index]) - 127.5;
            let correlation = |step: usize| {
                let pairs = (0..picture.pixels.len() - step).step_by(4).map(|at| value(at) * value(at + step));
                pairs.sum::<f64>() / (picture.size.pixel_count() as f64 * 256.0 * 256.0 / 12.0)
            };
            // Green, blue, the pixel on the right and the one below.
            let correlations = [1, 2, 4, 512 * 4].map(correlation);
            println!("{name}: {correlations:.4?}");
            assert!(correlations.iter().all(|correlation| correlation.abs() < 0.01), "{name} {correlations:?}");
        }
    }

    #[test]
    fn one_seed_is_one_texture_and_another_another() {
        let with_seed = |seed| NoiseTexture { seed, ..NoiseTexture::default() }.picture().unwrap();
        assert_eq!(with_seed(7), with_seed(7));
        assert_ne!(with_seed(7), with_seed(8));
        assert_eq!(with_seed(0).pixels[..8], [124, 163, 115, 255, 217, 4, 84, 255], "as ever");
    }
}
