//! The random number generators of the textures: ours, and the `rand()` of two C libraries of the report's time.
//!
//! The report makes its textures with `rand()` of an unnamed library, and supposes that a better generator would change little
//! (Valente 2007, section 5; errata V8). Both libraries' generators follow their published definitions and allow a test of that.

use crate::random::Random;

tinta_geometry::choices! {
    /// The source of a texture's random numbers.
    #[derive(Default)]
    pub enum Generator {
        /// SplitMix64, with different numbers for each texture of one seed. Ours.
        #[default]
        SplitMix = "splitmix",
        /// `rand()` of Microsoft's C runtime after `srand(seed)`: 15 bits of a linear congruential generator of 32.
        Msvc = "msvc",
        /// `rand()` of the GNU C library after `srand(seed)`: 31 bits, an additive feedback generator of 31 words (its TYPE_3).
        Glibc = "glibc",
    }
}

/// Random numbers for one texture.
pub(super) enum Numbers {
    SplitMix(Random),
    Msvc(Msvc),
    Glibc(Glibc),
}

impl Numbers {
    /// Starts the numbers of a seed. Our generator also varies them by `purpose`. A C program's begin at its `srand`, whose
    /// argument is the seed's lower 32 bits.
    pub(super) fn new(generator: Generator, seed: u64, purpose: &str) -> Self {
        match generator {
            Generator::SplitMix => Self::SplitMix(Random::new(seed, purpose)),
            Generator::Msvc => Self::Msvc(Msvc(seed as u32)),
            Generator::Glibc => Self::Glibc(Glibc::new(seed as u32)),
        }
    }

    /// Returns `rand()` scaled to 32 bits, or the upper half of one of our numbers.
    fn scaled(&mut self) -> u32 {
        match self {
            Self::SplitMix(random) => (random.bits() >> 32) as u32,
            Self::Msvc(rand) => rand.next() << 17,
            Self::Glibc(rand) => rand.next() << 1,
        }
    }

    /// Returns two numbers of 32 bits.
    pub(super) fn pair(&mut self) -> [u32; 2] {
        match self {
            Self::SplitMix(random) => {
                let bits = random.bits();
                [(bits >> 32) as u32, bits as u32]
            }
            _ => [self.scaled(), self.scaled()],
        }
    }

    /// Returns red, green and blue; `rand() % 256` each, as in a C program.
    pub(super) fn color(&mut self) -> [u8; 3] {
        match self {
            Self::SplitMix(random) => {
                let [red, green, blue, ..] = random.bits().to_le_bytes();
                [red, green, blue]
            }
            Self::Msvc(rand) => [(); 3].map(|()| rand.next() as u8),
            Self::Glibc(rand) => [(); 3].map(|()| rand.next() as u8),
        }
    }

    /// Returns a number in [-1, 1).
    pub(super) fn signed(&mut self) -> f32 {
        (self.scaled() >> 8) as f32 / (1u32 << 23) as f32 - 1.0
    }

    /// Returns a number in [0, 1).
    pub(super) fn share(&mut self) -> f32 {
        (self.scaled() >> 8) as f32 / (1u32 << 24) as f32
    }
}

/// Microsoft's: state * 214013 + 2531011; bits 16 to 30 are the number.
pub(super) struct Msvc(u32);

impl Msvc {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(214_013).wrapping_add(2_531_011);
        (self.0 >> 16) & 0x7fff
    }
}

/// GNU's: `r[i] = r[i - 3] + r[i - 31]`; all bits except the lowest are the number.
pub(super) struct Glibc {
    words: [u32; 31],
    /// The oldest word, which is replaced next.
    oldest: usize,
}

impl Glibc {
    /// Starts as `srand(seed)` does, which treats 0 as 1.
    fn new(seed: u32) -> Self {
        const MODULUS: i64 = 2_147_483_647;
        let mut word = i64::from(seed.max(1) as i32);
        let words = [(); 31].map(|()| {
            let this = word as u32;
            // 16807 times the word modulo 2^31 - 1, with the sign that C's division has, then made positive.
            word = 16_807 * word % MODULUS;
            if word < 0 {
                word += MODULUS;
            }
            this
        });
        // The words 31 to 33 repeat the first three, which makes the fourth the oldest.
        let mut made = Self { words, oldest: 3 };
        // The library discards these.
        for _ in 0..310 {
            made.next();
        }
        made
    }

    fn next(&mut self) -> u32 {
        let newer = (self.oldest + 28) % 31;
        let sum = self.words[self.oldest].wrapping_add(self.words[newer]);
        self.words[self.oldest] = sum;
        self.oldest = (self.oldest + 1) % 31;
        sum >> 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn microsofts_numbers_after_srand_1_are_those_that_every_program_had() {
        let mut rand = Msvc(1);
        assert_eq!([(); 5].map(|()| rand.next()), [41, 18_467, 6_334, 26_500, 19_169]);
    }

    #[test]
    fn gnus_numbers_after_srand_1_are_those_that_every_program_had() {
        let mut rand = Glibc::new(1);
        assert_eq!([(); 4].map(|()| rand.next()), [1_804_289_383, 846_930_886, 1_681_692_777, 1_714_636_915]);
        assert_eq!(Glibc::new(0).next(), 1_804_289_383, "srand(0) is srand(1)");
    }

    #[test]
    fn numbers_of_every_generator_stay_in_their_range_and_fill_it() {
        for (name, generator) in Generator::ALL {
            let mut numbers = Numbers::new(generator, 1, "a test");
            let (mut low, mut high) = (1.0f32, -1.0f32);
            for _ in 0..10_000 {
                let (signed, share) = (numbers.signed(), numbers.share());
                assert!((-1.0..1.0).contains(&signed) && (0.0..1.0).contains(&share), "{name} {signed} {share}");
                (low, high) = (low.min(signed), high.max(signed));
            }
            assert!(low < -0.999 && high > 0.999, "{name} {low} {high}");
        }
    }

    #[test]
    fn a_colour_is_rand_modulo_256_three_times() {
        assert_eq!(Numbers::new(Generator::Msvc, 1, "noise").color(), [41, (18_467 % 256) as u8, (6_334 % 256) as u8]);
        let expected = [1_804_289_383u32, 846_930_886, 1_681_692_777].map(|number| (number % 256) as u8);
        assert_eq!(Numbers::new(Generator::Glibc, 1, "noise").color(), expected);
    }
}
