//! A bar that goes by time.

use super::bar;
use super::estimate::{Estimate, Steps};
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// A bar for steps of several kinds; its length and remaining time account for the time of each kind.
#[derive(Debug)]
pub struct TimedProgress {
    bar: ProgressBar,
    estimate: RefCell<Estimate>,
    start: Instant,
}

impl TimedProgress {
    /// Resolution of the bar.
    const PARTS: u64 = 1000;

    /// A bar with the name of the work, such as "measuring", that begins now.
    pub fn new(what: &'static str, kinds: &[Steps]) -> Self {
        let bar = bar(what, Self::PARTS);
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {prefix} left") {
            bar.set_style(style.progress_chars("=> "));
        }
        let progress = Self { bar, estimate: RefCell::new(Estimate::new(kinds)), start: Instant::now() };
        progress.show();
        progress
    }

    /// A step of this kind is done.
    pub fn step(&self, kind: usize) {
        self.estimate.borrow_mut().step(kind, self.start.elapsed().as_secs_f64());
        self.show();
    }

    /// Removes so many steps of this kind.
    pub fn skip(&self, kind: usize, count: usize) {
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
