//! Whole processes of the looks beside f3d, and beside exact lines alone:
//! `cargo bench --bench looks -- [MODEL…] [--family NAME=SIZE]… [--rounds N] [--peer FILE] [--program FILE]`.
//!
//! Writes each family's scene as OBJ. For each model and scene f3d's picture and the looks' files take turns, round by round, each in a
//! process of its own, at 1280 x 960. f3d is left out where it is not found. Raw values go to `target/bench/looks.json`.

#[expect(dead_code, reason = "lines_growth tells families and sets their view")]
#[path = "../crates/tinta-geometry/tests/support/growth.rs"]
mod families;
mod report;

use families::FAMILIES;
use report::{Series, print_table, write_record};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

const USAGE: &str =
    "cargo bench --bench looks -- [MODEL…] [--family NAME=SIZE]… [--rounds N] [--peer FILE] [--program FILE]
  MODEL              files to draw
  --family NAME=SIZE a scene of lines_growth with about so many triangles: soup=400
  --rounds N         rounds in which contestants take turns (default 5)
  --peer FILE        f3d (default: the one that is found); it may need a display
  --program FILE     the tinta to measure (default: the one built with this)";

/// A contestant that is compared with others.
const LINES: &str = "lines, svg";

/// The looks: a name, the ending of the file, the options.
const LOOKS: [(&str, &str, &[&str]); 8] = [
    ("default, png", "png", &[]),
    ("default without its shadow, png", "png", &["--ground", "none"]),
    ("default, svg", "svg", &[]),
    ("technical, svg", "svg", &["--look", "technical"]),
    ("published, png", "png", &["--look", "published"]),
    (LINES, "svg", &["--style", "lines"]),
    ("lines with their outline, svg", "svg", &["--style", "lines", "--class-widths", "outline=4"]),
    ("hatched, svg", "svg", &["--hatch", "auto"]),
];

struct Settings {
    models: Vec<PathBuf>,
    families: Vec<(String, usize)>,
    rounds: usize,
    peer: PathBuf,
    program: PathBuf,
}

fn settings() -> Option<Settings> {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_tinta"));
    let mut settings =
        Settings { models: Vec::new(), families: Vec::new(), rounds: 5, peer: PathBuf::from("f3d"), program };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--family" => {
                let family = arguments.next()?;
                let (name, size) = family.split_once('=')?;
                settings.families.push((name.to_owned(), size.parse().ok()?));
            }
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            "--peer" => settings.peer = PathBuf::from(arguments.next()?),
            "--program" => settings.program = PathBuf::from(arguments.next()?),
            option if option.starts_with("--") => return None,
            model => settings.models.push(PathBuf::from(model)),
        }
    }
    Some(settings)
}

fn main() {
    let Some(mut settings) = settings() else {
        println!("{USAGE}");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    for (name, size) in &settings.families {
        let family = FAMILIES.iter().find(|family| family.name == name).expect("a family of lines_growth");
        let path = folder.path().join(format!("{name}-{size}.obj"));
        let shape = (family.make)(*size);
        let mut text = String::new();
        shape.positions.iter().for_each(|at| writeln!(text, "v {} {} {}", at.x, at.y, at.z).expect("memory"));
        for corners in &shape.triangles {
            let [a, b, c] = corners.map(|corner| corner + 1);
            writeln!(text, "f {a} {b} {c}").expect("memory");
        }
        std::fs::write(&path, text).expect("the scene can be written");
        settings.models.push(path);
    }
    let rows: Vec<Value> = settings.models.iter().map(|model| measured(model, &settings, folder.path())).collect();
    write_record("looks", &Value::Array(rows));
}

/// Times all contestants with a model.
fn measured(model: &Path, settings: &Settings, folder: &Path) -> Value {
    println!("{}", model.display());
    let peer = || {
        let mut peer = Command::new(&settings.peer);
        peer.arg(model).arg("--output").arg(folder.join("peer.png")).arg("--resolution=1280,960");
        peer
    };
    let mut series: Vec<Series> = LOOKS.iter().map(|(name, ..)| Series::new(name)).collect();
    let mut of_peer = Series::new("f3d, png");
    for _ in 0..settings.rounds {
        of_peer.times.extend(timed(peer()));
        for ((_, ending, options), series) in LOOKS.iter().zip(&mut series) {
            let mut tinta = Command::new(&settings.program);
            tinta.arg("render").arg(model).arg("-o").arg(folder.join(format!("look.{ending}")));
            tinta.args(["--size", "1280x960"]).args(*options);
            series.times.extend(timed(tinta));
        }
    }
    let against = if of_peer.times.is_empty() { LINES } else { "f3d, png" };
    series.push(of_peer);
    series.retain(|series| !series.times.is_empty());
    json!({ "model": model, "series": print_table(&series, against) })
}

/// Milliseconds that a process takes; `None` where it fails.
fn timed(mut command: Command) -> Option<f64> {
    let start = Instant::now();
    let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?;
    status.success().then(|| start.elapsed().as_secs_f64() * 1e3)
}
