//! Pruning: each rule where it applies and where it must not, and pictures byte for byte.

use crate::support::{BACKENDS, renderer, scene, scene_with};
use glam::DVec3;
use std::sync::Arc;
use tinta::lines::Length;
use tinta::plan::prune::{PrunedPlan, Pruning, Rule, prune};
use tinta::plan::{Draw, Faces, Geometry, Plan, Step};
use tinta::styles::{
    Border, Cartoon, Charcoal, Dietrich, Filter, Ink, Inking, LineWidth, MapEncoding, MapTarget, Phong, Quality,
    Supersample,
};
use tinta::{
    Background, CameraSettings, Color, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName, View,
    load,
};

/// For a GL on the processor that places vertices to 1/256 of a pixel, as Mesa does.
pub fn every_rule() -> Pruning {
    Pruning { subpixel_bits: 8, ..Pruning::default() }
}

fn pruned(scene: &Scene, style: &Style) -> PrunedPlan {
    prune(&style.plan(scene, Show::Final).unwrap(), scene, &every_rule())
}

/// Whether the rule left something out.
fn applies(rule: Rule, scene: &Scene, style: &Style) -> bool {
    let PrunedPlan { omissions, kept, .. } = pruned(scene, style);
    let found: Vec<&str> = omissions.iter().filter(|one| one.rule == rule).map(|one| one.what.as_str()).collect();
    let reasons: Vec<&str> = kept.iter().filter(|one| one.rule == rule).map(|one| one.reason.as_str()).collect();
    assert_eq!(found.len() + reasons.len(), 1, "each rule says what it did or why it did not: {rule}");
    assert!(found.iter().chain(&reasons).all(|text| text.len() > 5));
    !found.is_empty()
}

pub fn cartoon(change: impl FnOnce(&mut Cartoon)) -> Style {
    let mut cartoon = Cartoon::default();
    change(&mut cartoon);
    Style::ThreePass(cartoon)
}

fn two_pass(change: impl FnOnce(&mut Cartoon)) -> Style {
    let Style::ThreePass(cartoon) = cartoon(change) else { panic!("a cartoon") };
    Style::TwoPass(cartoon)
}

fn draws(plan: &Plan) -> impl Iterator<Item = &Draw> {
    plan.steps().filter_map(|(_, step)| if let Step::Draw(draw) = step { Some(draw) } else { None })
}

/// A scene seen from the side, with most of its copies outside the picture.
pub fn beside(model: &str) -> Scene {
    let mesh = Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
    let mut scene = Scene::new(
        vec![mesh],
        &SceneSettings { copies: 9, size: Size { width: 90, height: 70 }, ..Default::default() },
    )
    .unwrap();
    let target = scene.objects[0].offset + scene.objects[0].mesh.bounds().0.lerp(scene.objects[0].mesh.bounds().1, 0.5);
    scene.camera.eye = target + DVec3::Z * scene.radius;
    scene.camera.target = target;
    (scene.camera.near, scene.camera.far) = (scene.radius * 0.05, scene.radius * 4.0);
    scene
}

#[test]
fn a_border_multiplied_by_0_is_left_out_and_one_that_is_not_is_kept() {
    let scene = scene("builtin:bust", 64, 64);
    let with =
        |factor| cartoon(|cartoon| cartoon.border = Some(Border { detection_factor: factor, ..Border::default() }));
    assert!(applies(Rule::Border, &scene, &with(0.0)));
    assert!(!applies(Rule::Border, &scene, &with(0.01)));
    let sloped = Border { detection_factor: 0.0, slope_threshold: true, ..Border::default() };
    let sloped = cartoon(|cartoon| cartoon.border = Some(sloped));
    assert!(!applies(Rule::Border, &scene, &sloped), "that threshold is not multiplied");
    // Without the square, the map that it would have read goes too.
    assert!(applies(Rule::UnreadMap, &scene, &with(0.0)));
    assert_eq!(pruned(&scene, &with(0.0)).plan.passes.len(), 1);
}

#[test]
fn a_map_is_left_out_where_no_border_reads_it() {
    let scene = scene("builtin:bust", 64, 64);
    let style = cartoon(|cartoon| cartoon.border = None);
    assert!(applies(Rule::UnreadMap, &scene, &style));
    let names: Vec<&str> = pruned(&scene, &style).plan.passes.iter().map(|pass| pass.name).collect();
    assert_eq!(names, ["tones"]);
    assert!(!applies(Rule::UnreadMap, &scene, &cartoon(|_| {})));
    let float = cartoon(|cartoon| (cartoon.border, cartoon.map_encoding) = (None, MapEncoding::Float));
    assert!(applies(Rule::UnreadMap, &scene, &float));
    assert!(!applies(Rule::UnreadMap, &scene, &cartoon(|cartoon| cartoon.map_encoding = MapEncoding::DepthTexture)));
}

#[test]
fn objects_outside_the_picture_are_left_out_with_their_edges() {
    let (beside, whole) = (beside("builtin:gear"), scene("builtin:gear", 90, 70));
    for (name, style) in StyleName::of_passes().filter(|(name, _)| *name != "sand") {
        let style = Style::named(style);
        assert!(applies(Rule::OutsideObjects, &beside, &style), "{name}");
        assert!(!applies(Rule::OutsideObjects, &whole, &style), "{name}");
        for draw in draws(&pruned(&beside, &style).plan) {
            match &draw.geometry {
                Geometry::Objects(_) => {
                    let faces = draw.faces.as_ref().unwrap();
                    let inside = faces.iter().filter(|faces| **faces != Faces::None).count();
                    assert!((1..9).contains(&inside), "{name}: {inside}");
                }
                Geometry::Edges { runs, .. } => assert!(runs.iter().all(|run| run.object < 9) && runs.len() < 9),
                _ => {}
            }
        }
    }
}

#[test]
fn a_picture_of_nothing_needs_no_filter() {
    let mut scene = scene("builtin:gear", 64, 64);
    scene.camera.eye = scene.centre + DVec3::Z * scene.radius * 5.0;
    scene.camera.target = scene.camera.eye + DVec3::Z;
    let PrunedPlan { plan, .. } = pruned(&scene, &cartoon(|_| {}));
    assert_eq!(plan.steps().count(), 1, "{plan}");
    let mut renderer = renderer(BACKENDS[0]);
    let picture = renderer.draw(&scene, &plan).unwrap();
    assert!(picture.pixels.iter().all(|byte| *byte == 255));
}

#[test]
fn faces_are_left_out_before_the_driver_culls_them_only_where_it_culls() {
    let scene = scene("builtin:open-box", 64, 64);
    let culled = cartoon(|cartoon| cartoon.cull_back_faces = true);
    assert!(applies(Rule::CulledFaces, &scene, &culled));
    assert!(!applies(Rule::CulledFaces, &scene, &cartoon(|_| {})));
    let on_a_device = Pruning { is_software: false, ..every_rule() };
    let plan = culled.plan(&scene, Show::Final).unwrap();
    let kept = prune(&plan, &scene, &on_a_device).kept;
    assert!(kept.iter().any(|one| one.rule == Rule::CulledFaces && one.reason.contains("device")));
}

#[test]
fn faces_that_nobody_can_see_are_left_out_but_for_devices_and_draws_that_cull() {
    let scene = || scene("builtin:sphere", 256, 256);
    let plain = cartoon(|_| {});
    assert!(applies(Rule::HiddenFaces, &scene(), &plain));
    assert!(applies(Rule::HiddenFaces, &scene(), &Style::named(StyleName::Inking)));
    assert!(!applies(Rule::HiddenFaces, &scene(), &cartoon(|cartoon| cartoon.cull_back_faces = true)));
    let plan = plain.plan(&scene(), Show::Final).unwrap();
    let kept = prune(&plan, &scene(), &Pruning { is_software: false, ..every_rule() }).kept;
    assert!(kept.iter().any(|one| one.rule == Rule::HiddenFaces && one.reason.contains("device")));
}

#[test]
fn light_is_left_out_where_no_tone_depends_on_it() {
    let scene = scene("builtin:bust", 64, 64);
    let shaders = |style: &Style| {
        let plan = pruned(&scene, style).plan;
        let fragments: Vec<String> = draws(&plan)
            .filter_map(|draw| draw.program.as_ref())
            .flat_map(|program| program.fragments.iter().map(ToString::to_string))
            .collect();
        fragments.join(" ")
    };
    for with in [cartoon, two_pass] as [fn(fn(&mut Cartoon)) -> Style; 2] {
        let two = with(|cartoon| cartoon.tones.count = 2);
        assert!(applies(Rule::UnusedLight, &scene, &two));
        assert!(shaders(&two).contains("tone-diffuse") && !shaders(&two).contains("tone-steps"));
        let one = with(|cartoon| cartoon.tones.count = 1);
        assert!(applies(Rule::UnusedLight, &scene, &one));
        assert!(shaders(&one).contains("tone-one") && !shaders(&one).contains("tone-steps"));
        let three = with(|cartoon| cartoon.tones.levels[0] = 0.5);
        assert!(!applies(Rule::UnusedLight, &scene, &three));
        assert!(!applies(Rule::UnusedLight, &scene, &with(|_| {})), "the listing runs as it is");
    }
}

#[test]
fn a_background_square_is_left_out_unless_borders_or_rounding_need_it() {
    let on = |background: Background| {
        scene_with(
            "builtin:bust",
            SceneSettings { background, size: Size { width: 64, height: 64 }, ..Default::default() },
        )
    };
    let white = on(Background::Color(Color([1.0; 3])));
    assert!(applies(Rule::BackgroundSquare, &white, &cartoon(|_| {})));
    assert!(!applies(Rule::BackgroundSquare, &white, &cartoon(|cartoon| cartoon.background_square = false)));
    // Two-pass draws the outer half of its borders on it; its map's goes.
    let plan = pruned(&white, &two_pass(|_| {})).plan;
    assert_eq!(draws(&plan).filter(|draw| matches!(draw.geometry, Geometry::BackgroundSquare { .. })).count(), 1);
    // Half is 127.5 of 255: its rounding depends on the driver.
    let grey = on(Background::Color(Color([0.5; 3])));
    let plan = pruned(&grey, &cartoon(|_| {})).plan;
    assert_eq!(draws(&plan).filter(|draw| matches!(draw.geometry, Geometry::BackgroundSquare { .. })).count(), 1);
    let biased = cartoon(|cartoon| cartoon.map_encoding = MapEncoding::Biased);
    let plan = pruned(&white, &biased).plan;
    assert_eq!(draws(&plan).filter(|draw| matches!(draw.geometry, Geometry::BackgroundSquare { .. })).count(), 1);
}

#[test]
fn squares_are_confined_to_where_objects_are_unless_they_fill_the_picture() {
    let small = |distance: f64| {
        let mut scene = scene("builtin:gear", 128, 128);
        scene.camera.eye = scene.centre + (scene.camera.eye - scene.centre) * distance;
        scene.camera.far *= distance;
        scene
    };
    for style in [cartoon(|_| {}), two_pass(|_| {}), Style::Ink(Ink::default())] {
        assert!(applies(Rule::EmptyPixels, &small(3.0), &style));
        let plan = pruned(&small(3.0), &style).plan;
        assert_eq!(draws(&plan).filter(|draw| draw.scissor.is_some()).count(), 1);
        let close = small(0.35);
        assert!(!applies(Rule::EmptyPixels, &close, &style));
    }
    // The paper is everywhere.
    assert!(!applies(Rule::EmptyPixels, &small(3.0), &Style::Charcoal(Charcoal::default())));
}

#[test]
fn a_colour_is_not_cleared_where_a_square_covers_all_of_it() {
    let scene = scene("builtin:bust", 64, 64);
    let charcoal = Style::Charcoal(Charcoal::default());
    let plan = charcoal.plan(&scene, Show::Final).unwrap();
    let on_a_device = prune(&plan, &scene, &Pruning { is_software: false, ..every_rule() });
    assert!(on_a_device.omissions.iter().any(|one| one.rule == Rule::OverwrittenClear));
    let mut renderer = renderer(BACKENDS[0]);
    assert_eq!(renderer.draw(&scene, &plan).unwrap(), renderer.draw(&scene, &on_a_device.plan).unwrap());
    assert!(!applies(Rule::OverwrittenClear, &scene, &charcoal), "tiles that are not cleared are read first");
    assert!(!applies(Rule::OverwrittenClear, &scene, &Style::Phong(Phong::default())));
    let transparent = SceneSettings { background: Background::Transparent, ..SceneSettings::default() };
    let transparent = scene_with("builtin:bust", transparent);
    assert!(!applies(Rule::OverwrittenClear, &transparent, &Style::Charcoal(Charcoal::default())), "no paper there");
}

#[test]
fn textures_that_no_step_reads_are_left_out_and_the_others_keep_their_pictures() {
    let scene = scene("builtin:bust", 64, 64);
    let charcoal = Style::Charcoal(Charcoal::default());
    assert!(!applies(Rule::UnreadTextures, &scene, &charcoal));
    let plan = charcoal.plan(&scene, Show::Paper).unwrap();
    let short = prune(&plan, &scene, &every_rule());
    assert!(short.omissions.iter().any(|one| one.rule == Rule::UnreadTextures), "noise and grain");
    let names: Vec<&str> = short.plan.pictures.iter().map(|picture| picture.name).collect();
    assert_eq!(names, ["paper"]);
    let mut renderer = renderer(BACKENDS[0]);
    assert_eq!(renderer.draw(&scene, &plan).unwrap(), renderer.draw(&scene, &short.plan).unwrap());
}

#[test]
fn edges_turned_away_and_joints_are_options_of_a_style_for_they_show_a_little() {
    let scene = scene("builtin:gear", 128, 128);
    let draw = |renderer: &mut Renderer, inking: Inking| {
        let plan = Style::Inking(inking).plan(&scene, Show::Final).unwrap();
        let ends = draws(&plan).filter_map(|draw| match &draw.geometry {
            Geometry::Edges { runs, .. } => Some(runs.iter().map(|run| run.ends.len()).sum::<usize>()),
            _ => None,
        });
        let ends: Vec<usize> = ends.collect();
        (ends, renderer.draw(&scene, &plan).unwrap())
    };
    let mut renderer = renderer(BACKENDS[0]);
    let (all, as_published) = draw(&mut renderer, Inking::default());
    let (front, without_back) = draw(&mut renderer, Inking { back_edges: false, ..Inking::default() });
    let (lines, without_joints) = draw(&mut renderer, Inking { has_joints: false, ..Inking::default() });
    assert!(front[0] < all[0] * 9 / 10, "{front:?} of {all:?} edges");
    assert_eq!((all.len(), lines.len()), (2, 1), "lines and points, lines alone");
    for picture in [&without_back, &without_joints] {
        let difference = as_published.difference(picture).unwrap();
        assert!(difference.pixels < scene.size.pixel_count() / 20, "{difference:?}");
    }
    assert!(as_published != without_joints, "the points close notches between smoothed lines");
}

/// Settings under which plans differ.
pub fn many_styles() -> Vec<Style> {
    let border = |change: fn(&mut Border)| {
        move |cartoon: &mut Cartoon| {
            let mut border = Border::default();
            change(&mut border);
            cartoon.border = Some(border);
        }
    };
    let mut styles: Vec<Style> =
        StyleName::of_passes().filter(|(name, _)| *name != "sand").map(|(_, style)| Style::named(style)).collect();
    for with in [cartoon, two_pass] as [fn(Box<dyn FnOnce(&mut Cartoon)>) -> Style; 2] {
        styles.push(with(Box::new(|cartoon| cartoon.tones.count = 1)));
        styles.push(with(Box::new(|cartoon| cartoon.tones.count = 2)));
        styles.push(with(Box::new(|cartoon| cartoon.border = None)));
        styles.push(with(Box::new(|cartoon| cartoon.cull_back_faces = true)));
        styles.push(with(Box::new(|cartoon| cartoon.background_square = false)));
        styles.push(with(Box::new(border(|border| border.filter = Filter::Sobel))));
        styles.push(with(Box::new(border(|border| border.width = Some(LineWidth::Pixels(5))))));
        styles.push(with(Box::new(border(|border| border.slope_threshold = true))));
        styles.push(with(Box::new(border(|border| border.detection_factor = 0.0))));
        styles.push(with(Box::new(|cartoon| cartoon.supersample = Supersample::Two)));
        for (_, encoding) in MapEncoding::ALL {
            styles.push(with(Box::new(move |cartoon| cartoon.map_encoding = encoding)));
        }
    }
    styles.push(cartoon(Box::new(border(|border| border.filter = Filter::MitchellTwo))));
    styles.push(Style::Ink(Ink { cull_back_faces: true, supersample: Some(Supersample::Two), ..Ink::default() }));
    for map_target in [MapTarget::Copy, MapTarget::Texture] {
        styles.push(Style::Ink(Ink {
            quality: Quality::Best,
            supersample: Some(Supersample::One),
            line_width: LineWidth::Pixels(5),
            map_target,
            ..Ink::default()
        }));
    }
    styles.push(Style::Dietrich(Dietrich { cull_back_faces: true, ..Dietrich::default() }));
    styles.push(Style::Inking(Inking { line_width: Length::Px(7.0), ..Inking::default() }));
    styles
}

#[test]
fn pruning_twice_is_pruning_once_and_the_target_of_the_last_pass_stays() {
    for scene in [scene("builtin:ant", 80, 60), scene("builtin:gear", 80, 60), beside("builtin:bust")] {
        for style in many_styles() {
            for show in [Show::Final, Show::Tones, Show::Borders, Show::Map] {
                let Ok(plan) = style.plan(&scene, show) else { continue };
                let once = prune(&plan, &scene, &every_rule());
                let twice = prune(&once.plan, &scene, &every_rule());
                assert_eq!(twice.omissions, [], "{plan}\n{}", once.plan);
                assert_eq!(twice.plan, once.plan);
                let last = |plan: &Plan| plan.passes.last().map(|pass| pass.target);
                assert_eq!(last(&once.plan), last(&plan));
                assert_eq!((once.plan.output, once.plan.supersample), (plan.output, plan.supersample));
            }
        }
    }
}

#[test]
fn a_rule_that_is_to_be_kept_is_not_applied() {
    let scene = scene("builtin:bust", 64, 64);
    let plan = cartoon(|cartoon| cartoon.border = None).plan(&scene, Show::Final).unwrap();
    for (name, rule) in Rule::ALL {
        assert_eq!((name.parse(), rule.name()), (Ok(rule), name));
        let kept = prune(&plan, &scene, &Pruning { keep: vec![rule], ..every_rule() });
        assert!(kept.omissions.iter().all(|omission| omission.rule != rule));
    }
    let all = Pruning { keep: Rule::ALL.map(|(_, rule)| rule).to_vec(), ..every_rule() };
    assert_eq!(prune(&plan, &scene, &all).plan, plan);
}

#[test]
fn only_the_shaders_that_the_shorter_plan_names_are_compiled_warming_up_included() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:open-box", 64, 64);
    let style = cartoon(|cartoon| (cartoon.border, cartoon.tones.count) = (None, 1));
    let settings = SceneSettings { size: scene.size, ..SceneSettings::default() };
    let pruning = renderer.pruning();
    renderer.warm_up(&settings, &style, Show::Final, Some(&pruning)).unwrap();
    let warm = renderer.programs();
    renderer.render(&scene, &style).unwrap();
    assert_eq!(renderer.programs(), warm, "nothing is compiled when the models are there");
    let fragments = vec!["evangelista/toon-settings.frag", "improved/tone-one.frag"];
    assert_eq!(warm, [tinta::plan::Program::new("evangelista/toon.vert", fragments)]);
}

#[test]
fn plain_culling_would_not_pass_these_tests() {
    let view = View { azimuth_degrees: 30.0, elevation_degrees: 15.0 };
    let camera = CameraSettings { view, ..CameraSettings::default() };
    let scene = scene_with("builtin:bust", SceneSettings { camera, ..SceneSettings::default() });
    let mut renderer = renderer(BACKENDS[0]);
    let full = renderer.render(&scene, &cartoon(|_| {})).unwrap();
    let culled = renderer.render(&scene, &cartoon(|cartoon| cartoon.cull_back_faces = true)).unwrap();
    let difference = full.difference(&culled).unwrap();
    assert!((1..100).contains(&difference.pixels), "{difference:?}");
}
