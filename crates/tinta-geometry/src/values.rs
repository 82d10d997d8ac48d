//! The plain values a scene is described with, as a user writes them: picture size, colour, background.

use crate::error::ParseError;
use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// A picture's size in pixels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Size {
    /// Width over height.
    pub fn aspect(self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }

    /// A size this many times as wide and high.
    #[must_use]
    pub fn times(self, factor: u32) -> Self {
        Self { width: self.width.saturating_mul(factor), height: self.height.saturating_mul(factor) }
    }

    /// Number of pixels.
    pub fn pixel_count(self) -> usize {
        (self.width as usize).saturating_mul(self.height as usize)
    }
}

impl fmt::Display for Size {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}x{}", self.width, self.height)
    }
}

impl FromStr for Size {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let (width, height) = text.split_once(['x', 'X', ',']).unwrap_or((text, text));
        match (width.parse(), height.parse()) {
            (Ok(width), Ok(height)) if width > 0 && height > 0 => Ok(Self { width, height }),
            _ if text.ends_with(['m', 'n']) => {
                Err("a size is in pixels, without a unit; for a size on paper write --page 100x80mm".to_owned().into())
            }
            _ => Err("a size is WIDTHxHEIGHT in pixels, each at least 1, or one number for both".to_owned().into()),
        }
    }
}

/// Some pixels of a picture, counted from its lower left corner as GL does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    /// Columns to its left.
    pub x: u32,
    /// Rows below it.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Rectangle {
    /// This and so many pixels more on every side, within a surface of this size.
    #[must_use]
    pub fn grown(self, pixels: u32, surface: Size) -> Self {
        let (x, y) = (self.x.saturating_sub(pixels), self.y.saturating_sub(pixels));
        Self {
            x,
            y,
            width: (self.x + self.width).saturating_add(pixels).min(surface.width) - x,
            height: (self.y + self.height).saturating_add(pixels).min(surface.height) - y,
        }
    }

    /// The least rectangle around this and another.
    #[must_use]
    pub fn around(self, other: Self) -> Self {
        let (x, y) = (self.x.min(other.x), self.y.min(other.y));
        Self {
            x,
            y,
            width: (self.x + self.width).max(other.x + other.width) - x,
            height: (self.y + self.height).max(other.y + other.height) - y,
        }
    }

    /// What this and another have in common; `None` for nothing.
    #[must_use]
    pub fn within(self, other: Self) -> Option<Self> {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let width = (self.x + self.width).min(other.x + other.width).checked_sub(x)?;
        let height = (self.y + self.height).min(other.y + other.height).checked_sub(y)?;
        (width > 0 && height > 0).then_some(Self { x, y, width, height })
    }

    /// Number of pixels.
    pub fn pixel_count(self) -> usize {
        (self.width as usize).saturating_mul(self.height as usize)
    }
}

/// Red, green, blue in [0, 1], as GL gets them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Color(pub [f32; 3]);

impl FromStr for Color {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let [red, green, blue, alpha] = css_color(text)
            .ok_or_else(|| "a colour is a CSS name or #rrggbb, for example tan or #d2b48c".to_owned())?;
        if alpha != 1.0 {
            return Err("this colour is transparent; give an opaque one, or --transparent for no background"
                .to_owned()
                .into());
        }
        Ok(Self([red, green, blue]))
    }
}

/// A colour in CSS notation, its names in both spellings of grey; hexadecimal digits also without `#`.
fn css_color(text: &str) -> Option<[f32; 4]> {
    let text = text.trim().to_ascii_lowercase().replace("grey", "gray");
    let color = color::parse_color(&text).or_else(|_| color::parse_color(&format!("#{text}"))).ok()?;
    let components = color.to_alpha_color::<color::Srgb>().components;
    // The crate multiplies bytes by 1/255; dividing by 255 can give another last bit.
    Some(components.map(|channel| {
        let byte = (channel * 255.0).round();
        if channel == byte * (1.0 / 255.0) { byte / 255.0 } else { channel.clamp(0.0, 1.0) }
    }))
}

impl fmt::Display for Color {
    /// As `#rrggbb` where that is exactly this colour, else with all digits: reading it gives the same colour.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [red, green, blue] = self.0.map(|channel| (channel * 255.0).round() as u8);
        let hexadecimal = format!("#{red:02x}{green:02x}{blue:02x}");
        let [red, green, blue] = self.0;
        match hexadecimal.parse() == Ok(*self) {
            true => out.write_str(&hexadecimal),
            false => write!(out, "color(srgb {red} {green} {blue})"),
        }
    }
}

/// The background behind the objects.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Background {
    /// A colour.
    Color(Color),
    /// Nothing: alpha 0.
    Transparent,
}

impl Background {
    /// The colour the framebuffer is cleared to: red, green, blue, alpha. Transparent is black without alpha: ink blended over
    /// it is black with the ink's alpha.
    pub fn clear_color(self) -> [f32; 4] {
        match self {
            Self::Color(Color([red, green, blue])) => [red, green, blue, 1.0],
            Self::Transparent => [0.0; 4],
        }
    }
}

/// Returns a number for a message: with an exponent where its decimals would be long.
///
/// ```
/// use tinta_geometry::values::short;
///
/// assert_eq!([short(0.25), short(100.0), short(1e-300), short(2e60)], ["0.25", "100", "1e-300", "2e60"]);
/// ```
pub fn short(number: f64) -> String {
    match number == 0.0 || (1e-4..1e7).contains(&number.abs()) {
        true => number.to_string(),
        false => format!("{number:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_colours_are_read() {
        assert_eq!("640x480".parse(), Ok(Size { width: 640, height: 480 }));
        assert_eq!("64".parse(), Ok(Size { width: 64, height: 64 }));
        for bad in ["0x5", "5x", "x", "-1x5", "1x2x3", ""] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
        assert_eq!("#ff0000".parse(), Ok(Color([1.0, 0.0, 0.0])));
        assert_eq!("white".parse(), Ok(Color([1.0; 3])));
        assert_eq!("Tan".parse(), Ok(Color([210.0 / 255.0, 180.0 / 255.0, 140.0 / 255.0])));
        assert_eq!("darkslategrey".parse::<Color>(), "#2f4f4f".parse());
        assert_eq!(" LightGray".parse::<Color>(), "d3d3d3".parse());
        for same in ["f00", "#F00", "rgb(255,0,0)", "rgb(100% 0% 0%)", "hsl(0,100%,50%)"] {
            assert_eq!(same.parse(), Ok(Color([1.0, 0.0, 0.0])), "{same}");
        }
        for color in [[1.0, 0.0, 0.2], [0.1, 0.333_333_34, 1e-7], [0.9, 0.05, 0.05], [f32::MIN_POSITIVE, 0.5, 1.0]] {
            assert_eq!(Color(color).to_string().parse(), Ok(Color(color)));
        }
        assert_eq!(Color([1.0, 0.0, 0.2]).to_string(), "#ff0033");
        assert!("#ff000080".parse::<Color>().is_err());
        assert!("no-colour".parse::<Color>().is_err());
    }
}
