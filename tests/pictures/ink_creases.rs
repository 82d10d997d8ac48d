//! Creases of `ink` by planes and by normals.

use crate::support::{BACKENDS, ball, renderer};
use std::sync::Arc;
use tinta::edges::CreaseAngle;
use tinta::mesh::Normals;
use tinta::styles::{CreaseBy, Ink, LineWidth};
use tinta::{LoadOptions, Picture, Scene, SceneSettings, Show, Size, Style, load};

fn ink(crease_by: CreaseBy, width_px: u32) -> Style {
    Style::Ink(Ink {
        crease_by,
        line_width: LineWidth::Pixels(width_px),
        crease_angle: CreaseAngle::from_degrees(40.0).unwrap(),
        ..Ink::default()
    })
}

fn lines(scene: &Scene, style: &Style, backend: tinta::Backend) -> Picture {
    renderer(backend).draw(scene, &style.plan(scene, Show::Borders).unwrap()).unwrap()
}

fn inked(picture: &Picture) -> usize {
    picture.pixels.chunks_exact(4).filter(|pixel| pixel[1] == 0).count()
}

fn built_in(model: &str, normals: Normals) -> Scene {
    let options = LoadOptions { normals, smooth_angle_degrees: 40.0, ..LoadOptions::default() };
    let settings = SceneSettings { size: Size { width: 300, height: 240 }, ..SceneSettings::default() };
    Scene::new(vec![Arc::new(load(model, &options).unwrap().mesh)], &settings).unwrap()
}

#[test]
fn flat_faces_have_the_same_creases_by_normals_as_by_planes() {
    for backend in *BACKENDS {
        for model in ["builtin:open-box", "builtin:gear"] {
            let scene = built_in(model, Normals::Lasting);
            for width_px in [2, 5] {
                let [planes, normals] =
                    [CreaseBy::Planes, CreaseBy::Normals].map(|by| lines(&scene, &ink(by, width_px), backend));
                let difference = planes.difference(&normals).unwrap().pixels;
                let share = difference as f64 / inked(&planes) as f64;
                assert!(inked(&planes) > 1000 && share < 0.04, "{model} {width_px}: {share}");
            }
        }
    }
}

#[test]
fn a_smooth_ball_of_few_triangles_has_an_outline_only_by_its_normals() {
    // 20 triangles that meet at 42 degrees.
    let scene = ball(0);
    let [planes, normals] = [CreaseBy::Planes, CreaseBy::Normals].map(|by| lines(&scene, &ink(by, 2), BACKENDS[0]));
    let within = |picture: &Picture| {
        let places = (0..256 * 256).map(|n| (n % 256, n / 256));
        let middle = places.filter(|(x, y)| (x - 128) * (x - 128) + (y - 128) * (y - 128) < 70 * 70);
        middle.filter(|(x, y)| picture.pixel(*x, *y)[1] == 0).count()
    };
    assert!(within(&planes) > 500, "{}", within(&planes));
    assert_eq!(within(&normals), 0);
    assert!(inked(&normals) > 500);
}
