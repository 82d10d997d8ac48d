//! The commands, one file each. clap is known here and below, and nowhere else.
//!
//! ```
//! let line = |words: &str| tinta::cli::check(words.split(' ').map(Into::into));
//! assert_eq!(line("tinta render builtin:bust -o bust.png"), Ok(None));
//! assert!(line("tinta render builtin:bust").unwrap_err().contains("--output"));
//! ```

mod again;
mod bare;
mod batch;
mod camera_file;
mod compare;
mod completions;
#[cfg(test)]
mod documents;
mod edges;
#[cfg(feature = "measuring")]
mod figures;
mod help;
mod info;
mod inputs;
#[cfg(feature = "judging")]
mod judge;
mod looks;
mod man;
#[cfg(feature = "measuring")]
mod measure;
mod messages;
mod mistakes;
mod models;
mod options;
mod progress;
mod provenance;
mod render;
mod signals;
mod standard_input;
mod standard_output;
#[cfg(feature = "measuring")]
mod stress;
mod textures;
#[cfg(feature = "window")]
mod view;

use clap::error::ErrorKind;
use clap::{FromArgMatches, Parser, Subcommand};
use messages::print;
pub(crate) use messages::{plain, say};
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use tinta::{Error, Result};

/// Draw 3D models as cartoons, ink, charcoal and line art
#[derive(Parser)]
#[command(name = "tinta", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  tinta cow.obj                                   show a model, or draw it
  tinta render cow.obj -o cow.png                 draw it into this file
  tinta render builtin:bust -o bust.png           draw a built-in model
  tinta render cow.obj -o cow.png --style ink     choose a style
  tinta render cow.obj -o cow.svg                 write the exact visible lines
  tinta render cow.obj -o cow.gif --turntable 60  turn the model once around
  tinta render cow.obj -o cow.png --preset a.toml read options from a file
  tinta view cow.obj                              turn it, try styles
  tinta looks cow.obj -o looks                    draw it in every look
  tinta again cow.png -o again.png                redraw it by its recipe
  tinta compare builtin:gear -o both.png          compare lines of two styles
  tinta edges cow.obj                             count edges by class
  tinta measure cow.obj -o cow --quick            measure error and run time
  tinta judge cow.png --model cow.obj             judge any program's drawing
  tinta textures -o textures                      write charcoal's textures
  tinta figures -o figures                        redraw the texts' figures
  tinta stress -o stress                          test with extreme cases
  tinta batch jobs.jsonl -o pictures              run many jobs from a list
  tinta provenance three-pass                     which values a text prints
  tinta info                                      list the OpenGL backends
  tinta completions bash                          or zsh, fish
  tinta man -o man                                write the manual pages

Exit codes:
  0  done
  1  a check found a difference, or a job of a batch failed
  2  not done; one sentence on standard error says why")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Render(Box<render::Arguments>),
    #[cfg(feature = "window")]
    View(Box<view::Arguments>),
    Looks(looks::Arguments),
    Again(again::Arguments),
    Compare(Box<compare::Arguments>),
    Edges(Box<edges::Arguments>),
    #[cfg(feature = "measuring")]
    Measure(Box<measure::Arguments>),
    #[cfg(feature = "judging")]
    Judge(Box<judge::Arguments>),
    Textures(textures::Arguments),
    #[cfg(feature = "measuring")]
    Figures(figures::Arguments),
    #[cfg(feature = "measuring")]
    Stress(stress::Arguments),
    Batch(batch::Arguments),
    Provenance(provenance::Arguments),
    Info(info::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// How something that was done came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
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

/// Parses the command line, does what it says, prints the error and chooses the exit code.
pub fn main() -> ExitCode {
    outlive_the_limit_on_files();
    match run() {
        Ok(Verdict::Good) => ExitCode::SUCCESS,
        Ok(Verdict::Different) => ExitCode::FAILURE,
        // As a shell says it of a program that a signal has ended.
        Ok(Verdict::Stopped { signal }) => ExitCode::from(128 + signal),
        Err(error) => {
            say(&format!("tinta: {}", error.with_dashes()));
            // EX_TEMPFAIL of sysexits.h: the same will go later.
            ExitCode::from(if matches!(error, Error::Busy { .. }) { 75 } else { 2 })
        }
    }
}

/// Lets a write beyond the limit on files' sizes (`ulimit -f`) fail like any other, whoever writes, the GL driver too: by
/// default it ends the program by a signal. A handler that does nothing is the safe way to ignore it.
fn outlive_the_limit_on_files() {
    // Where it cannot be had the program is as it would be without.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

fn run() -> Result<Verdict> {
    let started = Instant::now();
    let (words, picture) = bare::with_command(std::env::args_os().collect(), bare::has_window());
    let as_given: Vec<String> = words.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let arguments = match parse(words) {
        Ok(parsed) => parsed,
        Err(Stop::Help(help)) => return messages::print_help(&help).map(|()| Verdict::Good),
        Err(Stop::Wrong(error)) => return Err(error),
    };
    let as_given = tinta::shell::command_line(as_given.into_iter());
    let verdict = carry_out(arguments.command, &as_given, started)?;
    picture.map_or(Ok(()), |picture| print(&bare::said(&picture))).map(|()| verdict)
}

/// Carries a command out; `as_given` is its command line, and `started` when the program did.
fn carry_out(command: Command, as_given: &str, started: Instant) -> Result<Verdict> {
    let _ = (as_given, started);
    let mut session = models::session();
    match command {
        #[cfg(feature = "window")]
        Command::View(arguments) => view::run(&arguments, started),
        Command::Render(arguments) => return render::run(&arguments, &mut session),
        Command::Looks(arguments) => looks::run(&arguments),
        Command::Again(arguments) => return again::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments, &mut session),
        Command::Edges(arguments) => edges::run(&arguments),
        #[cfg(feature = "measuring")]
        Command::Measure(arguments) => measure::run(&arguments, as_given, &mut session),
        #[cfg(feature = "judging")]
        Command::Judge(arguments) => return judge::run(&arguments, as_given),
        Command::Textures(arguments) => textures::run(&arguments),
        #[cfg(feature = "measuring")]
        Command::Figures(arguments) => figures::run(&arguments),
        #[cfg(feature = "measuring")]
        Command::Stress(arguments) => return stress::run(&arguments),
        Command::Batch(arguments) => return batch::run(&arguments),
        Command::Provenance(arguments) => provenance::run(&arguments),
        Command::Info(arguments) => return info::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
    }
    .map(|()| Verdict::Good)
}

/// Why a command line is not carried out.
#[derive(Debug)]
pub(crate) enum Stop {
    /// Help or the version was asked for: this is it.
    Help(clap::Error),
    /// It is wrong.
    Wrong(Error),
}

/// Parses a command line, the program's name first, and does nothing with it: help's text where it asks for that, or one
/// sentence of what is wrong.
///
/// # Errors
///
/// That sentence, as the program prints it.
pub fn check(words: impl IntoIterator<Item = OsString>) -> std::result::Result<Option<String>, String> {
    match parse(bare::with_command(words.into_iter().collect(), false).0) {
        Ok(_) => Ok(None),
        Err(Stop::Help(help)) => Ok(Some(help.to_string())),
        Err(Stop::Wrong(error)) => Err(plain(&error.with_dashes().to_string())),
    }
}

/// What the words say, the program's name first.
fn parse(words: impl IntoIterator<Item = OsString>) -> std::result::Result<Arguments, Stop> {
    let words: Vec<OsString> = words.into_iter().collect();
    let mut whole = help::command(&words);
    let parsed = whole.try_get_matches_from_mut(&words).and_then(|matches| Arguments::from_arg_matches(&matches));
    parsed.map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand | ErrorKind::DisplayVersion => {
            Stop::Help(error)
        }
        _ => Stop::Wrong(Error::CommandLine { problem: mistakes::sentence(&error, &whole, &words) }),
    })
}

/// Makes the folder that `-o` names, if it is not there.
fn make_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let problem = if folder.is_file() {
            "this is a file; name a folder".to_owned()
        } else {
            format!("the folder cannot be created ({error}); choose another")
        };
        Error::output(format!("-o {}", folder.display()), problem).because(&error)
    })
}

/// Writes a value as JSON to standard output.
fn print_json(value: &impl serde::Serialize) -> Result<()> {
    print(&json_text(value)?)
}

/// A value as JSON, a line to each of its parts.
fn json_text(value: &impl serde::Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| {
        Error::output("-", format!("the record cannot be written as JSON ({error}); leave out --json and report this"))
    })?;
    Ok(text + "\n")
}
