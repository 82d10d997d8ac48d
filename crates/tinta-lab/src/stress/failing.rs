//! Draws with a failing driver, and checks the program's state afterwards.

use super::Shape;
use super::outcome::Outcome;
use super::variants::Variant;
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;
use tinta::error::{Error, Result};
use tinta::gl::{Backend, Fault};
use tinta::mesh::LoadOptions;
use tinta::renderer::Renderer;
use tinta::scene::{Scene, SceneSettings, Size};

/// Draws a cube with the fault; then `sound`, another context of the same thread, must draw it unaffected.
pub(super) fn outcome(backend: Backend, fault: Fault, variant: &Variant, sound: &mut Renderer) -> Outcome {
    let mut attempt = || -> Result<Outcome> {
        let scene = scene()?;
        let before = sound.render(&scene, &variant.style)?;
        let failed =
            Renderer::with_fault(backend, fault).and_then(|mut failing| failing.render(&scene, &variant.style));
        if sound.render(&scene, &variant.style)? != before {
            return Err(Error::gl("drawing beside a context that failed", "another picture than before"));
        }
        Ok(match failed {
            Ok(_) => Outcome::Rendered(Default::default()),
            Err(error) => Outcome::refused(&error),
        })
    };
    attempt().unwrap_or_else(|error| Outcome::refused(&error))
}

fn scene() -> Result<Scene> {
    let mesh = Shape::Cube.mesh(1.0, DVec3::ZERO, Path::new(""), &LoadOptions::default())?;
    let size = Size { width: 64, height: 64 };
    Scene::new(vec![Arc::new(mesh)], &SceneSettings { size, ..SceneSettings::default() })
}
