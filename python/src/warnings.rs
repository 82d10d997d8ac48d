//! Sentences as Python's warnings.

use crate::errors::in_python;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// Warns of a drawing's remarks, `level` calls above.
pub(crate) fn warn(py: Python<'_>, remarks: &[String], level: i32) -> PyResult<()> {
    let category = py.get_type::<PyUserWarning>();
    for remark in remarks {
        // No sentence of tinta contains a zero.
        let Ok(text) = CString::new(in_python(remark)) else { continue };
        PyErr::warn(py, &category, &text, level)?;
    }
    Ok(())
}
