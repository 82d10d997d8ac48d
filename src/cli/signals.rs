//! Signal handling: the first signal lets long work end in good order, with its sentence; another one, half a second later or
//! more, stops at once. Schedulers and `timeout` send one signal both to a program and to its group, which makes it arrive twice.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::sleep;
use std::time::Duration;

/// How soon a signal is noticed, and how long afterwards another one stops at once.
const NOTICED: Duration = Duration::from_millis(200);
const SAME_SIGNAL: Duration = Duration::from_millis(500);

/// Whether Ctrl-C or a scheduler has requested a stop.
pub(super) struct Stop {
    is_asked: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Stop {
    /// Starts to listen for signals. On Windows only Ctrl-C exists.
    pub(super) fn on_signals() -> Self {
        use signal_hook::consts::{SIGINT, SIGTERM};
        use signal_hook::flag::{register, register_conditional_shutdown, register_usize};
        let stop = Self { is_asked: Arc::default(), signal: Arc::default() };
        let is_long_ago: Arc<AtomicBool> = Arc::default();
        for signal in [SIGINT, SIGTERM] {
            // If a handler cannot be registered, a signal ends the run as usual.
            let _ = register_conditional_shutdown(signal, 128 + signal, is_long_ago.clone());
            let _ = register_usize(signal, stop.signal.clone(), signal.unsigned_abs() as usize);
            let _ = register(signal, stop.is_asked.clone());
        }
        // A handler cannot read the clock. The program does not wait for this thread; without it signals only request a stop.
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

/// In a worker: terminals and schedulers send it their signals too, but its run decides when it stops.
pub(super) fn leave_to_the_run() {
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        let _ = signal_hook::flag::register(signal, Arc::default());
    }
}

/// Ends a worker whose run is gone, in the middle of its job: the driver's orderly shutdown is unsafe while another thread draws.
/// On Windows that thread has ended by then.
pub(super) fn end_at_once() -> ! {
    #[cfg(unix)]
    let _ = signal_hook::low_level::raise(signal_hook::consts::SIGKILL);
    std::process::exit(2)
}
