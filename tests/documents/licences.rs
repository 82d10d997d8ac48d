//! The licence of every crate in tinta is acceptable to its users: the list in deny.toml, checked without cargo deny.

use crate::support::root;
use std::process::Command;

/// The allowed licences, read from deny.toml to keep a single list.
fn allowed() -> Vec<String> {
    let text = std::fs::read_to_string(root().join("deny.toml")).unwrap();
    let list = text.split("allow = [").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    list.split(',').map(|name| name.trim().trim_matches('"').to_owned()).filter(|name| !name.is_empty()).collect()
}

/// Whether an SPDX expression without nested parentheses can be satisfied.
fn is_satisfied(expression: &str, allowed: &[String]) -> bool {
    let expression = expression.replace(['(', ')'], "").replace('/', " OR ");
    expression
        .split(" AND ")
        .all(|part| part.split(" OR ").any(|licence| allowed.iter().any(|name| name == licence.trim())))
}

#[test]
fn every_dependency_has_an_allowed_licence_and_comes_from_the_registry() {
    // `cargo tree` looks at this platform's crates only: others need not be downloaded.
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--workspace",
            "--offline",
            "--locked",
            "--edges",
            "normal,build,dev",
            "--prefix",
            "none",
            "--no-dedupe",
        ])
        .args(["--format", "{p}|{l}"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let packages: std::collections::BTreeSet<&str> = text.lines().filter(|line| !line.is_empty()).collect();
    assert!(packages.len() > 50, "{}", packages.len());
    let allowed = allowed();
    for package in packages {
        let (name, licence) = package.split_once('|').unwrap();
        assert!(is_satisfied(licence, &allowed), "{name} has the licence {licence:?}");
        // A crate from the registry is named with its version only, any other with its source.
        let elsewhere = name.contains("(/") || name.contains("://");
        let own = ["tinta ", "tinta-geometry ", "tinta-glsl ", "tinta-cli ", "tinta-lab ", "tinta-npr ", "tinta-web "]
            .iter()
            .any(|own| name.starts_with(own));
        assert!(!elsewhere || own, "{name} does not come from the registry");
    }
}

/// Most crates that may be resolved for the library without its features, those of this workspace not counted.
const MOST_CRATES_OF_THE_LIBRARY: usize = 73;

#[test]
fn the_library_alone_needs_few_crates() {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "-p", "tinta", "--no-default-features", "--edges", "normal,build"])
        .args(["--prefix", "none", "--no-dedupe", "--format", "{p}"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let crates: std::collections::BTreeSet<&str> =
        text.lines().filter(|line| !line.is_empty() && !line.starts_with("tinta")).collect();
    let names: Vec<&str> = crates.iter().filter_map(|name| name.split(' ').next()).collect();
    assert!(names.contains(&"glow") && !names.contains(&"clap") && !names.contains(&"plotters"), "{names:?}");
    assert!(names.len() <= MOST_CRATES_OF_THE_LIBRARY, "{} crates: {names:?}", names.len());
}

#[test]
fn the_licence_check_notices_what_is_not_allowed() {
    let allowed = allowed();
    assert!(is_satisfied("MIT OR GPL-3.0-only", &allowed));
    assert!(!is_satisfied("GPL-3.0-only", &allowed));
    assert!(!is_satisfied("MIT AND GPL-3.0-only", &allowed));
    assert!(!is_satisfied("none", &allowed));
}

#[test]
fn every_crate_that_is_named_has_a_row_in_the_documents() {
    let page = std::fs::read_to_string(root().join("docs/dev/decisions.md")).unwrap();
    let cells: std::collections::BTreeSet<&str> = page
        .lines()
        .filter_map(|line| line.strip_prefix("| "))
        .flat_map(|row| row.split(" |").next().unwrap_or_default().split(", "))
        .collect();
    for (manifest, least) in [
        ("Cargo.toml", 10),
        ("crates/tinta-cli/Cargo.toml", 5),
        ("crates/tinta-geometry/Cargo.toml", 10),
        ("crates/tinta-glsl/Cargo.toml", 1),
        ("crates/tinta-lab/Cargo.toml", 10),
        ("python/Cargo.toml", 3),
    ] {
        let text = std::fs::read_to_string(root().join(manifest)).unwrap();
        let mut is_list = false;
        let mut found = 0;
        for line in text.lines() {
            if line.starts_with('[') {
                is_list = line.ends_with("dependencies]");
            } else if let Some((name, _)) = line.split_once(" = ").filter(|_| is_list) {
                found += 1;
                assert!(
                    name.starts_with("tinta") || cells.contains(name),
                    "docs/dev/decisions.md has no row for {name}"
                );
            }
        }
        assert!(found > least, "{manifest} names {found} crates");
    }
}
