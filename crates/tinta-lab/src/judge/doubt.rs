//! Whether a drawing can be judged at all: a shaded picture has areas instead of lines, and the lines of another camera lie elsewhere.
//!
//! Takes a drawing's ink, the lines, and how much of both agree; returns a [`Doubt`], which is a reason and no proof.

use super::distances::Distances;
use crate::compare::InkMask;
use crate::measure::{INK_FROM, Ink, LineError, Reference};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::fmt::{Display, Formatter};

/// Why a drawing's numbers probably do not describe its lines.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Doubt {
    /// Most of the ink lies in areas wider than any line: its share.
    Shaded(f64),
    /// Ink and lines agree by hardly more than chance: the larger of precision and recall, scaled to 0 at chance and 1 at full
    /// agreement.
    Elsewhere(f64),
}

/// Side of the smallest square of ink that is an area, as a share of the picture's diagonal: 13 pixels of a picture of 512 x 512, where
/// the widest lines of the styles have 6.
const AREA_SIDE: f64 = 0.018;

/// Its least side in small pictures, pixels: lines are as wide there as in large ones.
const LEAST_SIDE_PX: usize = 8;

/// Least share of the ink in areas that marks a drawing as shaded.
const SHADED: f64 = 0.5;

/// Precision and recall, less the chance level, below which lines count as another view's. Drawings of the right view lack lines
/// or have false ones, rarely both.
const AGREEING: f64 = 0.35;

/// Distance within which ink and lines agree, pixels.
const NEAR_PX: f64 = 2.0;

impl Doubt {
    /// The reason against judging this ink by these lines, given their agreement.
    pub(super) fn of(ink: &Ink, reference: &Reference, lines: &LineError) -> Option<Self> {
        let shaded = share_in_areas(ink);
        if shaded > SHADED {
            return Some(Self::Shaded(shaded));
        }
        let drawn = InkMask::of_darkness(ink.size, &ink.darkness);
        let wanted = InkMask::of_points(ink.size, reference.samples.iter().map(|sample| sample.px));
        if drawn.count() == 0 || wanted.count() == 0 {
            return None;
        }
        let [near_lines, near_ink] = [&wanted, &drawn].map(|mask| share_near(mask, &[&drawn, &wanted], NEAR_PX));
        let beyond_chance = |share: f64, chance: f64| ((share - chance) / (1.0 - chance).max(f64::EPSILON)).max(0.0);
        let agreeing = beyond_chance(lines.precision, near_lines).max(beyond_chance(lines.recall, near_ink));
        (agreeing < AGREEING).then_some(Self::Elsewhere(agreeing))
    }
}

impl Display for Doubt {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Shaded(share) => write!(
                f,
                "this looks like a shaded picture, with {:.0} % of the ink in areas; draw its lines alone, or name their colour \
                 with --ink",
                share * 100.0
            ),
            Self::Elsewhere(share) => write!(
                f,
                "this looks like another camera or model, as lines and ink agree by {:.0} % more than chance; name the camera with \
                 --camera or --view, or try --fit",
                share * 100.0
            ),
        }
    }
}

/// The share of the box around all of these masks within a distance of one of them: the chance level of being near it.
fn share_near(mask: &InkMask, around: &[&InkMask], distance_px: f64) -> f64 {
    let width = mask.size.width as usize;
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for place in
        around.iter().flat_map(|mask| mask.ink.iter().enumerate().filter(|(_, ink)| **ink).map(|(index, _)| index))
    {
        let place = [place % width, place / width];
        (low, high) = ([0, 1].map(|axis| low[axis].min(place[axis])), [0, 1].map(|axis| high[axis].max(place[axis])));
    }
    let distances = Distances::to(mask, distance_px + 1.0);
    let middles =
        (low[1]..=high[1]).flat_map(|y| (low[0]..=high[0]).map(move |x| DVec2::new(x as f64 + 0.5, y as f64 + 0.5)));
    let count = (high[0] + 1 - low[0]) * (high[1] + 1 - low[1]);
    middles.filter(|middle| distances.at(*middle) <= distance_px).count() as f64 / count as f64
}

/// The share of the ink that a square of [`AREA_SIDE`] full of ink covers.
fn share_in_areas(ink: &Ink) -> f64 {
    let [width, height] = [ink.size.width as usize, ink.size.height as usize];
    let side = ((AREA_SIDE * (width as f64).hypot(height as f64)).round() as usize).max(LEAST_SIDE_PX);
    let inked: Vec<bool> = ink.darkness.iter().map(|darkness| *darkness >= INK_FROM).collect();
    let count = inked.iter().filter(|ink| **ink).count();
    if count == 0 || side > width || side > height {
        return 0.0;
    }
    // First whether the square at an upper left corner is full; then whether any of the squares over a pixel is.
    let sums = Sums::of(&inked, width);
    let full: Vec<bool> = (0..width * height)
        .map(|index| {
            let (x, y) = (index % width, index / width);
            x + side <= width && y + side <= height && sums.within([x, y], [x + side, y + side]) == side * side
        })
        .collect();
    let sums = Sums::of(&full, width);
    let is_covered = |index: usize| {
        let (x, y) = (index % width, index / width);
        sums.within([(x + 1).saturating_sub(side), (y + 1).saturating_sub(side)], [x + 1, y + 1]) > 0
    };
    let covered = (0..inked.len()).filter(|index| inked[*index] && is_covered(*index)).count();
    covered as f64 / count as f64
}

/// How many pixels above and to the left of each corner are set.
struct Sums {
    columns: usize,
    sums: Vec<usize>,
}

impl Sums {
    fn of(set: &[bool], width: usize) -> Self {
        let columns = width + 1;
        let mut sums = vec![0; columns];
        for row in set.chunks_exact(width) {
            let mut so_far = 0;
            let above = sums.len() - columns;
            sums.push(0);
            for (x, is_set) in row.iter().enumerate() {
                so_far += usize::from(*is_set);
                sums.push(sums[above + x + 1] + so_far);
            }
        }
        Self { columns, sums }
    }

    /// From one corner to another.
    fn within(&self, [left, top]: [usize; 2], [right, bottom]: [usize; 2]) -> usize {
        let at = |x: usize, y: usize| self.sums[y * self.columns + x];
        at(right, bottom) + at(left, top) - at(right, top) - at(left, bottom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    /// A picture of 200 x 100 pixels with ink where the condition holds.
    fn ink(is_ink: impl Fn(usize, usize) -> bool) -> Ink {
        let size = Size { width: 200, height: 100 };
        let darkness = (0..200 * 100).map(|index| if is_ink(index % 200, index / 200) { 255 } else { 0 });
        Ink { size, darkness: darkness.collect() }
    }

    #[test]
    fn lines_are_no_areas_and_areas_are() {
        assert_eq!(share_in_areas(&ink(|_, _| false)), 0.0);
        assert_eq!(share_in_areas(&ink(|x, y| x < 3 || y == 50 || x % 20 < 2)), 0.0);
        assert_eq!(share_in_areas(&ink(|x, y| (20..60).contains(&x) && (10..50).contains(&y))), 1.0);
        // 40 x 40 pixels of area beside 80 of a line.
        let both = ink(|x, y| (20..60).contains(&x) && (10..50).contains(&y) || y == 80 && x >= 120);
        assert!((share_in_areas(&both) - 1600.0 / 1680.0).abs() < 1e-12);
    }

    #[test]
    fn sums_count_what_lies_within() {
        let set: Vec<bool> = (0..12).map(|index| index % 3 == 0).collect();
        let sums = Sums::of(&set, 4);
        assert_eq!(sums.within([0, 0], [4, 3]), 4);
        assert_eq!(sums.within([1, 0], [4, 1]), 1);
        assert_eq!(sums.within([0, 1], [3, 3]), 2);
        assert_eq!(sums.within([0, 1], [2, 2]), 0);
    }
}
