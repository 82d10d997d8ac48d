//! Whether there is a standard output. Before `main` begins, Rust opens `/dev/null` in place of a closed one, and output there is
//! lost without an error; this check therefore runs earlier.

use std::sync::atomic::{AtomicBool, Ordering};

static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

/// Whether standard output was closed when the program began, as with `>&-`. Linux only; false on other systems.
pub(super) fn was_closed() -> bool {
    WAS_CLOSED.load(Ordering::Relaxed)
}

/// A function that the system's loader calls before Rust's runtime.
#[cfg(target_os = "linux")]
#[expect(unsafe_code, reason = "nothing in Rust runs before /dev/null is in its place")]
// SAFETY: the section holds pointers to functions of the C ABI, as here. `look` makes two system calls and stores a value; it
// does not need Rust's runtime, and cannot unwind.
#[unsafe(link_section = ".init_array")]
#[used]
static LOOK: extern "C" fn() = look;

#[cfg(target_os = "linux")]
extern "C" fn look() {
    use rustix::fs::readlink;
    // Without /proc the result is unknown.
    let is_there = |path: &str| readlink(path, Vec::new()).is_ok();
    WAS_CLOSED.store(is_there("/proc/self") && !is_there("/proc/self/fd/1"), Ordering::Relaxed);
}
