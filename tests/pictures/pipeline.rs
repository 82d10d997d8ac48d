//! The pipeline on real contexts: shaders compile, both backends agree, twins agree, nothing leaks, limits hold.

use crate::support::{BACKENDS, renderer, scene, scene_with, skip, styles};
use std::sync::Arc;
use tinta::picture::Difference;
use tinta::styles::{Border, Cartoon, Charcoal, Filter, Supersample, ToneLookup, Tones};
use tinta::{Backend, Background, Color, Error, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, load};

const EQUAL: Difference = Difference { largest: 0, pixels: 0 };

#[test]
fn every_shader_compiles_on_both_backends() {
    assert!(!tinta::glsl::SOURCES.is_empty());
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (path, _) in tinta::glsl::SOURCES {
            renderer.compile_shader(path).unwrap_or_else(|error| panic!("{backend:?}: {error}"));
        }
        assert!(matches!(renderer.compile_shader("no/such.frag"), Err(Error::Shader { .. })));
    }
}

#[test]
fn both_backends_of_one_driver_draw_the_same_bytes() {
    let [mut first, mut second] = BACKENDS.map(renderer);
    let of = |renderer: &Renderer| [&renderer.context().renderer, &renderer.context().version].map(String::clone);
    if of(&first) != of(&second) {
        // Skipped with a message, because only the same driver promises equal bytes.
        skip(&format!("equal bytes of both backends: they are {:?} and {:?}", of(&first), of(&second)));
        return;
    }
    for model in ["builtin:bust", "builtin:open-box", "builtin:ant", "builtin:gear"] {
        let scene = scene(model, 200, 150);
        for (name, style) in styles() {
            let pictures = [&mut first, &mut second].map(|renderer| renderer.render(&scene, &style).unwrap());
            assert_eq!(pictures[0].difference(&pictures[1]), Some(EQUAL), "{model} {name}");
        }
    }
}

/// Settings that select the shaders with uniforms but give the listing's picture.
fn as_published_but_by_settings() -> Cartoon {
    // The next number after 0.65: no specular value a picture shows lies between the two.
    let tones = Tones { specular_threshold: 0.65f32.next_up(), ..Tones::default() };
    let border = Border { detection_factor: 0.2f32.next_up(), ..Border::default() };
    Cartoon { tones, border: Some(border), ..Cartoon::default() }
}

#[test]
fn the_published_shaders_and_their_twins_with_settings_draw_the_same_picture() {
    let settings = as_published_but_by_settings();
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for make in [Style::ThreePass, Style::TwoPass] {
            let scene = scene("builtin:bust", 256, 256);
            let (published, by_settings) = (make(Cartoon::default()), make(settings.clone()));
            let plans = [&published, &by_settings].map(|style| style.plan(&scene, Show::Final).unwrap());
            assert_ne!(plans[0].to_string(), plans[1].to_string(), "they run different shaders");
            let pictures = plans.map(|plan| renderer.draw(&scene, &plan).unwrap());
            let difference = pictures[0].difference(&pictures[1]).unwrap();
            assert!(difference.largest <= 1 && difference.pixels < 20, "{backend:?} {difference:?}");
        }
    }
}

#[test]
fn three_and_two_passes_agree_to_rounding() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 256, 256);
    let [three, two] =
        [Style::ThreePass, Style::TwoPass].map(|make| renderer.render(&scene, &make(Cartoon::default())).unwrap());
    // Where the border's response exceeds 1, three-pass clamps alpha and two-pass clamps a negative colour: both give black.
    assert!(three.difference(&two).unwrap().largest <= 1);
}

#[test]
fn tones_from_the_texture_are_the_tones_by_comparing() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 256, 256);
    for count in 1..=3 {
        let [steps, texture] = [ToneLookup::Steps, ToneLookup::Texture].map(|lookup| {
            let tones = Tones { count, lookup, ..Tones::default() };
            let style = Style::ThreePass(Cartoon { tones, ..Cartoon::default() });
            renderer.render(&scene, &style).unwrap()
        });
        // Tones in the table are rounded to 1/255, which moves a colour by one step at most; light is exact to 1/1023
        // there, so only pixels on a tone's very edge may change sides.
        let pairs = steps.pixels.iter().zip(&texture.pixels);
        let different = pairs.filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(different < scene.size.pixel_count() / 200, "{count} tones: {different} bytes");
    }
}

#[test]
fn the_background_has_exactly_the_colour_asked_for_in_every_style_and_number_of_tones() {
    let mut renderer = renderer(BACKENDS[0]);
    let (asked, expected) = (Color([0.2, 0.4, 0.6]), [51, 102, 153, 255]);
    let settings = |size| SceneSettings { size, background: Background::Color(asked), ..SceneSettings::default() };
    for size in [Size { width: 64, height: 64 }, Size { width: 300, height: 40 }] {
        let mut settings = settings(size);
        settings.camera.fov_y_degrees = 100.0;
        let scene = scene_with("builtin:ant", settings);
        // Charcoal draws on paper.
        for (name, style) in styles().into_iter().filter(|(name, _)| *name != "charcoal") {
            for count in 1..=3 {
                for lookup in [ToneLookup::Steps, ToneLookup::Texture] {
                    let mut style = style.clone();
                    if let Style::ThreePass(cartoon) | Style::TwoPass(cartoon) = &mut style {
                        cartoon.tones = Tones { count, lookup, ..Tones::default() };
                    }
                    let picture = renderer.render(&scene, &style).unwrap();
                    let corner = (i64::from(size.width) - 1, i64::from(size.height) - 1);
                    for (x, y) in [(0, 0), (corner.0, 0), (0, corner.1), corner] {
                        assert_eq!(picture.pixel(x, y), expected, "{name} {count} {lookup:?} at {x},{y}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_transparent_picture_has_ink_with_its_own_alpha_and_nothing_else_outside() {
    let mut renderer = renderer(BACKENDS[0]);
    let settings = SceneSettings {
        size: Size { width: 200, height: 200 },
        background: Background::Transparent,
        ..SceneSettings::default()
    };
    let scene = scene_with("builtin:ant", settings);
    let picture = renderer.render(&scene, &Style::ThreePass(Cartoon::default())).unwrap();
    assert_eq!(picture.pixel(0, 0), [0; 4]);
    let pixels = || picture.pixels.chunks_exact(4);
    assert!(pixels().filter(|pixel| pixel[3] == 255).count() > 1000, "the ant is opaque");
    let ink: Vec<&[u8]> = pixels().filter(|pixel| (1..255).contains(&pixel[3])).collect();
    assert!(!ink.is_empty(), "its outer border is half transparent somewhere");
    assert!(ink.iter().all(|pixel| pixel[..3] == [0; 3]), "ink is black");
    let refused = Style::TwoPass(Cartoon::default()).plan(&scene, Show::Final).unwrap_err();
    assert!(refused.to_string().contains("--background-quad off"), "{refused}");
}

#[test]
fn without_the_background_square_two_pass_loses_ink_outside() {
    // Errata E10: half of the silhouette lies on background pixels.
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:ant", 200, 200);
    let mut ink = |background_square| {
        let style = Style::TwoPass(Cartoon { background_square, ..Cartoon::default() });
        let picture = renderer.render(&scene, &style).unwrap();
        picture.pixels.chunks_exact(4).filter(|pixel| pixel[..3].iter().all(|channel| *channel < 40)).count()
    };
    let (with, without) = (ink(true), ink(false));
    assert!(without < with * 3 / 4, "{without} against {with} dark pixels");
}

#[test]
fn the_background_square_hides_nothing_however_far_the_planes_are_apart() {
    let mut renderer = renderer(BACKENDS[0]);
    let mut settings = SceneSettings { size: Size { width: 64, height: 64 }, ..SceneSettings::default() };
    (settings.camera.near, settings.camera.far) = (Some(2e-4), Some(1e4));
    let scene = scene_with("builtin:gear", settings);
    let mut drawn = |background_square| {
        let style = Style::ThreePass(Cartoon { background_square, border: None, ..Cartoon::default() });
        renderer.render(&scene, &style).unwrap()
    };
    let (with, without) = (drawn(true), drawn(false));
    assert!(without.pixels.chunks_exact(4).filter(|pixel| pixel[0] < 250).count() > 500);
    assert_eq!(with.difference(&without), Some(EQUAL));
}

#[test]
fn culling_leaves_the_picture_of_a_closed_model_as_it_is() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 200, 200);
    let mut draw = |cull_back_faces| {
        renderer.render(&scene, &Style::ThreePass(Cartoon { cull_back_faces, ..Cartoon::default() })).unwrap()
    };
    assert_eq!(draw(false).difference(&draw(true)), Some(EQUAL));
}

#[test]
fn other_scenes_let_go_of_the_meshes_before() {
    let mut renderer = renderer(BACKENDS[1]);
    let style = Style::ThreePass(Cartoon::default());
    let objects: Vec<usize> = (0..5)
        .map(|_| {
            let mesh = load("builtin:open-box", &LoadOptions::default()).unwrap().mesh;
            let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap();
            renderer.render(&scene, &style).unwrap();
            renderer.live_objects()
        })
        .collect();
    assert_eq!(objects, vec![objects[0]; 5]);
}

#[test]
fn a_picture_beyond_what_can_be_drawn_is_refused_with_its_size() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let limit = renderer.context().largest_viewport;
        // The published charcoal lays its paper on the whole picture's clip coordinates.
        let wide = scene("builtin:open-box", limit.width + 1, 1);
        let message = renderer.render(&wide, &Style::Charcoal(Charcoal::default())).unwrap_err().to_string();
        assert!(message.contains(&format!("{}x{}", limit.width, limit.height)), "{message}");
    }
}

#[test]
fn auto_draws_whatever_another_context_can_and_smaller_pictures_as_before() {
    let [mut egl, mut osmesa] = BACKENDS.map(renderer);
    let limits = [&egl, &osmesa].map(|renderer| renderer.context().largest_picture.width);
    let mut auto = renderer(Backend::Auto);
    let first = auto.context().clone();
    if first.device != egl.context().device || limits[0] >= limits[1] {
        return skip("auto: no context here draws larger pictures than the first");
    }
    let style = Style::ThreePass(Cartoon::default());
    let [small, large] = [96, limits[0] + 1].map(|width| scene("builtin:gear", width, 64));
    let before = auto.render(&small, &style).unwrap();
    assert_eq!(before, egl.render(&small, &style).unwrap());
    for _ in 0..2 {
        assert_eq!(auto.render(&large, &style).unwrap(), osmesa.render(&large, &style).unwrap());
        assert_eq!(auto.context().backend, osmesa.context().backend);
        assert_eq!(auto.render(&small, &style).unwrap(), before);
        assert_eq!(auto.context(), &first);
    }
    // Supersampled pictures count at the larger size.
    let quarter = scene("builtin:gear", limits[0] / 4 + 1, 16);
    let sampled = Style::ThreePass(Cartoon { supersample: Supersample::Four, ..Cartoon::default() });
    assert_eq!(auto.render(&quarter, &sampled).unwrap(), osmesa.render(&quarter, &sampled).unwrap());
    // Beyond all limits the first one draws it in tiles.
    let wide = scene("builtin:gear", limits[1] / 4 + 1, 16);
    assert_eq!(auto.render(&wide, &sampled).unwrap(), egl.render(&wide, &sampled).unwrap());
    assert_eq!(auto.context(), &first);
    // Shaders in place of others are so in each context, those opened later too.
    let white = "#version 120\nvoid main() { gl_FragColor = vec4(1.0); }\n".to_owned();
    auto.replace_shaders([("evangelista/toon.frag".to_owned(), white)].into()).unwrap();
    let tones = |scene: &Scene| style.plan(scene, Show::Tones).unwrap();
    for scene in [&small, &large] {
        assert!(auto.draw(scene, &tones(scene)).unwrap().pixels.iter().all(|channel| *channel == 255));
    }
    assert_eq!(auto.close(), 0);
}

#[test]
fn odd_and_tiny_sizes_are_drawn() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (width, height) in [(1, 1), (1, 50), (50, 1), (63, 65), (333, 7)] {
            let scene = scene("builtin:open-box", width, height);
            for (name, style) in styles() {
                let picture = renderer.render(&scene, &style).unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!(picture.pixels.len(), (width * height * 4) as usize);
            }
        }
    }
}

#[test]
fn step_pictures_hold_the_map_and_end_with_the_picture() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 128, 128);
    let plan = Style::ThreePass(Cartoon::default()).plan(&scene, Show::Final).unwrap();
    let steps = renderer.step_pictures(&scene, &plan).unwrap();
    let names: Vec<String> = steps.iter().map(|step| format!("{}-{}", step.pass, step.step)).collect();
    let expected = [
        "map-clear",
        "map-background",
        "map-objects",
        "map-copy",
        "tones-clear",
        "tones-background",
        "tones-objects",
        "border-square",
    ];
    assert_eq!(names, expected);
    assert_eq!(steps[2].picture, steps[3].picture, "the copy is the framebuffer, byte for byte");
    assert_eq!(steps[7].picture, renderer.draw(&scene, &plan).unwrap());
    let map = renderer.draw(&scene, &Style::ThreePass(Cartoon::default()).plan(&scene, Show::Map).unwrap()).unwrap();
    assert_eq!(steps[2].picture, map);
}

#[test]
fn normals_and_depth_show_the_map_and_near_is_dark() {
    let mut renderer = renderer(BACKENDS[0]);
    let mut settings = SceneSettings { size: Size { width: 100, height: 100 }, ..SceneSettings::default() };
    settings.camera.view = "front".parse().unwrap();
    let scene = scene_with("builtin:bust", settings);
    let style = Style::ThreePass(Cartoon::default());
    let mut show = |show| renderer.draw(&scene, &style.plan(&scene, show).unwrap()).unwrap();
    let (map, normals, depth) = (show(Show::Map), show(Show::Normals), show(Show::Depth));
    assert_eq!(normals, map.clone().opaque());
    assert_eq!(depth, map.alpha_as_grey());
    assert_eq!(depth.pixel(0, 0), [255; 4], "the background is far");
    let nearest = depth.pixels.chunks_exact(4).map(|pixel| pixel[0]).min().unwrap();
    assert!(nearest < 20, "depth is fitted to the bust, and its nearest point is dark: {nearest}");
    let (nose, shoulder) = (depth.pixel(50, 30)[0], depth.pixel(35, 62)[0]);
    assert!(nose < shoulder && shoulder < 255, "the face is nearer than the shoulder: {nose} {shoulder}");
    assert_eq!(normals.pixel(0, 0), [0, 0, 255, 255], "the background square faces the eye");
}

#[test]
fn every_filter_draws_its_own_border() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 128, 128);
    let mut pictures = Vec::new();
    for (_, filter) in Filter::ALL {
        let border = Some(Border { filter, ..Border::default() });
        let style = Style::ThreePass(Cartoon { border, ..Cartoon::default() });
        pictures.push(renderer.draw(&scene, &style.plan(&scene, Show::Borders).unwrap()).unwrap());
    }
    for (index, picture) in pictures.iter().enumerate() {
        assert!(picture.pixels.chunks_exact(4).any(|pixel| pixel[0] < 128), "filter {index} finds edges");
        assert!(pictures[..index].iter().all(|other| other != picture), "filter {index} differs from the others");
    }
}
