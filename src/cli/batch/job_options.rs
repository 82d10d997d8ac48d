//! A job's options as its command takes them: the same that a command line gives, in the same types.

use super::super::options::{CameraFile, PresetFile};
use std::path::{Path, PathBuf};
use tinta::batch::{Job, OUTPUTS, place_in};
use tinta::choice::nearest;
use tinta::preset::Look;
use tinta::recipe::option_word;
use tinta::request::Request;
use tinta::settings::{HasSettings, OptionValue, Options};
use tinta::{Error, ParseError, Result};

/// The options of a job for its command.
#[derive(Debug)]
pub struct JobOptions {
    /// The models.
    pub models: Vec<String>,
    /// Where the output lies.
    pub output: String,
    /// All others, files that are written at their places.
    pub options: Options,
    /// In the form of a command line.
    pub command: String,
}

/// The options that every command has.
const COMMON: [&str; 3] = ["output", "preset", "camera"];

impl JobOptions {
    /// The options of a job with its outputs placed in `folder`.
    pub(super) fn of(job: &Job, folder: &Path) -> Result<Self> {
        let mut options = job.options.clone();
        for key in OUTPUTS {
            if let Some(value) = options.get_mut(key) {
                *value = placed(key, value, folder)?;
            }
        }
        let command = command(job, &options);
        let Some(OptionValue::Text(output)) = options.remove("output") else {
            return Err(Error::setting("output", "it is missing; name the file to write"));
        };
        let is_text = |name: &&str| matches!(options.get(*name), None | Some(OptionValue::Text(_)));
        if let Some(name) = ["look", "preset", "camera"].iter().find(|name| !is_text(name)) {
            return Err(Error::setting(*name, "write one name, as a text"));
        }
        if job.models.is_empty() && job.command != tinta::batch::JobCommand::Measure {
            return Err(Error::setting("model", "it is missing; name a file, or a built-in one such as builtin:bust"));
        }
        Ok(Self { models: job.models.clone(), output, options, command })
    }

    /// Refuses the first option that its command does not have.
    pub(super) fn refuse_unknown(options: &Options, command: &str, is_known: impl Fn(&str) -> bool) -> Result<()> {
        let is_known = |name: &str| COMMON.contains(&name) || is_known(name);
        let Some(key) = options.keys().find(|key| !is_known(key)) else { return Ok(()) };
        if let Some(problem) = Request::gone(key) {
            return Err(Error::setting(key, problem));
        }
        let names = Request::table().of(None).into_iter().map(|setting| setting.name).chain(COMMON);
        let names: Vec<&str> = names.filter(|name| is_known(name)).collect();
        let choice = match nearest(key, &names) {
            Some(meant) => format!("did you mean {meant}?"),
            None => format!("keys are long names of tinta {command} --help, and id, command, model"),
        };
        let shown = key.chars().take(40).collect::<String>();
        Err(Error::setting(shown, format!("there is no such option; {choice}")))
    }

    fn text(&self, option: &str) -> Option<&str> {
        self.options
            .get(option)
            .and_then(|value| if let OptionValue::Text(text) = value { Some(text.as_str()) } else { None })
    }

    /// The look that it names.
    pub(crate) fn look(&self) -> Result<Option<Look>> {
        let look = self.text("look").map(|name| (name, Look::of_name(name)));
        look.map(|(name, look)| look.map_err(|ParseError(problem)| Error::value("look", name, problem))).transpose()
    }

    /// The preset that it names.
    pub fn preset(&self) -> PresetFile {
        PresetFile { preset: self.text("preset").map(str::to_owned) }
    }

    /// The file with a camera that it names.
    pub fn camera(&self) -> CameraFile {
        CameraFile { camera: self.text("camera").map(PathBuf::from) }
    }
}

/// A file that the job writes, at its place.
fn placed(key: &str, value: &OptionValue, folder: &Path) -> Result<OptionValue> {
    let refuse = |problem: String| Error::setting(key, problem);
    let OptionValue::Text(output) = value else {
        return Err(refuse("write the name of a file, as a text".to_owned()));
    };
    let place = place_in(folder, output).map_err(|problem| refuse(format!("{output}: {problem}")))?;
    Ok(OptionValue::text(place.to_string_lossy()))
}

/// The command line that would do the same.
fn command(job: &Job, options: &Options) -> String {
    let name = job.command.to_string();
    let words = options.iter().filter_map(|(name, value)| option_word(name, value));
    tinta::shell::command_line([name].into_iter().chain(words).chain(["--".to_owned()]).chain(job.models.clone()))
}
