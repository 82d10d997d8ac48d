//! Hilbert's space-filling curve: points near each other get numbers near each other.

use glam::DVec3;

/// The place of a point with coordinates in [0, 1023] on Hilbert's space-filling curve (Skilling 2004), which, unlike
/// Morton's, never jumps.
pub(super) fn hilbert_code(point: DVec3) -> u32 {
    const BITS: u32 = 10;
    let mut axes = point.to_array().map(|coordinate| (coordinate as u32).min((1 << BITS) - 1));
    for bit in (1..BITS).rev() {
        let (mask, low) = (1 << bit, (1 << bit) - 1);
        for axis in 0..3 {
            if axes[axis] & mask != 0 {
                axes[0] ^= low;
            } else {
                let exchange = (axes[0] ^ axes[axis]) & low;
                axes[0] ^= exchange;
                axes[axis] ^= exchange;
            }
        }
    }
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    let flip =
        (1..BITS).rev().fold(0, |flip, bit| if axes[2] & (1 << bit) != 0 { flip ^ ((1 << bit) - 1) } else { flip });
    let axes = axes.map(|axis| axis ^ flip);
    // The bits of the three axes in turn, highest first.
    (0..BITS).rev().fold(0, |code, bit| axes.iter().fold(code, |code, axis| code << 1 | (axis >> bit & 1)))
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_curve_visits_every_cell_once_and_never_jumps() {
        // The first 8 x 8 x 8 cells of the curve are a cube; in the order of their codes neighbours differ by one step.
        let mut cells: Vec<(u32, [i32; 3])> = (0..512)
            .map(|i| [i & 7, i >> 3 & 7, i >> 6])
            .map(|cell| (super::hilbert_code(glam::IVec3::from_array(cell).as_dvec3()), cell))
            .collect();
        cells.sort_unstable();
        for pair in cells.windows(2) {
            assert_eq!(pair[1].0, pair[0].0 + 1, "codes are consecutive");
            let step: i32 = (0..3).map(|axis| (pair[0].1[axis] - pair[1].1[axis]).abs()).sum();
            assert_eq!(step, 1, "{pair:?}");
        }
    }
}
