//! `charcoal` and `sand`: Valente 2007, after Majumder and Gopi 2002.
//!
//! One pass: the paper over the whole picture, then the objects, dark grain where little light falls. The published listings run
//! if their uniforms cover the settings. Otherwise their exchangeable parts run (`glsl/valente/charcoal-parts.frag`). A test
//! shows that listing and parts draw the same picture.

mod choices;
mod improvements;
mod layout;
mod pictures;
mod settings;

pub use choices::{CetCoordinate, CetFilter, CharcoalRecipe, ContrastOperator, Noise};
pub use improvements::Improvements;
pub use pictures::{CharcoalPictures, TextureSource};

use self::layout::Layout;
use self::pictures::{CharcoalTextures, TextureSettings};
use super::surfaces::has_doubled_faces;
use super::textured::textured;
use super::{Show, Supersample};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::picture::Picture;
use crate::plan::{
    Depth, Draw, Facts, Geometry, Paint, Pass, Plan, PlanPicture, Program, Sampling, Step, Texture, Uniform, Value,
};
use crate::scene::{Background, Scene, Size};
use crate::textures::{ContrastTexture, Generator, NoiseTexture};
use std::sync::Arc;

/// Settings of `charcoal` and `sand`; the defaults are the text's where it gives them, ours elsewhere (errata V7).
#[derive(Debug, Clone, PartialEq)]
pub struct Charcoal {
    /// Exponent m of the contrast operator, above 0. Default 1.5, ours; more darkens everything except the lights.
    pub contrast_exponent: f32,
    /// Factor on the contrast-enhanced light, at least 0. Default 1; 1.2 lightens by a fifth, which hides faint lines: the text's
    /// closure.
    pub saturation: f32,
    /// Whether the drawing is multiplied by the light again, which darkens. Default no.
    pub smudge: bool,
    /// Directions towards the two lights, eye space, of any length above 0. `None` leaves one out, not both. The text has two
    /// lights; our default directions, from above and from the lower left, are 122 degrees apart. At that angle their sum never
    /// exceeds 1; closer lights wrap (errata V3).
    pub lights: [Option<[f32; 3]>; 2],
    /// Share of black in the contrast-enhanced texture before its grains are moved, percent. Default 60: the text says
    /// "density 60" without a unit, which is read as percent here (errata V10); more is darker.
    pub density_percent: f64,
    /// Exponent of the contrast-enhanced texture, at least 1. Default 5.5, the middle one of figure 3; which one the text
    /// draws with it does not say. More leaves fewer grains in light tones.
    pub cet_exponent: f64,
    /// Standard deviation of the blur of the contrast-enhanced texture, pixels, 0 to 100. Default 0.8, ours. More softens the
    /// grain, and removes it at the width of a row of tones.
    pub cet_blur_px: f64,
    /// Seed of the random numbers of all textures. Default 0.
    pub seed: u64,
    /// Source of the random numbers of all textures. Default SplitMix64, ours. The text uses its platform's `rand()`; two of
    /// these are available (errata V8).
    pub random: Generator,
    /// Size of the textures made here, pixels. Default 512 x 512. Noise and paper are stretched once over the picture, as
    /// published: more is finer grain.
    pub texture_size: Size,
    /// The contrast-enhanced texture: its darkest tone in its lowest row, repeated along its width. Default made here from
    /// density, exponent and blur.
    pub cet: TextureSource,
    /// The noise that chooses the grain's column: the mean of its red, green and blue. Default made here.
    pub noise_texture: TextureSource,
    /// The paper. Default made here.
    pub paper: TextureSource,
    /// How the contrast-enhanced texture is filtered. Default linear, as published.
    pub cet_filter: CetFilter,
    /// The light that selects its rows. Default the light before saturation, as published.
    pub cet_coordinate: CetCoordinate,
    /// The operator that enhances contrast. Default the power, as published.
    pub operator: ContrastOperator,
    /// The position of the noise. Default on the picture, as published.
    pub noise: Noise,
    /// The flaws of the text to mend, and additions beyond the text. Default none.
    pub improve: Improvements,
    /// Whether to skip faces turned away from the eye. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge and keeps
    /// the width of grain and paper.
    pub supersample: Supersample,
    /// The finished textures, kept for the next picture with the same settings and shared between clones.
    pub pictures: CharcoalPictures,
}

impl Default for Charcoal {
    fn default() -> Self {
        Self {
            contrast_exponent: 1.5,
            saturation: 1.0,
            smudge: false,
            lights: [Some([0.26, 0.9, 0.35]), Some([-0.7, -0.56, 0.45])],
            density_percent: 60.0,
            cet_exponent: 5.5,
            cet_blur_px: 0.8,
            seed: 0,
            random: Generator::SplitMix,
            texture_size: Size { width: 512, height: 512 },
            cet: TextureSource::Made,
            noise_texture: TextureSource::Made,
            paper: TextureSource::Made,
            cet_filter: CetFilter::Linear,
            cet_coordinate: CetCoordinate::Original,
            operator: ContrastOperator::Power,
            noise: Noise::Screen,
            improve: Improvements::default(),
            cull_back_faces: false,
            supersample: Supersample::One,
            pictures: CharcoalPictures::default(),
        }
    }
}

/// The indices of a plan's pictures in its list.
const NOISE: usize = 0;
const CET: usize = 1;
const PAPER: usize = 2;
const TOOTH: usize = 3;

/// The ground under the light or the contrast-enhanced model when shown alone.
const WHITE: [f32; 4] = [1.0; 4];

/// Returns a light whose length the shader's `normalize` can compute: unchanged, or scaled to length 1 if its squared length
/// exceeds f32.
fn measurable(light: [f32; 3]) -> [f32; 3] {
    const SQUARES: std::ops::RangeInclusive<f32> = 1e-30..=1e30;
    if SQUARES.contains(&light.iter().map(|x| x * x).sum()) {
        return light;
    }
    glam::DVec3::from_array(light.map(f64::from)).normalize_or_zero().as_vec3().to_array()
}

impl Charcoal {
    /// Its noise, contrast-enhanced texture and paper.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for textures that are too large, [`Error::File`] for a picture that cannot be read.
    pub fn textures(&self) -> Result<[Arc<Picture>; 3]> {
        self.pictures.of(self.texture_settings()).map(|CharcoalTextures { noise, cet, paper, .. }| [noise, cet, paper])
    }

    /// Returns the settings that determine its textures.
    fn texture_settings(&self) -> TextureSettings {
        let (size, seed, random) = (self.texture_size, self.seed, self.random);
        TextureSettings {
            contrast: ContrastTexture {
                size,
                seed,
                random,
                density_percent: self.density_percent,
                exponent: self.cet_exponent,
                blur_px: self.cet_blur_px,
            },
            noise: NoiseTexture { size, seed, random },
            sources: [&self.noise_texture, &self.cet, &self.paper].map(TextureSource::clone),
            has_tooth: self.improve.tooth,
        }
    }

    /// Returns the settings of one of the text's recipes.
    pub fn recipe(recipe: CharcoalRecipe) -> Self {
        let base = Self::default();
        match recipe {
            CharcoalRecipe::Plain => base,
            CharcoalRecipe::Darker => Self { density_percent: 85.0, contrast_exponent: 1.2, smudge: true, ..base },
            CharcoalRecipe::Closure => Self { density_percent: 35.0, contrast_exponent: 2.0, saturation: 1.4, ..base },
        }
    }

    /// Paper and drawing.
    pub(super) fn charcoal(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.plan(scene, show, false)
    }

    /// Returns paper and drawing mixed with the models' own textures in sepia.
    pub(super) fn sand(&self, scene: &Scene, show: Show) -> Result<Plan> {
        let has_texture = |mesh: &Mesh| {
            !mesh.triangle_texture_coordinates.is_empty() && mesh.materials.iter().any(|m| m.has_texture())
        };
        if let Some(object) = scene.objects.iter().find(|object| !has_texture(&object.mesh)) {
            return Err(Error::value(
                "style",
                "sand",
                format!(
                    "it draws with the model's own texture, and {} has no texture coordinates or no picture for them; \
                     name one with --skin, or use --style charcoal",
                    object.mesh.name
                ),
            ));
        }
        self.plan(scene, show, true)
    }

    fn plan(&self, scene: &Scene, show: Show, is_sand: bool) -> Result<Plan> {
        self.check(show, is_sand)?;
        let made = self.pictures.of(self.texture_settings())?;
        let cet = match self.cet_filter {
            CetFilter::Linear => Sampling::LinearRepeated,
            CetFilter::Mipmap => Sampling::MipmapRepeated,
        };
        let linear = Sampling::LinearRepeated;
        let picture = |name, picture, sampling| PlanPicture { name, picture, sampling };
        let layout = Layout::of(&made, scene.size, self.supersample.factor(), self.improve.proportion);
        let mut pictures = vec![
            picture("noise", made.noise, linear),
            picture("cet", made.cet, cet),
            picture("paper", made.paper, linear),
        ];
        pictures.extend(made.tooth.map(|tooth| picture(crate::plan::TOOTH, tooth, linear)));
        let has_paper = matches!(show, Show::Final | Show::Paper) && scene.background != Background::Transparent;
        let color = match show {
            Show::Final | Show::Paper => scene.background.clear_color(),
            _ if scene.background == Background::Transparent => [0.0; 4],
            _ => WHITE,
        };
        let mut steps = vec![Step::clear(color)];
        if has_paper {
            let is_published = !self.improve.proportion && self.supersample == Supersample::One;
            let fragments = match is_published {
                true => vec!["valente/paper.frag"],
                false => vec!["valente/paper-even.frag", self.spread(), self.grain()],
            };
            let program = Program::new("valente/paper.vert", fragments);
            // The text draws it in 2D over the whole screen. Later draws are nearer, so it needs no depth.
            steps.push(Step::Draw(Draw {
                uniforms: if is_published { Vec::new() } else { layout.places() },
                textures: vec![("paperTexture", Texture::Picture(PAPER))],
                depth: Depth::Ignore,
                facts: Facts::plain(),
                ..Draw::new(Geometry::ScreenSquare, Some(program))
            }));
        }
        if show != Show::Paper {
            let culls_doubled_faces = self.improve.two_sided && has_doubled_faces(scene);
            let objects = Draw { culls_doubled_faces, ..self.objects(show, is_sand, &layout) };
            // The text's sand already has textures in its own way.
            let own = textured(scene, &objects).filter(|_| show == Show::Final && !is_sand);
            steps.push(Step::Draw(objects));
            steps.extend(own);
        }
        let pass = Pass::new(if is_sand { "sand" } else { "charcoal" }, steps);
        Ok(self.supersample.finish(Plan { pictures, ..Plan::new(vec![pass]) }, scene.size))
    }

    /// The drawing itself.
    fn objects(&self, show: Show, is_sand: bool, layout: &Layout) -> Draw {
        let uniform = |name: &'static str, value| Uniform::new(name, value);
        // The first light that is set; the second is read if both are.
        let lights = self.lights.iter().flatten().zip(["inputLight1", "inputLight2"]);
        let mut uniforms: Vec<Uniform> =
            lights.map(|(light, name)| uniform(name, Value::Vec3(measurable(*light)))).collect();
        uniforms.extend([
            uniform("contrastExp", Value::Float(self.contrast_exponent)),
            uniform("saturationFactor", Value::Float(self.saturation)),
            uniform("smudge", Value::Int(self.smudge.into())),
        ]);
        let mut textures = Vec::new();
        if is_sand && show == Show::Final {
            // First, because the listing reads the first unit's coordinates.
            textures.push(("origTexture", Texture::Material { is_averaged: false }));
        }
        textures.extend([
            ("noiseTexture", Texture::Picture(NOISE)),
            ("contrastTexture", Texture::Picture(CET)),
            ("paperTexture", Texture::Picture(PAPER)),
        ]);
        if self.improve.tooth {
            textures.push(("toothTexture", Texture::Picture(TOOTH)));
        }
        let program = match self.is_published(show) {
            true if is_sand => Program::new("valente/sand.vert", ["valente/sand.frag"]),
            true => Program::new("valente/charcoal.vert", ["valente/charcoal.frag"]),
            false => {
                uniforms.extend(layout.uniforms());
                self.parts(show, is_sand)
            }
        };
        Draw {
            uniforms,
            textures,
            cull_back_faces: self.cull_back_faces,
            facts: Facts { reads_clip_place: !self.improve.paper_coordinate, ..Facts::plain() },
            ..Draw::new(Geometry::Objects(Paint::Uniform([1.0; 4])), Some(program))
        }
    }

    /// Whether the listing can draw this.
    fn is_published(&self, show: Show) -> bool {
        show == Show::Final
            && self.cet_coordinate == CetCoordinate::Original
            && self.operator == ContrastOperator::Power
            && self.noise == Noise::Screen
            && self.has_two_lights()
            && self.improve == Improvements::default()
            && self.supersample == Supersample::One
    }

    fn has_two_lights(&self) -> bool {
        self.lights.iter().all(Option::is_some)
    }

    /// The part that lays textures on the picture.
    fn spread(&self) -> &'static str {
        if self.improve.proportion { "valente/spread-even.frag" } else { "valente/spread-stretched.frag" }
    }

    /// The part that computes where a sample reads them.
    fn grain(&self) -> &'static str {
        if self.supersample == Supersample::One { "valente/grain-sample.frag" } else { "valente/grain-pixel.frag" }
    }

    /// Returns the listing in parts, each with the selected variant.
    fn parts(&self, show: Show, is_sand: bool) -> Program {
        let either = |condition: bool, yes, no| if condition { yes } else { no };
        let improve = &self.improve;
        let mut fragments = vec![
            "valente/charcoal-parts.frag",
            either(self.has_two_lights(), "valente/lights-two.frag", "valente/lights-one.frag"),
            either(improve.two_sided, "valente/side-seen.frag", "valente/side-outer.frag"),
            either(improve.strokes, "valente/strokes-hand.frag", "valente/strokes-none.frag"),
            match self.operator {
                ContrastOperator::Power => "valente/operator-power.frag",
                ContrastOperator::Sigmoid => "valente/operator-sigmoid.frag",
                ContrastOperator::Bias => "valente/operator-bias.frag",
            },
            either(improve.clamp, "valente/clamp-kept.frag", "valente/clamp-discarded.frag"),
            match self.cet_coordinate {
                CetCoordinate::Original => "valente/row-original.frag",
                CetCoordinate::Saturated => "valente/row-saturated.frag",
            },
            either(improve.wrap, "valente/wrap-edge.frag", "valente/wrap-repeat.frag"),
            either(improve.paper_coordinate, "valente/paper-pixel.frag", "valente/paper-vertex.frag"),
            self.spread(),
            self.grain(),
            either(self.noise == Noise::Object, "valente/noise-object.frag", "valente/noise-screen.frag"),
            either(improve.tooth, "valente/tooth-paper.frag", "valente/tooth-none.frag"),
            match show {
                Show::Diffuse => "valente/finish-diffuse.frag",
                Show::Cem => "valente/finish-cem.frag",
                Show::Cet => "valente/finish-cet.frag",
                _ if is_sand => "valente/finish-sand.frag",
                _ => "valente/finish-drawing.frag",
            },
        ];
        if is_sand && show == Show::Final {
            let rec709 = "valente/luminance-rec709.frag";
            fragments.push(either(improve.luminance, rec709, "valente/luminance-published.frag"));
        }
        let vertex = match self.noise {
            Noise::Object => "valente/charcoal-object.vert",
            Noise::Screen => either(is_sand, "valente/sand.vert", "valente/charcoal.vert"),
        };
        Program::new(vertex, fragments)
    }

    fn check(&self, show: Show, is_sand: bool) -> Result<()> {
        let above_zero = |x: f32| x > 0.0 && x.is_finite();
        if !above_zero(self.contrast_exponent) {
            return Err(Error::value(
                "contrast",
                self.contrast_exponent,
                "the exponent is a finite number above 0; below 1 it lightens",
            ));
        }
        if !(self.saturation >= 0.0 && self.saturation.is_finite()) {
            return Err(Error::value(
                "saturation",
                self.saturation,
                "the saturation is a finite number of at least 0; 1 changes nothing",
            ));
        }
        if self.lights == [None, None] {
            return Err(Error::setting("light-2", "the picture needs a light; leave one of the two"));
        }
        for (light, option) in self.lights.iter().zip(["light-1", "light-2"]) {
            let is_direction =
                light.is_none_or(|light| light.iter().all(|x| x.is_finite()) && light.iter().any(|x| *x != 0.0));
            if !is_direction {
                return Err(Error::setting(option, "a light's direction is three finite numbers, not all 0"));
            }
        }
        if matches!(show, Show::Normals | Show::Depth | Show::Map | Show::Borders | Show::Tones) {
            let name = if is_sand { "sand" } else { "charcoal" };
            return Err(Error::setting(
                "show",
                format!("the style {name} has no map, lines or tones; show final, diffuse, cem, cet or paper"),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
