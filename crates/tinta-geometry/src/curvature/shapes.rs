//! Meshes of surfaces with known curvature, for tests.

use crate::mesh::{LoadOptions, Mesh};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A mesh over a grid of parameters, with optionally joined sides.
pub(crate) fn grid(counts: [u32; 2], joined: [bool; 2], at: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let rows = [0, 1].map(|axis| if joined[axis] { counts[axis] } else { counts[axis] + 1 });
    let share = |number: u32, axis: usize| f64::from(number) / f64::from(counts[axis]);
    let points = (0..rows[0]).flat_map(|i| (0..rows[1]).map(move |j| (i, j)));
    let positions = points.map(|(i, j)| at(share(i, 0), share(j, 1))).collect();
    let place = |i: u32, j: u32| (i % rows[0]) * rows[1] + j % rows[1];
    let squares = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    let triangles: Vec<[u32; 3]> = squares
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Mesh::of_triangles("a grid", positions, &triangles, &LoadOptions::default()).unwrap()
}

/// A mapped ball whose six sides are grids of `count` squares each way.
pub(crate) fn ball(count: u32, map: impl Fn(DVec3) -> DVec3) -> Mesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let (axis, sign) = (side % 3, if side < 3 { 1.0 } else { -1.0 });
        let first = positions.len() as u32;
        let angle = |number: u32| (f64::from(number) / f64::from(count) - 0.5) * FRAC_PI_2;
        for i in 0..=count {
            for j in 0..=count {
                let (x, y) = (angle(i).tan(), angle(j).tan());
                let mut point = DVec3::ZERO;
                (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (sign, x * sign, y);
                positions.push(map(point.normalize()));
            }
        }
        for i in 0..count {
            for j in 0..count {
                let place = |i: u32, j: u32| first + i * (count + 1) + j;
                let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Mesh::of_triangles("a ball", positions, &triangles, &LoadOptions::default()).unwrap()
}

/// A torus with two radii around z.
pub(crate) fn torus(counts: [u32; 2], radii: [f64; 2]) -> Mesh {
    grid(counts, [true; 2], |u, v| {
        let (u, v) = (u * TAU, v * TAU);
        let across = radii[0] + radii[1] * v.cos();
        DVec3::new(across * u.cos(), across * u.sin(), radii[1] * v.sin())
    })
}
