//! Bundles: dozens of lines that overlap in the picture, such as the edges of equal parts in a row seen along the row. Tells
//! which of them is nearest at each place.
//!
//! In: the images of the wanted lines. Out: for each line, the few others that are nearest along it. The caller tests those first
//! and decides whether one hides the line for sure. No result depends on how bundles are made.
//!
//! The lines of a bundle share one direction and one distance from the picture's middle, within the tolerance for lines that
//! touch. A tree of lines (Li Chao) finds the nearest line of a bundle at all places between the lines' ends, in m log² m.

use crate::lines::eye::image::Image;
use crate::thresholds::THRESHOLDS;
use crate::tolerances::TURNED;
use glam::DVec2;
use std::f64::consts::PI;

/// An angle that hardly any line has: the order of directions begins there.
const FIRST_DIRECTION: f64 = 0.1234;

/// Marks the absence of a line or a bundle.
const NONE: u32 = u32::MAX;

/// All bundles.
#[derive(Debug, Default)]
pub(in crate::lines) struct Bundles {
    /// Each line's bundle; empty without bundles.
    of_lines: Vec<u32>,
    bundles: Vec<Bundle>,
}

#[derive(Debug)]
struct Bundle {
    /// Of length 1.
    along: DVec2,
    /// The nearest line from each distance along the bundle; ascending.
    nearest: Vec<(f64, u32)>,
}

/// A line in a bundle: its range along the bundle, its keys at both ends, its number.
#[derive(Debug, Clone, Copy)]
struct Member {
    range: [f64; 2],
    keys: [f64; 2],
    line: u32,
}

impl Member {
    fn new(along: DVec2, image: &Image, line: u32) -> Self {
        let range = [image.a, image.b].map(|end| along.dot(end));
        match range[0] <= range[1] {
            true => Self { range, keys: image.keys, line },
            false => Self { range: [range[1], range[0]], keys: [image.keys[1], image.keys[0]], line },
        }
    }

    fn key(&self, at: f64) -> f64 {
        let share = (at - self.range[0]) / (self.range[1] - self.range[0]);
        self.keys[0] + (self.keys[1] - self.keys[0]) * share
    }
}

impl Bundles {
    /// Finds the bundles of the wanted lines. `images` has an image for each line's number. Lines nearer than `touch_px` overlap.
    pub(in crate::lines) fn new(
        images: &[Option<Image>],
        is_wanted: impl Fn(usize) -> bool,
        middle: DVec2,
        touch_px: f64,
    ) -> Self {
        let mut directed: Vec<(f64, u32)> = Vec::new();
        for (line, image) in images.iter().enumerate() {
            let Some(image) = image.filter(|image| image.length() > touch_px && is_wanted(line)) else { continue };
            let along = image.b - image.a;
            directed.push(((along.y.atan2(along.x) - FIRST_DIRECTION).rem_euclid(PI), line as u32));
        }
        directed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut all = Self::default();
        let mut placed: Vec<(f64, u32)> = Vec::new();
        for of_direction in runs(&directed, TURNED).filter(|run| run.len() >= THRESHOLDS.group) {
            let Some(first) = images[of_direction[0].1 as usize] else { continue };
            let along = (first.b - first.a).normalize();
            placed.clear();
            placed.extend(of_direction.iter().filter_map(|(_, line)| {
                let image = images[*line as usize]?;
                Some((along.perp_dot((image.a + image.b) * 0.5 - middle), *line))
            }));
            placed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for on_one_line in runs(&placed, touch_px).filter(|run| run.len() >= THRESHOLDS.group) {
                let mut members: Vec<Member> = on_one_line
                    .iter()
                    .filter_map(|(_, line)| Some(Member::new(along, images[*line as usize].as_ref()?, *line)))
                    .collect();
                members.sort_unstable_by_key(|member| member.line);
                all.of_lines.resize(images.len(), NONE);
                members.iter().for_each(|member| all.of_lines[member.line as usize] = all.bundles.len() as u32);
                all.bundles.push(Bundle { along, nearest: nearest(&members, touch_px) });
            }
        }
        all
    }

    /// Returns the lines that are nearest somewhere along one, perhaps itself among them; nothing for a line in no bundle.
    pub(in crate::lines) fn nearest_along(&self, line: usize, image: &Image) -> impl Iterator<Item = usize> {
        let bundle = self.of_lines.get(line).and_then(|bundle| self.bundles.get(*bundle as usize));
        let pieces = bundle.map_or(&[][..], |bundle| {
            let [from, to] = Member::new(bundle.along, image, line as u32).range;
            let first = bundle.nearest.partition_point(|(start, _)| *start <= from).saturating_sub(1);
            let end = bundle.nearest.partition_point(|(start, _)| *start < to);
            &bundle.nearest[first..end.max(first)]
        });
        pieces.iter().filter(|(_, nearest)| *nearest != NONE).map(|(_, nearest)| *nearest as usize)
    }
}

/// Returns runs of ascending values that differ from the run's first by at most `most`.
fn runs(ascending: &[(f64, u32)], most: f64) -> impl Iterator<Item = &[(f64, u32)]> {
    let mut rest = ascending;
    std::iter::from_fn(move || {
        let (first, _) = rest.first()?;
        let (run, others) = rest.split_at(rest.partition_point(|(value, _)| *value <= first + most));
        rest = others;
        Some(run)
    })
}

/// Returns the places at which another line becomes the nearest, each with that line.
fn nearest(members: &[Member], touch_px: f64) -> Vec<(f64, u32)> {
    let mut ends: Vec<f64> = members.iter().flat_map(|member| member.range).collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends.dedup_by(|next, kept| *next - *kept <= touch_px);
    let middles: Vec<f64> = ends.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
    if middles.is_empty() {
        return Vec::new();
    }
    let mut tree = Tree { members, middles: &middles, nodes: vec![NONE; middles.len().next_power_of_two() * 2] };
    for (number, member) in members.iter().enumerate() {
        let first = middles.partition_point(|middle| *middle < member.range[0]);
        let end = middles.partition_point(|middle| *middle <= member.range[1]);
        tree.insert(1, 0..middles.len().next_power_of_two(), first..end, number as u32);
    }
    let mut nearest: Vec<(f64, u32)> = Vec::new();
    for (place, start) in ends[..middles.len()].iter().enumerate() {
        let line = tree.nearest(place);
        if nearest.last().is_none_or(|(_, last)| *last != line) {
            nearest.push((*start, line));
        }
    }
    nearest.push((ends[middles.len()], NONE));
    nearest
}

/// The nearest line at each of some places: a binary tree over the places. Each node holds a line that covers all the node's
/// places. The nearest line at a place is one of those on the path to the place.
struct Tree<'a> {
    members: &'a [Member],
    middles: &'a [f64],
    nodes: Vec<u32>,
}

impl Tree<'_> {
    /// Whether a line is nearer than another at a place, or the other is missing. Places past the last make their number even.
    fn is_nearer(&self, line: u32, other: u32, place: usize) -> bool {
        let at = self.middles[place.min(self.middles.len() - 1)];
        other == NONE || self.members[line as usize].key(at) < self.members[other as usize].key(at)
    }

    /// Inserts a line that covers some places, at or below a node that holds some of them.
    fn insert(&mut self, node: usize, of_node: std::ops::Range<usize>, covered: std::ops::Range<usize>, line: u32) {
        let (first, end) = (of_node.start.max(covered.start), of_node.end.min(covered.end));
        if first >= end {
            return;
        }
        let middle = of_node.start.midpoint(of_node.end);
        if (first, end) != (of_node.start, of_node.end) {
            self.insert(node * 2, of_node.start..middle, covered.clone(), line);
            self.insert(node * 2 + 1, middle..of_node.end, covered, line);
            return;
        }
        let mut line = line;
        if self.is_nearer(line, self.nodes[node], middle) {
            std::mem::swap(&mut line, &mut self.nodes[node]);
        }
        // The other line may be nearer on one side of the middle only.
        if line == NONE || of_node.len() == 1 {
            return;
        }
        if self.is_nearer(line, self.nodes[node], of_node.start) {
            self.insert(node * 2, of_node.start..middle, of_node.start..middle, line);
        } else if self.is_nearer(line, self.nodes[node], of_node.end - 1) {
            self.insert(node * 2 + 1, middle..of_node.end, middle..of_node.end, line);
        }
    }

    /// Returns the number of the line that is nearest at a place.
    fn nearest(&self, place: usize) -> u32 {
        let mut node = self.nodes.len() / 2 + place;
        let mut best = NONE;
        while node > 0 {
            let here = self.nodes[node];
            if here != NONE && self.is_nearer(here, best, place) {
                best = here;
            }
            node /= 2;
        }
        self.members.get(best as usize).map_or(NONE, |member| member.line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(from: f64, to: f64, keys: [f64; 2]) -> Image {
        // Along a diagonal.
        let at = |along: f64| DVec2::new(10.0, 20.0) + DVec2::new(0.6, 0.8) * along;
        Image { a: at(from), b: at(to), keys, noise_px: 0.0 }
    }

    #[test]
    fn the_nearest_of_a_bundle_is_that_of_all_its_lines_everywhere() {
        let mut state = 9u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for count in [THRESHOLDS.group, 40, 333] {
            let images: Vec<Option<Image>> = (0..count)
                .map(|_| {
                    let (from, length) = (number() * 300.0, 1.0 + number() * 90.0);
                    let ends = if number() < 0.5 { [from, from + length] } else { [from + length, from] };
                    Some(image(ends[0], ends[1], [number(), number()]))
                })
                .collect();
            let bundles = Bundles::new(&images, |_| true, DVec2::splat(256.0), 1e-4);
            assert_eq!(bundles.bundles.len(), 1);
            // In the middle between neighbouring ends of any lines, where the tree finds the nearest.
            let along = DVec2::new(0.6, 0.8);
            let mut ends: Vec<f64> =
                images.iter().flatten().flat_map(|it| [along.dot(it.a), along.dot(it.b)]).collect();
            ends.sort_unstable_by(f64::total_cmp);
            for pair in ends.windows(2).filter(|pair| pair[1] - pair[0] > 2e-4) {
                let px = images[0].unwrap().a + along * ((pair[0] + pair[1]) * 0.5 - along.dot(images[0].unwrap().a));
                let covers = |other: &Image| (0.0..=1.0).contains(&other.place_of(px));
                let key = |other: Image| other.key(other.place_of(px));
                let nearest = images.iter().flatten().filter(|it| covers(it)).map(|it| key(*it)).fold(2.0, f64::min);
                for (line, image) in images.iter().enumerate().filter(|(_, image)| image.as_ref().is_some_and(covers)) {
                    let known = bundles.nearest_along(line, image.as_ref().unwrap()).filter_map(|other| images[other]);
                    let best = known.filter(covers).map(key).fold(2.0, f64::min);
                    assert!((nearest - best).abs() < 1e-9, "{count} lines, line {line} at {px}: {best} for {nearest}");
                }
            }
        }
    }

    #[test]
    fn lines_that_do_not_lie_on_one_another_are_in_no_bundle() {
        let turned = |step: usize| {
            let direction = DVec2::from_angle(step as f64 * 0.01);
            Some(Image {
                a: DVec2::splat(200.0),
                b: DVec2::splat(200.0) + direction * 50.0,
                keys: [1.0; 2],
                noise_px: 0.0,
            })
        };
        let apart = |step: usize| {
            let a = DVec2::new(10.0, 10.0 + step as f64);
            Some(Image { a, b: a + DVec2::X * 80.0, keys: [1.0; 2], noise_px: 0.0 })
        };
        let images: Vec<Option<Image>> = (0..60).map(turned).chain((0..60).map(apart)).chain([None]).collect();
        let bundles = Bundles::new(&images, |_| true, DVec2::splat(256.0), 1e-4);
        assert!(bundles.bundles.is_empty());
        assert_eq!(bundles.nearest_along(3, &images[3].unwrap()).count(), 0);
    }
}
