//! Options that more than one command takes: loops over the tables of settings.
//!
//! Name, values, help and default of each are declared beside the struct it sets, see `tinta::settings`. This module holds
//! everything else: which settings a command has, and paths that are not text.

#[cfg(test)]
mod tests;

use super::camera_file;
use super::groups::{groups, in_groups};
pub use super::selection::Selection;
use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches, parser::ValueSource};
use std::ffi::OsStr;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use tinta::camera;
use tinta::error::ParseError;
use tinta::preset::{LOOKS, Look, Preset};
use tinta::request::{OptionLayer, Request, layers};
use tinta::settings::{HasSettings, Kind, OptionValue, Options, Setting, Table};
use tinta::{LoadOptions, Result};

/// The given options of a selection on the command line.
#[derive(Debug)]
pub struct GivenOptions<S> {
    /// By name, as in a preset.
    pub options: Options,
    selection: PhantomData<S>,
}

impl<S: Selection> GivenOptions<S> {
    fn all() -> impl Iterator<Item = &'static Setting<S::Of>> {
        S::Of::table().of(None).into_iter().filter(|setting| S::has(setting))
    }

    /// The options of this selection, for a command that is not called by words.
    pub fn of_options(options: &Options) -> Self {
        let options = options.iter().filter(|(name, _)| Self::all().any(|setting| setting.name == **name));
        let options = options.map(|(name, value)| (name.clone(), value.clone())).collect();
        Self { options, selection: PhantomData }
    }

    /// Whether it has an option of this name.
    pub fn has(option: &str) -> bool {
        Self::all().any(|setting| setting.name == option)
    }

    /// The given options as settings.
    pub fn settings(&self) -> Result<S::Of>
    where
        S::Of: Default,
    {
        S::Of::from_options(&self.options)
    }
}

/// The option of a setting.
fn arg<T: Clone + Send + Sync + 'static>(table: &'static Table<T>, setting: &'static Setting<T>) -> Arg {
    let default = setting.said_default.map_or_else(|| table.default_of(setting), str::to_owned);
    let arg = Arg::new(setting.name)
        .long(setting.name)
        .help(in_groups(&format!("{} [default: {default}]", setting.help)))
        .hide_short_help(!setting.is_common);
    if setting.kind == Kind::Flag {
        return arg.action(ArgAction::SetTrue);
    }
    let action = if setting.between.is_some() { ArgAction::Append } else { ArgAction::Set };
    let arg = arg.action(action).value_name(setting.value_name);
    let arg = match setting.stands_alone {
        true => arg.num_args(0..=1).require_equals(true).default_missing_value(""),
        false => arg,
    };
    // Parsing refuses only invalid values; the setting's owner is known later.
    let check = move |text: &str| match table.check(setting.name, text) {
        Err(_) if setting.name == "style" && Look::of_name(text).is_ok() => {
            Err(format!("this is a look; write --look {text}"))
        }
        checked => checked.map(|()| text.to_owned()),
    };
    match &setting.kind {
        Kind::Numbers { .. } | Kind::Text { .. } | Kind::Color | Kind::Colors { .. } => {
            arg.value_parser(check).allow_hyphen_values(true)
        }
        Kind::Choice(names) if names.iter().any(|name| name.starts_with('-')) => {
            arg.value_parser(check).allow_hyphen_values(true)
        }
        _ => arg.value_parser(check),
    }
}

/// The word against a switch that a look turns on; `None` for a setting with a value, and for one that leaves something out.
fn off_word<T>(setting: &Setting<T>) -> Option<String> {
    (setting.kind == Kind::Flag && !setting.name.starts_with("no-")).then(|| format!("no-{}", setting.name))
}

/// A command with a table's settings among its options.
pub(super) fn with_settings<T: Clone + Send + Sync + 'static>(
    command: Command,
    table: &'static Table<T>,
    settings: impl Iterator<Item = &'static Setting<T>>,
    has_headings: bool,
) -> Command {
    groups(settings).iter().fold(command, |command, group| {
        let arg = match group.plain.filter(|_| group.inside.is_empty()) {
            Some(setting) => arg(table, setting),
            None => group.arg(table),
        };
        let heading = group.heading();
        let command = command.arg(arg.help_heading((has_headings && !heading.is_empty()).then_some(heading)));
        let off = |command: Command, off: String| {
            command.arg(Arg::new(off.clone()).long(off).hide(true).action(ArgAction::SetTrue))
        };
        group.settings().filter_map(off_word).fold(command, off)
    })
}

impl<S: Selection> clap::Args for GivenOptions<S> {
    fn augment_args(command: Command) -> Command {
        with_settings(command, S::Of::table(), Self::all(), S::HAS_HEADINGS)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: Selection> FromArgMatches for GivenOptions<S> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let mut chosen = Self { options: Options::new(), selection: PhantomData };
        for group in groups(Self::all()).iter().filter(|group| !group.inside.is_empty()) {
            let given = matches.value_source(group.name) == Some(ValueSource::CommandLine);
            for text in matches.get_many::<String>(group.name).into_iter().flatten().filter(|_| given) {
                for (name, value) in group.split(text).unwrap_or_default() {
                    let between = group.settings().find(|setting| setting.name == name).and_then(|it| it.between);
                    match (chosen.options.get_mut(name), value, between) {
                        (None, value, _) => drop(chosen.options.insert(name.to_owned(), value)),
                        (Some(OptionValue::Text(before)), OptionValue::Text(more), Some(between)) => {
                            *before += &[between, &more].concat();
                        }
                        _ => {
                            let problem = format!("--{name}: it is given twice; leave one of them out");
                            return Err(clap::Error::raw(ErrorKind::ArgumentConflict, problem));
                        }
                    }
                }
            }
        }
        let is_alone = |setting: &&Setting<S::Of>| {
            setting.group.is_none() && !Self::all().any(|other| other.group == Some(setting.name))
        };
        for setting in Self::all() {
            if off_word(setting).is_some_and(|off| matches.value_source(&off) == Some(ValueSource::CommandLine)) {
                chosen.options.insert(setting.name.to_owned(), OptionValue::Switch(false));
                continue;
            }
            if !is_alone(&setting) || matches.value_source(setting.name) != Some(ValueSource::CommandLine) {
                continue;
            }
            let between = OsStr::new(setting.between.unwrap_or_default());
            let raw: Vec<&OsStr> = matches.get_raw(setting.name).into_iter().flatten().collect();
            let text = raw.join(between).to_string_lossy().into_owned();
            let value = match text.is_empty() && setting.stands_alone || setting.kind == Kind::Flag {
                true => OptionValue::Switch(true),
                false => OptionValue::Text(text),
            };
            chosen.options.insert(setting.name.to_owned(), value);
        }
        Ok(chosen)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// All that makes a drawing.
pub(super) struct OfRequest;

impl Selection for OfRequest {
    type Of = Request;
}

/// A model and its view.
#[derive(Debug)]
pub struct OfSubject;

impl Selection for OfSubject {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        setting.heading == camera::HEADING || LoadOptions::table().has(setting.name)
    }
}

/// `--camera`.
#[derive(Debug, clap::Args, Default)]
#[command(next_help_heading = camera::HEADING)]
pub struct CameraFile {
    /// Read the camera from this file: the JSON that --json prints, a picture that tinta drew, a glTF or GLB model, or the 16 numbers of the matrix from world to clip space, row by row; other camera options override it [default: none]
    #[arg(id = "camera", long, hide_short_help = true, value_name = "FILE")]
    pub camera: Option<PathBuf>,
}

/// `--preset`.
#[derive(Debug, clap::Args, Default)]
#[command(next_help_heading = "Presets")]
pub struct PresetFile {
    /// Read options from this TOML file, or a paper's constants: paper:evangelista-three-pass, paper:evangelista-two-pass, paper:dachsbacher-inking, paper:valente-charcoal-in-part, paper:valente-sand-in-part; the command line overrides it [default: none]
    #[arg(long, value_name = "FILE")]
    pub preset: Option<String>,
}

/// `--look`.
#[derive(clap::Args, Default)]
pub(super) struct NamedLook {
    #[arg(long, value_name = "LOOK", value_parser = Look::of_name, help = format!(
        "Appearance of the picture: {}; a preset and every other option override it [default: {}; published \
         if a style or preset is given, and into files of lines such as .dxf]",
        Look::list(), LOOKS[0].name
    ))]
    pub look: Option<Look>,
}

/// `--look` of `tinta render`.
#[derive(clap::Args, Default)]
pub(super) struct NamedLooks {
    #[arg(id = "look", long, value_name = "LOOK", value_parser = Looks::of_name, help = format!(
        "Appearance of the picture: {}; all: a picture in each, into the folder of --output; a preset and every other option \
         override it [default: {}; published if a style or preset is given, and into files of lines such as .dxf]",
        Look::list(), LOOKS[0].name
    ))]
    pub looks: Option<Looks>,
}

/// A look, or all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Looks {
    One(Look),
    All,
}

impl Looks {
    fn of_name(name: &str) -> std::result::Result<Self, ParseError> {
        if name == "all" { Ok(Self::All) } else { Look::of_name(name).map(Self::One) }
    }

    /// `None` for all.
    pub(super) fn one(self) -> Option<Look> {
        if let Self::One(look) = self { Some(look) } else { None }
    }
}

/// The layers below the options of a command line.
#[derive(Debug, Default)]
pub struct Below<'a> {
    pub look: Option<Look>,
    pub preset: Option<&'a str>,
    pub camera: Option<&'a Path>,
    /// Whether the output's name requests lines.
    pub draws_lines: bool,
    /// Whether the command has looks, with the first as the default.
    pub has_looks: bool,
    /// The command, for errors about a preset.
    pub command: &'static str,
}

impl<S: Selection<Of = Request>> GivenOptions<S> {
    /// Returns the request made by these options, and the options without effect.
    pub fn request(&self, models: &[String], below: &Below<'_>) -> Result<(Request, Vec<String>)> {
        let preset = below.preset.map(Preset::read).transpose()?;
        if let Some(preset) = &preset {
            // The style of a comparison is the one on the left.
            refuse_of_other_commands(preset, below.command, |key| key == "style" || Self::has(key))?;
        }
        let files: Vec<Preset> = preset.into_iter().collect();
        let layers = match below.has_looks {
            true => layers(below.look, files, self.options.clone(), below.draws_lines),
            false => {
                files.into_iter().map(OptionLayer::File).chain([OptionLayer::Given(self.options.clone())]).collect()
            }
        };
        self.request_of(layers, models, below)
    }

    /// The request that these options make over layers.
    pub fn request_over(
        &self,
        mut layers: Vec<OptionLayer>,
        models: &[String],
        below: &Below<'_>,
    ) -> Result<(Request, Vec<String>)> {
        layers.push(OptionLayer::Given(self.options.clone()));
        self.request_of(layers, models, below)
    }

    fn request_of(
        &self,
        mut layers: Vec<OptionLayer>,
        models: &[String],
        below: &Below<'_>,
    ) -> Result<(Request, Vec<String>)> {
        let mut aspect = None;
        if let Some(path) = below.camera {
            let (camera, of_file) = camera_file::read(path)?;
            layers.insert(layers.len() - 1, OptionLayer::Camera(camera));
            aspect = of_file.map(|aspect| (path, aspect));
        }
        let (request, mut remarks) = Request::from_layers(&layers)?;
        remarks.extend(aspect.and_then(|(path, aspect)| camera_file::aspect_remark(path, aspect, request.scene.size)));
        Ok((request.with_models(models.to_vec()), remarks))
    }
}

/// Refuses options of a preset that a command does not have.
pub fn refuse_of_other_commands(preset: &Preset, command: &str, has: impl Fn(&str) -> bool) -> Result<()> {
    match preset.options.keys().find(|key| !has(key)) {
        Some(key) if Request::table().has(key) => {
            let problem =
                format!("{key}: tinta {command} does not have this option, only tinta render does; leave it out");
            Err(preset.refuse(key, problem))
        }
        Some(key) if OF_ONE_RUN.contains(&key.as_str()) || super::run_settings::is_of_one_run(key) => {
            let problem = "this applies to one run and cannot be in a preset; give it on the command line";
            Err(preset.refuse(key, format!("{key}: {problem}")))
        }
        _ => Ok(()),
    }
}

/// Options that presets do not hold, because they name a preset or a file.
const OF_ONE_RUN: [&str; 4] = ["camera", "look", "output", "preset"];
