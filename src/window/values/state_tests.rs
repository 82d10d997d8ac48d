//! Tests of the viewer's state.

use super::*;
use crate::settings::{HasSettings, Options};
use crate::styles::{Cartoon, Charcoal, CharcoalRecipe, LineStyle};

fn after(events: impl IntoIterator<Item = ViewerEvent>) -> ViewerState {
    let mut state = ViewerState { models: vec!["a/bust.obj".to_owned()], ..ViewerState::default() };
    events.into_iter().for_each(|event| {
        state.update(event);
        assert_eq!(state.message, None);
    });
    state
}

fn line_style(state: &ViewerState) -> LineStyle {
    controls::in_style(&state.requests[0], StyleName::Lines).style.lines().unwrap()
}

fn set(option: &str, value: &str) -> ViewerEvent {
    ViewerEvent::Set(Side::Left, option.to_owned(), value.to_owned())
}

#[test]
fn it_begins_as_render_does() {
    let state = ViewerState::default();
    assert_eq!(*state.style(Side::Left), Style::named(StyleName::ThreePass));
    let (shown, default) = (state.scene_settings(), SceneSettings::default());
    assert_eq!(shown, default);
    assert!(state.orbit.is_fitted());
}

#[test]
fn a_style_keeps_its_settings_while_another_is_shown() {
    let style = |name: &str| ViewerEvent::Style(Side::Left, name.to_owned());
    let state = after([set("--tones", "2"), style("phong"), style("three-pass")]);
    let Style::ThreePass(Cartoon { tones, .. }) = state.style(Side::Left) else { panic!("three-pass") };
    assert_eq!(tones.count, 2);
    let mut right = state.clone();
    right.update(ViewerEvent::Style(Side::Right, "three-pass".to_owned()));
    let Style::ThreePass(right) = right.style(Side::Right) else { panic!("three-pass") };
    assert_eq!(right.tones.count, 3, "the other side has its own");
    // As at the command line, an option is that of every style that has it.
    let mut other = state;
    other.update(style("two-pass"));
    let Style::TwoPass(other) = other.style(Side::Left) else { panic!("two-pass") };
    assert_eq!(other.tones.count, 2);
}

#[test]
fn a_dial_goes_back_to_the_papers_value_alone_or_with_all_others() {
    let turned = || vec![set("--tones", "2"), set("--detection-factor", "0.5")];
    let one = after(turned().into_iter().chain([ViewerEvent::Default(Side::Left, "--tones".to_owned())]));
    let Style::ThreePass(cartoon) = one.style(Side::Left) else { panic!("three-pass") };
    assert_eq!((cartoon.tones.count, cartoon.border.unwrap().detection_factor), (3, 0.5));
    let all = after(turned().into_iter().chain([ViewerEvent::Faithful(Side::Left)]));
    assert_eq!(*all.style(Side::Left), Style::named(StyleName::ThreePass));
}

#[test]
fn what_cannot_be_is_said_in_a_sentence_and_changes_nothing() {
    let mut state = ViewerState::default();
    let before = state.clone();
    for event in [
        set("--tones", "many"),
        set("--line-width", "3"),
        ViewerEvent::View("beneath".to_owned()),
        ViewerEvent::Style(Side::Right, "oil".to_owned()),
        ViewerEvent::Turn([f64::NAN, 0.0]),
        ViewerEvent::Zoom(f64::INFINITY),
        ViewerEvent::Buffer("bumps".to_owned()),
        ViewerEvent::OpenPreset("paper:nobody".to_owned()),
    ] {
        assert_eq!(state.update(event), None);
        assert!(state.message.as_ref().is_some_and(|message| message.len() > 10), "{:?}", state.message);
        assert_eq!(ViewerState { message: None, ..state.clone() }, before);
    }
}

#[test]
fn three_layouts_follow_one_another_and_share_the_area_among_their_panes() {
    let resize = ViewerEvent::Resize([1000, 400]);
    let widths =
        |state: &ViewerState| state.panes().iter().map(|pane| (pane.left, pane.size.width)).collect::<Vec<_>>();
    let single = after([resize.clone()]);
    assert_eq!(widths(&single), [(0, 1000)]);
    let split = after([resize.clone(), ViewerEvent::NextLayout, ViewerEvent::Divide(0.25)]);
    assert_eq!(split.panes(), [Pane { content: Content::Cut(250), left: 0, size: split.area }]);
    let three = after([resize, ViewerEvent::NextLayout, ViewerEvent::NextLayout]);
    assert_eq!(widths(&three), [(0, 332), (334, 332), (668, 332)]);
    assert_eq!(three.picture_size(), Size { width: 332, height: 400 });
    assert_eq!(
        after([ViewerEvent::NextLayout, ViewerEvent::NextLayout, ViewerEvent::NextLayout]).layout,
        Layout::Single
    );
}

#[test]
fn an_area_of_one_pixel_still_has_panes_of_a_pixel() {
    for layout in [Layout::Single, Layout::Split, Layout::Difference] {
        let state = after([ViewerEvent::Layout(layout), ViewerEvent::Resize([0, 0])]);
        assert_eq!(state.area, Size { width: 1, height: 1 });
        assert!(state.panes().iter().all(|pane| pane.size.pixel_count() == 1), "{layout:?}");
    }
}

#[test]
fn the_buffer_key_goes_through_all_buffers_and_a_style_without_one_shows_its_picture() {
    let state = after([ViewerEvent::NextBuffer]);
    assert_eq!(state.buffer.name(), "map");
    let around = after(vec![ViewerEvent::NextBuffer; 7]);
    assert_eq!(around.buffer, Buffer::default());
    let kept = after([ViewerEvent::NextBuffer, ViewerEvent::Style(Side::Left, "ink".to_owned())]);
    assert_eq!(kept.buffer.name(), "map");
    let lost = after([ViewerEvent::NextBuffer, ViewerEvent::Style(Side::Left, "phong".to_owned())]);
    assert_eq!(lost.buffer, Buffer::default());
}

#[test]
fn the_title_says_model_and_styles() {
    assert_eq!(after([]).title(), "bust.obj - three-pass - tinta");
    let mut split = after([ViewerEvent::NextLayout]);
    split.models.push("b.obj".to_owned());
    assert_eq!(split.title(), "bust.obj and 1 more - three-pass | inking - tinta");
}

#[test]
fn a_preset_that_ships_is_a_style_with_the_papers_constants() {
    let paper = ViewerEvent::OpenPreset("paper:valente-charcoal-in-part".to_owned());
    let state = after([ViewerEvent::Style(Side::Left, "charcoal".to_owned()), set("--seed", "7"), paper]);
    assert_eq!(*state.style(Side::Left), Style::named(StyleName::Charcoal));
}

#[test]
fn a_preset_draws_in_the_viewer_what_it_draws_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml").to_str().unwrap().to_owned();
    let open = |text: &str| {
        std::fs::write(&path, text).unwrap();
        let mut state = ViewerState::default();
        state.update(ViewerEvent::OpenPreset(path.clone()));
        (state.style(Side::Left).clone(), state.message.unwrap_or_default())
    };
    // A recipe is no control, and the view no setting of a style; both may be in a preset.
    let (style, said) = open("style = \"charcoal\"\ncharcoal = \"darker\"\nview = \"front\"\ntones = 2\n");
    assert_eq!((style, said.as_str()), (Style::Charcoal(Charcoal::recipe(CharcoalRecipe::Darker)), ""));
    for (text, words) in [
        ("tone = 2\n", "mine.toml: line 1: tone: there is no such option"),
        ("style = \"ink\"\ntones = \"many\"\n", "mine.toml: line 2: tones many: give a whole number"),
        ("filter = \"sharp\"\n", "mine.toml: line 1: filter sharp: choose one of laplacian4"),
        ("smooth = 2\nstyle = \"inking\"\n", "mine.toml: line 1: smooth 2: choose on or off"),
        ("style = \"lines\"\ntone = 2\n", "mine.toml: line 2: tone: there is no such option"),
        ("style = \"lines\"\nhidden = \"red\"\n", "mine.toml: line 2: hidden red: choose one of none"),
    ] {
        let (style, said) = open(text);
        assert!(said.contains(words), "{text}: {said}");
        assert_eq!(style, Style::named(StyleName::ThreePass), "{text}");
    }
}

#[test]
fn a_look_is_a_style_and_a_scene_and_the_next_takes_back_what_it_has_set() {
    let look = |name: &str| ViewerEvent::Look(name.to_owned());
    let print = after([look("print")]);
    let options = Look::of_name("print").unwrap().preset().unwrap().options;
    assert_eq!(*print.style(Side::Left), Style::from_options(&options).unwrap());
    let scene = print.scene_settings();
    assert_eq!(
        scene,
        SceneSettings { size: scene.size, ..SceneSettings::from_options(&of_scene(&options)).unwrap() },
        "what a look says of the scene is what render makes of it"
    );
    assert_ne!(scene, SceneSettings { size: scene.size, ..SceneSettings::default() });
    assert_eq!(print.look().map(|look| look.name), Some("print"));
    let published = after([look("print"), look("published")]);
    assert_eq!(*published.style(Side::Left), Style::named(StyleName::Ink));
    assert_eq!(published.scene_settings(), SceneSettings::default());
    // The user's own background does not belong to a look.
    let tan = ViewerEvent::Background("tan".to_owned());
    let kept = after([tan, look("sketch"), look("print")]).scene_settings();
    assert_ne!(kept.background, SceneSettings::default().background);
}

#[test]
fn a_look_stays_however_the_model_is_turned_moved_and_brought_nearer() {
    for look in LOOKS {
        let begun = [ViewerEvent::Style(Side::Left, "three-pass".to_owned()), ViewerEvent::Look(look.name.to_owned())];
        let views = [
            ViewerEvent::Turn([0.21, -0.1]),
            ViewerEvent::Move([0.1, 0.1]),
            ViewerEvent::Zoom(1.5),
            ViewerEvent::View("top".to_owned()),
            ViewerEvent::Reset,
        ];
        for count in 0..=views.len() {
            let state = after(begun.iter().chain(&views[..count]).cloned());
            assert_eq!(state.look().map(|look| look.name), Some(look.name), "after {:?}", &views[..count]);
        }
        let other = after(begun.iter().cloned().chain([ViewerEvent::Scene("fov".to_owned(), "77".to_owned())]));
        assert!(other.look().is_none(), "another lens is no longer {}", look.name);
    }
}

fn of_scene(options: &Options) -> Options {
    let table = SceneSettings::table();
    options.clone().into_iter().filter(|(name, _)| table.has(name)).collect()
}

#[test]
fn a_look_of_vectors_shows_exact_lines_and_the_next_takes_them_back() {
    let look = |name: &str| ViewerEvent::Look(name.to_owned());
    let technical = after([look("technical")]);
    let options = Look::of_name("technical").unwrap().preset().unwrap().options;
    assert_eq!(technical.lines_shown(Side::Left), LinesShown::Alone);
    assert_eq!(*technical.style(Side::Left), Style::from_options(&options).unwrap());
    assert_ne!(line_style(&technical), LineStyle::default());
    assert!(technical.scene_settings().camera.parallel);
    assert_eq!(technical.look().map(|look| look.name), Some("technical"));
    let print = after([look("technical"), look("print")]);
    assert_eq!((print.lines_shown(Side::Left), print.scene_settings().camera.parallel), (LinesShown::Over, false));
    assert_eq!((print.style(Side::Left).name(), print.look().map(|look| look.name)), ("ink", Some("print")));
    let published = after([look("print"), look("published")]);
    assert_eq!(
        (published.lines_shown(Side::Left), published.look().map(|look| look.name)),
        (LinesShown::None, Some("published"))
    );
}

#[test]
fn exact_lines_are_a_style_and_lie_over_one() {
    let style = |name: &str| ViewerEvent::Style(Side::Left, name.to_owned());
    let shown = |events: Vec<ViewerEvent>| after(events).drawn_name(Side::Left);
    assert_eq!(shown(vec![style("lines")]), "lines");
    assert_eq!(shown(vec![style("lines"), style("phong")]), "phong");
    assert_eq!(shown(vec![ViewerEvent::Overlay(Side::Left, true)]), "three-pass+lines");
    assert_eq!(shown(vec![ViewerEvent::Overlay(Side::Left, true), style("ink")]), "ink+lines", "whatever the style");
    assert_eq!(
        shown(vec![ViewerEvent::Overlay(Side::Left, true), ViewerEvent::Overlay(Side::Left, false)]),
        "three-pass"
    );
    assert_eq!(shown(vec![style("lines"), ViewerEvent::Overlay(Side::Left, false)]), "lines", "they are no overlay");
    // Their settings are those of both sides, and of the side's style while they are it.
    let dashed = after([style("lines"), set("--hidden", "dashed")]);
    let over = after([ViewerEvent::Lines("--hidden".to_owned(), "dashed".to_owned())]);
    assert_eq!(line_style(&dashed), line_style(&over));
    let back = after([style("lines"), set("--hidden", "dashed"), ViewerEvent::Faithful(Side::Left)]);
    assert_eq!(line_style(&back), LineStyle::default());
    let mut state = after([style("lines")]);
    state.update(set("--tones", "2"));
    assert!(state.message.as_ref().is_some_and(|message| message.starts_with("--tones: ")), "{:?}", state.message);
}

#[test]
fn a_preset_of_lines_shows_them_as_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml").to_str().unwrap().to_owned();
    std::fs::write(&path, "style = \"lines\"\nhidden = \"ghost\"\nclass-colors = \"crease=red\"\n").unwrap();
    let state = after([ViewerEvent::OpenPreset(path)]);
    assert_eq!(state.drawn_name(Side::Left), "lines");
    let options = state.style(Side::Left).to_options().unwrap();
    assert_eq!(options.keys().collect::<Vec<_>>(), ["class-colors", "hidden", "style"]);
}

#[test]
fn every_setting_of_the_scene_is_set_from_the_window_and_goes_back() {
    let default = ViewerState::default().scene_settings();
    let controls = Group::Scene.controls(&Request::default());
    for control in &controls {
        let samples = control.setting.kind.samples(&control.value);
        let other = samples.iter().find(|sample| **sample != control.value).unwrap();
        let mut state = after([ViewerEvent::Scene(control.option(), other.clone())]);
        let set = control.setting.value(&state.seen(Side::Left));
        assert_ne!(set.as_deref(), Some(&*control.value), "{}", control.option());
        state.update(ViewerEvent::SceneDefault(control.option()));
        assert_eq!(state.scene_settings(), default, "{}", control.option());
    }
    assert_eq!(controls.len(), controls::SCENE_SETTINGS.len(), "each is a setting of the scene");
    let mut state = ViewerState::default();
    state.update(ViewerEvent::Scene("copies".to_owned(), "2".to_owned()));
    assert!(state.message.is_some_and(|message| message.starts_with("copies: the window has no such setting")));
}

#[test]
fn events_are_read_back_as_they_were_written() {
    for event in [
        set("--tones", "2"),
        ViewerEvent::Turn([0.5, -0.25]),
        ViewerEvent::NextLayout,
        ViewerEvent::Open(vec!["a.obj".to_owned()]),
        ViewerEvent::Resize([1, 1]),
    ] {
        let text = serde_json::to_string(&event).unwrap();
        assert_eq!(serde_json::from_str::<ViewerEvent>(&text).unwrap(), event, "{text}");
    }
}
