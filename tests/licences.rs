//! Every crate that goes into tinta has a licence its users can live with: what deny.toml allows, checked without cargo deny.

use crate::support::root;
use std::process::Command;

/// The allowed licences, read from deny.toml so that there is one list.
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
        .args(["tree", "--offline", "--locked", "--edges", "normal,build,dev", "--prefix", "none", "--no-dedupe"])
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
        // A crate from the registry is named with its version only, any other with where it comes from.
        let elsewhere = name.contains("(/") || name.contains("://");
        assert!(!elsewhere || name.starts_with("tinta "), "{name} does not come from the registry");
    }
}

#[test]
fn the_licence_check_notices_what_is_not_allowed() {
    let allowed = allowed();
    assert!(is_satisfied("MIT OR GPL-3.0-only", &allowed));
    assert!(!is_satisfied("GPL-3.0-only", &allowed));
    assert!(!is_satisfied("MIT AND GPL-3.0-only", &allowed));
    assert!(!is_satisfied("none", &allowed));
}
