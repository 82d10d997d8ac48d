//! Turns a job into command-line arguments, so that the usual parser reads and checks its options.

use super::super::help;
use super::super::mistakes::meant_option;
use super::super::preset::words_of;
use clap::{Arg, ArgAction, Command};
use std::ffi::OsString;
use std::path::Path;
use tinta::batch::{Job, OUTPUTS, place_in};
use tinta::preset::OptionValue;
use tinta::{Error, Result};

/// The command line of a job whose outputs lie in `folder`.
pub(super) fn argv(job: &Job, folder: &Path) -> Result<Vec<OsString>> {
    let whole = help::whole();
    let name = job.command.name();
    let refuse = |key: &str, problem: String| Error::setting(key, problem);
    let command = whole
        .find_subcommand(name)
        .ok_or_else(|| refuse("command", "there is no such command; see tinta --help".to_owned()))?;
    let mut words: Vec<OsString> = ["tinta", name].map(OsString::from).to_vec();
    for (key, value) in &job.options {
        let arg = command.get_arguments().find(|arg| arg.get_long() == Some(key));
        let arg = arg.ok_or_else(|| unknown(command, key))?;
        for value in values(arg, key, value, folder)? {
            words.extend(words_of(arg, &value).map_err(|problem| refuse(key, problem))?);
        }
    }
    words.push("--".into());
    words.extend(job.models.iter().map(OsString::from));
    Ok(words)
}

fn unknown(command: &Command, key: &str) -> Error {
    let name = command.get_name();
    // Long ones are no options anyway.
    let choice = match meant_option(command, key) {
        Some(meant) => format!("did you mean {meant}?"),
        None => format!("keys are long names of tinta {name} --help, and id, command, model"),
    };
    Error::setting(key.chars().take(40).collect::<String>(), format!("there is no such option; {choice}"))
}

/// The values of an option: as many as are given where it may be repeated, otherwise one, with commas in it.
fn values(arg: &Arg, key: &str, value: &OptionValue, folder: &Path) -> Result<Vec<OptionValue>> {
    let is_repeated = matches!(arg.get_action(), ArgAction::Append) && arg.get_value_delimiter().is_none();
    if OUTPUTS.contains(&key) {
        let refuse = |problem: String| Error::setting(key, problem);
        let OptionValue::Text(output) = value else {
            return Err(refuse("write the name of a file, as a text".to_owned()));
        };
        let place = place_in(folder, output).map_err(|problem| refuse(format!("{output}: {problem}")))?;
        return Ok(vec![OptionValue::text(place.to_string_lossy())]);
    }
    Ok(match value {
        OptionValue::Texts(texts) if is_repeated => texts.iter().map(OptionValue::text).collect(),
        value => vec![value.clone()],
    })
}
