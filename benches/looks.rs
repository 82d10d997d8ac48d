//! A picture of a model from its file: `tinta render --look print` compared with the published default, f3d and PyVista.
//!
//! `cargo bench --bench looks` times whole processes, in turn. The others draw into a display without a screen, which is started once
//! and not timed. Raw values go to `target/bench/looks.json`; docs/results/measuring.md has the command and the numbers.

mod report;

use report::{Series, print_table, write_record};
use serde_json::json;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;
use tinta::Size;
use tinta::renderer::milliseconds_since;

const USAGE: &str = "cargo bench --bench looks -- [--model FILE] [--rounds N] [--size WxH] [--python PYTHON]
  --model FILE     the model (default ../shared/models/stanford-bunny.obj)
  --rounds N       rounds in which contestants take turns (default 11)
  --size WxH       of the picture (default 1600x1200)
  --python PYTHON  a Python with PyVista (pip install pyvista); f3d takes part where it is installed, both need Xvfb";

struct Settings {
    model: PathBuf,
    rounds: usize,
    size: Size,
    python: Option<String>,
}

fn settings() -> Option<Settings> {
    let model =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("../shared/models/stanford-bunny.obj");
    let mut settings = Settings { model, rounds: 11, size: Size { width: 1600, height: 1200 }, python: None };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--model" => settings.model = PathBuf::from(arguments.next()?),
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            "--size" => settings.size = arguments.next()?.parse().ok()?,
            "--python" => settings.python = Some(arguments.next()?),
            _ => return None,
        }
    }
    Some(settings)
}

fn main() {
    let Some(settings) = settings() else {
        println!("{USAGE}");
        return;
    };
    if !settings.model.is_file() {
        println!("SKIPPED: {} is not there; name a model with --model", settings.model.display());
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("picture.png");
    let display = Display::start();
    let contestants = contestants(&settings, &picture, display.as_ref());
    let mut series: Vec<Series> = contestants.iter().map(|(name, _)| Series::new(name)).collect();
    // The first round warms the caches of files and is not counted.
    for round in 0..=settings.rounds {
        for ((name, command), series) in contestants.iter().zip(&mut series) {
            let _ = std::fs::remove_file(&command.output);
            let start = Instant::now();
            let status = run(command);
            let ms = milliseconds_since(start);
            assert!(status && command.output.is_file(), "{name} has drawn nothing");
            if round > 0 {
                series.times.push(ms);
            }
        }
    }
    println!("{} at {}, whole processes, {} rounds in turn", settings.model.display(), settings.size, settings.rounds);
    let rows = print_table(&series, "tinta --look print");
    let size = settings.size.to_string();
    write_record("looks", &json!({ "model": settings.model, "size": size, "contestants": rows }));
}

/// The words of a command, the file it writes, and the display it draws into.
struct Words {
    words: Vec<String>,
    output: PathBuf,
    display: Option<String>,
}

fn run(command: &Words) -> bool {
    let mut process = Command::new(&command.words[0]);
    process.args(&command.words[1..]).stdout(Stdio::null()).stderr(Stdio::null());
    if let Some(display) = &command.display {
        process.env("DISPLAY", display);
    }
    process.status().is_ok_and(|status| status.success())
}

fn contestants(settings: &Settings, picture: &Path, display: Option<&Display>) -> Vec<(&'static str, Words)> {
    let (model, output) = (settings.model.display().to_string(), picture);
    let picture = output.display().to_string();
    let Size { width, height } = settings.size;
    let tinta = |look: &str, kind: &str| {
        let (size, output) = (settings.size.to_string(), output.with_extension(kind));
        let file = output.display().to_string();
        let words = [env!("CARGO_BIN_EXE_tinta"), "render", &model, "-o", &file, "--look", look, "--size", &size];
        Words { words: words.map(str::to_owned).to_vec(), output, display: None }
    };
    let mut all = vec![
        ("tinta --look print", tinta("print", "png")),
        ("tinta --look print, SVG", tinta("print", "svg")),
        ("tinta --look published", tinta("published", "png")),
    ];
    let Some(display) = display else {
        println!("SKIPPED f3d and PyVista: they need the package xvfb");
        return all;
    };
    let with_display =
        |words: Vec<String>| Words { words, output: output.to_owned(), display: Some(display.name.clone()) };
    let f3d = ["f3d", &model, &format!("--output={picture}"), &format!("--resolution={width},{height}")];
    let f3d = with_display(f3d.map(str::to_owned).to_vec());
    match run(&f3d) {
        true => all.push(("f3d", f3d)),
        false => println!("SKIPPED f3d: it is not installed, or draws nothing here"),
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
        .join("benches/peers/pyvista_picture.py")
        .display()
        .to_string();
    let pyvista = settings.python.as_ref().map(|python| {
        with_display(vec![
            python.clone(),
            script,
            model.clone(),
            picture.clone(),
            width.to_string(),
            height.to_string(),
        ])
    });
    match pyvista.filter(run) {
        Some(pyvista) => all.push(("PyVista", pyvista)),
        None => println!("SKIPPED PyVista: needs --python PYTHON with pyvista in it"),
    }
    all
}

/// An X server without a screen.
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
