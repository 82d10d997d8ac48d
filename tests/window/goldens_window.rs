//! The goldens of the window: its picture after the events of a recording. One run of a recording draws all of its pictures, one
//! test compares each. `tour.jsonl` sets the sizes of its panes, `sizes.jsonl` uses windows of several sizes.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens_window::split` draws that one anew and then fails.

use crate::support::goldens::{Goldens, compare, how_to_update, names};
use crate::support::root;
use crate::window::Display;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use tinta::{Picture, Size};

/// The recording's pictures by name; `None`, with a message, where no window can be opened.
fn tour() -> Option<&'static BTreeMap<String, Picture>> {
    static PICTURES: OnceLock<Option<BTreeMap<String, Picture>>> = OnceLock::new();
    PICTURES.get_or_init(replay).as_ref()
}

fn replay() -> Option<BTreeMap<String, Picture>> {
    let display = Display::start()?;
    Some(played(&display, "tour", 1, &["builtin:bust", "--look", "published"]))
}

/// Windows by name, their size in points, and how many pixels make one.
const WINDOWS: [(&str, &str, u32); 3] =
    [("1280x720", "1280x720", 1), ("640x480", "640x480", 1), ("double", "640x480", 2)];

/// The line below the panes, points: it shows the pictures' times.
const STATUS_HEIGHT: u32 = 24;

/// The pictures of the other recording by window and name.
fn sizes() -> Option<&'static BTreeMap<String, Picture>> {
    static PICTURES: OnceLock<Option<BTreeMap<String, Picture>>> = OnceLock::new();
    let play = || {
        let display = Display::start()?;
        let mut all = BTreeMap::new();
        for (window, size, scale) in WINDOWS {
            let pictures = played(&display, "sizes", scale, &["builtin:gear", "--look", "published", "--window", size]);
            let named =
                |(name, picture): (String, Picture)| (format!("{window}-{name}"), without_status(picture, scale));
            all.extend(pictures.into_iter().map(named));
        }
        Some(all)
    };
    PICTURES.get_or_init(play).as_ref()
}

/// A window's picture without the parts that differ from run to run.
fn without_status(picture: Picture, scale: u32) -> Picture {
    let size = Size { width: picture.size.width, height: picture.size.height - STATUS_HEIGHT * scale };
    Picture { size, pixels: picture.pixels[..size.pixel_count() * 4].to_vec() }
}

/// Plays a recording; its pictures by name.
fn played(display: &Display, recording: &str, scale: u32, arguments: &[&str]) -> BTreeMap<String, Picture> {
    let folder = tempfile::tempdir().unwrap();
    let recording = std::fs::read_to_string(root().join(format!("tests/recordings/{recording}.jsonl"))).unwrap();
    let file = folder.path().join("recording.jsonl");
    std::fs::write(&file, recording.replace("OUT/", &format!("{}/", folder.path().display()))).unwrap();
    let output = display.view_at(scale, &[arguments, &["--replay", file.to_str().unwrap(), "--json"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(record["first_picture_ms"].as_f64().unwrap() > 0.0);
    assert_eq!(record["scale"].as_f64(), Some(f64::from(scale)));
    let pictures = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path());
    let pictures = pictures.filter(|path| path.extension().is_some_and(|extension| extension == "png"));
    let named = |path: std::path::PathBuf| {
        (path.file_stem().unwrap().to_str().unwrap().to_owned(), Picture::read_png(&path).unwrap())
    };
    let pictures: BTreeMap<String, Picture> = pictures.map(named).collect();
    assert_eq!(pictures.len(), recording.matches("OUT/").count(), "one for each in the recording");
    pictures
}

fn golden(name: &str) {
    compare_with(tour(), name);
}

fn golden_of_sizes(name: &str) {
    compare_with(sizes(), name);
}

fn compare_with(pictures: Option<&BTreeMap<String, Picture>>, name: &str) {
    let Some(pictures) = pictures else { return };
    let how = how_to_update(&format!("goldens_window::{}", test_of(name)));
    compare(&format!("window-{name}"), &pictures[name], "the window")
        .unwrap_or_else(|failure| panic!("{failure}\n{how}"));
}

/// The test that compares a picture: a name begins with a letter.
fn test_of(name: &str) -> String {
    let name = name.replace('-', "_");
    if name.starts_with(|first: char| first.is_ascii_digit()) { format!("window_{name}") } else { name }
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
fn window_1280x720_panel() {
    golden_of_sizes("1280x720-panel");
}

#[test]
fn window_1280x720_keys() {
    golden_of_sizes("1280x720-keys");
}

#[test]
fn window_640x480_panel() {
    golden_of_sizes("640x480-panel");
}

#[test]
fn window_640x480_keys() {
    golden_of_sizes("640x480-keys");
}

#[test]
fn double_panel() {
    golden_of_sizes("double-panel");
}

#[test]
fn double_keys() {
    golden_of_sizes("double-keys");
}

#[test]
fn window_1280x720_why() {
    golden_of_sizes("1280x720-why");
}

#[test]
fn window_640x480_why() {
    golden_of_sizes("640x480-why");
}

#[test]
fn double_why() {
    golden_of_sizes("double-why");
}

#[test]
fn every_picture_of_the_recordings_has_its_golden_and_its_test() {
    let Some((tour, sizes)) = tour().zip(sizes()) else { return };
    let mut goldens = names(Goldens::Window);
    goldens.sort();
    let mut pictures: Vec<String> = tour.keys().chain(sizes.keys()).map(|name| format!("window-{name}")).collect();
    pictures.sort();
    assert_eq!(goldens, pictures);
    let tests = include_str!("goldens_window.rs");
    for (call, names) in [("golden", tour), ("golden_of_sizes", sizes)] {
        for name in names.keys() {
            let test = format!("fn {}() {{\n    {call}(\"{name}\");\n", test_of(name));
            assert!(tests.contains(&test), "{name} has no test");
        }
    }
}

#[test]
fn back_at_the_first_view_and_size_the_first_picture_is_shown_again() {
    let Some(pictures) = tour() else { return };
    assert_eq!(pictures["first"], pictures["back"]);
    assert_ne!(pictures["first"], pictures["orbit"]);
}
