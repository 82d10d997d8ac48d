//! The kinds of settings, and the errors for invalid texts.

use crate::error::{Error, ParseError};

/// The placeholder for the value of an option that is on or off.
pub const ON_OFF: &str = "ON|OFF";

/// The kind of a setting's values.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// Numbers separated by commas.
    Numbers {
        /// Number of values.
        count: usize,
        /// The least and greatest value that a panel offers; others may still be accepted.
        range: [f64; 2],
        /// Number of decimals worth showing; 0 if only whole numbers are accepted.
        decimals: usize,
    },
    /// One of a few names. A shell and a panel offer them; other texts may be accepted too.
    Choice(Vec<&'static str>),
    /// Like [`Kind::Choice`], but each name stands for values of several other settings. It is set before these, and
    /// never written.
    Recipe(Vec<&'static str>),
    /// Several of a few names, separated by commas.
    Several(Vec<&'static str>),
    /// `on` or `off`.
    Switch,
    /// `on` or `off`; on the command line, an option without a value turns it on.
    Flag,
    /// The path of an input file.
    File,
    /// A colour: a CSS name, `#rrggbb` or `rgb(r,g,b)`.
    Color,
    /// Colours for some of a few names: `NAME=COLOR`, separated by commas.
    Colors {
        /// The names that a panel offers.
        names: Vec<&'static str>,
        /// Complete values worth offering.
        offered: &'static [&'static str],
        /// An example that is not the default.
        example: &'static str,
    },
    /// A text with its own grammar, such as colours by class or a size.
    Text {
        /// Values worth offering.
        offered: &'static [&'static str],
        /// An example that is not the default.
        example: &'static str,
    },
}

impl Kind {
    /// The texts that a shell offers.
    pub fn offered(&self) -> Vec<&'static str> {
        /// Offered where a whole number has no other texts.
        const NUMBERS: [&str; 5] = ["0", "1", "2", "3", "4"];
        match self {
            Self::Numbers { count: 1, range: [low, high], decimals: 0 } if (0.0..5.0).contains(high) => {
                NUMBERS[*low as usize..=*high as usize].to_vec()
            }
            Self::Choice(names) | Self::Recipe(names) | Self::Several(names) => names.clone(),
            Self::Text { offered, .. } | Self::Colors { offered, .. } => offered.to_vec(),
            Self::Switch => vec!["on", "off"],
            Self::Numbers { .. } | Self::Flag | Self::File | Self::Color => Vec::new(),
        }
    }

    /// Texts for tests: each is valid, and at least one is not `default`. The caller must create the file of a file
    /// setting.
    pub fn samples(&self, default: &str) -> Vec<String> {
        match self {
            Self::Numbers { count, range: [low, high], decimals } => {
                let number = |share: f64| {
                    let text = format!("{:.decimals$}", low + (high - low) * share);
                    text.parse::<f64>().map_or(text, |number| number.to_string())
                };
                [0.0, 0.4, 0.7, 1.0].map(|share| vec![number(share); *count].join(",")).to_vec()
            }
            Self::Switch | Self::Flag => vec![on_off(default != "on").to_owned()],
            Self::Text { example, .. } | Self::Colors { example, .. } => vec![(*example).to_owned()],
            Self::Color => vec!["rgb(10.5 20 30)".to_owned()],
            Self::Choice(names) | Self::Recipe(names) | Self::Several(names) => {
                names.iter().map(|name| (*name).to_owned()).collect()
            }
            Self::File => Vec::new(),
        }
    }
}

/// Returns `on` or `off`.
pub fn on_off(is_on: bool) -> &'static str {
    if is_on { "on" } else { "off" }
}

/// Why a text is invalid for a setting.
#[derive(Debug)]
pub enum Problem {
    /// The text is invalid in any context: a sentence without the setting's name.
    Text(String),
    /// The text is valid, but its value is refused.
    Refused(Error),
}

impl From<String> for Problem {
    fn from(problem: String) -> Self {
        Self::Text(problem)
    }
}

impl From<ParseError> for Problem {
    fn from(ParseError(problem): ParseError) -> Self {
        Self::Text(problem)
    }
}

impl From<Error> for Problem {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}
