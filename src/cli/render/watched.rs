//! Work on a drawing with its time limit, its progress bar and its signals.

use super::super::progress::Progress;
use super::super::signals::Stop;
use super::rendering::Rendering;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;
use tinta::lines::{Phase, Progress as LineProgress};

pub(super) fn is_stopped(stop: Option<&Stop>) -> bool {
    stop.is_some_and(Stop::is_asked)
}

/// Progress of the lines, whose time limit starts now.
pub(super) fn progress(rendering: &Rendering<'_>) -> LineProgress {
    let Some(seconds) = rendering.run.within else { return LineProgress::default() };
    LineProgress::within(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX))
}

/// How often the progress bar is looked after, and how long work takes before it gets one.
const GLANCE: Duration = Duration::from_millis(200);

/// Draws while another thread shows progress and watches for signals.
pub(super) fn watched<T>(progress: &LineProgress, stop: Option<&Stop>, work: impl FnOnce() -> T) -> T {
    let (done, is_done) = std::sync::mpsc::channel::<()>();
    std::thread::scope(|scope| {
        let watch = move || {
            let mut bar: Option<(Phase, Progress)> = None;
            // Until the other end is gone.
            while is_done.recv_timeout(GLANCE) == Err(RecvTimeoutError::Timeout) {
                if stop.is_some_and(Stop::is_asked) {
                    progress.cancel();
                }
                let (phase, (done, total)) = (progress.phase(), progress.state());
                // The time left in a phase is computed from its own steps.
                let (_, bar) = match bar.take().filter(|(known, _)| *known == phase) {
                    Some(known) => bar.insert(known),
                    None => bar.insert((phase, Progress::new(phase.words(), total as u64))),
                };
                if total == 0 { bar.wait() } else { bar.set(done as u64, total as u64) }
            }
        };
        // Without the thread progress is not shown.
        let _ = std::thread::Builder::new().spawn_scoped(scope, watch);
        // Also if the work panics.
        let _done = done;
        work()
    })
}
