//! `mrt`: the three passes' picture with one pass over the geometry, which draws tones and map into two targets at once.
//!
//! The future work of Evangelista et al. 2005 (section 6). The border is blended over the tones' texture, as in the third pass,
//! and that texture is read back without a copy. The background needs no square: each texture is cleared to the value the square
//! would leave.

use super::cartoon::background_square;
use super::map::MAP_TEXTURE;
use super::{ALL_STYLES, Border, CARTOON, Cartoon, MapEncoding, MapTarget, Show, Supersample, Tones, cull, no_borders};
use crate::error::{Error, Result};
use crate::plan::{
    Attachment, Attachments, Draw, Facts, Format, Geometry, Paint, Pass, Plan, Program, SettingValue, Step, Target,
    Texture, TextureName,
};
use crate::scene::Scene;
use crate::settings::{Kind, Setting, Value as _, under, within};

/// Settings of `mrt`; the defaults are those of the three passes.
#[derive(Debug, Clone, PartialEq)]
pub struct Mrt {
    /// The tones.
    pub tones: Tones,
    /// The border; `None` draws the tones alone.
    pub border: Option<Border>,
    /// Whether the map's background holds the value of the article's square, a normal towards the eye. Default yes. Without it
    /// outer borders are fainter at grazing angles.
    pub background_square: bool,
    /// Whether to skip faces turned away from the eye: faster. The picture of closed models changes only in a few pixels at
    /// outlines. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge and makes
    /// lines finer.
    pub supersample: Supersample,
}

impl Default for Mrt {
    fn default() -> Self {
        Self {
            tones: Tones::default(),
            border: Some(Border::default()),
            background_square: true,
            cull_back_faces: false,
            supersample: Supersample::One,
        }
    }
}

impl Mrt {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            no_borders(
                |mrt: &Self| mrt.border.is_none(),
                |mrt, is_without| mrt.border = (!is_without).then(|| mrt.border.unwrap_or_default()),
            ),
            cull(|mrt: &mut Self| &mut mrt.cull_back_faces),
            Supersample::setting(|mrt: &mut Self| &mut mrt.supersample),
        ];
        // For callers that draw both: the three passes have more encodings.
        let encoding = Setting::of(
            "map-encoding",
            "ENCODING",
            Kind::Choice(vec!["paper"]),
            MapEncoding::HELP,
            |_: &Self| MapEncoding::Published.text(),
            |_, text| match MapEncoding::parse(text)? {
                MapEncoding::Published => Ok(()),
                _ => Err(Error::setting(
                    "map-encoding",
                    "style mrt keeps its map as published; leave it out, or draw --style three-pass",
                )
                .into()),
            },
        );
        let map = vec![background_square(|mrt: &mut Self| &mut mrt.background_square), encoding];
        under(ALL_STYLES, common)
            .chain(within(Tones::settings(), |mrt: &mut Self| Some(&mut mrt.tones)))
            .chain(within(Border::settings(), |mrt: &mut Self| mrt.border.as_mut()))
            .chain(under(CARTOON, map))
            .collect()
    }
}

/// The picture before and after its borders.
const TONES: Attachment = Attachment { name: TextureName("Tones"), format: Format::Unorm8 };
const MAP: Attachment = Attachment { name: MAP_TEXTURE, format: Format::Unorm8 };

const TONES_AND_MAP: Attachments = Attachments {
    colors: &[TONES, MAP],
    has_depth: true,
    asked_by: SettingValue { setting: "style", value: "mrt" },
    instead: SettingValue { setting: "style", value: "three-pass" },
    instead_draws: Some("the same picture except for rounding"),
};

/// The target that the border is blended over while it reads the map.
const TONES_ALONE: Attachments = Attachments { colors: &[TONES], has_depth: false, ..TONES_AND_MAP };

impl Mrt {
    /// Tones and map, with the border blended on top.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        let cartoon = self.cartoon();
        // Textures are multiplied with the tones alone, while here tones and map are drawn at once.
        let at_once = show == Show::Final && !scene.has_textured_surfaces();
        let Some(border) = self.border.filter(|_| at_once) else {
            // The three passes draw its map, tones and borders when shown alone.
            return cartoon.three_pass(scene, show);
        };
        cartoon.check(scene, show)?;
        let surface = self.supersample.surface(scene.size);
        let map = vec![("borderMap", Texture::Drawn(MAP_TEXTURE))];
        let squares = border.squares(scene, surface, MapEncoding::Published, &map);
        let over_tones = |(name, square)| Pass {
            target: Target::Textures(&TONES_ALONE),
            ..Pass::new(name, vec![Step::Draw(square)])
        };
        let mut passes = vec![self.geometry_pass(scene)];
        passes.extend(squares.into_iter().map(over_tones));
        let plan = Plan { tables: self.tones.tables(), ..Plan::new(passes) };
        Ok(self.supersample.finish(plan, scene.size))
    }

    /// Returns the three passes with the same settings.
    fn cartoon(&self) -> Cartoon {
        Cartoon {
            tones: self.tones.clone(),
            border: self.border,
            background_square: self.background_square,
            cull_back_faces: self.cull_back_faces,
            map_encoding: MapEncoding::Published,
            map_target: MapTarget::Copy,
            supersample: self.supersample,
        }
    }

    /// Both of the article's geometry passes at once.
    fn geometry_pass(&self, scene: &Scene) -> Pass {
        let published = self.tones.are_published();
        let fragments = match published {
            true => vec!["improved/two-targets.frag"],
            false => vec!["improved/two-targets-settings.frag", self.tones.shader()],
        };
        let program = Program::new("improved/two-targets.vert", fragments);
        let objects = Draw {
            uniforms: if published { Vec::new() } else { self.tones.uniforms(false) },
            textures: if published { Vec::new() } else { self.tones.textures() },
            cull_back_faces: self.cull_back_faces,
            facts: Facts { shorter: self.tones.shorter(&program), ..Facts::plain() },
            ..Draw::new(Geometry::Objects(Paint::Materials), Some(program))
        };
        let encoding = MapEncoding::Published;
        let map = if self.background_square { encoding.background() } else { encoding.empty() };
        let colors = vec![scene.background.clear_color(), map];
        let steps = vec![Step::ClearEach { colors }, Step::Draw(objects)];
        Pass { target: Target::Textures(&TONES_AND_MAP), ..Pass::new("tones-and-map", steps) }
    }
}
