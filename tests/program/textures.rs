//! `tinta textures` as a user meets it.

use crate::program::{done, refused_in_one_line, tinta};
use crate::support::{Folder, names};

#[test]
fn textures_are_written_with_the_texts_figures_and_recorded() {
    let folder = Folder::new();
    let out = folder.path("new/folder");
    let output = done(&["textures", "-o", &out, "--size", "64x32", "--json"]);
    let figures = ["figure-2.png", "figure-3-m-1.3.png", "figure-3-m-15.png", "figure-3-m-5.5.png"];
    assert_eq!(names(&out), [&["cet.png"], &figures[..], &["noise.png", "paper.png", "ramp.png"]].concat());
    for name in names(&out) {
        let size = if name == "ramp.png" { (256, 64) } else { (64, 32) };
        assert_eq!(image::image_dimensions(std::path::Path::new(&out).join(name)).unwrap(), size);
    }
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let textures = record["textures"].as_array().unwrap();
    assert_eq!(textures.len(), 8);
    assert_eq!((&textures[0]["file"], &textures[0]["settings"]["exponent"]), (&"cet.png".into(), &5.5.into()));
    assert!(textures.iter().all(|texture| texture["ms"].as_f64().unwrap() > 0.0));
}

#[test]
fn the_same_seed_gives_the_same_files_and_other_settings_no_figures() {
    let folder = Folder::new();
    let make = |name: &str, seed: &str| {
        let out = folder.path(name);
        let output = tinta(&["textures", "-o", &out, "--size", "64", "--seed", seed, "--density", "40"]);
        assert!(output.status.success() && output.stdout.is_empty() && output.stderr.is_empty());
        assert_eq!(names(&out), ["cet.png", "noise.png", "paper.png", "ramp.png"]);
        // The ramp has no seed.
        names(&out)[..3].iter().map(|name| std::fs::read(format!("{out}/{name}")).unwrap()).collect::<Vec<_>>()
    };
    let first = make("a", "5");
    assert_eq!(first, make("b", "5"));
    assert!(first.iter().zip(make("c", "6")).all(|(a, b)| *a != b));
}

#[test]
fn the_ramp_written_and_given_back_paints_the_same_picture() {
    let folder = Folder::new();
    let out = folder.path("textures");
    assert!(tinta(&["textures", "-o", &out, "--size", "16"]).status.success());
    let paint = |name: &str, options: &[&str]| {
        let picture = folder.path(name);
        let mut arguments = vec!["render", "builtin:ant", "-o", &picture, "--size", "64", "--style", "inking"];
        // The recipe names the ramp; with it the files would differ.
        arguments.push("--no-recipe");
        arguments.extend(options);
        assert!(tinta(&arguments).status.success());
        std::fs::read(&picture).unwrap()
    };
    assert_eq!(paint("built-in.png", &[]), paint("given.png", &["--ramp", &format!("{out}/ramp.png")]));
}

#[test]
fn nonsensical_textures_are_refused_by_name_and_leave_nothing() {
    let folder = Folder::new();
    let out = folder.path("out");
    let refused = |option: &str, value: &str, words: &[&str]| {
        refused_in_one_line(&["textures", "-o", &out, option, value], words);
    };
    refused("--density", "101", &["--density 101", "from 0 to 100"]);
    refused("--density", "nan", &["--density NaN"]);
    refused("--cet-exponent", "0.5", &["--cet-exponent 0.5", "at least 1"]);
    refused("--cet-blur", "-1", &["--cet-blur -1"]);
    refused("--size", "5000x10", &["--size 5000x10", "4096"]);
    refused("--size", "0", &["--size"]);
    refused("--seed", "-1", &["--seed"]);
    assert!(!std::path::Path::new(&out).exists());
    let file = folder.file("file", b"");
    refused_in_one_line(&["textures", "-o", &file], &["-o ", "this is a file; name a folder"]);
    refused_in_one_line(&["textures"], &["--output"]);
}
