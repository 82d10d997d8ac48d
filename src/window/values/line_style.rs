//! The settings of exact lines in the window's panel.

/// The settings of exact lines that the panel shows and sets: the others are of files and of paper, and count where a drawing is saved.
pub(in crate::window) const LINE_SETTINGS: [&str; 10] = [
    "classes",
    "crease-angle",
    "lasting-creases",
    "form-lines",
    "curvature-smoothing",
    "class-colors",
    "line-width",
    "hidden",
    "class-widths",
    "min-length",
];

/// How a side shows exact lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LinesShown {
    /// No lines.
    None,
    /// They lie over the style's picture.
    Over,
    /// They are the picture, on its background.
    Alone,
}
