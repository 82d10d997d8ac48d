//! Planes far apart, angles near their ends, eyes where no eye should be.

use super::case::{Case, Drawing, Group, looking};
use crate::stress::{Shape, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;
use tinta::styles::{Border, Cartoon, MapEncoding, Style, StyleName};

pub(super) fn cases() -> Vec<Case> {
    let mut all = far_and_near();
    let middle = DVec3::splat(0.5);
    let cube = |camera| Drawing { camera, ..Drawing::default() };
    let field = |degrees: f64| {
        let settings = CameraSettings { fov_y_degrees: degrees, ..CameraSettings::default() };
        (format!("a field of view of {degrees} degrees"), cube(settings))
    };
    all.extend([0.1, 1.0, 150.0, 179.0].map(field).map(|(name, drawing)| rendered(name, drawing)));
    let beyond = [0.0, 180.0, f64::NAN, 1e-4].map(field);
    all.extend(beyond.map(|(name, drawing)| Case::refused(Group::Depth, name, drawing, "setting", "--fov")));
    let front = DVec3::new(0.5, 0.5, 4.5);
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
    all.extend(places.map(|(name, eye, target)| rendered(name, cube(looking(eye, target)))));
    all.extend(empty());
    let planes = |near, far, camera| CameraSettings { near, far, ..camera };
    // The cube's nearest corner is 3.45207 units before this eye.
    let eye = DVec3::new(2.9, 2.6, 3.4);
    let drawn = [
        ("edges through the near plane", planes(Some(0.6), None, looking(DVec3::new(0.7, 0.8, 1.5), middle))),
        ("planes a millionth of a unit apart", planes(Some(3.9), Some(3.900_001), looking(front, middle))),
        ("a near plane a ten thousandth before the cube", planes(Some(3.4517), None, looking(eye, middle))),
        ("a near plane a hundredth of a unit before the eye", planes(Some(0.01), Some(10.0), looking(eye, middle))),
    ];
    all.extend(drawn.map(|(name, camera)| rendered(name, cube(camera))));
    // The default near plane, a thousandth of the far plane's distance, would cut this box.
    let near = |near| Drawing {
        shape: Shape::OnAFloor,
        camera: planes(near, None, looking(DVec3::new(0.1, 1.2, 0.4), DVec3::new(0.0, 0.9, 0.2))),
        ..Drawing::default()
    };
    let own = Drawing { twin: Some(Box::new(near(Some(0.05)))), ..near(None) };
    all.push(rendered("the eye close to a box on a wide floor", own).with("twin_lines_differing", 0.0, 0.0));
    let refused = [
        ("the eye a million radii away", looking(DVec3::new(0.5, 0.5, 1e6), middle), "--eye"),
        ("the eye at its target", looking(middle, middle), "same point"),
        ("near beyond far", planes(Some(3.0), Some(2.0), looking(front, middle)), "--near"),
    ];
    all.extend(refused.map(|(name, camera, words)| Case::refused(Group::Depth, name, cube(camera), "setting", words)));
    let parallel = looking(DVec3::new(1.0, 0.5, 5.0), DVec3::new(1.0, 0.5, 0.0));
    all.push(rendered("in parallel, two faces edge-on", cube(CameraSettings { parallel: true, ..parallel })));
    all
}

/// A far plane ever farther beyond the near one.
fn far_and_near() -> Vec<Case> {
    let of = |name: String, drawing: Drawing, is_refused: bool| match is_refused {
        true => Case::refused(Group::Depth, name, drawing, "setting", "--near"),
        false => rendered(name, drawing),
    };
    let contact = |ratio: f64| {
        let camera = looking(DVec3::new(1.4, 1.6, 2.6), DVec3::splat(0.5));
        let camera = CameraSettings { near: Some(8.0 / ratio), far: Some(8.0), ..camera };
        let drawing = Drawing { shape: Shape::Contact, camera, variants: encodings(), ..Drawing::default() };
        let case = of(format!("far {ratio:e} times as far as near"), drawing, ratio > 1e5);
        // Normals show these cubes' edges; the cubes behind must not show through.
        if ratio > 1e5 { case } else { case.with("precision", 0.95, 1.0) }
    };
    let steps = |ratio: f64| {
        let name = format!("steps in depth, far {ratio:e} times as far as near");
        of(name, terraces(ratio, encodings()), ratio > 1e4)
    };
    let mut all = [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9].map(contact).to_vec();
    all.extend([1.3, 3.0, 10.0, 1e2, 1e3, 1e4, 1e5].map(steps));
    all
}

/// Distance of the far plane of [`terraces`], file units.
pub(super) const FAR: f64 = 4.6;

/// [`Shape::Terraces`] from the front, the far plane so many times as far as the near one.
pub(super) fn terraces(ratio: f64, variants: Vec<Variant>) -> Drawing {
    let camera = looking(DVec3::new(1.0, 0.5, 4.0), DVec3::new(1.0, 0.5, 0.0));
    let camera = CameraSettings { near: Some(FAR / ratio), far: Some(FAR), ..camera };
    Drawing { shape: Shape::Terraces, camera, variants, ..Drawing::default() }
}

/// Empty pictures, of which the program tells.
fn empty() -> Vec<Case> {
    let (front, middle) = (DVec3::new(0.5, 0.5, 5.0), DVec3::splat(0.5));
    let planes = |near, far| CameraSettings { near: Some(near), far: Some(far), ..looking(front, middle) };
    let cameras = [
        ("everything behind the eye", looking(front, DVec3::new(0.5, 0.5, 9.0))),
        ("everything beside the picture", looking(front, DVec3::new(90.0, 0.5, 4.0))),
        ("everything before the near plane", planes(100.0, 200.0)),
        ("everything beyond the far plane", planes(1.0, 2.0)),
    ];
    let said = |(name, camera): (&str, CameraSettings)| {
        rendered(name, Drawing { camera, ..Drawing::default() }).with("empty_said", 1.0, 1.0)
    };
    cameras.into_iter().map(said).collect()
}

fn rendered(name: impl Into<String>, drawing: Drawing) -> Case {
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
