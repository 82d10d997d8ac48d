//! Strokes along the form: where parallel planes of the model cut its visible faces.
//!
//! In: a scene and a rule of tones. Out: strokes. A section with a plane is a straight line in each face. The deciders of lines say which
//! pieces of it are visible, and its ends' light where its tone changes. Pieces of one plane that meet are one stroke. A darker tone has the
//! strokes of every plane, a brighter one those of every second; a face seen at an angle leaves out as many as keep the distance.

use crate::error::Result;
use crate::limits::HATCH_STROKES;
use crate::lines::drawing::form_planes::FormPlanes;
use crate::lines::drawing::simplify::simplified;
use crate::lines::eye::image::Image;
use crate::lines::eye::space::Space;
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::Progress;
use crate::lines::regions::{SeenFace, ToneRule, View};
use crate::lines::sight::Sight;
use crate::memory::STROKES;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, HashMap};

/// Number of steps until the distance between planes doubles: views of nearly the same size share it.
const STEPS: f64 = 8.0;

/// Distance between ends of pieces that meet, pixels.
const MEETING_PX: f64 = 0.05;

/// Least distance between strokes, as a share of that asked for, before every second one is left out.
const LEAST: f64 = 0.7;

/// How far strokes end before the border of their tone at most, as a share of their distance, and of their length.
const UNEVEN: f64 = 1.5;
const SHORTENED: f64 = 0.25;

/// Most cuts, seen or not: those of many layers behind one another.
const MOST_CUTS: usize = 8 * HATCH_STROKES;

/// Halvings of a stretch that find where its tone changes.
const HALVINGS: usize = 40;

/// A visible piece of a cut, and whether its tone has a stroke there.
struct Piece {
    ends: [DVec2; 2],
    is_drawn: bool,
}

/// An object, the number of a plane's normal there, and the plane.
type Plane = (u32, u32, i64);

/// Where a plane cuts a face.
struct Cut {
    place: u32,
    plane: Plane,
    /// Every how many planes have a stroke in the face.
    step: i64,
    /// The weights of the face's corners at both ends.
    weights: [[f64; 3]; 2],
}

/// Finds the strokes of a rule's tones with a distance and a least length in pixels; `None` for more than [`HATCH_STROKES`] pieces.
///
/// # Errors
///
/// Those of [`Regions::toned`](crate::lines::Regions::toned).
pub(super) fn form_strokes(
    sight: &Sight<'_>,
    rule: &ToneRule,
    [spacing_px, least_px]: [f64; 2],
    progress: &Progress,
) -> Result<Option<Vec<Vec<DVec2>>>> {
    let view = View::of(sight, STROKES, progress)?;
    let Some(cuts) = cuts(&view, rule, spacing_px) else { return Ok(None) };
    let faces = &view.input.faces;
    let inside = cuts.iter().map(|cut| (cut.place, cut.weights.map(|weights| at(faces.corners(cut.place), weights))));
    let visible = view.visible(inside, progress)?;
    if visible.len() > HATCH_STROKES {
        return Ok(None);
    }
    let mut pieces: BTreeMap<Plane, Vec<Piece>> = BTreeMap::new();
    for (number, range, image) in visible {
        let cut = &cuts[number];
        let of_plane = pieces.entry(cut.plane).or_default();
        let (_, _, row) = cut.plane;
        for ([from, to], tone) in by_tone(&view, rule, cut, &image, range) {
            let is_drawn = tone < rule.brightest() && row % (cut.step << tone) == 0;
            of_plane.push(Piece { ends: [image.at(from), image.at(to)], is_drawn });
        }
    }
    let mut strokes: Vec<Vec<DVec2>> =
        pieces.iter().flat_map(|(plane, pieces)| drawn(pieces, *plane, spacing_px)).collect();
    strokes.retain(|stroke| length(stroke) >= least_px);
    Ok(Some(strokes))
}

/// The point of a face with these weights.
fn at(corners: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    corners.iter().zip(weights).map(|(corner, weight)| *corner * weight).sum()
}

/// Cuts the faces in the picture by their planes, as many as their darkest tone has strokes of; `None` for too many cuts.
fn cuts(view: &View, rule: &ToneRule, spacing_px: f64) -> Option<Vec<Cut>> {
    let LineInput { scene, space, faces, .. } = &view.input;
    let px_per_unit = space.px_per_unit((scene.camera.eye - scene.centre).length());
    let steps = (scene.radius * px_per_unit / spacing_px).log2() * STEPS;
    let distance = scene.radius / (steps.round() / STEPS).exp2();
    let planes: Vec<FormPlanes> =
        scene.objects.iter().map(|object| FormPlanes::of(&object.mesh, scene.edges(object).list())).collect();
    let mut cuts = Vec::new();
    // Of strokes in one place the first one stays: that of the face that is seen.
    let mut places: Vec<u32> = (0..faces.triangles.len() as u32).collect();
    places.sort_unstable_by_key(|place| faces.numbers[*place as usize]);
    for place in places {
        let seen @ SeenFace { object, face } = view.face(place);
        let (planes, mesh) = (&planes[object as usize], &scene.objects[object as usize].mesh);
        let number = planes.of_faces[face as usize];
        let normal = planes.normals[number as usize] / distance;
        let numbers = mesh.triangles[face as usize].map(|corner| normal.dot(mesh.positions[corner as usize]));
        let is_edge_on = || faces.edge_on.binary_search(&faces.numbers[place as usize]).is_ok();
        // Most faces of a fine mesh meet no plane.
        if numbers.iter().all(|number| number.ceil() == numbers[0].ceil()) || is_edge_on() {
            continue;
        }
        let tone = rule.least_tone(&rule.lights(view, seen));
        if tone == rule.brightest() {
            continue;
        }
        let corners = faces.corners(place);
        let step = step(space, corners, space.direction(normal), spacing_px);
        for (row, weights) in rows(numbers, step << tone)? {
            let image = Image::of(space, weights.map(|weights| at(corners, weights)));
            if image.is_some_and(|image| image.inside(space.size, 0.0).is_some()) {
                cuts.push(Cut { place, plane: (object, number, row), step, weights });
            }
        }
        if cuts.len() > MOST_CUTS {
            return None;
        }
    }
    Some(cuts)
}

/// Every how many planes have a stroke in a face: a power of two that gives the wanted distance at the middle of the visible part.
/// `normal` is the planes', as long as the inverse of their distance.
fn step(space: &Space, corners: [DVec3; 3], normal: DVec3, spacing_px: f64) -> i64 {
    let [a, b, c] = corners;
    let across = (b - a).cross(c - a);
    let number = |px: DVec2| {
        let [from, to] = space.ray(px);
        normal.dot(from + (to - from) * (across.dot(a - from) / across.dot(to - from)))
    };
    let before: Vec<DVec3> = corners.into_iter().filter(|corner| -corner.z >= space.near).collect();
    let (px, _) = space.project(before.iter().sum::<DVec3>() / before.len() as f64);
    let slope = DVec2::new(number(px + DVec2::X) - number(px), number(px + DVec2::Y) - number(px)).length();
    let wanted = LEAST * spacing_px * slope;
    // Beyond 2^20 a face is seen from its edge.
    if wanted > 1.0 { 1 << (wanted.log2().ceil().min(20.0) as i64) } else { 1 }
}

/// Where every so many planes cut a face, whose corners have these numbers; `None` for too many.
fn rows(numbers: [f64; 3], step: i64) -> Option<Vec<(i64, [[f64; 3]; 2])>> {
    let mut found: Vec<(i64, [f64; 3])> = Vec::new();
    for (side, next) in [(0, 1), (1, 2), (2, 0)] {
        let (from, to) = (numbers[side], numbers[next]);
        let [first, last] = [from, to].map(|number| (number / step as f64).ceil());
        if !(first - last).is_finite() || (first - last).abs() > HATCH_STROKES as f64 {
            return None;
        }
        for row in (first.min(last) as i64..first.max(last) as i64).map(|row| row * step) {
            let share = (row as f64 - from) / (to - from);
            let mut weights = [0.0; 3];
            (weights[side], weights[next]) = (1.0 - share, share);
            found.push((row, weights));
        }
    }
    found.sort_unstable_by_key(|(row, _)| *row);
    Some(found.chunks_exact(2).map(|pair| (pair[0].0, [pair[0].1, pair[1].1])).collect())
}

/// The stretches of one tone of a visible range of a cut, with their tones.
fn by_tone(view: &View, rule: &ToneRule, cut: &Cut, image: &Image, [from, to]: [f64; 2]) -> Vec<([f64; 2], u8)> {
    let LineInput { space, faces, .. } = &view.input;
    let lights = rule.lights(view, view.face(cut.place));
    let [start, end] = cut.weights.map(|weights| at(faces.corners(cut.place), weights));
    let tone = |place: f64| {
        let point = space.point(image.at(place), image.key(place));
        let share = (point - start).dot(end - start) / (end - start).length_squared();
        rule.tone(
            &lights,
            [0, 1, 2].map(|corner| cut.weights[0][corner] * (1.0 - share) + cut.weights[1][corner] * share),
        )
    };
    let mut stretches: Vec<([f64; 2], u8)> = vec![([from, from], tone(from))];
    for [_, part_end] in image.stretches([from, to], rule.longest_part_px()) {
        let tone_of_end = tone(part_end);
        while let Some((stretch, tone_here)) = stretches.last_mut() {
            let (mut same, mut other) = (stretch[1], part_end);
            if *tone_here == tone_of_end {
                stretch[1] = part_end;
                break;
            }
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(same, other);
                *(if tone(middle) == *tone_here { &mut same } else { &mut other }) = middle;
            }
            stretch[1] = same;
            let next = tone(other);
            stretches.push(([same, other], next));
        }
    }
    stretches
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
            let most_px = (UNEVEN * spacing_px).min(SHORTENED * length(&points));
            for (is_whole, salt) in [(ends, 1), (begins, 2)] {
                if !is_whole {
                    shorten(&mut points, most_px * share_of(plane, salt));
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

fn length(stroke: &[DVec2]) -> f64 {
    stroke.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
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
