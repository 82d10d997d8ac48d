//! How values are written and read: each type's text reads back as the same value.

use super::{Choice, Kind, Problem, on_off};
use crate::values::{Background, Color, Size};
use glam::DVec3;
use std::path::PathBuf;

/// A type of a setting's field.
pub trait Value: Sized {
    /// The kind of its texts.
    fn kind() -> Kind;

    /// Returns its text.
    fn text(&self) -> String;

    /// Parses a text.
    ///
    /// # Errors
    ///
    /// A description of the problem.
    fn parse(text: &str) -> Result<Self, Problem>;
}

/// The names of a choice.
pub fn names_of<T: Choice>() -> Vec<&'static str> {
    T::NAMED.iter().map(|(name, _)| *name).collect()
}

impl<T: Choice> Value for T {
    fn kind() -> Kind {
        Kind::Choice(names_of::<T>())
    }

    fn text(&self) -> String {
        self.choice_name().to_owned()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(T::of_name(text)?)
    }
}

/// A type of number, with its decimals: 0 for whole numbers.
trait Number: std::str::FromStr + ToString + Copy {
    const DECIMALS: usize;
    const USAGE: &'static str;
}

fn kind_of<N: Number>(count: usize) -> Kind {
    Kind::Numbers { count, range: [0.0, 1.0], decimals: N::DECIMALS }
}

fn number<N: Number>(text: &str) -> Result<N, Problem> {
    text.trim().parse().map_err(|_| Problem::Text(N::USAGE.to_owned()))
}

fn numbers<N: Number, const COUNT: usize>(text: &str) -> Result<[N; COUNT], Problem> {
    let numbers: Option<Vec<N>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| format!("give {COUNT} numbers separated by commas, without blanks").into())
}

fn joined<N: Number>(numbers: &[N]) -> String {
    numbers.iter().map(N::to_string).collect::<Vec<_>>().join(",")
}

/// Implements [`Value`] for number types.
///
/// A macro, because a blanket implementation would conflict with that for every [`Choice`].
macro_rules! numbers {
    ($($number:ty: $decimals:literal, $usage:literal;)+) => {$(
        impl Number for $number {
            const DECIMALS: usize = $decimals;
            const USAGE: &'static str = $usage;
        }

        impl Value for $number {
            fn kind() -> Kind {
                kind_of::<Self>(1)
            }

            fn text(&self) -> String {
                self.to_string()
            }

            fn parse(text: &str) -> Result<Self, Problem> {
                number(text)
            }
        }
    )+};
}

numbers! {
    f32: 2, "give a number";
    f64: 2, "give a number";
    u8: 0, "give a whole number from 0 to 255";
    u32: 0, "give a whole number, 0 or more";
    u64: 0, "give a whole number, 0 or more";
}

impl<const COUNT: usize> Value for [f32; COUNT] {
    fn kind() -> Kind {
        kind_of::<f32>(COUNT)
    }

    fn text(&self) -> String {
        joined(self)
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        numbers(text)
    }
}

impl Value for DVec3 {
    fn kind() -> Kind {
        Kind::Numbers { count: 3, range: [-1.0, 1.0], decimals: 2 }
    }

    fn text(&self) -> String {
        joined(&self.to_array())
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        numbers(text).map(Self::from_array)
    }
}

impl Value for bool {
    fn kind() -> Kind {
        Kind::Switch
    }

    fn text(&self) -> String {
        on_off(*self).to_owned()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        match text {
            "on" => Ok(true),
            "off" => Ok(false),
            _ => Err("choose on or off".to_owned().into()),
        }
    }
}

impl Value for Size {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "96x64" }
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl Value for Color {
    fn kind() -> Kind {
        Kind::Color
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl Value for Background {
    fn kind() -> Kind {
        Kind::Color
    }

    fn text(&self) -> String {
        match self {
            Self::Color(color) => color.to_string(),
            Self::Transparent => "transparent".to_owned(),
        }
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(if text == "transparent" { Self::Transparent } else { Self::Color(text.parse()?) })
    }
}

impl Value for PathBuf {
    fn kind() -> Kind {
        Kind::File
    }

    /// A file name that is not UTF-8 keeps its valid parts.
    fn text(&self) -> String {
        self.to_string_lossy().into_owned()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(Self::from(text))
    }
}

impl Value for String {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "text" }
    }

    fn text(&self) -> String {
        self.clone()
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.to_owned())
    }
}
