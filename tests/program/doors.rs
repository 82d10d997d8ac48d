//! One request through every door: the command's file is the one of the calls that Python, the window and the page make, its recipe
//! included.
//!
//! The page and Python read the models themselves: they call `resolve`. Python's single mesh and the window keep a scene: they call
//! `resolve_again`. Both make the command's choices: the view of a flat sheet, a parallel projection for a drawing to scale, a
//! camera that has the shadow in view, the light of tones. A turn has its own camera, so none of these but the first view's light.

use crate::program::done;
use crate::support::Folder;
use std::path::{Path, PathBuf};
use tinta::cli::render::asked_by;
use tinta::lines::DrawingFormat;
use tinta::lines::Progress;
use tinta::recipe::{Driver, FileRecord};
use tinta::request::{Request, Resolved, Session, WantedLines};
use tinta::{Picture, StyleName};

/// A model's name, the ending of the file, and options.
type Row = (&'static str, &'static str, &'static str);

/// Drawings whose request and models decide something together.
const ROWS: [Row; 28] = [
    ("flat", "png", "--look print"),
    ("flat", "svg", "--look print"),
    ("flat", "png", "--look print --view 10,20"),
    ("flat", "png", "--look sketch --grain texture-size=64"),
    ("flat", "svg", "--look technical"),
    ("flat", "png", "--style three-pass"),
    ("floor", "svg", "--look print --page A4 --scale 1:1"),
    ("gear", "svg", "--look print --page A4 --scale 1:2"),
    ("gear", "svg", "--look print --page A4 --scale 1:2 --section x=0"),
    ("gear", "svg", "--style lines --page A4 --scale 1:2"),
    ("gear", "pdf", "--look print --page A5"),
    ("bust", "png", "--look print --ground shadow"),
    ("bust", "svg", "--look print --ground shadow"),
    ("bust", "png", "--style three-pass --ground shadow"),
    ("bust", "png", "--look print --ground shadow --background transparent"),
    ("gear", "png", "--look print --section x=0"),
    ("gear", "svg", "--look print --section x=0"),
    ("gear", "svg", "--look technical --sheet third"),
    ("gear", "svg", "--look print --hatch auto"),
    ("gear", "png", "--look print --hatch auto"),
    ("bust", "png", "--look print --hatch 6,hatch-angle=30 --ground shadow --background transparent"),
    ("gear", "dxf", "--look print --hatch auto --pen"),
    ("gear", "json", "--look technical"),
    ("gear", "svg", "--look technical --areas object --no-borders"),
    ("gear", "png", "--look print --no-borders"),
    ("gear", "png", "--style inking --exact-lines"),
    ("gear", "svg", "--style three-pass --exact-lines --hidden dashed"),
    ("gear", "png", "--look print --show tones --copies 2"),
];

/// A flat sheet that stands, and one that lies.
const SHEETS: [(&str, &str); 2] = [
    ("flat", "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nf 1 2 3 4\n"),
    ("floor", "v 0 0 0\nv 4 0 0\nv 4 0 2\nv 0 0 2\nf 1 2 3 4\n"),
];

/// The file of a resolved request.
fn file(drawn: &Resolved, beside: &[PathBuf], format: Option<DrawingFormat>, session: &mut Session) -> Vec<u8> {
    let request = &drawn.request;
    let recipe = |gl| request.recipe(&drawn.scene, beside, gl, |path: &Path| FileRecord::of(path).ok());
    if let Some(format) = format {
        let has_recipe = !format.is_of_lines_alone;
        let recipe = has_recipe.then(|| recipe(None));
        let lines = drawn.drawn_lines(WantedLines::of(format, false), &Progress::default()).unwrap();
        return lines.written(format, None, recipe.as_ref()).unwrap().bytes().unwrap();
    }
    let renderer = request.renderer(session).unwrap();
    let recipe = recipe(Some(Driver::new(renderer.context())));
    drawn.picture(renderer).unwrap().png_bytes(recipe.note().as_ref()).unwrap()
}

/// Draws a row by the command and by the library, and names it if a byte differs.
fn compared(folder: &Folder, session: &mut Session, (model, ending, options): Row) -> Result<(), String> {
    let model = match SHEETS.iter().find(|(name, _)| *name == model) {
        Some((name, text)) => {
            let path = folder.path(&format!("{name}.obj"));
            std::fs::write(&path, text).unwrap();
            path
        }
        None => format!("builtin:{model}"),
    };
    let out = folder.path(&format!("drawing.{ending}"));
    let words = ["render", &model, "-o", &out, "--size", "96x72"].into_iter().chain(options.split(' '));
    let words: Vec<&str> = words.collect();
    done(&words);
    let by_command = std::fs::read(&out).unwrap();
    let words: Vec<String> = ["tinta"].into_iter().chain(words).map(str::to_owned).collect();
    let (request, _) = asked_by(&words).unwrap();
    let format = request.drawing_format(&out).unwrap();
    let read = request.models(&session.models).unwrap();
    // A scene keeps its copies.
    let mut plain = Request::default();
    plain.scene.copies = request.scene.copies;
    let kept = plain.placed(read.meshes.clone()).unwrap();
    let doors = [
        ("resolve", request.resolve(read.meshes, format.is_some()).unwrap()),
        ("resolve_again", request.resolve_again(&kept, format.is_some()).unwrap()),
    ];
    for (door, drawn) in &doors {
        if file(drawn, &read.files, format, session) != by_command {
            return Err(format!("{} by {door}", words[1..].join(" ")));
        }
    }
    Ok(())
}

fn check(rows: impl IntoIterator<Item = Row>, count: usize) {
    let (folder, mut session) = (Folder::new(), Session::for_one());
    let compared: Vec<_> = rows.into_iter().map(|row| compared(&folder, &mut session, row)).collect();
    assert_eq!(compared.len(), count);
    let different: Vec<String> = compared.into_iter().filter_map(Result::err).collect();
    assert!(different.is_empty(), "{different:#?}");
}

#[test]
fn every_door_draws_the_commands_file() {
    check(ROWS, 28);
}

#[test]
fn every_look_and_style_is_the_same_through_every_door() {
    let looks = ["--look print", "--look technical", "--look sketch --grain texture-size=64", "--look published"];
    let styles: Vec<String> =
        StyleName::ALL.iter().filter(|(name, _)| *name != "sand").map(|(name, _)| format!("--style {name}")).collect();
    let mut rows: Vec<Row> = Vec::new();
    for options in looks.into_iter().chain(styles.iter().map(String::as_str)) {
        let options: &'static str = Box::leak(options.to_owned().into_boxed_str());
        let (request, _) = asked_by(
            &format!("tinta render a.obj -o a.png {options}").split(' ').map(str::to_owned).collect::<Vec<_>>(),
        )
        .unwrap();
        let endings = ["png", "svg", "pdf", "json"];
        let count = if request.style.vectors(request.scene.size).is_some() { 4 } else { 1 };
        rows.extend(endings[..count].iter().map(|ending| ("gear", *ending, options)));
    }
    let count = rows.len();
    assert!(count >= 34, "{count}");
    check(rows, count);
}

#[test]
fn a_turn_is_seen_by_its_own_camera_in_the_light_of_its_first_view() {
    let folder = Folder::new();
    let out = folder.path("turn-%d.png");
    let words = ["render", "builtin:bust", "-o", &out, "--size", "96x72", "--look", "print", "--turntable", "3"];
    done(&words);
    let words: Vec<String> = ["tinta"].into_iter().chain(words).map(str::to_owned).collect();
    let (request, _) = asked_by(&words).unwrap();
    let mut session = Session::for_one();
    let scene = request.placed(request.models(&session.models).unwrap().meshes).unwrap();
    let views = request.turn(scene, 3, false).unwrap();
    for (number, view) in (1..).zip(&views) {
        assert_eq!(view.light(), views[0].light());
        let by_command = Picture::read_png(Path::new(&folder.path(&format!("turn-{number}.png")))).unwrap();
        assert!(view.picture(request.renderer(&mut session).unwrap()).unwrap() == by_command, "view {number}");
    }
}
