//! Textures and colours at vertices under the shading of every style that leaves them to the scene.

use crate::support::lines::view;
use crate::support::{BACKENDS, renderer};
use glam::DVec3;
use std::sync::Arc;
use tinta::scene::Surface;
use tinta::{Color, LoadOptions, Mesh, Picture, Scene, SceneSettings, Show, Size, Style, StyleName, load};

/// Styles that use the scene's colours.
const STYLES: [StyleName; 6] =
    [StyleName::ThreePass, StyleName::TwoPass, StyleName::Mrt, StyleName::Phong, StyleName::Ink, StyleName::Charcoal];

fn settings(surface: Surface) -> SceneSettings {
    let camera = view("front", true);
    SceneSettings { size: Size { width: 40, height: 40 }, camera, surface, ..SceneSettings::default() }
}

/// A square that faces the eye, with a colour at each corner; white bare surfaces.
fn square(colors: Vec<[f32; 3]>, surface: Surface) -> Scene {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let mut mesh = Mesh::of_triangles("square", corners, &[[0, 1, 2], [0, 2, 3]], &LoadOptions::default()).unwrap();
    mesh.position_colors = colors;
    let white = Color([1.0; 3]);
    Scene::new([mesh], &SceneSettings { bare_color: white, ..settings(surface) }).unwrap()
}

/// The middle pixel, which every style shades alike in any colour.
fn middle(picture: &Picture) -> [u8; 4] {
    picture.pixel(20, 20)
}

#[test]
fn a_colour_at_all_vertices_is_multiplied_with_the_shading() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for name in STYLES {
            let style = Style::named(name);
            let mut drawn = |colors: &[[f32; 3]], surface| {
                let picture = renderer.render(&square(colors.to_vec(), surface), &style).unwrap();
                middle(&picture)
            };
            let shading = drawn(&[], Surface::Plain);
            let colored = drawn(&[[1.0, 0.5, 0.0]; 4], Surface::Textured);
            let expected = [f64::from(shading[0]), f64::from(shading[1]) * 0.5, 0.0];
            for (found, expected) in colored.into_iter().zip(expected) {
                assert!((f64::from(found) - expected).abs() <= 1.0, "{name:?}: {colored:?} of {shading:?}");
            }
            // Left out by default.
            assert_eq!(drawn(&[[1.0, 0.5, 0.0]; 4], Surface::Plain), shading, "{name:?}");
        }
    }
}

#[test]
fn colours_are_mixed_between_vertices() {
    for backend in *BACKENDS {
        let black_to_white = vec![[0.0; 3], [1.0; 3], [1.0; 3], [0.0; 3]];
        let scene = square(black_to_white, Surface::Textured);
        let picture = renderer(backend).render(&scene, &Style::named(StyleName::ThreePass)).unwrap();
        let row: Vec<u8> = (6..34).map(|x| picture.pixel(x, 20)[0]).collect();
        assert!(row.windows(2).all(|pair| pair[0] < pair[1]), "{row:?}");
    }
}

#[test]
fn what_is_left_out_is_said_and_a_plain_scene_draws_what_it_drew() {
    let soldier = Arc::new(load("builtin:soldier", &LoadOptions::default()).unwrap().mesh);
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for name in STYLES {
            let style = Style::named(name);
            let [plain, textured] = [Surface::Plain, Surface::Textured]
                .map(|surface| Scene::new([soldier.clone()], &settings(surface)).unwrap());
            assert!(style.remarks(&plain)[0].contains("--surface textured"), "{name:?}");
            assert!(style.remarks(&textured).is_empty(), "{name:?}");
            let steps = |scene: &Scene| style.plan(scene, Show::Final).unwrap().steps().count();
            assert!(name == StyleName::Mrt || steps(&textured) == steps(&plain) + 1, "{name:?}");
            assert!(
                renderer.render(&plain, &style).unwrap() != renderer.render(&textured, &style).unwrap(),
                "{name:?}"
            );
        }
    }
}
