//! Which parts of the lines are seen: cuts wherever that can change, then one ray for each piece.
//!
//! Three questions use one rule, [`Image::overlap`]: which lines lie on one another in the picture. They are cut where one of
//! them ends and where both are equally near; the nearest is drawn; of equally near ones, one.

use super::beside::Beside;
use super::bundles::Bundles;
use super::faces::{Faces, Own, Probe};
use super::features::Feature;
use super::foremost::Foremost;
use super::image::{Image, LineParts, LineTree};
use super::intersections::Piercing;
use super::occluders::Occluders;
use super::progress::Phase;
use super::pyramid::Pyramid;
use super::search::{Cuts, LastHider, Sought};
use super::space::Space;
use super::{LineSegment, LineSettings, Progress};
use crate::bvh::{Box3, LeftOut, NO_FAMILY, counting_steps, steps};
use crate::error::Result;
use crate::memory;
use crate::threads::{cores, in_chunks, spread_chunks};
use crate::tolerances::{SHORTEST_LINE, TOUCH};
use glam::DVec3;
use std::cell::LazyCell;
use std::collections::HashMap;

/// All lines with their images, ready to be decided one by one.
pub(super) struct Lines<'a> {
    pub(super) space: &'a Space,
    pub(super) faces: &'a Faces,
    pub(super) features: &'a [Feature],
    /// Of what of each line is between the near and the far plane.
    pub(super) images: Vec<Option<Image>>,
    /// Where edges pass through faces.
    pub(super) piercings: HashMap<[u32; 2], Vec<DVec3>>,
    /// Where surfaces end: what any line may be crossed by.
    pub(super) rims: LineTree,
    /// What single faces hide; `None` where none is large enough.
    pub(super) pyramid: Option<&'a Pyramid>,
    /// What hides others; `None` where the faces as they are do.
    occluders: Option<Occluders>,
    /// Which faces are nearest; `None` where little lies in front of one another.
    pub(super) foremost: Option<&'a Foremost>,
    /// The wanted lines, with the direction of their images for a third coordinate: what a line may lie on.
    pub(super) beside: LineTree,
    /// Many lines that lie on one another.
    pub(super) bundles: Bundles,
    pub(super) shortest_px: f64,
    pub(super) finds_outline: bool,
    pub(super) finds_hidden: bool,
}

/// A part of a line that is seen or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    /// On which sides there is nothing but background, on the right and on the left as it runs.
    pub background: [bool; 2],
}

/// Parts of the picture's larger side in which long lines are asked for what crosses them, so that a diagonal one does not
/// ask for everything in its box.
pub(super) const PARTS_OF_PICTURE: f64 = 16.0;

/// Parts' lines between two looks at the time.
const LINES_A_GLANCE: usize = 64;

/// Pieces of one line between two looks at the time.
const PIECES_A_GLANCE: usize = 64;

/// What a part of a line takes while its tree is built, at the most, bytes: box, nodes, numbers, and what building them needs.
const BYTES_A_PART: usize = 320;

/// Lines whose parts a thread finds at once.
const MADE_AT_ONCE: usize = 4096;

impl<'a> Lines<'a> {
    pub(super) fn new(
        space: &'a Space,
        faces: &'a Faces,
        features: &'a [Feature],
        piercings: &[Piercing],
        (pyramid, foremost): (Option<&'a Pyramid>, Option<&'a Foremost>),
        settings: &LineSettings,
        progress: &Progress,
    ) -> Result<Self> {
        let &LineSettings { finds_outline, finds_hidden, .. } = settings;
        let images: Vec<Option<Image>> = features.iter().map(|feature| Image::of(space, feature.ends)).collect();
        let side = space.size.max_element();
        let hubs = hubs(features);
        let occluders = Occluders::new(space, faces, pyramid, foremost.is_some());
        // Where much lies behind one another a box is asked for by many.
        let rim_px = side / PARTS_OF_PICTURE / if foremost.is_some() { 4.0 } else { 1.0 };
        let parts = in_chunks(features.len(), MADE_AT_ONCE, cores(), |range| {
            let (mut rims, mut beside) = (LineParts::default(), LineParts::default());
            for index in range {
                if index % LINES_A_GLANCE == 0 && progress.is_over() {
                    break;
                }
                let (feature, image) = (&features[index], images[index]);
                let Some((image, range)) = image.and_then(|image| Some((image, image.inside(space.size, 1.0)?))) else {
                    continue;
                };
                let margin = image.noise_px;
                let ends = |part: [f64; 2]| part.map(|place| (image.at(place), image.key(place)));
                for part in image.parts(range, side / PARTS_OF_PICTURE) {
                    let is_hidden = LazyCell::new(|| pyramid.is_some_and(|pyramid| pyramid.hides_line(ends(part))));
                    // What is hidden for sure changes nothing where anything is seen; but for the outline at any depth.
                    let is_rim = feature.occludes && (finds_outline || !*is_hidden);
                    let is_beside = feature.class.is_some() && (finds_hidden || !*is_hidden);
                    for part in image.parts(part, rim_px).filter(|_| is_rim) {
                        let around = image.part_box(part, margin, part.map(|place| image.key(place)));
                        rims.add_of_families(around, index, feature.plane, hub_of(&hubs, feature.own));
                    }
                    if is_beside {
                        for directions in image.directions(image.touch_px(space)) {
                            beside.add(image.part_box(part, margin, directions), index);
                        }
                    }
                }
            }
            (rims, beside)
        });
        let (mut rims, mut beside) = (LineParts::default(), LineParts::default());
        for (some_rims, some_beside) in parts {
            rims.append(some_rims);
            beside.append(some_beside);
        }
        progress.go_on()?;
        memory::check_lines((rims.len() + beside.len()) * BYTES_A_PART, memory::free())?;
        let is_wanted = |index: usize| features[index].class.is_some();
        let bundles = Bundles::new(&images, is_wanted, space.size * 0.5, 2.0 * TOUCH * side);
        let mut pierced: HashMap<[u32; 2], Vec<DVec3>> = HashMap::new();
        for piercing in piercings {
            pierced.entry(piercing.edge).or_default().push(piercing.point);
        }
        Ok(Self {
            space,
            faces,
            features,
            images,
            piercings: pierced,
            rims: rims.tree(progress),
            pyramid,
            occluders,
            foremost,
            beside: beside.tree(progress),
            bundles,
            shortest_px: SHORTEST_LINE * side,
            finds_outline,
            finds_hidden,
        })
    }

    /// The wanted lines' pieces, in the lines' order; with how many boxes were looked at. Of all lines, unless the time is over
    /// before: then of some, each as a whole.
    pub(super) fn segments(&self, progress: &Progress) -> (Vec<LineSegment>, u64) {
        const LINES: usize = 64;
        progress.begin(Phase::Lines, self.features.len());
        // Not one after the other: what is left then takes as long as what is done, and a part is one of the whole picture.
        let parts = spread_chunks(self.features.len(), LINES, cores(), |range| {
            counting_steps(|| {
                let (mut segments, last) = (Vec::new(), LastHider::default());
                for index in range {
                    if progress.is_over() {
                        break;
                    }
                    let before = steps();
                    if self.add_segments(index, &last, progress, &mut segments).is_none() {
                        break;
                    }
                    progress.advance(1, steps().wrapping_sub(before));
                }
                segments
            })
        });
        let compared = parts.iter().map(|(_, steps)| steps).sum();
        let mut segments = Vec::with_capacity(parts.iter().map(|(segments, _)| segments.len()).sum());
        parts.into_iter().for_each(|(some, _)| segments.extend(some));
        (segments, compared)
    }

    /// Adds the pieces of a line; `None`, and nothing, where the time is over before all are decided.
    fn add_segments(
        &self,
        index: usize,
        last: &LastHider,
        progress: &Progress,
        segments: &mut Vec<LineSegment>,
    ) -> Option<()> {
        let feature = &self.features[index];
        let (Some(class), Some(image)) = (feature.class, self.images[index]) else { return Some(()) };
        let Some(inside) = image.inside(self.space.size, 0.0) else { return Some(()) };
        if image.length() * (inside[1] - inside[0]) <= self.shortest_px {
            return Some(());
        }
        let behind = self.behind_nearest(index, &image, inside);
        let looked = self.look(index, &image, inside, behind, Sought::Nearer, last);
        if !self.finds_hidden && looked.open.is_empty() {
            return Some(());
        }
        let beside = Beside::new(index, &image, inside);
        let add = |part, most, cuts: &mut Vec<f64>| self.add_cuts(index, &image, &beside, part, most, cuts);
        let mut cuts = self.search(index, &image, looked, Sought::Nearer, &beside, add);
        self.add_piercings(index, &image, &mut cuts.places);
        if self.finds_hidden {
            // The box of one that is upright or level holds no other.
            let is_thin = (image.b - image.a).abs().min_element() < 1.0;
            let longest = if is_thin { f64::INFINITY } else { self.space.size.max_element() / PARTS_OF_PICTURE };
            for part in image.parts(inside, longest) {
                self.add_beside(index, &image, &beside, part, usize::MAX, &mut cuts.places);
            }
        }
        let mut pieces: Vec<Piece> = Vec::new();
        let places = self.places(&image, inside, std::mem::take(&mut cuts.places));
        for (number, place) in places.windows(2).enumerate() {
            if number % PIECES_A_GLANCE == PIECES_A_GLANCE - 1 && progress.is_over() {
                return None;
            }
            let [from, to] = [place[0], place[1]];
            let place = (from + to) * 0.5;
            let is_hidden = cuts.hides(place);
            if is_hidden && !self.finds_hidden {
                continue;
            }
            let Some(is_visible) = self.state(index, &image, &beside, place, is_hidden, &cuts) else { continue };
            match pieces.last_mut() {
                Some(last) if last.is_visible == is_visible && last.to == from => last.to = to,
                _ => pieces.push(Piece { from, to, is_visible, background: [false; 2] }),
            }
        }
        pieces.retain(|piece| piece.is_visible || self.finds_hidden);
        let mut add = |piece: Piece| {
            segments.push(LineSegment {
                class,
                is_visible: piece.is_visible,
                is_outline: piece.background != [false; 2],
                background: piece.background,
                is_covered: false,
                ends_px: [image.at(piece.from), image.at(piece.to)],
                ends_world: image.ends_world(self.space, [piece.from, piece.to]),
                edge: feature.edge,
                angle_degrees: feature.angle_degrees,
                object: feature.object,
            });
        };
        for piece in pieces {
            match self.finds_outline && piece.is_visible {
                true => self.with_outline(index, &image, piece).into_iter().for_each(&mut add),
                false => add(piece),
            }
        }
        Some(())
    }

    /// Where a part of a line begins, is cut and ends. A piece shorter than the shortest line belongs to its neighbour.
    pub(super) fn places(&self, image: &Image, [from, to]: [f64; 2], mut cuts: Vec<f64>) -> Vec<f64> {
        cuts.sort_unstable_by(f64::total_cmp);
        let shortest = self.shortest_px / image.length();
        let mut places = vec![from];
        places.extend(cuts.into_iter().filter(|cut| *cut > from + shortest && *cut < to - shortest));
        places.dedup_by(|next, kept| *next - *kept <= shortest);
        places.push(to);
        places
    }

    /// Whether a line is seen at a place; `None` where it lies in space on another line that stands for both. Where faces hide it
    /// for sure only the latter is asked.
    fn state(
        &self,
        index: usize,
        image: &Image,
        beside: &Beside,
        place: f64,
        is_hidden: bool,
        cuts: &Cuts,
    ) -> Option<bool> {
        let probe = LazyCell::new(|| self.probe(index, image, place));
        let is_nearest = beside.are_none(self) || self.is_nearest(index, image, beside, probe.px, -probe.view.z)?;
        let leave_open = || {
            let planes = self.features[index].planes;
            self.faces.leave_open(self.space, &probe, |column, visit| self.any_occluder(column, planes, visit))
        };
        Some(is_nearest && !is_hidden && (cuts.leave_open(place) || leave_open()))
    }

    /// Calls `visit` with each face that may hide something and whose box overlaps, perhaps several times, until it returns true;
    /// without those in these planes, as far as whole groups are.
    pub(super) fn any_occluder(&self, query: &Box3, planes: [u32; 2], visit: impl FnMut(u32) -> bool) -> bool {
        self.any_but(query, LeftOut::planes(planes), visit)
    }

    pub(super) fn any_but(&self, query: &Box3, left_out: LeftOut, visit: impl FnMut(u32) -> bool) -> bool {
        match &self.occluders {
            Some(occluders) => occluders.any_but(query, left_out, visit),
            None => self.faces.tree.any_but(query, left_out, visit),
        }
    }

    /// A place of a line as the faces are asked about it.
    pub(super) fn probe(&self, index: usize, image: &Image, place: f64) -> Probe {
        let (px, key) = (image.at(place), image.key(place));
        let feature = &self.features[index];
        let along = (image.b - image.a).normalize();
        Probe {
            view: self.space.point(px, key),
            px,
            key,
            // Down in the picture is up in the eye's space.
            aside: DVec3::new(along.y, along.x, 0.0),
            line_length: feature.ends[0].distance(feature.ends[1]),
            weld: feature.weld,
            own: feature.own,
            own_ends: feature.own.corners(self.faces),
        }
    }
}

/// Rims that end in one position from which on they are told apart from others: below, comparing all costs less.
const HUB: u32 = 64;

/// How many rims end in each position, as far as these are more than [`HUB`].
fn hubs(features: &[Feature]) -> HashMap<u32, u32> {
    let mut counts: HashMap<u32, u32> = HashMap::new();
    for feature in features.iter().filter(|feature| feature.occludes) {
        if let Own::Edge(ends) = feature.own {
            ends.into_iter().for_each(|end| *counts.entry(end).or_default() += 1);
        }
    }
    counts.retain(|_, count| *count > HUB);
    counts
}

/// The hub in which an edge ends, if it does in one; of two that with more rims.
fn hub_of(hubs: &HashMap<u32, u32>, own: Own) -> u32 {
    let Own::Edge(ends) = own else { return NO_FAMILY };
    let known = ends.into_iter().filter_map(|end| Some((*hubs.get(&end)?, end)));
    known.max().map_or(NO_FAMILY, |(_, end)| end)
}
