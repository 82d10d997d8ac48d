//! Rays from points of lines to the eye.

use crate::support::lines::{length, px};
use crate::support::shapes::Random;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use tinta::Scene;
use tinta::camera::Projection;
use tinta::lines::{LineSegment, VisibleLines};
use tinta::tolerances::{CONTACT, CREASE_DIGITS, TOUCH, WELD};

/// Distance of the rays' start from a line on either side, pixels. It is twice the distance within which two lines
/// coincide in the picture, so each ray is clearly on its side of anything on the line.
const ASIDE_PX: f64 = 1e-4;

/// Least distance of tested points from a segment's ends, pixels: more than the 0.02 pixels near a common corner
/// within which an adjacent face may hide the line.
const FROM_ENDS_PX: f64 = 0.03;

/// Sine of the angle to the view: a face is edge-on below the first value and not edge-on above the second.
const EDGE_ON: [f64; 2] = [1e-12, 1e-7];

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
}

#[derive(Debug, Default, Clone)]
pub struct Found {
    /// Tested points of hidden and visible segments, and the undecided ones among them.
    pub hidden: usize,
    pub visible: usize,
    pub unclear: usize,
    /// Edges whose points were counted, and those that a rule for covered edges exempts in part.
    pub edges: usize,
    pub exempt: usize,
    pub wrong: Vec<String>,
}

impl Found {
    pub fn add(&mut self, other: &Self) {
        self.hidden += other.hidden;
        self.visible += other.visible;
        self.unclear += other.unclear;
        self.edges += other.edges;
        self.exempt += other.exempt;
    }

    pub fn summary(&self) -> String {
        format!(
            "{} hidden and {} visible points, {} of these unclear; {} edges, {} covered by others",
            self.hidden, self.visible, self.unclear, self.edges, self.exempt
        )
    }
}

impl<'a> Rays<'a> {
    pub fn new(scene: &'a Scene) -> Self {
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
        Self { scene, faces, edges, welds, noise: ROUNDING * farthest }
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

    /// Tests points of all segments, and all edges.
    pub fn check(&self, lines: &VisibleLines, random: &mut Random) -> Found {
        let mut found = Found::default();
        for piece in lines.segments.iter().filter(|piece| length(piece) > 3.0 * FROM_ENDS_PX) {
            self.check_piece(piece, lines, random, &mut found);
        }
        self.check_edges(lines, &mut found);
        found
    }

    fn check_piece(&self, piece: &LineSegment, lines: &VisibleLines, random: &mut Random, found: &mut Found) {
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
            let aside = self.aside(point, along_px, ASIDE_PX);
            let sides = [aside, -aside].map(|aside| self.side(point, aside, &line));
            let is_wrong = match piece.is_visible {
                true => sides == [Side::Covered; 2],
                false => sides.contains(&Side::Open) && !self.is_under_nearer(point, piece, lines),
            };
            *(if piece.is_visible { &mut found.visible } else { &mut found.hidden }) += 1;
            let is_decided = match piece.is_visible {
                true => sides.contains(&Side::Open),
                false => sides == [Side::Covered; 2] || sides.contains(&Side::Open),
            };
            found.unclear += usize::from(!is_decided);
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

    /// The point of a segment whose image is at a pixel, if its image passes through it.
    fn nearest(&self, piece: &LineSegment, image: DVec2) -> Option<DVec3> {
        let [a, b] = piece.ends_px;
        let share = ((image - a).dot(b - a) / a.distance_squared(b).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let touch_px = 2.0 * TOUCH * f64::from(self.scene.size.width.max(self.scene.size.height));
        (a.lerp(b, share).distance(image) <= touch_px).then(|| self.at(piece.ends_world, share))
    }

    /// Sine of the angle between a face and the view, positive from its front.
    fn sine(&self, face: usize) -> f64 {
        let face = &self.faces[face];
        let camera = &self.scene.camera;
        let towards_eye = if self.is_parallel() { camera.backward() } else { camera.eye - face.corners[0] };
        face.normal.dot(towards_eye.normalize())
    }

    /// Whether an edge is a line by the default settings; `None` if rounding or a rule for overlapping faces decides.
    fn is_line(&self, [a, b]: [u32; 2], faces: &[usize]) -> Option<bool> {
        let [first, second] = match *faces {
            [_] => return Some(true),
            [first, second] => [first, second],
            _ => return None,
        };
        let runs_up = |face: usize| {
            let corners = self.faces[face].numbers.map(|number| number[1]);
            (0..3).any(|side| [corners[side], corners[(side + 1) % 3]] == [a, b])
        };
        let turned = if runs_up(first) == runs_up(second) { -1.0 } else { 1.0 };
        let normals = [first, second].map(|face| self.faces[face].normal);
        let cosine = turned * normals[0].dot(normals[1]);
        let of_drawings = 30f64.to_radians().cos();
        if normals.contains(&DVec3::ZERO) || (cosine - of_drawings).abs() < 2.0 * CREASE_DIGITS || cosine < 1e-9 - 1.0 {
            return None;
        }
        let way = |sine: f64| match sine.abs() {
            size if size <= EDGE_ON[0] => Some(0.0),
            size if size >= EDGE_ON[1] => Some(sine.signum()),
            _ => None,
        };
        let ways = [way(self.sine(first))?, way(turned * self.sine(second))?];
        Some(ways[0] != ways[1] || cosine < of_drawings)
    }

    /// Asserts that the segments of each edge follow one another without gap or overlap, unless another line fills
    /// the gap.
    fn check_edges(&self, lines: &VisibleLines, found: &mut Found) {
        let mut pieces: BTreeMap<(u32, [u32; 2]), Vec<&LineSegment>> = BTreeMap::new();
        for piece in &lines.segments {
            if let Some([a, b]) = self.numbers(piece) {
                pieces.entry((piece.object, [a.min(b), a.max(b)])).or_default().push(piece);
            }
        }
        for (&(object, numbers), faces) in &self.edges {
            let own = pieces.remove(&(object, numbers)).unwrap_or_default();
            let in_scene = &self.scene.objects[object as usize];
            let ends = numbers.map(|number| in_scene.mesh.positions[number as usize] + in_scene.offset);
            let is_line = self.is_line(numbers, faces);
            let Some(clipped) = self.clipped(ends) else { continue };
            let images = clipped.map(|end| px(self.scene, end));
            let length_px = images[0].distance(images[1]);
            if length_px < SAME_PLACE_PX {
                continue;
            }
            let along = (images[1] - images[0]) / length_px;
            let mut ranges: Vec<[f64; 2]> = own
                .iter()
                .map(|piece| {
                    let [a, b] = piece.ends_px.map(|end| (end - images[0]).dot(along));
                    [a.min(b), a.max(b)]
                })
                .collect();
            ranges.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            let what = || format!("object {object} edge {numbers:?}, {length_px} px, {} faces", faces.len());
            if let Some(pair) = ranges.windows(2).find(|pair| pair[1][0] < pair[0][1] - SAME_PLACE_PX) {
                found.wrong.push(format!("{} is twice from {} to {}", what(), pair[1][0], pair[0][1]));
            }
            let is_mended = |point: DVec3| self.lies_on_others(point, object, numbers);
            if is_line == Some(false) && !own.is_empty() && !is_mended(ends[0].lerp(ends[1], 0.5)) {
                found.wrong.push(format!("{} is no line", what()));
            }
            if is_line != Some(true) && own.is_empty() {
                continue;
            }
            found.edges += 1;
            let mut is_exempt = false;
            let mut start = 0.0;
            ranges.push([length_px; 2]);
            for [from, to] in ranges {
                let gap = [start, from];
                start = to.max(start);
                if gap[1] - gap[0] <= SAME_PLACE_PX {
                    continue;
                }
                for share in [0.01, 0.3, 0.5, 0.77, 0.99] {
                    let place = gap[0] + (gap[1] - gap[0]) * share;
                    let point = self.at(clipped, place / length_px);
                    if self.is_stood_for(point, object, ends[0].distance(ends[1]), lines) {
                        continue;
                    }
                    match is_mended(point) {
                        true => is_exempt = true,
                        false => {
                            found.wrong.push(format!("{} is in no piece at {}", what(), px(self.scene, point)));
                            break;
                        }
                    }
                }
            }
            found.exempt += usize::from(is_exempt);
        }
        // A face with a corner on its rim is split, and parts replace its edges.
        let is_part = |(object, numbers): &(u32, [u32; 2])| {
            let in_scene = &self.scene.objects[*object as usize];
            let place = |number: u32| in_scene.mesh.positions[number as usize];
            self.edges.keys().filter(|(other, _)| other == object).any(|(_, edge)| {
                let [a, b] = edge.map(place);
                numbers.iter().all(|number| {
                    let point = place(*number);
                    a.distance(point) + point.distance(b) <= a.distance(b) + self.noise
                })
            })
        };
        let invented = pieces.into_keys().filter(|edge| !is_part(edge));
        found.wrong.extend(invented.map(|edge| format!("lines of no edge: {edge:?}")));
    }

    /// Whether another line lies in the same place in space.
    fn is_stood_for(&self, point: DVec3, object: u32, length: f64, lines: &VisibleLines) -> bool {
        let image = px(self.scene, point);
        let touch = 2.1 * (CONTACT * length + self.welds[object as usize]) + self.noise;
        lines
            .segments
            .iter()
            .any(|piece| self.nearest(piece, image).is_some_and(|other| other.distance(point) <= touch))
    }

    /// Whether faces of its object without this edge touch it at a point, or faces at it lie on one another. The
    /// rules for covering faces and T-junctions then decide.
    fn lies_on_others(&self, point: DVec3, object: u32, numbers: [u32; 2]) -> bool {
        let own = &self.edges[&(object, numbers)];
        let ends = numbers.map(|number| self.scene.objects[object as usize].mesh.positions[number as usize]);
        let across: Vec<DVec3> = own
            .iter()
            .map(|face| {
                let face = &self.faces[*face];
                let apex = (0..3).find(|corner| !numbers.contains(&face.numbers[*corner][1])).unwrap_or(0);
                let along = (ends[1] - ends[0]).normalize();
                let to_apex = face.corners[apex] - point;
                (to_apex - along * along.dot(to_apex)).normalize_or_zero()
            })
            .collect();
        let lie_on_one_another =
            (0..across.len()).any(|second| (0..second).any(|first| across[first].dot(across[second]) > 1.0 - 1e-9));
        let others: BTreeSet<usize> = own.iter().copied().collect();
        let touch = 2.0 * self.welds[object as usize] + self.noise;
        let touches = |face: &Face| {
            let [p, q, r] = face.corners;
            let inside = [(p, q), (q, r), (r, p)]
                .map(|(from, to)| face.normal.cross(to - from).normalize_or_zero().dot(point - from));
            face.normal.dot(point - p).abs() <= touch && inside.iter().all(|inside| *inside >= -touch)
        };
        lie_on_one_another
            || self
                .faces
                .iter()
                .enumerate()
                .any(|(number, face)| face.object == object && !others.contains(&number) && touches(face))
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
