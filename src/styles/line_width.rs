//! Widths of lines that an image filter draws: in pixels, or as a share of the picture's height.

use crate::error::{Error, Result};
use crate::scene::Size;
use crate::settings::{Kind, Problem, Value};

/// The width of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LineWidth {
    /// This many pixels of the picture.
    Pixels(u32),
    /// This many hundredths of the picture's height, to the nearest pixel and at least two pixels: the same drawing at every
    /// size.
    Percent(f64),
}

/// Widest line, pixels: wider taps miss narrower features.
const WIDEST: u32 = 64;

/// Smallest width in pixels of a line given as a share of the height; narrower lines break up.
const NARROWEST_SHARE: u32 = 2;

/// Largest share of the height, hundredths.
const LARGEST_PERCENT: f64 = 10.0;

impl LineWidth {
    /// Returns the width in pixels of a picture of this size.
    pub(crate) fn pixels(self, picture: Size) -> u32 {
        match self {
            Self::Pixels(pixels) => pixels,
            Self::Percent(percent) => {
                let pixels = f64::from(picture.height) * percent / 100.0;
                (pixels.round() as u32).clamp(NARROWEST_SHARE, WIDEST)
            }
        }
    }

    /// Returns an error, with the setting's name, for a width that cannot be drawn.
    pub(super) fn check(self, name: &'static str) -> Result<()> {
        let is_drawable = match self {
            Self::Pixels(pixels) => (1..=WIDEST).contains(&pixels),
            Self::Percent(percent) => percent > 0.0 && percent <= LARGEST_PERCENT,
        };
        let problem = || {
            format!(
                "a border is 1 to {WIDEST} pixels wide, or up to {LARGEST_PERCENT}% of the picture's height; --style inking \
                 draws wider lines"
            )
        };
        if is_drawable { Ok(()) } else { Err(Error::value(name, self.text(), problem())) }
    }
}

impl Value for LineWidth {
    fn kind() -> Kind {
        Kind::Text { offered: &["1", "2", "3", "4", "6", "8", "0.35%", "0.5%"], example: "0.35%" }
    }

    fn text(&self) -> String {
        match self {
            Self::Pixels(pixels) => pixels.to_string(),
            Self::Percent(percent) => format!("{percent}%"),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        let width = match text.strip_suffix('%') {
            Some(percent) => percent.trim().parse().ok().filter(|percent: &f64| percent.is_finite()).map(Self::Percent),
            None => text.parse().ok().map(Self::Pixels),
        };
        width.ok_or_else(|| {
            "a width is a whole number of pixels, or a share of the picture's height such as 0.35%".to_owned().into()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_follows_the_height_and_never_breaks() {
        let high = |height| Size { width: 100, height };
        let share = LineWidth::Percent(0.35);
        assert_eq!([128, 512, 1200, 3508, 99_999].map(|height| share.pixels(high(height))), [2, 2, 4, 12, 64]);
        assert_eq!(LineWidth::Pixels(5).pixels(high(9)), 5);
    }

    #[test]
    fn widths_are_read_as_they_are_written() {
        for text in ["3", "0.35%", "10%"] {
            let width = LineWidth::parse(text).unwrap();
            assert!(width.check("border-width").is_ok(), "{text}");
            assert_eq!(width.text(), text);
        }
        for text in ["0", "65", "0%", "11%", "-1%"] {
            assert!(LineWidth::parse(text).unwrap().check("border-width").is_err(), "{text}");
        }
        for text in ["", "%", "nan%", "inf%", "1.5", "wide", "-1"] {
            assert!(LineWidth::parse(text).is_err(), "{text}");
        }
    }
}
