//! Where the visibility of a line may change: at crossings with nearer rims, where it passes through faces, and where lines on one
//! another begin, end or change places.

use crate::bvh::Exclusion;
use crate::lines::eye::image::Image;
use crate::lines::eye::touch::{key_slack, may_be_nearer, piercing};
use crate::lines::input::feature::Own;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::SearchDepth;
use crate::lines::visible::overlapping_lines::OverlappingLines;

impl LineIndex<'_> {
    /// Adds the places along a stretch of a line where its visibility may change: all, or only the first. Returns whether it stopped
    /// at the first.
    pub(in crate::lines) fn add_cuts(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        stretch: [f64; 2],
        stops_at_first: bool,
        cuts: &mut Vec<f64>,
    ) -> bool {
        let feature = &self.features[index];
        let touch_px = image.touch_px(self.space);
        let keys = stretch.map(|place| image.key(place));
        let farthest = keys[0].max(keys[1]);
        let line = self.line(image, SearchDepth::Nearer, key_slack(farthest));
        // Lines from one position cross nowhere else.
        let excluded = Exclusion([feature.planes, feature.own.corners(self.faces)]);
        let is_cut = self.rims.any_along(line, stretch, excluded, |other_index| {
            if let Some(other) = self.images[other_index].filter(|_| other_index != index) {
                let occludes = !feature.own.meets(self.features[other_index].own);
                self.add_crossings(image, &other, occludes, cuts);
            }
            stops_at_first && !cuts.is_empty()
        });
        if is_cut || self.add_overlaps(index, image, overlapping, stretch, [stops_at_first, false], cuts) {
            return true;
        }
        if matches!(feature.own, Own::Edge(_)) {
            return false;
        }
        // Faces with the corner in which it begins it meets nowhere else.
        self.any_but(&image.box_around(stretch, touch_px, keys), excluded, |face| {
            if matches!(feature.own, Own::Faces(own) if own.contains(&face)) {
                return false;
            }
            cuts.extend(
                piercing(feature.ends, self.faces.corners(face))
                    .map(|point| image.place_of(self.space.project(point).0)),
            );
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
    pub(in crate::lines) fn add_crossings(&self, image: &Image, other: &Image, occludes: bool, cuts: &mut Vec<f64>) {
        let touch_px = image.joint_touch_px(other, self.space);
        let Some(ends) = image.reached(other, touch_px) else { return };
        if let Some(range) = image.overlap(other, touch_px) {
            cuts.extend(range);
            cuts.extend(image.same_key(other));
        }
        let Some([place, on_other]) = image.crossing(other, ends).filter(|_| occludes) else { return };
        let length = image.length();
        let is_on_it = !(place * length < -touch_px || (place - 1.0) * length > touch_px);
        // Where it is not clear which is nearer, a cut too many does no harm.
        if is_on_it && may_be_nearer(other.key(on_other), image.key(place)) {
            cuts.push(place);
        }
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
