//! Edge lists and silhouettes compared with VTK and numpy. docs/results/measuring.md has the command.
//!
//! Two meshes: the model, and the model with every triangle cut into sixteen. Rounds are interleaved: in each, every
//! contestant runs once. All raw values go to `target/bench/edges.json`.

mod report;

use glam::DVec3;
use report::{Series, print_table, write_record};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;
use tinta::edges::{Class, ClassSet, Classes, CreaseAngle, Eye, SilhouetteRule, Silhouettes};
use tinta::renderer::milliseconds_since;
use tinta::{EdgeList, LoadOptions, Mesh, load};

const USAGE: &str = "cargo bench --bench edges -- MODEL [--python PYTHON] [--rounds N]
  MODEL            a model file, for example the Stanford bunny
  --python PYTHON  a Python with VTK and numpy (pip install vtk)
  --rounds N       interleaved rounds (default 7)";

/// Repeats within a round, for small meshes and for large ones.
const REPEATS: [usize; 2] = [9, 3];

struct Settings {
    model: String,
    python: Option<String>,
    rounds: usize,
}

fn settings() -> Option<Settings> {
    let mut settings = Settings { model: String::new(), python: None, rounds: 7 };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--python" => settings.python = arguments.next(),
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            _ if settings.model.is_empty() => settings.model = argument,
            _ => return None,
        }
    }
    (!settings.model.is_empty()).then_some(settings)
}

fn main() {
    let Some(settings) = settings() else {
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
    if settings.python.is_none() {
        println!("SKIPPED VTK and numpy: need --python PYTHON with vtk in it");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fine = Arc::new(cut_in_sixteen(&mesh));
    let tables: Vec<Value> = [(&mesh, REPEATS[0]), (&fine, REPEATS[1])]
        .into_iter()
        .map(|(mesh, repeats)| edge_tables(&settings, mesh, repeats, folder.path()))
        .collect();
    let listing_ms = listing_ms(&mesh);
    println!("\nthe text's linear search, once: {listing_ms:.0} ms");
    let record = json!({
        "model": settings.model,
        "edges": tables,
        "listing_ms": listing_ms,
    });
    write_record("edges", &record);
}

/// Every triangle cut into four at its sides' middles, twice.
fn cut_in_sixteen(mesh: &Mesh) -> Mesh {
    let mut positions = mesh.positions.clone();
    let mut triangles = mesh.triangles.clone();
    for _ in 0..2 {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut finer = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    positions.push((positions[a as usize] + positions[b as usize]) * 0.5);
                    positions.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    Mesh { positions, triangles, ..Mesh::triangle() }
}

/// The listing's edge list, every edge looked for among all before it (errata D1), milliseconds.
fn listing_ms(mesh: &Mesh) -> f64 {
    let start = Instant::now();
    let mut list: Vec<([u32; 2], u32)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (a, c), (b, c)] {
            let edge = [*from.min(to), *from.max(to)];
            match list.iter_mut().find(|(known, _)| *known == edge) {
                Some((_, boundary)) => *boundary += 1,
                None => list.push((edge, 1)),
            }
        }
    }
    let time = milliseconds_since(start);
    assert_eq!(list.len(), EdgeList::new(mesh).len());
    time
}

/// The mesh as the peers read it.
fn write_arrays(mesh: &Mesh, folder: &Path) -> [PathBuf; 2] {
    let [points, triangles] = ["points", "triangles"].map(|name| folder.join(name));
    let coordinates: Vec<u8> =
        mesh.positions.iter().flat_map(|point| point.to_array()).flat_map(f64::to_le_bytes).collect();
    let indices: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|index| i64::from(*index).to_le_bytes()).collect();
    std::fs::write(&points, coordinates).expect("the temporary folder can be written");
    std::fs::write(&triangles, indices).expect("the temporary folder can be written");
    [points, triangles]
}

fn peer(mut command: Command, script: &str, arrays: &[PathBuf; 2], arguments: &[String]) -> Value {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("benches/peers").join(script);
    let output = command.arg(script).args(arrays).args(arguments).output().expect("the peer can be started");
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().rfind(|line| line.starts_with('{'));
    let line = line.unwrap_or_else(|| panic!("no times from the peer: {}", String::from_utf8_lossy(&output.stderr)));
    serde_json::from_str(line).expect("JSON from the peer")
}

fn times(record: &Value, name: &str) -> Vec<f64> {
    record[name].as_array().expect("times").iter().filter_map(Value::as_f64).collect()
}

/// The eye at a step around the mesh, 1.5 diagonals of its bounding box away.
fn eye(mesh: &Mesh, step: usize) -> Eye {
    let (low, high) = mesh.bounds();
    let angle = 0.1 * step as f64;
    let away = DVec3::new(1.5 * angle.sin(), 0.3, 1.5 * angle.cos()) * (high - low).length();
    Eye::Point((low + high) * 0.5 + away)
}

fn edge_tables(settings: &Settings, mesh: &Mesh, repeats: usize, folder: &Path) -> Value {
    let wanted = ClassSet::of(&[Class::Boundary, Class::Crease, Class::NonManifold]);
    let edges = EdgeList::new(mesh);
    let faces = mesh.triangles.len() as f64;
    println!("\n{faces} triangles, {} edges", edges.len());
    let arrays = write_arrays(mesh, folder);
    let names = [
        "edges + classes, one thread",
        "edges + classes, all threads",
        "vtkFeatureEdges",
        "numpy",
        "silhouette, one thread",
        "silhouette, all threads",
        "vtkPolyDataSilhouette",
        "numpy silhouette",
        "planes for silhouettes, once",
    ];
    let mut series: Vec<Series> = names.iter().map(|name| Series::new(name)).collect();
    let all_threads = std::thread::available_parallelism().map_or(1, usize::from);
    let silhouettes = Silhouettes::new(mesh, &edges);
    let mut found = Value::Null;
    for round in 0..settings.rounds {
        for _ in 0..repeats {
            for (slot, threads) in [(0, 1), (1, all_threads)] {
                let start = Instant::now();
                let edges = EdgeList::with_threads(mesh, threads);
                let classes = Classes::with_threads(mesh, &edges, CreaseAngle::default(), wanted, threads);
                series[slot].times.push(milliseconds_since(start));
                black_box((edges, classes));
            }
        }
        let eyes: Vec<Eye> = (0..repeats * 5).map(|step| eye(mesh, round * repeats * 5 + step)).collect();
        let rule = SilhouetteRule::Exact;
        // One method after the other, each with its data loaded, as in a window that turns the model.
        let mut all = |slot: usize, find: &dyn Fn(Eye) -> Vec<u32>| -> Vec<Vec<u32>> {
            let one = |eye: &Eye| {
                let start = Instant::now();
                let found = find(*eye);
                (milliseconds_since(start), found)
            };
            let (times, found): (Vec<f64>, Vec<Vec<u32>>) = eyes.iter().map(one).unzip();
            series[slot].times.extend(times);
            found
        };
        let one = all(4, &|eye| silhouettes.find_with_threads(mesh, &edges, eye, rule, 1));
        assert_eq!(one, all(5, &|eye| silhouettes.find_with_threads(mesh, &edges, eye, rule, all_threads)));
        let start = Instant::now();
        black_box(Silhouettes::new(mesh, &edges));
        series[8].times.push(milliseconds_since(start));
        if let Some(python) = &settings.python {
            let record = peer(Command::new(python), "vtk_edges.py", &arrays, &[repeats.to_string()]);
            for (slot, name) in
                [(2, "feature_edges_ms"), (3, "numpy_edges_ms"), (6, "silhouette_ms"), (7, "numpy_silhouette_ms")]
            {
                series[slot].times.extend(times(&record, name));
            }
            found = record;
        }
    }
    let classes = Classes::new(mesh, &edges, CreaseAngle::default(), wanted);
    println!(
        "  found: {} feature edges; the peers: {} and {}",
        classes.marked.len(),
        found["feature_edges"],
        found["numpy_edges"]
    );
    series.retain(|one| !one.times.is_empty());
    let raw = print_table(&series, "vtkFeatureEdges");
    for one in series.iter().filter(|one| names[..4].contains(&one.name.as_str())) {
        println!("  {:<34}{:>10.2} million triangles a second", one.name, faces / one.median() / 1e3);
    }
    json!({ "triangles": faces, "edges": edges.len(), "raw": raw })
}
