//! Sentences as Python's warnings.

use crate::errors::in_python;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// Warns of remarks, at the line outside of this package that called it.
pub(crate) fn warn(py: Python<'_>, remarks: &[String]) -> PyResult<()> {
    if remarks.is_empty() {
        return Ok(());
    }
    let (category, level) = (py.get_type::<PyUserWarning>(), level(py)?);
    for remark in remarks {
        // No sentence of tinta contains a zero.
        let Ok(text) = CString::new(in_python(remark)) else { continue };
        PyErr::warn(py, &category, &text, level)?;
    }
    Ok(())
}

/// Warns of a sentence of the package's Python code.
#[pyfunction(name = "warn")]
pub(crate) fn warn_of(py: Python<'_>, sentence: String) -> PyResult<()> {
    warn(py, &[sentence])
}

/// How many calls above the compiled part the first line outside of the package is.
fn level(py: Python<'_>) -> PyResult<i32> {
    let mut frame = py.import("sys")?.call_method0("_getframe")?;
    let mut level = 1;
    while !frame.is_none() {
        let module = frame.getattr("f_globals")?.call_method1("get", ("__name__", ""))?.to_string();
        if module != "tinta_npr" && !module.starts_with("tinta_npr.") {
            break;
        }
        frame = frame.getattr("f_back")?;
        level += 1;
    }
    Ok(level)
}
