//! `three-pass` and `two-pass`: Evangelista et al. 2005.
//!
//! With the article's settings the published shaders run. Other settings run their twins (`*-settings.frag`), which have uniforms
//! in place of the constants. A test shows that the twins draw the same picture.

use super::textured::textured;
use super::tones::TOON;
use super::{
    ALL_STYLES, Border, CARTOON, IMAGE_SPACE, MapEncoding, MapTarget, Show, Supersample, Tones, cull, no_borders,
};
use crate::error::{Error, Result};
use crate::plan::{Depth, Draw, Facts, Geometry, Output, Paint, Pass, Plan, Program, Step, Target, WhereEven};
use crate::scene::{Background, Scene};
use crate::settings::{ON_OFF, Setting, under, within};

/// Settings of both cartoon styles; the defaults are the article's.
#[derive(Debug, Clone, PartialEq)]
pub struct Cartoon {
    /// The tones.
    pub tones: Tones,
    /// The border; `None` draws the tones alone.
    pub border: Option<Border>,
    /// Whether to draw a square of the background's colour behind the scene, as the article does in every scene. Default yes;
    /// without it the two-pass style loses the outer half of every silhouette (errata E10).
    pub background_square: bool,
    /// Whether to skip faces turned away from the eye: faster. The picture of closed models changes only in a few pixels at
    /// outlines. Default no.
    pub cull_back_faces: bool,
    /// How normals and depth are stored between the passes. Default as in the listing.
    pub map_encoding: MapEncoding,
    /// How the map gets from pass to pass. Default as in the listing; both ways give the same picture.
    pub map_target: MapTarget,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge and makes
    /// lines finer. Pictures of the map itself keep their size.
    pub supersample: Supersample,
}

impl Default for Cartoon {
    fn default() -> Self {
        Self {
            tones: Tones::default(),
            border: Some(Border::default()),
            background_square: true,
            cull_back_faces: false,
            map_encoding: MapEncoding::Published,
            map_target: MapTarget::Copy,
            supersample: Supersample::One,
        }
    }
}

impl Cartoon {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            no_borders(
                |cartoon: &Self| cartoon.border.is_none(),
                |cartoon, is_without| cartoon.border = (!is_without).then(|| cartoon.border.unwrap_or_default()),
            ),
            cull(|cartoon: &mut Self| &mut cartoon.cull_back_faces),
            Supersample::setting(|cartoon: &mut Self| &mut cartoon.supersample),
        ];
        let map = vec![
            Setting::field(
                "background-quad",
                ON_OFF,
                "Draw a square behind the scene, on or off; without it outer borders are lost",
                |cartoon: &mut Self| &mut cartoon.background_square,
            )
            .labelled("background square"),
            Setting::field("map-encoding", "ENCODING", MapEncoding::HELP, |cartoon: &mut Self| {
                &mut cartoon.map_encoding
            }),
        ];
        let image_space = vec![MapTarget::setting(|cartoon: &mut Self| &mut cartoon.map_target)];
        under(ALL_STYLES, common)
            .chain(within(Tones::settings(), |cartoon: &mut Self| Some(&mut cartoon.tones)))
            .chain(within(Border::settings(), |cartoon: &mut Self| cartoon.border.as_mut()))
            .chain(under(CARTOON, map))
            .chain(under(IMAGE_SPACE, image_space))
            .collect()
    }
}

/// Borders alone are drawn on white, as in figure 12.
const WHITE: [f32; 4] = [1.0; 4];

impl Cartoon {
    /// Map, tones, border blended on top (appendix 1).
    pub(super) fn three_pass(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.check(scene, show)?;
        let mut passes = Vec::new();
        let border = self.border.filter(|_| show != Show::Tones);
        // Made and copied without a border too, as in the published pipeline; `prune` removes it because it is unread.
        if show != Show::Tones {
            passes.push(self.map_pass(scene, !shows_map(show)));
        }
        if !shows_map(show) {
            if show != Show::Borders {
                passes.push(self.tone_pass(scene));
            }
            if let Some(border) = border {
                passes.extend(self.border_passes(&border, scene, show == Show::Borders));
            }
        }
        Ok(self.finish(scene, passes, show))
    }

    /// Map, then tones and border in one program (section 4.2, appendix 2).
    pub(super) fn two_pass(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.check(scene, show)?;
        let border = self.border.filter(|_| show != Show::Tones);
        let Some(border) = border.filter(|_| !shows_map(show) && show != Show::Borders) else {
            // The three passes draw its map, tones and borders when shown alone.
            return self.three_pass(scene, show);
        };
        if scene.background == Background::Transparent && self.background_square {
            return Err(Error::value(
                "background",
                "transparent",
                "two-pass draws its outer borders on an opaque background square; use --style three-pass, or \
                 --background-quad off and lose them",
            ));
        }
        let filter = border.shaders(self.map_encoding)?;
        let steps = self.scene_steps(scene, |background| {
            let surface = self.supersample.surface(scene.size);
            let published = border.runs_the_listing(self.map_encoding) && self.tones.are_published();
            let (mut uniforms, mut textures) =
                (Border::published_uniforms(surface), self.map_encoding.textures(self.map_target));
            let mut fragments = vec!["evangelista/two-pass.frag"];
            if !published {
                fragments = vec!["evangelista/two-pass-settings.frag", self.tones.shader()];
                fragments.extend(filter);
                uniforms = border.uniforms(scene, surface, self.map_encoding);
                uniforms.extend(self.tones.uniforms(background));
                textures.extend(self.tones.textures());
            }
            let program = Program::new("evangelista/two-pass.vert", fragments);
            let facts = Facts {
                reach_px: Some(border.reach_px(scene, surface)),
                // On the background every tone is 1.
                where_even: background.then(|| WhereEven::Color(scene.background.clear_color())),
                shorter: self.tones.shorter(&program),
                ..Facts::plain()
            };
            Draw { uniforms, textures, facts, ..self.draw(Geometry::Objects(Paint::Materials), program) }
        });
        let pass = Pass::new("tones-and-border", steps);
        Ok(self.finish(scene, vec![self.map_pass(scene, true), pass], show))
    }

    pub(super) fn check(&self, scene: &Scene, show: Show) -> Result<()> {
        if matches!(show, Show::Diffuse | Show::Cem | Show::Cet | Show::Paper) {
            return Err(Error::setting(
                "show",
                "diffuse, cem, cet and paper are pictures of the styles charcoal and sand; show final, normals, depth, map, \
                 borders or tones",
            ));
        }
        self.tones.check()?;
        if self.map_encoding == MapEncoding::Numbers && self.border.is_some_and(|border| border.slope_threshold) {
            let problem = "a map of numbers has no depth; leave out one of the two";
            return Err(Error::settings(&["slope-threshold", "map-encoding"], problem));
        }
        match self.border {
            Some(border) => border.check()?,
            None if show == Show::Borders => {
                return Err(Error::value(
                    "show",
                    "borders",
                    "--no-borders leaves none to show; leave out one of the two",
                ));
            }
            None => {}
        }
        if scene.background == Background::Transparent && matches!(show, Show::Normals | Show::Depth) {
            return Err(Error::value(
                "background",
                "transparent",
                "normals and depth are opaque pictures; leave it out here",
            ));
        }
        Ok(())
    }

    fn finish(&self, scene: &Scene, passes: Vec<Pass>, show: Show) -> Plan {
        let output = match show {
            Show::Normals => Output::Rgb,
            Show::Depth => Output::AlphaAsGrey,
            _ => Output::Rgba,
        };
        let reads_table = passes
            .iter()
            .flat_map(|pass| &pass.steps)
            .any(|step| matches!(step, Step::Draw(draw) if draw.textures.iter().any(|(name, _)| *name == "toneTable")));
        let tables = if reads_table { self.tones.tables() } else { Vec::new() };
        let plan = Plan { tables, output, ..Plan::new(passes) };
        if shows_map(show) { plan } else { self.supersample.finish(plan, scene.size) }
    }

    /// Step 1: normals and depth into the framebuffer and, for later reading, into a texture.
    fn map_pass(&self, scene: &Scene, is_read: bool) -> Pass {
        let encoding = self.map_encoding;
        let draw = |geometry| self.draw(geometry, encoding.program());
        let mut steps = vec![Step::clear(encoding.empty())];
        if self.background_square {
            let [red, green, blue, _] = scene.background.clear_color();
            let square = draw(Geometry::BackgroundSquare { color: [red, green, blue, 1.0] });
            let facts = Facts::constant(encoding.background());
            steps.push(Step::Draw(Draw { depth: Depth::Ignore, facts, ..square }));
        }
        steps.push(Step::Draw(draw(Geometry::Objects(encoding.paint(scene)))));
        // The picture of a map is in the framebuffer.
        let target = if is_read { encoding.target(self.map_target) } else { Target::Framebuffer };
        if is_read && target == Target::Framebuffer {
            steps.push(Step::CopyFramebuffer);
        }
        if is_read && encoding == MapEncoding::DepthTexture {
            steps.push(Step::CopyDepth);
        }
        Pass { target, ..Pass::new("map", steps) }
    }

    /// Step 2: uniform shading.
    fn tone_pass(&self, scene: &Scene) -> Pass {
        let steps = self.scene_steps(scene, |background| {
            let mut draw = self.tones.draw(TOON, background);
            draw.cull_back_faces = self.cull_back_faces;
            // On the background every tone is 1: the published highlight's, or that of settings.
            draw.facts.constant_color = background.then(|| scene.background.clear_color());
            draw
        });
        Pass::new("tones", steps)
    }

    fn draw(&self, geometry: Geometry, program: Program) -> Draw {
        Draw { cull_back_faces: self.cull_back_faces, facts: Facts::plain(), ..Draw::new(geometry, Some(program)) }
    }

    /// Clear, background square, objects; `draw` returns the draw of the background (true) or of the objects (false).
    fn scene_steps(&self, scene: &Scene, draw: impl Fn(bool) -> Draw) -> Vec<Step> {
        let color = scene.background.clear_color();
        let mut steps = vec![Step::clear(color)];
        if self.background_square && scene.background != Background::Transparent {
            let geometry = Geometry::BackgroundSquare { color };
            // It follows the clear, behind everything, so it needs no depth.
            steps.push(Step::Draw(Draw { geometry, depth: Depth::Ignore, ..draw(true) }));
        }
        let objects = draw(false);
        let texture = textured(scene, &objects);
        steps.push(Step::Draw(objects));
        steps.extend(texture);
        steps
    }

    /// Step 3: the filter over the whole picture, blended, a pass for each of its programs; `alone` on a white ground.
    fn border_passes(&self, border: &Border, scene: &Scene, alone: bool) -> Vec<Pass> {
        let surface = self.supersample.surface(scene.size);
        let textures = self.map_encoding.textures(self.map_target);
        let squares = border.squares(scene, surface, self.map_encoding, &textures);
        let mut passes: Vec<Pass> =
            squares.into_iter().map(|(name, square)| Pass::new(name, vec![Step::Draw(square)])).collect();
        if alone && let Some(first) = passes.first_mut() {
            let color = if scene.background == Background::Transparent { [0.0; 4] } else { WHITE };
            first.steps.insert(0, Step::clear(color));
        }
        passes
    }
}

fn shows_map(show: Show) -> bool {
    matches!(show, Show::Normals | Show::Depth | Show::Map)
}
