//! The library's errors as the page's.

use tinta::Error;
use tinta::request::Request;
use tinta::settings::{HasSettings, with_mentions};
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
        // The labels of the page's fields stand for the command line's options.
        error => with_mentions(&error.with_dashes(), |_, name, rest| {
            let setting = Request::table().settings.iter().find(|setting| setting.name == name)?;
            Some(format!("“{}”{rest}", setting.label()))
        }),
    })
}

/// An error of writing or reading JSON: the page's mistake.
pub(crate) fn unreadable(error: serde_json::Error) -> JsError {
    JsError::new(&format!("the page and the program speak differently: {error}; load the page again"))
}
