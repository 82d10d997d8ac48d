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
use crate::lines::visible::cover::Cover;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::SearchDepth;
use crate::ranges::{hold, meet, united};
use crate::tolerances::BESIDE;

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
        let sides = [aside, -aside].map(|aside| Image { a: image.a + aside, b: image.b + aside, ..*image });
        let range = [piece.from, piece.to];
        let least = SHORTEST_PART * self.beside_px() / image.length();
        let enough = if piece.length() < 2.0 * least { 0.0 } else { least };
        let are_short = |gaps: &[[f64; 2]]| gaps.iter().all(|gap| gap[1] - gap[0] <= enough);
        let cover = |side: &Image, enough: f64| self.cover(index, side, range, &[], SearchDepth::Any, enough);
        let covers = sides.map(|side| cover(&side, enough));
        // Faces cover the surroundings of most lines except short stretches, which their neighbours would absorb.
        if are_short(&united(covers.iter().flat_map(|cover| cover.open.clone()).collect())) {
            return vec![piece];
        }
        // A short one matters where it reaches out of a long one on the other side, or leaves little of it.
        let matters = |gap: &[f64; 2], of: &[f64; 2]| {
            meet(*gap, *of) && !(of[0] <= gap[0] && gap[1] <= of[1] && of[1] - of[0] >= 2.0 * enough)
        };
        let background = [0, 1].map(|side| {
            let [open, others] = [side, 1 - side].map(|side| &covers[side].open);
            if !are_short(open) {
                return self.background(index, &sides[side], range, &covers[side]);
            }
            let is_needed = open.iter().any(|gap| others.iter().any(|of| matters(gap, of)));
            let all = is_needed.then(|| cover(&sides[side], 0.0));
            all.map_or(Vec::new(), |cover| self.background(index, &sides[side], range, &cover))
        });
        let cuts = background.iter().flatten().flatten().copied().collect();
        let mut stretches: Vec<Interval> = Vec::new();
        for place in self.places(image, range, cuts).windows(2) {
            let middle = (place[0] + place[1]) * 0.5;
            let background = [0, 1].map(|side| hold(&background[side], middle));
            Interval { from: place[0], to: place[1], background, ..piece }.add_to(&mut stretches);
        }
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

    /// Returns the ranges between two places of a line's parallel that have background, given what covers it; ascending.
    fn background(&self, index: usize, image: &Image, range: [f64; 2], cover: &Cover) -> Vec<[f64; 2]> {
        let touch_px = image.touch_px(self.space);
        let mut cuts = Vec::new();
        for gap in &cover.open {
            // Beyond a gap only the nearest cuts matter: faces hide the rest.
            let mut around = range;
            for rims in [&self.rims, &self.hidden_rims] {
                rims.any_along(self.line(image, SearchDepth::Any, 0.0), *gap, Exclusion::default(), |other| {
                    for cut in self.images[other].iter().flat_map(|other| image.meetings(other, self.space)) {
                        match cut {
                            _ if cut < gap[0] => around[0] = around[0].max(cut),
                            _ if cut > gap[1] => around[1] = around[1].min(cut),
                            _ => cuts.push(cut),
                        }
                    }
                    false
                });
            }
            cuts.extend(around);
        }
        let mut background: Vec<[f64; 2]> = Vec::new();
        for place in self.places(image, range, cuts).windows(2) {
            let middle = (place[0] + place[1]) * 0.5;
            let may_cover = |(_, may): &&(u32, [f64; 2])| may[0] <= middle && middle <= may[1];
            let is_covered = || {
                self.faces.is_covered(self.space, &self.probe(index, image, middle), touch_px, |_, visit| {
                    cover.faces.iter().filter(may_cover).any(|(face, _)| visit(*face))
                })
            };
            if !hold(&cover.open, middle) || is_covered() {
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
    /// face within `touch_px` of the point counts as going through it. Faces seen edge-on cover nothing. `any` shows it the faces in a
    /// column until it returns true.
    pub(in crate::lines) fn is_covered(
        &self,
        space: &Space,
        probe: &Probe,
        touch_px: f64,
        any: impl FnOnce(&Box3, &mut dyn FnMut(u32) -> bool) -> bool,
    ) -> bool {
        let column =
            Box3::new((probe.px - touch_px).extend(f64::NEG_INFINITY), (probe.px + touch_px).extend(f64::INFINITY));
        let touch = touch_px / space.px_per_unit(-probe.view.z);
        let mut covered = [false; 2];
        any(&column, &mut |face| {
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
