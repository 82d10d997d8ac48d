//! A lock that lets only one context of a software driver work at a time in this process.
//!
//! Mesa's llvmpipe has one screen for all contexts of a device, and one for all of OSMesa. Before it reads or replaces a texture
//! it searches the pending draws of every context of that screen. It takes no lock, while their threads free those draws
//! (`lp_scene_is_resource_referenced`; seen in 22.3). Two EGL contexts at work at once ended in a segmentation fault in four of
//! seven runs of 20 to 30 s that did nothing else. Two OSMesa contexts failed in none of three runs. EGL's screen and OSMesa's
//! are independent.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The lock that a working context of a screen holds.
pub(super) struct ContextLock(Mutex<()>);

/// A guard that keeps the screen's other contexts waiting.
pub(super) struct ContextGuard {
    _guard: MutexGuard<'static, ()>,
}

/// The lock of EGL's software device; Mesa has one.
pub(super) static OF_EGL: ContextLock = ContextLock(Mutex::new(()));

/// The lock of EGL's surfaceless platform, which has a separate screen.
#[cfg(all(unix, not(target_os = "macos")))]
pub(super) static OF_SURFACELESS: ContextLock = ContextLock(Mutex::new(()));

/// The lock of WGL's contexts, including the window's: Mesa's library for Windows has one screen for all.
#[cfg(windows)]
pub(super) static OF_WGL: ContextLock = ContextLock(Mutex::new(()));

/// The lock of CGL's contexts.
#[cfg(target_os = "macos")]
pub(super) static OF_CGL: ContextLock = ContextLock(Mutex::new(()));

/// The lock of OSMesa's contexts.
pub(super) static OF_OSMESA: ContextLock = ContextLock(Mutex::new(()));

impl ContextLock {
    /// Waits for the lock. A thread must not lock it twice.
    pub(super) fn lock(&'static self) -> ContextGuard {
        // The lock guards no data that a panic could leave half done.
        ContextGuard { _guard: self.0.lock().unwrap_or_else(PoisonError::into_inner) }
    }

    /// Whether a context of this screen is at work.
    #[cfg(all(test, unix, not(target_os = "macos")))]
    pub(super) fn is_locked(&'static self) -> bool {
        self.0.try_lock().is_err()
    }
}
