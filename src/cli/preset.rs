//! `--preset` and `--look`: a file's options put before those of the command line, so that clap reads and checks both alike. A
//! preset's beat a look's.
//!
//! The words are read twice: once as given, to know the preset and what else is given; then with the preset's options before
//! them. An option given on the command line beats the preset's, and so does one that excludes it.

use super::Arguments;
use super::camera_file;
use super::inputs::Inputs;
#[cfg(feature = "measuring")]
use super::measure::StyleOptions;
use super::mistakes::{meant_option, sentence};
#[cfg(feature = "measuring")]
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, FromArgMatches};
use std::ffi::OsString;
use std::path::PathBuf;
use tinta::camera;
use tinta::preset::{LOOKS, Look, OptionValue, Options, Preset};
use tinta::settings::{HasSettings, ON_OFF};
use tinta::styles::is_ignored;
use tinta::{Error, Result, Style};

#[derive(clap::Args)]
#[command(next_help_heading = "Presets")]
pub(super) struct PresetArguments {
    /// Read options from this TOML file, under their long names, or a paper's constants: paper:evangelista-three-pass, paper:evangelista-two-pass, paper:dachsbacher-inking, paper:valente-charcoal, paper:valente-sand; the command line overrides it [default: none]
    #[arg(long, value_name = "FILE")]
    preset: Option<String>,
}

#[derive(clap::Args)]
pub(super) struct LookArguments {
    #[arg(long, value_name = "LOOK", value_parser = Look::of_name, help = format!(
        "What the picture looks like: {}; a preset and every option override it [default: {}, unless a style or preset is given, \
         or lines are drawn]",
        Look::list(), LOOKS[0].name
    ))]
    pub look: Option<Look>,
}

/// Options that say what is done with a picture, not which picture it is: they are in no preset and no recipe.
const OF_ONE_RUN: [&str; 22] = [
    "camera",
    "dump",
    "explain",
    "frames",
    "help",
    "json",
    "look",
    "machine",
    "merge",
    "no-recipe",
    "output",
    "partial",
    "preset",
    "quick",
    "resume",
    "save-preset",
    "styles",
    "submission",
    "suite",
    "tolerance",
    "verify",
    "within",
];

/// What a command line gives, its preset's options among it.
#[derive(Default)]
pub(super) struct Given {
    /// The words after the program's name, a preset's among them.
    pub words: Vec<String>,
    /// The words after the program's name as they were given.
    pub as_given: Vec<String>,
    /// The options that make the picture.
    pub options: Options,
    /// Words for a style and its settings, which `measure` measures besides.
    #[cfg_attr(not(feature = "measuring"), expect(dead_code, reason = "only measuring reads it"))]
    pub setting: Vec<String>,
    preset: Option<Preset>,
    /// The preset's options that count: name on the command line and in the file.
    used: Vec<(String, String)>,
}

impl Given {
    /// What the command reads.
    pub(super) fn inputs(&self, models: &[String]) -> Inputs {
        let presets = self.preset.as_ref().map(Preset::names).unwrap_or_default();
        Inputs::new(models, &self.options, &presets)
    }

    /// An error about an option that the preset gave, with the preset's name and line.
    pub(super) fn attributed(&self, error: Error) -> Error {
        match (&self.preset, &error) {
            (Some(preset), Error::Setting { .. } | Error::Settings { .. }) => preset.attributed(error, &self.used),
            _ => error,
        }
    }
}

/// Reads a command line, and the preset it names.
pub(super) fn parse(words: Vec<OsString>) -> std::result::Result<(Arguments, Given), Stop> {
    let mut whole = super::help::command(&words);
    let matches = whole.try_get_matches_from_mut(&words).map_err(|error| refused(error, &whole, &words))?;
    let texts = |words: &[OsString]| words.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let as_given = texts(&words);
    let (mut given, words) = match Merge::of(&whole, &matches)? {
        None => (Given::default(), words),
        Some(merge) => merge.merged(&whole, &words)?,
    };
    let matches = whole.try_get_matches_from_mut(&words).map_err(|error| refused(error, &whole, &words))?;
    if let Some((name, matches)) = matches.subcommand()
        && let Some(command) = whole.find_subcommand(name)
    {
        given.options = kept_options(command, matches);
    }
    (given.words, given.as_given) = (texts(&words), as_given);
    let arguments = Arguments::from_arg_matches(&matches).map_err(|error| refused(error, &whole, &words))?;
    Ok((arguments, given))
}

/// Why a command line is not carried out.
#[derive(Debug)]
pub(crate) enum Stop {
    /// Help or the version was asked for: this is it.
    Help(clap::Error),
    /// It is wrong.
    Wrong(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Wrong(error)
    }
}

/// What to say of words that `whole` does not read.
fn refused(error: clap::Error, whole: &Command, words: &[OsString]) -> Stop {
    use ErrorKind::{DisplayHelp, DisplayHelpOnMissingArgumentOrSubcommand, DisplayVersion};
    match error.kind() {
        DisplayHelp | DisplayVersion | DisplayHelpOnMissingArgumentOrSubcommand => Stop::Help(error),
        _ => Stop::Wrong(Error::CommandLine { problem: sentence(&error, whole, words) }),
    }
}

/// A preset on its way into a command line.
struct Merge<'a> {
    preset: Preset,
    /// What of it is a look's: an option that a command does not have is left out.
    of_look: Vec<String>,
    name: &'a str,
    command: &'a Command,
    /// What the command line gives by itself.
    given: &'a ArgMatches,
}

/// An option of the preset as words.
struct Words<'a> {
    arg: &'a Arg,
    key: String,
    words: Vec<OsString>,
}

impl<'a> Merge<'a> {
    /// Reads the preset and the look that are named, if one is, or the look of who asks for nothing.
    fn of(whole: &'a Command, matches: &'a ArgMatches) -> Result<Option<Self>> {
        let Some((name, given)) = matches.subcommand() else { return Ok(None) };
        let Some(command) = whole.find_subcommand(name) else { return Ok(None) };
        let file = given.try_get_one::<String>("preset").ok().flatten();
        // Whether a command has an option its matches tell in debug builds only.
        let has_looks = long(command, "look").is_some();
        let look = if has_looks { given.try_get_one::<Look>("look").ok().flatten().copied() } else { None };
        let preset = file.map(|file| Preset::read(file)).transpose()?;
        let look = match look {
            None if has_looks && preset.is_none() && has_default_look(given) => Some(LOOKS[0]),
            look => look,
        };
        let look = look.map(Look::preset).transpose()?;
        let is_of_look = |key: &&String| !preset.as_ref().is_some_and(|preset| preset.options.contains_key(*key));
        let of_look = look.iter().flat_map(|look| look.options.keys()).filter(is_of_look).cloned().collect();
        let preset = match (preset, look) {
            (Some(preset), Some(look)) => Some(preset.over(look)),
            (preset, look) => preset.or(look),
        };
        let camera = given.try_get_one::<PathBuf>("camera").ok().flatten();
        let camera = camera.map(|file| camera_file::read(file)).transpose()?;
        let preset = match (camera, preset) {
            (Some(camera), Some(preset)) => camera.over(preset.without(camera::HEADING)),
            (camera, preset) => match camera.or(preset) {
                Some(preset) => preset,
                None => return Ok(None),
            },
        };
        Ok(Some(Self { preset, of_look, name, command, given }))
    }

    /// The command line with the preset's options.
    fn merged(self, whole: &Command, words: &[OsString]) -> Result<(Given, Vec<OsString>)> {
        #[cfg(feature = "measuring")]
        let of_styles = StyleOptions::command();
        #[cfg(not(feature = "measuring"))]
        let of_styles = Command::new("tinta");
        let (mut own, mut setting, mut used) = (Vec::new(), Vec::new(), Vec::new());
        for (key, value) in &self.preset.options {
            // The style of a comparison is the one on the left.
            let option = if self.name == "compare" && key == "style" { "left" } else { key };
            let find = |command: &'a Command| command.get_arguments().find(|arg| arg.get_long() == Some(option));
            if self.of_look.contains(key) && self.is_of_another_style(option) {
                continue;
            }
            if !is_kept(option) {
                let problem = "this applies to one run and cannot be in a preset; give it on the command line";
                return Err(self.preset.refuse(key, format!("{key}: {problem}")));
            }
            if let Some(arg) = find(self.command) {
                own.push(Words { arg, key: key.clone(), words: self.words(arg, key, value)? });
            } else if let (true, Some(arg)) = (self.name == "measure", long(&of_styles, option)) {
                setting.extend(self.words(arg, key, value)?);
            } else if self.of_look.contains(key) {
                continue;
            } else {
                return Err(self.unknown(whole, key));
            }
            used.push((option.to_owned(), key.clone()));
        }
        let head = words.iter().take(2);
        let all = head.clone().chain(own.iter().flat_map(|option| &option.words));
        self.check(whole.clone(), all)?;
        if !setting.is_empty() {
            let program = OsString::from("tinta");
            self.check(of_styles.clone(), [&program].into_iter().chain(&setting))?;
        }
        let left: Vec<&Words<'_>> = own.iter().filter(|option| !self.is_beaten(option.arg)).collect();
        let beaten = |key: &String| own.iter().any(|option| option.key == *key && self.is_beaten(option.arg));
        used.retain(|(_, key)| !beaten(key));
        let words =
            head.chain(left.iter().flat_map(|option| &option.words)).chain(words.iter().skip(2)).cloned().collect();
        let setting = setting.iter().map(|word| word.to_string_lossy().into_owned()).collect();
        Ok((Given { setting, preset: Some(self.preset), used, ..Given::default() }, words))
    }

    /// Whether a picture in the style that is drawn has no use for this option.
    fn is_of_another_style(&self, option: &str) -> bool {
        let given = self.given.try_get_raw("style").ok().flatten().and_then(|mut words| words.next());
        let style = match (given, self.preset.options.get("style")) {
            (Some(word), _) => word.to_string_lossy().into_owned(),
            (None, Some(OptionValue::Text(style))) => style.clone(),
            _ => return false,
        };
        self.name == "render" && is_ignored(option, &[&style])
    }

    fn words(&self, arg: &Arg, key: &str, value: &OptionValue) -> Result<Vec<OsString>> {
        words_of(arg, value).map_err(|problem| self.preset.refuse(key, format!("{key}: {problem}")))
    }

    /// Refuses values that an option refuses, and options that exclude each other, with the preset's line.
    fn check<'w>(&self, mut command: Command, words: impl Iterator<Item = &'w OsString>) -> Result<()> {
        let words: Vec<OsString> = words.cloned().collect();
        let error = match command.try_get_matches_from_mut(&words) {
            Err(error) if error.kind() != ErrorKind::MissingRequiredArgument => error,
            _ => return Ok(()),
        };
        let named = match error.get(ContextKind::InvalidArg) {
            Some(ContextValue::String(arg)) => arg.split([' ', '=']).next().unwrap_or_default().to_owned(),
            _ => String::new(),
        };
        let key = named.trim_start_matches('-');
        let key = if self.name == "compare" && key == "left" { "style" } else { key };
        Err(self.preset.refuse(key, sentence(&error, &command, &words)))
    }

    /// Whether the command line gives this option itself, or one that excludes it.
    fn is_beaten(&self, arg: &Arg) -> bool {
        let is_given = |arg: &Arg| self.given.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
        let excludes = |one: &Arg, other: &Arg| {
            self.command.get_arg_conflicts_with(one).iter().any(|excluded| excluded.get_id() == other.get_id())
        };
        let mut all = self.command.get_arguments().filter(|other| is_given(other));
        all.any(|other| other.get_id() == arg.get_id() || excludes(other, arg) || excludes(arg, other))
    }

    fn unknown(&self, whole: &Command, key: &str) -> Error {
        let is_renders = whole.find_subcommand("render").is_some_and(|render| long(render, key).is_some());
        let problem = match is_renders {
            true => {
                format!("{key}: tinta {} does not have this option, only tinta render does; leave it out", self.name)
            }
            false => match meant_option(self.command, key) {
                Some(meant) => format!("{key}: there is no option --{key}; did you mean {meant}?"),
                None => format!("{key}: there is no option --{key}; see tinta {} --help", self.name),
            },
        };
        self.preset.refuse(key, problem)
    }
}

/// Whether nothing is asked for that has a look of its own: a style, or lines by their file's name.
fn has_default_look(given: &ArgMatches) -> bool {
    let has_style = given.value_source("style") == Some(ValueSource::CommandLine);
    let output = given.try_get_one::<String>("output").ok().flatten();
    !has_style && !output.is_some_and(|output| super::render::is_of_lines(output))
}

/// An option's words: what a switch is, the option itself knows. The error says what is wrong with the value.
pub(super) fn words_of(arg: &Arg, value: &OptionValue) -> std::result::Result<Vec<OsString>, String> {
    let takes_value = arg.get_action().takes_values();
    let may_stand_alone = !takes_value || arg.get_num_args().is_some_and(|count| count.min_values() == 0);
    let name = arg.get_long().unwrap_or_default();
    let is_on_off = arg.get_value_names().is_some_and(|names| names.iter().any(|name| name.as_str() == ON_OFF));
    match value {
        OptionValue::Text(value) if takes_value => Ok(vec![format!("--{name}={value}").into()]),
        OptionValue::Texts(values) if takes_value => Ok(vec![format!("--{name}={}", values.join(",")).into()]),
        OptionValue::Text(_) | OptionValue::Texts(_) => Err("write true or false, without quotes".to_owned()),
        OptionValue::Switch(switch) if is_on_off => {
            Ok(vec![format!("--{name}={}", if *switch { "on" } else { "off" }).into()])
        }
        OptionValue::Switch(true) if may_stand_alone => Ok(vec![format!("--{name}").into()]),
        OptionValue::Switch(false) if may_stand_alone => Ok(Vec::new()),
        OptionValue::Switch(_) => {
            let values = arg.get_value_names().unwrap_or_default().join(" ");
            Err(format!("this takes a value ({values}), not true or false"))
        }
    }
}

fn long<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    command.get_arguments().find(|arg| arg.get_long() == Some(name))
}

/// Whether a preset or recipe may hold this option, if there is one of this name.
pub(super) fn is_kept(option: &str) -> bool {
    !OF_ONE_RUN.contains(&option)
}

/// A value as it is written now, for what is kept is read by versions to come.
fn present(option: &str, value: String) -> String {
    let mut settings = Style::table().settings.iter();
    settings.find(|setting| setting.name == option).map_or(value.clone(), |setting| setting.present(&value).to_owned())
}

/// The options given that make the picture, as a preset or recipe keeps them.
fn kept_options(command: &Command, matches: &ArgMatches) -> Options {
    let mut options = Options::new();
    for arg in command.get_arguments() {
        let (Some(name), id) = (arg.get_long(), arg.get_id().as_str()) else { continue };
        if !is_kept(name) || matches.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let texts: Vec<String> =
            matches.get_raw(id).into_iter().flatten().map(|raw| raw.to_string_lossy().into_owned()).collect();
        let value = present(name, texts.join(","));
        let is_switch = !arg.get_action().takes_values() || value.is_empty();
        options.insert(name.to_owned(), if is_switch { OptionValue::Switch(true) } else { OptionValue::Text(value) });
    }
    options
}
