//! Leaving out what a scene does not need: each rule where it applies and where it must not, and pictures byte for byte.

use crate::support::{BACKENDS, public_models, renderer, scene, scene_with, skip};
use glam::DVec3;
use std::sync::Arc;
use tinta::plan::prune::{Pruned, Pruning, Rule, prune};
use tinta::plan::{Draw, Faces, Geometry, Plan, Step};
use tinta::styles::{Border, Cartoon, Charcoal, Dietrich, Filter, Ink, Inking, MapEncoding, Phong, Supersample};
use tinta::{
    Backend, Background, CameraSettings, Color, LoadOptions, Mesh, Renderer, Scene, SceneSettings, Show, Size, Style,
    StyleName, View, load,
};

/// As if many pictures were to come, so that every rule is worth its time.
fn every_rule() -> Pruning {
    Pruning { pictures: u32::MAX, subpixel_bits: 8, ..Pruning::default() }
}

fn pruned(scene: &Scene, style: &Style) -> Pruned {
    prune(&style.plan(scene, Show::Final).unwrap(), scene, &every_rule())
}

/// Whether the rule left something out.
fn applies(rule: Rule, scene: &Scene, style: &Style) -> bool {
    let Pruned { omissions, kept, .. } = pruned(scene, style);
    let found: Vec<&str> = omissions.iter().filter(|one| one.rule == rule).map(|one| one.what.as_str()).collect();
    let reasons: Vec<&str> = kept.iter().filter(|one| one.rule == rule).map(|one| one.reason.as_str()).collect();
    assert_eq!(found.len() + reasons.len(), 1, "each rule says what it did or why it did not: {rule}");
    assert!(found.iter().chain(&reasons).all(|text| text.len() > 5));
    !found.is_empty()
}

fn cartoon(change: impl FnOnce(&mut Cartoon)) -> Style {
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

/// A sphere of 20 * 4^cuts triangles, an icosahedron cut again and again.
fn ball(cuts: u32) -> Scene {
    let golden = 0.5 + 1.25f64.sqrt();
    let corner = |number: usize| {
        let [a, b] = [number & 1, number >> 1 & 1].map(|bit| if bit == 1 { 1.0 } else { -1.0 });
        DVec3::from_array([[0.0, a, b * golden], [a, b * golden, 0.0], [b * golden, 0.0, a]][number / 4]).normalize()
    };
    let corners: Vec<DVec3> = (0..12).map(corner).collect();
    let near = |a: DVec3, b: DVec3| a.distance(b) < 1.2;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|number| corners[number]);
                if near(p, q) && near(q, r) && near(r, p) {
                    let is_outward = (q - p).cross(r - p).dot(p) > 0.0;
                    faces.push(if is_outward { [p, q, r] } else { [p, r, q] });
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    for _ in 0..cuts {
        let middle = |a: DVec3, b: DVec3| (a + b).normalize();
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let mut text = String::new();
    for point in faces.as_flattened() {
        text.push_str(&format!("v {} {} {}\n", point.x, point.y, point.z));
    }
    (0..faces.len()).for_each(|face| text.push_str(&format!("f {} {} {}\n", face * 3 + 1, face * 3 + 2, face * 3 + 3)));
    let file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
    std::fs::write(file.path(), text).unwrap();
    scene_with(
        file.path().to_str().unwrap(),
        SceneSettings { size: Size { width: 256, height: 256 }, ..Default::default() },
    )
}

/// A scene looked at from the side, so that most of its copies are outside the picture.
fn beside(model: &str) -> Scene {
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
    // With its square goes the map it would have read.
    assert!(applies(Rule::UnreadMap, &scene, &with(0.0)));
    assert_eq!(pruned(&scene, &with(0.0)).plan.passes.len(), 1);
}

#[test]
fn a_map_is_left_out_where_no_border_reads_it() {
    let scene = scene("builtin:bust", 64, 64);
    for style in [cartoon(|cartoon| cartoon.border = None), Style::Ink(Ink { is_inked: false, ..Ink::default() })] {
        assert!(applies(Rule::UnreadMap, &scene, &style));
        let names: Vec<&str> = pruned(&scene, &style).plan.passes.iter().map(|pass| pass.name).collect();
        assert_eq!(names, ["tones"]);
    }
    assert!(!applies(Rule::UnreadMap, &scene, &cartoon(|_| {})));
    let float = cartoon(|cartoon| (cartoon.border, cartoon.map_encoding) = (None, MapEncoding::Float));
    assert!(applies(Rule::UnreadMap, &scene, &float));
    assert!(!applies(Rule::UnreadMap, &scene, &cartoon(|cartoon| cartoon.map_encoding = MapEncoding::DepthTexture)));
}

#[test]
fn objects_outside_the_picture_are_left_out_with_their_edges() {
    let (beside, whole) = (beside("builtin:gear"), scene("builtin:gear", 90, 70));
    for (name, style) in StyleName::ALL.iter().filter(|(name, _)| *name != "sand") {
        let style = Style::named(*style);
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
    let Pruned { plan, .. } = pruned(&scene, &cartoon(|_| {}));
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
fn hidden_faces_are_left_out_of_a_closed_model_and_not_of_an_open_one_that_is_looked_into() {
    let phong = Style::Phong(Phong::default());
    let ball = ball(4);
    assert!(applies(Rule::HiddenFaces, &ball, &phong));
    // Most of a gear's faces are near its outlines from every side.
    assert!(!applies(Rule::HiddenFaces, &scene("builtin:gear", 128, 128), &phong));
    assert!(!applies(Rule::HiddenFaces, &scene("builtin:open-box", 128, 128), &phong));
    // Polygon offset may push a front face behind the back one that it hides.
    assert!(!applies(Rule::HiddenFaces, &ball, &Style::Inking(Inking::default())));
    let plan = phong.plan(&ball, Show::Final).unwrap();
    let fresh = self::ball(3);
    let once = prune(&plan, &fresh, &Pruning { pictures: 1, ..every_rule() });
    assert!(once.kept.iter().any(|one| one.rule == Rule::HiddenFaces && one.reason.contains("longer")));
}

#[test]
fn light_is_left_out_where_no_tone_depends_on_it() {
    let scene = scene("builtin:bust", 64, 64);
    let shaders = |style: &Style| {
        let plan = pruned(&scene, style).plan;
        let fragments: Vec<&str> = draws(&plan)
            .filter_map(|draw| draw.program.as_ref())
            .flat_map(|program| program.fragments.clone())
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
    // Half is 127.5 of 255: which way that rounds is the driver's.
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
fn many_styles() -> Vec<Style> {
    let border = |change: fn(&mut Border)| {
        move |cartoon: &mut Cartoon| {
            let mut border = Border::default();
            change(&mut border);
            cartoon.border = Some(border);
        }
    };
    let mut styles: Vec<Style> =
        StyleName::ALL.iter().filter(|(name, _)| *name != "sand").map(|(_, style)| Style::named(*style)).collect();
    for with in [cartoon, two_pass] as [fn(Box<dyn FnOnce(&mut Cartoon)>) -> Style; 2] {
        styles.push(with(Box::new(|cartoon| cartoon.tones.count = 1)));
        styles.push(with(Box::new(|cartoon| cartoon.tones.count = 2)));
        styles.push(with(Box::new(|cartoon| cartoon.border = None)));
        styles.push(with(Box::new(|cartoon| cartoon.cull_back_faces = true)));
        styles.push(with(Box::new(|cartoon| cartoon.background_square = false)));
        styles.push(with(Box::new(border(|border| border.filter = Filter::Sobel))));
        styles.push(with(Box::new(border(|border| border.width_px = Some(5)))));
        styles.push(with(Box::new(border(|border| border.slope_threshold = true))));
        styles.push(with(Box::new(border(|border| border.detection_factor = 0.0))));
        styles.push(with(Box::new(|cartoon| cartoon.supersample = Supersample::Two)));
        for (_, encoding) in MapEncoding::ALL {
            styles.push(with(Box::new(move |cartoon| cartoon.map_encoding = encoding)));
        }
    }
    styles.push(Style::Ink(Ink { cull_back_faces: true, supersample: Some(Supersample::Two), ..Ink::default() }));
    styles.push(Style::Dietrich(Dietrich { cull_back_faces: true, ..Dietrich::default() }));
    styles.push(Style::Inking(Inking { line_width_px: 7.0, ..Inking::default() }));
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
    let pruning = Pruning::for_context(renderer.context(), 1);
    renderer.warm_up(&settings, &style, Show::Final, Some(&pruning)).unwrap();
    let warm = renderer.programs();
    renderer.render(&scene, &style).unwrap();
    assert_eq!(renderer.programs(), warm, "nothing is compiled when the models are there");
    let fragments = vec!["evangelista/toon-settings.frag", "improved/tone-one.frag"];
    assert_eq!(warm, [tinta::plan::Program { vertex: "evangelista/toon.vert", fragments }]);
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

/// Numbers from 0 to 1 that look random and are always the same.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The scene from a view of its own: any direction, sometimes from nearer or looking past it, sometimes in parallel.
fn random_view(scene: &Scene, dice: &mut Dice) -> Scene {
    let view =
        View { azimuth_degrees: dice.roll() * 360.0, elevation_degrees: (dice.roll() * 2.0 - 1.0).asin().to_degrees() };
    let parallel = dice.roll() < 0.2;
    let settings = SceneSettings {
        size: Size { width: 40 + (dice.roll() * 120.0) as u32, height: 40 + (dice.roll() * 120.0) as u32 },
        camera: CameraSettings {
            view,
            parallel,
            fov_y_degrees: 10.0 + dice.roll() * 60.0,
            ..CameraSettings::default()
        },
        ..SceneSettings::default()
    };
    let meshes = scene.objects.iter().map(|object| object.mesh.clone()).collect();
    let fitted = Scene::new(meshes, &settings).unwrap();
    let mut scene = Scene { camera: fitted.camera, size: fitted.size, ..scene.clone() };
    if dice.roll() < 0.3 {
        let aside = DVec3::new(dice.roll() - 0.5, dice.roll() - 0.5, dice.roll() - 0.5) * scene.radius;
        (scene.camera.eye, scene.camera.target) = (scene.camera.eye + aside, scene.camera.target + aside);
        scene.camera.near *= 0.5;
        scene.camera.far *= 1.5;
    }
    scene
}

/// Draws many views of a model in every style, in full and pruned, and compares the bytes.
fn verify(renderer: &mut Renderer, mesh: &Arc<Mesh>, views: usize) {
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default()).unwrap();
    let has_skin = !mesh.triangle_texture_coordinates.is_empty() && mesh.materials.iter().any(|m| m.texture.is_some());
    let mut styles: Vec<Style> = StyleName::ALL
        .iter()
        .filter(|(name, _)| *name != "sand" || has_skin)
        .map(|(_, style)| Style::named(*style))
        .collect();
    styles.push(cartoon(|cartoon| (cartoon.cull_back_faces, cartoon.tones.count) = (true, 2)));
    let pruning = Pruning { pictures: u32::MAX, ..Pruning::for_context(renderer.context(), 1) };
    let mut dice = Dice(mesh.triangles.len() as u64);
    for number in 0..views {
        let view = random_view(&scene, &mut dice);
        for style in &styles {
            let plan = style.plan(&view, Show::Final).unwrap();
            let short = prune(&plan, &view, &pruning);
            let full = renderer.draw(&view, &plan).unwrap();
            // The second of two frames in a row: nothing of the first may be left in it.
            renderer.time_frames(&view, &short.plan, 0, 1).unwrap();
            let picture = renderer.draw(&view, &short.plan).unwrap();
            let difference = full.difference(&picture).unwrap();
            assert!(
                full == picture,
                "{} view {number} in {}: {difference:?} without {:?}",
                mesh.name,
                style.name(),
                short.omissions
            );
        }
    }
}

/// All models there are, by the name of each.
fn all_models() -> Vec<String> {
    let mut models: Vec<String> =
        tinta::mesh::BUILTINS.iter().map(|builtin| format!("builtin:{}", builtin.name)).collect();
    if let Some(folder) = public_models() {
        let files = ["ant.ply", "beethoven.obj", "cow.obj", "faerie.md2", "fandisk.obj", "spot/spot_triangulated.obj"];
        for file in files.into_iter().chain(["stanford-bunny.obj", "suzanne.obj", "teapot.obj"]) {
            let path = folder.join(file);
            match path.is_file() {
                true => models.push(path.display().to_string()),
                false => skip(&format!("{file}: not in {}", folder.display())),
            }
        }
    }
    models
}

fn verify_all(backend: Backend) {
    let mut renderer = renderer(backend);
    for model in all_models() {
        let mesh = Arc::new(load(&model, &LoadOptions::default()).unwrap().mesh);
        verify(&mut renderer, &mesh, 50);
    }
}

#[test]
fn fifty_views_of_every_model_in_every_style_are_the_same_bytes_by_egl() {
    verify_all(Backend::Egl);
}

#[test]
fn fifty_views_of_every_model_in_every_style_are_the_same_bytes_by_osmesa() {
    verify_all(Backend::OsMesa);
}

#[test]
fn every_setting_draws_the_same_bytes_pruned() {
    for backend in BACKENDS {
        let mut renderer = renderer(backend);
        let pruning = Pruning { pictures: u32::MAX, ..Pruning::for_context(renderer.context(), 1) };
        let grey = Background::Color(Color([0.5, 0.25, 0.125]));
        for background in [Background::Color(Color([1.0; 3])), grey, Background::Transparent] {
            let settings =
                SceneSettings { background, copies: 2, size: Size { width: 150, height: 90 }, ..Default::default() };
            for scene in [scene_with("builtin:gear", settings.clone()), Scene { background, ..beside("builtin:bust") }]
            {
                for style in many_styles() {
                    for show in [Show::Final, Show::Tones, Show::Borders, Show::Map] {
                        let Ok(plan) = style.plan(&scene, show) else { continue };
                        let short = prune(&plan, &scene, &pruning);
                        let full = renderer.draw(&scene, &plan).unwrap();
                        let picture = renderer.draw(&scene, &short.plan).unwrap();
                        assert!(full == picture, "{backend:?} {background:?}\n{plan}\n{}", short.plan);
                    }
                }
            }
        }
    }
}
