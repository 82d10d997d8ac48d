//! Not part of the project: times the lines of families and files.
#[path = "../../../tests/support/growth.rs"]
mod families;
use families::{FAMILIES, Seen};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tinta_geometry::lines::Progress;
use tinta_geometry::{CameraSettings, LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines, load};
fn run(name: &str, scene: &Scene, hidden: bool, repeats: usize) {
    let wanted = LineSettings { finds_hidden: hidden, ..LineSettings::default() };
    let mut best = f64::INFINITY;
    let mut line = String::new();
    for _ in 0..repeats {
        let start = Instant::now();
        match VisibleLines::with_progress(scene, &wanted, &Progress::within(Duration::from_secs(40))) {
            Ok(lines) => {
                let ms = start.elapsed().as_secs_f64() * 1e3;
                let visible: f64 = lines.segments.iter().filter(|s| s.is_visible).map(|s| s.ends_px[0].distance(s.ends_px[1])).sum();
                if ms < best { best = ms; line = format!("{name}\t{ms:.1}\t{}\t{visible:.4}\t{}", lines.times.compared, lines.segments.len()); }
            }
            Err(_) => { line = format!("{name}\t40000+\t0\t0\t0"); break; }
        }
    }
    println!("{line}");
}
fn main() {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let hidden = a.iter().any(|x| x == "--hidden");
    let repeats: usize = std::env::var("REPEATS").map_or(3, |r| r.parse().unwrap());
    for x in a.iter().filter(|x| *x != "--hidden") {
        if let Ok(size) = x.parse::<usize>() {
            let only = std::env::var("FAMILY").unwrap_or_default();
            let out = std::env::var("BUT").unwrap_or_default();
            for family in FAMILIES.iter().filter(|f| (only.is_empty() || only.split(",").any(|n| n == f.name)) && !out.split(",").any(|n| n == f.name)) {
                let shape = (family.make)(size);
                let mesh = Mesh { file_vertices: (0..shape.positions.len() as u32).collect(), positions: shape.positions, triangles: shape.triangles, normals: Vec::new(), triangle_normals: Vec::new(), ..Mesh::triangle() };
                let camera = match family.seen {
                    Seen::Aslant => CameraSettings::default(),
                    Seen::Along => CameraSettings { view: "front".parse().unwrap(), parallel: true, ..CameraSettings::default() },
                };
                let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap();
                run(&format!("{}-{size}{}", family.name, if hidden {"-h"} else {""}), &scene, hidden, if size > 10000 { 1 } else { repeats });
            }
        } else {
            let mesh = match load(x, &LoadOptions::default()) { Ok(l) => l.mesh, Err(e) => { println!("{x}: {e}"); continue } };
            let Ok(scene) = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()) else { continue };
            let name = x.rsplit('/').next().unwrap();
            run(&format!("{name}{}", if hidden {"-h"} else {""}), &scene, hidden, repeats);
        }
    }
}
