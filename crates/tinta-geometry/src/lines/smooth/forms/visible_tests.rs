//! Form lines in drawings: hidden parts, connections, counts.

use crate::camera::CameraSettings;
use crate::curvature::shapes::{ball, grid, torus};
use crate::edges::{Class, ClassSet};
use crate::lines::{FormSettings, LineSettings, VisibleLines, chain};
use crate::mesh::{LoadOptions, Mesh};
use crate::scene::{Scene, SceneSettings};
use glam::DVec3;
use std::f64::consts::TAU;

fn seen_from(meshes: Vec<Mesh>, eye: DVec3) -> Scene {
    let camera = CameraSettings {
        eye: Some(eye),
        target: Some(DVec3::ZERO),
        up: Some(DVec3::Y),
        parallel: true,
        height: Some(12.0),
        ..CameraSettings::default()
    };
    Scene::new(meshes, &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
}

fn of(classes: &[Class]) -> LineSettings {
    LineSettings {
        classes: ClassSet::of(classes),
        forms: FormSettings { smoothing: 0.0, ..FormSettings::default() },
        ..LineSettings::default()
    }
}

fn length(lines: &VisibleLines, class: Class, is_visible: bool) -> f64 {
    let wanted = lines.segments.iter().filter(|segment| segment.class == class && segment.is_visible == is_visible);
    wanted.map(|segment| segment.ends_px[0].distance(segment.ends_px[1])).sum()
}

/// Three waves along x over a square of size eight.
fn waves() -> Mesh {
    grid([240, 24], [false; 2], |u, v| {
        let x = (u - 0.5) * 8.0;
        DVec3::new(x, (v - 0.5) * 8.0, 0.4 * (x * TAU / 8.0 * 3.0).cos())
    })
}

#[test]
fn what_a_sheet_covers_of_ridges_and_valleys_is_hidden() {
    let sheet = |z: f64| {
        let corners = [[-5.0, -2.0], [5.0, -2.0], [5.0, 1.0], [-5.0, 1.0]];
        let points = corners.map(|[x, y]| DVec3::new(x, y, z)).to_vec();
        Mesh::of_triangles("a sheet", points, &[[0, 1, 2], [0, 2, 3]], &LoadOptions::default()).unwrap()
    };
    let classes = [Class::Ridge, Class::Valley];
    for (z, covered) in [(3.0, 3.0 / 8.0), (-3.0, 0.0)] {
        let lines = VisibleLines::of(&seen_from(vec![waves(), sheet(z)], DVec3::Z * 20.0), &of(&classes)).unwrap();
        lines.check().unwrap();
        for class in classes {
            let (visible, hidden) = (length(&lines, class, true), length(&lines, class, false));
            assert!((hidden / (visible + hidden) - covered).abs() < 1e-3, "{class:?} {z}: {visible} {hidden}");
        }
        let mut counts = lines.edges;
        assert!(*counts.of(Class::Ridge) > 100 && *counts.of(Class::Suggestive) == 0);
        // Without hidden lines the visible ones are the same.
        let seen = LineSettings { finds_hidden: false, ..of(&classes) };
        let seen = VisibleLines::of(&seen_from(vec![waves(), sheet(z)], DVec3::Z * 20.0), &seen).unwrap();
        for class in classes {
            assert!((length(&seen, class, true) - length(&lines, class, true)).abs() < 1e-6);
        }
    }
}

#[test]
fn lines_hang_together_from_face_to_face() {
    let ellipsoid = ball(24, |point| point * DVec3::new(3.0, 2.0, 1.0));
    let lines =
        VisibleLines::of(&seen_from(vec![ellipsoid], DVec3::new(8.0, -9.0, 12.0)), &of(&[Class::Ridge])).unwrap();
    let paths = chain(&lines.segments);
    // Short segments come and go where the rim passes the contour of the polygons; between these places it is one
    // line.
    for is_visible in [true, false] {
        let lengths = paths.iter().filter(|path| path.is_visible == is_visible).map(|path| path.points_px.len());
        let (longest, all) = lengths.fold((0, 0), |(longest, all), length| (longest.max(length), all + length));
        assert!(longest * 10 > all * 9, "{is_visible}: {longest} of {all}");
    }
    assert!(lines.segments.len() > 60);
}

#[test]
fn every_class_together_is_drawn_and_the_default_is_without_form_lines() {
    let scene = seen_from(vec![torus([80, 40], [3.0, 1.2])], DVec3::new(14.0, 3.0, 6.0));
    let mut settings = LineSettings { classes: ClassSet::ALL, ..of(&[]) };
    settings.forms.strength = 0.0;
    let all = VisibleLines::of(&scene, &settings).unwrap();
    all.check().unwrap();
    assert!(length(&all, Class::Suggestive, true) > 10.0);
    // A pipe bent into a ring has no crest: it is equally round everywhere.
    assert_eq!(length(&all, Class::Ridge, true) + length(&all, Class::Valley, true), 0.0);
    let plain = VisibleLines::of(&scene, &LineSettings::default()).unwrap();
    assert!(plain.segments.iter().all(|segment| ClassSet::EDGES.contains(segment.class)));
    let silhouette = |lines: &VisibleLines| length(lines, Class::Silhouette, true);
    assert_eq!(silhouette(&plain), silhouette(&all));
}

#[test]
fn thresholds_that_are_none_are_refused() {
    let scene = seen_from(vec![waves()], DVec3::Z * 20.0);
    type Change = fn(&mut FormSettings);
    let wrong: [(&str, Change); 3] = [
        ("form-lines", |forms| forms.strength = -1.0),
        ("form-lines", |forms| forms.strength = f64::NAN),
        ("curvature-smoothing", |forms| forms.smoothing = 11.0),
    ];
    for (name, change) in wrong {
        let mut settings = of(&[Class::Ridge]);
        change(&mut settings.forms);
        let refused = VisibleLines::of(&scene, &settings).unwrap_err().to_string();
        assert!(refused.starts_with(name), "{refused}");
    }
}
