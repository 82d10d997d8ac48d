//! `tinta measure`: every style's error against its run time, on the user's own models and machine.

mod errors;
mod groups;
mod look;
mod measuring;
pub(super) mod results;
mod settings;
mod words;

use crate::measure::{Against, MeasuredStyle};
use groups::{all_surfaces, expected, groups};
pub(super) use look::exact_lines;
use measuring::Measuring;
use results::Results;
pub(super) use settings::TOLERANCE;
use settings::{HowMeasured, OfHow, Suite, setting_of};
use std::path::{Path, PathBuf};
use std::time::Duration;
use tinta::cli::batch::JobOptions;
use tinta::cli::completions::of_table;
use tinta::cli::inputs::Inputs;
use tinta::cli::options::{Below, CameraFile, GivenOptions, OfSubject, PresetFile, refuse_of_other_commands};
use tinta::cli::progress::{Steps, TimedProgress};
use tinta::cli::{Command, Verdict, given};
use tinta::preset::Preset;
use tinta::request::{OptionLayer, Request, Session};
use tinta::settings::{HasSettings, OptionValue, Options};
use tinta::{Error, Result, Style};
use words::{counted, in_words};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta measure cow.obj -o cow --quick            measure error and run time"],
    job: Some(|job| {
        let (arguments, words) = (Arguments::of_job(job)?, job.command.clone());
        Ok(Box::new(move |session| run(&arguments, &words, session).map(|()| Verdict::Good)))
    }),
    has_in_jobs: |name| name == "merge" || GivenOptions::<OfHow>::has(name) || GivenOptions::<OfSubject>::has(name),
    offers: of_table::<HowMeasured>,
    ..Command::new("measure", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.words, call.session).map(|()| Verdict::Good)
    })
};

/// Measure every style's error and run time, as a table, plots and a page
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model files (FORMATS), built-in models, or - for standard input, each measured separately
    #[arg(value_name = "MODEL", required_unless_present_any = ["suite", "merge", "against"])]
    models: Vec<String>,

    #[command(flatten)]
    how: GivenOptions<OfHow>,

    /// Folder for results.jsonl, results.csv, plots and report.html
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Merge the results of several runs or machines instead of measuring
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "models")]
    merge: Vec<PathBuf>,

    #[command(flatten)]
    preset: PresetFile,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    subject: GivenOptions<OfSubject>,

    /// A job's folder may hold the rows of an earlier try, which it continues or, to merge, replaces.
    #[arg(skip)]
    is_job: bool,
}

impl Arguments {
    /// Reads a job's options.
    pub(super) fn of_job(job: &JobOptions) -> Result<Self> {
        let merge = match job.options.get("merge") {
            None => Vec::new(),
            Some(OptionValue::Text(file)) => vec![file.into()],
            Some(OptionValue::Texts(files)) => files.iter().map(PathBuf::from).collect(),
            Some(OptionValue::Switch(_)) => {
                return Err(Error::setting("merge", "name files: a text, or several in brackets"));
            }
        };
        let arguments = Self {
            models: job.models.clone(),
            how: GivenOptions::of_options(&job.options),
            output: job.output.clone().into(),
            merge,
            preset: job.preset(),
            camera: job.camera(),
            subject: GivenOptions::of_options(&job.options),
            is_job: true,
        };
        let is_named = |name: &str| job.options.contains_key(name);
        match arguments.models.is_empty() && !["suite", "merge", "against"].into_iter().any(is_named) {
            true => {
                Err(Error::setting("model", "a model is missing; name a file, or a built-in one such as builtin:bust"))
            }
            false => Ok(arguments),
        }
    }

    /// Refuses conflicting options.
    fn check(&self) -> Result<()> {
        let is_given = |name: &str| match name {
            "model" => !self.models.is_empty(),
            name => self.how.options.contains_key(name),
        };
        let excluded: &[(&str, bool, &[&str])] = &[
            ("merge", !self.merge.is_empty(), &["model", "suite", "against", "resume"]),
            ("against", is_given("against"), &["suite"]),
        ];
        for (one, is_there, others) in excluded {
            if let Some(other) = others.iter().find(|other| *is_there && is_given(other)) {
                return Err(Error::settings(&[one, other], "they exclude each other; leave one of them out"));
            }
        }
        Ok(())
    }
}

/// Files that a measurement writes, the pictures of its plots and errors aside.
pub(super) const WRITTEN: [&str; 3] = ["results.jsonl", "results.csv", "report.html"];

/// Measures; `command` is the command line stated in the report.
pub(super) fn run(arguments: &Arguments, command: &str, session: &mut Session) -> Result<()> {
    arguments.check()?;
    if !arguments.merge.is_empty() {
        return Results::merged(&arguments.merge, &arguments.output, arguments.is_job)?.report(command).and_then(shown);
    }
    let (preset, camera) = (arguments.preset.preset.as_deref(), arguments.camera.camera.as_deref());
    let below = Below { camera, ..Below::default() };
    let of_preset = preset.map(Preset::read).transpose()?;
    let (with_preset, own_setting) = match &of_preset {
        None => (OptionLayer::Given(Options::new()), None),
        Some(preset) => of_preset_file(preset)?,
    };
    let (request, _) = arguments.subject.request_over(vec![with_preset], &arguments.models, &below)?;
    let files: Vec<&str> = preset.into_iter().chain(camera.and_then(Path::to_str)).collect();
    Inputs::new(&request.models, &request.options, &files).keep_in(&arguments.output, WRITTEN)?;
    // A preset's options for the measuring itself.
    let mut asked = of_preset.map(|preset| preset.of(is_of_both).options).unwrap_or_default();
    asked.extend(arguments.how.options.clone());
    let asked = HowMeasured::from_options(&asked).map_err(|error| request.attributed(error))?;
    measured(arguments, &request, &asked, own_setting, command, session).map_err(|error| request.attributed(error))
}

/// A preset's layer for the model and the camera, and its style, which is measured with the others.
fn of_preset_file(preset: &Preset) -> Result<(OptionLayer, Option<MeasuredStyle>)> {
    let is_of_subject = GivenOptions::<OfSubject>::has;
    let is_of_style = |name: &str| name == "style" || Style::table().has(name);
    refuse_of_other_commands(preset, "measure", |name| is_of_subject(name) || is_of_both(name) || is_of_style(name))?;
    let of_style = preset.clone().of(|name| !is_of_subject(name) && !is_of_both(name));
    let setting = match of_style.options.is_empty() {
        true => None,
        false => Some(setting_of(&Request::from_layers(&[OptionLayer::File(of_style)])?.0)?),
    };
    Ok((OptionLayer::File(preset.clone().of(is_of_subject)), setting))
}

/// Whether an option is of a drawing and of measuring.
fn is_of_both(name: &str) -> bool {
    GivenOptions::<OfHow>::has(name) && Request::table().has(name)
}

fn measured(
    arguments: &Arguments,
    request: &Request,
    asked: &HowMeasured,
    own_setting: Option<MeasuredStyle>,
    command: &str,
    session: &mut Session,
) -> Result<()> {
    let measuring = Measuring::asked(asked, request, own_setting)?;
    let Measuring { settings, how, against, .. } = &measuring;
    let named = arguments.models.iter().map(String::as_str);
    let surfaces = if *against == Against::Smooth && arguments.models.is_empty() { all_surfaces() } else { Vec::new() };
    let suite = asked.suite.map(Suite::models).unwrap_or_default();
    let models: Vec<&str> = suite.iter().copied().chain(named).chain(surfaces.iter().map(String::as_str)).collect();
    session.renderer(asked.backend)?;
    let groups = groups(request, &asked.sizes, *against, &models, &session.models)?;
    let renderer = session.renderer(asked.backend)?;
    let expected = expected(renderer, &groups, settings.len(), how.frames)?;
    let seconds: f64 = expected.iter().copied().map(Steps::total).sum();
    // Only now, when the measuring alone can fail.
    let mut results = Results::open(&arguments.output, asked.resume || arguments.is_job)?;
    results.refuse_other_terms(*against, how)?;
    tinta::cli::say(&format!(
        "tinta: {}, {}, {}, {} each: about {}{}",
        counted(settings.len(), "setting"),
        counted(models.len(), "model"),
        counted(asked.sizes.len(), "size"),
        counted(how.frames, "frame"),
        in_words(Duration::from_secs_f64(seconds)),
        if results.is_empty() { "" } else { ", minus those done already" }
    ));
    let progress = TimedProgress::new("measuring", &expected);
    for (number, group) in groups.into_iter().enumerate() {
        measuring.measure(renderer, number, group, &mut results, &progress)?;
    }
    drop(progress);
    if results.is_empty() {
        return Err(Error::setting("styles", "none of these settings can be drawn with these models; choose others"));
    }
    results.report(command).and_then(shown)
}

/// Prints the path of the report.
fn shown(path: String) -> Result<()> {
    tinta::cli::print(&format!("{path}\n"))
}
