//! A freshly installed program runs README's commands.

use crate::support::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A page with a place for a lesson, as `scripts/web` builds it.
const PAGE: &str = "<!-- lesson -->\n<script></script>\n";

/// The program in the folder `bin` of a fresh place.
fn installed(place: &Path) -> PathBuf {
    let program = place.join("bin/tinta");
    std::fs::create_dir_all(place.join("bin")).unwrap();
    let built = env!("CARGO_BIN_EXE_tinta");
    std::fs::hard_link(built, &program).or_else(|_| std::fs::copy(built, &program).map(drop)).unwrap();
    program
}

/// The program's output and files in this folder, without a display.
fn run(program: &Path, words: &str, folder: &Path) -> Output {
    let mut command = Command::new(program);
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command.args(words.split(' ').map(|word| word.trim_matches('\''))).current_dir(folder).output().unwrap()
}

/// README's commands of tinta, without their explanations.
fn commands() -> Vec<String> {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let lines = readme.lines().filter_map(|line| line.strip_prefix("    tinta "));
    lines.map(|line| line.split("  ").next().unwrap().split(" #").next().unwrap().to_owned()).collect()
}

#[test]
fn the_commands_of_the_readme_run_as_typed() {
    let place = tempfile::tempdir().unwrap();
    let program = installed(place.path());
    // As `scripts/web --install` leaves it.
    let share = place.path().join("share/tinta");
    std::fs::create_dir_all(&share).unwrap();
    std::fs::write(share.join("page.html"), PAGE).unwrap();
    let commands = commands();
    assert!(commands.len() >= 9, "{commands:?}");
    for words in commands {
        let output = run(&program, &words, place.path());
        let said = String::from_utf8_lossy(&output.stderr);
        if words.starts_with("view ") {
            // The window needs a display.
            assert!(!cfg!(feature = "window") || said.contains("DISPLAY"), "tinta {words}: {said}");
            continue;
        }
        assert_eq!(output.status.code(), Some(0), "tinta {words}: {said}");
        let list: Vec<&str> = words.split(' ').collect();
        let written = list.iter().position(|word| *word == "-o").map(|at| list[at + 1]);
        let written = written.or_else(|| (list.len() == 1).then_some("bust.png"));
        match written {
            Some(file) => assert!(place.path().join(file).exists(), "tinta {words} wrote no {file}"),
            None => assert!(!output.stdout.is_empty(), "tinta {words} says nothing"),
        }
        if words.starts_with("why ") {
            let explained = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(explained.contains(" is [0, 0, 0, 255]"), "the pixel is black: {explained}");
        }
    }
}

#[test]
fn a_program_without_its_part_for_browsers_says_how_to_get_it() {
    let place = tempfile::tempdir().unwrap();
    let output = run(&installed(place.path()), "page builtin:bust -o bust.html", place.path());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("run scripts/web --install in tinta's repository") && said.lines().count() == 1, "{said}");
}

#[test]
fn the_library_s_page_explains_every_cargo_feature() {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let features = manifest.split_once("\n[features]\n").unwrap().1.split("\n[").next().unwrap();
    let library = std::fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let explained = library.split_once("//! # Cargo features").unwrap().1.split("#![deny").next().unwrap();
    let features = features.lines().filter_map(|line| line.split_once(" = ")).map(|(name, _)| name);
    let features: BTreeSet<&str> = features.filter(|name| *name != "default").collect();
    let rows: BTreeSet<&str> = explained.split("\n//! | `").skip(1).filter_map(|row| row.split('`').next()).collect();
    assert_eq!(rows, features, "the table in src/lib.rs");
    assert!(features.len() > 3, "{features:?}");
}
