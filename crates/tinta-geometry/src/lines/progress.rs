//! How far long work is, and when it is to end before it is done.

use crate::clock::Instant;
use crate::error::{Error, Result};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
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
    done: AtomicUsize,
    total: AtomicUsize,
    is_cancelled: AtomicBool,
    deadline: Option<Deadline>,
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

    /// Lines decided and lines in all; 0 and 0 until it is known how many there are.
    pub fn state(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
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
            Some(deadline) if self.is_late() => Err(Error::OutOfTime { seconds: deadline.limit.as_secs_f64() }),
            _ => Ok(()),
        }
    }

    pub(crate) fn begin(&self, total: usize) {
        self.total.store(total, Ordering::Relaxed);
    }

    pub(crate) fn advance(&self, count: usize) {
        self.done.fetch_add(count, Ordering::Relaxed);
    }
}
