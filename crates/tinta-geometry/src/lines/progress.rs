//! Progress, cancellation and time limits of long work.

use crate::clock::Instant;
use crate::error::{Error, Result};
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The progress of long work, for another thread to watch or cancel.
///
/// Work that gets one checks it every few milliseconds.
///
/// ```
/// # fn main() -> tinta_geometry::Result<()> {
/// use std::time::Duration;
/// use tinta_geometry::lines::Progress;
/// use tinta_geometry::{Error, LineSettings, LoadOptions, Scene, SceneSettings, VisibleLines, load};
///
/// let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
/// let scene = Scene::new([mesh], &SceneSettings::default())?;
///
/// let no_time = Progress::within(Duration::ZERO);
/// let ended = VisibleLines::with_progress(&scene, &LineSettings::default(), &no_time);
/// assert!(matches!(ended, Err(Error::OutOfTime { .. })));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Default)]
pub struct Progress {
    phase: AtomicU8,
    done: AtomicUsize,
    total: AtomicUsize,
    compared: AtomicU64,
    is_cancelled: Arc<AtomicBool>,
    /// When each phase began, in order.
    begins: Mutex<Vec<(Phase, Instant)>>,
    deadline: Option<Deadline>,
}

/// The current phase of work on lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Models are read; not counted.
    Reading,
    /// Preparation: edges, faces and their hierarchies; not counted.
    Preparing,
    /// Finds intersections of faces; counts groups of faces.
    Intersections,
    /// Decides the visibility of lines; counts lines.
    Lines,
    /// Decides the visibility of smooth silhouettes; counts their segments.
    Contours,
    /// Removes lines that are too short; counts possible sides of slivers.
    TooShort,
    /// Cuts the view into areas; not counted.
    Areas,
    /// OpenGL draws; not counted.
    Drawing,
}

impl Phase {
    /// The name of the work, for people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Reading => "reading the model",
            Self::Preparing => "preparing lines",
            Self::Intersections => "finding intersections",
            Self::Lines => "finding lines",
            Self::Contours => "finding smooth silhouettes",
            Self::TooShort => "leaving out specks",
            Self::Areas => "finding areas",
            Self::Drawing => "drawing",
        }
    }
}

#[derive(Debug, Clone)]
struct Deadline {
    end: Instant,
    limit: Duration,
}

impl Progress {
    /// Ends the work with [`Error::OutOfTime`] if it takes longer than `limit` from now.
    pub fn within(limit: Duration) -> Self {
        // A limit beyond the clock's range is no limit.
        let deadline = Instant::now().checked_add(limit).map(|end| Deadline { end, limit });
        Self { deadline, ..Self::default() }
    }

    /// The progress of work beside this one: it ends with this one, and has phases of its own.
    #[must_use]
    pub fn beside(&self) -> Self {
        Self { is_cancelled: self.is_cancelled.clone(), deadline: self.deadline.clone(), ..Self::default() }
    }

    /// The current phase.
    pub fn phase(&self) -> Phase {
        match self.phase.load(Ordering::Relaxed) {
            0 => Phase::Reading,
            1 => Phase::Preparing,
            2 => Phase::Intersections,
            3 => Phase::Lines,
            4 => Phase::Contours,
            5 => Phase::TooShort,
            6 => Phase::Areas,
            _ => Phase::Drawing,
        }
    }

    /// Finished steps of the current phase and their total; both are 0 in a phase that counts no steps.
    pub fn state(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    /// Bounding boxes tested so far in this phase, where they are counted. They measure the work better than steps
    /// do, because steps differ in cost.
    pub fn compared(&self) -> u64 {
        self.compared.load(Ordering::Relaxed)
    }

    /// Cancels the work, which then soon ends with [`Error::Cancelled`].
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`Progress::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// Whether the work must end now.
    pub(crate) fn is_over(&self) -> bool {
        self.is_cancelled() || self.is_late()
    }

    fn is_late(&self) -> bool {
        self.deadline.as_ref().is_some_and(|deadline| Instant::now() >= deadline.end)
    }

    /// Returns an error if the work must end: cancelled or out of time.
    pub(crate) fn go_on(&self) -> Result<()> {
        if self.is_cancelled() {
            return Err(Error::Cancelled);
        }
        match &self.deadline {
            Some(deadline) if self.is_late() => Err(Error::OutOfTime { seconds: deadline.limit.as_secs_f64() }),
            _ => Ok(()),
        }
    }

    /// How long each phase took until now, milliseconds, in the order of their first beginnings.
    pub fn times(&self) -> Vec<(Phase, f64)> {
        let begins = self.begins.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let ends = begins.iter().skip(1).map(|(_, begin)| *begin).chain([Instant::now()]);
        let mut times: Vec<(Phase, f64)> = Vec::new();
        for ((phase, begin), end) in begins.iter().zip(ends) {
            let ms = end.duration_since(*begin).as_secs_f64() * 1e3;
            match times.iter_mut().find(|(known, _)| known == phase) {
                Some((_, sum)) => *sum += ms,
                None => times.push((*phase, ms)),
            }
        }
        times
    }

    /// Begins a phase of so many steps.
    pub fn begin(&self, phase: Phase, total: usize) {
        let mut begins = self.begins.lock().unwrap_or_else(PoisonError::into_inner);
        if begins.last().is_none_or(|(last, _)| *last != phase) {
            begins.push((phase, Instant::now()));
        }
        drop(begins);
        self.total.store(0, Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
        self.compared.store(0, Ordering::Relaxed);
        self.phase.store(phase as u8, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// Adds finished steps and the boxes tested for them.
    pub(crate) fn advance(&self, count: usize, compared: u64) {
        self.compared.fetch_add(compared, Ordering::Relaxed);
        self.done.fetch_add(count, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_listed_once_in_the_order_of_their_beginnings() {
        let progress = Progress::default();
        assert_eq!(progress.times(), []);
        for phase in [Phase::Preparing, Phase::Lines, Phase::TooShort, Phase::TooShort, Phase::Lines, Phase::Areas] {
            progress.begin(phase, 0);
            assert_eq!(progress.phase(), phase);
        }
        let phases: Vec<Phase> = progress.times().into_iter().map(|(phase, _)| phase).collect();
        assert_eq!(phases, [Phase::Preparing, Phase::Lines, Phase::TooShort, Phase::Areas]);
    }
}
