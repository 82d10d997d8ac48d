//! Drawings with known faults are judged by them.

use crate::program::{done, refused_in_one_line, said, tinta};
use crate::support::{Folder, renderer, scene};
use glam::DVec2;
use serde_json::Value;
use tinta::{Backend, DrawingSettings, LineSettings, Picture, Scene, Size, Style, StyleName, lines};
use tinta_lab::judge::{InkColor, JudgeSettings, Judgement, drawing, judge};
use tinta_lab::measure::{Ink, Reference, Row};

const SIDE: u32 = 120;

fn subject(model: &str) -> (Scene, Reference) {
    let scene = scene(model, SIDE, SIDE);
    let reference = Reference::with_hidden(&scene, &LineSettings::as_published()).unwrap();
    (scene, reference)
}

fn svg(reference: &Reference) -> String {
    lines::svg(&reference.lines, &DrawingSettings::default()).unwrap()
}

fn picture(svg: &str) -> Picture {
    drawing::of_bytes(svg.as_bytes(), "drawing.svg", None).unwrap()
}

fn judged(picture: &Picture, reference: &Reference, fits: bool) -> Judgement {
    // Two pixels.
    let settings = JudgeSettings { fits, tolerance: format!("1/{}", SIDE / 2).parse().unwrap() };
    judge(&InkColor::Dark.of(picture), reference, &settings).unwrap()
}

/// The drawing within another element.
fn within(svg: &str, before: &str, after: &str) -> String {
    let start = svg.find("<svg").unwrap();
    let body = svg[start..].find('>').unwrap() + start + 1;
    let end = svg.rfind("</svg>").unwrap();
    format!("{}{before}{}{after}{}", &svg[..body], &svg[body..end], &svg[end..])
}

#[test]
fn the_exact_lines_are_right_and_what_is_done_to_them_shows_in_the_number_it_belongs_to() {
    let (_, reference) = subject("builtin:gear");
    let whole = svg(&reference);
    let right = judged(&picture(&whole), &reference, false);
    assert!(right.lines.f1 > 0.9999 && right.lines.average_precision > 0.99, "{right:?}");
    assert!(right.one_to_one.iter().all(|one| one.best_f1 > 0.98), "{:?}", right.one_to_one);
    assert!(right.hausdorff_95_px.unwrap() < 1.2 && right.hidden.drawn_px == 0.0);

    // Moved by 3 px: no line is within 1 of its place, and every line is within 4.
    let moved = picture(&within(&whole, "<g transform=\"translate(3 0)\">", "</g>"));
    let moved = judged(&moved, &reference, false);
    assert!(moved.lines.f1 < 0.85 && moved.one_to_one[0].f1 < 0.5, "{moved:?}");
    assert!(moved.hausdorff_95_px.unwrap() > 2.0 && moved.hausdorff_95_px.unwrap() < 4.1);

    // The right half is missing: half of the lines, and no wrong ink.
    let half = picture(&within(
        &whole,
        "<clipPath id=\"c\"><path d=\"M0 0H60V120H0z\"/></clipPath><g clip-path=\"url(#c)\">",
        "</g>",
    ));
    let half = judged(&half, &reference, false);
    let left: f64 = reference.samples.iter().filter(|sample| sample.px.x < 60.0).map(|sample| sample.length_px).sum();
    assert!((half.lines.recall - left / reference.length_px()).abs() < 0.02, "{half:?}");
    assert!(half.lines.precision > 0.999);

    // With hidden lines.
    let mut all = reference.lines.clone();
    all.segments.iter_mut().for_each(|segment| segment.is_visible = true);
    let hidden = judged(&picture(&lines::svg(&all, &DrawingSettings::default()).unwrap()), &reference, false);
    assert!(hidden.hidden.length_px > 50.0 && hidden.hidden.drawn_px > 0.9 * hidden.hidden.length_px, "{hidden:?}");
    assert!(hidden.lines.recall > 0.9999 && hidden.lines.precision < 0.8);

    // An empty picture, and a full one.
    let blank = |value: u8| Picture {
        size: Size { width: SIDE, height: SIDE },
        pixels: [value, value, value, 255].repeat(14_400),
    };
    let empty = judged(&blank(255), &reference, false);
    assert_eq!((empty.lines.recall, empty.lines.f1, empty.chamfer_px, empty.hidden.drawn_px), (0.0, 0.0, None, 0.0));
    let black = judged(&blank(0), &reference, false);
    assert_eq!((black.lines.recall, black.hidden.drawn_px), (1.0, black.hidden.length_px));
    // The share of the picture near a line, without pixels near a soft crease alone.
    let middles =
        (0..SIDE * SIDE).map(|index| DVec2::new(f64::from(index % SIDE) + 0.5, f64::from(index / SIDE) + 0.5));
    let (mut near, mut counted) = (0.0, 0.0);
    for px in middles {
        let is_near = reference.distance_px(px) <= 2.0;
        near += f64::from(u8::from(is_near));
        counted += f64::from(u8::from(is_near || reference.distance_to_ignored_px(px) > 2.0));
    }
    assert!((black.lines.precision - near / counted).abs() < 1e-9 && black.lines.precision < 0.5, "{black:?}");
    assert!(black.one_to_one[2].f1 < 0.1, "a black square is thinned to a line or two: {:?}", black.one_to_one);

    // Seen from elsewhere.
    let other = scene("builtin:ant", SIDE, SIDE);
    let other = Reference::with_hidden(&other, &LineSettings::as_published()).unwrap();
    assert!(judged(&picture(&whole), &other, false).lines.f1 < 0.5);
}

#[test]
fn a_small_shift_a_scale_and_a_mirror_image_are_found_and_nothing_beyond() {
    let (_, reference) = subject("builtin:ant");
    let whole = svg(&reference);
    let fitted = |transform: &str| {
        let moved = picture(&within(&whole, &format!("<g transform=\"{transform}\">"), "</g>"));
        judged(&moved, &reference, true)
    };
    for (transform, shift, scale, mirrored, upside_down) in [
        ("translate(0 0)", [0.0, 0.0], 1.0, false, false),
        ("translate(3 -2)", [3.0, -2.0], 1.0, false, false),
        ("translate(60 60) scale(1.05) translate(-60 -60)", [0.0, 0.0], 1.05, false, false),
        ("translate(120 0) scale(-1 1)", [0.0, 0.0], 1.0, true, false),
        ("translate(4 120) scale(1 -1)", [4.0, 0.0], 1.0, false, true),
    ] {
        let judgement = fitted(transform);
        let fit = judgement.fit.unwrap();
        let near = |a: f64, b: f64, slack: f64| (a - b).abs() < slack;
        assert!(near(fit.shift_px[0], shift[0], 0.35) && near(fit.shift_px[1], shift[1], 0.35), "{transform}: {fit:?}");
        assert!(near(fit.scale, scale, 0.01), "{transform}: {fit:?}");
        assert_eq!((fit.is_mirrored, fit.is_upside_down), (mirrored, upside_down), "{transform}");
        assert!(judgement.lines.f1 > 0.995, "{transform}: {}", judgement.lines.f1);
    }
    let far = fitted("translate(40 0)");
    let [x, y] = far.fit.unwrap().shift_px;
    assert!(x.hypot(y) <= 0.05 * 120.0 * 2f64.sqrt() + 1e-9 && far.lines.f1 < 0.8, "{far:?}");
}

#[test]
fn what_a_style_draws_is_judged_as_it_is_measured() {
    let (scene, reference) = subject("builtin:gear");
    let mut renderer = renderer(Backend::Auto);
    let folder = Folder::new();
    for name in [StyleName::ThreePass, StyleName::Inking, StyleName::Ink] {
        let style = Style::named(name);
        let measured = Ink::of_style(&mut renderer, &scene, &style).unwrap().unwrap().error(&reference, 2.0);
        let path = folder.path("drawing.png");
        let style = format!("--style={}", name.name());
        let words = ["render", "builtin:gear", "-o", &path, &style, "--show", "borders", "--size", "120"];
        done(&words);
        let output = tinta(&["judge", &path, "--model", "builtin:gear", "--tolerance", "1/60", "--json"]);
        let record: Value = serde_json::from_slice(&output.stdout).unwrap();
        for (key, expected) in [("f1", measured.f1), ("recall", measured.recall), ("precision", measured.precision)] {
            let value = record["lines"][key].as_f64().unwrap();
            assert!((value - expected).abs() < 0.002, "{style} {key}: {value} and {expected}");
        }
    }
}

#[test]
fn rows_of_drawings_are_added_to_a_folder_and_land_in_its_plot() {
    let folder = Folder::new();
    let (svg, png, out) = (folder.path("a.svg"), folder.path("b.png"), folder.path("judged"));
    let draw = |path: &str, more: &[&str]| {
        let words = ["render", "builtin:open-box", "-o", path, "--size", "128"];
        done(&[&words[..], more].concat());
    };
    draw(&svg, &["--style", "lines"]);
    draw(&png, &["--style", "inking", "--show", "borders"]);
    let base = ["judge", &svg, &png, "--model", "builtin:open-box", "-o", &out];
    let output = done(&[&base[..], &["--names", "one,other", "--seconds", "0.5,1.5", "--machine", "here"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("one, 128x128 px") && text.contains("one to one") && text.contains("hidden lines"), "{text}");
    let output =
        tinta(&["judge", &svg, "--model", "builtin:open-box", "-o", &out, "--names", "third", "--machine", "here"]);
    assert_eq!(output.status.code(), Some(0));
    let rows: Vec<Row> = tinta_lab::report::read_rows(format!("{out}/results.jsonl").as_ref()).unwrap();
    assert_eq!(rows.iter().map(|row| row.style.as_str()).collect::<Vec<_>>(), ["one", "other", "third"]);
    assert_eq!(rows.iter().map(|row| row.time.median_ms).collect::<Vec<_>>(), [500.0, 1500.0, 0.0]);
    let plot = std::fs::read_to_string(format!("{out}/plot-lines.svg")).unwrap();
    assert!(plot.contains("one") && plot.contains("other") && !plot.contains("third"));
    assert!(std::path::Path::new(&format!("{out}/errors/builtin-open-box-128x128-one.png")).is_file());
    // The pictures of the first command are still in the page that the second wrote.
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    for name in ["one", "other", "third"] {
        assert!(page.contains(&format!("128x128: {name}, F1 ")), "{name}");
    }
}

#[test]
fn a_camera_of_another_program_is_read_from_its_file() {
    let folder = Folder::new();
    let [picture, record, matrix] = ["a.png", "a.json", "a.txt"].map(|name| folder.path(name));
    let view = ["--view", "200,-30", "--fov", "50", "--size", "150x100", "--style", "inking", "--show", "borders"];
    let output = tinta(&[&["render", "builtin:gear", "-o", &picture, "--json"], &view[..]].concat());
    std::fs::write(&record, &output.stdout).unwrap();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let columns = |name: &str| {
        glam::DMat4::from_cols_array(&serde_json::from_value::<[f64; 16]>(json["camera"][name].clone()).unwrap())
    };
    let clip_from_world = (columns("clip_from_view") * columns("view_from_world")).transpose().to_cols_array();
    let numbers: Vec<String> =
        clip_from_world.chunks(4).map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")).collect();
    std::fs::write(&matrix, numbers.join("\n")).unwrap();
    let judged = |more: &[&str], code: i32| {
        let output =
            tinta(&[&["judge", &picture, "--model", "builtin:gear", "--tolerance", "1/50", "--json"], more].concat());
        assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).unwrap()["lines"]["f1"].as_f64().unwrap()
    };
    let f1 = |more: &[&str]| judged(more, 0);
    let right = f1(&view[..4]);
    let elsewhere = ["--view", "20,10"];
    assert!(right > 0.99 && judged(&elsewhere, 1) < 0.8, "from another camera it is not scored");
    assert!((f1(&[]) - right).abs() < 1e-6, "a picture by tinta is judged from where it was drawn");
    for file in [&record, &matrix, &picture] {
        assert!((f1(&["--camera", file]) - right).abs() < 1e-6, "{file}");
        // A drawing from it, in a look with another view.
        let again = folder.path("again.png");
        let words = ["render", "builtin:gear", "-o", &again, "--camera", file, "--size", "150x100", "--look", "print"];
        done(&words);
    }
    let bare = folder.path("bare.png");
    tinta(&["render", "builtin:gear", "-o", &bare, "--no-recipe", "--size", "150x100"]);
    refused_in_one_line(&["judge", &picture, "--model", "builtin:gear", "--camera", &bare], &["bare.png", "camera"]);
}

#[test]
fn whatever_an_svg_holds_is_drawn_or_refused() {
    let (_, reference) = subject("builtin:open-box");
    let whole = svg(&reference);
    let right = judged(&picture(&whole), &reference, false).lines.f1;
    // Other elements around and beside the lines do not affect them.
    for (before, after) in [
        ("<text x=\"9\" y=\"9\">words</text>", ""),
        ("<g transform=\"translate(50 50) scale(2)\"><g transform=\"scale(0.5) translate(-50 -50)\">", "</g></g>"),
        (
            "<image href=\"secret.png\" width=\"9\" height=\"9\"/><image href=\"file:///etc/hostname\" width=\"9\" height=\"9\"/>",
            "",
        ),
        ("<defs><linearGradient id=\"g\"><stop stop-color=\"red\"/></linearGradient></defs>", ""),
    ] {
        let f1 = judged(&picture(&within(&whole, before, after)), &reference, false).lines.f1;
        assert!((f1 - right).abs() < 1e-3, "{before}: {f1} and {right}");
    }
    let refused = |svg: &str| drawing::of_bytes(svg.as_bytes(), "bad.svg", None).unwrap_err().to_string();
    let entities = |count: usize| {
        (1..count)
            .map(|n| format!("<!ENTITY a{n} \"&a{m};&a{m};&a{m};&a{m};&a{m};&a{m};&a{m};&a{m};\">", m = n - 1))
            .collect::<String>()
    };
    let laughs = format!(
        "<!DOCTYPE svg [<!ENTITY a0 \"<path d='M0 0h9'/>\">{}]><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">&a19;</svg>",
        entities(20)
    );
    assert!(refused(&laughs).starts_with("bad.svg: it is no SVG that can be read"));
    let uses = (1..40)
        .map(|n| format!("<g id=\"u{n}\"><use href=\"#u{m}\"/><use href=\"#u{m}\"/></g>", m = n - 1))
        .collect::<String>();
    let uses = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><defs><path id=\"u0\" d=\"M0 0h9\"/>{uses}</defs><use href=\"#u39\"/></svg>"
    );
    assert!(refused(&uses).contains("limit"), "{}", refused(&uses));
    assert!(refused("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2e9\" height=\"2e9\"/>").contains("too many"));
    assert!(refused("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"0\" height=\"5\"/>").contains("bad.svg"));
    assert!(refused("<html></html>").contains("no SVG"));
    assert!(drawing::of_bytes(&[0x1f, 0x8b, 8], "a.svgz", None).unwrap_err().to_string().contains("compressed"));
    let wide = drawing::of_bytes(whole.as_bytes(), "a.svg", Some(Size { width: 400, height: 200 })).unwrap();
    assert_eq!(wide.size, Size { width: 400, height: 200 });
}

#[test]
fn what_cannot_be_judged_is_refused_in_a_sentence() {
    let folder = Folder::new();
    let svg = folder.path("a.svg");
    done(&["render", "builtin:gear", "-o", &svg, "--size", "64"]);
    let png = folder.path("a.png");
    done(&["render", "builtin:gear", "-o", &png, "--size", "64"]);
    let missing = folder.path("missing.png");
    let base = ["judge", &svg, "--model", "builtin:gear"];
    for (words, parts) in [
        (vec!["judge", &svg], vec!["--model"]),
        (vec!["judge", &missing, "--model", "builtin:gear"], vec!["missing.png", "no such file"]),
        ([&base[..], &["--names", "a,b"]].concat(), vec!["--names", "2 are given for 1 drawing"]),
        ([&base[..], &["--seconds", "-1"]].concat(), vec!["--seconds", "above 0"]),
        ([&base[..], &["--tolerance", "0"]].concat(), vec!["--tolerance", "above 0"]),
        ([&base[..], &["--ink", "white"]].concat(), vec!["--ink", "light"]),
        ([&base[..], &["--ink", "drak"]].concat(), vec!["--ink"]),
        (vec!["judge", &png, "--model", "builtin:gear", "--size", "65"], vec!["a.png", "64x64", "65x65"]),
        (vec!["judge", &svg, "--model", "builtin:gaer"], vec!["builtin:gear"]),
    ] {
        refused_in_one_line(&words, &parts);
    }
}

#[test]
fn a_picture_is_judged_from_where_it_was_drawn_and_one_from_elsewhere_is_said() {
    let folder = Folder::new();
    let [elsewhere, here] = ["elsewhere.svg", "here.svg"].map(|name| folder.path(name));
    let model = ["--model", "builtin:gear"];
    let drawn = |out: &str, more: &[&str]| {
        let output =
            tinta(&[&["render", "builtin:gear", "-o", out, "--style", "lines", "--size", "160"][..], more].concat());
        assert!(output.status.success(), "{output:?}");
    };
    drawn(&elsewhere, &["--view", "70,40", "--fov", "20"]);
    drawn(&here, &[]);
    let judged = |drawings: &[&str], more: &[&str]| {
        let output = tinta(&[&["judge", "--json", "--tolerance", "1/80"], drawings, &model[..], more].concat());
        let last = String::from_utf8(output.stdout.clone()).unwrap();
        let last = last.rsplit("\n{").next().map(|record| format!("{{{}", record.trim_start_matches('{'))).unwrap();
        let record: Value = serde_json::from_str(&last).unwrap();
        (record["lines"]["f1"].as_f64().unwrap(), said(&output))
    };
    let (right, said) = judged(&[&elsewhere], &[]);
    assert!(said.is_empty() && right > 0.95, "{right} {said}");
    // Several drawings are judged from where the first was drawn.
    let (wrong, said) = judged(&[&here, &elsewhere], &[]);
    assert!(said.contains("elsewhere.svg was drawn from elsewhere (--fov 20 --view 70,40); --camera"), "{said}");
    assert!(wrong < 0.8, "{wrong}");
    assert_eq!(judged(&[&elsewhere], &["--camera", &elsewhere]).0, right);
    assert_eq!(judged(&[&here], &[]).1, "");
}

#[test]
fn a_shaded_picture_and_one_from_elsewhere_are_said_to_be_so_instead_of_scored() {
    let folder = Folder::new();
    let drawn = |name: &str, more: &[&str]| {
        let out = folder.path(name);
        let output =
            tinta(&[&["render", "builtin:gear", "-o", &out, "--size", "200", "--no-recipe"][..], more].concat());
        assert!(output.status.success(), "{output:?}");
        out
    };
    let judged = |drawing: &str, more: &[&str]| {
        let output = tinta(&[&["judge", drawing, "--model", "builtin:gear"][..], more].concat());
        let texts = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.code(), texts)
    };
    let shaded = drawn("shaded.png", &["--style", "phong"]);
    let elsewhere = drawn("elsewhere.png", &["--style", "lines", "--view", "140,-20"]);
    let right = drawn("right.png", &["--style", "lines"]);
    // Another view's lines cross the lines of this one here and there: numbers without the doubt mislead.
    for (drawing, sentence) in [
        (&shaded, "shaded.png: this looks like a shaded picture, with "),
        (&elsewhere, "elsewhere.png: this looks like another camera or model, as lines and ink agree by "),
    ] {
        let (code, [printed, said]) = judged(drawing, &[]);
        assert!(said.contains(sentence) && said.lines().count() == 1, "{said}");
        assert!(code == Some(1) && printed.contains("not scored") && !printed.contains("F1"), "{code:?} {printed}");
        let (_, [record, _]) = judged(drawing, &["--json"]);
        let record: Value = serde_json::from_str(&record).unwrap();
        assert!(record["lines"]["f1"].is_number() && record["doubt"].is_object(), "{record}");
    }
    let (code, [printed, said]) = judged(&right, &[]);
    assert!(code == Some(0) && printed.contains("F1") && said.is_empty(), "{code:?} {printed} {said}");
    // The styles' own widest lines are lines, and tones are not.
    let wide = drawn("wide.png", &["--style", "three-pass", "--border-width", "6", "--show", "borders"]);
    assert_eq!(judged(&wide, &[]).0, Some(0));
}
