//! A frame of the window: panes, panel, sheets, and the events that mouse and keys make in it.

use crate::picture::Picture;
use crate::window::threads::save::SAME_BY;
use crate::window::threads::viewer::Viewer;
use crate::window::values::buffer::{Buffer, CLASS_COLORS};
use crate::window::values::compose::difference;
use crate::window::values::event::{Side, ViewerEvent};
use crate::window::values::line_style::LinesShown;
use crate::window::values::state::{Content, Pane, ViewerState};
use crate::window::widgets::keys;
use crate::window::widgets::label;
use crate::window::widgets::listing;
use crate::window::widgets::panel;
use crate::window::widgets::plot;
use egui::{
    Align2, Color32, Context, CursorIcon, Key, Pos2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2,
};
use std::path::Path;
use std::time::Duration;

/// Width of the panel, points: at most and at least, and the share of a window's width between.
const PANEL_WIDTH: [f32; 2] = [220.0, 300.0];
const PANEL_SHARE: f32 = 0.36;

/// Height of the line below the panes, points.
pub(in crate::window) const STATUS_HEIGHT: f32 = 24.0;

/// Height of the parts around the list of keys, points.
const KEY_SHEET_MARGIN: f32 = 136.0;

/// Size that the panel and the status line take from a window of this width, points.
pub(in crate::window) fn taken(state: &ViewerState, window_width: f32) -> [f32; 2] {
    [if state.has_panel { panel_width(window_width) } else { 0.0 }, STATUS_HEIGHT]
}

/// The panel's width in a window of this width, points: a small window is the picture's first.
fn panel_width(window_width: f32) -> f32 {
    let [least, most] = PANEL_WIDTH;
    (window_width * PANEL_SHARE).round().clamp(least, most)
}

/// A window this wide, points, has the list of keys in two columns.
const WIDE: f32 = 1100.0;

/// Letters on one line of a key's description.
const LINE_LETTERS: usize = 44;

/// How far from the divider a pointer takes it, points.
const DIVIDER_REACH: f32 = 6.0;

/// Points of scrolling that bring the model nearer by e.
const SCROLL_POINTS: f64 = 300.0;

/// Time between updates of the loading stage.
const LOADING_INTERVAL: Duration = Duration::from_millis(100);

/// The pictures as textures, replaced when new ones arrive.
#[derive(Default)]
pub(in crate::window) struct Textures {
    made_of: Option<(u64, bool)>,
    sides: [Option<TextureHandle>; 2],
    difference: Option<TextureHandle>,
}

impl Textures {
    fn update(&mut self, context: &Context, viewer: &Viewer) {
        let has_difference = viewer.state.panes().iter().any(|pane| pane.content == Content::Difference);
        let wanted = Some((viewer.picture_number, has_difference));
        if self.made_of == wanted {
            return;
        }
        self.made_of = wanted;
        for side in [Side::Left, Side::Right] {
            put(context, &mut self.sides[side as usize], viewer.picture(side));
        }
        let pictures = viewer.picture(Side::Left).zip(viewer.picture(Side::Right)).filter(|_| has_difference);
        put(context, &mut self.difference, pictures.map(|(left, right)| difference(left, right)).as_ref());
    }
}

fn put(context: &Context, texture: &mut Option<TextureHandle>, picture: Option<&Picture>) {
    let Some(picture) = picture else {
        *texture = None;
        return;
    };
    // A map's depth lies in its alpha, which must not show as transparency.
    let image = egui::ColorImage::from_rgba_premultiplied(
        [picture.size.width as usize, picture.size.height as usize],
        &picture.clone().opaque().pixels,
    );
    match texture {
        Some(texture) => texture.set(image, TextureOptions::NEAREST),
        None => *texture = Some(context.load_texture("pane", image, TextureOptions::NEAREST)),
    }
}

/// Shows a frame and returns its events. `follows_window`: the drawing area is as large as the window allows.
pub(in crate::window) fn frame(
    context: &Context,
    viewer: &Viewer,
    textures: &mut Textures,
    follows_window: bool,
) -> Vec<ViewerEvent> {
    let mut events = Vec::new();
    textures.update(context, viewer);
    let state = &viewer.state;
    // While the user types a text, its letters are not keys.
    let is_typing = context.memory(|memory| memory.focused()).is_some();
    // Esc closes an open list, and only that.
    let has_keys = !is_typing && !egui::Popup::is_any_open(context);
    if let Some(path) = has_keys.then(|| typed_path(context)).flatten() {
        panel::type_model(context, path);
        events.extend((!state.has_panel).then_some(ViewerEvent::Panel));
    } else if has_keys {
        let pressed = |event: &egui::Event| match event {
            egui::Event::Key { key: Key::Escape, pressed: true, .. } if viewer.has_problem() => {
                Some(ViewerEvent::Dismiss)
            }
            egui::Event::Key { key, pressed: true, modifiers, .. } => keys::event(*key, *modifiers, state),
            _ => None,
        };
        events.extend(context.input(|input| input.events.iter().filter_map(pressed).collect::<Vec<_>>()));
    }
    let dropped = context.input(|input| {
        let paths = input.raw.dropped_files.iter().filter_map(|file| file.path.as_ref());
        paths.map(|path| path.to_string_lossy().into_owned()).collect::<Vec<_>>()
    });
    let (presets, models): (Vec<String>, _) = dropped.into_iter().partition(|path| is_preset(path));
    events.extend(presets.into_iter().map(ViewerEvent::OpenPreset));
    if !models.is_empty() {
        events.push(ViewerEvent::Open(models));
    }
    egui::TopBottomPanel::bottom("status").exact_height(STATUS_HEIGHT).show(context, |ui| status(ui, viewer));
    if state.has_panel {
        egui::SidePanel::right("panel")
            .exact_width(panel_width(context.content_rect().width()))
            .resizable(false)
            .show(context, |ui| panel::show(ui, viewer, &mut events));
    }
    egui::CentralPanel::default().frame(egui::Frame::NONE).show(context, |ui| {
        panes(ui, viewer, textures, follows_window, &mut events);
    });
    sheets(context, viewer, &mut events);
    if state.explains {
        listing::show(context, viewer);
    }
    if viewer.stage.is_some() {
        context.request_repaint_after(LOADING_INTERVAL);
    }
    events
}

/// Takes a pasted text, or typed letters that begin a path: they belong to the model's field and are no keys.
fn typed_path(context: &Context) -> Option<String> {
    let text_of = |event: &egui::Event| match event {
        egui::Event::Paste(text) | egui::Event::Text(text) => Some(text.clone()),
        _ => None,
    };
    context.input_mut(|input| {
        let is_pasted = input.events.iter().any(|event| matches!(event, egui::Event::Paste(_)));
        let text: String = input.events.iter().filter_map(text_of).collect();
        if !is_pasted && !text.starts_with(['/', '\\', '~', '.']) {
            return None;
        }
        input.events.retain(|event| text_of(event).is_none());
        Some(text)
    })
}

/// Whether a file's name is that of a preset.
fn is_preset(path: &str) -> bool {
    Path::new(path).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

fn status(ui: &mut Ui, viewer: &Viewer) {
    ui.horizontal_centered(|ui| {
        let state = &viewer.state;
        if let Some(message) = &state.message {
            let (said, command) = message.split_once(SAME_BY).unwrap_or((message, ""));
            if !command.is_empty() && ui.small_button("copy the command").clicked() {
                ui.ctx().copy_text(command.to_owned());
            }
            ui.add(egui::Label::new(said).truncate()).on_hover_text(message);
            return;
        }
        let styles: Vec<String> = state
            .sides()
            .iter()
            .map(|side| {
                let drawing = viewer.drawing(*side).map(|drawing| drawing.frame_ms);
                let drawing = viewer.costs.frame_ms(*side).or(drawing);
                let lines = viewer.lines.found().map(|found| found.ms);
                let ms = match state.lines_shown(*side) {
                    LinesShown::None => drawing,
                    LinesShown::Over => drawing.map(|ms| ms + lines.unwrap_or_default()),
                    LinesShown::Alone => lines,
                };
                let ms = ms.map_or_else(String::new, |ms| format!(" {ms:.0} ms"));
                format!("{}{ms}", state.drawn_name(*side))
            })
            .collect();
        let triangles = viewer.triangle_count().map_or(String::new(), |count| format!("{count} triangles   "));
        let shown = if state.buffer == Default::default() { "" } else { state.buffer.name() };
        ui.add(egui::Label::new(format!("{triangles}{}   {shown}   H: keys", styles.join(" | "))).truncate());
    });
}

/// The pictures in their places, and the mouse's actions on them.
fn panes(ui: &mut Ui, viewer: &Viewer, textures: &Textures, follows_window: bool, events: &mut Vec<ViewerEvent>) {
    let area = ui.max_rect();
    let scale = ui.ctx().pixels_per_point();
    let state = &viewer.state;
    let pixels = [area.width(), area.height()].map(|points| (points * scale).round().max(1.0) as u32);
    if follows_window && pixels != [state.area.width, state.area.height] {
        events.push(ViewerEvent::Resize(pixels));
    }
    // Aligned to whole pixels: each pixel of the picture is one of the screen's.
    let corner = Pos2::new((area.left() * scale).round() / scale, (area.top() * scale).round() / scale);
    let response = ui.interact(area, ui.id().with("panes"), Sense::click_and_drag());
    for pane in state.panes() {
        paint(ui, textures, pane, corner, scale);
        if let Content::Cut(column) = pane.content {
            divider(ui, corner + Vec2::X * (column as f32 / scale), area, events);
        }
    }
    label::show(ui, state, area, scale);
    // Also below the listing, which the pointer goes through.
    let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|place| area.contains(*place));
    if let Some(pointer) = pointer.filter(|_| state.explains) {
        let at = (pointer - corner) * scale;
        let pointed = pixel_at(state, [f64::from(at.x), f64::from(at.y)]);
        events.extend(pointed.filter(|_| pointed != state.pointed).map(|(side, at)| ViewerEvent::Point(side, at)));
    }
    let height = f64::from(area.height().max(1.0));
    let delta = response.drag_delta();
    if delta != Vec2::ZERO {
        let drag = [f64::from(delta.x) / height, f64::from(delta.y) / height];
        let is_moving = !response.dragged_by(egui::PointerButton::Primary) || ui.input(|input| input.modifiers.shift);
        events.push(if is_moving { ViewerEvent::Move(drag) } else { ViewerEvent::Turn(drag) });
    }
    if response.hovered() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
        let factor = (f64::from(scroll) / SCROLL_POINTS).exp() * f64::from(pinch);
        if factor != 1.0 {
            events.push(ViewerEvent::Zoom(factor));
        }
    }
}

/// The pixel of a side's picture at a place of the drawing area, pixels from its upper left corner.
fn pixel_at(state: &ViewerState, [x, y]: [f64; 2]) -> Option<(Side, [u32; 2])> {
    let (x, y) = ((x >= 0.0).then_some(x as u32)?, (y >= 0.0).then_some(y as u32)?);
    let has_it = |pane: &Pane| (pane.left..pane.left + pane.size.width).contains(&x) && y < pane.size.height;
    let pane = state.panes().into_iter().find(has_it)?;
    let side = match pane.content {
        Content::Picture(side) => side,
        Content::Cut(column) => {
            if x - pane.left < column {
                Side::Left
            } else {
                Side::Right
            }
        }
        Content::Difference => return None,
    };
    Some((side, [x - pane.left, y]))
}

fn paint(ui: &Ui, textures: &Textures, pane: Pane, corner: Pos2, scale: f32) {
    let part = |texture: &Option<TextureHandle>, columns: [u32; 2]| {
        let Some(texture) = texture else { return };
        let [width, height] = texture.size();
        let [from, to] = columns.map(|column| (column as f32).min(width as f32));
        if to <= from {
            return;
        }
        let min = corner + Vec2::new(pane.left as f32 + from, 0.0) / scale;
        let place = Rect::from_min_size(min, Vec2::new(to - from, height as f32) / scale);
        let source = Rect::from_min_max(Pos2::new(from / width as f32, 0.0), Pos2::new(to / width as f32, 1.0));
        ui.painter().image(texture.id(), place, source, Color32::WHITE);
    };
    match pane.content {
        Content::Picture(side) => part(&textures.sides[side as usize], [0, u32::MAX]),
        Content::Difference => part(&textures.difference, [0, u32::MAX]),
        Content::Cut(column) => {
            part(&textures.sides[0], [0, column]);
            part(&textures.sides[1], [column, u32::MAX]);
        }
    }
}

/// The draggable line between two styles.
fn divider(ui: &Ui, top: Pos2, area: Rect, events: &mut Vec<ViewerEvent>) {
    let reach = Rect::from_x_y_ranges(top.x - DIVIDER_REACH..=top.x + DIVIDER_REACH, area.y_range());
    let response =
        ui.interact(reach, ui.id().with("divider"), Sense::drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
    let is_held = response.hovered() || response.dragged();
    let stroke = Stroke::new(if is_held { 3.0 } else { 1.5 }, Color32::from_gray(90));
    ui.painter().vline(top.x, area.y_range(), stroke);
    ui.painter().circle(Pos2::new(top.x, area.center().y), 6.0, Color32::from_gray(235), stroke);
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        events.push(ViewerEvent::Divide(f64::from((pointer.x - area.left()) / area.width().max(1.0))));
    }
}

/// A text of the sheet, on two lines if it is long.
fn broken(text: &str) -> String {
    let end = text.char_indices().nth(LINE_LETTERS).and_then(|(end, _)| text[..end].rfind(' '));
    end.map_or_else(|| text.to_owned(), |end| format!("{}\n{}", &text[..end], &text[end + 1..]))
}

/// How to begin, in a line.
fn hint(context: &Context) {
    let offset = [8.0, -8.0 - STATUS_HEIGHT];
    egui::Area::new("hint".into()).anchor(Align2::LEFT_BOTTOM, offset).interactable(false).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.add(egui::Label::new("Drag to turn, wheel to zoom, H for keys").extend());
        });
    });
}

/// The sheets over the panes: keys, costs, problems, progress of reading.
fn sheets(context: &Context, viewer: &Viewer, events: &mut Vec<ViewerEvent>) {
    let state = &viewer.state;
    if state.has_price {
        window("times and errors").anchor(Align2::LEFT_TOP, [8.0, 8.0]).show(context, |ui| plot::show(ui, viewer));
    }
    if state.has_hint && viewer.stage.is_none() {
        hint(context);
    }
    if let Some(stage) = &viewer.stage {
        window("loading").anchor(Align2::CENTER_TOP, [0.0, 8.0]).show(context, |ui| {
            ui.label(&stage.text);
            ui.add(egui::ProgressBar::new(stage.share).show_percentage());
        });
    }
    for (title, text) in [
        ("this cannot be drawn", viewer.problem.as_deref()),
        ("these lines cannot be drawn", viewer.lines.problem()),
        ("a shader was refused", viewer.shader_log.as_deref()),
    ] {
        if let Some(text) = text {
            window(title).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).max_width(520.0).show(context, |ui| {
                ui.add(egui::Label::new(text).wrap());
            });
        }
    }
    if state.buffer == Buffer::EdgeClasses {
        window("edges").anchor(Align2::LEFT_BOTTOM, [8.0, -8.0 - STATUS_HEIGHT]).show(context, class_colors);
    }
    if state.has_key_sheet && key_sheet(context) {
        events.push(ViewerEvent::KeySheet);
    }
}

fn window(title: &str) -> egui::Window<'static> {
    egui::Window::new(title.to_owned()).collapsible(false).resizable(false).movable(false)
}

/// The colours of edges by class.
fn class_colors(ui: &mut Ui) {
    for (class, [red, green, blue]) in CLASS_COLORS {
        let byte = |channel: f32| (channel * 255.0) as u8;
        ui.horizontal(|ui| {
            let (place, _) = ui.allocate_exact_size(Vec2::new(14.0, 8.0), Sense::hover());
            ui.painter().rect_filled(place, 1.0, Color32::from_rgb(byte(red), byte(green), byte(blue)));
            ui.painter().rect_stroke(place, 1.0, Stroke::new(1.0, Color32::GRAY), egui::StrokeKind::Outside);
            ui.label(class.name());
        });
    }
}

/// The keys; whether the button that closes them was pressed.
fn key_sheet(context: &Context) -> bool {
    let shown = window("keys").anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        // In a small window the rest scrolls.
        let Vec2 { x: width, y: height } = context.content_rect().size();
        let height = height - KEY_SHEET_MARGIN;
        egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            let rows: Vec<_> = crate::keys::sheet(false).collect();
            let columns = if width < WIDE { 1 } else { 2 };
            let height = rows.len().div_ceil(columns);
            egui::Grid::new("keys").num_columns(2 * columns + 1).spacing([24.0, 4.0]).show(ui, |ui| {
                for row in 0..height {
                    for (keys, what) in rows.iter().skip(row).step_by(height) {
                        ui.strong(*keys);
                        ui.label(broken(what));
                    }
                    // Room for the bar beside the rows.
                    ui.label("");
                    ui.end_row();
                }
            });
        });
        ui.button("close").clicked()
    });
    shown.is_some_and(|shown| shown.inner == Some(true))
}

#[cfg(test)]
#[path = "ui_tests.rs"]
mod tests;
