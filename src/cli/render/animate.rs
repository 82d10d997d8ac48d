//! `tinta render` with an animation for its output: a turn around the models, or an animated model's frames.

use super::super::model_cache::ModelCache;
use super::super::models::read;
use super::super::progress::Progress;
use super::super::session::Session;
use super::{Arguments, Loaded, Verdict, load_scene, model_records, prune};
use serde_json::json;
use std::sync::Arc;
use std::time::Instant;
use tinta::mesh::ModelFrame;
use tinta::record::Summary;
use tinta::renderer::milliseconds_since;
use tinta::{AnimationTarget, AnimationWriter, Error, LoadOptions, Mesh, Result, Scene, SceneSettings, Style};

#[derive(clap::Args)]
#[command(
    next_help_heading = "Animation, into FILE.gif, FILE.apng or numbered files such as frame-%04d.png; lines: frame-%04d.svg"
)]
pub(super) struct AnimationArguments {
    /// Draw N views of a full turn around the models [default: off]
    #[arg(long, value_name = "N", conflicts_with = "animate", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub turntable: Option<u32>,

    /// Draw all frames of an animated model (MD2), or those of one movement, such as --animate=run [default: off]
    #[arg(long, hide_short_help = true, value_name = "MOVEMENT", num_args = 0..=1, require_equals = true, default_missing_value = "", conflicts_with = "model-frame")]
    pub animate: Option<String>,

    /// Time that each picture is shown, in milliseconds [default: 100 for a model's frame; a turn takes 2500, at most 200 each]
    #[arg(long, hide_short_help = true, value_name = "MS", value_parser = clap::value_parser!(u16).range(20..=60_000))]
    frame_delay: Option<u16>,
}

/// How long a turn takes unless told otherwise, milliseconds; few views are not shown longer than 200 each.
const TURN_MS: u32 = 2500;

/// Views from which silhouettes are worth a hierarchy.
pub(super) const WORTH_PREPARING: u32 = 30;

/// Quake 2 shows ten frames a second.
const MODEL_FRAME_MS: u16 = 100;

impl AnimationArguments {
    /// Where the animation goes, if one is asked for.
    pub(super) fn target(&self, output: &str, transparent: bool) -> Result<Option<AnimationTarget>> {
        let is_asked_for = self.turntable.is_some() || self.animate.is_some() || AnimationTarget::is_meant_by(output);
        is_asked_for.then(|| AnimationTarget::check(output, transparent)).transpose()
    }

    fn delay_ms(&self, frames: usize) -> u16 {
        let turn = (TURN_MS / frames.max(1) as u32).clamp(20, 200) as u16;
        self.frame_delay.unwrap_or(if self.animate.is_some() { MODEL_FRAME_MS } else { turn })
    }
}

/// Draws the animation that the arguments describe; encoding goes on beside the drawing.
pub(super) fn run(arguments: &Arguments, target: &AnimationTarget, session: &mut Session) -> Result<Verdict> {
    let start = Instant::now();
    refuse_what_is_for_one_picture(arguments)?;
    let style = arguments.styles.style(arguments.style_name())?;
    let (scenes, load_ms) = scenes(arguments, &style, &session.model_cache)?;
    let delay_ms = arguments.animation.delay_ms(scenes.len());
    let context = Instant::now();
    let renderer = session.renderer(arguments.run.backend)?;
    let context_ms = milliseconds_since(context);

    let progress = Progress::new("drawing", scenes.len() as u64);
    let mut writer = AnimationWriter::new(target.clone(), scenes.len() as u32, delay_ms)?;
    let mut frame_ms = Vec::new();
    let mut verdict = Verdict::Good;
    for (number, scene) in scenes.iter().enumerate() {
        let frame = Instant::now();
        let published = arguments.plan(&style, scene)?;
        renderer.choose_context(scene, &published)?;
        let plan = arguments.prune.pruned(&published, scene, renderer, scenes.len() as u32).plan;
        if number == 0 {
            let remarks = [style.remarks(scene), renderer.remarks(&plan)].concat();
            remarks.iter().for_each(|remark| super::super::say(&format!("tinta: {remark}")));
        }
        let picture = renderer.draw(scene, &plan)?;
        frame_ms.push(milliseconds_since(frame));
        if arguments.prune.verify && verdict == Verdict::Good {
            verdict = prune::verify(arguments, renderer, scene, &published, &picture)?;
        }
        writer.add(picture)?;
        progress.step();
    }
    let written = writer.finish()?;
    drop(progress);
    if !arguments.run.json {
        return Ok(verdict);
    }
    let models = model_records(&scenes[0], arguments.models.len());
    super::super::print_json(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "models": models,
        "load": arguments.model.settings()?,
        "style": style,
        "show": arguments.styles.show,
        "size": scenes[0].size,
        "gl": renderer.context(),
        "frames": scenes.len(),
        "delay_ms": delay_ms,
        "bytes": written.bytes,
        "load_ms": load_ms,
        "context_ms": context_ms,
        "frame_ms": Summary::new(frame_ms),
        "encode_ms": Summary::new(written.encode_ms),
        "whole_ms": milliseconds_since(start),
    }))
    .map(|()| verdict)
}

fn refuse_what_is_for_one_picture(arguments: &Arguments) -> Result<()> {
    let run = &arguments.run;
    let given = [("explain", run.explain), ("dump", run.dump.is_some()), ("frames", run.frames != 1)];
    match given.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => {
            Err(Error::setting(*option, "this is for one picture; leave it out, or name a picture such as drawing.png"))
        }
        None => Ok(()),
    }
}

/// A scene for each picture, and how long reading took, milliseconds.
pub(super) fn scenes(arguments: &Arguments, style: &Style, model_cache: &ModelCache) -> Result<(Vec<Scene>, f64)> {
    let settings = arguments.scene_settings()?;
    if let Some(movement) = &arguments.animation.animate {
        let start = Instant::now();
        let frames = model_frames(&arguments.models, &arguments.model.settings()?, movement)?;
        let load_ms = milliseconds_since(start);
        return Ok((one_scene_a_frame(frames, &settings)?, load_ms));
    }
    let Loaded { scene, load_ms, .. } = load_scene(arguments, &settings, style, model_cache)?;
    let Some(views) = arguments.animation.turntable else { return Ok((vec![scene], load_ms)) };
    if views >= WORTH_PREPARING && matches!(style, Style::Inking(_)) {
        scene.prepare_for_many_views();
    }
    let cameras = scene.turntable(&settings.camera, views)?;
    Ok((cameras.into_iter().map(|camera| Scene { camera, ..scene.clone() }).collect(), load_ms))
}

/// All models in each frame. Models that stand still, or have fewer frames than another, begin again.
fn model_frames(paths: &[String], options: &LoadOptions, movement: &str) -> Result<Vec<Vec<Arc<Mesh>>>> {
    let mut all: Vec<Vec<Arc<Mesh>>> = Vec::new();
    let mut moves = false;
    for path in paths {
        let first = read(path, options)?;
        first.remarks.iter().for_each(|remark| super::super::say(&format!("tinta: {remark}")));
        if first.frames.is_empty() {
            all.push(vec![Arc::new(first.mesh)]);
            continue;
        }
        moves = true;
        let at = |number: usize| {
            let model_frame = ModelFrame::Number(number as f64);
            Ok(Arc::new(read(path, &LoadOptions { model_frame, ..options.clone() })?.mesh))
        };
        all.push(numbers_of(&first.frames, movement, path)?.into_iter().map(at).collect::<Result<_>>()?);
    }
    if !moves {
        return Err(Error::setting(
            "animate",
            format!("{} has no frames; name an MD2 model, or use --turntable", paths.join(", ")),
        ));
    }
    let count = all.iter().map(Vec::len).max().unwrap_or(0);
    Ok((0..count).map(|frame| all.iter().map(|meshes| meshes[frame % meshes.len()].clone()).collect()).collect())
}

/// The frames named like a movement and a number, all for an empty name; one at least.
fn numbers_of(names: &[String], movement: &str, path: &str) -> Result<Vec<usize>> {
    let without_number =
        |name: &str| name.trim_end_matches(|letter: char| letter.is_ascii_digit()).to_ascii_lowercase();
    let belongs = |name: &str| {
        let rest = name.to_ascii_lowercase().strip_prefix(&movement.to_ascii_lowercase()).map(str::to_owned);
        movement.is_empty() || rest.is_some_and(|rest| rest.chars().all(|letter| letter.is_ascii_digit()))
    };
    let numbers: Vec<usize> = (0..names.len()).filter(|number| belongs(&names[*number])).collect();
    if numbers.is_empty() {
        let mut movements: Vec<String> = names.iter().map(|name| without_number(name)).collect();
        movements.dedup();
        movements.truncate(12);
        return Err(Error::setting(
            format!("animate={movement}"),
            format!("{path} has no such movement; it has {}", movements.join(", ")),
        ));
    }
    Ok(numbers)
}

/// Scenes that share one camera, which shows the models in all of them, and one place for each copy.
fn one_scene_a_frame(frames: Vec<Vec<Arc<Mesh>>>, settings: &SceneSettings) -> Result<Vec<Scene>> {
    let models = frames[0].len();
    let meshes: Vec<Arc<Mesh>> = frames.iter().flatten().cloned().collect();
    let mesh_count = meshes.len();
    let mut together = Scene::new(meshes, settings)?;
    let objects = std::mem::take(&mut together.objects);
    let mut scenes: Vec<Scene> = frames.iter().map(|_| together.clone()).collect();
    for (index, object) in objects.into_iter().enumerate() {
        scenes[index % mesh_count / models].objects.push(object);
    }
    Ok(scenes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Vec<String> {
        ["stand01", "stand02", "run1", "run2", "death101", "death201"].map(str::to_owned).to_vec()
    }

    #[test]
    fn movements_are_found_by_name() {
        let find = |movement: &str| numbers_of(&names(), movement, "a.md2");
        assert_eq!(find("").unwrap(), [0, 1, 2, 3, 4, 5]);
        assert_eq!(find("Run").unwrap(), [2, 3]);
        assert_eq!(find("death2").unwrap(), [5]);
        assert_eq!(find("death").unwrap(), [4, 5]);
        let message = find("jump").unwrap_err().with_dashes();
        assert_eq!(message, "--animate=jump: a.md2 has no such movement; it has stand, run, death");
    }

    #[test]
    fn frames_share_a_camera_and_keep_their_copies() {
        let mesh = |model: &str| Arc::new(read(model, &LoadOptions::default()).unwrap().mesh);
        let (ant, gear, still) = (mesh("builtin:ant"), mesh("builtin:gear"), mesh("builtin:open-box"));
        let frames = vec![vec![ant.clone(), still.clone()], vec![gear.clone(), still.clone()]];
        let settings = SceneSettings { copies: 3, ..SceneSettings::default() };
        let scenes = one_scene_a_frame(frames, &settings).unwrap();
        assert_eq!(scenes[0].camera, scenes[1].camera);
        for (scene, moving) in scenes.iter().zip([ant, gear]) {
            assert_eq!(scene.objects.len(), 6);
            for pair in scene.objects.chunks_exact(2) {
                assert!(Arc::ptr_eq(&pair[0].mesh, &moving) && Arc::ptr_eq(&pair[1].mesh, &still));
                assert_eq!(pair[0].offset, pair[1].offset);
            }
        }
    }
}
