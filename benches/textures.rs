//! Time of the charcoal drawing's textures, compared with the goal of 50 ms for all three at 512 x 512.
//!
//! `cargo bench --bench textures` prints medians; all raw values go to `target/bench/textures.json`.

use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;
use tinta::renderer::{median, milliseconds_since};
use tinta::textures::{ContrastTexture, NoiseTexture, PaperTexture};
use tinta::{Picture, Result, Size};

const ROUNDS: usize = 41;

fn main() {
    let mut tables = Vec::new();
    for side in [512, 1024] {
        let size = Size { width: side, height: side };
        let contrast = ContrastTexture { size, ..ContrastTexture::default() };
        let noise = NoiseTexture { size, ..NoiseTexture::default() };
        let paper = PaperTexture { size, ..PaperTexture::default() };
        let rows = [
            ("cet", times(|| contrast.picture())),
            ("noise", times(|| noise.picture())),
            ("paper", times(|| paper.picture())),
        ];
        let middle = |times: &[f64]| median(times.to_vec()).unwrap_or(f64::NAN);
        println!("\n{size}, median of {ROUNDS}");
        for (name, times) in &rows {
            println!("  {name:<8}{:>8.2} ms", middle(times));
        }
        println!("  {:<8}{:>8.2} ms", "all", rows.iter().map(|(_, times)| middle(times)).sum::<f64>());
        let rows: Vec<Value> = rows.iter().map(|(name, times)| json!({ "name": name, "ms": times })).collect();
        tables.push(json!({ "size": size, "textures": rows }));
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("target/bench/textures.json");
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    std::fs::write(&path, serde_json::to_string_pretty(&tables).expect("JSON")).expect("the record can be written");
    println!("raw values: {}", path.display());
}

fn times(make: impl Fn() -> Result<Picture>) -> Vec<f64> {
    let one = || {
        let start = Instant::now();
        std::hint::black_box(make().expect("a texture"));
        milliseconds_since(start)
    };
    one();
    (0..ROUNDS).map(|_| one()).collect()
}
