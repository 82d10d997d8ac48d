//! The panel: a widget for every control of the active style. It reads the state and makes events, nothing else.

use super::controls::{self, Control};
use super::event::{Layout, Side, ViewerEvent};
use super::keys;
use super::viewer::Viewer;
use super::widget::{self, Change};
use crate::preset::SHIPPED;
use crate::styles::{Origin, Style, StyleName};
use egui::{Color32, RichText, Ui};

/// Colours of what is said of a style's settings.
pub(super) const FAITHFUL: Color32 = Color32::from_rgb(110, 190, 110);
pub(super) const CHANGED: Color32 = Color32::from_rgb(220, 160, 60);

/// Colour of what stands in an empty field.
pub(super) const HINT: Color32 = Color32::GRAY;

/// Shows the panel's content.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, events: &mut Vec<ViewerEvent>) {
    let state = &viewer.state;
    let side = state.active;
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
                if ui.selectable_label(side == of, name).clicked() {
                    events.push(ViewerEvent::Choose(of));
                }
            }
        });
    }
    file(ui, "model", "cow.obj", |path| events.push(ViewerEvent::Open(vec![path])));
    let style = state.style(side);
    choices(ui, "style", style.name(), StyleName::ALL.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::Style(side, name.to_owned()));
    });
    let look = state.look().map_or("none", |look| look.name);
    let looks = controls::looks().map(|look| (look.name, look.about));
    choices_with_help(ui, "look", look, looks, |name| events.push(ViewerEvent::Look(name.to_owned())));
    let buffers = super::buffer::buffers(style.style_name()).into_iter().map(|buffer| buffer.name());
    choices(ui, "shown", state.buffer.name(), buffers, |name| events.push(ViewerEvent::Buffer(name.to_owned())));
    choices(ui, "presets", "choose a paper's", SHIPPED.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::OpenPreset(name.to_owned()));
    });
    file(ui, "from a file", "preset.toml", |path| events.push(ViewerEvent::OpenPreset(path)));
    ui.horizontal(|ui| {
        ui.label("save");
        for (key, what, event) in keys::SAVES {
            if ui.button(what).on_hover_text(keys::about_saving(key)).clicked() {
                events.push(event);
            }
        }
    });
    faithful(ui, style, side, events);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        let words = search(ui);
        grouped(ui, controls::of(style), &words, |ui, control| {
            let option = control.option();
            let change = ui.push_id((control.setting.name, side as usize), |ui| widget::show(ui, control)).inner;
            events.extend(change.map(|change| match change {
                Change::Set(value) => ViewerEvent::Set(side, option, value),
                Change::Default => ViewerEvent::Default(side, option),
            }));
        });
        grouped(ui, controls::of_scene(&state.scene_settings()), &words, |ui, control| {
            let option = control.option();
            let change = ui.push_id(("scene", control.setting.name), |ui| widget::show(ui, control)).inner;
            events.extend(change.map(|change| match change {
                Change::Set(value) => ViewerEvent::Scene(option, value),
                Change::Default => ViewerEvent::SceneDefault(option),
            }));
        });
        ui.separator();
        ui.label("the same by");
        match viewer.command() {
            Some(Ok(command)) => {
                let text = RichText::new(&command).monospace().size(11.0);
                ui.add(egui::Label::new(text).wrap().selectable(true));
                if ui.small_button("copy").clicked() {
                    ui.ctx().copy_text(command);
                }
            }
            Some(Err(problem)) => drop(ui.label(problem)),
            None => {}
        }
    });
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

/// Controls under their headings, which fold as long as nothing is looked for.
fn grouped<T: Clone + 'static>(
    ui: &mut Ui,
    controls: Vec<Control<T>>,
    words: &str,
    mut one: impl FnMut(&mut Ui, &Control<T>),
) {
    let found: Vec<Control<T>> = controls.into_iter().filter(|control| control.is_found_by(words)).collect();
    for group in found.chunk_by(|a, b| a.setting.heading == b.setting.heading) {
        let whole = group[0].setting.heading;
        // What explains it has no room here.
        let heading = RichText::new(whole.split(['(', ':']).next().unwrap_or(whole).trim()).strong();
        if words.is_empty() {
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

/// A field for a file; files can be dropped on the window, too.
fn file(ui: &mut Ui, label: &str, example: &str, mut open: impl FnMut(String)) {
    ui.horizontal(|ui| {
        let id = ui.id().with((label, "file"));
        let mut path: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        ui.label(label);
        let wanted = egui::vec2(ui.available_width() - 60.0, ui.spacing().interact_size.y);
        let field =
            ui.add_sized(wanted, egui::TextEdit::singleline(&mut path).hint_text(RichText::new(example).color(HINT)));
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        if (ui.small_button("open").clicked() || is_entered) && !path.trim().is_empty() {
            open(path.trim().to_owned());
        }
        ui.data_mut(|data| data.insert_temp(id, path));
    });
}

/// Whether all settings are the article's, as a state that can be returned to.
fn faithful(ui: &mut Ui, style: &Style, side: Side, events: &mut Vec<ViewerEvent>) {
    ui.horizontal(|ui| {
        if controls::is_faithful(style) {
            let said = match style.style_name().info().origin {
                Origin::Published => "● faithful",
                Origin::Named | Origin::Own => "● default settings",
            };
            ui.colored_label(FAITHFUL, said)
                .on_hover_text("every setting has its default: the text's value where it gives one");
        } else {
            let changed = controls::of(style).iter().filter(|control| !control.is_default()).count();
            ui.colored_label(CHANGED, format!("○ {changed} changed"));
            if ui.small_button("all as published").clicked() {
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

/// Names to choose from, each with what it is said to be.
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
