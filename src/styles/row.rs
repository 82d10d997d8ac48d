//! The contents of a style's row, and the macro that makes the styles from their rows.

use super::{LineStyle, Show, Style, StyleName};
use crate::error::Result;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::settings::Setting;

/// A style's row: its properties other than settings, which are declared with their struct.
#[derive(Debug)]
pub struct StyleInfo {
    /// Which style.
    pub style: StyleName,
    /// Its name as the user writes it.
    pub name: &'static str,
    /// Its pictures, the finished one first.
    pub shows: &'static [Show],
    /// Where it comes from.
    pub origin: Origin,
    /// Its mark in plots; `None` for a grey circle.
    pub mark: Option<Mark>,
    /// Whether it draws exact lines, without OpenGL or passes.
    pub draws_lines: bool,
    /// The style with the published settings.
    pub(super) published: fn() -> Style,
    /// Its settings.
    pub(super) settings: fn() -> Vec<Setting<Style>>,
}

/// The way a style with the settings `S` draws.
pub(super) enum Draw<S> {
    /// In passes, by OpenGL.
    Plan(fn(&S, &Scene, Show) -> Result<Plan>),
    /// Exact lines.
    Lines(fn(&S) -> LineStyle),
}

/// The origin of a style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A text of this year, whose values are the defaults.
    Published(u16),
    /// A text that names it without values.
    Named,
    /// This project.
    Own,
}

/// A style's mark in plots: a colour and a shape, either of which is sufficient. The colours suit the colour-blind (Okabe and Ito
/// 2008) and are visible on white and near black.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// Red, green and blue.
    pub rgb: [u8; 3],
    /// The shape.
    pub outline: Outline,
}

/// The shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle,
    /// A regular polygon.
    Polygon {
        /// How many corners.
        corners: usize,
        /// Angle of the first corner from the top, radians.
        turn: f64,
    },
    /// A five-pointed star.
    Star,
}

/// Makes [`Style`], [`StyleName`] and each style's special functions from the rows.
///
/// Without the macro a style would need code in six places: a variant of two types, match arms over them and a table entry.
macro_rules! styles {
    ($($(#[$about:meta])* $style:ident($settings:ty) {
        name: $name:literal, draw: $draw:expr, has_lines: $has_lines:expr, $($field:ident: $value:expr),*,
    })*) => {
        /// A style with its settings.
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        #[expect(clippy::large_enum_variant, reason = "a picture has one style: a box would save nothing")]
        pub enum Style {
            $($(#[$about])* $style($settings),)*
        }

        tinta_geometry::choices! {
            /// The styles' names.
            #[non_exhaustive]
            pub enum StyleName {
                $(#[doc = concat!("`", $name, "`")] $style = $name,)*
            }
        }

        /// Every style, in listing order.
        static STYLES: [StyleInfo; StyleName::ALL.len()] = [$(StyleInfo {
            style: StyleName::$style,
            name: $name,
            draws_lines: {
                let draw: Draw<$settings> = $draw;
                matches!(draw, Draw::Lines(_))
            },
            $($field: $value,)*
            published: || Style::$style(<$settings>::default()),
            settings: || {
                within(<$settings>::settings(), |style| if let Style::$style(it) = style { Some(it) } else { None })
                    .collect()
            },
        }),*];

        impl Style {
            /// Which style it is.
            pub fn style_name(&self) -> StyleName {
                match self {
                    $(Self::$style(_) => StyleName::$style,)*
                }
            }

            /// Whether the style draws lines that it can show alone.
            pub fn has_lines(&self) -> bool {
                match self {
                    $(Self::$style(settings) => {
                        let has_lines: fn(&$settings) -> bool = $has_lines;
                        has_lines(settings)
                    })*
                }
            }

            /// Returns the plan: GL's steps for this scene.
            ///
            /// # Errors
            ///
            /// [`crate::Error::Setting`] for an invalid setting, alone or with this scene or `show`, and for a style that draws
            /// exact lines.
            pub fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
                match self {
                    $(Self::$style(settings) => {
                        let draw: Draw<$settings> = $draw;
                        match draw {
                            Draw::Plan(plan) => plan(settings, scene, show),
                            Draw::Lines(_) => Err(no_passes($name)),
                        }
                    })*
                }
            }

            /// Returns its exact lines; `None` for a style that draws in passes.
            pub(crate) fn lines(&self) -> Option<LineStyle> {
                match self {
                    $(Self::$style(settings) => {
                        let draw: Draw<$settings> = $draw;
                        match draw {
                            Draw::Plan(_) => None,
                            Draw::Lines(lines) => Some(lines(settings)),
                        }
                    })*
                }
            }
        }
    };
}

pub(super) use styles;
