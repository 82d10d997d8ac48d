//! Draws a model's visible lines as SVG, with no crate but this one.
//!
//! `cargo run -p tinta-geometry --example exact_svg -- cow.obj cow.svg`

use tinta_geometry::lines::svg;
use tinta_geometry::{DrawingSettings, LineSettings, LoadOptions, Scene, SceneSettings, VisibleLines, load};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let model = words.next().unwrap_or_else(|| "models/gear.obj".to_owned());
    let output = words.next().unwrap_or_else(|| "lines.svg".to_owned());
    std::fs::write(output, draw(&model)?)?;
    Ok(())
}

/// The SVG's text.
pub fn draw(model: &str) -> tinta_geometry::Result<String> {
    let mesh = load(model, &LoadOptions::default())?.mesh;
    let scene = Scene::new([mesh], &SceneSettings::default())?;
    svg(&VisibleLines::of(&scene, &LineSettings::default())?, &DrawingSettings::default())
}
