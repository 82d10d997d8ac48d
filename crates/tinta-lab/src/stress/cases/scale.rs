//! Models of any size anywhere: only the shape counts.

use super::case::{Case, Drawing, Group};
use crate::stress::{Shape, Study, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;

/// Share of the pixels that may differ from the picture of the unscaled model: its coordinates round differently, and an edge
/// that passes a pixel's middle by less than that falls on its other side.
const ROUNDED: f64 = 0.002;

pub(super) fn cases() -> Vec<Case> {
    let mut all = sizes_and_places();
    let smaller = Shape::CubeAndSmaller(1e6);
    all.push(rendered(
        "a cube and one a million times smaller".to_owned(),
        Drawing { shape: smaller, ..Drawing::default() },
    ));
    // A millionth of a unit wide, seen from three millionths away, with the large cube's front behind it.
    let middle = DVec3::new(0.5, 0.5, 1.0 + 1.5e-6);
    let camera = CameraSettings {
        eye: Some(middle + DVec3::new(1.5e-6, 1e-6, 3e-6)),
        target: Some(middle),
        near: Some(1e-6),
        ..CameraSettings::default()
    };
    let near = Drawing { shape: smaller, camera, ..Drawing::default() };
    all.push(rendered("the smaller cube seen from nearby".to_owned(), near).with("lines_px", 100.0, 600.0));
    all.push(rendered("flat in one axis".to_owned(), Drawing { shape: Shape::Flat(12), ..Drawing::default() }));
    let edge_on =
        CameraSettings { view: "right".parse().unwrap_or(CameraSettings::default().view), ..Default::default() };
    all.push(rendered(
        "flat in one axis, seen edge-on".to_owned(),
        Drawing { shape: Shape::Flat(12), camera: edge_on, ..Drawing::default() },
    ));
    let many = Drawing {
        shape: Shape::Cube,
        copies: 2500,
        study: Study::Picture,
        variants: Variant::of_lines(),
        ..Drawing::default()
    };
    all.push(rendered("2500 copies of a cube".to_owned(), many));
    for (shape, name) in [(Shape::Point, "a single point"), (Shape::Line, "a line"), (Shape::Nothing, "nothing at all")]
    {
        let drawing = Drawing { shape, variants: Variant::of_lines(), ..Drawing::default() };
        all.push(Case::refused(Group::Scale, name, drawing, "model", "no"));
    }
    all
}

/// Models of any size, and any distance from the origin.
fn sizes_and_places() -> Vec<Case> {
    let mut all = Vec::new();
    for scale in [1e-30, 1e-6, 1e6, 1e30] {
        let drawing = compared(Drawing { shape: Shape::Builtin("builtin:gear"), scale, ..Drawing::default() });
        let case = rendered(format!("a gear {scale:e} times as large"), drawing);
        all.push(case.with("twin_differing", 0.0, ROUNDED).with("twin_lines_differing", 0.0, ROUNDED));
    }
    for scale in [1e-58, 1e58] {
        let drawing = compared(Drawing { shape: Shape::Cube, scale, ..Drawing::default() });
        all.push(rendered(format!("a cube {scale:e} times as large"), drawing).with("twin_differing", 0.0, ROUNDED));
    }
    for (scale, kind, words) in [(1e-62, "model", "radius"), (1e61, "model", "scale it down")] {
        let drawing = Drawing { shape: Shape::Cube, scale, ..Drawing::default() };
        let name = format!("a cube {scale:e} times as large");
        all.push(Case::refused(Group::Scale, name, drawing, kind, words));
    }
    // Beyond 1e8 an f64 knows a unit model's coordinates to 1e-8 only, and welding at 1e-7 of its size still holds.
    for (distance, differing) in [(1e3, ROUNDED), (1e5, ROUNDED), (1e7, ROUNDED), (1e9, 0.01)] {
        let offset = DVec3::new(1.0, -0.7, 0.4) * distance;
        let drawing = compared(Drawing { shape: Shape::Builtin("builtin:gear"), offset, ..Drawing::default() });
        let case = rendered(format!("a gear {distance:e} units away from the origin"), drawing);
        let case = case.with("twin_differing", 0.0, differing).with("twin_lines_differing", 0.0, differing);
        all.push(case.with("far_said", 0.0, 0.0));
    }
    // All coordinates are whole numbers, but numbers there are up to an eighth apart, which exact lines cannot know.
    for distance in [1e14, 1e15] {
        let offset = DVec3::new(1.0, -1.0, 1.0) * distance;
        let drawing = Drawing { shape: Shape::Cube, scale: 2.0, offset, study: Study::Picture, ..Drawing::default() };
        all.push(
            rendered(format!("a cube {distance:e} units away from the origin"), drawing).with("far_said", 1.0, 1.0),
        );
    }
    all
}

fn rendered(name: String, drawing: Drawing) -> Case {
    Case::rendered(Group::Scale, name, drawing)
}

/// Beside the unscaled shape. Its scale is not 1: an unscaled built-in model would bring its normals and materials.
fn compared(drawing: Drawing) -> Drawing {
    let unit = Drawing { scale: 1.0 + f64::EPSILON, offset: DVec3::ZERO, ..drawing.clone() };
    Drawing { twin: Some(Box::new(unit)), ..drawing }
}
