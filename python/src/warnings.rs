//! Sentences as Python's warnings.

use crate::errors::in_python;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// Warns of what is to be known of a drawing, `level` calls above.
pub(crate) fn warn(py: Python<'_>, remarks: &[String], level: i32) -> PyResult<()> {
    let category = py.get_type::<PyUserWarning>();
    for remark in remarks {
        // What has a zero in it is no sentence of ours.
        let Ok(text) = CString::new(in_python(remark)) else { continue };
        PyErr::warn(py, &category, &text, level)?;
    }
    Ok(())
}
