//! The measurements: models at sizes, and their expected time.

use crate::measure::{Against, frames_a_turn, turns};
use std::time::Instant;
use tinta::cli::progress::Steps;
use tinta::lines::closed_forms::ClosedForm;
use tinta::mesh::{BUILTINS, builtin};
use tinta::renderer::milliseconds_since;
use tinta::request::{ModelCache, Request};
use tinta::{Error, LoadOptions, Renderer, Result, Scene, SceneSettings, Show, Size, Style, StyleName};

/// Triangles of the surfaces' meshes by default.
const SURFACE_TRIANGLES: [usize; 3] = [1_000, 10_000, 100_000];

/// Time of a setting besides its frames, seconds: its pictures are compared with the references.
const SECONDS_A_SETTING: f64 = 0.35;

/// How long a model's references take at first guess, seconds: exact lines and rays.
const SECONDS_A_REFERENCE: f64 = 0.5;

/// Frames of a setting besides those of its turns.
const FRAMES_A_SETTING: f64 = 10.0;

/// The work for each model at each size, in the order of [`expected`]: references once, errors of each setting, turns.
pub(super) const KINDS: [usize; 3] = [0, 1, 2];

/// A model at a size.
pub(super) struct Group {
    pub(super) model: String,
    /// The surface whose contour its lines are compared with, if any.
    pub(super) surface: Option<ClosedForm>,
    pub(super) scene: Scene,
    pub(super) load_ms: f64,
}

/// All models at all sizes.
pub(super) fn groups(
    request: &Request,
    sizes: &[Size],
    against: Against,
    models: &[&str],
    cache: &ModelCache,
) -> Result<Vec<Group>> {
    let mut groups = Vec::new();
    let options = &request.read;
    if against == Against::Smooth && options.up_axis != LoadOptions::default().up_axis {
        let problem = "with --against smooth the formulas place the surfaces; leave it out";
        return Err(Error::setting("up", problem));
    }
    for model in models {
        let surface = (against == Against::Smooth).then(|| surface_of(model)).transpose()?;
        let start = Instant::now();
        let loaded = cache.read(model, options)?;
        let load_ms = milliseconds_since(start);
        for size in sizes {
            let scene = Scene::new(vec![loaded.mesh.clone()], &SceneSettings { size: *size, ..request.scene.clone() })?;
            groups.push(Group { model: (*model).to_owned(), surface, scene, load_ms });
        }
    }
    Ok(groups)
}

/// The surface that a built-in model is a mesh of.
fn surface_of(model: &str) -> Result<ClosedForm> {
    let surface = builtin(model).transpose()?.and_then(|named| named.builtin.closed_form());
    surface.ok_or_else(|| {
        let names: Vec<&str> = BUILTINS.iter().filter(|it| it.closed_form().is_some()).map(|it| it.name).collect();
        let problem = format!(
            "only surfaces in closed form have a true contour to measure against; choose from builtin:{}, or leave out \
             --against",
            names.join(", builtin:")
        );
        Error::model(model, problem)
    })
}

/// The surfaces in closed form, from few triangles to many.
pub(super) fn all_surfaces() -> Vec<String> {
    let surfaces = BUILTINS.iter().filter(|builtin| builtin.closed_form().is_some());
    surfaces.flat_map(|it| SURFACE_TRIANGLES.map(|count| format!("builtin:{}:{count}", it.name))).collect()
}

/// How long all of it will take, by one frame of each group.
pub(super) fn expected(
    renderer: &mut Renderer,
    groups: &[Group],
    settings: usize,
    frames: usize,
) -> Result<Vec<Steps>> {
    let style = Style::named(StyleName::ThreePass);
    let mut steps = Vec::new();
    for group in groups {
        let plan = style.plan(&group.scene, Show::Final)?;
        let frame = renderer.time_frames(&group.scene, &plan, 1, 1)?.first().copied().unwrap_or_default() * 1e-3;
        let pixels = group.scene.size.pixel_count() as f64 / (512.0 * 512.0);
        steps.push(Steps { count: 1, seconds: SECONDS_A_REFERENCE });
        steps.push(Steps { count: settings, seconds: SECONDS_A_SETTING * pixels.max(0.2) + frame * FRAMES_A_SETTING });
        steps.push(Steps { count: settings * turns(frames), seconds: frame * frames_a_turn(frames) as f64 });
    }
    Ok(steps)
}
