//! Which options change nothing in the styles that are drawn, so that whoever gives one can be told.

use super::{Style, StyleName};
use crate::lines::{LineSettings, SvgSettings};
use crate::settings::HasSettings;

/// Whether this option changes nothing in any of the styles, of which `lines` is one; options that are no style's are not
/// meant.
///
/// ```
/// use tinta::styles::is_ignored;
/// assert!(is_ignored("tones", &["charcoal"]) && !is_ignored("tones", &["three-pass"]));
/// assert!(!is_ignored("size", &["charcoal"]), "the scene's");
/// ```
pub fn is_ignored(option: &str, styles: &[&str]) -> bool {
    let has = |style: &&str| match style.parse::<StyleName>() {
        Ok(name) => Style::table().find(&Style::named(name), option).is_some(),
        Err(_) => LineSettings::table().has(option) || SvgSettings::table().has(option),
    };
    Style::table().has(option) && !styles.iter().any(has)
}
