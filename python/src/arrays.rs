//! Arrays for Python, each handed over with the memory it was made in.

use numpy::{Element, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// A list as an array of this shape.
pub(crate) fn shaped<'py, T: Element>(py: Python<'py>, values: Vec<T>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyArray1::from_vec(py, values).reshape(shape.to_vec())?.into_any())
}

/// Rows of two numbers.
pub(crate) fn pairs<'py, T: Element + Copy>(py: Python<'py>, rows: &[[T; 2]]) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, rows.as_flattened().to_vec(), &[rows.len(), 2])
}

/// Points of a plane.
pub(crate) fn points<'py>(py: Python<'py>, points: &[tinta::glam::DVec2]) -> PyResult<Bound<'py, PyAny>> {
    let numbers: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    shaped(py, numbers, &[points.len(), 2])
}
