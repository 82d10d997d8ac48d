//! Events of the viewer, as plain values: the mouse, the keys and the panel make them, a recording holds them.

use serde::{Deserialize, Serialize};

/// One of the two styles of a split view; the left one if there is a single style.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Left.
    #[default]
    Left,
    /// Right.
    Right,
}

/// How the two styles are laid out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Layout {
    /// The left style alone.
    #[default]
    Single,
    /// Both, one picture cut by a divider.
    Split,
    /// Both whole, and their difference as a third pane.
    Difference,
}

/// Something that happens.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ViewerEvent {
    /// The model is turned by a drag to the right and down, shares of a pane's height.
    Turn([f64; 2]),
    /// The model is moved by a drag, in the same units.
    Move([f64; 2]),
    /// It is brought nearer by this factor.
    Zoom(f64),
    /// The whole model from the default view.
    Reset,
    /// The whole model from a view, by its name or `AZIMUTH,ELEVATION`.
    View(String),
    /// From perspective to parallel projection or back.
    Projection,
    /// The style of a side, by its name.
    Style(Side, String),
    /// A setting of a side's style: option, value.
    Set(Side, String, String),
    /// The same back to the published value.
    Default(Side, String),
    /// Exact lines over the picture of a side, or not.
    Overlay(Side, bool),
    /// A setting of the exact lines: option, value.
    Lines(String, String),
    /// The same back to its default.
    LinesDefault(String),
    /// All of a side's settings back to the article's.
    Faithful(Side),
    /// The side that number keys and the panel are for.
    Choose(Side),
    /// How the two styles are laid out.
    Layout(Layout),
    /// From one, to both, to both and their difference, and back.
    NextLayout,
    /// The divider, share of the width.
    Divide(f64),
    /// The next buffer.
    NextBuffer,
    /// A buffer by its name, `final` for the finished picture.
    Buffer(String),
    /// Background colour.
    Background(String),
    /// A setting of the scene: option, value.
    Scene(String, String),
    /// The same back to its default.
    SceneDefault(String),
    /// Coarser pictures while the view moves, or not.
    Coarse(bool),
    /// The pixel under the pointer explained, or not.
    Explain,
    /// The pixel under the pointer: the side, and its place right and down from the upper left corner of the side's picture.
    Point(Side, [u32; 2]),
    /// The pass whose listing is shown: so many on.
    Pass(i32),
    /// The panel, shown or not.
    Panel,
    /// The key sheet.
    KeySheet,
    /// The errors of drawing, read.
    Dismiss,
    /// The end of the window.
    Quit,
    /// The whole screen.
    FullScreen,
    /// Times and errors, shown or not.
    Price,
    /// The drawing area's size, pixels.
    Resize([u32; 2]),
    /// How models are read, and they read again: option, value.
    Model(String, String),
    /// The same back to its default.
    ModelDefault(String),
    /// The system's dialogue to choose models in.
    Browse,
    /// Models to show instead, by their paths.
    Open(Vec<String>),
    /// The shown picture, into a file.
    SavePicture,
    /// The exact lines of this view, into a file.
    SaveLines,
    /// A turn around the model, into a file.
    SaveTurn,
    /// The side's settings, into a preset's file.
    SavePreset,
    /// A look on the active side, by its name.
    Look(String),
    /// Settings from a preset's file or by its name.
    OpenPreset(String),
}

impl ViewerEvent {
    /// Whether it writes a file.
    pub(in crate::window) fn saves(&self) -> bool {
        matches!(self, Self::SavePicture | Self::SaveLines | Self::SaveTurn | Self::SavePreset)
    }
}

/// An effect outside the state.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Let the user choose models.
    Browse,
    /// Read these models.
    Open(Vec<String>),
    /// Write a file of this kind.
    Save(Save),
    /// Cover the whole screen, or no longer.
    FullScreen(bool),
    /// Close the window.
    Quit,
}

/// Kinds of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Save {
    /// PNG of the shown picture.
    Picture,
    /// SVG of the exact lines.
    Lines,
    /// GIF of a turn.
    Turn,
    /// TOML.
    Preset,
}
