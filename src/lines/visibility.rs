//! Which parts of the lines are seen: cuts wherever that can change, then one ray for each piece.

use super::boxes::{Box3, BoxTree};
use super::faces::{Faces, Own, Probe};
use super::features::Feature;
use super::intersections::Piercing;
use super::space::Space;
use super::{LineSegment, Progress};
use crate::threads::{cores, in_chunks};
use crate::tolerances::{CONTACT, SHORTEST_LINE, TOUCH};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// A line's image: straight, its key linear along it.
#[derive(Debug, Clone, Copy)]
struct Image {
    a: DVec2,
    b: DVec2,
    keys: [f64; 2],
}

/// All lines with their images, ready to be decided one by one.
pub(super) struct Lines<'a> {
    space: &'a Space,
    faces: &'a Faces,
    features: &'a [Feature],
    /// Of what of each line is between the near and the far plane.
    images: Vec<Option<Image>>,
    /// Where edges pass through faces.
    piercings: HashMap<[u32; 2], Vec<DVec3>>,
    /// Parts of the lines, and each one's line.
    tree: BoxTree,
    numbers: Vec<u32>,
    touch_px: f64,
    shortest_px: f64,
}

/// Parts of the picture's larger side in which long lines are asked for what crosses them, so that a diagonal one does not
/// ask for everything in its box.
const PARTS_OF_PICTURE: f64 = 16.0;

/// Keys of boxes whose depth does not matter: it is compared where lines cross.
const FLAT: [f64; 2] = [0.0; 2];

impl<'a> Lines<'a> {
    pub fn new(space: &'a Space, faces: &'a Faces, features: &'a [Feature], piercings: &[Piercing]) -> Self {
        let images: Vec<Option<Image>> = features.iter().map(|feature| Image::of(space, feature.ends)).collect();
        let side = space.size.max_element();
        let (mut boxes, mut numbers) = (Vec::new(), Vec::new());
        for (index, image) in images.iter().enumerate() {
            let Some((image, range)) = image.and_then(|image| Some((image, image.inside(space.size, 1.0)?))) else {
                continue;
            };
            for part in image.parts(range, side / PARTS_OF_PICTURE) {
                boxes.push(image.part_box(part, 0.0, FLAT));
                numbers.push(index as u32);
            }
        }
        let (tree, order) = BoxTree::new(&boxes);
        let numbers = order.iter().map(|index| numbers[*index as usize]).collect();
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
            tree,
            numbers,
            touch_px: TOUCH * side,
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
        if self.is_repeated(index, feature, px, -view.z, line_length) {
            return None;
        }
        let probe = Probe { view, px, key, line_length, weld: feature.weld, own: feature.own };
        Some(!self.faces.hide(self.space, &probe))
    }

    /// Whether another line of an earlier class, or of the same and an earlier number, passes through the same place in space.
    fn is_repeated(&self, index: usize, feature: &Feature, px: DVec2, depth: f64, length: f64) -> bool {
        let here = Box3::new((px - self.touch_px).extend(0.0), (px + self.touch_px).extend(0.0));
        self.tree.any(&here, |place| {
            let other_index = self.numbers[place as usize];
            let other = &self.features[other_index as usize];
            let comes_first = other.class.is_some() && (other.class, other_index as usize) < (feature.class, index);
            if !comes_first || (feature.own.meets(other.own) && !run_the_same_way(feature.ends, other.ends)) {
                return false;
            }
            let Some(image) = self.images[other_index as usize] else { return false };
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
            self.tree.any(&image.part_box(part, self.touch_px, FLAT), |place| {
                let other_index = self.numbers[place as usize];
                let other = &self.features[other_index as usize];
                if other_index as usize != index
                    && !feature.own.meets(other.own)
                    && let Some(other_image) = self.images[other_index as usize]
                {
                    self.add_crossings(image, &other_image, other.occludes, cuts);
                }
                false
            });
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

impl Image {
    /// The image of what of a line is between the planes.
    fn of(space: &Space, ends: [DVec3; 2]) -> Option<Self> {
        let depths = ends.map(|end| -end.z);
        let mut range = [0.0f64, 1.0f64];
        for (start, end) in
            [(depths[0] - space.near, depths[1] - space.near), (space.far - depths[0], space.far - depths[1])]
        {
            if start < 0.0 && end < 0.0 {
                return None;
            }
            if start < 0.0 {
                range[0] = range[0].max(start / (start - end));
            } else if end < 0.0 {
                range[1] = range[1].min(start / (start - end));
            }
        }
        if range[0] >= range[1] {
            return None;
        }
        // The ends themselves as they are, so that lines that meet there meet in the picture.
        let point = |share: f64| match share {
            0.0 => ends[0],
            1.0 => ends[1],
            _ => ends[0] + (ends[1] - ends[0]) * share,
        };
        let ((a, first), (b, second)) = (space.project(point(range[0])), space.project(point(range[1])));
        Some(Self { a, b, keys: [first, second] })
    }

    fn length(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// The pixel at a place from 0 to 1.
    fn at(&self, place: f64) -> DVec2 {
        match place {
            0.0 => self.a,
            1.0 => self.b,
            _ => self.a + (self.b - self.a) * place,
        }
    }

    fn key(&self, place: f64) -> f64 {
        self.keys[0] + (self.keys[1] - self.keys[0]) * place
    }

    /// The place nearest to a pixel.
    fn place_of(&self, px: DVec2) -> f64 {
        let along = self.b - self.a;
        let square = along.length_squared();
        if square > 0.0 { (px - self.a).dot(along) / square } else { 0.0 }
    }

    /// From where to where a line is inside the picture with a margin around it (Liang and Barsky 1984).
    fn inside(&self, size: DVec2, margin: f64) -> Option<[f64; 2]> {
        let along = self.b - self.a;
        let mut range = [0.0f64, 1.0f64];
        for (start, step, limit) in [(self.a.x, along.x, size.x), (self.a.y, along.y, size.y)] {
            let (low, high) = (-margin - start, limit + margin - start);
            if step == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (enter, leave) = if step > 0.0 { (low / step, high / step) } else { (high / step, low / step) };
            range = [range[0].max(enter), range[1].min(leave)];
        }
        (range[0] <= range[1]).then_some(range)
    }

    /// A range of places in parts no longer than so many pixels.
    fn parts(&self, [from, to]: [f64; 2], longest_px: f64) -> impl Iterator<Item = [f64; 2]> + use<> {
        let count = ((to - from) * self.length() / longest_px).ceil().max(1.0);
        (0..count as usize).map(move |part| {
            let place = |part: usize| from + (to - from) * (part as f64 / count);
            [place(part), place(part + 1)]
        })
    }

    /// The box around a part, wider by a margin in pixels, between two keys.
    fn part_box(&self, part: [f64; 2], margin: f64, keys: [f64; 2]) -> Box3 {
        let [first, second] = part.map(|place| self.at(place));
        let (low, high) = (first.min(second) - margin, first.max(second) + margin);
        Box3::new(low.extend(keys[0].min(keys[1])), high.extend(keys[0].max(keys[1])))
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
