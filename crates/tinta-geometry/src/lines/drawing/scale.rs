//! Drawing to scale: how long lengths of the model are on paper.

use crate::error::ParseError;
use crate::settings::{Kind, Problem, Value};
use std::str::FromStr;

/// A length on paper over that of the model: 1:2 is half.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale(pub(in crate::lines) f64);

/// Least and largest scale.
const SCALES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

crate::choices! {
    /// The length that a model's numbers count.
    #[derive(Default)]
    pub enum ModelUnit {
        /// Millimetres.
        #[default]
        Mm = "mm",
        /// Centimetres.
        Cm = "cm",
        /// Metres.
        M = "m",
        /// Inches.
        In = "in",
    }
}

impl ModelUnit {
    pub(in crate::lines) fn millimetres(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::M => 1000.0,
            Self::In => 25.4,
        }
    }
}

impl Scale {
    /// The length of the model that so many millimetres on paper show.
    pub fn of_model(self, millimetres: f64, unit: ModelUnit) -> f64 {
        millimetres / (self.0 * unit.millimetres())
    }

    /// The scale at which a unit of the model has so many pixels, on paper that has so many a millimetre.
    pub(in crate::lines) fn of_pixels(px_per_unit: f64, px_per_mm: f64, unit: ModelUnit) -> Self {
        Self(px_per_unit / (px_per_mm * unit.millimetres()))
    }

    /// The largest scale of ISO 5455 that is no larger: 1, 2 or 5 times a power of ten.
    pub(in crate::lines) fn rounded(self) -> Self {
        Self(round_below(self.0))
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is no larger than a number above 0.
pub(in crate::lines) fn round_below(number: f64) -> f64 {
    let power = 10_f64.powf(number.log10().floor());
    let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= number).unwrap_or(1.0);
    // In decimal, so that it is written with few digits.
    format!("{digit}e{}", power.log10().round()).parse().unwrap_or(number)
}

impl FromStr for Scale {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| *number > 0.0);
        let sides = text.split_once(':').and_then(|(paper, model)| Some(number(paper)? / number(model)?));
        sides
            .filter(|ratio| SCALES.contains(ratio))
            .map(Self)
            .ok_or_else(|| ParseError("write lengths on paper and in the model, such as 1:2, 2:1 or 1:2.5".to_owned()))
    }
}

impl Value for Scale {
    fn kind() -> Kind {
        Kind::Text { offered: &["1:1", "1:2", "1:5", "2:1"], example: "1:2" }
    }

    fn text(&self) -> String {
        // Rounded where a quotient of two numbers is no number of few digits.
        let side = |number: f64| format!("{number:.9}").trim_end_matches('0').trim_end_matches('.').to_owned();
        if self.0 >= 1.0 { format!("{}:1", side(self.0)) } else { format!("1:{}", side(1.0 / self.0)) }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse::<Self>()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_read_and_written_as_draughtsmen_write_them() {
        for text in ["1:2", "2:1", "1:1", "1:2.5", "1:1000", "20:1"] {
            assert_eq!(Scale::parse(text).unwrap_or(Scale(0.0)).text(), text);
        }
        assert_eq!("2:4".parse::<Scale>().map(|scale| scale.text()), Ok("1:2".to_owned()));
        for wrong in ["0", "1:0", "0:1", "-1:2", "1", "1:", ":2", "a:b", "1:2:3", "nan:1", "1e300:1"] {
            assert!(wrong.parse::<Scale>().is_err(), "{wrong}");
        }
        for (number, round) in [(7.3, 5.0), (4.99, 2.0), (1.0, 1.0), (0.034, 0.02), (99.0, 50.0), (1e-7, 1e-7)] {
            assert_eq!(round_below(number), round);
        }
    }
}
