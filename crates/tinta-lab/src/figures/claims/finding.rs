//! The finding of a claim: a verdict and the numbers behind it.

use crate::figures::series::Interval;
use serde::Serialize;

/// A claim's verdict with its numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Whether the claim holds here.
    pub verdict: Verdict,
    /// The measured numbers, the one that decides first.
    pub numbers: Vec<Number>,
    /// Why it is not decided, if so.
    pub reason: Option<&'static str>,
}

/// The result of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The numbers agree with the text.
    Confirmed,
    /// They do not.
    Refuted,
    /// The repeats lie on both sides of the rule's limit, or the sentence is about something that is not here.
    NotDecided,
}

impl Verdict {
    /// Its name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::NotDecided => "not decided here",
        }
    }
}

/// A measured number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Number {
    /// The number's description.
    pub what: String,
    /// It.
    pub value: f64,
    /// The quartiles, for the median of repeats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quartiles: Option<[f64; 2]>,
    /// Its unit; empty for a count or a ratio.
    pub unit: &'static str,
    /// Digits that are shown after the point.
    #[serde(skip)]
    digits: usize,
}

impl Number {
    pub(super) fn new(what: impl Into<String>, value: f64, unit: &'static str, digits: usize) -> Self {
        Self { what: what.into(), value, quartiles: None, unit, digits }
    }

    /// The median of repeats with its quartiles.
    pub(super) fn repeated(what: impl Into<String>, of: Interval, unit: &'static str, digits: usize) -> Self {
        Self { quartiles: Some(of.quartiles), ..Self::new(what, of.middle, unit, digits) }
    }

    /// A share of 0 to 1 as percent.
    pub(super) fn share(what: impl Into<String>, share: f64) -> Self {
        Self::new(what, share * 100.0, "%", 1)
    }

    /// Percent.
    pub(super) fn percent(what: impl Into<String>, percent: f64) -> Self {
        Self::new(what, percent, "%", 0)
    }

    /// Percent, the median of repeats.
    pub(super) fn percents(what: impl Into<String>, of: Interval) -> Self {
        Self::repeated(what, of, "%", 0)
    }

    pub(super) fn count(what: impl Into<String>, count: usize) -> Self {
        Self::new(what, count as f64, "", 0)
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = self.digits;
        // Minus zero prints as zero.
        let text = |value: f64| {
            let is_none = format!("{:.digits$}", value.abs()).parse() == Ok(0.0);
            format!("{:.digits$}", if is_none { 0.0 } else { value })
        };
        let blank = if self.unit.is_empty() { "" } else { " " };
        write!(out, "{}: {}", self.what, text(self.value))?;
        if let Some([low, high]) = self.quartiles {
            write!(out, " ({} to {})", text(low), text(high))?;
        }
        write!(out, "{blank}{}", self.unit)
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let numbers = self.numbers.iter().map(ToString::to_string);
        let parts: Vec<String> = self.reason.map(str::to_owned).into_iter().chain(numbers).collect();
        out.write_str(&parts.join("; "))
    }
}

impl Finding {
    /// Confirmed if the rule holds, refuted if not. A NaN decides nothing.
    pub(super) fn of(holds: bool, numbers: Vec<Number>) -> Self {
        Self::of_repeats(Some(holds), numbers)
    }

    /// The same of measured times: `None` where the repeats do not decide.
    pub(super) fn of_repeats(holds: Option<bool>, numbers: Vec<Number>) -> Self {
        if numbers.iter().any(|number| !number.value.is_finite()) {
            return Self::nowhere("the measured work took no measurable time");
        }
        match holds {
            Some(true) => Self { verdict: Verdict::Confirmed, numbers, reason: None },
            Some(false) => Self { verdict: Verdict::Refuted, numbers, reason: None },
            None => {
                Self::undecided("the repeats lie on both sides of the rule's limit, or within 3 % of equal", numbers)
            }
        }
    }

    /// Not decided, for this reason, whatever the numbers.
    pub(super) fn undecided(reason: &'static str, numbers: Vec<Number>) -> Self {
        Self { verdict: Verdict::NotDecided, numbers, reason: Some(reason) }
    }

    pub(super) fn nowhere(reason: &'static str) -> Self {
        Self::undecided(reason, Vec::new())
    }
}
