//! The event of each key.

use crate::keys::{Action, action};
use crate::styles::StyleName;
use crate::window::values::event::{Side, ViewerEvent};
use crate::window::values::state::ViewerState;
use egui::{Key, Modifiers};

/// The things to save: each with its name and its key's action.
pub(in crate::window) const SAVES: [(&str, Action); 4] = [
    ("picture", Action::SavePicture),
    ("lines", Action::SaveLines),
    ("turn", Action::SaveTurn),
    ("preset", Action::SavePreset),
];

/// The event of a key; `None` for a key without an action.
pub(in crate::window) fn event(key: Key, modifiers: Modifiers, state: &ViewerState) -> Option<ViewerEvent> {
    event_of(action(|name| Key::from_name(name) == Some(key), modifiers.shift, modifiers.command)?, state)
}

/// The event of a key's action; `None` if it has nothing to close.
pub(in crate::window) fn event_of(action: Action, state: &ViewerState) -> Option<ViewerEvent> {
    let style = |name: &str| ViewerEvent::Style(state.active, name.to_owned());
    Some(match action {
        Action::Turn(step) => ViewerEvent::Turn(step),
        Action::Move(step) => ViewerEvent::Move(step),
        Action::Zoom(factor) => ViewerEvent::Zoom(factor),
        Action::Divide(by) => ViewerEvent::Divide(state.divider + by),
        Action::View(name) => ViewerEvent::View(name.to_owned()),
        Action::Style(number) => style(StyleName::ALL.get(number)?.0),
        Action::Lines => style(StyleName::Lines.name()),
        Action::Overlay => ViewerEvent::Overlay(state.active, !state.requests[state.active as usize].exact_lines),
        Action::Layout => ViewerEvent::NextLayout,
        Action::OtherSide => ViewerEvent::Choose(match state.active {
            Side::Left if state.sides().len() > 1 => Side::Right,
            _ => Side::Left,
        }),
        Action::Buffer => ViewerEvent::NextBuffer,
        Action::Explain => ViewerEvent::Explain,
        Action::Pass(passes) => ViewerEvent::Pass(passes),
        Action::Panel => ViewerEvent::Panel,
        Action::Coarse => ViewerEvent::Coarse(!state.is_coarse_while_moving),
        Action::Price => ViewerEvent::Price,
        Action::Reset => ViewerEvent::Reset,
        Action::Projection => ViewerEvent::Projection,
        Action::SavePicture => ViewerEvent::SavePicture,
        Action::SaveLines => ViewerEvent::SaveLines,
        Action::SaveTurn => ViewerEvent::SaveTurn,
        Action::SavePreset => ViewerEvent::SavePreset,
        Action::FullScreen => ViewerEvent::FullScreen,
        Action::Open => ViewerEvent::Browse,
        Action::KeySheet => ViewerEvent::KeySheet,
        Action::Close if state.has_key_sheet => ViewerEvent::KeySheet,
        Action::Close if state.explains => ViewerEvent::Explain,
        Action::Close if state.has_price => ViewerEvent::Price,
        Action::Close if state.has_panel => ViewerEvent::Panel,
        Action::Close if state.is_full_screen => ViewerEvent::FullScreen,
        Action::Close => return None,
        Action::Quit => ViewerEvent::Quit,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::about;

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
    }

    #[test]
    fn every_key_of_the_table_is_known_to_the_window() {
        for name in crate::keys::names() {
            let key = Key::from_name(name).unwrap_or_else(|| panic!("{name} is no key"));
            let is_done = [Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND].into_iter().any(|modifiers| {
                let open = ViewerState { has_panel: true, ..ViewerState::default() };
                event(key, modifiers, &open).is_some()
            });
            assert!(is_done, "{name} does nothing");
        }
    }

    #[test]
    fn what_is_saved_is_in_the_key_sheet() {
        for (what, action) in SAVES {
            let about = about(action).unwrap();
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
