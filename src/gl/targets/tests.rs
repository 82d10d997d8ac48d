use super::*;
use crate::gl::Backend;
use crate::gl::context::Context;
use crate::mesh::Mesh;
use crate::plan::{Attachment, SettingValue};
use crate::renderer::Renderer;
use crate::scene::{Scene, SceneSettings};
use crate::styles::{Cartoon, Ink, MapEncoding, MapTarget, Show, Style, StyleName};
use std::sync::Arc;

fn plan(style: &Style) -> Plan {
    let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
    style.plan(&scene, Show::Final).unwrap()
}

fn cartoon(map_encoding: MapEncoding, map_target: MapTarget) -> Style {
    Style::ThreePass(Cartoon { map_encoding, map_target, ..Cartoon::default() })
}

#[test]
fn what_a_driver_lacks_is_refused_by_the_option_that_asks_for_it() {
    let context = Context::open(Backend::Auto, None).unwrap_or_else(|error| panic!("{error}"));
    let able = ContextInfo { renderer: "Voodoo 2".to_owned(), ..context.info().clone() };
    let old = ContextInfo { framebuffer_objects: false, draw_buffers: 1, float_targets: false, ..able.clone() };
    let single = ContextInfo { draw_buffers: 1, ..able.clone() };
    let no_float = ContextInfo { float_targets: false, ..able.clone() };
    let mrt = Style::named(StyleName::Mrt);
    let texture = cartoon(MapEncoding::Published, MapTarget::Texture);
    let ink = Style::Ink(Ink { map_target: MapTarget::Texture, ..Ink::default() });
    let float = cartoon(MapEncoding::Float, MapTarget::Copy);
    for style in [&mrt, &texture, &ink, &float] {
        check(&able, &plan(style)).unwrap();
    }
    let refused = |info: &ContextInfo, style: &Style| check(info, &plan(style)).unwrap_err().to_string();
    let no_objects = "Voodoo 2 has no framebuffer objects (ARB_framebuffer_object); use";
    assert_eq!(
        refused(&old, &mrt),
        format!("style mrt: {no_objects} --style three-pass, which draws the same picture except for rounding")
    );
    for style in [&texture, &ink] {
        assert_eq!(refused(&old, style), format!("map-target texture: {no_objects} --map-target copy"));
        check(&single, &plan(style)).unwrap();
        check(&no_float, &plan(style)).unwrap();
    }
    assert!(refused(&single, &mrt).starts_with("style mrt: Voodoo 2 draws into 1 buffer at once, not 2"));
    assert!(refused(&no_float, &float).starts_with("map-encoding float: Voodoo 2 cannot draw into floating-point"));
    check(&old, &plan(&Style::named(StyleName::ThreePass))).unwrap();
}

#[test]
fn one_texture_in_two_formats_is_an_error_and_leaves_nothing_behind() {
    const HALF: Attachments = Attachments {
        colors: &[Attachment { name: TextureName("Map"), format: Format::Float16 }],
        has_depth: false,
        asked_by: SettingValue { setting: "size", value: "8" },
        instead: SettingValue { setting: "size", value: "4" },
        instead_draws: None,
    };
    let context = Context::open(Backend::Auto, None).unwrap_or_else(|error| panic!("{error}"));
    let _current = context.enter().unwrap();
    let mut plan = plan(&cartoon(MapEncoding::Published, MapTarget::Texture));
    plan.passes[1].target = Target::Textures(&HALF);
    let mut targets = Targets::default();
    let size = Size { width: 8, height: 8 };
    assert!(targets.prepare(context.gl(), &plan, size).is_err());
    assert_eq!(context.gl().live_objects.get(), 0);
}

#[test]
fn depth_that_is_taken_draws_the_picture_of_depth_that_is_copied() {
    let mut compared = 0;
    for name in ["bust", "gear", "soldier"] {
        let mesh = Arc::new(crate::mesh::load(&format!("builtin:{name}"), &Default::default()).unwrap().mesh);
        let size = Size { width: 300, height: 220 };
        let scene = Scene::new(vec![mesh], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
        for map_target in [MapTarget::Copy, MapTarget::Texture] {
            let style = cartoon(MapEncoding::DepthTexture, map_target);
            for tile in [None, Some(Size { width: 160, height: 160 })] {
                let draw = |copies_depth| {
                    let mut renderer = Renderer::new(Backend::Auto).unwrap_or_else(|error| panic!("{error}"));
                    renderer.confine(tile);
                    renderer.copy_depth(copies_depth);
                    // Twice: the second picture takes the depth texture that the first left.
                    [style.clone(), Style::named(StyleName::ThreePass), style.clone()]
                        .map(|style| renderer.render(&scene, &style).unwrap())
                };
                let (copied, taken) = (draw(true), draw(false));
                assert!(copied.iter().all(|picture| picture.pixels.iter().any(|byte| *byte < 64)), "{name} is drawn");
                // The copied map and the taken one are drawn into different framebuffers, which may round an interpolated
                // normal the other way; the filter enlarges that.
                let bytes = |pictures: &[crate::Picture]| -> Vec<u8> {
                    pictures.iter().flat_map(|picture| picture.pixels.iter().copied()).collect()
                };
                let (copied, taken) = (bytes(&copied), bytes(&taken));
                assert_eq!(copied.len(), taken.len());
                let differing = copied.iter().zip(&taken).filter(|(a, b)| a != b).count();
                println!("{name} {map_target:?} {tile:?} {}: {differing} of {}", style.name(), copied.len());
                assert!(differing * 1000 < copied.len(), "{name} {map_target:?} {tile:?}: {differing}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 12);
}
