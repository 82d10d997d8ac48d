//! `phong`: the realistic rendering that the first article compares its cartoons with (figures 5a and 8).

use super::textured::textured;
use super::{ALL_STYLES, Show, Supersample, cull};
use crate::error::{Error, Result};
use crate::plan::{Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step};
use crate::scene::Scene;
use crate::settings::{Setting, under};

/// Settings of `phong`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Phong {
    /// Whether to skip faces turned away from the eye: faster. The picture of closed models changes only in a few pixels at
    /// outlines. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge.
    pub supersample: Supersample,
}

impl Phong {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            cull(|phong: &mut Self| &mut phong.cull_back_faces),
            Supersample::setting(|phong: &mut Self| &mut phong.supersample),
        ];
        under(ALL_STYLES, common).collect()
    }

    /// One pass: clear and draw.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        if show != Show::Final {
            return Err(Error::setting(
                "show",
                "the style phong has no lines, tones or map; choose another style, or show final",
            ));
        }
        let program = Program::new("phong/phong.vert", ["phong/phong.frag"]);
        let draw = Draw {
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
