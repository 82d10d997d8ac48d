//! The conditions of a measurement, which a quotation of its rows names.

use serde::{Deserialize, Serialize};
use std::time::{SystemTime, UNIX_EPOCH};

/// The date, build and processor of a measured row; empty in rows of older versions.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Conditions {
    /// The day, UTC: year-month-day.
    pub date: String,
    /// The commit that tinta was built from; empty outside a repository.
    pub commit: String,
    /// The processor's name; empty where the system does not tell it.
    pub processor: String,
    /// Processes that wanted a processor over the last minute, on average; `None` where the system does not tell it.
    pub load: Option<f64>,
}

impl Conditions {
    /// Those of this moment.
    pub(crate) fn now() -> Self {
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        // These files are Linux's.
        let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
        let name_of = |line: &str| Some(line.strip_prefix("model name")?.split_once(':')?.1.trim().to_owned());
        Self {
            date: date(seconds / 86_400),
            commit: env!("TINTA_COMMIT").to_owned(),
            processor: read("/proc/cpuinfo").lines().find_map(name_of).unwrap_or_default(),
            load: read("/proc/loadavg").split(' ').next().and_then(|load| load.parse().ok()),
        }
    }
}

/// The day that many days after 1970-01-01, in the Gregorian calendar.
fn date(days: u64) -> String {
    // Years that begin in March end with the leap day.
    let days = days + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = era * 400 + year_of_era + u64::from(month < 3);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_the_calendars_names() {
        let known = [(0, "1970-01-01"), (59, "1970-03-01"), (11_016, "2000-02-29"), (20_513, "2026-03-01")];
        for (days, name) in known {
            assert_eq!(date(days), name);
        }
        assert!(Conditions::now().date.as_str() > "2026-01-01");
    }
}
