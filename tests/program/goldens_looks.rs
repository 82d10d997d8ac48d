//! Small approved pictures of each look, drawn by the finished program.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens_looks` draws them anew and then fails.

use crate::program::done;
use crate::support::backend_names;
use crate::support::goldens::{Goldens, compare, how_to_update, names};
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
                let (path, out) = (format!("builtin:{model}"), file.to_str().unwrap());
                let line = ["render", &path, "--look", look.name, "--size", "128", "--backend", backend, "-o", out];
                done(&[&line[..], &["--no-recipe"]].concat());
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
