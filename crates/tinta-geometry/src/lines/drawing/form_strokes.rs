//! Strokes along the form: where parallel planes of the model cut its visible faces.
//!
//! In: regions of one face and tone each. Out: strokes. The image of a section with a plane is a straight line in each face, so it is cut
//! at the sides of the region as exactly as a ruled stroke. Pieces of one plane that meet are one stroke. A darker tone has the strokes of
//! every plane, a brighter one those of every second; a face seen at an angle leaves out as many as keep the distance.

use crate::limits::HATCH_STROKES;
use crate::lines::drawing::form_planes::FormPlanes;
use crate::lines::drawing::simplify::simplified;
use crate::lines::eye::space::Space;
use crate::lines::regions::{Region, Regions, SeenFace};
use crate::scene::Scene;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, HashMap};

/// Number of steps until the distance between planes doubles: views of nearly the same size share it.
const STEPS: f64 = 8.0;

/// Distance between ends of pieces that meet, pixels.
const MEETING_PX: f64 = 0.05;

/// Least distance between strokes, as a share of that asked for, before every second one is left out.
const LEAST: f64 = 0.7;

/// How far strokes end before the border of their tone at most, as a share of their distance.
const UNEVEN: f64 = 1.5;

/// Where a plane meets a region, and whether its tone has a stroke there.
struct Piece {
    ends: [DVec2; 2],
    is_drawn: bool,
}

/// An object, the number of a plane's normal there, and the plane.
type Plane = (u32, u32, i64);

/// Finds the strokes with a distance and a least length in pixels; `None` for more than [`HATCH_STROKES`] pieces.
pub(super) fn form_strokes(
    scene: &Scene,
    regions: &Regions<Option<(SeenFace, u8)>>,
    brightest: u8,
    [spacing_px, least_px]: [f64; 2],
) -> Option<Vec<Vec<DVec2>>> {
    let space = Space::of(scene);
    let px_per_unit = space.px_per_unit((scene.camera.eye - scene.centre).length());
    let steps = (scene.radius * px_per_unit / spacing_px).log2() * STEPS;
    let distance = scene.radius / (steps.round() / STEPS).exp2();
    let mut planes: HashMap<u32, FormPlanes> = HashMap::new();
    let mut pieces: BTreeMap<Plane, Vec<Piece>> = BTreeMap::new();
    let mut count = 0;
    for region in &regions.regions {
        let Some((seen, tone)) = region.seen else { continue };
        let object = &scene.objects[seen.object as usize];
        let planes =
            planes.entry(seen.object).or_insert_with(|| FormPlanes::of(&object.mesh, scene.edges(object).list()));
        let number = planes.of_faces[seen.face as usize];
        let normal = planes.normals[number as usize] / distance;
        let Some(corners) = object.mesh.corners(&object.mesh.triangles[seen.face as usize]) else { continue };
        let face = SeenPlane {
            space: &space,
            corners: corners.map(|corner| space.view(corner + object.offset)),
            normal: space.direction(normal),
            start: normal.dot(space.world(DVec3::ZERO) - object.offset),
        };
        let step = face.step(region, spacing_px);
        let drawn_step = step << tone;
        let cuts = face.cuts(region, step)?;
        count += cuts.len();
        if count > HATCH_STROKES {
            return None;
        }
        for (row, ends) in cuts {
            let is_drawn = tone < brightest && row % drawn_step == 0;
            pieces.entry((seen.object, number, row)).or_default().push(Piece { ends, is_drawn });
        }
    }
    let mut strokes = Vec::new();
    for (plane, pieces) in &pieces {
        strokes.extend(drawn(pieces, *plane, spacing_px));
    }
    let length = |stroke: &Vec<DVec2>| stroke.windows(2).map(|ends| ends[0].distance(ends[1])).sum::<f64>();
    strokes.retain(|stroke| length(stroke) >= least_px);
    Some(strokes)
}

/// A face in the eye's space, and planes at whole numbers of `normal · point + start`.
struct SeenPlane<'a> {
    space: &'a Space,
    corners: [DVec3; 3],
    normal: DVec3,
    start: f64,
}

impl SeenPlane<'_> {
    /// The number of the plane through the place seen at a pixel, times the second number. Both are linear in the picture.
    fn place(&self, px: DVec2) -> [f64; 2] {
        let [a, b, c] = self.corners;
        let across = (b - a).cross(c - a);
        let [from, to] = self.space.ray(px);
        let share = across.dot(a - from) / across.dot(to - from);
        let point = from + (to - from) * share;
        let scale = if self.space.is_perspective() { -1.0 / point.z } else { 1.0 };
        [(self.normal.dot(point) + self.start) * scale, scale]
    }

    /// Every how many planes have a stroke: a power of two that gives the wanted distance.
    fn step(&self, region: &Region<Option<(SeenFace, u8)>>, spacing_px: f64) -> i64 {
        let Some(px) = region.loops.first().and_then(|corners| corners.first()) else { return 1 };
        let number = |px: DVec2| {
            let [number, scale] = self.place(px);
            number / scale
        };
        let here = number(*px);
        let slope = DVec2::new(number(*px + DVec2::X) - here, number(*px + DVec2::Y) - here).length();
        let wanted = LEAST * spacing_px * slope;
        // Beyond 2^20 a face is seen from its edge.
        if wanted > 1.0 { 1 << (wanted.log2().ceil().min(20.0) as i64) } else { 1 }
    }

    /// The strokes of every so many planes in a region; `None` for too many.
    fn cuts(&self, region: &Region<Option<(SeenFace, u8)>>, step: i64) -> Option<Vec<(i64, [DVec2; 2])>> {
        let mut cuts: Vec<(i64, DVec2)> = Vec::new();
        for corners in &region.loops {
            let places: Vec<[f64; 2]> = corners.iter().map(|px| self.place(*px)).collect();
            for (side, from) in corners.iter().enumerate() {
                let next = (side + 1) % corners.len();
                let (to, [a, q], [b, r]) = (corners[next], places[side], places[next]);
                let [first, last] = [a / q, b / r].map(|number| (number / step as f64).ceil());
                if !(first - last).is_finite() || (first - last).abs() > HATCH_STROKES as f64 {
                    return None;
                }
                for row in first.min(last) as i64..first.max(last) as i64 {
                    let row = row * step;
                    let number = row as f64;
                    let share = ((number * q - a) / ((b - a) - number * (r - q))).clamp(0.0, 1.0);
                    cuts.push((row, from.lerp(to, share)));
                }
            }
        }
        cuts.sort_unstable_by_key(|(row, _)| *row);
        let mut strokes = Vec::with_capacity(cuts.len() / 2);
        for of_row in cuts.chunk_by_mut(|one, other| one.0 == other.0) {
            let (low, high) = of_row
                .iter()
                .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), (_, px)| (low.min(*px), high.max(*px)));
            let is_wide = high.x - low.x >= high.y - low.y;
            let along = |px: DVec2| if is_wide { px.x } else { px.y };
            of_row.sort_unstable_by(|(_, one), (_, other)| along(*one).total_cmp(&along(*other)));
            strokes.extend(of_row.chunks_exact(2).map(|pair| (pair[0].0, [pair[0].1, pair[1].1])));
        }
        Some(strokes)
    }
}

/// The strokes of one plane: drawn pieces that meet, their ends inside the surface uneven.
fn drawn(pieces: &[Piece], plane: Plane, spacing_px: f64) -> Vec<Vec<DVec2>> {
    let ends: Vec<DVec2> = pieces.iter().flat_map(|piece| piece.ends).collect();
    let met = met(&ends);
    let mut is_done = vec![false; pieces.len()];
    let mut strokes = Vec::new();
    // Chains that end first, then closed ones.
    let starts = (0..ends.len()).filter(|end| met[*end].is_none()).chain((0..ends.len()).step_by(2));
    for start in starts {
        if is_done[start / 2] {
            continue;
        }
        let mut chain: Vec<(bool, [DVec2; 2])> = Vec::new();
        let mut next = Some(start);
        while let Some(end) = next.filter(|end| !is_done[end / 2]) {
            is_done[end / 2] = true;
            chain.push((pieces[end / 2].is_drawn, [ends[end], ends[end ^ 1]]));
            next = met[end ^ 1];
        }
        for run in chain.chunk_by(|one, other| one.0 == other.0).filter(|run| run[0].0) {
            let begins = run[0].1[0] == chain[0].1[0];
            let ends = run[run.len() - 1].1[1] == chain[chain.len() - 1].1[1];
            let mut points: Vec<DVec2> = run.iter().map(|(_, [from, _])| *from).collect();
            points.push(run[run.len() - 1].1[1]);
            let mut points = simplified(&points, false);
            for (is_whole, salt) in [(ends, 1), (begins, 2)] {
                if !is_whole {
                    shorten(&mut points, UNEVEN * spacing_px * share_of(plane, salt));
                }
                points.reverse();
            }
            if points.len() > 1 {
                strokes.push(points);
            }
        }
    }
    strokes
}

/// For each end the end of another piece at the same place.
fn met(ends: &[DVec2]) -> Vec<Option<usize>> {
    let cell = |px: DVec2| (px / MEETING_PX).floor().as_i64vec2();
    let mut cells: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    let mut met = vec![None; ends.len()];
    for (end, px) in ends.iter().enumerate() {
        let [x, y] = cell(*px).to_array();
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = around.filter_map(|cell| cells.get(&cell)).flatten().copied();
        let free = near.filter(|other| met[*other].is_none() && *other / 2 != end / 2);
        let nearest = free.min_by(|one, other| ends[*one].distance(*px).total_cmp(&ends[*other].distance(*px)));
        match nearest.filter(|other| ends[*other].distance(*px) <= MEETING_PX) {
            Some(other) => (met[end], met[other]) = (Some(other), Some(end)),
            None => cells.entry([x, y]).or_default().push(end),
        }
    }
    met
}

/// Cuts a length off the end of a polyline.
fn shorten(points: &mut Vec<DVec2>, mut length: f64) {
    while let [.., before, last] = points[..] {
        let piece = before.distance(last);
        if piece > length {
            let place = points.len() - 1;
            points[place] = last.lerp(before, length / piece);
            return;
        }
        length -= piece;
        points.pop();
    }
}

/// A number from 0 to 1 that looks like chance and is the same for a plane in every view.
fn share_of((object, normal, row): Plane, salt: u64) -> f64 {
    let mut mixed = salt;
    for part in [u64::from(object), u64::from(normal), row as u64] {
        mixed = (mixed ^ part).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^= mixed >> 29;
    }
    (mixed >> 11) as f64 / (1u64 << 53) as f64
}
