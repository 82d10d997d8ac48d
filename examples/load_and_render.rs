//! Reads a model and draws it in every style that needs no texture.
//!
//! `cargo run --example load_and_render -- cow.obj pictures` writes `pictures/three-pass.png` and so on.

use std::path::Path;
use std::sync::Arc;
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Size, Style, StyleName, Target, load};

fn main() -> tinta::Result<()> {
    let mut words = std::env::args().skip(1);
    let model = words.next().unwrap_or_else(|| "builtin:bust".to_owned());
    let folder = words.next().unwrap_or_else(|| ".".to_owned());
    for written in draw(&model, Path::new(&folder))? {
        println!("{written}");
    }
    Ok(())
}

/// Draws a model in every style into this folder; the names of the files.
pub fn draw(model: &str, folder: &Path) -> tinta::Result<Vec<String>> {
    let loaded = load(model, &LoadOptions::default())?;
    // Remarks about the file: faces left out, materials not found.
    loaded.remarks.iter().for_each(|remark| eprintln!("{remark}"));
    let settings = SceneSettings { size: Size { width: 240, height: 240 }, ..SceneSettings::default() };
    let scene = Scene::new(vec![Arc::new(loaded.mesh)], &settings)?;
    // Shaders, meshes and textures are kept from picture to picture.
    let mut renderer = Renderer::new(Backend::Auto)?;
    let mut written = Vec::new();
    for (name, style) in StyleName::of_passes() {
        if style == StyleName::Sand {
            continue;
        }
        let file = folder.join(format!("{name}.png")).display().to_string();
        // Checked before the work: a missing folder is reported now.
        let target = Target::check(&file, false)?;
        target.write(&renderer.render(&scene, &Style::named(style))?)?;
        written.push(file);
    }
    Ok(written)
}
