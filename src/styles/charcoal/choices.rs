//! The charcoal drawing's choices that have names.

use crate::error::ParseError;
use crate::settings::{Choice, Kind, Problem, Value};
use std::str::FromStr;

/// The text's ways to draw, in its conclusions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CharcoalRecipe {
    /// The default settings.
    #[default]
    Published,
    /// Stronger strokes: more grains, less contrast, smudged.
    Darker,
    /// Faint outlines left to the viewer: fewer grains, more contrast, more saturation.
    Closure,
}

impl CharcoalRecipe {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] =
        [("published", Self::Published), ("darker", Self::Darker), ("closure", Self::Closure)];
}

/// How the contrast-enhanced texture is filtered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CetFilter {
    /// GL_LINEAR, as published.
    #[default]
    Linear,
    /// GL_LINEAR_MIPMAP_LINEAR, which blurs the grain away, as the text says.
    Mipmap,
}

impl CetFilter {
    /// Both, as the user writes them.
    pub const ALL: [(&'static str, Self); 2] = [("linear", Self::Linear), ("mipmap", Self::Mipmap)];
}

/// By which light the rows of the contrast-enhanced texture are read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CetCoordinate {
    /// Before saturation, as published.
    #[default]
    Original,
    /// After it: figure 8.
    Saturated,
}

impl CetCoordinate {
    /// Both, as the user writes them.
    pub const ALL: [(&'static str, Self); 2] = [("original", Self::Original), ("saturated", Self::Saturated)];
}

/// What enhances contrast.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ContrastOperator {
    /// The light to the power of the exponent, as published.
    #[default]
    Power,
    /// An S about half light: darkens shadows and lightens lights.
    Sigmoid,
    /// Schlick's bias: darkens middle tones more evenly.
    Bias,
}

impl ContrastOperator {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] =
        [("power", Self::Power), ("sigmoid", Self::Sigmoid), ("bias", Self::Bias)];
}

/// Where the noise lies that chooses grains.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Noise {
    /// On the picture, as published: the model moves behind it.
    #[default]
    Screen,
    /// On the model: it turns with it.
    Object,
}

impl Noise {
    /// Both, as the user writes them.
    pub const ALL: [(&'static str, Self); 2] = [("screen", Self::Screen), ("object", Self::Object)];
}

/// Which of the text's flaws are mended.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Improvements {
    /// V2: the saturated light is clamped to 1.
    pub clamp: bool,
    /// V3: the texture's rows do not wrap, so that lights stay free of specks.
    pub wrap: bool,
    /// V4: paper and noise are placed by the pixel.
    pub paper_coordinate: bool,
    /// V5: luminance by Rec. 709 (the style sand only).
    pub luminance: bool,
}

impl Improvements {
    /// All of them.
    pub const ALL: Self = Self { clamp: true, wrap: true, paper_coordinate: true, luminance: true };
}

impl Improvements {
    /// Each flaw's name, and whether it is mended.
    fn named(&mut self) -> [(&'static str, &mut bool); 4] {
        let Self { clamp, wrap, paper_coordinate, luminance } = self;
        [("clamp", clamp), ("wrap", wrap), ("paper-coordinate", paper_coordinate), ("luminance", luminance)]
    }
}

impl Value for Improvements {
    fn kind() -> Kind {
        let names = Self::default().named().map(|(name, _)| name);
        Kind::Several(names.into_iter().chain(["all", "none"]).collect())
    }

    fn text(&self) -> String {
        let mut all = *self;
        let mended: Vec<&str> =
            all.named().into_iter().filter(|(_, is_mended)| **is_mended).map(|(name, _)| name).collect();
        if mended.is_empty() { "none".to_owned() } else { mended.join(",") }
    }

    fn parse(text: &str) -> Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for Improvements {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        match text {
            "none" => return Ok(Self::default()),
            "all" => return Ok(Self::ALL),
            _ => {}
        }
        let mut chosen = Self::default();
        for name in text.split(',').map(str::trim) {
            let usage = "write all, none, or some of clamp, wrap, paper-coordinate, luminance with commas between";
            let mut named = chosen.named().into_iter();
            *named.find(|(known, _)| *known == name).ok_or_else(|| usage.to_owned())?.1 = true;
        }
        Ok(chosen)
    }
}

impl Choice for CharcoalRecipe {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}

impl Choice for CetFilter {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}

impl Choice for CetCoordinate {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}

impl Choice for ContrastOperator {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}

impl Choice for Noise {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}
