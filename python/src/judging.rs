//! Styles judged: error against run time, and two styles' lines laid over each other.

use crate::errors::{raised, wrong};
use crate::mesh::{Mesh, drawable};
use crate::picture::{named, words};
use crate::request::{Basis, FunctionRequest};
use crate::settings::options;
use crate::studio::drawn;
use crate::work::done;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use tinta::pixel::LineTolerance;
use tinta::plan::Submission;
use tinta::settings::{OptionValue, Options};
use tinta::{Backend, Error, ParseError, Result, Show, Style, StyleName};
use tinta_lab::compare::{Agreement, InkMask};
use tinta_lab::measure::{MeasureSettings, MeasuredStyle, Subject};

/// The tolerance that is this share of a picture's height.
fn share(tolerance: f64) -> PyResult<LineTolerance> {
    let parsed = tolerance.to_string().parse();
    parsed.map_err(|ParseError(problem)| raised(Error::value("tolerance", tolerance, problem)))
}

/// Measures settings on meshes together: a row each. Every item of `asked` is a style with its settings.
#[pyfunction]
#[pyo3(signature = (meshes, asked, given, frames, tolerance, backend=None))]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    meshes: Vec<Py<Mesh>>,
    asked: Vec<Bound<'py, PyDict>>,
    given: &Bound<'py, PyDict>,
    frames: usize,
    tolerance: f64,
    backend: Option<&str>,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let backend: Backend = named("backend", backend)?;
    let how = MeasureSettings { tolerance: share(tolerance)?, frames, ..MeasureSettings::default() };
    how.check().map_err(raised)?;
    let settings: Vec<MeasuredStyle> = match asked.is_empty() {
        true => {
            let of_passes = StyleName::lines_first().into_iter().filter(|style| !style.draws_lines());
            of_passes.map(|name| of_style(Style::named(name))).collect::<PyResult<_>>()?
        }
        false => asked.iter().map(setting).collect::<PyResult<_>>()?,
    };
    let asked =
        FunctionRequest::new("measure", &meshes, given, &Basis { style: Some("three-pass"), ..Basis::default() })?;
    let scene = drawable(py, meshes, &asked.request)?.scene;
    let subject = done(py, || (), move || Subject::new(&asked.request.title(), scene, 0.0))?;
    let rows = drawn(py, backend, move |renderer| {
        let (measured, left_out) = tinta_lab::measure::measure(renderer, &subject, &settings, &how, |_| ())?;
        match left_out.is_empty() {
            true => Ok(measured),
            false => Err(Error::setting("settings", left_out.join("; "))),
        }
    })?;
    rows.iter().map(|measured| dictionary(py, tinta_lab::report::record(&measured.row))).collect()
}

/// A style with its settings, of a dictionary with its name under `style`.
fn setting(asked: &Bound<'_, PyDict>) -> PyResult<MeasuredStyle> {
    let others = asked.copy()?;
    let name: Option<String> = others.get_item("style")?.map(|name| name.extract()).transpose()?;
    if name.is_some() {
        others.del_item("style")?;
    }
    let mut options = options("compare", &others)?;
    options.extend(name.map(|name| ("style".to_owned(), OptionValue::text(name))));
    of_style(Style::from_options(&options).map_err(raised)?)
}

fn of_style(style: Style) -> PyResult<MeasuredStyle> {
    let is_faithful = style == Style::named(style.name().parse().unwrap_or(StyleName::ThreePass));
    let mut changed: Options = style.to_options().map_err(raised)?;
    changed.remove("style");
    let options = format!("style {} {}", style.name(), words(&changed)).trim_end().to_owned();
    Ok(MeasuredStyle { style, submission: Submission::default(), options, is_faithful })
}

fn dictionary<'py>(py: Python<'py>, row: impl IntoIterator<Item = (String, Value)>) -> PyResult<Bound<'py, PyDict>> {
    let of_row = PyDict::new(py);
    for (name, value) in row {
        of_row.set_item(name, plain(py, value)?)?;
    }
    Ok(of_row)
}

/// A number, a text, or `None`.
fn plain(py: Python<'_>, value: Value) -> PyResult<Bound<'_, PyAny>> {
    match value {
        Value::Number(number) if number.is_u64() => number.as_u64().into_bound_py_any(py),
        Value::Number(number) => number.as_f64().into_bound_py_any(py),
        Value::String(text) => text.into_bound_py_any(py),
        Value::Bool(is_so) => is_so.into_bound_py_any(py),
        _ => Ok(py.None().into_bound(py)),
    }
}

/// Draws meshes together in two styles and compares their lines: the numbers, and the pictures of left, right and lines.
#[pyfunction]
#[pyo3(signature = (meshes, given, left, right, tolerance, backend=None))]
pub(crate) fn compare<'py>(
    py: Python<'py>,
    meshes: Vec<Py<Mesh>>,
    given: &Bound<'py, PyDict>,
    left: &str,
    right: &str,
    tolerance: f64,
    backend: Option<&str>,
) -> PyResult<(Bound<'py, PyDict>, Vec<Bound<'py, PyAny>>)> {
    let backend: Backend = named("backend", backend)?;
    let tolerance = share(tolerance)?;
    let FunctionRequest { request, .. } =
        FunctionRequest::new("compare", &meshes, given, &Basis { style: Some(left), ..Basis::default() })?;
    let style = |argument: &str, name: &str| -> PyResult<Style> {
        let of_name = name.parse().map_err(|ParseError(problem)| raised(Error::value("style", name, problem)))?;
        let style = request.in_style(of_name).map_err(raised)?.style;
        if !style.style_name().has_lines() {
            let with_lines = StyleName::list_with_lines();
            return Err(wrong(argument, format!("style {name} has no lines to compare; choose one of {with_lines}")));
        }
        Ok(style)
    };
    let styles = [style("left", left)?, style("right", right)?];
    let scene = drawable(py, meshes, &request)?.scene;
    let (pictures, numbers) = drawn(py, backend, move |renderer| {
        let mut draw =
            |style: &Style, show| -> Result<tinta::Picture> { renderer.draw(&scene, &style.plan(&scene, show)?) };
        let [left, right] = &styles;
        let inks = [draw(left, Show::Borders)?, draw(right, Show::Borders)?].map(|ink| InkMask::of(&ink));
        let agreement = Agreement::of(&inks[0], &inks[1], tolerance.px(scene.size).round() as u32)
            .ok_or_else(|| Error::setting("size", "the two pictures came out in different sizes; choose another"))?;
        let pictures = [draw(left, Show::Final)?, draw(right, Show::Final)?, agreement.picture(scene.size)];
        Ok((pictures, agreement.numbers))
    })?;
    let numbers = match serde_json::to_value(numbers) {
        Ok(Value::Object(numbers)) => dictionary(py, numbers)?,
        _ => PyDict::new(py),
    };
    let of_pixels = |picture: tinta::Picture| {
        let shape = [picture.size.height as usize, picture.size.width as usize, 4];
        crate::arrays::shaped(py, picture.pixels, &shape)
    };
    Ok((numbers, pictures.into_iter().map(of_pixels).collect::<PyResult<_>>()?))
}
