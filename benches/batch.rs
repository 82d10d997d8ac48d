//! Many small pictures: `tinta batch` against one process per picture, and the cost of a job.
//!
//! `cargo bench --bench batch` writes different meshes of 1,000 triangles, and a job for each: 256x256 pixels, the default style.
//! Contestants take turns. One process per picture draws a share of them, as many in parallel as there are jobs of the batch. Raw
//! values go to `target/bench/batch.json`; docs/results/measuring.md has the command and the numbers.

use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tinta::renderer::median;

const USAGE: &str = "cargo bench --bench batch -- [--rounds N] [--jobs N] [--alone N] [--program FILE] [--memory]
  --rounds N     rounds in which contestants take turns (default 5)
  --jobs N       jobs of the batch (default 1000)
  --alone N      pictures that are drawn in a process each (default 100)
  --program FILE the tinta to measure (default: the one built with this)
  --memory       resident memory of one worker over ten times as many renders, instead of times";

struct Settings {
    rounds: usize,
    jobs: usize,
    alone: usize,
    program: PathBuf,
    memory: bool,
}

fn settings() -> Option<Settings> {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_tinta"));
    let mut settings = Settings { rounds: 5, jobs: 1000, alone: 100, program, memory: false };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            "--jobs" => settings.jobs = arguments.next()?.parse().ok()?,
            "--alone" => settings.alone = arguments.next()?.parse().ok()?,
            "--program" => settings.program = PathBuf::from(arguments.next()?),
            "--memory" => settings.memory = true,
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
    let folder = tempfile::tempdir().expect("a folder");
    write_models(folder.path(), settings.jobs);
    if settings.memory {
        write_record("batch-memory", &memory(&settings, folder.path()));
        return;
    }
    let list = write_list(folder.path(), settings.jobs, 1);
    // Pictures a second and processor milliseconds a picture, round by round.
    let mut rates: Vec<(String, Vec<f64>, Vec<f64>)> = Vec::new();
    for round in 0..settings.rounds {
        for jobs in [2, 1] {
            let batch = run_batch(&settings, folder.path(), &list, jobs);
            let alone = run_alone(&settings, folder.path(), jobs);
            for (name, count, [seconds, busy]) in
                [("batch", settings.jobs, batch), ("one process a picture", settings.alone, alone)]
            {
                let name = format!("{name}, {jobs} at once");
                let (rate, busy) = (count as f64 / seconds, busy * 1e3 / count as f64);
                println!("round {}: {name:<34}{rate:>8.1} a second, {busy:>7.2} ms of a processor each", round + 1);
                match rates.iter_mut().find(|(known, ..)| *known == name) {
                    Some((_, rates, all_busy)) => {
                        rates.push(rate);
                        all_busy.push(busy);
                    }
                    None => rates.push((name, vec![rate], vec![busy])),
                }
            }
        }
    }
    println!("\n{} meshes of {TRIANGLES} triangles, 256x256, medians of {} rounds", settings.jobs, settings.rounds);
    let middle = |rates: &[f64]| median(rates.to_vec()).unwrap_or(f64::NAN);
    for (name, rates, busy) in &rates {
        println!("  {name:<34}{:>8.1} a second{:>10.2} ms of a processor each", middle(rates), middle(busy));
    }
    let row = |(name, rates, busy): &(String, Vec<f64>, Vec<f64>)| json!({ "name": name, "a_second": rates, "processor_ms": busy });
    let rows: Vec<Value> = rates.iter().map(row).collect();
    write_record("batch", &json!({ "jobs": settings.jobs, "alone": settings.alone, "contestants": rows }));
}

/// Writes the record to `target/bench/NAME.json` and prints its path.
fn write_record(name: &str, record: &Value) {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join(format!("target/bench/{name}.json"));
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    std::fs::write(&path, serde_json::to_string_pretty(record).expect("JSON")).expect("the record can be written");
    println!("raw values: {}", path.display());
}

/// Around the ring of each mesh, a torus, and around its tube.
const RING: usize = 25;
const TUBE: usize = 20;

/// Triangles of each mesh.
const TRIANGLES: usize = 2 * RING * TUBE;

/// Writes meshes that are all different.
fn write_models(folder: &Path, count: usize) {
    for number in 0..count {
        let mut text = String::new();
        for (ring, tube) in (0..RING).flat_map(|ring| (0..TUBE).map(move |tube| (ring, tube))) {
            let angle = |place: usize, count: usize| place as f64 / count as f64 * std::f64::consts::TAU;
            let (around, across) = (angle(ring, RING), angle(tube, TUBE));
            let wave = 1.0 + 0.3 * (around * (2 + number % 7) as f64).sin() * (across * (number % 5) as f64).cos();
            let radius = 1.0 + (0.4 * wave + 1e-4 * number as f64) * across.cos();
            let (x, y, z) = (radius * around.cos(), 0.4 * wave * across.sin(), radius * around.sin());
            let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}");
        }
        for (ring, tube) in (0..RING).flat_map(|ring| (0..TUBE).map(move |tube| (ring, tube))) {
            let at = |ring: usize, tube: usize| ring % RING * TUBE + tube % TUBE + 1;
            let [a, b, c, d] = [at(ring, tube), at(ring, tube + 1), at(ring + 1, tube + 1), at(ring + 1, tube)];
            let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
        }
        std::fs::write(folder.join(format!("{number}.obj")), text).expect("a model can be written");
    }
}

/// A list that draws every model so many times.
fn write_list(folder: &Path, models: usize, times: usize) -> PathBuf {
    let mut text = String::new();
    for number in 0..models * times {
        let model = folder.join(format!("{}.obj", number % models));
        let job = json!({ "model": model, "output": format!("{number}.png"), "size": 256 });
        let _ = writeln!(text, "{job}");
    }
    let list = folder.join(format!("list-{times}.jsonl"));
    std::fs::write(&list, text).expect("the list can be written");
    list
}

/// Processor seconds of all processes that this one started and that have ended, and those they started.
fn processor_seconds() -> f64 {
    const TICKS_A_SECOND: f64 = 100.0;
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = text.rsplit(')').next().unwrap_or_default().split_ascii_whitespace();
    fields.skip(13).take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / TICKS_A_SECOND
}

/// Seconds that a batch takes, and those it keeps a processor busy.
fn run_batch(settings: &Settings, folder: &Path, list: &Path, jobs: usize) -> [f64; 2] {
    let out = folder.join("out");
    let (start, busy) = (Instant::now(), processor_seconds());
    let status = Command::new(&settings.program)
        .args(["batch", "--jobs", &jobs.to_string(), "-o"])
        .args([&out, list])
        .stderr(Stdio::null())
        .status();
    let seconds = [start.elapsed().as_secs_f64(), processor_seconds() - busy];
    assert!(status.is_ok_and(|status| status.success()), "the batch has been done");
    std::fs::remove_dir_all(&out).expect("its folder can be removed");
    seconds
}

/// The same for single processes, so many in parallel.
fn run_alone(settings: &Settings, folder: &Path, at_once: usize) -> [f64; 2] {
    let out = folder.join("alone");
    std::fs::create_dir_all(&out).expect("a folder");
    let next = AtomicUsize::new(0);
    let (start, busy) = (Instant::now(), processor_seconds());
    std::thread::scope(|scope| {
        for _ in 0..at_once {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= settings.alone.min(settings.jobs) {
                        return;
                    }
                    let (model, picture) = (folder.join(format!("{number}.obj")), out.join(format!("{number}.png")));
                    let status = Command::new(&settings.program)
                        .args(["render", "--size", "256", "-o"])
                        .args([&picture, &model])
                        .status();
                    assert!(status.is_ok_and(|status| status.success()), "{number} has been drawn");
                }
            });
        }
    });
    let seconds = [start.elapsed().as_secs_f64(), processor_seconds() - busy];
    std::fs::remove_dir_all(&out).expect("its folder can be removed");
    seconds
}

/// A worker's resident memory, MiB, at every tenth of ten times as many renders.
fn memory(settings: &Settings, folder: &Path) -> Value {
    let list = write_list(folder, settings.jobs, 10);
    let out = folder.join("out");
    let mut run = Command::new(&settings.program)
        .args(["batch", "--jobs", "1", "-o"])
        .args([&out, &list])
        .stderr(Stdio::null())
        .spawn()
        .expect("the batch can be started");
    let (mut drawn, mut seen) = (0, Vec::new());
    while drawn < settings.jobs * 10 && run.try_wait().is_ok_and(|status| status.is_none()) {
        std::thread::sleep(std::time::Duration::from_millis(50));
        drawn = std::fs::read_dir(&out).map_or(0, Iterator::count);
        while seen.len() * settings.jobs < drawn * 2 && seen.len() <= 20 {
            seen.push((drawn, resident_mib(run.id())));
        }
    }
    assert!(run.wait().is_ok_and(|status| status.success()), "the batch has been done");
    for (drawn, mib) in &seen {
        println!("after {drawn:>6} renders: {mib:>8.1} MiB");
    }
    json!(seen)
}

/// Resident memory of the process that another has started.
fn resident_mib(run: u32) -> f64 {
    let kib = || -> Option<f64> {
        let tasks = std::fs::read_dir(format!("/proc/{run}/task")).ok()?;
        let children =
            tasks.flatten().map(|task| std::fs::read_to_string(task.path().join("children")).unwrap_or_default());
        let worker = children.collect::<String>().split_ascii_whitespace().next()?.to_owned();
        let status = std::fs::read_to_string(format!("/proc/{worker}/status")).ok()?;
        status.lines().find(|line| line.starts_with("VmRSS:"))?.split_ascii_whitespace().nth(1)?.parse().ok()
    };
    kib().unwrap_or(f64::NAN) / 1024.0
}
