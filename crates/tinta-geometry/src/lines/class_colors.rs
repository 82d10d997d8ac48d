//! The colours of lines by their classes, and how wide they are: what drawings by GL and by SVG have in common.

use crate::edges::Class;
use crate::error::ParseError;
use crate::settings::{Kind, Problem, Setting, Value};
use crate::values::Color;
use std::str::FromStr;

/// A colour for each class of edges, in the order of [`Class::ALL`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClassColors(pub [Color; Class::ALL.len()]);

impl Default for ClassColors {
    fn default() -> Self {
        Self([Color([0.0; 3]); Class::ALL.len()])
    }
}

impl ClassColors {
    /// Outer lines red, inner ones blue: figure 6 of Evangelista et al. 2005.
    pub fn figure_6() -> Self {
        let is_outer = |class| matches!(class, Class::Boundary | Class::NonManifold | Class::Silhouette);
        let color = |class| if is_outer(class) { Color([0.9, 0.05, 0.05]) } else { Color([0.1, 0.2, 0.9]) };
        Self(Class::ALL.map(|(_, class)| color(class)))
    }
}

impl ClassColors {
    /// The setting of the colours.
    pub fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let help = "Colours of the lines by class: CLASS=COLOR, separated by commas, or figure-6 (outer red, inner \
                    blue); style lines too";
        Setting::field("class-colors", "COLORS", help, field)
            .printed("D, Inking: glColor3ub( 0, 0, 0 )")
            .labelled("class colours")
    }
}

impl Value for ClassColors {
    fn kind() -> Kind {
        let example = "silhouette=red,crease=rgb(1 2.5 3),normal=#010203";
        Kind::Text { offered: &["figure-6", "black"], example }
    }

    /// `CLASS=COLOR` of each class that is not black.
    fn text(&self) -> String {
        if *self == Self::figure_6() {
            return "figure-6".to_owned();
        }
        let colored = Class::ALL.iter().filter(|(_, class)| self.0[*class as usize] != Color([0.0; 3]));
        let texts: Vec<String> = colored.map(|(name, class)| format!("{name}={}", self.0[*class as usize])).collect();
        if texts.is_empty() { "black".to_owned() } else { texts.join(",") }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for ClassColors {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        match text {
            "figure-6" => return Ok(Self::figure_6()),
            "black" => return Ok(Self::default()),
            _ => {}
        }
        let mut colors = Self::default();
        for setting in text.split(',') {
            let usage = || "write figure-6, or CLASS=COLOR, separated by commas: silhouette=red,crease=blue".to_owned();
            let (class, color) = setting.split_once('=').ok_or_else(usage)?;
            colors.0[class.trim().parse::<Class>()? as usize] = color.trim().parse()?;
        }
        Ok(colors)
    }
}

/// The setting of how wide lines are.
pub fn line_width<T: Clone + 'static>(field: fn(&mut T) -> &mut f32) -> Setting<T> {
    let help = "Width of the lines in pixels, above 0 to 16384; style lines too";
    Setting::field("line-width", "PIXELS", help, field)
        .printed("D, Inking: glLineWidth( 2 )")
        .range(0.5, 40.0, 1)
        .common()
}
