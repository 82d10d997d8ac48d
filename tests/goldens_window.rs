//! The goldens of the window: what it shows after the events of a recording. One run of it draws them all, one test compares each.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens_window::split` draws that one anew and then fails.

use crate::goldens::{compare, how_to_update, names};
use crate::support::root;
use crate::window::Display;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use tinta::Picture;

/// The recording's pictures by name; none where no window can be opened, which is said.
fn tour() -> Option<&'static BTreeMap<String, Picture>> {
    static PICTURES: OnceLock<Option<BTreeMap<String, Picture>>> = OnceLock::new();
    PICTURES.get_or_init(replay).as_ref()
}

fn replay() -> Option<BTreeMap<String, Picture>> {
    let display = Display::start()?;
    let folder = tempfile::tempdir().unwrap();
    let recording = std::fs::read_to_string(root().join("tests/recordings/tour.jsonl")).unwrap();
    let file = folder.path().join("tour.jsonl");
    std::fs::write(&file, recording.replace("OUT/", &format!("{}/", folder.path().display()))).unwrap();
    let output = display.view(&["builtin:bust", "--look", "published", "--replay", file.to_str().unwrap(), "--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(record["first_picture_ms"].as_f64().unwrap() > 0.0);
    let pictures = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path());
    let pictures = pictures.filter(|path| path.extension().is_some_and(|extension| extension == "png"));
    let named = |path: std::path::PathBuf| {
        (path.file_stem().unwrap().to_str().unwrap().to_owned(), Picture::read_png(&path).unwrap())
    };
    let pictures: BTreeMap<String, Picture> = pictures.map(named).collect();
    assert_eq!(pictures.len(), recording.matches("OUT/").count(), "one for each in the recording");
    Some(pictures)
}

fn golden(name: &str) {
    let Some(pictures) = tour() else { return };
    let how = how_to_update(&format!("goldens_window::{}", name.replace('-', "_")));
    compare(&format!("window-{name}"), &pictures[name], "the window")
        .unwrap_or_else(|failure| panic!("{failure}\n{how}"));
}

#[test]
fn first() {
    golden("first");
}

#[test]
fn orbit() {
    golden("orbit");
}

#[test]
fn style() {
    golden("style");
}

#[test]
fn split() {
    golden("split");
}

#[test]
fn difference() {
    golden("difference");
}

#[test]
fn dial() {
    golden("dial");
}

#[test]
fn edge_classes() {
    golden("edge-classes");
}

#[test]
fn drop() {
    golden("drop");
}

#[test]
fn one_pixel() {
    golden("one-pixel");
}

#[test]
fn back() {
    golden("back");
}

#[test]
fn every_picture_of_the_recording_has_its_golden_and_its_test() {
    let Some(pictures) = tour() else { return };
    let mut goldens = names(true);
    goldens.sort();
    assert_eq!(goldens, pictures.keys().map(|name| format!("window-{name}")).collect::<Vec<_>>());
    let tests = include_str!("goldens_window.rs");
    for name in pictures.keys() {
        assert!(tests.contains(&format!("    golden(\"{name}\");\n")), "{name} has no test");
    }
}

#[test]
fn back_at_the_first_view_and_size_the_first_picture_is_shown_again() {
    let Some(pictures) = tour() else { return };
    assert_eq!(pictures["first"], pictures["back"]);
    assert_ne!(pictures["first"], pictures["orbit"]);
}
