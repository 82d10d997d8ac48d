//! `tinta render` into .svg and .json as a user meets it.

use crate::program::{answer, done, refused_in_one_line, silent, tinta};
use crate::support::Folder;
use crate::support::growth::FAMILIES;
use std::path::Path;

#[test]
fn a_drawing_is_written_as_svg_with_the_command_that_made_it() {
    let folder = Folder::new();
    let out = folder.path("gear <&>.svg");
    let options = ["--style", "lines", "--size", "96x64", "--hidden", "dashed"];
    assert!(silent(&[&["render", "builtin:gear", "-o", &out][..], &options].concat()).is_empty());
    let text = std::fs::read_to_string(&out).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("viewBox"), Some("0 0 96 64"));
    let said = document.descendants().find(|node| node.tag_name().name() == "description").unwrap();
    assert_eq!(
        said.text(),
        Some("tinta render builtin:gear -o drawing.svg --hidden dashed --size 96x64 --style lines")
    );
    let again = folder.path("again.svg");
    silent(&[&["render", "builtin:gear", "-o", &again][..], &options].concat());
    assert_eq!(std::fs::read_to_string(&again).unwrap(), text);
    let piped = silent(&["render", "builtin:gear", "-o", "-", "--style", "lines", "--size", "96x64"]);
    assert!(piped.starts_with(b"<?xml") && piped.ends_with(b"</svg>\n"));
}

#[test]
fn lines_are_written_as_json_and_their_record_is_printed() {
    let folder = Folder::new();
    let out = folder.path("lines.json");
    let record = answer(&["render", "builtin:open-box", "-o", &out, "--json", "--classes", "all"]);
    assert_eq!(record["style"]["name"], "lines");
    assert_eq!(record["style"]["classes"].as_array().map(Vec::len), Some(19));
    assert_eq!(record["model"]["path"], "builtin:open-box");
    for time in ["load_ms", "topology_ms", "silhouette_ms", "visibility_ms", "lines_ms"] {
        assert!(record[time].is_f64(), "{time}");
    }
    let counts = &record["counts"];
    for count in ["visible_segments", "hidden_segments", "visible_paths", "hidden_paths"] {
        assert!(counts[count].is_u64(), "{count}");
    }
    let lines: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
    assert_eq!(lines["size"]["width"], 512);
    assert_eq!(lines["camera"], record["camera"]);
    let segments = lines["segments"].as_array().unwrap().len() as u64;
    let counted = |name: &str| counts[name].as_u64().unwrap();
    assert_eq!(segments, counted("visible_segments") + counted("hidden_segments"));
    let record = answer(&["render", "builtin:open-box", "-o", &folder.path("a.svg"), "--json", "--hidden", "ghost"]);
    assert_eq!((&record["style"]["name"], &record["exact_lines"]["name"]), (&"ink".into(), &"lines".into()));
    let lines = &record["exact_lines"];
    assert_eq!((&lines["hidden"], &lines["line-width"]), (&"ghost".into(), &"0.2%/0.35mm".into()));
    assert_eq!(lines["classes"].as_array().map(Vec::len), Some(9));
}

/// The JSON file of a drawing with these options.
fn json(folder: &Folder, options: &[&str]) -> serde_json::Value {
    let out = folder.path("areas.json");
    // The look print tells that it leaves out the soldier's texture.
    let output =
        tinta(&[&["render", "builtin:soldier", "builtin:open-box", "-o", &out, "--size", "96x64"], options].concat());
    assert_eq!(output.status.code(), Some(0), "{options:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap()
}

#[test]
fn a_look_of_lines_is_written_into_every_format_of_lines() {
    let folder = Folder::new();
    for name in ["a.svg", "a.pdf", "a.dxf", "a.json", "a.png"] {
        let out = folder.path(name);
        silent(&["render", "builtin:gear", "-o", &out, "--look", "technical"]);
    }
    let drawing = json(&folder, &["--look", "technical"]);
    assert_eq!(drawing["camera"]["fov_y_degrees"], serde_json::Value::Null, "the look's parallel projection");
}

#[test]
fn areas_are_written_as_json_and_fill_the_picture() {
    let folder = Folder::new();
    let alone = json(&folder, &["--style", "lines"]);
    assert!(alone.get("regions").is_none() && alone.get("objects").is_none());
    let cases: [(&[&str], &[&str]); 5] = [
        (&["--areas", "face"], &["object", "material", "face", "area_px", "loops"]),
        (&["--areas", "material"], &["object", "material", "area_px", "loops"]),
        (&["--areas", "object"], &["object", "area_px", "loops"]),
        (&["--areas", "object", "--no-borders"], &["object", "area_px", "loops"]),
        (&["--look", "print"], &["object", "material", "tone", "area_px", "loops"]),
    ];
    for (options, keys) in cases {
        let drawing = json(&folder, options);
        let regions = drawing["regions"].as_array().unwrap();
        let area: f64 = regions.iter().map(|region| region["area_px"].as_f64().unwrap()).sum();
        assert!((area - 96.0 * 64.0).abs() < 1e-9 * area, "{options:?}: {area}");
        let names: Vec<_> = drawing["objects"].as_array().unwrap().iter().map(|object| &object["name"]).collect();
        assert_eq!(names, ["builtin:soldier", "builtin:open-box"]);
        // The background has no more than its place, and the box no materials.
        let all: std::collections::BTreeSet<_> =
            regions.iter().flat_map(|region| region.as_object().unwrap().keys().map(String::as_str)).collect();
        assert_eq!(all, keys.iter().copied().collect(), "{options:?}");
        assert_eq!(drawing["segments"].as_array().unwrap().is_empty(), options.contains(&"--no-borders"));
        for region in regions {
            let object = region["object"].as_u64();
            assert!(object.is_none_or(|object| object < 2) && !region["loops"].as_array().unwrap().is_empty());
        }
        assert_eq!(drawing["size"], alone["size"]);
        // A look has a camera of its own.
        assert_eq!(drawing["camera"] == alone["camera"], !options.contains(&"--look"), "{options:?}");
    }
}

#[test]
fn areas_are_written_as_paths_of_their_objects() {
    let folder = Folder::new();
    let out = folder.path("areas.svg");
    let drawn = |options: &[&str]| {
        silent(&[&["render", "builtin:open-box", "builtin:gear", "-o", &out], options].concat());
        std::fs::read_to_string(&out).unwrap()
    };
    let text = drawn(&["--areas", "object", "--no-borders"]);
    let document = roxmltree::Document::parse(&text).unwrap();
    let groups: Vec<_> = document.root_element().children().filter(|node| node.has_tag_name("g")).collect();
    let ids: Vec<_> = groups.iter().filter_map(|group| group.attribute("id")).collect();
    assert_eq!(ids, ["fill-0", "fill-1"]);
    for group in groups {
        assert_eq!(group.attribute("shape-rendering"), Some("crispEdges"));
        assert!(group.children().filter(|node| node.is_element()).all(|path| path.attribute("fill") != Some("none")));
    }
    let text = drawn(&["--areas", "face"]);
    assert!(text.contains(r#"data-face="0""#) && text.contains("visible-crease") && !text.contains("crispEdges"));
    assert!(text.contains(r#"<g id="fill-seams""#) && text.find("fill-seams") < text.find("fill-0"));
    let pdf = folder.path("areas.pdf");
    silent(&["render", "builtin:gear", "-o", &pdf, "--areas", "material", "--page", "A4"]);
    assert!(std::fs::read(&pdf).unwrap().starts_with(b"%PDF"));
}

#[test]
fn the_hidden_lines_that_are_drawn_are_counted_and_the_others_marked() {
    let folder = Folder::new();
    let cube = folder.path("cube.obj");
    let corners = (0..8).map(|k| format!("v {} {} {}\n", k & 1, k >> 1 & 1, k >> 2)).collect::<String>();
    let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    std::fs::write(&cube, corners + faces).unwrap();
    let svg = folder.path("a.svg");
    let hidden_paths = |options: &[&str]| {
        let all = [&["render", &cube, "-o", &svg, "--parallel", "--json"], options].concat();
        let record: serde_json::Value = serde_json::from_slice(&silent(&all)).unwrap();
        record["counts"]["hidden_paths"].as_u64().unwrap()
    };
    assert_eq!(hidden_paths(&["--hidden", "dashed", "--view", "front"]), 0, "under the visible ones");
    assert_eq!(hidden_paths(&["--view", "30,15"]), 0, "not drawn");
    assert_eq!(hidden_paths(&["--hidden", "dashed", "--view", "30,15"]), 2, "three edges at one corner");
    let out = folder.path("a.json");
    silent(&["render", &cube, "-o", &out, "--style", "lines", "--parallel", "--view", "front"]);
    let lines: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
    let pieces = lines["segments"].as_array().unwrap();
    assert_eq!(pieces.len(), 8);
    assert!(pieces.iter().all(|piece| piece["covered"].as_bool().unwrap() != piece["visible"].as_bool().unwrap()));
}

#[test]
fn styles_and_files_that_do_not_fit_are_refused() {
    let folder = Folder::new();
    let [svg, png, json] = ["a.svg", "a.png", "a.json"].map(|name| folder.path(name));
    let refuse = |output: &str, options: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:ant", "-o", output], options].concat(), words);
    };
    refuse("turn.gif", &["--style", "lines"], &["style lines writes .svg, .pdf, ", " or a still picture"]);
    refuse(&png, &["--style", "lines", "--page", "A4"], &["--page", "no paper"]);
    refuse("a.jpg", &["--style", "lines", "--background", "transparent"], &["a.jpg", "no transparency"]);
    refuse(&svg, &["--style", "phong"], &["a.svg: style phong draws pixels", ".png"]);
    refuse(&svg, &["--style", "cubism"], &["phong, three-pass", "back-faces, lines"]);
    refuse("-", &["--style", "lines", "--json"], &["-o -", "name a file"]);
    refuse("no/such/a.svg", &[], &["no/such/a.svg: the folder no/such does not exist"]);
    for options in [&["--dump", "steps"][..], &["--frames", "3"], &["--animate"], &["--show", "borders"]] {
        refuse(&svg, options, &[options[0], "vectors"]);
    }
    refuse(&folder.path("a-%d.svg"), &["--explain", "--turntable", "2"], &["--explain", "--turntable"]);
    refuse(&svg, &["--no-borders", "--style", "lines"], &["--no-borders", "leave it out"]);
    refuse(&svg, &["--silhouette", "paper"], &["--silhouette paper", "exactly"]);
    refuse(&png, &["--pen"], &["--pen", "a picture of pixels cannot have it"]);
    for options in [&["--hidden", "ghost"][..], &["--class-widths", "crease=1"], &["--pen"]] {
        refuse(&png, &[options, &["--style", "phong"]].concat(), &[options[0], "leave it out"]);
        refuse(&json, options, &[options[0], ".json", ".svg"]);
    }
    assert!(!std::path::Path::new(&svg).exists());
}

#[test]
fn nonsense_for_lines_is_refused_by_the_options_name() {
    let folder = Folder::new();
    let svg = folder.path("a.svg");
    let refuse = |options: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:ant", "-o", &svg], options].concat(), words);
    };
    refuse(&["--page", "width-mm=100", "--page", "dpi=96"], &["--page width-mm", "--page dpi"]);
    refuse(&["--page", "width-mm=-3"], &["--page width-mm=-3", "millimetres"]);
    refuse(&["--page", "dpi=NaN"], &["--page dpi=NaN", "96"]);
    refuse(&["--line-width", "0"], &["--line-width 0"]);
    refuse(&["--class-widths", "crease=-1"], &["--class-widths crease=-1"]);
    refuse(&["--class-widths", "crease"], &["--class-widths", "CLASS=PIXELS"]);
    refuse(&["--hidden", "dotted"], &["--hidden", "none, dashed, ghost"]);
    refuse(&["--classes", "outline"], &["--classes", "curve, point, centre, or all"]);
    refuse(&["--crease-angle", "200"], &["--crease-angle 200"]);
    refuse(&["--line-width", "2x"], &["--line-width 2x", "--class-widths"]);
    refuse(&["--min-length", "2x"], &["--min-length 2x", "--class-widths"]);
    refuse(&["--class-widths", "outlines=3"], &["--class-widths", "did you mean outline?"]);
    refuse(&["--class-widths", "sketch=3"], &["--class-widths", "outline, hatch, hidden, or hidden-"]);
    refuse(&["--line-width", "0.5mm"], &["--line-width 0.5mm", "no size on paper", "--page A4"]);
    refuse(&["--min-length", "1mm"], &["--min-length 1mm", "--page A4"]);
    refuse(&["--min-length", "-1"], &["--min-length -1", "0 or more"]);
    refuse(&["--page", "A9"], &["--page", "A3, A4, A5 or letter"]);
    refuse(&["--page", "A4", "--page", "width-mm=90"], &["--page", "--page width-mm"]);
    refuse(&["--page", "A4", "--page", "margin=105"], &["--page margin=105mm", "105 millimetres"]);
    refuse(&["--page", "margin=10mm"], &["--page margin", "--page A4"]);
    refuse(&["--fit-curves", "0"], &["--fit-curves 0", "0.01 to 100"]);
    refuse(&["--silhouette", "round"], &["--silhouette", "exact, smooth"]);
}

/// Each layer's name and stroke width in pixels, and how many pixels a millimetre has.
fn layer_widths(file: &str) -> (Vec<(String, f64)>, f64) {
    let text = std::fs::read_to_string(file).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    let number = |text: &str| text.trim_end_matches("mm").parse::<f64>().unwrap();
    let box_px: Vec<f64> = root.attribute("viewBox").unwrap().split(' ').map(number).collect();
    let layers = root.children().filter(|node| node.has_tag_name("g"));
    let widths = layers.map(|layer| {
        let width = number(layer.attribute("stroke-width").unwrap());
        (layer.attribute("id").unwrap().to_owned(), width)
    });
    (widths.collect(), box_px[2] / number(root.attribute("width").unwrap()))
}

#[test]
fn the_look_technical_has_one_ratio_of_widths_for_paper_pictures_and_pens() {
    let folder = Folder::new();
    let out = folder.path("gear.svg");
    let draw = |options: &[&str]| {
        let look = ["render", "builtin:gear", "-o", &out, "--look", "technical", "--hidden", "dashed"];
        silent(&[&look, options].concat());
        layer_widths(&out)
    };
    for (options, outline_mm) in [
        (&["--page", "A4"][..], 0.7),
        (&["--page", "A3", "--line-width", "0.25mm"], 0.5),
        (&["--page", "A5", "--pen"], 0.7),
        (&["--page", "width-mm=90", "--pen", "--line-width", "0.25mm"], 0.5),
    ] {
        let (layers, px_per_mm) = draw(options);
        let names: Vec<&str> = layers.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names.last(), Some(&"visible-outline"), "{options:?}");
        assert!(names.contains(&"visible-crease") && names.contains(&"hidden-crease"), "{options:?} {names:?}");
        for (name, width) in &layers {
            let expected = if name == "visible-outline" { outline_mm } else { outline_mm / 2.0 };
            assert!((width / px_per_mm - expected).abs() < 1e-3, "{options:?} {name}: {width} of {px_per_mm}");
        }
    }
    let (layers, _) = draw(&["--line-width", "3"]);
    assert!(
        layers.iter().all(|(name, width)| *width == if name == "visible-outline" { 6.0 } else { 3.0 }),
        "{layers:?}"
    );
}

#[test]
fn what_pens_a_drawing_needs_is_explained() {
    let folder = Folder::new();
    let out = folder.path("gear.svg");
    let explain = |options: &[&str]| {
        let all = [&["render", "builtin:gear", "-o", &out, "--explain", "--pen"], options].concat();
        String::from_utf8(silent(&all)).unwrap()
    };
    let said = explain(&["--look", "technical", "--page", "A4"]);
    let pens = said.split("pen, layer").nth(1).unwrap();
    let words: Vec<Vec<&str>> = pens.lines().skip(1).map(|line| line.split_whitespace().collect()).collect();
    assert_eq!((&words[0][..], words[1][0]), (&["pen", "1", "0.35", "mm"][..], "visible-crease"), "{pens}");
    let last = &words[words.len() - 2..];
    assert_eq!((&last[0][..], last[1][0]), (&["pen", "2", "0.70", "mm"][..], "visible-outline"), "{pens}");
    assert!(explain(&["--style", "lines", "--class-colors", "crease=red"]).contains("pen 2"), "a colour is a pen");
    assert!(!explain(&["--style", "lines"]).contains("pen 2"));
}

#[test]
fn inking_has_no_intersections() {
    let folder = Folder::new();
    let out = folder.path("a.png");
    let ink = ["render", "builtin:ant", "-o", &out, "--style", "inking", "--size", "32", "--classes"];
    refused_in_one_line(&[&ink[..], &["intersection"]].concat(), &["--classes intersection", "only style lines"]);
    silent(&[&ink[..], &["all"]].concat());
}

#[test]
fn lines_and_sheets_open_no_gl_library_in_any_format() {
    let folder = Folder::new();
    let traces = folder.path("trace");
    // glibc's loader names each library that it opens, in a file for each process.
    let libraries = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_tinta"))
            .args(arguments)
            .args(["--size", "128"])
            .envs([("LD_DEBUG", "files"), ("LD_DEBUG_OUTPUT", &traces)])
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        let files = std::fs::read_dir(Path::new(&traces).parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
        let traces: Vec<_> =
            files.filter(|file| file.file_name().unwrap().to_str().unwrap().starts_with("trace.")).collect();
        let text: String = traces.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect();
        traces.iter().for_each(|file| std::fs::remove_file(file).unwrap());
        text
    };
    let is_gl = |text: &str| ["libEGL", "libGL", "libOSMesa", "libgallium"].iter().any(|name| text.contains(name));
    let has_loader = cfg!(all(target_os = "linux", target_env = "gnu"));
    for format in ["svg", "pdf", "dxf", "json", "png"] {
        for options in
            [&["--style", "lines"][..], &["--sheet", "third"], &["--look", "technical", "--hidden", "dashed"]]
        {
            if format == "json" && options[0] != "--style" {
                continue;
            }
            let out = folder.path(&format!("a.{format}"));
            let text = libraries(&[&["render", "builtin:ant", "-o", &out], options].concat());
            assert!(text.contains("libc.so") || !has_loader, "a trace");
            assert!(!is_gl(&text), "{format} {options:?}: {text}");
        }
    }
    let picture = libraries(&["render", "builtin:ant", "-o", &folder.path("a.png"), "--style", "phong"]);
    assert!(is_gl(&picture) || !has_loader, "a picture by OpenGL");
}

#[test]
fn a_model_is_not_written_over_and_an_empty_drawing_is_said() {
    let folder = Folder::new();
    let model = folder.file("model.svg", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    refused_in_one_line(&["render", &model, "-o", &model], &["model.svg", "this would overwrite the model;"]);
    assert!(std::fs::read_to_string(&model).unwrap().starts_with("v 0 0 0"));
    let output = done(&["render", &model, "-o", &folder.path("empty.svg"), "--style", "lines", "--classes", "crease"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("no line of these classes is visible"));
    refused_in_one_line(&["render", &model, "-o", &folder.path("a.svgz")], &[".svgz", ".svg, .pdf, ", " for lines"]);
}

#[test]
fn a_pdf_of_a_sheet_is_written_the_same_every_time() {
    let folder = Folder::new();
    let [first, second] = ["a.pdf", "b.pdf"].map(|name| folder.path(name));
    for out in [&first, &second] {
        let options = ["--page", "A5", "--hidden", "dashed", "--class-widths", "outline=1mm,hidden=0.2mm"];
        assert!(silent(&[&["render", "builtin:gear", "-o", out][..], &options].concat()).is_empty());
    }
    let bytes = std::fs::read(&first).unwrap();
    assert_eq!(bytes, std::fs::read(&second).unwrap());
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("%PDF-1.") && text.contains("visible outline") && text.contains("drawing.pdf"));
    assert!(text.contains("[0 0 419.52756 595.27559]") || text.contains("[0 0 419.52756 595.2756]"), "A5, upright");
}

#[test]
fn a_json_file_has_all_pieces_unless_a_length_is_given_and_says_which_are_outline() {
    let folder = Folder::new();
    let out = folder.path("a.json");
    let segments = |options: &[&str]| -> Vec<serde_json::Value> {
        silent(&[&["render", "builtin:bust", "-o", &out][..], options].concat());
        let read: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
        read["segments"].as_array().unwrap().clone()
    };
    let (all, long) = (segments(&[]), segments(&["--min-length", "20"]));
    assert!(long.len() < all.len() && !long.is_empty(), "{} {}", long.len(), all.len());
    assert_eq!(segments(&["--min-length", "0"]), all);
    let outline = all.iter().filter(|segment| segment["outline"] == true).count();
    assert!(outline > 10 && all.iter().all(|segment| segment["outline"] == false || segment["visible"] == true));
}

#[test]
fn only_lines_have_outlines_and_millimetres() {
    let folder = Folder::new();
    let [png, svg] = ["a.png", "a.svg"].map(|name| folder.path(name));
    let ink = ["render", "builtin:ant", "-o", &png, "--style", "inking", "--size", "32"];
    refused_in_one_line(&[&ink[..], &["--class-colors", "outline=red"]].concat(), &["--class-colors outline", ".svg"]);
    refused_in_one_line(&[&ink[..], &["--line-width", "0.5mm"]].concat(), &["--line-width 0.5mm", "give pixels"]);
    silent(&[
        "render",
        "builtin:ant",
        "-o",
        &svg,
        "--class-colors",
        "outline=red",
        "--line-width",
        "0.5mm",
        "--page",
        "dpi=96",
    ]);
    assert!(std::fs::read_to_string(&svg).unwrap().contains(r#"id="visible-outline""#));
}

#[test]
fn smooth_silhouettes_say_where_they_break_and_lines_are_written_as_curves() {
    let folder = Folder::new();
    let [polylines, curves, pdf] = ["a.svg", "b.svg", "c.pdf"].map(|name| folder.path(name));
    let drawn = |out: &str, options: &[&str]| {
        silent(
            &[
                &["render", "builtin:bust", "-o", out, "--style", "lines", "--silhouette", "smooth", "--size", "128"],
                options,
            ]
            .concat(),
        )
    };
    let record: serde_json::Value = serde_json::from_slice(&drawn(&polylines, &["--json"])).unwrap();
    assert_eq!(record["style"]["silhouette"], "smooth");
    for count in ["crossings", "cusps", "inconsistencies"] {
        assert!(record["changes"][count].is_u64(), "{count}");
    }
    let places = record["changes"]["places"].as_array().unwrap();
    assert_eq!(places.len() as u64, record["changes"]["inconsistencies"]);
    assert!(places.iter().all(|place| place["px"][1].is_f64() && place["kind"].is_string()), "{places:?}");
    let exact = answer(&["render", "builtin:bust", "-o", &folder.path("d.svg"), "--size", "128", "--json"]);
    assert!(exact.get("changes").is_none());
    drawn(&curves, &["--fit-curves", "0.5"]);
    drawn(&pdf, &["--fit-curves", "0.5"]);
    let [straight, curved] = [&polylines, &curves].map(|path| std::fs::read_to_string(path).unwrap());
    let count = |text: &str, what: char| {
        text.split(" d=\"").skip(1).map(|path| path.split('"').next().unwrap().matches(what).count()).sum::<usize>()
    };
    assert_eq!(count(&straight, 'C'), 0);
    assert!(count(&curved, 'C') > 20, "{}", count(&curved, 'C'));
    assert!(curved.len() < straight.len(), "{} {}", curved.len(), straight.len());
    assert!(std::fs::read(&pdf).unwrap().windows(3).any(|word| word == b" c\n"));
}

#[test]
fn explained_lines_are_a_text_of_what_there_is() {
    let folder = Folder::new();
    let out = folder.path("a.svg");
    let base = ["render", "builtin:bust", "-o", &out, "--silhouette", "smooth", "--view", "0,35", "--size", "160"];
    let base = [&base[..], &["--style", "lines"]].concat();
    let said = String::from_utf8(silent(&[&base[..], &["--explain"]].concat())).unwrap();
    let record: serde_json::Value = serde_json::from_slice(&silent(&[&base[..], &["--json"]].concat())).unwrap();
    let breaks = record["changes"]["inconsistencies"].as_u64().unwrap();
    assert!(said.contains(&format!("{breaks} times for no reason")), "{said}");
    assert_eq!(said.lines().filter(|line| line.starts_with("  at ")).count() as u64, breaks);
    let edges = record["edges"]["crease"].as_u64().unwrap().to_string();
    let crease = said.lines().find(|line| line.starts_with("crease")).unwrap();
    assert_eq!(crease.split_whitespace().nth(1), Some(edges.as_str()));
    for part in ["seen px", "read", "preparing lines", "finding lines", "leaving out specks", "join and write"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(!said.contains("finding areas"), "{said}");
    let toned = ["render", "builtin:bust", "-o", &out, "--look", "print", "--size", "160", "--explain"];
    let said = String::from_utf8(silent(&toned)).unwrap();
    let place = |part: &str| said.find(part).unwrap_or_else(|| panic!("{part}: {said}"));
    assert!(place("leaving out specks") < place("finding areas"), "{said}");
}

/// A model with slow lines, as an OBJ file's text.
fn slow_model(triangles: usize) -> String {
    let hair = FAMILIES.iter().find(|family| family.name == "hair").unwrap();
    let shape = (hair.make)(triangles);
    let vertices = shape.positions.iter().map(|point| format!("v {} {} {}\n", point.x, point.y, point.z));
    let faces = shape.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    vertices.chain(faces).collect()
}

#[test]
fn lines_that_are_not_found_in_time_end_with_a_sentence_and_no_file() {
    let folder = Folder::new();
    for name in ["a.svg", "a.pdf", "a.json", "a.png"] {
        let out = folder.path(name);
        let words = ["render", "builtin:gear", "-o", &out, "--style", "lines", "--within", "1e-6"];
        refused_in_one_line(&words, &["not done within 0.000001 s", "more time"]);
        assert!(!Path::new(&out).exists(), "{out}");
    }
    let of = |out: &str, more: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:gear", "-o", &folder.path(out)][..], more].concat(), words);
    };
    of("a.svg", &["--within", "0"], &["--within", "above 0"]);
    of("a.svg", &["--provenance"], &["--provenance: this option is gone; -o drawing.json has each line's class"]);
    of("a.png", &["--style", "ink", "--within", "5"], &["--within", "exact lines"]);
}

#[test]
fn what_is_done_in_time_is_the_same_as_without_a_limit() {
    let folder = Folder::new();
    for name in ["a.svg", "a.json", "a.png"] {
        let drawn = |more: &[&str]| {
            let out = folder.path(name);
            silent(
                &[&["render", "builtin:gear", "-o", &out, "--style", "lines", "--size", "96x64"][..], more].concat(),
            );
            std::fs::read(out).unwrap()
        };
        assert_eq!(drawn(&["--within", "3600"]), drawn(&[]), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_the_search_for_lines_with_a_sentence_and_no_file() {
    use std::io::Write;
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    let out = folder.path("a.svg");
    // A scheduler's signal comes twice: to the program and to its group.
    for (signal, times, code) in [("INT", 1, 130), ("TERM", 2, 143)] {
        let mut process = Command::new(env!("CARGO_BIN_EXE_tinta"))
            .args(["render", "-", "-o", &out, "--hidden", "dashed"])
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // More than a pipe holds: when it is written the program reads, and takes signals.
        let model = slow_model(3_000);
        assert!(model.len() > 200_000);
        process.stdin.take().unwrap().write_all(model.as_bytes()).unwrap();
        for _ in 0..times {
            let kill = Command::new("kill").args(["-s", signal, &process.id().to_string()]).status();
            assert!(kill.unwrap().success());
        }
        let output = process.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            (output.status.code(), said.trim_end()),
            (Some(code), "tinta: stopped by a signal; nothing was written")
        );
        assert!(!Path::new(&out).exists());
    }
}

#[test]
fn a_look_with_tones_takes_the_options_of_lines_into_vectors() {
    let folder = Folder::new();
    let paths = |options: &[&str]| {
        let svg = folder.path("a.svg");
        silent(&[&["render", "builtin:bust", "-o", &svg, "--look", "print", "--size", "400x300"], options].concat());
        std::fs::read_to_string(svg).unwrap().matches("<path").count()
    };
    let lasting = paths(&[]);
    let sharp = paths(&["--crease-angle", "60"]);
    let silhouettes = paths(&["--classes", "silhouette"]);
    assert!(silhouettes < sharp && sharp < lasting, "{silhouettes} {sharp} {lasting}");
}
