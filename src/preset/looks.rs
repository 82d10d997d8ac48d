//! The looks: pictures for users who need not match a paper, each a TOML file in `presets/looks`.

use super::{OptionValue, Preset};
use crate::choice::meant_or;
use crate::error::{ParseError, Result};
use crate::styles::StyleName;

/// A look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// Its name.
    pub name: &'static str,
    /// One line that describes the look.
    pub about: &'static str,
    text: &'static str,
}

/// All looks. The first is the default. Static: a program holds their texts once.
pub static LOOKS: [Look; 4] = [
    Look {
        name: "print",
        about: "ink for paper at any size: even lines, three tones, the model's own colours",
        text: include_str!("../../presets/looks/print.toml"),
    },
    Look {
        name: "technical",
        about: "vectors as in a manual: parallel projection, thick outline, thin inner lines",
        text: include_str!("../../presets/looks/technical.toml"),
    },
    Look {
        name: "charcoal",
        about: "charcoal on paper with tooth, strokes of a hand and faint outlines",
        text: include_str!("../../presets/looks/charcoal.toml"),
    },
    Look { name: "published", about: "each style as its text prints it; three-pass without --style", text: "" },
];

impl Look {
    /// The one of this name.
    ///
    /// # Errors
    ///
    /// Returns the look of a name.
    pub fn of_name(name: &str) -> std::result::Result<Self, ParseError> {
        let found = LOOKS.into_iter().find(|look| look.name == name);
        let names = LOOKS.map(|look| look.name);
        found.ok_or_else(|| ParseError::from(meant_or(name, &names, &format!("choose one of {}", Self::list()))))
    }

    /// All names with commas between.
    pub fn list() -> String {
        LOOKS.map(|look| look.name).join(", ")
    }

    /// Whether it draws lines, as vectors.
    pub fn draws_lines(self) -> bool {
        let style = self.preset().ok().and_then(|preset| preset.options.get("style").cloned());
        matches!(style, Some(OptionValue::Text(style)) if style.parse().is_ok_and(StyleName::draws_lines))
    }

    /// Whether it sets anything.
    pub fn has_settings(self) -> bool {
        !self.text.is_empty()
    }

    /// Its settings.
    ///
    /// # Errors
    ///
    /// None in practice: a test reads them all.
    pub fn preset(self) -> Result<Preset> {
        Preset::parse(&format!("look {}", self.name), self.text)
    }
}
