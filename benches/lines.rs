//! Exact visible lines compared with Blender Freestyle's, and the growth of their time. docs/results/measuring.md has the command.
//!
//! Rounds are interleaved: in each, every contestant runs once, the programs as cold processes. All raw values go to
//! `target/bench/lines.json`, the growth as a plot to `target/bench/lines-growth.svg`.

mod report;
#[path = "report/sphere.rs"]
mod sphere;

use plotters::prelude::*;
use report::{Series, print_table, write_record};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Instant;
use tinta::lines::{LineSettings, LineTimes, VisibleLines};
use tinta::renderer::{median, milliseconds_since};
use tinta::{LoadOptions, Mesh, Scene, SceneSettings, load};

const USAGE: &str = "cargo bench --bench lines -- MODEL... [--blender-python PYTHON] [--rounds N]
  MODEL                    model files (OBJ), for example the Stanford bunny
  --blender-python PYTHON  a Python with benches/league/requirements-blender.txt
  --rounds N               interleaved rounds (default 5)";

#[derive(Default)]
struct Settings {
    models: Vec<String>,
    blender_python: Option<String>,
    rounds: usize,
}

fn settings() -> Option<Settings> {
    let mut settings = Settings { rounds: 5, ..Settings::default() };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--blender-python" => settings.blender_python = arguments.next(),
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            _ if !argument.starts_with('-') => settings.models.push(argument),
            _ => return None,
        }
    }
    (!settings.models.is_empty()).then_some(settings)
}

fn main() {
    let Some(settings) = settings() else {
        println!("{USAGE}");
        return;
    };
    if settings.blender_python.is_none() {
        println!("SKIPPED Blender: needs --blender-python PYTHON");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let models: Vec<Value> = settings.models.iter().map(|model| one_model(&settings, model, folder.path())).collect();
    let growth = growth();
    write_record("lines", &json!({ "models": models, "growth": growth }));
}

/// Every contestant on one model.
fn one_model(settings: &Settings, model: &str, folder: &Path) -> Value {
    let mesh = match load(model, &LoadOptions::default()) {
        Ok(loaded) => Arc::new(loaded.mesh),
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    println!("\n{model}: {} triangles, 512x512", mesh.triangles.len());
    let names = ["tinta, lines", "tinta, process to SVG of lines", "Freestyle, lines", "Freestyle, process to PNG"];
    let mut series = names.map(Series::new);
    let mut stages: Vec<[f64; 3]> = Vec::new();
    let svg = folder.join("lines.svg");
    for _ in 0..settings.rounds {
        let (milliseconds, times) = lines_ms(&mesh);
        series[0].times.push(milliseconds);
        stages.push([times.topology_ms, times.silhouette_ms, times.visibility_ms]);
        let mut tinta = Command::new(env!("CARGO_BIN_EXE_tinta"));
        series[1].times.push(process_ms(tinta.args(["render", model, "--style", "lines", "-o"]).arg(&svg)).0);
        if let Some(python) = &settings.blender_python {
            let mut command = Command::new(python);
            command.arg(peer("blender_freestyle.py")).args([model, "512", "512"]);
            command.arg(folder.join("freestyle.png")).arg("stages");
            let (milliseconds, output) = process_ms(&mut command);
            series[3].times.push(milliseconds);
            series[2].times.push(freestyle_lines_ms(&output));
        }
    }
    let ran: Vec<Series> = series.into_iter().filter(|one| !one.times.is_empty()).collect();
    let table = print_table(&ran, "tinta, lines");
    for (index, stage) in ["topology", "silhouette", "visibility"].into_iter().enumerate() {
        let times = stages.iter().map(|stage| stage[index]).collect();
        println!("  of that {stage:<26}{:>10.2}", median(times).unwrap_or(f64::NAN));
    }
    let memory = peak_memory_kib(model, &svg);
    match memory {
        Some(kib) => println!("  peak memory of the process: {:.0} MiB", kib / 1024.0),
        None => println!("SKIPPED peak memory: GNU time is not installed"),
    }
    json!({
        "model": model, "triangles": mesh.triangles.len(), "times": table, "stages": stages, "peak_memory_kib": memory,
    })
}

/// The lines of a mesh never seen before, and how long that takes.
fn lines_ms(mesh: &Arc<Mesh>) -> (f64, LineTimes) {
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default()).expect("a scene");
    let start = Instant::now();
    let lines = VisibleLines::of(&scene, &LineSettings::as_published()).expect("lines");
    (milliseconds_since(start), lines.times)
}

/// Returns a process's time from start to end, and its output.
fn process_ms(command: &mut Command) -> (f64, String) {
    let start = Instant::now();
    let output = command.stdin(Stdio::null()).output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let milliseconds = milliseconds_since(start);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{command:?} failed:\n{text}{}", String::from_utf8_lossy(&output.stderr));
    (milliseconds, text)
}

/// Freestyle's own times for edges, feature lines and view map: the cost of its lines before they are drawn.
fn freestyle_lines_ms(output: &str) -> f64 {
    let seconds = |stage: &str| {
        let line =
            output.lines().find(|line| line.starts_with(stage)).unwrap_or_else(|| panic!("no {stage} in:\n{output}"));
        line.rsplit(':').next().and_then(|number| number.trim().parse::<f64>().ok()).expect("seconds")
    };
    ["WEdge building", "Feature lines", "ViewMap building"].map(seconds).iter().sum::<f64>() * 1e3
}

fn peer(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("benches/peers").join(name)
}

/// The process's peak memory, by GNU time.
fn peak_memory_kib(model: &str, svg: &Path) -> Option<f64> {
    let mut command = Command::new("/usr/bin/time");
    command.args(["-f", "%M", env!("CARGO_BIN_EXE_tinta"), "render", model, "--style", "lines", "-o"]);
    command.arg(svg);
    let output = command.output().ok()?;
    String::from_utf8_lossy(&output.stderr).lines().last()?.trim().parse().ok()
}

/// Approximate triangles of the plotted meshes.
const SIZES: [usize; 6] = [1_000, 4_000, 16_000, 64_000, 256_000, 1_000_000];

/// Repeats of each.
const REPEATS: usize = 5;

/// Lines of a bumpy sphere with more and more triangles.
fn growth() -> Value {
    println!("\na sphere with bumps, 512x512");
    println!("  {:>10}{:>12}{:>20}{:>12}", "triangles", "median ms", "ns / (n log2 n)", "segments");
    let mut points = Vec::new();
    let rows: Vec<Value> = SIZES
        .iter()
        .map(|size| {
            let mesh = Arc::new(sphere::bumpy_sphere(*size));
            let count = mesh.triangles.len() as f64;
            let times: Vec<f64> = (0..REPEATS).map(|_| lines_ms(&mesh).0).collect();
            let middle = median(times.clone()).unwrap_or(f64::NAN);
            let scene = Scene::new(vec![mesh], &SceneSettings::default()).expect("a scene");
            let segments = VisibleLines::of(&scene, &LineSettings::as_published()).expect("lines").segments.len();
            println!("  {count:>10}{middle:>12.2}{:>20.2}{segments:>12}", middle * 1e6 / (count * count.log2()));
            points.push((count, middle));
            json!({ "triangles": count, "ms": times, "segments": segments })
        })
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("target/bench/lines-growth.svg");
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    plot(&points, &path).expect("the plot can be drawn");
    println!("plot: {}", path.display());
    Value::Array(rows)
}

/// Times over triangles on logarithmic axes, with a curve of n log n through the first point.
fn plot(points: &[(f64, f64)], path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let area = SVGBackend::new(path, (640, 400)).into_drawing_area();
    area.fill(&WHITE)?;
    let (first_count, first_ms) = points[0];
    let expected = |count: f64| first_ms * count * count.log2() / (first_count * first_count.log2());
    let top = points.iter().map(|(count, ms)| ms.max(expected(*count))).fold(0.0, f64::max) * 1.5;
    let mut chart = ChartBuilder::on(&area)
        .caption("Exact visible lines of a sphere with bumps, 512x512", ("sans-serif", 16))
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(60)
        .build_cartesian_2d((800.0..1_300_000.0).log_scale(), (first_ms * 0.6..top).log_scale())?;
    chart.configure_mesh().x_desc("triangles").y_desc("milliseconds, median of 5").draw()?;
    chart
        .draw_series(LineSeries::new(points.iter().map(|(count, _)| (*count, expected(*count))), &BLACK.mix(0.35)))?
        .label("n log n from the first point")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], BLACK.mix(0.35)));
    chart
        .draw_series(LineSeries::new(points.iter().copied(), BLUE.stroke_width(2)).point_size(4))?
        .label("measured")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], BLUE));
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .border_style(BLACK)
        .background_style(WHITE)
        .draw()?;
    area.present()?;
    Ok(())
}
