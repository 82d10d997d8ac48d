//! What the program says: results to standard output, talk to standard error, or both to whoever asked for a job to be done.

use std::io::Write;
use std::sync::{Mutex, PoisonError};
use tinta::{Error, Result};

/// What was said and printed while somebody listened.
#[derive(Default)]
pub struct Heard {
    /// Sentences for the person.
    pub said: Vec<String>,
    /// Results.
    pub printed: String,
}

/// Of the process: a job may speak from more than one thread.
static HEARD: Mutex<Option<Heard>> = Mutex::new(None);

/// Keeps what is said from now on instead of saying it.
pub fn listen() {
    *HEARD.lock().unwrap_or_else(PoisonError::into_inner) = Some(Heard::default());
}

/// Ends that, and hands over what was heard.
pub fn heard() -> Heard {
    HEARD.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or_default()
}

/// Whether somebody listens.
pub fn is_heard() -> bool {
    HEARD.lock().unwrap_or_else(PoisonError::into_inner).is_some()
}

/// Says a line to the person, on standard error; nobody listening is no error.
pub fn say(line: &str) {
    let line = plain(line);
    match HEARD.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        Some(heard) => heard.said.push(line.strip_prefix("tinta: ").map(str::to_owned).unwrap_or(line)),
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

/// Writes text to standard output; a reader that has heard enough (`| head`) is no error.
pub fn print(text: &str) -> Result<()> {
    if let Some(heard) = HEARD.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        heard.printed.push_str(text);
        return Ok(());
    }
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::Output {
            path: "-".to_owned(),
            problem: format!("standard output cannot be written ({error}); check where it goes"),
        }),
        _ => Ok(()),
    }
}
