use super::*;
use crate::gl::context::{Context, witnesses};
use crate::mesh::Mesh;
use crate::scene::SceneSettings;
use crate::styles::{Show, Style, StyleName};
use std::sync::Arc;

#[test]
fn polygons_are_not_smoothed_whatever_the_driver_was_told_before() {
    // Errata D13.
    let settings = SceneSettings { size: Size { width: 16, height: 16 }, ..SceneSettings::default() };
    let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap();
    let plan = Style::named(StyleName::Inking).plan(&scene, Show::Final).unwrap();
    for backend in witnesses() {
        let mut context = Context::open(backend, None).unwrap_or_else(|error| panic!("{error}"));
        context.resize(scene.size).unwrap();
        let _current = context.enter().unwrap();
        let gl = context.gl();
        let mut resources = Resources::new(gl);
        resources.prepare(&scene, &plan).unwrap();
        resources.begin_tile(&plan, Tile::whole(scene.size)).unwrap();
        for pass in &plan.passes {
            resources.begin(pass.target, pass.scissor).unwrap();
            for step in &pass.steps {
                // SAFETY: the context is current; the name is of GL 2.1.
                unsafe { gl.glow.enable(glow::POLYGON_SMOOTH) };
                resources.step(&scene, step).unwrap();
                // SAFETY: as above.
                let is_smoothed = unsafe { gl.glow.is_enabled(glow::POLYGON_SMOOTH) };
                assert_eq!(is_smoothed, !matches!(step, Step::Draw(_)), "{backend:?}: {step}");
            }
        }
        resources.clear();
    }
}
