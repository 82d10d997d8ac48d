//! The names of jobs' options, checked before the first job: a misspelt one would fail every job that has it.

use super::JobOptions;
use crate::cli::Program;
use std::collections::HashSet;
use tinta::batch::{List, Slice};
use tinta::choice::Choice;
use tinta::error::FileKind;
use tinta::{Error, Result};

/// The most faults that a message names.
const MOST: usize = 8;

/// Refuses a list with options that their commands do not have.
pub(super) fn check(list: &List, name: &str, program: &Program) -> Result<()> {
    let (mut checked, mut faults) = (HashSet::new(), Vec::new());
    for job in list.jobs(Slice::WHOLE) {
        // Most jobs of a list have the same options.
        let names: Vec<String> = job.options.keys().cloned().collect();
        let command = program.named(job.command.choice_name()).filter(|command| checked.insert((command.name, names)));
        if let Some(Err(error)) =
            command.map(|command| JobOptions::refuse_unknown(&job.options, command.name, command.has_in_jobs))
        {
            faults.push(format!("line {}: {error}", job.line));
        }
    }
    faults.truncate(MOST);
    match faults.is_empty() {
        true => Ok(()),
        false => Err(Error::file(FileKind::Batch, name, faults.join("; "))),
    }
}
