//! Time measurement.

use std::time::Instant;

/// Milliseconds by the clock since an instant.
pub fn milliseconds_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
