//! The window itself: winit's events in, egui's frames out, and recordings played in it.
//!
//! Frames are painted when there is something new to see and at no other time.

use super::event::{Effect, ViewerEvent};
use super::player::{PlayedRecord, Player};
use super::replay::Replay;
use super::ui::{self, Textures};
use super::viewer::{Viewer, ViewerOptions};
use crate::error::{Error, Result};
use crate::gl::context::window::{Shapes, WindowGl};
use crate::picture::Picture;
use crate::scene::Size;
use egui::{FontData, FontDefinitions, FontFamily, ViewportId};
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Fullscreen, Window, WindowId};

/// How a window is opened.
#[derive(Debug, Clone)]
pub struct WindowOptions {
    /// The viewer in it.
    pub viewer: ViewerOptions,
    /// The window's size, points.
    pub size: Size,
    /// A recording that is played; then the window closes.
    pub replay: Option<Replay>,
    /// When the program began, for the time to the first picture.
    pub started: Instant,
}

/// Brightness of texts on the dark panels: egui's own is faint.
const TEXT_GREY: u8 = 215;

/// A window less wide, in points, begins without the panel, and folds it when it becomes so.
const NARROW: u32 = 800;

/// How long a pointer that drags rests before what it drags is drawn in full.
const STILL: Duration = Duration::from_millis(200);

/// A thread has news.
#[derive(Debug, Clone, Copy)]
struct News;

/// Opens the window and returns when it is closed; of a recording what it took.
///
/// # Errors
///
/// [`Error::NoWindow`] without a display or OpenGL on it, what keeps the renderer from drawing at all, and for a recording
/// what keeps its pictures from being written.
pub fn open(mut options: WindowOptions) -> Result<Option<PlayedRecord>> {
    let no_window = |error: winit::error::EventLoopError| Error::NoWindow { reason: reason(&error.to_string()) };
    let event_loop = EventLoop::<News>::with_user_event().build().map_err(no_window)?;
    let proxy = event_loop.create_proxy();
    // The event loop may have ended while a thread was at work.
    let wake = move || {
        let _ = proxy.send_event(News);
    };
    // A recording says by itself what is open.
    if options.replay.is_none() {
        let state = &mut options.viewer.state;
        (state.has_panel, state.has_hint) = (options.size.width >= NARROW, true);
    }
    let viewer = Viewer::start(options.viewer, wake)?;
    let player = options.replay.map(|replay| Player::new(replay, options.started));
    let mut app = App { viewer: Some(viewer), shown: None, size: options.size, player, result: Ok(()) };
    event_loop.run_app(&mut app).map_err(no_window)?;
    let App { player, result, .. } = app;
    result?;
    Ok(player.map(Player::record))
}

/// winit's message without the place in its source.
fn reason(message: &str) -> String {
    let after_place = message.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    after_place.map_or(message, |(_, reason)| reason).trim_end_matches('.').to_owned()
}

struct App {
    /// Until the window is there.
    viewer: Option<Viewer>,
    shown: Option<Shown>,
    size: Size,
    player: Option<Player>,
    result: Result<()>,
}

/// What there is once there is a window.
pub(super) struct Shown {
    pub viewer: Viewer,
    textures: Textures,
    egui: egui_winit::State,
    // Before the window it paints into.
    gl: WindowGl,
    window: Window,
    title: String,
    /// Whether the drawing area is as large as the window leaves it.
    pub follows_window: bool,
    /// Whether it is to be closed.
    pub is_over: bool,
    /// Whether there is no room for the panel beside the panes.
    is_narrow: bool,
    /// Whether a recording says what happens, and when the view moves.
    is_played: bool,
}

impl Shown {
    fn open(event_loop: &ActiveEventLoop, viewer: Viewer, size: Size, player: Option<&Player>) -> Result<Self> {
        let follows_window = player.is_none_or(|player| !player.has_sizes());
        let title = viewer.state.title();
        let attributes = Window::default_attributes()
            .with_title(title.clone())
            .with_inner_size(LogicalSize::new(size.width, size.height));
        let (window, gl) = WindowGl::open(event_loop, attributes)?;
        let context = egui::Context::default();
        context.set_fonts(fonts());
        dress(&context);
        let egui = egui_winit::State::new(
            context,
            ViewportId::ROOT,
            event_loop,
            Some(window.scale_factor() as f32),
            None,
            Some(gl.largest_texture()),
        );
        let mut shown = Self {
            viewer,
            textures: Textures::default(),
            egui,
            gl,
            window,
            title,
            follows_window,
            is_over: false,
            is_narrow: size.width < NARROW,
            is_played: player.is_some(),
        };
        if follows_window {
            // The first picture is drawn while egui still finds out how much room there is.
            let (Size { width, height }, scale) = (shown.size(), shown.window.scale_factor());
            let [panel, status] = ui::taken(&shown.viewer.state, (f64::from(width) / scale) as f32)
                .map(|points| (f64::from(points) * scale).round() as u32);
            shown.event(ViewerEvent::Resize([width.saturating_sub(panel), height.saturating_sub(status)]));
        }
        shown.viewer.ask();
        Ok(shown)
    }

    fn size(&self) -> Size {
        let size = self.window.inner_size();
        Size { width: size.width, height: size.height }
    }

    /// Paints a frame and lets happen what was done in it. What the window then shows is returned if asked for, and how long
    /// nothing need be painted.
    pub(super) fn frame(&mut self, is_wanted: bool) -> Result<(Option<Picture>, Duration)> {
        let input = self.egui.take_egui_input(&self.window);
        let context = self.egui.egui_ctx().clone();
        let mut events = Vec::new();
        let output = context.run(input, |context| {
            events = ui::frame(context, &self.viewer, &mut self.textures, self.follows_window);
        });
        let has_events = !events.is_empty();
        events.into_iter().for_each(|event| self.event(event));
        let moving = self.moving();
        if !self.is_played {
            self.viewer.is_moving = moving.is_some();
        }
        self.viewer.ask();
        let title = self.viewer.state.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        self.egui.handle_platform_output(&self.window, output.platform_output);
        let shapes = Shapes {
            primitives: context.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: output.pixels_per_point,
        };
        let size = self.size();
        // A window without pixels shows nothing; its textures are kept up to date all the same.
        let picture = self.gl.paint(size, &shapes, is_wanted)?;
        let delay = output.viewport_output.get(&ViewportId::ROOT).map_or(Duration::MAX, |output| output.repaint_delay);
        let delay = moving.map_or(delay, |left| left.min(delay));
        Ok((picture, if has_events { Duration::ZERO } else { delay }))
    }

    /// While the pointer drags, how long it is until it counts as still.
    fn moving(&self) -> Option<Duration> {
        let is_down = self.egui.egui_ctx().input(|input| input.pointer.any_down());
        let since = self.egui.egui_ctx().input(|input| input.pointer.time_since_last_movement());
        let left = STILL.saturating_sub(Duration::try_from_secs_f32(since).unwrap_or(STILL));
        (is_down && !left.is_zero() && self.viewer.state.is_coarse_while_moving).then_some(left)
    }

    /// Pixels of the window to a point.
    pub(super) fn scale(&self) -> f64 {
        self.window.scale_factor()
    }

    pub(super) fn event(&mut self, event: ViewerEvent) {
        match self.viewer.event(event) {
            Some(Effect::FullScreen(is_full)) => {
                self.window.set_fullscreen(is_full.then_some(Fullscreen::Borderless(None)));
            }
            Some(Effect::Quit) => self.is_over = true,
            _ => {}
        }
    }

    /// Folds the panel when the window becomes too narrow for it; opened again it stays.
    fn fold_panel(&mut self) {
        let is_narrow = f64::from(self.size().width) < f64::from(NARROW) * self.window.scale_factor();
        if is_narrow && !self.is_narrow && self.viewer.state.has_panel {
            self.event(ViewerEvent::Panel);
        }
        self.is_narrow = is_narrow;
    }
}

impl App {
    fn stop(&mut self, event_loop: &ActiveEventLoop, error: Error) {
        if self.result.is_ok() {
            self.result = Err(error);
        }
        event_loop.exit();
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let Some(shown) = &mut self.shown else { return Ok(()) };
        if let Some(player) = &mut self.player {
            let is_over = player.play(shown)?;
            if is_over {
                event_loop.exit();
            } else {
                shown.window.request_redraw();
            }
            return Ok(());
        }
        let (_, delay) = shown.frame(false)?;
        if shown.is_over {
            event_loop.exit();
            return Ok(());
        }
        match delay {
            Duration::ZERO => shown.window.request_redraw(),
            delay => event_loop.set_control_flow(
                // Too long to be a time is for ever.
                Instant::now().checked_add(delay).map_or(ControlFlow::Wait, ControlFlow::WaitUntil),
            ),
        }
        Ok(())
    }
}

impl ApplicationHandler<News> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Some(viewer) = self.viewer.take() else { return };
        match Shown::open(event_loop, viewer, self.size, self.player.as_ref()) {
            Ok(shown) => {
                shown.window.request_redraw();
                self.shown = Some(shown);
            }
            Err(error) => self.stop(event_loop, error),
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // While there is still a display.
        self.shown = None;
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(shown)) = (cause, &self.shown) {
            event_loop.set_control_flow(ControlFlow::Wait);
            shown.window.request_redraw();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, _: News) {
        let Some(shown) = &mut self.shown else { return };
        match shown.viewer.take_reports() {
            Ok(true) => {
                shown.viewer.ask();
                shown.window.request_redraw();
            }
            Ok(false) => {}
            Err(error) => self.stop(event_loop, error),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.redraw(event_loop) {
                    self.stop(event_loop, error);
                }
            }
            event => {
                if let WindowEvent::Resized(_) = event {
                    shown.gl.resize(shown.size());
                    if self.player.is_none() {
                        shown.fold_panel();
                    }
                }
                if shown.egui.on_window_event(&shown.window, &event).repaint {
                    shown.window.request_redraw();
                }
            }
        }
    }
}

/// Dark panels with texts that can be read.
fn dress(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        // What fades in has to be painted again and again.
        style.animation_time = 0.0;
        style.visuals.override_text_color = Some(egui::Color32::from_gray(TEXT_GREY));
    });
}

/// DejaVu for everything: egui's own fonts have licences of their own.
pub(super) fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, data, family) in [
        ("sans", dejavu::sans::regular(), FontFamily::Proportional),
        ("mono", dejavu::sans_mono::regular(), FontFamily::Monospace),
    ] {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(data)));
        fonts.families.insert(family, vec![name.to_owned()]);
    }
    fonts
}

#[cfg(test)]
mod tests {
    use super::{dress, reason};
    use crate::window::panel::{CHANGED, FAITHFUL, HINT};
    use egui::Color32;

    /// Contrast of two colours as WCAG 2 defines it: from 1 to 21.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let luminance = |color: Color32| {
            let [red, green, blue] = [color.r(), color.g(), color.b()].map(|byte| {
                let share = f64::from(byte) / 255.0;
                if share <= 0.03928 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
            });
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    #[test]
    fn every_text_has_the_contrast_that_wcag_asks_for() {
        assert!((contrast(Color32::WHITE, Color32::BLACK) - 21.0).abs() < 1e-9);
        assert!(contrast(Color32::GRAY, Color32::WHITE) < 4.5, "the measure tells what is too faint");
        let context = egui::Context::default();
        dress(&context);
        let visuals = context.style().visuals.clone();
        let text = visuals.override_text_color.unwrap();
        let widgets = &visuals.widgets;
        let states = [&widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open];
        let mut pairs = vec![
            (text, visuals.panel_fill),
            (text, visuals.window_fill),
            (text, visuals.selection.bg_fill),
            (text, visuals.extreme_bg_color),
            (visuals.strong_text_color(), visuals.panel_fill),
            (HINT, visuals.extreme_bg_color),
            (FAITHFUL, visuals.panel_fill),
            (CHANGED, visuals.panel_fill),
        ];
        pairs.extend(states.map(|state| (text, state.weak_bg_fill)));
        for (text, behind) in pairs {
            assert!(contrast(text, behind) >= 4.5, "{text:?} on {behind:?}: {:.2}", contrast(text, behind));
        }
    }

    #[test]
    fn a_reason_names_no_place_in_a_source() {
        let message =
            "os error at /a/b/winit-0.30/src/platform_impl/linux/mod.rs:765: neither DISPLAY nor any other is set.";
        assert_eq!(reason(message), "neither DISPLAY nor any other is set");
        assert_eq!(reason("Exit(1)"), "Exit(1)");
    }
}
