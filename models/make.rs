//! Makes the five built-in models: a portrait bust, an open box, an ant, a gear
//! and a toy soldier; and two small ones that pictures of options need.
//!
//! `cargo run --release --example make-models -- [OUTDIR]` writes `bust.obj`,
//! `open-box.obj`, `ant.obj`, `gear.obj` and the colours beside them
//! (`*.mtl`), `soldier.md2` and its skin `soldier.pcx`, `pawn.obj`, `pawn.ppm` and `hop.md2` into OUTDIR, `models` by default. The files are the same byte
//! for byte on every run; `SOURCES.md` says what each model is for.

#[path = "make/ant.rs"]
mod ant;
#[path = "make/bust.rs"]
mod bust;
#[path = "make/clothes.rs"]
mod clothes;
#[path = "make/decimate.rs"]
mod decimate;
#[path = "make/face.rs"]
mod face;
#[path = "make/field.rs"]
mod field;
#[path = "make/gear.rs"]
mod gear;
#[path = "make/hair.rs"]
mod hair;
#[path = "make/md2.rs"]
mod md2;
#[path = "make/mesh.rs"]
mod mesh;
#[path = "make/obj.rs"]
mod obj;
#[path = "make/open_box.rs"]
mod open_box;
#[path = "make/pcx.rs"]
mod pcx;
#[path = "make/polygonise.rs"]
mod polygonise;
#[path = "make/samples.rs"]
mod samples;
#[path = "make/soldier.rs"]
mod soldier;
#[path = "make/soldier_skin.rs"]
mod soldier_skin;
#[path = "make/sweep.rs"]
mod sweep;
#[path = "make/vector.rs"]
mod vector;

use obj::Model;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = match arguments.as_slice() {
        [] => "models",
        [folder] if !folder.starts_with('-') => folder,
        _ => {
            eprintln!("usage: make-models [OUTDIR]");
            return ExitCode::from(2);
        }
    };
    match write_all(Path::new(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("make-models: {message}");
            ExitCode::FAILURE
        }
    }
}

fn write_all(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("cannot make the folder {}: {error}", folder.display()))?;
    let makers: [fn() -> Model; 4] = [open_box::model, gear::model, ant::model, bust::model];
    for make in makers {
        let model = make();
        obj::write(&model, folder)?;
        println!("{}.obj: {} triangles", model.name, model.triangle_count());
    }
    soldier::write(folder)?;
    samples::write(folder)
}
