//! Finds free memory, to reject large work with a message before the system swaps or kills the process.

use crate::error::{Error, Result};
use crate::limits::MEMORY_SLACK_BYTES;
use std::fs::read_to_string;

/// Returns the bytes that this process can use without swapping, by the system and its control group; `None` if unknown.
///
/// Linux only.
pub(crate) fn free() -> Option<u64> {
    let system = read_to_string("/proc/meminfo").ok().and_then(|text| free_of_system(&text));
    let group = read_to_string("/proc/self/cgroup").ok().and_then(|text| free_of_group(&text));
    match (system, group) {
        (Some(system), Some(group)) => Some(system.min(group)),
        (system, group) => system.or(group),
    }
}

/// Reads the free bytes from `/proc/meminfo`.
fn free_of_system(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// Returns the bytes left by the tightest limit of the version 2 control group in `/proc/self/cgroup` and its parents.
fn free_of_group(text: &str) -> Option<u64> {
    let mut path = text.lines().find_map(|line| line.strip_prefix("0::"))?.trim_matches('/');
    let mut least = None;
    loop {
        let file = |name: &str| read_to_string(format!("/sys/fs/cgroup/{path}/{name}")).ok();
        let free = left(file("memory.max"), file("memory.current"), file("memory.stat"));
        least = [least, free].into_iter().flatten().min();
        path = match path.rsplit_once('/') {
            Some((above, _)) => above,
            None if path.is_empty() => return least,
            None => "",
        };
    }
}

/// Returns the limit minus the used bytes. The file cache does not count as used, because the system frees it on demand.
fn left(most: Option<String>, used: Option<String>, statistics: Option<String>) -> Option<u64> {
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let (most, used) = (number(&most?)?, number(&used?)?);
    let kept = |line: &str| {
        let of_files = ["inactive_file ", "active_file "].into_iter().find_map(|name| line.strip_prefix(name));
        of_files.and_then(number).unwrap_or_default()
    };
    let kept: u64 = statistics.as_deref().unwrap_or_default().lines().map(kept).sum();
    Some(most.saturating_sub(used.saturating_sub(kept)))
}

/// Rejects a model that needs more bytes than are free; needs up to [`MEMORY_SLACK_BYTES`] always pass.
///
/// # Errors
///
/// [`Error::File`] with both numbers.
pub(crate) fn check(name: &str, needed: u64, free: Option<u64>) -> Result<()> {
    refusal(needed, free).map_or(Ok(()), |problem| Err(Error::model(name, problem)))
}

/// The same as a sentence without the model's name; `None` if there is enough.
pub(crate) fn refusal(needed: u64, free: Option<u64>) -> Option<String> {
    too_much(needed, free).map(|both| format!("it takes {both}; close other programs, or make it smaller"))
}

/// The work of a drawing: the setting that names it, its name in a sentence, and how to ask for less.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DrawingWork([&'static str; 3]);

/// The kinds of work on a drawing.
pub(crate) const LINES: DrawingWork =
    DrawingWork(["classes", "lines", "ask for fewer, for instance without intersection"]);
pub(crate) const AREAS: DrawingWork = DrawingWork(["areas", "areas", "draw fewer or simpler models at once"]);
pub(crate) const TONES: DrawingWork = DrawingWork(["tones", "areas of tone", "draw fewer or simpler models at once"]);
pub(crate) const STROKES: DrawingWork =
    DrawingWork(["hatch", "strokes", "choose a wider spacing, or draw fewer models at once"]);

impl DrawingWork {
    /// Rejects work that needs more bytes than are free.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with both numbers.
    pub(crate) fn check(self, needed: usize, free: Option<u64>) -> Result<()> {
        let Self([setting, things, advice]) = self;
        too_much(needed as u64, free).map_or(Ok(()), |both| {
            Err(Error::setting(setting, format!("the {things} of this scene take {both}; {advice}")))
        })
    }
}

/// Returns `2.5 GiB of memory, and 1.0 GiB are free` if too little is free.
fn too_much(needed: u64, free: Option<u64>) -> Option<String> {
    let free = free.filter(|free| needed > *free && needed > MEMORY_SLACK_BYTES as u64)?;
    let gib = |bytes: u64| format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30));
    Some(format!("{} of memory, and {} are free", gib(needed), gib(free)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_free_is_read_as_the_system_writes_it() {
        let text =
            "MemTotal:       24576000 kB\nMemFree:          100 kB\nMemAvailable:   20000000 kB\nSwapFree: 9 kB\n";
        assert_eq!(free_of_system(text), Some(20_480_000_000));
        assert_eq!(free_of_system("MemTotal: 1 kB\n"), None);
        assert_eq!(free_of_group("12:cpu:/a\n"), None, "of version 1");
    }

    #[test]
    fn a_group_leaves_its_limit_less_what_cannot_be_given_up() {
        let text = |text: &str| Some(text.to_owned());
        let statistics = || text("anon 5\ninactive_file 300\nactive_file 9\n");
        assert_eq!(left(text("1000\n"), text("700\n"), statistics()), Some(609));
        assert_eq!(left(text("1000\n"), text("1200\n"), None), Some(0));
        assert_eq!(left(text("max\n"), text("700\n"), statistics()), None, "without a limit");
        assert_eq!(left(None, text("700\n"), statistics()), None);
    }

    #[test]
    fn what_fits_or_is_little_is_not_refused_and_what_does_not_is_in_one_sentence() {
        assert!(check("a.obj", 5 << 30, Some(5 << 30)).is_ok());
        assert!(check("a.obj", u64::MAX, None).is_ok(), "where nobody says");
        assert!(check("a.obj", 64 << 20, Some(0)).is_ok());
        let message = check("a.obj", 5 << 30, Some(3 << 29)).unwrap_err().to_string();
        let sentence =
            "a.obj: it takes 5.0 GiB of memory, and 1.5 GiB are free; close other programs, or make it smaller";
        assert_eq!(message, sentence);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn some_memory_is_free_here() {
        assert!(free().is_some_and(|free| free > 1 << 20));
    }

    #[test]
    fn lines_that_take_more_than_there_is_say_what_to_leave_out() {
        let gib = 1usize << 30;
        assert!(LINES.check(2 * gib, Some(3 << 30)).is_ok() && LINES.check(2 * gib, None).is_ok());
        let message = LINES.check(5 * gib, Some(3 << 29)).unwrap_err().to_string();
        assert_eq!(
            message,
            "classes: the lines of this scene take 5.0 GiB of memory, and 1.5 GiB are free; ask for fewer, for instance \
             without intersection"
        );
        for (asked, start, end) in
            [(AREAS, "areas: the areas of ", "models at once"), (STROKES, "hatch: the strokes of ", "models at once")]
        {
            let message = asked.check(5 * gib, Some(3 << 29)).unwrap_err().to_string();
            assert!(message.starts_with(start) && message.ends_with(end), "{message}");
        }
    }
}
