//! Swept parts: rings of points strung along a line and closed by two poles.
//!
//! In: the rings from one end to the other. Out: a closed mesh.

use crate::mesh::Mesh;
use crate::vector::{Vec3, sin_cos, v};

/// One ring of a swept part: centre, half width across, half height.
#[derive(Clone, Copy)]
pub struct Ring {
    pub centre: Vec3,
    pub width: f64,
    pub height: f64,
}

/// An ellipsoid whose long axis z climbs by `slope` a unit.
pub fn ellipsoid(centre: Vec3, radii: Vec3, slope: f64, sides: usize, count: usize) -> Mesh {
    let rings: Vec<Ring> = (0..=count)
        .map(|i| {
            let (sine, cosine) = sin_cos(std::f64::consts::PI * i as f64 / count as f64);
            let along = -cosine * radii.z;
            let sine = if i == 0 || i == count { 0.0 } else { sine };
            Ring { centre: centre + v(0.0, slope * along, along), width: sine * radii.x, height: sine * radii.y }
        })
        .collect();
    sweep(&rings, sides)
}

/// Joins rings into a closed skin; the first and the last ring are poles.
pub fn sweep(rings: &[Ring], sides: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let last = rings.len() - 1;
    let start = mesh.add(rings[0].centre);
    let mut across = Vec3::ZERO;
    for index in 1..last {
        let along = (rings[index + 1].centre - rings[index - 1].centre).normalized();
        // Carried from ring to ring, so that a bent limb is not twisted.
        let guess = match index {
            1 if along.y.abs() > 0.9 => v(0.0, 0.0, 1.0).cross(along),
            1 => v(0.0, 1.0, 0.0).cross(along),
            _ => across,
        };
        across = guess.without(along).normalized();
        let up = along.cross(across);
        for side in 0..sides {
            let turn = 2.0 * std::f64::consts::PI * side as f64 / sides as f64;
            let (sine, cosine) = sin_cos(turn);
            let Ring { centre, width, height } = rings[index];
            mesh.add(centre + across * (cosine * width) + up * (sine * height));
        }
    }
    let end = mesh.add(rings[last].centre);
    for side in 0..sides {
        let next = (side + 1) % sides;
        mesh.triangles.push([start, 1 + next, 1 + side]);
        for index in 0..last - 2 {
            let [low, high] = [1 + index * sides, 1 + (index + 1) * sides];
            mesh.quad([low + side, low + next, high + next, high + side]);
        }
        let low = 1 + (last - 2) * sides;
        mesh.triangles.push([low + side, low + next, end]);
    }
    mesh
}
