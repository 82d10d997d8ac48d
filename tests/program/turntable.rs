//! `tinta render` into animations, as a user meets it.

use crate::program::{refused_in_one_line, said, silent, tinta};
use crate::support::{Folder, frames_of_gif as gif, public_models, skip};
use image::AnimationDecoder;
use image::codecs::png::PngDecoder;
use std::io::Cursor;

fn render(arguments: &[&str]) -> String {
    // Nor is there a progress bar where there is no terminal.
    String::from_utf8(silent(&[&["render"], arguments].concat())).unwrap()
}

#[test]
fn a_turntable_is_as_many_different_pictures_and_begins_with_the_view() {
    let folder = Folder::new();
    let (gif_path, apng_path) = (folder.path("a.gif"), folder.path("a.apng"));
    let model = ["builtin:bust", "--size", "48x40", "--turntable", "6"];
    let record = render(&[&model[..], &["-o", &gif_path, "--json"]].concat());
    render(&[&model[..], &["-o", &apng_path, "--frame-delay", "50"]].concat());
    render(&[&model[..], &["-o", &folder.path("a-%02d.png")]].concat());
    let frames = gif(&gif_path);
    assert_eq!(frames.len(), 6);
    assert!((1..6).all(|number| frames[number].buffer() != frames[0].buffer()));
    let decoder = PngDecoder::new(Cursor::new(std::fs::read(&apng_path).unwrap())).unwrap();
    let lossless = decoder.apng().unwrap().into_frames().collect_frames().unwrap();
    for (number, frame) in lossless.iter().enumerate() {
        assert_eq!(frame.delay().numer_denom_ms(), (50, 1));
        let picture = image::open(folder.path(&format!("a-{:02}.png", number + 1))).unwrap().into_rgba8();
        assert!(*frame.buffer() == picture, "picture {number}");
    }
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    assert_eq!((&record["frames"], &record["delay_ms"]), (&6.into(), &200.into()));
    assert_eq!(record["frame_ms"]["all"].as_array().unwrap().len(), 6);
    assert_eq!(record["encode_ms"]["all"].as_array().unwrap().len(), 6);
    assert_eq!(record["bytes"], std::fs::metadata(&gif_path).unwrap().len());
}

#[test]
fn a_name_of_an_animation_without_a_turn_is_refused() {
    let folder = Folder::new();
    for name in ["a.gif", "a.apng", "%d.png", "%d.svg"] {
        let path = folder.path(name);
        refused_in_one_line(&["render", "builtin:open-box", "-o", &path], &[name, "add --turntable 60", "drawing.png"]);
    }
    assert_eq!(std::fs::read_dir(folder.path(".")).unwrap().count(), 0);
}

#[test]
fn a_transparent_turntable_leaves_nothing_of_the_view_before() {
    let folder = Folder::new();
    let (gif_path, pictures) = (folder.path("a.gif"), folder.path("a-%d.png"));
    for path in [&gif_path, &pictures] {
        render(&["builtin:ant", "--size", "64", "--turntable", "5", "--background", "transparent", "-o", path]);
    }
    for (number, frame) in gif(&gif_path).iter().enumerate() {
        let picture = image::open(folder.path(&format!("a-{}.png", number + 1))).unwrap().into_rgba8();
        for (kept, drawn) in frame.buffer().pixels().zip(picture.pixels()) {
            assert_eq!(kept.0[3] == 255, drawn.0[3] >= 128, "view {number}");
        }
    }
}

#[test]
fn a_models_frames_are_walked_through() {
    let Some(folder) = public_models() else { return };
    let model = folder.join("faerie.md2");
    let Some(model) = model.to_str().filter(|model| std::path::Path::new(model).is_file()) else {
        return skip("faerie.md2: not there");
    };
    let folder = Folder::new();
    let out = folder.path("run.gif");
    render(&[model, "--animate=run", "--size", "64", "-o", &out]);
    let frames = gif(&out);
    assert_eq!(frames.len(), 6);
    assert!(frames.iter().all(|frame| frame.delay().numer_denom_ms() == (100, 1)));
    assert!((1..6).all(|number| frames[number].buffer() != frames[0].buffer()));
    refused_in_one_line(&["render", model, "-o", &out, "--animate=fly"], &["--animate=fly", "stand, run, attack"]);
}

#[test]
fn a_turn_of_lines_is_numbered_drawings_whose_paths_have_ids_that_stay() {
    let folder = Folder::new();
    let model = ["builtin:open-box", "--size", "96x80", "--turntable", "5"];
    let record = render(&[&model[..], &["-o", &folder.path("a-%02d.svg"), "--json", "--hidden", "dashed"]].concat());
    let ids = |number: usize| -> Vec<String> {
        let text = std::fs::read_to_string(folder.path(&format!("a-{number:02}.svg"))).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        let paths = document.descendants().filter(|node| node.has_tag_name("path"));
        paths.map(|path| path.attribute("id").expect("every path has one").to_owned()).collect()
    };
    let mut all = std::collections::BTreeSet::new();
    for number in 1..=5 {
        let ids = ids(number);
        let different: std::collections::BTreeSet<_> = ids.iter().cloned().collect();
        assert_eq!(ids.len(), different.len(), "{ids:?}");
        all.extend(different);
    }
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    assert_eq!((&record["frames"], &record["strokes"]), (&5.into(), &all.len().into()));
    assert_eq!((&record["style"]["name"], &record["style"]["hidden"]), (&"lines".into(), &"dashed".into()));
    let size = |number: usize| std::fs::metadata(folder.path(&format!("a-{number:02}.svg"))).unwrap().len();
    assert_eq!(record["bytes"], (1..=5).map(size).sum::<u64>());
    assert!(!std::path::Path::new(&folder.path("a-06.svg")).exists());
    // The twelve edges of a box with their hidden parts: visible or hidden, the same strokes.
    assert!(all.len() < 24, "{all:?}");
    render(&[&model[..], &["-o", &folder.path("%d.pdf")]].concat());
    render(&[&model[..], &["-o", &folder.path("%d.png"), "--style", "lines"]].concat());
    assert!(std::fs::read(folder.path("5.pdf")).unwrap().starts_with(b"%PDF"));
    assert_eq!(image::open(folder.path("5.png")).unwrap().into_rgba8().dimensions(), (96, 80));
    // Without a turn a drawing is one file, and its paths have no ids.
    render(&["builtin:open-box", "-o", &folder.path("one.svg")]);
    assert!(!std::fs::read_to_string(folder.path("one.svg")).unwrap().contains("stroke-1"));
}

/// The paths of a drawing: layer, number of the stroke, course.
type Courses = std::collections::BTreeSet<(String, String, String)>;

/// The paths of an animated drawing that are shown at a share of its turn, by the rules of SMIL.
fn courses_at(text: &str, share: f64) -> Courses {
    let document = roxmltree::Document::parse(text).unwrap();
    let mut courses = Courses::new();
    for path in document.descendants().filter(|node| node.has_tag_name("path")) {
        let layer = path.parent().unwrap().attribute("id").unwrap();
        let mut course = path.attribute("d").unwrap();
        if let Some(animate) = path.children().find(|node| node.has_tag_name("animate")) {
            let of = |name: &str| animate.attribute(name).unwrap();
            assert_eq!([of("attributeName"), of("calcMode"), of("repeatCount")], ["d", "discrete", "indefinite"]);
            let times: Vec<f64> = of("keyTimes").split(';').map(|time| time.parse().unwrap()).collect();
            let values: Vec<&str> = of("values").split(';').collect();
            assert!(
                times.len() == values.len() && times[0] == 0.0 && times.is_sorted() && times.last().unwrap() < &1.0
            );
            assert_eq!(course, values[0], "without animation the first view is shown");
            course = values[times.partition_point(|time| *time <= share) - 1];
        }
        if course != "M0 0" {
            let stroke = path.attribute("id").unwrap().strip_prefix(&format!("{layer}-")).unwrap();
            assert!(courses.insert((layer.to_owned(), stroke.to_owned(), course.to_owned())));
        }
    }
    courses
}

#[test]
fn an_animated_svg_shows_each_view_as_the_numbered_drawings_do() {
    for (model, views, options) in [
        ("builtin:open-box", 5, &["--hidden", "dashed"][..]),
        ("builtin:ant", 7, &["--line-width", "0.25mm", "--page", "width-mm=100"]),
        ("builtin:gear", 3, &["--hidden", "ghost", "--class-colors", "crease=red"]),
        ("builtin:torus", 6, &["--silhouette", "smooth", "--fit-curves", "0.5"]),
        ("builtin:open-box", 1, &[]),
    ] {
        let folder = Folder::new();
        let (count, animated) = (views.to_string(), folder.path("a.svg"));
        let all = [&["--size", "96x80", "--turntable", &count], options].concat();
        let record = render(&[&[model, "-o", &animated, "--json", "--frame-delay", "50"], &all[..]].concat());
        render(&[&[model, "-o", &folder.path("a-%d.svg")], &all[..]].concat());
        let text = std::fs::read_to_string(&animated).unwrap();
        assert!(!text.contains("<script"));
        for view in 0..views {
            let one = std::fs::read_to_string(folder.path(&format!("a-{}.svg", view + 1))).unwrap();
            let document = roxmltree::Document::parse(&one).unwrap();
            let of = |path: roxmltree::Node<'_, '_>| {
                let of = |node: roxmltree::Node<'_, '_>, name: &str| node.attribute(name).unwrap().to_owned();
                (of(path.parent().unwrap(), "id"), of(path, "id"), of(path, "d"))
            };
            let expected: Courses = document.descendants().filter(|it| it.has_tag_name("path")).map(of).collect();
            assert!(!expected.is_empty());
            assert_eq!(courses_at(&text, (f64::from(view) + 0.5) / f64::from(views)), expected, "{model}, view {view}");
            // The same sheet and the same layers' looks.
            let head = |text: &str| text.split("<g id=").next().unwrap().to_owned();
            assert_eq!(head(&one), head(&text));
        }
        let seconds = f64::from(views * 50) / 1000.0;
        assert_eq!(text.contains(&format!(r#"dur="{seconds}s""#)), views > 1, "{seconds}");
        let record: serde_json::Value = serde_json::from_str(&record).unwrap();
        assert_eq!((&record["frames"], &record["bytes"]), (&views.into(), &text.len().into()));
        assert_eq!(record["frame_ms"]["all"].as_array().unwrap().len(), views as usize);
    }
    // No dash of a pen is lost.
    let pen = ["builtin:open-box", "--turntable", "2", "--hidden", "dashed", "--pen", "-o"];
    let folder = Folder::new();
    render(&[&pen[..], &[&folder.path("p.svg")]].concat());
    render(&[&pen[..], &[&folder.path("p-%d.svg")]].concat());
    let lines = |name: &str| std::fs::read_to_string(folder.path(name)).unwrap().matches('M').count();
    assert!(lines("p.svg") > lines("p-1.svg") + lines("p-2.svg"));
}

#[test]
fn what_makes_no_turn_of_lines_is_refused() {
    let refused = |output: &str, options: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:ant", "-o", output, "--turntable", "4"], options].concat(), words);
    };
    for output in ["a.pdf", "a.dxf", "a.json", "%d.json"] {
        refused(output, &[], &[output, "this names one drawing", "frame-%04d.svg"]);
    }
    refused("no/such/a.svg", &[], &["no/such/a.svg: the folder no/such does not exist"]);
    refused("no/such/%d.svg", &[], &["no/such/1.svg: the folder no/such does not exist"]);
    refused("%d.svg", &["--page", "A4"], &["--page", "each view", "--page width-mm"]);
}

#[test]
fn what_makes_no_animation_is_refused() {
    let folder = Folder::new();
    let out = folder.path("a.gif");
    let refused = |output: &str, options: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:ant", "-o", output], options].concat(), words);
    };
    refused("a.png", &["--turntable", "4"], &["a.png: this names one picture", ".gif or .apng", "frame-%04d.png"]);
    refused("-", &["--turntable", "4"], &["-: this names one picture"]);
    refused("no/such/a.gif", &["--turntable", "4"], &["no/such/a.gif: the folder no/such does not exist"]);
    refused(&folder.path("%d.jpg"), &["--turntable", "4", "--background", "transparent"], &["no transparency"]);
    refused(&out, &["--turntable", "0"], &["--turntable", "from 1 to 10000"]);
    refused(&out, &["--turntable", "4", "--frame-delay", "5"], &["--frame-delay", "from 20 to 60000"]);
    refused(&out, &["--turntable", "4", "--animate"], &["--turntable", "--animate"]);
    refused(&out, &["--animate", "--model-frame", "2"], &["--animate", "--model-frame"]);
    refused(&out, &["--animate"], &["--animate: builtin:ant has no frames", "--turntable"]);
    refused(&out, &["--turntable", "4", "--dump", "steps"], &["--dump: this is for one picture"]);
    refused(&out, &["--turntable", "4", "--explain"], &["--explain: this is for one picture"]);
    refused(&out, &["--turntable", "4", "--frames", "9"], &["--frames: this is for one picture"]);
    assert!(!std::path::Path::new(&out).exists());
}

#[test]
fn frames_of_an_earlier_and_longer_turn_are_said() {
    let folder = Folder::new();
    for ending in ["png", "svg"] {
        let name = folder.path(&format!("frame-%02d.{ending}"));
        let turn = |views| {
            let output = tinta(&["render", "builtin:gear", "-o", &name, "--turntable", views, "--size", "32"]);
            assert!(output.status.success(), "{}", said(&output));
            said(&output)
        };
        assert_eq!([turn("4"), turn("4")].concat(), "", "{ending}");
        let left = turn("3");
        let sentence =
            format!("frame-04.{ending}: this frame is an earlier animation's; delete it with those after it");
        assert!(left.contains(&sentence) && left.trim_end().lines().count() == 1, "{left}");
    }
}
