//! Improvements on the published drawing: mended flaws of the text, and additions.
//!
//! `all` mends the text's flaws. It dates from before the additions and keeps its meaning, so old pictures and measured rows stay
//! valid. `everything` adds the rest.

use crate::error::ParseError;
use crate::settings::{Kind, Problem, Value};
use std::str::FromStr;

/// The flaws to mend and the improvements to add.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Improvements {
    /// V2: the saturated light is clamped to 1.
    pub clamp: bool,
    /// V3: the texture's rows do not wrap, which keeps lights free of specks.
    pub wrap: bool,
    /// V4: paper and noise are placed by the pixel.
    pub paper_coordinate: bool,
    /// V5: luminance by Rec. 709 (the style sand only).
    pub luminance: bool,
    /// Paper and noise keep their proportions in a picture that is not square: they cover it instead of being stretched.
    pub proportion: bool,
    /// The paper's tooth catches the grain: raised parts take more, hollows less.
    pub tooth: bool,
    /// Faces seen from behind are lit as if they faced the eye.
    pub two_sided: bool,
    /// Tone and grain vary like the strokes of a hand.
    pub strokes: bool,
}

/// The number of improvements.
const COUNT: usize = 8;

impl Improvements {
    /// The text's flaws.
    pub const ALL: Self = Self {
        clamp: true,
        wrap: true,
        paper_coordinate: true,
        luminance: true,
        proportion: false,
        tooth: false,
        two_sided: false,
        strokes: false,
    };

    /// The text's flaws, and additions beyond it.
    pub const EVERYTHING: Self = Self { proportion: true, tooth: true, two_sided: true, strokes: true, ..Self::ALL };

    /// Whether any improvement goes beyond the text.
    pub fn go_beyond_the_text(self) -> bool {
        let Self { proportion, tooth, two_sided, strokes, .. } = self;
        proportion || tooth || two_sided || strokes
    }

    /// Returns each improvement's name, and whether it is chosen.
    fn named(&mut self) -> [(&'static str, &mut bool); COUNT] {
        let Self { clamp, wrap, paper_coordinate, luminance, proportion, tooth, two_sided, strokes } = self;
        [
            ("clamp", clamp),
            ("wrap", wrap),
            ("paper-coordinate", paper_coordinate),
            ("luminance", luminance),
            ("proportion", proportion),
            ("tooth", tooth),
            ("two-sided", two_sided),
            ("strokes", strokes),
        ]
    }

    /// Their names.
    fn names() -> [&'static str; COUNT] {
        Self::default().named().map(|(name, _)| name)
    }
}

impl Value for Improvements {
    fn kind() -> Kind {
        Kind::Several(Self::names().into_iter().chain(["all", "everything", "none"]).collect())
    }

    fn text(&self) -> String {
        let mut all = *self;
        let chosen: Vec<&str> =
            all.named().into_iter().filter(|(_, is_chosen)| **is_chosen).map(|(name, _)| name).collect();
        if chosen.is_empty() { "none".to_owned() } else { chosen.join(",") }
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for Improvements {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        if text == "none" {
            return Ok(Self::default());
        }
        let mut chosen = Self::default();
        for name in text.split(',').map(str::trim) {
            let of_several = match name {
                "all" => Some(Self::ALL),
                "everything" => Some(Self::EVERYTHING),
                _ => None,
            };
            match of_several {
                Some(mut several) => {
                    for ((_, is_chosen), (_, is_in)) in chosen.named().into_iter().zip(several.named()) {
                        *is_chosen |= *is_in;
                    }
                }
                None => {
                    let mut named = chosen.named().into_iter();
                    *named.find(|(known, _)| *known == name).ok_or_else(usage)?.1 = true;
                }
            }
        }
        Ok(chosen)
    }
}

fn usage() -> ParseError {
    ParseError(format!(
        "write none, all (the text's flaws), everything, or some of {}, separated by commas",
        Improvements::names().join(", ")
    ))
}
