//! `suggestive`: contours and suggestive contours found in a picture, after the image-space method of DeCarlo et al. 2003.
//!
//! The surface is drawn with the cosine between its normal and the view as its only shade, bright where it faces the eye. A pixel
//! is ink where that picture has a valley: few pixels around it are darker, and at least one is much brighter. This finds
//! contours too, because the ground beside them is bright. Style `lines` finds the lines on the surface itself (`--classes
//! suggestive`).

use super::ink::Ink;
use super::surfaces::has_doubled_faces;
use super::{ALL_STYLES, SUGGESTIVE, Show, Supersample, Tones, cull, no_borders, supersample};
use crate::error::{Error, Result};
use crate::plan::{Depth, Draw, Facts, Geometry, Paint, Pass, Plan, Program, Step, Texture, Uniform, Value, WhereEven};
use crate::scene::{Background, Scene};
use crate::settings::{Setting, under, within};

/// Settings of `suggestive`.
#[derive(Debug, Clone, PartialEq)]
pub struct Suggestive {
    /// Whether to draw lines. Default yes.
    pub is_inked: bool,
    /// Radius of the neighbourhood that a pixel is compared with, 1 to 16. Default 5 pixels; more finds wider valleys, draws
    /// wider lines and takes longer by its square.
    pub radius_px: u32,
    /// Largest share of darker neighbours of a pixel in a valley, above 0 and below 1. Default 0.2; more draws wider lines and
    /// eventually slopes.
    pub darker_share: f32,
    /// Least excess of the brightest neighbour's brightness, 0 to 1. Default 0.1; more leaves out shallow valleys.
    pub least_depth: f32,
    /// The tones below. Default those of the three passes.
    pub tones: Tones,
    /// Whether to skip faces turned away from the eye. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge.
    pub supersample: Supersample,
}

impl Default for Suggestive {
    fn default() -> Self {
        Self {
            is_inked: true,
            radius_px: 5,
            darker_share: 0.2,
            least_depth: 0.1,
            tones: Tones::default(),
            cull_back_faces: false,
            supersample: Supersample::One,
        }
    }
}

/// Largest radius, pixels of the picture: 900 reads per pixel.
const LARGEST_RADIUS: u32 = 16;

impl Suggestive {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            no_borders(|style: &Self| !style.is_inked, |style, is_without| style.is_inked = !is_without),
            cull(|style: &mut Self| &mut style.cull_back_faces),
            Supersample::setting(|style: &mut Self| &mut style.supersample),
        ];
        let own = vec![
            Setting::field(
                "valley-radius",
                "PIXELS",
                "Radius of the neighbourhood searched for valleys of shade, in pixels, 1 to 16; more draws wider \
                 lines",
                |style: &mut Self| &mut style.radius_px,
            )
            .ours("chosen by eye on public models: lines of two to three pixels")
            .range(1.0, f64::from(LARGEST_RADIUS), 0),
            Setting::field(
                "valley-share",
                "SHARE",
                "Largest share of darker pixels around a valley, 0 to 1; more draws wider lines",
                |style: &mut Self| &mut style.darker_share,
            )
            .ours("a thin line of darker pixels across the disc is less")
            .range(0.0, 0.5, 2),
            Setting::field(
                "valley-depth",
                "COSINE",
                "Least difference between a valley and the brightest pixel around it; more leaves out shallow valleys",
                |style: &mut Self| &mut style.least_depth,
            )
            .ours("chosen by eye on public models")
            .range(0.0, 1.0, 2),
        ];
        under(ALL_STYLES, common)
            .chain(within(Tones::settings(), |style: &mut Self| Some(&mut style.tones)))
            .chain(under(SUGGESTIVE, own))
            .collect()
    }

    /// Shades, tones, valleys on top.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.check(show)?;
        let sampling = if show == Show::Map { Supersample::One } else { self.supersample };
        let mut passes = Vec::new();
        if show == Show::Map || (self.is_inked && show != Show::Tones) {
            passes.push(self.shade_pass(scene, show != Show::Map));
        }
        if matches!(show, Show::Final | Show::Tones) {
            let toned = Ink { tones: self.tones.clone(), cull_back_faces: self.cull_back_faces, ..Ink::default() };
            passes.push(toned.tone_pass(scene));
        }
        if self.is_inked && matches!(show, Show::Final | Show::Borders) {
            let blank = if scene.background == Background::Transparent { [0.0; 4] } else { [1.0; 4] };
            let ground = (show == Show::Borders).then(|| Step::clear(blank));
            let valleys = Step::Draw(self.valleys(scene, sampling));
            passes.push(Pass::new("valleys", ground.into_iter().chain([valleys]).collect()));
        }
        let tables = if show == Show::Borders { Vec::new() } else { self.tones.tables() };
        let plan = Plan { tables, ..Plan::new(passes) };
        Ok(sampling.finish(plan, scene.size))
    }

    fn check(&self, show: Show) -> Result<()> {
        if !matches!(show, Show::Final | Show::Tones | Show::Borders | Show::Map) {
            let problem = "the style suggestive has final, tones, borders and map; show one of these";
            return Err(Error::setting("show", problem));
        }
        if !self.is_inked && matches!(show, Show::Borders | Show::Map) {
            return Err(Error::setting("show", "--no-borders leaves no ink to show; leave out one of the two"));
        }
        if !(1..=LARGEST_RADIUS).contains(&self.radius_px) {
            let problem = format!("the radius is 1 to {LARGEST_RADIUS} pixels");
            return Err(Error::value("valley-radius", self.radius_px, problem));
        }
        if !(self.darker_share > 0.0 && self.darker_share < 1.0) {
            return Err(Error::value("valley-share", self.darker_share, "the share is above 0 and below 1"));
        }
        if !(0.0..=1.0).contains(&self.least_depth) {
            let problem = "the depth is the difference of two cosines, from 0 to 1";
            return Err(Error::value("valley-depth", self.least_depth, problem));
        }
        self.tones.check()
    }

    /// Draws each pixel's cosine between normal and view.
    fn shade_pass(&self, scene: &Scene, is_read: bool) -> Pass {
        let program = Program { vertex: "dietrich/dietrich.vert", fragments: vec!["improved/facing.frag"] };
        let objects = Draw {
            cull_back_faces: self.cull_back_faces,
            culls_doubled_faces: has_doubled_faces(scene),
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(Paint::Materials), Some(program))
        };
        // The ground has full brightness and is not marked as surface.
        let mut steps = vec![Step::clear([1.0, 1.0, 0.0, 0.0]), Step::Draw(objects)];
        if is_read {
            steps.push(Step::CopyFramebuffer);
        }
        Pass::new("map", steps)
    }

    /// The filter over the whole picture.
    fn valleys(&self, scene: &Scene, sampling: Supersample) -> Draw {
        let float = |name, value: f32| Uniform { name, value: Value::Float(value) };
        let radius = self.radius_px * sampling.factor();
        let program = Program { vertex: "evangelista/border.vert", fragments: vec!["improved/valleys.frag"] };
        Draw {
            uniforms: vec![
                supersample::texture_unit(sampling.surface(scene.size)),
                float("radius", radius as f32),
                float("darkerShare", self.darker_share),
                float("leastDepth", self.least_depth),
            ],
            textures: vec![("facingMap", Texture::BorderMap)],
            depth: Depth::Ignore,
            facts: Facts {
                reach_px: Some(radius + 1),
                // It discards pixels without ink.
                keeps_pixels: false,
                where_even: Some(WhereEven::Unchanged),
                ..Facts::plain()
            },
            ..Draw::new(Geometry::ScreenSquare, Some(program))
        }
    }
}
