//! The charcoal drawing's choices that have names.

/// Ways to draw: the listing as it is, and the two that the text's conclusions name.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CharcoalRecipe {
    /// The default settings: the listing, with values of ours where the text gives none (errata V7).
    #[default]
    Plain,
    /// Stronger strokes: more grains, less contrast, smudged.
    Darker,
    /// Faint outlines left to the viewer: fewer grains, more contrast, more saturation.
    Closure,
}

impl CharcoalRecipe {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] =
        [("plain", Self::Plain), ("darker", Self::Darker), ("closure", Self::Closure)];
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

tinta_geometry::choices!(CharcoalRecipe, CetFilter, CetCoordinate, ContrastOperator, Noise);
