//! Gaussian blur of a grid of numbers. Columns wrap around, as textures do under GL_REPEAT; a parameter decides for rows.

use crate::scene::Size;

/// The values above the first row and below the last.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Rows {
    /// The rows at the other end.
    Wrap,
    /// The same row again.
    Clamp,
}

/// Blurs `values`, row by row; `deviation_px` is the Gaussian's standard deviation, cut off at three of them.
pub(super) fn gaussian(values: &[f32], size: Size, deviation_px: f64, rows: Rows) -> Vec<f32> {
    let weights = weights(deviation_px);
    let reach = weights.len() / 2;
    let (width, height) = (size.width as usize, size.height as usize);
    let mut across = vec![0.0f32; values.len()];
    let mut padded = vec![0.0f32; width + 2 * reach];
    for (row, sums) in values.chunks_exact(width).zip(across.chunks_exact_mut(width)) {
        let wrapped = row.iter().cycle().skip((width - reach % width) % width);
        padded.iter_mut().zip(wrapped).for_each(|(to, from)| *to = *from);
        // Tap by tap over the whole row: the compiler vectorises it, and the order of sums is fixed.
        for (tap, weight) in weights.iter().enumerate() {
            sums.iter_mut().zip(&padded[tap..]).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    let mut down = vec![0.0f32; values.len()];
    for (y, sums) in down.chunks_exact_mut(width).enumerate() {
        for (tap, weight) in weights.iter().enumerate() {
            let from = (y + tap) as isize - reach as isize;
            let from = match rows {
                Rows::Wrap => from.rem_euclid(height as isize),
                Rows::Clamp => from.clamp(0, height as isize - 1),
            } as usize;
            let row = &across[from * width..][..width];
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    down
}

/// Returns an odd number of weights with the sum 1, in whole multiples of 2^-16. The rounding hides differences of libraries'
/// `exp` in the last bit, and makes sums of weights times bytes exact.
fn weights(deviation_px: f64) -> Vec<f32> {
    const UNIT: f64 = 65_536.0;
    if deviation_px <= 0.0 {
        return vec![1.0];
    }
    let reach = (deviation_px * 3.0).ceil() as i32;
    let bell = |x: i32| (-0.5 * (f64::from(x) / deviation_px).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(bell).sum();
    let mut weights: Vec<f64> = (-reach..=reach).map(|x| (bell(x) / sum * UNIT).round()).collect();
    let rest = UNIT - weights.iter().sum::<f64>();
    weights[reach as usize] += rest;
    weights.iter().map(|weight| (weight / UNIT) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dot(size: Size, x: usize, y: usize) -> Vec<f32> {
        let mut values = vec![0.0; size.pixel_count()];
        values[y * size.width as usize + x] = 1.0;
        values
    }

    #[test]
    fn a_blurred_dot_keeps_its_sum_and_has_the_deviation_asked_for() {
        let size = Size { width: 64, height: 48 };
        for deviation in [0.7, 1.0, 3.0] {
            let blurred = gaussian(&dot(size, 30, 20), size, deviation, Rows::Clamp);
            assert!((blurred.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            let variance: f64 = blurred
                .iter()
                .enumerate()
                .map(|(at, value)| ((at % 64) as f64 - 30.0).powi(2) * f64::from(*value))
                .sum();
            assert!((variance.sqrt() / deviation - 1.0).abs() < 0.03, "{deviation}: {}", variance.sqrt());
        }
    }

    #[test]
    fn a_shifted_picture_blurs_to_the_shifted_blur() {
        let size = Size { width: 9, height: 7 };
        let middle = gaussian(&dot(size, 4, 3), size, 2.5, Rows::Wrap);
        let corner = gaussian(&dot(size, 0, 6), size, 2.5, Rows::Wrap);
        for y in 0..7 {
            for x in 0..9 {
                let shifted = (y + 3) % 7 * 9 + (x + 5) % 9;
                assert!((middle[y * 9 + x] - corner[shifted]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn clamped_rows_do_not_reach_the_other_end() {
        let size = Size { width: 4, height: 20 };
        let blurred = gaussian(&dot(size, 1, 19), size, 1.0, Rows::Clamp);
        assert_eq!(blurred[..4], [0.0; 4]);
        assert!(gaussian(&dot(size, 1, 19), size, 1.0, Rows::Wrap)[1] > 0.0);
    }

    #[test]
    fn without_a_deviation_and_in_one_pixel_nothing_changes() {
        let size = Size { width: 1, height: 1 };
        assert_eq!(gaussian(&[0.25], size, 5.0, Rows::Wrap), [0.25]);
        let size = Size { width: 3, height: 1 };
        assert_eq!(gaussian(&[1.0, 2.0, 3.0], size, 0.0, Rows::Wrap), [1.0, 2.0, 3.0]);
    }
}
