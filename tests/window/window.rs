//! The viewer: its pictures without a window, and the window itself under Xvfb.

use crate::program::{assert_refused, done, said};
use crate::rendered::rendered;
use crate::support::{BACKENDS, backend_names, root, skip};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use tinta::settings::OptionValue;
use tinta::window::{Layout, Side, Viewer, ViewerEvent, ViewerOptions, ViewerState};
use tinta::{Backend, Picture, Size, Style, StyleName, View};

/// A viewer of these models without a window, at rest.
fn viewer(models: &[&str], backend: Backend, shaders: Option<&Path>) -> Viewer {
    let models = models.iter().map(|model| (*model).to_owned()).collect();
    viewer_of(ViewerState::new(models, Default::default()), backend, shaders)
}

fn viewer_of(mut state: ViewerState, backend: Backend, shaders: Option<&Path>) -> Viewer {
    state.update(ViewerEvent::Resize([160, 120]));
    let options = ViewerOptions {
        state,
        backend,
        shaders: shaders.map(Path::to_path_buf),
        folder: std::env::temp_dir(),
        line_measure: Some(tinta_lab::line_measure()),
    };
    let mut viewer = Viewer::start(options, || {}).unwrap();
    viewer.rest().unwrap();
    viewer
}

fn shown(viewer: &mut Viewer, events: impl IntoIterator<Item = ViewerEvent>) -> Picture {
    events.into_iter().for_each(|event| {
        viewer.event(event);
        assert_eq!(viewer.state.message, None);
    });
    viewer.rest().unwrap();
    assert_eq!(viewer.problem, None);
    viewer.shown().unwrap()
}

fn set(option: &str, value: &str) -> ViewerEvent {
    ViewerEvent::Set(Side::Left, option.to_owned(), value.to_owned())
}

fn style(name: &str) -> ViewerEvent {
    ViewerEvent::Style(Side::Left, name.to_owned())
}

/// Returns the picture of a command line written by the viewer.
fn by_command(command: &str, backend: &str) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    // These commands contain no blanks; colours are quoted.
    let command = command.replace('\'', "");
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    let output = Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(words)
        .args(["--backend", backend])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{command}: {}", said(&output));
    Picture::read_png(&folder.path().join("drawing.png")).unwrap()
}

#[test]
fn the_viewers_picture_is_the_one_its_command_line_draws_byte_for_byte() {
    for (backend, name) in BACKENDS.iter().copied().zip(backend_names()) {
        let mut viewer = viewer(&["builtin:bust"], backend, None);
        let steps: [Vec<ViewerEvent>; 10] = [
            vec![],
            vec![ViewerEvent::Turn([0.3, 0.1])],
            vec![ViewerEvent::Zoom(2.5), ViewerEvent::Move([0.1, -0.2])],
            vec![ViewerEvent::Projection],
            vec![set("--tones", "2"), set("--detection-factor", "0.5")],
            vec![ViewerEvent::Buffer("borders".to_owned())],
            vec![style("inking"), ViewerEvent::Buffer("final".to_owned()), set("--line-width", "3.5")],
            vec![ViewerEvent::Reset, style("charcoal"), ViewerEvent::Background("tan".to_owned())],
            vec![ViewerEvent::Projection, ViewerEvent::Look("print".to_owned())],
            vec![
                ViewerEvent::Zoom(1.5),
                ViewerEvent::Scene("bare-color".to_owned(), "tomato".to_owned()),
                ViewerEvent::Scene("surface".to_owned(), "plain".to_owned()),
            ],
        ];
        for (number, step) in steps.into_iter().enumerate() {
            let picture = shown(&mut viewer, step);
            let command = viewer.commands().remove(0).unwrap();
            let drawn = by_command(&command, name);
            let difference = drawn.difference(&picture.opaque()).unwrap();
            assert_eq!(difference.pixels, 0, "step {number} on {name}: {command}");
        }
    }
}

#[test]
fn a_look_shows_the_first_model_from_where_the_command_draws_it() {
    for (model, elevation_degrees) in [("builtin:bust", 12.0), ("builtin:gear", 23.0)] {
        let mut state = ViewerState::new(vec![model.to_owned()], Default::default());
        state.update(ViewerEvent::Look("print".to_owned()));
        let viewer = viewer_of(state, Backend::Auto, None);
        assert_eq!(viewer.state.orbit.view, View { azimuth_degrees: 30.0, elevation_degrees }, "{model}");
    }
}

#[test]
fn strokes_for_tones_and_lines_on_paper_are_those_of_the_command_line_and_tones_stay_while_the_model_turns() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hatched.toml").display().to_string();
    std::fs::write(&path, "style = \"ink\"\ntone-light = \"auto\"\nhatch = 3\nexact-lines = true\n").unwrap();
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    for (put, title) in
        [(ViewerEvent::OpenPreset(path), "ink+lines"), (ViewerEvent::Look("sketch".to_owned()), "charcoal+lines")]
    {
        let picture = shown(&mut viewer, [put, ViewerEvent::Turn([0.1, 0.05])]);
        assert!(viewer.state.title().contains(title), "{}", viewer.state.title());
        let command = viewer.commands().remove(0).unwrap();
        let drawn = by_command(&command, "auto");
        assert_eq!(drawn.difference(&picture.opaque()).unwrap().pixels, 0, "{command}");
        viewer.is_moving = true;
        viewer.event(ViewerEvent::Turn([0.1, 0.0]));
        viewer.ask();
        while !viewer.is_asked() {
            viewer.wait().unwrap();
            viewer.ask();
        }
        viewer.is_moving = false;
        viewer.rest().unwrap();
        assert_eq!(viewer.problem, None);
    }
}

#[test]
fn a_shader_that_does_not_compile_shows_its_log_and_the_one_before_stays() {
    let folder = tempfile::tempdir().unwrap();
    let glsl = root().join("glsl");
    std::fs::create_dir(folder.path().join("evangelista")).unwrap();
    let file = folder.path().join("evangelista/toon.frag");
    let published = std::fs::read_to_string(glsl.join("evangelista/toon.frag")).unwrap();
    std::fs::write(&file, &published).unwrap();
    let mut viewer = viewer(&["builtin:open-box"], Backend::Auto, Some(folder.path()));
    let before = shown(&mut viewer, []);
    assert_eq!(viewer.shader_log, None);

    std::fs::write(&file, published.replace("void main", "void mian(")).unwrap();
    while viewer.shader_log.is_none() {
        viewer.wait().unwrap();
    }
    let log = viewer.shader_log.clone().unwrap();
    assert!(log.contains("evangelista/toon.frag") && log.len() > 60, "{log}");
    assert_eq!(shown(&mut viewer, [ViewerEvent::Turn([0.2, 0.0]), ViewerEvent::Turn([-0.2, 0.0])]), before);

    let end = published.rfind('}').unwrap();
    let red = format!("{}\n    gl_FragColor.gb *= 0.5;\n}}\n", &published[..end]);
    std::fs::write(&file, red).unwrap();
    while viewer.shader_log.is_some() {
        viewer.wait().unwrap();
    }
    let redder = shown(&mut viewer, []);
    assert!(redder.difference(&before).unwrap().pixels > 1000);
}

#[test]
fn a_border_shader_that_inks_all_of_the_picture_is_not_confined_to_the_objects() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("evangelista")).unwrap();
    let all_ink = "#version 120\nvoid main() { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); }\n";
    std::fs::write(folder.path().join("evangelista/border.frag"), all_ink).unwrap();
    for backend in *BACKENDS {
        let mut viewer = viewer(&["builtin:gear"], backend, Some(folder.path()));
        let picture = shown(&mut viewer, [ViewerEvent::Zoom(0.3)]);
        let inked = picture.pixels.chunks_exact(4).filter(|pixel| **pixel == [0, 0, 0, u8::MAX]).count();
        assert_eq!(inked, picture.size.pixel_count(), "--full inks all of it");
    }
}

#[test]
fn a_model_is_read_again_when_its_file_changes_and_what_cannot_be_read_leaves_the_last_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.obj");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::fs::write(&file, triangle).unwrap();
    let mut viewer = viewer(&[file.to_str().unwrap()], Backend::Auto, None);
    assert_eq!(viewer.triangle_count(), Some(1));
    let turned = shown(&mut viewer, [ViewerEvent::Turn([0.05, 0.0])]);
    let orbit = viewer.state.orbit.clone();

    std::fs::write(&file, format!("{triangle}v 1 1 0\nf 2 4 3\n")).unwrap();
    while viewer.triangle_count() == Some(1) {
        viewer.wait().unwrap();
    }
    assert_eq!((viewer.triangle_count(), &viewer.state.orbit), (Some(2), &orbit), "the view stays");
    assert_ne!(shown(&mut viewer, []), turned);

    viewer.event(ViewerEvent::Open(vec![folder.path().join("none.obj").display().to_string()]));
    viewer.rest().unwrap();
    assert!(viewer.problem.as_ref().unwrap().contains("none.obj"), "{:?}", viewer.problem);
    assert_eq!(viewer.triangle_count(), Some(2));
    assert!(viewer.shown().is_some());
}

#[test]
fn a_model_is_stood_up_in_the_window_and_the_command_says_so() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    let before = viewer.shown().unwrap();
    let up = |axis: &str| ViewerEvent::Model("--up-axis".to_owned(), axis.to_owned());
    let turned = shown(&mut viewer, [up("z")]);
    assert_ne!(turned, before);
    let command = viewer.commands().remove(0).unwrap();
    assert!(command.contains("--up-axis z"), "{command}");
    assert_eq!(turned.difference(&by_command(&command, "auto")).unwrap().pixels, 0);
    assert_eq!(shown(&mut viewer, [ViewerEvent::ModelDefault("--up-axis".to_owned())]), before);
    // An unreadable choice keeps the last model and its command.
    viewer.event(ViewerEvent::Model("--skin".to_owned(), "/nowhere.png".to_owned()));
    viewer.rest().unwrap();
    assert!(viewer.problem.as_ref().is_some_and(|problem| problem.contains("nowhere.png")), "{:?}", viewer.problem);
    assert!(!viewer.commands().remove(0).unwrap().contains("nowhere"));
}

#[test]
fn a_picture_that_cannot_be_drawn_is_a_sentence_and_the_next_one_is_drawn() {
    let mut viewer = viewer(&["builtin:ant"], Backend::Auto, None);
    let before = viewer.shown().unwrap();
    viewer.event(style("sand"));
    viewer.rest().unwrap();
    assert!(viewer.problem.as_ref().unwrap().contains("--style charcoal"), "{:?}", viewer.problem);
    assert_eq!(shown(&mut viewer, [style("three-pass")]), before);
}

#[test]
fn prices_are_the_passes_times_and_the_lines_error_of_this_view() {
    let mut viewer = viewer(&["builtin:open-box"], Backend::Auto, None);
    shown(&mut viewer, [ViewerEvent::Price, ViewerEvent::Layout(Layout::Split)]);
    let [left, right] = &viewer.costs.sides[..] else { panic!("two sides") };
    assert_eq!(left.passes.iter().map(|pass| pass.name).collect::<Vec<_>>(), ["map", "tones", "border"]);
    assert_eq!((left.style, right.style), ("three-pass", "inking"));
    let f1 = |side: &tinta::window::SideCost| side.error.as_ref().unwrap().f1;
    assert!(f1(left) > 0.5 && f1(right) > 0.8, "{} {}", f1(left), f1(right));
    assert_eq!(viewer.costs.history.len(), 2);
    // The plot's times are those that are written above it.
    for (side, point) in viewer.costs.sides.iter().zip(&viewer.costs.history) {
        assert_eq!((side.style, side.frame_ms), (point.style, point.ms));
        assert!(side.frame_ms > 0.0);
    }
    shown(&mut viewer, [ViewerEvent::Turn([0.1, 0.0])]);
    assert_eq!(viewer.costs.history.len(), 2, "of the new view only");
}

#[test]
fn files_saved_from_the_viewer_are_those_its_commands_write() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = saving_viewer("builtin:open-box", folder.path());
    viewer.event(ViewerEvent::Resize([96, 80]));
    viewer.event(set("--tones", "2"));
    viewer.rest().unwrap();
    for (event, name) in [
        (ViewerEvent::SavePicture, "open-box-three-pass.png"),
        (ViewerEvent::SaveLines, "open-box-three-pass.svg"),
        (ViewerEvent::SaveTurn, "open-box-three-pass.gif"),
        (ViewerEvent::SavePreset, "open-box-three-pass.toml"),
    ] {
        let message = saved(&mut viewer, event);
        assert!(message.contains(name) && !message.contains("no command"), "{message}");
        let saved = std::fs::read(folder.path().join(name)).unwrap();
        let Some((_, command)) = message.split_once("; the same by tinta ") else { continue };
        let again = command.replace(name, &format!("again-{name}"));
        let words = again.split(' ').chain(["--backend", "egl"]).filter(|word| !word.is_empty());
        let lines = name.ends_with("svg");
        let words: Vec<&str> = words.take_while(|word| !(lines && *word == "--backend")).collect();
        done(&words);
        let again = std::fs::read(folder.path().join(format!("again-{name}"))).unwrap();
        match name.rsplit_once('.').unwrap().1 {
            "png" => {
                let read = |name: &str| Picture::read_png(&folder.path().join(name)).unwrap();
                assert_eq!(read(name), read(&format!("again-{name}")));
            }
            "gif" => assert_eq!(saved, again),
            // The SVG carries the command, and from the command line a recipe, too.
            _ => {
                let paths = |bytes: &[u8]| {
                    let text = String::from_utf8(bytes.to_vec()).unwrap();
                    text.lines().filter(|line| line.starts_with("<path")).map(str::to_owned).collect::<Vec<_>>()
                };
                assert!(!paths(&saved).is_empty());
                assert_eq!(paths(&saved), paths(&again));
            }
        }
    }
    let preset = std::fs::read_to_string(folder.path().join("open-box-three-pass.toml")).unwrap();
    assert!(preset.contains("style = \"three-pass\"\ntones = 2"), "{preset}");
}

/// An idle viewer of this model that saves files into this folder.
fn saving_viewer(model: &str, folder: &Path) -> Viewer {
    let options = ViewerOptions {
        state: ViewerState::new(vec![model.to_owned()], Default::default()),
        backend: Backend::Auto,
        shaders: None,
        folder: folder.to_path_buf(),
        line_measure: Some(tinta_lab::line_measure()),
    };
    let mut viewer = Viewer::start(options, || {}).unwrap();
    viewer.event(ViewerEvent::Resize([160, 120]));
    viewer.rest().unwrap();
    viewer
}

/// The message after saving this.
fn saved(viewer: &mut Viewer, event: ViewerEvent) -> String {
    viewer.event(event);
    while viewer.state.message.as_deref() == Some("saving") {
        viewer.wait().unwrap();
    }
    viewer.state.message.clone().unwrap()
}

#[test]
fn lines_tones_areas_and_sheets_are_saved_byte_for_byte_as_the_command_line_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("b o x.obj");
    std::fs::copy(root().join("models/open-box.obj"), &file).unwrap();
    let lines = |option: &str, value: &str| ViewerEvent::Lines(option.to_owned(), value.to_owned());
    for model in ["builtin:gear", file.to_str().unwrap()] {
        let mut viewer = saving_viewer(model, folder.path());
        let steps: [Vec<ViewerEvent>; 7] = [
            // Tones.
            vec![],
            vec![style("ink"), ViewerEvent::Turn([0.1, 0.0])],
            vec![ViewerEvent::Overlay(Side::Left, true), lines("--hidden", "dashed"), ViewerEvent::Turn([0.3, 0.1])],
            vec![style("lines"), lines("--class-colors", "outline=red,crease=royalblue"), ViewerEvent::Zoom(1.5)],
            vec![ViewerEvent::Look("technical".to_owned()), ViewerEvent::Background("tan".to_owned())],
            vec![style("lines")],
            vec![style("lines")],
        ];
        for (number, step) in steps.into_iter().enumerate() {
            shown(&mut viewer, step);
            // As a preset or an option of `tinta view` sets them.
            if let Some((option, value)) = [("areas", "face"), ("sheet", "third")].get(number.wrapping_sub(5)) {
                let options = [((*option).to_owned(), OptionValue::text(*value))].into();
                viewer.state.put_style(Side::Left, Style::with_options(StyleName::Lines, &options).unwrap());
                shown(&mut viewer, []);
            }
            let message = saved(&mut viewer, ViewerEvent::SaveLines);
            let parts = message.strip_prefix("saved ").and_then(|message| message.split_once("; the same by "));
            let (name, command) = parts.unwrap_or_else(|| panic!("{model} {number}: {message}"));
            let again = folder.path().join("again.svg");
            let command = command.replace(name, again.to_str().unwrap()).replace("tinta ", "exec \"$0\" ");
            let output = Command::new("sh").args(["-c", &command, env!("CARGO_BIN_EXE_tinta")]).output().unwrap();
            assert!(output.status.success(), "{command}: {}", said(&output));
            let [saved, again] = [Path::new(name), &again].map(|path| std::fs::read_to_string(path).unwrap());
            assert!(saved.contains("<path"), "{model} {number}");
            assert_eq!(saved.contains("id=\"fill-"), [0, 1, 2, 5].contains(&number), "{model} {number}");
            assert!(saved == again, "{model} {number}: {command}");
        }
    }
}

#[test]
fn lines_in_the_window_are_the_files_lines_as_another_program_draws_them() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = saving_viewer("builtin:gear", folder.path());
    for hidden in ["none", "dashed", "ghost"] {
        let set = ViewerEvent::Lines("--hidden".to_owned(), hidden.to_owned());
        let picture = shown(&mut viewer, [style("lines"), set]);
        let message = saved(&mut viewer, ViewerEvent::SaveLines);
        let name = message.strip_prefix("saved ").unwrap().split_once("; ").unwrap().0;
        let pixels = rendered(&std::fs::read_to_string(name).unwrap(), 1.0);
        let size = Size { width: pixels.width(), height: pixels.height() };
        let other = Picture { size, pixels: pixels.take() };
        assert_eq!(picture.size, other.size);
        let ink = |picture: &Picture| {
            picture.pixels.chunks_exact(4).map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).collect::<Vec<_>>()
        };
        let [ours, theirs] = [ink(&picture), ink(&other)];
        let all: f64 = theirs.iter().sum();
        assert!(all > 500.0, "{hidden}: {all}");
        // A quarter of a pixel aside would be a quarter of the ink.
        let elsewhere: f64 = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).sum();
        assert!(elsewhere < 0.05 * all, "{hidden}: {elsewhere} of {all} pixels of ink are elsewhere");
    }
}

#[test]
fn lines_over_a_picture_darken_it_where_they_are_and_go_when_they_are_taken_away() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    // Exact lines take the place of the style's own.
    let plain = shown(&mut viewer, [set("--no-borders", "on")]);
    let with_borders = shown(&mut viewer, [set("--no-borders", "off")]);
    assert_ne!(plain, with_borders);
    let over = shown(&mut viewer, [ViewerEvent::Overlay(Side::Left, true)]);
    let alone = shown(&mut viewer, [style("lines")]);
    let is_white = |pixel: &[u8]| pixel == [255; 4];
    let pixels = |picture: &Picture| picture.pixels.chunks_exact(4).map(<[u8]>::to_vec).collect::<Vec<_>>();
    let mut inked = 0;
    for ((plain, over), alone) in pixels(&plain).iter().zip(&pixels(&over)).zip(&pixels(&alone)) {
        if is_white(alone) {
            assert_eq!(plain, over, "nothing is drawn where no line is");
        }
        inked += usize::from(plain != over);
    }
    assert!(inked > 300, "{inked}");
    assert_eq!(shown(&mut viewer, [style("three-pass")]), with_borders);
    // On one side of a split alone.
    let split = shown(&mut viewer, [ViewerEvent::Layout(Layout::Difference), style("lines")]);
    assert_ne!(split, alone);
    let beside =
        shown(&mut viewer, [ViewerEvent::Layout(Layout::Split), ViewerEvent::Style(Side::Right, "lines".to_owned())]);
    assert_eq!(beside, alone, "lines on both sides are one picture");
}

#[test]
fn while_the_model_turns_lines_are_only_shown_over_the_picture_of_their_view() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    shown(&mut viewer, [ViewerEvent::Overlay(Side::Left, true)]);
    let mut with_lines = std::collections::HashSet::new();
    for _ in 0..40 {
        viewer.event(ViewerEvent::Turn([0.01, 0.005]));
        viewer.ask();
        while !viewer.is_asked() {
            viewer.wait().unwrap();
            viewer.ask();
        }
        with_lines.insert(viewer.shown().unwrap().pixels);
    }
    viewer.rest().unwrap();
    let last = viewer.shown().unwrap();
    let expected = {
        let mut still = self::viewer(&["builtin:gear"], Backend::Auto, None);
        let turns = (0..40).map(|_| ViewerEvent::Turn([0.01, 0.005]));
        shown(&mut still, turns.chain([ViewerEvent::Overlay(Side::Left, true)]))
    };
    assert_eq!(last, expected);
    assert!(with_lines.len() > 1);
}

#[test]
fn lines_by_themselves_follow_the_model_while_it_turns() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    shown(&mut viewer, [style("lines")]);
    let mut seen = std::collections::HashSet::new();
    for _ in 0..12 {
        viewer.event(ViewerEvent::Turn([0.02, 0.01]));
        viewer.ask();
        while !viewer.is_asked() {
            viewer.wait().unwrap();
            viewer.ask();
        }
        seen.insert(viewer.shown().unwrap().pixels);
    }
    // Each view's lines are begun when those of the one before have been found.
    assert!(seen.len() > 8, "{}", seen.len());
}

#[test]
fn pictures_are_coarser_while_the_model_moves_only_if_that_is_allowed_and_never_at_rest() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    let blocks = |picture: &Picture| {
        let row = picture.size.width as usize * 4;
        let rows: Vec<&[u8]> = picture.pixels.chunks_exact(row).collect();
        let is_wide = |row: &[u8]| row.chunks_exact(8).all(|pair| pair[..4] == pair[4..]);
        rows.chunks_exact(2).all(|pair| pair[0] == pair[1] && is_wide(pair[0]))
    };
    let turn = || [ViewerEvent::Turn([0.1, 0.05])];
    let fine = shown(&mut viewer, turn());
    viewer.is_moving = true;
    assert!(!blocks(&shown(&mut viewer, turn())), "not asked for");
    let coarse = shown(&mut viewer, [ViewerEvent::Coarse(true), turn()[0].clone()]);
    assert!(blocks(&coarse) && coarse.size == fine.size);
    let colors = |picture: &Picture| {
        picture.pixels.chunks_exact(4).map(<[u8]>::to_vec).collect::<std::collections::HashSet<_>>()
    };
    assert!(colors(&coarse).len() > 3, "something is drawn");
    let saved = saved(&mut viewer, ViewerEvent::SavePicture);
    assert!(saved.contains("wait"), "{saved}");
    viewer.is_moving = false;
    let last = shown(&mut viewer, []);
    assert!(!blocks(&last));
    assert_eq!(last.difference(&by_command(&viewer.commands().remove(0).unwrap(), "auto")).unwrap().pixels, 0);
    // A full picture is not drawn again.
    viewer.is_moving = true;
    assert_eq!(shown(&mut viewer, []), last);
}

#[test]
fn lines_that_cannot_be_are_a_sentence_and_the_next_ones_are_drawn() {
    let mut viewer = viewer(&["builtin:gear"], Backend::Auto, None);
    shown(&mut viewer, [style("lines")]);
    viewer.event(ViewerEvent::Lines("--line-width".to_owned(), "2mm".to_owned()));
    viewer.rest().unwrap();
    assert!(viewer.lines.problem().is_some_and(|problem| problem.contains("mm")), "{:?}", viewer.lines.problem());
    viewer.event(ViewerEvent::LinesDefault("--line-width".to_owned()));
    viewer.rest().unwrap();
    assert_eq!(viewer.lines.problem(), None);
}

#[test]
fn a_turn_of_lines_and_a_preset_of_them_are_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = saving_viewer("builtin:open-box", folder.path());
    shown(&mut viewer, [ViewerEvent::Resize([48, 40]), style("lines"), set("--hidden", "dashed")]);
    let turn = saved(&mut viewer, ViewerEvent::SaveTurn);
    assert!(turn.contains("open-box-lines.gif; no command"), "{turn}");
    assert!(std::fs::read(folder.path().join("open-box-lines.gif")).unwrap().starts_with(b"GIF89a"));
    let preset = saved(&mut viewer, ViewerEvent::SavePreset);
    assert!(preset.contains("open-box-lines.toml"), "{preset}");
    let path = folder.path().join("open-box-lines.toml").to_str().unwrap().to_owned();
    let file = folder.path().join("box.svg");
    done(&["render", "builtin:open-box", "--preset", &path, "-o", file.to_str().unwrap()]);
    assert!(std::fs::read_to_string(file).unwrap().contains("stroke-dasharray"));
}

#[test]
fn in_a_split_both_styles_are_saved_under_their_own_names_and_no_file_twice() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = saving_viewer("builtin:open-box", folder.path());
    let right = ViewerEvent::Style(Side::Right, "phong".to_owned());
    let events = [ViewerEvent::Resize([48, 40]), ViewerEvent::Layout(Layout::Split), right];
    shown(&mut viewer, events);
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    // The second request comes while the first file is being written.
    for event in [ViewerEvent::SaveTurn, ViewerEvent::SaveTurn, ViewerEvent::SavePreset, ViewerEvent::SavePicture] {
        viewer.event(event);
    }
    drop(viewer);
    let names = ["open-box-three-pass.gif", "open-box-phong.gif", "open-box-three-pass-2.gif", "open-box-phong-2.gif"];
    let [left, right, left_again, right_again] = names.map(read);
    assert!(left.starts_with(b"GIF89a") && right.starts_with(b"GIF89a"));
    assert_ne!(left, right);
    assert_eq!((left, right), (left_again, right_again));
    for style in ["three-pass", "phong"] {
        let preset = String::from_utf8(read(&format!("open-box-{style}.toml"))).unwrap();
        assert!(preset.contains(&format!("style = \"{style}\"")), "{preset}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), names.len() + 2 + 1);
    assert!(folder.path().join("open-box-three-pass-phong.png").exists());
}

/// A separate display; ends with this value.
pub struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// Starts Xvfb; prints a message where it is missing.
    pub fn start() -> Option<Self> {
        let started = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x960x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let Ok(mut server) = started else {
            skip("the window: there is no Xvfb; on Debian: apt-get install xvfb");
            return None;
        };
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        Some(Self { server, name: format!(":{}", number.trim()) })
    }

    /// Runs `tinta view` on it.
    pub fn view(&self, arguments: &[&str]) -> Output {
        self.view_at(1, arguments)
    }

    /// Runs it on a screen with so many pixels to a point.
    pub fn view_at(&self, scale: u32, arguments: &[&str]) -> Output {
        view(&[("DISPLAY", &self.name), ("WINIT_X11_SCALE_FACTOR", &scale.to_string())], arguments)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn view(environment: &[(&str, &str)], arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tinta"))
        .arg("view")
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .envs(environment.iter().copied())
        .output()
        .unwrap()
}

#[test]
fn a_drag_in_the_window_and_a_preset_lead_to_the_picture_that_tinta_render_draws() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(here("a.toml"), "tones = 1\nfilter = \"sobel\"\n").unwrap();
    let mut recording = "{\"frame\":0,\"event\":{\"resize\":[160,120]}}\n".to_owned();
    (1..=24).for_each(|frame| {
        recording += &format!("{{\"frame\":{frame},\"event\":{{\"turn\":[0.125,0.0]}},\"drag\":true}}\n");
    });
    recording += &format!("{{\"frame\":25,\"screenshot\":{:?}}}\n", here("turned.png"));
    std::fs::write(here("drag.jsonl"), recording).unwrap();
    let output =
        display.view(&["builtin:bust", "--preset", &here("a.toml"), "--replay", &here("drag.jsonl"), "--json"]);
    assert!(output.status.success(), "{}", said(&output));
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let shown = record["drag_frame_ms"]["all"].as_array().unwrap().len();
    assert!((1..=24).contains(&shown), "{shown} pictures were shown during the drag");
    // 24 eighths of a height are three half turns.
    let azimuth = View::DEFAULT.azimuth_degrees - 540.0;
    let view = format!("--view={azimuth},{}", View::DEFAULT.elevation_degrees);
    let out = here("drawn.png");
    done(&["render", "builtin:bust", "-o", &out, "--preset", &here("a.toml"), &view, "--size", "160x120"]);
    let read = |name: &str| Picture::read_png(&folder.path().join(name)).unwrap();
    assert_eq!(read("drawn.png").difference(&read("turned.png")).unwrap().pixels, 0);
}

#[test]
fn a_window_is_no_larger_than_its_screen() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name).display().to_string();
    // The screen has 1280 x 960 pixels.
    for (scale, size, expected) in
        [(2, "1280x720", [1280, 960]), (1, "1280x720", [1280, 720]), (2, "320x200", [640, 400])]
    {
        let recording = format!("{{\"frame\":1,\"window\":{:?}}}\n", here("window.png"));
        std::fs::write(here("shot.jsonl"), recording).unwrap();
        let line = ["builtin:gear", "--window", size, "--replay", &here("shot.jsonl")];
        let output = display.view_at(scale, &line);
        assert!(output.status.success(), "{}", said(&output));
        let Size { width, height } = Picture::read_png(&folder.path().join("window.png")).unwrap().size;
        assert_eq!([width, height], expected, "{size} at scale {scale}");
    }
}

#[test]
fn while_the_model_turns_no_older_picture_is_shown_after_a_newer_one() {
    let turn = || ViewerEvent::Turn([0.01, 0.005]);
    let mut one_by_one = viewer(&["builtin:gear"], Backend::Auto, None);
    let pictures: Vec<Picture> = (0..60).map(|_| shown(&mut one_by_one, [turn()])).collect();
    let mut turning = viewer(&["builtin:gear"], Backend::Auto, None);
    let mut seen = Vec::new();
    for _ in 0..60 {
        turning.event(turn());
        turning.ask();
        while !turning.is_asked() {
            turning.wait().unwrap();
            turning.ask();
        }
        seen.extend(turning.shown());
    }
    turning.rest().unwrap();
    seen.extend(turning.shown());
    seen.dedup();
    assert!(seen.len() > 20, "{} pictures were shown", seen.len());
    let first = seen.remove(0);
    assert!(!pictures.contains(&first), "the first is of the view before the turn");
    let numbers: Vec<usize> =
        seen.iter().map(|seen| pictures.iter().position(|picture| picture == seen).unwrap()).collect();
    assert!(numbers.is_sorted(), "{numbers:?}");
    assert_eq!(numbers.last(), Some(&59));
}

#[test]
fn without_a_display_or_opengl_on_it_there_is_a_sentence_and_exit_code_2() {
    let refused = |output: &Output, words: &[&str]| {
        assert_refused(output, &[words, &["tinta render", "DISPLAY"]].concat());
        assert!(!said(output).contains(".rs:"), "{}", said(output));
    };
    refused(&view(&[], &[]), &["no window can be opened"]);
    refused(&view(&[("DISPLAY", ":4711")], &[]), &["no window can be opened"]);
    refused(&view(&[("WAYLAND_DISPLAY", "nowhere")], &[]), &["no window can be opened"]);
    let Some(display) = Display::start() else { return };
    // A display, but an EGL that knows no driver.
    let nowhere = [("DISPLAY", display.name.as_str()), ("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")];
    refused(&view(&nowhere, &[]), &["no window can be opened"]);
}

#[test]
fn a_recording_that_is_none_is_refused_before_a_window_opens() {
    for (text, words) in [("", "no line"), ("{\"event\": \"jump\"}", "line 1")] {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let output = view(&[], &["--replay", file.path().to_str().unwrap()]);
        let message = said(&output);
        assert_eq!(output.status.code(), Some(2));
        assert!(message.contains("--replay") && message.contains(words), "{message}");
    }
}
