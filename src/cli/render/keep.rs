//! What is kept of a rendering besides the picture: its recipe in the picture, its options as a preset.

use super::super::inputs::Inputs;
use super::super::preset::{LookArguments, PresetArguments};
use super::super::standard_input;
use super::Arguments;
use std::path::{Path, PathBuf};
use tinta::gl::ContextInfo;
use tinta::preset::{Look, OptionValue, Options, to_toml};
use tinta::recipe::{self, Driver, FileRecord};
use tinta::{Error, Recipe, Result, Scene, Size, Style, StyleName, TextTarget};

#[derive(clap::Args)]
#[command(next_help_heading = "Presets")]
pub(super) struct KeepArguments {
    #[command(flatten)]
    look: LookArguments,

    #[command(flatten)]
    preset: PresetArguments,

    /// Save the options of this command line and of --preset as a preset, once the picture is drawn [default: off]
    #[arg(long, hide_short_help = true, value_name = "FILE")]
    save_preset: Option<String>,

    /// Leave out the recipe, from which `tinta again` redraws a .png or .svg, and the file names in it [default: off]
    #[arg(long, hide_short_help = true)]
    pub no_recipe: bool,
}

impl KeepArguments {
    /// What the user calls the style of a picture: the look that brought it, or its name.
    pub(super) fn said_style(&self, style: StyleName) -> String {
        let is_of = |look: &Look| {
            look.preset().is_ok_and(|preset| preset.options.get("style") == Some(&OptionValue::text(style.name())))
        };
        match self.look.look.filter(is_of) {
            Some(look) => format!("look {}", look.name),
            None => format!("style {}", style.name()),
        }
    }

    /// Where the preset goes, checked before the work.
    pub(super) fn preset_target(&self, output: &str, inputs: &Inputs) -> Result<Option<TextTarget>> {
        let Some(path) = &self.save_preset else { return Ok(None) };
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

/// The recipe of a picture of these models; `None` where it is not wanted.
pub(super) fn recipe(
    arguments: &Arguments,
    options: &Options,
    size: Size,
    files: Vec<FileRecord>,
    context: Option<&ContextInfo>,
) -> Option<Recipe> {
    (!arguments.keep.no_recipe).then(|| Recipe {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: "render".to_owned(),
        style: if context.is_some() { arguments.style_name().name().to_owned() } else { "lines".to_owned() },
        size: [size.width, size.height],
        models: arguments.models.clone(),
        options: options.clone(),
        files,
        gl: context.map(Driver::new),
    })
}

/// What is kept of a file: of standard input, too, its length and hash, by which it is known if it is ever piped in again.
fn record(path: &Path) -> Option<FileRecord> {
    match path == Path::new(standard_input::DASH) {
        true => standard_input::model().ok().map(|bytes| FileRecord::of_bytes(standard_input::DASH, &bytes)),
        false => FileRecord::of(path).ok(),
    }
}

/// The files that a picture was made of: models, what they brought with them, what the style draws with.
pub(super) fn files(
    arguments: &Arguments,
    scene: &Scene,
    beside: &[PathBuf],
    style: Option<&Style>,
) -> Vec<FileRecord> {
    if arguments.keep.no_recipe {
        return Vec::new();
    }
    let paths = recipe::files_read(&arguments.models, beside, scene, style);
    // One that has gone since it was read is left out: the picture is there, and says so by drawing otherwise.
    paths.iter().filter_map(|path| record(path)).collect()
}
