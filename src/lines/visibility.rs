//! Which parts of the lines are seen: cuts wherever that can change, then one ray for each piece.

use super::boxes::Box3;
use super::faces::{Faces, Own, Probe};
use super::features::Feature;
use super::image::{FLAT, Image, LineParts, LineTree};
use super::intersections::Piercing;
use super::space::Space;
use super::{LineSegment, Progress};
use crate::threads::{cores, in_chunks};
use crate::tolerances::{CONTACT, SHORTEST_LINE, TOUCH};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// All lines with their images, ready to be decided one by one.
pub(super) struct Lines<'a> {
    space: &'a Space,
    faces: &'a Faces,
    features: &'a [Feature],
    /// Of what of each line is between the near and the far plane.
    images: Vec<Option<Image>>,
    /// Where edges pass through faces.
    piercings: HashMap<[u32; 2], Vec<DVec3>>,
    /// Where surfaces end: what any line may be crossed by.
    rims: LineTree,
    /// The wanted lines, with the direction of their images for a third coordinate: what a line may lie on.
    beside: LineTree,
    touch_px: f64,
    shortest_px: f64,
}

/// Parts of the picture's larger side in which long lines are asked for what crosses them, so that a diagonal one does not
/// ask for everything in its box.
const PARTS_OF_PICTURE: f64 = 16.0;

impl<'a> Lines<'a> {
    pub fn new(space: &'a Space, faces: &'a Faces, features: &'a [Feature], piercings: &[Piercing]) -> Self {
        let images: Vec<Option<Image>> = features.iter().map(|feature| Image::of(space, feature.ends)).collect();
        let side = space.size.max_element();
        let touch_px = TOUCH * side;
        let (mut rims, mut beside) = (LineParts::default(), LineParts::default());
        for (index, (feature, image)) in features.iter().zip(&images).enumerate() {
            let Some((image, range)) = image.and_then(|image| Some((image, image.inside(space.size, 1.0)?))) else {
                continue;
            };
            for part in image.parts(range, side / PARTS_OF_PICTURE) {
                if feature.occludes {
                    rims.add(image.part_box(part, 0.0, FLAT), index);
                }
                if feature.class.is_some() {
                    for directions in image.directions(touch_px) {
                        beside.add(image.part_box(part, 0.0, directions), index);
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
            touch_px,
            shortest_px: SHORTEST_LINE * side,
        }
    }

    /// Every wanted line's pieces, in the lines' order.
    pub fn segments(&self, progress: &Progress) -> Vec<LineSegment> {
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
        let mut cuts = vec![inside[0], inside[1]];
        self.add_cuts(index, &image, inside, &mut cuts);
        cuts.sort_unstable_by(f64::total_cmp);
        let shortest = self.shortest_px / image.length();
        // A piece shorter than that belongs to its neighbour.
        let mut places = vec![inside[0]];
        places.extend(cuts.into_iter().filter(|cut| *cut > inside[0] + shortest && *cut < inside[1] - shortest));
        places.dedup_by(|next, kept| *next - *kept <= shortest);
        places.push(inside[1]);
        let mut open: Option<(f64, bool)> = None;
        let mut add = |from: f64, to: f64, is_visible: bool| {
            segments.push(LineSegment {
                class,
                is_visible,
                ends_px: [image.at(from), image.at(to)],
                edge: feature.edge,
                angle_degrees: feature.angle_degrees,
                object: feature.object,
            });
        };
        for piece in places.windows(2) {
            let state = self.state(index, &image, (piece[0] + piece[1]) * 0.5);
            match (open, state) {
                (Some((_, was_visible)), Some(is_visible)) if was_visible == is_visible => {}
                _ => {
                    if let Some((from, was_visible)) = open {
                        add(from, piece[0], was_visible);
                    }
                    open = state.map(|is_visible| (piece[0], is_visible));
                }
            }
        }
        if let Some((from, is_visible)) = open {
            add(from, inside[1], is_visible);
        }
    }

    /// Whether a line is seen at a place; `None` where it lies on another line that stands for both.
    fn state(&self, index: usize, image: &Image, place: f64) -> Option<bool> {
        let feature = &self.features[index];
        let (px, key) = (image.at(place), image.key(place));
        let view = self.space.point(px, key);
        let line_length = feature.ends[0].distance(feature.ends[1]);
        if self.is_repeated(index, image, px, -view.z) {
            return None;
        }
        let probe = Probe { view, px, key, line_length, weld: feature.weld, own: feature.own };
        Some(!self.faces.hide(self.space, &probe))
    }

    /// Whether another line of an earlier class, or of the same and an earlier number, runs through the same place in space.
    fn is_repeated(&self, index: usize, image: &Image, px: DVec2, depth: f64) -> bool {
        let feature = &self.features[index];
        let length = feature.ends[0].distance(feature.ends[1]);
        let [low, high] = image.directions(self.touch_px)[0];
        let here = Box3::new((px - self.touch_px).extend(low), (px + self.touch_px).extend(high));
        self.beside.any(&here, |other_index| {
            let other = &self.features[other_index];
            let comes_first = (other.class, other_index) < (feature.class, index);
            if !comes_first || (feature.own.meets(other.own) && !run_the_same_way(feature.ends, other.ends)) {
                return false;
            }
            let Some(image) = self.images[other_index] else { return false };
            let place = image.place_of(px).clamp(0.0, 1.0);
            let other_depth = self.space.depth_of_key(image.key(place));
            let contact = CONTACT * length.min(other.ends[0].distance(other.ends[1]))
                + feature.weld.min(other.weld)
                + 4.0 * self.space.noise;
            image.at(place).distance(px) <= self.touch_px && (other_depth - depth).abs() <= contact
        })
    }

    /// Adds the places along a line where what is seen of it may change.
    fn add_cuts(&self, index: usize, image: &Image, inside: [f64; 2], cuts: &mut Vec<f64>) {
        let feature = &self.features[index];
        for part in image.parts(inside, self.space.size.max_element() / PARTS_OF_PICTURE) {
            let others = [
                (&self.rims, FLAT, true),
                // Lines that lie on this one have its direction.
                (&self.beside, image.directions(self.touch_px)[0], false),
            ];
            for (tree, third, cross) in others {
                tree.any(&image.part_box(part, self.touch_px, third), |other_index| {
                    if other_index != index
                        && !feature.own.meets(self.features[other_index].own)
                        && let Some(other) = self.images[other_index]
                    {
                        self.add_crossings(image, &other, cross, cuts);
                    }
                    false
                });
            }
            if let Own::Faces(own) = feature.own {
                let keys = part.map(|place| image.key(place));
                self.faces.tree.any(&image.part_box(part, self.touch_px, keys), |face| {
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

    /// Adds where a nearer line's image crosses or touches this one's, and where one that lies on it ends.
    fn add_crossings(&self, image: &Image, other: &Image, occludes: bool, cuts: &mut Vec<f64>) {
        let along = image.b - image.a;
        let length = along.length();
        let (c, d) = (along.perp_dot(other.a - image.a) / length, along.perp_dot(other.b - image.a) / length);
        let touch = self.touch_px;
        if (c > touch && d > touch) || (c < -touch && d < -touch) {
            return;
        }
        if c.abs() <= touch && d.abs() <= touch {
            cuts.extend([image.place_of(other.a), image.place_of(other.b)]);
            return;
        }
        if !occludes {
            return;
        }
        let on_other = (c / (c - d)).clamp(0.0, 1.0);
        let place = image.place_of(other.at(on_other));
        if place * length < -touch || (place - 1.0) * length > touch {
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

/// Whether two lines with a common end go the same way from there.
fn run_the_same_way([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> bool {
    let (first, second) = if a == c {
        (b - a, d - c)
    } else if a == d {
        (b - a, c - d)
    } else if b == c {
        (a - b, d - c)
    } else {
        (a - b, c - d)
    };
    let lengths = first.length() * second.length();
    first.dot(second) > 0.0 && first.cross(second).length() <= CONTACT * lengths
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
