//! A list of jobs that draw each model into its own file, with the same options.

use super::super::models::refuse_missing;
use super::super::options::{CameraFile, GivenOptions, NamedLook, OfRequest, PresetFile};
use super::super::{Program, standard_input};
use super::JobOptions;
use crate::request::is_drawn_into;
use std::collections::HashMap;
use std::path::{Path, PathBuf, is_separator};
use tinta::batch::{List, Slice};
use tinta::mesh::Format;
use tinta::settings::OptionValue;
use tinta::{AnimationTarget, Error, Result};

/// The options of all drawings.
#[derive(clap::Args)]
pub(super) struct Drawing {
    #[command(flatten)]
    options: GivenOptions<OfRequest>,

    #[command(flatten)]
    look: NamedLook,

    #[command(flatten)]
    preset: PresetFile,

    #[command(flatten)]
    camera: CameraFile,
}

/// The placeholder of a model's name in an output.
const NAME: &str = "{name}";

impl Drawing {
    /// Refuses options that the lines of a list have.
    pub(super) fn refuse_for_lists(&self, output: &str) -> Result<()> {
        let Self { options, look, preset, camera } = self;
        let is_plain = options.options.is_empty() && preset.preset.is_none() && camera.camera.is_none();
        let problem = "a list names its files and the options of its drawings; give it a folder alone: -o DIR";
        match is_plain && look.look.is_none() && !output.contains(NAME) {
            true => Ok(()),
            false => Err(Error::CommandLine { problem: problem.to_owned() }),
        }
    }

    /// The list for models and folders of models, and the folder of its outputs.
    pub(super) fn list(&self, inputs: &[String], output: &str, program: &Program) -> Result<(List, PathBuf)> {
        let (folder, pattern) = places(output)?;
        // A missing file fails alone; where no file is there, perhaps a pattern matches none.
        inputs.iter().map(|input| refuse_missing(input)).reduce(Result::or).transpose()?;
        let (mut text, mut named) = (String::new(), HashMap::new());
        for model in inputs.iter().map(models).collect::<Result<Vec<_>>>()?.concat() {
            let file = pattern.replace(NAME, name(&model));
            text += &(self.job(&model, &file)? + "\n");
            if let Some(other) = named.insert(file.clone(), model.clone()) {
                let problem = format!("{other} and {model} would both be drawn into it; rename one of them");
                return Err(Error::output(folder.join(file), problem));
            }
        }
        let list = List::of_bytes(text.into_bytes(), output)?;
        let check = program.named("render").and_then(|command| command.job);
        if let (Some(job), Some(check)) = (list.jobs(Slice::WHOLE).next(), check) {
            check(&JobOptions::of(&job, &folder)?).map(drop)?;
        }
        Ok((list, folder))
    }

    /// The line of a job.
    fn job(&self, model: &str, file: &str) -> Result<String> {
        let camera = self.camera.camera.as_ref().map(|file| file.display().to_string());
        let look = self.look.look.map(|look| look.name.to_owned());
        let named = [("look", look), ("preset", self.preset.preset.clone()), ("camera", camera)];
        let named = named.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let named = named.chain([("model", model.to_owned()), ("output", file.to_owned())]);
        let mut keys = self.options.options.clone();
        keys.extend(named.map(|(name, value)| (name.to_owned(), OptionValue::Text(value))));
        serde_json::to_string(&keys).map_err(|error| Error::model(model, error.to_string()))
    }
}

/// The folder that an output names, and the files in it.
fn places(output: &str) -> Result<(PathBuf, String)> {
    let path = Path::new(output);
    let Some(place) = output.find(NAME) else {
        let is_file = is_drawn_into(output) || AnimationTarget::is_meant_by(output);
        if output == standard_input::DASH || is_file && !path.is_dir() {
            let problem = "each model is drawn into its own file; name a folder, or files such as 'pics/{name}.svg'";
            return Err(Error::output(output, problem));
        }
        return Ok((path.to_owned(), format!("{NAME}.png")));
    };
    let start = output[..place].rfind(is_separator).map_or(0, |before| before + 1);
    let folder = Path::new(if start == 0 { "." } else { &output[..start] });
    Ok((folder.to_owned(), output[start..].to_owned()))
}

/// A model's name without its folder and its ending.
fn name(model: &str) -> &str {
    let model = model.strip_prefix("builtin:").unwrap_or(model);
    Path::new(model).file_stem().and_then(|stem| stem.to_str()).unwrap_or(model)
}

/// A model, or those of a folder in the order of their names.
fn models(input: &String) -> Result<Vec<String>> {
    let path = Path::new(input);
    if !path.is_dir() {
        return Ok(vec![input.clone()]);
    }
    let files = path.read_dir().into_iter().flatten().flatten().map(|file| file.path().display().to_string());
    let mut models: Vec<String> =
        files.filter(|file| Format::of_name(file).is_some() && Path::new(file).is_file()).collect();
    models.sort();
    match models.is_empty() {
        true => Err(Error::model(input, "this folder holds no model that tinta reads; name another")),
        false => Ok(models),
    }
}
