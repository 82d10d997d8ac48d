//! Standard input, which `-` names where a model or a list of jobs is read: all of it, as much as a file may hold.

use crate::files;
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};
use tinta::error::FileKind;
use tinta::limits::{BATCH_BYTES, MODEL_BYTES};
use tinta::{Error, Result};

/// How a command line names it.
pub(super) const DASH: &str = "-";

/// Its name in messages.
pub(super) const NAME: &str = "standard input";

/// A model's bytes, kept for a second reading of the model: its other frames, a recipe.
static MODEL: Mutex<Option<Arc<Vec<u8>>>> = Mutex::new(None);

/// The bytes of the model on standard input.
///
/// # Errors
///
/// [`Error::File`] for empty input, or too much.
pub(super) fn model() -> Result<Arc<Vec<u8>>> {
    let mut kept = MODEL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = &*kept {
        return Ok(bytes.clone());
    }
    let bytes = Arc::new(read(FileKind::Model, MODEL_BYTES, "a model file")?);
    Ok(kept.insert(bytes).clone())
}

/// The bytes of the list on standard input.
///
/// # Errors
///
/// As [`model`].
pub(super) fn list() -> Result<Vec<u8>> {
    read(FileKind::Batch, BATCH_BYTES, "a list of jobs")
}

/// All that comes; `what` names such a file.
fn read(kind: FileKind, limit: u64, what: &str) -> Result<Vec<u8>> {
    let refuse = |problem: String| Err(Error::file(kind, NAME, problem));
    let input = std::io::stdin().lock();
    if input.is_terminal() {
        return refuse(format!("it is the keyboard; pipe {what} into it, or name one instead of {DASH}"));
    }
    let bytes = files::read_from(input, 0, limit).map_err(|failure| failure.into_error(kind, NAME, what))?;
    match bytes.is_empty() {
        true => refuse(format!("nothing came; pipe {what} into it, or see what the command before the pipe says")),
        false => Ok(bytes),
    }
}
