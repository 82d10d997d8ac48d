//! The border of the cartoon styles: which filter finds it in the map, and how strongly (section 4.1).

use super::supersample::texture_unit;
use super::{CARTOON, IMAGE_SPACE, LineWidth, MapEncoding, lens};
use crate::error::{Error, Result};
use crate::plan::{Blend, Depth, Draw, Facts, Geometry, Program, Texture, Uniform, Value, WhereEven};
use crate::scene::{Scene, Size};
use crate::settings::{ON_OFF, Setting, under};

/// Settings of the border; the defaults are the listing's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// The filter. Default laplacian4, the article's.
    pub filter: Filter,
    /// Factor on its response. Default 0.2; more makes fainter edges darker.
    pub detection_factor: f32,
    /// Width of a line at a step of the map. `None`, the default, keeps the listing's taps: 2 pixels, or 1 with Roberts' cross.
    /// More pixels also join neighbouring lines.
    pub width: Option<LineWidth>,
    /// Whether a threshold that accounts for the surface's slope, instead of the filter, decides on depth. Default no.
    pub slope_threshold: bool,
}

/// The smallest step in depth that is a line: widths of a picture's pixel on the surface, and rounding steps of the map. Rounding
/// shifts a second difference by up to 2 of these.
const LEAST_GAP: [f32; 2] = [1.5, 2.0];

tinta_geometry::choices! {
    /// The edge filters, each over the four channels of the map.
    pub enum Filter {
        /// The Laplacian over four neighbours (figure 11): the article's.
        Laplacian4 = "laplacian4",
        /// The Laplacian over eight neighbours (figure 10, left; Nienhaus and Doellner 2003).
        Laplacian8 = "laplacian8",
        /// The centre against its diagonal neighbours (figure 10, right; Mitchell 2002).
        Mitchell = "mitchell",
        /// The same in two programs, a limit of Mitchell's shading language: one reads the normals, one the depth, and each is
        /// blended (section 4.1). Where both respond, the line is fainter than with one program.
        MitchellTwo = "mitchell-two",
        /// Sobel's gradient.
        Sobel = "sobel",
        /// Roberts' cross.
        Roberts = "roberts",
        /// The centre against the Gaussian mean of the 3 x 3 pixels around it: our reading of the fourth filter that the article
        /// names.
        Gaussian = "gaussian",
    }
}

impl Filter {
    /// The programs that draw it one after the other: each one's pass and shader.
    fn programs(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Laplacian4 => &[("border", "evangelista/filter-laplacian4.frag")],
            Self::Laplacian8 => &[("border", "evangelista/filter-laplacian8.frag")],
            Self::Mitchell => &[("border", "evangelista/filter-mitchell.frag")],
            Self::MitchellTwo => &[
                ("border-normals", "evangelista/filter-mitchell-normals.frag"),
                ("border-depth", "evangelista/filter-mitchell-depth.frag"),
            ],
            Self::Sobel => &[("border", "evangelista/filter-sobel.frag")],
            Self::Roberts => &[("border", "evangelista/filter-roberts.frag")],
            Self::Gaussian => &[("border", "evangelista/filter-gaussian.frag")],
        }
    }
}

impl Default for Border {
    fn default() -> Self {
        Self { filter: Filter::Laplacian4, detection_factor: 0.2, width: None, slope_threshold: false }
    }
}

impl Border {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let filter =
            vec![
            Setting::field(
                "filter",
                "FILTER",
                "Edge filter: laplacian4, laplacian8, mitchell, mitchell-two (in two programs, not for two-pass), sobel, \
                 roberts, gaussian",
                |border: &mut Self| &mut border.filter,
            )
            .labelled("edge filter"),
            Setting::field(
                "detection-factor",
                "FACTOR",
                "Factor for the edge filter's response; more darkens faint edges",
                |border: &mut Self| &mut border.detection_factor,
            )
            .range(0.0, 2.0, 3),
            Setting::field(
                "slope-threshold",
                ON_OFF,
                "Find edges in depth by a threshold that follows the surface's slope, on or off; off uses the filter",
                |border: &mut Self| &mut border.slope_threshold,
            ),
        ];
        let width = Setting::open_field(
            "border-width",
            "WIDTH",
            "paper",
            "Width of the borders: 1 to 64 pixels, a share of the picture's height such as 0.35%, or paper (about 2 \
             pixels, as the filter draws them; 2 in style ink)",
            |border: &mut Self| &mut border.width,
        );
        under(CARTOON, filter).chain(under(IMAGE_SPACE, vec![width])).collect()
    }

    /// Whether these are the listing's constants, for which the listing itself can run.
    fn is_published(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn check(&self) -> Result<()> {
        if !self.detection_factor.is_finite() {
            return Err(Error::value("detection-factor", self.detection_factor, "it must be a finite number"));
        }
        self.width.map_or(Ok(()), |width| width.check("border-width"))
    }

    /// The fragment shader that holds the whole filter with its factor as a uniform, and its parts: for a style that draws more
    /// in the same program.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a filter that is no single program.
    pub(super) fn shaders(&self, encoding: MapEncoding) -> Result<[&'static str; 4]> {
        match self.filter.programs() {
            [(_, filter)] => Ok(self.parts(filter, encoding)),
            _ => Err(Error::value(
                "filter",
                "mitchell-two",
                "its two programs are blended one after the other, and two-pass has borders and tones in one; use --filter \
                 mitchell, or --style three-pass",
            )),
        }
    }

    /// A filter's shader and the shaders it calls.
    fn parts(&self, filter: &'static str, encoding: MapEncoding) -> [&'static str; 4] {
        let tap = if self.width.is_some() { "improved/tap-apart.frag" } else { "evangelista/tap-next.frag" };
        let depth = match (encoding, self.slope_threshold) {
            (MapEncoding::Numbers, _) => "improved/numbers-differ.frag",
            (_, true) => "improved/slope-threshold.frag",
            (_, false) => "evangelista/depth-as-filtered.frag",
        };
        [filter, tap, encoding.shader(), depth]
    }

    /// Whether the listing can run as printed on such a map.
    pub(super) fn runs_the_listing(&self, encoding: MapEncoding) -> bool {
        self.is_published() && encoding == MapEncoding::Published
    }

    /// The filter over the whole surface, blended: a draw for each of its programs, beside the name of its pass; `textures` are
    /// those of the map.
    pub(super) fn squares(
        &self,
        scene: &Scene,
        surface: Size,
        encoding: MapEncoding,
        textures: &[(&'static str, Texture)],
    ) -> Vec<(&'static str, Draw)> {
        let square = |(pass, filter): &(&'static str, &'static str)| {
            let mut fragments = vec!["evangelista/border.frag"];
            let mut uniforms = Self::published_uniforms(surface);
            if !self.runs_the_listing(encoding) {
                fragments = vec!["evangelista/border-settings.frag"];
                fragments.extend(self.parts(filter, encoding));
                uniforms = self.uniforms(scene, surface, encoding);
            }
            let draw = Draw {
                uniforms,
                textures: textures.to_vec(),
                depth: Depth::Ignore,
                blend: Blend::Over,
                facts: Facts {
                    reach_px: Some(self.reach_px(scene, surface)),
                    // Without differences the alpha is 0.
                    where_even: Some(WhereEven::Unchanged),
                    // The slope's threshold alone is black or white.
                    adds_nothing: (self.detection_factor == 0.0 && !self.slope_threshold)
                        .then(|| "the detection factor is 0".to_owned()),
                    ..Facts::plain()
                },
                ..Draw::new(Geometry::ScreenSquare, Some(Program::new("evangelista/border.vert", fragments)))
            };
            (*pass, draw)
        };
        self.filter.programs().iter().map(square).collect()
    }

    /// How far the filter reads in a map of this size, pixels; one more costs nothing.
    pub(super) fn reach_px(&self, scene: &Scene, surface: Size) -> u32 {
        let [before, behind] = taps(self.width_px(scene.size), surface.width / scene.size.width, self.is_one_sided());
        // The slope's threshold looks twice as far.
        before.max(behind) * if self.slope_threshold { 2 } else { 1 } + 1
    }

    fn width_px(&self, picture: Size) -> Option<u32> {
        self.width.map(|width| width.pixels(picture))
    }

    fn is_one_sided(&self) -> bool {
        self.filter == Filter::Roberts
    }

    /// Returns the uniforms of the listing: the distance between texels.
    pub(super) fn published_uniforms(surface: Size) -> Vec<Uniform> {
        vec![texture_unit(surface)]
    }

    /// Returns the uniforms of the filters with settings, for a map of this size.
    pub(super) fn uniforms(&self, scene: &Scene, surface: Size, encoding: MapEncoding) -> Vec<Uniform> {
        let scale = surface.width / scene.size.width;
        let mut uniforms = Self::published_uniforms(surface);
        uniforms.push(Uniform::new("detectionFactor", Value::Float(self.detection_factor)));
        if self.width.is_some() || self.slope_threshold {
            uniforms.push(reach("reach", self.width_px(scene.size), scale, self.is_one_sided()));
        }
        if self.slope_threshold {
            let gap = [LEAST_GAP[0] * scale as f32, LEAST_GAP[1] * encoding.depth_step()];
            uniforms.push(lens::footprint(scene, surface, lens::DepthRange::of_camera(scene)));
            uniforms.push(Uniform::new("leastGap", Value::Vec2(gap)));
        }
        uniforms
    }
}

/// Returns how many pixels the taps reach to the left or below, and to the right or above, for a line of this width. The map is
/// this many times the picture's size. A one-sided filter has taps to the right and above only.
pub(super) fn taps(width_px: Option<u32>, scale: u32, one_sided: bool) -> [u32; 2] {
    match width_px.map(|width| width * scale) {
        None => [1, 1],
        Some(width) if one_sided => [0, width],
        Some(width) => [width / 2, width - width / 2],
    }
}

/// Returns [`taps`] for a shader.
pub(super) fn reach(name: &'static str, width_px: Option<u32>, scale: u32, one_sided: bool) -> Uniform {
    let taps = taps(width_px, scale, one_sided);
    Uniform::new(name, Value::Vec2(taps.map(|pixels| pixels as f32)))
}
