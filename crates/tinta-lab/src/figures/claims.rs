//! The three texts' claims: every sentence that says something which can be measured, beside what is measured here.
//!
//! A claim is plain data: where it stands, what it says, which rule decides, what shows it. The rule is a function of measured
//! numbers; nobody writes a verdict down. [`measure_claims`] measures, `page` shows, [`markdown`] writes claims.md.

mod dachsbacher;
mod evangelista;
mod lab;
mod markdown;
mod valente;

use super::measure::{HowToMeasure, Numbers};
use super::{Panel, Text};
use lab::Lab;
pub use markdown::markdown;
pub(super) use markdown::place;
use serde::Serialize;
use tinta::error::Result;
use tinta::renderer::Renderer;

/// A sentence of a text that can be put to the test.
#[derive(Debug)]
pub struct Claim {
    /// The letter of its text and a few words: its place on the page.
    pub id: &'static str,
    /// Where it stands.
    pub text: Text,
    /// The text's own section, or its heading where sections have no numbers.
    pub section: &'static str,
    /// The line of the text's transcript.
    pub line: u32,
    /// What it says, in our words.
    pub says: &'static str,
    /// When it counts as confirmed.
    pub rule: &'static str,
    /// What shows it.
    pub command: &'static str,
    /// Pictures that show it; most have none.
    pub(super) panels: fn() -> Vec<Panel>,
    measure: Measure,
}

/// Makes the claims of a text, without pictures: id, section, line, what it says, the rule, what shows it, and how it is measured.
fn of_text(
    text: Text,
) -> impl Fn(&'static str, &'static str, u32, &'static str, &'static str, &'static str, Measure) -> Claim {
    move |id, section, line, says, rule, command, measure| Claim {
        id,
        text,
        section,
        line,
        says,
        rule,
        command,
        panels: none,
        measure,
    }
}

/// Where a claim's numbers come from.
#[derive(Debug)]
enum Measure {
    /// Section 5 of Evangelista et al., measured again.
    Section5(fn(&Numbers) -> Finding),
    /// Drawn, timed or counted for this claim.
    Here(fn(&mut Lab<'_>) -> Result<Finding>),
    /// Nothing here could decide it, for this reason.
    Nowhere(&'static str),
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Whether the claim holds here.
    pub verdict: Verdict,
    /// The measured numbers, the one that decides first.
    pub numbers: Vec<Number>,
    /// Why it cannot be tested, where it cannot.
    pub reason: Option<&'static str>,
}

/// What a rule makes of the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The numbers are as the text says.
    Confirmed,
    /// They are not.
    Refuted,
    /// There is nothing to measure here.
    NotTestable,
}

impl Verdict {
    /// In words.
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
    /// What it is.
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
    fn new(what: impl Into<String>, value: f64, unit: &'static str, digits: usize) -> Self {
        Self { what: what.into(), value, unit, digits }
    }

    /// A share of 0 to 1 as percent.
    fn share(what: impl Into<String>, share: f64) -> Self {
        Self::new(what, share * 100.0, "%", 1)
    }

    /// Percent.
    fn percent(what: impl Into<String>, percent: f64) -> Self {
        Self::new(what, percent, "%", 0)
    }

    fn count(what: impl Into<String>, count: usize) -> Self {
        Self::new(what, count as f64, "", 0)
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Minus nothing is nothing.
        let value = if format!("{:.*}", self.digits, self.value.abs()).parse() == Ok(0.0) { 0.0 } else { self.value };
        let blank = if self.unit.is_empty() { "" } else { " " };
        write!(out, "{}: {value:.*}{blank}{}", self.what, self.digits, self.unit)
    }
}

impl Finding {
    /// Confirmed if the rule holds, refuted if not. A number that is none decides nothing.
    fn of(holds: bool, numbers: Vec<Number>) -> Self {
        if numbers.iter().any(|number| !number.value.is_finite()) {
            return Self { numbers: Vec::new(), ..Self::nowhere("what was to be measured took no measurable time") };
        }
        let verdict = if holds { Verdict::Confirmed } else { Verdict::Refuted };
        Self { verdict, numbers, reason: None }
    }

    fn nowhere(reason: &'static str) -> Self {
        Self { verdict: Verdict::NotTestable, numbers: Vec::new(), reason: Some(reason) }
    }
}

/// A claim with what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClaimRecord {
    /// As [`Claim::id`].
    pub id: &'static str,
    /// The text's name.
    pub text: &'static str,
    /// As [`Claim::section`].
    pub section: &'static str,
    /// As [`Claim::line`].
    pub line: u32,
    /// As [`Claim::says`].
    pub says: &'static str,
    /// As [`Claim::rule`].
    pub rule: &'static str,
    /// As [`Claim::command`].
    pub command: &'static str,
    /// The verdict, the numbers, the reason.
    #[serde(flatten)]
    pub finding: Finding,
    #[serde(skip)]
    text_index: Text,
}

impl ClaimRecord {
    /// The text it is of.
    pub fn of_text(&self, text: Text) -> bool {
        self.text_index == text
    }
}

/// The claims of a text, in its order.
pub fn claims(text: Text) -> Vec<Claim> {
    match text {
        Text::Evangelista => evangelista::claims(),
        Text::Valente => valente::claims(),
        Text::Dachsbacher => dachsbacher::claims(),
    }
}

/// Measures claims; `numbers` are those of section 5, without which what follows from them is not testable, and `step` is called
/// once for each claim.
///
/// # Errors
///
/// As [`Renderer::draw`].
pub fn measure_claims(
    renderer: &mut Renderer,
    claims: &[Claim],
    how: &HowToMeasure,
    numbers: Option<&Numbers>,
    mut step: impl FnMut(),
) -> Result<Vec<ClaimRecord>> {
    let mut lab = Lab::new(renderer, how);
    let mut records = Vec::new();
    for claim in claims {
        let finding = match (&claim.measure, numbers) {
            (Measure::Section5(rule), Some(numbers)) => rule(numbers),
            (Measure::Section5(_), None) => Finding::nowhere("section 5 was not measured"),
            (Measure::Here(measure), _) => measure(&mut lab)?,
            (Measure::Nowhere(reason), _) => Finding::nowhere(reason),
        };
        let Claim { id, text, section, line, says, rule, command, .. } = *claim;
        records.push(ClaimRecord {
            id,
            text: text.name(),
            section,
            line,
            says,
            rule,
            command,
            finding,
            text_index: text,
        });
        step();
    }
    Ok(records)
}

/// How many records have each verdict, in a sentence.
pub fn tally(records: &[ClaimRecord]) -> String {
    let count = |verdict| records.iter().filter(|record| record.finding.verdict == verdict).count();
    format!(
        "{} claims: {} confirmed, {} refuted, {} not testable here.",
        records.len(),
        count(Verdict::Confirmed),
        count(Verdict::Refuted),
        count(Verdict::NotTestable)
    )
}

/// No pictures.
fn none() -> Vec<Panel> {
    Vec::new()
}

/// Rates nearer to each other than this are equal, percent: medians of a busy machine differ by as much.
const EQUAL_PERCENT: f64 = 3.0;

/// A percentage that the text prints counts as found again from this share of it on.
const FOUND_AGAIN: f64 = 0.5;

/// A command that a whole text's claims are measured by, for those that no single picture shows.
macro_rules! measured_by {
    ($text:literal) => {
        concat!("tinta figures -o figures --only ", $text, "-claims")
    };
}
use measured_by;

#[cfg(test)]
mod tests;
