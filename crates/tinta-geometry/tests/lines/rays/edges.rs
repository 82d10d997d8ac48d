//! Which edges are lines, and whether all of each is there.

use super::{Face, RayFindings, Rays, SAME_PLACE_PX};
use crate::support::lines::px;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use tinta::edges::Class;
use tinta::lines::{LineSegment, VisibleLines};
use tinta::tolerances::{CONTACT, CREASE_DIGITS};

/// Sine of the angle to the view: a face is edge-on below the first value and not edge-on above the second.
const EDGE_ON: [f64; 2] = [1e-12, 1e-7];

impl Rays<'_> {
    /// Sine of the angle between a face and the view, positive from its front.
    fn sine(&self, face: usize) -> f64 {
        let face = &self.faces[face];
        let camera = &self.scene.camera;
        let towards_eye = if self.is_parallel() { camera.backward() } else { camera.eye - face.corners[0] };
        face.normal.dot(towards_eye.normalize())
    }

    /// Whether an edge is a line, and the classes that it may have; `None` if rounding or a rule for overlapping faces decides.
    fn classes(&self, [a, b]: [u32; 2], faces: &[usize]) -> Option<&'static [Class]> {
        let [first, second] = match *faces {
            [_] => return Some(&[Class::Boundary]),
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
        let limit = self.creases.cosine();
        if normals.contains(&DVec3::ZERO) || (cosine - limit).abs() < 2.0 * CREASE_DIGITS || cosine < 1e-9 - 1.0 {
            return None;
        }
        let way = |sine: f64| match sine.abs() {
            size if size <= EDGE_ON[0] => Some(0.0),
            size if size >= EDGE_ON[1] => Some(sine.signum()),
            _ => None,
        };
        let ways = [way(self.sine(first))?, way(turned * self.sine(second))?];
        Some(match (ways[0] == ways[1], ways.contains(&0.0)) {
            (true, _) if cosine >= limit => &[],
            (true, _) => &[Class::Crease],
            (false, true) => &[Class::Silhouette, Class::Crease],
            (false, false) => &[Class::Silhouette],
        })
    }

    /// Asserts that the segments of each edge have its class and follow one another without gap or overlap, unless another line
    /// fills the gap.
    pub(super) fn check_edges(&self, lines: &VisibleLines, found: &mut RayFindings) {
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
            let classes = self.classes(numbers, faces);
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
            let is_wrong = |piece: &&&LineSegment| classes.is_some_and(|classes| !classes.contains(&piece.class));
            if let Some(piece) = own.iter().find(is_wrong).filter(|_| !is_mended(ends[0].lerp(ends[1], 0.5))) {
                found.wrong.push(format!("{} is {:?} instead of {:?}", what(), piece.class, classes));
            }
            if classes.is_none_or(<[_]>::is_empty) && own.is_empty() {
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
}
