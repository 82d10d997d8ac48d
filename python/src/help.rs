//! The settings of a function as its help lists them.

use crate::errors::{in_python, python_name};
use crate::request::{Basis, asked};
use crate::settings::{Entry, entries};
use pyo3::prelude::*;
use tinta::settings::{Kind, OptionValue, Options};

/// The settings of a function under their headings, each with its default, and with that of the look that is drawn by default.
#[pyfunction]
pub(crate) fn documentation(function: &str) -> String {
    let look = match function {
        "render" => {
            asked(function, Options::new(), &Basis::default()).map(|request| request.options).unwrap_or_default()
        }
        _ => Options::new(),
    };
    let of_look = |name: &str, default: &str| match look.get(name) {
        Some(OptionValue::Text(text)) if text != default => format!("; the look print: {text}"),
        Some(OptionValue::Switch(is_on)) => format!("; the look print: {is_on}"),
        _ => String::new(),
    };
    let mut text = String::new();
    let mut heading = "";
    for Entry { setting, default } in entries(function) {
        if setting.heading != heading {
            heading = setting.heading;
            text.push_str(&format!("\n{}\n", in_python(heading)));
        }
        let value = match setting.kind {
            Kind::Switch | Kind::Flag => "True or False".to_owned(),
            _ => setting.value_name.to_owned(),
        };
        let default = format!("{default}{}", of_look(setting.name, &default));
        text.push_str(&format!("  {} : {value}\n", python_name(setting.name)));
        text.push_str(&format!("      {} [default: {}]\n", in_python(setting.help), in_python(&default)));
    }
    text
}
