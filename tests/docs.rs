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
        ["render", "again", "view", "compare", "edges", "textures", "figures", "measure", "info"].map(help).concat();
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
