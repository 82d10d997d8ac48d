//! An ant on its six legs: ellipsoids and tapering tubes.
//!
//! Out: closed parts that overlap where the joints are, facing +z, with the
//! feet on the plane y = 0. All of them are swept rings with a pole at each
//! end, so there is only one way of building here.

use crate::mesh::Mesh;
use crate::obj::{Material, Model, Part, Shading};
use crate::sweep::{Ring, ellipsoid, sweep};
use crate::vector::{Vec3, v};

const BODY: Material = Material { name: "body", colour: [0.72, 0.33, 0.20] };
const GASTER: Material = Material { name: "gaster", colour: [0.55, 0.26, 0.20] };
const LIMB: Material = Material { name: "limb", colour: [0.80, 0.45, 0.24] };
const EYE: Material = Material { name: "eye", colour: [0.20, 0.19, 0.22] };

pub fn model() -> Model {
    let mut parts = Vec::new();
    let mut add = |name: String, material: Material, mesh: Mesh| {
        parts.push(Part {
            name,
            material: Some(material),
            shading: Shading::Smooth { crease_cosine: 0.5 },
            closed: true,
            mesh,
        });
    };
    add("head".to_owned(), BODY, head());
    let thorax = [
        ("prothorax", v(0.0, 1.24, 0.62), v(0.36, 0.37, 0.50), 0.10),
        ("mesothorax", v(0.0, 1.20, 0.06), v(0.29, 0.31, 0.42), -0.10),
        ("propodeum", v(0.0, 1.10, -0.46), v(0.25, 0.27, 0.40), -0.22),
        ("petiole", v(0.0, 1.02, -0.92), v(0.15, 0.26, 0.15), 0.12),
        ("postpetiole", v(0.0, 1.00, -1.20), v(0.18, 0.22, 0.17), 0.05),
    ];
    for (name, centre, radii, slope) in thorax {
        add(name.to_owned(), BODY, ellipsoid(centre, radii, slope, 12, 8));
    }
    add("gaster".to_owned(), GASTER, gaster());
    for side in [-1.0, 1.0] {
        let hand = if side < 0.0 { "right" } else { "left" };
        let flip = |p: Vec3| v(p.x * side, p.y, p.z);
        let eye = ellipsoid(flip(v(0.47, 1.46, 1.62)), v(0.10, 0.17, 0.17), 0.0, 10, 5);
        add(format!("eye-{hand}"), EYE, eye);
        let mandible = [
            (v(0.20, 1.14, 1.94), 0.13),
            (v(0.27, 1.08, 2.14), 0.12),
            (v(0.23, 1.03, 2.34), 0.09),
            (v(0.10, 1.00, 2.46), 0.055),
            (v(0.01, 0.98, 2.49), 0.03),
        ];
        add(format!("mandible-{hand}"), GASTER, limb(&mandible, side, 8));
        let scape = [
            (v(0.17, 1.44, 1.98), 0.065),
            (v(0.30, 1.68, 2.12), 0.05),
            (v(0.50, 1.98, 2.20), 0.055),
            (v(0.66, 2.16, 2.22), 0.07),
        ];
        add(format!("scape-{hand}"), LIMB, limb(&scape, side, 7));
        let funicle = [
            (v(0.65, 2.14, 2.20), 0.06),
            (v(0.74, 2.12, 2.46), 0.05),
            (v(0.80, 2.00, 2.76), 0.055),
            (v(0.83, 1.84, 3.04), 0.07),
            (v(0.84, 1.70, 3.24), 0.06),
        ];
        add(format!("funicle-{hand}"), LIMB, limb(&funicle, side, 7));
        for (index, leg) in legs().iter().enumerate() {
            let name = |joint: &str| format!("{joint}-{hand}-{}", index + 1);
            let [hip, trochanter, knee, ankle, toe] = *leg;
            let coxa = [(hip, 0.13), (hip.lerp(trochanter, 0.6), 0.14), (trochanter, 0.10)];
            add(name("coxa"), BODY, limb(&coxa, side, 6));
            let femur = [
                (trochanter, 0.075),
                (trochanter.lerp(knee, 0.35), 0.125),
                (trochanter.lerp(knee, 0.75), 0.095),
                (knee, 0.075),
            ];
            add(name("femur"), LIMB, limb(&femur, side, 7));
            let tibia = [(knee, 0.07), (knee.lerp(ankle, 0.4), 0.085), (ankle, 0.05)];
            add(name("tibia"), LIMB, limb(&tibia, side, 6));
            let bend = ankle.lerp(toe, 0.55) + v(0.0, -0.02, 0.0);
            let tarsus = [(ankle, 0.05), (bend, 0.042), (toe, 0.03)];
            add(name("tarsus"), LIMB, limb(&tarsus, side, 6));
        }
    }
    Model { name: "ant", title: "An ant: head, thorax, petiole, gaster, six legs, antennae, mandibles.", parts }
}

/// Hip, trochanter, knee, ankle and toe of the three left legs, front first.
fn legs() -> [[Vec3; 5]; 3] {
    [
        [v(0.20, 1.06, 0.72), v(0.42, 0.86, 0.86), v(1.02, 1.52, 1.30), v(1.46, 0.34, 1.84), v(1.66, 0.03, 2.24)],
        [v(0.19, 1.00, 0.14), v(0.42, 0.80, 0.14), v(1.20, 1.50, 0.20), v(1.82, 0.34, 0.10), v(2.18, 0.03, 0.12)],
        [v(0.17, 0.94, -0.40), v(0.38, 0.76, -0.50), v(1.08, 1.62, -1.06), v(1.62, 0.36, -1.86), v(1.86, 0.03, -2.30)],
    ]
}

/// A broad head, widest behind the eyes, hollowed a little at the nape.
fn head() -> Mesh {
    let profile = [
        (0.98, 0.00, 0.00),
        (0.94, 0.20, 0.13),
        (0.98, 0.38, 0.24),
        (1.12, 0.51, 0.35),
        (1.30, 0.56, 0.41),
        (1.50, 0.54, 0.42),
        (1.70, 0.47, 0.38),
        (1.88, 0.37, 0.30),
        (2.02, 0.26, 0.20),
        (2.09, 0.13, 0.10),
        (2.11, 0.00, 0.00),
    ];
    let rings: Vec<Ring> = profile
        .iter()
        .map(|&(z, width, height)| Ring { centre: v(0.0, 1.36 - 0.16 * (z - 1.3), z), width, height })
        .collect();
    sweep(&rings, 16)
}

/// The hind body: a drop of four plates, each overlapping the next one.
fn gaster() -> Mesh {
    let mut rings = Vec::new();
    let mut add = |z: f64, radius: f64| {
        rings.push(Ring { centre: v(0.0, 1.06 - 0.05 * z, -1.30 - z), width: 0.66 * radius, height: 0.62 * radius });
    };
    // Distance behind the waist and radius; each plate starts with a step in.
    let outline = [
        (0.00, 0.00),
        (0.03, 0.26),
        (0.12, 0.52),
        (0.28, 0.78),
        (0.50, 0.96),
        (0.72, 1.02),
        (0.75, 0.95),
        (0.98, 0.98),
        (1.20, 0.90),
        (1.23, 0.83),
        (1.42, 0.75),
        (1.58, 0.62),
        (1.61, 0.55),
        (1.76, 0.40),
        (1.88, 0.22),
        (1.96, 0.00),
    ];
    for (z, radius) in outline {
        add(z, radius);
    }
    sweep(&rings, 18)
}

/// A round limb through the given points of the left side, its ends domed.
fn limb(points: &[(Vec3, f64)], side: f64, sides: usize) -> Mesh {
    let flip = |p: Vec3| v(p.x * side, p.y, p.z);
    let ring = |centre: Vec3, radius: f64| Ring { centre: flip(centre), width: radius, height: radius };
    let (first, first_radius) = points[0];
    let (last, last_radius) = points[points.len() - 1];
    let ahead = (points[1].0 - first).normalized();
    let behind = (last - points[points.len() - 2].0).normalized();
    let mut rings =
        vec![ring(first - ahead * first_radius, 0.0), ring(first - ahead * (0.6 * first_radius), 0.8 * first_radius)];
    rings.extend(points.iter().map(|&(centre, radius)| ring(centre, radius)));
    rings.push(ring(last + behind * (0.6 * last_radius), 0.8 * last_radius));
    rings.push(ring(last + behind * last_radius, 0.0));
    sweep(&rings, sides)
}
