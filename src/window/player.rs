//! Plays recordings in a window frame by frame, and times them.

use crate::error::{Error, Result};
use crate::picture::{Target, write_rgba_png};
use crate::record::Summary;
use crate::renderer::milliseconds_since;
use crate::window::replay::Replay;
use crate::window::values::shown::WindowParts;
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

/// The measurements of a recording.
#[derive(Debug, Clone, Serialize)]
pub struct PlayedRecord {
    /// From the program's start to the first picture on the screen.
    pub first_picture_ms: f64,
    /// The time of each frame, from its events to its display; includes the drawing of frames that wait for it.
    pub frame_ms: Summary,
    /// Frames that ran while something was being read or drawn.
    pub free_frame_ms: Summary,
    /// In drags, the time from one new picture on the screen to the next.
    pub drag_frame_ms: Summary,
    /// Pixels of the window to a point.
    pub scale: f64,
}

/// A recording being played.
pub(super) struct Player {
    replay: Replay,
    frame: u64,
    /// Whether frames run without waiting for the work they started.
    is_free: bool,
    /// In a drag: the number and time of the last picture shown.
    dragged: Option<(u64, Instant)>,
    /// When the program began.
    started: Instant,
    times: Times,
}

/// The times of frames.
#[derive(Default)]
struct Times {
    first_picture_ms: Option<f64>,
    frame_ms: Vec<f64>,
    free_frame_ms: Vec<f64>,
    drag_frame_ms: Vec<f64>,
    scale: f64,
}

impl Player {
    /// Before its first frame.
    pub(super) fn new(replay: Replay, started: Instant) -> Self {
        Self { replay, frame: 0, is_free: false, dragged: None, started, times: Times::default() }
    }

    /// Whether it gives the size of the drawing area.
    pub(super) fn has_sizes(&self) -> bool {
        self.replay.has_sizes()
    }

    /// Returns the measurements.
    pub(super) fn record(self) -> PlayedRecord {
        let Times { first_picture_ms, frame_ms, free_frame_ms, drag_frame_ms, scale } = self.times;
        PlayedRecord {
            first_picture_ms: first_picture_ms.unwrap_or_default(),
            frame_ms: Summary::new(frame_ms),
            free_frame_ms: Summary::new(free_frame_ms),
            drag_frame_ms: Summary::new(drag_frame_ms),
            scale,
        }
    }

    fn is_over(&self) -> bool {
        !self.is_free && self.frame > self.replay.last_frame()
    }

    fn refused(frame: u64, problem: String) -> Error {
        Error::setting("replay", format!("frame {frame}: {problem}"))
    }

    /// Plays the next frame; whether it was the last.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for an invalid event and for drawing failures, and the errors of writing pictures.
    pub(super) fn play(&mut self, shown: &mut WindowParts) -> Result<bool> {
        self.times.scale = shown.scale();
        if self.is_free {
            self.play_free(shown)?;
            return Ok(self.is_over());
        }
        let start = Instant::now();
        let lines: Vec<_> = self.replay.lines(self.frame).cloned().collect();
        for event in lines.iter().filter_map(|line| line.event.clone()) {
            let saves = event.saves();
            shown.event(event);
            // Saving reports later.
            if let Some(problem) = shown.viewer.state.message.clone().filter(|_| !saves) {
                return Err(Self::refused(self.frame, problem));
            }
        }
        shown.viewer.is_moving = lines.iter().any(|line| line.drag);
        if shown.viewer.is_moving {
            self.drag(shown)?;
            self.frame += 1;
            return Ok(self.is_over());
        }
        self.is_free = lines.iter().any(|line| line.free);
        self.dragged = None;
        if !self.is_free {
            shown.viewer.rest()?;
            if shown.follows_window {
                // The panes take the window's size in the first of the frames that show a change of it.
                shown.frame(false)?;
                shown.viewer.rest()?;
            }
        }
        let is_wanted = lines.iter().any(|line| line.window.is_some());
        if is_wanted {
            // egui places a new sheet correctly only once it knows the size of the sheet and of its texts.
            (0..2).try_for_each(|_| shown.frame(false).map(drop))?;
        }
        let (window, _) = shown.frame(is_wanted)?;
        self.times.frame_ms.push(milliseconds_since(start));
        if self.times.first_picture_ms.is_none() && shown.viewer.shown().is_some() {
            self.times.first_picture_ms = Some(milliseconds_since(self.started));
        }
        for line in lines {
            if let (Some(name), Some(picture)) = (&line.window, &window) {
                Target::check(name, false)?.write(picture)?;
            }
            if let (Some(name), Some(picture)) = (&line.screenshot, shown.viewer.shown()) {
                write_rgba_png(&picture, Path::new(name))?;
            }
        }
        let problem = shown.viewer.problem.as_deref().or(shown.viewer.lines.problem());
        if let Some(problem) = problem.map(str::to_owned).filter(|_| !self.is_free) {
            return Err(Self::refused(self.frame, problem));
        }
        self.frame += 1;
        Ok(self.is_over() || shown.is_over)
    }

    /// A frame that continues the work of the one before it.
    fn play_free(&mut self, shown: &mut WindowParts) -> Result<()> {
        let start = Instant::now();
        shown.viewer.take_reports()?;
        shown.frame(false)?;
        self.times.free_frame_ms.push(milliseconds_since(start));
        self.is_free = !shown.viewer.is_at_rest();
        match shown.viewer.problem.clone().filter(|_| !self.is_free) {
            Some(problem) => Err(Self::refused(self.frame - 1, problem)),
            None => Ok(()),
        }
    }

    /// A frame of a drag: waits until its picture is begun, and shows the newest one.
    fn drag(&mut self, shown: &mut WindowParts) -> Result<()> {
        let viewer = &mut shown.viewer;
        let (number, since) = *self.dragged.get_or_insert_with(|| (viewer.picture_number, Instant::now()));
        viewer.take_reports()?;
        viewer.ask();
        while !viewer.is_asked() {
            viewer.wait()?;
            viewer.ask();
        }
        let newest = viewer.picture_number;
        if newest != number {
            shown.frame(false)?;
            self.times.drag_frame_ms.push(milliseconds_since(since));
            self.dragged = Some((newest, Instant::now()));
        }
        Ok(())
    }
}
