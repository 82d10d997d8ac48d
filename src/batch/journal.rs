//! A slice's file: an entry a line, on its way to the disk as soon as its job has ended.
//!
//! A line is one write to the end of a file that only one run has open, so that a run that is killed leaves whole lines and at
//! most one torn one, which the next run cuts off. A power cut may cost the last lines: their jobs are done again.

use super::entry::{Entry, Status};
use super::job::Job;
use super::list::List;
use super::slice::Slice;
use crate::error::{Error, Result};
use crate::files;
use crate::limits::BATCH_BYTES;
use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The open file of a slice.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
}

impl Journal {
    /// Begins a slice's file in the batch's folder, or goes on with the one that is there and cuts a torn last line off.
    ///
    /// # Errors
    ///
    /// [`Error::Output`] where it cannot be written, or where another run has it open.
    pub fn open(folder: &Path, slice: Slice) -> Result<Self> {
        let path = folder.join(slice.file_name());
        let refuse = |problem: String| Error::Output { path: path.display().to_string(), problem };
        if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
            return Err(refuse("this is no ordinary file; name another folder".to_owned()));
        }
        let cannot = |error: std::io::Error| refuse(format!("it cannot be written ({error}); choose another folder"));
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(cannot)?;
        if !is_alone(&file) {
            return Err(refuse("another run is at work on this; wait for its end, or take another --slice".to_owned()));
        }
        let bytes = read(&path)?;
        let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        if whole < bytes.len() {
            file.set_len(whole as u64).map_err(cannot)?;
        }
        Ok(Self { file, path })
    }

    /// Writes an entry down.
    ///
    /// # Errors
    ///
    /// [`Error::Output`] when the disk is full: then nothing half is left.
    pub fn append(&mut self, entry: &Entry) -> Result<()> {
        let refuse = |problem: String| Error::Output { path: self.path.display().to_string(), problem };
        let mut line = serde_json::to_string(entry).map_err(|error| refuse(format!("{error}; please report this")))?;
        line.push('\n');
        let length = self.file.metadata().map(|metadata| metadata.len());
        self.file.write_all(line.as_bytes()).map_err(|error| {
            if let Ok(length) = length {
                let _ = self.file.set_len(length);
            }
            refuse(format!("it cannot be written ({error}); free some space and go on by --resume"))
        })
    }
}

/// Whether this run alone has the file open. Where the system cannot tell, it is believed.
#[cfg(target_os = "linux")]
fn is_alone(file: &File) -> bool {
    use rustix::fs::{FlockOperation, flock};
    !matches!(flock(file, FlockOperation::NonBlockingLockExclusive), Err(rustix::io::Errno::WOULDBLOCK))
}

#[cfg(not(target_os = "linux"))]
fn is_alone(_: &File) -> bool {
    true
}

fn read(path: &Path) -> Result<Vec<u8>> {
    files::read(path, BATCH_BYTES).map_err(|failure| Error::Batch {
        path: path.display().to_string(),
        line: None,
        problem: failure.problem("a batch's record"),
    })
}

/// All that is written down in a batch's folder, by whatever slices.
#[derive(Debug, Default)]
pub struct Entries {
    /// By the jobs' names, in the order of the slices' files and their lines.
    by_id: HashMap<String, Vec<Entry>>,
    /// The slices that have begun.
    pub slices: Vec<Slice>,
    /// Whole lines that cannot be understood.
    pub damaged: usize,
}

impl Entries {
    /// Reads what is there.
    ///
    /// # Errors
    ///
    /// [`Error::Batch`] for a file that cannot be read.
    pub fn read(folder: &Path) -> Result<Self> {
        let names = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut slices: Vec<Slice> = names.filter_map(|file| Slice::of_file_name(file.file_name().to_str()?)).collect();
        slices.sort();
        let mut entries = Self { slices, ..Self::default() };
        for slice in entries.slices.clone() {
            entries.add(&read(&folder.join(slice.file_name()))?);
        }
        Ok(entries)
    }

    /// Adds a file's entries; a last line without its end is being written, or was when a run was killed.
    pub fn add(&mut self, bytes: &[u8]) {
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            match serde_json::from_slice::<Entry>(line) {
                Ok(entry) => self.by_id.entry(entry.id.clone()).or_default().push(entry),
                Err(_) if line.ends_with(b"\n") && !line.trim_ascii().is_empty() => self.damaged += 1,
                Err(_) => {}
            }
        }
    }

    /// What came of a job, as it is now: that it is done, or else what was written down last.
    pub fn of(&self, job: &Job) -> Option<&Entry> {
        let mut entries = self.by_id.get(&job.id)?.iter().filter(|entry| entry.job == job.sha256);
        let last = entries.clone().next_back();
        entries.rfind(|entry| entry.outcome.status == Status::Done).or(last)
    }

    /// Whether a job is done and what it wrote is still there.
    pub fn has_done(&self, job: &Job, folder: &Path) -> bool {
        self.by_id.get(&job.id).is_some_and(|entries| entries.iter().any(|entry| entry.is_done(job, folder)))
    }

    /// How many entries are of no job of this list: of one that was changed or taken out.
    pub fn outdated(&self, list: &List) -> usize {
        let jobs: HashMap<&str, &str> = list.jobs.iter().map(|job| (job.id.as_str(), job.sha256.as_str())).collect();
        let is_outdated = |entry: &&Entry| jobs.get(entry.id.as_str()) != Some(&entry.job.as_str());
        self.by_id.values().flatten().filter(is_outdated).count()
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
            assert_eq!((read.damaged, read.by_id["a"].len()), (0, if torn + 1 == whole.len() { 2 } else { 1 }));
        }
        drop(journal);
        let mut journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), whole);
        journal.append(&entry("b")).unwrap();
        let read = Entries::read(folder.path()).unwrap();
        assert!(read.of(&job("a")).is_some() && read.of(&job("b")).is_some() && read.of(&job("c")).is_none());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn two_runs_of_one_slice_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let journal = Journal::open(folder.path(), Slice::WHOLE).unwrap();
        let said = Journal::open(folder.path(), Slice::WHOLE).unwrap_err().to_string();
        assert!(said.contains("another run is at work"), "{said}");
        Journal::open(folder.path(), Slice { count: 2, number: 1 }).unwrap();
        drop(journal);
        Journal::open(folder.path(), Slice::WHOLE).unwrap();
    }

    #[test]
    fn done_counts_more_than_failed_whatever_came_last() {
        let mut entries = Entries::default();
        let failed = Entry::new(&job("a"), Outcome::failed("model", "no"));
        let mut done = failed.clone();
        done.outcome.status = Status::Done;
        for entry in [&failed, &done, &failed] {
            entries.add(format!("{}\nnonsense\n", serde_json::to_string(entry).unwrap()).as_bytes());
        }
        assert_eq!(entries.of(&job("a")), Some(&done));
        assert_eq!(entries.damaged, 3);
    }
}
