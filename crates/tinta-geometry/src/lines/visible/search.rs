//! Where a line is cut, without looking at what is behind something.
//!
//! Where much lies in front of a line, most of it is hidden, and what crosses it there does not matter. So a part of a line that
//! is crossed by more than a few things is swept first: of every face in front of it the places are found at which it hides the
//! line *for sure*, inside the face and behind its plane by more than any tolerance, and those at which it *may*, by as much less.
//! What is hidden for sure is done with. Cuts are found in the rest, and there only pieces that something may hide need a ray.
//! Which of both is decided by plain linear equations; all that is not sure is left to the exact rules, which would say the same.
//! Before that the [pyramid](crate::lines::visible::pyramid) says what single faces hide of whole parts.

use crate::bvh::Box3;
use crate::lines::input::feature::Feature;
use crate::lines::visible::face_image::FaceImage;
use crate::lines::visible::image::Image;
use crate::lines::visible::line_index::{LineIndex, PARTS_OF_PICTURE};
use crate::lines::visible::nearest_faces::NearestFaces;
use crate::lines::visible::occluder_probe::{OccluderProbe, ProbedLine, SearchDepth};
use crate::lines::visible::overlapping_lines::OverlappingLines;
use crate::lines::visible::ranges::{gaps, hold, united};
use crate::tolerances::NEAR_CORNER;
use std::cell::Cell;

/// Where a line is cut, and where it needs no look.
#[derive(Default)]
pub(in crate::lines) struct Cuts {
    pub places: Vec<f64>,
    /// Ascending parts that are hidden for sure.
    hidden: Vec<[f64; 2]>,
    /// Ascending parts that were swept, and those in them in which something may hide the line.
    swept: Vec<[f64; 2]>,
    maybe: Vec<[f64; 2]>,
}

impl Cuts {
    /// Whether a place is hidden for sure.
    pub(in crate::lines) fn hides(&self, place: f64) -> bool {
        hold(&self.hidden, place)
    }

    /// Whether a place is seen for sure, as far as faces are concerned.
    pub(in crate::lines) fn leave_open(&self, place: f64) -> bool {
        hold(&self.swept, place) && !hold(&self.maybe, place)
    }
}

/// Cuts in a part of a line from which on it is swept.
const MOST: usize = 24;

/// How often one face is sought that hides much of what is left of a part, and how many are asked each time.
const PROBES: usize = 4;
const ASKED: usize = 48;

/// The face that hid a line last: often it hides the next one too.
#[derive(Default)]
pub(in crate::lines) struct OccluderCache(Cell<Option<u32>>);

/// The parts of a line that are to be searched, and those of which a look shows that they are hidden.
#[derive(Default)]
pub(in crate::lines) struct OpenParts {
    pub open: Vec<[f64; 2]>,
    hidden: Vec<[f64; 2]>,
}

impl LineIndex<'_> {
    /// What of a line between two places, some of which is known to be hidden, neither the pyramid nor one face hides.
    pub(in crate::lines) fn look(
        &self,
        index: usize,
        image: &Image,
        inside: [f64; 2],
        hidden: Vec<[f64; 2]>,
        search_depth: SearchDepth,
        last: &OccluderCache,
    ) -> OpenParts {
        let longest = self.space.size.max_element() / PARTS_OF_PICTURE;
        let is_long = |gap: &[f64; 2]| *gap == inside || (gap[1] - gap[0]) * image.length() > self.shortest_px;
        let gaps_before = gaps(inside, &hidden);
        let mut open_parts = OpenParts { open: Vec::new(), hidden };
        for gap in gaps_before.into_iter().filter(is_long) {
            if self.pyramid_hides(image, gap, search_depth) {
                open_parts.hidden.push(gap);
                continue;
            }
            let parts: Vec<[f64; 2]> = image.parts(gap, longest).collect();
            let is_whole = parts.len() == 1;
            for part in parts {
                if !is_whole && self.pyramid_hides(image, part, search_depth) {
                    open_parts.hidden.push(part);
                    continue;
                }
                let hidden = self.hidden_by_nearest_faces(index, image, part, search_depth);
                if hidden != [part] && self.one_hides(index, image, part, search_depth, last) {
                    open_parts.hidden.push(part);
                    continue;
                }
                open_parts.open.extend(gaps(part, &hidden).into_iter().filter(is_long));
                open_parts.hidden.extend(hidden);
            }
        }
        open_parts
    }

    /// The cuts of the open parts of a line; `add` adds those of one, or returns true where there are more than a given number.
    pub(in crate::lines) fn search(
        &self,
        index: usize,
        image: &Image,
        open_parts: OpenParts,
        search_depth: SearchDepth,
        overlapping: &OverlappingLines,
        mut add: impl FnMut([f64; 2], usize, &mut Vec<f64>) -> bool,
    ) -> Cuts {
        let mut found = Cuts { hidden: open_parts.hidden, ..Cuts::default() };
        for part in open_parts.open {
            let before = found.places.len();
            if !add(part, MOST, &mut found.places) {
                continue;
            }
            found.places.truncate(before);
            self.sweep(index, image, part, search_depth, overlapping, &mut found);
            for gap in gaps(part, &found.hidden) {
                if (gap[1] - gap[0]) * image.length() > self.shortest_px {
                    add(gap, usize::MAX, &mut found.places);
                }
            }
        }
        found.hidden = united(found.hidden);
        found.maybe = united(found.maybe);
        found
    }

    fn pyramid_hides(&self, image: &Image, part: [f64; 2], search_depth: SearchDepth) -> bool {
        let Some(pyramid) = self.pyramid else { return false };
        let [first, second] = part.map(|place| image.at(place));
        let (low, high) = (first.min(second), first.max(second));
        match search_depth {
            SearchDepth::Nearer => pyramid.hides(low, high, image.key(part[0]).min(image.key(part[1]))),
            SearchDepth::Any => pyramid.covers(low, high),
        }
    }

    /// Whether one face of those before the middle of a part hides all of it for sure. Asked where there are many.
    fn one_hides(
        &self,
        index: usize,
        image: &Image,
        part: [f64; 2],
        search_depth: SearchDepth,
        last: &OccluderCache,
    ) -> bool {
        if self.nearest_faces.is_none() || search_depth == SearchDepth::Any {
            return false;
        }
        let feature = &self.features[index];
        let probe = self.occluder_probe(index, image, part, search_depth);
        let hides = |face: u32| self.hidden_ranges(face, &probe)[0] == Some(part);
        if last.0.get().is_some_and(hides) {
            return true;
        }
        let middle = (part[0] + part[1]) * 0.5;
        let px = image.at(middle);
        let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(image.key(middle)));
        let (mut asked, mut is_hidden) = (0, false);
        self.any_occluder(&column, feature.planes, |face| {
            asked += 1;
            is_hidden = hides(face);
            if is_hidden {
                last.0.set(Some(face));
            }
            is_hidden || asked >= ASKED
        });
        is_hidden
    }

    /// What of a part the nearest faces hide for sure. Asked where there are many.
    fn hidden_by_nearest_faces(
        &self,
        index: usize,
        image: &Image,
        part: [f64; 2],
        search_depth: SearchDepth,
    ) -> Vec<[f64; 2]> {
        let Some(nearest_faces) = self.nearest_faces else { return Vec::new() };
        let probe = |part: [f64; 2]| self.occluder_probe(index, image, part, search_depth);
        nearest_faces.hidden(self.space, self.faces, part, probe, NearestFaces::ASKED)
    }

    fn occluder_probe(&self, index: usize, image: &Image, part: [f64; 2], search_depth: SearchDepth) -> OccluderProbe {
        let &Feature { own, ends, weld, .. } = &self.features[index];
        OccluderProbe::new(self.space, self.faces, ProbedLine { own, ends, weld }, image, part, search_depth)
    }

    /// Finds what of a part faces hide for sure, and what they may hide.
    fn sweep(
        &self,
        index: usize,
        image: &Image,
        part: [f64; 2],
        search_depth: SearchDepth,
        overlapping: &OverlappingLines,
        found: &mut Cuts,
    ) {
        let feature = &self.features[index];
        let length = image.length();
        // What the pyramid hides of it, in pieces of about its cells.
        let mut hidden: Vec<[f64; 2]> = Vec::new();
        if self.pyramid.is_some() {
            let pieces = image.parts(part, self.space.size.max_element() / (PARTS_OF_PICTURE * 8.0));
            hidden.extend(pieces.filter(|piece| self.pyramid_hides(image, *piece, search_depth)));
        }
        let touch_px = image.touch_px(self.space);
        let farthest = |part: [f64; 2]| match search_depth {
            SearchDepth::Nearer => image.key(part[0]).max(image.key(part[1])),
            SearchDepth::Any => f64::INFINITY,
        };
        let probe = |part: [f64; 2]| self.occluder_probe(index, image, part, search_depth);
        // Often one face or two hide nearly all.
        for _ in 0..PROBES {
            let open = gaps(part, &hidden);
            let Some(gap) = open.into_iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0]))) else { break };
            let middle = (gap[0] + gap[1]) * 0.5;
            let px = image.at(middle);
            let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(farthest([middle; 2])));
            let probe = probe(gap);
            let (mut asked, mut best) = (0, [middle; 2]);
            self.any_occluder(&column, feature.planes, |face| {
                asked += 1;
                let sure = self.hidden_ranges(face, &probe)[0];
                if let Some(sure) = sure.filter(|sure| sure[1] - sure[0] > best[1] - best[0]) {
                    best = sure;
                }
                asked >= ASKED || (best[1] - best[0]) * 2.0 > gap[1] - gap[0]
            });
            if (best[1] - best[0]) * 4.0 < gap[1] - gap[0] {
                break;
            }
            hidden.push(best);
            hidden = united(hidden);
        }
        let mut maybe = Vec::new();
        for gap in gaps(part, &hidden) {
            if (gap[1] - gap[0]) * length <= NEAR_CORNER * self.space.size.max_element() {
                // It costs less to look at all there is.
                maybe.push(gap);
                continue;
            }
            let probe = probe(gap);
            let farthest = farthest(gap);
            self.any_occluder(&image.part_box(gap, touch_px, [f64::NEG_INFINITY, farthest]), feature.planes, |face| {
                let [sure, may] = self.hidden_ranges(face, &probe);
                hidden.extend(sure);
                maybe.extend(may);
                false
            });
        }
        hidden = united(hidden);
        if !self.finds_hidden {
            let open = gaps(part, &hidden);
            for gap in open.into_iter().filter(|gap| (gap[1] - gap[0]) * length > self.shortest_px) {
                self.behind_overlapping_lines(index, image, overlapping, gap, &mut hidden);
            }
        }
        found.hidden.extend(united(hidden));
        found.maybe.extend(united(maybe));
        found.swept.push(part);
    }
}

impl LineIndex<'_> {
    /// What of a part of a line a face hides for sure, on both sides, and what it may hide.
    fn hidden_ranges(&self, face: u32, probe: &OccluderProbe) -> [Option<[f64; 2]>; 2] {
        match self.nearest_faces {
            Some(nearest_faces) => {
                self.faces.hidden_ranges(self.space, face, &nearest_faces.image(self.space, self.faces, face), probe)
            }
            None => self.faces.hidden_ranges(self.space, face, &FaceImage::of(self.space, self.faces, face), probe),
        }
    }
}
