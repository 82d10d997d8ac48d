//! The three texts' claims: every measurable sentence, with the measurement here.
//!
//! A claim is plain data: its place, its sentence, its rule, the command that shows it. The rule is a function of measured
//! numbers; no verdict is written by hand. [`measure_claims`] measures, `page` shows, [`markdown()`] writes claims.md.

mod claim;
mod dachsbacher;
mod evangelista;
mod finding;
mod lab;
mod markdown;
mod valente;

use super::figure::Text;
use super::measure::HowToMeasure;
use super::numbers::Numbers;
pub use claim::Claim;
use claim::{Measure, place};
pub use finding::{Finding, Number, Verdict};
use lab::Lab;
pub use markdown::markdown;
use serde::Serialize;
use tinta::error::Result;
use tinta::renderer::Renderer;

/// A claim with its finding.
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
    /// Text, line and section in a phrase: `E:145, section 4.1`.
    pub place: String,
    /// As [`Claim::says`].
    pub says: &'static str,
    /// As [`Claim::rule`].
    pub rule: &'static str,
    /// As [`Claim::command`].
    pub command: &'static str,
    /// The numbers in a line, after the reason for an open verdict.
    pub measured: String,
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

/// Measures claims; `numbers` are those of section 5, which some claims need to be testable. `step` is called once for each
/// claim.
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
            place: place(text, section, line),
            says,
            rule,
            command,
            measured: finding.to_string(),
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
        "{} claims: {} confirmed, {} refuted, {} not decided here.",
        records.len(),
        count(Verdict::Confirmed),
        count(Verdict::Refuted),
        count(Verdict::NotDecided)
    )
}

#[cfg(test)]
mod tests;
