//! Settings by their names: which a function takes, what Python's values say, and what is written of them in help.
//!
//! No setting is named here: everything is a loop over the tables beside the structs.

use crate::errors::{in_python, python_name, raised};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PySequence, PyString};
use tinta::camera;
use tinta::choice::{nearest, no_option};
use tinta::settings::{HasSettings, Kind, OptionValue, Options, Setting, Table, names_of, refuse_exclusive};
use tinta::styles::StyleName;
use tinta::{Backend, Error, LineSettings, LoadOptions, SceneSettings, Show, Style, SvgSettings};

/// A table of settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Part {
    Reading,
    Scene,
    Lines,
    Drawing,
    Styles,
}

/// Functions of Python by what their settings are, and what they are called where help is asked for.
const FUNCTIONS: [(&str, &[Part]); 8] = [
    ("lines", &[Part::Lines, Part::Drawing, Part::Scene, Part::Reading]),
    ("Lines.svg", &[Part::Drawing]),
    ("render", &[Part::Styles, Part::Scene, Part::Reading]),
    ("mesh", &[Part::Reading]),
    ("edges", &[Part::Lines, Part::Reading]),
    ("silhouette", &[Part::Reading]),
    ("measure", &[Part::Scene, Part::Reading]),
    ("compare", &[Part::Styles, Part::Scene, Part::Reading]),
];

/// What a setting is, whatever it is a setting of.
#[derive(Clone)]
pub(crate) struct Entry {
    pub name: &'static str,
    pub kind: &'static Kind,
    value_name: &'static str,
    help: &'static str,
    default: String,
    heading: &'static str,
}

fn entries_of<T: HasSettings>() -> Vec<Entry> {
    let table: &'static Table<T> = T::table();
    let entry = |setting: &'static Setting<T>| Entry {
        name: setting.name,
        kind: &setting.kind,
        value_name: setting.value_name,
        help: setting.help,
        default: setting.said_default.map_or_else(|| table.default_of(setting), str::to_owned),
        heading: setting.heading,
    };
    table.of(None).into_iter().map(entry).collect()
}

impl Part {
    fn entries(self) -> Vec<Entry> {
        match self {
            Self::Reading => entries_of::<LoadOptions>(),
            Self::Scene => entries_of::<SceneSettings>(),
            Self::Lines => entries_of::<LineSettings>(),
            Self::Drawing => entries_of::<SvgSettings>(),
            Self::Styles => entries_of::<Style>(),
        }
    }

    fn canonical(self, name: &str, value: OptionValue) -> OptionValue {
        match self {
            Self::Reading => canonical_of::<LoadOptions>(name, value),
            Self::Scene => canonical_of::<SceneSettings>(name, value),
            Self::Lines => canonical_of::<LineSettings>(name, value),
            Self::Drawing => canonical_of::<SvgSettings>(name, value),
            // A style has no default; its texts have no other notation.
            Self::Styles => value,
        }
    }

    fn check(self, name: &str, text: &str) -> Result<(), String> {
        match self {
            Self::Reading => LoadOptions::table().check(name, text),
            Self::Scene => SceneSettings::table().check(name, text),
            Self::Lines => LineSettings::table().check(name, text),
            Self::Drawing => SvgSettings::table().check(name, text),
            Self::Styles => Style::table().check(name, text),
        }
    }
}

/// A value as a table writes it: of several numbers, which have a notation of their own there.
fn canonical_of<T: HasSettings + Default>(name: &str, value: OptionValue) -> OptionValue {
    let options = Options::from([(name.to_owned(), value.clone())]);
    let written = T::from_options(&options).ok().and_then(|of| T::table().find(&of, name)?.value(&of));
    written.map_or(value, OptionValue::Text)
}

fn parts_of(function: &str) -> &'static [Part] {
    FUNCTIONS.iter().find(|(name, _)| *name == function).map_or(&[], |(_, parts)| parts)
}

/// The settings of a function, each with its table, each name once.
pub(crate) fn entries(function: &str) -> Vec<(Part, Entry)> {
    let mut all: Vec<(Part, Entry)> = Vec::new();
    for part in parts_of(function) {
        for entry in part.entries() {
            if all.iter().all(|(_, known)| known.name != entry.name) {
                all.push((*part, entry));
            }
        }
    }
    all
}

/// Reads what is given to a function by names.
pub(crate) fn options(function: &str, given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let entries = entries(function);
    let mut options = Options::new();
    for (key, given_value) in given {
        let key: String = key.extract()?;
        let name = key.replace('_', "-");
        let Some((part, entry)) = entries.iter().find(|(_, entry)| entry.name == name) else {
            return Err(PyValueError::new_err(unknown(given.py(), function, &key, &entries)));
        };
        let Some(value) = value_of(&key, entry, &given_value)? else { continue };
        if let OptionValue::Text(text) = &value {
            if *entry.kind == Kind::Flag {
                return Err(raised(Error::setting(entry.name, "give True or False")));
            }
            part.check(entry.name, text).map_err(|problem| raised(Error::value(entry.name, text, problem)))?;
        }
        let is_list = scalar(&given_value)?.is_none() && several(&given_value)?.is_some();
        let value = if is_list && matches!(entry.kind, Kind::Text { .. } | Kind::Colors { .. }) {
            part.canonical(entry.name, value)
        } else {
            value
        };
        if let Some(value) = kept(entry.kind, value) {
            options.insert(entry.name.to_owned(), value);
        }
    }
    refuse_exclusive(&options).map_err(raised)?;
    Ok(options)
}

/// Refuses what is no setting of a function, or no value of one, before any work.
#[pyfunction]
pub(crate) fn check(function: &str, given: &Bound<'_, PyDict>) -> PyResult<()> {
    options(function, given).map(drop)
}

/// What to say of a name that is no setting of a function.
fn unknown(py: Python<'_>, function: &str, key: &str, entries: &[(Part, Entry)]) -> String {
    let own = own_names(py, function).unwrap_or_default();
    let settings: Vec<String> = entries.iter().map(|(_, entry)| python_name(entry.name)).collect();
    let names: Vec<&str> = own.iter().chain(&settings).map(String::as_str).collect();
    match nearest(key, &names) {
        Some(meant) => no_option(function, key, Some(meant)),
        None => format!("{}; see help(tinta_npr.{function})", no_option(function, key, None)),
    }
}

/// What a function of the package takes besides settings, by the names in its signature.
fn own_names(py: Python<'_>, function: &str) -> PyResult<Vec<String>> {
    let package = py.import("tinta_npr")?.into_any();
    let of_python = function.split('.').try_fold(package, |within, name| within.getattr(name))?;
    let parameters = py.import("inspect")?.call_method1("signature", (of_python,))?.getattr("parameters")?;
    let names: Vec<String> = parameters.try_iter()?.map(|name| name?.extract()).collect::<PyResult<_>>()?;
    Ok(names.into_iter().filter(|name| name != "settings" && name != "self").collect())
}

/// A value as recipes and presets keep it, as the command line does; `None` for a switch that is off.
pub(crate) fn kept(kind: &Kind, value: OptionValue) -> Option<OptionValue> {
    match (kind, value) {
        (Kind::Flag, OptionValue::Switch(false)) => None,
        (Kind::Switch, OptionValue::Switch(is_on)) => Some(OptionValue::text(if is_on { "on" } else { "off" })),
        (_, value) => Some(value),
    }
}

/// What a value of Python says of a setting; `None` leaves it as it is by default.
fn value_of(key: &str, entry: &Entry, value: &Bound<'_, PyAny>) -> PyResult<Option<OptionValue>> {
    if value.is_none() {
        return Ok(None);
    }
    if let Some(is_on) = switch(value) {
        return Ok(Some(OptionValue::Switch(is_on)));
    }
    let text = match text_of(value, entry.kind)? {
        Some(text) => text,
        None => {
            let given = value.get_type().name()?;
            let value_name = if entry.value_name.is_empty() { "True or False" } else { entry.value_name };
            return Err(PyTypeError::new_err(format!("{key}: give {value_name}, not a value of type {given}")));
        }
    };
    Ok(Some(OptionValue::Text(text)))
}

/// A truth value, numpy's too.
fn switch(value: &Bound<'_, PyAny>) -> Option<bool> {
    value.extract::<bool>().ok()
}

/// The text of a value: numbers and texts as they are, several with commas between, pairs as `NAME=VALUE`, a colour's numbers as
/// shares of full red, green and blue.
fn text_of(value: &Bound<'_, PyAny>, kind: &Kind) -> PyResult<Option<String>> {
    if let Some(text) = scalar(value)? {
        return Ok(Some(text));
    }
    if let Ok(pairs) = value.cast::<PyMapping>() {
        let mut texts = Vec::new();
        for pair in pairs.items()? {
            let (key, value): (String, Bound<'_, PyAny>) = pair.extract()?;
            // Colours are the only values of several numbers that are said of names.
            let Some(value) = text_of(&value, &Kind::Color)? else { return Ok(None) };
            texts.push(format!("{}={value}", key.replace('_', "-")));
        }
        return Ok(Some(texts.join(",")));
    }
    let Some(values) = several(value)? else { return Ok(None) };
    let mut texts = Vec::new();
    for value in values {
        let Some(text) = scalar(&value)? else { return Ok(None) };
        texts.push(text);
    }
    let numbers: Result<Vec<f64>, _> = texts.iter().map(|text| text.parse::<f64>()).collect();
    Ok(Some(match (kind, numbers) {
        (Kind::Color, Ok(numbers)) if numbers.len() == 3 || numbers.len() == 4 => {
            let [red, green, blue] = [0, 1, 2].map(|channel| numbers[channel] * 255.0);
            let alpha = numbers.get(3).map_or(String::new(), |alpha| format!(" / {alpha}"));
            format!("rgb({red} {green} {blue}{alpha})")
        }
        _ => texts.join(","),
    }))
}

/// A number, a text or a path.
fn scalar(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Some(text.to_cow()?.into_owned()));
    }
    if value.hasattr("__fspath__")? {
        return Ok(Some(value.call_method0("__fspath__")?.extract()?));
    }
    if value.hasattr("__index__")?
        && let Ok(whole) = value.extract::<i128>()
    {
        return Ok(Some(whole.to_string()));
    }
    if value.hasattr("__len__")? && value.len().is_ok() {
        return Ok(None);
    }
    match value.extract::<f64>() {
        Ok(number) => Ok(Some(number.to_string())),
        Err(_) => Ok(None),
    }
}

/// The values of a list, a tuple or an array.
fn several<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Vec<Bound<'py, PyAny>>>> {
    let list = if value.hasattr("tolist")? { value.call_method0("tolist")? } else { value.clone() };
    let is_set = list.hasattr("union")?;
    match list.cast::<PySequence>().is_ok() || is_set {
        true => list.try_iter()?.collect::<PyResult<Vec<_>>>().map(Some),
        false => Ok(None),
    }
}

/// The settings of a function as plain values, for its signature in the stubs.
#[pyfunction]
pub(crate) fn settings<'py>(py: Python<'py>, function: &str) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let described = |(_, entry): (Part, Entry)| -> PyResult<Bound<'py, PyDict>> {
        let of_it = PyDict::new(py);
        let (kind, names, count): (&str, Vec<&str>, usize) = match entry.kind {
            Kind::Numbers { count, .. } => ("numbers", Vec::new(), *count),
            Kind::Choice(names) | Kind::Recipe(names) => ("choice", names.clone(), 1),
            Kind::Several(names) => ("several", names.clone(), 1),
            Kind::Switch | Kind::Flag => ("switch", Vec::new(), 1),
            Kind::File => ("file", Vec::new(), 1),
            Kind::Color => ("color", Vec::new(), 1),
            Kind::Colors { offered, .. } | Kind::Text { offered, .. } => ("text", offered.to_vec(), 1),
        };
        of_it.set_item("name", python_name(entry.name))?;
        of_it.set_item("kind", kind)?;
        of_it.set_item("names", names)?;
        of_it.set_item("count", count)?;
        of_it.set_item("value_name", entry.value_name)?;
        of_it.set_item("heading", in_python(entry.heading))?;
        of_it.set_item("help", in_python(entry.help))?;
        of_it.set_item("default", &entry.default)?;
        Ok(of_it)
    };
    entries(function).into_iter().map(described).collect()
}

/// The settings of a function as its help lists them.
#[pyfunction]
pub(crate) fn documentation(function: &str) -> String {
    let mut text = String::new();
    let mut heading = "";
    for (_, entry) in entries(function) {
        if entry.heading != heading {
            heading = entry.heading;
            text.push_str(&format!("\n{}\n", in_python(heading)));
        }
        let value = match entry.kind {
            Kind::Switch | Kind::Flag => "True or False".to_owned(),
            _ => entry.value_name.to_owned(),
        };
        text.push_str(&format!("  {} : {value}\n", python_name(entry.name)));
        text.push_str(&format!("      {} [default: {}]\n", in_python(entry.help), entry.default));
    }
    text
}

/// The names that there are of something: styles, looks, shows, backends, classes.
#[pyfunction]
pub(crate) fn names(of: &str) -> Vec<&'static str> {
    match of {
        "style" => names_of::<StyleName>(),
        "show" => names_of::<Show>(),
        "backend" => names_of::<Backend>(),
        "class" => names_of::<tinta::edges::Class>(),
        "look" => tinta::preset::LOOKS.map(|look| look.name).to_vec(),
        "function" => FUNCTIONS.map(|(name, _)| name).to_vec(),
        _ => Vec::new(),
    }
}

/// The settings that are a camera's.
#[pyfunction]
pub(crate) fn camera_names() -> Vec<String> {
    let of_scene = SceneSettings::table().of(None).into_iter();
    of_scene.filter(|setting| setting.heading == camera::HEADING).map(|setting| python_name(setting.name)).collect()
}
