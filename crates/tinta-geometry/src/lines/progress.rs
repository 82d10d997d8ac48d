//! How far long work is, when it is to end before it is done, and what becomes then of what is done.

use crate::clock::Instant;
use crate::error::{Error, Result};
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

/// How far the work is, for whoever watches from another thread, who may also ask for it to be given up.
///
/// Work that is given one looks at it after each few milliseconds' worth.
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
    is_cancelled: AtomicBool,
    deadline: Option<Deadline>,
    keeps_part: bool,
    /// How much longer drawing what there is may take, where a part is asked for.
    grace: Duration,
}

/// What work on lines is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Getting ready: edges, faces, hierarchies of them; nobody counts these.
    Preparing,
    /// Looking for places where faces pass through one another; groups of faces count.
    Intersections,
    /// Deciding what is seen of each line; lines count.
    Lines,
    /// Deciding what is seen of smooth silhouettes; their pieces count.
    Contours,
    /// Leaving out what is too short to be a line; what may be one side of a sliver counts.
    TooShort,
}

#[derive(Debug)]
struct Deadline {
    end: Instant,
    /// The time that was given.
    limit: Duration,
}

impl Progress {
    /// Of work that ends with [`Error::OutOfTime`] when it takes longer than this from now on.
    pub fn within(limit: Duration) -> Self {
        // A time that no clock reaches is no limit.
        let deadline = Instant::now().checked_add(limit).map(|end| Deadline { end, limit });
        Self { deadline, ..Self::default() }
    }

    /// Of work that then ends with what is done of it: lines that are decided stay, each as a whole, and
    /// [`VisibleLines::undecided`](super::VisibleLines::undecided) says how many are missing. While no line is decided, it ends
    /// with [`Error::OutOfTime`] nevertheless.
    ///
    /// Leaving out specks may take a tenth of the time longer, and half a second; what is not done by then is left, see
    /// [`VisibleLines::has_specks`](super::VisibleLines::has_specks).
    pub fn within_or_part(limit: Duration) -> Self {
        const LEAST: Duration = Duration::from_millis(500);
        Self { keeps_part: true, grace: (limit / 10).saturating_add(LEAST), ..Self::within(limit) }
    }

    /// The same without a moment more.
    #[cfg(test)]
    pub(crate) fn exactly_within_or_part(limit: Duration) -> Self {
        Self { grace: Duration::ZERO, ..Self::within_or_part(limit) }
    }

    /// What the work is at.
    pub fn phase(&self) -> Phase {
        match self.phase.load(Ordering::Relaxed) {
            0 => Phase::Preparing,
            1 => Phase::Intersections,
            2 => Phase::Lines,
            3 => Phase::Contours,
            _ => Phase::TooShort,
        }
    }

    /// How much of its phase is done, and how much there is to do: 0 and 0 while nobody counts.
    pub fn state(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    /// How many boxes of hierarchies were looked at for what is done of this phase, as far as that is counted: what takes the time, so that the
    /// time left can be told from it where steps differ.
    pub fn compared(&self) -> u64 {
        self.compared.load(Ordering::Relaxed)
    }

    /// Asks for the work to be given up: it then ends soon with [`Error::Cancelled`].
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked to be given up.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// Whether the work is to end now.
    pub(crate) fn is_over(&self) -> bool {
        self.is_cancelled() || self.is_late()
    }

    fn is_late(&self) -> bool {
        self.deadline.as_ref().is_some_and(|deadline| Instant::now() >= deadline.end)
    }

    /// Refuses to go on where the work is to end.
    pub(crate) fn go_on(&self) -> Result<()> {
        if self.is_cancelled() {
            return Err(Error::Cancelled);
        }
        match &self.deadline {
            Some(deadline) if self.is_late() => {
                Err(Error::OutOfTime { seconds: deadline.limit.as_secs_f64(), asked_for_part: self.keeps_part })
            }
            _ => Ok(()),
        }
    }

    /// The same of what comes after the lines, which may take a little longer where a part of them is asked for.
    pub(crate) fn go_on_drawing(&self) -> Result<()> {
        let is_given_more = |deadline: &Deadline| deadline.end.elapsed() < self.grace;
        if self.keeps_part && !self.is_cancelled() && self.deadline.as_ref().is_none_or(is_given_more) {
            return Ok(());
        }
        self.go_on()
    }

    /// How many lines were not decided, of work that has ended.
    pub(crate) fn undecided(&self) -> Result<usize> {
        let (done, total) = self.state();
        match total - done {
            0 => Ok(0),
            left if self.keeps_part && done > 0 && !self.is_cancelled() => Ok(left),
            left => self.go_on().map(|()| left),
        }
    }

    pub(crate) fn begin(&self, phase: Phase, total: usize) {
        self.total.store(0, Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
        self.compared.store(0, Ordering::Relaxed);
        self.phase.store(phase as u8, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// So many steps more are done, for which so many boxes were looked at.
    pub(crate) fn advance(&self, count: usize, compared: u64) {
        self.compared.fetch_add(compared, Ordering::Relaxed);
        self.done.fetch_add(count, Ordering::Relaxed);
    }
}
