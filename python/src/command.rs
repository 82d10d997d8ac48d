//! The program `tinta`, which the wheel brings along: every command but `tinta view`.

use pyo3::prelude::*;
use std::ffi::OsString;
use std::io::Write;

/// Carries out a command line, whose first word names the program; returns the exit code.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| {
        let code = tinta::cli::exit_code(&tinta_lab::program(), words);
        // Only a program of Rust's own writes the rest at its end. A closed pipe has been reported before.
        drop(std::io::stdout().flush());
        code
    })
}
