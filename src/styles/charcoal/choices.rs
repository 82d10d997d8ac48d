//! The charcoal drawing's named choices.

tinta_geometry::choices! {
    /// A way to draw: the published listing, or one of the two that the text's conclusions name.
    #[derive(Default)]
    pub enum CharcoalRecipe {
        /// The default settings: the listing, with values of ours where the text gives none (errata V7).
        #[default]
        Plain = "plain",
        /// Stronger strokes: more grains, less contrast, smudged.
        Darker = "darker",
        /// Faint outlines left to the viewer: fewer grains, more contrast, more saturation.
        Closure = "closure",
    }
}

tinta_geometry::choices! {
    /// How the contrast-enhanced texture is filtered.
    #[derive(Default)]
    pub enum CetFilter {
        /// GL_LINEAR, as published.
        #[default]
        Linear = "linear",
        /// GL_LINEAR_MIPMAP_LINEAR, which blurs the grain away, as the text says.
        Mipmap = "mipmap",
    }
}

tinta_geometry::choices! {
    /// The light that selects the rows of the contrast-enhanced texture.
    #[derive(Default)]
    pub enum CetCoordinate {
        /// Before saturation, as published.
        #[default]
        Original = "original",
        /// After saturation: figure 8.
        Saturated = "saturated",
    }
}

tinta_geometry::choices! {
    /// The operator that enhances contrast.
    #[derive(Default)]
    pub enum ContrastOperator {
        /// The light to the power of the exponent, as published.
        #[default]
        Power = "power",
        /// An S about half light: darkens shadows and lightens lights.
        Sigmoid = "sigmoid",
        /// Schlick's bias: darkens middle tones more evenly.
        Bias = "bias",
    }
}

tinta_geometry::choices! {
    /// The position of the noise that chooses grains.
    #[derive(Default)]
    pub enum Noise {
        /// On the picture, as published: the model moves behind it.
        #[default]
        Screen = "screen",
        /// On the model: it turns with it.
        Object = "object",
    }
}
