//! The cartoon's frame and cold start compared with alternative programs. docs/results/measuring.md has the command.
//!
//! Rounds are interleaved: each contestant runs once in each round, and a busy moment of the machine hits all of them. The report
//! gives medians over all rounds and their ratios; all raw values go to `target/bench/cartoon.json`.

mod report;

use report::{Series, print_ratio, print_table, write_record};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Instant;
use tinta::mesh::Mesh;
use tinta::plan::prune::prune;
use tinta::renderer::milliseconds_since;
use tinta::styles::{Cartoon, Ink, Mrt};
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, load};

const USAGE: &str = "cargo bench --bench cartoon -- MODEL [--python PYTHON] [--rounds N] [--frames N]
  MODEL            an OBJ file, for example the Stanford bunny
  --python PYTHON  a Python with Panda3D 1.10 (pip install Panda3D); needs xvfb-run
  --rounds N       interleaved rounds (default 9)
  --frames N       frames a round and contestant (default 21)";

struct Settings {
    model: String,
    python: Option<String>,
    rounds: usize,
    frames: usize,
}

impl Settings {
    fn from_arguments() -> Option<Self> {
        let mut settings = Self { model: String::new(), python: None, rounds: 9, frames: 21 };
        let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--python" => settings.python = arguments.next(),
                "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
                "--frames" => settings.frames = arguments.next()?.parse().ok()?,
                _ if settings.model.is_empty() => settings.model = argument,
                _ => return None,
            }
        }
        (!settings.model.is_empty()).then_some(settings)
    }
}

fn main() {
    let Some(mut settings) = Settings::from_arguments() else {
        println!("{USAGE}");
        return;
    };
    let mesh = match load(&settings.model, &LoadOptions::default()) {
        Ok(loaded) => Arc::new(loaded.mesh),
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    settings.python = settings.python.filter(|python| has_panda(python));
    if settings.python.is_none() {
        println!("SKIPPED Panda3D: needs --python PYTHON with Panda3D in it, and the package xvfb");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let frames: Vec<Value> =
        [(512, 512), (1920, 1080)].into_iter().map(|size| frame_table(&settings, &mesh, size, folder.path())).collect();
    let cold = cold_table(&settings, folder.path());
    let memory = peak_memory_mib(&settings.model, folder.path());
    println!("\npeak memory of one process over 200 frames, 512 x 512: {memory:.0} MiB");

    let all = json!({ "model": settings.model, "frames": frames, "cold": cold, "peak_memory_mib": memory });
    write_record("cartoon", &all);
}

/// Whether this Python has Panda3D and there is a virtual display for it.
fn has_panda(python: &str) -> bool {
    let import = Command::new(python).args(["-c", "import panda3d"]).stderr(Stdio::null()).status();
    import.is_ok_and(|status| status.success()) && runs("xvfb-run", "--help")
}

/// Frame times, read-back included, the model turning 3 degrees a frame at the peer's distance and field of view.
fn frame_table(settings: &Settings, mesh: &Arc<Mesh>, (width, height): (u32, u32), folder: &Path) -> Value {
    let size = Size { width, height };
    let mut renderer = Renderer::new(Backend::Auto).expect("a context");
    println!("\nframe at {size}, {} triangles, {}", mesh.triangles.len(), renderer.context().renderer);
    let culled = Cartoon { cull_back_faces: true, ..Cartoon::default() };
    let styles = [
        ("three-pass --full", Style::ThreePass(Cartoon::default()), false),
        ("three-pass", Style::ThreePass(Cartoon::default()), true),
        ("three-pass --cull back", Style::ThreePass(culled.clone()), true),
        ("two-pass --full", Style::TwoPass(Cartoon::default()), false),
        ("two-pass", Style::TwoPass(Cartoon::default()), true),
        ("two-pass --cull back", Style::TwoPass(culled), true),
        ("mrt", Style::Mrt(Mrt::default()), true),
        ("mrt --cull back", Style::Mrt(Mrt { cull_back_faces: true, ..Mrt::default() }), true),
        ("ink --cull back", Style::Ink(Ink { cull_back_faces: true, ..Ink::default() }), true),
    ];
    let mut series: Vec<Series> = styles.iter().map(|(name, ..)| Series::new(name)).collect();
    let with_normals = folder.join("with-normals.obj");
    if settings.python.is_some() {
        write_with_normals(mesh, &with_normals);
        series.push(Series::new("Panda3D cartoon ink"));
    }
    let base = Scene::new(vec![mesh.clone()], &SceneSettings { size, ..SceneSettings::default() }).expect("a scene");
    let scenes: Vec<Scene> = (0..settings.frames).map(|frame| turned(&base, frame)).collect();
    let start = Instant::now();
    base.make_arrays();
    println!("  once, not in the frames: vertex arrays, {:.1} ms", milliseconds_since(start));
    let pruning = renderer.pruning();
    for _ in 0..settings.rounds {
        for ((_, style, is_pruned), series) in styles.iter().zip(&mut series) {
            // A frame includes the plan of a view and its pruning.
            let mut frame = |scene: &Scene| {
                let start = Instant::now();
                let mut plan = style.plan(scene, Show::Final).expect("a plan");
                if *is_pruned {
                    plan = prune(&plan, scene, &pruning).plan;
                }
                renderer.time_frames(scene, &plan, 0, 1).expect("a frame");
                milliseconds_since(start)
            };
            let _warm_up: f64 = (0..3).map(|_| frame(&scenes[0])).sum();
            series.times.extend(scenes.iter().map(&mut frame));
        }
        if let (Some(python), Some(series)) = (&settings.python, series.last_mut()) {
            series.times.extend(panda_times(python, &with_normals, size, settings.frames));
        }
    }
    print_table(&series, "Panda3D cartoon ink")
}

/// The scene with the camera where benches/peers/panda3d_ink.py puts it, turned to this frame's angle.
fn turned(base: &Scene, frame: usize) -> Scene {
    let mut scene = base.clone();
    let angle = (frame as f64 * 3.0).to_radians();
    let offset = glam::DVec3::new(3.2 * angle.sin(), 0.5, 3.2 * angle.cos()) * scene.radius;
    scene.camera.eye = scene.centre + offset;
    scene.camera.target = scene.centre;
    // 40 degrees across, as Panda's lens has by default, at this aspect.
    let half_width = 20f64.to_radians().tan();
    let fov_y_degrees = (half_width / scene.size.aspect()).atan().to_degrees() * 2.0;
    scene.camera.projection = tinta::camera::Projection::Perspective { fov_y_degrees };
    (scene.camera.near, scene.camera.far) = (scene.radius * 0.5, scene.radius * 8.0);
    scene
}

fn panda_times(python: &str, model: &Path, size: Size, frames: usize) -> Vec<f64> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("benches/peers/panda3d_ink.py");
    let output = Command::new("xvfb-run")
        .args(["-a", python, script.to_str().expect("a path"), model.to_str().expect("a path")])
        .args([size.width.to_string(), size.height.to_string(), frames.to_string()])
        .output()
        .expect("xvfb-run can be started");
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().rfind(|line| line.starts_with('{')).unwrap_or_else(|| {
        panic!("Panda3D gave no times: {}", String::from_utf8_lossy(&output.stderr));
    });
    let record: Value = serde_json::from_str(line).expect("JSON from the peer");
    record["frame_ms"].as_array().expect("times").iter().filter_map(Value::as_f64).collect()
}

/// Whole processes from start to end, model file to PNG file at 512 x 512.
fn cold_table(settings: &Settings, folder: &Path) -> Value {
    println!("\nwhole process, {} to PNG, 512 x 512", settings.model);
    let picture = folder.join("cold.png");
    let picture = picture.to_str().expect("a path");
    let model = settings.model.as_str();
    let tinta = env!("CARGO_BIN_EXE_tinta");
    let drawing = ["render", model, "-o", picture, "--size", "512x512"];
    let mut contestants: Vec<(String, Command)> = vec![
        // The default picture.
        ("tinta, look print".to_owned(), command(tinta, &[&drawing[..], &["--look", "print"]].concat())),
        ("tinta three-pass".to_owned(), command(tinta, &[&drawing[..], &["--style", "three-pass"]].concat())),
        ("tinta phong".to_owned(), command(tinta, &[&drawing[..], &["--style", "phong"]].concat())),
    ];
    let mut display = None;
    if runs("f3d", "--version") && runs("Xvfb", "-version") {
        display = Some(XDisplay::start());
        let output = format!("--output={picture}");
        let mut f3d = command("f3d", &[model, &output, "--resolution=512,512", "--dry-run"]);
        f3d.env("DISPLAY", XDisplay::NAME);
        contestants.push(("f3d".to_owned(), f3d));
    } else {
        println!("  SKIPPED f3d: needs the packages f3d and xvfb");
    }
    match empty_egl(folder) {
        Some(program) => contestants.push(("empty EGL program".to_owned(), Command::new(program))),
        None => println!("  SKIPPED the empty EGL program: needs cc and the packages libegl-dev and libgl-dev"),
    }
    let mut series: Vec<Series> = contestants.iter().map(|(name, _)| Series::new(name)).collect();
    // One unmeasured round warms files and drivers' caches for all contestants.
    for round in 0..settings.rounds * 2 + 1 {
        for ((name, command), series) in contestants.iter_mut().zip(&mut series) {
            let start = Instant::now();
            let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status().expect("the contestant starts");
            let time = start.elapsed().as_secs_f64() * 1e3;
            assert!(status.success(), "{name} ends well");
            if round > 0 {
                series.times.push(time);
            }
        }
    }
    drop(display);
    let table = print_table(&series, "f3d");
    if series.iter().any(|series| series.name == "empty EGL program") {
        print_ratio(&series, "empty EGL program");
    }
    table
}

fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments);
    command
}

fn runs(program: &str, argument: &str) -> bool {
    Command::new(program).arg(argument).stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// A virtual display for the length of the benchmark; its start counts for no contestant.
struct XDisplay(std::process::Child);

impl XDisplay {
    const NAME: &str = ":77";

    fn start() -> Self {
        let mut server = Command::new("Xvfb");
        server.args([Self::NAME, "-screen", "0", "1024x1024x24"]).stdout(Stdio::null()).stderr(Stdio::null());
        let child = server.spawn().expect("Xvfb starts");
        let socket = Path::new("/tmp/.X11-unix/X77");
        while !socket.exists() {
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
        Self(child)
    }
}

impl Drop for XDisplay {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn empty_egl(folder: &Path) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("benches/peers/empty_egl.c");
    let program = folder.join("empty-egl");
    let status = Command::new("cc").arg("-O2").arg(source).arg("-o").arg(&program).args(["-lEGL", "-lGL"]).status();
    status.is_ok_and(|status| status.success()).then_some(program)
}

/// Peak resident memory of one `tinta render` in three passes, as the kernel counts it for the child.
fn peak_memory_mib(model: &str, folder: &Path) -> f64 {
    let picture = folder.join("memory.png");
    let mut child = Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(["render", model, "-o", picture.to_str().expect("a path"), "--json", "--frames", "200"])
        .args(["--style", "three-pass", "--size", "512x512"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("tinta starts");
    let mut peak_kib: f64 = 0.0;
    while child.try_wait().expect("a child").is_none() {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = peak.and_then(|rest| rest.split_ascii_whitespace().next()).and_then(|text| text.parse().ok());
        peak_kib = peak_kib.max(number.unwrap_or(0.0));
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    peak_kib / 1024.0
}

/// Panda3D computes no normals: the peer gets ours.
fn write_with_normals(mesh: &Mesh, path: &Path) {
    let mut text = String::new();
    for position in &mesh.positions {
        text.push_str(&format!("v {} {} {}\n", position.x, position.y, position.z));
    }
    for normal in &mesh.normals {
        text.push_str(&format!("vn {} {} {}\n", normal.x, normal.y, normal.z));
    }
    for (corners, normals) in mesh.triangles.iter().zip(&mesh.triangle_normals) {
        let corner = |i: usize| format!("{}//{}", corners[i] + 1, normals[i] + 1);
        text.push_str(&format!("f {} {} {}\n", corner(0), corner(1), corner(2)));
    }
    std::fs::write(path, text).expect("the temporary folder can be written");
}
