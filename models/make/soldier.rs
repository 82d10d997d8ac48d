//! The toy soldier: a Quake 2 model with a skin, for what draws with a
//! character's own texture.
//!
//! Out: `soldier.md2`, turned parts with texture coordinates in five frames (he
//! stands, then salutes), and `soldier.pcx`, its skin (`soldier_skin.rs`).
//! Parts are closed and reach into each other. All measures are in heads or so:
//! he stands 2.6 high on y = 0, faces +z, and his right is -x.

use crate::md2::{Frame, Model};
use crate::soldier_skin::{self, Rect};
use crate::sweep::Ring;
use crate::vector::{Vec3, sin_cos, v};
use std::f64::consts::PI;
use std::path::Path;

/// How far the right arm is raised in each frame, of 1.
const SALUTE: [f64; 5] = [0.0, 0.0, 0.35, 0.75, 1.0];
const NAMES: [&str; 5] = ["stand", "salute1", "salute2", "salute3", "salute4"];

/// A part with its place on the skin.
struct Part {
    rings: Vec<Ring>,
    sides: usize,
    skin: Rect,
}

pub fn write(folder: &Path) -> Result<(), String> {
    let save = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))
    };
    let model = model();
    save("soldier.md2", &model.bytes())?;
    println!("soldier.md2: {} triangles", model.triangles.len());
    save("soldier.pcx", &soldier_skin::file()?)
}

fn model() -> Model {
    let mut texels: Vec<[i16; 2]> = Vec::new();
    let mut triangles = Vec::new();
    let mut first = 0;
    for part in parts(0.0) {
        cover(&part, first, &mut texels, &mut triangles);
        first += 2 + (part.rings.len() - 2) * part.sides;
    }
    let frames = SALUTE.into_iter().zip(NAMES).map(|(salute, name)| frame(name, salute)).collect();
    let size = soldier_skin::SIZE as u32;
    Model { skin: Some("soldier.pcx"), skin_size: [size, size], texels, triangles, frames }
}

/// Triangles and texels of a part whose vertices begin at `first`: its turns lie side by side on the skin, its first ring at the
/// bottom.
fn cover(part: &Part, first: usize, texels: &mut Vec<[i16; 2]>, triangles: &mut Vec<[u16; 6]>) {
    let (rings, sides) = (part.rings.len(), part.sides);
    // How far along the part each ring is, so that the skin is not squeezed.
    let steps: Vec<f64> = part.rings.windows(2).map(|pair| step(&pair[0], &pair[1])).collect();
    let length: f64 = steps.iter().sum();
    let first_texel = texels.len();
    let mut along = 0.0;
    for ring in 0..rings {
        for turn in 0..=sides {
            texels.push(part.skin.at(turn as f64 / sides as f64, along / length));
        }
        along += steps.get(ring).unwrap_or(&0.0);
    }
    let vertex = |ring: usize, turn: usize| match ring {
        0 => first,
        _ if ring == rings - 1 => first + 1 + (rings - 2) * sides,
        _ => first + 1 + (ring - 1) * sides + turn % sides,
    };
    let corner = |ring: usize, turn: usize| [vertex(ring, turn), first_texel + ring * (sides + 1) + turn];
    // Clockwise seen from outside, as the format has them.
    let mut triangle = |corners: [[usize; 2]; 3]| {
        let [[a, s], [b, t], [c, u]] = corners;
        triangles.push([a, c, b, s, u, t].map(|index| index as u16));
    };
    for turn in 0..sides {
        triangle([corner(0, turn), corner(1, turn + 1), corner(1, turn)]);
        for ring in 1..rings - 2 {
            let [a, b] = [corner(ring, turn), corner(ring, turn + 1)];
            let [d, c] = [corner(ring + 1, turn), corner(ring + 1, turn + 1)];
            triangle([a, b, c]);
            triangle([a, c, d]);
        }
        let last = rings - 2;
        triangle([corner(last, turn), corner(last, turn + 1), corner(last + 1, turn)]);
    }
}

/// From one ring to the next along the surface.
fn step(from: &Ring, to: &Ring) -> f64 {
    let (rise, out) = ((to.centre - from.centre).length(), to.height - from.height);
    (rise * rise + out * out).sqrt()
}

fn frame(name: &str, salute: f64) -> Frame {
    // y up to z up: forward, left, up.
    let points: Vec<Vec3> =
        parts(salute).iter().flat_map(points_of).map(|point| v(point.z, point.x, point.y)).collect();
    let low = points.iter().fold(points[0], |low, p| v(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z)));
    let high = points.iter().fold(points[0], |high, p| high.max(*p));
    let steps = (high - low) / 255.0;
    let byte = |value: f64, low: f64, step: f64| ((value - low) / step + 0.5) as u8;
    let vertices = points
        .iter()
        .map(|p| [byte(p.x, low.x, steps.x), byte(p.y, low.y, steps.y), byte(p.z, low.z, steps.z)])
        .collect();
    let floats = |v: Vec3| [v.x as f32, v.y as f32, v.z as f32];
    Frame { name: name.to_owned(), scale: floats(steps), translation: floats(low), vertices }
}

/// The points of a part: its lower pole, its rings, its upper pole. A ring begins at his right where it lies flat, whatever way
/// the rings before it went, so that frames of a raised arm do not twist it.
fn points_of(part: &Part) -> Vec<Vec3> {
    let rings = &part.rings;
    let mut points = vec![rings[0].centre];
    for index in 1..rings.len() - 1 {
        let along = (rings[index + 1].centre - rings[index - 1].centre).normalized();
        let across = v(0.0, 0.0, 1.0).cross(along).normalized();
        let up = along.cross(across);
        let Ring { centre, width, height } = rings[index];
        for side in 0..part.sides {
            let (sine, cosine) = sin_cos(2.0 * PI * side as f64 / part.sides as f64);
            points.push(centre + across * (cosine * width) + up * (sine * height));
        }
    }
    points.push(rings[rings.len() - 1].centre);
    points
}

/// A ring at a height, its middle so far in front, half as wide and deep as said.
fn ring(y: f64, front: f64, width: f64, depth: f64) -> Ring {
    // Whole from bottom to top, a ring's width is along x and its height along z.
    Ring { centre: v(0.0, y, front), width, height: depth }
}

/// Rings between two poles, which close them flat.
fn closed(rings: &[Ring]) -> Vec<Ring> {
    let pole = |ring: &Ring| Ring { width: 0.0, height: 0.0, ..*ring };
    let mut all = vec![pole(&rings[0])];
    all.extend_from_slice(rings);
    all.push(pole(&rings[rings.len() - 1]));
    all
}

fn moved(rings: Vec<Ring>, by: Vec3) -> Vec<Ring> {
    rings.into_iter().map(|ring| Ring { centre: ring.centre + by, ..ring }).collect()
}

fn parts(salute: f64) -> Vec<Part> {
    let part = |rings: Vec<Ring>, sides, skin| Part { rings, sides, skin };
    let stand = closed(&[ring(0.0, 0.0, 0.56, 0.5), ring(0.1, 0.0, 0.52, 0.46)]);
    let torso = [
        ring(0.8, 0.0, 0.32, 0.26),
        ring(0.99, 0.01, 0.24, 0.185),
        ring(1.42, 0.02, 0.33, 0.235),
        ring(1.58, 0.0, 0.29, 0.2),
        ring(1.65, 0.0, 0.12, 0.11),
    ];
    let head = [
        ring(1.6, 0.0, 0.1, 0.1),
        ring(1.68, 0.03, 0.185, 0.19),
        ring(1.82, 0.02, 0.225, 0.225),
        ring(2.02, 0.0, 0.215, 0.215),
    ];
    let hat = [
        ring(1.955, 0.1, 0.235, 0.3),
        ring(2.005, 0.02, 0.225, 0.23),
        ring(2.4, -0.01, 0.29, 0.28),
        ring(2.5, -0.01, 0.24, 0.23),
    ];
    let leg = closed(&[
        ring(0.09, 0.06, 0.12, 0.21),
        ring(0.21, 0.025, 0.11, 0.15),
        ring(0.56, 0.0, 0.13, 0.125),
        ring(0.98, 0.0, 0.12, 0.13),
    ]);
    let nose = along(&[(v(0.0, 1.8, 0.2), 0.03), (v(0.0, 1.845, 0.33), 0.055), (v(0.0, 1.93, 0.2), 0.03)]);
    let moustache = along(&[
        (v(-0.19, 1.77, 0.17), 0.004),
        (v(-0.09, 1.745, 0.24), 0.04),
        (v(0.0, 1.765, 0.26), 0.035),
        (v(0.09, 1.745, 0.24), 0.04),
        (v(0.19, 1.77, 0.17), 0.004),
    ]);
    let plume = along(&[
        (v(0.0, 2.42, 0.26), 0.02),
        (v(0.0, 2.52, 0.27), 0.07),
        (v(0.0, 2.66, 0.25), 0.055),
        (v(0.0, 2.74, 0.22), 0.01),
    ]);
    let shoulder = |side: f64| {
        moved(closed(&[ring(1.48, 0.0, 0.175, 0.18), ring(1.61, 0.0, 0.11, 0.12)]), v(side * 0.34, 0.0, 0.0))
    };
    vec![
        part(stand, 10, soldier_skin::STAND),
        part(moved(leg.clone(), v(-0.15, 0.0, 0.0)), 7, soldier_skin::LEG),
        part(moved(leg, v(0.15, 0.0, 0.0)), 7, soldier_skin::LEG),
        part(closed(&torso), 10, soldier_skin::TORSO),
        part(closed(&head), 10, soldier_skin::HEAD),
        part(closed(&hat), 10, soldier_skin::HAT),
        part(nose, 4, soldier_skin::NOSE),
        part(moustache, 4, soldier_skin::HAIR),
        part(plume, 4, soldier_skin::PLUME),
        part(shoulder(-1.0), 5, soldier_skin::SHOULDER),
        part(shoulder(1.0), 5, soldier_skin::SHOULDER),
        part(arm(-1.0, salute), 6, soldier_skin::ARM),
        part(arm(1.0, 0.0), 6, soldier_skin::ARM),
    ]
}

/// Rings of one half width along a line of points, poles at both ends.
fn along(points: &[(Vec3, f64)]) -> Vec<Ring> {
    let mut rings: Vec<Ring> =
        points.iter().map(|(centre, radius)| Ring { centre: *centre, width: *radius, height: *radius }).collect();
    for end in [0, points.len() - 1] {
        (rings[end].width, rings[end].height) = (0.0, 0.0);
    }
    rings
}

/// An arm from the hand up to the shoulder; raised to the hat where he salutes.
fn arm(side: f64, salute: f64) -> Vec<Ring> {
    let shoulder = v(side * 0.36, 1.5, 0.0);
    // Both bones turn: the upper arm outwards, the lower one up and in.
    let (out, fold) = (0.22 + salute * 1.55, 0.1 + salute * 2.2);
    let upper = turned(side, out, 0.16);
    let lower = turned(side, out + fold * salute.max(0.15), 0.3);
    let (elbow, hand) = (shoulder + upper * 0.36, shoulder + upper * 0.36 + lower * 0.33);
    let tip = hand + lower * 0.15;
    let ring = |centre: Vec3, radius: f64| Ring { centre, width: radius, height: radius };
    vec![
        ring(tip, 0.0),
        ring(hand + lower * 0.07, 0.08),
        ring(hand - lower * 0.01, 0.095),
        ring(elbow, 0.1),
        ring(shoulder - upper * 0.02, 0.115),
        ring(shoulder - upper * 0.05, 0.0),
    ]
}

/// A direction that hangs down, turned outwards by an angle and a little forward.
fn turned(side: f64, angle: f64, forward: f64) -> Vec3 {
    let (sine, cosine) = sin_cos(angle);
    v(side * sine, -cosine, forward).normalized()
}
