//! Small approved pictures of each look, drawn by the finished program.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens_looks` draws them anew and then fails.

use crate::support::backend_names;
use crate::support::goldens::{Goldens, compare, how_to_update, names};
use std::process::Command;
use tinta::Picture;
use tinta::preset::LOOKS;

#[test]
fn every_look_draws_the_built_in_models_as_they_were_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let mut failures = Vec::new();
    for look in LOOKS {
        for model in ["bust", "gear", "ant"] {
            for backend in backend_names() {
                let file = folder.path().join(format!("{}-{model}-{backend}.png", look.name));
                let mut tinta = Command::new(env!("CARGO_BIN_EXE_tinta"));
                tinta.args(["render", &format!("builtin:{model}"), "--look", look.name, "--size", "128"]);
                tinta.args(["--backend", backend, "--no-recipe", "-o"]).arg(&file);
                let output = tinta.output().unwrap();
                assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
                let picture = Picture::read_png(&file).unwrap();
                failures.extend(compare(&format!("look-{}-{model}", look.name), &picture, backend).err());
            }
        }
    }
    assert!(failures.is_empty(), "{}\n{}", failures.join("\n"), how_to_update("goldens_looks"));
}

#[test]
fn every_golden_of_a_look_is_drawn() {
    let drawn =
        LOOKS.iter().flat_map(|look| ["bust", "gear", "ant"].map(|model| format!("look-{}-{model}", look.name)));
    let (mut drawn, mut kept): (Vec<String>, Vec<String>) = (drawn.collect(), names(Goldens::Looks));
    drawn.sort();
    kept.sort();
    assert_eq!(drawn, kept);
}
