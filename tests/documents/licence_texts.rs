//! Every licence that must be passed on is: tinta's own in each package for a registry, those of all crates beside each program.

use crate::support::{root, skip};
use std::collections::BTreeSet;
use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output};

const LICENCES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn every_package_for_a_registry_ships_both_licences() {
    for (package, folder) in [
        ("tinta", "."),
        ("tinta-cli", "crates/tinta-cli"),
        ("tinta-geometry", "crates/tinta-geometry"),
        ("tinta-glsl", "crates/tinta-glsl"),
        ("tinta-lab", "crates/tinta-lab"),
    ] {
        let output = Command::new(env!("CARGO"))
            .args(["package", "--list", "--allow-dirty", "--offline", "--locked", "--package", package])
            .current_dir(root())
            .output()
            .unwrap();
        assert!(output.status.success(), "{package}: {}", said(&output));
        let files = String::from_utf8(output.stdout).unwrap();
        for licence in LICENCES {
            assert!(files.lines().any(|file| file == licence), "{package} has no {licence}: {files}");
            let [own, shipped] = [".", folder].map(|at| std::fs::read(root().join(at).join(licence)).unwrap());
            assert!(own == shipped, "{folder}/{licence} is another text");
        }
    }
}

#[test]
fn the_licences_beside_the_program_are_those_of_all_its_crates_each_with_a_text() {
    let output = Command::new(root().join("scripts/third-party-licences")).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let bar = "=".repeat(80);
    let parts: Vec<&str> = text.split(&format!("\n{bar}\n")).skip(1).collect();
    let mut listed = BTreeSet::new();
    for part in parts.chunks_exact(2) {
        let name = part[0].split(':').next().unwrap();
        assert!(part[1].contains("\n-- ") && part[1].len() > 400, "{name} has no text");
        listed.insert(name.to_owned());
    }
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--package", "tinta-cli", "--edges", "normal", "--prefix", "none"])
        .args(["--no-dedupe", "--format", "{p}"])
        .current_dir(root())
        .output()
        .unwrap();
    let tree = String::from_utf8(tree.stdout).unwrap();
    let words = tree.lines().filter(|line| !line.starts_with("tinta")).map(|line| line.split(' '));
    let needed: BTreeSet<String> = words
        .filter_map(|mut words| Some(format!("{} {}", words.next()?, words.next()?.trim_start_matches('v'))))
        .collect();
    assert_eq!(listed, needed);
    assert!(needed.iter().any(|name| name.starts_with("resvg ")), "the program's own crates too");
}

#[test]
fn the_sbom_lists_the_compiled_crates_alone_and_names_no_path() {
    if Command::new("python3").arg("--version").output().is_err() {
        skip("the SBOM: python3 is not installed");
        return;
    }
    let output = Command::new(root().join("scripts/sbom")).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(!text.contains(&root().display().to_string()) && !text.contains("file://"), "{text}");
    let sbom: serde_json::Value = serde_json::from_str(&text).unwrap();
    let components = sbom["components"].as_array().unwrap();
    let names: BTreeSet<&str> = components.iter().filter_map(|component| component["name"].as_str()).collect();
    assert!(["tinta", "glow", "resvg"].iter().all(|name| names.contains(name)), "{names:?}");
    // Macros run while it is compiled, and tests are no part of it.
    assert!(["serde_derive", "syn", "proptest"].iter().all(|name| !names.contains(name)), "{names:?}");
}

#[test]
fn a_crate_without_a_licence_text_is_refused_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let cargo = folder.path().join("cargo");
    for (licence, is_refused) in [("MIT", true), ("MIT AND Apache-2.0", true), ("MIT OR Apache-2.0", false)] {
        std::fs::write(&cargo, format!("#!/bin/sh\necho 'textless v1.0.0|{licence}'\n")).unwrap();
        std::fs::set_permissions(&cargo, Permissions::from_mode(0o755)).unwrap();
        let home = folder.path().join("registry/src/index/textless-1.0.0");
        std::fs::create_dir_all(&home).unwrap();
        std::fs::write(home.join("Cargo.toml"), "authors = [\"A. Author <a@example.org>\"]\n").unwrap();
        std::fs::write(home.join("LICENSE"), "../LICENSE").unwrap();
        let output = Command::new(root().join("scripts/third-party-licences"))
            .args(["tinta-cli", "any"])
            .env("PATH", format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap()))
            .env("CARGO_HOME", folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.success(), !is_refused, "{licence}: {output:?}");
        if is_refused {
            assert!(said(&output).contains("textless 1.0.0 came without the text"), "{}", said(&output));
        } else {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(text.contains("Apache-2.0, of A. Author") && text.contains("TERMS AND CONDITIONS"), "{text}");
        }
    }
}

#[test]
fn every_script_passes_on_the_licences_of_what_it_packs() {
    let mut count = 0;
    for script in ["package", "python", "release", "web"] {
        let text = std::fs::read_to_string(root().join("scripts").join(script)).unwrap();
        for rest in text.split("scripts/third-party-licences").skip(1) {
            let package = rest.split_whitespace().next().unwrap_or_default();
            // Without a name it is the program.
            let is_product = ["|", "tinta-cli", "tinta-npr", "tinta-web"].contains(&package);
            assert!(is_product, "scripts/{script} passes on the licences of {package}");
            count += 1;
        }
    }
    assert_eq!(count, 4);
}
