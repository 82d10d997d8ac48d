//! Vertices by buffers and one by one: the same bytes in every style, and the errors where they are impossible.

use crate::support::{BACKENDS, Folder, renderer, scene, scene_with, styles, textured};
use tinta::edges::SilhouetteRule;
use tinta::gl::Fault;
use tinta::lines::Length;
use tinta::plan::prune::prune;
use tinta::plan::{LineDrawing, Plan, Submission};
use tinta::styles::{Inking, LightOn, PaintMode, RampRow};
use tinta::{Backend, Picture, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName};

fn drawn(renderer: &mut Renderer, scene: &Scene, plan: &Plan, submission: Submission) -> Picture {
    renderer.draw(scene, &Plan { submission, ..plan.clone() }).unwrap()
}

/// glBegin and glEnd draw this plan as buffers do, first and again.
fn check(renderer: &mut Renderer, scene: &Scene, plan: &Plan, what: &str) {
    let expected = drawn(renderer, scene, plan, Submission::Buffers);
    for _ in 0..2 {
        let actual = drawn(renderer, scene, plan, Submission::Immediate);
        let different = expected.difference(&actual).map(|difference| difference.pixels);
        assert_eq!(different, Some(0), "{what}");
    }
}

#[test]
fn ink_and_paint_are_the_same_bytes_by_every_way_to_hand_vertices_over() {
    let base = Inking::default;
    let variants = [
        base(),
        Inking { is_smooth: false, silhouette: SilhouetteRule::Exact, writes_depth: false, ..base() },
        Inking { paint: PaintMode::None, line_drawing: LineDrawing::Quads, line_width: Length::Px(3.0), ..base() },
        Inking { paint: PaintMode::Flat, has_joints: false, ..base() },
        Inking { silhouette: SilhouetteRule::Smooth, ..base() },
        Inking { paint: PaintMode::FlatShaded, ramp_row: RampRow::Own, ..base() },
        Inking { paint: PaintMode::Gouraud, is_inked: false, ..base() },
        Inking { light: LightOn::VertexShader, ramp_row: RampRow::Object, cull_back_faces: true, ..base() },
    ];
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for model in ["builtin:bust", "builtin:gear"] {
            let settings =
                SceneSettings { size: Size { width: 160, height: 150 }, copies: 2, ..SceneSettings::default() };
            let scene = scene_with(model, settings);
            for inking in &variants {
                let plan = Style::Inking(inking.clone()).plan(&scene, Show::Final).unwrap();
                check(&mut renderer, &scene, &plan, &format!("{backend:?}: {model}, {inking:?}"));
                // Lists of some of the faces, too.
                let short = prune(&plan, &scene, &renderer.pruning()).plan;
                check(
                    &mut renderer,
                    &scene,
                    &short,
                    &format!("{backend:?}: {model} without what is culled, {inking:?}"),
                );
            }
        }
        assert_eq!(renderer.close(), 0);
    }
}

#[test]
fn every_style_draws_the_same_bytes_by_every_way_to_hand_vertices_over() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 96, 80);
    for (name, style) in styles() {
        let plan = style.plan(&scene, Show::Final).unwrap();
        check(&mut renderer, &scene, &plan, name);
    }
}

#[test]
fn a_models_own_picture_lies_the_same_by_every_way_to_hand_vertices_over() {
    let folder = Folder::new();
    let model = textured(&folder);
    let mesh = tinta::load(&model, &tinta::LoadOptions::default()).unwrap().mesh;
    let settings = SceneSettings { size: Size { width: 80, height: 80 }, ..SceneSettings::default() };
    let scene = Scene::new(vec![std::sync::Arc::new(mesh)], &settings).unwrap();
    let mut renderer = renderer(BACKENDS[0]);
    // Alone on the first unit, behind the ramp on the second, and in shaders.
    let textured = |paint| Style::Inking(Inking { paint, has_texture: true, ..Inking::default() });
    for style in [textured(PaintMode::Flat), textured(PaintMode::Ramp), Style::named(StyleName::Sand)] {
        let plan = style.plan(&scene, Show::Final).unwrap();
        check(&mut renderer, &scene, &plan, style.name());
    }
}

#[test]
fn vertices_sent_one_by_one_leave_no_objects() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 64, 64);
    let plan = Style::named(StyleName::Inking).plan(&scene, Show::Final).unwrap();
    drawn(&mut renderer, &scene, &plan, Submission::Buffers);
    let without = renderer.live_objects();
    drawn(&mut renderer, &scene, &plan, Submission::Immediate);
    assert_eq!(renderer.live_objects(), without);
    assert_eq!(renderer.close(), 0);
}

#[test]
fn a_driver_without_glbegin_says_so_in_a_sentence_and_draws_from_buffers() {
    let scene = scene("builtin:open-box", 48, 48);
    let plan = Style::named(StyleName::Inking).plan(&scene, Show::Final).unwrap();
    for backend in *BACKENDS {
        let mut core = Renderer::with_fault(backend, Fault::NoImmediateMode).unwrap();
        let immediate = Plan { submission: Submission::Immediate, ..plan.clone() };
        let error = core.draw(&scene, &immediate).unwrap_err().to_string();
        assert!(error.starts_with("submission immediate: "), "{error}");
        assert!(error.contains("has no glBegin") && error.contains("leave this out"), "{error}");
        let expected = drawn(&mut renderer(backend), &scene, &plan, Submission::Buffers);
        assert_eq!(drawn(&mut core, &scene, &plan, Submission::Buffers), expected);
    }
}

#[test]
fn the_plan_says_how_vertices_are_handed_over() {
    let scene = scene("builtin:open-box", 48, 48);
    let plan = Style::named(StyleName::Inking).plan(&scene, Show::Final).unwrap();
    let said = |submission| Plan { submission, ..plan.clone() }.to_string().lines().next().unwrap().to_owned();
    assert_eq!(said(Submission::Buffers), "pass 1: paint");
    assert_eq!(said(Submission::Immediate), "vertices sent one by one, by glBegin and glEnd");
}

#[test]
fn nobody_needs_glbegin_but_for_what_it_draws() {
    // The whole program uses buffers by default.
    let mut core = Renderer::with_fault(Backend::Auto, Fault::NoImmediateMode).unwrap();
    let scene = scene("builtin:ant", 40, 40);
    for (name, style) in styles() {
        core.render(&scene, &style).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
