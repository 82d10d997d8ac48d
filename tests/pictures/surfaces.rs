//! Textures and colours at vertices under the shading of every style that leaves them to the scene.

use crate::support::lines::view;
use crate::support::{BACKENDS, renderer};
use glam::DVec3;
use std::sync::Arc;
use tempfile::TempDir;
use tinta::picture::MaterialPictures;
use tinta::pixel::{Explainer, Recomputation};
use tinta::scene::{Rectangle, Surface};
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

/// A square that faces the eye under a grey texture of 1,024 texels a side.
fn textured_square(texel: impl Fn(usize, usize) -> u8, side_px: u32) -> (Scene, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let texels = (0..1024 * 1024).map(|place| texel(place % 1024, place / 1024));
    let picture: Vec<u8> = b"P6 1024 1024 255\n".iter().copied().chain(texels.flat_map(|grey| [grey; 3])).collect();
    let model = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
    for (name, bytes) in [("a.obj", model.as_bytes()), ("m.mtl", b"newmtl m\nmap_Kd t.ppm\n"), ("t.ppm", &picture)] {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let mesh = load(folder.path().join("a.obj").to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
    let size = Size { width: side_px, height: side_px };
    (Scene::new([mesh], &SceneSettings { size, ..settings(Surface::Textured) }).unwrap(), folder)
}

#[test]
fn a_texture_finer_than_the_pixels_is_averaged_and_explained_so() {
    let checker = |x: usize, y: usize| if (x + y).is_multiple_of(2) { 255 } else { 1 };
    // One of seven is light; their mean is 128, too.
    let of_seven = |at: usize| if at.is_multiple_of(7) { 236 } else { 110 };
    let (white, _folder) = textured_square(|_, _| 255, 100);
    for (name, (scene, _folder)) in [
        ("checker", textured_square(checker, 100)),
        ("columns", textured_square(|x, _| of_seven(x), 100)),
        ("rows", textured_square(|_, y| of_seven(y), 100)),
    ] {
        for style in [StyleName::ThreePass, StyleName::Phong].map(Style::named) {
            let mut drawer = renderer(BACKENDS[0]);
            let [lit, drawn] = [&white, &scene].map(|scene| drawer.render(scene, &style).unwrap());
            // In the light of the pixel.
            let at = |place: i64| (20 + place % 60, 20 + place / 60);
            let share = |(x, y)| f64::from(drawn.pixel(x, y)[0]) * 255.0 / f64::from(lit.pixel(x, y)[0]);
            let greys: Vec<f64> = (0..3600).map(|place| share(at(place))).collect();
            let mean = greys.iter().sum::<f64>() / 3600.0;
            let deviation = (greys.iter().map(|grey| (grey - mean).powi(2)).sum::<f64>() / 3600.0).sqrt();
            assert!((mean - 128.0).abs() < 2.0 && deviation < 6.0, "{name} {}: {mean} {deviation}", style.name());
            // The same texels where it is recomputed.
            let plan = style.plan(&scene, Show::Final).unwrap();
            let part = Rectangle { x: 0, y: 0, width: 100, height: 100 };
            let values = drawer.step_values(&scene, &plan, part).unwrap();
            let how = Recomputation::like(drawer.context());
            let explainer = Explainer::new(&scene, &plan, &values, how).unwrap();
            for place in (0..3600).step_by(61) {
                let (x, y) = at(place);
                for step in explainer.pixel([x as u32, y as u32], true).unwrap() {
                    assert!(step.difference.is_none_or(|difference| difference < 1.01), "{name}: {x},{y}");
                }
            }
        }
    }
}

#[test]
fn a_texture_keeps_one_to_two_texels_a_pixel_where_it_is_shown_largest() {
    for side in [20, 50, 100, 200, 333, 700, 1500] {
        let (scene, _folder) = textured_square(|x, _| x as u8, side);
        let mut pictures = MaterialPictures::default();
        pictures.prepare(&scene, Some(scene.size)).unwrap();
        let texels = f64::from(pictures.of(&scene.objects[0], 0).unwrap().size.width);
        let px = f64::from(side) * 0.92;
        let is_fine = texels == 1024.0 || texels > px * 0.999;
        assert!(is_fine && texels < 2.001 * px, "{side}: {texels} texels at {px} px");
    }
}
