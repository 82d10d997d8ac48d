//! Reports on measured rows: `results.jsonl` row by row, then `results.csv`, plots of error against run time and one
//! page that holds all of it.
//!
//! Takes [`Row`]s of one machine or several, and [`ReportInfo`] about the run; writes files in a folder, each whole. It does not
//! measure, draw models or read the clock. The plots are work-precision diagrams as in numerical analysis (Hairer, Nørsett,
//! Wanner: Solving Ordinary Differential Equations I, section II.10).
//!
//! ```
//! // The first line names the columns.
//! let table = tinta_lab::report::csv(&[]);
//! assert_eq!(table.lines().count(), 1);
//! ```

mod answer;
mod columns;
mod convergence;
pub(crate) mod html;
mod frame;
mod info;
mod labels;
mod log;
mod marks;
mod plot;
mod ratios;
mod settings;
mod svg_canvas;

pub use columns::{Column, columns};
pub use convergence::{Curve, curves};
pub use frame::Shape;
pub use html::html;
pub use info::{ReportInfo, ReportPicture};
pub use log::{RowLog, read_rows, rows_of_bytes};
pub use plot::plot;
pub use settings::{Machine, Measure, Point, Points, machines, pareto, points};
pub use tinta::record::ROWS_FILE;

use crate::measure::Row;
use columns::Value;
use std::path::Path;
use tinta::error::{Error, FileKind, Result};
use tinta::output::StagedContents;

/// All rows with all their columns but the times of single frames, which `results.jsonl` has.
///
/// The first line names the columns of [`columns()`], in their order; values that a style lacks are empty.
pub fn csv(rows: &[Row]) -> String {
    let columns = columns();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let cell = |value: Value| match value {
        Value::Text(text) => text,
        Value::Number(number) => number.to_string(),
        Value::Missing => String::new(),
    };
    let header = columns.iter().map(|column| column.name.clone().into_owned()).collect();
    let lines = rows.iter().map(|row| columns.iter().map(|column| cell(column.value(row))).collect());
    for line in std::iter::once(header).chain(lines) {
        let line: Vec<String> = line;
        // Neither memory nor lines of one length fail.
        writer.write_record(&line).unwrap_or_default();
    }
    writer.into_inner().map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}

/// A row with its columns by their names: numbers, texts, and `null` for values that a style lacks.
pub fn record(row: &Row) -> Vec<(String, serde_json::Value)> {
    let cell = |value: Value| match value {
        Value::Text(text) => text.into(),
        Value::Number(number) => number.into(),
        Value::Missing => serde_json::Value::Null,
    };
    columns().iter().map(|column| (column.name.clone().into_owned(), cell(column.value(row)))).collect()
}

/// Writes `results.csv`, `plot-*.svg` and `report.html` into the folder, which must be there.
///
/// # Errors
///
/// [`Error::File`] when a file cannot be written, and without any row.
pub fn write(folder: &Path, rows: &[Row], info: &ReportInfo) -> Result<()> {
    if rows.is_empty() {
        return Err(Error::file(FileKind::Rows, folder, "no row to report on; measure something first"));
    }
    // They belong together: none appears before all are on the disk.
    let stage = |name: &str, text: &str| StagedContents::new(&folder.join(name), text.as_bytes());
    let mut staged = vec![stage("results.csv", &csv(rows))?];
    let machines = machines(rows);
    for (number, machine) in machines.iter().enumerate() {
        // Machines have long names that files cannot have.
        let suffix = if machines.len() > 1 { format!("-machine-{}", number + 1) } else { String::new() };
        for (name, measure) in Measure::ALL {
            let subtitle = plot::subtitle(machine, measure);
            if let Some(svg) = plot(&points(&machine.rows, measure), measure, Shape::Wide, &subtitle)? {
                staged.push(stage(&format!("plot-{name}{suffix}.svg"), &svg)?);
            }
        }
    }
    for machine in machines.iter().take(1) {
        let curves = curves(&machine.rows);
        for surface in convergence::surfaces(&curves) {
            let svg = convergence::plot(&curves, surface, Shape::Wide)?;
            staged.push(stage(&format!("plot-convergence-{surface}.svg"), &svg)?);
        }
    }
    staged.push(stage("report.html", &html(rows, info)?)?);
    staged.into_iter().try_for_each(StagedContents::put_in_place)
}
