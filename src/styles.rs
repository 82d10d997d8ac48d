//! The styles: settings with the published values as defaults, and the plan each makes of a scene. No GL here.
//!
//! Each style is a row of [`Style`]: its picture, source, name, settings, plan.
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

mod back_faces;
mod border;
mod cartoon;
mod charcoal;
mod coarse;
mod contents;
mod dietrich;
mod far_light;
mod flat_colors;
mod gradients;
mod headings;
mod ignored;
mod ink;
mod inking;
mod lens;
mod line_style;
mod line_width;
mod map;
mod mrt;
mod phong;
mod ramp;
mod row;
mod shading;
mod show;
mod supersample;
mod surfaces;
mod textured;
mod tones;

pub use crate::lines::ClassColors;
pub use back_faces::BackFaces;
pub use border::{Border, Filter};
pub use cartoon::Cartoon;
pub use charcoal::{
    CetCoordinate, CetFilter, Charcoal, CharcoalPictures, CharcoalRecipe, ContrastOperator, Improvements, Noise,
    TextureSource,
};
pub use coarse::coarse;
pub use contents::{Below, Contents, ViewAreas};
pub use dietrich::Dietrich;
pub use far_light::FarLight;
pub use ignored::{is_ignored, is_of_lines_alone};
pub(crate) use ignored::{is_of_exact_lines, is_of_vectors};
pub use ink::{Ink, Quality};
pub use inking::{Inking, LightOn, PaintMode};
pub use line_style::LineStyle;
pub use line_width::LineWidth;
pub use map::{MapEncoding, MapTarget};
pub use mrt::Mrt;
pub use phong::Phong;
pub use ramp::{Ramp, RampRow};
pub use row::{Mark, Origin, Outline, StyleInfo};
pub use show::Show;
pub use supersample::Supersample;
pub use tones::{ToneLookup, Tones};

use crate::choice::Choice;
use crate::error::{Error, ParseError, Result};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::settings::{HasSettings, OptionValue, Options, Setting, Table, within};
use headings::{ALL_STYLES, CARTOON, CHARCOAL, HEADINGS, IMAGE_SPACE, INK, INKING, cull, no_borders};
use row::Draw;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::f64::consts::PI;
use std::sync::LazyLock;

row::styles! {
    /// Smooth shading per pixel: the realistic rendering the first article compares with.
    Phong(Phong) {
        name: "phong",
        draw: Draw::Plan(Phong::plan),
        has_lines: |_| false,
        shows: &[Show::Final],
        origin: Origin::Named,
        mark: Some(Mark { rgb: [128, 128, 128], outline: Outline::Circle }),
    }

    /// Map, tones, border blended on top: Evangelista et al. 2005, appendix 1.
    ThreePass(Cartoon) {
        name: "three-pass",
        draw: Draw::Plan(Cartoon::three_pass),
        has_lines: |cartoon| cartoon.border.is_some(),
        shows: CARTOON_SHOWS,
        origin: Origin::Published(2005),
        mark: Some(Mark { rgb: [31, 131, 201], outline: Outline::Polygon { corners: 4, turn: PI / 4.0 } }),
    }

    /// Map, then tones and border in one: Evangelista et al. 2005, section 4.2 and appendix 2.
    TwoPass(Cartoon) {
        name: "two-pass",
        draw: Draw::Plan(Cartoon::two_pass),
        has_lines: |cartoon| cartoon.border.is_some(),
        shows: CARTOON_SHOWS,
        origin: Origin::Published(2005),
        mark: Some(Mark { rgb: [213, 94, 0], outline: Outline::Polygon { corners: 3, turn: 0.0 } }),
    }

    /// Map and tones at once, border blended on top: that article's future work, section 6, the three passes' picture with one
    /// pass over the geometry.
    Mrt(Mrt) {
        name: "mrt",
        draw: Draw::Plan(Mrt::plan),
        has_lines: |mrt| mrt.0.border.is_some(),
        shows: CARTOON_SHOWS,
        origin: Origin::Own,
        mark: Some(Mark { rgb: [86, 180, 233], outline: Outline::Polygon { corners: 5, turn: PI } }),
    }

    /// Painted faces, lines from the edge list: Dachsbacher, edge list and painting.
    Inking(Inking) {
        name: "inking",
        draw: Draw::Plan(Inking::plan),
        has_lines: |inking| inking.is_inked,
        shows: LINE_SHOWS,
        origin: Origin::Published(2001),
        mark: Some(Mark { rgb: [0, 158, 115], outline: Outline::Polygon { corners: 4, turn: 0.0 } }),
    }

    /// Ink where the surface is seen at a grazing angle: the hardware's outline that Dachsbacher names as the alternative.
    Dietrich(Dietrich) {
        name: "dietrich",
        draw: Draw::Plan(Dietrich::plan),
        has_lines: |_| true,
        shows: LINE_SHOWS,
        origin: Origin::Named,
        mark: Some(Mark { rgb: [204, 121, 167], outline: Outline::Polygon { corners: 3, turn: PI } }),
    }

    /// Ink where the surface ends or turns, found by its planes: Evangelista's passes with a map and a filter that answer to
    /// geometry.
    Ink(Ink) {
        name: "ink",
        draw: Draw::Plan(Ink::plan),
        has_lines: |ink| ink.is_inked,
        shows: &[Show::Final, Show::Map, Show::Borders, Show::Tones],
        origin: Origin::Own,
        mark: Some(Mark { rgb: [200, 50, 80], outline: Outline::Polygon { corners: 3, turn: -PI / 2.0 } }),
    }

    /// Grain by tone, on paper: Valente 2007.
    Charcoal(Charcoal) {
        name: "charcoal",
        draw: Draw::Plan(Charcoal::charcoal),
        has_lines: |_| false,
        shows: CHARCOAL_SHOWS,
        origin: Origin::Published(2007),
        mark: Some(Mark { rgb: [140, 109, 90], outline: Outline::Polygon { corners: 5, turn: 0.0 } }),
    }

    /// The same mixed with the model's own texture in sepia: Valente 2007, section 4.
    Sand(Charcoal) {
        name: "sand",
        draw: Draw::Plan(Charcoal::sand),
        has_lines: |_| false,
        shows: CHARCOAL_SHOWS,
        origin: Origin::Published(2007),
        mark: Some(Mark { rgb: [184, 137, 11], outline: Outline::Polygon { corners: 6, turn: 0.0 } }),
    }

    /// Tones with the rims of thick lines around the faces turned away: the outline by two passes that Evangelista et al. name
    /// beside their filter.
    BackFaces(BackFaces) {
        name: "back-faces",
        draw: Draw::Plan(BackFaces::plan),
        has_lines: |back_faces| back_faces.line_width > 0.0,
        shows: LINE_SHOWS,
        origin: Origin::Named,
        mark: Some(Mark { rgb: [230, 159, 0], outline: Outline::Polygon { corners: 3, turn: PI / 2.0 } }),
    }

    // A new style's row comes here: docs/dev/adding-a-style.md.

    /// Exact visible lines, without OpenGL.
    Lines(LineStyle) {
        name: "lines",
        draw: Draw::Lines(LineStyle::clone),
        has_lines: |_| false,
        shows: &[Show::Final],
        origin: Origin::Own,
        mark: Some(Mark { rgb: [123, 92, 214], outline: Outline::Star }),
    }
}

/// Pictures of the styles that filter a map.
const CARTOON_SHOWS: &[Show] = &[Show::Final, Show::Map, Show::Normals, Show::Depth, Show::Borders, Show::Tones];

/// Pictures of the styles with lines from edges or grazing views.
const LINE_SHOWS: &[Show] = &[Show::Final, Show::Borders, Show::Tones];

/// Pictures of the drawings in charcoal and sand.
const CHARCOAL_SHOWS: &[Show] = &[Show::Final, Show::Diffuse, Show::Cem, Show::Cet, Show::Paper];

impl Default for Style {
    fn default() -> Self {
        Self::named(StyleName::ThreePass)
    }
}

impl Style {
    /// Returns the style of this name with the published settings.
    #[must_use]
    pub fn named(name: StyleName) -> Self {
        (name.info().published)()
    }

    /// Returns the style's name as the user writes it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.style_name().name()
    }

    /// Returns the style that the options name, by default three-pass, with the settings they give. Options of other styles, or
    /// of no style, are ignored, as on the command line.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] for an unknown style or value, [`crate::Error::File`] for a file that cannot be read.
    pub fn from_options(options: &Options) -> Result<Self> {
        let name = match options.get("style") {
            None => StyleName::ThreePass,
            Some(OptionValue::Text(name)) => {
                name.parse().map_err(|ParseError(problem)| Error::value("style", name, problem))?
            }
            Some(_) => {
                return Err(Error::setting("style", "this takes one value (STYLE), not true, false or several"));
            }
        };
        Self::with_options(name, options)
    }

    /// Returns the style of this name with the settings that the options give; a style among the options is ignored.
    ///
    /// # Errors
    ///
    /// Those of [`Style::from_options`].
    pub fn with_options(name: StyleName, options: &Options) -> Result<Self> {
        let mut style = Self::named(name);
        Self::table().apply(&mut style, options)?;
        Ok(style)
    }

    /// The style without the borders that it can leave out.
    ///
    /// # Errors
    ///
    /// Those of the settings.
    pub(crate) fn without_borders(&self) -> Result<Self> {
        let mut style = self.clone();
        let without = Options::from([("no-borders".to_owned(), OptionValue::Switch(true))]);
        Self::table().apply(&mut style, &without).map(|()| style)
    }

    /// Returns the options that make this style with these settings: its name, and every setting that differs from the default.
    /// One option alone is the published style.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] for settings that text cannot express, such as a file name outside Unicode or an empty set of line
    /// classes.
    pub fn to_options(&self) -> Result<Options> {
        let mut options = Self::table().options(self, &Self::named(self.style_name()))?;
        options.insert("style".to_owned(), OptionValue::text(self.name()));
        Ok(options)
    }

    /// Returns remarks on this scene's pictures in this style, a sentence each.
    pub fn remarks(&self, scene: &Scene) -> Vec<String> {
        let mut remarks = match self {
            // This style needs the edges in any case.
            Self::Inking(_) => scene.crack_remarks(),
            _ => Vec::new(),
        };
        remarks.extend(surfaces::of_doubled_faces(self, scene));
        remarks.extend(surfaces::of_averaged_normals(scene));
        if self.leaves_textures_out(scene) {
            let remark = "the model's textures or colours at vertices are not drawn; --surface textured draws them";
            remarks.push(remark.to_owned());
        }
        remarks
    }

    /// A remark on curves and points of the scene that this style does not draw.
    pub(crate) fn curves_remark(&self, scene: &Scene) -> Option<String> {
        let draws_curves = matches!(self, Self::Inking(_));
        let has_own = !draws_curves && scene.objects.iter().any(|object| object.mesh.curves.has_own());
        let remark =
            "the model's own curves and points are not drawn; --style lines draws them, and inking beside faces";
        has_own.then(|| remark.to_owned())
    }

    /// Whether the scene has textures that this style could draw but does not.
    fn leaves_textures_out(&self, scene: &Scene) -> bool {
        let draws_own = matches!(self, Self::Inking(inking) if inking.has_texture || inking.paint == PaintMode::None);
        let brings = |object: &crate::scene::Object| {
            !object.mesh.position_colors.is_empty() || object.mesh.materials.iter().any(|it| it.has_texture())
        };
        let is_free = scene.surface == crate::scene::Surface::Plain && !scene.recolor;
        let has_none = matches!(self.style_name(), StyleName::Dietrich | StyleName::Sand);
        is_free && !draws_own && !has_none && scene.objects.iter().any(brings)
    }

    /// Whether the style can show its tones alone.
    pub fn has_tones(&self) -> bool {
        self.style_name().info().shows.contains(&Show::Tones)
    }
}

impl HasSettings for Style {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<Style>> = LazyLock::new(|| Table {
            settings: settings(),
            defaults: StyleName::ALL.map(|(_, name)| Style::named(name)).into(),
        });
        &TABLE
    }
}

/// Its name, and each setting under its own name.
impl Serialize for Style {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let settings = Self::table().record(self);
        let mut map = serializer.serialize_map(Some(settings.len() + 1))?;
        map.serialize_entry("name", self.name())?;
        settings.iter().try_for_each(|(name, value)| map.serialize_entry(name, value))?;
        map.end()
    }
}

/// Returns the settings of all styles, each declared beside its struct. Within a heading, styles with lines come first.
pub(crate) fn settings() -> Vec<Setting<Style>> {
    let mut settings: Vec<Setting<Style>> =
        StyleName::lines_first().into_iter().flat_map(|style| (style.info().settings)()).collect();
    let rank = |heading: &str| HEADINGS.iter().position(|known| *known == heading).unwrap_or(HEADINGS.len());
    settings.sort_by_key(|setting| rank(setting.heading));
    settings
}

/// Returns the error that a style of exact lines has no plan.
fn no_passes(style: &str) -> Error {
    Error::value("style", style, "it draws exact lines and has no passes; choose another style")
}

impl StyleName {
    /// Returns all names, separated by commas.
    pub(crate) fn list() -> String {
        Self::ALL.map(|(name, _)| name).join(", ")
    }

    /// Returns the names of styles that draw lines, separated by commas.
    pub fn list_with_lines() -> String {
        let with_lines = STYLES.iter().filter(|info| info.style.has_lines());
        with_lines.map(|info| info.name).collect::<Vec<_>>().join(", ")
    }

    /// Returns all styles, those that draw lines first.
    pub fn lines_first() -> [Self; Self::ALL.len()] {
        let mut styles = Self::ALL.map(|(_, style)| style);
        styles.sort_by_key(|style| !style.has_lines());
        styles
    }

    /// Returns the styles that OpenGL draws in passes, by the user's names.
    pub fn of_passes() -> impl Iterator<Item = (&'static str, Self)> + Clone {
        Self::ALL.into_iter().filter(|(_, style)| !style.draws_lines())
    }

    /// Whether it draws exact lines, without OpenGL.
    pub fn draws_lines(self) -> bool {
        self.info().draws_lines
    }

    /// Its row.
    pub fn info(self) -> &'static StyleInfo {
        &STYLES[self as usize]
    }

    /// Returns the name as the user writes it.
    pub fn name(self) -> &'static str {
        self.info().name
    }

    /// Whether the style draws lines that it can show alone, as published.
    pub fn has_lines(self) -> bool {
        self.info().shows.contains(&Show::Borders)
    }
}

impl Show {
    /// Returns the option that shows this picture; empty for the finished one.
    pub fn to_options(self) -> Options {
        let shown = (self != Self::Final).then(|| ("show".to_owned(), OptionValue::text(self.choice_name())));
        shown.into_iter().collect()
    }
}

#[cfg(test)]
mod settings_tests;

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
        assert!(
            plan.steps().all(|(_, step)| !matches!(step, Step::Draw(draw) if draw.blend == crate::plan::Blend::Over))
        );
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
    fn a_filter_of_two_programs_is_two_blended_passes_and_no_part_of_a_joint_one() {
        let border = Some(Border { filter: Filter::MitchellTwo, ..Border::default() });
        let cartoon = Cartoon { border, ..Cartoon::default() };
        let (two, mrt) = (Style::TwoPass(cartoon.clone()), Style::Mrt(Mrt(cartoon.clone())));
        let whole = plan(&Style::ThreePass(cartoon), Show::Final);
        assert_eq!(
            whole.passes.iter().map(|pass| pass.name).collect::<Vec<_>>(),
            ["map", "tones", "border-normals", "border-depth"]
        );
        assert_eq!(
            whole
                .steps()
                .filter(|(_, step)| matches!(step, Step::Draw(draw) if draw.blend == crate::plan::Blend::Over))
                .count(),
            2
        );
        assert_eq!(plan(&mrt, Show::Final).passes.len(), 3);
        let refused = two.plan(&scene(Background::Color(Color([1.0; 3]))), Show::Final).unwrap_err().to_string();
        assert!(refused.starts_with("filter mitchell-two: its two programs are blended"), "{refused}");
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
        assert!(refused(&|cartoon| cartoon.tones.count = 4).starts_with("tones 4"));
        assert!(refused(&|cartoon| cartoon.tones.levels[1] = 1.5).starts_with("tone-levels"));
        assert!(refused(&|cartoon| cartoon.tones.diffuse_threshold = f32::NAN).starts_with("tone-thresholds"));
        let infinite = Some(Border { detection_factor: f32::INFINITY, ..Border::default() });
        assert!(refused(&|cartoon| cartoon.border = infinite).starts_with("detection-factor"));
    }
}
