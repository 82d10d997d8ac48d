//! The page's drawing parts: a canvas's renderer, a scene, and its view.

use crate::errors::{said, unreadable};
use crate::model::{Model, asked};
use serde_json::json;
use tinta::camera::CameraSettings;
use tinta::glam::DVec2;
use tinta::lines::Progress;
use tinta::orbit::Orbit;
use tinta::pixel::Explanation;
use tinta::plan::Step;
use tinta::recipe::Driver;
use tinta::renderer::Renderer;
use tinta::request::{LINES_AT_ONCE_MS, Request, Resolved};
use tinta::settings::HasSettings;
use tinta::styles::{Show, coarse};
use tinta::{Picture, Scene, SceneSettings, Style, StyleName, View};
use tinta_lab::measure::Ink;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;
use web_sys::HtmlCanvasElement;

/// Draws one scene in any style, from wherever it is turned to.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Pane {
    renderer: Renderer,
    scene: Option<Scene>,
    orbit: Orbit,
    drawn: Option<Picture>,
    /// How long the last search for exact lines took, milliseconds.
    lines_ms: f64,
    /// The light of the tones in the last view.
    light: Option<[f32; 3]>,
}

#[wasm_bindgen]
impl Pane {
    /// On this canvas, which the page need not show.
    ///
    /// # Errors
    ///
    /// If WebGL is missing or too limited.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: HtmlCanvasElement) -> Result<Pane, JsError> {
        let renderer = Renderer::on_canvas(canvas).map_err(said)?;
        Ok(Self { renderer, scene: None, orbit: Orbit::default(), drawn: None, lines_ms: f64::INFINITY, light: None })
    }

    /// The browser's graphics context, as JSON.
    pub fn context(&self) -> String {
        json!(self.renderer.context()).to_string()
    }

    /// Shows this model.
    ///
    /// # Errors
    ///
    /// If it is too large for a scene.
    pub fn show(&mut self, model: &Model) -> Result<(), JsError> {
        (self.scene, self.light) = (Some(model.placed(&Request::default())?), None);
        Ok(())
    }

    /// Draws the scene with these options, in the faster style of a moving model if it may be coarse, and keeps the picture; returns
    /// its width.
    ///
    /// # Errors
    ///
    /// Those of the options, the style and the browser.
    pub fn draw(&mut self, options: &str, show: &str, is_coarse: bool) -> Result<u32, JsError> {
        let mut request = picture_asked(options, show)?;
        // A turning model has the style's own borders where exact lines take too long.
        request.exact_lines &= !is_coarse || self.lines_ms < LINES_AT_ONCE_MS;
        if is_coarse && self.renderer.context().draw_buffers > 1 {
            request.style = coarse(&request.style);
        }
        let view = match is_coarse {
            true => request.moving(self.seen(&request)?, self.light, false).map_err(said)?,
            false => self.still(&request)?,
        };
        self.light = view.light().or(self.light);
        let around = view.around(&Progress::default()).map_err(said)?;
        if view.contents.lines.is_some() {
            self.lines_ms = around.found_ms;
        }
        let (_, pruned) = view.plans(&mut self.renderer).map_err(said)?;
        let picture = around.drawn(&view, &pruned.plan, &mut self.renderer).map_err(said)?;
        let width = picture.size.width;
        self.drawn = Some(picture);
        Ok(width)
    }

    /// The picture last drawn: red, green, blue, alpha, from the top.
    pub fn pixels(&self) -> Vec<u8> {
        self.drawn.as_ref().map(|picture| picture.pixels.clone()).unwrap_or_default()
    }

    /// The picture last drawn as a PNG file, with the recipe it was drawn by: these options, of this model.
    ///
    /// # Errors
    ///
    /// Before the first drawing.
    pub fn png(&self, options: &str, model: &Model) -> Result<Vec<u8>, JsError> {
        let picture = self.drawn.as_ref().ok_or_else(|| JsError::new("nothing was drawn yet"))?;
        let driver = Driver::new(self.renderer.context());
        let request = model.request(StyleName::ThreePass, options)?;
        let recipe = model.recipe(&self.still(&request)?, Some(driver));
        picture.png_bytes(recipe.note().as_ref()).map_err(said)
    }

    /// The passes of the drawing, each with its programs' shaders, as JSON.
    ///
    /// # Errors
    ///
    /// Those of [`Pane::draw`].
    pub fn passes(&self, options: &str, show: &str) -> Result<String, JsError> {
        let request = picture_asked(options, show)?;
        let plan = self.still(&request)?.plan().map_err(said)?;
        let passes: Vec<_> = plan
            .passes
            .iter()
            .map(|pass| {
                let mut shaders: Vec<&str> = Vec::new();
                for step in &pass.steps {
                    if let Step::Draw(draw) = step
                        && let Some(program) = &draw.program
                    {
                        shaders.push(&program.vertex);
                        shaders.extend(program.fragments.iter().map(|fragment| &**fragment));
                    }
                }
                shaders.dedup();
                json!({ "name": pass.name, "shaders": shaders })
            })
            .collect();
        serde_json::to_string(&passes).map_err(unreadable)
    }

    /// The ink of these options' lines, as the darkness of each pixel; `None` for a style without lines.
    ///
    /// # Errors
    ///
    /// Those of [`Pane::draw`].
    pub fn ink(&mut self, options: &str) -> Result<Option<Vec<u8>>, JsError> {
        let request = asked(StyleName::ThreePass, options)?;
        let view = self.still(&request)?;
        Ok(Ink::of_style(&mut self.renderer, view.lit(), &view.request.style).map_err(said)?.map(|ink| ink.darkness))
    }

    /// Why a pixel of the drawing, right and down from its upper left corner, has its colour: each pass with each statement of its
    /// shaders and its value. A supersampled pixel has several colours, so the picture is drawn once for it.
    ///
    /// # Errors
    ///
    /// Those of [`Pane::draw`], and for background.
    pub fn why(&mut self, options: &str, x: f64, y: f64) -> Result<String, JsError> {
        let request = asked(StyleName::ThreePass, options)?;
        let view = self.still(&request)?;
        let mut style = view.request.style.clone();
        let is_supersampled = style.plan(view.lit(), Show::Final).map_err(said)?.supersample > 1;
        if is_supersampled && let Some(setting) = Style::table().find(&style, "supersample") {
            setting.set(&mut style, "1").map_err(said)?;
        }
        let why = Explanation::of(&style, view.lit(), &mut self.renderer, DVec2::new(x, y)).map_err(said)?;
        Ok(format!("{}{why}", if is_supersampled { "As drawn once, without “Supersample”:\n" } else { "" }))
    }

    /// From where the scene is seen, as [`Pane::set_orbit`] takes it.
    pub fn orbit(&self) -> String {
        let Orbit { view, zoom, pan, parallel, fov_y_degrees } = &self.orbit;
        let View { azimuth_degrees, elevation_degrees } = view;
        let numbers = [*azimuth_degrees, *elevation_degrees, *zoom, pan[0], pan[1], *fov_y_degrees];
        let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
        format!("{},{}", words.join(","), if *parallel { "parallel" } else { "perspective" })
    }

    /// Sets the view from a link; invalid parts change nothing.
    #[wasm_bindgen(js_name = setOrbit)]
    pub fn set_orbit(&mut self, words: &str) {
        let numbers: Vec<f64> = words.split(',').map_while(|word| word.parse().ok()).collect();
        let [azimuth_degrees, elevation_degrees, zoom, right, up, fov_y_degrees] = numbers[..] else { return };
        if !numbers.iter().all(|number| number.is_finite()) {
            return;
        }
        let parallel = words.ends_with(",parallel");
        self.orbit = Orbit { parallel, fov_y_degrees, ..Orbit::default() };
        self.orbit.look_from(View { azimuth_degrees, elevation_degrees: elevation_degrees.clamp(-90.0, 90.0) });
        self.orbit.zoom_by(zoom);
        self.orbit.pan = [right.clamp(-2.0, 2.0), up.clamp(-2.0, 2.0)];
    }

    /// Uses these shaders instead of those built in: JSON, texts by their paths; an empty object takes them back.
    ///
    /// # Errors
    ///
    /// If one of them is refused.
    pub fn replace_shaders(&mut self, shaders: &str) -> Result<(), JsError> {
        let shaders = serde_json::from_str(shaders).map_err(unreadable)?;
        self.renderer.replace_shaders(shaders).map_err(said)
    }

    /// How many objects of WebGL there are.
    pub fn live_objects(&self) -> usize {
        self.renderer.live_objects()
    }

    /// Turns by a drag to the right and down, shares of the picture's height.
    pub fn turn(&mut self, right: f64, down: f64) {
        self.orbit.turn(right, down);
    }

    /// Moves the scene with a drag to the right and down, shares of the picture's height.
    #[wasm_bindgen(js_name = moveBy)]
    pub fn move_by(&mut self, right: f64, down: f64) {
        self.orbit.move_by(right, down);
    }

    /// Brings the scene nearer by this factor.
    pub fn zoom(&mut self, factor: f64) {
        self.orbit.zoom_by(factor);
    }

    /// Looks from here at the whole scene: a view as the command line has it, or in place of a look's the one that suits the model.
    ///
    /// # Errors
    ///
    /// If the view is unknown.
    pub fn look(&mut self, view: &str, is_of_look: Option<bool>) -> Result<(), JsError> {
        let view: View = view.parse().map_err(|error| JsError::new(&format!("{error}")))?;
        let scene = self.scene.as_ref().filter(|_| is_of_look == Some(true));
        self.orbit.look_from(scene.map_or(view, |scene| scene.suited(view)));
        Ok(())
    }

    /// Looks as at first.
    pub fn reset(&mut self) {
        self.orbit = Orbit::default();
    }

    /// Changes between perspective and parallel projection.
    pub fn project(&mut self) {
        self.orbit.parallel = !self.orbit.parallel;
    }

    /// The options that say from where the scene is seen: JSON.
    ///
    /// # Errors
    ///
    /// Where the camera is refused.
    pub fn camera(&self, options: &str) -> Result<String, JsError> {
        let settings = self.settings(&asked(StyleName::ThreePass, options)?)?;
        let camera = SceneSettings { camera: settings.camera, ..SceneSettings::default() };
        serde_json::to_string(&camera.to_options().map_err(said)?).map_err(unreadable)
    }
}

impl Pane {
    fn settings(&self, request: &Request) -> Result<SceneSettings, JsError> {
        let settings = request.scene.clone();
        if ["eye", "target", "view"].iter().any(|name| request.options.contains_key(*name)) {
            return Ok(settings);
        }
        let scene = self.scene.as_ref().ok_or_else(|| JsError::new("no model is shown yet"))?;
        // The lens is the scene's; a key changes the projection that it has.
        let CameraSettings { fov_y_degrees, parallel, .. } = settings.camera;
        let orbit = Orbit { fov_y_degrees, parallel: self.orbit.parallel != parallel, ..self.orbit.clone() };
        let camera = orbit.settings(scene, &settings).map_err(said)?;
        Ok(SceneSettings { camera, ..settings })
    }

    /// The scene in view.
    fn seen(&self, request: &Request) -> Result<Scene, JsError> {
        let scene = self.scene.as_ref().ok_or_else(|| JsError::new("no model is shown yet"))?;
        scene.seen_with(&self.settings(request)?).map_err(said)
    }

    /// The scene in view as a still picture: its tones have the light of this view.
    fn still(&self, request: &Request) -> Result<Resolved, JsError> {
        request.still(self.seen(request)?, false).map_err(said)
    }
}

/// The request of the options, with one of the style's pictures.
fn picture_asked(options: &str, show: &str) -> Result<Request, JsError> {
    let mut request = asked(StyleName::ThreePass, options)?;
    request.show = show.parse().map_err(|error| JsError::new(&format!("{error}")))?;
    Ok(request)
}
