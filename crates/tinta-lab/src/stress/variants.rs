//! The styles of stiff cases: each as published, with the form designed to withstand them.

use tinta::edges::SilhouetteRule;
use tinta::styles::{Border, Cartoon, Charcoal, Improvements, Inking, MapEncoding, Style, StyleName};

/// A style with settings under the name its rows carry.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// The style and the options that make it, as the user writes them.
    pub name: String,
    /// The style.
    pub style: Style,
}

impl Variant {
    /// A style under a name that states its options.
    pub(crate) fn new(name: impl Into<String>, style: Style) -> Self {
        Self { name: name.into(), style }
    }

    /// A style as published.
    pub(crate) fn published(name: StyleName) -> Self {
        let style = Style::named(name);
        Self::new(style.name(), style)
    }

    /// Every style that draws any model, as published, and the mended forms of those that have one. `sand` needs a texture.
    pub(crate) fn all() -> Vec<Self> {
        let of_any_model = StyleName::of_passes().filter(|(_, name)| *name != StyleName::Sand);
        let mut all: Vec<Self> = of_any_model.map(|(_, name)| Self::published(name)).collect();
        all.extend([Self::mended_three_pass(), Self::exact_inking(), Self::mended_charcoal()]);
        all
    }

    /// The styles with geometric lines, faithful and corrected: for cases too large to draw in all styles.
    pub(crate) fn of_lines() -> Vec<Self> {
        vec![Self::published(StyleName::ThreePass), Self::published(StyleName::Ink), Self::exact_inking()]
    }

    /// The first article's passes without its clamped normals, 8-bit depth and faint borders.
    pub(crate) fn mended_three_pass() -> Self {
        let border = Border { detection_factor: 1.0, slope_threshold: true, ..Border::default() };
        let cartoon = Cartoon { border: Some(border), map_encoding: MapEncoding::Float, ..Cartoon::default() };
        Self::new(
            "three-pass --map-encoding float --slope-threshold on --detection-factor 1",
            Style::ThreePass(cartoon),
        )
    }

    /// Dachsbacher's lines with silhouettes by exact arithmetic.
    pub(crate) fn exact_inking() -> Self {
        let inking = Inking { silhouette: SilhouetteRule::Exact, ..Inking::default() };
        Self::new("inking --silhouette exact", Style::Inking(inking))
    }

    /// Charcoal without the text's flaws.
    pub(crate) fn mended_charcoal() -> Self {
        let charcoal = Charcoal { improve: Improvements::ALL, ..Charcoal::default() };
        Self::new("charcoal --improve all", Style::Charcoal(charcoal))
    }
}
