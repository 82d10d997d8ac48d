//! `charcoal` and `sand`: Valente 2007, after Majumder and Gopi 2002.
//!
//! One pass: the paper over the whole picture, then the objects, dark grain where little light falls. The published listings
//! run unless a setting is none of their uniforms; then their parts do, each of which can be exchanged alone
//! (`glsl/valente/charcoal-parts.frag`). A test shows that listing and parts draw the same picture.

mod choices;
mod pictures;

pub use choices::{CetCoordinate, CetFilter, CharcoalRecipe, ContrastOperator, Improvements, Noise};
pub use pictures::{CharcoalPictures, Paper};

use super::{ALL_STYLES, Show, cull};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::plan::{
    Depth, Draw, Facts, Geometry, Paint, Pass, Plan, PlanPicture, Program, Sampling, Step, Texture, Uniform, Value,
};
use crate::scene::{Background, Scene, Size};
use crate::settings::{Kind, ON_OFF, Setting, Value as _, names_of, under};

/// Settings of `charcoal` and `sand`; the defaults are the text's where it gives them, ours elsewhere (errata V7).
#[derive(Debug, Clone, PartialEq)]
pub struct Charcoal {
    /// Exponent m of the contrast operator, above 0. Default 1.5, ours; more darkens all but the lights.
    pub contrast_exponent: f32,
    /// What the contrast-enhanced light is multiplied by, at least 0. Default 1; 1.2 lightens by a fifth, so that faint
    /// lines vanish: the text's closure.
    pub saturation: f32,
    /// Whether the drawing is multiplied by the light again, which darkens. Default no.
    pub smudge: bool,
    /// Directions towards the two lights, eye space, of any length above 0. Default ours: from above and from the lower
    /// left, 122 degrees apart, so that together they nowhere exceed 1; nearer to each other they wrap (errata V3).
    pub lights: [[f32; 3]; 2],
    /// Share of black in the contrast-enhanced texture before its grains are moved, percent. Default 60, the text's; more
    /// is darker.
    pub density_percent: f64,
    /// Exponent of the contrast-enhanced texture, at least 1. Default 5.5, the text's middle one; more leaves fewer
    /// grains in light tones.
    pub cet_exponent: f64,
    /// Standard deviation of the blur of the contrast-enhanced texture, pixels, 0 to 100. Default 0.8, ours; more is softer
    /// grain, and none at all where it is as wide as a row of tones.
    pub cet_blur_px: f64,
    /// Where the random numbers of all textures begin. Default 0.
    pub seed: u64,
    /// Size of the textures made here, pixels. Default 512 x 512. Noise and paper are stretched once over the picture, as
    /// published: more is finer grain.
    pub texture_size: Size,
    /// The paper. Default made here.
    pub paper: Paper,
    /// How the contrast-enhanced texture is filtered. Default linear, as published.
    pub cet_filter: CetFilter,
    /// By which light its rows are read. Default that before saturation, as published.
    pub cet_coordinate: CetCoordinate,
    /// What enhances contrast. Default the power, as published.
    pub operator: ContrastOperator,
    /// Where the noise lies. Default on the picture, as published.
    pub noise: Noise,
    /// Which of the text's flaws are mended. Default none.
    pub improve: Improvements,
    /// Whether faces turned away from the eye are left out. Default no.
    pub cull_back_faces: bool,
    /// The textures once they are made; kept for the next picture with the same settings and shared between clones.
    pub pictures: CharcoalPictures,
}

impl Default for Charcoal {
    fn default() -> Self {
        Self {
            contrast_exponent: 1.5,
            saturation: 1.0,
            smudge: false,
            lights: [[0.26, 0.9, 0.35], [-0.7, -0.56, 0.45]],
            density_percent: 60.0,
            cet_exponent: 5.5,
            cet_blur_px: 0.8,
            seed: 0,
            texture_size: Size { width: 512, height: 512 },
            paper: Paper::Made,
            cet_filter: CetFilter::Linear,
            cet_coordinate: CetCoordinate::Original,
            operator: ContrastOperator::Power,
            noise: Noise::Screen,
            improve: Improvements::default(),
            cull_back_faces: false,
            pictures: CharcoalPictures::default(),
        }
    }
}

impl Charcoal {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![cull(|charcoal: &mut Self| &mut charcoal.cull_back_faces)];
        let recipe = Setting::of(
            "charcoal",
            "RECIPE",
            Kind::Recipe(names_of::<CharcoalRecipe>()),
            "Recipe: published, darker (density 85, contrast exponent 1.2, smudged), closure (density 35, contrast exponent 2, \
             saturation 1.4); options given beside it count more",
            |_: &Self| CharcoalRecipe::Published.text(),
            |charcoal, text| {
                let recipe = Self::recipe(CharcoalRecipe::parse(text)?);
                (charcoal.density_percent, charcoal.contrast_exponent) =
                    (recipe.density_percent, recipe.contrast_exponent);
                (charcoal.smudge, charcoal.saturation) = (recipe.smudge, recipe.saturation);
                Ok(())
            },
        );
        let grain = vec![
            recipe,
            Setting::field(
                "seed",
                "N",
                "Where the random numbers begin; the same seed gives the same textures",
                |charcoal: &mut Self| &mut charcoal.seed,
            )
            .range(0.0, 1000.0, 0),
            Setting::field(
                "density",
                "PERCENT",
                "Share of black pixels in the grain's texture before they are moved, percent; more is darker",
                |charcoal: &mut Self| &mut charcoal.density_percent,
            )
            .range(0.0, 100.0, 0),
            Setting::field(
                "cet-exponent",
                "M",
                "Exponent m that moves black pixels along t to t^m; more leaves fewer grains in light tones",
                |charcoal: &mut Self| &mut charcoal.cet_exponent,
            )
            .range(1.0, 20.0, 1)
            .labelled("grain exponent"),
            Setting::field(
                "cet-blur",
                "PIXELS",
                "Standard deviation of the blur that follows, pixels; more is softer grain",
                |charcoal: &mut Self| &mut charcoal.cet_blur_px,
            )
            .range(0.0, 5.0, 2)
            .labelled("grain blur"),
        ];
        let drawing = vec![
            Setting::field(
                "contrast-exponent",
                "M",
                "Exponent of the light's contrast; more darkens all but the lights",
                |charcoal: &mut Self| &mut charcoal.contrast_exponent,
            )
            .range(0.1, 6.0, 2),
            Setting::field(
                "saturation",
                "FACTOR",
                "What the light is multiplied by; above 1 faint lines vanish (closure)",
                |charcoal: &mut Self| &mut charcoal.saturation,
            )
            .range(0.0, 3.0, 2),
            Setting::field("smudge", ON_OFF, "Smudge the drawing, on or off; on is darker", |charcoal: &mut Self| {
                &mut charcoal.smudge
            }),
            Setting::field(
                "light-1",
                "X,Y,Z",
                "Direction towards the first light, seen from the eye",
                |charcoal: &mut Self| &mut charcoal.lights[0],
            )
            .range(-1.0, 1.0, 2)
            .labelled("first light"),
            Setting::field("light-2", "X,Y,Z", "Direction towards the second light", |charcoal: &mut Self| {
                &mut charcoal.lights[1]
            })
            .range(-1.0, 1.0, 2)
            .labelled("second light"),
            Setting::field(
                "paper",
                "FILE",
                "Picture of the paper, stretched over the whole drawing in place of --background",
                |charcoal: &mut Self| &mut charcoal.paper,
            )
            .said("made from the seed"),
            Setting::field(
                "texture-size",
                "WxH",
                "Size of grain, noise and paper, stretched over the drawing; more is finer",
                |charcoal: &mut Self| &mut charcoal.texture_size,
            ),
            Setting::field(
                "cet-filter",
                "FILTER",
                "Filter of the grain's texture: linear, mipmap (blurs the grain away)",
                |charcoal: &mut Self| &mut charcoal.cet_filter,
            )
            .labelled("grain filter"),
            Setting::field(
                "cet-coordinate",
                "LIGHT",
                "Light that chooses the grain: original, saturated",
                |charcoal: &mut Self| &mut charcoal.cet_coordinate,
            )
            .labelled("grain chosen by"),
            Setting::field(
                "contrast-operator",
                "OPERATOR",
                "What enhances contrast: power (as published), sigmoid, bias",
                |charcoal: &mut Self| &mut charcoal.operator,
            ),
            Setting::field(
                "noise",
                "WHERE",
                "Where the noise lies: screen (as published), object (turns with the model)",
                |charcoal: &mut Self| &mut charcoal.noise,
            ),
            Setting::field(
                "improve",
                "FLAWS",
                "Flaws of the text to mend: clamp, wrap, paper-coordinate, luminance with commas between, or all",
                |charcoal: &mut Self| &mut charcoal.improve,
            )
            .labelled("mended flaws"),
        ];
        let heading = "Styles charcoal and sand (the defaults are the text's where it gives them)";
        under(ALL_STYLES, common).chain(under(heading, grain)).chain(under(heading, drawing)).collect()
    }
}

/// Where a plan's pictures are in its list.
const NOISE: usize = 0;
const CET: usize = 1;
const PAPER: usize = 2;

/// The ground of the light and the contrast-enhanced model, shown by themselves.
const WHITE: [f32; 4] = [1.0; 4];

/// A light whose length the shader's `normalize` can compute: as it is, or one as long as 1 where the square of its length is
/// beyond f32.
fn measurable(light: [f32; 3]) -> [f32; 3] {
    const SQUARES: std::ops::RangeInclusive<f32> = 1e-30..=1e30;
    if SQUARES.contains(&light.iter().map(|x| x * x).sum()) {
        return light;
    }
    glam::DVec3::from_array(light.map(f64::from)).normalize_or_zero().as_vec3().to_array()
}

impl Charcoal {
    /// The settings of one of the text's recipes.
    pub fn recipe(recipe: CharcoalRecipe) -> Self {
        let base = Self::default();
        match recipe {
            CharcoalRecipe::Published => base,
            CharcoalRecipe::Darker => Self { density_percent: 85.0, contrast_exponent: 1.2, smudge: true, ..base },
            CharcoalRecipe::Closure => Self { density_percent: 35.0, contrast_exponent: 2.0, saturation: 1.4, ..base },
        }
    }

    /// Paper and drawing.
    pub(super) fn charcoal(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.plan(scene, show, false)
    }

    /// Paper and drawing mixed with the models' own textures in sepia.
    pub(super) fn sand(&self, scene: &Scene, show: Show) -> Result<Plan> {
        let has_texture = |mesh: &Mesh| {
            !mesh.triangle_texture_coordinates.is_empty() && mesh.materials.iter().any(|m| m.has_texture())
        };
        if let Some(object) = scene.objects.iter().find(|object| !has_texture(&object.mesh)) {
            return Err(Error::value(
                "style",
                "sand",
                format!(
                    "it draws with a model's own texture, and {} has no texture coordinates with a picture for them; give \
                     it one with --skin, or use --style charcoal",
                    object.mesh.name
                ),
            ));
        }
        self.plan(scene, show, true)
    }

    fn plan(&self, scene: &Scene, show: Show, is_sand: bool) -> Result<Plan> {
        self.check(show, is_sand)?;
        let made = self.pictures.of(self)?;
        let cet = match self.cet_filter {
            CetFilter::Linear => Sampling::LinearRepeated,
            CetFilter::Mipmap => Sampling::MipmapRepeated,
        };
        let linear = Sampling::LinearRepeated;
        let picture = |name, picture, sampling| PlanPicture { name, picture, sampling };
        let pictures = vec![
            picture("noise", made.noise, linear),
            picture("cet", made.cet, cet),
            picture("paper", made.paper, linear),
        ];
        let has_paper = matches!(show, Show::Final | Show::Paper) && scene.background != Background::Transparent;
        let color = match show {
            Show::Final | Show::Paper => scene.background.clear_color(),
            _ if scene.background == Background::Transparent => [0.0; 4],
            _ => WHITE,
        };
        let mut steps = vec![Step::clear(color)];
        if has_paper {
            let program = Program { vertex: "valente/paper.vert", fragments: vec!["valente/paper.frag"] };
            // The text draws it in 2D over the whole screen; what follows is nearer, so it needs no depth.
            steps.push(Step::Draw(Draw {
                textures: vec![("paperTexture", Texture::Picture(PAPER))],
                depth: Depth::Ignore,
                facts: Facts::plain(),
                ..Draw::new(Geometry::ScreenSquare, Some(program))
            }));
        }
        if show != Show::Paper {
            steps.push(Step::Draw(self.objects(scene, show, is_sand)));
        }
        let pass = Pass::new(if is_sand { "sand" } else { "charcoal" }, steps);
        Ok(Plan { pictures, ..Plan::new(vec![pass]) })
    }

    /// The drawing itself.
    fn objects(&self, scene: &Scene, show: Show, is_sand: bool) -> Draw {
        let uniform = |name, value| Uniform { name, value };
        let mut uniforms = vec![
            uniform("inputLight1", Value::Vec3(measurable(self.lights[0]))),
            uniform("inputLight2", Value::Vec3(measurable(self.lights[1]))),
            uniform("contrastExp", Value::Float(self.contrast_exponent)),
            uniform("saturationFactor", Value::Float(self.saturation)),
            uniform("smudge", Value::Int(self.smudge.into())),
        ];
        let mut textures = Vec::new();
        if is_sand && show == Show::Final {
            // First, for the first unit's coordinates are those the listing reads.
            textures.push(("origTexture", Texture::Material));
        }
        textures.extend([
            ("noiseTexture", Texture::Picture(NOISE)),
            ("contrastTexture", Texture::Picture(CET)),
            ("paperTexture", Texture::Picture(PAPER)),
        ]);
        let program = match self.is_published(show) {
            true if is_sand => Program { vertex: "valente/sand.vert", fragments: vec!["valente/sand.frag"] },
            true => Program { vertex: "valente/charcoal.vert", fragments: vec!["valente/charcoal.frag"] },
            false => {
                let Size { width, height } = scene.size;
                let texel = 1.0 / self.texture_size.height as f32;
                let unit = [1.0 / width as f32, 1.0 / height as f32];
                // About as many texels a pixel as on the screen, where the scene's radius is about half the picture.
                let across = [width, height].map(|side| width.min(height) as f32 / side as f32 * 0.5);
                uniforms.extend([
                    uniform("cetTexel", Value::Float(texel)),
                    uniform("textureUnit", Value::Vec2(unit)),
                    uniform("noiseScale", Value::Vec2(across)),
                ]);
                self.parts(show, is_sand)
            }
        };
        Draw {
            uniforms,
            textures,
            cull_back_faces: self.cull_back_faces,
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(Paint::Uniform([1.0; 4])), Some(program))
        }
    }

    /// Whether the listing can draw this.
    fn is_published(&self, show: Show) -> bool {
        show == Show::Final
            && self.cet_coordinate == CetCoordinate::Original
            && self.operator == ContrastOperator::Power
            && self.noise == Noise::Screen
            && self.improve == Improvements::default()
    }

    /// The listing in parts, each the one that is asked for.
    fn parts(&self, show: Show, is_sand: bool) -> Program {
        let either = |condition: bool, yes, no| if condition { yes } else { no };
        let improve = &self.improve;
        let mut fragments = vec![
            "valente/charcoal-parts.frag",
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
            either(self.noise == Noise::Object, "valente/noise-object.frag", "valente/noise-screen.frag"),
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
        Program { vertex, fragments }
    }

    fn check(&self, show: Show, is_sand: bool) -> Result<()> {
        let above_zero = |x: f32| x > 0.0 && x.is_finite();
        if !above_zero(self.contrast_exponent) {
            return Err(Error::value(
                "contrast-exponent",
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
        for (light, option) in self.lights.iter().zip(["light-1", "light-2"]) {
            let is_direction = light.iter().all(|x| x.is_finite()) && light.iter().any(|x| *x != 0.0);
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
