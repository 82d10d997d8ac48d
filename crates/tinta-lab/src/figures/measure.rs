//! The numbers of Evangelista et al. 2005, section 5, measured here: figure 13, the filter's gain, two passes without the
//! square, the shaders' throughput. Settings take turns, so that a busy moment hits all of them; reported are medians, and
//! every raw time is kept.

use super::mix::{Kit, Mix, TRIANGLES};
use super::reasons::{Host, reasons};
use super::throughput::{self, COMPARED_FACTOR, ShaderRow};
use serde::Serialize;
use std::sync::Arc;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, load};
use tinta::plan::Plan;
use tinta::renderer::{Renderer, median};
use tinta::scene::{Background, Scene, SceneSettings, Size};
use tinta::styles::{Border, Cartoon, Filter, Show, Style, Tones};

/// How much is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HowToMeasure {
    /// Picture size of the frames; throughput is measured on twice the width and height.
    pub size: Size,
    /// Frames of each setting.
    pub frames: usize,
    /// How many of the six scenes, smallest first.
    pub scenes: usize,
}

/// What the article's text prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Article {
    /// The card.
    pub device: &'static str,
    /// Picture size.
    pub size: Size,
    /// Triangles of the first and the last scene.
    pub triangles: [usize; 2],
    /// How much more frames a second the cheaper filter gives, percent.
    pub filter_gain_percent: f64,
    /// How much more frames a second two passes without the square give at most, percent.
    pub background_gain_percent: f64,
}

/// The article's numbers; those of the shaders are in [`super::SHADERS`].
pub const ARTICLE: Article = Article {
    device: "GeForce FX 5200, processor of 1 GHz",
    size: Size { width: 512, height: 512 },
    triangles: [3_039, 122_646],
    filter_gain_percent: 48.0,
    background_gain_percent: 100.0,
};

/// Everything measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Numbers {
    /// What drew.
    pub host: Host,
    /// Picture size of the frames.
    pub size: Size,
    /// A frame of nothing but a clear and the read-back.
    pub empty: Series,
    /// The scenes of figure 13.
    pub scenes: Vec<MixRow>,
    /// Their frames, scene by scene.
    pub frames: Vec<FrameRow>,
    /// The article's filter and the one it replaces.
    pub filters: Vec<FilterRow>,
    /// Two passes without the square, from near to far.
    pub backgrounds: Vec<BackgroundRow>,
    /// The shaders.
    pub shaders: Vec<ShaderRow>,
    /// What the article's text prints.
    #[serde(rename = "paper")]
    pub article: Article,
    /// Why ours differ, a few sentences for each number.
    pub reasons: Vec<Reason>,
}

/// A sentence about a measured number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// `frames`, `filter`, `background` or `throughput`.
    pub about: &'static str,
    /// It.
    pub sentence: String,
}

/// Measured frames.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// Their median, milliseconds.
    pub median_ms: f64,
    /// All of them, in the order measured.
    pub frames_ms: Vec<f64>,
}

impl Series {
    pub(super) fn new(frames_ms: Vec<f64>) -> Self {
        Self { median_ms: median(frames_ms.clone()).unwrap_or_default(), frames_ms }
    }

    /// Frames per second, by the median.
    pub fn frames_per_second(&self) -> f64 {
        1e3 / self.median_ms
    }
}

/// A scene of figure 13.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MixRow {
    /// What it is made of.
    #[serde(flatten)]
    pub mix: Mix,
    /// Share of the picture's pixels that its models cover, 0 to 1.
    pub covered: f64,
}

/// A curve's point of figure 13.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameRow {
    /// Triangles of its scene.
    pub triangles: usize,
    /// One to three.
    pub tones: u8,
    /// Two or three.
    pub passes: u8,
    /// Its frames.
    #[serde(flatten)]
    pub series: Series,
}

/// A filter in the first scene, three passes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FilterRow {
    /// Which.
    pub filter: Filter,
    /// Its frames.
    #[serde(flatten)]
    pub series: Series,
}

/// The bust from one distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BackgroundRow {
    /// The eye's distance, of that at which the bust fills the picture.
    pub distance: f64,
    /// Share of the picture's pixels that it covers, 0 to 1.
    pub covered: f64,
    /// Three passes with the square.
    pub three_pass: Series,
    /// Two passes with the square.
    pub two_pass: Series,
    /// Two passes without it.
    pub two_pass_without: Series,
}

impl BackgroundRow {
    /// How much more frames a second two passes without the square give than three passes, percent.
    pub fn gain_percent(&self) -> f64 {
        gain_percent(&self.two_pass_without, &self.three_pass)
    }
}

impl Numbers {
    /// How much more frames a second the article's filter gives than the one it replaces, percent.
    pub fn filter_gain_percent(&self) -> Option<f64> {
        let of = |filter| self.filters.iter().find(|row| row.filter == filter);
        Some(gain_percent(&of(Filter::Laplacian4)?.series, &of(Filter::Laplacian8)?.series))
    }

    /// The frames of these tones and passes, by triangles.
    pub fn curve(&self, tones: u8, passes: u8) -> impl Iterator<Item = &FrameRow> {
        self.frames.iter().filter(move |row| row.tones == tones && row.passes == passes)
    }
}

/// How much more frames a second `one` gives than `other`, percent: the median of the ratios within a turn, which a busy
/// moment's frames, slow for both, do not move.
pub(super) fn gain_percent(one: &Series, other: &Series) -> f64 {
    let ratios = other.frames_ms.iter().zip(&one.frames_ms).map(|(other, one)| other / one);
    (median(ratios.collect()).unwrap_or(1.0) - 1.0) * 100.0
}

/// A plan that takes its turns.
pub(super) struct Contestant {
    pub(super) scene: Arc<Scene>,
    pub(super) plan: Plan,
    pub(super) times: Vec<f64>,
}

impl Contestant {
    pub(super) fn new(scene: &Arc<Scene>, plan: Plan) -> Self {
        Self { scene: scene.clone(), plan, times: Vec::new() }
    }

    fn styled(scene: &Arc<Scene>, style: &Style) -> Result<Self> {
        Ok(Self::new(scene, style.plan(scene, Show::Final)?))
    }

    pub(super) fn series(&self) -> Series {
        Series::new(self.times.clone())
    }
}

/// Distances of the eye from the bust, of that at which it fills the picture.
const DISTANCES: [f64; 4] = [0.35, 0.6, 1.0, 3.0];

/// Tones and passes of figure 13.
const CURVES: [(u8, u8); 6] = [(1, 2), (1, 3), (2, 2), (2, 3), (3, 2), (3, 3)];

/// What [`measure`] has timed when it says so: a frame each of all that take turns, [`HowToMeasure::frames`] times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// Scenes.
    Scenes,
    /// Squares.
    Squares,
}

/// How many frames of how many triangles are drawn in a turn of [`Turn::Scenes`], about: figure 13's scenes are most of them.
pub fn triangles_a_turn(how: &HowToMeasure) -> usize {
    TRIANGLES.into_iter().take(how.scenes).sum::<usize>() * CURVES.len() * 2
}

/// Measures; `step` is told of each turn.
///
/// # Errors
///
/// As [`Renderer::draw`].
pub fn measure(renderer: &mut Renderer, how: &HowToMeasure, mut step: impl FnMut(Turn)) -> Result<Numbers> {
    let kit = Kit::new()?;
    let settings = SceneSettings { size: how.size, ..SceneSettings::default() };
    let mut scenes = Vec::new();
    let mut contestants = Vec::new();
    for wanted in TRIANGLES.into_iter().take(how.scenes) {
        let mix = kit.mix(wanted);
        let scene = Arc::new(Scene::new(kit.meshes(&mix), &settings)?);
        scenes.push(MixRow { mix, covered: covered(renderer, &scene)? });
        for (tones, passes) in CURVES {
            let cartoon = Cartoon { tones: Tones { count: tones, ..Tones::default() }, ..Cartoon::default() };
            let style = if passes == 2 { Style::TwoPass(cartoon) } else { Style::ThreePass(cartoon) };
            contestants.push(Contestant::styled(&scene, &style)?);
        }
    }
    let curves = contestants.len();
    let smallest = contestants[0].scene.clone();
    for filter in [Filter::Laplacian4, Filter::Laplacian8] {
        let border = Some(Border { filter, detection_factor: COMPARED_FACTOR, ..Border::default() });
        let cartoon = Cartoon { border, ..Cartoon::default() };
        contestants.push(Contestant::styled(&smallest, &Style::ThreePass(cartoon))?);
    }
    let bust = Scene::new(vec![Arc::new(load("builtin:bust", &LoadOptions::default())?.mesh)], &settings)?;
    let mut coverages = Vec::new();
    for distance in DISTANCES {
        let scene = Arc::new(from(&bust, distance, how.size)?);
        coverages.push(covered(renderer, &scene)?);
        let without = Cartoon { background_square: false, ..Cartoon::default() };
        let forms = [Style::ThreePass(Cartoon::default()), Style::TwoPass(Cartoon::default()), Style::TwoPass(without)];
        for style in forms {
            contestants.push(Contestant::styled(&scene, &style)?);
        }
    }
    let mut empty = Style::ThreePass(Cartoon::default()).plan(&smallest, Show::Final)?;
    empty.passes.truncate(1);
    empty.passes[0].steps.truncate(1);
    contestants.push(Contestant::new(&smallest, empty));
    take_turns(renderer, &mut contestants, how.frames, &mut || step(Turn::Scenes))?;

    let large = Size { width: how.size.width * 2, height: how.size.height * 2 };
    let square = Scene::new(
        smallest.objects.iter().map(|object| object.mesh.clone()),
        &SceneSettings { size: large, ..settings },
    )?;
    let mut squares = throughput::contestants(&Arc::new(square))?;
    take_turns(renderer, &mut squares, how.frames, &mut || step(Turn::Squares))?;

    let (curve, others) = contestants.split_at(curves);
    let rows = curve.iter().zip(CURVES.iter().cycle());
    let frames = rows.map(|(contestant, (tones, passes))| FrameRow {
        triangles: contestant.scene.triangle_count(),
        tones: *tones,
        passes: *passes,
        series: contestant.series(),
    });
    let filters = [Filter::Laplacian4, Filter::Laplacian8].into_iter().zip(others);
    let forms = others[2..].chunks_exact(3).zip(DISTANCES).zip(coverages);
    let mut numbers = Numbers {
        host: Host::new(renderer.context()),
        size: how.size,
        empty: others.last().map_or_else(|| Series::new(Vec::new()), Contestant::series),
        scenes,
        frames: frames.collect(),
        filters: filters.map(|(filter, contestant)| FilterRow { filter, series: contestant.series() }).collect(),
        backgrounds: forms
            .map(|((forms, distance), covered)| BackgroundRow {
                distance,
                covered,
                three_pass: forms[0].series(),
                two_pass: forms[1].series(),
                two_pass_without: forms[2].series(),
            })
            .collect(),
        shaders: throughput::rows(&squares),
        article: ARTICLE,
        reasons: Vec::new(),
    };
    numbers.reasons = reasons(&numbers);
    Ok(numbers)
}

/// All contestants' frames, one of each at a time.
pub(super) fn take_turns(
    renderer: &mut Renderer,
    contestants: &mut [Contestant],
    frames: usize,
    step: &mut impl FnMut(),
) -> Result<()> {
    for _ in 0..frames {
        for Contestant { scene, plan, times } in contestants.iter_mut() {
            // A frame that follows one of another kind also clears up after that one: up to a fifth of a large scene's
            // frame on a software renderer. So each is preceded by an untimed one of its own, as in an animation.
            times.extend(renderer.time_frames(scene, plan, 1, 1)?);
        }
        step();
    }
    Ok(())
}

/// The scene from its own direction and so many times its own distance.
pub(super) fn from(scene: &Scene, distance: f64, size: Size) -> Result<Scene> {
    let camera = scene.camera;
    let eye = Some(camera.target + (camera.eye - camera.target) * distance);
    let camera = tinta::CameraSettings { eye, target: Some(camera.target), ..tinta::CameraSettings::default() };
    let meshes = scene.objects.iter().map(|object| object.mesh.clone());
    Scene::new(meshes, &SceneSettings { camera, size, ..SceneSettings::default() })
}

/// Share of the picture's pixels that the objects cover.
pub(super) fn covered(renderer: &mut Renderer, scene: &Scene) -> Result<f64> {
    let bare = Scene { background: Background::Transparent, ..scene.clone() };
    let picture = renderer.render(&bare, &Style::Phong(tinta::styles::Phong::default()))?;
    let drawn = picture.pixels.chunks_exact(4).filter(|pixel| pixel[3] > 0).count();
    Ok(drawn as f64 / picture.size.pixel_count() as f64)
}
