//! The panel: a widget for every control of the active style. It reads the state and makes events.

use crate::keys::about;
use crate::preset::{LOOKS, SHIPPED};
use crate::styles::{Origin, StyleName};
use crate::window::threads::viewer::Viewer;
use crate::window::values::controls::{Control, Group, in_style};
use crate::window::values::event::{Layout, Side, ViewerEvent};
use crate::window::values::line_style::LinesShown;
use crate::window::values::state::ViewerState;
use crate::window::widgets::keys;
use crate::window::widgets::widget::{self, Change};
use egui::{Color32, Context, Id, RichText, Ui};

/// Colours of the remarks on a style's settings.
pub(in crate::window) const FAITHFUL: Color32 = Color32::from_rgb(110, 190, 110);
pub(in crate::window) const CHANGED: Color32 = Color32::from_rgb(220, 160, 60);

/// Colour of the hint in an empty field.
pub(in crate::window) const HINT: Color32 = Color32::GRAY;

/// The meaning of coarser.
const COARSE: &str =
    "while the model turns: half the width and height, without the faces that look away, three-pass in one pass";

/// Shows the panel's content.
pub(in crate::window) fn show(ui: &mut Ui, viewer: &Viewer, events: &mut Vec<ViewerEvent>) {
    let state = &viewer.state;
    panes(ui, state, events);
    models(ui, state, events);
    drawn(ui, state, events);
    presets(ui, state, events);
    changes(ui, state, events);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        settings(ui, state, events);
        ui.separator();
        commands(ui, viewer);
    });
}

/// How many styles are shown, and which of them the panel is about.
fn panes(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    ui.horizontal_wrapped(|ui| {
        for (layout, name) in
            [(Layout::Single, "one style"), (Layout::Split, "split"), (Layout::Difference, "difference")]
        {
            if ui.selectable_label(state.layout == layout, name).clicked() {
                events.push(ViewerEvent::Layout(layout));
            }
        }
    });
    if state.sides().len() > 1 {
        ui.horizontal(|ui| {
            for (of, name) in [(Side::Left, "left"), (Side::Right, "right")] {
                if ui.selectable_label(state.active == of, name).clicked() {
                    events.push(ViewerEvent::Choose(of));
                }
            }
        });
    }
}

fn models(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    let names = state.model_names().join(", ");
    match file(ui, "model", RichText::new(&names), &state.models.join(", ")) {
        Some(path) if !path.is_empty() => events.push(ViewerEvent::Open(vec![path])),
        Some(_) => events.push(ViewerEvent::Browse),
        _ => {}
    }
}

/// What is drawn: the style, lines over it, the look, the buffer.
fn drawn(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    let side = state.active;
    let style = state.style(side);
    let lines = state.lines_shown(side);
    choices(ui, "style", style.name(), StyleName::ALL.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::Style(side, name.to_owned()));
    });
    if lines != LinesShown::Alone {
        let mut is_over = state.requests[side as usize].exact_lines;
        if ui.checkbox(&mut is_over, "exact lines over it").changed() {
            events.push(ViewerEvent::Overlay(side, is_over));
        }
    }
    let look = state.look().map_or("none", |look| look.name);
    let looks = LOOKS.into_iter().map(|look| (look.name, look.about));
    choices_with_help(ui, "look", look, looks, |name| events.push(ViewerEvent::Look(name.to_owned())));
    if lines != LinesShown::Alone {
        let buffers =
            crate::window::values::buffer::buffers(style.style_name()).into_iter().map(|buffer| buffer.name());
        choices(ui, "shown", state.buffer.name(), buffers, |name| events.push(ViewerEvent::Buffer(name.to_owned())));
    }
}

/// Settings from files, coarser pictures, and what can be saved.
fn presets(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    choices(ui, "presets", "choose", SHIPPED.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::OpenPreset(name.to_owned()));
    });
    let preset = file(ui, "from a file", RichText::new("a.toml").color(HINT), "a preset's path");
    events.extend(preset.filter(|path| !path.is_empty()).map(ViewerEvent::OpenPreset));
    let mut is_allowed = state.is_coarse_while_moving;
    if ui.checkbox(&mut is_allowed, "coarser while moving").on_hover_text(COARSE).changed() {
        events.push(ViewerEvent::Coarse(is_allowed));
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("save");
        for (what, action) in keys::SAVES {
            let button = ui.button(what);
            if button.on_hover_text(about(action).unwrap_or_default()).clicked() {
                events.extend(keys::event_of(action, state));
            }
        }
    });
}

/// The controls of the lines, the style, the scene and the models.
fn settings(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    let side = state.active;
    let request = state.seen(side);
    let mut list = ControlLists { words: search(ui), events };
    if state.lines_shown(side) == LinesShown::Over {
        let title = |_: &str| "Exact lines of both sides".to_owned();
        let of_lines = Group::Style.controls(&in_style(&request, StyleName::Lines));
        list.show(ui, "lines", of_lines, title, ViewerEvent::Lines, ViewerEvent::LinesDefault);
    }
    let title = |heading: &str| of_style_heading(heading, request.style.name());
    let set = |option, value| ViewerEvent::Set(side, option, value);
    let of_style = Group::Style.controls(&request);
    list.show(ui, side, of_style, title, set, |option| ViewerEvent::Default(side, option));
    let of_scene = Group::Scene.controls(&request);
    list.show(ui, "scene", of_scene, by_heading, ViewerEvent::Scene, ViewerEvent::SceneDefault);
    let of_models = Group::Models.controls(&request);
    list.show(ui, "models", of_models, by_heading, ViewerEvent::Model, ViewerEvent::ModelDefault);
}

/// The commands that draw the same.
fn commands(ui: &mut Ui, viewer: &Viewer) {
    ui.label("the same by");
    for command in viewer.commands() {
        match command {
            Ok(command) => {
                let text = RichText::new(&command).monospace().size(11.0);
                ui.add(egui::Label::new(text).wrap().selectable(true));
                if ui.small_button("copy").clicked() {
                    ui.ctx().copy_text(command);
                }
            }
            Err(problem) => drop(ui.label(problem)),
        }
    }
}

/// A field for words that a setting's name or help must have.
fn search(ui: &mut Ui) -> String {
    let id = ui.id().with("search");
    let mut words: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let hint = RichText::new("find a setting").color(HINT);
    ui.add(egui::TextEdit::singleline(&mut words).hint_text(hint).desired_width(f32::INFINITY));
    ui.data_mut(|data| data.insert_temp(id, words.clone()));
    words.trim().to_owned()
}

/// A group's heading, without its explanation, which does not fit here.
fn by_heading(heading: &str) -> String {
    heading.split(['(', ':']).next().unwrap_or(heading).trim().to_owned()
}

/// Settings shared with other styles appear as the style's own, whichever styles the heading names.
fn of_style_heading(heading: &str, style: &str) -> String {
    if heading.starts_with("Style") { format!("Style {style}") } else { by_heading(heading) }
}

/// Lists of controls, filtered by the search, and the events they make.
struct ControlLists<'a> {
    words: String,
    events: &'a mut Vec<ViewerEvent>,
}

impl ControlLists<'_> {
    /// Shows controls under their headings, which fold unless a search is active.
    fn show(
        &mut self,
        ui: &mut Ui,
        id: impl std::hash::Hash + Copy,
        controls: Vec<Control>,
        title: impl Fn(&str) -> String,
        set: impl Fn(String, String) -> ViewerEvent,
        back: impl Fn(String) -> ViewerEvent,
    ) {
        let found: Vec<Control> = controls.into_iter().filter(|control| control.is_found_by(&self.words)).collect();
        let mut one = |ui: &mut Ui, control: &Control| {
            let change = ui.push_id((id, control.setting.name), |ui| widget::show(ui, control)).inner;
            self.events.extend(change.map(|change| match change {
                Change::Set(value) => set(control.option(), value),
                Change::Default => back(control.option()),
            }));
        };
        for group in found.chunk_by(|a, b| title(a.setting.heading) == title(b.setting.heading)) {
            let whole = group[0].setting.heading;
            let heading = RichText::new(title(whole)).strong();
            if self.words.is_empty() {
                egui::CollapsingHeader::new(heading)
                    .default_open(true)
                    .show_unindented(ui, |ui| group.iter().for_each(|control| one(ui, control)))
                    .header_response
                    .on_hover_text(whole);
            } else {
                ui.label(heading).on_hover_text(whole);
                group.iter().for_each(|control| one(ui, control));
            }
        }
    }
}

/// Puts a text into the model's field, where the user types on.
pub(in crate::window) fn type_model(context: &Context, text: String) {
    let id = file_id("model");
    context.data_mut(|data| data.insert_temp(id, text));
    context.memory_mut(|memory| memory.request_focus(id));
}

fn file_id(label: &str) -> Id {
    Id::new((label, "file"))
}

/// A field for a file, which shows `open` until the user types a path. Returns the typed path when it is confirmed, empty if the
/// field is empty. Files can be dropped on the window, too.
fn file(ui: &mut Ui, label: &str, open: RichText, about: &str) -> Option<String> {
    let mut opened = None;
    ui.horizontal(|ui| {
        let id = file_id(label);
        let mut path: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        ui.label(label);
        let wanted = egui::vec2(ui.available_width() - 60.0, ui.spacing().interact_size.y);
        let field =
            ui.add_sized(wanted, egui::TextEdit::singleline(&mut path).id(id).hint_text(open)).on_hover_text(about);
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        if ui.small_button("open").clicked() || (is_entered && !path.trim().is_empty()) {
            opened = Some(path.trim().to_owned());
            path.clear();
        }
        ui.data_mut(|data| data.insert_temp(id, path));
    });
    opened
}

/// Whether all settings are the article's, if there is one, as a state to return to; or a look's.
fn changes(ui: &mut Ui, state: &ViewerState, events: &mut Vec<ViewerEvent>) {
    let side = state.active;
    let origin = state.style(side).style_name().info().origin;
    let controls = Group::Style.controls(&state.seen(side));
    let changed = controls.iter().filter(|control| !control.is_default()).count();
    ui.horizontal(|ui| {
        if changed == 0 {
            let said = match origin {
                Origin::Published(_) => "● faithful",
                Origin::Named | Origin::Own => "● default settings",
            };
            ui.colored_label(FAITHFUL, said)
                .on_hover_text("every setting has its default: the text's value where it gives one");
        } else {
            match state.look().filter(|look| look.has_settings()) {
                Some(look) => ui.colored_label(FAITHFUL, format!("● as in the look {}", look.name)),
                None => ui.colored_label(CHANGED, format!("○ {changed} changed")),
            };
            let back = if matches!(origin, Origin::Published(_)) { "all as published" } else { "all as by default" };
            if ui.small_button(back).clicked() {
                events.push(ViewerEvent::Faithful(side));
            }
        }
    });
}

fn choices<'a>(
    ui: &mut Ui,
    label: &str,
    chosen: &str,
    names: impl Iterator<Item = &'a str>,
    choose: impl FnMut(&'a str),
) {
    choices_with_help(ui, label, chosen, names.map(|name| (name, "")), choose);
}

/// Names to choose from, each with its description.
fn choices_with_help<'a>(
    ui: &mut Ui,
    label: &str,
    chosen: &str,
    names: impl Iterator<Item = (&'a str, &'a str)>,
    mut choose: impl FnMut(&'a str),
) {
    ui.horizontal(|ui| {
        ui.label(label);
        egui::ComboBox::from_id_salt(label).selected_text(chosen).show_ui(ui, |ui| {
            for (name, help) in names {
                let choice = ui.selectable_label(name == chosen, name);
                let choice = if help.is_empty() { choice } else { choice.on_hover_text(help) };
                if choice.clicked() {
                    choose(name);
                }
            }
        });
    });
}
