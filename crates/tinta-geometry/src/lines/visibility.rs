//! Which parts of the lines are seen: cuts wherever that can change, then one ray for each piece.
//!
//! Three questions use one rule, [`Image::overlap`]: which lines lie on one another in the picture. They are cut where one of
//! them ends and where both are equally near; the nearest is drawn; of equally near ones, one.

use super::faces::{Faces, Own, Probe};
use super::features::Feature;
use super::image::{FLAT, Image, LineParts, LineTree};
use super::intersections::Piercing;
use super::space::Space;
use super::{LineSegment, Progress};
use crate::bvh::Box3;
use crate::threads::{cores, in_chunks};
use crate::tolerances::{CONTACT, SHORTEST_LINE};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// All lines with their images, ready to be decided one by one.
pub(super) struct Lines<'a> {
    pub(super) space: &'a Space,
    pub(super) faces: &'a Faces,
    pub(super) features: &'a [Feature],
    /// Of what of each line is between the near and the far plane.
    pub(super) images: Vec<Option<Image>>,
    /// Where edges pass through faces.
    piercings: HashMap<[u32; 2], Vec<DVec3>>,
    /// Where surfaces end: what any line may be crossed by.
    pub(super) rims: LineTree,
    /// The wanted lines, with the direction of their images for a third coordinate: what a line may lie on.
    beside: LineTree,
    shortest_px: f64,
    finds_outline: bool,
}

/// A part of a line that is seen or hidden as a whole, by its places on the image.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub from: f64,
    pub to: f64,
    pub is_visible: bool,
    pub is_outline: bool,
}

/// Parts of the picture's larger side in which long lines are asked for what crosses them, so that a diagonal one does not
/// ask for everything in its box.
pub(super) const PARTS_OF_PICTURE: f64 = 16.0;

impl<'a> Lines<'a> {
    pub(super) fn new(
        space: &'a Space,
        faces: &'a Faces,
        features: &'a [Feature],
        piercings: &[Piercing],
        finds_outline: bool,
    ) -> Self {
        let images: Vec<Option<Image>> = features.iter().map(|feature| Image::of(space, feature.ends)).collect();
        let side = space.size.max_element();
        let (mut rims, mut beside) = (LineParts::default(), LineParts::default());
        for (index, (feature, image)) in features.iter().zip(&images).enumerate() {
            let Some((image, range)) = image.and_then(|image| Some((image, image.inside(space.size, 1.0)?))) else {
                continue;
            };
            let (touch_px, margin) = (image.touch_px(space), image.noise_px);
            for part in image.parts(range, side / PARTS_OF_PICTURE) {
                if feature.occludes {
                    rims.add(image.part_box(part, margin, FLAT), index);
                }
                if feature.class.is_some() {
                    for directions in image.directions(touch_px) {
                        beside.add(image.part_box(part, margin, directions), index);
                    }
                }
            }
        }
        let mut pierced: HashMap<[u32; 2], Vec<DVec3>> = HashMap::new();
        for piercing in piercings {
            pierced.entry(piercing.edge).or_default().push(piercing.point);
        }
        Self {
            space,
            faces,
            features,
            images,
            piercings: pierced,
            rims: rims.tree(),
            beside: beside.tree(),
            shortest_px: SHORTEST_LINE * side,
            finds_outline,
        }
    }

    /// Every wanted line's pieces, in the lines' order.
    pub(super) fn segments(&self, progress: &Progress) -> Vec<LineSegment> {
        const LINES: usize = 64;
        progress.begin(self.features.len());
        let parts = in_chunks(self.features.len(), LINES, cores(), |range| {
            let mut segments = Vec::new();
            progress.advance(range.len());
            if progress.is_cancelled() {
                return segments;
            }
            range.for_each(|index| self.add_segments(index, &mut segments));
            segments
        });
        parts.concat()
    }

    fn add_segments(&self, index: usize, segments: &mut Vec<LineSegment>) {
        let feature = &self.features[index];
        let (Some(class), Some(image)) = (feature.class, self.images[index]) else { return };
        let Some(inside) = image.inside(self.space.size, 0.0) else { return };
        if image.length() * (inside[1] - inside[0]) <= self.shortest_px {
            return;
        }
        let mut cuts = Vec::new();
        self.add_cuts(index, &image, inside, &mut cuts);
        let mut pieces: Vec<Piece> = Vec::new();
        for place in self.places(&image, inside, cuts).windows(2) {
            let [from, to] = [place[0], place[1]];
            let Some(is_visible) = self.state(index, &image, (from + to) * 0.5) else { continue };
            match pieces.last_mut() {
                Some(last) if last.is_visible == is_visible && last.to == from => last.to = to,
                _ => pieces.push(Piece { from, to, is_visible, is_outline: false }),
            }
        }
        let mut add = |piece: Piece| {
            segments.push(LineSegment {
                class,
                is_visible: piece.is_visible,
                is_outline: piece.is_outline,
                ends_px: [image.at(piece.from), image.at(piece.to)],
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

    /// Whether a line is seen at a place; `None` where it lies in space on another line that stands for both.
    fn state(&self, index: usize, image: &Image, place: f64) -> Option<bool> {
        let probe = self.probe(index, image, place);
        let is_nearest = self.is_nearest(index, image, probe.px, -probe.view.z)?;
        Some(is_nearest && self.faces.leave_open(self.space, &probe))
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
        }
    }

    /// Whether a line is the nearest to the eye of those wanted ones that lie on it in the picture at a pixel. `None` where it
    /// lies in space on another of an earlier class, or of the same and a lower number.
    fn is_nearest(&self, index: usize, image: &Image, px: DVec2, depth: f64) -> Option<bool> {
        let touch_px = image.touch_px(self.space);
        let [low, high] = image.directions(touch_px)[0];
        let here = Box3::new((px - touch_px).extend(low), (px + touch_px).extend(high));
        let place = image.place_of(px);
        let mut others: Vec<(f64, usize)> = Vec::new();
        self.beside.any(&here, |other_index| {
            let Some(other) = self.images[other_index].filter(|_| other_index != index) else { return false };
            let lies_on_it = image
                .overlap(&other, touch_px.max(other.touch_px(self.space)))
                .is_some_and(|range| (range[0]..=range[1]).contains(&place));
            if lies_on_it {
                let key = other.key(other.place_of(px).clamp(0.0, 1.0));
                others.push((self.space.depth_of_key(key), other_index));
            }
            false
        });
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
    fn contact(&self, first: usize, second: usize) -> f64 {
        let [first, second] = [first, second].map(|index| &self.features[index]);
        let length = |feature: &Feature| feature.ends[0].distance(feature.ends[1]);
        CONTACT * length(first).min(length(second)) + first.weld.min(second.weld) + 4.0 * self.space.noise
    }

    /// Adds the places along a line where what is seen of it may change.
    fn add_cuts(&self, index: usize, image: &Image, inside: [f64; 2], cuts: &mut Vec<f64>) {
        let feature = &self.features[index];
        let touch_px = image.touch_px(self.space);
        for part in image.parts(inside, self.space.size.max_element() / PARTS_OF_PICTURE) {
            let others = [
                (&self.rims, FLAT, true),
                // Lines that lie on this one have its direction.
                (&self.beside, image.directions(touch_px)[0], false),
            ];
            for (tree, third, occludes) in others {
                tree.any(&image.part_box(part, touch_px, third), |other_index| {
                    if let Some(other) = self.images[other_index].filter(|_| other_index != index) {
                        let touch_px = touch_px.max(other.touch_px(self.space));
                        let meets = feature.own.meets(self.features[other_index].own);
                        self.add_crossings(image, &other, touch_px, occludes && !meets, cuts);
                    }
                    false
                });
            }
            if let Own::Faces(own) = feature.own {
                let keys = part.map(|place| image.key(place));
                self.faces.tree.any(&image.part_box(part, touch_px, keys), |face| {
                    if !own.contains(&face) {
                        cuts.extend(
                            self.piercing(feature.ends, face).map(|point| image.place_of(self.space.project(point).0)),
                        );
                    }
                    false
                });
            }
        }
        if let Own::Edge([a, b]) = feature.own
            && let Some(points) = self.piercings.get(&[a.min(b), a.max(b)])
        {
            cuts.extend(points.iter().map(|point| image.place_of(self.space.project(*point).0)));
        }
    }

    /// Adds where a line's image that lies on this one begins and ends and where both are equally near, and where a nearer one
    /// at which a surface ends crosses or touches it.
    fn add_crossings(&self, image: &Image, other: &Image, touch_px: f64, occludes: bool, cuts: &mut Vec<f64>) {
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
    fn piercing(&self, [from, to]: [DVec3; 2], face: u32) -> Option<DVec3> {
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
    fn meets(self, other: Self) -> bool {
        match (self, other) {
            (Self::Edge([a, b]), Self::Edge(other)) => other.contains(&a) || other.contains(&b),
            _ => false,
        }
    }
}
