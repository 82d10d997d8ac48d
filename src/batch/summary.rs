//! The summary of a whole list, from the journals of its slices.
//!
//! `batch-summary.jsonl` has a line for every job in the list's order, and only facts that are the same in every run: the slices
//! of many machines merge into the bytes of a single machine's run. Times, drivers and everything that contains a time go to
//! `batch-times.jsonl`, also one line per job.

use super::entry::{Entry, Failure, Run, Status, Written};
use super::job::{Job, JobCommand};
use super::journal::Entries;
use super::list::{LIST_FILE, List};
use super::slice::Slice;
use crate::error::{Error, FileKind, Result};
use crate::output::Staged;
use crate::renderer::median;
use serde::Serialize;
use std::path::Path;

/// The facts that are the same every time, one line per job.
const SUMMARY_FILE: &str = "batch-summary.jsonl";

/// The facts that differ every time, one line per job.
const TIMES_FILE: &str = "batch-times.jsonl";

/// The result of a batch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Jobs in the list.
    pub jobs: usize,
    /// The number of these that are done.
    pub done: usize,
    /// How many failed.
    pub failed: usize,
    /// How many have not ended yet.
    pub missing: usize,
    /// Entries of jobs that were changed or taken out of the list since.
    pub outdated: usize,
    /// Lines of the slices' files that cannot be understood.
    pub damaged: usize,
    /// The same by command.
    pub commands: Vec<CommandSummary>,
    /// Those that failed, in the list's order.
    pub failures: Vec<Named>,
    /// Those that have not ended, in the list's order.
    pub missing_jobs: Vec<Named>,
}

/// A command's jobs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CommandSummary {
    /// The command.
    pub command: JobCommand,
    /// How many are done.
    pub done: usize,
    /// How many failed.
    pub failed: usize,
    /// How many have not ended yet.
    pub missing: usize,
    /// Milliseconds of the ended jobs: the sum, the median, the maximum.
    pub milliseconds: [f64; 3],
}

/// A job to report.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Named {
    /// Its line in the list.
    pub line: u64,
    /// Its name.
    pub id: String,
    /// Why it failed; empty for one that has not ended.
    pub problem: String,
}

/// A line of the summary.
#[derive(Serialize)]
struct Row<'a> {
    line: u64,
    id: &'a str,
    job: &'a str,
    command: JobCommand,
    status: &'static str,
    error: Option<&'a Failure>,
    remarks: &'a [String],
    outputs: Vec<Output<'a>>,
}

/// A file, with its length and hash unless it contains times.
#[derive(Serialize)]
struct Output<'a> {
    path: &'a str,
    bytes: Option<u64>,
    sha256: Option<&'a str>,
}

/// A line of the times.
#[derive(Serialize)]
struct TimesRow<'a> {
    line: u64,
    id: &'a str,
    #[serde(flatten)]
    run: &'a Run,
    /// Those of the remarks that speak of times.
    remarks: &'a [String],
    /// Those of the outputs that hold times.
    outputs: Vec<&'a Written>,
}

impl Summary {
    /// Reads a batch's folder, even while runs are working there, and writes either both files there or none.
    ///
    /// # Errors
    ///
    /// [`Error::File`] if the folder holds no batch, its files cannot be read, or the summary cannot be written.
    pub(crate) fn put_together(folder: &Path) -> Result<Self> {
        let path = folder.join(LIST_FILE);
        if path.symlink_metadata().is_err() {
            return Err(Error::file(FileKind::Batch, path, "there is no such file; name the folder of a batch"));
        }
        let (summary, [rows, times]) = Self::new(&List::read(&path)?, &Entries::read(folder)?);
        let stage = |name: &str, text: String| Staged::new(&folder.join(name), text.as_bytes());
        let files = [stage(SUMMARY_FILE, rows)?, stage(TIMES_FILE, times)?];
        files.into_iter().try_for_each(Staged::put_in_place)?;
        Ok(summary)
    }

    /// Combines a list with the journal's entries; also the text of the summary, and of the times.
    pub fn new(list: &List, entries: &Entries) -> (Self, [String; 2]) {
        let mut texts = [String::new(), String::new()];
        let (mut failures, mut missing_jobs, mut current) = (Vec::new(), Vec::new(), 0);
        let mut commands = JobCommand::ALL.map(|command| {
            (CommandSummary { command, done: 0, failed: 0, missing: 0, milliseconds: [0.0; 3] }, Vec::new())
        });
        for job in list.jobs(Slice::WHOLE) {
            let entry = entries.of(&job);
            let entry = entry.as_ref();
            current += entries.count_of(&job);
            add_rows(&mut texts, &job, entry);
            let (counts, times) = &mut commands[job.command as usize];
            times.extend(entry.map(|entry| entry.run.milliseconds));
            let named = |problem: &str| Named { line: job.line, id: job.id.clone(), problem: problem.to_owned() };
            match entry {
                None => {
                    counts.missing += 1;
                    missing_jobs.push(named(""));
                }
                Some(Entry { status: Status::Done, .. }) => counts.done += 1,
                Some(Entry { error, .. }) => {
                    counts.failed += 1;
                    failures.push(named(error.as_ref().map_or("", |error| &error.problem)));
                }
            }
        }
        let commands = commands.into_iter().filter(|(counts, _)| counts.done + counts.failed + counts.missing > 0);
        let commands = commands.map(|(counts, times)| {
            let (sum, longest) = times.iter().fold((0.0, 0.0), |(sum, most), time| (sum + time, time.max(most)));
            CommandSummary { milliseconds: [sum, median(times).unwrap_or_default(), longest], ..counts }
        });
        let summary = Self {
            jobs: list.count,
            done: list.count - failures.len() - missing_jobs.len(),
            failed: failures.len(),
            missing: missing_jobs.len(),
            outdated: entries.count() - current,
            damaged: entries.damaged,
            commands: commands.collect(),
            failures,
            missing_jobs,
        };
        (summary, texts)
    }

    /// Whether every job is done.
    pub(crate) fn is_all_done(&self) -> bool {
        self.done == self.jobs
    }
}

/// Adds a job's line to the summary and, if it has ended, to the times.
fn add_rows([summary, times]: &mut [String; 2], job: &Job, entry: Option<&Entry>) {
    let outputs = entry.map_or(&[][..], |entry| &entry.outputs);
    let remarks = entry.map_or(&[][..], |entry| &entry.remarks);
    // A measurement first prints its expected time.
    let (same, differ) = if job.command == JobCommand::Measure { (&[][..], remarks) } else { (remarks, &[][..]) };
    let is_timed = |file: &&Written| holds_times(job.command, &file.path);
    let output = |file| {
        let same = Some(file).filter(|file| !is_timed(file));
        Output { path: &file.path, bytes: same.map(|file| file.bytes), sha256: same.map(|file| file.sha256.as_str()) }
    };
    let row = Row {
        line: job.line,
        id: &job.id,
        job: &job.sha256,
        command: job.command,
        status: match entry.map(|entry| entry.status) {
            None => "missing",
            Some(Status::Done) => "done",
            Some(Status::Failed) => "failed",
        },
        error: entry.and_then(|entry| entry.error.as_ref()),
        remarks: same,
        outputs: outputs.iter().map(output).collect(),
    };
    add_line(summary, &row);
    if let Some(Entry { run, .. }) = entry {
        let outputs = outputs.iter().filter(is_timed).collect();
        add_line(times, &TimesRow { line: job.line, id: &job.id, run, remarks: differ, outputs });
    }
}

/// Whether a file of a command holds times: a measurement's rows and pages, a comparison's sheet.
fn holds_times(command: JobCommand, path: &str) -> bool {
    const WITHOUT: [&str; 3] = ["left.png", "right.png", "lines.png"];
    match command {
        JobCommand::Render => false,
        JobCommand::Compare => !path.rsplit_once('/').is_some_and(|(_, name)| WITHOUT.contains(&name)),
        JobCommand::Measure => true,
    }
}

fn add_line(text: &mut String, row: &impl Serialize) {
    // Only text and finite numbers, which JSON can represent.
    text.push_str(&serde_json::to_string(row).unwrap_or_default());
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::super::entry::Outcome;
    use super::*;

    #[test]
    fn a_summary_is_the_same_however_the_entries_are_spread_and_timed() {
        let line = |id: usize| format!("{{\"id\":\"{id}\",\"command\":\"render\",\"output\":\"{id}.png\"}}\n");
        let text: String = (0..20).map(line).collect();
        let list = List::of_bytes(text.into_bytes(), "jobs.jsonl").unwrap();
        let jobs: Vec<Job> = list.jobs(Slice::WHOLE).collect();
        let entry = |place: usize, milliseconds: f64| {
            let mut outcome = Outcome::failed("model", format!("no model {place}"));
            if !place.is_multiple_of(7) {
                (outcome.status, outcome.error) = (Status::Done, None);
                outcome.outputs.push(Written { path: format!("{place}.png"), bytes: 3, sha256: "00".to_owned() });
            }
            outcome.run.milliseconds = milliseconds;
            serde_json::to_string(&Entry::new(&jobs[place], outcome)).unwrap() + "\n"
        };
        let (mut one, mut other) = (Entries::default(), Entries::default());
        (0..19).for_each(|place| one.add(entry(place, 1.0).as_bytes()));
        (0..19).rev().for_each(|place| other.add(entry(place, place as f64).as_bytes()));
        let (one, [rows, times]) = Summary::new(&list, &one);
        let (other, [other_rows, other_times]) = Summary::new(&list, &other);
        assert_eq!(rows, other_rows);
        assert_ne!(times, other_times);
        assert_eq!((rows.lines().count(), times.lines().count()), (20, 19));
        assert_eq!((one.done, one.failed, one.missing, one.outdated), (16, 3, 1, 0));
        assert_eq!(one.failures[1], Named { line: 8, id: "7".to_owned(), problem: "no model 7".to_owned() });
        assert_eq!(one.missing_jobs[0].id, "19");
        assert_eq!(other.commands[0].milliseconds, [171.0, 9.0, 18.0]);
        assert!(!one.is_all_done());
    }
}
