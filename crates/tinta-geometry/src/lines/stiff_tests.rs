//! Smooth contours on hard input: closed forms with flat places and rims, all cusps of a torus, noise, wrong normals,
//! and mostly flat shapes.

use super::LineSettings;
use super::contour_distance::ContourDistance;
use super::smooth_tests::{camera, distance, found, of_triangles, scene, smooth};
use crate::edges::{Class, SilhouetteRule};
use crate::lines::smooth::closed_forms::{ClosedForm, Patch};
use crate::mesh::{LoadOptions, Mesh, load};
use glam::{DVec2, DVec3, Vec3};
use std::io::Write;
use std::path::{Path, PathBuf};

/// y = 0.5 (x^2 - z^2): the rim is that of a saddle.
const SADDLE: Patch = Patch { coefficients: [[0.0, 0.0, -0.5, 0.0], [0.0; 4], [0.5, 0.0, 0.0, 0.0], [0.0; 4]] };

fn error(form: ClosedForm, triangles: usize, jitter: f64, (azimuth, elevation): (f64, f64)) -> ContourDistance {
    let scene = scene(form.mesh(triangles, jitter).unwrap(), camera(azimuth, elevation));
    distance(&found(&scene, &smooth()), &form.visible_contour(&scene))
}

#[test]
fn superquadrics_and_saddles_of_ten_thousand_triangles_are_met_within_a_pixel() {
    let superquadric = ClosedForm::Superquadric { half_axes: DVec3::new(1.0, 0.6, 1.4), power: 4 };
    for form in [superquadric, ClosedForm::Patch(SADDLE)] {
        for view in [(30.0, 15.0), (112.0, 8.0)] {
            let error = error(form, 10_000, 0.2, view);
            assert!(error.hausdorff_px() <= 0.8 && error.mean_px < 0.2, "{form:?} {view:?}: {error:?}");
        }
    }
}

#[test]
fn hills_that_hide_one_another_are_met_but_for_their_ends() {
    for view in [(112.0, 8.0), (-71.0, -12.0), (30.0, 15.0), (5.0, 34.0)] {
        for (jitter, limit_px) in [(0.0, 1.5), (0.2, 2.2)] {
            let error = error(ClosedForm::Patch(Patch::HILLS), 10_000, jitter, view);
            assert!(error.hausdorff_px() <= limit_px && error.mean_px < 0.06, "{view:?} {jitter}: {error:?}");
        }
    }
}

#[test]
fn what_is_seen_of_random_hills_is_what_rays_say() {
    let (mut truth_px, mut near_px, mut drawn_px, mut right_px) = (0.0, 0.0, 0.0, 0.0);
    let mut worst: Vec<(u64, f64)> = Vec::new();
    for number in 1..=20 {
        let form = ClosedForm::Patch(Patch::random(number));
        let scene =
            scene(form.mesh(10_000, 0.1).unwrap(), camera(17.0 * number as f64, 5.0 + (number % 4) as f64 * 9.0));
        let truth: Vec<[DVec2; 2]> = form
            .visible_contour(&scene)
            .iter()
            .flat_map(|line| line.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>())
            .collect();
        let lines = found(&scene, &smooth());
        let seen = |class: Class| {
            let drawn = lines.segments.iter().filter(move |line| line.is_visible && line.class == class);
            drawn.map(|line| line.ends_px).collect::<Vec<[DVec2; 2]>>()
        };
        let (drawn, rims) = (seen(Class::Silhouette), seen(Class::Boundary));
        let within = |point: DVec2, lines: &[[DVec2; 2]]| {
            lines.iter().any(|[a, b]| {
                let along = *b - *a;
                let share = ((point - *a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                point.distance(*a + along * share) <= 1.0
            })
        };
        let share = |lines: &[[DVec2; 2]], others: &[&[[DVec2; 2]]]| {
            let (mut near, mut all) = (0.0, 0.0);
            for [a, b] in lines {
                all += a.distance(*b);
                near += if others.iter().any(|others| within((*a + *b) * 0.5, others)) { a.distance(*b) } else { 0.0 };
            }
            [near, all]
        };
        // Where a contour runs along a rim, the rim is drawn.
        let ([near, all], [right, drawn_length]) = (share(&truth, &[&drawn, &rims]), share(&drawn, &[&truth]));
        worst.push((number, (all - near) + (drawn_length - right)));
        (truth_px, near_px) = (truth_px + all, near_px + near);
        (drawn_px, right_px) = (drawn_px + drawn_length, right_px + right);
    }
    worst.sort_by(|a, b| b.1.total_cmp(&a.1));
    assert!(truth_px > 2_000.0, "{truth_px}");
    let (recall, precision) = (near_px / truth_px, right_px / drawn_px);
    assert!(recall > 0.99 && precision > 0.99, "{recall} {precision}, most wrong: {:?}", &worst[..4]);
}

#[test]
fn a_torus_keeps_its_error_while_its_cusps_come_and_go() {
    let torus = ClosedForm::Torus { ring: 1.0, tube: 0.4 };
    for elevation in [6.0, 12.0, 34.0, 60.0] {
        let error = error(torus, 10_000, 0.0, (11.0, elevation));
        assert!(error.hausdorff_px() <= 0.4, "{elevation}: {error:?}");
    }
}

#[test]
fn noise_of_a_given_size_moves_a_contour_by_little_more() {
    let sphere = ClosedForm::ellipsoid(1.0, 1.0, 1.0);
    let mut state = 7u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    // An edge is about 0.05 long.
    for (noise, limit_px) in [(0.0005, 0.5), (0.002, 1.0)] {
        let mut mesh = sphere.mesh(10_000, 0.2).unwrap();
        mesh.positions.iter_mut().for_each(|position| *position *= 1.0 + noise * random());
        let scene = scene(of_triangles(mesh.positions, &mesh.triangles), camera(30.0, 15.0));
        let lines = found(&scene, &smooth());
        let error = distance(&lines, &sphere.visible_contour(&scene));
        assert!(error.hausdorff_px() <= limit_px, "{noise}: {error:?}");
        assert_eq!(lines.changes.map(|changes| changes.inconsistencies), Some(0));
    }
}

#[test]
fn normals_of_a_file_that_are_wrong_change_nothing() {
    let plain = ClosedForm::Torus { ring: 1.0, tube: 0.4 }.mesh(2_000, 0.0).unwrap();
    let mut wrong = plain.clone();
    assert!(!wrong.normals.is_empty());
    for (number, normal) in wrong.normals.iter_mut().enumerate() {
        *normal = if number % 2 == 0 { -*normal } else { Vec3::X };
    }
    let segments = |mesh: Mesh| found(&scene(mesh, camera(30.0, 15.0)), &smooth()).segments;
    assert_eq!(segments(plain), segments(wrong));
}

/// On flat faces, a machine part's creases are those of the exact rule; on round parts they begin and end elsewhere.
#[test]
fn a_machine_part_keeps_its_creases() {
    let public = std::env::var_os("TINTA_MODELS").map_or_else(|| "../shared/models".into(), PathBuf::from);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(public).join("fandisk.obj");
    if !path.exists() {
        let _ = writeln!(std::io::stderr(), "SKIPPED {}: it is not there", path.display());
        return;
    }
    let mesh = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
    for (azimuth, elevation) in [(30.0, 15.0), (112.0, 38.0), (-71.0, -22.0)] {
        let scene = scene(mesh.clone(), camera(azimuth, elevation));
        let creases = |silhouette| -> f64 {
            let segments = found(&scene, &LineSettings { silhouette, ..LineSettings::default() }).segments;
            let seen = segments.iter().filter(|of| of.is_visible && of.class == Class::Crease);
            seen.map(|of| of.ends_px[0].distance(of.ends_px[1])).sum()
        };
        let [exact, round] = [SilhouetteRule::Exact, SilhouetteRule::Smooth].map(creases);
        assert!((exact - round).abs() <= 0.01 * exact, "{azimuth},{elevation}: {exact} {round} px");
    }
}
