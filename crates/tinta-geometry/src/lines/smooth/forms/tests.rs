//! Form lines against closed forms, on the surface itself.

use super::*;
use crate::curvature::shapes::{ball, grid, torus};
use crate::edges::{EdgeList, Side, side_of_face};
use crate::mesh::LoadOptions;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The lines of a class on a mesh, in the mesh's space.
pub(super) fn traced(mesh: &Mesh, class: Class, eye: Eye, settings: &FormSettings) -> Vec<[DVec3; 2]> {
    let settings = LineSettings { classes: ClassSet::of(&[class]), forms: settings.clone(), ..LineSettings::default() };
    let curvatures = Curvatures::of_form(mesh, &EdgeList::new(mesh), settings.forms.smoothing);
    let forms = Forms::new(mesh, &curvatures, eye, &settings);
    let mut found = Vec::new();
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        let corners = triangle.map(|corner| mesh.positions[corner as usize]);
        let is_front = side_of_face(corners, eye) == Side::Front;
        forms.trace(face, corners, is_front, |_, ends| found.push(ends));
    }
    found
}

pub(super) fn raw() -> FormSettings {
    FormSettings { smoothing: 0.0, ..FormSettings::default() }
}

pub(super) fn length(lines: &[[DVec3; 2]]) -> f64 {
    lines.iter().map(|[from, to]| from.distance(*to)).sum()
}

/// The distance of a point from the nearest end of some lines.
fn distance(lines: &[[DVec3; 2]], point: DVec3) -> f64 {
    lines.iter().flatten().map(|end| end.distance(point)).fold(f64::INFINITY, f64::min)
}

/// The number of ends that meet no other, bit for bit.
fn loose_ends(lines: &[[DVec3; 2]]) -> usize {
    let mut ends: Vec<[u64; 3]> = lines.iter().flatten().map(|end| (*end + 0.0).to_array().map(f64::to_bits)).collect();
    ends.sort_unstable();
    ends.chunk_by(|a, b| a == b).filter(|meeting| meeting.len() == 1).count()
}

/// The curvature of a torus along the view and its growth towards the eye, in closed form, with the factors of sines
/// of [`Radial`].
pub(super) fn on_torus([large, small]: [f64; 2], [u, v]: [f64; 2], to_eye: DVec3) -> [f64; 2] {
    let across = large + small * v.cos();
    let around = DVec3::new(-u.sin(), u.cos(), 0.0);
    let up = DVec3::new(-v.sin() * u.cos(), -v.sin() * u.sin(), v.cos());
    let (x, y) = (to_eye.dot(around), to_eye.dot(up));
    let (k, l) = (v.cos() / across, 1.0 / small);
    // The first curvature changes along the second direction, and so do the mixed terms of the derivative.
    let growth = -v.sin() * large / (across * across) / small;
    let normal = DVec3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
    let (squares, torsion) = (x * x + y * y, (l - k) * x * y / (x * x + y * y));
    let third = 3.0 * growth * x * x * y;
    [k * x * x + l * y * y, third / squares - 2.0 * normal.dot(to_eye) * torsion * torsion]
}

/// The parameters of the torus's nearest point to a point.
pub(super) fn parameters(large: f64, point: DVec3) -> [f64; 2] {
    [point.y.atan2(point.x), point.z.atan2(point.truncate().length() - large)]
}

#[test]
fn suggestive_contours_of_a_torus_are_where_the_curvature_along_the_view_is_zero() {
    let radii = [1.0, 0.4];
    let to_eye = DVec3::new(1.0, 0.2, 0.5).normalize();
    let all = FormSettings { strength: 0.0, ..raw() };
    let errors = [50, 100, 200].map(|count| {
        let mesh = torus([2 * count, count], radii);
        let found = traced(&mesh, Class::Suggestive, Eye::Direction(to_eye), &all);
        assert!(!found.is_empty());
        let mut errors: Vec<f64> = Vec::new();
        for [from, to] in &found {
            let at = parameters(radii[0], (*from + *to) * 0.5);
            let normal = DVec3::new(at[1].cos() * at[0].cos(), at[1].cos() * at[0].sin(), at[1].sin());
            if normal.dot(to_eye) < 0.02 {
                continue;
            }
            let [curvature, growth] = on_torus(radii, at, to_eye);
            // Only on the inner half, between the parabolic circles, and growing.
            assert!(at[1].cos() < 0.1, "{at:?}");
            assert!(growth > -0.3, "{at:?}: {growth}");
            // The error of the line's place: the curvature over its slope.
            let step = 1e-5;
            let slope = |axis: usize| {
                let mut beside = at;
                beside[axis] += step;
                (on_torus(radii, beside, to_eye)[0] - curvature) / step
            };
            let per_unit = (slope(0) / (radii[0] + radii[1] * at[1].cos())).hypot(slope(1) / radii[1]);
            errors.push(curvature.abs() / per_unit);
        }
        errors.sort_unstable_by(f64::total_cmp);
        // All clear lines are found.
        let (mut sought, mut missed) = (0, 0);
        for i in 0..400 {
            for j in 0..400 {
                let at = |j: u32| [f64::from(i) / 400.0 * TAU, f64::from(j) / 400.0 * TAU];
                let [[here, growth], [next, _]] = [on_torus(radii, at(j), to_eye), on_torus(radii, at(j + 1), to_eye)];
                let [u, v] = at(j);
                let normal = DVec3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
                if (here > 0.0) != (next > 0.0) && growth > 0.3 && normal.dot(to_eye) > 0.05 {
                    let across = radii[0] + radii[1] * v.cos();
                    let point = DVec3::new(across * u.cos(), across * u.sin(), radii[1] * v.sin());
                    sought += 1;
                    missed += u32::from(distance(&found, point) > 4.0 / f64::from(count));
                }
            }
        }
        assert!(sought > 30 && missed == 0, "{missed} of {sought} missed at {count}");
        errors[errors.len() / 2]
    });
    let order = (errors[0] / errors[2]).log(4.0);
    println!("suggestive contours of a torus: {errors:?}, order {order:.2}");
    assert!(errors[1] < 2e-3 && order > 1.5, "{errors:?}: {order}");
}

#[test]
fn suggestive_contours_of_waves_are_the_turning_points_towards_the_eye() {
    // A wave along x, high at x = 0, seen from the side of larger x.
    let waves = |counts| {
        grid(counts, [false; 2], |u, v| {
            let x = (u - 0.5) * 3.0 * TAU;
            DVec3::new(x, 4.0 * v, 0.25 * x.cos())
        })
    };
    let to_eye = DVec3::new(0.5, 0.0, 1.0);
    let found = traced(&waves([240, 20]), Class::Suggestive, Eye::Direction(to_eye), &raw());
    // One line per wave, across it from end to end; none at the other turning points.
    for [from, to] in &found {
        for end in [from, to] {
            let turning = (end.x + FRAC_PI_2).rem_euclid(TAU);
            assert!(turning.min(TAU - turning) < 0.01, "{end}");
        }
    }
    assert!((length(&found) - 3.0 * 4.0).abs() < 0.2, "{}", length(&found));
    assert!(loose_ends(&found) <= 8, "{}", loose_ends(&found));
    // From behind the sides are swapped: hollows bulge.
    let behind = traced(&waves([240, 20]), Class::Suggestive, Eye::Direction(-to_eye), &raw());
    assert!(!behind.is_empty());
}

#[test]
fn ridges_and_valleys_of_waves_are_their_crests_and_troughs() {
    let waves = grid([240, 20], [false; 2], |u, v| {
        let x = (u - 0.5) * 3.0 * TAU;
        DVec3::new(x, 4.0 * v, 0.6 * x.cos())
    });
    let eye = Eye::Direction(DVec3::new(0.1, 0.2, 1.0));
    for (class, at, count) in [(Class::Ridge, 0.0, 3.0), (Class::Valley, PI, 2.0)] {
        let found = traced(&waves, class, eye, &raw());
        for end in found.iter().flatten() {
            let off = (end.x - at).rem_euclid(TAU);
            let is_rim = end.x.abs() > 3.0 * PI - 0.4 || end.y < 0.3 || end.y > 3.7;
            assert!(off.min(TAU - off) < 0.01 || is_rim, "{class:?}: {end}");
        }
        let inner: Vec<_> = found.into_iter().filter(|[from, _]| from.x.abs() < 3.0 * PI - 0.4).collect();
        assert!((length(&inner) - count * 4.0).abs() < 0.15 * count * 4.0, "{class:?}: {}", length(&inner));
    }
}

#[test]
fn the_ridge_of_a_flat_ellipsoid_is_its_rim() {
    let axes = DVec3::new(3.0, 2.0, 1.0);
    let rim = 15.8654;
    let off = [20, 40].map(|count| {
        let mesh = ball(count, |point| point * axes);
        let found = traced(&mesh, Class::Ridge, Eye::Direction(DVec3::X), &raw());
        let (near, far): (Vec<_>, Vec<_>) =
            found.into_iter().partition(|[from, to]| from.z.abs().max(to.z.abs()) < 0.1);
        assert!(far.is_empty(), "{far:?}");
        assert!((length(&near) / rim - 1.0).abs() < 0.01, "{count}: {}", length(&near));
        assert_eq!(loose_ends(&near), 0);
        near.iter().flatten().map(|end| end.z.abs()).sum::<f64>() / near.len() as f64
    });
    println!("ridge of an ellipsoid: {off:?}");
    assert!(off[1] < 0.5 * off[0] + 1e-9 && off[1] < 0.01, "{off:?}");
}

#[test]
fn balls_pipes_and_flat_faces_have_no_crests_and_no_suggestive_contours() {
    let sphere = ball(16, |point| point);
    let pipe = grid([64, 10], [true, false], |u, v| DVec3::new((u * TAU).cos(), (u * TAU).sin(), 3.0 * v));
    let cube = ball(8, |point| point / point.abs().max_element());
    for (mesh, name) in [(sphere, "sphere"), (pipe, "pipe"), (cube, "cube")] {
        for class in [Class::Suggestive, Class::Ridge, Class::Valley] {
            for smoothing in [0.0, 1.0] {
                let eye = Eye::Point(DVec3::new(4.0, 5.0, 6.0));
                let found = traced(&mesh, class, eye, &FormSettings { smoothing, ..raw() });
                assert!(found.is_empty(), "{name}, {class:?}, {smoothing}: {}", found.len());
            }
        }
    }
}

#[test]
fn raising_a_threshold_only_takes_away_and_scale_changes_nothing() {
    let radii = [1.0, 0.4];
    let bumpy = |scale: f64| {
        grid([120, 60], [true; 2], |u, v| {
            let (u, v) = (u * TAU, v * TAU);
            let small = radii[1] * (1.0 + 0.15 * (3.0 * u).cos() * (2.0 * v).cos());
            let across = radii[0] + small * v.cos();
            scale * DVec3::new(across * u.cos(), across * u.sin(), small * v.sin())
        })
    };
    let eye = |scale: f64| Eye::Point(scale * DVec3::new(2.0, -3.0, 4.0));
    for class in [Class::Suggestive, Class::Ridge, Class::Valley] {
        let with = |factor: f64, scale: f64| {
            let forms = FormSettings { strength: factor * if class == Class::Suggestive { 1.0 } else { 0.3 }, ..raw() };
            length(&traced(&bumpy(scale), class, eye(scale), &forms)) / scale
        };
        let lengths = [0.5, 1.0, 2.0, 4.0].map(|factor| with(factor, 1.0));
        assert!(lengths.is_sorted_by(|a, b| a >= b) && lengths[0] > lengths[3], "{class:?}: {lengths:?}");
        let small = with(1.0, 1e-12);
        assert!((small / lengths[1] - 1.0).abs() < 1e-3, "{class:?}: {small} {lengths:?}");
    }
}

#[test]
fn hostile_meshes_give_lines_with_finite_ends_or_none() {
    let points: Vec<DVec3> = (0..60)
        .map(|k| {
            let k = f64::from(k);
            DVec3::new((k * 12.9898).sin(), (k * 78.233).sin(), (k * 37.719).sin() * 1e-7)
        })
        .collect();
    let triangles: Vec<[u32; 3]> =
        (0..58).map(|k| [k, k + 1, k + 2]).chain((0..50).map(|k| [k, k + 9, k + 5])).collect();
    let soup = Mesh::of_triangles("soup", points, &triangles, &LoadOptions::default()).unwrap();
    let all = FormSettings { strength: 0.0, smoothing: 2.0 };
    for class in [Class::Suggestive, Class::Ridge, Class::Valley] {
        for eye in [Eye::Point(soup.positions[3]), Eye::Direction(DVec3::Z), Eye::Point(DVec3::splat(1e9))] {
            let found = traced(&soup, class, eye, &all);
            assert!(found.iter().flatten().all(|end| end.is_finite()), "{class:?} {eye:?}");
        }
    }
}
