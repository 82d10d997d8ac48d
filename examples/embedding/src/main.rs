//! Draws a gear in three styles and in one of its own, and writes its visible lines, by tinta's library alone.
//!
//! `cargo run` in this folder writes `ink.png`, `three-pass.png`, `charcoal.png`, `screen.png` and `lines.svg`.

use std::collections::HashMap;
use tinta::lines::svg;
use tinta::plan::{Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Uniform, Value};
use tinta::{
    Backend, DrawingSettings, LineSettings, LoadOptions, Renderer, Scene, SceneSettings, Style, StyleName, TextTarget,
    VisibleLines, load,
};

fn main() -> tinta::Result<()> {
    let gear = load("builtin:gear", &LoadOptions::default())?.mesh;
    let scene = Scene::new([gear], &SceneSettings::default())?;
    let mut renderer = Renderer::new(Backend::Auto)?;
    for style in [StyleName::Ink, StyleName::ThreePass, StyleName::Charcoal] {
        renderer.render(&scene, &Style::named(style))?.save(&format!("{style}.png"))?;
    }
    let file = std::env::args().nth(1).unwrap_or_else(|| "screen.frag".to_owned());
    let text = std::fs::read_to_string(&file).expect("a fragment shader");
    renderer.replace_shaders(HashMap::from([(file.clone(), text)]))?;
    renderer.draw(&scene, &own_style(&scene, file))?.save("screen.png")?;
    let lines = VisibleLines::of(&scene, &LineSettings::default())?;
    TextTarget::check("lines.svg")?.write(&svg(&lines, &DrawingSettings::default())?)
}

/// One pass: clear, then all objects by a shader of tinta's and one from a file.
fn own_style(scene: &Scene, fragment: String) -> Plan {
    let program = Program::new("phong/phong.vert", [fragment]);
    let uniforms = vec![Uniform::new("distance", Value::Float(6.0))];
    let objects =
        Draw { uniforms, facts: Facts::plain(), ..Draw::new(Geometry::Objects(Paint::Materials), Some(program)) };
    Plan::new(vec![Pass::new("screen", vec![Step::clear(scene.background.clear_color()), Step::Draw(objects)])])
}
