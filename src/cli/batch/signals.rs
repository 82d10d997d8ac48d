//! A run that is asked to stop ends the jobs it has begun and writes them down; asked again, it stops at once.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Set once the run is asked to stop, by Ctrl-C or by a scheduler.
#[cfg(unix)]
pub fn stopped() -> Arc<AtomicBool> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag::{register, register_conditional_shutdown};
    let stopped = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // In this order: the first signal finds the flag unset. Where a handler cannot be had, a signal ends the run as ever.
        let _ = register_conditional_shutdown(signal, 128 + signal, stopped.clone());
        let _ = register(signal, stopped.clone());
    }
    stopped
}

/// Elsewhere a run ends at once, and what is written down stays.
#[cfg(not(unix))]
pub fn stopped() -> Arc<AtomicBool> {
    Arc::default()
}

/// In a worker: terminals and schedulers send their signals to it too, but its run says when it has done enough.
pub fn leave_to_the_run() {
    #[cfg(unix)]
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        let _ = signal_hook::flag::register(signal, Arc::default());
    }
}

/// Ends a worker whose run is gone, in the middle of its job: what the driver would do at an orderly end is not safe beside a
/// thread that draws.
pub fn end_at_once() -> ! {
    #[cfg(unix)]
    let _ = signal_hook::low_level::raise(signal_hook::consts::SIGKILL);
    std::process::exit(2)
}
