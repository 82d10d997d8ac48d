//! The claims about painting: the light of faces and of vertices, and the resulting colours.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, changed};
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;
use tinta::camera::{CameraSettings, View};
use tinta::edges::{CreaseAngle, Incidence};
use tinta::error::Result;
use tinta::plan::{Geometry, Paint, Step};
use tinta::scene::{Background, Color, Scene, SceneSettings};
use tinta::styles::{Inking, LightOn, RampRow, Show, Style};

/// A step or a change of light that is seen, of 1.
const SEEN: f64 = 2.0 / 255.0;

/// Share of pixels that may differ between pictures that are the same up to rounding.
const SAME: f64 = 0.01;

/// Most light of a face in shadow: the text clamps it there, and shadow has one tone.
const SHADOW: f64 = 0.1;

/// The text's light: a normal's share in (0, 1, 1), seen from the eye, within 0.1 and 0.9.
fn light(scene: &Scene, normal: DVec3) -> f64 {
    let seen = scene.camera.view_from_world().transform_vector3(normal);
    seen.dot(DVec3::new(0.0, 1.0, 1.0).normalize()).clamp(SHADOW, 0.9)
}

pub(super) fn flat_shows_triangles(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let object = &scene.objects[0];
    let (mesh, edges) = (&object.mesh, scene.edges(object));
    let normal = |face: u32| {
        let [a, b, c] = mesh.triangles[face as usize].map(|corner| mesh.positions[corner as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let crease = CreaseAngle::default().degrees().to_radians().cos();
    let (mut inner, mut steps) = (0usize, 0usize);
    for (edge, incidence) in edges.list().incidence().iter().enumerate() {
        let [one, other] = edges.list().faces(edge as u32) else { continue };
        let [one, other] = [*one, *other].map(normal);
        let [light_one, light_other] = [one, other].map(|normal| light(&scene, normal));
        let is_lit = light_one.max(light_other) > SHADOW;
        if *incidence == Incidence::Inner && one.dot(other) >= crease && is_lit {
            inner += 1;
            steps += usize::from((light_one - light_other).abs() > SEEN);
        }
    }
    let share = steps as f64 / inner.max(1) as f64;
    Ok(Finding::of(share > 0.5, vec![Number::share("of such borders are seen where there is light", share)]))
}

/// The light that the style computes at each vertex of the first object.
fn lights(scene: &Scene) -> Result<Arc<Vec<[f32; 2]>>> {
    let plan = Style::Inking(Inking::default()).plan(scene, Show::Final)?;
    let of_step = |(_, step): (&str, &Step)| match step {
        Step::Draw(draw) => match &draw.geometry {
            Geometry::Objects(Paint::Coordinates(lists)) => lists.first().cloned(),
            _ => None,
        },
        _ => None,
    };
    Ok(plan.steps().find_map(of_step).unwrap_or_default())
}

pub(super) fn gouraud_gives_gradients(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let (lights, arrays) = (lights(&scene)?, scene.arrays(&scene.objects[0]));
    let (mut all, mut gradients) = (0usize, 0usize);
    for corners in arrays.indices.chunks_exact(3) {
        let light = |corner: &u32| f64::from(lights[*corner as usize][0]);
        let most = corners.iter().map(light).fold(f64::NEG_INFINITY, f64::max);
        let least = corners.iter().map(light).fold(f64::INFINITY, f64::min);
        // In f32 the clamp is slightly off the number.
        if most > SHADOW + f64::from(f32::EPSILON) {
            all += 1;
            gradients += usize::from(most - least > SEEN);
        }
    }
    let levels: BTreeSet<u8> = lights.iter().map(|[light, _]| (light * 255.0).round() as u8).collect();
    let share = gradients as f64 / all.max(1) as f64;
    Ok(Finding::of(
        share > 0.5,
        vec![
            Number::share("of the triangles in light have a gradient", share),
            Number::count("shades of 256 at the vertices", levels.len()),
        ],
    ))
}

pub(super) fn texture_gives_few_colours(lab: &mut Lab<'_>) -> Result<Finding> {
    let settings = SceneSettings { background: Background::Color(Color([0.0; 3])), ..SceneSettings::default() };
    let scene = lab.seen("builtin:gear", settings)?;
    let inking = Inking { is_inked: false, ramp_row: RampRow::Row(0), ..Inking::default() };
    let picture = lab.draw(&scene, &Style::Inking(inking), Show::Final)?;
    let colors: BTreeSet<&[u8]> = picture.pixels.chunks_exact(4).collect();
    // One of them is the background.
    let count = colors.len().saturating_sub(1);
    Ok(Finding::of(count <= 3, vec![Number::count("colours of the model", count)]))
}

pub(super) fn light_stands_in_the_world(lab: &mut Lab<'_>) -> Result<Finding> {
    let mut from = |azimuth_degrees| -> Result<Arc<Vec<[f32; 2]>>> {
        let view = View { azimuth_degrees, elevation_degrees: 20.0 };
        let camera = CameraSettings { view, ..CameraSettings::default() };
        let scene = lab.seen("builtin:bust", SceneSettings { camera, ..SceneSettings::default() })?;
        lights(&scene)
    };
    let [before, after] = [from(30.0)?, from(80.0)?];
    let is_other = |(before, after): &(&[f32; 2], &[f32; 2])| f64::from((before[0] - after[0]).abs()) > SEEN;
    let share = before.iter().zip(&*after).filter(is_other).count() as f64 / before.len().max(1) as f64;
    Ok(Finding::of(share == 0.0, vec![Number::share("of the vertices get another light, turned by 50 degrees", share)]))
}

pub(super) fn vertex_shader(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let mut with = |light| lab.draw(&scene, &Style::Inking(Inking { light, ..Inking::default() }), Show::Final);
    let [listing, shader] = [with(LightOn::Cpu)?, with(LightOn::VertexShader)?];
    let share = changed(&listing, &shader, 2, None);
    Ok(Finding::of(share <= SAME, vec![Number::share("pixels that differ", share)]))
}

pub(super) fn second_stage(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:soldier")?;
    let plan = Style::Inking(Inking { has_texture: true, ..Inking::default() }).plan(&scene, Show::Final)?;
    let textures = plan.steps().filter_map(|(_, step)| match step {
        Step::Draw(draw) if matches!(draw.geometry, Geometry::Objects(_)) => Some(draw.textures.len()),
        _ => None,
    });
    let textures: Vec<usize> = textures.collect();
    Ok(Finding::of(
        textures == [2],
        vec![
            Number::count("times the faces are drawn", textures.len()),
            Number::count("textures of each", textures.into_iter().max().unwrap_or_default()),
        ],
    ))
}
