//! The viewer as a value: the scene, the view, the styles, and how events change them. It uses neither a window nor GL.

use crate::camera::CameraSettings;
use crate::camera::View;
use crate::error::Result as DrawingResult;
use crate::lines::PartRules;
use crate::orbit::Orbit;
use crate::preset::{LOOKS, Look, Preset};
use crate::request::{OptionLayer, Request};
use crate::scene::{SceneSettings, Size};
use crate::settings::HasSettings;
use crate::styles::{Style, StyleName};
use crate::window::values::buffer::{Buffer, buffers};
use crate::window::values::controls::{self, Group};
use crate::window::values::event::{Effect, Layout, Save, Side, ViewerEvent};
use crate::window::values::line_style::LinesShown;

/// The complete state of the viewer's pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewerState {
    /// The models, as the user named them.
    pub models: Vec<String>,
    /// The view of them.
    pub orbit: Orbit,
    /// The request of each side. It keeps the options of other styles, too. Scene and reading are the same on both sides; a
    /// pane gives the scene's size, and the orbit its view.
    pub(in crate::window) requests: [Request; 2],
    /// The side that number keys and the panel are for.
    pub active: Side,
    /// How the two styles are laid out.
    pub layout: Layout,
    /// Where the divider is, share of the width.
    pub divider: f64,
    /// The shown buffer of the styles.
    pub buffer: Buffer,
    /// Whether pictures may be coarser while the view moves.
    pub is_coarse_while_moving: bool,
    /// Size of the drawing area, pixels.
    pub area: Size,
    /// Whether the panel is shown.
    pub has_panel: bool,
    /// Whether the starting hint is shown, until the first event.
    pub has_hint: bool,
    /// Whether the key sheet is.
    pub has_key_sheet: bool,
    /// Whether the pixel under the pointer is explained.
    pub explains: bool,
    /// That pixel: its side, and its place right and down in the side's picture.
    pub pointed: Option<(Side, [u32; 2])>,
    /// The step whose listing is shown, counted from the last.
    pub passes_on: i32,
    /// Whether times and errors are.
    pub has_price: bool,
    /// Whether the whole screen is covered.
    pub is_full_screen: bool,
    /// A sentence about the last event, if any.
    pub message: Option<String>,
}

/// The divider stays this share of the width away from both edges.
const DIVIDER_MARGIN: f64 = 0.02;

/// Pixels between the panes of a difference.
const GAP_PX: u32 = 2;

/// Largest side of a drawing area that an event may set.
const LARGEST_SIDE: u32 = 16_384;

impl Default for ViewerState {
    fn default() -> Self {
        Self {
            models: Vec::new(),
            orbit: Orbit::default(),
            requests: [StyleName::ThreePass, StyleName::Inking].map(Request::of_style),
            active: Side::Left,
            layout: Layout::Single,
            divider: 0.5,
            buffer: Buffer::default(),
            is_coarse_while_moving: false,
            area: SceneSettings::default().size,
            has_panel: false,
            has_hint: false,
            has_key_sheet: false,
            explains: false,
            pointed: None,
            passes_on: 0,
            has_price: false,
            is_full_screen: false,
            message: None,
        }
    }
}

/// A pane: its place in the drawing area, pixels from the left, and its content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pane {
    /// The pane's content.
    pub content: Content,
    /// Its left edge.
    pub left: u32,
    /// Its size.
    pub size: Size,
}

/// The content of a pane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// A side's picture.
    Picture(Side),
    /// Both sides' pictures, cut at this column.
    Cut(u32),
    /// The difference of both.
    Difference,
}

/// The contents of a request's drawing in any scene.
fn of_any_scene(Request { style, show, exact_lines, options, .. }: Request) -> Request {
    Request { style, show, exact_lines, options, ..Request::default() }
}

impl ViewerState {
    /// The first state for these models, seen so.
    pub fn new(models: Vec<String>, orbit: Orbit) -> Self {
        Self { models, orbit, ..Self::default() }
    }

    /// Draws this on the left side, and its style's neighbour in the options of the right one; its scene and reading are both sides'.
    #[cfg(feature = "cli")]
    pub(crate) fn put_request(&mut self, request: &Request) {
        self.put_scene(request.scene.clone());
        let right = Request { exact_lines: false, ..controls::in_style(request, self.style(Side::Right).style_name()) };
        self.requests = [request.clone(), right];
    }

    /// The style a side shows.
    pub fn style(&self, side: Side) -> &Style {
        &self.requests[side as usize].style
    }

    /// The request of a side's picture in its buffer, of any scene.
    pub(in crate::window) fn drawn(&self, side: Side) -> Request {
        of_any_scene(self.buffer.drawn(&self.requests[side as usize]))
    }

    /// How a side shows exact lines, or strokes that stand for tones.
    pub(in crate::window) fn lines_shown(&self, side: Side) -> LinesShown {
        let drawn = self.drawn(side);
        match drawn.style.style_name().draws_lines() {
            true => LinesShown::Alone,
            false if drawn.contents(false).is_ok_and(|contents| contents.has_strokes()) => LinesShown::Over,
            false => LinesShown::None,
        }
    }

    /// The request of a side's drawing in vectors: its own if its style has areas of tone, else that of exact lines.
    pub(in crate::window) fn drawing(&self, side: Side) -> Request {
        let request = of_any_scene(Buffer::default().drawn(&self.requests[side as usize]));
        let has_vectors = request.style.vectors(self.area).is_some();
        if has_vectors { request } else { controls::in_style(&request, StyleName::Lines) }
    }

    /// A side's rules for parts: all pictures follow the rules for surfaces.
    pub(in crate::window) fn part_rules(&self, side: Side) -> PartRules {
        let lines = controls::in_style(&self.requests[side as usize], StyleName::Lines).style.lines();
        lines.map(|style| style.lines.parts).unwrap_or_default()
    }

    /// The name of a side's picture: a style, lines, or a style and lines.
    pub(in crate::window) fn drawn_name(&self, side: Side) -> String {
        let name = self.style(side).name();
        match self.lines_shown(side) {
            LinesShown::Over => format!("{name}+{}", StyleName::Lines.name()),
            LinesShown::None | LinesShown::Alone => name.to_owned(),
        }
    }

    /// A side's request with the scene as it is seen.
    pub(in crate::window) fn seen(&self, side: Side) -> Request {
        Request { scene: self.scene_settings(), ..self.requests[side as usize].clone() }
    }

    /// Shows this style on a side.
    pub fn put_style(&mut self, side: Side, style: Style) {
        controls::put_style(&mut self.requests[side as usize], style);
    }

    /// Sets an option of a side, or of both if it is the scene's or the models', or back to its default.
    fn set(&mut self, side: Side, group: Group, option: &str, value: Option<&str>) -> Result<(), String> {
        let mut request = self.seen(side);
        if matches!(group, Group::Style) && request.style.style_name().draws_lines() {
            return self.set_lines(option, value);
        }
        controls::set(&mut request, group, option, value)?;
        match group {
            Group::Style => self.requests[side as usize] = request,
            Group::Scene => self.put_scene(request.scene),
            Group::Models => self.requests.iter_mut().for_each(|side| side.read = request.read.clone()),
        }
        Ok(())
    }

    /// Sets an option of exact lines on both sides; a style without lines over it keeps an own setting of that name.
    fn set_lines(&mut self, option: &str, value: Option<&str>) -> Result<(), String> {
        let mut requests = self.requests.clone();
        for (side, request) in [Side::Left, Side::Right].into_iter().zip(&mut requests) {
            let is_own = Style::table().find(&request.style, option.trim_start_matches('-')).is_some();
            if is_own && self.lines_shown(side) == LinesShown::None {
                continue;
            }
            let mut lines = controls::in_style(request, StyleName::Lines);
            controls::set(&mut lines, Group::Style, option, value)?;
            request.options = lines.options;
            if is_own {
                *request = request.in_style(request.style.style_name()).map_err(|error| error.with_dashes())?;
            }
        }
        self.requests = requests;
        Ok(())
    }

    /// The sides that are seen.
    pub(crate) fn sides(&self) -> &'static [Side] {
        match self.layout {
            Layout::Single => &[Side::Left],
            Layout::Split | Layout::Difference => &[Side::Left, Side::Right],
        }
    }

    /// Where the panes are.
    pub(crate) fn panes(&self) -> Vec<Pane> {
        let Size { width, height } = self.area;
        match self.layout {
            Layout::Single => vec![Pane { content: Content::Picture(Side::Left), left: 0, size: self.area }],
            Layout::Split => {
                let column = (f64::from(width) * self.divider).round() as u32;
                vec![Pane { content: Content::Cut(column.min(width)), left: 0, size: self.area }]
            }
            Layout::Difference => {
                let size = Size { width: (width.saturating_sub(2 * GAP_PX) / 3).max(1), height };
                let contents = [Content::Picture(Side::Left), Content::Picture(Side::Right), Content::Difference];
                let pane = |(index, content)| Pane { content, left: index as u32 * (size.width + GAP_PX), size };
                contents.into_iter().enumerate().map(pane).collect()
            }
        }
    }

    /// The size that each side's picture is drawn in.
    pub(in crate::window) fn picture_size(&self) -> Size {
        self.panes().first().map_or(self.area, |pane| pane.size)
    }

    /// The scene settings without the user's moves and zoom.
    pub(in crate::window) fn scene_settings(&self) -> SceneSettings {
        let scene = &self.requests[0].scene;
        SceneSettings { size: self.picture_size(), camera: self.orbit.fitted(&scene.camera), ..scene.clone() }
    }

    /// Applies scene settings; of the camera the view, the projection and the target.
    pub(crate) fn put_scene(&mut self, scene: SceneSettings) {
        let CameraSettings { view, parallel, fov_y_degrees, .. } = scene.camera;
        if view != self.orbit.view {
            self.orbit.look_from(view);
        }
        (self.orbit.parallel, self.orbit.fov_y_degrees) = (parallel, fov_y_degrees);
        self.requests.iter_mut().for_each(|side| side.scene = scene.clone());
    }

    /// The models' files without their folders.
    pub(crate) fn model_names(&self) -> Vec<String> {
        let name = |model: &String| {
            let path = std::path::Path::new(model);
            path.file_name().map_or_else(|| model.clone(), |name| name.to_string_lossy().into_owned())
        };
        self.models.iter().map(name).collect()
    }

    /// The window's title: model and styles.
    pub fn title(&self) -> String {
        let models = match &self.model_names()[..] {
            [] => "no model".to_owned(),
            [one] => one.clone(),
            [first, others @ ..] => format!("{first} and {} more", others.len()),
        };
        let styles: Vec<String> = self.sides().iter().map(|side| self.drawn_name(*side)).collect();
        format!("{models} - {} - tinta", styles.join(" | "))
    }

    /// Applies an event; returns its effect outside this value.
    pub fn update(&mut self, event: ViewerEvent) -> Option<Effect> {
        self.message = None;
        // The system resizes a window, too.
        self.has_hint &= matches!(event, ViewerEvent::Resize(_));
        let result = self.changed(event);
        result.unwrap_or_else(|problem| {
            self.message = Some(problem);
            None
        })
    }

    fn changed(&mut self, event: ViewerEvent) -> Result<Option<Effect>, String> {
        let finite = |value: f64| if value.is_finite() { Ok(value) } else { Err("give finite numbers".to_owned()) };
        match event {
            ViewerEvent::Turn([right, down]) => self.orbit.turn(finite(right)?, finite(down)?),
            ViewerEvent::Move([right, down]) => self.orbit.move_by(finite(right)?, finite(down)?),
            ViewerEvent::Zoom(factor) => self.orbit.zoom_by(finite(factor)?),
            ViewerEvent::Reset => self.orbit.look_from(View::DEFAULT),
            ViewerEvent::View(name) => self.orbit.look_from(name.parse()?),
            ViewerEvent::Projection => self.orbit.parallel = !self.orbit.parallel,
            ViewerEvent::Style(side, name) => self.choose_style(side, name.parse()?),
            ViewerEvent::Set(side, option, value) => self.set(side, Group::Style, &option, Some(&value))?,
            ViewerEvent::Default(side, option) => self.set(side, Group::Style, &option, None)?,
            ViewerEvent::Faithful(side) => self.put_style(side, Style::named(self.style(side).style_name())),
            ViewerEvent::Overlay(side, is_over) => {
                self.requests[side as usize].exact_lines = is_over && !self.style(side).style_name().draws_lines();
            }
            ViewerEvent::Lines(option, value) => self.set_lines(&option, Some(&value))?,
            ViewerEvent::LinesDefault(option) => self.set_lines(&option, None)?,
            ViewerEvent::Choose(side) => self.active = side,
            ViewerEvent::Layout(layout) => self.lay_out(layout),
            ViewerEvent::NextLayout => self.lay_out(match self.layout {
                Layout::Single => Layout::Split,
                Layout::Split => Layout::Difference,
                Layout::Difference => Layout::Single,
            }),
            ViewerEvent::Divide(share) => self.divider = finite(share)?.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN),
            ViewerEvent::NextBuffer => self.buffer = self.next_buffer(),
            ViewerEvent::Buffer(name) => self.buffer = name.parse()?,
            ViewerEvent::Background(color) => self.set(self.active, Group::Scene, "background", Some(&color))?,
            ViewerEvent::Scene(option, value) => self.set(self.active, Group::Scene, &option, Some(&value))?,
            ViewerEvent::SceneDefault(option) => self.set(self.active, Group::Scene, &option, None)?,
            ViewerEvent::Model(option, value) => {
                self.set(self.active, Group::Models, &option, Some(&value))?;
                return Ok(self.read_again());
            }
            ViewerEvent::ModelDefault(option) => {
                self.set(self.active, Group::Models, &option, None)?;
                return Ok(self.read_again());
            }
            ViewerEvent::Coarse(is_allowed) => self.is_coarse_while_moving = is_allowed,
            ViewerEvent::Explain => (self.explains, self.passes_on) = (!self.explains, 0),
            ViewerEvent::Point(side, place) => self.pointed = Some((side, place)),
            ViewerEvent::Pass(passes) => self.passes_on = self.passes_on.wrapping_add(passes),
            ViewerEvent::Panel => self.has_panel = !self.has_panel,
            ViewerEvent::KeySheet => self.has_key_sheet = !self.has_key_sheet,
            ViewerEvent::Price => self.has_price = !self.has_price,
            ViewerEvent::Dismiss => {}
            ViewerEvent::Quit => return Ok(Some(Effect::Quit)),
            ViewerEvent::FullScreen => {
                self.is_full_screen = !self.is_full_screen;
                return Ok(Some(Effect::FullScreen(self.is_full_screen)));
            }
            ViewerEvent::Resize([width, height]) => {
                let side = |pixels: u32| pixels.clamp(1, LARGEST_SIDE);
                self.area = Size { width: side(width), height: side(height) };
            }
            ViewerEvent::Browse => return Ok(Some(Effect::Browse)),
            ViewerEvent::Open(models) => return Ok((!models.is_empty()).then_some(Effect::Open(models))),
            ViewerEvent::SavePicture => return Ok(Some(Effect::Save(Save::Picture))),
            ViewerEvent::SaveLines => return Ok(Some(Effect::Save(Save::Lines))),
            ViewerEvent::SaveTurn => return Ok(Some(Effect::Save(Save::Turn))),
            ViewerEvent::SavePreset => return Ok(Some(Effect::Save(Save::Preset))),
            ViewerEvent::Look(name) => self.put_layer(OptionLayer::Look(Look::of_name(&name)?))?,
            ViewerEvent::OpenPreset(name) => {
                self.put_layer(OptionLayer::File(Preset::read(&name).map_err(|error| error.to_string())?))?;
            }
        }
        Ok(None)
    }

    fn read_again(&self) -> Option<Effect> {
        (!self.models.is_empty()).then(|| Effect::Open(self.models.clone()))
    }

    fn choose_style(&mut self, side: Side, name: StyleName) {
        let mut request = controls::in_style(&self.requests[side as usize], name);
        request.exact_lines &= !name.draws_lines();
        self.requests[side as usize] = request;
        // The buffer stays if the new style has it, to let a key compare two styles' maps.
        if !self.sides().iter().any(|side| buffers(self.style(*side).style_name()).contains(&self.buffer)) {
            self.buffer = Buffer::default();
        }
    }

    fn lay_out(&mut self, layout: Layout) {
        self.layout = layout;
        if layout == Layout::Single {
            self.active = Side::Left;
        }
    }

    fn next_buffer(&self) -> Buffer {
        let known = buffers(self.style(self.active).style_name());
        let index = known.iter().position(|buffer| *buffer == self.buffer).unwrap_or(0);
        known.get((index + 1) % known.len().max(1)).copied().unwrap_or_default()
    }

    /// The options of a look or a preset for a side; they replace all earlier ones. A layer without a style keeps the drawn
    /// one, and reading stays.
    fn of_layer(&self, side: Side, layer: OptionLayer) -> DrawingResult<Request> {
        let own = &self.requests[side as usize];
        let mut scene = self.scene_settings();
        if let OptionLayer::Look(_) = layer {
            controls::forget_looks(&mut scene)?;
        }
        let (request, _) = Request::from_layers(&[OptionLayer::Style(own.style.style_name()), layer])?;
        let of_scene = controls::of_scene_in(&request.options);
        SceneSettings::table().apply(&mut scene, &of_scene).map_err(|error| request.attributed(error))?;
        request.contents(false)?;
        Ok(Request { scene, read: own.read.clone(), ..request })
    }

    /// Puts a look or a preset on the active side, and its scene settings on both.
    fn put_layer(&mut self, layer: OptionLayer) -> Result<(), String> {
        let request = self.of_layer(self.active, layer).map_err(|error| error.to_string())?;
        self.put_scene(request.scene.clone());
        self.requests[self.active as usize] = request;
        Ok(())
    }

    /// The look that the active side has, if it has one.
    pub(in crate::window) fn look(&self) -> Option<Look> {
        self.look_of(self.active)
    }

    /// The look that a side has, from wherever it is seen.
    pub(in crate::window) fn look_of(&self, side: Side) -> Option<Look> {
        let (own, seen) = (self.requests[side as usize].contents(false).ok()?, self.scene_settings());
        let has = |look: &Look| {
            self.of_layer(side, OptionLayer::Look(*look)).is_ok_and(|mut of_look| {
                of_look.scene.camera.view = seen.camera.view;
                of_look.scene == seen && of_look.contents(false).is_ok_and(|contents| contents == own)
            })
        };
        LOOKS.into_iter().find(has)
    }
}

#[cfg(test)]
#[path = "state_tests.rs"]
mod tests;
