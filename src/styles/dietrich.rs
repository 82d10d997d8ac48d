//! `dietrich`: the hardware's alternative to the edge list, from the text's section "Alternative Techniken". Per pixel it
//! compares normal and view; ink is below a threshold. It is fast, and the surface's curvature sets the lines' width.

use super::{ALL_STYLES, Show, Supersample, cull, no_borders};
use crate::error::{Error, Result};
use crate::plan::{Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Uniform, Value};
use crate::scene::{Background, Color, Scene};
use crate::settings::{Setting, Value as _, under};

/// Settings of `dietrich`.
#[derive(Debug, Clone, PartialEq)]
pub struct Dietrich {
    /// Cosine of the angle between normal and view below which a pixel is ink, 0 to 1. Default 0.25; more makes lines
    /// wider, on flat surfaces first.
    pub threshold: f32,
    /// The ink's colour. Default black.
    pub ink: Color,
    /// Whether to skip faces turned away from the eye. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge.
    pub supersample: Supersample,
}

impl Default for Dietrich {
    fn default() -> Self {
        Self { threshold: 0.25, ink: Color([0.0; 3]), cull_back_faces: false, supersample: Supersample::One }
    }
}

/// Returns the setting of the ink's colour.
pub(super) fn ink_color<T: Clone + 'static>(field: fn(&mut T) -> &mut Color) -> Setting<T> {
    let set = move |style: &mut T, text: &str| {
        // Recordings of earlier versions have red, green and blue from 0 to 1.
        *field(style) = <[f32; 3]>::parse(text).map(Color).or_else(|_| Color::parse(text))?;
        Ok(())
    };
    let help = "The ink's colour: a CSS name, #rrggbb or rgb(r,g,b)";
    Setting::of("ink-color", "COLOR", Color::kind(), help, move |style: &T| field(&mut style.clone()).text(), set)
        .said("black")
        .labelled("ink colour")
}

impl Dietrich {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            // No cosine is below 0.
            no_borders(
                |dietrich: &Self| dietrich.threshold == 0.0,
                |dietrich, is_without| {
                    if is_without {
                        dietrich.threshold = 0.0;
                    } else if dietrich.threshold == 0.0 {
                        dietrich.threshold = Self::default().threshold;
                    }
                },
            ),
            cull(|dietrich: &mut Self| &mut dietrich.cull_back_faces),
            Supersample::setting(|dietrich: &mut Self| &mut dietrich.supersample),
        ];
        let color = ink_color(|dietrich: &mut Self| &mut dietrich.ink);
        let own = vec![
            Setting::field(
                "ink-threshold",
                "COSINE",
                "Cosine between normal and view below which a pixel is ink, 0 to 1; more makes wider lines",
                |dietrich: &mut Self| &mut dietrich.threshold,
            )
            .range(0.0, 1.0, 3),
            color,
        ];
        under(ALL_STYLES, common).chain(under("Style dietrich", own)).collect()
    }

    /// One pass: clear and draw.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        if !(0.0..=1.0).contains(&self.threshold) {
            return Err(Error::value(
                "ink-threshold",
                self.threshold,
                "the threshold is the cosine of an angle, from 0 to 1",
            ));
        }
        let transparent = scene.background == Background::Transparent;
        let (paint, ground, threshold) = match show {
            Show::Final => (Paint::Materials, scene.background.clear_color(), self.threshold),
            Show::Tones => (Paint::Materials, scene.background.clear_color(), 0.0),
            Show::Borders if transparent => (Paint::Uniform([0.0; 4]), [0.0; 4], self.threshold),
            Show::Borders => (Paint::Uniform([1.0; 4]), [1.0; 4], self.threshold),
            _ => {
                return Err(Error::setting(
                    "show",
                    "the style dietrich has no map, light or paper; show final, borders or tones",
                ));
            }
        };
        let program = Program::new("dietrich/dietrich.vert", ["dietrich/dietrich.frag"]);
        let draw = Draw {
            uniforms: vec![
                Uniform::new("threshold", Value::Float(threshold)),
                Uniform::new("inkColor", Value::Vec3(self.ink.0)),
            ],
            cull_back_faces: self.cull_back_faces,
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(paint), Some(program))
        };
        let steps = vec![Step::clear(ground), Step::Draw(draw)];
        Ok(self.supersample.finish(Plan::new(vec![Pass::new("dietrich", steps)]), scene.size))
    }
}
