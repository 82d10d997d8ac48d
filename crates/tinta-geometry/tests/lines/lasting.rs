//! Creases that last, and those of scans that do not.

use crate::support::builtin;
use crate::support::lines::{lines_with, of_class, only, scene_of, view};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use glam::DVec3;
use tinta::Mesh;
use tinta::edges::{Class, CreaseAngle};
use tinta::lines::LineSettings;

/// The length of the visible creases, of all and of the lasting ones.
fn creases(mesh: Mesh) -> [f64; 2] {
    let scene = scene_of(vec![mesh], view("33,17", true));
    [false, true].map(|lasting_creases| {
        let found = lines_with(&scene, &LineSettings { lasting_creases, ..only(&[Class::Crease]) });
        of_class(&found, Class::Crease, true)
    })
}

#[test]
fn all_creases_of_parts_last_and_the_folds_of_a_bumpy_ball_do_not() {
    let [all, lasting] = creases(cuboid(DVec3::ZERO, DVec3::new(3.0, 2.0, 1.0)));
    assert!(all > 100.0 && all == lasting, "a box: {all} {lasting}");
    let gear = builtin("gear");
    let [all, lasting] = creases(gear);
    assert!(all > 100.0 && (all - lasting).abs() < 1e-6, "a gear: {all} {lasting}");
    // Small steps on a large plate have edges of a fiftieth of it, between flat faces.
    let plate = cuboid(DVec3::new(-20.0, -1.0, -20.0), DVec3::new(20.0, 0.0, 20.0));
    let steps = cuboid(DVec3::new(0.0, 0.1, 0.0), DVec3::splat(1.0));
    let [all, lasting] = creases(joined(&[plate, steps]));
    assert_eq!(all, lasting, "a step");
    // Every vertex of fine balls moved at random: folds everywhere, few of them continuous.
    let mut sums = [0.0; 2];
    for seed in 1..=8 {
        let (mut random, ball) = (Random::seeded(seed), icosphere(4));
        let positions = ball.positions.iter().map(|point| *point * (1.0 + 0.03 * random.number())).collect();
        let found = creases(mesh(positions, ball.triangles));
        (0..2).for_each(|which| sums[which] += found[which]);
    }
    let [all, lasting] = sums;
    assert!(all > 8000.0 && lasting < 0.15 * all, "bumpy balls: {all} {lasting}");
}

/// A ridge along x whose edges have these angles, degrees; no two triangles beside it lie in one plane unless its angles are equal.
fn ridge(angles: &[f64]) -> Mesh {
    let fall = |degrees: &f64| (degrees.to_radians() / 2.0).tan();
    let mut positions: Vec<DVec3> = (0..=angles.len()).map(|place| DVec3::new(place as f64, 0.0, 0.0)).collect();
    let mut triangles = Vec::new();
    for side in [1.0, -1.0] {
        let first = positions.len() as u32;
        let wing = |place: usize| DVec3::new(place as f64, -fall(angles.get(place).unwrap_or(&0.0)), side);
        positions.extend((0..=angles.len()).map(wing));
        for place in 0..angles.len() as u32 {
            let [own, beside] = [[place, place + 1], [first + place, first + place + 1]];
            let faces = [[own[0], own[1], beside[0]], [own[1], beside[1], beside[0]]];
            triangles.extend(faces.map(|[a, b, c]| if side > 0.0 { [a, c, b] } else { [a, b, c] }));
        }
    }
    mesh(positions, triangles)
}

#[test]
fn a_crease_whose_angle_varies_around_the_limit_is_one_line() {
    let varying: Vec<f64> = (0..12).map(|place| if place % 2 == 0 { 34.0 } else { 24.0 }).collect();
    let [sharp, lasting] = creases(ridge(&varying));
    assert!(sharp > 100.0 && (lasting / sharp - 2.0).abs() < 0.1, "{sharp} {lasting}");
    // An edge below two thirds of the angle continues nothing.
    let broken: Vec<f64> = (0..12).map(|place| if place == 6 { 19.0 } else { 34.0 - f64::from(place) / 8.0 }).collect();
    let [sharp, lasting] = creases(ridge(&broken));
    assert!(sharp > 100.0 && (lasting - sharp).abs() < 1e-6, "{sharp} {lasting}");
    // What is sharp at one place in twelve is not a crease all along.
    let blunt: Vec<f64> = (0..12).map(|place| if place == 6 { 34.0 } else { 24.0 - f64::from(place) / 8.0 }).collect();
    let [sharp, lasting] = creases(ridge(&blunt));
    assert!(sharp > 10.0 && lasting == 0.0, "{sharp} {lasting}");
}

#[test]
fn creases_of_coarse_round_shapes_stand_out_from_their_facets_and_those_of_polyhedra_are_all_drawn() {
    // All edges of a cone of twelve triangles have 29 degrees at its side; its rim has more.
    let count = 12;
    let around = |place: u32| std::f64::consts::TAU * f64::from(place) / f64::from(count);
    let rim = |place: u32| DVec3::new(around(place).cos(), 0.0, around(place).sin());
    let positions = [2.0 * DVec3::Y, DVec3::ZERO].into_iter().chain((0..count).map(rim)).collect();
    let side = |place: u32| [[0, 2 + (place + 1) % count, 2 + place], [1, 2 + place, 2 + (place + 1) % count]];
    let cone = || mesh(Vec::clone(&positions), (0..count).flat_map(side).collect());
    let angled = |lasting_creases: bool, degrees: f64| {
        let crease_angle = CreaseAngle::from_degrees(degrees).unwrap();
        let scene = scene_of(vec![cone()], view("33,17", true));
        let settings = LineSettings { lasting_creases, crease_angle, ..only(&[Class::Crease]) };
        of_class(&lines_with(&scene, &settings), Class::Crease, true)
    };
    let [all, lasting, rim] = [angled(false, 20.0), angled(true, 20.0), angled(false, 60.0)];
    assert!(all > 2.0 * rim && (lasting - rim).abs() < 1e-6, "a cone: {all} {lasting} {rim}");
    let [all, lasting] = creases(icosphere(0));
    assert!(all > 100.0 && all == lasting, "an icosahedron: {all} {lasting}");
}
