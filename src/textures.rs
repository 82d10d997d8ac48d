//! The textures of a charcoal drawing, made on the CPU before anything is drawn (Valente 2007, sections 2.1.3 and 3.1).
//!
//! In: settings with a size and a seed. Out: opaque [`Picture`]s whose edges meet where GL repeats them. No GL here.
//!
//! The same settings give the same bytes on every machine. The numbers come from our generator, or from a fixed `rand()` instead
//! of the platform's (errata V8). Sums have a fixed order. Results of the platform's mathematics library are rounded before they
//! reach a byte.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::Size;
//! use tinta::textures::NoiseTexture;
//!
//! let noise = NoiseTexture { size: Size { width: 32, height: 32 }, seed: 7, ..NoiseTexture::default() };
//! assert_eq!(noise.picture()?, noise.clone().picture()?, "the same on every machine");
//! assert_ne!(noise.picture()?, NoiseTexture { seed: 8, ..noise }.picture()?);
//! # Ok(())
//! # }
//! ```

mod blur;
mod contrast;
mod generator;
mod noise;
mod paper;

pub use contrast::{ContrastTexture, Grains};
pub use generator::Generator;
pub use noise::NoiseTexture;
pub use paper::{PaperTexture, height_of};

use crate::error::{Error, Result};
use crate::picture::Picture;
use crate::scene::Size;

/// The longest side of a texture, pixels: every OpenGL 2.1 driver in use supports it.
pub(crate) const LARGEST_SIDE_PX: u32 = 4096;

/// The default size of textures.
const DEFAULT_SIZE: Size = Size { width: 512, height: 512 };

fn check_size(size: Size) -> Result<()> {
    let fits = |side: u32| (1..=LARGEST_SIDE_PX).contains(&side);
    if fits(size.width) && fits(size.height) {
        return Ok(());
    }
    Err(Error::value("size", size, format!("a texture has 1 to {LARGEST_SIDE_PX} pixels on each side")))
}

/// Returns an opaque picture of these colours, row by row from the top.
fn opaque(size: Size, colors: impl Iterator<Item = [u8; 3]>) -> Picture {
    let mut pixels = Vec::with_capacity(size.pixel_count() * 4);
    colors.for_each(|[red, green, blue]| pixels.extend([red, green, blue, u8::MAX]));
    Picture { size, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FNV-1a, 64 bits.
    fn sum(picture: &Picture) -> u64 {
        picture
            .pixels
            .iter()
            .fold(0xcbf2_9ce4_8422_2325, |sum: u64, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
    }

    /// A change here changes every drawing made with these textures. Make one only on purpose, and note it in CHANGELOG.md.
    #[test]
    fn the_bytes_of_seed_0_are_what_they_were() {
        let sums = [
            ContrastTexture::default().picture().unwrap(),
            NoiseTexture::default().picture().unwrap(),
            PaperTexture::default().picture().unwrap(),
        ]
        .map(|picture| sum(&picture));
        let expected = [0x72ef_50e2_bf95_f539, 0xe57a_c481_91bf_09b7, 0x73e1_ec7d_e7da_e9a0];
        assert_eq!(sums, expected, "{sums:#x?}");
    }
}
