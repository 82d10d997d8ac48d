//! What a setting can be, and what is wrong with a text that is none of it.

use crate::error::{Error, ParseError};

/// What options that are on or off call their value.
pub const ON_OFF: &str = "ON|OFF";

/// What a setting can be.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// Numbers with commas between.
    Numbers {
        /// How many.
        count: usize,
        /// Least and most that a panel offers; what is beyond may be refused or not.
        range: [f64; 2],
        /// So many decimals are worth showing; none where only whole numbers are read.
        decimals: usize,
    },
    /// One of a few names; a shell and a panel offer them, and other texts may be read too.
    Choice(Vec<&'static str>),
    /// The same, and each name stands for values of several other settings. It is set before these, and never written.
    Recipe(Vec<&'static str>),
    /// Some of a few names with commas between.
    Several(Vec<&'static str>),
    /// `on` or `off`.
    Switch,
    /// `on` or `off`, and on the command line an option without a value where it is on.
    Flag,
    /// The path of a file that is read.
    File,
    /// A colour: a CSS name, `#rrggbb` or `rgb(r,g,b)`.
    Color,
    /// Colours for some of a few names: `NAME=COLOR`, with commas between.
    Colors {
        /// The names that a panel offers.
        names: Vec<&'static str>,
        /// Some whole values worth offering.
        offered: &'static [&'static str],
        /// One that is not the default.
        example: &'static str,
    },
    /// A text of its own grammar: colours by class, a size.
    Text {
        /// Some values worth offering.
        offered: &'static [&'static str],
        /// One that is not the default.
        example: &'static str,
    },
}

impl Kind {
    /// The texts that a shell offers.
    pub fn offered(&self) -> Vec<&'static str> {
        /// Whole numbers are offered where there are no others.
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

    /// Texts to try: each is read, and one at least is not `default`. A file is made by whoever tries.
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

/// `on` or `off`.
pub fn on_off(is_on: bool) -> &'static str {
    if is_on { "on" } else { "off" }
}

/// Why a text is no value of a setting.
#[derive(Debug)]
pub enum Problem {
    /// It does not say such a value, whatever the rest is. A sentence without the setting's name.
    Text(String),
    /// It says one, which cannot be had.
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
