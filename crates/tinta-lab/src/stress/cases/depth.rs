//! Planes far apart, angles near their ends, eyes where no eye should be.

use super::case::{Case, Drawing, Group};
use crate::stress::{Shape, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;
use tinta::styles::{Border, Cartoon, MapEncoding, Style, StyleName};

pub(super) fn cases() -> Vec<Case> {
    let mut all = far_and_near();
    let camera =
        |eye: DVec3, target: DVec3| CameraSettings { eye: Some(eye), target: Some(target), ..Default::default() };
    let middle = DVec3::splat(0.5);
    let cube = |camera| Drawing { camera, ..Drawing::default() };
    for degrees in [0.1, 1.0, 150.0, 179.0] {
        let settings = CameraSettings { fov_y_degrees: degrees, ..CameraSettings::default() };
        all.push(rendered(format!("a field of view of {degrees} degrees"), cube(settings)));
    }
    for degrees in [0.0, 180.0, f64::NAN, 1e-4] {
        let settings = CameraSettings { fov_y_degrees: degrees, ..CameraSettings::default() };
        let name = format!("a field of view of {degrees} degrees");
        all.push(Case::refused(Group::Depth, name, cube(settings), "setting", "--fov"));
    }
    let places = [
        ("the eye on a vertex", DVec3::ONE, middle),
        ("the eye on an edge", DVec3::new(0.5, 1.0, 1.0), middle),
        ("the eye on a face", DVec3::new(0.5, 0.5, 1.0), DVec3::new(0.5, 0.4, 0.0)),
        ("the eye inside", middle, DVec3::new(0.4, 0.45, 0.0)),
        ("the eye in the plane of a face", DVec3::new(1.0, 0.3, 5.0), middle),
        ("the eye in the planes of two faces", DVec3::new(1.0, 1.0, 4.0), middle),
        ("the eye on the line of an edge", DVec3::new(1.0, 1.0, 5.0), DVec3::new(1.0, 1.0, 0.0)),
        ("the eye 19000 radii away", DVec3::new(0.5, 0.5, 16_000.0), middle),
    ];
    for (name, eye, target) in places {
        all.push(rendered(name.to_owned(), cube(camera(eye, target))));
    }
    all.extend(empty());
    let far_away = camera(DVec3::new(0.5, 0.5, 1e6), middle);
    all.push(Case::refused(Group::Depth, "the eye a million radii away", cube(far_away), "setting", "--eye"));
    let same = camera(middle, middle);
    all.push(Case::refused(Group::Depth, "the eye at its target", cube(same), "setting", "same point"));
    let through = CameraSettings { near: Some(0.6), ..camera(DVec3::new(0.7, 0.8, 1.5), middle) };
    all.push(rendered("edges through the near plane".to_owned(), cube(through)));
    let slice = CameraSettings { near: Some(3.9), far: Some(3.900_001), ..camera(DVec3::new(0.5, 0.5, 4.5), middle) };
    all.push(rendered("planes a millionth of a unit apart".to_owned(), cube(slice)));
    let crossed = CameraSettings { near: Some(3.0), far: Some(2.0), ..camera(DVec3::new(0.5, 0.5, 4.5), middle) };
    all.push(Case::refused(Group::Depth, "near beyond far", cube(crossed), "setting", "--near"));
    let parallel = CameraSettings { parallel: true, ..camera(DVec3::new(1.0, 0.5, 5.0), DVec3::new(1.0, 0.5, 0.0)) };
    all.push(rendered("in parallel, two faces edge-on".to_owned(), cube(parallel)));
    all
}

/// A far plane ever farther beyond the near one.
fn far_and_near() -> Vec<Case> {
    let mut all = Vec::new();
    for ratio in [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9] {
        let camera = CameraSettings {
            eye: Some(DVec3::new(1.4, 1.6, 2.6)),
            target: Some(DVec3::splat(0.5)),
            near: Some(8.0 / ratio),
            far: Some(8.0),
            ..CameraSettings::default()
        };
        let drawing = Drawing { shape: Shape::Contact, camera, variants: encodings(), ..Drawing::default() };
        let name = format!("far {ratio:e} times as far as near");
        all.push(match ratio <= 1e5 {
            // Normals show these cubes' edges; the cubes behind must not show through.
            true => rendered(name, drawing).with("precision", 0.95, 1.0),
            false => Case::refused(Group::Depth, name, drawing, "setting", "--near"),
        });
    }
    for ratio in [1.3, 3.0, 10.0, 1e2, 1e3, 1e4, 1e5] {
        let camera = CameraSettings {
            eye: Some(DVec3::new(1.0, 0.5, 4.0)),
            target: Some(DVec3::new(1.0, 0.5, 0.0)),
            near: Some(4.6 / ratio),
            far: Some(4.6),
            ..CameraSettings::default()
        };
        let drawing = Drawing { shape: Shape::Terraces, camera, variants: encodings(), ..Drawing::default() };
        let name = format!("steps in depth, far {ratio:e} times as far as near");
        all.push(match ratio <= 1e4 {
            true => rendered(name, drawing),
            false => Case::refused(Group::Depth, name, drawing, "setting", "--near"),
        });
    }
    all
}

/// Pictures in which nothing is seen, which the program says.
fn empty() -> Vec<Case> {
    let (front, middle) = (DVec3::new(0.5, 0.5, 5.0), DVec3::splat(0.5));
    let looking = |target| CameraSettings { eye: Some(front), target: Some(target), ..CameraSettings::default() };
    let planes = |near, far| CameraSettings { near: Some(near), far: Some(far), ..looking(middle) };
    let cameras = [
        ("everything behind the eye", looking(DVec3::new(0.5, 0.5, 9.0))),
        ("everything beside the picture", looking(DVec3::new(90.0, 0.5, 4.0))),
        ("everything before the near plane", planes(100.0, 200.0)),
        ("everything beyond the far plane", planes(1.0, 2.0)),
    ];
    let said = |(name, camera): (&str, CameraSettings)| {
        rendered(name.to_owned(), Drawing { camera, ..Drawing::default() }).with("empty_said", 1.0, 1.0)
    };
    cameras.into_iter().map(said).collect()
}

fn rendered(name: String, drawing: Drawing) -> Case {
    Case::rendered(Group::Depth, name, drawing)
}

/// The three passes with every encoding of the map, with the filter as published and with the one that knows the precision of a
/// depth, and the styles with separate depth.
fn encodings() -> Vec<Variant> {
    let filters = [("", false), ("--slope-threshold on ", true)];
    let three_passes = filters.iter().flat_map(|(option, slope_threshold)| {
        // A map of numbers has no depth.
        let with_depth = MapEncoding::ALL.iter().filter(|(_, encoding)| *encoding != MapEncoding::Numbers);
        with_depth.map(move |(name, encoding)| {
            let border = Border { detection_factor: 1.0, slope_threshold: *slope_threshold, ..Border::default() };
            let cartoon = Cartoon { border: Some(border), map_encoding: *encoding, ..Cartoon::default() };
            let name = format!("three-pass --detection-factor 1 {option}--map-encoding {name}");
            Variant::new(name, Style::ThreePass(cartoon))
        })
    });
    three_passes.chain([Variant::published(StyleName::Ink), Variant::exact_inking()]).collect()
}
