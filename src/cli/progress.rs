//! A progress bar for commands that take a while: on standard error, and only where that is a terminal.

mod estimate;

use super::messages::is_captured;
use estimate::Estimate;
pub(super) use estimate::Steps;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// Disappears when it is dropped, so that a message after it stands in a line of its own.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// A bar for `count` steps with the word for what is done, such as "drawing".
    pub(super) fn new(what: &'static str, count: u64) -> Self {
        let progress = Self(bar(what, count));
        progress.show_share();
        progress
    }

    fn show_share(&self) {
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {pos}/{len}, {eta} left") {
            self.0.set_style(style.progress_chars("=> "));
        }
    }

    /// So many steps are done of so many.
    pub(super) fn set(&self, done: u64, count: u64) {
        if self.0.length() != Some(count) {
            self.show_share();
            self.0.set_length(count);
        }
        self.0.set_position(done);
    }

    /// Nothing is known yet of how much there is to do.
    pub(super) fn wait(&self) {
        self.0.set_length(u64::MAX);
        if let Ok(style) = ProgressStyle::with_template("{msg}, {elapsed} so far") {
            self.0.set_style(style);
        }
        self.0.tick();
    }

    /// One step more is done.
    pub(super) fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar of so many steps with the word for what is done.
fn bar(what: &'static str, count: u64) -> ProgressBar {
    // Draws nothing unless standard error is a terminal, and nothing for a job of a batch, which has a bar of its own.
    let target = if is_captured() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(Some(count), target);
    bar.set_message(what);
    bar
}

/// A bar for steps of several kinds, whose length and time left go by how long each kind takes.
pub(super) struct TimedProgress {
    bar: ProgressBar,
    estimate: RefCell<Estimate>,
    start: Instant,
}

impl TimedProgress {
    /// How finely the bar's length is told.
    const PARTS: u64 = 1000;

    /// A bar with the word for what is done, such as "measuring", that begins now.
    pub(super) fn new(what: &'static str, kinds: &[Steps]) -> Self {
        let bar = bar(what, Self::PARTS);
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {prefix} left") {
            bar.set_style(style.progress_chars("=> "));
        }
        let progress = Self { bar, estimate: RefCell::new(Estimate::new(kinds)), start: Instant::now() };
        progress.show();
        progress
    }

    /// A step of this kind is done.
    pub(super) fn step(&self, kind: usize) {
        self.estimate.borrow_mut().step(kind, self.start.elapsed().as_secs_f64());
        self.show();
    }

    /// So many steps of this kind need not be done.
    pub(super) fn skip(&self, kind: usize, count: usize) {
        self.estimate.borrow_mut().skip(kind, count);
        self.show();
    }

    fn show(&self) {
        let estimate = self.estimate.borrow();
        let left = Duration::try_from_secs_f64(estimate.left()).unwrap_or_default();
        self.bar.set_prefix(format!("{:#}", HumanDuration(left)));
        self.bar.set_position((estimate.share() * Self::PARTS as f64) as u64);
    }
}

impl Drop for TimedProgress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
