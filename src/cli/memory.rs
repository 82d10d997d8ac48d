//! How glibc hands memory out while a model is read.
//!
//! By default glibc returns large blocks to the system as soon as they are freed, and the system clears each page before it gives
//! it out again. Reading a model frees and allocates blocks of some megabytes all the time; kept, they are reused as they are.

/// Blocks from this size on are mapped one by one and returned at once, bytes. Fixed, because glibc otherwise raises it to 32 MiB,
/// where what is kept lies between what is in use and raises the peak.
const MAPPED: i32 = 8 << 20;

/// Free memory at the heap's end that is kept, bytes.
const KEPT: i32 = 1 << 30;

/// `M_TRIM_THRESHOLD` of malloc.h.
const TRIM_THRESHOLD: i32 = -1;

/// `M_MMAP_THRESHOLD` of malloc.h.
const MMAP_THRESHOLD: i32 = -3;

#[expect(unsafe_code, reason = "mallopt is a function of the C library")]
unsafe extern "C" {
    fn mallopt(parameter: i32, value: i32) -> i32;
}

/// Keeps freed blocks for the next ones.
#[expect(unsafe_code, reason = "mallopt is a function of the C library")]
pub(super) fn keep_freed_blocks() {
    // Where it is refused the program is as it would be without.
    // SAFETY: glibc's own function by its own declaration; it takes any values, at any time, and keeps no pointer.
    let _ = unsafe { (mallopt(MMAP_THRESHOLD, MAPPED), mallopt(TRIM_THRESHOLD, KEPT)) };
}
