//! Tests of frames without a window: pointer, wheel, keys and dropped files, as egui receives them.

use super::*;
use crate::gl::Backend;
use crate::scene::Size;
use crate::window::{Layout, ViewerOptions, ViewerState};
use egui::{Event, Modifiers, MouseWheelUnit, PointerButton, RawInput};

/// A viewer at rest and the frames that show it, 400 x 324 points.
struct Frames {
    viewer: Viewer,
    context: Context,
    textures: Textures,
}

impl Frames {
    fn new() -> Self {
        let state = ViewerState::new(vec!["builtin:open-box".to_owned()], Default::default());
        let (backend, folder) = (Backend::Auto, std::env::temp_dir());
        let viewer =
            Viewer::start(ViewerOptions { state, backend, shaders: None, folder, line_measure: None }, || {}).unwrap();
        let context = Context::default();
        context.set_fonts(crate::window::values::shown::fonts());
        let mut frames = Self { viewer, context, textures: Textures::default() };
        // egui knows where things are once it has shown them.
        (0..3).for_each(|_| drop(frames.show(Vec::new())));
        frames
    }

    /// Shows a frame with these input events, applies the resulting events, and waits for the picture.
    fn show(&mut self, events: Vec<Event>) -> Vec<ViewerEvent> {
        self.show_with(RawInput { events, ..RawInput::default() })
    }

    fn show_with(&mut self, input: RawInput) -> Vec<ViewerEvent> {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 300.0 + STATUS_HEIGHT)));
        let mut made = Vec::new();
        let _ = self.context.run(RawInput { screen_rect, ..input }, |context| {
            made = frame(context, &self.viewer, &mut self.textures, true);
        });
        made.iter().cloned().for_each(|event| drop(self.viewer.event(event)));
        self.viewer.rest().unwrap();
        made
    }

    /// Presses a button at one place and lets go at another.
    fn drag(&mut self, button: PointerButton, from: Pos2, to: Pos2) -> Vec<ViewerEvent> {
        let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
        self.show(vec![Event::PointerMoved(from)]);
        let mut made = self.show(vec![press(from, true)]);
        // Farther than a click may shake.
        made.extend(self.show(vec![Event::PointerMoved(from.lerp(to, 0.5))]));
        made.extend(self.show(vec![Event::PointerMoved(to)]));
        made.extend(self.show(vec![press(to, false)]));
        made
    }
}

/// A key that is pressed, with the letters that it types.
fn typed(key: egui::Key, text: &str) -> [Event; 2] {
    let modifiers = Modifiers::NONE;
    [Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }, Event::Text(text.to_owned())]
}

/// All texts of a frame.
fn texts(shape: &egui::Shape, found: &mut Vec<String>) {
    match shape {
        egui::Shape::Text(text) => found.push(text.galley.text().to_owned()),
        egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| texts(shape, found)),
        _ => {}
    }
}

#[test]
fn a_path_typed_or_pasted_over_the_picture_goes_into_the_models_field() {
    use egui::Key;
    /// The events without the sizes that an opening panel leaves.
    fn made(frames: &mut Frames, events: &[Event]) -> Vec<ViewerEvent> {
        let made = frames.show(events.to_vec());
        made.into_iter().filter(|event| !matches!(event, ViewerEvent::Resize(_))).collect()
    }
    for has_panel in [false, true] {
        let mut frames = Frames::new();
        frames.viewer.state.has_panel = has_panel;
        (0..2).for_each(|_| drop(frames.show(Vec::new())));
        let opened: Vec<ViewerEvent> = (!has_panel).then_some(ViewerEvent::Panel).into_iter().collect();
        let first = [typed(Key::Slash, "/"), typed(Key::H, "h"), typed(Key::Q, "q")].concat();
        assert_eq!(made(&mut frames, &first), opened, "a quick hand types several letters in a frame");
        for (key, text) in [(Key::Slash, "/"), (Key::Num2, "2"), (Key::Q, "q"), (Key::Period, ".obj")] {
            assert_eq!(made(&mut frames, &typed(key, text)), [], "{text}");
        }
        let entered = made(&mut frames, &typed(Key::Enter, "")[..1]);
        assert_eq!(entered, [ViewerEvent::Open(vec!["/hq/2q.obj".to_owned()])]);
        assert!(frames.viewer.state.has_panel);
        // Now letters are keys again.
        assert_eq!(made(&mut frames, &typed(Key::P, "p")), [ViewerEvent::Projection]);
        assert_eq!(made(&mut frames, &[Event::Paste("models/x.ply".to_owned())]), []);
        let entered = made(&mut frames, &typed(Key::Enter, "")[..1]);
        assert_eq!(entered, [ViewerEvent::Open(vec!["models/x.ply".to_owned()])]);
    }
}

#[test]
fn status_and_times_tell_the_same_time_of_what_is_shown() {
    let mut frames = Frames::new();
    frames.viewer.event(ViewerEvent::Price);
    for buffer in ["final", "map"] {
        frames.viewer.event(ViewerEvent::Buffer(buffer.to_owned()));
        frames.viewer.rest().unwrap();
        let cost = frames.viewer.costs.sides[0].clone();
        assert_eq!(cost.passes.len(), if buffer == "map" { 1 } else { 3 }, "{buffer}");
        let mut found = Vec::new();
        // A sheet is measured before it is shown.
        for _ in 0..3 {
            let output = frames.context.run(RawInput::default(), |context| {
                frame(context, &frames.viewer, &mut frames.textures, false);
            });
            output.shapes.iter().for_each(|clipped| texts(&clipped.shape, &mut found));
        }
        for said in
            [format!("three-pass {:.0} ms", cost.frame_ms), format!("three-pass: {:.1} ms a frame", cost.frame_ms)]
        {
            assert!(found.iter().any(|text| text.contains(&said)), "{said}: {found:?}");
        }
    }
}

#[test]
fn the_area_is_what_the_window_leaves_it() {
    let frames = Frames::new();
    assert_eq!([frames.viewer.state.area.width, frames.viewer.state.area.height], [400, 300]);
    assert_eq!(frames.viewer.shown().unwrap().size, frames.viewer.state.area);
}

#[test]
fn the_hint_goes_with_the_first_drag_and_what_the_panel_takes_is_known_before_it_is_shown() {
    let mut frames = Frames::new();
    (frames.viewer.state.has_panel, frames.viewer.state.has_hint) = (true, true);
    let [panel, status] = taken(&frames.viewer.state, 400.0);
    (0..3).for_each(|_| drop(frames.show(Vec::new())));
    let area = frames.viewer.state.area;
    assert_eq!([area.width as f32, area.height as f32], [400.0 - panel, 300.0 + STATUS_HEIGHT - status]);
    assert!(frames.viewer.state.has_hint, "nothing was done yet");
    frames.drag(PointerButton::Primary, Pos2::new(20.0, 100.0), Pos2::new(50.0, 100.0));
    assert!(!frames.viewer.state.has_hint);
}

#[test]
fn a_small_window_keeps_most_of_its_width_for_the_picture() {
    for (window, panel) in [(400.0, 220.0), (640.0, 230.0), (800.0, 288.0), (1280.0, 300.0)] {
        assert_eq!(panel_width(window), panel);
    }
}

#[test]
fn a_long_row_of_the_key_sheet_is_broken_between_words() {
    let all: Vec<String> = crate::keys::sheet(false).map(|(_, what)| what).collect();
    assert!(all.iter().any(|what| broken(what).contains('\n')), "one is long");
    for what in all {
        assert_eq!(broken(&what).replace('\n', " "), what);
        assert!(broken(&what).lines().all(|line| line.chars().count() <= LINE_LETTERS), "{what}");
    }
}

#[test]
fn a_drag_turns_and_one_with_the_other_button_moves() {
    let mut frames = Frames::new();
    let before = frames.viewer.state.orbit.view.azimuth_degrees;
    let made = frames.drag(PointerButton::Primary, Pos2::new(100.0, 100.0), Pos2::new(130.0, 100.0));
    assert!(made.iter().all(|event| matches!(event, ViewerEvent::Turn(_))), "{made:?}");
    // 30 of 300 points are a tenth of 180 degrees.
    assert!((before - frames.viewer.state.orbit.view.azimuth_degrees - 18.0).abs() < 1e-3);
    frames.drag(PointerButton::Secondary, Pos2::new(100.0, 100.0), Pos2::new(100.0, 160.0));
    assert!((frames.viewer.state.orbit.pan[1] - 0.2).abs() < 1e-6, "{:?}", frames.viewer.state.orbit.pan);
}

#[test]
fn the_divider_follows_a_drag_that_begins_on_it_and_the_model_does_not_turn() {
    let mut frames = Frames::new();
    frames.viewer.event(ViewerEvent::Layout(Layout::Split));
    (0..2).for_each(|_| drop(frames.show(Vec::new())));
    let made = frames.drag(PointerButton::Primary, Pos2::new(200.0, 80.0), Pos2::new(120.0, 90.0));
    assert!(!made.is_empty() && made.iter().all(|event| matches!(event, ViewerEvent::Divide(_))), "{made:?}");
    assert!((frames.viewer.state.divider - 0.3).abs() < 1e-6, "{}", frames.viewer.state.divider);
}

#[test]
fn the_wheel_brings_the_model_nearer() {
    let mut frames = Frames::new();
    frames.show(vec![Event::PointerMoved(Pos2::new(150.0, 150.0))]);
    let delta = Vec2::new(0.0, 60.0);
    frames.show(vec![Event::MouseWheel { unit: MouseWheelUnit::Point, delta, modifiers: Modifiers::NONE }]);
    (0..20).for_each(|_| drop(frames.show(Vec::new())));
    let zoom = frames.viewer.state.orbit.zoom;
    assert!(zoom > 1.05 && zoom < 1.5, "{zoom}");
}

#[test]
fn keys_switch_styles_and_a_dropped_file_is_opened() {
    let mut frames = Frames::new();
    let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    frames.show(vec![key(egui::Key::Num5)]);
    assert_eq!(frames.viewer.state.style(Side::Left).name(), "inking");
    let path = Some("builtin:gear".into());
    let dropped_files = vec![egui::DroppedFile { path, ..Default::default() }];
    let made = frames.show_with(RawInput { dropped_files, ..RawInput::default() });
    assert_eq!(made, [ViewerEvent::Open(vec!["builtin:gear".to_owned()])]);
    assert_eq!(frames.viewer.state.models, ["builtin:gear"]);
}

#[test]
fn a_dropped_preset_is_put_on_the_active_side_and_one_that_cannot_be_read_is_a_sentence() {
    let mut frames = Frames::new();
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    std::fs::write(file.path(), "style = \"two-pass\"\ntones = 1\n").unwrap();
    let drop = |path: &Path| RawInput {
        dropped_files: vec![egui::DroppedFile { path: Some(path.to_owned()), ..Default::default() }],
        ..RawInput::default()
    };
    frames.show_with(drop(file.path()));
    assert_eq!((frames.viewer.state.style(Side::Left).name(), &frames.viewer.state.message), ("two-pass", &None));
    assert_eq!(frames.viewer.state.models, ["builtin:open-box"]);
    std::fs::write(file.path(), "filter = \"prewitt\"\n").unwrap();
    frames.show_with(drop(file.path()));
    let message = frames.viewer.state.message.clone().unwrap();
    assert!(message.contains(".toml") && message.contains("prewitt"), "{message}");
    assert_eq!(frames.viewer.state.style(Side::Left).name(), "two-pass");
}

#[test]
fn a_frame_in_which_nothing_happens_makes_no_event_and_asks_for_no_other() {
    let mut frames = Frames::new();
    for event in [ViewerEvent::Panel, ViewerEvent::KeySheet, ViewerEvent::Price] {
        frames.viewer.event(event);
    }
    frames.context.all_styles_mut(|style| style.animation_time = 0.0);
    (0..6).for_each(|_| drop(frames.show(Vec::new())));
    assert_eq!(frames.show(Vec::new()), []);
    let number = frames.viewer.picture_number;
    let output = frames.context.run(RawInput::default(), |context| {
        drop(frame(context, &frames.viewer, &mut frames.textures, false));
    });
    let delay = output.viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert!(delay > Duration::from_secs(60), "{delay:?}");
    assert_eq!(frames.viewer.picture_number, number);
}

#[test]
fn a_width_with_a_unit_and_colours_by_class_have_widgets_that_change_nothing_by_themselves() {
    let mut frames = Frames::new();
    let lines = |option: &str, value: &str| ViewerEvent::Lines(option.to_owned(), value.to_owned());
    let style = ViewerEvent::Style(Side::Left, "lines".to_owned());
    for event in [ViewerEvent::Panel, style, lines("--line-width", "0.5%"), lines("--class-colors", "crease=red")] {
        frames.viewer.event(event);
    }
    frames.context.all_styles_mut(|style| style.animation_time = 0.0);
    (0..3).for_each(|_| drop(frames.show(Vec::new())));
    assert_eq!(frames.show(Vec::new()), [], "what is shown is what there is");
    assert_eq!(frames.viewer.lines.problem(), None);
}

#[test]
fn the_pixel_under_the_pointer_is_explained_until_w_or_esc_closes_it() {
    let mut frames = Frames::new();
    let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let point = |x, y| vec![Event::PointerMoved(Pos2::new(x, y))];
    assert_eq!(frames.show(point(200.0, 150.0)), [], "nothing is asked before");
    assert_eq!(frames.show(vec![key(egui::Key::W)]), [ViewerEvent::Explain]);
    assert_eq!(frames.show(Vec::new()), [ViewerEvent::Point(Side::Left, [200, 150])]);
    let answer = frames.viewer.explained.answer().unwrap().as_ref().unwrap();
    assert_eq!(answer.pixel, [200, 150]);
    let same_as_the_library = crate::pixel::Explanation::without_lines(
        frames.viewer.state.style(Side::Left),
        &frames.viewer.job().unwrap().scene().unwrap(),
        &mut crate::Renderer::new(Backend::Auto).unwrap(),
        glam::DVec2::new(200.0, 150.0),
    );
    assert_eq!(answer.to_string(), same_as_the_library.unwrap().to_string());
    assert_eq!(frames.show(point(210.0, 150.0)), [ViewerEvent::Point(Side::Left, [210, 150])]);
    frames.show(point(1.0, 1.0));
    assert!(frames.viewer.explained.answer().unwrap().as_ref().unwrap_err().contains("background"));
    assert_eq!(frames.show(vec![key(egui::Key::N)]), [ViewerEvent::Pass(1)]);
    assert_eq!(frames.show(vec![key(egui::Key::Escape)]), [ViewerEvent::Explain]);
    assert_eq!(frames.show(point(205.0, 150.0)), []);
    assert!(frames.viewer.explained.answer().is_none());
}

#[test]
fn a_place_is_a_pixel_of_the_side_that_is_shown_there() {
    let state =
        |layout| ViewerState { layout, area: Size { width: 302, height: 100 }, divider: 0.5, ..Default::default() };
    let at = |layout, x, y| pixel_at(&state(layout), [x, y]);
    assert_eq!(at(Layout::Single, 301.5, 99.0), Some((Side::Left, [301, 99])));
    assert_eq!(at(Layout::Single, 302.0, 99.0), None);
    assert_eq!(at(Layout::Single, -0.5, 9.0), None);
    assert_eq!(at(Layout::Split, 150.9, 0.0), Some((Side::Left, [150, 0])));
    assert_eq!(at(Layout::Split, 151.0, 0.0), Some((Side::Right, [151, 0])));
    let panes = state(Layout::Difference).panes();
    assert_eq!(at(Layout::Difference, f64::from(panes[1].left) + 3.0, 7.0), Some((Side::Right, [3, 7])));
    assert_eq!(at(Layout::Difference, f64::from(panes[2].left) + 3.0, 7.0), None);
}
