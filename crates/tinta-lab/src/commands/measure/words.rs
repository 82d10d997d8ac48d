//! Counts and times in words.

pub(super) use crate::report::html::counted;
use std::time::Duration;

/// Seconds up to a minute and a half, then minutes.
pub(super) fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..=90 => counted(time.as_secs().max(1) as usize, "second"),
        seconds => format!("{} minutes", seconds.div_ceil(60)),
    }
}
