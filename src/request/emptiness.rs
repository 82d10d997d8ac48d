//! A remark on a picture that shows nothing of its scene: whether it is all background, and why.
//!
//! The picture decides, lines included, not the camera: it is compared with the same plan without the scene. That costs a frame, so it is
//! done only for a picture of one colour, or where no face surely covers a pixel.

use super::Around;
use crate::error::Result;
use crate::picture::Picture;
use crate::plan::{Geometry, Plan, Step};
use crate::renderer::Renderer;
use crate::scene::{Scene, UnseenReason};
use crate::values::short;

/// Returns a remark if this picture, drawn by this plan as published with its shadow and lines, is all background; `None` for any
/// other picture.
///
/// # Errors
///
/// Those of [`Renderer::draw`].
pub fn empty_remark(
    scene: &Scene,
    published: &Plan,
    around: Option<&Around>,
    picture: &Picture,
    renderer: &mut Renderer,
) -> Result<Option<String>> {
    let drawn_around = || around.filter(|around| around.below.is_some()).map(|_| published.clone());
    let Some(ground) = without_scene(published).or_else(drawn_around) else { return Ok(None) };
    let culls = published.steps().any(|(_, step)| matches!(step, Step::Draw(draw) if draw.cull_back_faces));
    let unseen = scene.unseen(scene.size.times(published.supersample), culls);
    if unseen.is_none() && !picture.is_of_one_color() {
        return Ok(None);
    }
    let mut below = renderer.draw(scene, &ground)?;
    around.inspect(|around| around.put_bare(&mut below));
    Ok((below == *picture).then(|| format!("the picture is empty: {}", reason(scene, unseen))))
}

/// The plan without its draws of the scene; `None` if it has none.
fn without_scene(plan: &Plan) -> Option<Plan> {
    let is_of_scene = |step: &Step| matches!(step, Step::Draw(draw) if matches!(draw.geometry, Geometry::Objects(_) | Geometry::Edges { .. }));
    let mut ground = plan.clone();
    ground.passes.iter_mut().for_each(|pass| pass.steps.retain(|step| !is_of_scene(step)));
    (ground != *plan).then_some(ground)
}

/// Why nothing is seen, and what to do.
pub(super) fn reason(scene: &Scene, unseen: Option<UnseenReason>) -> String {
    match unseen {
        Some(UnseenReason::Behind) => "the whole model is behind the eye; see --eye and --target".to_owned(),
        Some(UnseenReason::Beside) => "the model lies beside it; see --eye, --target, --fov and --height".to_owned(),
        Some(UnseenReason::CutOff) => format!(
            "nothing lies between the near plane, {} away, and the far plane, {} away; see --near and --far",
            short(scene.camera.near),
            short(scene.camera.far)
        ),
        Some(UnseenReason::TurnedAway) => "all faces in it are turned away, and --cull back leaves them out".to_owned(),
        Some(UnseenReason::BetweenPixels) => {
            "no face is large enough to cover the centre of a pixel; come nearer, or give a larger --size".to_owned()
        }
        None => "what is drawn has the background's colour; see --background and --color".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraSettings;
    use crate::gl::Backend;
    use crate::mesh::{LoadOptions, load};
    use crate::random::Random;
    use crate::scene::{SceneSettings, Size};
    use crate::styles::{Show, Style, StyleName};
    use glam::DVec3;
    use std::sync::Arc;

    /// A camera near a model of size 1, which often looks past it, cuts it off, or sees it from afar.
    fn camera(random: &mut Random) -> (CameraSettings, Size) {
        let mut number = |low: f64, high: f64| low + (high - low) * (random.signed_f64() * 0.5 + 0.5);
        let mut point = |reach: f64| DVec3::new(number(-reach, reach), number(-reach, reach), number(-reach, reach));
        let (eye, target) = (point(1.0) * point(3.0).length_squared(), point(1.5));
        let near = number(0.01, 8.0);
        let planes = match number(0.0, 3.0) as u32 {
            0 => (Some(near), Some(near + number(0.001, 4.0))),
            1 => (Some(near), None),
            _ => (None, None),
        };
        let camera = CameraSettings {
            eye: Some(eye),
            target: Some(target),
            fov_y_degrees: number(5.0, 100.0),
            parallel: number(0.0, 1.0) < 0.3,
            near: planes.0,
            far: planes.1,
            ..CameraSettings::default()
        };
        (camera, Size { width: number(1.0, 40.0) as u32, height: number(1.0, 40.0) as u32 })
    }

    #[test]
    fn pictures_by_chance_are_remarked_if_and_only_if_they_are_all_background() {
        let mut renderer = Renderer::new(Backend::Auto).unwrap();
        let styles: Vec<Style> = StyleName::of_passes().map(|(_, name)| Style::named(name)).collect();
        let mut random = Random::new(7, "cameras");
        let (mut empty, mut drawn) = (0, 0);
        for model in ["builtin:gear", "builtin:open-box"] {
            let mesh = Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
            for _ in 0..40 {
                let (camera, size) = camera(&mut random);
                let settings = SceneSettings { camera, size, ..SceneSettings::default() };
                let Ok(scene) = Scene::new(vec![mesh.clone()], &settings) else { continue };
                for style in &styles {
                    let Ok(plan) = style.plan(&scene, Show::Final) else { continue };
                    let Ok(picture) = renderer.draw(&scene, &plan) else { continue };
                    let ground = renderer.draw(&scene, &without_scene(&plan).unwrap()).unwrap();
                    let remark = empty_remark(&scene, &plan, None, &picture, &mut renderer).unwrap();
                    assert_eq!(
                        remark.is_some(),
                        picture == ground,
                        "{model} {} {settings:?}: {remark:?}",
                        style.name()
                    );
                    *(if remark.is_some() { &mut empty } else { &mut drawn }) += 1;
                }
            }
        }
        assert!(empty > 60 && drawn > 60, "{empty} empty, {drawn} drawn");
    }

    #[test]
    fn what_has_the_backgrounds_colour_is_no_picture_either() {
        let mesh = Arc::new(load("builtin:gear", &LoadOptions::default()).unwrap().mesh);
        let size = Size { width: 32, height: 32 };
        let scene = Scene::new(vec![mesh], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
        let mut plan = Style::named(StyleName::Phong).plan(&scene, Show::Final).unwrap();
        let mut renderer = Renderer::new(Backend::Auto).unwrap();
        let picture = renderer.draw(&scene, &plan).unwrap();
        assert_eq!(empty_remark(&scene, &plan, None, &picture, &mut renderer).unwrap(), None);
        // Without light, shaders and colours every face is white.
        for step in plan.passes.iter_mut().flat_map(|pass| &mut pass.steps) {
            if let Step::Draw(draw) = step {
                (draw.program, draw.textures) = (None, Vec::new());
                draw.uniforms.clear();
                draw.geometry = Geometry::Objects(crate::plan::Paint::Uniform([1.0; 4]));
            }
        }
        let picture = renderer.draw(&scene, &plan).unwrap();
        let remark = empty_remark(&scene, &plan, None, &picture, &mut renderer).unwrap().unwrap();
        assert!(remark.starts_with("the picture is empty: what is drawn has the background's colour"), "{remark}");
    }
}
