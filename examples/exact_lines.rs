//! Finds the visible lines of a model exactly and writes them as SVG, hidden ones dashed. No OpenGL is opened.
//!
//! `cargo run --example exact_lines -- cow.obj cow.svg`

use std::sync::Arc;
use tinta::edges::Class;
use tinta::lines::{HiddenLines, Length, svg};
use tinta::{DrawingSettings, LineSettings, LoadOptions, Scene, SceneSettings, TextTarget, VisibleLines, load};

fn main() -> tinta::Result<()> {
    let mut words = std::env::args().skip(1);
    let model = words.next().unwrap_or_else(|| "builtin:gear".to_owned());
    let output = words.next().unwrap_or_else(|| "lines.svg".to_owned());
    let (visible, hidden) = draw(&model, &output)?;
    println!("{visible} visible pieces of lines, {hidden} hidden ones");
    Ok(())
}

/// Writes a model's lines; how many pieces are visible and how many hidden.
pub fn draw(model: &str, output: &str) -> tinta::Result<(usize, usize)> {
    let target = TextTarget::check(output)?;
    let mesh = load(model, &LoadOptions::default())?.mesh;
    let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
    let lines = VisibleLines::of(&scene, &LineSettings::default())?;
    let creases = lines.segments.iter().filter(|segment| segment.class == Class::Crease).count();
    let settings = DrawingSettings {
        title: format!("{model}, {creases} pieces of creases"),
        hidden: HiddenLines::Dashed,
        line_width: Some(Length::Px(1.5)),
        ..DrawingSettings::default()
    };
    target.write(&svg(&lines, &settings)?)?;
    let visible = lines.segments.iter().filter(|segment| segment.is_visible).count();
    Ok((visible, lines.segments.len() - visible))
}
