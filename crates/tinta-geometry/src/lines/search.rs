//! Where a line is cut, without looking at what is behind something.
//!
//! Where much lies in front of a line, most of it is hidden, and what crosses it there does not matter. So a part of a line that
//! is crossed by more than a few things is swept first: of every face in front of it the places are found at which it hides the
//! line *for sure*, inside the face and behind its plane by more than any tolerance, and those at which it *may*, by as much less.
//! What is hidden for sure is done with. Cuts are found in the rest, and there only pieces that something may hide need a ray.
//! Which of both is decided by plain linear equations; all that is not sure is left to the exact rules, which would say the same.
//! Before that the [pyramid](super::pyramid) says what single faces hide of whole parts.

use super::beside::Beside;
use super::face_image::FaceImage;
use super::faces::{Faces, Own};
use super::features::Feature;
use super::foremost::Foremost;
use super::image::Image;
use super::ranges::{above_zero, clipped, common, gaps, hold, united};
use super::space::Space;
use super::visibility::{Lines, PARTS_OF_PICTURE};
use crate::bvh::Box3;
use crate::tolerances::{CONTACT, NEAR_CORNER, TIP};
use glam::{DVec2, DVec3};
use std::cell::Cell;

/// Where a line is cut, and where it needs no look.
#[derive(Default)]
pub(super) struct Cuts {
    pub places: Vec<f64>,
    /// Ascending parts that are hidden for sure.
    hidden: Vec<[f64; 2]>,
    /// Ascending parts that were swept, and those in them in which something may hide the line.
    swept: Vec<[f64; 2]>,
    maybe: Vec<[f64; 2]>,
}

impl Cuts {
    /// Whether a place is hidden for sure.
    pub(super) fn hides(&self, place: f64) -> bool {
        hold(&self.hidden, place)
    }

    /// Whether a place is seen for sure, as far as faces are concerned.
    pub(super) fn leave_open(&self, place: f64) -> bool {
        hold(&self.swept, place) && !hold(&self.maybe, place)
    }
}

/// Cuts in a part of a line from which on it is swept.
const MOST: usize = 24;

/// How often one face is sought that hides much of what is left of a part, and how many are asked each time.
const PROBES: usize = 4;
const ASKED: usize = 48;

/// What a search looks for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sought {
    /// What is nearer to the eye.
    Nearer,
    /// What is there at any depth.
    Any,
}

/// The face that hid a line last: often it hides the next one too.
#[derive(Default)]
pub(super) struct LastHider(Cell<Option<u32>>);

/// The parts of a line that are to be searched, and those of which a look shows that they are hidden.
#[derive(Default)]
pub(super) struct Looked {
    pub open: Vec<[f64; 2]>,
    hidden: Vec<[f64; 2]>,
}

/// A line of which it is asked what hides it.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub own: Own,
    /// In the eye's space.
    pub ends: [DVec3; 2],
    /// The distance below which positions of its object count as one, file units.
    pub weld: f64,
}

/// A part of such a line.
pub(super) struct Stretch {
    part: [f64; 2],
    pub px: [DVec2; 2],
    /// In the eye's space.
    view: [DVec3; 2],
    own: Own,
    /// The positions in which the line ends, as far as it ends in some.
    own_ends: [u32; 2],
    /// The positions in which the part begins and ends, as far as it ends in some.
    corners: [u32; 2],
    /// So near to such a corner what faces around it hide is hidden up to there, shares of the line.
    near_corner: f64,
    /// So near to where the part begins and ends what any face hides is hidden up to there, shares of the line.
    tips: [f64; 2],
    line_length: f64,
    weld: f64,
    touch_px: f64,
    /// What rounding may move a point by, pixels.
    noise_px: f64,
    is_nearer_sought: bool,
}

impl Lines<'_> {
    /// What of a line between two places, some of which is known to be hidden, neither the pyramid nor one face hides.
    pub(super) fn look(
        &self,
        index: usize,
        image: &Image,
        inside: [f64; 2],
        hidden: Vec<[f64; 2]>,
        sought: Sought,
        last: &LastHider,
    ) -> Looked {
        let longest = self.space.size.max_element() / PARTS_OF_PICTURE;
        let is_long = |gap: &[f64; 2]| *gap == inside || (gap[1] - gap[0]) * image.length() > self.shortest_px;
        let gaps_before = gaps(inside, &hidden);
        let mut looked = Looked { open: Vec::new(), hidden };
        for gap in gaps_before.into_iter().filter(is_long) {
            if self.pyramid_hides(image, gap, sought) {
                looked.hidden.push(gap);
                continue;
            }
            let parts: Vec<[f64; 2]> = image.parts(gap, longest).collect();
            let is_whole = parts.len() == 1;
            for part in parts {
                if !is_whole && self.pyramid_hides(image, part, sought) {
                    looked.hidden.push(part);
                    continue;
                }
                let hidden = self.hidden_by_foremost(index, image, part, sought);
                if hidden != [part] && self.one_hides(index, image, part, sought, last) {
                    looked.hidden.push(part);
                    continue;
                }
                looked.open.extend(gaps(part, &hidden).into_iter().filter(is_long));
                looked.hidden.extend(hidden);
            }
        }
        looked
    }

    /// The cuts of the open parts of a line; `add` adds those of one, or returns true where there are more than a given number.
    pub(super) fn search(
        &self,
        index: usize,
        image: &Image,
        looked: Looked,
        sought: Sought,
        beside: &Beside,
        mut add: impl FnMut([f64; 2], usize, &mut Vec<f64>) -> bool,
    ) -> Cuts {
        let mut found = Cuts { hidden: looked.hidden, ..Cuts::default() };
        for part in looked.open {
            let before = found.places.len();
            if !add(part, MOST, &mut found.places) {
                continue;
            }
            found.places.truncate(before);
            self.sweep(index, image, part, sought, beside, &mut found);
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

    fn pyramid_hides(&self, image: &Image, part: [f64; 2], sought: Sought) -> bool {
        let Some(pyramid) = self.pyramid else { return false };
        let [first, second] = part.map(|place| image.at(place));
        let (low, high) = (first.min(second), first.max(second));
        match sought {
            Sought::Nearer => pyramid.hides(low, high, image.key(part[0]).min(image.key(part[1]))),
            Sought::Any => pyramid.covers(low, high),
        }
    }

    /// Whether one face of those before the middle of a part hides all of it for sure. Asked where there are many.
    fn one_hides(&self, index: usize, image: &Image, part: [f64; 2], sought: Sought, last: &LastHider) -> bool {
        if self.foremost.is_none() || sought == Sought::Any {
            return false;
        }
        let feature = &self.features[index];
        let stretch = self.stretch(index, image, part, sought);
        let hides = |face: u32| self.hidden_ranges(face, &stretch)[0] == Some(part);
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
    fn hidden_by_foremost(&self, index: usize, image: &Image, part: [f64; 2], sought: Sought) -> Vec<[f64; 2]> {
        let Some(foremost) = self.foremost else { return Vec::new() };
        let stretch = |part: [f64; 2]| self.stretch(index, image, part, sought);
        foremost.hidden(self.space, self.faces, part, stretch, Foremost::ASKED)
    }

    fn stretch(&self, index: usize, image: &Image, part: [f64; 2], sought: Sought) -> Stretch {
        let &Feature { own, ends, weld, .. } = &self.features[index];
        Stretch::new(self.space, self.faces, Line { own, ends, weld }, image, part, sought)
    }

    /// Finds what of a part faces hide for sure, and what they may hide.
    fn sweep(&self, index: usize, image: &Image, part: [f64; 2], sought: Sought, beside: &Beside, found: &mut Cuts) {
        let feature = &self.features[index];
        let length = image.length();
        // What the pyramid hides of it, in pieces of about its cells.
        let mut hidden: Vec<[f64; 2]> = Vec::new();
        if self.pyramid.is_some() {
            let pieces = image.parts(part, self.space.size.max_element() / (PARTS_OF_PICTURE * 8.0));
            hidden.extend(pieces.filter(|piece| self.pyramid_hides(image, *piece, sought)));
        }
        let touch_px = image.touch_px(self.space);
        let farthest = |part: [f64; 2]| match sought {
            Sought::Nearer => image.key(part[0]).max(image.key(part[1])),
            Sought::Any => f64::INFINITY,
        };
        let stretch = |part: [f64; 2]| self.stretch(index, image, part, sought);
        // Often one face or two hide nearly all.
        for _ in 0..PROBES {
            let open = gaps(part, &hidden);
            let Some(gap) = open.into_iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0]))) else { break };
            let middle = (gap[0] + gap[1]) * 0.5;
            let px = image.at(middle);
            let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(farthest([middle; 2])));
            let stretch = stretch(gap);
            let (mut asked, mut best) = (0, [middle; 2]);
            self.any_occluder(&column, feature.planes, |face| {
                asked += 1;
                let sure = self.hidden_ranges(face, &stretch)[0];
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
            let stretch = stretch(gap);
            let farthest = farthest(gap);
            self.any_occluder(&image.part_box(gap, touch_px, [f64::NEG_INFINITY, farthest]), feature.planes, |face| {
                let [sure, may] = self.hidden_ranges(face, &stretch);
                hidden.extend(sure);
                maybe.extend(may);
                false
            });
        }
        hidden = united(hidden);
        if !self.finds_hidden {
            let open = gaps(part, &hidden);
            for gap in open.into_iter().filter(|gap| (gap[1] - gap[0]) * length > self.shortest_px) {
                self.behind_lines(index, image, beside, gap, &mut hidden);
            }
        }
        found.hidden.extend(united(hidden));
        found.maybe.extend(united(maybe));
        found.swept.push(part);
    }
}

impl Own {
    /// So near to its end what a face hides of a line is hidden up to there, a share of its length. An intersection ends where an edge passes
    /// through a face, often in a plane in which others lie, too, and behind none of these for sure.
    pub(super) fn tip(self, space: &Space, length_px: f64) -> f64 {
        match self {
            Self::Edge(_) => 0.0,
            Self::Faces(_) => TIP * space.size.max_element() / length_px,
        }
    }
}

impl Stretch {
    /// The part between two places of the line's image.
    pub(super) fn new(space: &Space, faces: &Faces, line: Line, image: &Image, part: [f64; 2], sought: Sought) -> Self {
        let Line { own, ends, weld } = line;
        let (corners, length_px) = (own.corners(faces), image.length());
        let is_at = |end: usize, px: DVec2| space.project(ends[end]).0 == px;
        let is_at_end = [part[0] == 0.0 && is_at(0, image.a), part[1] == 1.0 && is_at(1, image.b)];
        Self {
            part,
            corners: [0, 1].map(|end| if is_at_end[end] { corners[end] } else { u32::MAX }),
            near_corner: NEAR_CORNER * space.size.max_element() / length_px,
            tips: is_at_end.map(|is_at_end| if is_at_end { own.tip(space, length_px) } else { 0.0 }),
            px: part.map(|place| image.at(place)),
            view: part.map(|place| space.point(image.at(place), image.key(place))),
            own,
            own_ends: corners,
            line_length: ends[0].distance(ends[1]),
            weld,
            touch_px: image.touch_px(space),
            noise_px: image.noise_px,
            is_nearer_sought: sought == Sought::Nearer,
        }
    }

    /// A range that a face hides, up to where the line ends in one of its corners, for there both touch, and nothing comes between; and up
    /// to any end that is very near.
    fn up_to_ends(&self, mut range: [f64; 2], corners: [u32; 3]) -> [f64; 2] {
        for (end, place) in range.iter_mut().enumerate() {
            let left = (*place - self.part[end]).abs();
            if left <= self.tips[end] || left <= self.near_corner && corners.contains(&self.corners[end]) {
                *place = self.part[end];
            }
        }
        range
    }
}

impl Lines<'_> {
    /// What of a part of a line a face hides for sure, on both sides, and what it may hide.
    fn hidden_ranges(&self, face: u32, stretch: &Stretch) -> [Option<[f64; 2]>; 2] {
        match self.foremost {
            Some(foremost) => {
                self.faces.hidden_ranges(self.space, face, &foremost.image(self.space, self.faces, face), stretch)
            }
            None => self.faces.hidden_ranges(self.space, face, &FaceImage::of(self.space, self.faces, face), stretch),
        }
    }
}

impl Faces {
    pub(super) fn hidden_ranges(
        &self,
        space: &Space,
        face: u32,
        image: &FaceImage,
        stretch: &Stretch,
    ) -> [Option<[f64; 2]>; 2] {
        const NOTHING: [Option<[f64; 2]>; 2] = [None; 2];
        let is_cut = !self.cut_by_near.is_empty() && self.cut_by_near.binary_search(&face).is_ok();
        // How far inside of each side both ends are; most faces in the box of a part lie beside it.
        let [from, to] = stretch.px;
        let of_side = |side: usize| [image.inside(side, from), image.inside(side, to)];
        let inside = [of_side(0), of_side(1), of_side(2)];
        let outside = -2.0 * stretch.touch_px - image.rounding_px;
        let is_side = |side: usize| image.lengths_px[side] > 2.0 * stretch.touch_px;
        if !is_cut && (0..3).any(|side| is_side(side) && inside[side][0].max(inside[side][1]) < outside) {
            return NOTHING;
        }
        if matches!(stretch.own, Own::Faces(own) if own.contains(&face)) {
            return NOTHING;
        }
        let numbers = self.triangles[face as usize];
        let is_own_end = |number: u32| stretch.own_ends.contains(&number);
        let is_own = [is_own_end(numbers[0]), is_own_end(numbers[1]), is_own_end(numbers[2])];
        if is_own.iter().filter(|is_own| **is_own).count() == 2 {
            return NOTHING;
        }
        if is_cut {
            return [None, Some(stretch.part)];
        }
        let [mut sure, mut may] = [Some(stretch.part); 2];
        for side in 0..3 {
            if !is_side(side) {
                // No direction to speak of.
                sure = None;
                continue;
            }
            // A side that begins where the line ends runs beside it as near as one likes.
            let is_beside = stretch.is_nearer_sought && (is_own[side] || is_own[(side + 1) % 3]);
            let margin = if is_beside { 8.0 * stretch.noise_px } else { 2.0 * stretch.touch_px } + image.rounding_px;
            let [start, end] = inside[side];
            sure = clipped(sure, stretch.part, [start - margin, end - margin]);
            may = clipped(may, stretch.part, [start - outside, end - outside]);
            if may.is_none() {
                return NOTHING;
            }
        }
        if !stretch.is_nearer_sought {
            return [sure, may];
        }
        let [a, b, c] = self.corners(face);
        let normal = (b - a).cross(c - a);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
        let touching = CONTACT * longest.min(stretch.line_length) + self.weld(numbers[0]).min(stretch.weld);
        // As in the exact rule, the less the nearer to a corner that both have.
        let corner = (0..3).find(|corner| is_own[*corner]).map(|corner| [a, b, c][corner]);
        let contacts = stretch.view.map(|view| {
            let share = corner.map_or(1.0, |corner| (view.distance(corner) / stretch.line_length).min(1.0));
            (touching * share + 4.0 * space.noise) * normal.length()
        });
        let away = -normal.dot(space.to_eye(a)).signum();
        let behind = stretch.view.map(|view| normal.dot(view - a) * away);
        // Places along the line as places along its image.
        let depths = stretch.view.map(|view| if space.is_perspective() { -view.z } else { 1.0 });
        let place = |share: f64| {
            if share == 1.0 {
                return stretch.part[1];
            }
            let far = share * depths[1];
            stretch.part[0] + (stretch.part[1] - stretch.part[0]) * (far / ((1.0 - share) * depths[0] + far))
        };
        let clip = |range: Option<[f64; 2]>, times: f64| {
            let behind = [0, 1].map(|end| behind[end] - times * contacts[end]);
            common(range?, above_zero([0.0, 1.0], behind)?.map(place))
        };
        [clip(sure, 2.0).map(|sure| stretch.up_to_ends(sure, numbers)), clip(may, 0.5)]
    }
}
