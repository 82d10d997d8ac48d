//! `mrt`: the three passes' picture with one pass over the geometry, which draws tones and map into two targets at once.
//!
//! The future work of Evangelista et al. 2005 (section 6). The border is blended over the tones' texture, as in the third pass,
//! and that texture is read back without a copy. The background needs no square: each texture is cleared to the value the square
//! would leave.

use super::map::MAP_TEXTURE;
use super::{CARTOON, Cartoon, MapEncoding, MapTarget, Show};
use crate::error::{Error, Result};
use crate::plan::{
    Attachment, Attachments, Draw, Format, Pass, Plan, SettingValue, Step, Target, Texture, TextureName,
};
use crate::scene::Scene;
use crate::settings::{Kind, Setting, Value as _, within};

/// Settings of `mrt`, those of the three passes; how these store and pass on their map has no effect. Without
/// [`Cartoon::background_square`] outer borders are fainter at grazing angles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mrt(pub Cartoon);

impl Mrt {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        // For callers that draw both: the three passes have more encodings.
        let encoding = || {
            let mut setting = Setting::of(
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
            setting.heading = CARTOON;
            setting
        };
        within(Cartoon::settings(), |mrt: &mut Self| Some(&mut mrt.0))
            .filter(|setting| setting.name != "map-target")
            .map(|setting| if setting.name == "map-encoding" { encoding() } else { setting })
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
        let (map_encoding, map_target) = (MapEncoding::Published, MapTarget::Copy);
        let cartoon = Cartoon { map_encoding, map_target, ..self.0.clone() };
        // Textures are multiplied with the tones alone, while here tones and map are drawn at once.
        let at_once = show == Show::Final && !scene.has_textured_surfaces();
        let Some(border) = cartoon.border.filter(|_| at_once) else {
            // The three passes draw its map, tones and borders when shown alone.
            return cartoon.three_pass(scene, show);
        };
        cartoon.check(scene, show)?;
        let surface = cartoon.supersample.surface(scene.size);
        let map = vec![("borderMap", Texture::Drawn(MAP_TEXTURE))];
        let squares = border.squares(scene, surface, MapEncoding::Published, &map);
        let over_tones = |(name, square)| Pass {
            target: Target::Textures(&TONES_ALONE),
            ..Pass::new(name, vec![Step::Draw(square)])
        };
        let mut passes = vec![geometry_pass(&cartoon, scene)];
        passes.extend(squares.into_iter().map(over_tones));
        let plan = Plan { tables: cartoon.tones.tables(), ..Plan::new(passes) };
        Ok(cartoon.supersample.finish(plan, scene.size))
    }
}

/// Both of the article's geometry passes at once.
fn geometry_pass(cartoon: &Cartoon, scene: &Scene) -> Pass {
    let shaders = ["improved/two-targets.vert", "improved/two-targets.frag", "improved/two-targets-settings.frag"];
    let objects = Draw { cull_back_faces: cartoon.cull_back_faces, ..cartoon.tones.draw(shaders, false) };
    let encoding = MapEncoding::Published;
    let map = if cartoon.background_square { encoding.background() } else { encoding.empty() };
    let colors = vec![scene.background.clear_color(), map];
    let steps = vec![Step::ClearEach { colors }, Step::Draw(objects)];
    Pass { target: Target::Textures(&TONES_AND_MAP), ..Pass::new("tones-and-map", steps) }
}
