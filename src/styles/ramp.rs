//! The ramp texture of the text's section "Painting": gradients of a few flat tones, one per row, indexed by the light.

use crate::error::{ParseError, Result};
use crate::picture::Picture;
use crate::scene::{Color, Size};
use crate::settings::{Kind, Problem, Value};
use serde::{Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::{Arc, LazyLock};

/// Gradients of a ramp, as in the text's picture.
const ROWS: u32 = 4;

/// The light at which a gradient shows its base colour.
pub(super) const MIDDLING_LIGHT: f32 = 0.6;

/// A picture of gradients one above the other, dark at the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// The picture; its gradients are equally high, the first at the top.
    pub picture: Arc<Picture>,
    /// The number of gradients: four, as in the text, or as many as the picture has bands of equal rows.
    pub rows: u32,
    /// Its source file; `None` for the built-in one.
    pub path: Option<PathBuf>,
}

impl Default for Ramp {
    /// Four gradients of three tones, our own.
    fn default() -> Self {
        static BUILT_IN: LazyLock<Arc<Picture>> = LazyLock::new(|| Arc::new(built_in()));
        Self { picture: BUILT_IN.clone(), rows: ROWS, path: None }
    }
}

impl Ramp {
    /// Reads a picture.
    ///
    /// # Errors
    ///
    /// [`crate::Error::File`] when it cannot be read.
    pub fn read(path: &Path) -> Result<Self> {
        Ok(Self::of(Picture::read(path)?, path))
    }

    /// A picture's bytes as a ramp; `name` is for messages.
    ///
    /// # Errors
    ///
    /// Those of [`Ramp::read`].
    pub fn from_bytes(bytes: &[u8], name: &str) -> Result<Self> {
        Ok(Self::of(Picture::from_bytes(bytes, name)?, Path::new(name)))
    }

    fn of(picture: Picture, path: &Path) -> Self {
        let rows = bands(&picture).unwrap_or(ROWS.min(picture.size.height));
        Self { picture: Arc::new(picture), rows, path: Some(path.to_path_buf()) }
    }
}

impl Ramp {
    /// Returns the row whose colour in middling light is nearest.
    pub(super) fn nearest_row(&self, color: Color) -> u32 {
        let Size { width, height } = self.picture.size;
        let distance = |row: &u32| {
            let y = (row * 2 + 1) * height / (self.rows * 2);
            let pixel = self.picture.pixel((MIDDLING_LIGHT * width as f32) as i64, y.into());
            let squares = pixel.iter().zip(color.0).map(|(a, b)| (f32::from(*a) / 255.0 - b).powi(2));
            squares.sum::<f32>()
        };
        (0..self.rows).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default()
    }
}

/// The number of a picture's bands of equal rows, if all are equally high; `None` for other pictures, and for a tall picture whose
/// rows all differ, like a photograph's.
fn bands(picture: &Picture) -> Option<u32> {
    /// The most bands of a single row.
    const MOST_THIN: u32 = 16;
    let Size { width, height } = picture.size;
    let mut lines = picture.pixels.chunks_exact(width as usize * 4).peekable();
    let mut highs = vec![0_u32];
    while let Some(line) = lines.next() {
        *highs.last_mut()? += 1;
        if lines.peek().is_some_and(|next| *next != line) {
            highs.push(0);
        }
    }
    let is_thick = highs.first().is_some_and(|high| *high > 1);
    let are_equal = highs.windows(2).all(|pair| pair[0] == pair[1]);
    (are_equal && (is_thick || height <= MOST_THIN)).then_some(highs.len() as u32)
}

/// The name of the built-in ramp.
const BUILT_IN: &str = "built-in";

impl Value for Ramp {
    fn kind() -> Kind {
        Kind::File
    }

    /// A ramp without a file has no text.
    fn text(&self) -> String {
        match &self.path {
            Some(path) => path.to_string_lossy().into_owned(),
            None if *self == Self::default() => BUILT_IN.to_owned(),
            None => String::new(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(if text == BUILT_IN { Self::default() } else { Self::read(Path::new(text))? })
    }
}

impl Serialize for Ramp {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text())
    }
}

impl Value for RampRow {
    fn kind() -> Kind {
        Kind::Text { offered: &["material", "object", "own", "0", "1", "2", "3"], example: "2" }
    }

    fn text(&self) -> String {
        match self {
            Self::Material => "material".to_owned(),
            Self::Object => "object".to_owned(),
            Self::Own => "own".to_owned(),
            Self::Row(row) => row.to_string(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// The gradient that a surface gets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum RampRow {
    /// Each material the one nearest to its colour; without a colour the first.
    #[default]
    Material,
    /// Each object the next one.
    Object,
    /// Each of a material's colours in the tones of the built-in ramp; [`Ramp`] is ignored.
    Own,
    /// This one for all, from 0 at the top.
    Row(u8),
}

impl FromStr for RampRow {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        match text {
            "material" => Ok(Self::Material),
            "object" => Ok(Self::Object),
            "own" => Ok(Self::Own),
            _ => text.parse().map(Self::Row).map_err(|_| {
                "choose material, object, own, or the number of a gradient, from 0 at the top".to_owned().into()
            }),
        }
    }
}

/// Base colours of the built-in gradients: clay, rust, umber, slate.
const BASES: [[f32; 3]; ROWS as usize] =
    [[0.93, 0.74, 0.52], [0.80, 0.36, 0.24], [0.60, 0.49, 0.38], [0.46, 0.58, 0.72]];

/// The smallest light of the base colour and of the highlight.
const TONES_FROM: [f32; 2] = [0.45, 0.82];

/// Columns of a ramp made here.
pub(super) const WIDTH: u32 = 256;

fn built_in() -> Picture {
    let size = Size { width: WIDTH, height: 64 };
    // All rows of a gradient are equal.
    let lines = |base: &[f32; 3]| gradient(*base).repeat((size.height / ROWS) as usize);
    Picture { size, pixels: BASES.iter().flat_map(lines).collect() }
}

/// Returns a row of pixels: a colour in shadow, unchanged, and as a highlight.
pub(super) fn gradient(base: [f32; 3]) -> Vec<u8> {
    let pixel = |x: u32| {
        let light = (x as f32 + 0.5) / WIDTH as f32;
        let tone = |channel: f32| match light {
            light if light < TONES_FROM[0] => channel * 0.62,
            light if light < TONES_FROM[1] => channel,
            _ => channel + (1.0 - channel) * 0.55,
        };
        let [red, green, blue] = base.map(|channel| (tone(channel) * 255.0).round() as u8);
        [red, green, blue, u8::MAX]
    };
    (0..WIDTH).flat_map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_ramp_has_four_gradients_of_three_tones() {
        let Ramp { picture, .. } = Ramp::default();
        let mut all = std::collections::HashSet::new();
        for row in 0..ROWS {
            let y = i64::from(row * picture.size.height / ROWS + 3);
            let tones: std::collections::HashSet<[u8; 4]> =
                (0..i64::from(picture.size.width)).map(|x| picture.pixel(x, y)).collect();
            assert_eq!(tones.len(), 3);
            all.extend(tones);
        }
        assert_eq!(all.len(), 12);
    }

    #[test]
    fn a_picture_has_as_many_gradients_as_bands_of_one_height() {
        let rows = |width: u32, lines: &[u8]| {
            let pixels = lines.iter().flat_map(|line| [*line; 4].repeat(width as usize)).collect();
            Ramp::of(Picture { size: Size { width, height: lines.len() as u32 }, pixels }, Path::new("x")).rows
        };
        assert_eq!(rows(3, &[7]), 1);
        assert_eq!(rows(1, &[7, 8]), 2);
        assert_eq!(rows(2, &[1, 1, 2, 2, 3, 3, 1, 1, 5, 5, 6, 6]), 6);
        // Unequal bands, and a tall picture of rows that all differ, are quarters.
        assert_eq!(rows(2, &[1, 1, 1, 2, 3, 3]), 4);
        assert_eq!(rows(2, &(0..64).collect::<Vec<u8>>()), 4);
    }

    #[test]
    fn a_colours_row_is_the_nearest_and_a_row_is_a_number() {
        for (row, base) in BASES.iter().enumerate() {
            assert_eq!(Ramp::default().nearest_row(Color(*base)), row as u32);
        }
        assert_eq!("2".parse(), Ok(RampRow::Row(2)));
        assert!("-1".parse::<RampRow>().is_err() && "256".parse::<RampRow>().is_err());
    }
}
