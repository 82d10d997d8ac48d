//! `tinta measure`: every style's error against its run time, on the user's own models and machine.

pub(super) mod errors;
mod settings;

use super::model_cache::ModelCache;
use super::options::{CameraArguments, ModelArguments};
use super::preset::{Given, PresetArguments};
use super::progress::{Steps, TimedProgress};
use super::session::Session;
use errors::{error_page, is_shown, known_picture};
pub(super) use settings::StyleOptions;
use settings::{of_words, settings};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tinta::camera;
use tinta::edges::SilhouetteRule;
use tinta::lines::closed_forms::ClosedForm;
use tinta::measure::{
    Against, MeasureSettings, MeasureStep, Measured, Row, Setting, Subject, frames_a_turn, line_options, measure,
    measure_lines, turns,
};
use tinta::mesh::{BUILTINS, builtin};
use tinta::renderer::milliseconds_since;
use tinta::report::{ReportInfo, ReportPicture, RowLog, read_rows};
use tinta::settings::{HasSettings, Kind};
use tinta::{Backend, Error, LoadOptions, Renderer, Result, Scene, SceneSettings, Show, Size, Style, StyleName};

/// Measure every style's error and run time, as a table, plots and a page
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in models, or - for standard input, each measured by itself
    #[arg(value_name = "MODEL", required_unless_present_any = ["suite", "merge", "against"])]
    models: Vec<String>,

    /// What lines are compared with: the exact lines of the models (lines), or the true contour of smooth surfaces (smooth), whose
    /// models are built-in ones, by default all of them with about 1,000, 10,000 and 100,000 triangles [default: lines]
    #[arg(long, value_name = "WHAT", conflicts_with_all = ["suite", "merge"])]
    against: Option<Against>,

    /// Set of built-in models: papers (bust, ant), solids (gear, open box), all
    #[arg(long, value_name = "SUITE", value_parser = parse_suite)]
    suite: Option<Suite>,

    /// Folder for results.jsonl, results.csv, plots and report.html
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Sizes in pixels, separated by commas [default: 512x512]
    #[arg(long, value_name = "SIZES", value_delimiter = ',', default_value = "512x512", hide_default_value = true)]
    size: Vec<Size>,

    /// Styles, separated by commas [default: all]
    #[arg(long, value_name = "STYLES", value_delimiter = ',')]
    styles: Vec<StyleName>,

    /// Frames to time for each setting [default: 21, with --quick 7]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,

    /// Measure fewer settings and frames [default: off]
    #[arg(long)]
    quick: bool,

    /// Distance within which ink and line count as the same, in pixels [default: 2]
    #[arg(
        long,
        hide_short_help = true,
        value_name = "PIXELS",
        default_value = "2",
        hide_default_value = true,
        allow_hyphen_values = true
    )]
    tolerance: f64,

    /// Continue an interrupted run in the same folder [default: off]
    #[arg(long, conflicts_with = "merge")]
    resume: bool,

    /// Merge the results of several runs or machines instead of measuring
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["models", "suite"])]
    merge: Vec<PathBuf>,

    /// Name of this machine in the report [default: system, processor, threads]
    #[arg(long, hide_short_help = true, value_name = "NAME")]
    machine: Option<String>,

    /// OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works) [default: auto]
    #[arg(long, hide_short_help = true, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    #[command(flatten)]
    preset: PresetArguments,

    #[command(flatten)]
    camera: CameraArguments,

    #[command(flatten)]
    model: ModelArguments,
}

/// Built-in models that are measured together.
type Suite = &'static [&'static str];

fn parse_suite(text: &str) -> std::result::Result<Suite, String> {
    match text {
        "papers" => Ok(&["builtin:bust", "builtin:ant"]),
        "solids" => Ok(&["builtin:gear", "builtin:open-box"]),
        "all" => Ok(&["builtin:bust", "builtin:ant", "builtin:gear", "builtin:open-box"]),
        _ => Err("choose papers, solids or all".to_owned()),
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

pub(super) fn run(arguments: &Arguments, given: &Given, session: &mut Session) -> Result<()> {
    if !arguments.merge.is_empty() {
        return merge(arguments, given);
    }
    given.inputs(&arguments.models).keep_in(&arguments.output, WRITTEN)?;
    let how = MeasureSettings {
        tolerance_px: arguments.tolerance,
        frames: arguments.frames.map_or(FRAMES[usize::from(arguments.quick)], |frames| frames as usize),
        machine: arguments
            .machine
            .clone()
            .filter(|name| !name.trim().is_empty())
            .unwrap_or_else(|| MeasureSettings::default().machine),
    };
    how.check()?;
    let of_scene = scene_options(given.words.iter().cloned());
    let against = arguments.against.unwrap_or_default();
    let mut settings = settings(&arguments.styles, arguments.quick)?;
    if against == Against::Smooth && settings.iter().any(|setting| matches!(setting.style, Style::Inking(_))) {
        settings.extend(of_words(&["--style=inking", "--silhouette=smooth"].map(str::to_owned))?);
    }
    // A preset's style is measured beside the others, unless it is one of them.
    if let Some(setting) = of_words(&given.setting)?.filter(|own| settings.iter().all(|other| other.style != own.style))
    {
        settings.push(setting);
    }
    settings.iter_mut().for_each(|setting| setting.options.push_str(&of_scene));
    let named = arguments.models.iter().map(String::as_str);
    let surfaces = if against == Against::Smooth && arguments.models.is_empty() { all_surfaces() } else { Vec::new() };
    let models: Vec<&str> = arguments
        .suite
        .unwrap_or_default()
        .iter()
        .copied()
        .chain(named)
        .chain(surfaces.iter().map(String::as_str))
        .collect();
    session.renderer(arguments.backend)?;
    let groups = groups(arguments, against, &models, &session.model_cache)?;
    let renderer = session.renderer(arguments.backend)?;
    let expected = expected(renderer, &groups, settings.len(), how.frames)?;
    let seconds: f64 = expected.iter().copied().map(Steps::total).sum();
    // Once nothing but the measuring can go wrong.
    make_folder(&arguments.output)?;
    let (mut log, mut rows) = match arguments.resume {
        true => RowLog::resume(&arguments.output)?,
        false => (RowLog::create(&arguments.output)?, Vec::new()),
    };
    refuse_other_terms(arguments, against, &rows, &how)?;
    super::say(&format!(
        "tinta: {}, {}, {}, {} each: about {}{}",
        counted(settings.len(), "setting"),
        counted(models.len(), "model"),
        counted(arguments.size.len(), "size"),
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
    report(arguments, given, &rows, pictures)
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
        let is_of_frames = row.style != "lines" && row.time.frames_ms.len() != how.frames;
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
fn scene_options(words: impl Iterator<Item = String>) -> String {
    let is_kept = |word: &str| {
        let name = word.strip_prefix("--")?.split('=').next()?;
        let camera = SceneSettings::table().of(None).into_iter().find(|setting| setting.name == name);
        let camera = camera.filter(|setting| setting.heading == camera::HEADING).map(|setting| &setting.kind);
        // Whether defects are refused is nothing of a picture, and what lies outside is for whoever has it.
        let model = || LoadOptions::table().of(None).into_iter().find(|setting| setting.name == name);
        let model = || model().map(|setting| &setting.kind).filter(|kind| **kind != Kind::Flag);
        camera.or_else(model)
    };
    let mut words = words;
    let mut options = String::new();
    while let Some(word) = words.next() {
        let Some(kind) = is_kept(&word) else { continue };
        if *kind == Kind::Flag || word.contains('=') {
            options = options + " " + &tinta::shell::quoted(&word);
        } else {
            let value = words.next().unwrap_or_default();
            options = options + " " + &tinta::shell::quoted(&format!("{word}={value}"));
        }
    }
    options
}

/// A model at a size.
struct Group {
    model: String,
    /// The surface whose contour its lines are compared with, if they are.
    surface: Option<ClosedForm>,
    scene: Scene,
    load_ms: f64,
}

fn groups(arguments: &Arguments, against: Against, models: &[&str], model_cache: &ModelCache) -> Result<Vec<Group>> {
    let mut groups = Vec::new();
    let options = arguments.model.settings()?;
    if against == Against::Smooth && options.up_axis != LoadOptions::default().up_axis {
        let problem = "with --against smooth surfaces stand as their formulas say; leave it out";
        return Err(Error::setting("up", problem));
    }
    for model in models {
        let surface = (against == Against::Smooth).then(|| surface_of(model)).transpose()?;
        let start = Instant::now();
        let loaded = model_cache.read(model, &options)?;
        let load_ms = milliseconds_since(start);
        loaded.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        for size in &arguments.size {
            let settings =
                SceneSettings { size: *size, camera: arguments.camera.settings()?, ..SceneSettings::default() };
            let scene = Scene::new(vec![loaded.mesh.clone()], &settings)?;
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

fn report(arguments: &Arguments, given: &Given, rows: &[Row], pictures: Vec<ReportPicture>) -> Result<()> {
    let info = ReportInfo {
        command: tinta::shell::command_line(given.as_given.iter().cloned()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        notes: Vec::new(),
        pictures,
    };
    tinta::report::write(&arguments.output, rows, &info)?;
    super::print(&format!("{}\n", arguments.output.join("report.html").display()))
}

/// Puts the rows of several files together.
fn merge(arguments: &Arguments, given: &Given) -> Result<()> {
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
    report(arguments, given, &rows, Vec::new())
}
