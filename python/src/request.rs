//! What a drawing is asked for with: its settings, a look's and a preset's below them, the models' own; and the recipe of what
//! comes of it, which is the command line's for models from files.

use crate::errors::{in_python, python_name, raised};
use crate::mesh::Mesh;
use crate::settings::{Part, entries, kept, options};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::path::{Path, PathBuf};
use tinta::gl::ContextInfo;
use tinta::preset::{LOOKS, Look};
use tinta::recipe::{Driver, FileRecord, Recipe, files_read};
use tinta::settings::{EXCLUSIVE, OptionValue, Options};
use tinta::styles::is_ignored;
use tinta::{Error, ParseError, Preset, Result, Scene, Style};

/// Whose drawing it is, and the options that make it.
#[derive(Debug, Clone)]
pub(crate) struct Request {
    pub options: Options,
    /// Paths of the models; `None` where one is no file's.
    models: Option<Vec<String>>,
    /// What their drawing is titled.
    pub title: String,
    /// The files that were read besides the models.
    beside: Vec<PathBuf>,
}

/// What may be given besides the settings.
pub(crate) struct Basis<'a> {
    pub style: Option<&'a str>,
    pub look: Option<&'a str>,
    pub preset: Option<&'a str>,
}

impl Request {
    /// Reads what is given to a function.
    pub(crate) fn new(
        function: &str,
        meshes: &[Py<Mesh>],
        given: &Bound<'_, PyDict>,
        basis: &Basis<'_>,
    ) -> PyResult<Self> {
        let mut options = options(function, given)?;
        if let Some(style) = basis.style {
            options.insert("style".to_owned(), OptionValue::text(style));
        }
        let is_excluded = |name: &str, options: &Options| {
            let excludes = |(one, others): &(&str, &[&str])| {
                (*one == name && others.iter().any(|other| options.contains_key(*other)))
                    || (others.contains(&name) && options.contains_key(*one))
            };
            EXCLUSIVE.iter().any(excludes)
        };
        for (name, (_, value)) in
            below(function, basis).map_err(raised)?.into_iter().filter(|(_, (part, _))| !is_read(*part))
        {
            if !is_excluded(&name, &options) {
                options.entry(name).or_insert(value);
            }
        }
        for mesh in meshes {
            options.extend(mesh.get().options.clone());
        }
        let paths: Option<Vec<String>> = meshes.iter().map(|mesh| mesh.get().path.clone()).collect();
        let names = meshes.iter().map(|mesh| mesh.get().mesh.name.clone());
        let file_name = |name: String| {
            Path::new(&name).file_name().map_or(name.clone(), |file| file.to_string_lossy().into_owned())
        };
        let title = names.map(file_name).filter(|name| !name.is_empty()).collect::<Vec<_>>().join(", ");
        let beside = meshes.iter().flat_map(|mesh| mesh.get().files.clone()).collect();
        Ok(Self { options, models: paths, title, beside })
    }

    /// The recipe of a drawing; `None` where a model is no file's, for then nobody could make it again.
    pub(crate) fn recipe(
        &self,
        style_name: &str,
        scene: &Scene,
        style: Option<&Style>,
        context: Option<&ContextInfo>,
    ) -> Option<Recipe> {
        let models = self.models.clone()?;
        let paths = files_read(&models, &self.beside, scene, style);
        Some(Recipe {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: "render".to_owned(),
            style: style_name.to_owned(),
            size: [scene.size.width, scene.size.height],
            // One that has gone since it was read is left out.
            files: paths.iter().filter_map(|path| FileRecord::of(path).ok()).collect(),
            models,
            options: self.options.clone(),
            gl: context.map(Driver::new),
        })
    }
}

/// Options with the tables that they are of.
type Parted = BTreeMap<String, (Option<Part>, OptionValue)>;

/// Whether a setting says how a mesh is read, which is done before it is drawn.
fn is_read(part: Option<Part>) -> bool {
    part == Some(Part::Reading)
}

/// The settings by which a function reads meshes where a look or a preset says so.
#[pyfunction]
#[pyo3(signature = (function, style, look, preset))]
pub(crate) fn reading<'py>(
    py: Python<'py>,
    function: &str,
    style: Option<&str>,
    look: Option<&str>,
    preset: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (name, (_, value)) in below(function, &Basis { style, look, preset })
        .map_err(raised)?
        .into_iter()
        .filter(|(_, (part, _))| is_read(*part))
    {
        match value {
            OptionValue::Switch(is_on) => found.set_item(python_name(&name), is_on)?,
            OptionValue::Text(text) => found.set_item(python_name(&name), text)?,
            OptionValue::Texts(texts) => found.set_item(python_name(&name), texts)?,
        }
    }
    Ok(found)
}

/// The options of a preset, and below them of a look: the one that is named, or for a picture of which nothing is said the first.
fn below(function: &str, basis: &Basis<'_>) -> Result<Parted> {
    let entries = entries(function);
    let known = |key: &str| entries.iter().find(|(_, entry)| entry.name == key);
    let draws_lines = function == "lines";
    let is_style =
        |key: &str, value: &OptionValue| key == "style" && (!draws_lines || *value == OptionValue::text("lines"));
    let preset = basis.preset.map(Preset::read).transpose()?;
    let look = match basis.look {
        Some(name) => Some(Look::of_name(name).map_err(|ParseError(problem)| Error::value("look", name, problem))?),
        None if !draws_lines && basis.style.is_none() && preset.is_none() => Some(LOOKS[0]),
        None => None,
    };
    let mut below = Parted::new();
    for (key, value) in preset.iter().flat_map(|preset| &preset.options) {
        match known(key) {
            Some((part, entry)) => {
                below.extend(kept(entry.kind, value.clone()).map(|value| (key.clone(), (Some(*part), value))));
            }
            None if is_style(key, value) => drop(below.insert(key.clone(), (None, value.clone()))),
            None if key == "style" => {}
            None => {
                let problem = format!("{key}: {function} has no such option; leave it out");
                return Err(preset.as_ref().map_or(Error::Cancelled, |preset| preset.refuse(key, problem)));
            }
        }
    }
    let options = look.map(Look::preset).transpose()?.map(|preset| preset.options).unwrap_or_default();
    if let Some(look) = look.filter(|look| look.draws_lines() != draws_lines && !options.is_empty()) {
        let other = if draws_lines { "pictures; give it to render()" } else { "lines; give it to lines()" };
        return Err(Error::value("look", look.name, format!("this look is of {other}")));
    }
    let own_style = below.get("style").map(|(_, value)| value).or(options.get("style"));
    let style = match (basis.style, own_style) {
        (Some(style), _) => Some(style.to_owned()),
        (None, Some(OptionValue::Text(style))) => Some(style.clone()),
        _ => None,
    };
    for (key, value) in options {
        let is_of_another_style = style.as_ref().is_some_and(|style| is_ignored(&key, &[style]));
        let found = match known(&key).filter(|_| !is_of_another_style) {
            Some((part, entry)) => kept(entry.kind, value).map(|value| (Some(*part), value)),
            None => is_style(&key, &value).then_some((None, value)),
        };
        if let Some(found) = found {
            below.entry(key).or_insert(found);
        }
    }
    Ok(below)
}

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
