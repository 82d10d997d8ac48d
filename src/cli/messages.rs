//! Messages: results to standard output, remarks to standard error, or both captured for the batch worker that does the job.

use super::groups::in_groups;
use super::standard_output;
use std::io::Write;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use tinta::{Error, Result};

/// Messages and output captured.
#[derive(Default)]
pub(super) struct CapturedMessages {
    /// Sentences for the person.
    pub said: Vec<String>,
    /// Results.
    pub printed: String,
}

/// For the whole process: a job may print from several threads.
static CAPTURED: Mutex<Option<CapturedMessages>> = Mutex::new(None);

/// Starts to capture messages.
pub(super) fn capture() {
    *CAPTURED.lock().unwrap_or_else(PoisonError::into_inner) = Some(CapturedMessages::default());
}

/// Ends the capture and returns its contents.
pub(super) fn captured() -> CapturedMessages {
    CAPTURED.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or_default()
}

/// Whether messages are captured.
pub(super) fn is_captured() -> bool {
    CAPTURED.lock().unwrap_or_else(PoisonError::into_inner).is_some()
}

/// Prints a line for the user to standard error; a closed stream is no error.
pub fn say(line: &str) {
    let line = plain(&in_groups(line));
    match CAPTURED.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        Some(captured) => captured.said.push(line.strip_prefix("tinta: ").map(str::to_owned).unwrap_or(line)),
        None => drop(writeln!(std::io::stderr(), "{line}")),
    }
}

/// A line that is one: a file's name may hold anything, and must neither break the line nor turn it around nor command the
/// terminal.
pub fn plain(line: &str) -> String {
    let is_unseen =
        |c: char| matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    line.chars()
        .flat_map(|c| if c.is_control() || is_unseen(c) { c.escape_default().collect() } else { vec![c] })
        .collect()
}

/// Writes text to standard output; a reader that stops early (`| head`) is no error.
pub fn print(text: &str) -> Result<()> {
    if let Some(captured) = CAPTURED.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        captured.printed.push_str(text);
        return Ok(());
    }
    check_output(STANDARD_OUTPUT)?;
    let mut out = std::io::stdout().lock();
    printed(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints the requested help or version; an empty command line is an error and ends the program.
pub(super) fn print_help(help: &clap::Error) -> Result<()> {
    if help.use_stderr() {
        help.exit();
    }
    check_output(STANDARD_OUTPUT)?;
    // clap knows whether the terminal shows colours.
    printed(help.print().and_then(|()| std::io::stdout().flush()))
}

/// How an output names standard output.
const STANDARD_OUTPUT: &str = "-";

/// Refuses standard output that was closed when the program began.
pub fn check_output(output: &str) -> Result<()> {
    match output == STANDARD_OUTPUT && standard_output::was_closed() {
        true => Err(Error::output(STANDARD_OUTPUT, "standard output is closed; name a file, or leave it open")),
        false => Ok(()),
    }
}

fn printed(result: std::io::Result<()>) -> Result<()> {
    match result {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::output(
            STANDARD_OUTPUT,
            format!("standard output cannot be written ({error}); check where it goes"),
        )
        .because(&error)),
        _ => Ok(()),
    }
}

/// Makes the folder that `-o` names, if it is not there.
pub fn make_folder(folder: &Path) -> Result<()> {
    make_folder_of("-o", folder)
}

/// Makes the folder that an option names, if it is not there.
pub(super) fn make_folder_of(option: &str, folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let problem = if folder.is_file() {
            "this is a file; name a folder".to_owned()
        } else {
            format!("the folder cannot be created ({error}); choose another")
        };
        Error::output(format!("{option} {}", folder.display()), problem).because(&error)
    })
}

/// Writes a value as JSON to standard output.
pub fn print_json(value: &impl serde::Serialize) -> Result<()> {
    print(&json_text(value)?)
}

/// A value as JSON, a line to each of its parts.
pub fn json_text(value: &impl serde::Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| {
        Error::output("-", format!("the record cannot be written as JSON ({error}); leave out --json and report this"))
    })?;
    Ok(text + "\n")
}
