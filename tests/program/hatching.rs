//! Hatching as a user meets it: options, files, pens.

use crate::program::{refused_in_one_line, silent, tinta};
use crate::support::Folder;
use tinta::request::{OptionLayer, Request, Session};
use tinta::settings::{OptionValue, Options};

/// The ids of an SVG's layers, and how many paths each has.
fn layers(text: &str) -> Vec<(String, usize)> {
    let document = roxmltree::Document::parse(text).unwrap();
    let groups = document.descendants().filter(|node| node.has_tag_name("g"));
    let count = |group: &roxmltree::Node<'_, '_>| group.children().filter(|node| node.has_tag_name("path")).count();
    groups.map(|group| (group.attribute("id").unwrap().to_owned(), count(&group))).collect()
}

fn drawn(folder: &Folder, options: &[&str]) -> String {
    let svg = folder.path("a.svg");
    silent(&[&["render", "builtin:bust", "-o", &svg, "--size", "300"], options].concat());
    std::fs::read_to_string(&svg).unwrap()
}

#[test]
fn every_style_of_tones_is_hatched_below_its_lines() {
    let folder = Folder::new();
    for style in ["three-pass", "two-pass", "mrt", "ink"] {
        let of = |options: &[&str]| layers(&drawn(&folder, &[&["--style", style], options].concat()));
        let painted = of(&[]);
        let hatched = of(&["--hatch", "auto"]);
        let has = |layers: &[(String, usize)], start: &str| layers.iter().any(|(id, _)| id.starts_with(start));
        assert!(!has(&painted, "hatch") && has(&painted, "fill-0"), "{style}");
        let of_strokes: Vec<&str> =
            hatched.iter().map(|(id, _)| id.as_str()).filter(|id| id.starts_with("hatch")).collect();
        assert_eq!(of_strokes, ["hatch-1"], "{style}");
        let ruled = of(&["--hatch", "auto,hatch-angle=30"]);
        let has_both = ["hatch-1", "hatch-0"].iter().all(|layer| has(&ruled, layer));
        assert!(has_both, "{style}: a direction for each tone");
        // A material has one colour.
        assert!(hatched.iter().all(|(id, count)| !id.starts_with("fill") || *count <= 2), "{style}: {hatched:?}");
        let lines = |layers: &[(String, usize)]| -> Vec<(String, usize)> {
            layers.iter().filter(|(id, _)| id.starts_with("visible")).cloned().collect()
        };
        assert!(!lines(&painted).is_empty() && lines(&painted) == lines(&hatched), "{style}");
        let two = of(&["--hatch", "auto", "--tones", "2", "--no-borders"]);
        assert!(has(&two, "hatch-0") && !has(&two, "hatch-1") && !has(&two, "visible"), "{style}");
    }
}

#[test]
fn a_bare_model_is_hatched_on_paper_and_a_coloured_one_on_its_colour() {
    let folder = Folder::new();
    let bare = folder.path("bare.obj");
    std::fs::write(&bare, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").unwrap();
    let svg = folder.path("b.svg");
    let has_fills = |options: &[&str]| {
        silent(&[&["render", &bare, "-o", &svg, "--look", "print", "--size", "300"], options].concat());
        std::fs::read_to_string(&svg).unwrap().contains(r#"id="fill-"#)
    };
    assert!(has_fills(&[]) && !has_fills(&["--hatch", "auto"]) && has_fills(&["--hatch", "auto", "--color", "tan"]));
    assert!(!has_fills(&["--pen"]) && !has_fills(&["--pen", "--hatch", "auto", "--color", "tan"]));
}

#[test]
fn a_sheet_has_strokes_in_millimetres_for_a_pen_of_its_own() {
    let folder = Folder::new();
    let paper = ["--look", "print", "--page", "A4", "--pen", "--class-widths", "hatch=0.25mm"];
    let stroke = |spacing: &str| {
        let text = drawn(&folder, &[&paper[..], &["--hatch", spacing]].concat());
        let count: usize = layers(&text).iter().filter(|(id, _)| id.starts_with("hatch")).map(|(_, count)| count).sum();
        (text, count)
    };
    let [(text, wide), (_, narrow)] = ["2mm", "1mm"].map(stroke);
    assert!(text.contains(r#"width="210mm""#) && !text.contains("background"));
    assert!(narrow as f64 > 1.8 * wide as f64 && (narrow as f64) < 2.2 * wide as f64, "{wide} {narrow}");
    let pens = silent(
        &[
            &["render", "builtin:bust", "-o", &folder.path("pens.svg"), "--hatch", "1mm", "--explain", "--size", "300"],
            &paper[..],
        ]
        .concat(),
    );
    let pens = String::from_utf8(pens).unwrap();
    assert!(pens.contains("hatch-1") && pens.contains("0.25 mm"), "{pens}");
    let pdf = folder.path("a.pdf");
    silent(&[
        "render",
        "builtin:bust",
        "-o",
        &pdf,
        "--look",
        "print",
        "--page",
        "A4",
        "--hatch",
        "auto",
        "--size",
        "300",
    ]);
    let bytes = std::fs::read(&pdf).unwrap();
    assert!(bytes.windows(7).any(|part| part == b"hatch 1"), "a layer of its own");
}

#[test]
fn a_turn_is_hatched_in_every_view() {
    let folder = Folder::new();
    let turn = |name: &str, options: &[&str]| {
        let out = folder.path(name);
        let words = ["render", "builtin:gear", "-o", &out, "--look", "print", "--turntable", "3", "--size", "200"];
        silent(&[&words, options].concat());
        [1, 2, 3].map(|view| std::fs::read(out.replace("%d", &view.to_string())).unwrap())
    };
    let [hatched, painted] = [turn("a-%d.png", &["--hatch", "auto"]), turn("b-%d.png", &[])];
    assert!(hatched.iter().zip(&painted).all(|(one, other)| one != other) && hatched[0] != hatched[1]);
    turn("a.gif", &["--hatch", "auto"]);
}

#[test]
fn a_recipe_keeps_hatching() {
    let folder = Folder::new();
    let text = drawn(&folder, &["--look", "print", "--page", "A4", "--hatch", "1.5mm", "--hatch", "hatch-angle=30"]);
    let again = folder.path("again.svg");
    assert_eq!(tinta(&["again", &folder.path("a.svg"), "-o", &again]).status.code(), Some(0), "the same");
    assert_eq!(std::fs::read_to_string(&again).unwrap(), text);
}

#[test]
fn nonsense_for_strokes_is_refused_by_the_options_name() {
    let folder = Folder::new();
    let refuse = |file: &str, options: &[&str], words: &[&str]| {
        let output = folder.path(file);
        refused_in_one_line(&[&["render", "builtin:ant", "-o", &output], options].concat(), words);
        assert!(!std::path::Path::new(&output).exists());
    };
    for spacing in ["0", "-1", "1e9", "0x", "0%"] {
        refuse("a.svg", &["--look", "print", "--hatch", spacing], &["--hatch", "0.001 to 16384"]);
    }
    for spacing in ["nan", "inf", "-infx"] {
        refuse("a.svg", &["--look", "print", "--hatch", spacing], &["--hatch", "1mm or 6x"]);
    }
    refuse(
        "a.svg",
        &["--look", "print", "--hatch", "0.001"],
        &["--hatch 0.001", "strokes", "at most 1000000", "wider"],
    );
    refuse("a.svg", &["--look", "print", "--hatch", "1mm"], &["--hatch 1mm", "--page A4"]);
    refuse("a.svg", &["--look", "print", "--hatch", "wide"], &["--hatch", "wide", "1mm or 6x"]);
    refuse(
        "a.svg",
        &["--look", "print", "--hatch", "auto", "--hatch", "hatch-angle=nan"],
        &["--hatch hatch-angle=NaN", "-360 to 360"],
    );
    refuse("a.svg", &["--style", "lines", "--hatch", "auto"], &["--hatch", "have no tones", "--look print"]);
    refuse("a.png", &["--look", "technical", "--hatch", "auto"], &["--hatch", "have no tones"]);
    refuse("a.png", &["--look", "sketch", "--hatch", "auto"], &["--hatch", "no tones", "--look print"]);
    refuse("a.png", &["--style", "phong", "--hatch", "auto"], &["--hatch", "tones", "--look print"]);
    refuse("a.png", &["--look", "print", "--hatch", "auto", "--show", "tones"], &["--hatch", "a finished picture"]);
    refuse("a.svg", &["--look", "sketch", "--hatch", "auto"], &["look sketch draws pixels", "--look print"]);
    refuse("a.svg", &["--look", "print", "--hatch", "auto", "--tones", "1"], &["--hatch", "--tones", "2 or 3 tones"]);
}

#[test]
fn a_picture_of_pixels_names_options_that_only_vectors_have() {
    let given: Options = [("style", "ink"), ("class-colors", "hatch=red"), ("size", "64")]
        .map(|(name, value)| (name.to_owned(), OptionValue::text(value)))
        .into();
    let (request, remarks) = Request::from_layers(&[OptionLayer::Given(given)]).unwrap();
    assert!(remarks.is_empty(), "an .svg has it: {remarks:?}");
    let request = request.with_models(vec!["builtin:gear".to_owned()]);
    let picture = request.picture(&mut Session::default(), &Default::default()).unwrap();
    assert!(picture.remarks.iter().any(|remark| remark.starts_with("--class-colors has no effect on style ink")));
    let hatched: Options = [("style", OptionValue::text("ink")), ("hatch", OptionValue::text("auto"))]
        .map(|(name, value)| (name.to_owned(), value))
        .into();
    let (request, _) = Request::from_layers(&[OptionLayer::Given(hatched)]).unwrap();
    let request = request.with_models(vec!["builtin:gear".to_owned()]);
    let hatched = request.picture(&mut Session::default(), &Default::default()).unwrap();
    assert!(hatched.remarks.is_empty() && hatched.picture != picture.picture, "{:?}", hatched.remarks);
}
