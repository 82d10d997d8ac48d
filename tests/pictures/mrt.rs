//! One pass over the geometry draws the same as the published passes: byte for byte where both draw into textures, and up to
//! rounding where the published ones draw into the framebuffer. The same holds for maps drawn into textures.
//!
//! Mesa draws its own framebuffer from the top and textures from the bottom: rows count the other way, and edges through pixels'
//! middles and interpolated values round differently.

use crate::support::{BACKENDS, failure_folder, public_models, renderer, scene, scene_with, side_by_side};
use std::sync::Arc;
use tinta::picture::write_rgba_png;
use tinta::plan::{Attachment, Attachments, Format, Plan, SettingValue, Target, TextureName};
use tinta::styles::{
    Border, Cartoon, Filter, Ink, LineWidth, MapEncoding, MapTarget, Mrt, Supersample, ToneLookup, Tones,
};
use tinta::{
    Backend, Background, Color, LoadOptions, Picture, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName,
    load,
};

/// Share of pixels that rounding may change between framebuffer and texture: the largest observed is 0.3 %, on the bust, whose
/// colours lie between two steps of 8 bits.
const ROUNDED_SHARE: f64 = 0.005;

/// A pixel counts as moved beyond this, in 1/255: a map's value that is one step off counts four times in the filter, with
/// the largest factor tried here, 1.
const FILTERED_STEP: u8 = 4;

/// Share of pixels that may have moved: where an edge goes through a pixel's middle.
const MOVED_SHARE: f64 = 0.0005;

const TONES: Attachments = Attachments {
    colors: &[Attachment { name: TextureName("Tones"), format: Format::Unorm8 }],
    has_depth: false,
    asked_by: SettingValue { setting: "size", value: "8" },
    instead: SettingValue { setting: "size", value: "4" },
    instead_draws: None,
};
const TONES_AND_DEPTH: Attachments = Attachments { has_depth: true, ..TONES };

/// The same three passes into textures only.
fn in_textures(mut plan: Plan) -> Plan {
    for pass in &mut plan.passes {
        match pass.name {
            "tones" => pass.target = Target::Textures(&TONES_AND_DEPTH),
            "border" | "border-normals" | "border-depth" => pass.target = Target::Textures(&TONES),
            _ => assert!(matches!(pass.target, Target::Textures(_)), "{}", pass.name),
        }
    }
    plan
}

/// The three passes and the one, with the same settings.
fn pair(change: impl Fn(&mut Cartoon)) -> [Style; 2] {
    let mut cartoon = Cartoon::default();
    change(&mut cartoon);
    [Style::ThreePass(cartoon.clone()), Style::Mrt(Mrt(cartoon))]
}

fn assert_same(context: &str, expected: &Picture, actual: &Picture) {
    if expected == actual {
        return;
    }
    assert_eq!(expected.size, actual.size, "{context}");
    let differing = expected.pixels.chunks(4).zip(actual.pixels.chunks(4)).filter(|(a, b)| a != b).count();
    let path = failure_folder().join(format!("mrt-{}.png", context.replace([' ', ':', '/'], "-")));
    write_rgba_png(&side_by_side(expected, actual), &path).unwrap();
    panic!("{context}: {differing} pixels differ, none may; expected | difference | actual: {}", path.display());
}

/// Fails where more differs than rounding explains.
fn assert_near(context: &str, expected: &Picture, actual: &Picture) {
    let pairs = expected.pixels.chunks(4).zip(actual.pixels.chunks(4));
    let differences = pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0));
    let (mut rounded, mut moved) = (0, 0);
    for difference in differences {
        rounded += usize::from(difference > 0);
        moved += usize::from(difference > FILTERED_STEP);
    }
    let count = expected.size.pixel_count() as f64;
    println!("{context}: {rounded} pixels rounded otherwise, {moved} moved");
    // A picture of few pixels may have one of each.
    if rounded as f64 > (count * ROUNDED_SHARE).max(1.0) || moved as f64 > (count * MOVED_SHARE).max(1.0) {
        assert_same(context, expected, actual);
    }
}

/// Compares both styles' pictures: byte for byte in textures, up to rounding in the framebuffer.
fn assert_pair(renderer: &mut Renderer, scene: &Scene, context: &str, [three, mrt]: &[Style; 2]) {
    let context = format!("{context} on {}", renderer.context().backend);
    let mut draw = |plan: &Plan| renderer.draw(scene, plan).unwrap_or_else(|error| panic!("{context}: {error}"));
    let published = three.plan(scene, Show::Final).unwrap();
    let plan = mrt.plan(scene, Show::Final).unwrap();
    let actual = draw(&plan);
    assert_near(&context, &draw(&published), &actual);
    if plan.supersample == 1 && plan.picture_target() != Target::Framebuffer {
        let Style::ThreePass(cartoon) = three else { panic!("{}", three.name()) };
        let style = Style::ThreePass(Cartoon { map_target: MapTarget::Texture, ..cartoon.clone() });
        let expected = draw(&in_textures(style.plan(scene, Show::Final).unwrap()));
        assert_same(&context, &expected, &actual);
    }
}

fn check_settings(backends: &[Backend], models: &[&str]) {
    let with = |border: Border| pair(move |cartoon| cartoon.border = Some(border));
    let mut settings = vec![
        ("defaults".to_owned(), pair(|_| ())),
        ("no borders".to_owned(), pair(|cartoon| cartoon.border = None)),
        ("no square".to_owned(), pair(|cartoon| cartoon.background_square = false)),
        ("culled".to_owned(), pair(|cartoon| cartoon.cull_back_faces = true)),
        ("wide".to_owned(), with(Border { width: Some(LineWidth::Pixels(5)), ..Border::default() })),
        ("slope".to_owned(), with(Border { slope_threshold: true, ..Border::default() })),
        ("dark".to_owned(), with(Border { detection_factor: 1.0, ..Border::default() })),
        ("supersampled".to_owned(), pair(|cartoon| cartoon.supersample = Supersample::Two)),
        ("table".to_owned(), pair(|cartoon| cartoon.tones.lookup = ToneLookup::Texture)),
    ];
    settings.extend((1..=3).map(|count| (format!("{count} tones"), pair(|cartoon| cartoon.tones.count = count))));
    settings.extend(Filter::ALL.map(|(name, filter)| (name.to_owned(), with(Border { filter, ..Border::default() }))));
    for &backend in backends {
        let mut renderer = renderer(backend);
        for &model in models {
            let scene = scene(model, 161, 120);
            for (name, styles) in &settings {
                assert_pair(&mut renderer, &scene, &format!("{model} {name}"), styles);
            }
        }
    }
}

#[test]
fn every_setting_draws_of_a_gear_what_the_three_passes_draw() {
    check_settings(&BACKENDS[1..], &["builtin:gear"]);
}

#[test]
#[ignore = "exhaustive: four models by both backends"]
fn every_setting_draws_what_the_three_passes_draw() {
    check_settings(&*BACKENDS, &["builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box"]);
}

#[test]
fn public_models_are_drawn_as_by_the_three_passes() {
    let Some(folder) = public_models() else { return };
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for name in ["stanford-bunny.obj", "beethoven.obj", "fandisk.obj", "suzanne.obj"] {
            let mesh = Arc::new(load(&folder.join(name).display().to_string(), &LoadOptions::default()).unwrap().mesh);
            let settings = SceneSettings { size: Size { width: 300, height: 301 }, ..SceneSettings::default() };
            let scene = Scene::new(vec![mesh], &settings).unwrap();
            for tones in 1..=3 {
                let styles = pair(|cartoon| cartoon.tones = Tones { count: tones, ..Tones::default() });
                assert_pair(&mut renderer, &scene, &format!("{name} {tones} tones"), &styles);
            }
        }
    }
}

#[test]
fn every_background_and_size_is_the_same_and_sizes_may_change_between_frames() {
    let colors = [[1.0; 3], [0.0; 3], [0.2, 0.4, 0.8], [16.0 / 255.0, 32.0 / 255.0, 48.0 / 255.0]];
    let mut backgrounds = vec![Background::Transparent];
    backgrounds.extend(colors.map(|color| Background::Color(Color(color))));
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (width, height) in [(1, 1), (64, 48), (1, 1), (77, 3), (3, 77), (333, 257)] {
            for background in &backgrounds {
                let size = Size { width, height };
                let settings = SceneSettings { size, background: *background, ..SceneSettings::default() };
                let scene = scene_with("builtin:bust", settings);
                assert_pair(&mut renderer, &scene, &format!("{size} {background:?}"), &pair(|_| ()));
            }
        }
    }
}

#[test]
fn the_comparison_notices_another_setting() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 160, 120);
    let [three, mrt] = [pair(|_| ()), pair(|cartoon| cartoon.tones.count = 2)];
    let [expected, actual] = [&three[0], &mrt[1]].map(|style| renderer.render(&scene, style).unwrap());
    assert!(std::panic::catch_unwind(|| assert_near("two tones for three", &expected, &actual)).is_err());
}

#[test]
fn the_plan_names_its_targets() {
    let plan = Style::named(StyleName::Mrt).plan(&scene("builtin:open-box", 512, 512), Show::Final).unwrap();
    let expected = "\
pass 1: tones-and-map, into the textures Tones, 8 bits a channel and Map, 8 bits a channel
  clear to (1, 1, 1, 1) and (0, 0, 1, 1), depth to 1
  draw the objects with improved/two-targets.vert + improved/two-targets.frag
pass 2: border, into the texture Tones, 8 bits a channel
  draw the screen square with evangelista/border.vert + evangelista/border.frag, textureUnit = (0.001953125, \
0.001953125), borderMap = Map, no depth test, blended
picture: the texture Tones
";
    assert_eq!(plan.to_string(), expected);
}

#[test]
fn steps_can_be_dumped_and_the_last_is_the_picture() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:gear", 120, 90);
        for supersample in [Supersample::One, Supersample::Two] {
            let style = Style::Mrt(Mrt(Cartoon { supersample, ..Cartoon::default() }));
            let plan = style.plan(&scene, Show::Final).unwrap();
            let steps = renderer.step_pictures(&scene, &plan).unwrap();
            assert_eq!(steps.len(), plan.steps().count());
            assert_eq!(steps.last().unwrap().picture, renderer.draw(&scene, &plan).unwrap());
        }
    }
}

#[test]
fn a_map_drawn_into_a_texture_gives_the_picture_of_a_copied_one() {
    let targets = [MapTarget::Copy, MapTarget::Texture];
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for model in ["builtin:bust", "builtin:gear"] {
            let scene = scene(model, 161, 120);
            let mut assert_both = |name: &str, styles: [Style; 2]| {
                let pictures = styles.map(|style| renderer.render(&scene, &style).unwrap());
                assert_near(&format!("{model} {name} on {backend:?}"), &pictures[0], &pictures[1]);
            };
            for (name, map_encoding) in MapEncoding::ALL {
                for supersample in [Supersample::One, Supersample::Two] {
                    let cartoon = |map_target| Cartoon { map_encoding, map_target, supersample, ..Cartoon::default() };
                    assert_both(name, targets.map(|target| Style::ThreePass(cartoon(target))));
                    assert_both(name, targets.map(|target| Style::TwoPass(cartoon(target))));
                }
            }
            let ink = |map_target, supersample| Style::Ink(Ink { map_target, supersample, ..Ink::default() });
            for supersample in [None, Some(Supersample::Two)] {
                assert_both("ink", targets.map(|target| ink(target, supersample)));
            }
        }
    }
}

#[test]
fn a_map_drawn_into_a_texture_is_copied_nowhere() {
    let cartoon = Cartoon { map_target: MapTarget::Texture, ..Cartoon::default() };
    let plan = Style::ThreePass(cartoon).plan(&scene("builtin:open-box", 64, 64), Show::Final).unwrap();
    let text = plan.to_string();
    assert!(text.starts_with("pass 1: map, into the texture Map, 8 bits a channel\n"), "{text}");
    assert!(text.contains("borderMap = Map") && !text.contains("copy"), "{text}");
}
