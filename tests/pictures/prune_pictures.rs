//! Pictures of pruned plans against those of full ones: the same bytes for every model, style, view and backend.

use crate::prune::{beside, cartoon, many_styles};
use crate::support::shapes::Random;
use crate::support::{BACKENDS, PUBLIC_MODELS, full_sizes, public_model, renderer, scene_with, styles};
use glam::DVec3;
use std::sync::Arc;
use tinta::plan::prune::{Pruning, prune};
use tinta::{
    Backend, Background, CameraSettings, Color, LoadOptions, Mesh, Renderer, Scene, SceneSettings, Show, Size, Style,
    StyleName, View, load,
};

/// The scene from a random view: any direction, sometimes from nearer or looking past it, sometimes in parallel.
fn random_view(scene: &Scene, dice: &mut Random) -> Scene {
    let view = View {
        azimuth_degrees: dice.number() * 360.0,
        elevation_degrees: (dice.number() * 2.0 - 1.0).asin().to_degrees(),
    };
    let parallel = dice.number() < 0.2;
    let largest = if dice.number() < 0.1 { 500.0 } else { 120.0 };
    let settings = SceneSettings {
        size: Size { width: 40 + (dice.number() * largest) as u32, height: 40 + (dice.number() * largest) as u32 },
        camera: CameraSettings {
            view,
            parallel,
            fov_y_degrees: 10.0 + dice.number() * 60.0,
            ..CameraSettings::default()
        },
        ..SceneSettings::default()
    };
    let meshes = scene.objects.iter().map(|object| object.mesh.clone());
    let fitted = Scene::new(meshes, &settings).unwrap();
    let mut scene = Scene { camera: fitted.camera, size: fitted.size, ..scene.clone() };
    if dice.number() < 0.3 {
        let aside = DVec3::new(dice.number() - 0.5, dice.number() - 0.5, dice.number() - 0.5) * scene.radius;
        (scene.camera.eye, scene.camera.target) = (scene.camera.eye + aside, scene.camera.target + aside);
        scene.camera.near *= 0.5;
        scene.camera.far *= 1.5;
    }
    scene
}

/// Draws many views of a model in every style, in full and pruned, and compares the bytes.
fn verify(renderer: &mut Renderer, mesh: &Arc<Mesh>, views: usize) {
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default()).unwrap();
    let has_skin = !mesh.triangle_texture_coordinates.is_empty() && mesh.materials.iter().any(|m| m.has_texture());
    let mut styles: Vec<Style> = styles().into_iter().map(|(_, style)| style).collect();
    if has_skin {
        styles.push(Style::named(StyleName::Sand));
    }
    styles.push(cartoon(|cartoon| (cartoon.cull_back_faces, cartoon.tones.count) = (true, 2)));
    let pruning = renderer.pruning();
    let mut dice = Random::seeded(mesh.triangles.len() as u64);
    for number in 0..views {
        let view = random_view(&scene, &mut dice);
        for style in &styles {
            let plan = style.plan(&view, Show::Final).unwrap();
            // A search for hidden faces that found few would rest.
            let short = prune(&plan, &view, &Pruning { rest: Default::default(), ..pruning.clone() });
            let full = renderer.draw(&view, &plan).unwrap();
            // The second of two frames in a row must contain nothing of the first.
            if number == 0 {
                renderer.time_frames(&view, &short.plan, 0, 1).unwrap();
            }
            let picture = renderer.draw(&view, &short.plan).unwrap();
            let difference = full.difference(&picture).unwrap();
            assert!(
                full == picture,
                "{} view {number} in {}: {difference:?} without {:?}",
                mesh.name,
                style.name(),
                short.omissions
            );
        }
    }
}

/// All models there are, by the name of each.
fn all_models() -> Vec<String> {
    let mut models: Vec<String> =
        tinta::mesh::BUILTINS.iter().map(|builtin| format!("builtin:{}", builtin.name)).collect();
    models.extend(PUBLIC_MODELS.into_iter().filter_map(public_model));
    models
}

fn verify_all(backend: Backend, models: &[String], views: usize) {
    let mut renderer = renderer(backend);
    for model in models {
        let mesh = Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
        verify(&mut renderer, &mesh, views);
    }
}

#[test]
fn three_views_of_two_models_in_every_style_are_the_same_bytes_on_both_backends_briefly() {
    for backend in *BACKENDS {
        verify_all(backend, &["builtin:gear", "builtin:open-box"].map(str::to_owned), 3);
    }
}

/// Views of each model by the first backend; `TINTA_VIEWS` overrides it.
const VIEWS: usize = 4;

/// The second backend draws one view for each so many of the first.
const VIEWS_OF_FIRST: usize = 2;

fn views() -> usize {
    let wanted = std::env::var("TINTA_VIEWS").ok();
    wanted.map_or(VIEWS, |views| views.parse().expect("TINTA_VIEWS: write a number of views"))
}

#[test]
#[ignore = "exhaustive: every model from four views in every style, or as many as TINTA_VIEWS says"]
fn every_model_in_every_style_is_the_same_bytes_by_the_first_backend() {
    verify_all(BACKENDS[0], &all_models(), views());
}

#[test]
#[ignore = "exhaustive: every model from two views in every style"]
fn every_model_in_every_style_is_the_same_bytes_by_the_second_backend() {
    verify_all(BACKENDS[1], &all_models(), views().div_ceil(VIEWS_OF_FIRST));
}

fn verify_settings(backends: &[Backend], backgrounds: &[Background], shows: &[Show]) {
    let styles = many_styles();
    for &backend in backends {
        let mut renderer = renderer(backend);
        let pruning = renderer.pruning();
        for &background in backgrounds {
            let settings =
                SceneSettings { background, copies: 2, size: Size { width: 150, height: 90 }, ..Default::default() };
            for scene in [scene_with("builtin:gear", settings.clone()), Scene { background, ..beside("builtin:bust") }]
            {
                for style in &styles {
                    for &show in shows {
                        let Ok(plan) = style.plan(&scene, show) else { continue };
                        let short = prune(&plan, &scene, &pruning);
                        let full = renderer.draw(&scene, &plan).unwrap();
                        let picture = renderer.draw(&scene, &short.plan).unwrap();
                        assert!(full == picture, "{backend:?} {background:?}\n{plan}\n{}", short.plan);
                    }
                }
            }
        }
    }
}

#[test]
fn every_setting_draws_the_same_final_bytes_pruned_briefly() {
    verify_settings(&BACKENDS[..1], &[Background::Transparent], &[Show::Final]);
}

#[test]
#[ignore = "exhaustive: every setting on three backgrounds, all its buffers, with TINTA_FULL_SIZES by both backends"]
fn every_setting_draws_the_same_bytes_pruned() {
    let grey = Background::Color(Color([0.5, 0.25, 0.125]));
    let backgrounds = [Background::Color(Color([1.0; 3])), grey, Background::Transparent];
    let backends = if full_sizes() { &BACKENDS[..] } else { &BACKENDS[..1] };
    verify_settings(backends, &backgrounds, &[Show::Final, Show::Tones, Show::Borders, Show::Map]);
}
