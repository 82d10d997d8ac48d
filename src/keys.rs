//! The keys in the window of `tinta view` and on the page in a browser: one table for both, and for the sheets that list it.
//!
//! ```
//! use tinta::keys::{Action, action};
//!
//! let pressed = |key: &'static str| move |name: &str| name.eq_ignore_ascii_case(key);
//! assert_eq!(action(pressed("f"), false, false), Some(Action::View("front")));
//! assert_eq!(action(pressed("f"), true, false), Some(Action::View("back")), "with Shift");
//! ```

use crate::styles::StyleName;
use serde::Serialize;

/// The effect of a key. The window and the page decide which side it affects and what follows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Action {
    /// Turn the model to the right and down, shares of the picture's height.
    Turn([f64; 2]),
    /// Move it so.
    Move([f64; 2]),
    /// Bring it nearer by a factor.
    Zoom(f64),
    /// Move the divider to the right, a share of the width.
    Divide(f64),
    /// Look from a named view.
    View(&'static str),
    /// Choose a style by its number in [`StyleName::ALL`].
    Style(usize),
    /// Show exact lines alone.
    Lines,
    /// Lay exact lines over the picture, or not.
    Overlay,
    /// The next layout: one style, two with a divider, two and their difference.
    Layout,
    /// The other side is the one that keys change.
    OtherSide,
    /// The next buffer.
    Buffer,
    /// The pixel under the pointer explained, or not.
    Explain,
    /// The pass whose listing is shown: so many passes on.
    Pass(i32),
    /// The panel of settings.
    Panel,
    /// Coarser pictures while the model moves, or not.
    Coarse,
    /// Times and errors.
    Price,
    /// The first view.
    Reset,
    /// Perspective or parallel.
    Projection,
    /// Save the picture.
    SavePicture,
    /// Save the drawing as vectors.
    SaveLines,
    /// Save a turn.
    SaveTurn,
    /// Save style and settings.
    SavePreset,
    /// Full screen, or not.
    FullScreen,
    /// The system's dialogue to choose models in.
    Open,
    /// The sheet of keys.
    KeySheet,
    /// Close the sheet, the explanation, times, panel or full screen.
    Close,
    /// Quit.
    Quit,
}

/// A modifier held down with a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum With {
    /// No modifier, or one without a meaning for this key.
    Nothing,
    Shift,
    /// Ctrl, or the command key on systems that have one.
    Ctrl,
}

/// A line of the sheet, with its keys' actions. Keys have the names of `KeyboardEvent.key` in browsers.
struct Row {
    keys: &'static str,
    what: &'static str,
    /// Whether the page has it too.
    is_on_page: bool,
    bindings: &'static [(&'static str, With, Action)],
}

/// Turn or move of an arrow key, shares of the picture's height.
const STEP: f64 = 1.0 / 24.0;

/// Zoom factor of + and -.
const ZOOM: f64 = 1.25;

/// Move of the divider by `[` and `]`, share of the width.
const DIVIDE: f64 = 0.05;

/// A placeholder for the styles' names.
const STYLES: &str = "STYLES";

/// A row that the page has too.
const fn row(keys: &'static str, what: &'static str, bindings: &'static [(&'static str, With, Action)]) -> Row {
    Row { keys, what, is_on_page: true, bindings }
}

/// A row of the window alone.
const fn window(keys: &'static str, what: &'static str, bindings: &'static [(&'static str, With, Action)]) -> Row {
    Row { is_on_page: false, ..row(keys, what, bindings) }
}

use Action::{
    Buffer, Close, Coarse, Divide, Explain, FullScreen, KeySheet, Layout, Lines, Move, Open, OtherSide, Overlay, Panel,
    Pass, Price, Projection, Quit, Reset, SaveLines, SavePicture, SavePreset, SaveTurn, Style, Turn, View, Zoom,
};
use With::{Ctrl, Nothing, Shift};

const ROWS: &[Row] = &[
    row("drag", "turn the model", &[]),
    row("right drag, Shift drag", "move it", &[]),
    row("wheel, pinch", "nearer, farther", &[]),
    row(
        "1 to 9",
        STYLES,
        &[
            ("1", Nothing, Style(0)),
            ("2", Nothing, Style(1)),
            ("3", Nothing, Style(2)),
            ("4", Nothing, Style(3)),
            ("5", Nothing, Style(4)),
            ("6", Nothing, Style(5)),
            ("7", Nothing, Style(6)),
            ("8", Nothing, Style(7)),
            ("9", Nothing, Style(8)),
        ],
    ),
    window("0", "lines: exact lines alone", &[("0", Nothing, Lines)]),
    window("E", "exact lines over the picture, or not", &[("E", Nothing, Overlay)]),
    window("S", "one style; two with a divider to drag; two and their difference", &[("S", Nothing, Layout)]),
    row("O", "the other side: its style by number, its settings in the panel", &[("O", Nothing, OtherSide)]),
    row("B", "buffers: map, normals, depth, borders, tones, edge classes", &[("B", Nothing, Buffer)]),
    window("W", "why: the shader at the pixel under the pointer, with its values", &[("W", Nothing, Explain)]),
    window("N, Shift N", "there the next pass, the one before", &[("N", Nothing, Pass(1)), ("N", Shift, Pass(-1))]),
    window("Space", "panel with every setting", &[("Space", Nothing, Panel)]),
    window("C", "coarser pictures while the model moves, or not", &[("C", Nothing, Coarse)]),
    window("M", "time of each pass, error against the exact lines", &[("M", Nothing, Price)]),
    row("R", "whole model, first view", &[("R", Nothing, Reset)]),
    row("F, Shift F", "from the front, from the back", &[("F", Nothing, View("front")), ("F", Shift, View("back"))]),
    row("L, Shift L", "from the left, from the right", &[("L", Nothing, View("left")), ("L", Shift, View("right"))]),
    row("T, Shift T", "from the top, from below", &[("T", Nothing, View("top")), ("T", Shift, View("bottom"))]),
    row("I", "from a corner (iso)", &[("I", Nothing, View("iso"))]),
    row("P", "perspective or parallel projection", &[("P", Nothing, Projection)]),
    row(
        "arrows, Shift arrows",
        "turn, move",
        &[
            ("ArrowLeft", Nothing, Turn([-STEP, 0.0])),
            ("ArrowLeft", Shift, Move([-STEP, 0.0])),
            ("ArrowRight", Nothing, Turn([STEP, 0.0])),
            ("ArrowRight", Shift, Move([STEP, 0.0])),
            ("ArrowUp", Nothing, Turn([0.0, -STEP])),
            ("ArrowUp", Shift, Move([0.0, -STEP])),
            ("ArrowDown", Nothing, Turn([0.0, STEP])),
            ("ArrowDown", Shift, Move([0.0, STEP])),
        ],
    ),
    row(
        "+ and -",
        "nearer, farther",
        &[("+", Nothing, Zoom(ZOOM)), ("=", Nothing, Zoom(ZOOM)), ("-", Nothing, Zoom(1.0 / ZOOM))],
    ),
    row(
        "[ and ]",
        "divider to the left, to the right",
        &[("[", Nothing, Divide(-DIVIDE)), ("]", Nothing, Divide(DIVIDE))],
    ),
    row("Ctrl S", "save the picture that is shown (PNG)", &[("S", Ctrl, SavePicture)]),
    row("Ctrl L", "save lines and tones of this view (SVG)", &[("L", Ctrl, SaveLines)]),
    window("Ctrl T", "save a turn around the model (GIF)", &[("T", Ctrl, SaveTurn)]),
    window("Ctrl P", "save style and settings (preset, TOML)", &[("P", Ctrl, SavePreset)]),
    window("Ctrl O", "open a model", &[("O", Ctrl, Open)]),
    window("drop a file", "show that model; a preset (.toml): its style and settings", &[]),
    window("F11", "full screen", &[("F11", Nothing, FullScreen)]),
    row("H, ?", "this sheet", &[("H", Nothing, KeySheet), ("?", Nothing, KeySheet)]),
    window("Esc", "close the sheet, why, times, panel or full screen", &[("Escape", Nothing, Close)]),
    window("Q", "quit", &[("Q", Nothing, Quit), ("Q", Ctrl, Quit)]),
];

/// Returns the lines of the sheet of keys: keys and their effects, either all of the window's or those that the page has.
pub fn sheet(is_page: bool) -> impl Iterator<Item = (&'static str, String)> {
    // Styles after the ninth have no key.
    let names: Vec<&str> = StyleName::ALL.iter().map(|(name, _)| *name).take(9).collect();
    let rows = ROWS.iter().filter(move |row| row.is_on_page || !is_page);
    rows.map(move |row| (row.keys, row.what.replace(STYLES, &names.join(", "))))
}

/// Returns the window's sheet text for the key of an action, or `None` if it has no key.
pub fn about(action: Action) -> Option<String> {
    let row = ROWS.iter().find(|row| row.bindings.iter().any(|(.., does)| *does == action))?;
    Some(format!("{}: {}", row.keys, row.what))
}

/// Returns the [`Action`] of the key whose name satisfies `is_key`, or `None`. Shift counts where it has a meaning with the key.
pub fn action(is_key: impl Fn(&str) -> bool, has_shift: bool, has_ctrl: bool) -> Option<Action> {
    let bindings = || ROWS.iter().flat_map(|row| row.bindings).filter(|(key, ..)| is_key(key));
    let of = |with: With| bindings().find(|binding| binding.1 == with).map(|(.., action)| *action);
    match (has_ctrl, has_shift) {
        (true, _) => of(Ctrl),
        (false, true) => of(Shift).or_else(|| of(Nothing)),
        (false, false) => of(Nothing),
    }
}

/// The names of all keys that do something.
#[cfg(all(test, feature = "window"))]
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    ROWS.iter().flat_map(|row| row.bindings).map(|(key, ..)| *key)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn done(key: &str, has_shift: bool, has_ctrl: bool) -> Option<Action> {
        action(|name| name.eq_ignore_ascii_case(key), has_shift, has_ctrl)
    }

    #[test]
    fn keys_do_what_their_row_says_with_and_without_shift_and_ctrl() {
        assert_eq!(done("f", false, false), Some(View("front")));
        assert_eq!(done("F", true, false), Some(View("back")));
        assert_eq!(done("f", false, true), None);
        assert_eq!(done("s", false, false), Some(Layout));
        assert_eq!(done("S", true, false), Some(Layout));
        assert_eq!(done("s", false, true), Some(SavePicture));
        assert_eq!(done("ArrowUp", false, false), Some(Turn([0.0, -STEP])));
        assert_eq!(done("10", false, false), None);
    }

    #[test]
    fn no_key_is_bound_twice_and_each_number_is_a_style() {
        let all: Vec<_> = ROWS.iter().flat_map(|row| row.bindings).collect();
        for (place, (key, with, _)) in all.iter().enumerate() {
            assert!(all[..place].iter().all(|(other, held, _)| (other, held) != (key, with)), "{key} {with:?}");
        }
        for number in 1..=9 {
            assert_eq!(done(&number.to_string(), false, false), Some(Style(number - 1)));
        }
        assert!(StyleName::ALL.len() >= 9);
    }

    #[test]
    fn the_page_has_a_part_of_the_windows_sheet() {
        let (window, page): (Vec<_>, Vec<_>) = (sheet(false).collect(), sheet(true).collect());
        assert!(page.len() > 15 && page.len() < window.len());
        assert!(page.iter().all(|row| window.contains(row)));
        assert!(page.iter().any(|(_, what)| what.contains("three-pass")));
    }

    #[test]
    fn a_browser_reads_an_action_as_a_name_with_or_without_a_value() {
        let text = |action: Action| serde_json::to_string(&action).unwrap();
        assert_eq!(text(Turn([0.5, 0.0])), r#"{"turn":[0.5,0.0]}"#);
        assert_eq!(text(OtherSide), r#""other-side""#);
    }
}
