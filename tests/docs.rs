//! What the documents name exists: files, folders, options of the program.

use crate::support::root;
use std::path::PathBuf;
use std::process::Command;

fn documents() -> Vec<(PathBuf, String)> {
    let mut paths = vec![root().join("README.md"), root().join("CHANGELOG.md"), root().join("models/SOURCES.md")];
    paths.extend(std::fs::read_dir(root().join("docs")).unwrap().map(|file| file.unwrap().path()));
    paths
        .into_iter()
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .map(|path| (path.clone(), std::fs::read_to_string(&path).unwrap()))
        .collect()
}

/// The words of a document that stand in backquotes and begin like a path of this project.
fn quoted_paths(text: &str) -> Vec<&str> {
    const FOLDERS: [&str; 14] = [
        "src/",
        "glsl/",
        "models/",
        "presets/",
        "tests/",
        "docs/",
        "scripts/",
        "benches/",
        "evangelista/",
        "improved/",
        "phong/",
        "dachsbacher/",
        "dietrich/",
        "valente/",
    ];
    text.split('`')
        .skip(1)
        .step_by(2)
        .filter(|word| FOLDERS.iter().any(|folder| word.starts_with(folder)) && !word.contains([' ', '*', '…', '\n']))
        .collect()
}

/// The targets of a document's links and pictures that are files of this project.
fn link_targets(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains("://")).collect()
}

#[test]
fn every_path_named_in_the_documents_exists() {
    let mut checked = 0;
    for (document, text) in documents() {
        let folder = document.parent().unwrap();
        for path in quoted_paths(&text) {
            let found = [root().join(path), root().join("glsl").join(path)].iter().any(|path| path.exists());
            assert!(found, "{} names {path}, which is not there", document.display());
            checked += 1;
        }
        for target in link_targets(&text) {
            assert!(folder.join(target).exists(), "{} links to {target}, which is not there", document.display());
            checked += 1;
        }
    }
    assert!(checked > 60, "only {checked} paths were found to check");
}

#[test]
fn every_option_named_in_the_documents_exists() {
    let help = |command: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_tinta")).args([command, "--help"]).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let known: String =
        ["render", "again", "view", "compare", "edges", "textures", "figures", "measure", "info", "batch"]
            .map(help)
            .concat();
    for (document, text) in documents() {
        for line in text.lines().filter(|line| line.contains("tinta ")) {
            for option in line.split([' ', '`']).filter(|word| word.starts_with("--") && word.len() > 2) {
                let option = option.trim_end_matches([',', '.', ';', ':', ')']);
                let named = option.split('=').next().unwrap_or(option);
                assert!(known.contains(named) || named == "--help", "{}: {named} in {line:?}", document.display());
            }
        }
    }
}

#[test]
fn the_limits_are_documented_as_they_are() {
    use tinta::limits::*;
    let limits = [
        ("MEMORY_FACTOR", MEMORY_FACTOR as u64),
        ("MEMORY_SLACK_BYTES", MEMORY_SLACK_BYTES as u64),
        ("MODEL_BYTES", MODEL_BYTES),
        ("MATERIAL_FILE_BYTES", MATERIAL_FILE_BYTES),
        ("PICTURE_FILE_BYTES", PICTURE_FILE_BYTES),
        ("ROWS_BYTES", ROWS_BYTES),
        ("BATCH_BYTES", BATCH_BYTES),
        ("JOB_BYTES", JOB_BYTES as u64),
        ("JOB_ID_BYTES", JOB_ID_BYTES as u64),
        ("PICTURE_SIDE_PX", u64::from(PICTURE_SIDE_PX)),
        ("PICTURE_BYTES", PICTURE_BYTES),
        ("MODEL_PICTURES_BYTES", MODEL_PICTURES_BYTES),
        ("PIXELS_A_BYTE", PIXELS_A_BYTE),
        ("TRIANGLES", TRIANGLES as u64),
        ("CONCAVE_CORNERS", CONCAVE_CORNERS as u64),
        ("CROSSING_CORNERS", CROSSING_CORNERS as u64),
        ("PLY_HEADER_BYTES", PLY_HEADER_BYTES as u64),
        ("STL_LINE_BYTES", STL_LINE_BYTES as u64),
        ("MATERIALS", MATERIALS as u64),
        ("MATERIAL_FILES", MATERIAL_FILES as u64),
        ("SKINS", SKINS as u64),
        ("REMARKS", REMARKS as u64),
        ("SHOWN_CHARACTERS", SHOWN_CHARACTERS as u64),
    ];
    let source = std::fs::read_to_string(root().join("src/limits.rs")).unwrap();
    assert_eq!(source.matches("pub const ").count(), limits.len(), "a limit that this test does not know");
    let document = std::fs::read_to_string(root().join("docs/limits.md")).unwrap();
    for (name, value) in limits {
        // | `NAME` | 64 MiB | why |
        let row = document.lines().find_map(|line| line.strip_prefix(&format!("| `{name}` | "))).expect(name);
        let cell = row.split(" |").next().unwrap();
        let (number, unit) = cell.split_once(' ').unwrap_or((cell, ""));
        let number: u64 = number.replace(',', "").parse().expect(row);
        let documented = match unit {
            "GiB" => number << 30,
            "MiB" => number << 20,
            "KiB" => number << 10,
            _ => number,
        };
        assert_eq!(documented, value, "{name}: {row}");
    }
}
