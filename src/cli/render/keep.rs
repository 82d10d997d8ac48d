//! The records of a rendering besides the picture: its recipe in the picture, its options as a preset.

use super::super::inputs::Inputs;
use super::super::standard_input;
use super::rendering::Rendering;
use std::path::{Path, PathBuf};
use tinta::gl::ContextInfo;
use tinta::preset::{Options, to_toml};
use tinta::recipe::{Driver, FileRecord};
use tinta::request::Resolved;
use tinta::{Error, Recipe, Result, TextTarget};

/// Where the preset goes, checked before the work.
pub(super) fn preset_target(path: Option<&str>, output: &str, inputs: &Inputs) -> Result<Option<TextTarget>> {
    let Some(path) = path else { return Ok(None) };
    let refuse = |problem: &str| Err(Error::value("save-preset", path, problem));
    if path.is_empty() {
        return refuse("a preset is a file; name one");
    }
    inputs.keep(path)?;
    match TextTarget::check(path)? {
        TextTarget::Stdout => refuse("a preset is a file; name one"),
        TextTarget::File(_) if path == output => refuse("this is the picture's file; name another"),
        target => Ok(Some(target)),
    }
}

/// Writes the options as a preset.
pub(super) fn save_preset(target: &TextTarget, options: &Options) -> Result<()> {
    let comment = format!(
        "A preset of tinta {}: options by their long names; any of them may be left out.\n\
         tinta render MODEL -o picture.png --preset THIS-FILE",
        env!("CARGO_PKG_VERSION")
    );
    target.write(&to_toml(options, &comment))
}

/// The recipe of a picture, or of lines if no context is given; `None` if not requested.
pub(super) fn recipe(
    rendering: &Rendering<'_>,
    resolved: &Resolved,
    beside: &[PathBuf],
    context: Option<&ContextInfo>,
) -> Option<Recipe> {
    let recipe = || resolved.request.recipe(&resolved.scene, beside, context.map(Driver::new), record);
    (!rendering.run.no_recipe).then(recipe)
}

/// A file's record. Standard input is recorded too, by length and hash, to recognise the same data later.
fn record(path: &Path) -> Option<FileRecord> {
    match path == Path::new(standard_input::DASH) {
        true => standard_input::model().ok().map(|bytes| FileRecord::of_bytes(standard_input::DASH, &bytes)),
        false => FileRecord::of(path).ok(),
    }
}
