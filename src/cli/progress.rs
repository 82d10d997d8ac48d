//! A progress bar for long commands: on standard error, and only if that is a terminal.

mod estimate;
mod timed;

use super::messages::is_captured;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
pub use {estimate::Steps, timed::TimedProgress};

/// Disappears when dropped; a later message then starts on a clear line.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for `count` steps with the name of the work, such as "drawing".
    pub fn new(what: &'static str, count: u64) -> Self {
        let progress = Self(bar(what, count));
        progress.show_share();
        progress
    }

    fn show_share(&self) {
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {pos}/{len}, {eta} left") {
            self.0.set_style(style.progress_chars("=> "));
        }
    }

    /// Sets the number of finished steps and their total.
    pub fn set(&self, done: u64, count: u64) {
        if self.0.length() != Some(count) {
            self.0.set_length(count);
            self.show_share();
        }
        self.0.set_position(done);
    }

    /// The amount of work is still unknown.
    pub(crate) fn wait(&self) {
        if let Ok(style) = ProgressStyle::with_template("{msg}, {elapsed} so far") {
            self.0.set_style(style);
        }
        self.0.set_length(u64::MAX);
        self.0.tick();
    }

    /// One step more is done.
    pub(crate) fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar of so many steps with the name of the work.
fn bar(what: &'static str, count: u64) -> ProgressBar {
    // Draws nothing unless standard error is a terminal, and nothing for a job of a batch, which has its own bar.
    let target = if is_captured() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    // Without drawing: the style comes next.
    ProgressBar::with_draw_target(Some(count), target).with_message(what)
}
