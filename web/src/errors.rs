//! The library's errors as the page's.

use wasm_bindgen::JsError;

/// An error of the library's: its sentence.
pub(crate) fn said(error: tinta::Error) -> JsError {
    JsError::new(&error.to_string())
}

/// An error of writing or reading JSON: the page's mistake.
pub(crate) fn unreadable(error: serde_json::Error) -> JsError {
    JsError::new(&format!("the page and the program speak differently: {error}; load the page again"))
}
