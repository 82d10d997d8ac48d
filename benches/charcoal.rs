//! The charcoal drawing's frame compared with the same model's in Phong shading. docs/results/measuring.md has the command.
//!
//! Interleaved: in each round every contestant draws the same turning model, and a busy moment hits all of them. The report gives
//! medians and ratios; all raw values go to `target/bench/charcoal.json`.

mod report;

use report::{Series, print_table, write_record};
use serde_json::json;
use std::sync::Arc;
use tinta::styles::{Charcoal, Improvements, Phong};
use tinta::{Backend, CameraSettings, LoadOptions, Renderer, Scene, SceneSettings, Show, Style, load};

const ROUNDS: usize = 15;
const FRAMES: usize = 21;

fn main() {
    let Some(model) = std::env::args().skip(1).find(|argument| argument != "--bench") else {
        println!("cargo bench --bench charcoal -- MODEL");
        return;
    };
    let mesh = match load(&model, &LoadOptions::default()) {
        Ok(loaded) => Arc::new(loaded.mesh),
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    let mut renderer = Renderer::new(Backend::Auto).expect("a context");
    println!("{} triangles, 512x512, {}", mesh.triangles.len(), renderer.context().renderer);
    let base = Charcoal::default;
    let styles = [
        ("charcoal, as published", Style::Charcoal(base())),
        ("charcoal, improved", Style::Charcoal(Charcoal { improve: Improvements::ALL, ..base() })),
        ("charcoal, back faces culled", Style::Charcoal(Charcoal { cull_back_faces: true, ..base() })),
        ("phong, back faces culled", Style::Phong(Phong { cull_back_faces: true, ..Phong::default() })),
        ("phong", Style::Phong(Phong::default())),
    ];
    let mut series: Vec<Series> = styles.iter().map(|(name, _)| Series::new(name)).collect();
    let base = Scene::new(vec![mesh], &SceneSettings::default()).expect("a scene");
    let scenes: Vec<Scene> = (0..FRAMES)
        .map(|frame| {
            let view = format!("{},15", 30 + 3 * frame).parse().expect("a view");
            let camera = CameraSettings { view, ..CameraSettings::default() };
            let turned = Scene::new(
                base.objects.iter().map(|object| object.mesh.clone()),
                &SceneSettings { camera, ..SceneSettings::default() },
            );
            Scene { camera: turned.expect("a scene").camera, ..base.clone() }
        })
        .collect();
    for _ in 0..ROUNDS {
        for ((_, style), series) in styles.iter().zip(&mut series) {
            let plan = style.plan(&scenes[0], Show::Final).expect("a plan");
            renderer.time_frames(&scenes[0], &plan, 3, 1).expect("frames");
            for scene in &scenes {
                series.times.extend(renderer.time_frames(scene, &plan, 0, 1).expect("a frame"));
            }
        }
    }
    let table = print_table(&series, "phong");
    write_record("charcoal", &json!({ "model": model, "frames": table }));
}
