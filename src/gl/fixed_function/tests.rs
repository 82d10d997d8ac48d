//! Tests that the shaders draw the same picture as the driver's pipeline.

use crate::gl::Backend;
use crate::gl::context::Context;
use crate::gl::execute::Resources;
use crate::mesh::load;
use crate::picture::Picture;
use crate::plan::{Plan, Tile};
use crate::scene::{Scene, SceneSettings, Size};
use crate::settings::{OptionValue, Options};
use crate::styles::{Show, Style, StyleName};

const SIZE: Size = Size { width: 256, height: 256 };

/// A plan drawn by the driver's pipeline or without it.
fn drawn(context: &Context, scene: &Scene, plan: &Plan, has_pipeline: bool) -> Picture {
    let _current = context.enter().unwrap();
    let mut resources = Resources::new(context.gl());
    resources.has_pipeline = has_pipeline;
    resources.prepare(scene, plan).unwrap();
    resources.begin_tile(plan, Tile::whole(SIZE)).unwrap();
    for pass in &plan.passes {
        resources.begin(pass.target, pass.scissor).unwrap();
        pass.steps.iter().for_each(|step| resources.step(scene, step).unwrap());
    }
    let mut pixels = vec![0; SIZE.pixel_count() * 4];
    resources.read_framebuffer(Tile::whole(SIZE).drawn, &mut pixels);
    resources.check("a test").unwrap();
    resources.clear();
    Picture { size: SIZE, pixels }
}

/// The model, options, and how many pixels drawn in both ways differ by more than each of these many of 255.
fn different<const N: usize>(model: &str, options: &[(&str, &str)], by: [u8; N]) -> [usize; N] {
    let mut context = Context::open(Backend::Egl, None).unwrap_or_else(|error| panic!("{error}"));
    context.resize(SIZE).unwrap();
    let mesh = load(&format!("builtin:{model}"), &Default::default()).unwrap().mesh;
    let scene = Scene::new([mesh], &SceneSettings { size: SIZE, ..SceneSettings::default() }).unwrap();
    let value = |text: &str| if text == "true" { OptionValue::Switch(true) } else { OptionValue::text(text) };
    let options: Options = options.iter().map(|(name, text)| ((*name).to_owned(), value(text))).collect();
    let style = Style::with_options(StyleName::Inking, &options).unwrap();
    let plan = style.plan(&scene, Show::Final).unwrap();
    let [with, without] = [true, false].map(|has_pipeline| drawn(&context, &scene, &plan, has_pipeline));
    let is_drawn = with.pixels.chunks_exact(4).any(|pixel| pixel != with.pixel(0, 0));
    assert!(is_drawn, "something is drawn");
    let pairs = with.pixels.chunks_exact(4).zip(without.pixels.chunks_exact(4));
    let farthest = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let differences: Vec<u8> = pairs.map(farthest).collect();
    by.map(|by| differences.iter().filter(|difference| **difference > by).count())
}

#[test]
fn faces_and_textures_are_those_of_the_pipeline() {
    for (model, options) in [
        ("soldier", &[("texture", "on"), ("no-borders", "true")][..]),
        ("bust", &[("no-borders", "true")]),
        ("bust", &[("no-borders", "true"), ("light", "vertex-shader")]),
        ("gear", &[("smooth", "off"), ("line-width", "1")]),
    ] {
        assert_eq!(different(model, options, [1]), [0], "{model} {options:?}");
    }
}

#[test]
fn smoothed_lines_are_those_of_the_pipeline() {
    // Of a box, where hardly a line lies on a face so steep that the last bits of depths decide which of its pixels are seen.
    let options = [("joints", "off"), ("line-width", "3")];
    let [any, some, many] = different("open-box", &options, [2, 8, 32]);
    let said = format!("{any}, {some}, {many} pixels differ by more than 2, 8, 32 of 255");
    assert!(any * 1000 <= SIZE.pixel_count(), "{said}");
}
