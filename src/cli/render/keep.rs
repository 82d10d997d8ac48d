//! The records of a rendering besides the picture: its recipe in the picture, its options as a preset. A picture that is there
//! already tells by its recipe whether it is this rendering's.

use super::super::inputs::Inputs;
use super::super::standard_input;
use super::rendering::Rendering;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use tinta::gl::ContextInfo;
use tinta::preset::{Options, to_toml};
use tinta::recipe::{Driver, FileRecord};
use tinta::request::{Request, Resolved};
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

/// Whether a picture, whose recipe this is, is whole and what this version draws of a request from the files that are there now;
/// `None` as [`Request::is_kept_in`].
pub(super) fn is_drawn(request: &Request, recipe: &Recipe, picture: &Path) -> Option<bool> {
    let is_of_now = recipe.version == env!("CARGO_PKG_VERSION") && recipe.models == request.models;
    match is_of_now && is_whole(picture) && recipe.files.iter().all(|file| is_as_then(file, picture)) {
        true => request.is_kept_in(recipe),
        false => Some(false),
    }
}

/// Whether a PNG or SVG has its end, which a copy that was broken off lacks.
fn is_whole(picture: &Path) -> bool {
    const ENDS: [&[u8]; 2] = [b"IEND\xae\x42\x60\x82", b"</svg>\n"];
    let mut end = Vec::new();
    let read = std::fs::File::open(picture).and_then(|mut file| {
        file.seek(SeekFrom::End(-8))?;
        file.read_to_end(&mut end)
    });
    read.is_ok() && ENDS.iter().any(|known| end.ends_with(known))
}

/// Whether a file that a picture was drawn from has not changed since. One that is not here, as on another machine, is not known to
/// have; one that is older than the picture is not read.
fn is_as_then(file: &FileRecord, picture: &Path) -> bool {
    let path = Path::new(&file.path);
    let Ok(now) = path.metadata() else { return true };
    let is_older = || now.modified().and_then(|now| Ok(now <= picture.metadata()?.modified()?)).unwrap_or_default();
    now.len() == file.bytes && (is_older() || record(path).is_some_and(|now| now.sha256 == file.sha256))
}
