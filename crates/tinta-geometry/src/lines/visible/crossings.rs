//! Where what is seen of a line may change: at crossings with nearer rims, where it passes through faces, and where lines on one
//! another begin, end or change places.

use crate::bvh::Exclusion;
use crate::lines::eye::image::Image;
use crate::lines::input::feature::Own;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::SearchDepth;
use crate::lines::visible::overlapping_lines::OverlappingLines;
use crate::tolerances::CONTACT;
use glam::DVec3;

impl LineIndex<'_> {
    /// Adds the places along a part of a line where what is seen of it may change: all, or only the first. Returns whether it stopped
    /// at the first.
    pub(in crate::lines) fn add_cuts(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        part: [f64; 2],
        stops_at_first: bool,
        cuts: &mut Vec<f64>,
    ) -> bool {
        let feature = &self.features[index];
        let touch_px = image.touch_px(self.space);
        let keys = part.map(|place| image.key(place));
        let farthest = keys[0].max(keys[1]);
        let line = self.line(image, SearchDepth::Nearer, farthest.abs() * (2.0 * CONTACT));
        // Lines from one position cross nowhere else.
        let excluded = Exclusion([feature.planes, feature.own.corners(self.faces)]);
        let is_cut = self.rims.any_along(line, part, excluded, |other_index| {
            if let Some(other) = self.images[other_index].filter(|_| other_index != index) {
                let touch_px = touch_px.max(other.touch_px(self.space));
                let occludes = !feature.own.meets(self.features[other_index].own);
                self.add_crossings(image, &other, touch_px, occludes, cuts);
            }
            stops_at_first && !cuts.is_empty()
        });
        if is_cut || (!self.finds_hidden && self.add_overlaps(index, image, overlapping, part, stops_at_first, cuts)) {
            return true;
        }
        if matches!(feature.own, Own::Edge(_)) {
            return false;
        }
        // Faces with the corner in which it begins it meets nowhere else.
        self.any_but(&image.part_box(part, touch_px, keys), excluded, |face| {
            if matches!(feature.own, Own::Faces(own) if own.contains(&face)) {
                return false;
            }
            cuts.extend(self.piercing(feature.ends, face).map(|point| image.place_of(self.space.project(point).0)));
            stops_at_first && !cuts.is_empty()
        })
    }

    /// Adds the places where an edge passes through faces.
    pub(in crate::lines) fn add_piercings(&self, index: usize, image: &Image, places: &mut Vec<f64>) {
        let Own::Edge([a, b]) = self.features[index].own else { return };
        if let Some(points) = self.piercings.get(&[a.min(b), a.max(b)]) {
            places.extend(points.iter().map(|point| image.place_of(self.space.project(*point).0)));
        }
    }

    /// Adds where a line's image that lies on this one begins and ends and where both are equally near, and where a nearer one
    /// at which a surface ends crosses or touches it.
    pub(in crate::lines) fn add_crossings(
        &self,
        image: &Image,
        other: &Image,
        touch_px: f64,
        occludes: bool,
        cuts: &mut Vec<f64>,
    ) {
        let along = image.b - image.a;
        let length = along.length();
        let (c, d) = (along.perp_dot(other.a - image.a) / length, along.perp_dot(other.b - image.a) / length);
        if (c > touch_px && d > touch_px) || (c < -touch_px && d < -touch_px) {
            return;
        }
        if let Some(range) = image.overlap(other, touch_px) {
            cuts.extend(range);
            cuts.extend(image.same_key(other));
        }
        if !occludes || c == d {
            return;
        }
        let on_other = (c / (c - d)).clamp(0.0, 1.0);
        let place = image.place_of(other.at(on_other));
        if place * length < -touch_px || (place - 1.0) * length > touch_px {
            return;
        }
        let (key, other_key) = (image.key(place), other.key(on_other));
        // What is clearly farther away hides nothing; where that is not clear, a cut too many does no harm.
        if other_key <= key + key.abs() * CONTACT {
            cuts.push(place);
        }
    }

    /// Where a line passes through a face, if it does.
    pub(in crate::lines) fn piercing(&self, [from, to]: [DVec3; 2], face: u32) -> Option<DVec3> {
        let [a, b, c] = self.faces.corners(face);
        let normal = (b - a).cross(c - a);
        let (start, end) = (normal.dot(from - a), normal.dot(to - a));
        if (start > 0.0) == (end > 0.0) {
            return None;
        }
        let point = from + (to - from) * (start / (start - end));
        // Inside, or near enough: one cut too many does no harm.
        let scale = -1e-9 * normal.length_squared();
        let is_left = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) >= scale;
        (is_left(a, b) && is_left(b, c) && is_left(c, a)).then_some(point)
    }
}

impl Own {
    /// Whether two edges share an end, where both end anyway.
    pub(in crate::lines) fn meets(self, other: Self) -> bool {
        match (self, other) {
            (Self::Edge([a, b]), Self::Edge(other)) => other.contains(&a) || other.contains(&b),
            _ => false,
        }
    }
}
