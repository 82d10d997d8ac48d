//! Thick hair swept back in locks: a mass on the skull with tapering, waving
//! locks laid over it like shingles.
//!
//! In: the tables below and a seed. Out: the mass as a distance field and
//! the locks as closed strips of their own, in the frame of the face,
//! centimetres. The locks are not blended into the mass, because where one
//! edge lies over another the renderer finds a clean line to ink.

use crate::field::{ellipsoid, join, meet};
use crate::mesh::Mesh;
use crate::polygonise::gradient;
use crate::vector::{Random, Vec3, sin_cos, smoothstep, v};

/// Of the seeds tried, the one whose locks fall best from all sides.
const SEED: u64 = 4;

/// Rings a lock is made of; it ends in a point.
const RINGS: usize = 8;

/// A lock's section: across and outward, in half widths and half heights. The
/// straight side from the last corner to the first lies underneath.
const SECTION: [[f64; 2]; 4] = [[-1.0, -0.5], [-0.5, 0.72], [0.38, 0.9], [1.0, -0.5]];

/// What a lock grows from, and how.
struct Seed {
    root: Vec3,
    length: f64,
    /// Half its greatest width.
    width: f64,
    /// How far it stands off the mass where it arches, and at its tip.
    lift: f64,
    curl: f64,
}

/// One row of roots on the left side; the right side's are varied.
struct Row {
    roots: &'static [[f64; 3]],
    length: f64,
    width: f64,
    lift: f64,
    curl: f64,
}

/// From the nape up to the hairline over the forehead.
const ROWS: [Row; 7] = [
    // The ends that curl over the collar.
    Row { roots: &[[2.2, -1.6, -9.4], [6.4, -2.6, -6.8]], length: 8.5, width: 2.1, lift: 0.5, curl: 1.6 },
    // The back of the head.
    Row {
        roots: &[[1.8, 8.4, -8.9], [5.0, 5.4, -8.4], [2.2, 3.2, -10.8]],
        length: 12.0,
        width: 2.2,
        lift: 0.4,
        curl: 1.8,
    },
    // The crown.
    Row {
        roots: &[[1.6, 12.2, -2.0], [4.8, 10.6, -2.8], [7.4, 7.0, -3.8]],
        length: 12.5,
        width: 2.1,
        lift: 0.5,
        curl: 2.0,
    },
    // Over the ears.
    Row {
        roots: &[[8.6, 4.4, -0.4], [8.6, 1.2, -0.6], [8.4, -1.6, -0.8]],
        length: 10.5,
        width: 1.9,
        lift: 0.9,
        curl: 1.2,
    },
    // Behind the mane.
    Row {
        roots: &[[1.5, 11.2, 3.4], [4.8, 9.8, 3.0], [7.4, 6.6, 2.2]],
        length: 12.5,
        width: 2.0,
        lift: 0.9,
        curl: 2.0,
    },
    // Temples and whiskers.
    Row {
        roots: &[[6.9, 2.6, 4.4], [7.2, 0.2, 3.6], [7.2, -2.2, 2.8]],
        length: 10.0,
        width: 1.6,
        lift: 0.9,
        curl: 1.0,
    },
    // The mane over the forehead.
    Row {
        roots: &[[0.8, 7.0, 8.6], [2.8, 6.8, 8.0], [4.6, 5.9, 6.9], [6.1, 4.4, 5.6]],
        length: 12.5,
        width: 1.8,
        lift: 1.1,
        curl: 2.0,
    },
];

/// The mass before it is cut back to the hairline.
fn cap(p: Vec3) -> f64 {
    let crown = ellipsoid(p, v(0.0, 3.9, -1.6), v(9.9, 9.3, 10.2));
    let nape = ellipsoid(p, v(0.0, -2.8, -3.4), v(9.4, 6.6, 6.4));
    join(crown, nape, 3.0)
}

/// The mass the locks lie on.
pub fn mass(p: Vec3) -> f64 {
    let hairline = (p.z - 3.5 - 0.44 * p.y) / 1.09;
    meet(cap(p), hairline, 2.0)
}

/// The way the hair is combed at a place: up and away from the forehead to
/// both sides, back over the crown, back and down past the ears, down behind.
fn combed(p: Vec3) -> Vec3 {
    let side = (p.x / 5.0).clamp(-1.0, 1.0);
    let front = smoothstep(0.0, 6.0, p.z);
    let high = smoothstep(1.0, 8.0, p.y);
    let back = smoothstep(1.0, -7.5, p.z);
    let top = v(0.8 * side, 0.7 * front, -1.0);
    let temple = v(0.3 * side, -0.55, -0.85 * (0.5 + 0.5 * front));
    let behind = v(0.1 * side, -1.0, -0.1);
    temple.lerp(top, high).lerp(behind, back * (1.0 - 0.45 * high))
}

/// All the locks.
pub fn locks() -> Mesh {
    let mut random = Random::new(SEED);
    let mut mesh = Mesh::default();
    for row in ROWS {
        for root in row.roots {
            for side in [-1.0, 1.0] {
                let jitter = v(random.range(-0.5, 0.5), random.range(-0.5, 0.5), random.range(-0.6, 0.6));
                let seed = Seed {
                    root: v(side * root[0], root[1], root[2]) + jitter,
                    length: row.length * random.range(0.85, 1.2),
                    width: row.width * random.range(0.85, 1.15),
                    lift: row.lift * random.range(0.6, 1.1),
                    curl: row.curl * random.range(0.5, 1.4),
                };
                mesh.append(&lock(&seed, &mut random));
            }
        }
    }
    mesh
}

/// A point of a lock's middle line, the direction out of the head there and
/// half the lock's width.
struct Station {
    place: Vec3,
    out: Vec3,
    width: f64,
}

/// Walks over the mass, waving from side to side and lifting off it.
fn stations(seed: &Seed, random: &mut Random) -> Vec<Station> {
    let stride = seed.length / RINGS as f64;
    let phase = random.range(0.0, 1.0);
    let swing = random.range(0.4, 0.85);
    let drift = random.range(-0.2, 0.2);
    let mut ground = seed.root;
    let mut stations = Vec::new();
    for step in 0..=RINGS {
        let t = step as f64 / RINGS as f64;
        let out = gradient(&cap, ground, 0.05).normalized();
        ground = ground - out * cap(ground);
        let way = combed(ground).without(out).normalized();
        let (wave, _) = sin_cos(2.0 * std::f64::consts::PI * (1.1 * t + phase));
        let heading = (way + way.cross(out) * (swing * wave + drift)).normalized();
        // Rises out of the mass, lies down, and its tip stands off again.
        let rise = -1.1 + (1.1 + seed.lift) * smoothstep(-0.1, 0.3, t) - 0.6 * seed.lift * smoothstep(0.3, 0.75, t)
            + seed.curl * smoothstep(0.72, 1.0, t);
        // A flame: fullest at a third of its length, running out to a point.
        let swell = 0.3 + 0.7 * smoothstep(-0.05, 0.38, t);
        let taper = 1.0 - 0.9 * smoothstep(0.4, 1.1, t);
        stations.push(Station { place: ground + out * rise, out, width: swell * taper * seed.width });
        ground += heading * stride;
    }
    stations
}

/// One lock as a closed strip: a pole, rings of four corners, a pole.
fn lock(seed: &Seed, random: &mut Random) -> Mesh {
    let stations = stations(seed, random);
    // One edge dips under the neighbour, the other stands over it.
    let tilt = random.range(-0.45, 0.45);
    let flip = if random.range(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
    let mut mesh = Mesh::default();
    let sides = SECTION.len();
    for (index, station) in stations.iter().enumerate().take(RINGS) {
        let before = &stations[index.saturating_sub(1)];
        let after = &stations[index + 1];
        let along = (after.place - before.place).normalized();
        let up = station.out.without(along).normalized();
        let side = along.cross(up);
        let across = (side + up * tilt).normalized();
        let out = (up - side * tilt).normalized();
        let height = 0.5 * station.width;
        for corner in 0..sides {
            // A flipped section is walked backward, to stay counter-clockwise.
            let turn = if flip < 0.0 { sides - 1 - corner } else { corner };
            let [x, y] = SECTION[turn];
            mesh.add(station.place + across * (flip * x * station.width) + out * (y * height));
        }
    }
    let root = mesh.positions[..sides].iter().fold(Vec3::ZERO, |sum, &p| sum + p) / sides as f64;
    let root = mesh.add(root);
    let tip = mesh.add(stations[RINGS].place);
    for side in 0..sides {
        let next = (side + 1) % sides;
        mesh.triangles.push([root, next, side]);
        for ring in 0..RINGS - 1 {
            let (low, high) = (ring * sides, (ring + 1) * sides);
            mesh.quad([low + side, low + next, high + next, high + side]);
        }
        let low = (RINGS - 1) * sides;
        mesh.triangles.push([low + side, low + next, tip]);
    }
    mesh
}
