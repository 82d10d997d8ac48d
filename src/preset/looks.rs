//! The looks: pictures for users who need not match a paper, each a TOML file in `presets/looks`.

use super::{OptionValue, Preset};
use crate::choice::meant_or;
use crate::error::{ParseError, Result};
use crate::settings::names_of;
use crate::styles::StyleName;
use std::str::FromStr;

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
        name: "sketch",
        about: "charcoal on paper with tooth, strokes of a hand and faint outlines",
        text: include_str!("../../presets/looks/sketch.toml"),
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
        let problem = || match name {
            "charcoal" => "charcoal is the name of a style; the look of earlier versions is sketch now".to_owned(),
            _ => meant_or(name, &names, &format!("choose one of {}", Self::list())),
        };
        found.ok_or_else(|| ParseError::from(problem()))
    }

    /// All names with commas between.
    pub(crate) fn list() -> String {
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

/// A style as published, or a look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StyleOrLook {
    /// A style.
    Style(StyleName),
    /// A look.
    Look(Look),
}

impl StyleOrLook {
    /// All names, those of styles first.
    pub fn names() -> Vec<&'static str> {
        names_of::<StyleName>().into_iter().chain(LOOKS.map(|look| look.name)).collect()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Style(style) => style.name(),
            Self::Look(look) => look.name,
        }
    }
}

impl FromStr for StyleOrLook {
    type Err = ParseError;

    fn from_str(name: &str) -> std::result::Result<Self, ParseError> {
        let look = || LOOKS.into_iter().find(|look| look.name == name).map(Self::Look);
        let named = name.parse().ok().map(Self::Style).or_else(look);
        let names = Self::names();
        named.ok_or_else(|| ParseError::from(meant_or(name, &names, &format!("choose one of {}", names.join(", ")))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_and_looks_have_names_of_their_own() {
        let names = StyleOrLook::names();
        for (number, name) in names.iter().enumerate() {
            assert!(!names[..number].contains(name), "{name} means two things");
            assert_eq!(name.parse::<StyleOrLook>().unwrap().name(), *name);
        }
        assert!("sketsch".parse::<StyleOrLook>().unwrap_err().to_string().contains("did you mean sketch?"));
        let gone = Look::of_name("charcoal").unwrap_err().to_string();
        assert_eq!(gone, "charcoal is the name of a style; the look of earlier versions is sketch now");
    }
}
