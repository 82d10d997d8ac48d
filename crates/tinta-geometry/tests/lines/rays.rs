//! Lines by rays in f64 and world space, each against every face, with no formula of the library.

mod crossings;
mod edges;

use crate::support::lines::{distance, length, lines, lines_with, px};
use crate::support::shapes::Random;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use tinta::Scene;
use tinta::camera::Projection;
use tinta::lines::{LineSegment, LineSettings, VisibleLines};
use tinta::tolerances::{CONTACT, TOUCH, WELD};

/// Distance of the rays' start from a line on either side, pixels. It is twice the distance within which two lines
/// coincide in the picture, so each ray is clearly on its side of anything on the line.
const ASIDE_PX: f64 = 1e-4;

/// Least distance of tested points from a segment's ends, pixels: more than the 0.02 pixels near a common corner
/// within which an adjacent face may hide the line.
const FROM_ENDS_PX: f64 = 0.03;

/// Largest overlap or gap between the ends of segments, pixels: ten times the shortest line in a picture of 640.
const SAME_PLACE_PX: f64 = 1e-3;

/// Rounding of a place in space, as a share of the largest coordinate or distance.
const ROUNDING: f64 = 1e-12;

struct Face {
    corners: [DVec3; 3],
    /// Positions by object and number.
    numbers: [[u32; 2]; 3],
    normal: DVec3,
    longest: f64,
    object: u32,
    /// Bounds of its image, with a margin.
    low: DVec2,
    high: DVec2,
}

/// The state of the space between one side of a line and the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    /// A face certainly covers it.
    Covered,
    /// A face touches the line, or its rim passes too close to decide.
    Unclear,
    Open,
}

struct Line {
    ends: [DVec3; 2],
    /// The positions at its ends by object and number: both for an edge; for an intersection, the common corner of
    /// its faces.
    corners: [Option<[u32; 2]>; 2],
    /// The faces that it belongs to.
    own: Vec<usize>,
    object: u32,
}

/// All faces and edges of a scene.
pub struct Rays<'a> {
    scene: &'a Scene,
    faces: Vec<Face>,
    /// By object and position numbers, the lower first.
    edges: BTreeMap<(u32, [u32; 2]), Vec<usize>>,
    welds: Vec<f64>,
    /// Largest shift of a point by rounding, file units.
    noise: f64,
    creases: Creases,
    /// Distances of the rays from a line, pixels; a point is wrong if the rays at each of them say so.
    asides_px: &'static [f64],
}

/// Which creases are lines.
#[derive(Debug, Clone, Copy)]
pub enum Creases {
    /// From 30 degrees, as in drawings.
    Drawn,
    /// With a cosine below 0.4, as in Dachsbacher's listing.
    Published,
}

impl Creases {
    /// The lines with these.
    pub fn lines(self, scene: &Scene) -> VisibleLines {
        match self {
            Self::Drawn => lines(scene),
            Self::Published => lines_with(scene, &LineSettings::as_published()),
        }
    }

    fn cosine(self) -> f64 {
        match self {
            Self::Drawn => 30f64.to_radians().cos(),
            Self::Published => 0.4,
        }
    }
}

#[derive(Debug, Default, Clone)]
pub struct RayFindings {
    /// Tested points of hidden and visible segments, and the undecided ones among them.
    pub hidden: usize,
    pub visible: usize,
    pub unclear: usize,
    /// Edges whose points were counted, and those that a rule for covered edges exempts in part.
    pub edges: usize,
    pub exempt: usize,
    /// Points where two faces pass through one another.
    pub crossings: usize,
    pub wrong: Vec<String>,
}

impl RayFindings {
    pub fn add(&mut self, other: &Self) {
        self.hidden += other.hidden;
        self.visible += other.visible;
        self.unclear += other.unclear;
        self.edges += other.edges;
        self.exempt += other.exempt;
        self.crossings += other.crossings;
    }

    pub fn summary(&self) -> String {
        format!(
            "{} hidden and {} visible points, {} of these unclear; {} edges, {} covered by others; {} points of crossings",
            self.hidden, self.visible, self.unclear, self.edges, self.exempt, self.crossings
        )
    }
}

impl<'a> Rays<'a> {
    pub fn new(scene: &'a Scene, creases: Creases) -> Self {
        let (mut faces, mut edges, mut welds) = (Vec::new(), BTreeMap::new(), Vec::new());
        let mut farthest: f64 = 0.0;
        let camera = &scene.camera;
        for (number, object) in (0u32..).zip(&scene.objects) {
            let (low, high) = object.mesh.bounds();
            welds.push(WELD * low.distance(high));
            for triangle in &object.mesh.triangles {
                for side in 0..3 {
                    let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
                    let of_edge: &mut Vec<usize> = edges.entry((number, [a.min(b), a.max(b)])).or_default();
                    of_edge.push(faces.len());
                }
                let corners = triangle.map(|corner| object.mesh.positions[corner as usize] + object.offset);
                let [a, b, c] = corners;
                corners
                    .iter()
                    .for_each(|corner| farthest = farthest.max(corner.distance(camera.eye)).max(corner.length()));
                let is_cut = corners.iter().any(|corner| (camera.eye - *corner).dot(camera.backward()) < camera.near);
                let images = corners.map(|corner| px(scene, corner));
                // The image of a face cut by the near plane is unbounded.
                let (low, high) = match is_cut {
                    true => (DVec2::NEG_INFINITY, DVec2::INFINITY),
                    false => {
                        (images[0].min(images[1]).min(images[2]) - 1.0, images[0].max(images[1]).max(images[2]) + 1.0)
                    }
                };
                faces.push(Face {
                    corners,
                    numbers: triangle.map(|corner| [number, corner]),
                    normal: (b - a).cross(c - a).normalize_or_zero(),
                    longest: a.distance(b).max(b.distance(c)).max(c.distance(a)),
                    object: number,
                    low,
                    high,
                });
            }
        }
        Self { scene, faces, edges, welds, noise: ROUNDING * farthest, creases, asides_px: &[ASIDE_PX] }
    }

    /// The same for thin models: lines may be wrong by 0.004 pixels.
    pub fn of_thin(scene: &'a Scene, creases: Creases) -> Self {
        Self { asides_px: &[ASIDE_PX, 4e-3], ..Self::new(scene, creases) }
    }

    fn is_parallel(&self) -> bool {
        matches!(self.scene.camera.projection, Projection::Parallel { .. })
    }

    fn depth(&self, point: DVec3) -> f64 {
        (self.scene.camera.eye - point).dot(self.scene.camera.backward())
    }

    /// The direction from a point to the eye, or to the plane through it.
    fn to_eye(&self, point: DVec3) -> DVec3 {
        let camera = &self.scene.camera;
        if self.is_parallel() { camera.backward() * self.depth(point) } else { camera.eye - point }
    }

    /// The point of a line whose image is at this share of the line's image.
    fn at(&self, [a, b]: [DVec3; 2], share: f64) -> DVec3 {
        if self.is_parallel() {
            return a.lerp(b, share);
        }
        let (near, far) = (self.depth(a) * share, self.depth(b) * (1.0 - share));
        a.lerp(b, near / (near + far))
    }

    /// The distance below which a face touches a line at a point: proportional to the distance from a common corner.
    fn touch(&self, face: &Face, line: &Line, point: DVec3) -> f64 {
        let length = line.ends[0].distance(line.ends[1]);
        let touch =
            CONTACT * face.longest.min(length) + self.welds[face.object as usize].min(self.welds[line.object as usize]);
        let corner = (0..2).find(|end| line.corners[*end].is_some_and(|corner| face.numbers.contains(&corner)));
        corner.map_or(touch, |corner| touch * (point.distance(line.ends[corner]) / length).min(1.0))
    }

    /// The state of one side of a line at a point.
    fn side(&self, point: DVec3, aside: DVec3, line: &Line) -> Side {
        let camera = &self.scene.camera;
        let moved = point + aside;
        let image = px(self.scene, moved);
        let to_eye = self.to_eye(moved);
        let mut side = Side::Open;
        for (number, face) in self.faces.iter().enumerate() {
            let is_elsewhere = image.cmplt(face.low).any() || image.cmpgt(face.high).any();
            if is_elsewhere || face.normal == DVec3::ZERO || line.own.contains(&number) {
                continue;
            }
            let [p, q, r] = face.corners;
            let from_plane = |point: DVec3| face.normal.dot(point - p).abs();
            // A face whose plane contains the line does not hide it.
            let touches = |end: &DVec3| from_plane(*end) < 0.4 * self.touch(face, line, *end) + self.noise;
            if line.ends.iter().all(touches) {
                continue;
            }
            let share = face.normal.dot(p - moved) / face.normal.dot(to_eye);
            let hit = moved + to_eye * share;
            // A line may touch the face here and lie behind it elsewhere: the whole line decides then.
            let is_near = from_plane(point) <= 2.1 * self.touch(face, line, point) + self.noise;
            if !share.is_finite() || (share <= 0.0 && !is_near) || self.depth(hit) < camera.near {
                continue;
            }
            // How far inside the face the ray passes, pixels.
            let unit_px =
                px(self.scene, hit + camera.backward().any_orthonormal_vector()).distance(px(self.scene, hit));
            let inside_px = |(from, to): (DVec3, DVec3)| {
                let inward = face.normal.cross(to - from).normalize();
                let across = (inward - to_eye * (inward.dot(to_eye) / to_eye.length_squared())).length();
                inward.dot(hit - from) * unit_px * across
            };
            let inside_px = [(p, q), (q, r), (r, p)].map(inside_px).into_iter().fold(f64::INFINITY, f64::min);
            if inside_px < -0.1 * ASIDE_PX {
                continue;
            }
            if inside_px > 0.1 * ASIDE_PX && !is_near {
                return Side::Covered;
            }
            side = Side::Unclear;
        }
        side
    }

    /// A vector across a line's image, parallel to the picture, with this length in pixels at a point.
    fn aside(&self, point: DVec3, along_px: DVec2, length_px: f64) -> DVec3 {
        let camera = &self.scene.camera;
        let right = camera.up.cross(camera.backward()).normalize();
        let up = camera.backward().cross(right);
        let unit_px = px(self.scene, point + right).distance(px(self.scene, point));
        // Pixels run down, eye space up.
        (right * along_px.y + up * along_px.x) * (length_px / unit_px)
    }

    /// The positions of the edge that contains a segment, if the edge exists.
    fn numbers(&self, piece: &LineSegment) -> Option<[u32; 2]> {
        let vertices = &self.scene.objects[piece.object as usize].mesh.file_vertices;
        let number = |vertex: u32| Some(vertices.iter().position(|known| *known == vertex)? as u32);
        let [a, b] = piece.edge?;
        Some([number(a)?, number(b)?])
    }

    /// The line that contains a segment.
    fn line(&self, piece: &LineSegment) -> Option<Line> {
        if piece.edge.is_none() {
            // If a corner of one face touches the other face, the line ends in that corner, beside the planes'
            // intersection.
            return self.intersection(piece, CONTACT * CONTACT).or_else(|| self.intersection(piece, CONTACT));
        }
        let (numbers, object) = (self.numbers(piece)?, &self.scene.objects[piece.object as usize]);
        let [a, b] = numbers;
        Some(Line {
            ends: numbers.map(|number| object.mesh.positions[number as usize] + object.offset),
            corners: numbers.map(|number| Some([piece.object, number])),
            own: self.edges.get(&(piece.object, [a.min(b), a.max(b)])).cloned().unwrap_or_default(),
            object: piece.object,
        })
    }

    /// The intersection of two faces that contains a segment, within a share of their sides; the shortest if there
    /// are several.
    fn intersection(&self, piece: &LineSegment, share: f64) -> Option<Line> {
        let [start, end] = piece.ends_world;
        let along = (end - start).normalize();
        // The range of the segment that runs through a face.
        let range = |face: &Face| -> Option<[f64; 2]> {
            let [p, q, r] = face.corners;
            let rounding = share * face.longest + self.noise;
            if [start, end].iter().any(|end| face.normal.dot(*end - p).abs() > rounding) {
                return None;
            }
            let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
            for (a, b) in [(p, q), (q, r), (r, p)] {
                let inward = face.normal.cross(b - a).normalize();
                let (height, slope) = (inward.dot(start - a), inward.dot(along));
                match -height / slope {
                    place if slope > 1e-12 => from = from.max(place),
                    place if slope < -1e-12 => to = to.min(place),
                    _ if height < -rounding => return None,
                    _ => {}
                }
            }
            let is_on_it = from <= rounding && to >= start.distance(end) - rounding;
            is_on_it.then_some([from, to])
        };
        let ranges: Vec<(usize, [f64; 2])> =
            self.faces.iter().enumerate().filter_map(|(number, face)| Some((number, range(face)?))).collect();
        let pairs = (0..ranges.len()).flat_map(|second| (0..second).map(move |first| [first, second]));
        let lines = pairs.map(|pair| pair.map(|place| ranges[place])).filter_map(|[(first, one), (second, other)]| {
            let [f, g] = [first, second].map(|face| &self.faces[face]);
            let common: Vec<[u32; 2]> = f.numbers.into_iter().filter(|number| g.numbers.contains(number)).collect();
            let is_bent = f.normal.cross(g.normal).length() > CONTACT;
            let places = [one[0].max(other[0]), one[1].min(other[1])];
            let ends = places.map(|place| start + along * place);
            let at = |corner: [u32; 2]| f.corners[f.numbers.iter().position(|number| *number == corner).unwrap()];
            let corners = ends.map(|end| common.iter().copied().find(|corner| at(*corner).distance(end) <= CONTACT));
            let line = Line { ends, corners, own: vec![first, second], object: f.object };
            (is_bent && common.len() < 2).then_some((places[1] - places[0], line))
        });
        lines.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, line)| line)
    }

    /// Tests points of all segments, all edges, and all places where faces pass through one another.
    pub fn check(&self, random: &mut Random) -> RayFindings {
        let lines = &self.creases.lines(self.scene);
        let mut found = RayFindings::default();
        for piece in lines.segments.iter().filter(|piece| length(piece) > 3.0 * FROM_ENDS_PX) {
            self.check_piece(piece, lines, random, &mut found);
        }
        self.check_edges(lines, &mut found);
        self.check_crossings(lines, &mut found);
        found
    }

    fn check_piece(&self, piece: &LineSegment, lines: &VisibleLines, random: &mut Random, found: &mut RayFindings) {
        let Some(line) = self.line(piece) else {
            found.wrong.push(format!("neither edge nor intersection: {piece:?}"));
            return;
        };
        let is_wrong_place = |end: &(DVec3, DVec2)| px(self.scene, end.0).distance(end.1) > SAME_PLACE_PX;
        if piece.ends_world.into_iter().zip(piece.ends_px).any(|end| is_wrong_place(&end)) {
            found.wrong.push(format!("its ends in the picture are not those in the world: {piece:?}"));
            return;
        }
        let length_px = length(piece);
        let along_px = (piece.ends_px[1] - piece.ends_px[0]) / length_px;
        let count = (length_px * 0.05).clamp(2.0, 6.0).ceil() as usize;
        for sample in 0..count {
            let share = (sample as f64 + random.number()) / count as f64;
            let place = share.clamp(FROM_ENDS_PX / length_px, 1.0 - FROM_ENDS_PX / length_px);
            let point = self.at(piece.ends_world, place);
            let sides_at = |aside_px: f64| {
                let aside = self.aside(point, along_px, aside_px);
                [aside, -aside].map(|aside| self.side(point, aside, &line))
            };
            let is_wrong_at = |sides: [Side; 2]| match piece.is_visible {
                true => sides == [Side::Covered; 2],
                false => sides.contains(&Side::Open) && !self.is_under_nearer(point, piece, lines),
            };
            let sides = sides_at(ASIDE_PX);
            let is_wrong = self.asides_px.iter().all(|aside_px| is_wrong_at(sides_at(*aside_px)));
            *(if piece.is_visible { &mut found.visible } else { &mut found.hidden }) += 1;
            let is_decided = match piece.is_visible {
                true => sides.contains(&Side::Open),
                false => sides == [Side::Covered; 2] || sides.contains(&Side::Open),
            };
            found.unclear += usize::from(!is_decided);
            if piece.is_visible && self.is_doubled(point, along_px, piece, lines) {
                found.wrong.push(format!("drawn twice at {} of {piece:?}", px(self.scene, point)));
            }
            if is_wrong {
                found.wrong.push(format!("{sides:?} at {} of {piece:?}", px(self.scene, point)));
            }
        }
    }

    /// Whether a visible line overlaps a point in the picture and is not farther away.
    fn is_under_nearer(&self, point: DVec3, piece: &LineSegment, lines: &VisibleLines) -> bool {
        let image = px(self.scene, point);
        lines.segments.iter().any(|other| {
            let nearest = || self.nearest(other, image);
            other.is_visible
                && !std::ptr::eq(other, piece)
                && nearest().is_some_and(|nearest| self.depth(nearest) <= self.depth(point) + self.noise)
        })
    }

    /// Whether another visible segment runs along this one at a point.
    fn is_doubled(&self, point: DVec3, along_px: DVec2, piece: &LineSegment, lines: &VisibleLines) -> bool {
        let image = px(self.scene, point);
        lines.segments.iter().any(|other| {
            let [a, b] = other.ends_px;
            other.is_visible
                && !std::ptr::eq(other, piece)
                && [a, b].iter().all(|end| end.distance(image) > FROM_ENDS_PX)
                && distance(image, [a, b]) < 1e-6
                && (b - a).normalize().perp_dot(along_px).abs() < 1e-6
        })
    }

    /// The point of a segment whose image is at a pixel, if its image passes through it.
    fn nearest(&self, piece: &LineSegment, image: DVec2) -> Option<DVec3> {
        let [a, b] = piece.ends_px;
        let share = ((image - a).dot(b - a) / a.distance_squared(b).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let touch_px = 2.0 * TOUCH * f64::from(self.scene.size.width.max(self.scene.size.height));
        (a.lerp(b, share).distance(image) <= touch_px).then(|| self.at(piece.ends_world, share))
    }

    /// The part of a line in the picture and between the planes.
    fn clipped(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let camera = &self.scene.camera;
        let clip_from_world = camera.clip_from_view(self.scene.size.aspect()) * camera.view_from_world();
        let [start, end] = [a, b].map(|end| clip_from_world * end.extend(1.0));
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let (at_start, at_end) = (start.w + sign * start[axis], end.w + sign * end[axis]);
                let share = at_start / (at_start - at_end);
                match (at_start < 0.0, at_end < 0.0) {
                    (true, true) => return None,
                    (true, false) => from = from.max(share),
                    (false, true) => to = to.min(share),
                    _ => {}
                }
            }
        }
        (from < to).then(|| [from, to].map(|share| a.lerp(b, share)))
    }
}
