//! The border of the cartoon styles: which filter finds it in the map, and how strongly (section 4.1).

use super::find;
use crate::error::{Error, Result};
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

    /// The border at a pixel from the map around it, as the shaders compute it but in f64: 0 none, 1 and more black.
    ///
    /// `map(x, y)` is the map's four channels in [0, 1] at this offset in pixels, y up, clamped at the rim.
    pub fn response(&self, map: impl Fn(i32, i32) -> [f64; 4]) -> f64 {
        let factor = f64::from(self.detection_factor);
        let channel = |channel: usize| {
            let at = |x, y| map(x, y)[channel];
            match self.filter {
                Filter::Laplacian4 => ((4.0 * at(0, 0) - at(0, -1) - at(-1, 0) - at(1, 0) - at(0, 1)) * factor).abs(),
                Filter::Laplacian8 => {
                    let block = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                    ((9.0 * at(0, 0) - block.map(|(x, y)| at(x, y)).sum::<f64>()) * factor).abs()
                }
                Filter::Mitchell => {
                    let corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)];
                    corners.map(|(x, y)| (at(0, 0) - at(x, y)).abs()).iter().sum::<f64>() * factor.abs()
                }
                Filter::Sobel => {
                    let weight = |along: i32, across: i32| f64::from(along * (2 - across.abs()));
                    let block = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                    let (x, y) = block.fold((0.0, 0.0), |(sum_x, sum_y), (x, y)| {
                        (sum_x + weight(x, y) * at(x, y), sum_y + weight(y, x) * at(x, y))
                    });
                    x.hypot(y) * factor.abs()
                }
                Filter::Roberts => {
                    let falling: f64 = at(0, 0) - at(1, 1);
                    falling.hypot(at(1, 0) - at(0, 1)) * factor.abs()
                }
            }
        };
        (0..4).map(channel).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(filter: Filter) -> Border {
        Border { filter, detection_factor: 1.0 }
    }

    #[test]
    fn every_filter_is_silent_on_an_even_map_and_speaks_at_a_step() {
        for (name, filter) in Filter::ALL {
            assert!(with(filter).response(|_, _| [0.3; 4]).abs() < 1e-12, "{name}");
            let step = |x: i32, _| [f64::from(i32::from(x > 0)), 0.0, 0.0, 0.0];
            assert!(with(filter).response(step) > 0.5, "{name}");
        }
    }

    #[test]
    fn only_the_laplacians_are_silent_on_a_ramp() {
        let ramp = |x: i32, y: i32| [0.5 + 0.1 * f64::from(x) + 0.05 * f64::from(y), 0.0, 0.0, 0.0];
        let response = |filter| with(filter).response(ramp);
        assert!(response(Filter::Laplacian4) < 1e-12);
        assert!(response(Filter::Laplacian8) < 1e-12);
        // Central differences of 0.2 and 0.1 weighted 1 + 2 + 1.
        assert!((response(Filter::Sobel) - 0.8f64.hypot(0.4)).abs() < 1e-12);
        assert!((response(Filter::Roberts) - 0.15f64.hypot(0.05)).abs() < 1e-12);
        assert!((response(Filter::Mitchell) - 2.0 * (0.15 + 0.05)).abs() < 1e-12);
    }

    #[test]
    fn a_right_angle_is_forty_percent_black_with_the_papers_factor() {
        // Errata E9: a crease between normals (0, 0, 1) and (1, 0, 0), seen on the z side.
        let crease = |x: i32, _| if x > 0 { [1.0, 0.0, 0.0, 0.5] } else { [0.0, 0.0, 1.0, 0.5] };
        assert!((Border::default().response(crease) - 0.4).abs() < 1e-7);
    }
}
