//! The visible lines of the outline: only background lies beside them in the picture.
//!
//! Beside means [`BESIDE`] away, on either side. A parallel of the line at that distance is cut wherever the image of a surface's
//! end or turn crosses it, at any depth. All faces at the middle of each stretch, at any depth, decide the stretch. This has three
//! effects. Lines that overlap, up to a small share of that distance, are outline together, whichever of them is the nearest. A
//! face seen nearly edge-on is no surface between a line and the background. A slit narrower than that distance is no background.

use crate::bvh::{Box3, Exclusion};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::image::Image;
use crate::lines::eye::space::Space;
use crate::lines::visible::contact::Probe;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::SearchDepth;
use crate::ranges::hold;
use crate::tolerances::BESIDE;
use glam::DVec2;

/// Shortest stretch that is outline or not, in units of [`LineIndex::beside_px`]. At an acute corner of at least eleven degrees, the
/// parallel of a line reaches over that of the other by no more than this.
const SHORTEST_PART: f64 = 5.0;

/// Adds a stretch to the longer one of its neighbours.
fn absorb(stretches: &mut Vec<Interval>, stretch: usize) {
    let Interval { from, to, .. } = stretches.remove(stretch);
    let length = |stretch: Option<&Interval>| stretch.map_or(0.0, Interval::length);
    let (before, after) = (stretch.checked_sub(1), stretch);
    let is_after = length(stretches.get(after)) > length(before.and_then(|before| stretches.get(before)));
    match before.filter(|_| !is_after) {
        Some(before) => stretches[before].to = to,
        None => stretches[after].from = from,
    }
    std::mem::take(stretches).into_iter().for_each(|stretch| stretch.add_to(stretches));
}

impl Interval {
    fn length(&self) -> f64 {
        self.to - self.from
    }
}

impl LineIndex<'_> {
    /// Cuts a visible piece where background begins or ends beside it.
    pub(in crate::lines) fn with_outline(&self, index: usize, image: &Image, piece: Interval) -> Vec<Interval> {
        let aside = (image.b - image.a).perp().normalize() * self.beside_px();
        let background = [aside, -aside].map(|aside| self.background(index, image, [piece.from, piece.to], aside));
        let cuts = background.iter().flatten().flatten().copied().collect();
        let mut stretches: Vec<Interval> = Vec::new();
        for place in self.places(image, [piece.from, piece.to], cuts).windows(2) {
            let middle = (place[0] + place[1]) * 0.5;
            let background = [0, 1].map(|side| hold(&background[side], middle));
            Interval { from: place[0], to: place[1], background, ..piece }.add_to(&mut stretches);
        }
        let least = SHORTEST_PART * self.beside_px() / image.length();
        while let Some(stretch) =
            (0..stretches.len()).filter(|_| stretches.len() > 1).find(|stretch| stretches[*stretch].length() < least)
        {
            absorb(&mut stretches, stretch);
        }
        stretches
    }

    /// How far beside a line background makes it outline, pixels.
    pub(in crate::lines) fn beside_px(&self) -> f64 {
        BESIDE * self.space.size.max_element()
    }

    /// Returns the ranges between two places of a line that have background at a distance beside them; ascending.
    fn background(&self, index: usize, line: &Image, range: [f64; 2], aside: DVec2) -> Vec<[f64; 2]> {
        let image = &Image { a: line.a + aside, b: line.b + aside, ..*line };
        let touch_px = image.touch_px(self.space);
        let cover = self.cover(index, image, range, &[], SearchDepth::Any);
        let mut cuts = Vec::new();
        for gap in &cover.open {
            let line = self.line(image, SearchDepth::Any, 0.0);
            self.rims.any_along(line, *gap, Exclusion::default(), |other_index| {
                if let Some(other) = self.images[other_index] {
                    cuts.extend(image.meetings(&other, self.space));
                }
                false
            });
        }
        let mut background: Vec<[f64; 2]> = Vec::new();
        for place in self.places(image, range, cuts).windows(2) {
            let middle = (place[0] + place[1]) * 0.5;
            if cover.hides(middle) || self.faces.is_covered(self.space, &self.probe(index, image, middle), touch_px) {
                continue;
            }
            match background.last_mut() {
                Some(last) if last[1] == place[0] => last[1] = place[1],
                _ => background.push([place[0], place[1]]),
            }
        }
        background
    }
}

impl Faces {
    /// Whether faces at any depth cover the surroundings of a point, to both sides at an arbitrarily small distance. A side of a
    /// face within `touch_px` of the point counts as going through it. Faces seen edge-on cover nothing.
    pub(in crate::lines) fn is_covered(&self, space: &Space, probe: &Probe, touch_px: f64) -> bool {
        let column =
            Box3::new((probe.px - touch_px).extend(f64::NEG_INFINITY), (probe.px + touch_px).extend(f64::INFINITY));
        let touch = touch_px / space.px_per_unit(-probe.view.z);
        let mut covered = [false; 2];
        self.tree.any(&column, |face| {
            let by_this = self.covers(space, face, probe, touch);
            covered = [covered[0] || by_this[0], covered[1] || by_this[1]];
            covered == [true; 2]
        })
    }

    fn covers(&self, space: &Space, face: u32, probe: &Probe, touch: f64) -> [bool; 2] {
        const NEITHER: [bool; 2] = [false; 2];
        if self.is_ghost(face) || self.edge_on.binary_search(&self.numbers[face as usize]).is_ok() {
            return NEITHER;
        }
        let corners @ [a, b, c] = self.corners(face);
        let normal = (b - a).cross(c - a);
        let sign = if normal.dot(space.to_eye(a)) > 0.0 { 1.0 } else { -1.0 };
        let is_inside = probe.inside(space, corners, sign, |_| touch, |inward, _| inward > 0.0);
        let is_cut = is_inside != NEITHER && self.cut_by_near.binary_search(&face).is_ok();
        if is_cut && self.hit_depth(space, [a, normal], probe) < space.near { NEITHER } else { is_inside }
    }
}
