//! A bicubic patch: the height y over a square is a cubic polynomial in x and in z.
//!
//! Input: its coefficients and an eye. Output: the contour on both of its sides as short straight segments, and which
//! of them are visible. Along a ray from a point of the contour, the height over the patch is a polynomial of degree
//! six with a double root at the point. The remaining factor has degree four; any root of it inside the square hides
//! the point. Its roots are found between those of its derivative.

use crate::edges::Eye;
use glam::{DVec2, DVec3};

/// A patch over the square from -1 to 1 in x and z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// `coefficients[i][j]` is the coefficient of `x^i z^j` in y.
    pub coefficients: [[f64; 4]; 4],
}

/// Cells of the square in each direction; their sides are searched for the contour.
const CELLS: usize = 768;

/// Bisections of a cell's side or of a root's range; more exceed the precision of f64.
const HALVINGS: usize = 52;

impl Patch {
    /// Hills that hide one another, and a saddle at the rim.
    pub const HILLS: Self = Self {
        coefficients: [[0.1, 0.9, 0.0, -1.1], [-0.8, 0.2, 0.3, 0.0], [0.1, 0.0, -0.4, 0.2], [1.0, 0.1, 0.0, 0.0]],
    };

    /// Hills from a seed: none as steep as a wall, most with contours from the side.
    #[cfg(test)]
    pub(in crate::lines) fn random(number: u64) -> Self {
        let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut coefficients = [[0.0; 4]; 4];
        for (place, share) in coefficients.as_flattened_mut().iter_mut().enumerate() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let from_minus_one_to_one = (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0;
            // Small weights for high powers.
            *share = from_minus_one_to_one / (1 + (place % 4) * (place / 4)) as f64;
        }
        Self { coefficients }
    }

    /// The point over a place of the square.
    pub(super) fn point(&self, place: DVec2) -> DVec3 {
        let row = |row: &[f64; 4]| row.iter().rev().fold(0.0, |sum, share| sum * place.y + share);
        let height = self.coefficients.iter().rev().fold(0.0, |sum, shares| sum * place.x + row(shares));
        DVec3::new(place.x, height, place.y)
    }

    /// The normal at a place, of any length.
    fn normal(&self, place: DVec2) -> DVec3 {
        let (mut along_x, mut along_z) = (0.0, 0.0);
        for (i, shares) in self.coefficients.iter().enumerate() {
            for (j, share) in shares.iter().enumerate() {
                let power = |base: f64, exponent: usize| base.powi(exponent as i32);
                if i > 0 {
                    along_x += share * i as f64 * power(place.x, i - 1) * power(place.y, j);
                }
                if j > 0 {
                    along_z += share * j as f64 * power(place.x, i) * power(place.y, j - 1);
                }
            }
        }
        DVec3::new(-along_x, 1.0, -along_z)
    }

    /// The vertices and triangles of a mesh with about this many triangles. `random` gives numbers from -1 to 1 that
    /// move inner vertices by up to `jitter` of a cell.
    /// vertices inside the rim by up to `jitter` of a cell.
    pub(super) fn mesh(
        &self,
        triangles: usize,
        jitter: f64,
        mut random: impl FnMut() -> f64,
    ) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let cells = (triangles as f64 / 2.0).sqrt().round().max(1.0) as u32;
        let mut positions = Vec::new();
        for row in 0..=cells {
            for column in 0..=cells {
                let is_inner = row > 0 && row < cells && column > 0 && column < cells;
                let shift = DVec2::new(random(), random()) * if is_inner { jitter } else { 0.0 };
                let place = (DVec2::new(f64::from(column), f64::from(row)) + shift) / f64::from(cells);
                positions.push(self.point(place * 2.0 - 1.0));
            }
        }
        let at = |column: u32, row: u32| row * (cells + 1) + column;
        let faces = (0..cells).flat_map(|row| {
            (0..cells).flat_map(move |column| {
                quad([at(column, row), at(column, row + 1), at(column + 1, row + 1), at(column + 1, row)])
            })
        });
        (positions, faces.collect())
    }

    /// The visible segments of the contour, each shorter than a cell.
    pub(super) fn visible_pieces(&self, eye: Eye) -> Vec<[DVec3; 2]> {
        let mut seen = Vec::new();
        for [a, b] in self.contour(eye) {
            let is_seen = |share: f64| self.is_seen(a.lerp(b, share), eye);
            let range = match [is_seen(0.0), is_seen(1.0)] {
                [true, true] => [0.0, 1.0],
                [true, false] => [0.0, change(is_seen, [0.0, 1.0])],
                [false, true] => [change(is_seen, [0.0, 1.0]), 1.0],
                [false, false] => continue,
            };
            seen.push(range.map(|share| self.point(a.lerp(b, share))));
        }
        seen
    }

    /// The contour in the square, as segments through cells.
    pub(super) fn contour(&self, eye: Eye) -> Vec<[DVec2; 2]> {
        let is_front = |place: DVec2| self.normal(place).dot(way(eye, self.point(place))) >= 0.0;
        let at = |column: usize, row: usize| DVec2::new(column as f64, row as f64) * (2.0 / CELLS as f64) - 1.0;
        let fronts: Vec<Vec<bool>> =
            (0..=CELLS).map(|row| (0..=CELLS).map(|column| is_front(at(column, row))).collect()).collect();
        let mut pieces = Vec::new();
        for row in 0..CELLS {
            for column in 0..CELLS {
                let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                let sides = (0..4).map(|side| [corners[side], corners[(side + 1) % 4]]);
                let crossed = sides.filter(|[a, b]| fronts[a.1][a.0] != fronts[b.1][b.0]);
                let points: Vec<DVec2> = crossed
                    .map(|[a, b]| {
                        let (a, b) = (at(a.0, a.1), at(b.0, b.1));
                        a.lerp(b, change(|share| is_front(a.lerp(b, share)), [0.0, 1.0]))
                    })
                    .collect();
                pieces.extend(points.chunks_exact(2).map(|ends| [ends[0], ends[1]]));
            }
        }
        pieces
    }

    /// Whether an eye sees a point of the contour.
    pub(super) fn is_seen(&self, place: DVec2, eye: Eye) -> bool {
        let point = self.point(place);
        let way = way(eye, point);
        // The height of the ray over the patch, while the ray is over the square.
        let mut height = [0.0; 7];
        let line = |start: f64, step: f64, exponent: usize| {
            (0..exponent).fold(vec![1.0], |power: Vec<f64>, _| {
                let mut next = vec![0.0; power.len() + 1];
                for (k, share) in power.iter().enumerate() {
                    next[k] += share * start;
                    next[k + 1] += share * step;
                }
                next
            })
        };
        for (i, shares) in self.coefficients.iter().enumerate() {
            for (j, share) in shares.iter().enumerate() {
                for (k, x) in line(place.x, way.x, i).iter().enumerate() {
                    for (l, z) in line(place.y, way.z, j).iter().enumerate() {
                        height[k + l] -= share * x * z;
                    }
                }
            }
        }
        let leaves = |start: f64, step: f64| if step == 0.0 { f64::INFINITY } else { (step.signum() - start) / step };
        let end = leaves(place.x, way.x).min(leaves(place.y, way.z));
        let end = if matches!(eye, Eye::Point(_)) { end.min(1.0) } else { end };
        // Without the double root; the linear term, which belongs to it, is pure rounding.
        roots(&height[2..], [0.0, end]).is_empty()
    }
}

/// The direction from a point to the eye.
fn way(eye: Eye, point: DVec3) -> DVec3 {
    match eye {
        Eye::Point(eye) => eye - point,
        Eye::Direction(direction) => direction,
    }
}

/// The place between two others where a condition changes; it holds at exactly one of them.
fn change(holds: impl Fn(f64) -> bool, [mut from, mut to]: [f64; 2]) -> f64 {
    let at_from = holds(from);
    for _ in 0..HALVINGS {
        let middle = (from + to) * 0.5;
        if holds(middle) == at_from { from = middle } else { to = middle }
    }
    (from + to) * 0.5
}

/// The sign changes of a polynomial between two places; coefficients start with the constant.
fn roots(polynomial: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let value = |place: f64| polynomial.iter().rev().fold(0.0, |sum, share| sum * place + share);
    let derivative: Vec<f64> =
        polynomial.iter().enumerate().skip(1).map(|(exponent, share)| share * exponent as f64).collect();
    let mut places = vec![from];
    places.extend(roots(&derivative, [from, to]));
    places.push(to);
    let changed = places.windows(2).filter(|ends| (value(ends[0]) > 0.0) != (value(ends[1]) > 0.0));
    changed.map(|ends| change(|place| value(place) > 0.0, [ends[0], ends[1]])).collect()
}

pub(super) fn quad([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_those_of_factors() {
        // (t - 0.25) (t - 0.5) (t - 2) (t + 1)
        let polynomial = [-0.25, 1.375, -1.125, -1.75, 1.0];
        let found = roots(&polynomial, [0.0, 1.0]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[0] - 0.25).abs() < 1e-12 && (found[1] - 0.5).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_patch_hides_what_small_steps_along_the_ray_find_hidden() {
        let (mut hidden, mut seen) = (0, 0);
        let patches = std::iter::once(Patch::HILLS).chain((1..=6).map(Patch::random));
        for (number, patch) in patches.enumerate() {
            for eye in [
                Eye::Point(DVec3::new(3.0, 1.0, 2.0)),
                Eye::Point(DVec3::new(-2.0, 0.4, 3.0)),
                Eye::Direction(DVec3::new(1.0, 0.3, 0.4)),
                Eye::Direction(DVec3::new(-0.3, -0.2, 1.0)),
            ] {
                for place in patch.contour(eye).into_iter().step_by(7).map(|[a, b]| (a + b) * 0.5) {
                    let point = patch.point(place);
                    let way = way(eye, point) * if matches!(eye, Eye::Direction(_)) { 4.0 } else { 1.0 };
                    let heights = (1..=20_000).map(|k| point + way * (f64::from(k) / 20_000.0));
                    let over = heights.take_while(|at| at.x.abs() <= 1.0 && at.z.abs() <= 1.0);
                    let heights = over.map(|at| at.y - patch.point(DVec2::new(at.x, at.z)).y);
                    let (low, high) =
                        heights.fold((0.0f64, 0.0f64), |(low, high), height| (low.min(height), high.max(height)));
                    // Grazes shallower than this are below the sampling's resolution.
                    if low < -1e-5 && high > 1e-5 {
                        assert!(!patch.is_seen(place, eye), "{number} {place} {eye:?}: {low} {high}");
                        hidden += 1;
                    } else if low > -1e-9 || high < 1e-9 {
                        assert!(patch.is_seen(place, eye), "{number} {place} {eye:?}: {low} {high}");
                        seen += 1;
                    }
                }
            }
        }
        assert!(hidden > 100 && seen > 500, "{hidden} {seen}");
    }
}
