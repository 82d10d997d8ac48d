//! The panel: a widget for every control of the active style. It reads the state and makes events, nothing else.

use super::controls::{self, Control};
use super::event::{Layout, Side, ViewerEvent};
use super::viewer::Viewer;
use crate::preset::SHIPPED;
use crate::settings::Kind;
use crate::styles::{Origin, Style, StyleName};
use egui::{Color32, RichText, Ui};

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
    let style = state.style(side);
    choices(ui, "style", style.name(), StyleName::ALL.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::Style(side, name.to_owned()));
    });
    let buffers = super::buffer::buffers(style.style_name()).into_iter().map(|buffer| buffer.name());
    choices(ui, "shown", state.buffer.name(), buffers, |name| events.push(ViewerEvent::Buffer(name.to_owned())));
    choices(ui, "presets", "", SHIPPED.iter().map(|(name, _)| *name), |name| {
        events.push(ViewerEvent::OpenPreset(name.to_owned()));
    });
    preset_file(ui, events);
    faithful(ui, style, side, events);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        for control in controls::of(style) {
            ui.push_id((control.setting.name, side as usize), |ui| one(ui, &control, side, events));
        }
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

/// A field for a preset's file; files can be dropped on the window, too.
fn preset_file(ui: &mut Ui, events: &mut Vec<ViewerEvent>) {
    ui.horizontal(|ui| {
        let id = ui.id().with("preset file");
        let mut path: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        ui.label("from a file");
        let wanted = egui::vec2(ui.available_width() - 60.0, ui.spacing().interact_size.y);
        let field = ui.add_sized(
            wanted,
            egui::TextEdit::singleline(&mut path).hint_text(RichText::new("preset.toml").color(Color32::GRAY)),
        );
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        if (ui.small_button("open").clicked() || is_entered) && !path.trim().is_empty() {
            events.push(ViewerEvent::OpenPreset(path.trim().to_owned()));
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
            ui.colored_label(Color32::from_rgb(110, 190, 110), said)
                .on_hover_text("every setting has its default: the text's value where it gives one");
        } else {
            let changed = controls::of(style).iter().filter(|control| !control.is_default()).count();
            ui.colored_label(Color32::from_rgb(220, 160, 60), format!("○ {changed} changed"));
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
    mut choose: impl FnMut(&'a str),
) {
    ui.horizontal(|ui| {
        ui.label(label);
        egui::ComboBox::from_id_salt(label).selected_text(chosen).show_ui(ui, |ui| {
            for name in names {
                if ui.selectable_label(name == chosen, name).clicked() {
                    choose(name);
                }
            }
        });
    });
}

/// A control: its name, its widget, and the way back to the published value.
fn one(ui: &mut Ui, control: &Control<Style>, side: Side, events: &mut Vec<ViewerEvent>) {
    let (setting, value) = (control.setting, &control.value);
    ui.horizontal(|ui| {
        let name = RichText::new(setting.label());
        let name = if control.is_default() { name } else { name.strong() };
        ui.label(name).on_hover_text(format!("{} {}", control.option(), setting.help));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let back = ui.add_enabled(!control.is_default(), egui::Button::new("↺").small());
            if back.on_hover_text(format!("back to the default: {}", control.default)).clicked() {
                events.push(ViewerEvent::Default(side, control.option()));
            }
            if let Kind::Switch | Kind::Flag | Kind::Choice(_) = setting.kind
                && let Some(text) = widget(ui, &setting.kind, value)
            {
                events.push(ViewerEvent::Set(side, control.option(), text));
            }
        });
    });
    if let Some(open) = setting.open
        && matches!(setting.kind, Kind::Numbers { .. })
    {
        let mut is_open = value == open;
        if ui.checkbox(&mut is_open, open).changed() {
            let text = if is_open { open.to_owned() } else { control.given() };
            events.push(ViewerEvent::Set(side, control.option(), text));
        }
    }
    if let Kind::Numbers { .. } | Kind::Several(_) | Kind::File | Kind::Text { .. } = setting.kind
        && let Some(text) = widget(ui, &setting.kind, value)
    {
        events.push(ViewerEvent::Set(side, control.option(), text));
    }
}

/// A widget for a value; its new value once it has been turned.
fn widget(ui: &mut Ui, kind: &Kind, value: &str) -> Option<String> {
    match kind {
        &Kind::Numbers { range: [low, high], decimals, .. } => {
            let mut numbers: Vec<f64> = value.split(',').filter_map(|number| number.parse().ok()).collect();
            let mut has_changed = false;
            for number in &mut numbers {
                let slider = egui::Slider::new(number, low..=high)
                    .clamping(egui::SliderClamping::Never)
                    .fixed_decimals(decimals);
                has_changed |= ui.add(slider).changed();
            }
            let text = |number: &f64| {
                let rounded = format!("{number:.decimals$}");
                rounded.parse::<f64>().map_or(rounded, |number| number.to_string())
            };
            has_changed.then(|| numbers.iter().map(text).collect::<Vec<_>>().join(","))
        }
        Kind::Choice(names) | Kind::Recipe(names) => {
            let mut chosen = None;
            egui::ComboBox::from_id_salt("choice").selected_text(value).show_ui(ui, |ui| {
                for name in names {
                    if ui.selectable_label(*name == value, *name).clicked() {
                        chosen = Some((*name).to_owned());
                    }
                }
            });
            chosen
        }
        Kind::Switch | Kind::Flag => {
            let mut is_on = value == "on";
            ui.checkbox(&mut is_on, "").changed().then(|| if is_on { "on" } else { "off" }.to_owned())
        }
        Kind::Several(_) | Kind::File | Kind::Text { .. } => {
            // What is being typed is kept until it is finished: half a word is no value.
            let id = ui.id().with("typed");
            let mut text: String = ui.data_mut(|data| data.get_temp(id)).unwrap_or_else(|| value.to_owned());
            let field = ui.add(egui::TextEdit::singleline(&mut text).desired_width(f32::INFINITY));
            if field.has_focus() {
                ui.data_mut(|data| data.insert_temp(id, text));
                return None;
            }
            if field.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                return (text != value).then_some(text);
            }
            None
        }
    }
}
