//! The border of the cartoon styles: which filter finds it in the map, and how strongly (section 4.1).

use crate::error::{Error, Result};
use crate::names::find;
use crate::plan::{Texture, Uniform, Value};
use crate::scene::Size;
use serde::Serialize;
use std::str::FromStr;

/// Settings of the border; the defaults are the listing's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Border {
    /// The filter. Default laplacian4, the paper's.
    pub filter: Filter,
    /// What its response is multiplied by. Default 0.2; more makes fainter edges darker.
    pub detection_factor: f32,
}

/// The edge filters, each over the four channels of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The Laplacian over four neighbours (figure 11): the paper's.
    Laplacian4,
    /// The Laplacian over eight neighbours (figure 10, left; Nienhaus and Doellner 2003).
    Laplacian8,
    /// The centre against its diagonal neighbours (figure 10, right; Mitchell 2002).
    Mitchell,
    /// Sobel's gradient.
    Sobel,
    /// Roberts' cross.
    Roberts,
}

impl Filter {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 5] = [
        ("laplacian4", Self::Laplacian4),
        ("laplacian8", Self::Laplacian8),
        ("mitchell", Self::Mitchell),
        ("sobel", Self::Sobel),
        ("roberts", Self::Roberts),
    ];
}

impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}

impl Default for Border {
    fn default() -> Self {
        Self { filter: Filter::Laplacian4, detection_factor: 0.2 }
    }
}

impl Border {
    /// Whether these are the constants of the listing, so that the listing itself can run.
    pub(super) fn is_published(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn check(&self) -> Result<()> {
        if self.detection_factor.is_finite() {
            return Ok(());
        }
        Err(Error::setting(format!("--detection-factor {}", self.detection_factor), "it must be a finite number"))
    }

    /// The fragment shader that holds the filter with its factor as a uniform.
    pub(super) fn shader(&self) -> &'static str {
        match self.filter {
            Filter::Laplacian4 => "evangelista/filter-laplacian4.frag",
            Filter::Laplacian8 => "evangelista/filter-laplacian8.frag",
            Filter::Mitchell => "evangelista/filter-mitchell.frag",
            Filter::Sobel => "evangelista/filter-sobel.frag",
            Filter::Roberts => "evangelista/filter-roberts.frag",
        }
    }

    /// The uniforms of the listing: how far apart texels are.
    pub(super) fn published_uniforms(size: Size) -> Vec<Uniform> {
        let unit = [1.0 / size.width as f32, 1.0 / size.height as f32];
        vec![Uniform { name: "textureUnit", value: Value::Vec2(unit) }]
    }

    /// The uniforms of the filters with settings.
    pub(super) fn uniforms(&self, size: Size) -> Vec<Uniform> {
        let factor = Uniform { name: "detectionFactor", value: Value::Float(self.detection_factor) };
        let mut uniforms = Self::published_uniforms(size);
        uniforms.push(factor);
        uniforms
    }

    /// The textures all of them read.
    pub(super) fn textures() -> Vec<(&'static str, Texture)> {
        vec![("borderMap", Texture::BorderMap)]
    }
}
