//! The scene of a still picture, with the light of its tones: the one place where pixels, lines and areas get both.

use super::Request;
use crate::error::Result;
use crate::lines::lit_scene;
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::settings::{OptionValue, Options, Value as _};
use crate::styles::FarLight;
use std::sync::Arc;

impl Request {
    /// Puts the scene of a still picture together, as [`Request::lit`] has it.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`].
    pub fn scene(&self, meshes: Vec<Arc<Mesh>>) -> Result<Scene> {
        Scene::new(meshes, &self.scene).map(|scene| self.lit(scene))
    }

    /// Returns a scene for a still picture: if the style has tones by a far light, with that light, and without patches of a tone that
    /// are too small to draw.
    #[must_use]
    pub fn lit(&self, scene: Scene) -> Scene {
        let Some((light, thresholds)) = self.style.far_tones() else { return scene };
        let known = match light {
            FarLight::Auto => scene.tone_light.get().copied(),
            FarLight::Towards(direction) => Some(direction),
        };
        lit_scene(scene, known, thresholds.map(f64::from))
    }

    /// The options of a recipe: those given, with the light that was chosen for a scene.
    pub(super) fn options_for(&self, scene: &Scene) -> Options {
        let mut options = self.options.clone();
        if let (Some((FarLight::Auto, _)), Some(light)) = (self.style.far_tones(), scene.tone_light.get()) {
            options.insert("tone-light".to_owned(), OptionValue::text(light.text()));
        }
        options
    }
}
