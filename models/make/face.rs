//! The flesh of the bust: skull, face and neck, eyes, lips and brows.
//!
//! Centimetres, y = 0 on the line of the eyes, z = 0 at the ears, the face
//! toward +z. The proportions follow the classical canon: eyes at half the
//! height of the head, three equal thirds from hairline to brow, to the base
//! of the nose, to the chin. The features are those of a heavy, stern face.

use crate::field::{carve, chain, cone, ellipsoid, front_of, join, polygon, sphere, stroke, stroke_along};
use crate::mesh::Mesh;
use crate::sweep::{Ring, sweep};
use crate::vector::{Vec3, sin_cos, smoothstep, v};

/// The left eye's centre; everything paired is sculpted at x > 0 and mirrored.
pub const EYE: Vec3 = v(3.3, 0.0, 6.75);
const EYE_RADIUS: f64 = 1.3;
const IRIS_RADIUS: f64 = 0.62;

/// Half the width of the opening between the lids, its rise above and below
/// the middle of the eye, and how much its outer corner sinks.
const EYE_HALF: f64 = 1.48;
const UPPER_LID: f64 = 0.56;
const LOWER_LID: f64 = 0.48;
const EYE_SLANT: f64 = 0.06;
const LID_THICKNESS: f64 = 0.22;

/// The line where the lips meet, the fullest line of either lip and the outer
/// edge of both: x, y and, for the lips, how far they stand out.
const MOUTH_LINE: [[f64; 2]; 4] = [[0.0, -7.0], [0.6, -6.93], [1.7, -7.0], [2.75, -7.16]];
const UPPER_LIP: [[f64; 3]; 4] = [[0.0, -6.62, 0.10], [0.65, -6.56, 0.14], [1.7, -6.78, 0.08], [2.6, -7.06, -0.04]];
const LOWER_LIP: [[f64; 3]; 4] = [[0.0, -7.42, 0.14], [0.8, -7.42, 0.16], [1.7, -7.32, 0.08], [2.5, -7.22, -0.04]];
const LIP_EDGE: [[f64; 2]; 12] = [
    [-1.0, -6.5],
    [0.0, -6.5],
    [0.5, -6.3],
    [0.95, -6.38],
    [1.8, -6.7],
    [2.75, -7.1],
    [2.75, -7.22],
    [2.2, -7.42],
    [1.5, -7.64],
    [0.8, -7.8],
    [0.0, -7.82],
    [-1.0, -7.82],
];

pub fn halved(p: Vec3) -> Vec3 {
    v(p.x.abs(), p.y, p.z)
}

/// The features that must first find the surface they lie on.
pub struct Face {
    upper: Vec<(Vec3, f64)>,
    lower: Vec<(Vec3, f64)>,
    line: Vec<Vec3>,
    brows: Vec<(Vec3, f64)>,
}

impl Face {
    pub fn new() -> Face {
        let lip = |points: &[[f64; 3]], radius: f64| -> Vec<(Vec3, f64)> {
            points.iter().map(|&[x, y, out]| (front_of(&bare, x, y) + v(0.0, 0.0, out - radius), radius)).collect()
        };
        let mut face =
            Face { upper: lip(&UPPER_LIP, 0.34), lower: lip(&LOWER_LIP, 0.38), line: Vec::new(), brows: Vec::new() };
        face.line = MOUTH_LINE.iter().map(|&[x, y]| front_of(&|p| face.skin(p), x, y) + v(0.0, 0.0, 0.06)).collect();
        // x, y and thickness, from the root of the nose to the temple.
        let brows = [(0.95, 1.5, 0.36), (1.8, 1.72, 0.56), (3.1, 2.08, 0.54), (4.4, 2.2, 0.42), (5.6, 1.6, 0.20)];
        face.brows =
            brows.iter().map(|&(x, y, radius)| (front_of(&bare, x, y) - v(0.0, 0.0, 0.5 * radius), radius)).collect();
        face
    }

    /// Skull, face and neck.
    pub fn skin(&self, point: Vec3) -> f64 {
        let p = halved(point);
        let mut d = bare(p);
        if p.z > 5.0 && p.y < -4.0 {
            d = join(d, chain(p, &self.upper), 0.3);
            d = join(d, chain(p, &self.lower), 0.3);
        }
        d
    }

    /// The red of the lips, a film on the skin that sinks into it at its edge,
    /// for a step there would be inked.
    pub fn lips(&self, point: Vec3) -> f64 {
        let p = halved(point);
        let skin = self.skin(p);
        let edge = polygon(p.x, p.y, &LIP_EDGE);
        let film = (skin - 0.09 + 0.2 * smoothstep(-0.2, 0.15, edge)).max(6.5 - p.z);
        film.max(-(skin + 0.5)).max(edge - 0.15)
    }

    /// The dark line where the lips meet, as a thin cord laid between them.
    pub fn mouth_line(&self) -> Mesh {
        let left = self.line.iter().copied().zip([0.10, 0.10, 0.09, 0.03]);
        let right = left.clone().skip(1).map(|(p, thickness)| (v(-p.x, p.y, p.z), thickness));
        let points: Vec<(Vec3, f64)> = right.rev().chain(left).collect();
        cord(&points)
    }

    /// Bushy eyebrows that run down toward the nose.
    pub fn brows(&self, point: Vec3) -> f64 {
        let p = halved(point);
        chain(p, &self.brows)
    }
}

/// The head but for the lips.
fn bare(point: Vec3) -> f64 {
    let p = halved(point);
    let mut d = masses(p);
    d = sockets(p, d);
    d = join(d, nose(p), 0.55);
    d = carve(d, ellipsoid(p, v(0.66, -4.75, 10.1), v(0.4, 0.5, 0.6)), 0.3);
    d = mouth_bed(p, d);
    d + furrows(p)
}

fn masses(p: Vec3) -> f64 {
    let mut d = ellipsoid(p, v(0.0, 3.4, -0.8), v(7.6, 7.8, 9.6));
    d = join(d, ellipsoid(p, v(0.0, 3.6, 3.2), v(6.7, 4.6, 5.9)), 1.5);
    d = join(d, ellipsoid(p, v(0.0, -2.0, 2.2), v(6.9, 7.0, 6.4)), 1.5);
    // Muzzle, chin and the line of the jaw.
    d = join(d, ellipsoid(p, v(0.0, -6.2, 4.6), v(4.6, 4.4, 4.9)), 1.6);
    d = join(d, cone(p, v(5.5, -6.8, 0.8), v(1.9, -10.0, 7.0), 1.4, 1.35), 2.2);
    d = join(d, ellipsoid(p, v(0.0, -10.0, 7.9), v(2.3, 1.45, 1.75)), 1.1);
    // Cheekbones and the flesh below them.
    d = join(d, ellipsoid(p, v(5.0, -2.4, 5.3), v(1.9, 1.4, 2.0)), 1.6);
    d = join(d, ellipsoid(p, v(4.0, -5.6, 4.7), v(2.4, 3.0, 2.6)), 1.8);
    // The heavy brow, lowest at the root of the nose.
    d = join(d, cone(p, v(0.9, 1.45, 8.45), v(5.0, 1.95, 6.4), 1.0, 0.85), 0.8);
    join(d, cone(p, v(0.0, -19.0, -2.6), v(0.0, -5.0, -1.4), 5.6, 5.2), 1.5)
}

/// Hollows for the eyes, then the lids as a shell round the eyeball, open
/// where two arcs cross.
fn sockets(p: Vec3, d: f64) -> f64 {
    let mut d = carve(d, ellipsoid(p, v(3.3, -0.1, 9.0), v(2.25, 1.25, 1.95)), 0.9);
    let q = p - EYE;
    let lids = sphere(p, EYE, EYE_RADIUS + LID_THICKNESS);
    d = join(d, lids, 0.3);
    // Tilted: the outer corner lies a little lower, which makes the eye grave.
    let (x, y) = (q.x, q.y + EYE_SLANT * q.x);
    let arc = |lid: f64, up: f64| {
        let (centre, radius) = lid_arc(lid);
        (x * x + (y - up * centre) * (y - up * centre)).sqrt() - radius
    };
    let opening = arc(UPPER_LID, 1.0).max(arc(LOWER_LID, -1.0)).max(-q.z);
    carve(d, opening, 0.08)
}

/// Centre above the eye and radius of the arc that rises by `rise`.
fn lid_arc(rise: f64) -> (f64, f64) {
    let radius = (EYE_HALF * EYE_HALF + rise * rise) / (2.0 * rise);
    (rise - radius, radius)
}

fn nose(p: Vec3) -> f64 {
    let bridge = cone(p, v(0.0, 0.9, 8.35), v(0.0, -3.0, 10.25), 0.85, 1.02);
    let sides = cone(p, v(0.3, -0.6, 8.2), v(0.9, -3.5, 9.2), 0.8, 1.15);
    let tip = sphere(p, v(0.0, -3.55, 10.6), 1.1);
    let wing = ellipsoid(p, v(1.42, -3.9, 9.6), v(0.74, 0.74, 0.98));
    let column = cone(p, v(0.0, -4.2, 10.6), v(0.0, -4.7, 9.4), 0.42, 0.5);
    let body = join(join(bridge, sides, 0.6), tip, 0.5);
    join(join(body, wing, 0.28), column, 0.3)
}

/// The bulge of the lips' muscle, the groove under the nose, the dip above
/// the chin, the drawn corners.
fn mouth_bed(p: Vec3, d: f64) -> f64 {
    let mut d = d;
    d -= 0.3 * stroke(p, v(0.0, -6.4, 9.4), v(3.2, 2.0, 2.0));
    d += 0.3 * stroke(p, v(0.0, -5.4, 9.9), v(0.6, 1.0, 1.4));
    d += 0.6 * stroke(p, v(0.0, -8.8, 9.4), v(2.8, 0.95, 2.0));
    d += 0.3 * stroke(p, v(3.1, -7.4, 8.3), v(1.1, 1.0, 1.3));
    d + 0.2 * stroke(p, v(0.0, -10.3, 9.8), v(0.5, 1.0, 1.2))
}

/// Lines of age and will: from the nose to the mouth, between the brows, on
/// the forehead, under the eyes.
fn furrows(p: Vec3) -> f64 {
    let mut dent = 0.22 * stroke_along(p, v(2.2, -3.6, 8.9), v(3.8, -6.8, 7.7), 1.3);
    dent += 0.35 * stroke_along(p, v(0.6, 1.0, 9.5), v(0.75, 2.7, 9.7), 0.5);
    dent += 0.2 * stroke_along(p, v(-2.6, 4.5, 9.3), v(2.6, 4.5, 9.3), 0.7);
    dent += 0.22 * stroke_along(p, v(2.2, -1.6, 8.0), v(4.2, -1.8, 7.2), 0.6);
    dent - 0.3 * stroke(p, v(2.2, 4.4, 8.2), v(2.6, 1.9, 2.2))
}

/// Both eyeballs, as far as the lids let them be seen.
pub fn eyeballs() -> Mesh {
    mirrored_pair(&cap(EYE_RADIUS, 0.30, &[0.07, 0.15, 0.23]))
}

/// Both irises: caps that stand proud of the eyeballs by a hair's breadth.
pub fn irises() -> Mesh {
    let edge = IRIS_RADIUS / EYE_RADIUS / (2.0 * std::f64::consts::PI);
    mirrored_pair(&cap(EYE_RADIUS + 0.05, edge * 1.02, &[0.55 * edge]))
}

/// A cap of the sphere round the eye's centre, facing +z, closed behind; the
/// rings' angles from the axis in turns.
fn cap(radius: f64, rim: f64, rings: &[f64]) -> Mesh {
    let ring = |turns: f64, radius: f64| {
        let (sine, cosine) = sin_cos(2.0 * std::f64::consts::PI * turns);
        Ring { centre: EYE + v(0.0, 0.0, radius * cosine), width: radius * sine, height: radius * sine }
    };
    let edge = ring(rim, radius);
    let mut all = vec![Ring { centre: edge.centre - v(0.0, 0.0, 0.12), width: 0.0, height: 0.0 }, edge];
    all.extend(rings.iter().rev().map(|&turns| ring(turns, radius)));
    all.push(ring(0.0, radius));
    sweep(&all, 10)
}

/// The rims of both upper lids with their lashes, as one dark line each.
pub fn lashes() -> Mesh {
    let (centre, arc) = lid_arc(UPPER_LID);
    let radius = EYE_RADIUS + LID_THICKNESS;
    let points: Vec<(Vec3, f64)> = [(-1.40, 0.03), (-1.05, 0.08), (-0.4, 0.12), (0.35, 0.13), (1.0, 0.11), (1.5, 0.03)]
        .iter()
        .map(|&(x, thickness): &(f64, f64)| {
            let y = centre + (arc * arc - x * x).sqrt() - EYE_SLANT * x;
            let z = (radius * radius - x * x - y * y).max(0.0).sqrt();
            (EYE + v(x, y, z), thickness)
        })
        .collect();
    mirrored_pair(&cord(&points))
}

/// A four-sided cord through the points, pointed at both ends.
fn cord(points: &[(Vec3, f64)]) -> Mesh {
    let mut rings: Vec<Ring> =
        points.iter().map(|&(centre, radius)| Ring { centre, width: radius, height: radius }).collect();
    let last = rings.len() - 1;
    rings[0].width = 0.0;
    rings[last].width = 0.0;
    sweep(&rings, 4)
}

fn mirrored_pair(mesh: &Mesh) -> Mesh {
    let mut pair = mesh.clone();
    let mut other = mesh.clone();
    for position in &mut other.positions {
        position.x = -position.x;
    }
    for triangle in &mut other.triangles {
        triangle.swap(1, 2);
    }
    pair.append(&other);
    pair
}
