use super::*;
use crate::mesh::Mesh;
use crate::picture::Picture;
use crate::plan::prune::{Pruning, prune};
use crate::plan::{Attachment, Attachments, Pass, PlanPicture, Program, Sampling, SettingValue};
use crate::scene::SceneSettings;
use crate::styles::{Cartoon, MapEncoding, MapTarget, Mrt, Show, Style, StyleName, Supersample, ToneLookup};
use std::sync::Arc;

const ASKED: SettingValue = SettingValue { setting: "map-target", value: "texture" };

fn scene() -> Scene {
    let settings = SceneSettings { size: Size { width: 8, height: 6 }, ..SceneSettings::default() };
    Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap()
}

fn three_pass() -> Plan {
    Style::named(StyleName::ThreePass).plan(&scene(), Show::Final).unwrap()
}

fn in_textures() -> Plan {
    let cartoon = Cartoon { map_target: MapTarget::Texture, ..Cartoon::default() };
    Style::ThreePass(cartoon).plan(&scene(), Show::Final).unwrap()
}

fn flaw(plan: &Plan) -> Flaw {
    plan.check(&scene()).expect_err("a flaw")
}

fn says(plan: &Plan, sentence: &str) {
    let found = flaw(plan).to_string();
    assert!(found.contains(sentence), "{found}");
}

fn draw_of(plan: &mut Plan, pass: usize) -> &mut Draw {
    let draws = plan.passes[pass].steps.iter_mut();
    draws.filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None }).next_back().unwrap()
}

#[test]
fn every_style_and_everything_it_shows_passes_pruned_or_not() {
    let scene = scene();
    let mut styles: Vec<Style> = StyleName::of_passes().map(|(_, name)| Style::named(name)).collect();
    for (_, map_encoding) in MapEncoding::ALL {
        for (_, map_target) in MapTarget::ALL {
            for supersample in [Supersample::One, Supersample::Two] {
                let mut cartoon = Cartoon { map_encoding, map_target, supersample, ..Cartoon::default() };
                styles.extend([Style::ThreePass(cartoon.clone()), Style::TwoPass(cartoon.clone())]);
                cartoon.tones.lookup = ToneLookup::Texture;
                cartoon.background_square = false;
                styles.extend([Style::ThreePass(cartoon.clone()), Style::TwoPass(cartoon)]);
            }
        }
    }
    styles.push(Style::Mrt(Mrt(Cartoon { supersample: Supersample::Four, ..Cartoon::default() })));
    let mut count = 0;
    for style in &styles {
        for (name, show) in Show::ALL {
            let Ok(plan) = style.plan(&scene, show) else { continue };
            assert_eq!(plan.check(&scene), Ok(()), "{name} of {plan}");
            for is_software in [true, false] {
                let short = prune(&plan, &scene, &Pruning { is_software, ..Pruning::default() }).plan;
                assert_eq!(short.check(&scene), Ok(()), "{name} of {short}");
            }
            count += 1;
        }
    }
    assert!(count > 200, "{count}");
}

#[test]
fn a_texture_that_is_read_before_it_is_made_is_found() {
    let mut plan = three_pass();
    plan.passes[0].steps.retain(|step| *step != Step::CopyFramebuffer);
    assert_eq!(flaw(&plan), Flaw::ReadBeforeWritten { pass: "border", what: "the texture BorderMap".to_owned() });
    // Its copy comes too late.
    let mut plan = three_pass();
    let map = plan.passes.remove(0);
    plan.passes.push(map);
    says(&plan, "the pass border reads the texture BorderMap before a step has written it");
    let mut plan = in_textures();
    let map = plan.passes.remove(0);
    plan.passes.push(map);
    assert!(matches!(flaw(&plan), Flaw::ReadBeforeWritten { pass: "border", .. }));
}

#[test]
fn what_an_earlier_picture_left_is_not_drawn_over() {
    let mut plan = three_pass();
    plan.passes[0].steps.remove(0);
    // The background square fills the picture, but depth is that of the picture before.
    says(&plan, "the pass map reads the depth buffer before");
    let mut plan = Style::named(StyleName::Phong).plan(&scene(), Show::Final).unwrap();
    plan.passes[0].steps[0] = Step::Clear { color: None, depth: true };
    says(&plan, "the pass phong reads the framebuffer before");
    // A plan that draws into textures and shows the framebuffer.
    let mut plan = in_textures();
    plan.passes.truncate(1);
    plan.passes.push(Pass::new("nothing", Vec::new()));
    says(&plan, "the pass nothing reads the framebuffer before");
    assert_eq!(flaw(&Plan::new(Vec::new())), Flaw::NoPass);
}

#[test]
fn targets_and_textures_that_are_not_there_are_found() {
    let mut plan = in_textures();
    plan.passes.remove(0);
    says(&plan, "the pass border needs a pass that draws the texture");
    let mut plan = three_pass();
    draw_of(&mut plan, 1).textures.push(("table", Texture::Table(0)));
    says(&plan, "the pass tones needs table 0");
    let mut plan = three_pass();
    draw_of(&mut plan, 1).textures.push(("paper", Texture::Picture(0)));
    says(&plan, "the pass tones needs picture 0");
    const FLAT: Attachments = Attachments {
        colors: &[Attachment { name: TextureName("Map"), format: Format::Unorm8 }],
        has_depth: false,
        ..NONE
    };
    const NONE: Attachments =
        Attachments { colors: &[], has_depth: true, asked_by: ASKED, instead: ASKED, instead_draws: None };
    let mut plan = in_textures();
    plan.passes[0].target = Target::Textures(&FLAT);
    says(&plan, "the pass map needs a depth buffer");
    plan.passes[0].target = Target::Textures(&NONE);
    says(&plan, "the pass map needs a texture to draw into");
    let mut plan = three_pass();
    plan.passes[0].steps[0] = Step::ClearEach { colors: vec![[0.0; 4]] };
    says(&plan, "the pass map needs textures to clear");
}

#[test]
fn a_texture_is_not_read_while_it_is_drawn_and_has_one_format() {
    const HALF: Attachments = Attachments {
        colors: &[Attachment { name: TextureName("Map"), format: Format::Float16 }],
        has_depth: true,
        asked_by: ASKED,
        instead: ASKED,
        instead_draws: None,
    };
    let mut plan = in_textures();
    plan.passes[2].target = plan.passes[0].target;
    assert_eq!(flaw(&plan), Flaw::ReadWhileWritten { pass: "border", name: TextureName("Map") });
    let mut plan = in_textures();
    plan.passes[1].target = Target::Textures(&HALF);
    assert_eq!(flaw(&plan), Flaw::TwoFormats { name: TextureName("Map") });
}

#[test]
fn sizes_that_do_not_fit_are_found() {
    let mut plan = three_pass();
    draw_of(&mut plan, 2).scissor = Some(Rectangle { x: 4, y: 0, width: 5, height: 6 });
    says(&plan, "what border is confined to is 5x6 pixels from (4, 0), not within 8x6");
    plan.supersample = 2;
    says(&plan, "the end of the plan is 2 times the picture, not the picture's size");
    let mut plan = three_pass();
    plan.passes[1].scissor = Some(Rectangle { x: u32::MAX, y: 0, width: 2, height: 1 });
    says(&plan, "what tones is confined to");
    let mut plan = three_pass();
    draw_of(&mut plan, 1).faces = Some(Arc::new(Vec::new()));
    says(&plan, "the list of faces in tones is 0, not 1 long");
    let mut plan = Style::named(StyleName::Inking).plan(&scene(), Show::Final).unwrap();
    let twice = Scene::new(
        vec![Arc::new(Mesh::triangle())],
        &SceneSettings { copies: 2, size: scene().size, ..SceneSettings::default() },
    );
    let found = plan.check(&twice.unwrap()).unwrap_err().to_string();
    assert!(found.contains("the list of coordinates"), "{found}");
    let picture = Arc::new(Picture { size: Size { width: 2, height: 2 }, pixels: vec![0; 4] });
    plan.pictures[0] = PlanPicture { name: "ramp", picture, sampling: Sampling::NearestClamped };
    says(&plan, "the picture ramp is 4 bytes, not 4 for each of 2x2 pixels");
    let mut plan = Style::named(StyleName::Mrt).plan(&scene(), Show::Final).unwrap();
    plan.passes[0].steps[0] = Step::ClearEach { colors: vec![[0.0; 4]] };
    says(&plan, "the list of colours that tones-and-map clears to is 1, not 2 long");
}

#[test]
fn a_square_that_fills_the_picture_needs_no_clear() {
    let program = Program::new("own/square.vert", ["own/square.frag"]);
    let square = Draw { depth: Depth::Ignore, ..Draw::new(Geometry::ScreenSquare, Some(program)) };
    let plan = Plan::new(vec![Pass::new("square", vec![Step::Draw(square)])]);
    assert_eq!(plan.check(&scene()), Ok(()));
}
