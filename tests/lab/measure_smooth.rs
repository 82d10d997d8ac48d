//! `tinta measure --against smooth`: surfaces in closed form, their references and how settings converge.

use crate::program::{refused_in_one_line, said, tinta};
use crate::support::Folder;
use glam::DVec2;
use tinta::lines::closed_forms::ClosedForm;
use tinta::mesh::builtin;
use tinta::{CameraSettings, LineSettings, LoadOptions, Scene, SceneSettings, View, load};
use tinta_lab::measure::{Against, Reference, Row};
use tinta_lab::report::curves;

fn scene(model: &str, camera: CameraSettings) -> Scene {
    let mesh = std::sync::Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
    Scene::new(vec![mesh], &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
}

#[test]
fn the_contour_of_a_sphere_from_afar_is_a_circle_of_its_radius() {
    let camera = CameraSettings { parallel: true, ..CameraSettings::default() };
    let scene = scene("builtin:sphere:500", camera);
    let sphere = builtin("builtin:sphere").unwrap().unwrap().builtin.closed_form().unwrap();
    let reference = Reference::of_surface(&scene, &sphere).unwrap();
    assert_eq!(reference.against, Against::Smooth);
    let middle = DVec2::splat(256.0);
    let radii: Vec<f64> = reference.samples.iter().map(|sample| sample.px.distance(middle)).collect();
    let (low, high) =
        radii.iter().fold((f64::MAX, 0.0f64), |(low, high), radius| (low.min(*radius), high.max(*radius)));
    assert!(high - low < 0.01, "{low} {high}");
    assert!((reference.length_px() - std::f64::consts::TAU * high).abs() < 0.1);
    // The mesh's own outline lies within it, and its lines are other ones.
    let lines = Reference::of(&scene, &LineSettings::as_published()).unwrap();
    assert_eq!(lines.against, Against::Lines);
    let farthest = lines.samples.iter().map(|sample| reference.distance_px(sample.px)).fold(0.0, f64::max);
    assert!((0.5..12.0).contains(&farthest), "{farthest}");
}

#[test]
fn rims_of_an_open_surface_count_as_little_as_soft_creases() {
    let view = View { azimuth_degrees: 0.0, elevation_degrees: 60.0 };
    let scene = scene("builtin:patch:2000", CameraSettings { view, ..CameraSettings::default() });
    let patch = builtin("builtin:patch").unwrap().unwrap().builtin.closed_form().unwrap();
    let reference = Reference::of_surface(&scene, &patch).unwrap();
    let lines = Reference::of(&scene, &LineSettings::as_published()).unwrap();
    let rims: Vec<DVec2> = lines
        .samples
        .iter()
        .filter(|sample| sample.class == tinta::edges::Class::Boundary)
        .map(|sample| sample.px)
        .collect();
    assert!(rims.len() > 1000);
    assert!(rims.iter().all(|px| reference.distance_to_ignored_px(*px) < 0.5));
}

#[test]
fn built_in_surfaces_have_about_as_many_triangles_as_they_are_asked_for() {
    for (name, count) in [
        ("sphere", 500),
        ("ellipsoid:2000", 2_000),
        ("torus", 10_000),
        ("superquadric:100", 100),
        ("patch:5000", 5_000),
    ] {
        let count = if name == "sphere" { 10_000 } else { count };
        let mesh = load(&format!("builtin:{name}"), &LoadOptions::default()).unwrap().mesh;
        let share = mesh.triangles.len() as f64 / f64::from(count);
        assert!((0.85..1.25).contains(&share), "{name}: {}", mesh.triangles.len());
    }
    assert!(matches!(builtin("builtin:torus").unwrap().unwrap().builtin.closed_form(), Some(ClosedForm::Torus { .. })));
    assert!(builtin("torus").is_none());
    let refused = |name: &str, what: &[&str]| refused_in_one_line(&["render", name, "-o", "never.png"], what);
    refused("builtin:torus:5", &["builtin:torus:5", "100", "4000000", "builtin:torus:10000"]);
    refused("builtin:torus:many", &["builtin:torus:10000"]);
    refused("builtin:bust:100", &["builtin:bust"]);
    refused("builtin:tours", &["did you mean builtin:torus?"]);
}

#[test]
fn exact_lines_of_a_sphere_converge_and_ink_stays_on_its_pixels() {
    let folder = Folder::new();
    let out = folder.path("converges");
    let base = ["measure", "builtin:sphere:500", "builtin:sphere:4000", "--against", "smooth", "-o", &out];
    let run = |more: &[&str]| {
        tinta(
            &[&base[..], &["--quick", "--size", "160", "--frames", "1", "--styles", "three-pass,inking"], more]
                .concat(),
        )
    };
    let output = run(&[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = std::fs::read_to_string(format!("{out}/results.jsonl")).unwrap();
    let rows: Vec<Row> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(rows.iter().flat_map(|row| &row.lines).all(|lines| lines.against == Against::Smooth));
    let curves = curves(&rows.iter().collect::<Vec<_>>());
    let curve = |name: &str| {
        curves.iter().find(|curve| curve.name.ends_with(name)).unwrap_or_else(|| panic!("{name}: {curves:?}"))
    };
    for name in ["lines: classes silhouette, silhouette smooth", "lines: classes silhouette, silhouette exact"] {
        let curve = curve(name);
        let order = curve.order().unwrap();
        assert!(curve.points[1].1 < 0.2 && order > 1.6, "{name}: {:?}, order {order}", curve.points);
    }
    for name in ["inking: silhouette smooth", "three-pass"] {
        let error = curve(name).points[1].1;
        assert!((0.2..1.0).contains(&error), "{name}: {error}");
    }
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(page.contains("smooth surfaces in closed form") && page.contains("Convergence on the sphere"));
    assert!(std::fs::metadata(format!("{out}/plot-convergence-sphere.svg")).unwrap().len() > 2000);
    // The same folder takes no rows of another yardstick, and repeating a complete run adds none.
    let rest = ["-o", out.as_str(), "--quick", "--size", "160", "--frames", "1", "--resume"];
    refused_in_one_line(&[&["measure", "builtin:sphere:500"], &rest[..]].concat(), &["--against"]);
    assert_eq!(run(&["--resume"]).status.code(), Some(0));
    assert_eq!(std::fs::read_to_string(format!("{out}/results.jsonl")).unwrap(), text);
}

#[test]
fn what_has_no_closed_form_is_refused() {
    let folder = Folder::new();
    let out = folder.path("never");
    refused_in_one_line(
        &["measure", "builtin:bust", "--against", "smooth", "-o", &out],
        &["builtin:bust", "builtin:torus", "--against"],
    );
    refused_in_one_line(&["measure", "builtin:torus", "--against", "smooth", "--up", "z", "-o", &out], &["--up"]);
    refused_in_one_line(&["measure", "builtin:torus", "--against", "rough", "-o", &out], &["lines", "smooth"]);
}
