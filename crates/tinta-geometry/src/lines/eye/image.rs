//! Images of lines in the picture, and trees of them.

use crate::bvh::{Box3, BoxTree, Exclusion, Line3, NO_GROUP, Walk};
use crate::lines::eye::space::{Space, at_depth};
use crate::lines::progress::Progress;
use crate::ranges::{between, meet};
use crate::tolerances::TOUCH;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A line's image: straight, its key linear along it.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Image {
    pub a: DVec2,
    pub b: DVec2,
    pub keys: [f64; 2],
    /// How far the rounding of the world's own numbers may move it, pixels.
    pub noise_px: f64,
}

impl Image {
    /// Returns the image of a line's part between the planes.
    pub(in crate::lines) fn of(space: &Space, ends: [DVec3; 2]) -> Option<Self> {
        Self::between(space, ends, [space.near, space.far])
    }

    /// Returns the image of a line's part between two depths.
    pub(in crate::lines) fn between(space: &Space, ends: [DVec3; 2], [near, far]: [f64; 2]) -> Option<Self> {
        let depths = ends.map(|end| -end.z);
        let (nearest, farthest) = (depths[0].min(depths[1]), depths[0].max(depths[1]));
        let is_flat = nearest == farthest;
        if farthest < near || nearest > far || !is_flat && (farthest <= near || nearest >= far) {
            return None;
        }
        // The ends themselves stay unchanged: lines that meet there meet in the picture.
        let kept = |end: DVec3| match -end.z {
            depth if depth < near => at_depth(ends, near).unwrap_or(end),
            depth if depth > far => at_depth(ends, far).unwrap_or(end),
            _ => end,
        };
        let [(a, first), (b, second)] = ends.map(|end| space.project(kept(end)));
        let noise_px = space.noise * space.px_per_unit(nearest.max(near));
        Some(Self { a, b, keys: [first, second], noise_px })
    }

    pub(in crate::lines) fn length(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// The distance below which a place lies on the line, pixels.
    pub(in crate::lines) fn touch_px(&self, space: &Space) -> f64 {
        TOUCH * space.size.max_element() + self.noise_px
    }

    /// Returns the range of this line that another line overlaps, if any: everywhere in it the other is nearer than `touch_px`.
    pub(in crate::lines) fn overlap(&self, other: &Self, touch_px: f64) -> Option<[f64; 2]> {
        let (first, last) = (self.place_of(other.a), self.place_of(other.b));
        let range = [first.min(last).max(0.0), first.max(last).min(1.0)];
        let length = (range[1] - range[0]) * self.length();
        // Covers lines that only meet at their ends.
        if length <= touch_px || length.is_nan() {
            return None;
        }
        let is_on_it = |place: f64| {
            let px = self.at(place);
            other.at(other.place_of(px).clamp(0.0, 1.0)).distance(px) <= touch_px
        };
        (is_on_it(range[0]) && is_on_it(range[1])).then_some(range)
    }

    /// Returns the place on this line where both have the same key, if any. Two overlapping lines change their order in depth
    /// there.
    pub(in crate::lines) fn same_key(&self, other: &Self) -> Option<f64> {
        let difference = |place: f64| self.key(place) - other.key(other.place_of(self.at(place)));
        let (start, end) = (difference(0.0), difference(1.0));
        ((start < 0.0) != (end < 0.0)).then(|| start / (start - end))
    }

    /// Returns the range of directions of lines that touch this one at two places, as the third coordinate of boxes. A range that
    /// reaches over an end comes a second time, half a turn away: then of two lines, one has the other's direction.
    pub(in crate::lines) fn directions(&self, touch_px: f64) -> impl Iterator<Item = [f64; 2]> + use<> {
        /// Far more than rounding turns a line.
        const LEAST: f64 = 1e-6;
        /// Pixels per radian: lines of different directions then lie apart in the hierarchy, too.
        const PX: f64 = 1024.0;
        let along = self.b - self.a;
        let direction = along.y.atan2(along.x).rem_euclid(PI);
        let spread = (2.0 * touch_px / along.length() + LEAST).min(PI);
        let turned = if direction < PI * 0.5 { direction + PI } else { direction - PI };
        let reaches_over = direction < spread || direction + spread > PI;
        let all = [Some(direction), reaches_over.then_some(turned)];
        all.into_iter().flatten().map(move |direction| [(direction - spread) * PX, (direction + spread) * PX])
    }

    /// The pixel at a place from 0 to 1.
    pub(in crate::lines) fn at(&self, place: f64) -> DVec2 {
        match place {
            0.0 => self.a,
            1.0 => self.b,
            _ => self.a + (self.b - self.a) * place,
        }
    }

    /// The points at two places, in the world.
    pub(in crate::lines) fn ends_world(&self, space: &Space, places: [f64; 2]) -> [DVec3; 2] {
        places.map(|place| space.world(space.point(self.at(place), self.key(place))))
    }

    pub(in crate::lines) fn key(&self, place: f64) -> f64 {
        self.keys[0] + (self.keys[1] - self.keys[0]) * place
    }

    /// The place nearest to a pixel.
    pub(in crate::lines) fn place_of(&self, px: DVec2) -> f64 {
        let along = self.b - self.a;
        let square = along.length_squared();
        if square > 0.0 { (px - self.a).dot(along) / square } else { 0.0 }
    }

    /// Returns the range of a line inside the picture with a margin around it.
    pub(in crate::lines) fn inside(&self, size: DVec2, margin: f64) -> Option<[f64; 2]> {
        let along = self.b - self.a;
        let range = between([0.0, 1.0], self.a.x, along.x, [-margin, size.x + margin])?;
        between(range, self.a.y, along.y, [-margin, size.y + margin])
    }

    /// Cuts a range of places into parts no longer than `longest_px`.
    pub(in crate::lines) fn parts(
        &self,
        [from, to]: [f64; 2],
        longest_px: f64,
    ) -> impl Iterator<Item = [f64; 2]> + use<> {
        let count = ((to - from) * self.length() / longest_px).ceil().max(1.0);
        (0..count as usize).map(move |part| {
            let place = |part: usize| from + (to - from) * (part as f64 / count);
            [place(part), place(part + 1)]
        })
    }

    /// The box around a part, wider by a margin in pixels, between two keys.
    pub(in crate::lines) fn part_box(&self, part: [f64; 2], margin: f64, keys: [f64; 2]) -> Box3 {
        let [first, second] = part.map(|place| self.at(place));
        let (low, high) = (first.min(second) - margin, first.max(second) + margin);
        Box3::new(low.extend(keys[0].min(keys[1])), high.extend(keys[0].max(keys[1])))
    }
}

/// Parts of lines with their boxes, and each one's line.
#[derive(Default)]
pub(in crate::lines) struct LineParts {
    boxes: Vec<Box3>,
    numbers: Vec<u32>,
    /// The plane and the high-valence vertex of each; empty without groups.
    groups: [Vec<u32>; 2],
}

/// Parts of lines in a tree, for searches.
pub(in crate::lines) struct LineTree {
    tree: BoxTree,
    numbers: Vec<u32>,
}

impl LineParts {
    /// The count of parts.
    pub(in crate::lines) fn len(&self) -> usize {
        self.boxes.len()
    }

    /// Adds another's parts.
    pub(in crate::lines) fn append(&mut self, other: Self) {
        self.boxes.extend(other.boxes);
        self.numbers.extend(other.numbers);
        self.groups.iter_mut().zip(other.groups).for_each(|(all, more)| all.extend(more));
    }

    /// Adds a part of a line.
    pub(in crate::lines) fn add(&mut self, around: Box3, line: usize) {
        self.boxes.push(around);
        self.numbers.push(line as u32);
    }

    /// Adds a part of a line that ends in a high-valence vertex, all of whose faces lie in a plane.
    pub(in crate::lines) fn add_of_groups(&mut self, around: Box3, line: usize, of_part: [u32; 2]) {
        self.add(around, line);
        self.groups.iter_mut().zip(of_part).for_each(|(groups, group)| groups.push(group));
    }

    /// Builds their tree; an empty one if the time runs out.
    pub(in crate::lines) fn tree(self, progress: &Progress) -> LineTree {
        let (mut tree, order) = BoxTree::new_unless(&self.boxes, || progress.is_over());
        if order.len() < self.boxes.len() {
            return LineTree { tree, numbers: Vec::new() };
        }
        let [planes, vertices] = self.groups.map(|groups| {
            let has_some = groups.iter().any(|group| *group != NO_GROUP);
            order.iter().filter(|_| has_some).map(|index| groups[*index as usize]).collect::<Vec<u32>>()
        });
        tree.set_groups([&planes, &vertices]);
        LineTree { tree, numbers: order.iter().map(|index| self.numbers[*index as usize]).collect() }
    }
}

impl LineTree {
    /// Calls `visit` with each line that has a part in `query`, perhaps several times, until it returns true.
    pub(in crate::lines) fn any(&self, query: &Box3, mut visit: impl FnMut(usize) -> bool) -> bool {
        self.tree.any(query, |place| visit(self.numbers[place as usize] as usize))
    }

    /// Calls `visit` with each line that may cross a part of another, perhaps several times, until it returns true; returns
    /// whether it did. Leaves out whole nodes of excluded groups.
    pub(in crate::lines) fn any_along(
        &self,
        line: Line3,
        part: [f64; 2],
        excluded: Exclusion,
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        let visit = |place| visit(self.numbers[place as usize] as usize);
        let mut walk = PartWalk { line, part, visit, is_found: false };
        self.tree.walk(excluded, &mut walk);
        walk.is_found
    }
}

/// The walk along a part of a line.
struct PartWalk<F> {
    line: Line3,
    part: [f64; 2],
    visit: F,
    is_found: bool,
}

impl<F: FnMut(u32) -> bool> Walk for PartWalk<F> {
    fn enters(&self, around: &Box3) -> bool {
        self.line.is_near(around) && self.line.range(around).is_some_and(|range| meet(self.part, range))
    }

    fn visit(&mut self, place: u32) -> bool {
        self.is_found = (self.visit)(place);
        self.is_found
    }
}
