//! Signal handling: the first signal lets work that takes a while end in good order, with its sentence; another one, half a second later or
//! more, stops at once. Schedulers and `timeout` send one signal to a program and to its group, so that it comes twice.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::sleep;
use std::time::Duration;

/// How soon a signal is noticed after which another one stops at once, and how long after that it does.
const NOTICED: Duration = Duration::from_millis(200);
const SAME_SIGNAL: Duration = Duration::from_millis(500);

/// Whether the run is asked to stop, by Ctrl-C or by a scheduler.
pub(super) struct Stop {
    is_asked: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Stop {
    /// From now on. Windows has Ctrl-C of the two; nobody sends the other there.
    pub(super) fn on_signals() -> Self {
        use signal_hook::consts::{SIGINT, SIGTERM};
        use signal_hook::flag::{register, register_conditional_shutdown, register_usize};
        let stop = Self { is_asked: Arc::default(), signal: Arc::default() };
        let is_long_ago: Arc<AtomicBool> = Arc::default();
        for signal in [SIGINT, SIGTERM] {
            // Where a handler cannot be had, a signal ends the run as ever.
            let _ = register_conditional_shutdown(signal, 128 + signal, is_long_ago.clone());
            let _ = register_usize(signal, stop.signal.clone(), signal.unsigned_abs() as usize);
            let _ = register(signal, stop.is_asked.clone());
        }
        // A handler cannot look at the clock. Nobody waits for this thread; without it signals only ask.
        let is_asked = stop.is_asked.clone();
        let _ = std::thread::Builder::new().spawn(move || {
            while !is_asked.load(Ordering::Relaxed) {
                sleep(NOTICED);
            }
            sleep(SAME_SIGNAL);
            is_long_ago.store(true, Ordering::Relaxed);
        });
        stop
    }

    /// Whether it is.
    pub(super) fn is_asked(&self) -> bool {
        self.is_asked.load(Ordering::Relaxed)
    }

    /// The signal's number.
    pub(super) fn signal(&self) -> u8 {
        u8::try_from(self.signal.load(Ordering::Relaxed)).unwrap_or_default()
    }
}

/// In a worker: terminals and schedulers send their signals to it too, but its run says when it has done enough.
pub(super) fn leave_to_the_run() {
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        let _ = signal_hook::flag::register(signal, Arc::default());
    }
}

/// Ends a worker whose run is gone, in the middle of its job: what the driver would do at an orderly end is not safe beside a
/// thread that draws. On Windows that thread has ended by then, whatever the end.
pub(super) fn end_at_once() -> ! {
    #[cfg(unix)]
    let _ = signal_hook::low_level::raise(signal_hook::consts::SIGKILL);
    std::process::exit(2)
}
