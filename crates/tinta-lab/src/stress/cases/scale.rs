//! Models of any size anywhere: only the shape counts.

use super::case::{Case, Drawing, Group, ROUNDED, looking, viewed};
use crate::stress::{Shape, Study, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;

pub(super) fn cases() -> Vec<Case> {
    let mut all = sizes_and_places();
    let smaller = Shape::CubeAndSmaller(1e6);
    all.push(rendered("a cube and one a million times smaller", Drawing { shape: smaller, ..Drawing::default() }));
    // A hundred thousandth of a unit wide, seen from three away, with the large cube's front behind it. The smaller cube's faces must
    // be seen there by rays and in areas, too, as by GL. One a tenth as wide is hardly wider than the distance at which positions are one.
    let middle = DVec3::new(0.5, 0.5, 1.0 + 1.5e-5);
    let camera = looking(middle + DVec3::new(1.5e-5, 1e-5, 3e-5), middle);
    let camera = CameraSettings { near: Some(1e-5), ..camera };
    let near = Drawing { shape: Shape::CubeAndSmaller(1e5), camera, ..Drawing::default() };
    all.push(rendered("the smaller cube seen from nearby", near).with("lines_px", 100.0, 600.0));
    all.push(rendered("flat in one axis", Drawing { shape: Shape::Flat(12), ..Drawing::default() }));
    let edge_on = Drawing { shape: Shape::Flat(12), camera: viewed("right"), ..Drawing::default() };
    all.push(rendered("flat in one axis, seen edge-on", edge_on));
    let variants = Variant::of_lines();
    let many = Drawing { copies: 2500, study: Study::Picture, variants, ..Drawing::default() };
    all.push(rendered("2500 copies of a cube", many));
    all.extend(parts());
    for (shape, name) in [(Shape::Point, "a single point"), (Shape::Line, "a line"), (Shape::Nothing, "nothing at all")]
    {
        let drawing = Drawing { shape, variants: Variant::of_lines(), ..Drawing::default() };
        all.push(Case::refused(Group::Scale, name, drawing, "model", "no"));
    }
    all
}

/// Parts and solids that are small or thin beside the whole: each with the number of its separate areas.
fn parts() -> Vec<Case> {
    let parts = [
        ("parts a thousandth of their distance in size", Shape::Specks(1e-3), 8.0),
        ("parts a hundred thousandth of their distance in size", Shape::Specks(1e-5), 8.0),
        ("a cube beside one a thousand times smaller", Shape::CubeBesideSmaller(1e3), 2.0),
        ("a cube beside one a hundred thousand times smaller", Shape::CubeBesideSmaller(1e5), 2.0),
        ("a plate 10,000 times as wide as thick", Shape::Solid(1e-4, 1.0), 1.0),
        ("a rod 10,000 times as long as thick", Shape::Solid(1e-4, 1e-4), 1.0),
        ("a triangle 10,000 times as long as high", Shape::Triangle(1e-4), 1.0),
        ("a sheet with 20 folds", Shape::Corrugated(20), 1.0),
        ("a sheet with 500 folds", Shape::Corrugated(500), 1.0),
    ];
    let case = |(name, shape, areas): (&str, Shape, f64)| {
        let camera = if let Shape::Corrugated(_) = shape { viewed("0,20") } else { CameraSettings::default() };
        rendered(name, Drawing { shape, camera, ..Drawing::default() }).with("areas", areas, areas)
    };
    parts.map(case).to_vec()
}

/// Models of any size, and any distance from the origin.
fn sizes_and_places() -> Vec<Case> {
    let gear = Shape::Builtin("builtin:gear");
    let sizes = [(gear, 1e-30), (gear, 1e-6), (gear, 1e6), (gear, 1e30), (Shape::Cube, 1e-58), (Shape::Cube, 1e58)];
    let sized = |(shape, scale): (Shape, f64)| {
        let name = format!("a {} {scale:e} times as large", if shape == gear { "gear" } else { "cube" });
        same(name, Drawing { shape, scale, ..Drawing::default() }, ROUNDED)
    };
    let mut all = sizes.map(sized).to_vec();
    for (scale, words) in [(1e-62, "radius"), (1e61, "scale it down")] {
        let name = format!("a cube {scale:e} times as large");
        all.push(Case::refused(Group::Scale, name, Drawing { scale, ..Drawing::default() }, "model", words));
    }
    // Beyond 1e8 an f64 knows a unit model's coordinates to 1e-8 only, and welding at 1e-7 of its size still holds.
    all.extend([(1e3, ROUNDED), (1e5, ROUNDED), (1e7, ROUNDED), (1e9, 0.01)].map(|(distance, differing)| {
        let drawing = Drawing { shape: gear, offset: DVec3::new(1.0, -0.7, 0.4) * distance, ..Drawing::default() };
        let case = same(format!("a gear {distance:e} units away from the origin"), drawing, differing);
        case.with("far_said", 0.0, 0.0)
    }));
    // All coordinates are whole numbers, but at last numbers are up to an eighth apart, which exact lines cannot know.
    let full = Study::Full;
    let places = [
        (1e4, full, 0.0),
        (1e7, full, 0.0),
        (1e10, full, 0.0),
        (1e14, Study::Picture, 1.0),
        (1e15, Study::Picture, 1.0),
    ];
    all.extend(places.map(|(distance, study, said)| {
        let drawing =
            Drawing { scale: 2.0, offset: DVec3::new(1.0, -1.0, 1.0) * distance, study, ..Drawing::default() };
        rendered(format!("a cube {distance:e} units away from the origin"), drawing).with("far_said", said, said)
    }));
    all
}

fn rendered(name: impl Into<String>, drawing: Drawing) -> Case {
    Case::rendered(Group::Scale, name, drawing)
}

/// Beside the unscaled shape. Its scale is not 1: an unscaled built-in model would bring its normals and materials.
fn same(name: String, drawing: Drawing, differing: f64) -> Case {
    let unit = Drawing { scale: 1.0 + f64::EPSILON, offset: DVec3::ZERO, ..drawing.clone() };
    let case = rendered(name, Drawing { twin: Some(Box::new(unit)), ..drawing });
    case.with("twin_differing", 0.0, differing).with("twin_lines_differing", 0.0, differing)
}
