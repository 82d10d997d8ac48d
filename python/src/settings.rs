//! Settings by their names: each function's settings, the conversion of Python values, and the help texts.
//!
//! This file names no setting: everything is a loop over the tables beside the structs.

use crate::errors::{in_python, python_name, raised};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PySequence, PyString};
use tinta::camera;
use tinta::choice::{nearest, no_option};
use tinta::lines::PartRules;
use tinta::mesh::Format;
use tinta::preset::{LOOKS, Look};
use tinta::settings::{HasSettings, Kind, OptionValue, Options, Setting, names_of, refuse_exclusive, rule_text};
use tinta::styles::{StyleName, is_of_lines_alone};
use tinta::{Backend, Error, LineSettings, LoadOptions, Request, SceneSettings, Show, Style};

/// The settings of a drawing that a function takes.
#[derive(Clone, Copy)]
struct FunctionSettings {
    /// The style of its settings; `None` for all OpenGL styles.
    style: Option<StyleName>,
    of_style: fn(&str) -> bool,
    has_scene: bool,
    has_reading: bool,
}

/// Python functions by their settings, with their names in help.
const FUNCTIONS: [(&str, FunctionSettings); 9] = {
    const ALL: FunctionSettings =
        FunctionSettings { style: None, of_style: |_| true, has_scene: true, has_reading: true };
    const NONE: fn(&str) -> bool = |_| false;
    const LINES: FunctionSettings = FunctionSettings { style: Some(StyleName::Lines), ..ALL };
    let drawing: fn(&str) -> bool = |name| !LineSettings::table().has(name);
    let tones: fn(&str) -> bool = |name| name.starts_with("tone") && name != "tone-lookup";
    let finding: fn(&str) -> bool = |name| LineSettings::table().has(name);
    let reading = FunctionSettings { of_style: NONE, has_scene: false, ..ALL };
    [
        ("lines", LINES),
        ("Lines.svg", FunctionSettings { of_style: drawing, has_scene: false, has_reading: false, ..LINES }),
        ("Lines.regions", FunctionSettings { of_style: tones, has_scene: false, has_reading: false, ..ALL }),
        ("render", ALL),
        ("mesh", reading),
        ("edges", FunctionSettings { of_style: finding, has_scene: false, ..LINES }),
        ("silhouette", reading),
        ("measure", FunctionSettings { of_style: NONE, ..ALL }),
        ("compare", ALL),
    ]
};

/// A setting of a function.
#[derive(Clone)]
pub(crate) struct Entry {
    pub setting: &'static Setting<Request>,
    pub default: String,
}

impl Entry {
    /// Its name with hyphens.
    pub(crate) fn name(&self) -> &'static str {
        self.setting.name
    }
}

/// Whether a setting controls how a mesh is read, which happens before drawing.
pub(crate) fn is_reading(name: &str) -> bool {
    LoadOptions::table().has(name)
}

/// Whether a function draws exact lines.
pub(crate) fn draws_lines(function: &str) -> bool {
    taken_by(function).is_some_and(|taken| taken.style.is_some_and(StyleName::draws_lines))
}

fn taken_by(function: &str) -> Option<&'static FunctionSettings> {
    FUNCTIONS.iter().find(|(name, _)| *name == function).map(|(_, taken)| taken)
}

/// A request in the style of a function's settings.
fn form_of(function: &str) -> Request {
    let style = taken_by(function).and_then(|taken| taken.style);
    style.map_or_else(Request::default, Request::of_style)
}

/// The settings of a function, those of styles first, each name once.
pub(crate) fn entries(function: &str) -> Vec<Entry> {
    let Some(taken) = taken_by(function) else { return Vec::new() };
    let (table, form) = (Request::table(), form_of(function));
    let rank = |name: &str| match name {
        name if Style::table().has(name) => {
            let is_of_it = (taken.of_style)(name) && (taken.style.is_some() || !is_of_lines_alone(name));
            is_of_it.then_some(0)
        }
        name if SceneSettings::table().has(name) => taken.has_scene.then_some(1),
        name => (taken.has_reading && is_reading(name)).then_some(2),
    };
    let settings = table.of(taken.style.map(|_| &form));
    let mut all: Vec<_> = settings.into_iter().filter_map(|setting| Some((rank(setting.name)?, setting))).collect();
    all.sort_by_key(|(rank, _)| *rank);
    // Said for several styles, lines among them, it is of another function's pictures.
    let is_of_others = |said: &str| taken.style.is_some() && said.contains("style lines:");
    let default = |setting: &Setting<Request>| match (setting.said_default, setting.value(&form)) {
        (Some(said), None) => said.to_owned(),
        (Some(said), Some(_)) if !is_of_others(said) => said.to_owned(),
        (_, Some(value)) => value,
        (None, None) => table.default_of(setting),
    };
    all.into_iter().map(|(_, setting)| Entry { setting, default: default(setting) }).collect()
}

/// A value in the table's notation, which differs for lists of numbers.
fn canonical(function: &str, name: &str, value: OptionValue) -> OptionValue {
    let (table, mut form) = (Request::table(), form_of(function));
    let is_set = table.apply(&mut form, &Options::from([(name.to_owned(), value.clone())])).is_ok();
    let written = table.find(&form, name).filter(|_| is_set).and_then(|setting| setting.value(&form));
    written.map_or(value, OptionValue::Text)
}

/// Reads a function's keyword arguments.
pub(crate) fn options(function: &str, given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let entries = entries(function);
    let mut options = Options::new();
    for (key, given_value) in given {
        let key: String = key.extract()?;
        let name = key.replace('_', "-");
        let Some(entry) = entries.iter().find(|entry| entry.name() == name) else {
            return Err(PyValueError::new_err(unknown(given.py(), function, &key)));
        };
        let Some(value) = value_of(&key, entry, &given_value)? else { continue };
        if let OptionValue::Text(text) = &value {
            if entry.setting.kind == Kind::Flag {
                return Err(raised(Error::setting(name, "give True or False")));
            }
            let checked = Request::table().check(&name, text);
            checked.map_err(|problem| raised(Error::value(name.clone(), text, problem)))?;
        }
        let is_list = scalar(&given_value)?.is_none() && several(&given_value)?.is_some();
        let value = if is_list && matches!(entry.setting.kind, Kind::Text { .. } | Kind::Colors { .. }) {
            canonical(function, &name, value)
        } else {
            value
        };
        if let Some(value) = kept(&entry.setting.kind, value) {
            options.insert(name, value);
        }
    }
    refuse_exclusive(&options).map_err(raised)?;
    Ok(options)
}

/// Refuses unknown settings of a function and invalid values before any work.
#[pyfunction]
pub(crate) fn check(function: &str, given: &Bound<'_, PyDict>) -> PyResult<()> {
    options(function, given).map(drop)
}

/// The error about an unknown setting of a function.
fn unknown(py: Python<'_>, function: &str, key: &str) -> String {
    if let Some(problem) = Request::gone(&key.replace('_', "-")) {
        return in_python(&format!("{key}: {problem}"));
    }
    let names = argument_names(py, function).unwrap_or_default();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let meant = nearest(key, &names);
    let see = if meant.is_none() { format!("; see help(tinta_npr.{function})") } else { String::new() };
    no_option(function, key, meant) + &see
}

/// A function's arguments, settings among them, by the names in its signature.
fn argument_names(py: Python<'_>, function: &str) -> PyResult<Vec<String>> {
    let package = py.import("tinta_npr")?.into_any();
    let of_python = function.split('.').try_fold(package, |within, name| within.getattr(name))?;
    let parameters = py.import("inspect")?.call_method1("signature", (of_python,))?.getattr("parameters")?;
    let names: Vec<String> = parameters.try_iter()?.map(|name| name?.extract()).collect::<PyResult<_>>()?;
    Ok(names.into_iter().filter(|name| name != "self").collect())
}

/// Options as Python's keyword arguments.
pub(crate) fn python_options<'py>(py: Python<'py>, options: &Options) -> PyResult<Bound<'py, PyDict>> {
    let given = PyDict::new(py);
    for (name, value) in options {
        let name = python_name(name);
        match value {
            OptionValue::Switch(is_on) => given.set_item(name, is_on)?,
            OptionValue::Text(text) if text == "on" || text == "off" => given.set_item(name, text == "on")?,
            OptionValue::Text(text) => given.set_item(name, text)?,
            OptionValue::Texts(texts) => given.set_item(name, texts)?,
        }
    }
    Ok(given)
}

/// A value as recipes and presets keep it, as the command line does; `None` for a switch that is off.
pub(crate) fn kept(kind: &Kind, value: OptionValue) -> Option<OptionValue> {
    match (kind, value) {
        (Kind::Flag, OptionValue::Switch(false)) => None,
        (Kind::Switch, OptionValue::Switch(is_on)) => Some(OptionValue::text(if is_on { "on" } else { "off" })),
        (_, value) => Some(value),
    }
}

/// Converts a Python value to a setting's; `None` keeps the default.
fn value_of(key: &str, entry: &Entry, value: &Bound<'_, PyAny>) -> PyResult<Option<OptionValue>> {
    if value.is_none() {
        return Ok(None);
    }
    if let Some(is_on) = switch(value) {
        let choices = match &entry.setting.kind {
            Kind::Choice(names) | Kind::Several(names) if !names.contains(&"on") => names.join(", "),
            Kind::Numbers { .. } | Kind::Color | Kind::Colors { .. } => entry.setting.value_name.to_owned(),
            _ => return Ok(Some(OptionValue::Switch(is_on))),
        };
        let truth = if is_on { "True" } else { "False" };
        return Err(PyValueError::new_err(format!("{key}: give {choices}, not {truth}")));
    }
    if let (Some(_), Some(texts)) = (entry.setting.between, several(value)?)
        && value.cast::<PyMapping>().is_err()
        && let Ok(texts) = texts.iter().map(|text| text.extract()).collect::<PyResult<Vec<String>>>()
        && scalar(value)?.is_none()
    {
        return Ok(Some(OptionValue::Texts(texts)));
    }
    let text = match text_of(key, value, &entry.setting.kind)? {
        Some(text) => text,
        None => {
            let given = value.get_type().name()?;
            let value_name =
                if entry.setting.value_name.is_empty() { "True or False" } else { entry.setting.value_name };
            return Err(PyTypeError::new_err(format!("{key}: give {value_name}, not a value of type {given}")));
        }
    };
    Ok(Some(OptionValue::Text(text)))
}

/// A truth value, numpy's too.
fn switch(value: &Bound<'_, PyAny>) -> Option<bool> {
    value.extract::<bool>().ok()
}

/// The text of a value: numbers and texts unchanged, several joined by commas, pairs as `NAME=VALUE`, a colour's numbers as
/// shares of full red, green and blue, which the sentence about wrong ones names by `key`.
fn text_of(key: &str, value: &Bound<'_, PyAny>, kind: &Kind) -> PyResult<Option<String>> {
    if let Some(text) = scalar(value)? {
        return Ok(Some(text));
    }
    if let Ok(pairs) = value.cast::<PyMapping>() {
        let (mut texts, mut rules) = (Vec::new(), Vec::new());
        for pair in pairs.items()? {
            let (name, value): (String, Bound<'_, PyAny>) = pair.extract()?;
            if let Ok(settings) = value.cast::<PyMapping>() {
                rules.push(rule(key, &name, settings)?);
                continue;
            }
            // Colours are the only named values of several numbers.
            let Some(value) = text_of(&format!("{key} {name}"), &value, &Kind::Color)? else { return Ok(None) };
            texts.push(format!("{}={value}", name.replace('_', "-")));
        }
        return Ok(Some(if rules.is_empty() { texts.join(",") } else { rules.join(PartRules::BETWEEN) }));
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
            if !numbers.iter().all(|number| (0.0..=1.0).contains(number)) {
                let problem = "the numbers of a colour are from 0 to 1; divide those from 0 to 255 by 255";
                return Err(PyValueError::new_err(format!("{key} ({}): {problem}", texts.join(", "))));
            }
            let [red, green, blue] = [0, 1, 2].map(|channel| numbers[channel] * 255.0);
            let alpha = numbers.get(3).map_or(String::new(), |alpha| format!(" / {alpha}"));
            format!("rgb({red} {green} {blue}{alpha})")
        }
        _ => texts.join(","),
    }))
}

/// The text of a rule for parts, from the dictionary of its settings.
fn rule(key: &str, name: &str, settings: &Bound<'_, PyMapping>) -> PyResult<String> {
    let mut options = Vec::new();
    for pair in settings.items()? {
        let (setting, value): (String, Bound<'_, PyAny>) = pair.extract()?;
        let key = format!("{key} {name} {setting}");
        let value = match switch(&value) {
            Some(is_on) => OptionValue::Switch(is_on),
            None => match (text_of(&key, &value, &Kind::Color)?, scalar(&value)?) {
                (Some(text), None) if !text.starts_with("rgb(") => {
                    OptionValue::Texts(text.split(',').map(str::to_owned).collect())
                }
                (Some(text), _) => OptionValue::Text(text),
                (None, _) => return Err(PyTypeError::new_err(format!("{key}: give a text, a number, a list or True"))),
            },
        };
        options.push((setting.replace('_', "-"), value));
    }
    Ok(rule_text(name, options))
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

/// The settings of a function as plain values, for its signature.
#[pyfunction]
pub(crate) fn settings<'py>(py: Python<'py>, function: &str) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let described = |Entry { setting, default }: Entry| -> PyResult<Bound<'py, PyDict>> {
        let of_it = PyDict::new(py);
        let (kind, names, count): (&str, Vec<&str>, usize) = match &setting.kind {
            Kind::Numbers { count, .. } => ("numbers", Vec::new(), *count),
            Kind::Choice(names) | Kind::Recipe(names) => ("choice", names.clone(), 1),
            Kind::Several(names) => ("several", names.clone(), 1),
            Kind::Switch | Kind::Flag => ("switch", Vec::new(), 1),
            Kind::File => ("file", Vec::new(), 1),
            Kind::Color => ("color", Vec::new(), 1),
            Kind::Colors { offered, .. } | Kind::Text { offered, .. } => ("text", offered.to_vec(), 1),
        };
        of_it.set_item("name", python_name(setting.name))?;
        of_it.set_item("kind", kind)?;
        of_it.set_item("names", names)?;
        of_it.set_item("count", count)?;
        of_it.set_item("value_name", setting.value_name)?;
        of_it.set_item("heading", in_python(setting.heading))?;
        of_it.set_item("help", in_python(setting.help))?;
        of_it.set_item("default", in_python(&default))?;
        Ok(of_it)
    };
    entries(function).into_iter().map(described).collect()
}

/// Looks of a kind, and those without settings, which are of every kind.
fn looks(is_wanted: impl Fn(&Look) -> bool) -> Vec<&'static str> {
    LOOKS.iter().filter(|look| is_wanted(look) || !look.has_settings()).map(|look| look.name).collect()
}

/// The names that there are of something: styles, looks, shows, backends, classes, formats of models and their endings.
#[pyfunction]
pub(crate) fn names(of: &str) -> Vec<&'static str> {
    match of {
        "style" => StyleName::of_passes().map(|(name, _)| name).collect(),
        "show" => names_of::<Show>(),
        "backend" => names_of::<Backend>(),
        "class" => names_of::<tinta::edges::Class>(),
        "look" => LOOKS.map(|look| look.name).to_vec(),
        "look of lines" => looks(|look| look.draws_lines()),
        "look of pictures" => looks(|look| !look.draws_lines()),
        "format" => Format::names(),
        "ending" => Format::ALL.iter().flat_map(|format| format.endings).copied().collect(),
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
