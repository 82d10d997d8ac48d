//! Creases that last, and those of scans that do not.

use crate::support::builtin;
use crate::support::lines::{lines_with, of_class, only, scene_of, view};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use glam::DVec3;
use tinta::Mesh;
use tinta::edges::Class;
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
