//! `tinta render` with an animation for its output: a turn around the models, or an animated model's frames.

use super::super::Verdict;
use super::super::models::read;
use super::super::progress::Progress;
use super::prune;
use super::rendering::{Rendering, pictures_of};
use serde_json::json;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use tinta::animation::NumberedName;
use tinta::lines::Progress as LineProgress;
use tinta::mesh::ModelFrame;
use tinta::plan::prune::PrunedPlan;
use tinta::record::Summary;
use tinta::renderer::milliseconds_since;
use tinta::request::{AnimationSettings, ModelCache, ReadModels, Request, Resolved, Session, empty_remark};
use tinta::{AnimationTarget, AnimationWriter, Error, LoadOptions, Mesh, Result, Scene};

/// Default time of a turn, milliseconds; each of a few views is shown for at most 200.
const TURN_MS: u32 = 2500;

/// Quake 2 shows ten frames a second.
const MODEL_FRAME_MS: u16 = 100;

/// Refuses the name of an animation for a picture that stands still.
pub(super) fn check_name(animation: &AnimationSettings, output: &str) -> Result<()> {
    if animation.is_still() && AnimationTarget::is_meant_by(output) {
        let problem = "this names an animation; add --turntable 60, or --animate for a model with frames, or name one picture \
                       such as drawing.png";
        return Err(Error::output(output, problem));
    }
    if output.contains("%s") {
        let problem = "%s stands for no model's name; tinta batch draws a picture of each model: -o '{name}.png'";
        return Err(Error::output(output, problem));
    }
    Ok(())
}

/// Says which frames of an earlier and longer animation are left behind the last.
pub(super) fn say_left_over(output: &str, frames: u32) {
    let next = NumberedName::parse(output).map(|name| name.with(frames + 1));
    if let Some(next) = next.filter(|next| Path::new(next).exists()) {
        super::super::say(&format!(
            "tinta: {next}: this frame is an earlier animation's; delete it with those after it"
        ));
    }
}

/// The animation's target, if one is asked for.
pub(super) fn target(
    animation: &AnimationSettings,
    output: &str,
    is_transparent: bool,
) -> Result<Option<AnimationTarget>> {
    (!animation.is_still()).then(|| AnimationTarget::check(output, is_transparent)).transpose()
}

fn delay_ms(animation: &AnimationSettings, frames: usize) -> u16 {
    let turn = (TURN_MS / frames.max(1) as u32).clamp(20, 200) as u16;
    let as_given = animation.frame_delay_ms.map(|ms| u16::try_from(ms).unwrap_or(u16::MAX));
    as_given.unwrap_or(if animation.animate.is_some() { MODEL_FRAME_MS } else { turn })
}

/// Draws the animation; encoding runs in parallel.
pub(super) fn run(rendering: &Rendering<'_>, target: &AnimationTarget, session: &mut Session) -> Result<Verdict> {
    let start = Instant::now();
    let Rendering { request, run, output } = *rendering;
    run.refuse_for_animations()?;
    let (views, load_ms) = views(request, &session.models)?;
    pictures_of(&views[0].scene).keep(output)?;
    let delay_ms = delay_ms(&request.animation, views.len());
    let (context, renderer) = (Instant::now(), request.renderer(session)?);
    let context_ms = milliseconds_since(context);

    let progress = Progress::new("drawing", views.len() as u64);
    let mut writer = AnimationWriter::new(target.clone(), views.len() as u32, delay_ms)?;
    let mut frame_ms = Vec::new();
    let mut verdict = Verdict::Good;
    let (mut remarks, mut empty) = (Vec::new(), Vec::new());
    for (number, view) in views.iter().enumerate() {
        let frame = Instant::now();
        let scene = view.lit();
        let (published, PrunedPlan { mut plan, .. }) = view.plans(renderer)?;
        plan.submission = run.submission;
        if number == 0 {
            remarks = view.picture_remarks(&plan, renderer);
            remarks.iter().for_each(|remark| super::super::say(&format!("tinta: {remark}")));
        }
        let around = view.around(&LineProgress::default())?;
        let picture = around.drawn(view, &plan, renderer)?;
        frame_ms.push(milliseconds_since(frame));
        empty.extend(empty_remark(scene, &published, Some(&around), &picture, renderer)?);
        if run.verify && verdict == Verdict::Good {
            verdict = prune::verify(output, renderer, view, (&published, &around), &picture)?;
        }
        writer.add(picture)?;
        progress.step();
    }
    let written = writer.finish()?;
    drop(progress);
    say_left_over(output, views.len() as u32);
    remarks.extend(of_empty(&empty, views.len()).inspect(|remark| super::super::say(&format!("tinta: {remark}"))));
    if !run.json {
        return Ok(verdict);
    }
    super::super::print_json(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "models": rendering.model_records(&views[0].scene),
        "load": request.read,
        "style": request.style,
        "show": request.show,
        "size": request.scene.size,
        "gl": renderer.context(),
        "remarks": remarks,
        "frames": views.len(),
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

/// The remark on the empty pictures of an animation, given theirs.
fn of_empty(remarks: &[String], pictures: usize) -> Option<String> {
    let first = remarks.first()?;
    Some(format!("{} of {pictures} pictures are empty; the first: {first}", remarks.len()))
}

/// A view for each picture, and how long reading took, milliseconds.
pub fn views(request: &Request, models: &ModelCache) -> Result<(Vec<Resolved>, f64)> {
    if let Some(movement) = &request.animation.animate {
        let start = Instant::now();
        let frames = model_frames(&request.models, request.load_options()?.as_ref(), movement)?;
        let load_ms = milliseconds_since(start);
        return Ok((request.animation(one_scene_a_frame(frames, request)?, false)?, load_ms));
    }
    let ReadModels { meshes, ms: load_ms, .. } = request.models(models)?;
    let views = match request.animation.turntable {
        Some(views) => request.turn(request.placed(meshes)?, views, false)?,
        None => vec![request.resolve(meshes, false)?],
    };
    Ok((views, load_ms))
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

/// Scenes with one camera, which has the models of all of them in view, and a fixed place for each copy.
fn one_scene_a_frame(frames: Vec<Vec<Arc<Mesh>>>, request: &Request) -> Result<Vec<Scene>> {
    // A section may leave nothing of a model in some frames.
    let left = |frame: &(usize, &Arc<Mesh>)| !frame.1.is_empty();
    let numbered = frames.iter().enumerate().flat_map(|(frame, meshes)| meshes.iter().map(move |mesh| (frame, mesh)));
    let (frame_of, meshes): (Vec<usize>, Vec<Arc<Mesh>>) =
        numbered.filter(left).map(|(frame, mesh)| (frame, mesh.clone())).unzip();
    if let Some(frame) = (0..frames.len()).find(|frame| !frame_of.contains(frame)) {
        return Err(Error::setting("section", format!("nothing is left of frame {frame}; move the plane")));
    }
    let mut together = request.placed(meshes)?;
    let objects = std::mem::take(&mut together.objects);
    let mut scenes: Vec<Scene> = frames.iter().map(|_| together.clone()).collect();
    for (index, object) in objects.into_iter().enumerate() {
        scenes[frame_of[index % frame_of.len()]].objects.push(object);
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
        let mut request = Request::default();
        request.scene.copies = 3;
        let scenes = one_scene_a_frame(frames, &request).unwrap();
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
