//! The journal of a slice: one entry per line, written as soon as its job ends, of jobs whose files do not say how they ended.
//!
//! A line is one write to the end of a file that only one run has open. A killed run leaves whole lines and at most one torn
//! line, which the next run cuts off. A power cut may cost the last lines: their jobs run again.

use super::entry::Entry;
use super::slice::Slice;
use crate::error::{Error, FileKind, Result};
use crate::files;
use crate::limits::BATCH_BYTES;
use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The open file of a slice.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
}

impl Journal {
    /// Creates a slice's file in the batch's folder, or continues the existing one and cuts off a torn last line.
    ///
    /// # Errors
    ///
    /// [`Error::File`] if it cannot be written, [`Error::Busy`] if another run has it open.
    pub fn open(folder: &Path, slice: Slice) -> Result<Self> {
        let path = folder.join(slice.file_name());
        if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
            return Err(Error::output(&path, "this is not a regular file; name another folder"));
        }
        let cannot = |error: std::io::Error| {
            Error::output(&path, format!("it cannot be written ({error}); choose another folder")).because(&error)
        };
        let Some(mut file) = open_alone(&path).map_err(cannot)? else { return Err(Error::Busy { path }) };
        cut_torn(&mut file).map_err(cannot)?;
        Ok(Self { file, path })
    }

    /// Writes an entry down.
    ///
    /// # Errors
    ///
    /// [`Error::File`] if it cannot be written: no partial line is left.
    pub(crate) fn append(&mut self, entry: &Entry) -> Result<()> {
        let refuse = |problem: String| Error::output(&self.path, problem);
        let mut line = serde_json::to_string(entry).map_err(|error| refuse(format!("{error}; please report this")))?;
        line.push('\n');
        let length = self.file.metadata().map(|metadata| metadata.len());
        // Only on Unix can a file be opened for appending and still be truncated.
        let written = self.file.seek(SeekFrom::End(0)).and_then(|_| self.file.write_all(line.as_bytes()));
        written.map_err(|error| {
            if let Ok(length) = length {
                let _ = self.file.set_len(length);
            }
            let problem = format!("it cannot be written ({error}); free some space and give the same command again");
            Error::output(&self.path, problem).because(&error)
        })
    }
}

impl Drop for Journal {
    /// Removes an empty journal.
    fn drop(&mut self) {
        if self.file.metadata().is_ok_and(|file| file.len() == 0) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Cuts off everything after the last line's end.
fn cut_torn(file: &mut File) -> std::io::Result<()> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    let end = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    if end < bytes.len() { file.set_len(end as u64) } else { Ok(()) }
}

/// Opens the file for appending, for this run alone; `None` if another run has it open.
#[cfg(unix)]
fn open_alone(path: &Path) -> std::io::Result<Option<File>> {
    use rustix::fs::{FlockOperation, flock};
    use rustix::io::Errno;
    use std::os::unix::fs::MetadataExt;
    let mut attempts = 0;
    loop {
        let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
        // If the file system cannot tell, the run counts as alone.
        let is_taken = matches!(flock(&file, FlockOperation::NonBlockingLockExclusive), Err(Errno::WOULDBLOCK));
        // A run that ended meanwhile removes its empty file. Some file systems count no links.
        attempts += 1;
        if is_taken || file.metadata()?.nlink() > 0 || attempts > 100 {
            return Ok((!is_taken).then_some(file));
        }
    }
}

/// The same on Windows, where a file itself limits how others may open it: for reading.
#[cfg(windows)]
fn open_alone(path: &Path) -> std::io::Result<Option<File>> {
    use std::os::windows::fs::OpenOptionsExt;
    use windows_sys::Win32::Foundation::ERROR_SHARING_VIOLATION;
    use windows_sys::Win32::Storage::FileSystem::{FILE_SHARE_DELETE, FILE_SHARE_READ};
    let mut options = OpenOptions::new();
    // On Windows a file opened for appending cannot be truncated.
    options.read(true).write(true).create(true).truncate(false).share_mode(FILE_SHARE_READ | FILE_SHARE_DELETE);
    match options.open(path) {
        Err(error) if error.raw_os_error() == Some(ERROR_SHARING_VIOLATION as i32) => Ok(None),
        opened => opened.map(Some),
    }
}

/// Returns a folder's entries that may be of a slice's jobs, by [`super::Job::json`].
///
/// Only relevant files are read: the slice's own and those of another number of slices. Other slices of the same number contain
/// none of its jobs.
///
/// # Errors
///
/// [`Error::File`] for a file that cannot be read.
pub(crate) fn entries(folder: &Path, slice: Slice) -> Result<HashMap<String, Entry>> {
    let mut found = HashMap::new();
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let slices = files.filter_map(|file| Slice::of_file_name(file.file_name().to_str()?));
    for other in slices.filter(|other| other.count != slice.count || *other == slice) {
        let path = folder.join(other.file_name());
        let read = files::read(&path, BATCH_BYTES);
        add_entries(
            &mut found,
            &read.map_err(|failure| failure.into_error(FileKind::Batch, &path, "a batch's record"))?,
        );
    }
    Ok(found)
}

/// Adds a file's entries. Of each job the last that is done counts, or the last. A line that cannot be understood is passed over, as
/// is one without its end: it is being written, or was when a run was killed.
pub fn add_entries(found: &mut HashMap<String, Entry>, bytes: &[u8]) {
    for entry in bytes.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice::<Entry>(line).ok()) {
        // Text and numbers alone.
        let job = serde_json::to_string(&entry.job).unwrap_or_default();
        if entry.outcome.error.is_none() || found.get(&job).is_none_or(|known| known.outcome.error.is_some()) {
            found.insert(job, entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Job, Outcome};
    use super::*;

    fn job(id: &str) -> Job {
        Job::parse(format!(r#"{{"id":"{id}","output":"{id}.png"}}"#).as_bytes()).unwrap()
    }

    fn failed(id: &str) -> Entry {
        Entry::new(&job(id), Outcome::failed("model", "no"))
    }

    fn done(id: &str) -> Entry {
        Entry::new(&job(id), Outcome::default())
    }

    fn line(entry: &Entry) -> String {
        serde_json::to_string(entry).unwrap() + "\n"
    }

    #[test]
    fn a_torn_last_line_is_passed_over_and_cut_off() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("batch-1-of-1.jsonl");
        let mut journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        journal.append(&failed("a")).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for torn in 1..whole.len() {
            std::fs::write(&path, [&whole[..], &whole[..torn]].concat()).unwrap();
            assert_eq!(entries(folder.path(), Slice::WHOLE).unwrap().len(), 1);
        }
        drop(journal);
        let journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), whole);
        drop(journal);
        // Also a torn line longer than one read.
        std::fs::write(&path, [&whole[..], &[b'x'; 200_000]].concat()).unwrap();
        Journal::open(folder.path(), Slice::WHOLE).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), whole);
        // A torn line alone leaves no file.
        std::fs::write(&path, vec![b'x'; 100_000]).unwrap();
        Journal::open(folder.path(), Slice::WHOLE).unwrap();
        assert!(!path.exists());
        std::fs::write(&path, &whole).unwrap();
        let mut journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        journal.append(&failed("b")).unwrap();
        let read = entries(folder.path(), Slice::WHOLE).unwrap();
        assert_eq!(["a", "b", "c"].map(|id| read.contains_key(&job(id).json)), [true, true, false]);
    }

    #[cfg(any(unix, windows))]
    #[test]
    fn two_runs_of_one_slice_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        let busy = Journal::open(folder.path(), Slice::WHOLE).unwrap_err();
        assert!(matches!(busy, Error::Busy { .. }) && busy.to_string().contains("another run is working"), "{busy}");
        Journal::open(folder.path(), Slice { count: 2, number: 1 }).unwrap();
        drop(journal);
        Journal::open(folder.path(), Slice::WHOLE).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn no_entry_is_lost_where_a_run_without_entries_ends_as_another_begins() {
        for _ in 0..100 {
            let folder = tempfile::tempdir().unwrap();
            let writes = |run: usize| match Journal::open(folder.path(), Slice::WHOLE) {
                Ok(mut journal) if run.is_multiple_of(2) => journal.append(&done(&run.to_string())).is_ok(),
                _ => false,
            };
            let written = std::thread::scope(|scope| {
                let runs = [0, 1, 2, 3].map(|run| scope.spawn(move || writes(run)));
                runs.into_iter().filter_map(|run| run.join().ok()).filter(|has_written| *has_written).count()
            });
            assert_eq!(entries(folder.path(), Slice::WHOLE).unwrap().len(), written);
        }
    }

    #[test]
    fn done_counts_more_than_failed_whatever_came_last() {
        let mut found = HashMap::new();
        for entry in [failed("a"), done("a"), failed("a")] {
            add_entries(&mut found, format!("{}nonsense\n", line(&entry)).as_bytes());
        }
        assert_eq!(found, HashMap::from([(job("a").json, done("a"))]));
    }

    #[test]
    fn a_slice_reads_what_may_hold_its_jobs() {
        let folder = tempfile::tempdir().unwrap();
        let of = |number, count| Slice { count, number };
        let write = |slice: Slice, entry: Entry| {
            std::fs::write(folder.path().join(slice.file_name()), line(&entry)).unwrap();
        };
        write(of(1, 3), done("own"));
        write(of(2, 2), done("from another count"));
        write(of(1, 2), failed("failed"));
        // Of another slice of the same count, whose jobs this one does not have.
        write(of(2, 3), done("beside"));
        let ids = |slice| {
            let mut ids: Vec<String> =
                entries(folder.path(), slice)?.values().map(|entry| entry.job["id"].to_string()).collect();
            ids.sort();
            Result::Ok(ids.join(" "))
        };
        assert_eq!(ids(of(1, 3)).unwrap(), r#""failed" "from another count" "own""#);
        assert_eq!(ids(of(1, 2)).unwrap(), r#""beside" "failed" "own""#);
        assert_eq!(ids(Slice::WHOLE).unwrap(), r#""beside" "failed" "from another count" "own""#);
        // Nor does it matter that it cannot be read, but to those who must.
        std::fs::create_dir(folder.path().join(of(3, 3).file_name())).unwrap();
        assert!(ids(of(1, 3)).is_ok());
        for slice in [of(1, 2), Slice::WHOLE] {
            let said = ids(slice).unwrap_err().to_string();
            assert!(said.contains("batch-3-of-3.jsonl: this is a directory"), "{said}");
        }
    }
}
