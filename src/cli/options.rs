//! Options that more than one command takes: loops over the tables of settings.
//!
//! Name, values, help and default of each are declared beside the struct it sets, see `tinta::settings`. What is no setting
//! of a struct stands here: which settings a command has, which exclude each other, paths that are no text.

pub(super) mod ignored;
#[cfg(test)]
mod tests;

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches, parser::ValueSource};
use std::ffi::OsString;
use std::marker::PhantomData;
use std::path::PathBuf;
use tinta::camera;
use tinta::settings::{EXCLUSIVE, HasSettings, Kind, OptionValue, Options, Setting, Table};
use tinta::styles::{Ramp, TextureSource};
use tinta::{
    CameraSettings, Error, LineSettings, LoadOptions, Result, SceneSettings, Show, Style, StyleName, SvgSettings,
};

/// Some of a table's settings as options.
pub(super) trait Selection {
    /// Whose settings.
    type Of: HasSettings;

    /// Whether they are listed under headings of their own.
    const HAS_HEADINGS: bool = true;

    /// Whether this is one of them.
    fn has(_setting: &Setting<Self::Of>) -> bool {
        true
    }
}

/// What is given of a selection on the command line.
pub(super) struct Chosen<S> {
    /// By name, as a preset has it.
    pub options: Options,
    /// Files whose paths are no text, which options cannot hold.
    paths: Vec<(&'static str, PathBuf)>,
    selection: PhantomData<S>,
}

impl<S: Selection> Chosen<S> {
    fn all() -> impl Iterator<Item = &'static Setting<S::Of>> {
        S::Of::table().of(None).into_iter().filter(|setting| S::has(setting))
    }

    /// Refuses the first of them that is given.
    pub(super) fn refuse(&self, problem: &str) -> Result<()> {
        self.refuse_but("", problem)
    }

    /// Refuses the first of them that is given and is not this one.
    pub(super) fn refuse_but(&self, taken: &str, problem: &str) -> Result<()> {
        let is_given = |name| name != taken && self.options.contains_key(name);
        match Self::all().find(|setting| is_given(setting.name)) {
            Some(setting) => Err(Error::setting(setting.name, problem)),
            None => Ok(()),
        }
    }

    fn is_on(&self, flag: &str) -> bool {
        self.options.get(flag) == Some(&OptionValue::Switch(true))
    }
}

/// The option of a setting.
fn arg<T: Clone + Send + Sync + 'static>(table: &'static Table<T>, setting: &'static Setting<T>) -> Arg {
    let default = setting.said_default.map_or_else(|| table.default_of(setting), str::to_owned);
    let arg = Arg::new(setting.name)
        .long(setting.name)
        .help(format!("{} [default: {default}]", setting.help))
        .hide_short_help(!setting.is_common);
    if setting.kind == Kind::Flag {
        return arg.action(ArgAction::SetTrue);
    }
    let arg = arg.action(ArgAction::Set).value_name(setting.value_name);
    // As soon as it is read only what is no value at all is refused; whose setting it is, is known later.
    let check = move |text: &str| table.check(setting.name, text).map(|()| text.to_owned());
    match &setting.kind {
        Kind::File => arg.value_parser(clap::value_parser!(PathBuf)),
        Kind::Numbers { .. } | Kind::Text { .. } | Kind::Color | Kind::Colors { .. } => {
            arg.value_parser(check).allow_hyphen_values(true)
        }
        Kind::Choice(names) if names.iter().any(|name| name.starts_with('-')) => {
            arg.value_parser(check).allow_hyphen_values(true)
        }
        _ => arg.value_parser(check),
    }
}

/// A command with a table's settings among its options.
pub(super) fn with_settings<T: Clone + Send + Sync + 'static>(
    command: Command,
    table: &'static Table<T>,
    settings: impl Iterator<Item = &'static Setting<T>>,
    has_headings: bool,
) -> Command {
    settings.fold(command, |command, setting| {
        let arg = arg(table, setting).help_heading(has_headings.then_some(setting.heading));
        let excluded = EXCLUSIVE.iter().filter(|(option, _)| *option == setting.name).flat_map(|(_, others)| *others);
        command.arg(arg.conflicts_with_all(excluded))
    })
}

impl<S: Selection> clap::Args for Chosen<S> {
    fn augment_args(command: Command) -> Command {
        with_settings(command, S::Of::table(), Self::all(), S::HAS_HEADINGS)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: Selection> FromArgMatches for Chosen<S> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let mut chosen = Self { options: Options::new(), paths: Vec::new(), selection: PhantomData };
        for setting in Self::all() {
            if matches.value_source(setting.name) != Some(ValueSource::CommandLine) {
                continue;
            }
            let raw = matches.get_raw(setting.name).and_then(|mut raw| raw.next()).map(OsString::from);
            let value = match raw.unwrap_or_default().into_string() {
                _ if setting.kind == Kind::Flag => OptionValue::Switch(true),
                Ok(text) => OptionValue::Text(text),
                Err(path) => {
                    chosen.paths.push((setting.name, path.into()));
                    continue;
                }
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

/// The settings of every style.
pub(super) struct OfStyles;

impl Selection for OfStyles {
    type Of = Style;
}

/// The styles' settings, in one group for every command that draws.
#[derive(clap::Args)]
#[command(next_help_heading = "All styles")]
pub(super) struct StyleArguments {
    /// Picture to show: final, borders, tones; three-pass, two-pass and mrt also normals, depth, map, ink also map; charcoal and sand final, diffuse, cem, cet, paper [default: final]
    #[arg(long, hide_short_help = true, value_name = "PICTURE", default_value = "final", hide_default_value = true)]
    pub show: Show,

    #[command(flatten)]
    given: Chosen<OfStyles>,
}

impl StyleArguments {
    /// The style of this name with these settings; what belongs to other styles is left alone.
    pub(super) fn style(&self, name: StyleName) -> Result<Style> {
        let mut style = Style::with_options(name, &self.given.options)?;
        for (option, path) in &self.given.paths {
            match (&mut style, *option) {
                (Style::Inking(inking), "ramp") => inking.ramp = Ramp::read(path)?,
                (Style::Charcoal(charcoal) | Style::Sand(charcoal), option) => {
                    let source = match option {
                        "cet" => &mut charcoal.cet,
                        "noise-texture" => &mut charcoal.noise_texture,
                        "paper" => &mut charcoal.paper,
                        _ => continue,
                    };
                    *source = TextureSource::read(path)?;
                }
                _ => {}
            }
        }
        Ok(style)
    }

    /// Whether the lines are to be left out.
    pub(super) fn are_without_borders(&self) -> bool {
        self.given.is_on("no-borders")
    }

    /// What the style lines finds; some of that it has in common with inking.
    pub(super) fn line_settings(&self, forms: &FormArguments) -> Result<LineSettings> {
        let mut lines = LineSettings::from_options(&self.given.options)?;
        LineSettings::table().apply(&mut lines, &forms.options)?;
        Ok(lines)
    }

    /// How the style lines draws it; some of that it has in common with inking.
    pub(super) fn svg_settings<S: Selection<Of = SvgSettings>>(&self, lines: &Chosen<S>) -> Result<SvgSettings> {
        let mut svg = SvgSettings::from_options(&self.given.options)?;
        SvgSettings::table().apply(&mut svg, &lines.options)?;
        Ok(svg)
    }
}

/// The settings of lines that no other style has.
pub(super) struct OfLinesAlone;

impl Selection for OfLinesAlone {
    type Of = SvgSettings;

    fn has(setting: &Setting<SvgSettings>) -> bool {
        !Style::table().has(setting.name)
    }
}

pub(super) type LineArguments = Chosen<OfLinesAlone>;

/// The settings of what lines finds that no other style has: its form lines.
pub(super) struct OfForms;

impl Selection for OfForms {
    type Of = LineSettings;

    fn has(setting: &Setting<LineSettings>) -> bool {
        !Style::table().has(setting.name)
    }
}

pub(super) type FormArguments = Chosen<OfForms>;

/// What a scene is besides its models and its camera.
pub(super) struct OfScene;

impl Selection for OfScene {
    type Of = SceneSettings;

    fn has(setting: &Setting<SceneSettings>) -> bool {
        setting.heading != camera::HEADING
    }
}

pub(super) type SceneArguments = Chosen<OfScene>;

impl SceneArguments {
    pub(super) fn settings(&self, camera: CameraSettings) -> Result<SceneSettings> {
        Ok(SceneSettings { camera, ..SceneSettings::from_options(&self.options)? })
    }

    /// Whether there is no background.
    pub(super) fn is_transparent(&self) -> bool {
        self.is_on("transparent")
    }
}

/// The camera of a scene.
pub(super) struct OfCamera;

impl Selection for OfCamera {
    type Of = SceneSettings;

    fn has(setting: &Setting<SceneSettings>) -> bool {
        setting.heading == camera::HEADING
    }
}

/// The camera's settings, one by one or out of a file.
#[derive(clap::Args)]
#[command(next_help_heading = camera::HEADING)]
pub(super) struct CameraArguments {
    /// Read the camera from this file: the JSON that --json prints, a picture that tinta drew, a glTF or GLB model, or the 16 numbers of the matrix from world to clip space, row by row; single options override it [default: none]
    // Its settings stand among the others by the time anyone asks: see preset.rs.
    #[arg(id = "camera", long, hide_short_help = true, value_name = "FILE")]
    _file: Option<PathBuf>,

    #[command(flatten)]
    given: Chosen<OfCamera>,
}

impl CameraArguments {
    pub(super) fn settings(&self) -> Result<CameraSettings> {
        SceneSettings::from_options(&self.given.options).map(|scene| scene.camera)
    }
}

/// How models are read.
pub(super) struct OfModels;

impl Selection for OfModels {
    type Of = LoadOptions;
}

pub(super) type ModelArguments = Chosen<OfModels>;

impl ModelArguments {
    pub(super) fn settings(&self) -> Result<LoadOptions> {
        let load = LoadOptions::from_options(&self.options)?;
        let skin = self.paths.iter().find(|(option, _)| *option == "skin").map(|(_, path)| path.clone());
        Ok(LoadOptions { skin: skin.or(load.skin), ..load })
    }
}
