//! Surfaces without roundings have no tangent edges, however their triangles fan; a thin rounding has its own.

use super::{Solid, angle_bar, rounded_block, rounded_rod, tangents};
use crate::support::shapes::{Random, mesh};
use glam::{DQuat, DVec2, DVec3, EulerRot};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use tinta::{EdgeList, Mesh};

/// A strip of triangles between two rows of points in parameters, each time to the nearer next point.
fn strip(rows: [Vec<DVec2>; 2], surface: impl Fn(DVec2) -> DVec3) -> Mesh {
    let [top, bottom] = &rows;
    let (mut triangles, mut i, mut j) = (Vec::new(), 0, 0);
    let at = |j: usize| (top.len() + j) as u32;
    while i + 1 < top.len() || j + 1 < bottom.len() {
        let is_top = i + 1 < top.len()
            && (j + 1 == bottom.len() || (top[i + 1].x - bottom[j].x).abs() < (top[i].x - bottom[j + 1].x).abs());
        if is_top {
            triangles.push([i as u32, at(j), i as u32 + 1]);
            i += 1;
        } else {
            triangles.push([i as u32, at(j), at(j + 1)]);
            j += 1;
        }
    }
    mesh(rows.concat().into_iter().map(surface).collect(), triangles)
}

fn count(mesh: &Mesh) -> usize {
    tangents(mesh, &EdgeList::new(mesh)).len()
}

#[test]
fn a_hole_across_a_plain_cylinder_cone_or_ball_makes_none() {
    for (rim, hole) in [(40, 20), (40, 40), (24, 60), (90, 20), (12, 80)] {
        for radius in [0.1, 0.333, 0.6f64] {
            let around = |step: i32| DVec2::new(TAU * f64::from(step) / f64::from(rim), 20.0);
            let top: Vec<DVec2> = (-rim / 13..=rim / 13).map(around).collect();
            let bottom = (0..=hole).map(|step| {
                let turn = PI * f64::from(step) / f64::from(hole);
                DVec2::new((-turn.cos() * radius).asin(), 12.0 * radius * turn.sin())
            });
            let rows = [top, bottom.collect()];
            let in_file = |point: DVec3| (point * 1e5).round() / 1e5;
            let cylinder = |at: DVec2| in_file(DVec3::new(12.0 * at.x.cos(), 12.0 * at.x.sin(), at.y));
            let cone = |at: DVec2| {
                let across = 12.0 - 0.3 * at.y;
                in_file(DVec3::new(across * at.x.cos(), across * at.x.sin(), at.y))
            };
            let ball = |at: DVec2| {
                let [(sine, cosine), up] = [at.x.sin_cos(), (at.y / 24.0).sin_cos()];
                in_file(12.0 * DVec3::new(up.1 * cosine, up.1 * sine, up.0))
            };
            let found =
                [count(&strip(rows.clone(), cylinder)), count(&strip(rows.clone(), cone)), count(&strip(rows, ball))];
            assert_eq!(found, [0; 3], "{rim} facets, {hole} at a hole of {radius}");
        }
    }
}

#[test]
fn a_thin_rounding_has_two() {
    for height in [0.5, 2.0, 5.0, 8.0, 40.0] {
        for facets in [4, 8, 16] {
            let mut profile = vec![DVec2::new(-30.0, 10.0)];
            let arc = (0..=facets)
                .map(|step| 10.0 * DVec2::from_angle(FRAC_PI_2 * (1.0 - f64::from(step) / f64::from(facets))));
            profile.extend(arc);
            profile.push(DVec2::new(10.0, -30.0));
            let mut solid = Solid::default();
            for (step, side) in profile.windows(2).enumerate() {
                let [from, to] = [side[0], side[1]].map(|at| at.extend(0.0));
                let up = DVec3::Z * height;
                let patch = if step == 0 {
                    0
                } else if step + 2 == profile.len() {
                    2
                } else {
                    1
                };
                solid.add_towards(patch, &[from, to, to + up, from + up], DVec3::new(1.0, 1.0, 0.0));
            }
            let mesh = mesh(solid.positions, solid.triangles);
            let edges = EdgeList::new(&mesh);
            let sides =
                |edge: &u32| -> usize { edges.faces(*edge).iter().map(|face| solid.patches[*face as usize]).sum() };
            let found: Vec<usize> = tangents(&mesh, &edges).iter().map(sides).collect();
            let mut sorted = found.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, [1, 3], "{height} high, {facets} facets");
        }
    }
}

/// A grid over the unit square, its squares' diagonals one way or the other.
fn grid(counts: [u32; 2], is_mixed: bool, surface: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let [rows, columns] = counts;
    let points = (0..=rows).flat_map(|i| (0..=columns).map(move |j| (i, j)));
    let at = |i: u32, j: u32| surface(f64::from(i) / f64::from(rows), f64::from(j) / f64::from(columns));
    let mut triangles = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let place = |i: u32, j: u32| i * (columns + 1) + j;
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            let turned = is_mixed && (i * 7 + j * 3) % 5 < 2;
            triangles.extend(if turned { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] });
        }
    }
    mesh(points.map(|(i, j)| at(i, j)).collect(), triangles)
}

#[test]
fn surfaces_of_changing_curvature_have_none() {
    let around = |across: f64, turn: f64, along: f64| DVec3::new(across * turn.cos(), across * turn.sin(), along);
    let bernstein = |t: f64| [(1.0 - t).powi(3), 3.0 * t * (1.0 - t).powi(2), 3.0 * t * t * (1.0 - t), t.powi(3)];
    let bezier = |u: f64, v: f64| {
        let heights = [[0.3, -1.1, 0.8, 0.2], [1.4, 0.1, -0.9, 0.5], [-0.4, 1.2, 0.6, -1.3], [0.7, -0.2, 0.9, 0.1]];
        let rows = bernstein(u).into_iter().zip(heights);
        let height =
            rows.map(|(share, row)| share * bernstein(v).iter().zip(row).map(|(a, b)| a * b).sum::<f64>()).sum();
        DVec3::new(6.0 * u, 6.0 * v, height)
    };
    let noise = |u: f64, v: f64, axis: f64| ((u * 791.3 + v * 317.7 + axis) * 43.1).sin() * 1e-3;
    for counts in [[24, 16], [60, 40], [160, 60]] {
        for is_mixed in [false, true] {
            let none = |name: &str, surface: &dyn Fn(f64, f64) -> DVec3| {
                assert_eq!(count(&grid(counts, is_mixed, surface)), 0, "{name} of {counts:?}, {is_mixed}");
            };
            none("a wave", &|u, v| DVec3::new(10.0 * u, 6.0 * v, (2.0 * TAU * u).sin()));
            none("waves both ways", &|u, v| DVec3::new(9.0 * u, 9.0 * v, (TAU * u).sin() * (TAU * v).sin()));
            none("a parabola", &|u, v| DVec3::new(10.0 * u - 5.0, 6.0 * v, 0.1 * (10.0 * u - 5.0).powi(2)));
            none("an ellipse", &|u, v| DVec3::new(5.0 * (TAU * u).cos(), 3.0 * (TAU * u).sin(), 8.0 * v));
            none("a spring", &|u, v| around(5.0 + (TAU * v).cos(), 3.0 * TAU * u, 8.0 * u + (TAU * v).sin()));
            none("a thread", &|u, v| around(5.0 + 0.5 * (TAU * (5.0 * v + u)).sin(), TAU * u, 10.0 * v));
            none("a vase", &|u, v| around(4.0 + (4.0 * v).sin() + 0.3 * (9.0 * v).cos(), TAU * u, 10.0 * v));
            none("a patch", &bezier);
            none("a rough pipe", &|u, v| around(1.0 + noise(u, v, 0.0), TAU * u, 3.0 * v + noise(u, v, 1.0)));
        }
    }
}

#[test]
fn roundings_turned_at_random_and_written_in_f32_have_their_tangent_edges() {
    for seed in 0..90 {
        let mut random = Random::seeded(seed);
        let mut between = |low: f64, high: f64| low + (high - low) * random.number();
        let (facets, rounding) = (between(4.0, 17.0) as usize, between(0.1, 1.5));
        let mut solid = match seed % 3 {
            0 => rounded_block(DVec3::from_array([0.0; 3].map(|_| between(0.2, 5.0))), rounding, facets),
            1 => rounded_rod(between(1.6, 6.0), rounding, between(0.3, 8.0), facets, between(13.0, 97.0) as usize),
            _ => angle_bar(rounding, facets),
        };
        let [x, y, z] = [0.0; 3].map(|_| between(0.0, TAU));
        let (turn, scale) = (DQuat::from_euler(EulerRot::XYZ, x, y, z), between(0.01, 100.0));
        solid.positions.iter_mut().for_each(|position| *position = (turn * *position * scale).as_vec3().as_dvec3());
        let [all, right, wrong] = solid.found();
        // A bar's creases, too, are between two of its surfaces.
        let all = if seed % 3 == 2 { 80.0 * scale } else { all };
        assert!(right >= 0.99 * all && wrong == 0.0, "{seed}: {facets} facets, {rounding}: {right} of {all}, {wrong}");
    }
}
