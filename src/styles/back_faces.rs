//! `back-faces`: the outline by two passes in the image, which Evangelista et al. name beside their filter (section 2) after Gooch:
//! front faces hide thick lines along the edges of the faces behind them, except their rim. GL draws it without shaders.

use super::dietrich::ink_color;
use super::{ALL_STYLES, Cartoon, Show, Tones, no_borders};
use crate::error::{Error, Result};
use crate::plan::{Depth, Draw, Geometry, Paint, Pass, Plan, Step};
use crate::scene::{Background, Color, Scene};
use crate::settings::{Setting, under, within};

/// Settings of `back-faces`.
#[derive(Debug, Clone, PartialEq)]
pub struct BackFaces {
    /// The tones, those of the cartoon styles.
    pub tones: Tones,
    /// Width of the lines, pixels; about half is seen. Default 4; 0 draws the tones alone.
    pub line_width: f32,
    /// The lines' colour. Default black.
    pub ink: Color,
}

impl Default for BackFaces {
    fn default() -> Self {
        Self { tones: Tones::default(), line_width: 4.0, ink: Color([0.0; 3]) }
    }
}

/// Widest lines, pixels.
const WIDEST_PX: f32 = 64.0;

impl BackFaces {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let without = no_borders(
            |style: &Self| style.line_width == 0.0,
            |style, is_without| match is_without {
                true => style.line_width = 0.0,
                false if style.line_width == 0.0 => style.line_width = Self::default().line_width,
                false => {}
            },
        );
        let width = Setting::field(
            "line-width",
            "PIXELS",
            "Width of the lines; about half of it is seen",
            |style: &mut Self| &mut style.line_width,
        );
        let own = vec![width.range(0.0, 16.0, 1), ink_color(|style: &mut Self| &mut style.ink)];
        under(ALL_STYLES, vec![without])
            .chain(within(Tones::settings(), |style: &mut Self| Some(&mut style.tones)))
            .chain(under("Style back-faces", own))
            .collect()
    }

    /// Two passes: the faces, then the lines of those turned away.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        if !(0.0..=WIDEST_PX).contains(&self.line_width) {
            let problem = format!("a line's width is a number of pixels from 0 to {WIDEST_PX}");
            return Err(Error::value("line-width", self.line_width, problem));
        }
        let mut plan = match show {
            Show::Final | Show::Tones => {
                let tones = Cartoon { tones: self.tones.clone(), background_square: false, ..Cartoon::default() };
                tones.three_pass(scene, Show::Tones)?
            }
            Show::Borders => {
                let ground = if scene.background == Background::Transparent { [0.0; 4] } else { [1.0; 4] };
                let faces = Draw::new(Geometry::Objects(Paint::Uniform(ground)), None);
                Plan::new(vec![Pass::new("faces", vec![Step::clear(ground), Step::Draw(faces)])])
            }
            _ => {
                let problem = "the style back-faces has no map, light or paper; show final, borders or tones";
                return Err(Error::setting("show", problem));
            }
        };
        if show != Show::Tones && self.line_width > 0.0 {
            let [red, green, blue] = self.ink.0;
            let lines = Draw {
                back_faces_as_lines: Some(self.line_width),
                depth: Depth::TestOnly,
                ..Draw::new(Geometry::Objects(Paint::Uniform([red, green, blue, 1.0])), None)
            };
            plan.passes.push(Pass::new("back-faces", vec![Step::Draw(lines)]));
        }
        Ok(plan)
    }
}
