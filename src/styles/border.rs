//! The border of the cartoon styles: which filter finds it in the map, and how strongly (section 4.1).

use super::supersample::texture_unit;
use super::{CARTOON, IMAGE_SPACE, MapEncoding, lens};
use crate::error::{Error, Result};
use crate::plan::{Depth, Draw, Facts, Geometry, Program, Texture, Uniform, Value, WhereEven};
use crate::scene::{Scene, Size};
use crate::settings::{Choice, ON_OFF, Setting, under};
use serde::Serialize;

/// Settings of the border; the defaults are the listing's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// The filter. Default laplacian4, the article's.
    pub filter: Filter,
    /// What its response is multiplied by. Default 0.2; more makes fainter edges darker.
    pub detection_factor: f32,
    /// Width of a line in pixels of the picture, where the map has a step; `None` leaves the filter's taps where the listing
    /// has them, 2 pixels (1 with Roberts' cross). Default none; more pixels also join what lies near each other.
    pub width_px: Option<u32>,
    /// Whether depth answers by a threshold that knows the surface's slope instead of by the filter. Default no.
    pub slope_threshold: bool,
}

/// Widest line, pixels: beyond it taps miss whatever is narrower.
const WIDEST: u32 = 64;

/// The least step in depth that is a line: widths of a picture's pixel on the surface, and steps of the map's rounding,
/// by 2 of which a second difference can be off.
const LEAST_GAP: [f32; 2] = [1.5, 2.0];

/// The edge filters, each over the four channels of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The Laplacian over four neighbours (figure 11): the article's.
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

impl Choice for Filter {
    const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
}

impl Default for Border {
    fn default() -> Self {
        Self { filter: Filter::Laplacian4, detection_factor: 0.2, width_px: None, slope_threshold: false }
    }
}

impl Border {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let filter = vec![
            Setting::field(
                "filter",
                "FILTER",
                "Edge filter: laplacian4, laplacian8, mitchell, sobel, roberts",
                |border: &mut Self| &mut border.filter,
            )
            .labelled("edge filter"),
            Setting::field(
                "detection-factor",
                "FACTOR",
                "What the edge filter's response is multiplied by; more darkens faint edges",
                |border: &mut Self| &mut border.detection_factor,
            )
            .range(0.0, 2.0, 3),
            Setting::field(
                "slope-threshold",
                ON_OFF,
                "Let depth answer by a threshold that knows the surface's slope, on or off; off: by the filter",
                |border: &mut Self| &mut border.slope_threshold,
            ),
        ];
        let width = Setting::open_field(
            "border-width",
            "PIXELS",
            "paper",
            "Width of the borders, pixels, 1 to 64; paper is as the filter draws them, about 2; ink has 2",
            |border: &mut Self| &mut border.width_px,
        )
        .offering(&["paper", "1", "2", "3", "4", "5", "6", "8", "12", "16", "24", "32", "64"]);
        under(CARTOON, filter).chain(under(IMAGE_SPACE, vec![width])).collect()
    }

    /// Whether these are the constants of the listing, so that the listing itself can run.
    fn is_published(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn check(&self) -> Result<()> {
        if !self.detection_factor.is_finite() {
            return Err(Error::value("detection-factor", self.detection_factor, "it must be a finite number"));
        }
        check_width(self.width_px)
    }

    /// The fragment shader that holds the filter with its factor as a uniform, and its parts.
    pub(super) fn shaders(&self, encoding: MapEncoding) -> [&'static str; 4] {
        let filter = match self.filter {
            Filter::Laplacian4 => "evangelista/filter-laplacian4.frag",
            Filter::Laplacian8 => "evangelista/filter-laplacian8.frag",
            Filter::Mitchell => "evangelista/filter-mitchell.frag",
            Filter::Sobel => "evangelista/filter-sobel.frag",
            Filter::Roberts => "evangelista/filter-roberts.frag",
        };
        let tap = if self.width_px.is_some() { "improved/tap-apart.frag" } else { "evangelista/tap-next.frag" };
        let depth = match self.slope_threshold {
            true => "improved/slope-threshold.frag",
            false => "evangelista/depth-as-filtered.frag",
        };
        [filter, tap, encoding.shader(), depth]
    }

    /// Whether the listing can run as printed on such a map.
    pub(super) fn runs_the_listing(&self, encoding: MapEncoding) -> bool {
        self.is_published() && encoding == MapEncoding::Published
    }

    /// The filter over the whole surface, blended; `textures` are those of the map.
    pub(super) fn square(
        &self,
        scene: &Scene,
        surface: Size,
        encoding: MapEncoding,
        textures: Vec<(&'static str, Texture)>,
    ) -> Draw {
        let mut fragments = vec!["evangelista/border.frag"];
        let mut uniforms = Self::published_uniforms(surface);
        if !self.runs_the_listing(encoding) {
            fragments = vec!["evangelista/border-settings.frag"];
            fragments.extend(self.shaders(encoding));
            uniforms = self.uniforms(scene, surface, encoding);
        }
        Draw {
            uniforms,
            textures,
            depth: Depth::Ignore,
            blend: true,
            facts: Facts {
                reach_px: Some(self.reach_px(scene, surface)),
                // No difference is an alpha of 0.
                where_even: Some(WhereEven::Unchanged),
                // The slope's threshold is black or white by itself.
                adds_nothing: (self.detection_factor == 0.0 && !self.slope_threshold)
                    .then(|| "the detection factor is 0".to_owned()),
                ..Facts::plain()
            },
            ..Draw::new(Geometry::ScreenSquare, Some(Program { vertex: "evangelista/border.vert", fragments }))
        }
    }

    /// How far the filter looks in a map of this size, pixels; one more costs nothing.
    pub(super) fn reach_px(&self, scene: &Scene, surface: Size) -> u32 {
        let [before, behind] = taps(self.width_px, surface.width / scene.size.width, self.is_one_sided());
        // The slope's threshold looks twice as far.
        before.max(behind) * if self.slope_threshold { 2 } else { 1 } + 1
    }

    fn is_one_sided(&self) -> bool {
        self.filter == Filter::Roberts
    }

    /// The uniforms of the listing: how far apart texels are.
    pub(super) fn published_uniforms(surface: Size) -> Vec<Uniform> {
        vec![texture_unit(surface)]
    }

    /// The uniforms of the filters with settings, for a map of this size.
    pub(super) fn uniforms(&self, scene: &Scene, surface: Size, encoding: MapEncoding) -> Vec<Uniform> {
        let scale = surface.width / scene.size.width;
        let mut uniforms = Self::published_uniforms(surface);
        uniforms.push(Uniform { name: "detectionFactor", value: Value::Float(self.detection_factor) });
        if self.width_px.is_some() || self.slope_threshold {
            uniforms.push(reach(self.width_px, scale, self.is_one_sided()));
        }
        if self.slope_threshold {
            let gap = [LEAST_GAP[0] * scale as f32, LEAST_GAP[1] * encoding.depth_step()];
            uniforms.push(lens::footprint(scene, surface, lens::DepthRange::of_camera(scene)));
            uniforms.push(Uniform { name: "leastGap", value: Value::Vec2(gap) });
        }
        uniforms
    }
}

/// Refuses widths no filter can draw.
pub(super) fn check_width(width_px: Option<u32>) -> Result<()> {
    match width_px {
        Some(width) if !(1..=WIDEST).contains(&width) => Err(Error::value(
            "border-width",
            width,
            format!("a border is 1 to {WIDEST} pixels wide; --style inking draws wider lines"),
        )),
        _ => Ok(()),
    }
}

/// How many pixels taps reach to the left or below and to the right or above for a line of this width in a map so many times
/// the picture's size; a one-sided filter has taps to the right and above only.
pub(super) fn taps(width_px: Option<u32>, scale: u32, one_sided: bool) -> [u32; 2] {
    match width_px.map(|width| width * scale) {
        None => [1, 1],
        Some(width) if one_sided => [0, width],
        Some(width) => [width / 2, width - width / 2],
    }
}

/// `reach`: [`taps`] for a shader.
pub(super) fn reach(width_px: Option<u32>, scale: u32, one_sided: bool) -> Uniform {
    let taps = taps(width_px, scale, one_sided);
    Uniform { name: "reach", value: Value::Vec2(taps.map(|pixels| pixels as f32)) }
}
