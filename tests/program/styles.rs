//! Styles and formats by the command line: drawings, remarks and refusals.

use crate::program::{done, refused_in_one_line, tinta};
use crate::support::Folder;
use crate::support::shapes::cuboid;
use glam::DVec3;
use serde_json::Value;
use tinta::picture::{Difference, write_rgba_png};
use tinta::preset::OptionValue;
use tinta::settings::HasSettings;
use tinta::textures::{ContrastTexture, NoiseTexture, PaperTexture};
use tinta::{Picture, Recipe, Size, Style, Target};

const EQUAL: Difference = Difference { largest: 0, pixels: 0 };

#[test]
fn recipes_are_overruled_by_options_and_nonsense_is_refused_by_name() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let line = |options: &[&str]| {
        let line = ["render", "builtin:gear", "-o", &out, "--size", "32", "--style", "charcoal"];
        [&line[..], options].concat().iter().map(|word| (*word).to_owned()).collect::<Vec<String>>()
    };
    let settings = |options: &[&str]| {
        let line = line(options);
        let output = tinta(&line.iter().map(String::as_str).collect::<Vec<_>>());
        let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        record["style"].clone()
    };
    let closure = settings(&["--json", "--charcoal", "closure", "--grain", "density=50", "--improve", "clamp,wrap"]);
    assert_eq!((closure["name"].as_str(), closure["density"].as_f64()), (Some("charcoal"), Some(50.0)));
    assert_eq!((closure["saturation"].as_f64(), closure["smudge"].as_bool()), (Some(1.4), Some(false)));
    assert_eq!(closure["improve"], serde_json::json!(["clamp", "wrap"]));
    let darker = settings(&["--json", "--charcoal", "darker", "--smudge", "off"]);
    assert_eq!((darker["density"].as_f64(), darker["smudge"].as_bool()), (Some(85.0), Some(false)));
    let refused = |options: &[&str], words: &[&str]| {
        let line = line(options);
        refused_in_one_line(&line.iter().map(String::as_str).collect::<Vec<_>>(), words);
    };
    refused(&["--improve", "polish"], &["--improve", "paper-coordinate"]);
    refused(&["--charcoal", "lighter"], &["--charcoal", "darker", "closure"]);
    refused(&["--light", "light-1=0,0,0"], &["--light light-1"]);
    refused(&["--grain", "texture-size=5000"], &["--grain texture-size=5000x5000", "4096"]);
    refused(&["--texture", "paper=no/such.png"], &["no/such.png"]);
    refused(&["--show", "tones"], &["--show", "diffuse"]);
    for style in ["phong", "three-pass", "two-pass", "mrt", "inking", "dietrich"] {
        let line = ["render", "builtin:gear", "-o", &out, "--style", style, "--show", "cet"];
        refused_in_one_line(&line, &["--show"]);
    }
    refused_in_one_line(&["render", "builtin:gear", "-o", &out, "--style", "sand"], &["style sand", "--texture skin"]);
}

#[test]
fn the_recipes_old_name_is_read_wherever_it_stands_and_no_longer_written() {
    let folder = Folder::new();
    let drawn = |file: &str, options: &[&str]| {
        let line = ["render", "builtin:gear", "-o", file, "--size", "32", "--grain", "texture-size=16"];
        done(&[&line[..], options].concat());
        std::fs::read(file).unwrap()
    };
    let [new, old] = ["plain", "published"].map(|name| {
        let file = folder.path(&format!("{name}.png"));
        drawn(&file, &["--style", "charcoal", "--charcoal", name])
    });
    assert!(new == old, "the same picture with the same recipe");
    let picture = std::path::PathBuf::from(folder.path("published.png"));
    let mut recipe = Recipe::read(&picture).unwrap();
    assert_eq!(recipe.options["charcoal"], OptionValue::text("plain"));
    // A preset of earlier versions.
    let preset = folder.file("old.toml", b"style = \"charcoal\"\ncharcoal = \"published\"\n");
    let saved = folder.path("new.toml");
    assert!(new == drawn(&folder.path("by-preset.png"), &["--preset", &preset, "--save-preset", &saved]));
    assert!(std::fs::read_to_string(saved).unwrap().contains("charcoal = \"plain\""));
    // A picture of earlier versions.
    recipe.options.insert("charcoal".to_owned(), OptionValue::text("published"));
    let pixels = Picture::read_png(&picture).unwrap();
    let (earlier, again) = (folder.path("earlier.png"), folder.path("again.png"));
    Target::check(&earlier, false).unwrap().write_with(&pixels, recipe.note().as_ref()).unwrap();
    done(&["again", &earlier, "-o", &again]);
    assert!(std::fs::read(again).unwrap() == new);
    // A job.
    let job = r#"{"id": 1, "command": "render", "model": "builtin:gear", "output": "a.png", "size": 32,
        "texture-size": 16, "style": "charcoal", "charcoal": "published"}"#;
    let list = folder.file("jobs.jsonl", job.replace('\n', "").as_bytes());
    done(&["batch", &list, "-o", &folder.path("batch")]);
    assert!(std::fs::read(folder.path("batch/a.png")).unwrap() == new);
    let offered = Style::table().settings.iter().filter(|setting| setting.name == "charcoal");
    assert!(offered.flat_map(|setting| setting.kind.offered()).all(|name| name != "published"));
}

#[test]
fn textures_of_ones_own_are_drawn_with_and_those_that_tinta_writes_draw_what_it_draws_without() {
    let folder = Folder::new();
    let size = Size { width: 48, height: 48 };
    let [cet, noise, paper] = ["cet", "noise", "paper"].map(|name| folder.path(&format!("{name}.png")));
    let contrast = ContrastTexture { size, seed: 3, ..ContrastTexture::default() };
    write_rgba_png(&contrast.picture().unwrap(), cet.as_ref()).unwrap();
    let texture = NoiseTexture { size, seed: 3, ..NoiseTexture::default() };
    write_rgba_png(&texture.picture().unwrap(), noise.as_ref()).unwrap();
    let texture = PaperTexture { size, seed: 3, ..PaperTexture::default() };
    write_rgba_png(&texture.picture().unwrap(), paper.as_ref()).unwrap();
    let pixels = |file: &str, options: &[&str]| {
        let out = folder.path(file);
        let line = ["render", "builtin:gear", "-o", &out, "--size", "64", "--style", "charcoal", "--improve", "wrap"];
        done(&[&line[..], options].concat());
        Picture::read_png(out.as_ref()).unwrap()
    };
    let made = pixels("made.png", &["--seed", "3", "--grain", "texture-size=48"]);
    let own = pixels(
        "own.png",
        &[
            "--texture",
            &format!("cet={}", cet),
            "--texture",
            &format!("noise-texture={}", noise),
            "--texture",
            &format!("paper={}", paper),
        ],
    );
    assert_eq!(made.difference(&own), Some(EQUAL));
    let recipe = Recipe::read(folder.path("own.png").as_ref()).unwrap();
    let files: Vec<&str> = recipe.files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(files, [&cet, &noise, &paper]);
    // A grain without grains is the light alone.
    let white = folder.file("white.ppm", b"P6 1 1 255\n\xff\xff\xff");
    let none =
        pixels("none.png", &["--texture", &format!("cet={}", white), "--seed", "3", "--grain", "texture-size=48"]);
    let empty = pixels("empty.png", &["--grain", "density=0", "--seed", "3", "--grain", "texture-size=48"]);
    assert_eq!(none.difference(&empty), Some(EQUAL));
    let line = ["render", "builtin:gear", "-o", &folder.path("a.png"), "--style", "charcoal"];
    for option in ["cet", "noise-texture"] {
        refused_in_one_line(&[&line[..], &["--texture", &format!("{option}=no/such.png")]].concat(), &["no/such.png"]);
    }
}

/// The program's remarks on a drawing, its exit code and its answer as JSON.
fn said(line: &[&str]) -> (String, Option<i32>, Value) {
    let output = tinta(line);
    let json = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (String::from_utf8(output.stderr).unwrap(), output.status.code(), json)
}

#[test]
fn published_styles_name_the_faces_written_twice_and_what_helps() {
    let folder = Folder::new();
    let model = folder.file("a.obj", b"v -1 0 0\nv 1 0 .3\nv 1 1 .3\nv -1 1 0\nf 1 2 3 4\nf 4 3 2 1\n");
    let out = folder.path("a.png");
    let render = |options: &[&str]| said(&[&["render", &model, "-o", &out, "--size", "40x30"][..], options].concat());
    for style in ["three-pass", "two-pass", "mrt", "phong", "inking", "charcoal"] {
        let (remark, code, _) = render(&["--style", style]);
        assert!(remark.contains("a.obj: 2 triangles are written twice") && remark.contains("--cull back"), "{remark}");
        assert_eq!(code, Some(0));
        assert_eq!(render(&["--style", style, "--cull", "back"]).0, "", "{style}");
    }
    let (remark, _, json) = render(&["--json"]);
    assert_eq!((remark.as_str(), &json["model"]["defects"]["doubled_triangles"]), ("", &Value::from(2)));
    let (refusal, code, _) = render(&["--strict"]);
    assert_eq!(code, Some(2));
    assert!(refusal.contains("2 triangles written for both sides"), "{refusal}");
}

#[test]
fn averaged_normals_are_left_out_of_looks_and_named_in_published_styles() {
    let folder = Folder::new();
    let (mut with, mut without) = (String::new(), String::new());
    let cube = cuboid(-DVec3::ONE, DVec3::ONE);
    for position in &cube.positions {
        let DVec3 { x, y, z } = *position;
        without += &format!("v {x} {y} {z}\n");
        with += &format!("v {x} {y} {z}\nvn {x} {y} {z}\n");
    }
    for face in cube.triangles {
        let [a, b, c] = face.map(|corner| corner + 1);
        without += &format!("f {a} {b} {c}\n");
        with += &format!("f {a}//{a} {b}//{b} {c}//{c}\n");
    }
    let models = [folder.file("d.obj", with.as_bytes()), folder.file("clean.obj", without.as_bytes())];
    let render = |model: usize, options: &[&str]| {
        let out = folder.path("picture.ppm");
        let line = ["render", &models[model], "-o", &out, "--no-recipe", "--size", "60x45"];
        let (remark, code, _) = said(&[&line[..], options].concat());
        assert_eq!(code, Some(0), "{remark}");
        (remark, std::fs::read(out).unwrap())
    };
    for look in [&["--look", "print"][..], &["--look", "sketch", "--grain", "texture-size=32"]] {
        let (remark, picture) = render(0, look);
        assert!(remark.contains("d.obj: 36 of the file's 36 normals") && remark.contains("--normals file"), "{remark}");
        let (silence, clean) = render(1, look);
        assert_eq!((silence.as_str(), picture == clean), ("", true), "{look:?}");
        let (remark, forced) = render(0, &[look, &["--normals", "file"]].concat());
        assert!(remark.contains("--normals smooth") && forced != clean, "{remark}");
    }
    let published = ["--style", "three-pass"];
    let (remark, _) = render(0, &published);
    assert!(remark.contains("d.obj: 36 of its normals") && remark.contains("--normals smooth"), "{remark}");
    let smooth = [&published[..], &["--normals", "smooth"]].concat();
    assert_eq!(render(0, &smooth), (String::new(), render(1, &published).1));
    // Lines come from geometry.
    let out = folder.path("d.svg");
    assert_eq!(said(&["render", &models[0], "-o", &out, "--look", "technical"]).0, "");
}

#[test]
fn the_command_line_draws_the_same_file_by_every_way_to_hand_vertices_over() {
    let folder = Folder::new();
    let made = |submission: &str, name: &str, more: &[&str]| {
        let out = folder.path(name);
        let base =
            ["render", "builtin:gear", "-o", &out, "--style", "inking", "--size", "80", "--submission", submission];
        let output = done(&[&base[..], more].concat());
        (std::fs::read(out).unwrap(), String::from_utf8(output.stdout).unwrap())
    };
    let (expected, _) = made("buffers", "a.png", &[]);
    let (bytes, said) = made("immediate", "b.png", &["--json", "--verify"]);
    assert!(bytes == expected);
    let record: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(record["submission"], "immediate");
    let turn = |submission| made(submission, "turn.gif", &["--turntable", "2"]).0;
    assert!(turn("immediate") == turn("buffers"));
    let out = folder.path("c.png");
    for other in ["telegraph", "display-list"] {
        refused_in_one_line(
            &["render", "builtin:gear", "-o", &out, "--submission", other],
            &["--submission", "buffers, immediate"],
        );
    }
}

#[test]
fn the_command_writes_dxf_and_refuses_what_it_lacks() {
    let folder = Folder::new();
    let output = folder.path("gear.dxf");
    let draw = |options: &[&str]| tinta(&[&["render", "builtin:gear", "-o", &output], options].concat());
    let done = draw(&["--page", "A4", "--class-widths", "outline=2x"]);
    assert!(done.status.success() && done.stderr.is_empty(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = std::fs::read_to_string(&output).unwrap();
    assert!(text.contains("8\nvisible-crease\n") && text.contains("8\nvisible-outline\n"), "{text}");
    let lines: Vec<&str> = text.split_once("ENTITIES").unwrap().1.lines().skip(1).collect();
    let corners = lines.chunks(2).filter(|pair| ["10", "20"].contains(&pair[0].trim()));
    let places: Vec<f64> = corners.map(|pair| pair[1].parse().unwrap()).filter(|place| *place != 0.0).collect();
    assert!(places.len() > 100 && places.iter().all(|place| (14.999..282.001).contains(place)), "{places:?}");
    for (option, value) in [("--fit-curves", "0.5"), ("--areas", "face")] {
        refused_in_one_line(&["render", "builtin:gear", "-o", &output, option, value], &[option, "polylines", ".svg"]);
    }
    // What is measured from a file is not left out of it.
    let vertices = |options: &[&str]| {
        assert!(tinta(&[&["render", "builtin:bust", "-o", &output], options].concat()).status.success());
        std::fs::read_to_string(&output).unwrap().matches("\nVERTEX\n").count()
    };
    let all = vertices(&[]);
    assert!(all == vertices(&["--min-length", "0"]) && all > vertices(&["--min-length", "2"]), "{all}");
    // Fills are left out aloud.
    let done = draw(&["--look", "print"]);
    assert!(done.status.success() && String::from_utf8_lossy(&done.stderr).contains("has no fills"));
}
