//! Measures the time to read a model, each stage next to its limit:
//! `cargo bench -p tinta-geometry --bench reading -- [TRIANGLES] [ROUNDS]`.
//!
//! A sphere with bumps is written in all formats that hold any number of triangles. Each round reads every format
//! once, and the results are medians over the rounds: a plain read of the file, a copy of its bytes in memory, the
//! stages of `load`, and the vertex arrays next to a copy of them. The allocator counts the memory.

#![expect(unsafe_code, reason = "an allocator that counts can only be written so")]

#[path = "../tests/big/mod.rs"]
mod big;

use big::{Counting, files, peak, sphere};
use std::path::Path;
use std::time::Instant;
use tinta_geometry::mesh::{LoadStage, VertexArrays};
use tinta_geometry::{LoadOptions, load};

#[global_allocator]
static COUNTING: Counting = Counting;

/// The measurements of a format, milliseconds.
const COLUMNS: [&str; 8] = ["plain read", "memcpy", "reading", "parsing", "joining", "normals", "arrays", "memcpy"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = std::env::args().skip(1).filter_map(|argument| argument.parse().ok());
    let (triangles, rounds) = (numbers.next().unwrap_or(1_000_000), numbers.next().unwrap_or(5));
    let folder = tempfile::tempdir()?;
    let (count, files) = {
        let (positions, triangles) = sphere(triangles);
        (triangles.len(), files(&positions, &triangles, folder.path())?)
    };
    println!("{count} triangles, medians of {rounds} rounds, ms");
    println!(
        "{:<12}{:>8}{:>9}{}{:>14}",
        "",
        "MB",
        "B/tri",
        COLUMNS.map(|name| format!("{name:>12}")).concat(),
        "read, MB/s"
    );
    let mut times = vec![[const { Vec::new() }; COLUMNS.len()]; files.len()];
    let mut bytes_a_triangle = vec![0; files.len()];
    for _ in 0..rounds {
        for (((_, path), times), bytes) in files.iter().zip(&mut times).zip(&mut bytes_a_triangle) {
            let (measured, peak) = peak(|| one(path));
            times.iter_mut().zip(measured?).for_each(|(times, time)| times.push(time));
            *bytes = peak / count;
        }
    }
    for (((name, path), times), bytes) in files.iter().zip(&mut times).zip(bytes_a_triangle) {
        let medians = times.each_mut().map(|times| median(times));
        let mb = std::fs::metadata(path)?.len() as f64 * 1e-6;
        let columns = medians.map(|time| format!("{time:>12.1}")).concat();
        println!("{name:<12}{mb:>8.1}{bytes:>9}{columns}{:>14.0}", mb / (medians[2] + medians[3]) * 1e3);
    }
    Ok(())
}

/// Reads a file once; returns all times, in the order of the columns.
fn one(path: &Path) -> tinta_geometry::Result<[f64; COLUMNS.len()]> {
    let (bytes, plain) = timed(|| std::fs::read(path).unwrap_or_default());
    let (copy, copied) = timed(|| bytes.clone());
    drop((bytes, copy));
    let loaded = load(&path.to_string_lossy(), &LoadOptions::default())?;
    let took = |stage| loaded.stages.iter().find(|(other, _)| *other == stage).map_or(0.0, |(_, ms)| *ms);
    let stages = [LoadStage::Reading, LoadStage::Parsing, LoadStage::Joining, LoadStage::Normals].map(took);
    let (arrays, made) = timed(|| VertexArrays::new(&loaded.mesh, 1.0));
    let (_, arrays_copied) = timed(|| (arrays.vertices.clone(), arrays.indices.clone()));
    let [reading, parsing, joining, normals] = stages;
    Ok([plain, copied, reading, parsing, joining, normals, made, arrays_copied])
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let clock = Instant::now();
    let result = work();
    (result, clock.elapsed().as_secs_f64() * 1e3)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
