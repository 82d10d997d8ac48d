//! How the exact lines' time grows with scenes that have made programs for hidden lines hang:
//! `cargo bench --bench lines_growth -- [SIZE…] [--family NAME]… [--hidden] [--limit SECONDS]`.
//!
//! Prints for each family and size the time of the lines alone and of the SVG after them, and draws a plot of the sum. Reports a
//! size beyond the time limit, and skips larger ones of that family.

#[path = "../crates/tinta-geometry/tests/support/growth.rs"]
mod families;
#[expect(dead_code, reason = "other benchmarks fit lines to their curves")]
#[path = "report/growth.rs"]
mod growth;
#[expect(dead_code, reason = "other benchmarks have contestants")]
#[path = "report/mod.rs"]
mod report;

use families::{FAMILIES, Family, FamilyView};
use growth::{Curve, plot};
use report::write_record;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tinta::lines::{LineSettings, Progress, VisibleLines, svg};
use tinta::renderer::milliseconds_since;
use tinta::{CameraSettings, DrawingSettings, Error, Mesh, Scene, SceneSettings};

struct Settings {
    sizes: Vec<usize>,
    families: Vec<String>,
    finds_hidden: bool,
    limit: Duration,
}

fn settings() -> Settings {
    let mut settings =
        Settings { sizes: Vec::new(), families: Vec::new(), finds_hidden: false, limit: Duration::from_secs(60) };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--hidden" => settings.finds_hidden = true,
            "--family" => settings.families.extend(arguments.next()),
            "--limit" => {
                let seconds = arguments.next().and_then(|text| text.parse().ok()).expect("--limit SECONDS");
                settings.limit = Duration::from_secs_f64(seconds);
            }
            size => settings.sizes.push(size.parse().expect("a number of triangles")),
        }
    }
    if settings.sizes.is_empty() {
        settings.sizes = vec![1_000, 5_000, 50_000];
    }
    settings
}

fn main() {
    let settings = settings();
    println!(
        "  {:<12}{:>10}{:>10}{:>12}{:>12}{:>14}",
        "family", "triangles", "pieces", "lines ms", "SVG ms", "boxes each"
    );
    let chosen =
        |family: &&Family| settings.families.is_empty() || settings.families.iter().any(|name| name == family.name);
    let (mut curves, mut rows) = (Vec::new(), Vec::new());
    for family in FAMILIES.iter().filter(chosen) {
        let mut curve = Curve { name: family.name.to_owned(), points: Vec::new() };
        for size in &settings.sizes {
            let Some((row, milliseconds)) = measured(family, *size, &settings) else { break };
            curve.points.push((row["triangles"].as_f64().expect("a number"), milliseconds));
            rows.push(row);
        }
        curves.push(curve);
    }
    curves.retain(|curve| !curve.points.is_empty());
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("target/bench/lines-families.svg");
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    let words = ["exact lines of families of scenes, 512x512", "triangles", "milliseconds, with the SVG"];
    plot(&curves, words, &path).expect("the plot can be drawn");
    println!("plot: {}", path.display());
    write_record("lines-families", &Value::Array(rows));
}

/// A row of the table with the time of lines and SVG together; `None` where the limit was passed.
fn measured(family: &Family, size: usize, settings: &Settings) -> Option<(Value, f64)> {
    let shape = (family.make)(size);
    let triangles = shape.triangles.len();
    let mesh = Mesh {
        file_vertices: (0..shape.positions.len() as u32).collect(),
        positions: shape.positions,
        triangles: shape.triangles,
        normals: Vec::new(),
        triangle_normals: Vec::new(),
        ..Mesh::triangle()
    };
    let camera = match family.seen {
        FamilyView::Aslant => CameraSettings::default(),
        FamilyView::Along => {
            CameraSettings { view: "front".parse().expect("a view"), parallel: true, ..CameraSettings::default() }
        }
    };
    let settings_of_scene = SceneSettings { camera, ..SceneSettings::default() };
    let scene = Scene::new(vec![Arc::new(mesh)], &settings_of_scene).expect("a scene");
    let wanted = LineSettings { finds_hidden: settings.finds_hidden, ..LineSettings::default() };
    let start = Instant::now();
    let lines = match VisibleLines::with_progress(&scene, &wanted, &Progress::within(settings.limit)) {
        Ok(lines) => lines,
        Err(Error::OutOfTime { seconds }) => {
            println!("  {:<12}{triangles:>10}  not done within {seconds} s", family.name);
            return None;
        }
        Err(error) => panic!("{}: {error}", family.name),
    };
    let lines_ms = milliseconds_since(start);
    let start = Instant::now();
    let bytes = svg(&lines, &DrawingSettings::default()).expect("an SVG").len();
    let svg_ms = milliseconds_since(start);
    let pieces = lines.segments.len();
    let each = lines.times.compared as f64 / (triangles + pieces) as f64;
    println!("  {:<12}{triangles:>10}{pieces:>10}{lines_ms:>12.1}{svg_ms:>12.1}{each:>14.0}", family.name);
    let row = json!({
        "family": family.name, "what": family.what, "triangles": triangles, "pieces": pieces, "lines_ms": lines_ms,
        "svg_ms": svg_ms, "bytes": bytes, "compared": lines.times.compared, "hidden": settings.finds_hidden,
    });
    Some((row, lines_ms + svg_ms))
}
