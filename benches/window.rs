//! The window under Xvfb: time to the first picture, pictures a second while the model turns, the longest frame while a large model is
//! read, pixels explained under the pointer, and processor time at rest. Run `cargo bench --bench window -- --model FILE --large FILE`.
//!
//! Each round starts a new process for each row. Raw values go to `target/bench/window.json`.

mod report;

use report::{Series, print_table, write_record};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use tinta::renderer::median;

const USAGE: &str = "cargo bench --bench window -- --model FILE [--large FILE] [--rounds N]
  --model FILE   the model that is turned (the Stanford bunny)
  --large FILE   the model that is read while frames go on (1.1 million triangles); without it only turning is timed
  --rounds N     interleaved rounds (default 5)";

/// Frames of a drag.
const DRAG_FRAMES: usize = 150;

/// Pictures at a drag's beginning that are not counted: shaders are compiled, a second thread started.
const WARM_UP: usize = 30;

/// The turned models: a name, and options.
const DRAGS: [(&str, &[&str]); 11] = [
    ("three-pass", &["--style", "three-pass"]),
    ("three-pass --cull back", &["--style", "three-pass", "--cull", "back"]),
    ("three-pass --coarse", &["--style", "three-pass", "--coarse"]),
    ("mrt", &["--style", "mrt"]),
    ("mrt --cull back", &["--style", "mrt", "--cull", "back"]),
    ("inking", &["--style", "inking"]),
    ("inking --coarse", &["--style", "inking", "--coarse"]),
    ("charcoal", &["--style", "charcoal"]),
    ("look print", &["--look", "print"]),
    ("look print --coarse", &["--look", "print", "--coarse"]),
    ("lines", &["--style", "lines"]),
];

/// Styles whose pixels are explained, and the pixels.
const POINTED: [&str; 3] = ["three-pass", "ink", "charcoal"];
const PIXELS: u32 = 200;

struct Settings {
    model: String,
    large: Option<String>,
    rounds: usize,
}

fn settings() -> Option<Settings> {
    let (mut model, mut large, mut rounds) = (None, None, 5);
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--model" => model = arguments.next(),
            "--large" => large = arguments.next(),
            "--rounds" => rounds = arguments.next()?.parse().ok()?,
            _ => return None,
        }
    }
    Some(Settings { model: model?, large, rounds })
}

fn main() {
    let Some(settings) = settings() else {
        println!("{USAGE}");
        return;
    };
    let display = Display::start();
    let mut first = Series::new("bust, first picture");
    let mut drags: Vec<Series> = DRAGS.iter().map(|(name, _)| Series::new(name)).collect();
    // Two threads' pictures come in pairs, which makes the median interval useless: a round's result is its number of pictures a
    // second.
    let mut rates: Vec<Vec<f64>> = vec![Vec::new(); DRAGS.len()];
    let mut longest = Series::new("large model, longest frame");
    let mut middle = Series::new("large model, middle frame");
    let mut idle = Series::new("at rest, in 5 s");
    let mut pointed: Vec<Series> = POINTED.iter().map(|name| Series::new(name)).collect();
    let drag = recording("drag", (1..=DRAG_FRAMES).map(|_| json!({ "turn": [0.01, 0.002] })), Some("drag"));
    let load = recording("load", settings.large.iter().map(|large| json!({ "open": [large] })), Some("free"));
    // Across the model, three pixels a frame.
    let at = |number: u32| json!({ "point": ["left", [130 + number * 3 % 250, 200 + number * 3 / 250 * 7]] });
    let point = recording("point", std::iter::once(json!("explain")).chain((0..PIXELS).map(at)), None);
    for round in 1..=settings.rounds {
        println!("round {round} of {}", settings.rounds);
        for ((series, rates), (_, options)) in drags.iter_mut().zip(&mut rates).zip(DRAGS) {
            let record = display.play(&[&[settings.model.as_str()], options].concat(), &drag);
            let times: Vec<f64> = numbers(&record["drag_frame_ms"]["all"]).into_iter().skip(WARM_UP).collect();
            rates.push(1000.0 * times.len() as f64 / times.iter().sum::<f64>());
            series.times.extend(times);
        }
        for (series, style) in pointed.iter_mut().zip(POINTED) {
            let record = display.play(&[&settings.model, "--style", style], &point);
            // After the first picture and the opening of the listing.
            series.times.extend(numbers(&record["frame_ms"]["all"]).into_iter().skip(2));
        }
        if settings.large.is_none() {
            continue;
        }
        let record = display.play(&["builtin:bust"], &recording("first", std::iter::empty(), None));
        first.times.extend(record["first_picture_ms"].as_f64());
        let record = display.play(&["builtin:bust"], &load);
        longest.times.extend(record["free_frame_ms"]["max"].as_f64());
        middle.times.extend(record["free_frame_ms"]["median"].as_f64());
        idle.times.push(display.idle_ms(&settings.model));
    }
    let mut single = Value::Null;
    if settings.large.is_some() {
        println!("\nwindow at 1280x720, in milliseconds");
        single = print_table(&[first, longest, middle, idle], "");
    }
    println!("\n{} at 512x512 while it turns, from one new picture on the screen to the next", settings.model);
    let drags = print_table(&drags, "three-pass");
    println!("\npictures a second: median of {} rounds, and each", settings.rounds);
    for ((name, _), rates) in DRAGS.iter().zip(&rates) {
        let all: Vec<String> = rates.iter().map(|rate| format!("{rate:.1}")).collect();
        println!("  {name:<34}{:>10.1}   {}", median(rates.clone()).unwrap_or(f64::NAN), all.join(" "));
    }
    println!("\n{} at 512x512, from one pixel under the pointer explained and shown to the next", settings.model);
    let pointed = print_table(&pointed, "three-pass");
    write_record("window", &json!({ "single": single, "drags": drags, "rates": rates, "pointed": pointed }));
}

/// Writes a recording of a 512x512 area with these events, one a frame, each with this flag.
fn recording(name: &str, events: impl Iterator<Item = Value>, flag: Option<&str>) -> String {
    let mut lines = vec![json!({ "frame": 0, "event": { "resize": [512, 512] } })];
    lines.extend(events.enumerate().map(|(index, event)| {
        let mut line = json!({ "frame": index + 1, "event": event });
        if let Some(flag) = flag {
            line[flag] = true.into();
        }
        line
    }));
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.jsonl"));
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    std::fs::write(&path, text).expect("the recording can be written");
    path.display().to_string()
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

/// An X server without a screen.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb; on Debian: apt-get install xvfb");
        let mut number = String::new();
        let output = server.stdout.take().expect("its output");
        BufReader::new(output).read_line(&mut number).expect("the display's number");
        Self { server, name: format!(":{}", number.trim()) }
    }

    fn view(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
        command.arg("view").args(arguments).env("DISPLAY", &self.name).env_remove("WAYLAND_DISPLAY");
        command.stderr(Stdio::null());
        command
    }

    /// Plays a recording and returns its measurements.
    fn play(&self, arguments: &[&str], recording: &str) -> Value {
        let output = self.view(arguments).args(["--replay", recording, "--json"]).output().expect("tinta view");
        assert!(output.status.success(), "{arguments:?}");
        serde_json::from_slice(&output.stdout).expect("a record")
    }

    /// Processor time of five idle seconds, milliseconds.
    fn idle_ms(&self, model: &str) -> f64 {
        let mut window = self.view(&[model]).stdout(Stdio::null()).spawn().expect("tinta view");
        std::thread::sleep(Duration::from_secs(5));
        let before = processor_ticks(window.id());
        std::thread::sleep(Duration::from_secs(5));
        let ticks = processor_ticks(window.id()) - before;
        window.kill().expect("the window can be closed");
        window.wait().expect("the window ends");
        // Linux counts in hundredths of a second.
        ticks * 10.0
    }
}

/// User and system time of a process, in the system's ticks.
fn processor_ticks(process: u32) -> f64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/stat")).expect("the window is still there");
    let fields: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    fields[11..13].iter().filter_map(|field| field.parse::<f64>().ok()).sum()
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
