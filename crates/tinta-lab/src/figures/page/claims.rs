//! The claims on the page: each a block with its verdict, its numbers, its pictures and its command.

use super::pictures::{PictureRecord, pictures};
use crate::figures::{ClaimRecord, Text, Verdict, tally};
use std::fmt::{Result, Write};
use tinta_geometry::markup::escaped;

/// The claims of one text; `shown` are the pictures of each claim, by its id.
pub(super) fn claims(
    out: &mut String,
    text: Text,
    records: &[ClaimRecord],
    shown: &[(&str, Vec<PictureRecord>)],
) -> Result {
    let of_text: Vec<ClaimRecord> = records.iter().filter(|record| record.of_text(text)).cloned().collect();
    if of_text.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "<p>{} The number after {}: is the line of the transcript that this program was made from. The words are ours, and a rule decides: a verdict is \
         about this program on this machine.</p>",
        tally(&of_text),
        text.letter()
    )?;
    for record in &of_text {
        claim(out, record)?;
        if let Some((_, records)) = shown.iter().find(|(id, _)| *id == record.id) {
            pictures(out, records.iter(), record.says)?;
        }
        writeln!(out, "<pre>{}</pre>\n</article>", escaped(record.command))?;
    }
    Ok(())
}

fn claim(out: &mut String, record: &ClaimRecord) -> Result {
    let class = match record.finding.verdict {
        Verdict::Confirmed => "confirmed",
        Verdict::Refuted => "refuted",
        Verdict::NotDecided => "untested",
    };
    writeln!(out, "<article class=\"claim\" id=\"{}\">", record.id)?;
    writeln!(out, "<p><b>{}.</b> {}</p>", escaped(&record.place), escaped(record.says))?;
    let name = record.finding.verdict.name();
    let measured = escaped(&record.measured);
    writeln!(out, "<p><span class=\"verdict {class}\">{name}</span> {measured}</p>")?;
    if !record.finding.numbers.is_empty() {
        writeln!(out, "<p class=\"hint\">Confirmed if {}.</p>", escaped(record.rule))?;
    }
    Ok(())
}
