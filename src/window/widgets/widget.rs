//! The widget of a control, by the kind of its setting.

use crate::scene::Color;
use crate::settings::{Kind, Value};
use crate::styles::ClassColors;
use crate::window::values::controls::Control;
use egui::{RichText, Ui};

/// A change to a control: a new value, or back to the default.
pub(in crate::window) enum Change {
    /// To this value.
    Set(String),
    /// To the default.
    Default,
}

/// A control: its name, its widget, and a reset to the published value. Returns the change.
pub(in crate::window) fn show(ui: &mut Ui, control: &Control) -> Option<Change> {
    let (setting, value) = (control.setting, &control.value);
    let mut change = None;
    ui.horizontal(|ui| {
        let name = RichText::new(setting.label());
        let name = if control.is_default() { name } else { name.strong() };
        ui.label(name).on_hover_text(format!("{} {}", control.option(), setting.help));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let back = ui.add_enabled(!control.is_default(), egui::Button::new("↺").small());
            if back.on_hover_text(format!("back to the default: {}", control.default)).clicked() {
                change = Some(Change::Default);
            }
            if let Kind::Switch | Kind::Flag | Kind::Choice(_) | Kind::Color = setting.kind
                && let Some(text) = widget(ui, &setting.kind, value)
            {
                change = Some(Change::Set(text));
            }
        });
    });
    if let Some(open) = setting.open
        && matches!(setting.kind, Kind::Numbers { .. } | Kind::Color)
    {
        let mut is_open = value == open;
        if ui.checkbox(&mut is_open, open).changed() {
            change = Some(Change::Set(if is_open { open.to_owned() } else { control.given() }));
        }
    }
    // An open value has no number to show.
    let has_value = setting.open != Some(value) || !matches!(setting.kind, Kind::Numbers { .. });
    if has_value
        && let Kind::Numbers { .. } | Kind::Several(_) | Kind::File | Kind::Text { .. } | Kind::Colors { .. } =
            setting.kind
        && let Some(text) = widget(ui, &setting.kind, value)
    {
        change = Some(Change::Set(text));
    }
    change
}

fn picker(ui: &mut Ui, color: Color) -> Option<Color> {
    let mut bytes = color.0.map(|channel| (channel * 255.0).round() as u8);
    let has_changed = ui.color_edit_button_srgb(&mut bytes).changed();
    has_changed.then(|| Color(bytes.map(|byte| f32::from(byte) / 255.0)))
}

/// A picker for each name, in two columns; a name without a value shows black.
fn pickers(ui: &mut Ui, names: &[&str], value: &str) -> Option<String> {
    let mut colors: ClassColors = value.parse().ok()?;
    let mut has_changed = false;
    egui::Grid::new("colors").num_columns(4).show(ui, |ui| {
        for row in names.chunks(2) {
            for name in row {
                let said = colors.named(name).ok().flatten();
                let label = RichText::new(*name);
                let picked = picker(ui, said.unwrap_or(Color([0.0; 3])));
                ui.label(if said.is_some() { label.strong() } else { label });
                has_changed |= picked.is_some_and(|color| colors.set_named(name, Some(color)).is_ok());
            }
            ui.end_row();
        }
    });
    has_changed.then(|| Value::text(&colors))
}

/// Values to choose from, and a field for others.
fn offered_or_typed(ui: &mut Ui, offered: &[&str], value: &str) -> Option<String> {
    let [chosen, typed] = ui.horizontal(|ui| [choice(ui, offered, "choose"), typed(ui, value)]).inner;
    chosen.or(typed)
}

/// Names to choose from.
fn choice(ui: &mut Ui, names: &[&str], value: &str) -> Option<String> {
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

/// A widget for a value; its new value once it has been turned.
fn widget(ui: &mut Ui, kind: &Kind, value: &str) -> Option<String> {
    match kind {
        // A length may have a unit, which no slider has.
        Kind::Numbers { .. } if value.split(',').any(|number| number.parse::<f64>().is_err()) => typed(ui, value),
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
        Kind::Choice(names) | Kind::Recipe(names) => choice(ui, names, value),
        // An open value has no colour to show.
        Kind::Color => picker(ui, value.parse().ok()?).map(|color| color.to_string()),
        Kind::Colors { names, offered, .. } => {
            let whole = offered_or_typed(ui, offered, value);
            whole.or(pickers(ui, names, value))
        }
        Kind::Switch | Kind::Flag => {
            let mut is_on = value == "on";
            ui.checkbox(&mut is_on, "").changed().then(|| if is_on { "on" } else { "off" }.to_owned())
        }
        Kind::Text { offered, .. } if !offered.is_empty() => offered_or_typed(ui, offered, value),
        Kind::Several(names) => several(ui, names, value),
        Kind::File | Kind::Text { .. } => typed(ui, value),
    }
}

/// At least one of a few names, each with a switch.
fn several(ui: &mut Ui, names: &[&str], value: &str) -> Option<String> {
    let mut chosen: Vec<&str> = value.split(',').collect();
    let mut switched = None;
    ui.horizontal_wrapped(|ui| {
        for name in names {
            if ui.selectable_label(chosen.contains(name), *name).clicked() {
                switched = Some(*name);
            }
        }
    });
    let switched = switched?;
    match chosen.iter().position(|name| *name == switched) {
        Some(_) if chosen.len() == 1 => return None,
        Some(place) => drop(chosen.remove(place)),
        None => chosen.push(switched),
    }
    Some(names.iter().filter(|name| chosen.contains(name)).copied().collect::<Vec<_>>().join(","))
}

/// A field for a text.
fn typed(ui: &mut Ui, value: &str) -> Option<String> {
    // Unfinished text stays in the field: half a word is no value.
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
