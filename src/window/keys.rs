//! Keys: which event each makes, and the sheet that lists them.

use super::event::{Side, ViewerEvent};
use super::line_style::{LINES, LinesShown};
use super::state::ViewerState;
use crate::styles::StyleName;
use egui::{Key, Modifiers};

/// What the key sheet says: keys, what they do.
pub(super) fn sheet() -> impl Iterator<Item = (&'static str, String)> {
    // Those after the ninth have no key.
    let names: Vec<&str> = StyleName::ALL.iter().map(|(name, _)| *name).take(9).collect();
    SHEET.iter().map(move |(keys, what)| (*keys, what.replace(STYLES, &names.join(", "))))
}

/// Stands for the styles' names.
const STYLES: &str = "STYLES";

const SHEET: &[(&str, &str)] = &[
    ("drag", "turn the model"),
    ("right drag, Shift drag", "move it"),
    ("wheel, pinch", "nearer, farther"),
    ("1 to 9", STYLES),
    ("0", "lines: exact lines by themselves"),
    ("E", "exact lines over the picture, or not"),
    ("S", "one style; two with a divider to drag; two and their difference"),
    ("O", "the other side: its style by number, its settings in the panel"),
    ("B", "buffers: map, normals, depth, borders, tones, edge classes"),
    ("Space", "panel with every setting"),
    ("C", "coarser pictures while the model moves, or not"),
    ("M", "time of each pass, error against the exact lines"),
    ("R", "whole model, first view"),
    ("F, Shift F", "from the front, from the back"),
    ("L, Shift L", "from the left, from the right"),
    ("T, Shift T", "from the top, from below"),
    ("I", "from a corner (iso)"),
    ("P", "perspective or parallel projection"),
    ("arrows, Shift arrows", "turn, move"),
    ("+ and -", "nearer, farther"),
    ("[ and ]", "divider to the left, to the right"),
    ("Ctrl S", "save the picture that is shown (PNG)"),
    ("Ctrl L", "save the exact lines of this view (SVG)"),
    ("Ctrl T", "save a turn around the model (GIF)"),
    ("Ctrl P", "save style and settings (preset, TOML)"),
    ("drop a file", "show that model; a preset (.toml): its style and settings"),
    ("F11", "full screen"),
    ("H", "this sheet"),
    ("Esc", "close what is open: sheet, times, panel, full screen"),
    ("Q", "quit"),
];

/// What can be saved: the key with Ctrl, what it is, the event.
pub(super) const SAVES: [(Key, &str, ViewerEvent); 4] = [
    (Key::S, "picture", ViewerEvent::SavePicture),
    (Key::L, "lines", ViewerEvent::SaveLines),
    (Key::T, "turn", ViewerEvent::SaveTurn),
    (Key::P, "preset", ViewerEvent::SavePreset),
];

/// What the key sheet says of saving this.
pub(super) fn about_saving(key: Key) -> String {
    let keys = format!("Ctrl {}", key.name());
    let what = SHEET.iter().find(|(listed, _)| *listed == keys).map_or("", |(_, what)| *what);
    format!("{keys}: {what}")
}

/// What an arrow turns or moves by, shares of the picture's height.
const STEP: f64 = 1.0 / 24.0;

/// What + and - bring nearer by.
const ZOOM_STEP: f64 = 1.25;

/// What [ and ] move the divider by, share of the width.
const DIVIDER_STEP: f64 = 0.05;

/// The event of a key; `None` for a key that does nothing.
pub(super) fn event(key: Key, modifiers: Modifiers, state: &ViewerState) -> Option<ViewerEvent> {
    if modifiers.command {
        let save = SAVES.iter().find(|(of_it, ..)| *of_it == key).map(|(_, _, event)| event.clone());
        return save.or_else(|| (key == Key::Q).then_some(ViewerEvent::Quit));
    }
    let view =
        |plain: &str, shifted: &str| Some(ViewerEvent::View(if modifiers.shift { shifted } else { plain }.to_owned()));
    let arrow = |right: f64, down: f64| {
        let step = [right * STEP, down * STEP];
        Some(if modifiers.shift { ViewerEvent::Move(step) } else { ViewerEvent::Turn(step) })
    };
    let style = |number: usize| {
        let (name, _) = StyleName::ALL.get(number)?;
        Some(ViewerEvent::Style(state.active, (*name).to_owned()))
    };
    match key {
        Key::Num1 => style(0),
        Key::Num2 => style(1),
        Key::Num3 => style(2),
        Key::Num4 => style(3),
        Key::Num5 => style(4),
        Key::Num6 => style(5),
        Key::Num7 => style(6),
        Key::Num8 => style(7),
        Key::Num9 => style(8),
        Key::Num0 => Some(ViewerEvent::Style(state.active, LINES.to_owned())),
        Key::E => Some(ViewerEvent::Overlay(state.active, state.lines_shown(state.active) != LinesShown::Over)),
        Key::S => Some(ViewerEvent::NextLayout),
        Key::O => Some(ViewerEvent::Choose(match state.active {
            Side::Left if state.sides().len() > 1 => Side::Right,
            _ => Side::Left,
        })),
        Key::B => Some(ViewerEvent::NextBuffer),
        Key::Space => Some(ViewerEvent::Panel),
        Key::C => Some(ViewerEvent::Coarse(!state.is_coarse_while_moving)),
        Key::M => Some(ViewerEvent::Price),
        Key::R => Some(ViewerEvent::Reset),
        Key::F => view("front", "back"),
        Key::L => view("left", "right"),
        Key::T => view("top", "bottom"),
        Key::I => view("iso", "iso"),
        Key::P => Some(ViewerEvent::Projection),
        Key::H => Some(ViewerEvent::KeySheet),
        Key::F11 => Some(ViewerEvent::FullScreen),
        Key::Q => Some(ViewerEvent::Quit),
        Key::Escape if state.has_key_sheet => Some(ViewerEvent::KeySheet),
        Key::Escape if state.has_price => Some(ViewerEvent::Price),
        Key::Escape if state.has_panel => Some(ViewerEvent::Panel),
        Key::Escape if state.is_full_screen => Some(ViewerEvent::FullScreen),
        Key::ArrowLeft => arrow(-1.0, 0.0),
        Key::ArrowRight => arrow(1.0, 0.0),
        Key::ArrowUp => arrow(0.0, -1.0),
        Key::ArrowDown => arrow(0.0, 1.0),
        Key::Plus | Key::Equals => Some(ViewerEvent::Zoom(ZOOM_STEP)),
        Key::Minus => Some(ViewerEvent::Zoom(1.0 / ZOOM_STEP)),
        Key::OpenBracket => Some(ViewerEvent::Divide(state.divider - DIVIDER_STEP)),
        Key::CloseBracket => Some(ViewerEvent::Divide(state.divider + DIVIDER_STEP)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn number_keys_are_the_styles_in_their_order() {
        let keys = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
        for (key, (name, _)) in keys.into_iter().zip(StyleName::ALL) {
            let mut state = ViewerState::default();
            let made = event(key, Modifiers::NONE, &state).unwrap();
            assert_eq!(made, ViewerEvent::Style(Side::Left, name.to_owned()));
            state.update(made);
            assert_eq!((state.style(Side::Left).name(), &state.message), (name, &None));
        }
        let (_, listed) = sheet().find(|(keys, _)| *keys == "1 to 9").unwrap();
        let names: Vec<&str> = StyleName::ALL.iter().map(|(name, _)| *name).take(9).collect();
        assert_eq!(listed, names.join(", "));
    }

    #[test]
    fn what_is_saved_is_in_the_key_sheet() {
        for (key, what, _) in SAVES {
            let about = about_saving(key);
            assert!(
                about.contains(": save ") && about.contains(if what == "preset" { "settings" } else { what }),
                "{about}"
            );
        }
    }

    #[test]
    fn no_key_makes_an_event_that_is_refused() {
        let mut count = 0;
        for key in Key::ALL {
            for modifiers in [Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND] {
                let mut state = ViewerState::default();
                if let Some(event) = event(*key, modifiers, &state) {
                    state.update(event);
                    assert_eq!(state.message, None, "{key:?}");
                    count += 1;
                }
            }
        }
        assert!(count > 60, "{count}");
    }

    #[test]
    fn escape_leaves_what_covers_the_picture_and_nothing_else() {
        let escape = |state: &ViewerState| event(Key::Escape, Modifiers::NONE, state);
        assert_eq!(escape(&ViewerState::default()), None);
        let covered = ViewerState { has_key_sheet: true, is_full_screen: true, ..ViewerState::default() };
        assert_eq!(escape(&covered), Some(ViewerEvent::KeySheet));
        let mut all = ViewerState { has_price: true, has_panel: true, ..covered };
        let mut closed = Vec::new();
        while let Some(event) = escape(&all) {
            all.update(event.clone());
            closed.push(event);
        }
        let expected = [ViewerEvent::KeySheet, ViewerEvent::Price, ViewerEvent::Panel, ViewerEvent::FullScreen];
        assert_eq!(closed, expected);
    }
}
