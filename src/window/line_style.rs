//! The exact lines of a view as the window shows them: which lines there are and how they are drawn.

use crate::lines::{LineSettings, SvgSettings};
use crate::settings::{HasSettings, Table, under, within};
use std::sync::LazyLock;

/// What the style of exact lines is called.
pub(super) const LINES: &str = "lines";

/// The settings of exact lines that a window shows and sets: the others are of files and of paper.
pub const LINE_SETTINGS: [&str; 13] = [
    "classes",
    "crease-angle",
    "lasting-creases",
    "suggestive-threshold",
    "ridge-threshold",
    "apparent-ridge-threshold",
    "surface-crease-angle",
    "curvature-smoothing",
    "class-colors",
    "line-width",
    "hidden",
    "class-widths",
    "min-length",
];

/// What a side shows of the exact lines.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum LinesShown {
    /// Nothing.
    #[default]
    None,
    /// They lie over the style's picture.
    Over,
    /// They are the picture, on its background.
    Alone,
}

/// How exact lines look.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LineStyle {
    /// Which there are.
    pub(super) lines: LineSettings,
    /// How they are drawn.
    pub(super) drawing: SvgSettings,
}

impl LineStyle {
    /// From what says which lines there are and how they are drawn.
    pub fn new(lines: LineSettings, drawing: SvgSettings) -> Self {
        Self { lines, drawing }
    }

    /// What is to be found: outlines only where that shows.
    pub(super) fn wanted(&self) -> LineSettings {
        LineSettings { finds_outline: self.drawing.tells_outline(), ..self.lines.clone() }
    }
}

impl HasSettings for LineStyle {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<LineStyle>> = LazyLock::new(|| {
            let lines = within(LineSettings::settings(), |style: &mut LineStyle| Some(&mut style.lines));
            let drawing = within(SvgSettings::settings(), |style: &mut LineStyle| Some(&mut style.drawing));
            let all = lines.chain(drawing).filter(|setting| LINE_SETTINGS.contains(&setting.name));
            let settings = under("Exact lines of both sides", all.collect()).collect();
            Table { settings, defaults: vec![LineStyle::default()] }
        });
        &TABLE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::scene::Color;

    #[test]
    fn every_setting_of_the_window_is_one_of_the_drawings() {
        let names: Vec<&str> = LineStyle::table().settings.iter().map(|setting| setting.name).collect();
        assert_eq!(names.len(), LINE_SETTINGS.len(), "{names:?}");
        assert!(LINE_SETTINGS.iter().all(|name| names.contains(name)), "{names:?}");
    }

    #[test]
    fn outlines_are_looked_for_only_where_something_is_said_of_them() {
        let mut style = LineStyle::default();
        style.drawing.class_colors.0.set_class(Class::Crease, Color([1.0, 0.0, 0.0]));
        assert!(!style.wanted().finds_outline);
        style.drawing.class_colors.0.set_outline(Color([1.0, 0.0, 0.0]));
        assert!(style.wanted().finds_outline);
    }
}
