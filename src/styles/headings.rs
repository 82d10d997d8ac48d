//! The headings of styles' settings, and the settings that several styles share.

use crate::settings::Setting;

/// The headings of the settings, in this order.
pub(super) const HEADINGS: [&str; 8] =
    [ALL_STYLES, CARTOON, INKING, "Style dietrich", "Style back-faces", IMAGE_SPACE, INK, CHARCOAL];

pub(super) const ALL_STYLES: &str = "All styles";
pub(super) const CARTOON: &str = "Styles three-pass, two-pass and mrt (published values are the paper's)";
pub(super) const INKING: &str = "Style inking: lines from the model's edges (published values are the text's)";
pub(super) const IMAGE_SPACE: &str = "Styles three-pass, two-pass, mrt and ink";
pub(super) const INK: &str = "Style ink (also the tone options of three-pass, --crease-angle of inking)";
pub(super) const CHARCOAL: &str = "Styles charcoal and sand (defaults are the text's where it gives them)";

/// Returns the setting that turns lines off.
pub(super) fn no_borders<T: Clone + 'static>(get: fn(&T) -> bool, set: fn(&mut T, bool)) -> Setting<T> {
    Setting::flag("no-borders", "Leave out the lines: draw tones or paint alone", get, set).labelled("no lines")
}

/// Returns the setting that skips faces turned away.
pub(super) fn cull<T: Clone + 'static>(field: fn(&mut T) -> &mut bool) -> Setting<T> {
    let help = "Faces to leave out: none, or back (those that point away): faster, and nearly the same picture of \
        closed models";
    Setting::either("cull", "FACES", ["none", "back"], help, field)
}
