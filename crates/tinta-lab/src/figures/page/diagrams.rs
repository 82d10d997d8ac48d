//! The parts of figures that are neither pictures nor tables of numbers: the passes of figure 7, the matrices of figures 10
//! and 11.

use crate::figures::{PassColumn, kernels};
use std::fmt::{Result, Write};
use tinta::styles::{Filter, Style};
use tinta_geometry::markup::escaped;

/// Both columns of figure 7.
pub(super) fn passes(out: &mut String, columns: &[PassColumn]) -> Result {
    writeln!(out, "<div class=\"columns\">")?;
    for column in columns {
        writeln!(out, "<div><h4>{}</h4>", column.title)?;
        for (number, pass) in column.passes.iter().enumerate() {
            writeln!(out, "<div class=\"pass\"><b>{}. {}</b>\n<ol>", number + 1, pass.name)?;
            for step in &pass.steps {
                writeln!(out, "<li>{}</li>", escaped(step))?;
            }
            writeln!(out, "</ol></div>")?;
        }
        writeln!(out, "<pre>{}</pre></div>", escaped(&column.command))?;
    }
    writeln!(out, "</div>")
}

/// The filter that a picture was drawn with.
fn filter_of(style: Option<&Style>) -> Option<Filter> {
    match style? {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(cartoon.border?.filter),
        _ => None,
    }
}

/// The matrices of a picture's filter, the upper row first.
pub(super) fn matrices(out: &mut String, style: Option<&Style>) -> Result {
    let Some(filter) = filter_of(style) else { return Ok(()) };
    writeln!(out, "<div class=\"matrices\">")?;
    for kernel in kernels(filter) {
        writeln!(out, "<table class=\"matrix\">")?;
        for row in kernel.rows {
            let cells = row.map(|weight| format!("<td>{}</td>", weight.to_string().replace('-', "−")));
            writeln!(out, "<tr>{}</tr>", cells.concat())?;
        }
        writeln!(out, "</table>")?;
        if kernel.divisor != 1 {
            writeln!(out, "<span>/ {}</span>", kernel.divisor)?;
        }
    }
    writeln!(out, "</div>")
}
