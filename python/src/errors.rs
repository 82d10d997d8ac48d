//! The library's errors as Python's: the same sentence as on the command line, with names as Python writes them.

use pyo3::PyErr;
use pyo3::exceptions::{PyFileNotFoundError, PyKeyboardInterrupt, PyOSError, PyRuntimeError, PyValueError};
use tinta::{Error, FileKind};

/// Returns the Python exception for an error.
pub(crate) fn raised(error: Error) -> PyErr {
    let sentence = in_python(&error.with_dashes());
    match error {
        Error::Cancelled => PyKeyboardInterrupt::new_err(sentence),
        Error::File { .. } if error.is_missing_file() => PyFileNotFoundError::new_err(sentence),
        Error::File { kind: FileKind::Output, .. } => PyOSError::new_err(sentence),
        Error::NoContext { .. } | Error::Gl { .. } | Error::ContextLost { .. } | Error::Shader { .. } => {
            PyRuntimeError::new_err(sentence)
        }
        Error::Lines { .. } | Error::Plan { .. } => PyRuntimeError::new_err(sentence),
        _ => PyValueError::new_err(sentence),
    }
}

/// Returns the Python exception for a wrong argument.
pub(crate) fn wrong(argument: &str, problem: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(format!("{argument}: {problem}"))
}

/// A name as Python writes it: `line_width`.
pub(crate) fn python_name(name: &str) -> String {
    name.replace('-', "_")
}

/// A sentence of the command line with its options as Python names them.
pub(crate) fn in_python(sentence: &str) -> String {
    let mut parts = sentence.split("--");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let is_of_name = |c: char| c.is_ascii_lowercase() || c == '-';
        let end = part.find(|c| !is_of_name(c)).unwrap_or(part.len());
        let (name, rest) = part.split_at(end);
        match name.is_empty() {
            true => text.push_str("--"),
            false => text.push_str(&python_name(name)),
        }
        text.push_str(rest);
    }
    text
}
