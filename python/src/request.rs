//! The request of a drawing: its settings over those of a look and a preset, the models' settings; and the recipe of the result,
//! which is the command line's for models from files.

use crate::errors::raised;
use crate::mesh::Mesh;
use crate::settings::{draws_lines, entries, is_reading, options, python_options};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use tinta::gl::ContextInfo;
use tinta::preset::Look;
use tinta::recipe::{Driver, FileRecord, Recipe};
use tinta::request::{Resolved, layers};
use tinta::settings::{OptionValue, Options};
use tinta::{Error, ParseError, Preset, Request, Result};

/// The function and its request.
#[derive(Debug, Clone)]
pub(crate) struct FunctionRequest {
    pub request: Request,
    /// Paths of the models; `None` if one has no file.
    models: Option<Vec<String>>,
    /// The other files read with the models.
    beside: Vec<PathBuf>,
}

/// Arguments other than settings.
#[derive(Default)]
pub(crate) struct Basis<'a> {
    pub style: Option<&'a str>,
    pub look: Option<&'a str>,
    pub preset: Option<&'a str>,
    pub show: Option<&'a str>,
    pub backend: Option<&'a str>,
}

impl FunctionRequest {
    /// Reads the arguments of a function.
    pub(crate) fn new(
        function: &str,
        meshes: &[Py<Mesh>],
        given: &Bound<'_, PyDict>,
        basis: &Basis<'_>,
    ) -> PyResult<Self> {
        let mut request = asked(function, options(function, given)?, basis).map_err(raised)?;
        // The meshes are already read: each knows its reading options.
        request.options.retain(|name, _| !is_reading(name));
        for mesh in meshes {
            request.options.extend(mesh.get().options.clone());
        }
        let paths: Option<Vec<String>> = meshes.iter().map(|mesh| mesh.get().path.clone()).collect();
        let names = meshes.iter().map(|mesh| mesh.get().mesh.name.clone());
        let file_name = |name: String| {
            Path::new(&name).file_name().map_or(name.clone(), |file| file.to_string_lossy().into_owned())
        };
        request.title = Some(names.map(file_name).filter(|name| !name.is_empty()).collect::<Vec<_>>().join(", "));
        let beside = meshes.iter().flat_map(|mesh| mesh.get().files.clone()).collect();
        Ok(Self { request, models: paths, beside })
    }

    /// The recipe of a drawing; `None` if a model has no file, because such a drawing cannot be made again.
    pub(crate) fn recipe(&self, drawn: &Resolved, context: Option<&ContextInfo>) -> Option<Recipe> {
        let request = drawn.request.clone().with_models(self.models.clone()?);
        Some(request.recipe(&drawn.scene, &self.beside, context.map(Driver::new), |path| FileRecord::of(path).ok()))
    }
}

/// The settings that a look or a preset gives a function for reading meshes.
#[pyfunction]
#[pyo3(signature = (function, style, look, preset))]
pub(crate) fn reading<'py>(
    py: Python<'py>,
    function: &str,
    style: Option<&str>,
    look: Option<&str>,
    preset: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let basis = Basis { style, look, preset, ..Basis::default() };
    let mut options = asked(function, Options::new(), &basis).map_err(raised)?.options;
    options.retain(|name, _| is_reading(name));
    python_options(py, &options)
}

/// The request of a function: its options over a preset and a look. The look is the named one, or the first for a picture without
/// style or look.
pub(crate) fn asked(function: &str, mut given: Options, basis: &Basis<'_>) -> Result<Request> {
    let named = [("style", basis.style), ("show", basis.show), ("backend", basis.backend)];
    given.extend(named.into_iter().filter_map(|(name, value)| Some((name.to_owned(), OptionValue::text(value?)))));
    let entries = entries(function);
    let preset = basis.preset.map(Preset::read).transpose()?;
    let is_known = |key: &str| key == "style" || entries.iter().any(|entry| entry.name() == key);
    if let Some((preset, key)) =
        preset.as_ref().and_then(|preset| Some((preset, preset.options.keys().find(|key| !is_known(key))?)))
    {
        return Err(preset.refuse(key, format!("{key}: {function} has no such option; leave it out")));
    }
    let look =
        basis.look.map(|name| Look::of_name(name).map_err(|ParseError(problem)| Error::value("look", name, problem)));
    let look = look.transpose()?;
    let draws_lines = draws_lines(function);
    if let Some(look) = look.filter(|look| look.has_settings() && look.draws_lines() != draws_lines) {
        let other = if draws_lines { "pictures; give it to render()" } else { "lines; give it to lines()" };
        return Err(Error::value("look", look.name, format!("this look is of {other}")));
    }
    let (request, _) = Request::from_layers(&layers(look, preset.into_iter().collect(), given, draws_lines))?;
    match request.style.style_name().draws_lines() == draws_lines {
        true => Ok(request),
        false => {
            let other = if draws_lines { "a picture; give it to render()" } else { "exact lines; give it to lines()" };
            Err(request.attributed(Error::value("style", request.style.name(), format!("this style draws {other}"))))
        }
    }
}
