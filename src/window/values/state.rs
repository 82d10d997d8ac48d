//! The viewer as a value: the scene, the view, the styles, and how events change them. It uses neither a window nor GL.

use crate::camera::CameraSettings;
use crate::camera::View;
use crate::error::Error;
use crate::mesh::LoadOptions;
use crate::orbit::Orbit;
use crate::preset::{LOOKS, Look, Preset};
use crate::request::{EXACT_LINES, OptionLayer};
use crate::scene::{SceneSettings, Size};
use crate::settings::{OptionValue, Options};
use crate::styles::{LineStyle, Style, StyleName, is_of_exact_lines};
use crate::window::values::buffer::{Buffer, buffers};
use crate::window::values::controls;
use crate::window::values::event::{Effect, Layout, Save, Side, ViewerEvent};
use crate::window::values::line_style::LinesShown;

/// The complete state of the viewer's pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewerState {
    /// The models, as the user named them.
    pub models: Vec<String>,
    /// How they are read.
    pub(in crate::window) load: LoadOptions,
    /// The view of them.
    pub orbit: Orbit,
    /// The styles of both sides by their names, each with its last settings.
    pub(in crate::window) styles: [Vec<Style>; 2],
    /// The shown style of each side.
    pub(in crate::window) chosen: [StyleName; 2],
    /// Whether exact lines lie over it.
    pub(in crate::window) has_lines_over: [bool; 2],
    /// The side that number keys and the panel are for.
    pub active: Side,
    /// How the two styles are laid out.
    pub layout: Layout,
    /// Where the divider is, share of the width.
    pub divider: f64,
    /// The shown buffer of the styles.
    pub buffer: Buffer,
    /// The scene of both sides; a pane gives its size, and the orbit its view.
    pub(in crate::window) scene: SceneSettings,
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
        let all = || StyleName::ALL.into_iter().map(|(_, name)| Style::named(name)).collect();
        Self {
            models: Vec::new(),
            load: LoadOptions::default(),
            orbit: Orbit::default(),
            styles: [all(), all()],
            chosen: [StyleName::ThreePass, StyleName::Inking],
            has_lines_over: [false; 2],
            active: Side::Left,
            layout: Layout::Single,
            divider: 0.5,
            buffer: Buffer::default(),
            scene: SceneSettings::default(),
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

impl ViewerState {
    /// The first state for these models, seen so.
    pub fn new(models: Vec<String>, orbit: Orbit) -> Self {
        Self { models, orbit, ..Self::default() }
    }

    /// The style a side shows.
    pub fn style(&self, side: Side) -> &Style {
        &self.styles[side as usize][self.chosen[side as usize] as usize]
    }

    /// How a side shows exact lines.
    pub(in crate::window) fn lines_shown(&self, side: Side) -> LinesShown {
        let is_over = self.has_lines_over[side as usize] && self.buffer == Buffer::default();
        match (self.style(side).lines(), is_over) {
            (Some(_), _) => LinesShown::Alone,
            (None, true) => LinesShown::Over,
            (None, false) => LinesShown::None,
        }
    }

    /// The style of exact lines that lie over pictures, the same on both sides.
    pub(in crate::window) fn style_of_lines(&self) -> &Style {
        &self.styles[0][StyleName::Lines as usize]
    }

    /// The style whose vectors a side's drawing has: its own if it has areas of tone, else that of exact lines.
    pub(in crate::window) fn style_of_drawing(&self, side: Side) -> &Style {
        let style = self.style(side);
        if style.vectors(self.scene.size).is_some() { style } else { self.style_of_lines() }
    }

    /// Adds the options of the exact lines over a side's picture, which beat its style's.
    pub(in crate::window) fn add_lines_over(&self, side: Side, options: &mut Options) -> Result<(), Error> {
        if self.lines_shown(side) == LinesShown::Over {
            options.retain(|name, _| !is_of_exact_lines(name));
            let of_lines = self.style_of_lines().to_options()?;
            options.extend(of_lines.into_iter().filter(|(name, _)| is_of_exact_lines(name)));
            options.insert(EXACT_LINES.to_owned(), OptionValue::Switch(true));
        }
        Ok(())
    }

    /// The style of exact lines: of a side that shows them alone, or else of those over pictures.
    pub(crate) fn line_style(&self) -> LineStyle {
        let alone = self.sides().iter().find_map(|side| self.style(*side).lines());
        alone.or_else(|| self.style_of_lines().lines()).unwrap_or_default()
    }

    /// The name of a side's picture: a style, lines, or a style and lines.
    pub(in crate::window) fn drawn_name(&self, side: Side) -> String {
        let name = self.style(side).name();
        match self.lines_shown(side) {
            LinesShown::Over => format!("{name}+{}", self.style_of_lines().name()),
            LinesShown::None | LinesShown::Alone => name.to_owned(),
        }
    }

    /// Shows this style on a side, with these exact lines over it or none.
    fn put_drawn(&mut self, side: Side, style: Style, lines_over: Option<Style>) {
        self.put_style(side, style);
        self.has_lines_over[side as usize] = lines_over.is_some();
        if let Some(lines) = lines_over {
            self.prepare_style(&lines);
        }
    }

    /// Shows this style on a side.
    pub fn put_style(&mut self, side: Side, style: Style) {
        let name = style.style_name();
        self.chosen[side as usize] = name;
        // Exact lines look the same on both sides.
        match name.draws_lines() {
            true => self.prepare_style(&style),
            false => self.styles[side as usize][name as usize] = style,
        }
    }

    /// Sets a style's settings on both sides, for when it is chosen.
    pub(crate) fn prepare_style(&mut self, style: &Style) {
        for side in &mut self.styles {
            side[style.style_name() as usize] = style.clone();
        }
    }

    /// Changes the style that a side shows.
    fn change_style(
        &mut self,
        side: Side,
        change: impl FnOnce(&mut Style) -> Result<(), String>,
    ) -> Result<(), String> {
        let mut style = self.style(side).clone();
        change(&mut style)?;
        self.put_style(side, style);
        Ok(())
    }

    /// Changes how exact lines look.
    fn change_lines(&mut self, change: impl FnOnce(&mut Style) -> Result<(), String>) -> Result<(), String> {
        let mut style = self.style_of_lines().clone();
        change(&mut style)?;
        self.prepare_style(&style);
        Ok(())
    }

    /// The sides that are seen.
    pub fn sides(&self) -> &'static [Side] {
        match self.layout {
            Layout::Single => &[Side::Left],
            Layout::Split | Layout::Difference => &[Side::Left, Side::Right],
        }
    }

    /// Where the panes are.
    pub fn panes(&self) -> Vec<Pane> {
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
        let camera = self.orbit.fitted(&self.scene.camera);
        SceneSettings { size: self.picture_size(), camera, ..self.scene.clone() }
    }

    /// Applies scene settings; of the camera the view, the projection and the target.
    pub(crate) fn put_scene(&mut self, scene: SceneSettings) {
        let CameraSettings { view, parallel, fov_y_degrees, .. } = scene.camera;
        if view != self.orbit.view {
            self.orbit.look_from(view);
        }
        (self.orbit.parallel, self.orbit.fov_y_degrees) = (parallel, fov_y_degrees);
        self.scene = scene;
    }

    /// Sets a setting of the scene.
    fn set_scene(&mut self, option: &str, value: &str) -> Result<(), String> {
        let mut scene = self.scene_settings();
        controls::turn_in(&controls::SCENE, &mut scene, option, value)?;
        self.put_scene(scene);
        Ok(())
    }

    /// The models' files without their folders.
    pub fn model_names(&self) -> Vec<String> {
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
            ViewerEvent::Set(side, option, value) => {
                self.change_style(side, |style| controls::turn(style, &option, &value))?;
            }
            ViewerEvent::Default(side, option) => {
                self.change_style(side, |style| controls::turn_back(style, &option))?;
            }
            ViewerEvent::Faithful(side) => self.put_style(side, Style::named(self.chosen[side as usize])),
            ViewerEvent::Overlay(side, is_over) => {
                self.has_lines_over[side as usize] = is_over && self.style(side).lines().is_none();
            }
            ViewerEvent::Lines(option, value) => self.change_lines(|style| controls::turn(style, &option, &value))?,
            ViewerEvent::LinesDefault(option) => self.change_lines(|style| controls::turn_back(style, &option))?,
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
            ViewerEvent::Background(color) => self.set_scene("background", &color)?,
            ViewerEvent::Scene(option, value) => self.set_scene(&option, &value)?,
            ViewerEvent::SceneDefault(option) => {
                let mut scene = self.scene_settings();
                controls::turn_back_in(&controls::SCENE, &mut scene, &option)?;
                self.put_scene(scene);
            }
            ViewerEvent::Model(option, value) => {
                controls::turn_in(&controls::LOAD, &mut self.load, &option, &value)?;
                return Ok(self.read_again());
            }
            ViewerEvent::ModelDefault(option) => {
                controls::turn_back_in(&controls::LOAD, &mut self.load, &option)?;
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
            ViewerEvent::Look(name) => self.choose_look(Look::of_name(&name)?)?,
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
        self.chosen[side as usize] = name;
        self.has_lines_over[side as usize] &= !name.draws_lines();
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

    /// Puts a look or a preset on the active side, and its scene settings on both.
    fn put_layer(&mut self, layer: OptionLayer) -> Result<(), String> {
        let drawn = self.chosen[self.active as usize];
        let (style, lines, scene) =
            controls::of_layer(layer, drawn, self.scene_settings()).map_err(|error| error.to_string())?;
        self.put_drawn(self.active, style, lines);
        self.put_scene(scene);
        Ok(())
    }

    fn choose_look(&mut self, look: Look) -> Result<(), String> {
        self.put_layer(OptionLayer::Look(look))?;
        // A side still unseen and unchanged starts with settings that fit the look.
        let other = if self.active == Side::Left { Side::Right } else { Side::Left };
        if self.layout == Layout::Single && controls::look_of_sibling(self.style(other)).is_some() {
            self.put_style(other, controls::sibling(look, self.chosen[other as usize]));
        }
        Ok(())
    }

    /// The look that the active side has, if it has one.
    pub(in crate::window) fn look(&self) -> Option<Look> {
        self.look_of(self.active)
    }

    /// The look that a side has, from wherever it is seen.
    pub(in crate::window) fn look_of(&self, side: Side) -> Option<Look> {
        let (shown, seen) = (self.style(side), self.scene_settings());
        let lines = (self.lines_shown(side) == LinesShown::Over).then(|| self.style_of_lines().clone());
        let has = |look: &Look| {
            let of_look = controls::of_layer(OptionLayer::Look(*look), shown.style_name(), seen.clone());
            of_look.is_ok_and(|(style, over, mut scene)| {
                scene.camera.view = seen.camera.view;
                style == *shown && scene == seen && over == lines
            })
        };
        LOOKS.into_iter().find(has)
    }
}

#[cfg(test)]
#[path = "state_tests.rs"]
mod tests;
