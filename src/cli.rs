//! The commands, one file each, and the program that they make. clap is known here and above, and nowhere below.
//!
//! ```
//! let program = tinta::cli::Program::default();
//! let line = |words: &str| program.check(words.split(' ').map(Into::into));
//! assert_eq!(line("tinta render builtin:bust -o bust.png"), Ok(None));
//! assert!(line("tinta render builtin:bust").unwrap_err().contains("--output"));
//! ```

mod again;
mod bare;
pub mod batch;
pub mod camera_file;
mod command;
pub mod completions;
mod generate;
mod groups;
mod help;
mod info;
pub mod inputs;
mod looks;
mod man;
pub mod messages;
mod mistakes;
pub mod models;
pub mod options;
mod page;
pub mod progress;
mod program;
pub mod render;
mod run_settings;
mod selection;
mod signals;
mod standard_input;
mod standard_output;
#[cfg(feature = "window")]
mod view;

pub(crate) use command::Task;
pub use command::{Call, Command, Program, Verdict, given};
pub use messages::{json_text, make_folder, plain, print, print_json, say};
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;
use tinta::{Error, Result};

/// The commands of this package, as help lists them.
const COMMANDS: &[Command] = &[
    looks::COMMAND,
    #[cfg(feature = "window")]
    view::COMMAND,
    page::COMMAND,
    again::COMMAND,
    batch::COMMAND,
    info::COMMAND,
    generate::COMMAND,
];

impl Default for Program {
    fn default() -> Self {
        Self::of(COMMANDS.to_vec())
    }
}

/// Carries out the command line of the process, prints the error and chooses the exit code.
pub fn main(program: &Program) -> ExitCode {
    ExitCode::from(exit_code(program, std::env::args_os().collect()))
}

/// Carries out a command line whose first word names the program, prints the error and returns the exit code.
pub fn exit_code(program: &Program, words: Vec<OsString>) -> u8 {
    outlive_the_limit_on_files();
    match run(program, words) {
        Ok(Verdict::Good) => 0,
        Ok(Verdict::Different) => 1,
        // As a shell reports a program ended by a signal.
        Ok(Verdict::Stopped { signal }) => 128 + signal,
        Err(error) => {
            say(&format!("tinta: {}", error.with_dashes()));
            // EX_TEMPFAIL of sysexits.h: the same will go later.
            if matches!(error, Error::Busy { .. }) { 75 } else { 2 }
        }
    }
}

/// Makes a write beyond the limit on file sizes (`ulimit -f`) fail like any other write, in the GL driver too. By default the
/// limit ends the program by a signal. A handler that does nothing is the safe way to ignore that signal.
fn outlive_the_limit_on_files() {
    // If registration fails, the default action remains.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

fn run(program: &Program, words: Vec<OsString>) -> Result<Verdict> {
    let started = Instant::now();
    let (words, picture) = bare::with_command(words, bare::has_window());
    let verdict = program.carry_out(words, started)?;
    picture.map_or(Ok(()), |picture| print(&bare::said(&picture))).map(|()| verdict)
}
