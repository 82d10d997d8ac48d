//! `ink`: the best ink found for an image-space filter that takes no more time than the faithful three passes.
//!
//! Evangelista's three passes with another map and another filter: the map holds each pixel's own plane, and the filter tests
//! whether neighbouring planes meet. `docs/results/measuring.md` has its measurements.

use super::border::{reach, taps};
use super::far_light::{FarLight, unit};
use super::lens::DepthRange;
use super::map::map_texture;
use super::surfaces::{has_doubled_faces, stacked};
use super::textured::textured;
use super::tones::{TOON, ToneLookup};
use super::{
    ALL_STYLES, IMAGE_SPACE, INK, INKING, LineWidth, MapTarget, Show, Supersample, Tones, cull, lens, no_borders,
    supersample,
};
use crate::edges::CreaseAngle;
use crate::error::{Error, Result};
use crate::plan::{
    Depth, Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Target, Texture, Uniform, Value, WhereEven,
};
use crate::scene::{Background, Scene, Size};
use crate::settings::{Setting, Value as _, under, within};

/// Settings of `ink`.
#[derive(Debug, Clone, PartialEq)]
pub struct Ink {
    /// The time budget of the picture. Default standard.
    pub quality: Quality,
    /// Supersampling factor of the drawing; `None`, the default, follows the quality.
    pub supersample: Option<Supersample>,
    /// Whether to draw lines. Default yes.
    pub is_inked: bool,
    /// Smallest angle between planes at a crease. Default 30 degrees; more draws fewer lines.
    pub crease_angle: CreaseAngle,
    /// Width of the lines. Default 2 pixels; more also joins neighbouring lines.
    pub line_width: LineWidth,
    /// Width of the lines that do not border on the background; `None`, the default, uses that of all lines.
    pub inner_width: Option<LineWidth>,
    /// The least step from one surface to another that is a line, in widths of a pixel. Default 1.5; more draws fewer lines.
    pub least_gap_px: f32,
    /// A distant light; `None`, the default, is the listing's near light at (1, 1, 1).
    pub tone_light: Option<FarLight>,
    /// The tones below. Default those of the three passes.
    pub tones: Tones,
    /// Whether to skip faces turned away from the eye. Default no.
    pub cull_back_faces: bool,
    /// How the map gets from pass to pass. Default by a copy of the framebuffer; both ways give the same picture.
    pub map_target: MapTarget,
}

tinta_geometry::choices! {
    /// The time budget of a picture.
    #[derive(Default)]
    pub enum Quality {
        /// At most that of the faithful three passes.
        #[default]
        Standard = "standard",
        /// Every improvement: drawn larger, without specks, and shrunk.
        Best = "best",
    }
}

impl Default for Ink {
    fn default() -> Self {
        Self {
            quality: Quality::Standard,
            supersample: None,
            is_inked: true,
            crease_angle: CreaseAngle::of_drawings(),
            least_gap_px: 1.5,
            line_width: LineWidth::Pixels(2),
            inner_width: None,
            tone_light: None,
            tones: Tones::default(),
            cull_back_faces: false,
            map_target: MapTarget::Copy,
        }
    }
}

impl Ink {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            no_borders(|ink: &Self| !ink.is_inked, |ink, is_without| ink.is_inked = !is_without),
            cull(|ink: &mut Self| &mut ink.cull_back_faces),
            Setting::open_field("supersample", "N", "auto", Supersample::HELP, |ink: &mut Self| &mut ink.supersample),
        ];
        let width = Setting::of(
            "border-width",
            "WIDTH",
            LineWidth::kind(),
            "Width of the lines in pixels, 1 to 64, or as a share of the picture's height such as 0.35%, then at least 2",
            |ink: &Self| ink.line_width.text(),
            |ink, text| {
                ink.line_width = if text == "paper" { Self::default().line_width } else { LineWidth::parse(text)? };
                Ok(())
            },
        );
        let crease = CreaseAngle::setting(|ink: &mut Self| &mut ink.crease_angle);
        let image_space = vec![width.labelled("line width"), MapTarget::setting(|ink: &mut Self| &mut ink.map_target)];
        let own = vec![
            Setting::open_field(
                "inner-width",
                "WIDTH",
                "border",
                "Width of the lines inside the outline: in pixels, in percent of the picture's height, or border \
                 (the outline's width)",
                |ink: &mut Self| &mut ink.inner_width,
            )
            .inside("border-width"),
            Setting::field(
                "quality",
                "QUALITY",
                "Quality of the ink: standard (no slower than three-pass) or best (drawn larger, without specks, then shrunk)",
                |ink: &mut Self| &mut ink.quality,
            ),
            Setting::open_field(
                "tone-light",
                "X,Y,Z",
                "listing",
                "Direction towards a distant light, in eye space, which gives a flat face one tone; auto (chosen so that \
                 about a fifth of the model is dark) or listing (the near light of three-pass)",
                |ink: &mut Self| &mut ink.tone_light,
            )
            .inside("light"),
            Setting::field(
                "least-gap",
                "PIXELS",
                "Smallest step in depth between two surfaces that makes a line, in pixel widths; more draws fewer \
                 lines",
                |ink: &mut Self| &mut ink.least_gap_px,
            )
            .range(0.0, 20.0, 2),
        ];
        under(ALL_STYLES, common)
            .chain(within(Tones::settings(), |ink: &mut Self| Some(&mut ink.tones)))
            .chain(under(INKING, vec![crease]))
            .chain(under(IMAGE_SPACE, image_space))
            .chain(under(INK, own))
            .collect()
    }

    /// Map, tones, ink on top.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.check(show)?;
        let sampling = if show == Show::Map { Supersample::One } else { self.supersample() };
        let surface = sampling.surface(scene.size);
        let mut passes = Vec::new();
        if show != Show::Tones && (self.is_inked || show == Show::Map) {
            passes.push(self.map_pass(scene, surface, show != Show::Map));
        }
        let has_ink = matches!(show, Show::Final | Show::Borders) && self.is_inked;
        if has_ink && self.removes_specks() {
            let steps = vec![Step::clear([0.0; 4]), Step::Draw(self.ink(scene, surface)), Step::CopyFramebuffer];
            passes.push(Pass::new("ink", steps));
        }
        if matches!(show, Show::Final | Show::Tones) {
            passes.push(self.tone_pass(scene));
        }
        if has_ink {
            let (name, square) = match self.removes_specks() {
                true => ("specks", self.without_specks(scene, surface)),
                false => ("ink", self.ink(scene, surface)),
            };
            let ground = (show == Show::Borders).then(|| Step::clear(blank(scene)));
            passes.push(Pass::new(name, ground.into_iter().chain([Step::Draw(square)]).collect()));
        }
        let tables = if show == Show::Borders { Vec::new() } else { self.tones.tables() };
        let plan = stacked(Plan { tables, ..Plan::new(passes) }, scene);
        Ok(sampling.finish(plan, scene.size))
    }

    fn supersample(&self) -> Supersample {
        self.supersample.unwrap_or(if self.quality == Quality::Best { Supersample::Two } else { Supersample::One })
    }

    /// Whether isolated ink at most twice as long as a line is wide goes. Testing the neighbours of all ink takes about half of the
    /// picture's time again with a software driver.
    fn removes_specks(&self) -> bool {
        self.quality == Quality::Best
    }

    fn check(&self, show: Show) -> Result<()> {
        if !matches!(show, Show::Final | Show::Tones | Show::Borders | Show::Map) {
            return Err(Error::setting("show", "the style ink has final, tones, borders and map; show one of these"));
        }
        if !self.is_inked && matches!(show, Show::Borders | Show::Map) {
            return Err(Error::setting("show", "--no-borders leaves no ink to show; leave out one of the two"));
        }
        self.line_width.check("border-width")?;
        self.inner_width.map_or(Ok(()), |width| width.check("inner-width"))?;
        self.tone_light.map_or(Ok(()), FarLight::check)?;
        if self.tone_light.is_some() && self.tones.lookup == ToneLookup::Texture {
            return Err(Error::settings(
                &["tone-lookup", "tone-light"],
                "tones by a light from a direction are compared; leave out one of the two",
            ));
        }
        self.tones.check()
    }

    /// Each pixel's plane.
    fn map_pass(&self, scene: &Scene, surface: Size, is_read: bool) -> Pass {
        let depth = DepthRange::of_scene(scene);
        let program = Program::new("improved/plane-map.vert", ["improved/plane-map.frag"]);
        let objects = Draw {
            uniforms: vec![lens::footprint(scene, surface, depth), depth.of_distance(scene)],
            cull_back_faces: self.cull_back_faces,
            culls_doubled_faces: has_doubled_faces(scene),
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(Paint::Materials), Some(program))
        };
        let mut steps = vec![Step::clear([0.0; 4]), Step::Draw(objects)];
        // The picture of a map is in the framebuffer.
        let target = if is_read { self.map_target.target() } else { Target::Framebuffer };
        if is_read && target == Target::Framebuffer {
            steps.push(Step::CopyFramebuffer);
        }
        Pass { target, ..Pass::new("map", steps) }
    }

    /// The published tones; the background is cleared and needs no square.
    fn tone_pass(&self, scene: &Scene) -> Pass {
        let mut objects = match self.tone_light {
            Some(light) => self.far_tones(light.towards(scene, self.tones.far_thresholds())),
            None => self.tones.draw(TOON, false),
        };
        objects.cull_back_faces = self.cull_back_faces;
        objects.culls_doubled_faces = has_doubled_faces(scene);
        let texture = textured(scene, &objects);
        let mut steps = vec![Step::clear(scene.background.clear_color()), Step::Draw(objects)];
        steps.extend(texture);
        Pass::new("tones", steps)
    }

    /// Tones by a light from a direction.
    fn far_tones(&self, light: [f32; 3]) -> Draw {
        let program = Program::new("improved/tones-far.vert", ["improved/tones-far.frag"]);
        let uniforms = vec![
            Uniform::new("lightDirection", Value::Vec3(unit(light).as_vec3().to_array())),
            Uniform::new("toneThresholds", Value::Vec2(self.tones.far_thresholds())),
            Uniform::new("toneLevels", Value::Vec3(self.tones.levels)),
        ];
        let draw = Draw::new(Geometry::Objects(Paint::Materials), Some(program));
        Draw { uniforms, facts: Facts::plain(), ..draw }
    }

    /// The filter over the whole picture.
    fn ink(&self, scene: &Scene, surface: Size) -> Draw {
        let float = |name: &'static str, value: f64| Uniform::new(name, Value::Float(value as f32));
        let (scale, width) = (self.supersample().factor(), self.line_width.pixels(scene.size));
        let inner_width = self.inner_width.unwrap_or(self.line_width).pixels(scene.size);
        let mut uniforms = vec![
            supersample::texture_unit(surface),
            lens::footprint(scene, surface, DepthRange::of_scene(scene)),
            float("gapThreshold", f64::from(self.least_gap_px * scale as f32)),
            float("creaseCosine", self.crease_angle.cosine),
            reach("reach", Some(width), scale, false),
            reach("innerReach", Some(inner_width), scale, false),
        ];
        let [before, behind] = taps(Some(width.max(inner_width)), scale, false);
        uniforms.extend(lens::rays(scene, surface));
        let fragments = vec!["improved/plane-ink.frag", "improved/ink-depth-map.frag", "improved/ink-turn-planes.frag"];
        let textures = vec![("planeMap", map_texture(self.map_target.target()))];
        over_the_picture(fragments, uniforms, textures, before.max(behind) + 1)
    }

    /// Redraws the ink without its specks.
    fn without_specks(&self, scene: &Scene, surface: Size) -> Draw {
        // A mark less than twice as long as wide is no stroke.
        let size = (2 * self.line_width.pixels(scene.size) * self.supersample().factor()).min(LARGEST_SPECK);
        let uniforms = vec![supersample::texture_unit(surface), Uniform::new("speckSize", Value::Float(size as f32))];
        over_the_picture(vec!["improved/specks.frag"], uniforms, vec![("inkMask", Texture::BorderMap)], size + 1)
    }
}

/// Largest speck, in drawn pixels. Larger marks are rarely specks, and a wider search costs time.
const LARGEST_SPECK: u32 = 16;

/// Returns the ground for ink alone: white, or transparent.
fn blank(scene: &Scene) -> [f32; 4] {
    if scene.background == Background::Transparent { [0.0; 4] } else { [1.0; 4] }
}

/// A filter over the whole picture, whose pixels depend on others up to `reach_px` away.
fn over_the_picture(
    fragments: Vec<&'static str>,
    uniforms: Vec<Uniform>,
    textures: Vec<(&'static str, Texture)>,
    reach_px: u32,
) -> Draw {
    let program = Program::new("evangelista/border.vert", fragments);
    Draw {
        uniforms,
        textures,
        depth: Depth::Ignore,
        facts: Facts {
            reach_px: Some(reach_px),
            // It discards pixels without ink.
            keeps_pixels: false,
            where_even: Some(WhereEven::Unchanged),
            ..Facts::plain()
        },
        ..Draw::new(Geometry::ScreenSquare, Some(program))
    }
}
