//! Pixels of two masks paired one to one, as many as can be: Hopcroft and Karp (SIAM Journal on Computing 2, 1973).
//!
//! The Berkeley benchmark solves an assignment of least cost with a penalty for unmatched pixels above the cost of any pair; it
//! finds as many pairs.

use crate::compare::InkMask;
use std::collections::VecDeque;

/// No partner.
const NONE: u32 = u32::MAX;

/// Number of pixels of `left` with a separate partner in `right`, at most `distance_px` away.
pub fn matched(left: &InkMask, right: &InkMask, distance_px: f64) -> usize {
    let mut pairs = Pairs::new(left, right, distance_px);
    let mut count = pairs.take_nearest();
    while pairs.find_layers() {
        let free: Vec<u32> = (0..pairs.of_left.len() as u32).filter(|l| pairs.of_left[*l as usize] == NONE).collect();
        count += free.into_iter().filter(|start| pairs.augment(*start)).count();
    }
    count
}

struct Pairs {
    /// The possible partners: for each pixel on the left those on the right, the nearest first; a range of `candidates` each.
    ranges: Vec<[u32; 2]>,
    candidates: Vec<u32>,
    of_left: Vec<u32>,
    of_right: Vec<u32>,
    /// Steps from a free pixel on the left, as paths alternate.
    layer: Vec<u32>,
    /// How far each one's candidates were tried in this round.
    tried: Vec<u32>,
}

impl Pairs {
    fn new(left: &InkMask, right: &InkMask, distance_px: f64) -> Self {
        let (width, height) = (i64::from(right.size.width), i64::from(right.size.height));
        let reach = distance_px.floor() as i64;
        let mut disc: Vec<(i64, i64)> = (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| (x, y))).collect();
        disc.retain(|(x, y)| (x * x + y * y) as f64 <= distance_px * distance_px);
        disc.sort_by_key(|(x, y)| (x * x + y * y, *y, *x));
        let mut number = vec![NONE; right.ink.len()];
        let mut rights = 0;
        for (index, _) in right.ink.iter().enumerate().filter(|(_, ink)| **ink) {
            number[index] = rights;
            rights += 1;
        }
        let (mut ranges, mut candidates) = (Vec::new(), Vec::new());
        for (index, _) in left.ink.iter().enumerate().filter(|(_, ink)| **ink) {
            let (x, y) = (index as i64 % width, index as i64 / width);
            let first = candidates.len() as u32;
            for (dx, dy) in &disc {
                let (x, y) = (x + dx, y + dy);
                if (0..width).contains(&x) && (0..height).contains(&y) {
                    candidates.extend(Some(number[(y * width + x) as usize]).filter(|number| *number != NONE));
                }
            }
            ranges.push([first, candidates.len() as u32]);
        }
        let lefts = ranges.len();
        Self {
            ranges,
            candidates,
            of_left: vec![NONE; lefts],
            of_right: vec![NONE; rights as usize],
            layer: vec![NONE; lefts],
            tried: vec![0; lefts],
        }
    }

    /// Pairs each pixel with the nearest free one: most of them at once.
    fn take_nearest(&mut self) -> usize {
        let mut count = 0;
        for (left, [first, end]) in self.ranges.iter().enumerate() {
            let free =
                self.candidates[*first as usize..*end as usize].iter().find(|r| self.of_right[**r as usize] == NONE);
            if let Some(right) = free {
                (self.of_left[left], self.of_right[*right as usize]) = (*right, left as u32);
                count += 1;
            }
        }
        count
    }

    /// Builds layers of alternating paths from every unmatched pixel; returns whether one of them ends at a free partner.
    fn find_layers(&mut self) -> bool {
        let mut queue = VecDeque::new();
        for (left, partner) in self.of_left.iter().enumerate() {
            self.layer[left] = if *partner == NONE { 0 } else { NONE };
            self.tried[left] = self.ranges[left][0];
            if *partner == NONE {
                queue.push_back(left);
            }
        }
        let mut has_end = false;
        while let Some(left) = queue.pop_front() {
            let [first, end] = self.ranges[left];
            for right in &self.candidates[first as usize..end as usize] {
                match self.of_right[*right as usize] {
                    NONE => has_end = true,
                    next if self.layer[next as usize] == NONE => {
                        self.layer[next as usize] = self.layer[left] + 1;
                        queue.push_back(next as usize);
                    }
                    _ => {}
                }
            }
        }
        has_end
    }

    /// Follows a path down the layers from one who is alone, and swaps partners along it if it ends at a free one.
    fn augment(&mut self, start: u32) -> bool {
        let mut path = vec![start];
        while let Some(left) = path.last().copied() {
            let end = self.ranges[left as usize][1];
            let mut goes_on = false;
            while self.tried[left as usize] < end {
                let right = self.candidates[self.tried[left as usize] as usize];
                match self.of_right[right as usize] {
                    NONE => {
                        self.swap_along(&path);
                        return true;
                    }
                    next if self.layer[next as usize] == self.layer[left as usize].saturating_add(1) => {
                        path.push(next);
                        goes_on = true;
                        break;
                    }
                    _ => self.tried[left as usize] += 1,
                }
            }
            if !goes_on {
                // A dead end: the search need not come here again in this round.
                self.layer[left as usize] = NONE;
                path.pop();
                if let Some(before) = path.last() {
                    self.tried[*before as usize] += 1;
                }
            }
        }
        false
    }

    /// Everyone on the path takes the candidate last tried.
    fn swap_along(&mut self, path: &[u32]) {
        for left in path {
            let right = self.candidates[self.tried[*left as usize] as usize];
            (self.of_left[*left as usize], self.of_right[right as usize]) = (right, *left);
            self.layer[*left as usize] = NONE;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    const SIZE: Size = Size { width: 9, height: 7 };

    /// The largest number of pairs, by trying every partner for each in turn (Kuhn's algorithm on a full table).
    fn brute_force(left: &InkMask, right: &InkMask, distance_px: f64) -> usize {
        let points = |mask: &InkMask| -> Vec<(f64, f64)> {
            let inked = (0..mask.ink.len()).filter(|index| mask.ink[*index]);
            inked.map(|index| ((index % 9) as f64, (index / 9) as f64)).collect()
        };
        let (lefts, rights) = (points(left), points(right));
        let near = |l: usize, r: usize| (lefts[l].0 - rights[r].0).hypot(lefts[l].1 - rights[r].1) <= distance_px;
        fn find(l: usize, near: &dyn Fn(usize, usize) -> bool, seen: &mut [bool], of: &mut [Option<usize>]) -> bool {
            for r in 0..of.len() {
                if near(l, r)
                    && !std::mem::replace(&mut seen[r], true)
                    && of[r].is_none_or(|other| find(other, near, seen, of))
                {
                    of[r] = Some(l);
                    return true;
                }
            }
            false
        }
        let mut of = vec![None; rights.len()];
        (0..lefts.len()).filter(|l| find(*l, &near, &mut vec![false; rights.len()], &mut of)).count()
    }

    #[test]
    fn as_many_pairs_as_a_full_search_finds_and_the_same_from_both_sides() {
        let mut random = tinta::random::Random::new(3, "ink");
        for round in 0..300 {
            let density = 5 + random.below(60);
            let mut mask = || InkMask { size: SIZE, ink: (0..63).map(|_| random.below(100) < density).collect() };
            let (left, right) = (mask(), mask());
            for distance in [0.0, 1.0, 1.5, 2.0, 3.9] {
                let count = matched(&left, &right, distance);
                assert_eq!(count, brute_force(&left, &right, distance), "round {round}, {distance} px");
                assert_eq!(count, matched(&right, &left, distance));
            }
        }
    }

    #[test]
    fn each_pixel_has_one_partner_at_most() {
        let row = |columns: &[usize]| InkMask { size: SIZE, ink: (0..63).map(|i| columns.contains(&i)).collect() };
        assert_eq!(matched(&row(&[3]), &row(&[2, 3, 4]), 2.0), 1);
        assert_eq!(matched(&row(&[0, 1, 2]), &row(&[1, 2, 3]), 1.0), 3);
        assert_eq!(matched(&row(&[0]), &row(&[5]), 4.0), 0);
    }
}
