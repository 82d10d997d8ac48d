//! The rows as a Markdown table.

use super::run::{MissingBackend, Row, Summary};
use std::fmt::Write;

impl Summary {
    /// Every row: its required outcome, its actual one, and its figures.
    pub fn table(&self) -> String {
        let failed = self.failures().count();
        let mut text = format!(
            "# Stiff and extreme cases\n\ntinta {}, {}: {} cases, {} rows, {failed} not as they must be.\n\n{}\
             | case | right answer | style | backend | verdict | as expected | figures |\n|---|---|---|---|---|---|---|\n",
            self.version,
            self.renderers.join(" and "),
            self.case_count,
            self.cases.len(),
            missing(&self.missing)
        );
        for row in &self.cases {
            let passed = if row.passed { "yes" } else { "**no**" };
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "| {} | {} | `{}` | {} | {} | {passed} | {} |",
                row.name,
                answer(row),
                row.style,
                row.backend,
                row.verdict,
                numbers(row)
            );
        }
        text
    }
}

/// The kind of the right answer, and the answer.
fn answer(row: &Row) -> String {
    let parts = [row.kind, row.answer].into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join(": ")
}

/// A sentence for each missing backend.
fn missing(missing: &[MissingBackend]) -> String {
    let sentence = |of: &MissingBackend| {
        format!("Without {}, which is not available ({}): no two backends were compared.\n\n", of.backend, of.reason)
    };
    missing.iter().map(sentence).collect()
}

/// The figures in a line, and the remark.
fn numbers(row: &Row) -> String {
    let figures =
        row.figures.iter().map(|(name, value)| format!("{name} {value:.4}").trim_end_matches(".0000").to_owned());
    let remark = row.remark.iter().map(|remark| remark.replace('|', "\\|"));
    figures.chain(remark).collect::<Vec<_>>().join(", ")
}
