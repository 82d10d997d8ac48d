//! `tinta info MODEL`, `tinta compare` and the style inking as a user meets them.

use crate::program::{answer, refused_in_one_line, tinta};
use crate::support::Folder;
use std::path::Path;

#[test]
fn edges_are_counted_by_class() {
    let output = tinta(&["info", "builtin:open-box", "--json"]);
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(record["edges"], 17);
    let classes = &record["classes"];
    for (class, count) in [("boundary", 4), ("crease", 8), ("silhouette", 4), ("non-manifold", 0)] {
        assert_eq!(classes[class], count, "{class}");
    }
    assert_eq!(classes.get("intersection"), None, "they are not looked for");
    assert_eq!(record["model"]["defects"]["degenerate_triangles"], 0);
    assert_eq!(record["crease_cosine"], 0.4);
    let text = String::from_utf8(tinta(&["info", "builtin:open-box", "--crease-angle", "100"]).stdout).unwrap();
    assert!(text.contains("crease                 0"), "{text}");
    refused_in_one_line(&["info", "builtin:open-box", "--crease-angle", "200"], &["--crease-angle 200"]);
    refused_in_one_line(&["info", "no-such.obj"], &["no-such.obj"]);
}

#[test]
fn a_record_of_lines_counts_every_class_by_the_name_that_the_lines_and_the_options_have() {
    let folder = Folder::new();
    // Three pages around one edge that intersect nothing.
    let book = folder.file("book.obj", b"v 0 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 1\nv -1 0 -1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    let (svg, json) = (folder.path("book.svg"), folder.path("book.json"));
    let record = |arguments: &[&str]| -> serde_json::Value {
        let output = tinta(arguments);
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"))
    };
    let drawn = record(&["render", &book, "-o", &svg, "--style", "lines", "--json"]);
    assert_eq!((&drawn["edges"]["intersection"], &drawn["edges"]["non-manifold"]), (&0.into(), &1.into()), "{drawn}");
    let classes = drawn["style"]["classes"].as_array().unwrap();
    assert!(classes.contains(&"non-manifold".into()), "{classes:?}");
    tinta(&["render", &book, "-o", &json]);
    let lines: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert!(lines["segments"].as_array().unwrap().iter().any(|line| line["class"] == "non-manifold"));
    assert_eq!(record(&["info", &book, "--json"])["classes"]["non-manifold"], 1);
}

#[test]
fn a_comparison_is_one_sheet_or_a_folder_of_four_pictures() {
    let folder = Folder::new();
    let sheet = folder.path("both.png");
    let record = answer(&[
        "compare",
        "builtin:gear",
        "-o",
        &sheet,
        "--size",
        "96",
        "--tolerance",
        "1/48",
        "--frames",
        "2",
        "--json",
    ]);
    assert_eq!(
        (&record["left"]["style"]["name"], &record["right"]["style"]["name"]),
        (&serde_json::json!("three-pass"), &serde_json::json!("inking"))
    );
    assert_eq!(record["right"]["frame_ms"]["all"].as_array().map(Vec::len), Some(2));
    let agreement = &record["agreement"];
    assert!(agreement["left_px"].as_u64() > Some(100) && agreement["tolerance_px"] == 2, "{agreement}");
    let picture = tinta::Picture::read(Path::new(&sheet)).unwrap();
    assert!(picture.size.width > 3 * 96 && picture.size.height > 96);
    // A style against itself agrees wholly.
    let pictures = folder.path("pictures/");
    let arguments = ["compare", "builtin:gear", "-o", &pictures, "--size", "64", "--left", "inking", "--json"];
    let record: serde_json::Value = serde_json::from_slice(&tinta(&arguments).stdout).unwrap();
    assert_eq!(record["agreement"]["left_shared"], 1.0);
    let mut names: Vec<String> =
        std::fs::read_dir(&pictures).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["left.png", "lines.png", "right.png", "sheet.png"]);
    refused_in_one_line(&["compare", "builtin:gear", "-o", &sheet, "--left", "phong"], &["phong", "lines"]);
    // A look is drawn as the user draws it, and a style beside it in its view and size: the same lines, exact and by a filter.
    let looks = ["compare", "builtin:gear", "-o", &sheet, "--left", "print", "--frames", "1", "--json"];
    let record = answer(&[&looks[..], &["--right", "technical", "--size", "200"]].concat());
    assert_eq!(
        (&record["agreement"]["left_shared"], &record["right"]["style"]["name"]),
        (&1.0.into(), &"lines".into())
    );
    let record = answer(&[&looks[..], &["--right", "three-pass"]].concat());
    assert_eq!(record["size"], serde_json::json!({ "width": 1280, "height": 960 }));
    assert!(record["agreement"]["left_shared"].as_f64() > Some(0.5), "{record}");
    refused_in_one_line(&["compare", "builtin:gear", "-o", "both.xyz"], &["both.xyz"]);
    refused_in_one_line(&["compare", "builtin:gear", "-o", &sheet, "--no-borders"], &["--no-borders"]);
}

#[test]
fn ink_takes_its_options_and_refuses_what_it_cannot_use() {
    let folder = Folder::new();
    let out = folder.path("ink.png");
    let refuse = |options: &[&str], words: &[&str]| {
        let mut arguments = vec!["render", "builtin:gear", "-o", &out, "--style", "inking"];
        arguments.extend(options);
        refused_in_one_line(&arguments, words);
    };
    refuse(&["--texture", "ramp=no-such.png"], &["no-such.png"]);
    let low = folder.file("low.ppm", b"P6 1 1 255\n\xff\0\0");
    refuse(&["--texture", &format!("ramp={}", low), "--ramp-row", "1"], &["--ramp-row 1", "0 to 0"]);
    refuse(&["--classes", "edges"], &["boundary, non-manifold, silhouette"]);
    refuse(&["--class-colors", "crease"], &["CLASS=COLOR"]);
    refuse(&["--line-width", "0"], &["--line-width 0"]);
    refuse(&["--texture", "on"], &["--texture skin"]);
    let output = tinta(&[
        "render",
        "builtin:gear",
        "-o",
        &out,
        "--style",
        "inking",
        "--size",
        "64",
        "--line-width",
        "9999",
        "--json",
    ]);
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("drawn as quads") && said.lines().count() == 1, "{said}");
    assert!(record["remarks"][0].as_str().is_some_and(|remark| remark.contains("drawn as quads")));
    assert!(record["plan_ms"].as_f64() > Some(0.0));
    assert_eq!(record["style"]["classes"], serde_json::json!(["boundary", "silhouette", "crease", "curve", "point"]));
}

#[test]
fn a_dump_does_not_take_the_pictures_place() {
    let folder = Folder::new();
    let dump = folder.path("steps");
    std::fs::create_dir(&dump).unwrap();
    let render = |name: &str| {
        tinta(&["render", "builtin:ant", "-o", &format!("{dump}/{name}"), "--dump", &dump, "--size", "32"])
    };
    assert!(render("ant.png").status.success());
    let picture = format!("{dump}/01-map-clear.png");
    refused_in_one_line(&["render", "builtin:ant", "-o", &picture, "--dump", &dump], &["01-map-clear.png", "--dump"]);
}

#[test]
fn info_says_the_size_in_the_files_axes_and_names_without_their_commands() {
    let folder = Folder::new();
    let stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 80 0 0\nvertex 0 60 19\nendloop\nendfacet\nendsolid\n";
    let obj = b"o \x1b[2Jleg\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let text =
        |model: &str, more: &[&str]| String::from_utf8(tinta(&[&["info", model], more].concat()).stdout).unwrap();
    let part = folder.file("part.stl", stl.as_bytes());
    for more in [&[][..], &["--up-axis", "z"], &["--up-axis", "y"]] {
        let text = text(&part, more);
        assert!(
            text.starts_with("size            [0, 0, 0] to [80, 60, 19], in the axes of the file"),
            "{more:?}: {text}"
        );
    }
    // A cut, too, is in the file's axes, as of render: up it leaves nothing open below, across it takes the corner away.
    let counted = |plane: &str| answer(&["info", &part, "--section", plane, "--json"])["model"]["triangles"].clone();
    assert_eq!([counted("z=9"), counted("y=30"), counted("z=20")], [2, 2, 1].map(serde_json::Value::from));
    let text = text(&folder.file("leg.obj", obj), &[]);
    assert!(text.contains("parts           \\u{1b}[2Jleg\n") && !text.contains('\u{1b}'), "{text:?}");
}
