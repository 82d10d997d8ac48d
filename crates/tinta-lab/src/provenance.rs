//! The origin of each value of a style: printed in its text, deduced from it, or ours.
//!
//! Settings declare it ([`tinta::settings::Setting::provenance`]), fixed values have it in [`CONSTANTS`], the numbers in shaders
//! in [`SHADERS`]. Takes the name of a style, or none for all; returns rows, a table for a terminal, and a page of all tables.
//!
//! ```
//! use tinta::StyleName;
//! use tinta_lab::provenance::rows;
//! use tinta::settings::Whose;
//!
//! let factor = rows(Some(StyleName::ThreePass)).into_iter().find(|row| row.name == "detection-factor").expect("a setting");
//! assert_eq!((factor.value.as_str(), factor.whose), ("0.2", Whose::Printed));
//! ```

mod constants;
mod shaders;

pub use constants::{CONSTANTS, Constant};
pub use shaders::{SHADERS, ShaderNumbers};

use std::fmt::Write;
use tinta::choice::Choice;
use tinta::settings::{HasSettings, Whose};
use tinta::styles::{Style, StyleName};

/// A value and its origin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// The styles that use it.
    pub styles: Vec<StyleName>,
    /// The option's name, or the value's description.
    pub name: String,
    /// The value, by default.
    pub value: String,
    /// Its origin.
    pub whose: Whose,
    /// Its printed place, its derivation, or the reason for its choice.
    pub why: &'static str,
    /// Its effect, and the change if it were otherwise.
    pub otherwise: &'static str,
}

/// All rows of a style, or of all styles; a row shared by several styles appears once.
///
/// First the settings in the order of help, then fixed values, then the numbers in the shaders.
pub fn rows(style: Option<StyleName>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    let is_wanted = |of: StyleName| style.is_none_or(|style| style == of);
    let mut add = |of: StyleName, row: Row| {
        let same = |other: &&mut Row| Row { styles: Vec::new(), ..(*other).clone() } == row;
        match rows.iter_mut().find(same) {
            Some(present) => present.styles.push(of),
            None => rows.push(Row { styles: vec![of], ..row }),
        }
    };
    for (_, name) in StyleName::of_passes().filter(|(_, name)| is_wanted(*name)) {
        let style = Style::named(name);
        for setting in Style::table().of(Some(&style)) {
            let Some(provenance) = setting.provenance else { continue };
            let value = match setting.said_default {
                Some(said) if setting.value(&style).is_none_or(|text| text.is_empty()) => said.to_owned(),
                _ => setting.value(&style).unwrap_or_default(),
            };
            let row = Row {
                styles: Vec::new(),
                name: setting.name.to_owned(),
                value,
                whose: provenance.whose,
                why: provenance.why,
                otherwise: setting.help,
            };
            add(name, row);
        }
    }
    for constant in CONSTANTS {
        for name in constant.styles.iter().filter(|name| is_wanted(**name)) {
            let row = Row {
                styles: Vec::new(),
                name: constant.name.to_owned(),
                value: constant.value.to_owned(),
                whose: constant.provenance.whose,
                why: constant.provenance.why,
                otherwise: constant.otherwise,
            };
            add(*name, row);
        }
    }
    rows
}

/// The rows as a table for a terminal: under each of printed, deduced and ours the values, their source or reason, and their
/// effect.
pub fn text(style: Option<StyleName>) -> String {
    let rows = rows(style);
    let mut out = String::new();
    for whose in [Whose::Printed, Whose::Deduced, Whose::Ours] {
        let of_them: Vec<&Row> = rows.iter().filter(|row| row.whose == whose).collect();
        if of_them.is_empty() {
            continue;
        }
        let _ = writeln!(out, "{}", heading(whose));
        for row in of_them {
            let styles = if style.is_some() { String::new() } else { format!("  ({})", names(row)) };
            let _ = writeln!(out, "\n  {} = {}{styles}", row.name, row.value);
            let _ = writeln!(out, "      {}", row.why);
            let _ = writeln!(out, "      {}", row.otherwise);
        }
        out.push('\n');
    }
    out
}

/// All rows as a page of tables, then the numbers in shaders.
pub fn page() -> String {
    let mut out = PAGE_OPENING.to_owned();
    for whose in [Whose::Printed, Whose::Deduced, Whose::Ours] {
        let _ = writeln!(out, "\n## {}\n", heading(whose));
        let _ = writeln!(
            out,
            "| setting or fixed value | by default | styles | {} | what it does |\n|---|---|---|---|---|",
            column(whose)
        );
        for row in rows(None).iter().filter(|row| row.whose == whose) {
            let _ = writeln!(
                out,
                "| {} | {} | {} | {} | {} |",
                cell(&row.name),
                cell(&row.value),
                names(row),
                cell(row.why),
                cell(row.otherwise)
            );
        }
    }
    out.push_str("\n## Numbers in shaders\n\nSuch as are neither 0 nor 1.\n\n| shader | numbers | whose | source or reason |\n|---|---|---|---|\n");
    for ShaderNumbers { path, numbers, provenance } in SHADERS {
        let numbers = numbers.join(", ");
        let _ = writeln!(out, "| `glsl/{path}` | {numbers} | {} | {} |", provenance.whose.name(), cell(provenance.why));
    }
    out
}

/// The page's text before its tables.
const PAGE_OPENING: &str = "\
# Whose value is it

Every value that a style draws with: printed in its text, deduced from the text, or ours because the text is silent.
`cargo run -p tinta-lab --example provenance -- three-pass` prints those of one style, without a style this page. E is Evangelista et al. 2005, D is Dachsbacher, V is Valente 2007; numbers like E13 are rows of the errata.
";

fn heading(whose: Whose) -> &'static str {
    match whose {
        Whose::Printed => "Printed in the text",
        Whose::Deduced => "Deduced from the text",
        Whose::Ours => "Ours, where the text is silent",
    }
}

fn column(whose: Whose) -> &'static str {
    match whose {
        Whose::Printed => "where",
        Whose::Deduced => "from what",
        Whose::Ours => "why",
    }
}

/// The styles of a row with commas between.
fn names(row: &Row) -> String {
    if row.styles.len() == StyleName::of_passes().count() {
        return "all".to_owned();
    }
    row.styles.iter().map(|style| style.choice_name()).collect::<Vec<_>>().join(", ")
}

/// A text as a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests;
