//! Pictures whose sides are powers of two, for textures that repeat on drivers that repeat only such textures.

use super::Picture;
use crate::values::Size;

impl Picture {
    /// Returns the picture with sides of the next powers of two, interpolated as by GL_LINEAR, and across its edges as by
    /// GL_REPEAT.
    #[must_use]
    pub(crate) fn with_powers_of_two(&self) -> Self {
        let Size { width, height } = self.size;
        let size = Size { width: width.next_power_of_two(), height: height.next_power_of_two() };
        // A new texel's middle lies between two old texels: the first, and the share of the second.
        let between = |place: u32, new: u32, old: u32| {
            let middle = (f64::from(place) + 0.5) * f64::from(old) / f64::from(new) - 0.5;
            let first = middle.floor();
            let wrapped = |texel: f64| (texel as i64).rem_euclid(i64::from(old));
            ([wrapped(first), wrapped(first + 1.0)], middle - first)
        };
        let columns: Vec<_> = (0..size.width).map(|x| between(x, size.width, width)).collect();
        let mut pixels = Vec::with_capacity(size.pixel_count() * 4);
        for y in 0..size.height {
            let ([low, high], up) = between(y, size.height, height);
            for ([left, right], across) in &columns {
                let corners =
                    [(*left, low), (*right, low), (*left, high), (*right, high)].map(|(x, y)| self.pixel(x, y));
                let shares = [(1.0 - across) * (1.0 - up), across * (1.0 - up), (1.0 - across) * up, across * up];
                let mixed = |channel: usize| {
                    let sum: f64 = corners.iter().zip(shares).map(|(it, share)| f64::from(it[channel]) * share).sum();
                    sum.round() as u8
                };
                pixels.extend([0, 1, 2, 3].map(mixed));
            }
        }
        Self { size, pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_between_texels_are_mixed_and_edges_meet_around() {
        let grey = |values: &[u8], width: u32| Picture {
            size: Size { width, height: values.len() as u32 / width },
            pixels: values.iter().flat_map(|value| [*value, *value, *value, 255]).collect(),
        };
        let columns = grey(&[0, 120, 240], 3).with_powers_of_two();
        // Middles at 1/8, 3/8, 5/8, 7/8 of three texels: -1/8, 5/8, 11/8, 17/8.
        assert_eq!(columns, grey(&[30, 75, 165, 210], 4));
        assert_eq!(grey(&[0, 120, 240], 1).with_powers_of_two(), grey(&[30, 75, 165, 210], 1));
        let square = grey(&[1, 2, 3, 4], 2);
        assert_eq!(square.with_powers_of_two(), square, "powers of two stay");
    }
}
