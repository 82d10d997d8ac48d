//! A claim: its place in a text, its measurement, its rule.

use super::finding::Finding;
use super::lab::Lab;
use crate::figures::figure::{Panel, Text};
use crate::figures::numbers::Numbers;
use tinta::error::Result;

/// A sentence of a text that can be put to the test.
#[derive(Debug)]
pub struct Claim {
    /// The letter of its text and a few words: its place on the page.
    pub id: &'static str,
    /// Its text.
    pub text: Text,
    /// The text's own section, or its heading if sections have no numbers.
    pub section: &'static str,
    /// The line of the text's transcript.
    pub line: u32,
    /// Its sentence, in our words.
    pub says: &'static str,
    /// When it counts as confirmed.
    pub rule: &'static str,
    /// The command that shows it.
    pub command: &'static str,
    /// Pictures that show it; usually empty.
    pub(super) panels: fn() -> Vec<Panel>,
    pub(super) measure: Measure,
}

impl Claim {
    /// The pictures that show it.
    pub fn panels(&self) -> Vec<Panel> {
        (self.panels)()
    }
}

/// The place of a claim: `E:145, section 4.1`.
pub(super) fn place(text: Text, section: &str, line: u32) -> String {
    let section = if section.starts_with(char::is_numeric) { format!("section {section}") } else { section.to_owned() };
    format!("{}:{line}, {section}", text.letter())
}

/// Makes the claims of a text, without pictures: id, section, line, sentence, rule, command, and measurement.
pub(super) fn of_text(
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
pub(super) enum Measure {
    /// Section 5 of Evangelista et al., measured again.
    Section5(fn(&Numbers) -> Finding),
    /// Drawn, timed or counted for this claim.
    Here(fn(&mut Lab<'_>) -> Result<Finding>),
    /// It cannot be decided here, for this reason.
    Nowhere(&'static str),
}

/// No pictures.
fn none() -> Vec<Panel> {
    Vec::new()
}

/// A command that a whole text's claims are measured by, for those that no single picture shows.
macro_rules! measured_by {
    ($text:literal) => {
        concat!("tinta figures -o figures --only ", $text, "-claims")
    };
}
pub(super) use measured_by;
