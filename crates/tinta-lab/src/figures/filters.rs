//! The filters' matrices, as the texts print them and as the shaders compute them (Evangelista et al. 2005, figures 10 and 11).

use tinta::styles::Filter;

/// A matrix over a pixel and its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kernel {
    /// Weights, the upper row first, as a text prints them.
    pub rows: [[i8; 3]; 3],
    /// The common divisor.
    pub divisor: i8,
}

impl Kernel {
    /// The weight in this row from the top and this column from the left.
    pub fn weight(&self, row: usize, column: usize) -> f64 {
        f64::from(self.rows[row][column]) / f64::from(self.divisor)
    }
}

/// The matrices of a filter: one, or two for those that are a gradient's length. Mitchell's is the pattern of the pixels that he
/// reads, which is all that is printed of it.
pub fn kernels(filter: Filter) -> Vec<Kernel> {
    let whole = |rows| Kernel { rows, divisor: 1 };
    match filter {
        Filter::Laplacian4 => vec![whole([[0, -1, 0], [-1, 4, -1], [0, -1, 0]])],
        Filter::Laplacian8 => vec![whole([[-1, -1, -1], [-1, 8, -1], [-1, -1, -1]])],
        Filter::Mitchell | Filter::MitchellTwo => vec![whole([[1, 0, 1], [0, 1, 0], [1, 0, 1]])],
        Filter::Sobel => {
            vec![whole([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]]), whole([[1, 2, 1], [0, 0, 0], [-1, -2, -1]])]
        }
        Filter::Roberts => vec![whole([[0, 0, -1], [0, 1, 0], [0, 0, 0]]), whole([[0, -1, 0], [0, 0, 1], [0, 0, 0]])],
        Filter::Gaussian => vec![Kernel { rows: [[-1, -2, -1], [-2, 12, -2], [-1, -2, -1]], divisor: 3 }],
    }
}
