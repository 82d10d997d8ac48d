//! The summary of a whole list, from the journals of its slices.
//!
//! `batch-summary.jsonl` has a line for every job in the list's order, and only facts that are the same in every run: the slices
//! of many machines merge into the bytes of a single machine's run. Times, drivers and everything that contains a time go to
//! `batch-times.jsonl`, also one line per job.

use super::entry::{Failure, Outcome, Run, Status, Written};
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
pub const SUMMARY_FILE: &str = "batch-summary.jsonl";

/// The facts that differ every time, one line per job.
pub const TIMES_FILE: &str = "batch-times.jsonl";

/// Bytes written at once.
const WRITTEN_BYTES: usize = 1 << 20;

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
        let list = List::kept(folder)?.ok_or_else(|| {
            Error::file(FileKind::Batch, folder.join(LIST_FILE), "there is no such file; name the folder of a batch")
        })?;
        let entries = Entries::read(folder)?;
        let mut files = [Staged::begin(&folder.join(SUMMARY_FILE))?, Staged::begin(&folder.join(TIMES_FILE))?];
        let mut texts = [String::new(), String::new()];
        let summary = Self::new(&list, &entries, |lines| {
            for ((text, line), file) in texts.iter_mut().zip(lines).zip(&mut files) {
                text.push_str(&line);
                if text.len() >= WRITTEN_BYTES {
                    file.add(text.as_bytes())?;
                    text.clear();
                }
            }
            Ok(())
        })?;
        for (file, text) in files.iter_mut().zip(&texts) {
            file.add(text.as_bytes())?;
            file.settle()?;
        }
        files.into_iter().try_for_each(Staged::put_in_place)?;
        Ok(summary)
    }

    /// Combines a list with the journal's entries. `take` receives each job's line of the summary and of the times; the latter is
    /// empty for an unfinished job.
    ///
    /// # Errors
    ///
    /// Those of `take`.
    pub fn new(list: &List, entries: &Entries, mut take: impl FnMut([String; 2]) -> Result<()>) -> Result<Self> {
        let mut summary = Self {
            jobs: list.count,
            done: 0,
            failed: 0,
            missing: 0,
            outdated: 0,
            damaged: entries.damaged,
            commands: Vec::new(),
            failures: Vec::new(),
            missing_jobs: Vec::new(),
        };
        let mut commands = JobCommand::ALL.map(|(_, command)| Tally { command, ..Tally::default() });
        let mut current = 0;
        for job in list.jobs(Slice::WHOLE) {
            let outcome = entries.of(&job).map(|entry| entry.outcome);
            current += entries.count_of(&job);
            if let Some(tally) = commands.iter_mut().find(|tally| tally.command == job.command) {
                tally.add(outcome.as_ref());
            }
            take(lines(&job, outcome.as_ref()))?;
            summary.name(job, outcome);
        }
        summary.outdated = entries.count() - current;
        summary.commands = commands.into_iter().filter_map(Tally::sum).collect();
        let count = |of: fn(&CommandSummary) -> usize| summary.commands.iter().map(of).sum();
        (summary.done, summary.failed, summary.missing) =
            (count(|of| of.done), count(|of| of.failed), count(|of| of.missing));
        Ok(summary)
    }

    /// Keeps the name of a job that is not done.
    fn name(&mut self, job: Job, outcome: Option<Outcome>) {
        let named = |problem| Named { line: job.line, id: job.id, problem };
        match outcome {
            None => self.missing_jobs.push(named(String::new())),
            Some(Outcome { status: Status::Failed, error, .. }) => {
                self.failures.push(named(error.map_or_else(String::new, |error| error.problem)));
            }
            Some(_) => {}
        }
    }

    /// Whether every job is done.
    pub(crate) fn is_all_done(&self) -> bool {
        self.done == self.jobs
    }
}

/// A command's jobs while they are counted.
#[derive(Debug)]
struct Tally {
    command: JobCommand,
    jobs: usize,
    done: usize,
    milliseconds: Vec<f64>,
}

impl Default for Tally {
    fn default() -> Self {
        Self { command: JobCommand::Render, jobs: 0, done: 0, milliseconds: Vec::new() }
    }
}

impl Tally {
    fn add(&mut self, outcome: Option<&Outcome>) {
        self.jobs += 1;
        if let Some(outcome) = outcome {
            self.done += usize::from(outcome.status == Status::Done);
            self.milliseconds.push(outcome.run.milliseconds);
        }
    }

    /// `None` for a command that no job is.
    fn sum(self) -> Option<CommandSummary> {
        let Self { command, jobs, done, milliseconds: times } = self;
        let (sum, longest) = times.iter().fold((0.0, 0.0), |(sum, most), time: &f64| (sum + time, time.max(most)));
        (jobs > 0).then(|| CommandSummary {
            command,
            done,
            failed: times.len() - done,
            missing: jobs - times.len(),
            milliseconds: [sum, median(times).unwrap_or_default(), longest],
        })
    }
}

/// A job's lines of the summary and of the times.
fn lines(job: &Job, outcome: Option<&Outcome>) -> [String; 2] {
    let outputs = outcome.map_or(&[][..], |outcome| &outcome.outputs);
    let remarks = outcome.map_or(&[][..], |outcome| &outcome.remarks);
    // A measurement first prints its expected time.
    let (same, differ) = if job.command == JobCommand::Measure { (&[][..], remarks) } else { (remarks, &[][..]) };
    let row = Row {
        line: job.line,
        id: &job.id,
        job: &job.sha256,
        command: job.command,
        status: match outcome.map(|outcome| outcome.status) {
            None => "missing",
            Some(Status::Done) => "done",
            Some(Status::Failed) => "failed",
        },
        error: outcome.and_then(|outcome| outcome.error.as_ref()),
        remarks: same,
        outputs: outputs
            .iter()
            .map(|file| {
                let is_same = !holds_times(job.command, &file.path);
                Output {
                    path: &file.path,
                    bytes: is_same.then_some(file.bytes),
                    sha256: is_same.then_some(file.sha256.as_str()),
                }
            })
            .collect(),
    };
    let times = outcome.map_or_else(String::new, |outcome| {
        let outputs = outputs.iter().filter(|file| holds_times(job.command, &file.path)).collect();
        line_of(&TimesRow { line: job.line, id: &job.id, run: &outcome.run, remarks: differ, outputs })
    });
    [line_of(&row), times]
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

fn line_of(row: &impl Serialize) -> String {
    // Only text and finite numbers, which JSON can represent.
    let mut text = serde_json::to_string(row).unwrap_or_default();
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::super::entry::Entry;
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
        (0..19).for_each(|place| one.add(entry(place, 1.0).into_bytes()));
        (0..19).rev().for_each(|place| other.add(entry(place, place as f64).into_bytes()));
        let summary = |entries: &Entries| {
            let mut texts = [String::new(), String::new()];
            let summary = Summary::new(&list, entries, |lines| {
                texts.iter_mut().zip(lines).for_each(|(text, line)| text.push_str(&line));
                Ok(())
            });
            (summary.unwrap(), texts)
        };
        let ((one, [rows, times]), (other, [other_rows, other_times])) = (summary(&one), summary(&other));
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
