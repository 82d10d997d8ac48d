//! Form lines on hard input: nearly flat surfaces, wrong or missing normals, noise.

use super::tests::{length, on_torus, parameters, raw, traced};
use super::*;
use crate::curvature::shapes::{grid, torus};
use crate::mesh::{LoadOptions, read_bytes};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Without smoothing, and with every suggestive contour.
fn whole() -> FormSettings {
    FormSettings { strength: 0.0, ..raw() }
}

const ALL: [Class; 3] = [Class::Suggestive, Class::Ridge, Class::Valley];

/// Three waves along x with this height; `more` is added to each height.
fn waves(height: f64, more: impl Fn(DVec3) -> f64) -> Mesh {
    grid([240, 20], [false; 2], |u, v| {
        let flat = DVec3::new((u - 0.5) * 3.0 * TAU, 4.0 * v, 0.0);
        flat + DVec3::Z * (height * flat.x.cos() + more(flat))
    })
}

/// Scattered over -1 to 1, the same everywhere.
fn scattered(point: DVec3) -> f64 {
    let product = (point.dot(DVec3::new(127.1, 311.7, 74.7))).sin() * 43758.5453;
    2.0 * (product - product.floor()) - 1.0
}

#[test]
fn crests_of_waves_that_are_nearly_flat_are_where_those_of_high_ones_are() {
    let eye = Eye::Direction(DVec3::new(0.1, 0.2, 1.0));
    let all = FormSettings { strength: 0.0, ..raw() };
    for height in [0.6, 1e-3, 1e-6, 1e-9] {
        for (class, at, count) in [(Class::Ridge, 0.0, 3.0), (Class::Valley, PI, 2.0)] {
            let found = traced(&waves(height, |_| 0.0), class, eye, &all);
            let inner = |[from, to]: &[DVec3; 2]| from.x.abs().max(to.x.abs()) < 3.0 * PI - 0.4;
            let inner: Vec<_> = found.into_iter().filter(inner).collect();
            let off = |end: &DVec3| ((end.x - at + PI).rem_euclid(TAU) - PI).abs();
            assert!(
                inner.iter().flatten().filter(|end| end.y > 0.3 && end.y < 3.7).all(|end| off(end) < 0.01),
                "{height}"
            );
            assert!((length(&inner) - 4.0 * count).abs() < 0.15 * 4.0 * count, "{height}: {}", length(&inner));
        }
    }
}

#[test]
fn what_is_flat_but_for_rounding_has_no_form_lines() {
    for noise in [0.0, 1e-15, 1e-12, 1e-9] {
        let sheet = waves(0.0, |point| noise * scattered(point));
        for class in ALL {
            for eye in [Eye::Direction(DVec3::new(0.3, 0.2, 1.0)), Eye::Point(DVec3::new(2.0, -9.0, 0.5))] {
                let found = traced(&sheet, class, eye, &raw());
                assert!(found.is_empty(), "{class:?} {noise}: {}", length(&found));
            }
        }
    }
}

/// A mesh read from an OBJ file, with the normal that `normal` gives at each position.
fn obj(mesh: &Mesh, normal: Option<&dyn Fn(usize) -> DVec3>) -> Mesh {
    let mut text = String::new();
    for (number, DVec3 { x, y, z }) in mesh.positions.iter().enumerate() {
        let _ = writeln!(text, "v {x} {y} {z}");
        if let Some(DVec3 { x, y, z }) = normal.map(|normal| normal(number)) {
            let _ = writeln!(text, "vn {x} {y} {z}");
        }
    }
    for [a, b, c] in mesh.triangles.iter().map(|triangle| triangle.map(|corner| corner + 1)) {
        let _ = match normal {
            Some(_) => writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    read_bytes(text.as_bytes(), "torus.obj", &[], &LoadOptions::default()).unwrap().mesh
}

#[test]
fn a_files_wrong_normals_change_no_form_line() {
    let torus = torus([60, 30], [1.0, 0.4]);
    let wrong = |number: usize| match number % 3 {
        0 => DVec3::ZERO,
        1 => -torus.positions[number],
        _ => DVec3::new(scattered(torus.positions[number]), 1.0, -0.5),
    };
    let (without, with) = (obj(&torus, None), obj(&torus, Some(&wrong)));
    let eye = Eye::Direction(DVec3::new(1.0, 0.2, 0.5));
    for class in ALL {
        let lines = [&without, &with].map(|mesh| traced(mesh, class, eye, &whole()));
        assert_eq!(lines[0], lines[1], "{class:?}");
    }
    assert!(!traced(&with, Class::Suggestive, eye, &whole()).is_empty());
}

#[test]
fn vertices_whose_normals_cancel_leave_the_rest_as_it_is() {
    // Every twentieth triangle is repeated in the opposite orientation; around it the sum of normals is meaningless.
    let good = torus([60, 30], [1.0, 0.4]);
    let mut triangles = good.triangles.clone();
    triangles.extend(good.triangles.iter().step_by(97).map(|[a, b, c]| [*a, *c, *b]));
    let bad = Mesh::of_triangles("bad", good.positions.clone(), &triangles, &LoadOptions::default()).unwrap();
    let eye = Eye::Direction(DVec3::new(1.0, 0.2, 0.5));
    let [whole, found] = [&good, &bad].map(|mesh| traced(mesh, Class::Suggestive, eye, &whole()));
    assert!(found.iter().flatten().all(|end| end.is_finite()));
    let share = length(&found) / length(&whole);
    assert!((0.7..1.3).contains(&share), "{share}");
}

#[test]
fn noise_moves_smoothed_suggestive_contours_by_little() {
    let (radii, to_eye) = ([1.0, 0.4], DVec3::new(1.0, 0.2, 0.5).normalize());
    let good = torus([140, 70], radii);
    // The exact curvature along the view, as shares of its largest value: 0 on the line itself.
    let off = |noise: f64, smoothing: f64| {
        let positions = good.positions.iter().map(|point| *point * (1.0 + noise * scattered(*point))).collect();
        let mesh = Mesh::of_triangles("noise", positions, &good.triangles, &LoadOptions::default()).unwrap();
        let lines = traced(&mesh, Class::Suggestive, Eye::Direction(to_eye), &FormSettings { smoothing, ..whole() });
        let weighted = lines.iter().map(|[from, to]| {
            let at = parameters(radii[0], (*from + *to) * 0.5);
            from.distance(*to) * (on_torus(radii, at, to_eye)[0] * radii[1]).abs()
        });
        [weighted.sum::<f64>() / length(&lines), length(&lines)]
    };
    let [clean, whole] = off(0.0, 0.0);
    assert!(clean < 0.01, "{clean}");
    for noise in [0.0002, 0.001, 0.002] {
        let by_smoothing = [0.0, 1.0, 2.0].map(|smoothing| off(noise, smoothing));
        println!("noise {noise}: {by_smoothing:?}, without {clean} {whole}");
        // With hardly any noise, smoothing moves lines more than the noise does.
        assert!(noise < 0.001 || by_smoothing[1][0] < 0.7 * by_smoothing[0][0], "{noise}: {by_smoothing:?}");
        for [off, length] in &by_smoothing[1..] {
            assert!(*off < 0.01 && (length / whole - 1.0).abs() < 0.1, "{noise}: {off} {length} {whole}");
        }
    }
}
