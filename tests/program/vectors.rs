//! Cartoons as vectors: a renderer that is not ours draws their SVG, and each pixel beside no border is that of the style by OpenGL.

use crate::program::done;
use crate::rendered::rendered;
use crate::support::{BACKENDS, public_meshes, renderer, scene_with};
use std::sync::Arc;
use tinta::lines::{
    Areas, FillGroup, JoinKey, Progress, Regions, SeenNormals, Sight, first_hits, painted, svg_of_paths,
};
use tinta::mesh::Normals;
use tinta::styles::{Cartoon, FarLight, Ink, LineStyle, Tones};
use tinta::{
    Background, CameraSettings, Color, DrawingSettings, LoadOptions, Picture, Scene, SceneSettings, Size, Style,
    VisibleLines, load,
};

/// The areas of a style as SVG.
fn areas(scene: &Scene, style: &Style) -> String {
    let lines = VisibleLines::none(scene.size);
    let areas =
        style.vectors(scene.size).unwrap().areas(&Sight::of(scene), &lines, &Progress::default()).unwrap().unwrap();
    svg_of(scene, areas.drawn)
}

fn of_fills(fills: Vec<FillGroup>) -> Areas {
    Areas { fills, ..Areas::default() }
}

/// Areas alone as SVG.
fn svg_of(scene: &Scene, areas: Areas) -> String {
    let settings = DrawingSettings { background: scene.background, ..DrawingSettings::default() };
    svg_of_paths(&VisibleLines::none(scene.size), Vec::new(), Some(&areas), &settings).unwrap()
}

/// An SVG's pixels at a zoom.
fn drawn(text: &str, zoom: f32) -> Picture {
    let pixels = rendered(text, zoom);
    let size = Size { width: pixels.width(), height: pixels.height() };
    Picture { size, pixels: pixels.take() }
}

/// Calls `at` with the red, green and blue of each pixel whose neighbours have the same colour in the first picture.
fn beside_no_border(picture: &Picture, mut at: impl FnMut(usize, [u8; 3])) {
    let (width, height) = (picture.size.width as usize, picture.size.height as usize);
    let rgb = |x: usize, y: usize| <[u8; 3]>::try_from(&picture.pixels[(y * width + x) * 4..][..3]).unwrap();
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let here = rgb(x, y);
            if (y - 1..=y + 1).all(|y| (x - 1..=x + 1).all(|x| rgb(x, y) == here)) {
                at(y * width + x, here);
            }
        }
    }
}

/// The styles whose tones are compared, without lines.
fn tones_alone() -> [(&'static str, Style); 5] {
    let two = Tones { count: 2, ..Tones::default() };
    let of_print = Tones {
        count: 3,
        levels: [0.68, 0.88, 1.0],
        diffuse_threshold: 0.56,
        specular_threshold: 0.2,
        ..Tones::default()
    };
    let cartoon = Cartoon { border: None, ..Cartoon::default() };
    let ink = Ink {
        is_inked: false,
        tones: of_print,
        tone_light: Some(FarLight::Towards([-0.4, 1.0, 0.6])),
        ..Ink::default()
    };
    let chosen = Ink { tone_light: Some(FarLight::Auto), ..ink.clone() };
    [
        ("three-pass", Style::ThreePass(cartoon.clone())),
        ("two-pass in two tones", Style::TwoPass(Cartoon { tones: two, ..cartoon })),
        ("ink", Style::Ink(Ink { is_inked: false, ..Ink::default() })),
        ("ink by a far light", Style::Ink(ink)),
        ("ink as printed", Style::Ink(chosen)),
    ]
}

fn check(name: &str, scene: &Scene, styles: &[(&str, Style)]) {
    let mut renderer = renderer(BACKENDS[0]);
    for (style_name, style) in styles {
        let expected = renderer.render(scene, style).unwrap();
        let found = drawn(&areas(scene, style), 1.0);
        assert_eq!(expected.size, found.size);
        // Tones of a far light are smooth in pixels: where light almost reaches thresholds at a corner, and turns back, a pixel there is
        // mixed although no border is. Of each step between tones it keeps the half on its own side.
        let half = match style {
            Style::Ink(Ink { tone_light: Some(_), tones: Tones { levels: [dark, .., bright], .. }, .. }) => {
                ((bright - dark) * 127.5).ceil() as u8
            }
            _ => 0,
        };
        let (mut compared, mut wrong, mut mixed) = (0, 0, 0);
        beside_no_border(&found, |pixel, rgb| {
            compared += 1;
            let of_style = &expected.pixels[pixel * 4..][..3];
            let farthest = rgb.iter().zip(of_style).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            mixed += usize::from((2..=half).contains(&farthest));
            wrong += usize::from(farthest > half.max(1));
        });
        println!("{name}, {style_name}: {compared} pixels beside no border, {wrong} differ, {mixed} are mixed");
        let beside = found.size.pixel_count() - compared;
        assert!(mixed * 300 <= beside, "{name}, {style_name}: {mixed} are mixed, and {beside} lie beside a border");
        assert!(compared * 2 > found.size.pixel_count(), "{name}, {style_name}: {compared} compared");
        // OpenGL computes in f32: at a pixel that lies on a border of tones to the last bits it may find the other tone.
        assert!(wrong * 100_000 <= compared, "{name}, {style_name}: {wrong} of {compared}");
    }
}

#[test]
fn areas_of_tone_are_the_pixels_of_the_style_briefly() {
    check("builtin:gear", &scene_with("builtin:gear", SceneSettings::default()), &tones_alone());
    check("builtin:bust", &scene_with("builtin:bust", SceneSettings::default()), &tones_alone()[3..]);
}

#[test]
fn areas_and_pixels_are_the_same_where_normals_are_averaged_and_patches_flattened() {
    let options = LoadOptions { normals: Normals::Lasting, smooth_angle_degrees: 34.0, ..LoadOptions::default() };
    let camera = CameraSettings { view: "30,23".parse().unwrap(), ..CameraSettings::default() };
    let settings = SceneSettings { camera, ..SceneSettings::default() };
    for model in ["builtin:bust", "builtin:soldier", "builtin:gear"] {
        let scene = Scene::new([load(model, &options).unwrap().mesh], &settings).unwrap();
        let (seen, thresholds) = (SeenNormals::of(&scene), [0.2, 0.56]);
        check(model, &seen.lit(&scene, seen.best_light(thresholds), thresholds), &tones_alone()[4..]);
    }
}

#[test]
#[ignore = "exhaustive: four styles of three scenes"]
fn areas_of_tone_are_the_pixels_of_the_style() {
    for model in ["builtin:bust", "builtin:gear"] {
        check(model, &scene_with(model, SceneSettings::default()), &tones_alone());
    }
    let copies = SceneSettings { copies: 4, ..SceneSettings::default() };
    check("four busts", &scene_with("builtin:bust", copies), &tones_alone());
}

#[test]
#[ignore = "exhaustive: four public models"]
fn areas_of_public_models_are_the_pixels_of_the_style() {
    for (file, mesh) in public_meshes(&["cow.obj", "teapot.obj", "suzanne.obj", "beethoven.obj"]) {
        let camera = CameraSettings { view: "30,23".parse().unwrap(), ..CameraSettings::default() };
        let settings = SceneSettings { camera, ..SceneSettings::default() };
        check(file, &Scene::new(vec![Arc::new(mesh)], &settings).unwrap(), &tones_alone());
    }
}

/// Masks of objects: each pixel has the colour of the object that a ray hits there, and no other colour.
#[test]
fn outlines_of_objects_are_masks() {
    let ground = Color([1.0; 3]);
    let settings = SceneSettings { background: Background::Color(ground), copies: 4, ..SceneSettings::default() };
    let scene = scene_with("builtin:bust", settings);
    let style = LineStyle { areas: Some(JoinKey::Object), is_of_areas_alone: true, ..LineStyle::default() };
    let vectors = Style::Lines(style).vectors(scene.size).unwrap();
    let lines = VisibleLines::none(scene.size);
    let fills = vectors.areas(&Sight::of(&scene), &lines, &Progress::default()).unwrap().unwrap().drawn.fills;
    assert_eq!(fills.iter().map(|group| group.object).collect::<Vec<_>>(), [0, 1, 2, 3]);
    let bytes = |Color(color): Color| color.map(|channel| (channel * 255.0).round() as u8);
    let colors: Vec<[u8; 3]> = fills.iter().map(|group| bytes(group.fills[0].color)).collect();
    let found = drawn(&svg_of(&scene, of_fills(fills)), 1.0);
    let (mut wrong, mut count) = (0, 0);
    for (pixel, hit) in first_hits(&scene).into_iter().enumerate() {
        let rgb = <[u8; 3]>::try_from(&found.pixels[pixel * 4..][..3]).unwrap();
        assert!(colors.contains(&rgb) || rgb == [255; 3], "{rgb:?} at {pixel}: edges are not smoothed");
        let expected = hit.map_or([255; 3], |hit| colors[hit.object as usize]);
        wrong += usize::from(rgb != expected);
        count += usize::from(expected != [255; 3]);
    }
    // The renderer rounds places, which moves a border by less than a pixel.
    println!("{wrong} of {count} pixels differ");
    assert!(wrong * 1000 <= count, "{wrong} of {count}");
}

/// Faces in one colour, on another, look like one area: no ground shines through between them at any zoom.
#[test]
fn no_ground_shines_through_between_faces() {
    let settings = SceneSettings { background: Background::Color(Color([1.0, 0.0, 1.0])), ..SceneSettings::default() };
    let scene = scene_with("builtin:bust", settings);
    let regions = Regions::joined_by(&Sight::of(&scene), JoinKey::Face, &Progress::default()).unwrap();
    let grey = |has_traps: bool| svg_of(&scene, of_fills(painted(&regions, has_traps, |_| Color([0.5; 3]))));
    let objects = Regions::joined_by(&Sight::of(&scene), JoinKey::Object, &Progress::default()).unwrap();
    let whole = svg_of(&scene, of_fills(painted(&objects, true, |_| Color([0.5; 3]))));
    let smoothed = grey(false).replace("shape-rendering", "data-not");
    for zoom in [0.5, 1.0, 2.5] {
        let [faces, seams, whole] = [&grey(true), &smoothed, &whole].map(|text| drawn(text, zoom));
        let (mut worst, mut of_seams, mut count) = (0, 0, 0);
        beside_no_border(&whole, |pixel, rgb| {
            let differs = |picture: &Picture| {
                let of_faces = &picture.pixels[pixel * 4..][..3];
                rgb.iter().zip(of_faces).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
            };
            worst = worst.max(differs(&faces));
            of_seams = of_seams.max(differs(&seams));
            count += 1;
        });
        println!("zoom {zoom}: {worst} with traps, {of_seams} without, over {count} pixels");
        assert!(worst <= 1 && of_seams > 20 && count > 1000, "zoom {zoom}: {worst} with traps, {of_seams} without");
    }
}

/// On magenta, grey areas without seams: no pixel inside them has a trace of the ground, unless OpenGL sees ground nearby at a fourth
/// of a pixel.
fn check_ground(styles: &[(&str, Style)]) {
    let settings = SceneSettings {
        background: Background::Color(Color([1.0, 0.0, 1.0])),
        color: Some(Color([1.0; 3])),
        copies: 4,
        ..SceneSettings::default()
    };
    let scene = scene_with("builtin:bust", settings.clone());
    let fine = Size { width: settings.size.width * 4, height: settings.size.height * 4 };
    let fine_scene = scene_with("builtin:bust", SceneSettings { size: fine, ..settings });
    let [(_, flat), ..] = tones_alone();
    let truth = renderer(BACKENDS[0]).render(&fine_scene, &flat).unwrap();
    let side = fine.width as usize;
    let has_ground = |[x, y]: [usize; 2], [width, height]: [usize; 2]| {
        let mut all = (y..(y + height).min(side)).flat_map(|y| (x..(x + width).min(side)).map(move |x| y * side + x));
        all.any(|pixel| truth.pixels[pixel * 4 + 1] < 100)
    };
    for (name, style) in styles {
        let text = areas(&scene, style);
        for (zoom, most) in [(0.5, 24), (1.0, 16), (2.5, 16)] {
            let found = drawn(&text, zoom);
            let width = found.size.width as usize;
            let rgb = |pixel: usize| &found.pixels[pixel * 4..][..3];
            let is_ground = |pixel: usize| rgb(pixel)[1] < 100;
            let (mut inside, mut worst) = (0, 0);
            for pixel in 2 * width + 2..found.pixels.len() / 4 - 2 * width - 2 {
                let around = (0..25).map(|step| pixel + step % 5 + step / 5 * width - 2 - 2 * width);
                if around.into_iter().all(|near| !is_ground(near)) {
                    inside += 1;
                    let scale = side as f64 / width as f64;
                    let place = [pixel % width - 1, pixel / width - 1].map(|at| (at as f64 * scale) as usize);
                    if has_ground(place, [(3.0 * scale).ceil() as usize; 2]) {
                        continue;
                    }
                    worst = worst.max(rgb(pixel)[0].abs_diff(rgb(pixel)[1]));
                }
            }
            println!("{name} at {zoom}: {inside} pixels inside, at most {worst} of 255 from the ground");
            assert!(inside > 1000 && worst <= most, "{name} at {zoom}: {worst}");
        }
    }
}

#[test]
fn no_ground_shines_through_between_areas_briefly() {
    check_ground(&tones_alone()[3..]);
}

#[test]
#[ignore = "exhaustive: four styles"]
fn no_ground_shines_through_between_areas() {
    check_ground(&tones_alone());
}

#[test]
fn looks_of_tones_write_areas_without_being_told_a_style() {
    let folder = tempfile::tempdir().unwrap();
    for look in ["print", "published"] {
        for name in ["a.svg", "a.pdf"] {
            let file = folder.path().join(name);
            done(&["render", "builtin:gear", "--size", "64", "--look", look, "-o", file.to_str().unwrap()]);
            let written = std::fs::read(&file).unwrap();
            let has_areas = String::from_utf8_lossy(&written).contains("id=\"fill-0-0\"");
            assert!(has_areas || name.ends_with("pdf"), "{look}: no areas in {name}");
        }
    }
}
