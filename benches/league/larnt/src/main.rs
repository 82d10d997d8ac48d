//! larnt on a mesh: league-larnt MODEL.obj CAMERA.json DRAWING.svg
//!
//! As in its README's mesh example: `load_obj`, a scene, `render`, `to_svg`. It draws the visible parts of every triangle's
//! edges, and has no silhouettes or creases. Lines are cut into steps as long as a pixel at the target, and each step is visible
//! or not.

use larnt::{Scene, Shape, Vector, load_obj};
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let camera: Value = serde_json::from_str(&std::fs::read_to_string(&arguments[2]).unwrap()).unwrap();
    let number = |name: &str| camera[name].as_f64().unwrap();
    let vector = |name: &str| {
        let [x, y, z] = [0, 1, 2].map(|axis| camera[name][axis].as_f64().unwrap());
        Vector::new(x, y, z)
    };
    let start = Instant::now();
    let mut mesh = load_obj(&arguments[1]).unwrap();
    mesh.compile();
    let mut scene = Scene::new();
    scene.add_arc(Arc::new(mesh));
    let size = number("size");
    let fov = number("fov_y_degrees");
    let pixel = 2.0 * number("distance") * (fov.to_radians() / 2.0).tan() / size;
    let paths = scene.render(
        vector("eye"),
        vector("target"),
        vector("up"),
        size,
        size,
        fov,
        number("near"),
        number("far"),
        pixel,
    );
    std::fs::write(&arguments[3], paths.to_svg(size, size)).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    println!("{}", json!({"version": "larnt 0.1.0", "renderer": "none", "drawing_seconds": seconds}));
}
