//! Counts a model's edges by class and draws nothing but its inked edges.
//!
//! `cargo run --example edges_only -- cow.obj edges.png`

use std::sync::Arc;
use tinta::edges::{Class, ClassCounts, ClassSet, Classes, CreaseAngle, SilhouetteRule, Silhouettes};
use tinta::styles::{Inking, PaintMode};
use tinta::{Backend, EdgeList, LoadOptions, Renderer, Scene, SceneSettings, Style, Target, load};

fn main() -> tinta::Result<()> {
    let mut words = std::env::args().skip(1);
    let model = words.next().unwrap_or_else(|| "builtin:gear".to_owned());
    let output = words.next().unwrap_or_else(|| "edges.png".to_owned());
    let (mut counts, silhouette) = draw(&model, &output)?;
    for (name, class) in Class::ALL {
        if class != Class::Silhouette && class != Class::Intersection {
            println!("{name}: {}", counts.of(class));
        }
    }
    println!("silhouette, from here: {silhouette}");
    Ok(())
}

/// Draws a model's edges; how many it has of each class, and how many are silhouettes in this view.
pub fn draw(model: &str, output: &str) -> tinta::Result<(ClassCounts, usize)> {
    let target = Target::check(output, false)?;
    let mesh = Arc::new(load(model, &LoadOptions::default())?.mesh);

    // Without any OpenGL: each edge once, its class, and which of them part front from back for this eye.
    let edges = EdgeList::new(&mesh);
    let classes = Classes::new(&mesh, &edges, CreaseAngle::default(), ClassSet::EDGES);
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default())?;
    let eye = scene.eye(&scene.objects[0], SilhouetteRule::Exact);
    let silhouette = Silhouettes::new(&mesh, &edges).find(&mesh, &edges, eye, SilhouetteRule::Exact);

    // The faces are painted in the background's colour: they hide everything behind them and stay invisible.
    let ink = Inking { paint: PaintMode::None, silhouette: SilhouetteRule::Exact, ..Inking::default() };
    target.write(&Renderer::new(Backend::Auto)?.render(&scene, &Style::Inking(ink))?)?;
    Ok((classes.counts(), silhouette.len()))
}
