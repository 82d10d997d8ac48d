//! Turns: of one software driver's contexts in this process only one is at work at a time.
//!
//! Mesa's llvmpipe has one screen for all contexts of a device, and one for all of OSMesa. Before it reads or replaces a
//! texture it looks through what every context of that screen has yet to draw, without a lock and while their threads free it
//! (`lp_scene_is_resource_referenced`; seen in 22.3): two of EGL's at work at once ended in a segmentation fault in four of
//! seven runs of 20 to 30 s that did nothing else; two of OSMesa's, in three runs, in none. EGL's
//! screen and OSMesa's do not know of each other.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Whose turn it is among the contexts of one screen.
pub struct Turns(Mutex<()>);

/// Until it is dropped, no other context of the screen is at work.
pub struct Turn {
    _guard: MutexGuard<'static, ()>,
}

/// Those of EGL's software device, of which Mesa has one.
pub static OF_EGL: Turns = Turns(Mutex::new(()));

/// Those of OSMesa.
pub static OF_OSMESA: Turns = Turns(Mutex::new(()));

impl Turns {
    /// Waits for a turn. A thread that has one must not ask for another.
    pub fn take(&'static self) -> Turn {
        // Nothing is guarded that a panic could leave half done.
        Turn { _guard: self.0.lock().unwrap_or_else(PoisonError::into_inner) }
    }

    /// Whether a context of this screen is at work.
    #[cfg(test)]
    pub fn is_taken(&'static self) -> bool {
        self.0.try_lock().is_err()
    }
}
