//! Values of drawings as JSON.

use crate::error::{Error, Result};
use serde::Serialize;

/// A value as JSON.
pub(super) fn json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string(value).map_err(|error| Error::Lines {
        problem: format!("the drawing cannot be written as JSON ({error}); write .svg"),
    })
}
