//! The window while it is open: winit's events in, egui's frames out.

use crate::error::Result;
use crate::gl::context::window::{Shapes, WindowGl};
use crate::picture::Picture;
use crate::scene::Size;
use crate::window::threads::viewer::Viewer;
use crate::window::values::event::{Effect, ViewerEvent};
use crate::window::widgets::ui::{self, Textures};
use egui::{FontData, FontDefinitions, FontFamily, ViewportId};
use std::sync::Arc;
use std::time::Duration;
use winit::dpi::LogicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::{Fullscreen, Window};

/// Brightness of texts on the dark panels: egui's own is faint.
const TEXT_GREY: u8 = 215;

/// A window less wide, in points, begins without the panel, and folds it when it becomes so.
pub(in crate::window) const NARROW: u32 = 800;

/// How long a dragging pointer rests before the full picture is drawn.
const STILL: Duration = Duration::from_millis(200);

/// The parts that exist once the window exists.
pub(in crate::window) struct WindowParts {
    pub viewer: Viewer,
    textures: Textures,
    pub egui: egui_winit::State,
    // Before the window it paints into.
    pub gl: WindowGl,
    pub window: Window,
    title: String,
    /// Whether the drawing area is as large as the window leaves it.
    pub follows_window: bool,
    /// Whether the window should close.
    pub is_over: bool,
    /// Whether the window is too narrow for the panel beside the panes.
    is_narrow: bool,
    /// Whether the panel was folded for that.
    is_folded: bool,
    /// Whether a recording controls the events, including those that move the view.
    is_played: bool,
}

impl WindowParts {
    /// `played` is whether a recording plays that gives the drawing area its sizes, if one plays.
    pub(in crate::window) fn open(
        event_loop: &ActiveEventLoop,
        viewer: Viewer,
        size: Size,
        played: Option<bool>,
    ) -> Result<Self> {
        let follows_window = played != Some(true);
        let title = viewer.state.title();
        let screen = event_loop.primary_monitor().or(event_loop.available_monitors().next());
        let room = screen.map_or([u32::MAX; 2].into(), |it| it.size().to_logical(it.scale_factor()));
        let inner: LogicalSize<u32> = LogicalSize::new(size.width.min(room.width), size.height.min(room.height));
        let attributes = Window::default_attributes().with_title(title.clone()).with_inner_size(inner);
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
            is_folded: false,
            is_played: played.is_some(),
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

    pub(in crate::window) fn size(&self) -> Size {
        let size = self.window.inner_size();
        Size { width: size.width, height: size.height }
    }

    /// Paints a frame and applies its events. Returns the window's picture if requested, and how long the window can wait before
    /// the next paint.
    pub(in crate::window) fn frame(&mut self, is_wanted: bool) -> Result<(Option<Picture>, Duration)> {
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
        // A window without pixels shows nothing, but its textures stay up to date.
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
    pub(in crate::window) fn scale(&self) -> f64 {
        self.window.scale_factor()
    }

    pub(in crate::window) fn event(&mut self, event: ViewerEvent) {
        match self.viewer.event(event) {
            Some(Effect::FullScreen(is_full)) => {
                self.window.set_fullscreen(is_full.then_some(Fullscreen::Borderless(None)));
            }
            Some(Effect::Quit) => self.is_over = true,
            _ => {}
        }
    }

    /// Folds the panel when the window becomes too narrow for it, and unfolds it when there is room again; opened meanwhile it stays.
    pub(in crate::window) fn fold_panel(&mut self) {
        let is_narrow = f64::from(self.size().width) < f64::from(NARROW) * self.window.scale_factor();
        let has_panel = self.viewer.state.has_panel;
        let folds = is_narrow && !self.is_narrow && has_panel;
        if folds || !is_narrow && self.is_folded && !has_panel {
            self.event(ViewerEvent::Panel);
        }
        self.is_folded = folds || is_narrow && self.is_folded;
        self.is_narrow = is_narrow;
    }
}

/// Dark panels with texts that can be read.
pub(in crate::window) fn dress(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        // A fading element would need repeated painting.
        style.animation_time = 0.0;
        style.visuals.override_text_color = Some(egui::Color32::from_gray(TEXT_GREY));
    });
}

/// DejaVu for everything: egui's own fonts have separate licences.
pub(in crate::window) fn fonts() -> FontDefinitions {
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
