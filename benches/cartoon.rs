//! The cartoon's frame and cold start compared with alternative programs. docs/results/measuring.md has the command.
//!
//! Rounds are interleaved: each contestant runs once in each round, and a busy moment of the machine hits all of them. The report
//! gives medians over all rounds and their ratios; all raw values go to `target/bench/cartoon.json`. The peers are the scripts in
//! benches/peers, each of which draws frames or one picture.

mod report;

use report::{Series, print_table, write_record};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Instant;
use tinta::edges::SilhouetteRule;
use tinta::mesh::Mesh;
use tinta::plan::prune::prune;
use tinta::renderer::milliseconds_since;
use tinta::styles::{Cartoon, Ink, Inking, Mrt};
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, load};

const USAGE: &str = "cargo bench --bench cartoon -- MODEL [OPTIONS]
  MODEL                    an OBJ file, y up, for example the Stanford bunny
  --python PYTHON          a Python with benches/league/requirements.txt; Panda3D also needs Xvfb
  --blender-python PYTHON  a Python with benches/league/requirements-blender.txt
  --rounds N               interleaved rounds (default 9); cold starts have twice as many
  --frames N               frames a round and contestant (default 21)
  --backwards              contestants in the opposite order";

/// Picture sizes of frames and cold starts.
const SIZES: [Size; 2] = [Size { width: 512, height: 512 }, Size { width: 1920, height: 1080 }];

/// Blender needs about a second for a frame.
const BLENDER_FRAMES: usize = 3;

#[derive(Default)]
struct Settings {
    model: String,
    python: Option<String>,
    blender_python: Option<String>,
    rounds: usize,
    frames: usize,
    is_backwards: bool,
}

impl Settings {
    fn from_arguments() -> Option<Self> {
        let mut settings = Self { rounds: 9, frames: 21, ..Self::default() };
        let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--python" => settings.python = arguments.next(),
                "--blender-python" => settings.blender_python = arguments.next(),
                "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
                "--frames" => settings.frames = arguments.next()?.parse().ok()?,
                "--backwards" => settings.is_backwards = true,
                _ if settings.model.is_empty() => settings.model = argument,
                _ => return None,
            }
        }
        (!settings.model.is_empty()).then_some(settings)
    }
}

/// A script in benches/peers with the Python that runs it.
struct Peer {
    name: String,
    python: String,
    script: PathBuf,
    is_blender: bool,
    with_edges: bool,
}

impl Peer {
    /// Draws FRAMES frames or one PICTURE.
    fn command(&self, model: &str, size: Size, last: &str, display: Option<&Display>) -> Command {
        let mut command = Command::new(&self.python);
        command.arg(&self.script).args([model, &size.width.to_string(), &size.height.to_string(), last]);
        if self.with_edges {
            command.arg("edges");
        }
        // Only Panda3D needs a display; the others find EGL, as on a server.
        match display {
            Some(display) if self.name.starts_with("Panda3D") => command.env("DISPLAY", &display.name),
            _ => command.env_remove("DISPLAY"),
        };
        command
    }

    fn frame_times(&self, settings: &Settings, size: Size, display: Option<&Display>) -> Vec<f64> {
        let frames = if self.is_blender { BLENDER_FRAMES } else { settings.frames };
        let record = record(self.command(&settings.model, size, &frames.to_string(), display));
        record["frame_ms"].as_array().expect("times").iter().filter_map(Value::as_f64).collect()
    }
}

/// The JSON object that a peer prints last.
fn record(mut command: Command) -> Value {
    let output = command.output().expect("the peer starts");
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().rfind(|line| line.starts_with('{'));
    let line = line.unwrap_or_else(|| panic!("no times from the peer: {}", String::from_utf8_lossy(&output.stderr)));
    serde_json::from_str(line).expect("JSON from the peer")
}

/// The peers that this machine has, each with its version.
fn peers(settings: &Settings, display: Option<&Display>, folder: &Path) -> Vec<Peer> {
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("benches/peers");
    let all = [
        ("panda3d_ink.py", " cartoon ink", false),
        ("vtk_ink.py", " silhouette and feature edges", false),
        ("pyvista_ink.py", " silhouette", false),
        ("f3d_picture.py", ", no lines", false),
        ("f3d_picture.py", ", all triangles' edges", true),
        ("blender_freestyle.py", " Freestyle", false),
    ];
    let picture = folder.join("version.png").display().to_string();
    let mut found = Vec::new();
    for (script, draws, with_edges) in all {
        let is_blender = script.starts_with("blender");
        let python = if is_blender { &settings.blender_python } else { &settings.python };
        let needs_display = script.starts_with("panda3d");
        let Some(python) = python.clone().filter(|_| !needs_display || display.is_some()) else {
            println!("SKIPPED {script}: see --python, --blender-python and Xvfb in the usage");
            continue;
        };
        let name = if needs_display { "Panda3D".to_owned() } else { String::new() };
        let mut peer = Peer { name, python, script: scripts.join(script), is_blender, with_edges };
        let version = record(peer.command(&settings.model, SIZES[0], &picture, display))["version"].clone();
        peer.name = format!("{}{draws}", version.as_str().expect("a version"));
        found.push(peer);
    }
    found
}

/// The numbers of contestants in the order in which they run.
fn order(settings: &Settings, count: usize) -> Vec<usize> {
    if settings.is_backwards { (0..count).rev().collect() } else { (0..count).collect() }
}

fn main() {
    let Some(settings) = Settings::from_arguments() else {
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
    let folder = tempfile::tempdir().expect("a temporary folder");
    let display = Display::start();
    let peers = peers(&settings, display.as_ref(), folder.path());
    let frames: Vec<Value> =
        SIZES.into_iter().map(|size| frame_table(&settings, &mesh, &peers, size, display.as_ref())).collect();
    let cold: Vec<Value> =
        SIZES.into_iter().map(|size| cold_table(&settings, &peers, size, folder.path(), display.as_ref())).collect();
    let memory = peak_memory_mib(&settings.model, folder.path());
    println!("\npeak memory of one process over 200 frames, 512 x 512: {memory:.0} MiB");

    let all = json!({ "model": settings.model, "frames": frames, "cold": cold, "peak_memory_mib": memory });
    write_record("cartoon", &all);
}

/// Frame times, read-back included, the model turning 3 degrees a frame at the peers' distance and field of view.
fn frame_table(settings: &Settings, mesh: &Arc<Mesh>, peers: &[Peer], size: Size, display: Option<&Display>) -> Value {
    let mut renderer = Renderer::new(Backend::Auto).expect("a context");
    println!("\nframe at {size}, {} triangles, {}", mesh.triangles.len(), renderer.context().renderer);
    let culled = Cartoon { cull_back_faces: true, ..Cartoon::default() };
    let inking = Inking { silhouette: SilhouetteRule::Exact, ..Inking::default() };
    let styles = [
        ("tinta mrt", Style::Mrt(Mrt::default())),
        ("tinta mrt --cull back", Style::Mrt(Mrt(Cartoon { cull_back_faces: true, ..Cartoon::default() }))),
        ("tinta three-pass", Style::ThreePass(Cartoon::default())),
        ("tinta three-pass --cull back", Style::ThreePass(culled)),
        ("tinta ink", Style::Ink(Ink::default())),
        ("tinta inking --silhouette exact", Style::Inking(inking.clone())),
        ("tinta inking --silhouette exact --cull back", Style::Inking(Inking { cull_back_faces: true, ..inking })),
    ];
    let names = styles.iter().map(|(name, _)| *name).chain(peers.iter().map(|peer| peer.name.as_str()));
    let mut series: Vec<Series> = names.map(Series::new).collect();
    let base = Scene::new(vec![mesh.clone()], &SceneSettings { size, ..SceneSettings::default() }).expect("a scene");
    let scenes: Vec<Scene> = (0..settings.frames).map(|frame| turned(&base, frame)).collect();
    let start = Instant::now();
    base.make_arrays();
    println!("  once, not in the frames: vertex arrays, {:.1} ms", milliseconds_since(start));
    let pruning = renderer.pruning();
    for _ in 0..settings.rounds {
        for contestant in order(settings, series.len()) {
            let Some((_, style)) = styles.get(contestant) else {
                let peer = &peers[contestant - styles.len()];
                series[contestant].times.extend(peer.frame_times(settings, size, display));
                continue;
            };
            // A frame includes the plan of a view and its pruning.
            let mut frame = |scene: &Scene| {
                let start = Instant::now();
                let plan = prune(&style.plan(scene, Show::Final).expect("a plan"), scene, &pruning).plan;
                renderer.time_frames(scene, &plan, 0, 1).expect("a frame");
                milliseconds_since(start)
            };
            let _warm_up: f64 = (0..3).map(|_| frame(&scenes[0])).sum();
            series[contestant].times.extend(scenes.iter().map(&mut frame));
        }
    }
    let rows = print_table(&series, "tinta mrt");
    json!({ "size": size.to_string(), "contestants": rows })
}

/// The scene with the camera where benches/peers/turntable.py puts it, turned to this frame's angle.
fn turned(base: &Scene, frame: usize) -> Scene {
    let mut scene = base.clone();
    let angle = (frame as f64 * 3.0).to_radians();
    let offset = glam::DVec3::new(3.2 * angle.sin(), 0.5, 3.2 * angle.cos()) * scene.radius;
    scene.camera.eye = scene.centre + offset;
    scene.camera.target = scene.centre;
    // 40 degrees across.
    let half_width = 20f64.to_radians().tan();
    let fov_y_degrees = (half_width / scene.size.aspect()).atan().to_degrees() * 2.0;
    scene.camera.projection = tinta::camera::Projection::Perspective { fov_y_degrees };
    (scene.camera.near, scene.camera.far) = (scene.radius * 0.5, scene.radius * 8.0);
    scene
}

/// Whole processes from start to end, model file to PNG file.
fn cold_table(settings: &Settings, peers: &[Peer], size: Size, folder: &Path, display: Option<&Display>) -> Value {
    println!("\nwhole process, {} to PNG, {size}", settings.model);
    let file = folder.join("cold.png");
    let picture = file.to_str().expect("a path");
    let size_text = size.to_string();
    let tinta = |options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
        command.args(["render", &settings.model, "-o", picture, "--size", &size_text]).args(options);
        command
    };
    let mut contestants: Vec<(&str, Command)> = vec![
        // The default picture, without a shadow as the others.
        ("tinta, look print", tinta(&["--look", "print", "--ground", "none"])),
        ("tinta ink", tinta(&["--style", "ink"])),
        ("tinta three-pass", tinta(&["--style", "three-pass"])),
        ("tinta phong, no lines", tinta(&["--style", "phong"])),
    ];
    contestants.extend(peers.iter().map(|peer| {
        let command = peer.command(&settings.model, size, picture, display);
        (peer.name.as_str(), command)
    }));
    match empty_egl(folder) {
        Some(program) => contestants.push(("empty EGL program", Command::new(program))),
        None => println!("  SKIPPED the empty EGL program: needs cc and the packages libegl-dev and libgl-dev"),
    }
    let mut series: Vec<Series> = contestants.iter().map(|(name, _)| Series::new(name)).collect();
    // One unmeasured round warms files and drivers' caches for all contestants.
    for round in 0..settings.rounds * 2 + 1 {
        for contestant in order(settings, series.len()) {
            let (name, command) = &mut contestants[contestant];
            let _ = std::fs::remove_file(&file);
            let start = Instant::now();
            let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status().expect("the contestant starts");
            let time = milliseconds_since(start);
            assert!(status.success(), "{name} ends well");
            assert!(*name == "empty EGL program" || has_size(&file, size), "{name} has drawn no picture of {size}");
            if round > 0 {
                series[contestant].times.push(time);
            }
        }
    }
    let rows = print_table(&series, "tinta, look print");
    json!({ "size": size_text, "contestants": rows })
}

/// Whether a PNG file has this size, by its header.
fn has_size(file: &Path, size: Size) -> bool {
    let bytes = std::fs::read(file).unwrap_or_default();
    bytes.get(16..24) == Some(&[size.width.to_be_bytes(), size.height.to_be_bytes()].concat())
}

/// A virtual display for the length of the benchmark; its start counts for no contestant.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Option<Self> {
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "1920x1440x24", "-nolisten", "tcp"]);
        let mut server = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().ok()?;
        let mut number = String::new();
        BufReader::new(server.stdout.take()?).read_line(&mut number).ok()?;
        Some(Self { server, name: format!(":{}", number.trim()) })
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
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
