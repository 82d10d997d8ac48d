//! Random numbers that are the same everywhere: SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number
//! generators", 2014). Ten lines replace a crate whose next version could give other numbers.
//!
//! ```
//! use tinta::random::Random;
//!
//! let mut dice = Random::new(7, "dice");
//! assert!((0..100).all(|_| dice.below(6) < 6));
//! ```

/// A sequence of numbers.
#[derive(Debug)]
pub struct Random(u64);

impl Random {
    /// Numbers for one purpose: textures of one seed must not be made of the same numbers.
    pub fn new(seed: u64, purpose: &str) -> Self {
        let mut random = Self(seed);
        purpose.bytes().for_each(|byte| random.0 = random.bits() ^ u64::from(byte));
        random
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from -1 up to but not 1, with all the digits an f64 has there.
    pub fn signed_f64(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A number below `count`, which is at least 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_splitmixs() {
        // The reference implementation's first numbers for the seed 1234567.
        let mut random = Random(1_234_567);
        let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(expected.map(|_| random.bits()), expected);
    }

    #[test]
    fn seeds_and_purposes_differ() {
        assert_ne!(Random::new(1, "a").bits(), Random::new(1, "b").bits());
        assert_ne!(Random::new(1, "a").bits(), Random::new(2, "a").bits());
    }
}
