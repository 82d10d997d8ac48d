//! The file claims.md: the claims with the numbers of one run.

use super::claim::place;
use super::{Claim, ClaimRecord, tally};
use crate::figures::figure::Text;
use crate::figures::measure::HowToMeasure;
use crate::figures::numbers::Host;

impl Text {
    /// The letter that errata and claims know it by.
    pub fn letter(self) -> char {
        match self {
            Self::Evangelista => 'E',
            Self::Valente => 'V',
            Self::Dachsbacher => 'D',
        }
    }
}

impl Claim {
    /// The part of its row in claims.md that no measurement changes: place, sentence, rule, command.
    pub fn cells(&self) -> [String; 4] {
        [
            place(self.text, self.section, self.line),
            self.says.to_owned(),
            self.rule.to_owned(),
            format!("`{}`", self.command),
        ]
    }
}

/// The document.
pub fn markdown(records: &[ClaimRecord], host: &Host, how: &HowToMeasure) -> String {
    let mut out = String::from(HEAD);
    out.push_str(&format!(
        "\n{} Measured at {} with {} {} of each timed setting, on {}, {} {} of the processor.\n",
        tally(records),
        how.size,
        how.frames,
        if how.frames == 1 { "frame" } else { "frames" },
        host.renderer,
        host.threads,
        if host.threads == 1 { "thread" } else { "threads" },
    ));
    for text in Text::ALL {
        let of_text: Vec<&ClaimRecord> = records.iter().filter(|record| record.of_text(text)).collect();
        if of_text.is_empty() {
            continue;
        }
        out.push_str(&format!("\n## {}\n\n{COLUMNS}", text.name()));
        for record in of_text {
            out.push_str(&format!(
                "| {} | {} | {} | {} | {} | `{}` |\n",
                record.place,
                record.says,
                record.finding.verdict.name(),
                record.measured,
                record.rule,
                record.command
            ));
        }
    }
    out
}

const COLUMNS: &str = "\
| where | the text says | verdict | measured here | confirmed if | shown by |
|---|---|---|---|---|---|
";

const HEAD: &str = "\
# Claims

Every measurable sentence of the three texts, beside the measurement here. A rule in the code
decides between confirmed, refuted and not decided here; no verdict is written by hand. A verdict is about this program on this
machine: the texts had other hardware, and measured there. Times are medians of repeats that take turns, with their quartiles in
brackets. A limit within the quartiles decides nothing, and neither does a difference of up to 3 %.

E stands for Evangelista et al. 2005, V for Valente 2007, D for Dachsbacher; the number is the line of the transcript that this
project was made from, and the section is the text's own. The words are ours. `tinta figures` measures them all, writes
this file and shows them on its page with pictures:

    tinta figures -o figures --only evangelista-claims,valente-claims,dachsbacher-claims
";
