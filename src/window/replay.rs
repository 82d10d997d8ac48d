//! A recording: events by frame number, and pictures to take, one JSON object a line.
//!
//! ```text
//! {"frame": 0, "event": {"resize": [320, 240]}}
//! {"frame": 1, "event": {"turn": [0.25, 0.0]}, "screenshot": "turned.png"}
//! {"frame": 2, "event": "key-sheet", "window": "keys.png"}
//! ```
//!
//! A frame's events happen first, then its picture is drawn, then it is saved: `screenshot` has the panes, `window` the whole
//! window.

use crate::error::{Error, Result};
use crate::window::values::event::ViewerEvent;
use serde::Deserialize;
use std::path::Path;

/// A line of a recording.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Line {
    /// The frame's number, from 0; by default the same as in the previous line.
    pub frame: Option<u64>,
    /// The event.
    pub event: Option<ViewerEvent>,
    /// A file for the picture of the panes.
    pub screenshot: Option<String>,
    /// A file for the picture of the window.
    pub window: Option<String>,
    /// Frames run without waiting for the work that the event starts; the record has each frame's time.
    #[serde(default)]
    pub free: bool,
    /// The frame is one of a drag: it shows the newest finished picture as soon as its own is begun.
    #[serde(default)]
    pub drag: bool,
}

/// A recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Replay {
    lines: Vec<(u64, Line)>,
}

/// The longest recording read, bytes.
const LONGEST: u64 = 16 << 20;

/// Highest number of a frame.
const LAST_FRAME: u64 = 1_000_000;

impl Replay {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the line that cannot be understood.
    pub fn read(path: &Path) -> Result<Self> {
        let refused = |problem: String| Error::value("replay", path.display(), problem);
        let metadata = std::fs::metadata(path);
        let text = match metadata {
            Ok(file) if file.len() > LONGEST => {
                return Err(refused(format!("it is longer than {LONGEST} bytes; cut it")));
            }
            Ok(file) if !file.is_file() => return Err(refused("this is not a file; name a recording".to_owned())),
            _ => std::fs::read_to_string(path),
        };
        let text = text.map_err(|error| refused(format!("it cannot be read ({error}); check the name")))?;
        Self::parse(&text).map_err(refused)
    }

    /// Reads a recording's text.
    ///
    /// # Errors
    ///
    /// A sentence with the number of the line.
    pub fn parse(text: &str) -> std::result::Result<Self, String> {
        let mut lines = Vec::new();
        let mut frame = 0;
        for (number, text) in text.lines().enumerate().filter(|(_, text)| !text.trim().is_empty()) {
            let number = number + 1;
            let line: Line = serde_json::from_str(text)
                .map_err(|error| format!("line {number} is not a step of a recording ({error})"))?;
            let this = line.frame.unwrap_or(frame);
            if this < frame || this > LAST_FRAME {
                return Err(format!("line {number}: frame numbers must increase, up to {LAST_FRAME}"));
            }
            frame = this;
            lines.push((frame, line));
        }
        if lines.is_empty() {
            return Err("it has no line; write one such as {\"frame\": 0, \"screenshot\": \"a.png\"}".to_owned());
        }
        Ok(Self { lines })
    }

    /// The lines of a frame.
    pub(crate) fn lines(&self, frame: u64) -> impl Iterator<Item = &Line> {
        self.lines.iter().filter(move |(number, _)| *number == frame).map(|(_, line)| line)
    }

    /// The number of the last frame.
    pub(in crate::window) fn last_frame(&self) -> u64 {
        self.lines.last().map_or(0, |(frame, _)| *frame)
    }

    /// Whether it gives the size of the drawing area; otherwise the window decides.
    pub(crate) fn has_sizes(&self) -> bool {
        self.lines.iter().any(|(_, line)| matches!(line.event, Some(ViewerEvent::Resize(_))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_without_a_number_belong_to_the_frame_before() {
        let text =
            "{\"event\": \"reset\"}\n\n{\"frame\": 2, \"event\": {\"zoom\": 2.0}}\n{\"screenshot\": \"a.png\"}\n";
        let replay = Replay::parse(text).unwrap();
        assert_eq!(replay.last_frame(), 2);
        assert_eq!(replay.lines(0).count(), 1);
        assert_eq!(replay.lines(1).count(), 0);
        let second: Vec<&Line> = replay.lines(2).collect();
        assert_eq!(second[0].event, Some(ViewerEvent::Zoom(2.0)));
        assert_eq!(second[1].screenshot.as_deref(), Some("a.png"));
        assert!(!replay.has_sizes());
    }

    #[test]
    fn what_is_no_recording_is_refused_by_its_line() {
        for (text, words) in [
            ("", "no line"),
            ("{\"event\": \"reset\"}\n{\"event\": \"jump\"}", "line 2"),
            ("{\"frame\": 3}\n{\"frame\": 2}", "line 2: frame numbers must increase"),
            ("{\"frame\": -1}", "line 1"),
            ("{\"picture\": \"a.png\"}", "line 1"),
        ] {
            let problem = Replay::parse(text).unwrap_err();
            assert!(problem.contains(words), "{text}: {problem}");
        }
    }
}
