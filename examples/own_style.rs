//! A user-defined style: a halftone of dots by two shaders beside this file, combined in a plan. No line of GL.
//!
//! `cargo run --example own_style -- cow.obj halftone.png`

use std::collections::HashMap;
use std::sync::Arc;
use tinta::plan::{Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Uniform, Value};
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Target, load};

/// The shaders' names in the plan, and their texts.
const VERTEX: (&str, &str) = ("own/halftone.vert", include_str!("own_style/halftone.vert"));
const FRAGMENT: (&str, &str) = ("own/halftone.frag", include_str!("own_style/halftone.frag"));

fn main() -> tinta::Result<()> {
    let mut words = std::env::args().skip(1);
    let model = words.next().unwrap_or_else(|| "builtin:bust".to_owned());
    let output = words.next().unwrap_or_else(|| "halftone.png".to_owned());
    draw(&model, &output)
}

/// Draws a model in dots.
pub fn draw(model: &str, output: &str) -> tinta::Result<()> {
    let target = Target::check(output, false)?;
    let mesh = load(model, &LoadOptions::default())?.mesh;
    let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
    let mut renderer = Renderer::new(Backend::Auto)?;
    renderer
        .replace_shaders(HashMap::from([VERTEX, FRAGMENT].map(|(path, text)| (path.to_owned(), text.to_owned()))))?;
    target.write(&renderer.draw(&scene, &halftone(&scene, 8.0))?)
}

/// One pass: clear, then all objects through both shaders, dots this far apart. Both shaders keep vertices and pixels in place:
/// pruning may omit everything that a view cannot show.
pub fn halftone(scene: &Scene, distance_px: f32) -> Plan {
    let program = Program::new(VERTEX.0, [FRAGMENT.0]);
    let uniforms = vec![Uniform::new("distance", Value::Float(distance_px))];
    let objects =
        Draw { uniforms, facts: Facts::plain(), ..Draw::new(Geometry::Objects(Paint::Materials), Some(program)) };
    Plan::new(vec![Pass::new("halftone", vec![Step::clear(scene.background.clear_color()), Step::Draw(objects)])])
}
