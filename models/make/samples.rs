//! The two small models that pictures of options need: a turned pawn with a
//! picture on it, and a ball that hops.
//!
//! Out: `pawn.obj` with texture coordinates and without normals, its seam
//! written twice as texturing needs it; `pawn.ppm`, the picture; `hop.md2`,
//! four frames of a movement called `hop`.

use crate::md2::{Frame, Model};
use crate::vector::sin_cos;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

/// The pawn's outline from the middle of its foot to its top: radius, height.
const OUTLINE: [[f64; 2]; 12] = [
    [0.0, 0.0],
    [0.62, 0.0],
    [0.66, 0.12],
    [0.5, 0.3],
    [0.52, 0.38],
    [0.3, 0.62],
    [0.2, 1.05],
    [0.36, 1.16],
    [0.18, 1.22],
    [0.34, 1.38],
    [0.28, 1.82],
    [0.0, 1.92],
];
const SIDES: usize = 24;
/// Texels a side of the pawn's picture.
const TEXELS: usize = 32;

/// The ball: rings between its poles, corners of each.
const RINGS: usize = 7;
const CORNERS: usize = 12;
/// Height and width of the ball and how far it is above the ground, in radii, a frame each.
const HOP: [[f64; 3]; 4] = [[1.0, 1.0, 0.0], [0.6, 1.25, 0.0], [1.3, 0.88, 0.9], [1.1, 0.95, 1.6]];

pub fn write(folder: &Path) -> Result<(), String> {
    save(&folder.join("pawn.obj"), pawn().as_bytes())?;
    save(&folder.join("pawn.ppm"), picture().as_bytes())?;
    save(&folder.join("hop.md2"), &hop())
}

fn save(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

fn pawn() -> String {
    let mut text =
        String::from("# A pawn: texture coordinates, no normals.\n# Written by make-models (models/make.rs).\n");
    let top = OUTLINE[OUTLINE.len() - 1][1];
    let last = OUTLINE.len() - 1;
    for (ring, [radius, height]) in OUTLINE.into_iter().enumerate() {
        // The seam is written twice, but at the poles, where a triangle has no use for it.
        let count = if ring == 0 || ring == last { SIDES } else { SIDES + 1 };
        for side in 0..count {
            let turn = side as f64 / SIDES as f64;
            let (sine, cosine) = sin_cos(2.0 * PI * (side % SIDES) as f64 / SIDES as f64);
            // Adding 0 turns -0 into 0.
            let (x, z) = (radius * cosine + 0.0, 0.0 - radius * sine);
            let _ = writeln!(text, "v {x:.5} {height:.5} {z:.5}\nvt {turn:.5} {:.5}", height / top);
        }
    }
    for ring in 1..OUTLINE.len() {
        for side in 1..=SIDES {
            let first = |ring: usize| if ring == 0 { 0 } else { ring * (SIDES + 1) - 1 };
            let (a, d) = (first(ring - 1) + side, first(ring) + side);
            let (b, c) = (a + 1, d + 1);
            // Quads with a pole for one of their sides are triangles.
            let corners = match ring {
                1 => vec![a, c, d],
                _ if ring == last => vec![a, b, d],
                _ => vec![a, b, c, d],
            };
            text.push('f');
            for corner in corners {
                let _ = write!(text, " {corner}/{corner}");
            }
            text.push('\n');
        }
    }
    text
}

/// Slanting stripes over a dark foot.
fn picture() -> String {
    let mut text = format!("P3 {TEXELS} {TEXELS} 255\n");
    for y in 0..TEXELS {
        for x in 0..TEXELS {
            text.push_str(match (y > TEXELS * 4 / 5, (x + y) / 4 % 2 == 1) {
                (true, _) => "70 40 30\n",
                (false, true) => "190 60 40\n",
                (false, false) => "230 200 140\n",
            });
        }
    }
    text
}

/// Points of a ball of radius 1 on the ground: x forward, y left, z up.
fn ball() -> Vec<[f64; 3]> {
    let mut points = vec![[0.0, 0.0, 0.0]];
    for ring in 1..=RINGS {
        let (sine, cosine) = sin_cos(PI * ring as f64 / (RINGS + 1) as f64);
        for corner in 0..CORNERS {
            let (y, x) = sin_cos(2.0 * PI * corner as f64 / CORNERS as f64);
            points.push([sine * x, sine * y, 1.0 - cosine]);
        }
    }
    points.push([0.0, 0.0, 2.0]);
    points
}

/// Its triangles, clockwise as seen from outside, as the format has them.
fn triangles() -> Vec<[u16; 3]> {
    let at = |ring: usize, corner: usize| (1 + (ring - 1) * CORNERS + corner % CORNERS) as u16;
    let top = (1 + RINGS * CORNERS) as u16;
    let mut triangles = Vec::new();
    for corner in 0..CORNERS {
        triangles.push([0, at(1, corner), at(1, corner + 1)]);
        for ring in 1..RINGS {
            let [a, b] = [at(ring, corner), at(ring, corner + 1)];
            let [d, c] = [at(ring + 1, corner), at(ring + 1, corner + 1)];
            triangles.extend([[a, c, b], [a, d, c]]);
        }
        triangles.push([top, at(RINGS, corner + 1), at(RINGS, corner)]);
    }
    triangles
}

fn hop() -> Vec<u8> {
    let points = ball();
    let frames = HOP.into_iter().enumerate().map(|(number, [height, width, lift])| {
        let step = |value: f64| (value * 64.0 + 0.5) as u8;
        Frame {
            name: format!("hop{}", number + 1),
            // Steps of 1/64 of a radius, from -2 up to almost 2; upwards from 0.
            scale: [1.0 / 64.0; 3],
            translation: [-2.0, -2.0, lift as f32],
            vertices: points
                .iter()
                .map(|[x, y, z]| [step(x * width + 2.0), step(y * width + 2.0), step(z * height)])
                .collect(),
        }
    });
    let model = Model {
        skin: None,
        skin_size: [1, 1],
        // One texture coordinate for all corners.
        texels: vec![[0, 0]],
        triangles: triangles().into_iter().map(|[a, b, c]| [a, b, c, 0, 0, 0]).collect(),
        frames: frames.collect(),
    };
    model.bytes()
}
