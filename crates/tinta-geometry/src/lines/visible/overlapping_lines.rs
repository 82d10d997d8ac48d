//! Which other lines lie on one in the picture: mostly none, and one search for a whole line finds it. Of lines on one another
//! the nearest is seen, and of equally near ones one stands for all.

use crate::lines::eye::image::Image;
use crate::lines::input::feature::Feature;
use crate::lines::visible::line_index::LineIndex;
use crate::ranges::{above_zero, united};
use crate::thresholds::THRESHOLDS;
use std::cell::OnceCell;

/// The lines that lie on one somewhere, found at the first use: most hidden lines need none.
pub(in crate::lines) struct OverlappingLines {
    /// The line with its image, and the places between which they matter.
    line: (usize, Image, [f64; 2]),
    found: OnceCell<Overlaps>,
}

/// The result of the search.
enum Overlaps {
    /// These.
    Few(Vec<usize>),
    /// Too many: a search finds those of each stretch.
    Many,
}

impl OverlappingLines {
    pub(in crate::lines) fn new(index: usize, image: &Image, inside: [f64; 2]) -> Self {
        Self { line: (index, *image, inside), found: OnceCell::new() }
    }

    /// None.
    pub(in crate::lines) fn none(index: usize, image: &Image, inside: [f64; 2]) -> Self {
        Self::new(index, image, inside).known(Vec::new())
    }

    /// The same, already found.
    pub(in crate::lines) fn known(self, lines: Vec<usize>) -> Self {
        Self { found: OnceCell::from(Overlaps::Few(lines)), ..self }
    }

    fn found(&self, lines: &LineIndex) -> &Overlaps {
        let (index, image, inside) = &self.line;
        self.found.get_or_init(|| lines.lying_on(*index, image, *inside))
    }

    pub(in crate::lines) fn are_none(&self, lines: &LineIndex) -> bool {
        matches!(self.found(lines), Overlaps::Few(lines) if lines.is_empty())
    }
}

impl LineIndex<'_> {
    /// The wanted lines that lie on one between two places.
    fn lying_on(&self, index: usize, image: &Image, inside: [f64; 2]) -> Overlaps {
        let mut found: Vec<usize> = Vec::new();
        let are_many = self.any_of_its_direction(image, inside, |other_index| {
            let Some(other) = self.images[other_index].filter(|_| other_index != index) else { return false };
            if image.lies_on(&other, self.space).is_some() {
                found.push(other_index);
            }
            found.len() >= THRESHOLDS.group
        });
        if are_many { Overlaps::Many } else { Overlaps::Few(found) }
    }

    /// Calls `visit` with each line that may lie on a stretch of one, perhaps several times, until it returns true; returns whether
    /// it did.
    fn any_overlapping(
        &self,
        image: &Image,
        overlapping: &OverlappingLines,
        stretch: [f64; 2],
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        match overlapping.found(self) {
            Overlaps::Few(lines) => lines.iter().any(|line| visit(*line)),
            Overlaps::Many => self.any_of_its_direction(image, stretch, visit),
        }
    }

    /// The same of all lines that have its direction where it is, as those that lie on it have.
    fn any_of_its_direction(&self, image: &Image, stretch: [f64; 2], mut visit: impl FnMut(usize) -> bool) -> bool {
        let touch_px = image.touch_px(self.space);
        let mut directions = image.directions(touch_px);
        directions.any(|directions| self.overlapping.any(&image.box_around(stretch, touch_px, directions), &mut visit))
    }

    /// Whether a line is the nearest to the eye of those wanted ones that lie on it in the picture at a place. `None` where it lies in
    /// space on another of an earlier class, or of the same and a lower number; unless `if_hidden`, a hidden line may be told as not the
    /// nearest instead.
    pub(in crate::lines) fn is_nearest(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        place: f64,
        if_hidden: bool,
    ) -> Option<bool> {
        let px = image.at(place);
        let depth = -self.space.point(px, image.key(place)).z;
        let (place, own_key) = (image.place_of(px), image.key(image.place_of(px)));
        let mut others: Vec<(f64, usize)> = Vec::new();
        let is_behind = self.any_overlapping(image, overlapping, [place; 2], |other_index| {
            let Some(other) = self.images[other_index].filter(|_| other_index != index) else { return false };
            let lies_on_it =
                image.lies_on(&other, self.space).is_some_and(|range| (range[0]..=range[1]).contains(&place));
            if lies_on_it {
                let key = other.key(other.place_of(px).clamp(0.0, 1.0));
                if !if_hidden && own_key - key > self.clearly_behind(index, &other) {
                    return true;
                }
                others.push((self.space.depth_of_key(key), other_index));
            }
            false
        });
        if is_behind {
            return Some(false);
        }
        if others.is_empty() {
            return Some(true);
        }
        others.push((depth, index));
        others.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        others.dedup();
        // From the nearest on, those that touch the first of a group are in its place.
        let mut start = 0;
        loop {
            let (first_depth, first) = others[start];
            let is_of_group = |(depth, other): &(f64, usize)| depth - first_depth <= self.contact(first, *other);
            let end = start + others[start..].iter().take_while(|other| is_of_group(other)).count();
            let group = &others[start..end];
            if group.iter().any(|(_, other)| *other == index) {
                let stands_for_all = group.iter().map(|(_, other)| (self.features[*other].class, *other)).min();
                return (stands_for_all.map(|(_, other)| other) == Some(index)).then_some(start == 0);
            }
            start = end;
        }
    }

    /// The distance below which two lines touch, file units.
    pub(in crate::lines) fn contact(&self, first: usize, second: usize) -> f64 {
        let [first, second] = [first, second].map(|index| &self.features[index]);
        let length = |feature: &Feature| feature.ends[0].distance(feature.ends[1]);
        self.space.contact(length(first).min(length(second)), first.weld.min(second.weld))
    }

    /// Adds where other lines that lie in the picture on a stretch of one begin, end and are as near: all, or only the first line's.
    /// Returns whether it stopped at the first. Unless `if_hidden`, leaves out those that are farther away for sure.
    pub(in crate::lines) fn add_overlaps(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        stretch: [f64; 2],
        [stops_at_first, if_hidden]: [bool; 2],
        cuts: &mut Vec<f64>,
    ) -> bool {
        self.any_overlapping(image, overlapping, stretch, |other_index| {
            let changes_nothing = |other: &Image| !if_hidden && self.is_farther(other_index, other, image);
            if let Some(other) =
                self.images[other_index].filter(|other| other_index != index && !changes_nothing(other))
            {
                self.add_crossings(image, &other, false, cuts);
                return stops_at_first;
            }
            false
        })
    }

    /// The ranges of a line between two places that the nearest of many lines on it hide for sure; ascending.
    pub(in crate::lines) fn behind_nearest(&self, index: usize, image: &Image, inside: [f64; 2]) -> Vec<[f64; 2]> {
        let nearest = self.bundles.nearest_along(index, image);
        united(nearest.filter_map(|other| self.behind_overlapping_line(index, image, other, inside)).collect())
    }

    /// Adds the ranges of a stretch that lie in the picture on another line that is nearer for sure.
    pub(in crate::lines) fn behind_overlapping_lines(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        stretch: [f64; 2],
        hidden: &mut Vec<[f64; 2]>,
    ) {
        self.any_overlapping(image, overlapping, stretch, |other| {
            hidden.extend(self.behind_overlapping_line(index, image, other, stretch));
            false
        });
    }

    /// The range of a stretch that lies in the picture on one other line that is nearer for sure.
    fn behind_overlapping_line(
        &self,
        index: usize,
        image: &Image,
        other_index: usize,
        stretch: [f64; 2],
    ) -> Option<[f64; 2]> {
        let other = self.images[other_index].filter(|_| other_index != index)?;
        let range = image.lies_on(&other, self.space)?;
        let range = [range[0].max(stretch[0]), range[1].min(stretch[1])];
        let least = self.clearly_behind(index, &other);
        let behind = |place: f64| image.key(place) - other.key(other.place_of(image.at(place))) - least;
        if range[0] < range[1] { above_zero(range, range.map(behind)) } else { None }
    }

    /// Whether a line that lies in the picture on another is farther away than that for sure, wherever it lies on it.
    fn is_farther(&self, index: usize, image: &Image, nearer: &Image) -> bool {
        let Some(range) = nearer.lies_on(image, self.space) else { return false };
        let least = self.clearly_behind(index, nearer);
        range.into_iter().all(|place| image.key(image.place_of(nearer.at(place))) - nearer.key(place) > least)
    }

    /// By how much a line's key must be larger than another's for it not to touch it, nor anything that is nearer still.
    pub(in crate::lines) fn clearly_behind(&self, index: usize, other: &Image) -> f64 {
        let feature = &self.features[index];
        let length = feature.ends[0].distance(feature.ends[1]);
        let depths = other.keys.map(|key| self.space.depth_of_key(key));
        self.space.key_step(depths[0].min(depths[1]), 2.0 * self.space.contact(length, feature.weld))
    }
}
