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
fn a_turn_of_lines_is_numbered_drawings() {
    let folder = Folder::new();
    let model = ["builtin:open-box", "--size", "96x80", "--turntable", "5"];
    let record = render(&[&model[..], &["-o", &folder.path("a-%02d.svg"), "--json", "--hidden", "dashed"]].concat());
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    assert_eq!(record["frames"], 5);
    assert_eq!((&record["style"]["name"], &record["style"]["hidden"]), (&"lines".into(), &"dashed".into()));
    let drawing = |number: usize| std::fs::read_to_string(folder.path(&format!("a-{number:02}.svg"))).unwrap();
    let drawings: std::collections::BTreeSet<String> = (1..=5).map(drawing).collect();
    assert_eq!(drawings.len(), 5, "each view is another");
    assert_eq!(record["bytes"], drawings.iter().map(String::len).sum::<usize>());
    assert!(!std::path::Path::new(&folder.path("a-06.svg")).exists());
    render(&[&model[..], &["-o", &folder.path("%d.pdf")]].concat());
    render(&[&model[..], &["-o", &folder.path("%d.png"), "--style", "lines"]].concat());
    assert!(std::fs::read(folder.path("5.pdf")).unwrap().starts_with(b"%PDF"));
    assert_eq!(image::open(folder.path("5.png")).unwrap().into_rgba8().dimensions(), (96, 80));
}

#[test]
fn what_makes_no_turn_of_lines_is_refused() {
    let refused = |output: &str, options: &[&str], words: &[&str]| {
        refused_in_one_line(&[&["render", "builtin:ant", "-o", output, "--turntable", "4"], options].concat(), words);
    };
    for output in ["a.svg", "a.pdf", "a.dxf", "a.json", "%d.json"] {
        refused(output, &[], &[output, "this names one drawing", ".gif or .apng", "frame-%04d.svg"]);
    }
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
