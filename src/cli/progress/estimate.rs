//! Estimates the remaining time of steps of several kinds, from the remaining steps of each kind.
//!
//! Takes the number of steps of each kind with their expected times, then each step's kind and end time; returns the remaining
//! seconds. It reads no clock.

/// Steps of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// How many.
    pub count: usize,
    /// How long one is expected to take, seconds.
    pub seconds: f64,
}

impl Steps {
    /// The expected time of all of them, seconds.
    pub fn total(self) -> f64 {
        self.count as f64 * self.seconds
    }
}

/// Work under way.
#[derive(Debug)]
pub(super) struct Estimate {
    kinds: Vec<Kind>,
    /// When the last step ended, seconds.
    last: f64,
}

#[derive(Debug)]
struct Kind {
    expected: Steps,
    /// Steps that were done, and how long they took together, seconds.
    done: usize,
    took: f64,
    /// Steps that need not be done.
    skipped: usize,
}

impl Estimate {
    /// Work that begins at time 0.
    pub(super) fn new(kinds: &[Steps]) -> Self {
        let kind = |expected: &Steps| Kind { expected: *expected, done: 0, took: 0.0, skipped: 0 };
        Self { kinds: kinds.iter().map(kind).collect(), last: 0.0 }
    }

    /// A step of this kind has ended now, seconds from the beginning.
    pub(super) fn step(&mut self, kind: usize, now: f64) {
        if let Some(kind) = self.kinds.get_mut(kind) {
            kind.done += 1;
            kind.took += (now - self.last).max(0.0);
        }
        self.last = now;
    }

    /// Removes so many steps of this kind.
    pub(super) fn skip(&mut self, kind: usize, count: usize) {
        if let Some(kind) = self.kinds.get_mut(kind) {
            kind.skipped += count;
        }
    }

    /// How long the work will still take, seconds.
    ///
    /// A kind of step already measured continues at its measured rate; other kinds use the expected time, scaled by the steps so
    /// far.
    pub(super) fn left(&self) -> f64 {
        let took: f64 = self.kinds.iter().map(|kind| kind.took).sum();
        let expected: f64 = self.kinds.iter().map(|kind| kind.done as f64 * kind.expected.seconds).sum();
        let pace = if expected > 0.0 { took / expected } else { 1.0 };
        let left = |kind: &Kind| {
            let one = if kind.done > 0 { kind.took / kind.done as f64 } else { kind.expected.seconds * pace };
            kind.open() as f64 * one
        };
        self.kinds.iter().map(left).sum()
    }

    /// The finished share of the work, in time.
    pub(super) fn share(&self) -> f64 {
        let took: f64 = self.kinds.iter().map(|kind| kind.took).sum();
        let all = took + self.left();
        if all > 0.0 { took / all } else { 0.0 }
    }
}

impl Kind {
    fn open(&self) -> usize {
        self.expected.count.saturating_sub(self.done + self.skipped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOW: Steps = Steps { count: 10, seconds: 4.0 };
    const FAST: Steps = Steps { count: 100, seconds: 0.1 };

    #[test]
    fn at_first_all_is_left_that_is_expected() {
        let estimate = Estimate::new(&[SLOW, FAST]);
        assert_eq!((estimate.left(), estimate.share()), (SLOW.total() + FAST.total(), 0.0));
        assert_eq!(Estimate::new(&[]).left(), 0.0);
    }

    #[test]
    fn slow_steps_at_first_say_nothing_of_fast_ones_that_follow() {
        // The count of steps alone, ten of a hundred and ten, would predict six and a half minutes.
        let mut estimate = Estimate::new(&[SLOW, FAST]);
        (1..=10).for_each(|step| estimate.step(0, f64::from(step) * 4.0));
        assert!((estimate.left() - 10.0).abs() < 1e-9, "{}", estimate.left());
        assert!((estimate.share() - 0.8).abs() < 1e-9);
    }

    #[test]
    fn fast_steps_at_first_say_nothing_of_slow_ones_that_follow() {
        let mut estimate = Estimate::new(&[FAST, SLOW]);
        (1..=100).for_each(|step| estimate.step(0, f64::from(step) * 0.1));
        assert!((estimate.left() - 40.0).abs() < 1e-9, "{}", estimate.left());
    }

    #[test]
    fn a_machine_of_half_the_speed_needs_twice_the_time_for_what_it_has_not_done_yet() {
        let mut estimate = Estimate::new(&[SLOW, FAST]);
        estimate.step(0, 8.0);
        assert!((estimate.left() - (9.0 * 8.0 + 20.0)).abs() < 1e-9, "{}", estimate.left());
        // Measured times override expected ones.
        estimate.step(1, 9.0);
        assert!((estimate.left() - (9.0 * 8.0 + 99.0)).abs() < 1e-9, "{}", estimate.left());
    }

    #[test]
    fn what_is_skipped_is_not_left_and_nothing_is_less_than_nothing() {
        let mut estimate = Estimate::new(&[SLOW, FAST]);
        estimate.skip(0, 9);
        estimate.skip(1, 100);
        assert_eq!(estimate.left(), 4.0);
        estimate.step(0, 3.0);
        estimate.step(0, 3.0);
        estimate.step(7, 3.0);
        assert_eq!((estimate.left(), estimate.share()), (0.0, 1.0));
    }

    #[test]
    fn the_time_left_falls_as_time_passes_where_steps_take_what_they_did_before() {
        let mut estimate = Estimate::new(&[SLOW, FAST]);
        let (mut now, mut before) = (0.0, f64::INFINITY);
        for turn in 0..10 {
            now += 5.0;
            estimate.step(0, now);
            for _ in 0..10 {
                now += 0.2;
                estimate.step(1, now);
                if turn > 0 {
                    assert!(estimate.left() < before, "{now}: {} after {before}", estimate.left());
                }
                before = estimate.left();
            }
        }
        assert!(before.abs() < 1e-9);
    }
}
