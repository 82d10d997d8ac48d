//! The frame to read of an animated model: a number, possibly between two frames, or a name.

use crate::error::{Error, ParseError, Result};
use crate::settings::{Kind, Problem, Value};
use std::{fmt, str::FromStr};

/// A frame, as the user writes it.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelFrame {
    /// Counted from 0; a fraction interpolates linearly between two frames.
    Number(f64),
    /// By its name in the file, in any case.
    Name(String),
}

impl Default for ModelFrame {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl fmt::Display for ModelFrame {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(out),
            Self::Name(name) => name.fmt(out),
        }
    }
}

impl FromStr for ModelFrame {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        match text.parse::<f64>() {
            Ok(number) if number < 0.0 => Err("frames are counted from 0".to_owned().into()),
            Ok(number) if number.is_finite() => Ok(Self::Number(number)),
            _ if text.is_empty() => Err("give a frame's number or name".to_owned().into()),
            _ => Ok(Self::Name(text.to_owned())),
        }
    }
}

impl Value for ModelFrame {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "run3" }
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// Two neighbouring frames, by number, and how far the wanted one lies from the first towards the second, in [0, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Between {
    pub first: usize,
    pub second: usize,
    pub share: f64,
}

impl ModelFrame {
    /// Finds the frame among those of a file, named in order; there is at least one.
    pub(super) fn find(&self, names: &[String], path: &str) -> Result<Between> {
        let last = names.len().saturating_sub(1);
        let refused = |problem: String| Error::value("model-frame", self, problem);
        let number = match self {
            Self::Number(number) => *number,
            Self::Name(wanted) => match names.iter().position(|name| name.eq_ignore_ascii_case(wanted)) {
                Some(number) => number as f64,
                None => return Err(refused(format!("{path} has no frame of that name; it has {}", a_few(names)))),
            },
        };
        if !(0.0..=last as f64).contains(&number) {
            let count = if last == 0 { "1 frame".to_owned() } else { format!("{} frames", names.len()) };
            return Err(refused(format!("{path} has {count}; give a number from 0 to {last}, or a name")));
        }
        let first = number.floor() as usize;
        Ok(Between { first, second: (first + 1).min(last), share: number.fract() })
    }

    /// Rejects any frame except the first of a model without frames.
    pub(super) fn check_still(&self, path: &str) -> Result<()> {
        if *self == Self::default() {
            return Ok(());
        }
        Err(Error::value(
            "model-frame",
            self,
            format!("{path} has no frames; leave the option out, or name an MD2 model"),
        ))
    }
}

/// The first frame of each movement, as far as they fit into a sentence.
fn a_few(names: &[String]) -> String {
    const MOST: usize = 6;
    let movement = |name: &String| name.trim_end_matches(|letter: char| letter.is_ascii_digit()).to_owned();
    let mut firsts: Vec<&String> = names.iter().collect();
    firsts.dedup_by_key(|name| movement(name));
    let listed: Vec<&str> = firsts.iter().take(MOST).map(|name| name.as_str()).collect();
    let more = if listed.len() < names.len() { " and others" } else { "" };
    format!("{}{more}", listed.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Vec<String> {
        ["stand01", "stand02", "run1", "run2"].map(str::to_owned).to_vec()
    }

    fn find(text: &str) -> std::result::Result<Between, String> {
        let frame: ModelFrame = text.parse()?;
        frame.find(&names(), "a.md2").map_err(|error| error.to_string())
    }

    #[test]
    fn frames_are_found_by_number_fraction_and_name() {
        assert_eq!(find("0"), Ok(Between { first: 0, second: 1, share: 0.0 }));
        assert_eq!(find("1.25"), Ok(Between { first: 1, second: 2, share: 0.25 }));
        assert_eq!(find("3"), Ok(Between { first: 3, second: 3, share: 0.0 }));
        assert_eq!(find("Run1"), Ok(Between { first: 2, second: 3, share: 0.0 }));
    }

    #[test]
    fn frames_that_are_not_there_are_refused_with_those_that_are() {
        assert_eq!(
            find("3.5").unwrap_err(),
            "model-frame 3.5: a.md2 has 4 frames; give a number from 0 to 3, or a name"
        );
        assert_eq!(
            find("jump").unwrap_err(),
            "model-frame jump: a.md2 has no frame of that name; it has stand01, run1 and others"
        );
        assert!(find("-1").unwrap_err().contains("counted from 0"));
        assert!(find("").is_err() && find("nan").unwrap_err().contains("no frame of that name"));
        for number in [f64::NAN, f64::INFINITY, -0.5] {
            assert!(ModelFrame::Number(number).find(&names(), "a.md2").is_err());
            assert!(ModelFrame::Number(number).check_still("a.obj").is_err());
        }
        let one = ModelFrame::Number(1.0).find(&names()[..1], "a.md2").unwrap_err().to_string();
        assert!(one.contains("has 1 frame; give a number from 0 to 0"), "{one}");
    }
}
