//! The borders of a tone inside a triangle.
//!
//! In: a triangle, and at which weights of its corners the tone is. Out: lines that follow the tone's border from side to side of a
//! division of the triangle, with each end on the border. Blocks of the division that the border does not reach are never entered:
//! the work grows with the border's length, also where a long, narrow triangle is divided finely.

use glam::DVec3;

/// Halvings of a side that find where a border crosses it.
const HALVINGS: usize = 40;

/// A tone as a function of the weights of a triangle's corners.
pub(super) trait Tone {
    fn is_inside(&self, weights: [f64; 3]) -> bool;

    /// Whether the quadrilateral between these weights is surely all inside, or all outside.
    fn is_even(&self, corners: &[[f64; 3]; 4]) -> bool;
}

/// Adds the lines between the inside and the outside of a tone in a triangle, whose sides are divided into so many parts.
pub(super) fn add_borders(corners: [DVec3; 3], parts: usize, tone: &impl Tone, lines: &mut Vec<[DVec3; 2]>) {
    Division { corners, parts, tone, lines }.add(Block { low: [0; 2], size: [parts; 2] });
}

/// A part of the division: the steps from the first corner towards the second and the third at which it begins, and its size.
#[derive(Clone, Copy)]
struct Block {
    low: [usize; 2],
    size: [usize; 2],
}

struct Division<'a, T> {
    corners: [DVec3; 3],
    parts: usize,
    tone: &'a T,
    lines: &'a mut Vec<[DVec3; 2]>,
}

impl<T: Tone> Division<'_, T> {
    /// Adds the lines in a block; its part beyond the triangle has none.
    fn add(&mut self, Block { low: [i, j], size: [along, across] }: Block) {
        if i + j >= self.parts {
            return;
        }
        if along.max(across) == 1 {
            self.add_triangle([[i, j], [i + 1, j], [i, j + 1]]);
            if i + j + 1 < self.parts {
                self.add_triangle([[i + 1, j], [i + 1, j + 1], [i, j + 1]]);
            }
            return;
        }
        // Beyond the triangle a weight is negative; the part inside still lies between the four.
        let around = [[i, j], [i + along, j], [i + along, j + across], [i, j + across]].map(|steps| self.plain(steps));
        if self.tone.is_even(&around) {
            return;
        }
        let halves = |low: usize, size: usize| [(low, size / 2), (low + size / 2, size - size / 2)];
        for (i, along) in halves(i, along) {
            for (j, across) in halves(j, across) {
                if along > 0 && across > 0 {
                    self.add(Block { low: [i, j], size: [along, across] });
                }
            }
        }
    }

    /// The weights of a place of the division.
    fn plain(&self, steps: [usize; 2]) -> [f64; 3] {
        let [a, b] = steps.map(|steps| steps as f64 / self.parts as f64);
        [1.0 - a - b, a, b]
    }

    /// Like [`Division::plain`], and never negative by rounding.
    fn weights(&self, steps: [usize; 2]) -> [f64; 3] {
        let [first, a, b] = self.plain(steps);
        [first.max(0.0), a, b]
    }

    /// Adds the line in a triangle of the division.
    fn add_triangle(&mut self, triangle: [[usize; 2]; 3]) {
        let is_in = triangle.map(|steps| self.tone.is_inside(self.weights(steps)));
        let Some(single) = (0..3).find(|corner| {
            let others = [is_in[(corner + 1) % 3], is_in[(corner + 2) % 3]];
            others == [!is_in[*corner]; 2]
        }) else {
            return;
        };
        let ends = [1, 2].map(|step| {
            let (one, other) = (triangle[single], triangle[(single + step) % 3]);
            if is_in[single] { self.between(one, other) } else { self.between(other, one) }
        });
        self.lines.push(ends);
    }

    /// The point of the border between two places.
    fn between(&self, inside: [usize; 2], outside: [usize; 2]) -> DVec3 {
        let (mut inside, mut outside) = (self.weights(inside), self.weights(outside));
        for _ in 0..HALVINGS {
            let middle = [0, 1, 2].map(|corner| (inside[corner] + outside[corner]) * 0.5);
            *(if self.tone.is_inside(middle) { &mut inside } else { &mut outside }) = middle;
        }
        self.corners[0] * inside[0] + self.corners[1] * inside[1] + self.corners[2] * inside[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// Inside of a distance from a centre, both in weights.
    struct Disc {
        center: [f64; 3],
        radius: f64,
        asked: Cell<usize>,
    }

    impl Disc {
        fn distance(&self, weights: [f64; 3]) -> f64 {
            DVec3::from(weights).distance(DVec3::from(self.center))
        }
    }

    impl Tone for Disc {
        fn is_inside(&self, weights: [f64; 3]) -> bool {
            self.asked.set(self.asked.get() + 1);
            self.distance(weights) < self.radius
        }

        fn is_even(&self, corners: &[[f64; 3]; 4]) -> bool {
            let middle = corners.iter().map(|corner| DVec3::from(*corner)).sum::<DVec3>() / 4.0;
            let reach = corners.iter().map(|corner| DVec3::from(*corner).distance(middle)).fold(0.0, f64::max);
            (self.distance(middle.to_array()) - self.radius).abs() > reach
        }
    }

    /// The same, with every block entered.
    struct Everywhere(Disc);

    impl Tone for Everywhere {
        fn is_inside(&self, weights: [f64; 3]) -> bool {
            self.0.is_inside(weights)
        }

        fn is_even(&self, _: &[[f64; 3]; 4]) -> bool {
            false
        }
    }

    #[test]
    fn a_border_is_found_whole_without_a_look_at_the_rest_of_the_triangle() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for parts in [1, 2, 3, 7, 64, 333] {
            for center in [[0.3, 0.3, 0.4], [0.0, 0.5, 0.5], [1.0, 0.0, 0.0], [0.1, 0.8, 0.1]] {
                let disc = || Disc { center, radius: 0.21, asked: Cell::new(0) };
                let (quick, every) = (disc(), Everywhere(disc()));
                let (mut found, mut expected) = (Vec::new(), Vec::new());
                add_borders(corners, parts, &quick, &mut found);
                add_borders(corners, parts, &every, &mut expected);
                assert_eq!(found, expected, "{parts} parts around {center:?}");
                let (asked, all) = (quick.asked.get(), every.0.asked.get());
                let most = 100 * expected.len() + 100;
                assert!(asked <= most.min(all), "{parts} parts around {center:?}: {asked} questions of {all}");
            }
        }
    }
}
