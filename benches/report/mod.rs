//! Shared parts of the benchmarks: a contestant's times, tables of medians, the record of all raw values.

use serde_json::{Value, json};
use std::path::Path;
use tinta::renderer::median;

/// Writes the record to `target/bench/NAME.json` and prints its path.
pub fn write_record(name: &str, record: &Value) {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join(format!("target/bench/{name}.json"));
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    std::fs::write(&path, serde_json::to_string_pretty(record).expect("JSON")).expect("the record can be written");
    println!("raw values: {}", path.display());
}

/// A contestant's times, milliseconds, over all rounds.
pub struct Series {
    /// Who.
    pub name: String,
    /// In the order measured.
    pub times: Vec<f64>,
}

impl Series {
    /// Without times.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), times: Vec::new() }
    }

    /// The middle time.
    pub fn median(&self) -> f64 {
        median(self.times.clone()).unwrap_or(f64::NAN)
    }
}

/// Prints medians, quartiles and the ratios to one contestant; returns the raw values.
pub fn print_table(series: &[Series], against: &str) -> Value {
    println!("  {:<34}{:>10}{:>10}{:>10}", "", "median ms", "quartiles", "");
    for one in series {
        let [low, middle, high] = quartiles(&one.times);
        println!("  {:<34}{middle:>10.2}{low:>10.2}{high:>10.2}", one.name);
    }
    if series.iter().any(|one| one.name == against) {
        print_ratio(series, against);
    }
    let rows: Vec<Value> = series.iter().map(|one| json!({ "name": one.name, "ms": one.times })).collect();
    Value::Array(rows)
}

/// Prints every contestant's median over one's.
pub fn print_ratio(series: &[Series], against: &str) {
    let base = series.iter().find(|one| one.name == against).map_or(f64::NAN, Series::median);
    for one in series.iter().filter(|one| one.name != against) {
        println!("  {:<34}{:>10.2} x {against}", one.name, one.median() / base);
    }
}

fn quartiles(times: &[f64]) -> [f64; 3] {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| sorted.get(sorted.len() * quarter / 4).copied().unwrap_or(f64::NAN))
}
