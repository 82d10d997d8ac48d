//! Lengths in a drawing: pixels, a share of the picture's height, millimetres on paper, or a multiple of the line
//! width.

use crate::error::{Error, ParseError, Result};
use crate::settings::{Kind, Problem, Setting, Value};
use std::fmt;
use std::str::FromStr;

/// A length in a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Pixels of the picture.
    Px(f64),
    /// Millimetres on paper; needs a drawing with a size on paper.
    Mm(f64),
    /// Hundredths of the picture's height, at least 0.7 pixels because thinner lines vanish on a screen.
    Percent(f64),
    /// [`Length::Percent`] for a drawing without a size on paper, millimetres for one that has it.
    ScreenOrPaper {
        /// Hundredths of the picture's height.
        percent: f64,
        /// Millimetres.
        mm: f64,
    },
    /// A multiple of the common line width; only for widths of classes.
    Times(f64),
}

/// The suffix of millimetres.
const MM: &str = "mm";

/// The suffix of shares of the picture's height.
const PERCENT: &str = "%";

/// The suffix of multiples of the line width.
const TIMES: &str = "x";

/// Least width of a share of the height, pixels.
const LEAST_SHARE_PX: f64 = 0.7;

/// The scale of lengths in one drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Pixels per millimetre; `None` if the drawing has no size on paper.
    pub px_per_mm: Option<f64>,
    /// The picture's height, pixels.
    pub height_px: f64,
}

impl Length {
    /// Converts to pixels. `None` for multiples, and for millimetres of a drawing without a size on paper.
    pub fn px(self, units: Units) -> Option<f64> {
        match self {
            Self::Times(_) => None,
            Self::ScreenOrPaper { percent, mm } => Self::Mm(mm).px(units).or_else(|| Self::Percent(percent).px(units)),
            Self::Px(px) => Some(px),
            Self::Mm(mm) => units.px_per_mm.map(|px| mm * px),
            Self::Percent(percent) => Some((units.height_px * percent / 100.0).max(LEAST_SHARE_PX)),
        }
    }

    /// Refuses millimetres for a drawing without a size on paper.
    pub(in crate::lines) fn check_unit(self, name: &str, has_paper: bool) -> Result<()> {
        if !matches!(self, Self::Mm(_)) || has_paper {
            return Ok(());
        }
        let problem = "the drawing has no size on paper; add --page A4, --width-mm or --dpi, or give pixels";
        Err(Error::value(name, self, problem))
    }

    /// Refuses multiples, except for widths of classes.
    pub(in crate::lines) fn check_is_no_multiple(self, name: &str) -> Result<()> {
        match self {
            Self::Times(_) => {
                Err(Error::value(name, self, "only --class-widths has multiples: outline=2x; give a length"))
            }
            _ => Ok(()),
        }
    }

    /// Whether the number passes the test; for [`Length::ScreenOrPaper`], both numbers.
    pub(in crate::lines) fn all(self, is_sound: impl Fn(f64) -> bool) -> bool {
        match self {
            Self::Px(number) | Self::Mm(number) | Self::Percent(number) | Self::Times(number) => is_sound(number),
            Self::ScreenOrPaper { percent, mm } => is_sound(percent) && is_sound(mm),
        }
    }
}

impl fmt::Display for Length {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Px(px) => write!(out, "{px}"),
            Self::Mm(mm) => write!(out, "{mm}{MM}"),
            Self::Percent(percent) => write!(out, "{percent}{PERCENT}"),
            Self::ScreenOrPaper { percent, mm } => write!(out, "{percent}{PERCENT}/{mm}{MM}"),
            Self::Times(times) => write!(out, "{times}{TIMES}"),
        }
    }
}

impl FromStr for Length {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let usage = || {
            "give a number of pixels, of millimetres on paper, or a share of the height: 2, 0.35mm or 0.3%; or a share and \
             its width on paper: 0.3%/0.35mm"
                .to_owned()
        };
        let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(usage);
        let text = text.trim();
        if let Some((screen, paper)) = text.split_once('/') {
            return match (screen.parse()?, paper.parse()?) {
                (Self::Percent(percent), Self::Mm(mm)) => Ok(Self::ScreenOrPaper { percent, mm }),
                _ => Err(usage().into()),
            };
        }
        if let Some(text) = text.strip_suffix(TIMES) {
            return Ok(Self::Times(number(text)?));
        }
        match (text.strip_suffix(MM), text.strip_suffix(PERCENT)) {
            (Some(text), _) => Ok(Self::Mm(number(text)?)),
            (_, Some(text)) => Ok(Self::Percent(number(text)?)),
            _ => Ok(Self::Px(number(text)?)),
        }
    }
}

impl Value for Length {
    fn kind() -> Kind {
        Kind::Numbers { count: 1, range: [0.0, 1.0], decimals: 2 }
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// A length on paper, millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Millimetres(pub f64);

impl Value for Millimetres {
    fn kind() -> Kind {
        Kind::Text { offered: &["10mm", "15mm", "20mm"], example: "10mm" }
    }

    fn text(&self) -> String {
        Length::Mm(self.0).to_string()
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        let text = text.trim();
        let number = text.strip_suffix(MM).unwrap_or(text).trim();
        Ok(Self(number.parse().map_err(|_| "give a number of millimetres: 15mm".to_owned())?))
    }
}

/// Name, value name and help of `--line-width`.
pub(in crate::lines) const LINE_WIDTH: (&str, &str, &str) = (
    "line-width",
    "PIXELS",
    "Width of the lines in pixels, up to 16384, or a share of the height (0.3%); of exact lines also millimetres on paper \
     (0.35mm), or a share on the screen and millimetres on paper (0.3%/0.35mm)",
);

/// The default as the help gives it.
pub(in crate::lines) const LINE_WIDTH_SAID: &str = "2; style lines with --page: 0.5mm";

/// The range that a panel offers.
pub(in crate::lines) const LINE_WIDTH_RANGE: (f64, f64, usize) = (0.5, 40.0, 1);

/// The setting of the line width for drawings by GL, which have no paper.
pub fn line_width<T: Clone + 'static>(field: fn(&mut T) -> &mut Length) -> Setting<T> {
    let (name, value_name, help) = LINE_WIDTH;
    let (low, high, decimals) = LINE_WIDTH_RANGE;
    let get = move |of: &T| field(&mut of.clone()).text();
    let set = move |of: &mut T, text: &str| {
        let length = Length::parse(text)?;
        if matches!(length, Length::Mm(_) | Length::Times(_)) {
            let problem = "a picture of pixels has no millimetres; give pixels, or write a .svg or .pdf";
            return Err(Error::value(name, text, problem).into());
        }
        *field(of) = length;
        Ok(())
    };
    Setting::of(name, value_name, Length::kind(), help, get, set).range(low, high, decimals).said(LINE_WIDTH_SAID)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_read_in_every_unit_and_written_as_they_were() {
        for (text, length) in [
            ("2", Length::Px(2.0)),
            ("0.35mm", Length::Mm(0.35)),
            (" 1e-3 mm", Length::Mm(0.001)),
            ("0.3%", Length::Percent(0.3)),
            ("0.3%/0.35mm", Length::ScreenOrPaper { percent: 0.3, mm: 0.35 }),
            ("2x", Length::Times(2.0)),
        ] {
            assert_eq!(text.parse(), Ok(length));
            assert_eq!(length.to_string().parse(), Ok(length));
        }
        for bad in ["", "mm", "2cm", "wide", "2px", "%", "x", "0.3%/", "0.3%/2", "2mm/0.3%", "0.3%/0.35mm/1mm", "1%/2x"]
        {
            assert!(bad.parse::<Length>().is_err(), "{bad}");
        }
        let units = |px_per_mm| Units { px_per_mm, height_px: 400.0 };
        assert_eq!(Length::Mm(0.5).px(units(Some(4.0))), Some(2.0));
        assert_eq!((Length::Mm(0.5).px(units(None)), Length::Px(3.0).px(units(None))), (None, Some(3.0)));
        let both = Length::ScreenOrPaper { percent: 0.5, mm: 0.5 };
        assert_eq!((both.px(units(Some(8.0))), both.px(units(None))), (Some(4.0), Some(2.0)));
        assert_eq!([0.5, 0.1].map(|percent| Length::Percent(percent).px(units(None))), [Some(2.0), Some(0.7)]);
    }
}
