//! The scene of a still picture, with the light of its tones: the one place where pixels, lines and areas get both.

use super::Request;
use crate::camera::View;
use crate::error::Result;
use crate::lines::lit_scene;
use crate::mesh::{LoadOptions, Mesh};
use crate::scene::Scene;
use crate::settings::{OptionValue, Options, Value as _};
use crate::styles::{FarLight, LineStyle};
use std::borrow::Cow;
use std::sync::Arc;

/// Distance of the strokes on a cut of a drawing to scale, millimetres on paper.
const HATCHING_MM: f64 = 2.5;

/// The thickness of a sheet, as a share of its length.
const FLAT: f64 = 1e-3;

impl Request {
    /// Puts the scene of a still picture together, as [`Request::lit`] has it.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`].
    pub(crate) fn scene(&self, meshes: Vec<Arc<Mesh>>) -> Result<Scene> {
        let mut settings = Cow::Borrowed(&self.scene);
        if self.is_to_scale()? && !settings.camera.parallel {
            settings.to_mut().camera.parallel = true;
        }
        let mut scene = Scene::new(meshes, &settings)?;
        if let Some(view) = self.view_of_sheet(&scene) {
            settings.to_mut().camera.view = view;
            scene = scene.seen_with(&settings)?;
        }
        if let Some(light) = self.shadow_light(&scene) {
            scene = scene.with_shadow_in_view(&settings, light)?;
        }
        Ok(self.lit(scene))
    }

    /// Whether one view is drawn to scale, which is a parallel projection's.
    fn is_to_scale(&self) -> Result<bool> {
        Ok(self.line_style()?.is_some_and(|style| style.drawing.scale.is_some() && style.sheet.is_none()))
    }

    /// How the models are read: with a cut's strokes as far apart on paper as they should be, if the drawing is to scale.
    pub(super) fn read_to_scale(&self) -> Result<Cow<'_, LoadOptions>> {
        let scale = |style: LineStyle| Some(style.drawing.scale?.of_model(HATCHING_MM, style.drawing.units));
        let spacing = match (self.read.section, self.read.section_hatch) {
            (Some(_), None) => self.line_style()?.and_then(scale),
            _ => None,
        };
        Ok(match spacing {
            Some(_) => Cow::Owned(LoadOptions { section_hatch: spacing, ..self.read.clone() }),
            None => Cow::Borrowed(&self.read),
        })
    }

    /// The view along the normal of models that are a flat sheet, in place of a look's: from there a sheet is seen as what it is.
    fn view_of_sheet(&self, scene: &Scene) -> Option<View> {
        let is_free = self.is_of_look("view") && !["eye", "target"].iter().any(|name| self.options.contains_key(*name));
        let extent = scene.extent();
        let thin = (0..3).find(|axis| extent[*axis] <= FLAT * extent.max_element()).filter(|_| is_free)?;
        ["right", "top", "front"][thin].parse().ok()
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

    /// The options of a recipe: those given, with the style of lines alone, and the view and the light that were chosen for a scene.
    pub(super) fn options_for(&self, scene: &Scene) -> Options {
        let mut options = self.options.clone();
        if self.style.lines().is_some() {
            // A file's name does not ask for it.
            options.entry("style".to_owned()).or_insert_with(|| OptionValue::text(self.style.name()));
        }
        if let Some(view) = self.view_of_sheet(scene) {
            options.insert("view".to_owned(), OptionValue::text(view.text()));
        }
        if let (Some((FarLight::Auto, _)), Some(light)) = (self.style.far_tones(), scene.tone_light.get()) {
            options.insert("tone-light".to_owned(), OptionValue::text(light.text()));
        }
        options
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::{ModelCache, OptionLayer};
    use crate::styles::StyleName;

    fn request(light: &str) -> Request {
        let options =
            [("tone-light", light), ("tone-thresholds", "0.2,0.56"), ("normals", "lasting"), ("view", "30,23")];
        let options = options.map(|(name, value)| (name.to_owned(), OptionValue::text(value)));
        let layers = [OptionLayer::Style(StyleName::Ink), OptionLayer::Given(options.into_iter().collect())];
        Request::from_layers(&layers).unwrap().0.with_models(vec!["builtin:bust".to_owned()])
    }

    fn scene(request: &Request) -> Scene {
        request.scene(request.models(&ModelCache::for_one()).unwrap().meshes).unwrap()
    }

    #[test]
    fn a_recipe_names_the_light_that_was_chosen_and_drawing_again_gives_the_same_scene() {
        let automatic = request("auto");
        let first = scene(&automatic);
        let options = automatic.options_for(&first);
        let Some(OptionValue::Text(light)) = options.get("tone-light") else { panic!("{options:?}") };
        assert_eq!(light.split(',').count(), 3, "{light}");
        let again = request(light);
        let second = scene(&again);
        assert_eq!(again.options_for(&second), again.options);
        assert_eq!(first.objects[0].mesh.normals, second.objects[0].mesh.normals);
        let plan = |request: &Request, scene: &Scene| request.style.plan(scene, request.show).unwrap();
        assert_eq!(plan(&automatic, &first).passes, plan(&again, &second).passes);
    }

    #[test]
    fn a_turn_keeps_the_light_of_its_first_view_and_another_picture_chooses_its_own() {
        let automatic = request("auto");
        let meshes = automatic.models(&ModelCache::for_one()).unwrap().meshes;
        let first = Scene::new(meshes, &automatic.scene).unwrap();
        let cameras = first.turntable(&automatic.scene.camera, 6).unwrap();
        let views: Vec<Scene> = cameras.into_iter().map(|camera| Scene { camera, ..first.clone() }).collect();
        let (light, thresholds) = automatic.style.far_tones().unwrap();
        let lights: Vec<[f32; 3]> = views.iter().map(|view| light.towards(view, thresholds)).collect();
        assert!(lights.iter().all(|light| *light == lights[0]), "{lights:?}");
        assert_eq!(first.tone_light.get(), Some(&lights[0]));
    }
}
