//! Finds options that change nothing in the drawn styles, for a warning to the user.

use super::{Style, StyleName};
use crate::lines::{DrawingSettings, LineSettings};
use crate::scene::SceneSettings;
use crate::settings::HasSettings;

/// Whether this option changes nothing in any of the styles; false for options outside the styles.
///
/// ```
/// use tinta::styles::is_ignored;
/// assert!(is_ignored("tones", &["charcoal"]) && !is_ignored("tones", &["three-pass"]));
/// assert!(!is_ignored("size", &["charcoal"]), "the scene's");
/// ```
pub fn is_ignored(option: &str, styles: &[&str]) -> bool {
    let has = |style: &&str| style.parse().is_ok_and(|style| style_has(style, option));
    Style::table().has(option) && !styles.iter().any(has)
}

/// Whether this is an option of styles that draw exact lines, and of no other.
pub fn is_of_lines_alone(option: &str) -> bool {
    let of_passes = StyleName::of_passes().any(|(_, style)| style_has(style, option));
    Style::table().has(option) && !of_passes
}

/// Whether this is an option of exact lines or of their drawing.
pub(crate) fn is_of_exact_lines(option: &str) -> bool {
    DrawingSettings::table().has(option) || LineSettings::table().has(option)
}

/// Whether this is an option of exact lines or of their drawing that the style, which OpenGL draws in passes, has as vectors too.
pub(crate) fn is_of_vectors(option: &str, style: StyleName) -> bool {
    let has_vectors = || Style::named(style).vectors(SceneSettings::default().size).is_some();
    is_of_exact_lines(option) && !style_has(style, option) && has_vectors()
}

fn style_has(style: StyleName, option: &str) -> bool {
    Style::table().find(&Style::named(style), option).is_some()
}
