//! A measurement's files: rows, pictures of errors, a report.

use super::errors::{error_page, is_shown, known_picture};
use super::words::counted;
use crate::measure::{Against, MeasureSettings, Measurement, Row, Subject};
use crate::report::{ReportInfo, ReportPicture, RowLog, read_rows};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use tinta::cli::make_folder;
use tinta::record::ROWS_FILE;
use tinta::{Error, Picture, Result, Size, StyleName};

/// The rows of a folder so far, and the pictures that its report shows.
pub(in crate::commands) struct Results<'a> {
    folder: &'a Path,
    log: RowLog,
    pub(super) rows: Vec<Row>,
    pictures: Vec<ReportPicture>,
}

/// Whether a row is of a subject on a machine.
pub(super) fn is_of(row: &Row, subject: &Subject, machine: &str) -> bool {
    let Size { width, height } = subject.scene.size;
    row.machine == machine && row.model == subject.model && row.size == [width, height]
}

impl<'a> Results<'a> {
    /// Starts without rows, or with those of an earlier run; creates the folder if missing.
    pub(in crate::commands) fn open(folder: &'a Path, is_resumed: bool) -> Result<Self> {
        make_folder(folder)?;
        let (log, rows) = match is_resumed {
            true => RowLog::resume(folder)?,
            false => (RowLog::create(folder)?, Vec::new()),
        };
        Ok(Self { folder, log, rows, pictures: Vec::new() })
    }

    /// The rows of several files together; `replaces` those that the folder holds.
    pub(super) fn merged(files: &[PathBuf], folder: &'a Path, replaces: bool) -> Result<Self> {
        let mut rows: Vec<Row> = Vec::new();
        // Where the row of a key was first seen.
        let mut places: HashMap<String, usize> = HashMap::new();
        for path in files {
            let of_file = read_rows(path)?;
            if of_file.is_empty() {
                return Err(Error::output(path, "it holds no row; name a results.jsonl of `tinta measure`"));
            }
            for row in of_file {
                let place = *places.entry(row.key()).or_insert(rows.len());
                if let Some(known) = rows.get(place).filter(|known| **known != row) {
                    return Err(Error::output(
                        path,
                        format!(
                            "{} was measured in another file on a machine of the same name; measure one of them with another \
                             --machine",
                            known.options
                        ),
                    ));
                }
                rows.push(row);
            }
        }
        if replaces {
            // If that fails, opening it says why.
            let _ = std::fs::remove_file(folder.join(ROWS_FILE));
        }
        let mut results = Self::open(folder, false)?;
        rows.iter().try_for_each(|row| results.log.append(row))?;
        results.rows = rows;
        Ok(results)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Shows the pictures of these rows from an earlier run.
    pub(in crate::commands) fn show_known(&mut self, has_picture: impl Fn(&Row) -> bool) {
        let shown = self.rows.iter().filter(|row| has_picture(row));
        self.pictures.extend(shown.filter_map(|row| known_picture(self.folder, row)));
    }

    /// Writes a row, and its picture if it is shown.
    pub(super) fn keep(&mut self, Measurement { row, drawing, error_picture }: Measurement) -> Result<()> {
        if let Some(picture) = error_picture.filter(|_| is_shown(&row)) {
            return self.add(row, [&drawing, &picture]);
        }
        self.log.append(&row)?;
        self.rows.push(row);
        Ok(())
    }

    /// Writes a row and its drawing and errors.
    pub(in crate::commands) fn add(&mut self, row: Row, pictures: [&Picture; 2]) -> Result<()> {
        self.log.append(&row)?;
        self.pictures.push(error_page(self.folder, &row, pictures)?);
        self.rows.push(row);
        Ok(())
    }

    /// Refuses rows measured on other terms: one folder has one yardstick.
    pub(super) fn refuse_other_terms(&self, against: Against, how: &MeasureSettings) -> Result<()> {
        let is_other = |row: &Row| row.lines.as_ref().is_some_and(|lines| lines.against != against);
        if self.rows.iter().any(is_other) {
            let problem =
                "its rows were measured against something else; give the same --against, or name another folder";
            return Err(Error::output(self.folder, problem));
        }
        let differs = |row: &Row| {
            let tolerance = row.lines.as_ref().map(|lines| lines.tolerance_px);
            let [width, height] = row.size;
            let now = how.tolerance.px(Size { width, height });
            let is_of_frames = row.style != StyleName::Lines.name() && row.time.frames_ms.len() != how.frames;
            tolerance.is_some_and(|tolerance| (tolerance - now).abs() > 1e-9) || is_of_frames
        };
        match self.rows.iter().find(|row| differs(row)) {
            None => Ok(()),
            Some(row) => Err(Error::output(
                self.folder,
                format!(
                    "its rows were measured with {} and perhaps another tolerance; give the same --frames, --quick and \
                     --tolerance, or name another folder",
                    counted(row.time.frames_ms.len(), "frame")
                ),
            )),
        }
    }

    /// Writes the report and returns its path; `command` is the command line stated in it.
    pub(in crate::commands) fn report(self, command: &str) -> Result<String> {
        let info = ReportInfo { command: command.to_owned(), pictures: self.pictures };
        crate::report::write(self.folder, &self.rows, &info)?;
        Ok(self.folder.join("report.html").display().to_string())
    }
}
