//! The colour of a drawing's ink.

use crate::measure::Ink;
use std::str::FromStr;
use tinta::error::{Error, Result};
use tinta::picture::Picture;
use tinta::settings::Value as _;
use tinta_geometry::values::Color;

/// Which parts of a picture count as ink, and how much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InkColor {
    /// Pixels darker than white, by their darkest channel; transparent pixels stand on white.
    Dark,
    /// Pixels lighter than black, by their lightest channel; transparent pixels stand on black.
    Light,
    /// Opaque pixels.
    Alpha,
    /// Pixels nearer to this colour than white is; on white.
    Color(Color),
}

impl InkColor {
    /// A picture's ink.
    pub fn of(self, picture: &Picture) -> Ink {
        let darkness = |pixel: &[u8]| {
            let over = |ground: u8| {
                let alpha = u32::from(pixel[3]);
                let mix = |channel: u8| (u32::from(channel) * alpha + u32::from(ground) * (255 - alpha) + 127) / 255;
                [mix(pixel[0]), mix(pixel[1]), mix(pixel[2])].map(|channel| channel as u8)
            };
            let least = |channels: [u8; 3]| channels.into_iter().min().unwrap_or_default();
            match self {
                Self::Dark => u8::MAX - least(over(u8::MAX)),
                Self::Light => u8::MAX - least(over(0).map(|channel| u8::MAX - channel)),
                Self::Alpha => pixel[3],
                Self::Color(Color(ink)) => {
                    let apart = |to: [f64; 3]| {
                        let channels = over(u8::MAX).map(|channel| f64::from(channel) / 255.0);
                        channels.iter().zip(to).map(|(channel, to)| (channel - to).powi(2)).sum::<f64>().sqrt()
                    };
                    let ink = ink.map(f64::from);
                    let white = ink.iter().map(|channel| (1.0 - channel).powi(2)).sum::<f64>().sqrt();
                    ((1.0 - apart(ink) / white).clamp(0.0, 1.0) * 255.0).round() as u8
                }
            }
        };
        Ink { size: picture.size, darkness: picture.pixels.chunks_exact(4).map(darkness).collect() }
    }
}

impl FromStr for InkColor {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        match text {
            "dark" => Ok(Self::Dark),
            "light" => Ok(Self::Light),
            "alpha" => Ok(Self::Alpha),
            _ => match Color::parse(text) {
                Ok(Color(channels)) if channels.iter().all(|channel| *channel >= 1.0) => {
                    Err(Error::setting("ink", "white ink on white is invisible; choose light for white ink on black"))
                }
                Ok(color) => Ok(Self::Color(color)),
                Err(_) => {
                    Err(Error::value("ink", text, "choose dark, light, alpha or a colour such as red or #c03020"))
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    fn ink(color: &str, pixel: [u8; 4]) -> u8 {
        let picture = Picture { size: Size { width: 1, height: 1 }, pixels: pixel.to_vec() };
        color.parse::<InkColor>().unwrap().of(&picture).darkness[0]
    }

    #[test]
    fn ink_is_what_was_said_to_be() {
        assert_eq!(
            [[0, 0, 0, 255], [255, 255, 255, 255], [0, 0, 0, 0], [200, 255, 255, 255]].map(|p| ink("dark", p)),
            [255, 0, 0, 55]
        );
        assert_eq!(ink("dark", [0, 0, 0, 128]), 128);
        assert_eq!([[255, 255, 255, 255], [0, 0, 0, 255], [255, 255, 255, 0]].map(|p| ink("light", p)), [255, 0, 0]);
        assert_eq!([[9, 9, 9, 7], [255, 255, 255, 255]].map(|p| ink("alpha", p)), [7, 255]);
        assert_eq!([[255, 0, 0, 255], [255, 255, 255, 255], [0, 0, 255, 255]].map(|p| ink("red", p)), [255, 0, 0]);
        assert_eq!(ink("red", [255, 128, 128, 255]), 127);
        assert!("white".parse::<InkColor>().is_err() && "nothing".parse::<InkColor>().is_err());
    }
}
