//! The distance within which ink and line count as the same: a share of the picture's height, which asks as much of a large picture
//! as of a small one.

use crate::error::ParseError;
use crate::scene::Size;
use crate::settings::{Kind, Problem, Value};
use std::str::FromStr;

/// A share of the picture's height. Default 1/256, 2 pixels of 512: half the width of the published borders, and their shift of one.
/// At least a pixel: half of a pen of two, which cannot be judged finer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineTolerance(f64);

impl LineTolerance {
    /// The largest: 64 pixels of 2048.
    const MOST: f64 = 1.0 / 32.0;

    /// Returns the same in pixels of a picture.
    pub fn px(self, size: Size) -> f64 {
        (self.0 * f64::from(size.height)).max(1.0)
    }
}

impl Default for LineTolerance {
    fn default() -> Self {
        Self(1.0 / 256.0)
    }
}

impl Value for LineTolerance {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "1/128" }
    }

    fn text(&self) -> String {
        let parts = 1.0 / self.0;
        let is_whole = (parts - parts.round()).abs() < 1e-9 * parts;
        if is_whole { format!("1/{}", parts.round()) } else { self.0.to_string() }
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.parse::<Self>()?)
    }
}

impl FromStr for LineTolerance {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let share = match text.split_once('/') {
            Some((part, whole)) => number(part).zip(number(whole)).map(|(part, whole)| part / whole),
            None => number(text),
        };
        share.filter(|share| *share > 0.0 && *share <= Self::MOST).map(Self).ok_or_else(|| {
            let problem = "it is a share of the picture's height, above 0 and at most 1/32; 1/256 are 2 pixels of 512";
            ParseError(problem.to_owned())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_read_as_a_fraction_or_a_number_and_written_as_read() {
        let size = Size { width: 300, height: 512 };
        for (text, px) in [("1/256", 2.0), ("0.00390625", 2.0), ("1/32", 16.0), ("3/1024", 1.5)] {
            let tolerance = LineTolerance::parse(text).unwrap_or_default();
            assert!((tolerance.px(size) - px).abs() < 1e-12, "{text}");
            assert_eq!(LineTolerance::parse(&tolerance.text()).ok(), Some(tolerance), "{text}");
        }
        assert_eq!(LineTolerance::default().text(), "1/256");
        assert_eq!(LineTolerance::default().px(Size { width: 128, height: 128 }), 1.0, "half a pen of two pixels");
        for wrong in ["0", "-1/256", "2", "1/0", "1/", "nan", "inf", "0/0", "1/31", "2 px", ""] {
            assert!(LineTolerance::parse(wrong).is_err(), "{wrong}");
        }
    }
}
