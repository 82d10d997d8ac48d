//! Curvatures compared with closed forms.

use super::shapes::{ball, grid, torus};
use super::*;
use crate::mesh::LoadOptions;
use glam::DQuat;

const AXES: DVec3 = DVec3::new(3.0, 2.0, 1.0);

fn ellipsoid(count: u32) -> Mesh {
    ball(count, |point| point * AXES)
}

fn curvatures_of(mesh: &Mesh) -> Curvatures {
    Curvatures::new(mesh, &EdgeList::new(mesh), CreaseAngle::of_drawings(), 0.0)
}

/// Each vertex's position and curvature.
fn placed<'a>(mesh: &'a Mesh, of: &'a Curvatures) -> Vec<(DVec3, Curvature)> {
    let places = of.positions().iter().map(|position| mesh.positions[*position as usize]);
    places.zip(of.all().iter().copied()).collect()
}

fn median(mut numbers: Vec<f64>) -> f64 {
    assert!(!numbers.is_empty() && numbers.iter().all(|number| number.is_finite()));
    numbers.sort_unstable_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// The median error of both principal curvatures, as a share of the larger absolute value.
fn median_error(mesh: &Mesh, truth: impl Fn(DVec3) -> [f64; 2]) -> f64 {
    let of = curvatures_of(mesh);
    let errors = placed(mesh, &of).into_iter().flat_map(|(point, at)| {
        let truth = truth(point);
        let (mut found, mut truth) = (at.principal, truth);
        found.sort_unstable_by(f64::total_cmp);
        truth.sort_unstable_by(f64::total_cmp);
        let largest = truth[0].abs().max(truth[1].abs());
        [0, 1].map(|k| (found[k] - truth[k]).abs() / largest)
    });
    median(errors.collect())
}

fn torus_curvatures(radii: [f64; 2]) -> impl Fn(DVec3) -> [f64; 2] {
    move |point| {
        let across = point.truncate().length();
        [1.0 / radii[1], (across - radii[0]) / radii[1] / across]
    }
}

/// The curvatures of the ellipsoid with half axes `AXES`.
fn ellipsoid_curvatures(point: DVec3) -> [f64; 2] {
    let gradient = point / (AXES * AXES);
    let [x, y, z] = gradient.to_array();
    let height = 1.0 / gradient.length();
    // Both follow from their product and their sum.
    let product = height.powi(4) / (AXES * AXES).element_product();
    let sum = height.powi(3)
        * (x * x * (1.0 / AXES.y.powi(2) + 1.0 / AXES.z.powi(2))
            + y * y * (1.0 / AXES.x.powi(2) + 1.0 / AXES.z.powi(2))
            + z * z * (1.0 / AXES.x.powi(2) + 1.0 / AXES.y.powi(2)));
    let root = (0.25 * sum * sum - product).max(0.0).sqrt();
    [0.5 * sum + root, 0.5 * sum - root]
}

#[test]
fn planes_have_none_and_spheres_and_cylinders_theirs() {
    let plane = grid([8, 8], [false; 2], |u, v| DVec3::new(u, v, 0.3 * u - 2.0 * v));
    for (_, at) in placed(&plane, &curvatures_of(&plane)) {
        assert!(at.principal.iter().all(|curvature| curvature.abs() < 1e-12));
        assert!(at.derivative.iter().all(|derivative| derivative.abs() < 1e-10));
    }
    let sphere = ball(12, |point| point * 2.0 + DVec3::new(5.0, -3.0, 1.0));
    for (point, at) in placed(&sphere, &curvatures_of(&sphere)) {
        assert!(at.normal.distance((point - DVec3::new(5.0, -3.0, 1.0)) / 2.0) < 2e-3, "{point}");
        assert!(at.principal.iter().all(|curvature| (curvature - 0.5).abs() < 2e-3), "{:?}", at.principal);
    }
    let cylinder = grid([64, 10], [true, false], |u, v| {
        let angle = u * std::f64::consts::TAU;
        DVec3::new(0.5 * angle.cos(), 0.5 * angle.sin(), 2.0 * v)
    });
    for (point, at) in placed(&cylinder, &curvatures_of(&cylinder)) {
        assert!((at.principal[0] - 2.0).abs() < 0.01 && at.principal[1].abs() < 1e-9, "{point}: {:?}", at.principal);
        assert!(at.directions[0].z.abs() < 1e-6 && at.directions[1].z.abs() > 1.0 - 1e-6);
    }
}

#[test]
fn a_torus_and_an_ellipsoid_of_ten_thousand_triangles_are_within_two_percent() {
    let radii = [1.0, 0.4];
    let error = median_error(&torus([100, 50], radii), torus_curvatures(radii));
    println!("torus of 10,000 triangles: {:.3} %", 100.0 * error);
    assert!(error < 0.02, "torus: {error}");
    let error = median_error(&ellipsoid(29), ellipsoid_curvatures);
    println!("ellipsoid of 10,092 triangles: {:.3} %", 100.0 * error);
    assert!(error < 0.02, "ellipsoid: {error}");
}

#[test]
fn errors_shrink_with_the_square_of_the_edges() {
    let radii = [1.0, 0.4];
    let coarse = median_error(&torus([40, 20], radii), torus_curvatures(radii));
    let fine = median_error(&torus([160, 80], radii), torus_curvatures(radii));
    let order = (coarse / fine).log(4.0);
    println!("torus: {:.3} % to {:.4} %, order {order:.2}", 100.0 * coarse, 100.0 * fine);
    assert!(order > 1.8, "torus: {coarse} {fine}: {order}");
    let (coarse, fine) =
        (median_error(&ellipsoid(12), ellipsoid_curvatures), median_error(&ellipsoid(48), ellipsoid_curvatures));
    let order = (coarse / fine).log(4.0);
    println!("ellipsoid: {:.3} % to {:.4} %, order {order:.2}", 100.0 * coarse, 100.0 * fine);
    assert!(order > 1.8, "ellipsoid: {coarse} {fine}: {order}");
}

#[test]
fn the_derivative_is_that_of_a_cubic() {
    // Seen from above a rise is concave, so every number changes its sign.
    let (k, c) = ([0.7, -0.4], [0.9, -0.5, 0.3, 0.8]);
    let height = |x: f64, y: f64| {
        0.5 * (k[0] * x * x + k[1] * y * y)
            + (c[0] * x * x * x + 3.0 * c[1] * x * x * y + 3.0 * c[2] * x * y * y + c[3] * y * y * y) / 6.0
    };
    let error = |count: u32| {
        let patch = grid([count; 2], [false; 2], |u, v| {
            let (x, y) = (u - 0.5, v - 0.5);
            DVec3::new(x, y, height(x, y))
        });
        let of = curvatures_of(&patch);
        let (_, at) = placed(&patch, &of).into_iter().min_by(|a, b| a.0.length().total_cmp(&b.0.length())).unwrap();
        assert!((at.second([DVec3::X; 2]) + k[0]).abs() < 0.05 && (at.second([DVec3::Y; 2]) + k[1]).abs() < 0.05);
        let ways = [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8], [0.8, -0.6]];
        let errors = ways.map(|[x, y]| {
            let truth = c[0] * x * x * x + 3.0 * c[1] * x * x * y + 3.0 * c[2] * x * y * y + c[3] * y * y * y;
            (at.third(DVec3::new(x, y, 0.0)) + truth).abs()
        });
        errors.into_iter().fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(16), error(64));
    println!("derivative: {coarse:.5} to {fine:.6}, order {:.2}", (coarse / fine).log(4.0));
    assert!(fine < 0.01, "{coarse} {fine}");
    assert!((coarse / fine).log(4.0) > 1.5, "{coarse} {fine}");
}

#[test]
fn saddles_have_both_signs() {
    let saddle = grid([40, 40], [false; 2], |u, v| {
        let (x, y) = (u - 0.5, v - 0.5);
        DVec3::new(x, y, x * y)
    });
    let of = curvatures_of(&saddle);
    let (_, at) = placed(&saddle, &of).into_iter().min_by(|a, b| a.0.length().total_cmp(&b.0.length())).unwrap();
    let amounts = at.principal.map(f64::abs);
    assert!(at.principal[0] * at.principal[1] < 0.0 && amounts.iter().all(|it| (it - 1.0).abs() < 5e-3), "{amounts:?}");
    // It rises along x = y: concave from above.
    let rising = DVec3::new(1.0, 1.0, 0.0).normalize();
    assert!((at.second([rising; 2]) + 1.0).abs() < 5e-3);
}

#[test]
fn turning_scaling_and_another_order_change_nothing() {
    let mesh = ellipsoid(12);
    let before = curvatures_of(&mesh);
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 1.1);
    let (scale, shift) = (1e-3, DVec3::new(4.0, 5.0, -6.0) * 1e-3);
    let positions = mesh.positions.iter().map(|point| turn * *point * scale + shift).collect();
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().rev().map(|[a, b, c]| [*b, *c, *a]).collect();
    let moved = Mesh::of_triangles("moved", positions, &triangles, &LoadOptions::default()).unwrap();
    let after = curvatures_of(&moved);
    assert!((after.feature_size() / scale / before.feature_size() - 1.0).abs() < 1e-9);
    let mut after = placed(&moved, &after);
    for (point, at) in placed(&mesh, &before) {
        let target = turn * point * scale + shift;
        let nearest = after.iter().position(|(other, _)| other.distance(target) < 1e-9).unwrap();
        let (_, other) = after.swap_remove(nearest);
        for k in 0..2 {
            assert!((other.principal[k] * scale - at.principal[k]).abs() < 1e-9);
        }
        // Directions are arbitrary where both curvatures are equal.
        let apart = (at.principal[0] - at.principal[1]).abs() / at.principal[0].abs();
        for direction in at.directions {
            let (here, there) = (at.third(direction), other.third(turn * direction) * scale * scale);
            assert!((here - there).abs() < 1e-7, "{point} {apart}: {here} {there}");
        }
    }
    assert!(after.is_empty());
}

#[test]
fn creases_split_a_position_and_one_that_ends_inside_does_not() {
    let cube = ball(4, |point| point / point.abs().max_element());
    let of = curvatures_of(&cube);
    assert_eq!(of.all().len(), 6 * 25);
    assert!(of.all().iter().all(|at| at.principal.iter().all(|curvature| curvature.abs() < 1e-9)));
    // A dart: folded along one edge from the centre outwards.
    let dart = grid([2, 2], [false; 2], |u, v| DVec3::new(u, v, if u == 1.0 && v == 0.5 { 0.4 } else { 0.0 }));
    let of = Curvatures::new(&dart, &EdgeList::new(&dart), CreaseAngle::from_degrees(50.0).unwrap(), 0.0);
    let middle: Vec<_> =
        placed(&dart, &of).into_iter().filter(|(point, _)| point.truncate() == glam::DVec2::splat(0.5)).collect();
    assert_eq!(middle.len(), 1);
}

#[test]
fn degenerate_meshes_have_numbers_all_the_same() {
    let needle = |height: f64| {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, height, 0.0), DVec3::new(0.5, -1.0, 0.2)];
        Mesh::of_triangles("a needle", points, &[[0, 1, 2], [0, 3, 1]], &LoadOptions::default()).unwrap()
    };
    let mut fan = vec![DVec3::ZERO];
    fan.extend((0..8).map(|k| DVec3::new(f64::from(k).cos(), f64::from(k).sin(), f64::from(k % 2))));
    let sheets: Vec<[u32; 3]> = (1..8).map(|k| [0, 1, k + 1]).collect();
    let book = Mesh::of_triangles("a book", fan, &sheets, &LoadOptions::default()).unwrap();
    let folded = {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.1, 0.9, 0.0)];
        Mesh::of_triangles("folded back", points, &[[0, 1, 2], [1, 0, 3]], &LoadOptions::default()).unwrap()
    };
    let far = ball(3, |point| point * 1e-30 + DVec3::splat(1e-20));
    for mesh in [needle(1e-7), needle(1e-3), book, folded, far, Mesh::triangle()] {
        for smoothing in [0.0, 1.5] {
            let of = Curvatures::new(&mesh, &EdgeList::new(&mesh), CreaseAngle::default(), smoothing);
            assert!(of.feature_size() > 0.0 && of.feature_size().is_finite(), "{}", mesh.name);
            for at in of.all() {
                let numbers = at.principal.iter().chain(&at.derivative).chain(at.normal.as_ref());
                assert!(numbers.into_iter().all(|number| number.is_finite()), "{}: {at:?}", mesh.name);
            }
        }
    }
}

#[test]
fn smoothing_takes_noise_away() {
    let radii = [1.0, 0.4];
    let smooth = torus([80, 40], radii);
    let mut number = 1u64;
    let mut random = || {
        number = number.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (number >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    };
    let shaken =
        smooth.positions.iter().map(|point| *point + 0.004 * DVec3::new(random(), random(), random())).collect();
    let shaken = Mesh::of_triangles("shaken", shaken, &smooth.triangles, &LoadOptions::default()).unwrap();
    let error = |smoothing: f64| {
        let of = Curvatures::new(&shaken, &EdgeList::new(&shaken), CreaseAngle::of_drawings(), smoothing);
        let truth = torus_curvatures(radii);
        let errors = placed(&shaken, &of).into_iter().map(|(point, at)| {
            let largest = truth(point).into_iter().fold(0.0, f64::max);
            (at.principal[0] - largest).abs() / largest
        });
        median(errors.collect())
    };
    let (raw, smoothed) = (error(0.0), error(1.5));
    println!("noise: {:.1} % raw, {:.1} % smoothed", 100.0 * raw, 100.0 * smoothed);
    assert!(smoothed < 0.5 * raw && smoothed < 0.05, "{raw} {smoothed}");
}
