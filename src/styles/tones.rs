//! The tones of the cartoon styles: the mapping from light to one, two or three levels (section 3.2, figure 5).

use super::CARTOON;
use crate::error::{Error, Result};
use crate::plan::{Draw, Facts, Geometry, Paint, PlanTable, Program, Shorter, Texture, Uniform, Value};
use crate::settings::{Kind, Setting, Value as _, under};
use crate::tolerances::UNREACHED_LIGHT;

/// Settings of the tones; the defaults are the listing's constants.
#[derive(Debug, Clone, PartialEq)]
pub struct Tones {
    /// Number of tones, 1 to 3: the first, then the diffuse one, then the highlight. Default 3, the listing.
    pub count: u8,
    /// Smallest diffuse value of the second tone, in [0, 1]. Default 0.8; more shrinks the lit part.
    pub diffuse_threshold: f32,
    /// Specular value, in [0, 1], above which the third tone applies. Default 0.65; more shrinks the highlight.
    pub specular_threshold: f32,
    /// The factor each tone multiplies the colour by. Default 0.65, 0.95, 1.
    pub levels: [f32; 3],
    /// How a tone is found. Default by comparing.
    pub lookup: ToneLookup,
}

tinta_geometry::choices! {
    /// The way a tone is found from the light.
    pub enum ToneLookup {
        /// By comparing with the thresholds, as in the listing.
        Steps = "steps",
        /// In a one-dimensional texture, as the article mentions.
        Texture = "texture",
    }
}

impl Tones {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let thresholds = Setting::of(
            "tone-thresholds",
            "D,S",
            Kind::Numbers { count: 2, range: [0.0, 1.0], decimals: 3 },
            "Diffuse and specular light at which the second and third tone begin; more makes these tones smaller. With \
             --tone-light both are cosines of the angle to the light",
            |tones: &Self| [tones.diffuse_threshold, tones.specular_threshold].text(),
            |tones, text| {
                [tones.diffuse_threshold, tones.specular_threshold] = <[f32; 2]>::parse(text)?;
                Ok(())
            },
        )
        .inside("tones");
        let settings = vec![
            Setting::field(
                "tones",
                "N",
                "Number of tones, 1 to 3; fewer leave out the brightest",
                |tones: &mut Self| &mut tones.count,
            )
            .range(1.0, 3.0, 0),
            thresholds,
            Setting::field(
                "tone-levels",
                "A,B,C",
                "Brightness of each tone: factors for the colour",
                |tones: &mut Self| &mut tones.levels,
            )
            .inside("tones")
            .range(0.0, 1.0, 3),
            Setting::field(
                "tone-lookup",
                "HOW",
                "Look up tones by comparison (steps) or in a 1-D texture (texture)",
                |tones: &mut Self| &mut tones.lookup,
            )
            .inside("tones"),
        ];
        under(CARTOON, settings).collect()
    }
}

impl Default for Tones {
    fn default() -> Self {
        Self {
            count: 3,
            diffuse_threshold: 0.8,
            specular_threshold: 0.65,
            levels: [0.65, 0.95, 1.0],
            lookup: ToneLookup::Steps,
        }
    }
}

/// A threshold above all light values, which end at 1.
const NEVER: f32 = 2.0;

/// The part that compares both kinds of light with their thresholds.
const STEPS: &str = "evangelista/tone-steps.frag";

/// The shaders of uniform shading: the vertices', and the fragments' with the listing's constants and with settings.
pub(super) const TOON: [&str; 3] = ["evangelista/toon.vert", "evangelista/toon.frag", "evangelista/toon-settings.frag"];

/// Texels of the tone table: thresholds are exact to 1/1023.
const TABLE_SIZE: usize = 1024;

impl Tones {
    /// Whether these are the listing's constants, for which the listing itself can run.
    pub(super) fn are_published(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn check(&self) -> Result<()> {
        if !(1..=3).contains(&self.count) {
            return Err(Error::value("tones", self.count, "there are 1, 2 or 3 tones"));
        }
        if [self.diffuse_threshold, self.specular_threshold].iter().any(|threshold| !threshold.is_finite()) {
            return Err(Error::setting("tone-thresholds", "its numbers must be finite"));
        }
        if self.levels.iter().any(|level| !(0.0..=1.0).contains(level)) {
            return Err(Error::setting("tone-levels", "a level is a share of the colour from 0 to 1"));
        }
        Ok(())
    }

    /// Returns the diffuse and specular thresholds; those of unused tones are out of reach.
    pub(super) fn thresholds(&self) -> [f32; 2] {
        let with = |used: bool, threshold: f32| if used { threshold } else { NEVER };
        [with(self.count >= 2, self.diffuse_threshold), with(self.count >= 3, self.specular_threshold)]
    }

    /// Returns the cosines with a light from a direction at which the second and the third tone begin: the thresholds in
    /// ascending order, for there both compare the same light.
    pub(super) fn far_thresholds(&self) -> [f32; 2] {
        let [low, high] = [self.diffuse_threshold, self.specular_threshold];
        let [low, high] = [low.min(high), low.max(high)];
        [if self.count >= 2 { low } else { NEVER }, if self.count >= 3 { high } else { NEVER }]
    }

    /// The tone of light on a surface: the same decision the shaders make.
    ///
    /// `diffuse` and `specular` in [0, 1].
    pub fn tone(&self, diffuse: f32, specular: f32) -> f32 {
        let [diffuse_threshold, specular_threshold] = self.thresholds();
        if specular > specular_threshold {
            self.levels[2]
        } else if diffuse >= diffuse_threshold {
            self.levels[1]
        } else {
            self.levels[0]
        }
    }

    /// Returns the fragment shader that finds the tones.
    pub(super) fn shader(&self) -> &'static str {
        match self.lookup {
            ToneLookup::Steps => STEPS,
            ToneLookup::Texture => "evangelista/tone-texture.frag",
        }
    }

    /// Returns the draw of the objects by these shaders, those of a program as [`TOON`] has them; `is_square` if it draws the
    /// background's square instead.
    pub(super) fn draw(&self, [vertex, listed, with_settings]: [&'static str; 3], is_square: bool) -> Draw {
        let published = self.are_published();
        let fragments = if published { vec![listed] } else { vec![with_settings, self.shader()] };
        let program = Program::new(vertex, fragments);
        Draw {
            uniforms: if published { Vec::new() } else { self.uniforms(is_square) },
            textures: if published { Vec::new() } else { self.textures() },
            facts: Facts { shorter: self.shorter(&program), ..Facts::plain() },
            ..Draw::new(Geometry::Objects(Paint::Materials), Some(program))
        }
    }

    /// Returns a program for threshold tones without the light that no threshold depends on; the driver then removes that light
    /// from both shaders.
    pub(super) fn shorter(&self, program: &Program) -> Option<Shorter> {
        let [diffuse, specular] = self.thresholds();
        if specular < UNREACHED_LIGHT || !program.has_shader(STEPS) {
            return None;
        }
        let (part, without) = match diffuse < UNREACHED_LIGHT {
            true => ("improved/tone-diffuse.frag", "highlights"),
            false => ("improved/tone-one.frag", "diffuse light and highlights"),
        };
        let mut program = program.clone();
        program
            .fragments
            .iter_mut()
            .filter(|fragment| **fragment == STEPS)
            .for_each(|fragment| *fragment = part.into());
        let because = format!("light ends at 1, and the thresholds are {diffuse} and {specular}");
        Some(Shorter { program, without, because })
    }

    /// Returns its uniforms. On the `background` every tone is 1, which leaves the square its given colour.
    pub(super) fn uniforms(&self, background: bool) -> Vec<Uniform> {
        match self.lookup {
            ToneLookup::Steps => vec![
                Uniform::new("toneThresholds", Value::Vec2(self.thresholds())),
                Uniform::new("toneLevels", Value::Vec3(if background { [1.0; 3] } else { self.levels })),
            ],
            ToneLookup::Texture => {
                let texel = 1.0 / TABLE_SIZE as f32;
                vec![
                    Uniform::new("toneTableScale", Value::Vec2([1.0 - texel, 0.5 * texel])),
                    Uniform::new("toneGain", Value::Float(if background { 0.0 } else { 1.0 })),
                ]
            }
        }
    }

    /// Returns the textures it reads.
    pub(super) fn textures(&self) -> Vec<(&'static str, Texture)> {
        match self.lookup {
            ToneLookup::Steps => Vec::new(),
            ToneLookup::Texture => vec![("toneTable", Texture::Table(0))],
        }
    }

    /// Returns the plan's tables if one is read: the tone of a diffuse value, and that of a specular value or 0.
    pub(super) fn tables(&self) -> Vec<PlanTable> {
        let table = (self.lookup == ToneLookup::Texture).then(|| {
            let byte = |level: f32| (level * 255.0).round() as u8;
            let [_, specular_threshold] = self.thresholds();
            let texel = |index: usize| {
                let light = index as f32 / (TABLE_SIZE - 1) as f32;
                // 0 means no highlight, so a black highlight gets the darkest other value.
                let highlight = if light > specular_threshold { byte(self.levels[2]).max(1) } else { 0 };
                [byte(self.tone(light, f32::NEG_INFINITY)), highlight]
            };
            PlanTable { name: "the table of tones", texels: (0..TABLE_SIZE).map(texel).collect() }
        });
        table.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_the_listings_tones() {
        let tones = Tones::default();
        assert!(tones.are_published());
        assert_eq!(tones.tone(0.799, 0.65), 0.65);
        assert_eq!(tones.tone(0.8, 0.65), 0.95);
        assert_eq!(tones.tone(0.0, 0.66), 1.0);
    }

    #[test]
    fn fewer_tones_leave_out_the_brightest() {
        let with = |count| Tones { count, ..Tones::default() };
        assert_eq!([1, 2, 3].map(|count| with(count).tone(1.0, 1.0)), [0.65, 0.95, 1.0]);
        assert!(with(0).check().is_err());
        assert!(with(4).check().is_err());
    }

    #[test]
    fn the_table_says_what_the_steps_say() {
        for count in 1..=3 {
            let tones = Tones { count, lookup: ToneLookup::Texture, ..Tones::default() };
            let texels = tones.tables().remove(0).texels;
            for light in (0..TABLE_SIZE).map(|i| i as f32 / (TABLE_SIZE - 1) as f32) {
                for other in [0.0, 0.5, 1.0f32] {
                    let at = |light: f32| texels[(light * (TABLE_SIZE - 1) as f32).round() as usize];
                    let found = if at(other)[1] > 0 { at(other)[1] } else { at(light)[0] };
                    assert_eq!(found, (tones.tone(light, other) * 255.0).round() as u8, "{light} {other}");
                }
            }
        }
    }
}
