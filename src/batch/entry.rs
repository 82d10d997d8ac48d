//! A journal entry: the result of one finished job.

use super::job::{Job, JobCommand};
use super::named_outputs::NamedOutput;
use super::output_path::place_in;
use crate::recipe::{Driver, FileRecord};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Its outputs are there, whole.
    Done,
    /// Ended with an error, or with a check that found a difference.
    Failed,
}

/// Why a job failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// [`crate::Error::kind`], `check` for a check that found a difference, `crash` for a worker that ended.
    pub kind: String,
    /// The command's error; paths in the batch's folder are relative to it.
    pub problem: String,
}

/// A file that a job wrote.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Written {
    /// From the batch's folder, with `/` between names.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, hexadecimal.
    pub sha256: String,
}

/// The part of an entry that differs each time a job runs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// From reading the line to the last file.
    pub milliseconds: f64,
    /// How often it was tried: a second time where the GL context was lost.
    pub tries: u32,
    /// The driver; `None` where the job drew nothing.
    pub gl: Option<Driver>,
    /// The command's standard output: a record where the job has `json`.
    pub printed: Option<String>,
}

/// The result of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
    /// Why it failed, if it did.
    pub error: Option<Failure>,
    /// Remarks of the command, a sentence each.
    pub remarks: Vec<String>,
    /// Its output files, sorted by path.
    pub outputs: Vec<Written>,
    /// The part that differs each time.
    pub run: Run,
}

impl Outcome {
    /// The outcome of a job that failed for this reason.
    pub fn failed(kind: &str, problem: impl Into<String>) -> Self {
        Self {
            status: Status::Failed,
            error: Some(Failure { kind: kind.to_owned(), problem: problem.into() }),
            remarks: Vec::new(),
            outputs: Vec::new(),
            run: Run::default(),
        }
    }
}

/// A job and its result: a line of a slice's file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The job's name.
    pub id: String,
    /// Its line in the list.
    pub line: u64,
    /// [`Job::sha256`]: a job that has been changed since is another.
    pub job: String,
    /// The command.
    pub command: JobCommand,
    /// How it ended.
    pub status: Status,
    /// Why it failed, if it did.
    pub error: Option<Failure>,
    /// Remarks of the command, a sentence each.
    pub remarks: Vec<String>,
    /// Its output files, sorted by path.
    pub outputs: Vec<Written>,
    /// The part that differs each time.
    pub run: Run,
}

impl Entry {
    /// Makes the entry of a job.
    pub fn new(job: &Job, outcome: Outcome) -> Self {
        let Outcome { status, error, remarks, outputs, run } = outcome;
        let (id, line, sha256, command) = (job.id.clone(), job.line, job.sha256.clone(), job.command);
        Self { id, line, job: sha256, command, status, error, remarks, outputs, run }
    }

    /// Whether this entry marks the job as done, and its output files still exist with the same lengths.
    pub fn is_done(&self, job: &Job, folder: &Path) -> bool {
        let is_there = |file: &Written| {
            folder.join(&file.path).metadata().is_ok_and(|there| there.is_file() && there.len() == file.bytes)
        };
        self.job == job.sha256 && self.status == Status::Done && self.outputs.iter().all(is_there)
    }
}

/// Returns the existing output of a job: its files, those in its folders, the pictures of a pattern such as `frame-%04d.png`.
pub fn written(job: &Job, folder: &Path) -> Vec<Written> {
    let mut files = Vec::new();
    for named in NamedOutput::all(job) {
        let Ok(place) = place_in(folder, &named.output) else { continue };
        if place.is_dir() {
            files_in(&place, &mut files);
        } else {
            if named.output.contains('%') {
                files.extend(numbered(&named, &place, folder));
            }
            files.push(place);
        }
    }
    files.sort();
    files.dedup();
    files.iter().filter_map(|file| record(file, folder)).collect()
}

fn record(file: &Path, folder: &Path) -> Option<Written> {
    let FileRecord { bytes, sha256, .. } = FileRecord::of(file).ok()?;
    let names: Vec<_> = file.strip_prefix(folder).ok()?.iter().map(|name| name.to_string_lossy()).collect();
    Some(Written { path: names.join("/"), bytes, sha256 })
}

/// The files of a folder and of those in it; links are not followed.
fn files_in(folder: &Path, files: &mut Vec<PathBuf>) {
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => folders.push(entry.path()),
                Ok(kind) if kind.is_file() => files.push(entry.path()),
                _ => {}
            }
        }
    }
}

/// The files whose names match a pattern with a number.
fn numbered(named: &NamedOutput, pattern: &Path, folder: &Path) -> Vec<PathBuf> {
    let names = std::fs::read_dir(pattern.parent().unwrap_or(folder)).into_iter().flatten().flatten();
    let is_one = |file: &PathBuf| {
        let name = file.strip_prefix(folder).ok().and_then(Path::to_str);
        name.is_some_and(|name| named.has_numbered(&name.replace(std::path::MAIN_SEPARATOR, "/")))
    };
    names.map(|file| file.path()).filter(is_one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_folders_and_numbered_pictures_are_found_and_known_again() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("steps/more")).unwrap();
        for name in ["f-01.png", "f-02.png", "f-2.png", "f-04.png", "f-x.png", "steps/b", "steps/more/a", "other"] {
            std::fs::write(at(name), name).unwrap();
        }
        let line = r#"{"id":"a","command":"render","output":"f-%02d.png","turntable":3,"dump":"./steps"}"#;
        let job = Job::parse(line.as_bytes()).unwrap();
        let found = written(&job, folder.path());
        let paths: Vec<&str> = found.iter().map(|file| file.path.as_str()).collect();
        assert_eq!(paths, ["f-01.png", "f-02.png", "steps/b", "steps/more/a"]);
        assert_eq!((found[1].bytes, found[1].sha256.len()), (8, 64));
        let outcome =
            Outcome { status: Status::Done, error: None, remarks: Vec::new(), outputs: found, run: Run::default() };
        let entry = Entry::new(&job, outcome);
        assert!(entry.is_done(&job, folder.path()));
        let text = serde_json::to_string(&entry).unwrap();
        assert_eq!(serde_json::from_str::<Entry>(&text).unwrap(), entry);
        let changed = Job::parse(line.replace("02d", "03d").as_bytes()).unwrap();
        assert!(!entry.is_done(&changed, folder.path()));
        std::fs::write(at("steps/b"), "longer than it was").unwrap();
        assert!(!entry.is_done(&job, folder.path()));
    }
}
