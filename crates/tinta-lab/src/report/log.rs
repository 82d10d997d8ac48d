//! `results.jsonl`: a row a line, on disk as soon as it is known; an interruption loses at most the current row.

use crate::measure::Row;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tinta::error::{Error, FileKind, Result};
use tinta::limits::ROWS_BYTES;
use tinta::record::ROWS_FILE;
use tinta_geometry::files::{self, Failure, shown};

/// The open file of rows.
#[derive(Debug)]
pub struct RowLog {
    file: File,
    path: PathBuf,
}

impl RowLog {
    /// Starts a new file in the folder, which must be there.
    ///
    /// # Errors
    ///
    /// [`Error::File`] if one exists or the folder cannot be written.
    pub fn create(folder: &Path) -> Result<Self> {
        let path = folder.join(ROWS_FILE);
        check(&path)?;
        // A run that ended before its first row left an empty file, which may be replaced.
        if path.metadata().is_ok_and(|file| file.len() > 0) {
            return Err(Error::output(
                path,
                "this folder holds rows of an earlier run; continue with --resume, or name another folder",
            ));
        }
        match OpenOptions::new().append(true).create(true).open(&path) {
            Ok(file) => Ok(Self { file, path }),
            Err(error) => Err(cannot_write(&path, &error)),
        }
    }

    /// Continues the folder's file and returns its rows; begins one where it is missing.
    ///
    /// A last line that was half written when a run was interrupted is cut off.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a complete line that is not a row, and for a file that cannot be written.
    pub fn resume(folder: &Path) -> Result<(Self, Vec<Row>)> {
        let path = folder.join(ROWS_FILE);
        check(&path)?;
        let open = OpenOptions::new().append(true).create(true).open(&path);
        let mut file = open.map_err(|error| cannot_write(&path, &error))?;
        let text = read(&path)?;
        let (rows, sound_bytes) = parse(&path, &text)?;
        let mend = |file: &mut File| {
            file.set_len(sound_bytes as u64)?;
            if sound_bytes > 0 && text[sound_bytes - 1] != b'\n' {
                file.write_all(b"\n")?;
            }
            file.sync_data()
        };
        mend(&mut file).map_err(|error| cannot_write(&path, &error))?;
        Ok((Self { file, path }, rows))
    }

    /// Writes one row, a line, and waits until it is on disk.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a row with a number that is not finite, and for a full disk.
    pub fn append(&mut self, row: &Row) -> Result<()> {
        let problem = |problem: String| Error::file(FileKind::Rows, &self.path, problem);
        let mut line = serde_json::to_string(row).map_err(|error| problem(error.to_string()))?;
        // JSON has neither NaN nor infinity: they would not be read back.
        if serde_json::from_str::<Row>(&line).ok().as_ref() != Some(row) {
            let key = row.key();
            return Err(problem(format!("the row of {key} holds a number that is not finite; please report this")));
        }
        line.push('\n');
        let append = |file: &mut File| {
            let sound_bytes = file.metadata()?.len();
            let written = file.write_all(line.as_bytes()).and_then(|()| file.sync_data());
            // No half row stays on a full disk. Were even that refused, `resume` would cut it off.
            written.inspect_err(|_| drop(file.set_len(sound_bytes)))
        };
        append(&mut self.file).map_err(|error| cannot_write(&self.path, &error))
    }
}

/// Reads all rows of a file; a half-written last line is left out.
///
/// # Errors
///
/// [`Error::File`] naming file and line.
pub fn read_rows(path: &Path) -> Result<Vec<Row>> {
    Ok(parse(path, &read(path)?)?.0)
}

/// Reads the rows of a file's bytes; `name` is for messages.
///
/// # Errors
///
/// [`Error::File`] naming file and line.
pub fn rows_of_bytes(bytes: &[u8], name: &str) -> Result<Vec<Row>> {
    Ok(parse(Path::new(name), bytes)?.0)
}

fn read(path: &Path) -> Result<Vec<u8>> {
    files::read(path, ROWS_BYTES).map_err(|failure| match failure {
        Failure::System(error) if error.kind() == ErrorKind::NotFound => {
            let problem = "there is no such file; name a results.jsonl of tinta measure";
            Error::file(FileKind::Rows, path, problem).because(&error)
        }
        Failure::Folder => Error::file(FileKind::Rows, path, "this is a folder; name the results.jsonl in it"),
        failure => failure.into_error(FileKind::Rows, path, "a results.jsonl"),
    })
}

/// Refuses anything but a file in the rows' place: a pipe would wait for a reader.
fn check(path: &Path) -> Result<()> {
    match path.metadata() {
        Ok(metadata) if !metadata.is_file() => {
            Err(Error::output(path, "this is not a regular file; name another folder"))
        }
        _ => Ok(()),
    }
}

/// The rows, and the bytes of the file that hold them.
fn parse(path: &Path, text: &[u8]) -> Result<(Vec<Row>, usize)> {
    let mut rows = Vec::new();
    let mut sound_bytes = 0;
    for (index, line) in text.split_inclusive(|byte| *byte == b'\n').enumerate() {
        match serde_json::from_slice(line) {
            Ok(row) => rows.push(row),
            Err(_) if line.trim_ascii().is_empty() => {}
            // Without its end this is the line that was being written.
            Err(_) if !line.ends_with(b"\n") => break,
            Err(error) => {
                return Err(Error::file(
                    FileKind::Rows,
                    path,
                    format!("this is not a row of this version ({}); remove the line", without_place(&error)),
                )
                .at(Some(index as u64 + 1)));
            }
        }
        sound_bytes += line.len();
    }
    Ok((rows, sound_bytes))
}

/// serde_json's message without its own count of lines, which is always 1 here.
fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    // It may quote the file.
    shown(text.split(" at line ").next().unwrap_or(&text))
}

fn cannot_write(path: &Path, error: &std::io::Error) -> Error {
    let problem = match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => "its folder does not exist; create it first".to_owned(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "the disk is full; free some space and continue with --resume".to_owned()
        }
        ErrorKind::FileTooLarge => {
            "it would exceed the limit on file sizes (see ulimit -f); raise the limit and continue with --resume"
                .to_owned()
        }
        _ => format!("it cannot be written ({error})"),
    };
    Error::output(path, problem).because(error)
}
