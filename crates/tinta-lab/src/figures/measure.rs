//! The numbers of Evangelista et al. 2005, section 5, measured here: figure 13, the filter's gain, two passes without the square,
//! the shaders' throughput. Settings take turns, and a busy moment hits all of them; the report gives medians and quartiles, and keeps every raw
//! time.

use super::mix::{Kit, TRIANGLES};
use super::numbers::{ARTICLE, BackgroundRow, FilterRow, FrameRow, Host, MixRow, Numbers};
use super::reasons::reasons;
use super::series::{Contestant, take_turns};
use super::throughput::{self, COMPARED_FACTOR};
use std::sync::Arc;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, load};
use tinta::renderer::Renderer;
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

/// Distances of the eye from the bust, relative to the one at which the bust fills the picture.
const DISTANCES: [f64; 4] = [0.35, 0.6, 1.0, 3.0];

/// Tones and passes of figure 13.
const CURVES: [(u8, u8); 6] = [(1, 2), (1, 3), (2, 2), (2, 3), (3, 2), (3, 3)];

/// The work that [`measure`] has just timed: a frame of each setting in turn, [`HowToMeasure::frames`] times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// Scenes.
    Scenes,
    /// Squares.
    Squares,
}

/// About how many triangles a turn of [`Turn::Scenes`] draws, over all its frames: figure 13's scenes dominate.
pub fn triangles_a_turn(how: &HowToMeasure) -> usize {
    TRIANGLES.into_iter().take(how.scenes).sum::<usize>() * CURVES.len() * 2
}

/// Measures; `step` receives each turn.
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
        empty: others.last().map(Contestant::series).unwrap_or_default(),
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

/// The scene from its own direction and so many times its own distance.
fn from(scene: &Scene, distance: f64, size: Size) -> Result<Scene> {
    let camera = scene.camera;
    let eye = Some(camera.target + (camera.eye - camera.target) * distance);
    let camera = tinta::CameraSettings { eye, target: Some(camera.target), ..tinta::CameraSettings::default() };
    let meshes = scene.objects.iter().map(|object| object.mesh.clone());
    Scene::new(meshes, &SceneSettings { camera, size, ..SceneSettings::default() })
}

/// Share of the picture's pixels that the objects cover.
fn covered(renderer: &mut Renderer, scene: &Scene) -> Result<f64> {
    let bare = Scene { background: Background::Transparent, ..scene.clone() };
    let picture = renderer.render(&bare, &Style::Phong(tinta::styles::Phong::default()))?;
    let drawn = picture.pixels.chunks_exact(4).filter(|pixel| pixel[3] > 0).count();
    Ok(drawn as f64 / picture.size.pixel_count() as f64)
}
