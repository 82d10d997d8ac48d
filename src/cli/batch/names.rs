//! The names of jobs' options, checked before the first job: a misspelt one would fail every job that has it.

use super::JobOptions;
use crate::cli::Program;
use std::collections::HashSet;
use tinta::batch::{List, Slice};
use tinta::error::FileKind;
use tinta::{Error, Result};

/// The most faults that a message names.
const MOST: usize = 8;

/// Refuses a list with options that their commands do not have.
pub(super) fn check(list: &List, name: &str, program: &Program) -> Result<()> {
    let (mut checked, mut faults) = (HashSet::new(), Vec::new());
    for job in list.jobs(Slice::WHOLE) {
        let names: Vec<String> = job.options.keys().cloned().collect();
        // Most jobs of a list have the same options.
        if !checked.insert((job.command.name(), names)) {
            continue;
        }
        let Some(command) = program.named(job.command.name()) else { continue };
        if let Err(error) = JobOptions::refuse_unknown(&job.options, command.name, command.has_in_jobs) {
            faults.push((job.line, error.to_string()));
        }
        if faults.len() == MOST {
            break;
        }
    }
    let Some((first, problem)) = faults.first() else { return Ok(()) };
    let others = faults[1..].iter().map(|(line, problem)| format!("; line {line}, {problem}"));
    let problem = others.fold(problem.clone(), |text, other| text + &other);
    Err(Error::file(FileKind::Batch, name, problem).at(Some(*first)))
}
