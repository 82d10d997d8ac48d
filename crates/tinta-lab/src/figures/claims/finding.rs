//! The finding of a claim: a verdict and the numbers behind it.

use serde::Serialize;

/// A claim's verdict with its numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Whether the claim holds here.
    pub verdict: Verdict,
    /// The measured numbers, the one that decides first.
    pub numbers: Vec<Number>,
    /// Why it cannot be tested, if so.
    pub reason: Option<&'static str>,
}

/// The result of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The numbers agree with the text.
    Confirmed,
    /// They are not.
    Refuted,
    /// It cannot be measured here.
    NotTestable,
}

impl Verdict {
    /// Its name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::NotTestable => "not testable here",
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
    /// Its unit; empty for a count or a ratio.
    pub unit: &'static str,
    /// Digits that are shown after the point.
    #[serde(skip)]
    digits: usize,
}

impl Number {
    pub(super) fn new(what: impl Into<String>, value: f64, unit: &'static str, digits: usize) -> Self {
        Self { what: what.into(), value, unit, digits }
    }

    /// A share of 0 to 1 as percent.
    pub(super) fn share(what: impl Into<String>, share: f64) -> Self {
        Self::new(what, share * 100.0, "%", 1)
    }

    /// Percent.
    pub(super) fn percent(what: impl Into<String>, percent: f64) -> Self {
        Self::new(what, percent, "%", 0)
    }

    pub(super) fn count(what: impl Into<String>, count: usize) -> Self {
        Self::new(what, count as f64, "", 0)
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Minus zero prints as zero.
        let value = if format!("{:.*}", self.digits, self.value.abs()).parse() == Ok(0.0) { 0.0 } else { self.value };
        let blank = if self.unit.is_empty() { "" } else { " " };
        write!(out, "{}: {value:.*}{blank}{}", self.what, self.digits, self.unit)
    }
}

impl Finding {
    /// Confirmed if the rule holds, refuted if not. A NaN decides nothing.
    pub(super) fn of(holds: bool, numbers: Vec<Number>) -> Self {
        if numbers.iter().any(|number| !number.value.is_finite()) {
            return Self { numbers: Vec::new(), ..Self::nowhere("the measured work took no measurable time") };
        }
        let verdict = if holds { Verdict::Confirmed } else { Verdict::Refuted };
        Self { verdict, numbers, reason: None }
    }

    pub(super) fn nowhere(reason: &'static str) -> Self {
        Self { verdict: Verdict::NotTestable, numbers: Vec::new(), reason: Some(reason) }
    }
}
