//! The window itself: winit's events in, egui's frames out, and recordings played in it.
//!
//! The window paints frames only when the picture changes.

use crate::error::{Error, Result};
use crate::scene::Size;
use crate::window::player::{PlayedRecord, Player};
use crate::window::replay::Replay;
use crate::window::threads::viewer::{Viewer, ViewerOptions};
use crate::window::values::shown::{NARROW, WindowParts};
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::WindowId;

/// How a window is opened.
#[derive(Debug, Clone)]
pub struct WindowOptions {
    /// The viewer in it.
    pub viewer: ViewerOptions,
    /// The window's size, points.
    pub size: Size,
    /// A recording that is played; then the window closes.
    pub replay: Option<Replay>,
    /// When the program began, to time the first picture.
    pub started: Instant,
}

/// A thread has news.
#[derive(Debug, Clone, Copy)]
struct News;

/// Opens the window and returns when it is closed, with the measurements of a recording.
///
/// # Errors
///
/// [`Error::NoWindow`] without a display or OpenGL on it, the renderer's errors, and for a recording the errors of writing its
/// pictures.
pub fn open(mut options: WindowOptions) -> Result<Option<PlayedRecord>> {
    let no_window = |error: winit::error::EventLoopError| Error::NoWindow { reason: reason(&error.to_string()) };
    let event_loop = EventLoop::<News>::with_user_event().build().map_err(no_window)?;
    let proxy = event_loop.create_proxy();
    // The event loop may have ended while a thread was at work.
    let wake = move || {
        let _ = proxy.send_event(News);
    };
    // A recording states which parts are open.
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
    shown: Option<WindowParts>,
    size: Size,
    player: Option<Player>,
    result: Result<()>,
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
                // A delay too long for the clock means no limit.
                Instant::now().checked_add(delay).map_or(ControlFlow::Wait, ControlFlow::WaitUntil),
            ),
        }
        Ok(())
    }
}

impl ApplicationHandler<News> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Some(viewer) = self.viewer.take() else { return };
        match WindowParts::open(event_loop, viewer, self.size, self.player.as_ref().map(Player::has_sizes)) {
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

#[cfg(test)]
mod tests {
    use super::reason;
    use crate::window::values::shown::dress;
    use crate::window::widgets::panel::{CHANGED, FAITHFUL, HINT};
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
