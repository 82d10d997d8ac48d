//! The program as a list of commands, each a plain value: this package has those that draw, packages above add theirs.

use super::batch::job_options::JobOptions;
use clap::{ArgMatches, FromArgMatches};
use std::time::Instant;
use tinta::request::Session;
use tinta::{Error, Result};

/// How something that was done came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Well.
    Good,
    /// Two pictures that should be equal differ, a case did not end as it must, or a job of a batch failed.
    Different,
    /// A signal ended a batch before its last job.
    Stopped {
        /// Its number.
        signal: u8,
    },
}

/// A command: its name, its options and the function that carries it out.
#[derive(Debug, Clone, Copy)]
pub struct Command {
    /// The word after `tinta`.
    pub name: &'static str,
    /// Adds its arguments and its help to an empty command.
    pub arguments: fn(clap::Command) -> clap::Command,
    /// Carries it out.
    pub run: fn(&ArgMatches, &mut Call<'_>) -> Result<Verdict>,
    /// Its lines among the examples of `tinta --help`. Default empty.
    pub examples: &'static [&'static str],
    /// Checks a job of a batch and makes a task of it. Default `None`: a batch has no such jobs.
    pub job: Option<fn(&JobOptions) -> Result<Task>>,
    /// Whether a job's output tells that the job is done. Default `None`: it does not tell.
    pub told: fn(&JobOptions) -> Option<bool>,
    /// Whether a job of it may have this option.
    pub has_in_jobs: fn(&str) -> bool,
    /// The values that a shell offers for an option. Default empty: those of a drawing's settings are offered.
    pub offers: fn(&str) -> Vec<&'static str>,
}

/// A job that was checked.
pub(crate) type Task = Box<dyn FnOnce(&mut Session) -> Result<Verdict>>;

/// The parts of the run that a command may use.
#[derive(Debug)]
pub struct Call<'a> {
    /// All commands.
    pub program: &'a Program,
    /// The command line, without the program's name.
    pub words: &'a str,
    /// When the program started.
    pub started: Instant,
    /// Contexts and models.
    pub session: &'a mut Session,
}

impl Command {
    /// A command without examples and jobs.
    pub const fn new(
        name: &'static str,
        arguments: fn(clap::Command) -> clap::Command,
        run: fn(&ArgMatches, &mut Call<'_>) -> Result<Verdict>,
    ) -> Self {
        let (examples, job, told) = (&[], None, |_: &JobOptions| None);
        Self { name, arguments, run, examples, job, told, has_in_jobs: |_| false, offers: |_| Vec::new() }
    }
}

/// The arguments that a command line gives.
///
/// # Errors
///
/// [`Error::CommandLine`] for an argument that is missing.
pub fn given<A: FromArgMatches>(matches: &ArgMatches) -> Result<A> {
    A::from_arg_matches(matches).map_err(|error| Error::CommandLine {
        problem: error.to_string().trim_start_matches("error: ").trim_end().to_owned(),
    })
}

/// All commands, and the measure of lines that the window shows.
#[derive(Debug)]
pub struct Program {
    commands: Vec<Command>,
    /// How the window measures the lines of a style. Default `None`: it does not.
    #[cfg(feature = "window")]
    pub(super) line_measure: Option<crate::window::LineMeasure>,
}

/// The command that those of other packages are listed before: they measure drawings, it and those behind it manage.
const FIRST_OF_MANAGING: &str = "batch";

impl Program {
    /// A program of these commands.
    pub(crate) fn of(commands: Vec<Command>) -> Self {
        Self {
            commands,
            #[cfg(feature = "window")]
            line_measure: None,
        }
    }

    /// Adds commands.
    #[must_use]
    pub fn with(mut self, commands: impl IntoIterator<Item = Command>) -> Self {
        let place = self.commands.iter().position(|command| command.name == FIRST_OF_MANAGING);
        let place = place.unwrap_or(self.commands.len());
        self.commands.splice(place..place, commands);
        self
    }

    /// Sets how the window measures lines.
    #[cfg(feature = "window")]
    #[must_use]
    pub fn measuring_lines_by(self, measure: crate::window::LineMeasure) -> Self {
        Self { line_measure: Some(measure), ..self }
    }

    /// The commands, as help lists them.
    pub(crate) fn commands(&self) -> &[Command] {
        &self.commands
    }

    /// The command of this name.
    pub(crate) fn named(&self, name: &str) -> Option<&Command> {
        self.commands.iter().find(|command| command.name == name)
    }
}
