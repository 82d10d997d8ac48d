//! How far every place of a picture is from the nearest pixel with ink: exact squared distances in two passes, rows after columns
//! (Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012).

use crate::compare::InkMask;
use glam::DVec2;

/// Distances from pixels' middles, no farther than a limit.
pub(super) struct Distances {
    width: usize,
    height: usize,
    px: Vec<f64>,
    farthest_px: f64,
}

impl Distances {
    /// To the middles of a mask's pixels.
    pub(super) fn to(mask: &InkMask, farthest_px: f64) -> Self {
        let [width, height] = [mask.size.width as usize, mask.size.height as usize];
        let far = (width * width + height * height) as f64;
        let mut squared: Vec<f64> = mask.ink.iter().map(|ink| if *ink { 0.0 } else { far }).collect();
        for x in 0..width {
            let column: Vec<f64> = (0..height).map(|y| squared[y * width + x]).collect();
            for (y, value) in lowest(&column).into_iter().enumerate() {
                squared[y * width + x] = value;
            }
        }
        for row in squared.chunks_exact_mut(width) {
            row.copy_from_slice(&lowest(row));
        }
        let px = squared.into_iter().map(|squared| squared.sqrt().min(farthest_px)).collect();
        Self { width, height, px, farthest_px }
    }

    /// At any place, between the pixels around it; outside the picture the way to it is added.
    pub(super) fn at(&self, px: DVec2) -> f64 {
        let most = DVec2::new((self.width - 1) as f64, (self.height - 1) as f64);
        let inside = (px - 0.5).clamp(DVec2::ZERO, most);
        let low = inside.floor().min(most);
        let [x, y] = [low.x as usize, low.y as usize];
        let [right, down] = [(x + 1).min(self.width - 1), (y + 1).min(self.height - 1)];
        let part = inside - low;
        let at = |x: usize, y: usize| self.px[y * self.width + x];
        let row = |y: usize| at(x, y) * (1.0 - part.x) + at(right, y) * part.x;
        let there = row(y) * (1.0 - part.y) + row(down) * part.y;
        (there + inside.distance(px - 0.5)).min(self.farthest_px)
    }
}

/// For each place the least of `values[other] + (place - other)^2`: the lower envelope of parabolas.
fn lowest(values: &[f64]) -> Vec<f64> {
    // The parabolas of the envelope, each with the place where it begins to be the lowest.
    let mut envelope: Vec<(usize, f64)> = Vec::new();
    for (place, value) in values.iter().enumerate() {
        let meets = |other: usize| {
            let [here, there] = [place as f64, other as f64];
            ((value + here * here) - (values[other] + there * there)) / (2.0 * (here - there))
        };
        while envelope.last().is_some_and(|(other, begins)| meets(*other) <= *begins) {
            envelope.pop();
        }
        let begins = envelope.last().map_or(f64::NEG_INFINITY, |(other, _)| meets(*other));
        envelope.push((place, begins));
    }
    let mut current = 0;
    let lowest_at = |place: usize| {
        while envelope.get(current + 1).is_some_and(|(_, begins)| *begins <= place as f64) {
            current += 1;
        }
        let other = envelope[current].0;
        values[other] + (place as f64 - other as f64).powi(2)
    };
    (0..values.len()).map(lowest_at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    #[test]
    fn every_pixel_is_as_far_from_ink_as_a_search_of_all_ink_says() {
        let mut random = tinta::random::Random::new(5, "ink");
        for count in [1, 3, 20, 200] {
            let mut ink = vec![false; 23 * 17];
            (0..count).for_each(|_| ink[random.below(23 * 17)] = true);
            let mask = InkMask { size: Size { width: 23, height: 17 }, ink };
            let distances = Distances::to(&mask, 12.0);
            let place = |index: usize| DVec2::new((index % 23) as f64 + 0.5, (index / 23) as f64 + 0.5);
            for index in 0..23 * 17 {
                let inked = (0..23 * 17).filter(|other| mask.ink[*other]);
                let nearest = inked.map(|other| place(other).distance(place(index))).fold(12.0, f64::min);
                assert!((distances.at(place(index)) - nearest).abs() < 1e-9);
            }
        }
    }
}
