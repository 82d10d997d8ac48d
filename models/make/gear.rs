//! A spur gear with a recessed web, lightening holes, a hub and a keyed bore.
//!
//! Out: one closed faceted mesh, axis along z, every ring cut into quads
//! between circles of matching points so that no needles appear.

use crate::mesh::Mesh;
use crate::obj::{Material, Model, Part, Shading};
use crate::vector::{sin_cos, v};

const TEETH: usize = 20;
/// Points on the circles between tooth rim and bore: two to a tooth.
const RING: usize = 2 * TEETH;
const HOLES: usize = 5;
const RING_PER_HOLE: usize = RING / HOLES;
/// A hole's outline: outer arc, inner arc and twice the middle of a spoke.
const HOLE_POINTS: usize = 2 * RING_PER_HOLE + 4;

const RIM_RADIUS: f64 = 1.32;
const HUB_RADIUS: f64 = 0.52;
const BORE_RADIUS: f64 = 0.27;
const KEYWAY_TOP: f64 = 0.36;
const HOLE_RADIUS: f64 = 0.265;

const RIM_HALF_WIDTH: f64 = 0.26;
const WEB_HALF_WIDTH: f64 = 0.09;
const HUB_HALF_WIDTH: f64 = 0.34;

/// The rim's points lie a quarter pitch either side of a tooth's middle, in
/// pitches.
const TOOTH_SHIFT: f64 = 0.25;

/// Half a tooth at its foot, on the pitch circle, above it and at the tip:
/// angle in pitches, radius.
const FLANK: [(f64, f64); 4] = [(0.33, 1.56), (0.265, 1.70), (0.19, 1.83), (0.105, 1.93)];

pub fn model() -> Model {
    let steel = Material { name: "steel", colour: [0.62, 0.70, 0.76] };
    Model {
        name: "gear",
        title: "A spur gear: 20 teeth, 5 lightening holes, hub and keyway; faceted, closed.",
        parts: vec![Part {
            name: "gear".to_owned(),
            material: Some(steel),
            shading: Shading::Unstated,
            closed: true,
            mesh: mesh(),
        }],
    }
}

/// A point in the plane of the gear; angle in turns from +y toward -x.
fn polar(turns: f64, radius: f64) -> [f64; 2] {
    let (sine, cosine) = sin_cos(2.0 * std::f64::consts::PI * turns);
    [-sine * radius, cosine * radius]
}

/// The same outline at +z and -z: position numbers, counter-clockwise as seen
/// from +z.
struct Outline {
    front: Vec<usize>,
    back: Vec<usize>,
}

fn outline(mesh: &mut Mesh, points: &[[f64; 2]], half_width: f64) -> Outline {
    let mut at = |z: f64| points.iter().map(|&[x, y]| mesh.add(v(x, y, z))).collect();
    Outline { front: at(half_width), back: at(-half_width) }
}

fn circle(radius: f64, count: usize) -> Vec<[f64; 2]> {
    (0..count).map(|i| polar(i as f64 / count as f64, radius)).collect()
}

fn mesh() -> Mesh {
    let mut mesh = Mesh::default();
    let tooth_points: Vec<[f64; 2]> = (0..TEETH)
        .flat_map(|tooth| {
            let rising = FLANK.iter().map(|&(angle, radius)| (-angle, radius));
            let falling = FLANK.iter().rev().copied();
            rising
                .chain(falling)
                .map(move |(angle, radius)| polar((tooth as f64 + TOOTH_SHIFT + angle) / TEETH as f64, radius))
        })
        .collect();
    let teeth = outline(&mut mesh, &tooth_points, RIM_HALF_WIDTH);
    let rim_points = circle(RIM_RADIUS, RING);
    let rim = outline(&mut mesh, &rim_points, RIM_HALF_WIDTH);
    let rim_foot = outline(&mut mesh, &rim_points, WEB_HALF_WIDTH);
    let hub_points = circle(HUB_RADIUS, RING);
    let hub_foot = outline(&mut mesh, &hub_points, WEB_HALF_WIDTH);
    let hub = outline(&mut mesh, &hub_points, HUB_HALF_WIDTH);
    let bore = outline(&mut mesh, &bore_points(), HUB_HALF_WIDTH);

    outer_wall(&mut mesh, &teeth.front, &teeth.back);
    for (teeth, rim, front) in [(&teeth.front, &rim.front, true), (&teeth.back, &rim.back, false)] {
        tooth_faces(&mut mesh, teeth, rim, front);
    }
    inner_wall(&mut mesh, &rim.front, &rim_foot.front);
    inner_wall(&mut mesh, &rim_foot.back, &rim.back);
    web(&mut mesh, &rim_foot, &hub_foot);
    outer_wall(&mut mesh, &hub.front, &hub_foot.front);
    outer_wall(&mut mesh, &hub_foot.back, &hub.back);
    ring_face(&mut mesh, &hub.front, &bore.front, true);
    ring_face(&mut mesh, &hub.back, &bore.back, false);
    inner_wall(&mut mesh, &bore.front, &bore.back);
    mesh
}

/// The bore's circle with three points moved out to cut the keyway.
fn bore_points() -> Vec<[f64; 2]> {
    let mut points = circle(BORE_RADIUS, RING);
    let side = points[2][0].abs();
    for (index, x) in [(1, -side), (0, 0.0), (RING - 1, side)] {
        points[index] = [x, KEYWAY_TOP];
    }
    points
}

/// Two triangles over the diagonal that leaves the larger smaller triangle.
fn best_quad(mesh: &mut Mesh, [a, b, c, d]: [usize; 4]) {
    let smaller = |p: [usize; 3], q: [usize; 3]| {
        let size = |t| mesh.area_vector(t).length();
        size(p).min(size(q))
    };
    if smaller([a, b, c], [a, c, d]) + 1e-12 >= smaller([a, b, d], [b, c, d]) {
        mesh.quad([a, b, c, d]);
    } else {
        mesh.quad([b, c, d, a]);
    }
}

fn outer_wall(mesh: &mut Mesh, front: &[usize], back: &[usize]) {
    for i in 0..front.len() {
        let j = (i + 1) % front.len();
        best_quad(mesh, [front[i], back[i], back[j], front[j]]);
    }
}

fn inner_wall(mesh: &mut Mesh, front: &[usize], back: &[usize]) {
    for i in 0..front.len() {
        let j = (i + 1) % front.len();
        best_quad(mesh, [front[j], back[j], back[i], front[i]]);
    }
}

fn face_quad(mesh: &mut Mesh, [a, b, c, d]: [usize; 4], front: bool) {
    best_quad(mesh, if front { [a, b, c, d] } else { [d, c, b, a] });
}

fn ring_face(mesh: &mut Mesh, outer: &[usize], inner: &[usize], front: bool) {
    for i in 0..outer.len() {
        let j = (i + 1) % outer.len();
        face_quad(mesh, [outer[i], outer[j], inner[j], inner[i]], front);
    }
}

/// The flat side of the toothed rim: tooth by tooth, a quad per step of the
/// flank, then the land under the tooth and the land under the gap.
fn tooth_faces(mesh: &mut Mesh, teeth: &[usize], rim: &[usize], front: bool) {
    let per_tooth = 2 * FLANK.len();
    for tooth in 0..TEETH {
        let points = &teeth[tooth * per_tooth..(tooth + 1) * per_tooth];
        for step in 0..FLANK.len() - 1 {
            let far = per_tooth - 1 - step;
            let quad = [points[step], points[step + 1], points[far - 1], points[far]];
            // Seen from +z the flanks run counter-clockwise, low angle first.
            face_quad(mesh, [quad[1], quad[2], quad[3], quad[0]], front);
        }
        let last = points[per_tooth - 1];
        let next_tooth = teeth[(tooth + 1) * per_tooth % teeth.len()];
        let low = rim[2 * tooth];
        let high = rim[2 * tooth + 1];
        let next = rim[(2 * tooth + 2) % RING];
        face_quad(mesh, [points[0], last, high, low], front);
        face_quad(mesh, [last, next_tooth, next, high], front);
    }
}

/// The thin disc between rim and hub, a quad ring round each hole.
fn web(mesh: &mut Mesh, rim: &Outline, hub: &Outline) {
    let middle = 0.5 * (RIM_RADIUS + HUB_RADIUS);
    // The middles of the spokes, which two neighbouring sectors share.
    let spoke_points: Vec<[f64; 2]> =
        (0..HOLES).map(|hole| polar((hole as f64 - 0.5) / HOLES as f64, middle)).collect();
    let spokes = outline(mesh, &spoke_points, WEB_HALF_WIDTH);
    for hole in 0..HOLES {
        let first = hole * RING_PER_HOLE + RING - RING_PER_HOLE / 2;
        let next_spoke = (hole + 1) % HOLES;
        // From the spoke after the hole, in along the hub, out along the rim.
        let border = |rim: &[usize], hub: &[usize], spokes: &[usize]| -> Vec<usize> {
            let along = |ring: &[usize], i: usize| ring[(first + i) % RING];
            (0..=RING_PER_HOLE)
                .map(|i| along(rim, i))
                .chain([spokes[next_spoke]])
                .chain((0..=RING_PER_HOLE).rev().map(|i| along(hub, i)))
                .chain([spokes[hole]])
                .collect()
        };
        let centre = polar(hole as f64 / HOLES as f64, middle);
        let front = border(&rim.front, &hub.front, &spokes.front);
        let back = border(&rim.back, &hub.back, &spokes.back);
        let edge_points: Vec<[f64; 2]> = hole_angles()
            .into_iter()
            .map(|turns| {
                let here = hole as f64 / HOLES as f64;
                let [x, y] = polar(here + turns, HOLE_RADIUS);
                [centre[0] + x, centre[1] + y]
            })
            .collect();
        let edge = outline(mesh, &edge_points, WEB_HALF_WIDTH);
        ring_face(mesh, &front, &edge.front, true);
        ring_face(mesh, &back, &edge.back, false);
        inner_wall(mesh, &edge.front, &edge.back);
    }
}

/// Evenly spread directions round a hole, in turns from the gear's radius,
/// the first toward the corner of rim and spoke the border starts at.
fn hole_angles() -> Vec<f64> {
    let half = RING_PER_HOLE as f64 / 2.0;
    (0..HOLE_POINTS).map(|i| (i as f64 - half) / HOLE_POINTS as f64).collect()
}
