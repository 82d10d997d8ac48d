//! The styles: settings with the papers' values as defaults, and the plan each makes of a scene. No GL here.
//!
//! | style | source |
//! |---|---|
//! | `phong` | the realistic rendering the first paper compares with |
//! | `three-pass` | Evangelista et al. 2005, appendix 1 |
//! | `two-pass` | Evangelista et al. 2005, section 4.2 and appendix 2 |
//! | `mrt` | its future work, section 6: the three passes' picture with one pass over the geometry |
//! | `inking` | Dachsbacher, edge list and painting |
//! | `dietrich` | the hardware's outline that Dachsbacher names as the alternative |
//! | `ink` | of this project: Evangelista's passes with a map and a filter that answer to geometry |
//! | `charcoal` | Valente 2007 |
//! | `sand` | Valente 2007, section 4 |
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use std::sync::Arc;
//! use tinta::styles::{Cartoon, Tones};
//! use tinta::{LoadOptions, Scene, SceneSettings, Show, Style, load};
//!
//! let mesh = load("builtin:bust", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let cartoon = Cartoon { tones: Tones { count: 2, ..Tones::default() }, ..Cartoon::default() };
//! let plan = Style::ThreePass(cartoon.clone()).plan(&scene, Show::Final)?;
//! assert_eq!(plan.passes.len(), 3);
//! // Nonsense is refused by the option's name.
//! let wrong = Cartoon { tones: Tones { count: 4, ..Tones::default() }, ..cartoon };
//! assert!(Style::ThreePass(wrong).plan(&scene, Show::Final).is_err());
//! # Ok(())
//! # }
//! ```

mod border;
mod cartoon;
mod charcoal;
mod dietrich;
mod ink;
mod inking;
mod lens;
mod map;
mod mrt;
mod phong;
mod ramp;
mod supersample;
mod tones;

pub use border::{Border, Filter};
pub use cartoon::Cartoon;
pub use charcoal::{
    CetCoordinate, CetFilter, Charcoal, CharcoalPictures, ContrastOperator, Improvements, Noise, Paper, Recipe,
};
pub use dietrich::Dietrich;
pub use ink::{Ink, Quality};
pub use inking::{ClassColors, Inking, LightOn, PaintMode};
pub use map::{MapEncoding, MapTarget};
pub use mrt::Mrt;
pub use phong::Phong;
pub use ramp::{Ramp, RampRow};
pub use supersample::Supersample;
pub use tones::{ToneLookup, Tones};

use crate::error::Result;
use crate::names::find;
use crate::plan::Plan;
use crate::scene::Scene;
use serde::Serialize;
use std::str::FromStr;

/// A style with its settings.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "name", rename_all = "kebab-case")]
pub enum Style {
    /// Smooth shading per pixel.
    Phong(Phong),
    /// Map, tones, border blended on top.
    ThreePass(Cartoon),
    /// Map, then tones and border in one.
    TwoPass(Cartoon),
    /// Map and tones at once, border blended on top.
    Mrt(Mrt),
    /// Painted faces, lines from the edge list.
    Inking(Inking),
    /// Ink where the surface is seen at a grazing angle.
    Dietrich(Dietrich),
    /// Ink where the surface ends or turns, found by its planes.
    Ink(Ink),
    /// Grain by tone, on paper.
    Charcoal(Charcoal),
    /// The same mixed with the model's own texture in sepia.
    Sand(Charcoal),
}

/// Which of a style's pictures is wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Show {
    /// The finished picture.
    #[default]
    Final,
    /// The normal map: red, green, blue of the map (figure 9, left).
    Normals,
    /// The depth map: alpha of the map as grey, near is dark (figure 9, right).
    Depth,
    /// The map itself, four channels.
    Map,
    /// The borders alone (figure 12).
    Borders,
    /// The tones alone (figure 5).
    Tones,
    /// The light of a charcoal drawing (Valente 2007, figure 4, left).
    Diffuse,
    /// The contrast-enhanced model (figure 4, right).
    Cem,
    /// The contrast-enhanced texture where the model reads it.
    Cet,
    /// The paper alone.
    Paper,
}

impl Style {
    /// The style of this name with the paper's settings.
    pub fn named(name: StyleName) -> Self {
        match name {
            StyleName::Phong => Self::Phong(Phong::default()),
            StyleName::ThreePass => Self::ThreePass(Cartoon::default()),
            StyleName::TwoPass => Self::TwoPass(Cartoon::default()),
            StyleName::Mrt => Self::Mrt(Mrt::default()),
            StyleName::Inking => Self::Inking(Inking::default()),
            StyleName::Dietrich => Self::Dietrich(Dietrich::default()),
            StyleName::Ink => Self::Ink(Ink::default()),
            StyleName::Charcoal => Self::Charcoal(Charcoal::default()),
            StyleName::Sand => Self::Sand(Charcoal::default()),
        }
    }

    /// The style's name as the user writes it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Phong(_) => "phong",
            Self::ThreePass(_) => "three-pass",
            Self::TwoPass(_) => "two-pass",
            Self::Mrt(_) => "mrt",
            Self::Inking(_) => "inking",
            Self::Dietrich(_) => "dietrich",
            Self::Ink(_) => "ink",
            Self::Charcoal(_) => "charcoal",
            Self::Sand(_) => "sand",
        }
    }

    /// Whether it draws lines that can be shown by themselves.
    pub fn has_lines(&self) -> bool {
        match self {
            Self::ThreePass(cartoon) | Self::TwoPass(cartoon) => cartoon.border.is_some(),
            Self::Mrt(mrt) => mrt.border.is_some(),
            Self::Inking(inking) => inking.is_inked,
            Self::Ink(ink) => ink.is_inked,
            Self::Dietrich(_) => true,
            Self::Phong(_) | Self::Charcoal(_) | Self::Sand(_) => false,
        }
    }

    /// Whether its tones can be shown by themselves.
    pub fn has_tones(&self) -> bool {
        match self {
            Self::ThreePass(_) | Self::TwoPass(_) | Self::Mrt(_) => true,
            Self::Inking(_) | Self::Dietrich(_) | Self::Ink(_) => true,
            Self::Phong(_) | Self::Charcoal(_) | Self::Sand(_) => false,
        }
    }

    /// What GL has to do for this scene.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] when a setting is nonsense, by itself or with this scene or `show`.
    pub fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        match self {
            Self::Phong(phong) => phong.plan(scene, show),
            Self::ThreePass(cartoon) => cartoon.three_pass(scene, show),
            Self::TwoPass(cartoon) => cartoon.two_pass(scene, show),
            Self::Mrt(mrt) => mrt.plan(scene, show),
            Self::Inking(inking) => inking.plan(scene, show),
            Self::Dietrich(dietrich) => dietrich.plan(scene, show),
            Self::Ink(ink) => ink.plan(scene, show),
            Self::Charcoal(charcoal) => charcoal.charcoal(scene, show),
            Self::Sand(charcoal) => charcoal.sand(scene, show),
        }
    }
}

/// The styles' names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StyleName {
    /// `phong`
    Phong,
    /// `three-pass`
    ThreePass,
    /// `two-pass`
    TwoPass,
    /// `mrt`
    Mrt,
    /// `inking`
    Inking,
    /// `dietrich`
    Dietrich,
    /// `ink`
    Ink,
    /// `charcoal`
    Charcoal,
    /// `sand`
    Sand,
}

impl StyleName {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 9] = [
        ("phong", Self::Phong),
        ("three-pass", Self::ThreePass),
        ("two-pass", Self::TwoPass),
        ("mrt", Self::Mrt),
        ("inking", Self::Inking),
        ("dietrich", Self::Dietrich),
        ("ink", Self::Ink),
        ("charcoal", Self::Charcoal),
        ("sand", Self::Sand),
    ];
}

impl StyleName {
    /// As the user writes it.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].0
    }
}

impl FromStr for StyleName {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}

impl Show {
    /// Whether only charcoal and sand draw this picture.
    fn is_of_charcoal(self) -> bool {
        matches!(self, Self::Diffuse | Self::Cem | Self::Cet | Self::Paper)
    }

    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 10] = [
        ("final", Self::Final),
        ("normals", Self::Normals),
        ("depth", Self::Depth),
        ("map", Self::Map),
        ("borders", Self::Borders),
        ("tones", Self::Tones),
        ("diffuse", Self::Diffuse),
        ("cem", Self::Cem),
        ("cet", Self::Cet),
        ("paper", Self::Paper),
    ];
}

impl FromStr for Show {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::plan::Step;
    use crate::scene::{Background, Color, SceneSettings};
    use std::sync::Arc;

    fn scene(background: Background) -> Scene {
        let settings = SceneSettings { background, ..SceneSettings::default() };
        Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap()
    }

    fn plan(style: &Style, show: Show) -> Plan {
        style.plan(&scene(Background::Color(Color([1.0; 3]))), show).unwrap()
    }

    fn shaders(plan: &Plan) -> Vec<String> {
        let draws = plan.steps().filter_map(|(_, step)| if let Step::Draw(draw) = step { Some(draw) } else { None });
        draws.map(|draw| draw.program.as_ref().unwrap().fragments.join("+").replace("evangelista/", "")).collect()
    }

    #[test]
    fn three_passes_are_the_papers_diagram() {
        let text = plan(&Style::named(StyleName::ThreePass), Show::Final).to_string();
        let expected = "\
pass 1: map
  clear to (0, 0, 0, 1), depth to 1
  draw the background square in (1, 1, 1, 1) with evangelista/map.vert + evangelista/map.frag, no depth test
  draw the objects with evangelista/map.vert + evangelista/map.frag
  copy the framebuffer into the texture BorderMap
pass 2: tones
  clear to (1, 1, 1, 1), depth to 1
  draw the background square in (1, 1, 1, 1) with evangelista/toon.vert + evangelista/toon.frag, no depth test
  draw the objects with evangelista/toon.vert + evangelista/toon.frag
pass 3: border
  draw the screen square with evangelista/border.vert + evangelista/border.frag, textureUnit = (0.001953125, \
0.001953125), borderMap = BorderMap, no depth test, blended
picture: the framebuffer
";
        assert_eq!(text, expected);
    }

    #[test]
    fn two_passes_have_no_third_and_no_blending() {
        let plan = plan(&Style::named(StyleName::TwoPass), Show::Final);
        assert_eq!(plan.passes.iter().map(|pass| pass.name).collect::<Vec<_>>(), ["map", "tones-and-border"]);
        assert!(plan.steps().all(|(_, step)| !matches!(step, Step::Draw(draw) if draw.blend)));
    }

    #[test]
    fn any_setting_but_the_papers_runs_the_twin_with_uniforms() {
        let published = ["map.frag", "map.frag", "toon.frag", "toon.frag", "border.frag"];
        assert_eq!(shaders(&plan(&Style::named(StyleName::ThreePass), Show::Final)), published);
        let mut cartoon = Cartoon::default();
        cartoon.tones.count = 2;
        let toned = shaders(&plan(&Style::ThreePass(cartoon.clone()), Show::Final));
        assert_eq!(toned[3..], ["toon-settings.frag+tone-steps.frag", "border.frag"]);
        cartoon.border = Some(Border { filter: Filter::Sobel, ..Border::default() });
        let both = shaders(&plan(&Style::TwoPass(cartoon), Show::Final));
        assert_eq!(
            both[3],
            "two-pass-settings.frag+tone-steps.frag+filter-sobel.frag+tap-next.frag+texel-map.frag+depth-as-filtered.frag"
        );
    }

    #[test]
    fn a_plan_has_only_the_passes_its_picture_needs() {
        let passes = |style: &Style, show| plan(style, show).passes.iter().map(|pass| pass.name).collect::<Vec<_>>();
        let three = Style::named(StyleName::ThreePass);
        assert_eq!(passes(&three, Show::Tones), ["tones"]);
        assert_eq!(passes(&three, Show::Borders), ["map", "border"]);
        for show in [Show::Map, Show::Normals, Show::Depth] {
            assert_eq!(passes(&three, show), ["map"]);
            assert!(
                plan(&three, show).steps().all(|(_, step)| *step != Step::CopyFramebuffer),
                "nobody reads the copy"
            );
        }
        let without = Style::ThreePass(Cartoon { border: None, ..Cartoon::default() });
        assert_eq!(passes(&without, Show::Final), ["map", "tones"], "as published; pruning finds that nobody reads it");
    }

    #[test]
    fn tables_travel_only_with_plans_that_read_them() {
        let mut cartoon = Cartoon::default();
        cartoon.tones.lookup = ToneLookup::Texture;
        let style = Style::ThreePass(cartoon);
        assert_eq!(plan(&style, Show::Final).tables.len(), 1);
        assert!(plan(&style, Show::Borders).tables.is_empty());
    }

    #[test]
    fn nonsense_is_refused_by_the_options_name() {
        let refused = |change: &dyn Fn(&mut Cartoon)| {
            let mut cartoon = Cartoon::default();
            change(&mut cartoon);
            let scene = scene(Background::Transparent);
            Style::ThreePass(cartoon).plan(&scene, Show::Final).unwrap_err().to_string()
        };
        assert!(refused(&|cartoon| cartoon.tones.count = 4).starts_with("--tones 4"));
        assert!(refused(&|cartoon| cartoon.tones.levels[1] = 1.5).starts_with("--tone-levels"));
        assert!(refused(&|cartoon| cartoon.tones.diffuse_threshold = f32::NAN).starts_with("--tone-thresholds"));
        let infinite = Some(Border { detection_factor: f32::INFINITY, ..Border::default() });
        assert!(refused(&|cartoon| cartoon.border = infinite).starts_with("--detection-factor"));
    }
}
