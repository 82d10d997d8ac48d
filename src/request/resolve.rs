//! From a request and its models to a drawing's scene and contents: the one place that makes a scene and decides all that depends on
//! both.
//!
//! Every door begins here. A still picture has its light, the view of a flat model, the projection of a drawing to scale and a camera
//! that has the shadow in view; a moving view keeps its camera and the light chosen before.

use super::{Ground, Request};
use crate::camera::View;
use crate::edges::Class;
use crate::error::Result;
use crate::lines::{DrawingSettings, LineSettings, PageSize, PartRules, Regions, SeenNormals, ground_light};
use crate::mesh::{LoadOptions, Mesh, Normals};
use crate::scene::{Background, Scene, SceneSettings};
use crate::settings::{HasSettings, OptionValue, Options, Value as _};
use crate::styles::{Below, Contents, FarLight, Show, Style};
use glam::DVec3;
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// Distance of the strokes on a cut of a drawing to scale, millimetres on paper.
const HATCHING_MM: f64 = 2.5;

/// The light that shadows follow where a style's tones have none: from the left, eye space.
const LIGHT: [f32; 3] = [-0.4, 1.0, 0.6];

/// A request with nothing left to choose, and its scene.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The request, with the light and the view that were chosen.
    pub request: Request,
    /// The scene.
    pub scene: Scene,
    /// The contents of the drawing.
    pub contents: Contents,
    /// The light of a still picture's tones.
    light: Option<Arc<StillLight>>,
    /// The shadow on the ground, once it was asked for.
    pub(super) shadow: Arc<OnceLock<Regions<()>>>,
}

/// A light, and the scene as it shows it.
#[derive(Debug)]
struct StillLight {
    towards: [f32; 3],
    thresholds: [f64; 2],
    /// Both are made when they are first asked for.
    seen: OnceLock<SeenNormals>,
    lit: OnceLock<Scene>,
}

impl Request {
    /// The contents of the drawing, in a file of pixels or of vectors. A style without vectors is pixels in both; strokes that stand
    /// for tones are those of the vectors in both.
    ///
    /// # Errors
    ///
    /// Those of the options of lines and of drawings.
    pub fn contents(&self, as_vectors: bool) -> Result<Contents> {
        let draws_lines = self.style.style_name().draws_lines();
        let has_strokes = |spacing: &OptionValue| self.show == Show::Final && *spacing != OptionValue::text("none");
        let is_exact = as_vectors || draws_lines || self.options.get("hatch").is_some_and(has_strokes);
        let vectors = self.style.vectors(self.scene.size).filter(|_| is_exact);
        let mut contents = vectors.unwrap_or_else(|| Contents {
            below: Below::Passes(Box::new(self.style.clone())),
            lines: None,
            drawing: DrawingSettings::default(),
            sheet: None,
        });
        // `--no-borders` leaves exact lines out, too.
        let leaves_lines_out = self.style.style_name().has_lines() && !self.style.has_lines();
        let has_lines_over = self.exact_lines && self.show == Show::Final && !draws_lines && !leaves_lines_out;
        if has_lines_over {
            // The same over every style, which leaves out its own borders where it can.
            (contents.lines, contents.drawing) = (Some(LineSettings::default()), DrawingSettings::default());
            if let Below::Passes(style) = &mut contents.below {
                **style = style.without_borders()?;
            }
        }
        if !draws_lines && (has_lines_over || !matches!(contents.below, Below::Passes(_))) {
            DrawingSettings::table().apply(&mut contents.drawing, &self.options)?;
            if let Some(lines) = &mut contents.lines {
                LineSettings::table().apply(lines, &self.options)?;
            }
        }
        (contents.drawing.title, contents.drawing.background) = (self.title(), self.scene.background);
        contents.check().map(|()| contents)
    }

    /// The rules for parts, which all styles follow where they are about surfaces and sections.
    pub(super) fn part_rules(&self) -> Result<PartRules> {
        let rules = self.options.get_key_value("part").map(|(name, rules)| (name.clone(), rules.clone()));
        Ok(LineSettings::from_options(&rules.into_iter().collect())?.parts)
    }

    /// How the models are read: with a cut's strokes as far apart on paper as they should be, if the drawing is to scale; and with
    /// the normals that take no time where no step reads them.
    pub(crate) fn load_options(&self) -> Result<Cow<'_, LoadOptions>> {
        let mut read = Cow::Borrowed(&self.read);
        if self.read.section.is_some() && self.read.section_hatch.is_none() {
            let drawing = self.contents(true)?.drawing;
            if let Some(scale) = drawing.scale {
                read.to_mut().section_hatch = Some(scale.of_model(HATCHING_MM, drawing.units));
            }
        }
        let uncut = self.part_rules()?.uncut();
        if !uncut.is_empty() {
            read.to_mut().uncut = uncut;
        }
        let reads_none = |lines: &LineSettings| {
            !lines.creases_by_normals && !lines.classes.contains(Class::Normal) && lines.parts == PartRules::default()
        };
        match &self.style {
            // One a position: GL's vertices are shared.
            Style::Inking(inking) if !inking.reads_normals() => read.to_mut().normals = Normals::Dachsbacher,
            style if style.lines().is_some_and(|style| reads_none(&style.lines)) => {
                read.to_mut().normals = Normals::Flat;
            }
            _ => {}
        }
        Ok(read)
    }

    /// Resolves a still picture of these models.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`] and [`Request::contents`].
    pub fn resolve(&self, meshes: Vec<Arc<Mesh>>, as_vectors: bool) -> Result<Resolved> {
        self.framed(|settings| Scene::new(meshes, settings), as_vectors)
    }

    /// Resolves a still picture of a scene's models, with the data that it has of them.
    ///
    /// # Errors
    ///
    /// As [`Request::resolve`].
    pub fn resolve_again(&self, known: &Scene, as_vectors: bool) -> Result<Resolved> {
        self.framed(|settings| known.seen_with(settings), as_vectors)
    }

    /// Chooses the camera of a still picture.
    fn framed(&self, scene: impl FnOnce(&SceneSettings) -> Result<Scene>, as_vectors: bool) -> Result<Resolved> {
        let Contents { drawing, sheet, .. } = self.contents(as_vectors)?;
        let mut framed = self.clone();
        // One view is drawn to scale in a parallel projection.
        framed.scene.camera.parallel |= drawing.scale.is_some() && sheet.is_none();
        let mut scene = scene(&framed.scene)?.with_fills(&self.part_rules()?);
        let view = self.suited_view(&scene);
        if view != framed.scene.camera.view {
            framed.scene.camera.view = view;
            framed.options.insert("view".to_owned(), OptionValue::text(view.text()));
            scene = scene.seen_with(&framed.scene)?;
        }
        framed.put_ground(Some(&scene))?;
        if framed.ground == Ground::Shadow {
            framed.put_light(|light, thresholds| light.towards(&scene, thresholds));
            let light = framed.shadow_light(&scene);
            scene = scene.with_shadow_in_view(&framed.scene, light)?;
        }
        framed.still(scene, as_vectors)
    }

    /// Resolves a still picture of a scene whose camera is chosen: with a far light, patches of a tone too small to draw are left out.
    ///
    /// # Errors
    ///
    /// Those of [`Request::contents`].
    pub fn still(&self, scene: Scene, as_vectors: bool) -> Result<Resolved> {
        let mut request = self.clone();
        request.put_ground(None)?;
        let light = self.style.far_tones().map(|(light, thresholds)| {
            let (seen, thresholds) = (OnceLock::new(), thresholds.map(f64::from));
            let best = || seen.get_or_init(|| SeenNormals::of(&scene)).best_light(thresholds);
            let towards = light.known().unwrap_or_else(best);
            request.put_light(|_, _| towards);
            Arc::new(StillLight { towards, thresholds, seen, lit: OnceLock::new() })
        });
        Ok(Resolved { contents: request.contents(as_vectors)?, request, scene, light, shadow: Arc::default() })
    }

    /// Resolves a view of a turning scene, with this light of its tones or one chosen for it: all patches stay. It has a shadow where the
    /// request asks for one.
    ///
    /// # Errors
    ///
    /// Those of [`Request::contents`].
    pub fn moving(&self, scene: Scene, light: Option<[f32; 3]>, as_vectors: bool) -> Result<Resolved> {
        let mut request = self.clone();
        request.put_light(|chosen, thresholds| light.unwrap_or_else(|| chosen.towards(&scene, thresholds)));
        Ok(Resolved { contents: request.contents(as_vectors)?, request, scene, light: None, shadow: Arc::default() })
    }

    /// Resolves pictures of an animation, which share the first one's light.
    ///
    /// # Errors
    ///
    /// Those of [`Request::contents`].
    pub(crate) fn animation(&self, scenes: Vec<Scene>, as_vectors: bool) -> Result<Vec<Resolved>> {
        let mut light = None;
        let views = scenes.into_iter().map(|scene| {
            let view = self.moving(scene, light, as_vectors)?;
            light = view.light();
            Ok(view)
        });
        views.collect()
    }

    /// Resolves the views of a turn around a scene.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::turntable`] and [`Request::contents`].
    pub fn turn(&self, scene: Scene, views: u32, as_vectors: bool) -> Result<Vec<Resolved>> {
        let cameras = scene.turntable(&self.scene.camera, views)?;
        self.animation(cameras.into_iter().map(|camera| Scene { camera, ..scene.clone() }).collect(), as_vectors)
    }

    /// The models under the request's settings, for views that the caller chooses.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`].
    pub fn placed(&self, meshes: Vec<Arc<Mesh>>) -> Result<Scene> {
        Ok(Scene::new(meshes, &self.scene)?.with_fills(&self.part_rules()?))
    }

    /// The view, or in place of a look's the one that suits the models.
    pub(crate) fn suited_view(&self, scene: &Scene) -> View {
        let view = self.scene.camera.view;
        let is_free = self.is_of_look("view") && !["eye", "target"].iter().any(|name| self.options.contains_key(*name));
        if is_free { scene.suited(view) } else { view }
    }

    /// Gives the tones a light if they name none; a recipe names it.
    fn put_light(&mut self, choose: impl FnOnce(FarLight, [f32; 2]) -> [f32; 3]) {
        if let Some((light, thresholds)) = self.style.far_tones().filter(|(light, _)| light.known().is_none()) {
            let chosen = choose(light, thresholds);
            self.options.insert("tone-light".to_owned(), OptionValue::text(chosen.text()));
            self.style.put_far_light(chosen);
        }
    }

    /// Decides whether the models have a shadow where the request leaves that open; a recipe names it. Standing models have one in still
    /// pictures on a coloured ground whose camera is framed around them, but not on paper or where strokes stand for tones.
    fn put_ground(&mut self, framed: Option<&Scene>) -> Result<()> {
        if self.ground != Ground::Auto {
            return Ok(());
        }
        let DrawingSettings { page_size, is_for_pen, hatching, .. } = self.contents(true)?.drawing;
        let is_drawing = matches!(page_size, PageSize::Paper(_)) || is_for_pen || hatching.spacing.is_some();
        let shows_all = self.scene.camera.eye.is_none() && self.scene.background != Background::Transparent;
        let stands = shows_all && !is_drawing && framed.is_some_and(Scene::stands);
        self.ground = if stands { Ground::Shadow } else { Ground::None };
        self.options.insert("ground".to_owned(), OptionValue::text(self.ground.text()));
        Ok(())
    }

    /// The direction towards the light of the shadow on the ground, world space.
    pub(super) fn shadow_light(&self, scene: &Scene) -> DVec3 {
        ground_light(
            scene,
            self.style.far_tones().map_or(LIGHT, |(light, thresholds)| light.towards(scene, thresholds)),
        )
    }
}

impl Resolved {
    /// The same scene drawn with more options, which change how lines and areas look, and with another title if one is given.
    ///
    /// # Errors
    ///
    /// Those of [`Request::from_given`] and [`Request::contents`].
    pub fn with_options(&self, more: Options, title: Option<String>) -> Result<Self> {
        let mut options = self.request.options.clone();
        options.extend(more);
        let style = OptionValue::text(self.request.style.name());
        let (models, title) = (self.request.models.clone(), title.or(self.request.title.clone()));
        // Without a style among them they are of lines all the same.
        let named = options.clone().into_iter().chain([("style".to_owned(), style)]).collect();
        let request = Request { models, title, options, ..Request::from_given(&named)? };
        Ok(Self { contents: request.contents(true)?, request, ..self.clone() })
    }

    /// The scene as its tones show it: in a still picture without patches too small to draw. Its normals are others, so lines are found
    /// in the scene itself.
    pub fn lit(&self) -> &Scene {
        let lit = |light: &StillLight| {
            let seen = light.seen.get_or_init(|| SeenNormals::of(&self.scene));
            seen.lit(&self.scene, light.towards, light.thresholds)
        };
        self.light.as_ref().map_or(&self.scene, |light| light.lit.get_or_init(|| lit(light)))
    }

    /// The light of the tones that was chosen or given, eye space.
    pub fn light(&self) -> Option<[f32; 3]> {
        self.request.style.far_tones()?.0.known()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::{ModelCache, OptionLayer, WantedLines};
    use crate::styles::StyleName;

    fn request(light: &str) -> Request {
        request_with(light, &[])
    }

    fn request_with(light: &str, more: &[(&str, &str)]) -> Request {
        let options =
            [("tone-light", light), ("tone-thresholds", "0.2,0.56"), ("normals", "lasting"), ("view", "30,23")];
        let options = options.iter().chain(more).map(|(name, value)| ((*name).to_owned(), OptionValue::text(*value)));
        let layers = [OptionLayer::Style(StyleName::Ink), OptionLayer::Given(options.collect())];
        Request::from_layers(&layers).unwrap().0.with_models(vec!["builtin:bust".to_owned()])
    }

    fn meshes(request: &Request) -> Vec<Arc<Mesh>> {
        request.models(&ModelCache::for_one()).unwrap().meshes
    }

    #[test]
    fn the_options_name_the_light_that_was_chosen_and_drawing_again_gives_the_same_scene() {
        let automatic = request("auto");
        let first = automatic.resolve(meshes(&automatic), false).unwrap();
        let Some(OptionValue::Text(light)) = first.request.options.get("tone-light") else { panic!("{first:?}") };
        assert_eq!(light.split(',').count(), 3, "{light}");
        let again = request(light);
        let second = again.resolve(meshes(&again), false).unwrap();
        assert_eq!(second.request.options, again.options);
        assert_eq!(first.lit().objects[0].mesh.normals, second.lit().objects[0].mesh.normals);
        assert_eq!(first.plan().unwrap().passes, second.plan().unwrap().passes);
    }

    #[test]
    fn lines_read_no_normals_but_where_a_class_is_of_them() {
        let normals = |classes: &str, parts: &str| {
            let options = [("style", "lines"), ("classes", classes), ("part", parts), ("normals", "lasting")];
            let options = options.map(|(name, value)| (name.to_owned(), OptionValue::text(value)));
            Request::from_given(&options.into_iter().collect()).unwrap().load_options().unwrap().normals
        };
        assert_eq!(normals("crease", "none"), Normals::Flat);
        assert_eq!(normals("crease,normal", "none"), Normals::Lasting);
        assert_eq!(normals("crease", "*: classes=normal"), Normals::Lasting);
    }

    #[test]
    fn a_standing_model_has_a_shadow_but_on_paper_and_under_strokes() {
        let ground = |more: &[(&str, &str)]| {
            let asked = request_with("auto", &[&[("ground", "auto")], more].concat());
            let resolved = asked.resolve(meshes(&asked), true).unwrap().request;
            assert_eq!(resolved.options["ground"], OptionValue::text(resolved.ground.text()));
            resolved.ground
        };
        assert_eq!(ground(&[]), Ground::Shadow);
        assert_eq!([ground(&[("page", "A5")]), ground(&[("hatch", "auto")])], [Ground::None; 2]);
    }

    #[test]
    fn the_light_moves_no_line() {
        let found = |light: &str, silhouette: &str| {
            let more = [("classes", "all"), ("silhouette", silhouette)];
            let asked = request_with(light, &more);
            let resolved = asked.resolve(meshes(&asked), true).unwrap();
            let drawn = resolved.drawn_lines(WantedLines::default(), &crate::lines::Progress::default()).unwrap();
            assert!(!Arc::ptr_eq(&resolved.lit().objects[0].mesh, &resolved.scene.objects[0].mesh), "patches go");
            drawn.lines.segments.iter().map(|segment| (segment.class, segment.ends_px)).collect::<Vec<_>>()
        };
        for silhouette in ["exact", "smooth"] {
            let [front, side] = ["0,0,1", "-1,1,0.2"].map(|light| found(light, silhouette));
            assert!(front.len() > 100 && front == side, "{silhouette}: {} and {} lines", front.len(), side.len());
        }
    }

    #[test]
    fn a_turn_keeps_the_light_of_its_first_view_and_a_still_picture_has_its_own() {
        let automatic = request("auto");
        let scene = automatic.placed(meshes(&automatic)).unwrap();
        let views = automatic.turn(scene.clone(), 6, false).unwrap();
        let lights: Vec<_> = views.iter().map(|view| view.light().unwrap()).collect();
        assert!(lights.iter().all(|light| *light == lights[0]), "{lights:?}");
        let own = |view: &Resolved| automatic.still(view.scene.clone(), false).unwrap().light().unwrap();
        assert_eq!(own(&views[0]), lights[0]);
        let others: Vec<_> = views.iter().map(own).collect();
        assert!(others.iter().any(|light| *light != lights[0]), "{others:?}");
        // Whatever was drawn before: nothing remembers it.
        assert_eq!(views.iter().rev().map(own).rev().collect::<Vec<_>>(), others);
    }
}
