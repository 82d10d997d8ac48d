//! What came of a whole list, put together from what its slices wrote down.
//!
//! `batch-summary.jsonl` has a line for every job in the list's order and nothing in it that differs from run to run, so that
//! the slices of many machines merge into the bytes that one machine would have given. What differs, times, drivers and
//! whatever holds a time, stands in `batch-times.jsonl`, also a line a job.

use super::entry::{Entry, Failure, Run, Status, Written};
use super::job::{Job, JobCommand};
use super::journal::Entries;
use super::list::{LIST_FILE, List};
use crate::error::{Error, Result};
use crate::output::Staged;
use crate::renderer::median;
use serde::Serialize;
use std::path::Path;

/// What is the same every time, a line a job.
pub const SUMMARY_FILE: &str = "batch-summary.jsonl";

/// What is different every time, a line a job.
pub const TIMES_FILE: &str = "batch-times.jsonl";

/// What came of a batch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Jobs in the list.
    pub jobs: usize,
    /// Of these, how many are done.
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
    #[serde(skip)]
    rows: String,
    #[serde(skip)]
    times: String,
}

/// A command's jobs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CommandSummary {
    /// Which.
    pub command: JobCommand,
    /// How many are done.
    pub done: usize,
    /// How many failed.
    pub failed: usize,
    /// How many have not ended yet.
    pub missing: usize,
    /// Milliseconds of those that ended: all of them together, the median, the longest.
    pub milliseconds: [f64; 3],
}

/// A job that something is to be said of.
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

/// A file; with how long it is and what is in it, unless times are in it.
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
    /// Reads a batch's folder, even while runs are at work in it.
    ///
    /// # Errors
    ///
    /// [`Error::Batch`] where there is no batch, or what there is cannot be read.
    pub fn of_folder(folder: &Path) -> Result<Self> {
        let list = List::kept(folder)?.ok_or_else(|| Error::Batch {
            path: folder.join(LIST_FILE).display().to_string(),
            line: None,
            problem: "there is no such file; name the folder of a batch".to_owned(),
        })?;
        Ok(Self::new(&list, &Entries::read(folder)?))
    }

    /// Of a list and what was written down.
    pub fn new(list: &List, entries: &Entries) -> Self {
        let mut summary = Self {
            jobs: list.jobs.len(),
            done: 0,
            failed: 0,
            missing: 0,
            outdated: entries.outdated(list),
            damaged: entries.damaged,
            commands: Vec::new(),
            failures: Vec::new(),
            missing_jobs: Vec::new(),
            rows: String::new(),
            times: String::new(),
        };
        for (_, command) in JobCommand::ALL {
            let jobs: Vec<Option<&Entry>> =
                list.jobs.iter().filter(|job| job.command == command).map(|job| entries.of(job)).collect();
            if !jobs.is_empty() {
                summary.commands.push(CommandSummary::of(command, &jobs));
            }
        }
        let count = |of: fn(&CommandSummary) -> usize| summary.commands.iter().map(of).sum();
        (summary.done, summary.failed, summary.missing) =
            (count(|of| of.done), count(|of| of.failed), count(|of| of.missing));
        for job in &list.jobs {
            summary.add(job, entries.of(job));
        }
        summary
    }

    fn add(&mut self, job: &Job, entry: Option<&Entry>) {
        let problem = entry.and_then(|entry| entry.outcome.error.as_ref()).map(|error| error.problem.clone());
        let named = |problem| Named { line: job.line, id: job.id.clone(), problem };
        match entry.map(|entry| entry.outcome.status) {
            None => self.missing_jobs.push(named(String::new())),
            Some(Status::Failed) => self.failures.push(named(problem.unwrap_or_default())),
            Some(Status::Done) => {}
        }
        let outcome = entry.map(|entry| &entry.outcome);
        let outputs = outcome.map_or(&[][..], |outcome| &outcome.outputs);
        let remarks = outcome.map_or(&[][..], |outcome| &outcome.remarks);
        // A measurement says at first how long it will take.
        let (same, differ) = if job.command == JobCommand::Measure { (&[][..], remarks) } else { (remarks, &[][..]) };
        push_line(
            &mut self.rows,
            &Row {
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
            },
        );
        if let Some(outcome) = outcome {
            let outputs = outputs.iter().filter(|file| holds_times(job.command, &file.path)).collect();
            push_line(
                &mut self.times,
                &TimesRow { line: job.line, id: &job.id, run: &outcome.run, remarks: differ, outputs },
            );
        }
    }

    /// Writes both files into the batch's folder, both or none.
    ///
    /// # Errors
    ///
    /// [`Error::Output`] when they cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let summary = Staged::new(&folder.join(SUMMARY_FILE), self.rows.as_bytes())?;
        let times = Staged::new(&folder.join(TIMES_FILE), self.times.as_bytes())?;
        summary.put_in_place()?;
        times.put_in_place()
    }

    /// Whether every job is done.
    pub fn is_all_done(&self) -> bool {
        self.done == self.jobs
    }
}

impl CommandSummary {
    fn of(command: JobCommand, jobs: &[Option<&Entry>]) -> Self {
        let ended = || jobs.iter().flatten().map(|entry| &entry.outcome);
        let done = ended().filter(|outcome| outcome.status == Status::Done).count();
        let times: Vec<f64> = ended().map(|outcome| outcome.run.milliseconds).collect();
        let (sum, longest) = times.iter().fold((0.0, 0.0), |(sum, most), time: &f64| (sum + time, time.max(most)));
        Self {
            command,
            done,
            failed: times.len() - done,
            missing: jobs.len() - times.len(),
            milliseconds: [sum, median(times).unwrap_or_default(), longest],
        }
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

fn push_line(text: &mut String, row: &impl Serialize) {
    // Of text and finite numbers, which JSON has.
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
        let entry = |place: usize, milliseconds: f64| {
            let mut outcome = Outcome::failed("model", format!("no model {place}"));
            if !place.is_multiple_of(7) {
                (outcome.status, outcome.error) = (Status::Done, None);
                outcome.outputs.push(Written { path: format!("{place}.png"), bytes: 3, sha256: "00".to_owned() });
            }
            outcome.run.milliseconds = milliseconds;
            serde_json::to_string(&Entry::new(&list.jobs[place], outcome)).unwrap() + "\n"
        };
        let (mut one, mut other) = (Entries::default(), Entries::default());
        (0..19).for_each(|place| one.add(entry(place, 1.0).as_bytes()));
        (0..19).rev().for_each(|place| other.add(entry(place, place as f64).as_bytes()));
        let (one, other) = (Summary::new(&list, &one), Summary::new(&list, &other));
        assert_eq!(one.rows, other.rows);
        assert_ne!(one.times, other.times);
        assert_eq!((one.done, one.failed, one.missing, one.rows.lines().count()), (16, 3, 1, 20));
        assert_eq!(one.failures[1], Named { line: 8, id: "7".to_owned(), problem: "no model 7".to_owned() });
        assert_eq!(one.missing_jobs[0].id, "19");
        assert_eq!(other.commands[0].milliseconds, [171.0, 9.0, 18.0]);
        assert!(!one.is_all_done());
    }
}
