//! The promises of this crate to users of it alone: few dependencies, no OpenGL, and an SVG of a model's visible
//! lines.

#[expect(dead_code, reason = "the program's own main is not run here")]
#[path = "../examples/exact_svg.rs"]
mod exact_svg;

use std::collections::BTreeSet;
use std::process::Command;

/// Largest number of resolved crates, without this one; two of them read 3MF.
const MOST_CRATES: usize = 44;

#[test]
fn it_draws_an_svg() {
    let svg = exact_svg::draw(concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/open-box.obj")).unwrap();
    assert!(svg.starts_with("<?xml") && svg.trim_end().ends_with("</svg>"), "{svg}");
    assert!(svg.contains("<path"), "{svg}");
    let missing = exact_svg::draw("nowhere.obj").unwrap_err();
    assert_eq!(missing.to_string(), "nowhere.obj: there is no such file; check the name");
}

#[test]
fn it_needs_few_crates_and_none_that_draws() {
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--offline", "-p", "tinta-geometry", "-e", "normal,build", "--prefix", "none"])
        .args(["--format", "{p}"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let text = String::from_utf8(tree.stdout).unwrap();
    let names: BTreeSet<&str> =
        text.lines().map(|line| line.trim_end_matches(" (*)")).filter(|line| !line.is_empty()).collect();
    assert!(names.iter().any(|name| name.starts_with("tinta-geometry ")), "{text}");
    assert!(names.len() - 1 <= MOST_CRATES, "{} crates: {names:#?}", names.len() - 1);
    let drawing = ["glow", "glutin", "winit", "image", "clap"];
    let found: Vec<&&str> = names.iter().filter(|name| drawing.contains(&name.split(' ').next().unwrap())).collect();
    assert!(found.is_empty(), "{found:?}");
}
