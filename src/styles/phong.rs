//! `phong`: the realistic rendering that the first article compares its cartoons with (figures 5a and 8).

use super::textured::textured;
use super::{ALL_STYLES, Show, Supersample, cull};
use crate::error::{Error, Result};
use crate::plan::{Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Uniform, Value};
use crate::scene::Scene;
use crate::settings::{Setting, under};

/// Settings of `phong`.
#[derive(Debug, Clone, PartialEq)]
pub struct Phong {
    /// Share of the colour visible without light. Default 0.25; more lightens the shadows.
    pub ambient: f32,
    /// Weight of the white highlight. Default 0.35.
    pub specular: f32,
    /// Exponent of the highlight. Default 24; more makes it smaller.
    pub shininess: f32,
    /// Whether to skip faces turned away from the eye: faster. The picture of closed models changes only in a few pixels at
    /// outlines. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge.
    pub supersample: Supersample,
}

impl Default for Phong {
    fn default() -> Self {
        Self { ambient: 0.25, specular: 0.35, shininess: 24.0, cull_back_faces: false, supersample: Supersample::One }
    }
}

impl Phong {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let own = vec![
            Setting::field(
                "ambient",
                "SHARE",
                "Share of the colour seen where no light falls; more lightens the shadows",
                |phong: &mut Self| &mut phong.ambient,
            )
            .inside("shading")
            .limits(0.0..=1.0),
            Setting::field(
                "specular",
                "SHARE",
                "Weight of the white highlight; more is brighter",
                |phong: &mut Self| &mut phong.specular,
            )
            .inside("shading")
            .limits(0.0..=1.0),
            Setting::field(
                "shininess",
                "EXPONENT",
                "Exponent of the highlight; more makes it smaller",
                |phong: &mut Self| &mut phong.shininess,
            )
            .inside("shading")
            .limits(1.0..=10_000.0)
            .range(1.0, 200.0, 0),
        ];
        let common = vec![
            cull(|phong: &mut Self| &mut phong.cull_back_faces),
            Supersample::setting(|phong: &mut Self| &mut phong.supersample),
        ];
        under(ALL_STYLES, common).chain(under("Style phong", own)).collect()
    }

    /// One pass: clear and draw.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        if show != Show::Final {
            return Err(Error::setting(
                "show",
                "the style phong has no lines, tones or map; choose another style, or show final",
            ));
        }
        let uniform = |name: &'static str, value| Uniform::new(name, Value::Float(value));
        let program = Program::new("phong/phong.vert", ["phong/phong.frag"]);
        let draw = Draw {
            uniforms: vec![
                uniform("ambient", self.ambient),
                uniform("specular", self.specular),
                uniform("shininess", self.shininess),
            ],
            cull_back_faces: self.cull_back_faces,
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(Paint::Materials), Some(program))
        };
        let texture = textured(scene, &draw);
        let mut steps = vec![Step::clear(scene.background.clear_color()), Step::Draw(draw)];
        steps.extend(texture);
        Ok(self.supersample.finish(Plan::new(vec![Pass::new("phong", steps)]), scene.size))
    }
}
