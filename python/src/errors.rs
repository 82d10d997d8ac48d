//! The library's errors as Python's: the same sentence as on the command line, with names as Python writes them.

use pyo3::PyErr;
use pyo3::exceptions::{PyFileNotFoundError, PyKeyboardInterrupt, PyOSError, PyRuntimeError, PyValueError};
use tinta::settings::{HasSettings, Kind, with_mentions};
use tinta::{Error, FileKind, Request};

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

/// A sentence of the command line as Python says it: `--page A4` is `page="A4"`, except at the beginning, where it names the setting
/// and the value that are wrong; style lines is the function.
pub(crate) fn in_python(sentence: &str) -> String {
    let text = with_mentions(sentence, |before, name, rest| {
        let value = rest.strip_prefix(' ').and_then(|rest| rest.split([' ', ',', ';', ':', ')']).next());
        let value = value.filter(|_| !before.is_empty());
        match value.and_then(|value| Some((value, python_value(name, value)?))) {
            _ if name.is_empty() => None,
            Some((value, written)) => Some(format!("{}={written}{}", python_name(name), &rest[1 + value.len()..])),
            None => Some(python_name(name) + rest),
        }
    });
    text.replace("style lines", "lines()")
}

/// How Python writes the value of an option; `None` for a word that is no value of it.
fn python_value(name: &str, word: &str) -> Option<String> {
    let setting = Request::table().of(None).into_iter().find(|setting| setting.name == name)?;
    match &setting.kind {
        Kind::Switch | Kind::Flag => {
            [("on", "True"), ("off", "False")].iter().find(|(text, _)| *text == word).map(|(_, of)| (*of).to_owned())
        }
        _ if word.parse::<f64>().is_ok() => Some(word.to_owned()),
        kind => kind.offered().contains(&word).then(|| format!("\"{word}\"")),
    }
}
