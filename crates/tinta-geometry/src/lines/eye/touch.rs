//! Contact: the decisions on numbers that rounding moves, each with its tolerance.

use crate::lines::eye::image::Image;
use crate::lines::eye::space::Space;
use crate::tolerances::{CONTACT, PIERCED, TIE, TOUCH};
use glam::DVec3;

impl Space {
    /// Distance below which two things touch whose shorter length is this, and whose positions count as one below `weld`, file units.
    pub(in crate::lines) fn contact(&self, length: f64, weld: f64) -> f64 {
        CONTACT * length + weld + 4.0 * self.noise
    }

    /// Distance in pixels below which a point lies on the image of a line.
    pub(in crate::lines) fn tie_px(&self, depth: f64) -> f64 {
        TIE * self.size.max_element() + self.noise * self.px_per_unit(depth)
    }

    /// The same at a depth in file units.
    pub(in crate::lines) fn tie(&self, depth: f64) -> f64 {
        TIE * self.size.max_element() / self.px_per_unit(depth) + self.noise
    }

    /// Distance in pixels below which the images of two lines touch, without rounding of the world's own numbers.
    pub(in crate::lines) fn touch_px(&self) -> f64 {
        TOUCH * self.size.max_element()
    }
}

/// How much farther than a key something may be that a point with that key touches.
pub(in crate::lines) fn key_slack(key: f64) -> f64 {
    key.abs() * (2.0 * CONTACT)
}

/// Whether a thing with one key may be nearer than a thing with another.
pub(in crate::lines) fn may_be_nearer(key: f64, than: f64) -> bool {
    key <= than + than.abs() * CONTACT
}

/// Whether a point of a face's plane lies in the face, or beyond a side by no more than a share of the face.
pub(in crate::lines) fn lies_in([a, b, c]: [DVec3; 3], normal: DVec3, point: DVec3, share: f64) -> bool {
    let least = -share * normal.length_squared();
    [(a, b), (b, c), (c, a)].iter().all(|(from, to)| (*to - *from).cross(point - *from).dot(normal) >= least)
}

/// Returns where a line passes through a face, if it does. Inside, or near enough: one cut too many does no harm.
pub(in crate::lines) fn piercing([from, to]: [DVec3; 2], corners: [DVec3; 3]) -> Option<DVec3> {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let (start, end) = (normal.dot(from - a), normal.dot(to - a));
    let point = from + (to - from) * (start / (start - end));
    ((start > 0.0) != (end > 0.0) && lies_in(corners, normal, point, PIERCED)).then_some(point)
}

impl Image {
    /// The distance below which a place lies on the line, pixels.
    pub(in crate::lines) fn touch_px(&self, space: &Space) -> f64 {
        space.touch_px() + self.noise_px
    }

    /// The distance below which a place lies on both this line and another, pixels.
    pub(in crate::lines) fn joint_touch_px(&self, other: &Self, space: &Space) -> f64 {
        self.touch_px(space).max(other.touch_px(space))
    }

    /// Returns the range of this line that another line overlaps, if any.
    pub(in crate::lines) fn lies_on(&self, other: &Self, space: &Space) -> Option<[f64; 2]> {
        self.overlap(other, self.joint_touch_px(other, space))
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

    /// Returns the distances of another line's ends from the line through this one; `None` if all of it lies beside.
    pub(in crate::lines) fn reached(&self, other: &Self, touch_px: f64) -> Option<[f64; 2]> {
        let along = self.b - self.a;
        let length = along.length();
        let [c, d] = [other.a, other.b].map(|end| along.perp_dot(end - self.a) / length);
        let is_beside = (c > touch_px && d > touch_px) || (c < -touch_px && d < -touch_px);
        (!is_beside).then_some([c, d])
    }

    /// Returns where the line through this one is crossed or touched by another, whose ends have these distances from it, with the place
    /// on the other.
    pub(in crate::lines) fn crossing(&self, other: &Self, [c, d]: [f64; 2]) -> Option<[f64; 2]> {
        let on_other = (c / (c - d)).clamp(0.0, 1.0);
        (c != d).then(|| [self.place_of(other.at(on_other)), on_other])
    }

    /// Returns the places on this line where another's image crosses or touches it, or overlaps it and ends.
    pub(in crate::lines) fn meetings(&self, other: &Self, space: &Space) -> impl Iterator<Item = f64> + use<> {
        let touch_px = self.joint_touch_px(other, space);
        let places = self.reached(other, touch_px).map(|ends| {
            let crossing = self.crossing(other, ends).map(|[place, _]| place);
            self.overlap(other, touch_px).into_iter().flatten().chain(crossing)
        });
        places.into_iter().flatten()
    }
}
