//! Draws a gear in three styles and writes its visible lines, by tinta's library alone.
//!
//! `cargo run` in this folder writes `ink.png`, `three-pass.png`, `charcoal.png` and `lines.svg`.

use tinta::lines::svg;
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
    let lines = VisibleLines::of(&scene, &LineSettings::default())?;
    TextTarget::check("lines.svg")?.write(&svg(&lines, &DrawingSettings::default())?)
}
