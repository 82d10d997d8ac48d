//! Coat, lapels, waistcoat, collar and cravat of the bust, and its socle.
//!
//! Centimetres, in the frame of the face (see `face.rs`); distance fields,
//! but for the socle, which is turned on a lathe.

use crate::face::halved;
use crate::field::{carve, chain, cone, ellipsoid, front_of, join, meet, polygon};
use crate::mesh::Mesh;
use crate::polygonise::gradient;
use crate::sweep::{Ring, sweep};
use crate::vector::{Vec3, smoothstep, v};

/// Height of the socle's foot.
pub const FOOT: f64 = -40.2;

/// Chest and shoulders before the sculptor's cut.
fn torso(point: Vec3) -> f64 {
    let p = halved(point);
    let chest = ellipsoid(p, v(0.0, -26.0, -0.6), v(16.5, 12.5, 9.6));
    let shoulder = cone(p, v(3.0, -16.0, -2.4), v(14.5, -19.6, -2.4), 4.0, 4.4);
    let nape = cone(p, v(0.0, -12.0, -3.0), v(5.0, -16.8, -3.0), 5.4, 4.4);
    join(join(chest, shoulder, 4.5), nape, 3.0)
}

/// The outline a sculptor leaves: arms cut off, drawn in to the foot.
fn cut(p: Vec3) -> f64 {
    let (x, y) = (p.x / 13.8, (p.y + 18.5) / 14.2);
    ((x * x + y * y).sqrt() - 1.0) * 13.8
}

pub fn coat(p: Vec3) -> f64 {
    // The left front is buttoned over the right one.
    let over = if p.x > -0.5 && p.z > 0.0 { 0.3 } else { 0.0 };
    let body = meet(torso(p) - over * smoothstep(12.0, 6.0, p.x), cut(p), 0.5);
    let opening = polygon(p.x.abs(), p.y, &[[-1.0, -8.0], [5.6, -8.0], [5.2, -14.0], [0.4, -29.5], [-1.0, -29.5]]);
    let hollow = opening.max(-p.z).max(-(torso(p) + 2.2));
    let neck = cone(p, v(0.0, -30.0, -2.4), v(0.0, -5.0, -1.4), 5.4, 6.4);
    carve(carve(body, hollow, 0.15), neck, 0.3)
}

pub fn waistcoat(p: Vec3) -> f64 {
    meet(torso(p) + 0.5, cut(p) + 1.5, 0.4).max(1.0 - p.z).max(p.y + 15.5).max(p.x.abs() - 5.5).max(-29.0 - p.y)
}

/// Two buttons under the cravat and one where the coat closes.
pub fn buttons() -> Mesh {
    let mut mesh = Mesh::default();
    for (x, y, radius) in [(0.0, -24.6, 0.5), (0.0, -27.2, 0.5), (1.3, -31.2, 0.6)] {
        let cloth = if x > 1.0 { coat } else { waistcoat };
        let seat = front_of(&cloth, x, y);
        let out = gradient(&cloth, seat, 0.3).normalized();
        let ring = |depth: f64, radius: f64| Ring { centre: seat + out * depth, width: radius, height: radius };
        let rings = [ring(-0.3, 0.0), ring(-0.2, radius), ring(0.15, radius), ring(0.35, 0.0)];
        mesh.append(&sweep(&rings, 8));
    }
    mesh
}

/// A lapel on either side and the standing collar behind.
pub fn lapels(point: Vec3) -> f64 {
    let p = halved(point);
    let leaf = polygon(
        p.x,
        p.y,
        &[
            [5.3, -15.7],
            [8.4, -16.6],
            [7.6, -18.4],
            [10.4, -18.8],
            [7.6, -24.5],
            [1.2, -30.4],
            [0.4, -29.4],
            [3.0, -21.5],
        ],
    );
    let shell = (torso(p) - 0.95).max(-(torso(p) + 0.4));
    let lapel = meet(meet(leaf, shell, 0.25), cut(p) - 0.2, 0.2).max(-p.z);
    let tube = cone(p, v(0.0, -24.0, -0.8), v(0.0, -6.0, -2.7), 7.1, 6.9);
    let top = (p.y + 9.8 + 0.5 * (p.z + 8.0)) * 0.9;
    let band = meet((tube - 0.45).max(-(tube + 0.35)), top, 0.3);
    lapel.min(band.max(-(p.y + 17.5)).max(p.z - 0.8))
}

/// The cloth wound round the neck, the knot and the falling ends.
pub fn cravat(point: Vec3) -> f64 {
    let p = halved(point);
    let ring = |height: f64, tilt: f64, wide: f64, thick: f64| {
        let y = p.y - height + tilt * p.z;
        let around = (p.x * p.x + (p.z + 1.4) * (p.z + 1.4)).sqrt() - wide;
        (around * around + y * y / (1.35 * 1.35)).sqrt() - thick
    };
    let mut d = ring(-12.3, 0.14, 5.2, 1.05).min(ring(-13.9, 0.17, 5.5, 1.05));
    // The knot stands before the loops and the falling ends.
    d = d.min(ellipsoid(p, v(0.0, -14.8, 6.5), v(1.05, 1.15, 1.2)));
    let loops = chain(p, &[(v(0.7, -14.8, 6.1), 0.55), (v(2.7, -14.7, 6.2), 1.2), (v(3.9, -15.2, 5.8), 0.8)]);
    let ends = chain(p, &[(v(0.3, -15.6, 6.2), 0.6), (v(0.85, -18.6, 8.0), 1.1), (v(1.15, -22.4, 9.1), 1.1)]);
    d.min(loops).min(ends.max(-23.0 - p.y))
}

/// The points of the shirt collar on both sides of the chin.
pub fn collar(point: Vec3) -> f64 {
    let p = halved(point);
    let tube = cone(p, v(0.0, -20.0, -1.6), v(0.0, -6.0, -0.9), 5.2, 6.4);
    let shell = (tube - 0.2).max(-(tube + 0.2));
    let leaf = polygon(p.z, p.y, &[[-5.0, -15.5], [-5.0, -11.0], [1.0, -9.9], [5.4, -9.2], [4.7, -15.5]]);
    meet(shell, leaf, 0.15)
}

/// The turned foot: rings of height and radius from below.
pub fn socle() -> Mesh {
    let profile = [
        (FOOT, 0.0),
        (FOOT, 6.6),
        (FOOT + 1.9, 6.6),
        (FOOT + 2.0, 6.0),
        (FOOT + 3.6, 4.1),
        (FOOT + 4.8, 3.5),
        (FOOT + 7.0, 4.6),
        (FOOT + 7.1, 5.3),
        (FOOT + 8.6, 5.3),
        (FOOT + 10.0, 0.0),
    ];
    let rings: Vec<Ring> =
        profile.iter().map(|&(y, radius)| Ring { centre: v(0.0, y, -0.4), width: radius, height: radius }).collect();
    sweep(&rings, 16)
}
