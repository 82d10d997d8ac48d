//! Counts and times in words.

use std::time::Duration;

/// "1 model", "3 models".
pub(super) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Seconds up to a minute and a half, then minutes.
pub(super) fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..=90 => counted(time.as_secs().max(1) as usize, "second"),
        seconds => format!("{} minutes", seconds.div_ceil(60)),
    }
}
