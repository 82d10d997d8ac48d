//! The library's errors as the page's.

use tinta::Error;
use tinta::request::Request;
use tinta::settings::HasSettings;
use wasm_bindgen::JsError;

/// An error of the library's: its sentence, in the page's words.
pub(crate) fn said(error: Error) -> JsError {
    JsError::new(&match error {
        Error::Shader { path, log } if !log.contains(&path) => format!("This browser rejects the shader {path}: {log}"),
        Error::NoContext { attempts } => {
            let tried = attempts.join(", ");
            format!(
                "The styles cannot be drawn ({tried}). Turn on graphics acceleration in the browser, or use another browser."
            )
        }
        Error::Shader { log, .. } => format!("This browser rejects the shader: {log}"),
        error => in_words(&error.to_string()),
    })
}

/// A sentence with the labels of the page's fields instead of the command line's options, which stand at its beginning or after `--`.
fn in_words(sentence: &str) -> String {
    let label = |part: &str| -> Option<String> {
        let end = part.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(part.len());
        let setting = Request::table().settings.iter().find(|setting| setting.name == &part[..end])?;
        Some(format!("“{}”{}", setting.label(), &part[end..]))
    };
    let mut parts = sentence.split("--");
    let first = parts.next().unwrap_or_default();
    let mut words = label(first).unwrap_or_else(|| first.to_owned());
    for part in parts {
        words += &label(part).unwrap_or_else(|| format!("--{part}"));
    }
    words
}

/// An error of writing or reading JSON: the page's mistake.
pub(crate) fn unreadable(error: serde_json::Error) -> JsError {
    JsError::new(&format!("the page and the program speak differently: {error}; load the page again"))
}
