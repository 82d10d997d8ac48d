//! Pictures: styles drawn by OpenGL, and PNG files of them.

use crate::arrays::shaped;
use crate::errors::{python_name, raised, wrong};
use crate::mesh::{Mesh, drawable};
use crate::request::{Basis, FunctionRequest};
use crate::studio::drawn;
use crate::warnings::warn;
use crate::work::done;
use numpy::PyReadonlyArray3;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;
use std::str::FromStr;
use tinta::lines::Progress;
use tinta::picture::Note;
use tinta::recipe::KEYWORD;
use tinta::settings::{OptionValue, Options};
use tinta::styles::is_ignored;
use tinta::{Error, ParseError, Recipe, Size, Target, TextTarget};

/// A drawn picture: its pixels, handed over once, and the recipe in its PNG file.
#[pyclass(frozen, module = "tinta_npr._native")]
pub(crate) struct Picture {
    #[pyo3(get)]
    pixels: Py<PyAny>,
    #[pyo3(get)]
    recipe: Option<String>,
}

/// Draws meshes together.
#[pyfunction]
#[pyo3(signature = (meshes, given, style=None, look=None, preset=None, show=None, backend=None))]
#[expect(clippy::too_many_arguments, reason = "they are Python's, each with a name")]
pub(crate) fn render(
    py: Python<'_>,
    meshes: Vec<Py<Mesh>>,
    given: &Bound<'_, PyDict>,
    style: Option<&str>,
    look: Option<&str>,
    preset: Option<&str>,
    show: Option<&str>,
    backend: Option<&str>,
) -> PyResult<Picture> {
    let asked = FunctionRequest::new("render", &meshes, given, &Basis { style, look, preset, show, backend })?;
    warn(py, &ignored(given, asked.request.style.name())?)?;
    let resolved = drawable(py, meshes, &asked.request)?;
    let (picture, recipe, remarks) = drawn(py, asked.request.backend, move |renderer| {
        let (published, around) = (resolved.plan()?, resolved.around(&Progress::default())?);
        let drawn = resolved.drawn_picture(published, around, renderer)?;
        let recipe = asked.recipe(&drawn.resolved, Some(renderer.context()));
        Ok((drawn.picture, recipe.as_ref().and_then(Recipe::json), drawn.remarks))
    })?;
    warn(py, &remarks)?;
    let shape = [picture.size.height as usize, picture.size.width as usize, 4];
    Ok(Picture { pixels: shaped(py, picture.pixels, &shape)?.unbind(), recipe })
}

/// The value of a name; the default without a name.
pub(crate) fn named<T: FromStr<Err = ParseError> + Default>(argument: &str, name: Option<&str>) -> PyResult<T> {
    let Some(name) = name else { return Ok(T::default()) };
    name.parse().map_err(|ParseError(problem)| raised(Error::value(argument, name, problem)))
}

/// The remark about settings that this style does not have.
fn ignored(given: &Bound<'_, PyDict>, style: &str) -> PyResult<Vec<String>> {
    let mut remarks = Vec::new();
    for key in given.keys() {
        let key: String = key.extract()?;
        if is_ignored(&key.replace('_', "-"), &[style]) {
            remarks.push(format!("{key} has no effect on style {style}; help(tinta_npr.render) says which it is for"));
        }
    }
    Ok(remarks)
}

/// The PNG file of pixels, (H, W, 4) uint8, with a recipe in it.
#[pyfunction]
#[pyo3(signature = (pixels, recipe=None))]
pub(crate) fn png<'py>(
    py: Python<'py>,
    pixels: PyReadonlyArray3<'py, u8>,
    recipe: Option<String>,
) -> PyResult<Bound<'py, PyBytes>> {
    let picture = picture_of(&pixels)?;
    let note = recipe.map(|text| Note { keyword: KEYWORD, text });
    Ok(PyBytes::new(py, &done(py, || (), move || picture.png_bytes(note.as_ref()))?))
}

/// Writes the pixels in the format of the file name's ending.
#[pyfunction]
#[pyo3(signature = (pixels, path, recipe=None))]
pub(crate) fn save(
    py: Python<'_>,
    pixels: PyReadonlyArray3<'_, u8>,
    path: PathBuf,
    recipe: Option<String>,
) -> PyResult<()> {
    let picture = picture_of(&pixels)?;
    let is_transparent = picture.pixels.chunks_exact(4).any(|pixel| pixel[3] != u8::MAX);
    let note = recipe.map(|text| Note { keyword: KEYWORD, text });
    done(py, || (), move || Target::of_file(&path, is_transparent)?.write_with(&picture, note.as_ref()))
}

/// Writes a file whole, or leaves the old file unchanged.
#[pyfunction]
pub(crate) fn write(py: Python<'_>, path: String, content: Vec<u8>) -> PyResult<()> {
    done(py, || (), move || TextTarget::check(&path)?.write_bytes(&content))
}

/// A copy of pixels.
pub(crate) fn picture_of(pixels: &PyReadonlyArray3<'_, u8>) -> PyResult<tinta::Picture> {
    let array = pixels.as_array();
    let (height, width, channels) = array.dim();
    let side = |length: usize| u32::try_from(length).ok().filter(|length| *length > 0);
    let (Some(width), Some(height), 4) = (side(width), side(height), channels) else {
        return Err(wrong("pixels", format!("their shape is ({height}, {width}, {channels}); give (H, W, 4)")));
    };
    Ok(tinta::Picture { size: Size { width, height }, pixels: array.iter().copied().collect() })
}

/// Settings in the command line's notation, without its dashes.
pub(crate) fn words(options: &Options) -> String {
    let word = |(name, value): (&String, &OptionValue)| match value {
        OptionValue::Switch(false) => None,
        OptionValue::Switch(true) => Some(python_name(name)),
        OptionValue::Text(text) => Some(format!("{} {}", python_name(name), tinta::shell::quoted(text))),
        OptionValue::Texts(texts) => Some(format!("{} {}", python_name(name), tinta::shell::quoted(&texts.join(",")))),
    };
    options.iter().filter_map(word).collect::<Vec<_>>().join(" ")
}
