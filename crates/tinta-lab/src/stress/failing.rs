//! Draws with a failing driver, and checks the program's state afterwards.

use super::cases::Drawing;
use super::drawing::scene;
use super::outcome::Outcome;
use super::variants::Variant;
use std::path::Path;
use tinta::error::{Error, Result};
use tinta::gl::{Backend, Fault};
use tinta::mesh::LoadOptions;
use tinta::renderer::Renderer;

/// Draws a cube with the fault; then `sound`, another context of the same thread, must draw it unaffected.
pub(super) fn outcome(backend: Backend, fault: Fault, variant: &Variant, sound: &mut Renderer) -> Outcome {
    let mut attempt = || -> Result<Outcome> {
        let cube = Drawing::default();
        let scene = scene(&cube, cube.size, Path::new(""), &LoadOptions::default())?;
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
