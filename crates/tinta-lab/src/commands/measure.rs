//! `tinta measure`: every style's error against its run time, on the user's own models and machine.

pub(super) mod errors;
mod settings;

use super::batch::JobOptions;
use super::completions::of_table;
use super::inputs::Inputs;
use super::options::{Below, CameraFile, Chosen, OfSubject, PresetFile, refuse_of_other_commands};
use super::progress::{Steps, TimedProgress};
use super::{Command, Verdict, given};
use crate::measure::{
    Against, MeasureSettings, MeasureStep, Measured, Row, Setting, Subject, frames_a_turn, line_options, measure,
    measure_lines, turns,
};
use crate::report::{ReportInfo, ReportPicture, RowLog, read_rows};
use errors::{error_page, is_shown, known_picture};
use settings::{HowMeasured, OfHow, Suite, setting_of, settings, smooth_inking};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tinta::edges::SilhouetteRule;
use tinta::lines::closed_forms::ClosedForm;
use tinta::mesh::{BUILTINS, builtin};
use tinta::preset::Preset;
use tinta::recipe::option_words;
use tinta::renderer::milliseconds_since;
use tinta::request::{Layer, ModelCache, Request, Session};
use tinta::settings::{HasSettings, Kind, OptionValue, Options};
use tinta::{Error, LoadOptions, Renderer, Result, Scene, SceneSettings, Show, Size, Style, StyleName};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta measure cow.obj -o cow --quick            measure error and run time"],
    job: Some(|job| {
        let (arguments, words) = (Arguments::of_job(job)?, job.command.clone());
        Ok(Box::new(move |folder, session| {
            let output = folder.map_or_else(|| arguments.output.clone(), Path::to_owned);
            run(&arguments.resumed(output), &words, session).map(|()| Verdict::Good)
        }))
    }),
    offers: of_table::<HowMeasured>,
    ..Command::new("measure", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.words, call.session).map(|()| Verdict::Good)
    })
};

/// Measure every style's error and run time, as a table, plots and a page
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in models, or - for standard input, each measured by itself
    #[arg(value_name = "MODEL", required_unless_present_any = ["suite", "merge", "against"])]
    models: Vec<String>,

    #[command(flatten)]
    how: Chosen<OfHow>,

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
    subject: Chosen<OfSubject>,
}

impl Arguments {
    /// Of a job's options.
    pub(super) fn of_job(job: &JobOptions) -> Result<Self> {
        let is_own = |name: &str| name == "merge" || Chosen::<OfHow>::has(name) || Chosen::<OfSubject>::has(name);
        job.refuse_unknown("measure", is_own)?;
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
            how: Chosen::of_options(&job.options),
            output: job.output.clone().into(),
            merge,
            preset: job.preset(),
            camera: job.camera(),
            subject: Chosen::of_options(&job.options),
        };
        let is_named = |name: &str| job.options.contains_key(name);
        match arguments.models.is_empty() && !["suite", "merge", "against"].into_iter().any(is_named) {
            true => {
                Err(Error::setting("model", "a model is missing; name a file, or a built-in one such as builtin:bust"))
            }
            false => Ok(arguments),
        }
    }

    /// The same as if it went on in the folder: a job's is there from an earlier try, or empty.
    pub(super) fn resumed(mut self, output: PathBuf) -> Self {
        if self.merge.is_empty() {
            self.how.options.insert("resume".to_owned(), OptionValue::Switch(true));
        }
        Self { output, ..self }
    }

    /// Refuses what does not go together.
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

/// Timed frames of a setting.
const FRAMES: [usize; 2] = [21, 7];

/// Times that exact lines are found to be timed.
const FRAMES_OF_LINES: usize = 3;

/// Triangles of the surfaces' meshes, where none are named.
const SURFACE_TRIANGLES: [usize; 3] = [1_000, 10_000, 100_000];

/// Settings whose frames are timed in turns.
const SETTINGS_IN_TURN: usize = 8;

/// How long a setting takes besides its frames, seconds: its pictures compared with the references.
const SECONDS_A_SETTING: f64 = 0.35;

/// How long a model's references take at first guess, seconds: exact lines and rays.
const SECONDS_A_REFERENCE: f64 = 0.5;

/// Frames of a setting that are drawn besides those of its turns.
const FRAMES_A_SETTING: f64 = 10.0;

/// What is done for each model at each size, in the order of [`expected`]: references once, errors of each setting, turns.
const KINDS: [usize; 3] = [0, 1, 2];

/// Files that a measurement writes, the pictures of its plots and errors aside.
const WRITTEN: [&str; 3] = ["results.jsonl", "results.csv", "report.html"];

/// Measures; `command` is what the report says it was made by.
pub(super) fn run(arguments: &Arguments, command: &str, session: &mut Session) -> Result<()> {
    arguments.check()?;
    if !arguments.merge.is_empty() {
        return merge(arguments, command);
    }
    let (preset, camera) = (arguments.preset.preset.as_deref(), arguments.camera.camera.as_deref());
    let below = Below { camera, ..Below::default() };
    let of_preset = preset.map(Preset::read).transpose()?;
    let (with_preset, own_setting) = match &of_preset {
        None => (Layer::Given(Options::new()), None),
        Some(preset) => of_preset_file(preset)?,
    };
    let (request, _) = arguments.subject.request_over(with_preset, &arguments.models, &below)?;
    let files: Vec<&str> = preset.into_iter().chain(camera.and_then(Path::to_str)).collect();
    Inputs::new(&request.models, &request.options, &files).keep_in(&arguments.output, WRITTEN)?;
    // What a preset says of the measuring itself.
    let mut asked = of_preset.map(|preset| preset.of(is_of_both).options).unwrap_or_default();
    asked.extend(arguments.how.options.clone());
    let asked = HowMeasured::from_options(&asked).map_err(|error| request.attributed(error))?;
    measured(arguments, &request, asked, own_setting, command, session).map_err(|error| request.attributed(error))
}

/// What a preset says of the model and the camera; and its style, which is measured beside the others.
fn of_preset_file(preset: &Preset) -> Result<(Layer, Option<Setting>)> {
    let is_of_subject = Chosen::<OfSubject>::has;
    let is_of_style = |name: &str| name == "style" || Style::table().has(name);
    refuse_of_other_commands(preset, "measure", |name| is_of_subject(name) || is_of_both(name) || is_of_style(name))?;
    let of_style = preset.clone().of(|name| !is_of_subject(name) && !is_of_both(name));
    let setting = match of_style.options.is_empty() {
        true => None,
        false => Some(setting_of(&Request::from_layers(&[Layer::File(of_style)])?.0)?),
    };
    Ok((Layer::File(preset.clone().of(is_of_subject)), setting))
}

/// Whether an option is of a drawing and of measuring.
fn is_of_both(name: &str) -> bool {
    Chosen::<OfHow>::has(name) && Request::table().has(name)
}

fn measured(
    arguments: &Arguments,
    request: &Request,
    asked: HowMeasured,
    own_setting: Option<Setting>,
    command: &str,
    session: &mut Session,
) -> Result<()> {
    let how = MeasureSettings {
        tolerance_px: asked.tolerance_px,
        frames: asked.frames.map_or(FRAMES[usize::from(asked.quick)], |frames| frames as usize),
        machine: asked
            .machine
            .clone()
            .filter(|name| !name.trim().is_empty())
            .unwrap_or_else(|| MeasureSettings::default().machine),
    };
    how.check()?;
    let of_scene = scene_options(&request.options);
    let against = asked.against.unwrap_or_default();
    let mut settings = settings(&asked.styles, asked.quick)?;
    if against == Against::Smooth && settings.iter().any(|setting| matches!(setting.style, Style::Inking(_))) {
        settings.push(smooth_inking()?);
    }
    // A preset's style is measured beside the others, unless it is one of them.
    if let Some(setting) = own_setting.filter(|own| settings.iter().all(|other| other.style != own.style)) {
        settings.push(setting);
    }
    settings.iter_mut().for_each(|setting| setting.options.push_str(&of_scene));
    let named = arguments.models.iter().map(String::as_str);
    let surfaces = if against == Against::Smooth && arguments.models.is_empty() { all_surfaces() } else { Vec::new() };
    let suite = asked.suite.map(Suite::models).unwrap_or_default();
    let models: Vec<&str> = suite.iter().copied().chain(named).chain(surfaces.iter().map(String::as_str)).collect();
    session.renderer(asked.backend)?;
    let groups = groups(request, &asked.sizes, against, &models, &session.models)?;
    let renderer = session.renderer(asked.backend)?;
    let expected = expected(renderer, &groups, settings.len(), how.frames)?;
    let seconds: f64 = expected.iter().copied().map(Steps::total).sum();
    // Once nothing but the measuring can go wrong.
    make_folder(&arguments.output)?;
    let (mut log, mut rows) = match asked.resume {
        true => RowLog::resume(&arguments.output)?,
        false => (RowLog::create(&arguments.output)?, Vec::new()),
    };
    refuse_other_terms(arguments, against, &rows, &how)?;
    super::say(&format!(
        "tinta: {}, {}, {}, {} each: about {}{}",
        counted(settings.len(), "setting"),
        counted(models.len(), "model"),
        counted(asked.sizes.len(), "size"),
        counted(how.frames, "frame"),
        in_words(Duration::from_secs_f64(seconds)),
        if rows.is_empty() { "" } else { ", minus what is done already" }
    ));
    let progress = TimedProgress::new("measuring", &expected);
    let mut pictures = Vec::new();
    for (number, group) in groups.into_iter().enumerate() {
        let [reference, errors, turn] = KINDS.map(|kind| number * KINDS.len() + kind);
        let subject = match &group.surface {
            None => Subject::new(&group.model, group.scene, group.load_ms)?,
            Some(surface) => Subject::of_surface(&group.model, group.scene, surface, group.load_ms)?,
        };
        progress.step(reference);
        let is_known = |options: &str| {
            let Size { width, height } = subject.scene.size;
            let is_it = |row: &Row| {
                row.machine == how.machine
                    && row.model == subject.model
                    && row.size == [width, height]
                    && row.options == options
            };
            rows.iter().any(is_it)
        };
        for row in rows.iter().filter(|row| row.machine == how.machine && row.model == subject.model) {
            let Size { width, height } = subject.scene.size;
            if row.size == [width, height] && is_shown(row) {
                pictures.extend(known_picture(&arguments.output, row));
            }
        }
        let left: Vec<Setting> = settings.iter().filter(|setting| !is_known(&setting.options)).cloned().collect();
        let rules: &[SilhouetteRule] = match against {
            Against::Lines => &[],
            Against::Smooth => &[SilhouetteRule::Exact, SilhouetteRule::Smooth],
        };
        let rules = rules.iter().map(|rule| (*rule, line_options(*rule, &of_scene)));
        let rules: Vec<(SilhouetteRule, String)> = rules.filter(|(_, options)| !is_known(options)).collect();
        progress.skip(errors, settings.len() - left.len());
        progress.skip(turn, (settings.len() - left.len()) * turns(how.frames));
        // Settings take turns in groups, so that rows are on disk soon and an interruption costs little.
        for some in left.chunks(SETTINGS_IN_TURN) {
            let step = |step| progress.step(if step == MeasureStep::Errors { errors } else { turn });
            let (measured, left_out) = measure(renderer, &subject, some, &how, step)?;
            progress.skip(turn, left_out.len() * turns(how.frames));
            left_out.iter().for_each(|reason| super::say(&format!("tinta: {reason}")));
            for measured in measured {
                pictures.extend(kept(arguments, &mut log, &mut rows, measured)?);
            }
        }
        for (rule, options) in rules {
            let measured = measure_lines(&subject, rule, options, FRAMES_OF_LINES, &how)?;
            pictures.extend(kept(arguments, &mut log, &mut rows, measured)?);
        }
    }
    drop(progress);
    if rows.is_empty() {
        return Err(Error::setting("styles", "none of these settings can be drawn with these models; choose others"));
    }
    report(arguments, command, &rows, pictures)
}

/// Writes a row down, and its picture where it is shown.
fn kept(
    arguments: &Arguments,
    log: &mut RowLog,
    rows: &mut Vec<Row>,
    Measured { row, drawing, error_picture }: Measured,
) -> Result<Option<ReportPicture>> {
    log.append(&row)?;
    let shown = error_picture.filter(|_| is_shown(&row));
    let picture = shown.map(|picture| error_page(&arguments.output, &row, [&drawing, &picture])).transpose()?;
    rows.push(row);
    Ok(picture)
}

/// The surfaces in closed form, from few triangles to many.
fn all_surfaces() -> Vec<String> {
    let surfaces = BUILTINS.iter().filter(|builtin| builtin.closed_form().is_some());
    surfaces.flat_map(|it| SURFACE_TRIANGLES.map(|count| format!("builtin:{}:{count}", it.name))).collect()
}

/// Rows of one folder are measured by one yardstick.
fn refuse_other_terms(arguments: &Arguments, against: Against, rows: &[Row], how: &MeasureSettings) -> Result<()> {
    let is_other = |row: &Row| row.lines.as_ref().is_some_and(|lines| lines.against != against);
    if rows.iter().any(is_other) {
        let problem = "its rows were measured against something else; give the same --against, or name another folder";
        return Err(Error::output(&arguments.output, problem));
    }
    let differs = |row: &Row| {
        let tolerance = row.lines.as_ref().map(|lines| lines.tolerance_px);
        let is_of_frames = row.style != StyleName::Lines.name() && row.time.frames_ms.len() != how.frames;
        tolerance.is_some_and(|tolerance| tolerance != how.tolerance_px) || is_of_frames
    };
    match rows.iter().find(|row| differs(row)) {
        None => Ok(()),
        Some(row) => Err(Error::output(
            &arguments.output,
            format!(
                "its rows were measured with {} and perhaps another tolerance; give the same --frames, --quick and \
                 --tolerance, or name another folder",
                counted(row.time.frames_ms.len(), "frame")
            ),
        )),
    }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Camera and model as the user asked for them: without these a row could not be drawn again.
fn scene_options(options: &Options) -> String {
    // Whether defects are refused is nothing of a picture, and what lies outside is for whoever has it.
    let is_flag = |name: &str| {
        LoadOptions::table().settings.iter().any(|setting| setting.name == name && setting.kind == Kind::Flag)
    };
    let kept = options.iter().filter(|(name, _)| !is_flag(name));
    kept.flat_map(|(name, value)| match value {
        OptionValue::Text(value) => vec![format!("--{name}={value}")],
        switch => option_words(name, switch),
    })
    .fold(String::new(), |options, word| options + " " + &tinta::shell::quoted(&word))
}

/// A model at a size.
struct Group {
    model: String,
    /// The surface whose contour its lines are compared with, if they are.
    surface: Option<ClosedForm>,
    scene: Scene,
    load_ms: f64,
}

fn groups(
    request: &Request,
    sizes: &[Size],
    against: Against,
    models: &[&str],
    cache: &ModelCache,
) -> Result<Vec<Group>> {
    let mut groups = Vec::new();
    let options = &request.read;
    if against == Against::Smooth && options.up_axis != LoadOptions::default().up_axis {
        let problem = "with --against smooth surfaces stand as their formulas say; leave it out";
        return Err(Error::setting("up", problem));
    }
    for model in models {
        let surface = (against == Against::Smooth).then(|| surface_of(model)).transpose()?;
        let start = Instant::now();
        let loaded = cache.read(model, options)?;
        let load_ms = milliseconds_since(start);
        for size in sizes {
            let scene = Scene::new(vec![loaded.mesh.clone()], &SceneSettings { size: *size, ..request.scene.clone() })?;
            groups.push(Group { model: (*model).to_owned(), surface, scene, load_ms });
        }
    }
    Ok(groups)
}

/// The surface that a built-in model is a mesh of.
fn surface_of(model: &str) -> Result<ClosedForm> {
    let surface = builtin(model).transpose()?.and_then(|named| named.builtin.closed_form());
    surface.ok_or_else(|| {
        let names: Vec<&str> = BUILTINS.iter().filter(|it| it.closed_form().is_some()).map(|it| it.name).collect();
        let problem = format!(
            "only surfaces in closed form have a true contour to measure against; choose of builtin:{}, or leave out \
             --against",
            names.join(", builtin:")
        );
        Error::model(model, problem)
    })
}

/// How long all of it will take, by one frame of each group.
fn expected(renderer: &mut Renderer, groups: &[Group], settings: usize, frames: usize) -> Result<Vec<Steps>> {
    let style = Style::named(StyleName::ThreePass);
    let mut steps = Vec::new();
    for group in groups {
        let plan = style.plan(&group.scene, Show::Final)?;
        let frame = renderer.time_frames(&group.scene, &plan, 1, 1)?.first().copied().unwrap_or_default() * 1e-3;
        let pixels = group.scene.size.pixel_count() as f64 / (512.0 * 512.0);
        steps.push(Steps { count: 1, seconds: SECONDS_A_REFERENCE });
        steps.push(Steps { count: settings, seconds: SECONDS_A_SETTING * pixels.max(0.2) + frame * FRAMES_A_SETTING });
        steps.push(Steps { count: settings * turns(frames), seconds: frame * frames_a_turn(frames) as f64 });
    }
    Ok(steps)
}

fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..=90 => counted(time.as_secs().max(1) as usize, "second"),
        seconds => format!("{} minutes", seconds.div_ceil(60)),
    }
}

pub(super) fn make_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let problem = match folder.is_file() {
            true => "this is a file; name a folder".to_owned(),
            false => format!("the folder cannot be created ({error}); choose another"),
        };
        Error::output(folder, problem).because(&error)
    })
}

fn report(arguments: &Arguments, command: &str, rows: &[Row], pictures: Vec<ReportPicture>) -> Result<()> {
    let info = ReportInfo {
        command: command.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        notes: Vec::new(),
        pictures,
    };
    crate::report::write(&arguments.output, rows, &info)?;
    super::print(&format!("{}\n", arguments.output.join("report.html").display()))
}

/// Puts the rows of several files together.
fn merge(arguments: &Arguments, command: &str) -> Result<()> {
    let mut rows: Vec<Row> = Vec::new();
    // Where the row of a key was first seen.
    let mut places: HashMap<String, usize> = HashMap::new();
    for path in &arguments.merge {
        let of_file = read_rows(path)?;
        if of_file.is_empty() {
            return Err(Error::output(path, "it holds no row; name a results.jsonl of `tinta measure`"));
        }
        for row in of_file {
            let place = *places.entry(row.key()).or_insert(rows.len());
            if let Some(known) = rows.get(place).filter(|known| **known != row) {
                return Err(Error::output(
                    path,
                    format!(
                        "{} was measured in another file on a machine of the same name; measure one of them with another \
                         --machine",
                        known.options
                    ),
                ));
            }
            rows.push(row);
        }
    }
    make_folder(&arguments.output)?;
    let mut log = RowLog::create(&arguments.output)?;
    rows.iter().try_for_each(|row| log.append(row))?;
    report(arguments, command, &rows, Vec::new())
}
