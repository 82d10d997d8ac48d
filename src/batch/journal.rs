//! The journal of a slice: one entry per line, written as soon as its job ends.
//!
//! A line is one write to the end of a file that only one run has open. A killed run leaves whole lines and at most one torn
//! line, which the next run cuts off. A power cut may cost the last lines: their jobs run again.

use super::entry::{Entry, Status};
use super::job::Job;
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
    pub fn append(&mut self, entry: &Entry) -> Result<()> {
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
            let problem = format!("it cannot be written ({error}); free some space and continue with --resume");
            Error::output(&self.path, problem).because(&error)
        })
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
    let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
    // If the file system cannot tell, the run counts as alone.
    let is_taken = matches!(flock(&file, FlockOperation::NonBlockingLockExclusive), Err(Errno::WOULDBLOCK));
    Ok((!is_taken).then_some(file))
}

/// The same on Windows, where a file itself limits how others may open it: for reading.
#[cfg(windows)]
fn open_alone(path: &Path) -> std::io::Result<Option<File>> {
    use std::os::windows::fs::OpenOptionsExt;
    use windows_sys::Win32::Foundation::ERROR_SHARING_VIOLATION;
    use windows_sys::Win32::Storage::FileSystem::FILE_SHARE_READ;
    let mut options = OpenOptions::new();
    // On Windows a file opened for appending cannot be truncated.
    options.read(true).write(true).create(true).truncate(false).share_mode(FILE_SHARE_READ);
    match options.open(path) {
        Err(error) if error.raw_os_error() == Some(ERROR_SHARING_VIOLATION as i32) => Ok(None),
        opened => opened.map(Some),
    }
}

fn read(path: &Path) -> Result<Vec<u8>> {
    files::read(path, BATCH_BYTES).map_err(|failure| failure.into_error(FileKind::Batch, path, "a batch's record"))
}

/// The slices with a file in a batch's folder; the files are not read.
pub fn begun(folder: &Path) -> Vec<Slice> {
    let names = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut slices: Vec<Slice> = names.filter_map(|file| Slice::of_file_name(file.file_name().to_str()?)).collect();
    slices.sort();
    slices
}

/// Returns which of a slice's jobs are done with their output still present.
///
/// Only relevant files are read: the slice's own and those of another number of slices. Other slices of the same number contain
/// none of its jobs.
///
/// # Errors
///
/// [`Error::File`] for a file that cannot be read.
pub fn done(folder: &Path, slice: Slice, jobs: &[Job]) -> Result<Vec<bool>> {
    let places: HashMap<&str, usize> =
        jobs.iter().enumerate().map(|(place, job)| (job.sha256.as_str(), place)).collect();
    let mut done = vec![false; jobs.len()];
    for other in begun(folder) {
        if other.count == slice.count && other != slice {
            continue;
        }
        for line in read(&folder.join(other.file_name()))?.split(|byte| *byte == b'\n') {
            let Ok(entry) = serde_json::from_slice::<Entry>(line) else { continue };
            let Some(place) = places.get(entry.job.as_str()) else { continue };
            done[*place] = done[*place] || entry.is_done(&jobs[*place], folder);
        }
    }
    Ok(done)
}

/// All entries in a batch's folder, of any slices.
#[derive(Debug, Default)]
pub struct Entries {
    /// By [`Entry::job`]: the line that counts with its status, and how many there are. A line takes half the memory of its entry.
    found: HashMap<String, (Box<[u8]>, Status, usize)>,
    /// Whole lines that cannot be understood.
    pub damaged: usize,
}

impl Entries {
    /// Reads the existing entries.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a file that cannot be read.
    pub fn read(folder: &Path) -> Result<Self> {
        let mut entries = Self::default();
        for slice in begun(folder) {
            entries.add(&read(&folder.join(slice.file_name()))?);
        }
        Ok(entries)
    }

    /// Adds a file's entries; a last line without its end is being written, or was when a run was killed.
    pub fn add(&mut self, bytes: &[u8]) {
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            let Ok(entry) = serde_json::from_slice::<Entry>(line) else {
                self.damaged += usize::from(line.ends_with(b"\n") && !line.trim_ascii().is_empty());
                continue;
            };
            let (counts, status, count) = self.found.entry(entry.job).or_insert((Box::default(), Status::Failed, 0));
            *count += 1;
            if entry.status == Status::Done || *status == Status::Failed {
                (*counts, *status) = (line.into(), entry.status);
            }
        }
    }

    /// The result of a job in its current form: done if any entry says done, otherwise the last entry.
    pub fn of(&self, job: &Job) -> Option<Entry> {
        self.found.get(&job.sha256).and_then(|(line, ..)| serde_json::from_slice(line).ok())
    }

    /// Number of entries of a job in its current form.
    pub(crate) fn count_of(&self, job: &Job) -> usize {
        self.found.get(&job.sha256).map_or(0, |(.., count)| *count)
    }

    /// How many entries there are in all.
    pub fn count(&self) -> usize {
        self.found.values().map(|(.., count)| count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::entry::Outcome;
    use super::*;

    fn job(id: &str) -> Job {
        Job::parse(format!(r#"{{"id":"{id}","command":"render"}}"#).as_bytes()).unwrap()
    }

    #[test]
    fn a_torn_last_line_is_passed_over_and_cut_off() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("batch-1-of-1.jsonl");
        let entry = |id: &str| Entry::new(&job(id), Outcome::failed("model", "no"));
        let mut journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        journal.append(&entry("a")).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for torn in 1..whole.len() {
            std::fs::write(&path, [&whole[..], &whole[..torn]].concat()).unwrap();
            let read = Entries::read(folder.path()).unwrap();
            assert_eq!((read.damaged, read.count()), (0, if torn + 1 == whole.len() { 2 } else { 1 }));
        }
        drop(journal);
        let journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), whole);
        drop(journal);
        // Also a torn line longer than one read, and one that is the only line.
        for (text, kept) in [([&whole[..], &[b'x'; 200_000]].concat(), whole.len()), (vec![b'x'; 100_000], 0)] {
            std::fs::write(&path, &text).unwrap();
            Journal::open(folder.path(), Slice::WHOLE).unwrap();
            assert_eq!(std::fs::read(&path).unwrap(), text[..kept]);
        }
        std::fs::write(&path, &whole).unwrap();
        let mut journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        journal.append(&entry("b")).unwrap();
        let read = Entries::read(folder.path()).unwrap();
        assert!(read.of(&job("a")).is_some() && read.of(&job("b")).is_some() && read.of(&job("c")).is_none());
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

    #[test]
    fn done_counts_more_than_failed_whatever_came_last() {
        let mut entries = Entries::default();
        let failed = Entry::new(&job("a"), Outcome::failed("model", "no"));
        let mut done = failed.clone();
        done.status = Status::Done;
        for entry in [&failed, &done, &failed] {
            entries.add(format!("{}\nnonsense\n", serde_json::to_string(entry).unwrap()).as_bytes());
        }
        assert_eq!(entries.of(&job("a")), Some(done));
        assert_eq!((entries.damaged, entries.count_of(&job("a")), entries.count_of(&job("b"))), (3, 3, 0));
    }

    #[test]
    fn a_slice_reads_what_may_hold_its_jobs_and_a_summary_reads_all() {
        let folder = tempfile::tempdir().unwrap();
        let of = |number, count| Slice { count, number };
        let write = |slice: Slice, id: &str, status| {
            let outcome = Outcome { status, error: None, ..Outcome::failed("", "") };
            let line = serde_json::to_string(&Entry::new(&job(id), outcome)).unwrap();
            std::fs::write(folder.path().join(slice.file_name()), format!("{line}\n")).unwrap();
        };
        write(of(1, 3), "own", Status::Done);
        write(of(2, 2), "from another count", Status::Done);
        write(of(1, 2), "failed", Status::Failed);
        // This entry describes one of the slice's jobs, which only the slice itself may do: it is ignored.
        write(of(2, 3), "beside", Status::Done);
        let jobs = ["own", "from another count", "failed", "beside"].map(job);
        assert_eq!(done(folder.path(), of(1, 3), &jobs).unwrap(), [true, true, false, false]);
        assert_eq!(done(folder.path(), of(1, 2), &jobs).unwrap(), [true, false, false, true]);
        // Nor does it matter that it cannot be read, but to those who must.
        std::fs::create_dir(folder.path().join(of(3, 3).file_name())).unwrap();
        assert_eq!(done(folder.path(), of(1, 3), &jobs).unwrap(), [true, true, false, false]);
        let said = [
            done(folder.path(), of(1, 2), &jobs).unwrap_err().to_string(),
            Entries::read(folder.path()).unwrap_err().to_string(),
        ];
        assert!(said.iter().all(|said| said.contains("batch-3-of-3.jsonl: this is a directory")), "{said:?}");
        std::fs::remove_dir(folder.path().join(of(3, 3).file_name())).unwrap();
        std::fs::write(folder.path().join(of(3, 3).file_name()), "nonsense\n".repeat(5)).unwrap();
        let read = Entries::read(folder.path()).unwrap();
        assert_eq!((read.count(), read.damaged), (4, 5));
    }
}
