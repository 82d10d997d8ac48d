//! `tinta compare`: draws one scene in two styles and overlays their lines.

mod alone;

use super::measure::{TOLERANCE, exact_lines};
use crate::compare::{Agreement, AgreementNumbers, BOTH_COLOR, InkMask, LEFT_COLOR, RIGHT_COLOR};
use crate::contact_sheet::{Caption, Panel, sheet};
use crate::measure::Reference;
use alone::alone_on_lines;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::Instant;
use tinta::cli::batch::JobOptions;
use tinta::cli::completions::of_table;
use tinta::cli::inputs::Inputs;
use tinta::cli::options::{Below, CameraFile, GivenOptions, OfSubject, PresetFile, Selection};
use tinta::cli::{Command, Verdict, given};
use tinta::gl::ContextInfo;
use tinta::pixel::LineTolerance;
use tinta::preset::{LOOKS, Look, StyleOrLook};
use tinta::record::{CameraRecord, ModelRecord, Summary};
use tinta::renderer::milliseconds_since;
use tinta::request::{Request, Resolved, Session, ignored_remark};
use tinta::settings::{HasSettings, Kind, Setting, Table};
use tinta::styles::is_of_lines_alone;
use tinta::{Error, LineSettings, Picture, Renderer, Result, Show, StyleName, Target};
use tinta::{SceneSettings, Size, Style};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta compare builtin:gear -o both.png          compare lines of two styles"],
    job: Some(|job| {
        let arguments = Arguments::of_job(job)?;
        Ok(Box::new(move |session| run(&arguments, session).map(|()| Verdict::Good)))
    }),
    has_in_jobs: |name| GivenOptions::<OfHow>::has(name) || GivenOptions::<OfComparison>::has(name),
    offers: of_table::<CompareSettings>,
    ..Command::new("compare", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.session).map(|()| Verdict::Good)
    })
};

/// Draw one scene in two styles or looks side by side, and show which lines both drew
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model files (FORMATS), built-in models, or - for standard input; several make one scene
    #[arg(required = true, value_name = "MODEL")]
    models: Vec<String>,

    /// Sheet to write (.png .jpg .bmp .tga .ppm), or, ending in /, a folder for the sheet and its three pictures
    #[arg(short, long, value_name = "FILE|DIR")]
    output: String,

    #[command(flatten)]
    how: GivenOptions<OfHow>,

    #[command(flatten)]
    options: GivenOptions<OfComparison>,

    #[command(flatten)]
    preset: PresetFile,

    #[command(flatten)]
    camera: CameraFile,
}

impl Arguments {
    /// Reads a job's options.
    pub(super) fn of_job(job: &JobOptions) -> Result<Self> {
        Ok(Self {
            models: job.models.clone(),
            output: job.output.clone(),
            how: GivenOptions::of_options(&job.options),
            options: GivenOptions::of_options(&job.options),
            preset: job.preset(),
            camera: job.camera(),
        })
    }
}

/// How two styles are compared.
#[derive(Debug, Clone)]
pub(super) struct CompareSettings {
    left: StyleOrLook,
    right: StyleOrLook,
    tolerance: LineTolerance,
    frames: u32,
    json: bool,
}

impl Default for CompareSettings {
    fn default() -> Self {
        let [left, right] = [StyleName::ThreePass, StyleName::Inking].map(StyleOrLook::Style);
        Self { left, right, tolerance: LineTolerance::default(), frames: 11, json: false }
    }
}

/// The names that a side may have: of styles that draw lines, and of looks.
fn list() -> String {
    let looks = LOOKS.iter().filter(|look| look.has_settings()).map(|look| format!(", {}", look.name));
    StyleName::list_with_lines() + &looks.collect::<String>()
}

/// The request that draws a side in the view of another one. A look has its view and size, which the other side then has, too; a
/// style also its colours.
fn request_of(side: StyleOrLook, beside: &Request, of: impl Fn(Option<Look>) -> Result<Request>) -> Result<Request> {
    let mut own = match side {
        StyleOrLook::Look(look) => of(Some(look))?,
        StyleOrLook::Style(style) => {
            let mut own = of(None)?.in_style(style)?;
            (own.scene, own.read) = (beside.scene.clone(), beside.read.clone());
            own
        }
    };
    (own.scene.camera, own.scene.size) = (beside.scene.camera.clone(), beside.scene.size);
    Ok(own)
}

/// All of them.
pub(super) struct OfHow;

impl Selection for OfHow {
    type Of = CompareSettings;
    const HAS_HEADINGS: bool = false;
}

impl HasSettings for CompareSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<CompareSettings>> =
            LazyLock::new(|| Table { settings: settings(), defaults: vec![CompareSettings::default()] });
        &TABLE
    }
}

/// The settings of a comparison of two styles: neither lines nor animation.
struct OfComparison;

impl Selection for OfComparison {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        let is_of_passes = Style::table().has(setting.name) && !is_of_lines_alone(setting.name);
        is_of_passes || SceneSettings::table().has(setting.name) || OfSubject::has(setting) || setting.name == "backend"
    }
}

/// A style that is compared.
fn style(
    name: &'static str,
    help: &'static str,
    field: fn(&mut CompareSettings) -> &mut StyleOrLook,
) -> Setting<CompareSettings> {
    let get = move |how: &CompareSettings| field(&mut how.clone()).name().to_owned();
    let set = move |how: &mut CompareSettings, text: &str| {
        *field(how) = text.parse()?;
        Ok(())
    };
    Setting::of(name, "STYLE|LOOK", Kind::Choice(StyleOrLook::names()), help, get, set).common()
}

fn settings() -> Vec<Setting<CompareSettings>> {
    static LEFT: LazyLock<String> = LazyLock::new(|| format!("Style or look on the left: {}", list()));
    let frames = Setting::field(
        "frames",
        "N",
        "Frames of each style to draw and time after warm-up",
        |how: &mut CompareSettings| &mut how.frames,
    );
    vec![
        style("left", &LEFT, |how| &mut how.left),
        style("right", "Style or look on the right", |how| &mut how.right),
        Setting::field("tolerance", "SHARE", TOLERANCE, |how: &mut CompareSettings| &mut how.tolerance),
        frames.whole(1..=1_000_000).range(1.0, 101.0, 0),
        Setting::flag("json", "Print one JSON record", |how: &CompareSettings| how.json, |how, is_on| how.json = is_on),
    ]
}

/// One of two drawings of a comparison.
#[derive(Debug, Clone, Serialize)]
struct DrawingRecord {
    /// The style with every setting.
    style: Style,
    /// Making the first plan: edge list, classes and planes included, where the style needs them; finding exact lines.
    plan_ms: f64,
    /// The frames after warm-up, each including its plan and reading back, milliseconds.
    frame_ms: Summary,
}

/// Two drawings of one scene and how far their lines agree.
#[derive(Debug, Clone, Serialize)]
struct ComparisonRecord {
    /// tinta's version.
    version: &'static str,
    /// All models together.
    model: ModelRecord,
    /// The picture's size.
    size: Size,
    /// The camera, world space.
    camera: CameraRecord,
    /// The context.
    gl: ContextInfo,
    /// The left drawing.
    left: DrawingRecord,
    /// The right drawing.
    right: DrawingRecord,
    /// Pixels of ink, and how many both have.
    agreement: AgreementNumbers,
    /// Of the ink that the left and the right side draw alone, the pixels within the tolerance of an exact visible line.
    alone_on_lines_px: [usize; 2],
}

/// Frames drawn before measuring.
const WARM_UP: usize = 2;

/// One style's part.
struct Drawing {
    picture: Picture,
    ink: InkMask,
    record: DrawingRecord,
}

pub(super) fn run(arguments: &Arguments, session: &mut Session) -> Result<()> {
    let (preset, camera) = (arguments.preset.preset.as_deref(), arguments.camera.camera.as_deref());
    let of = |look: Option<Look>| {
        let below = Below { look, preset, camera, has_looks: look.is_some(), command: "compare", ..Below::default() };
        arguments.options.request(&arguments.models, &below).map(|(request, _)| request)
    };
    let files: Vec<&str> = preset.into_iter().chain(camera.and_then(Path::to_str)).collect();
    let request = of(None)?;
    let mut compared = || {
        let (how, left) = how_compared(arguments, &request)?;
        let names = named(&request, [(left, how.left), ("right", how.right)])?;
        let look = [how.left, how.right]
            .into_iter()
            .find_map(|side| if let StyleOrLook::Look(look) = side { Some(look) } else { None });
        let beside = if look.is_some() { of(look)? } else { request.clone() };
        let sides = [request_of(how.left, &beside, of)?, request_of(how.right, &beside, of)?];
        compare(arguments, (&how, names), sides, &files, session)
    };
    compared().map_err(|error| request.attributed(error))
}

fn compare(
    arguments: &Arguments,
    (how, names): (&CompareSettings, [&'static str; 2]),
    sides: [Request; 2],
    files: &[&str],
    session: &mut Session,
) -> Result<()> {
    let request = &sides[0];
    tinta::cli::messages::check_output(&arguments.output)?;
    let inputs = Inputs::new(&request.models, &request.options, files);
    inputs.keep(&arguments.output)?;
    inputs.keep_in(Path::new(&arguments.output), NAMES)?;
    let output = Output::check(&arguments.output)?;
    if how.json && matches!(output, Output::File(Target::Stdout)) {
        return Err(Error::value("o", "-", "the sheet and --json cannot share standard output; name a file"));
    }
    let of = |side: &Request| side.still(side.placed(side.models(&session.models)?.meshes)?, false);
    let [left, right] = [of(&sides[0])?, of(&sides[1])?];
    let scene = &left.scene;
    let count = scene.objects.len() / request.scene.copies as usize;
    let renderer = request.renderer(session)?;
    let (drawn, right) = (Drawing::of(&left, renderer, how.frames)?, Drawing::of(&right, renderer, how.frames)?);
    let tolerance_px = how.tolerance.px(scene.size);
    let agreement = Agreement::of(&drawn.ink, &right.ink, tolerance_px.round() as u32)
        .ok_or_else(|| Error::setting("size", "the two pictures came out in different sizes; choose another"))?;
    let map = agreement.picture(scene.size);
    let models: Vec<ModelRecord> = scene.objects[..count].iter().map(|object| ModelRecord::new(&object.mesh)).collect();
    let record = ComparisonRecord {
        version: env!("CARGO_PKG_VERSION"),
        model: ModelRecord::together(&models),
        size: scene.size,
        camera: CameraRecord::new(scene),
        gl: renderer.context().clone(),
        left: drawn.record,
        right: right.record,
        agreement: agreement.numbers,
        alone_on_lines_px: alone_on_lines(
            &agreement,
            &Reference::of(scene, &LineSettings::as_published())?,
            tolerance_px,
        ),
    };
    let panels = [
        panel(names[0], &record.left, drawn.picture),
        panel(names[1], &record.right, right.picture),
        Panel { title: "their lines".to_owned(), subtitle: String::new(), picture: map },
    ];
    let whole = sheet(&panels, &captions(&record, names, &arguments.models));
    output.write(&whole, panels)?;
    let given = arguments.options.options.keys().map(String::as_str);
    ignored_remark(given, &names).iter().for_each(|remark| tinta::cli::say(&format!("tinta: {remark}")));
    if how.json { tinta::cli::print_json(&record) } else { Ok(()) }
}

/// How is compared, and the option that chose the style on the left.
fn how_compared(arguments: &Arguments, request: &Request) -> Result<(CompareSettings, &'static str)> {
    let mut how = arguments.how.settings()?;
    // A preset's style is the one on the left.
    let is_of_preset = request.options.contains_key("style") && !arguments.how.options.contains_key("left");
    if is_of_preset {
        how.left = StyleOrLook::Style(request.style.style_name());
    }
    Ok((how, if is_of_preset { "style" } else { "left" }))
}

/// The names of two styles with lines, each with the option that chose it.
fn named(request: &Request, chosen: [(&str, StyleOrLook); 2]) -> Result<[&'static str; 2]> {
    if request.options.contains_key("no-borders") {
        return Err(Error::setting("no-borders", "compare needs the lines; leave it out"));
    }
    for (option, side) in chosen {
        if matches!(side, StyleOrLook::Style(style) if !style.has_lines()) {
            let problem = format!("this style has no lines to compare; choose one of {}", list());
            return Err(Error::value(option, side.name(), problem));
        }
    }
    Ok(chosen.map(|(_, side)| side.name()))
}

impl Drawing {
    /// Draws the scene for one side, and times so many frames.
    fn of(side: &Resolved, renderer: &mut Renderer, frames: u32) -> Result<Self> {
        if side.contents.lines.is_some() {
            return Self::of_exact_lines(side, renderer, frames);
        }
        let (scene, style) = (&side.scene, &side.request.style);
        let start = Instant::now();
        let plan = style.plan(scene, Show::Final)?;
        let plan_ms = milliseconds_since(start);
        let lines = style.plan(scene, Show::Borders)?;
        renderer.remarks(&plan).iter().for_each(|remark| tinta::cli::say(&format!("tinta: {remark}")));
        let ink = InkMask::of(&renderer.draw(scene, &lines)?);
        let picture = renderer.draw(scene, &plan)?;
        renderer.time_frames(scene, &plan, WARM_UP, 1)?;
        // As in a moving view: silhouettes and light are computed in every frame.
        let frame_ms = timed(frames, || {
            let plan = style.plan(scene, Show::Final)?;
            renderer.time_frames(scene, &plan, 0, 1).map(drop)
        })?;
        let record = DrawingRecord { style: style.clone(), plan_ms, frame_ms };
        Ok(Self { picture, ink, record })
    }

    /// The same where exact lines are drawn, alone or over the picture; a frame finds them anew.
    fn of_exact_lines(side: &Resolved, renderer: &mut Renderer, frames: u32) -> Result<Self> {
        let start = Instant::now();
        let lines = exact_lines(side)?;
        let plan_ms = milliseconds_since(start);
        let mut picture = || match side.contents.below {
            tinta::styles::Below::Passes(_) => side.picture(renderer),
            _ => exact_lines(side),
        };
        let first = picture()?;
        let frame_ms = timed(frames, || picture().map(drop))?;
        let record = DrawingRecord { style: side.request.style.clone(), plan_ms, frame_ms };
        Ok(Self { picture: first, ink: InkMask::of(&lines), record })
    }
}

/// The milliseconds of so many frames.
fn timed(frames: u32, mut frame: impl FnMut() -> Result<()>) -> Result<Summary> {
    let mut time = || {
        let start = Instant::now();
        frame().map(|()| milliseconds_since(start))
    };
    (0..frames).map(|_| time()).collect::<Result<Vec<f64>>>().map(Summary::new)
}

fn panel(name: &str, record: &DrawingRecord, picture: Picture) -> Panel {
    Panel { title: name.to_owned(), subtitle: format!("{:.1} ms a frame", record.frame_ms.median), picture }
}

fn captions(record: &ComparisonRecord, [left, right]: [&str; 2], names_of_models: &[String]) -> Vec<Caption> {
    let AgreementNumbers { tolerance_px, left_px, right_px, only_left_px, only_right_px, .. } = record.agreement;
    let percent = |share: Option<f64>| share.map_or("nothing".to_owned(), |share| format!("{:.1} %", share * 100.0));
    let (left_shared, right_shared) = (percent(record.agreement.left_shared), percent(record.agreement.right_shared));
    let line = |swatch: Option<[u8; 3]>, text: String| Caption { swatch, text };
    let right_of = |alone: usize, on_lines: usize| match alone {
        0 => String::new(),
        _ => format!(", {:.0} % of them on an exact line", on_lines as f64 / alone as f64 * 100.0),
    };
    let [left_right, right_right] = record.alone_on_lines_px;
    let first = &names_of_models[0];
    let file = Path::new(first).file_name().map_or(first.as_str().into(), |name| name.to_string_lossy());
    let others = match names_of_models.len() - 1 {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    vec![
        line(Some(BOTH_COLOR), format!("both: {left_shared} of {left}'s ink, {right_shared} of {right}'s")),
        line(
            Some(LEFT_COLOR),
            format!("only {left}: {only_left_px} of its {left_px} px{}", right_of(only_left_px, left_right)),
        ),
        line(
            Some(RIGHT_COLOR),
            format!("only {right}: {only_right_px} of its {right_px} px{}", right_of(only_right_px, right_right)),
        ),
        line(
            None,
            format!(
                "{file}{others}, {} triangles, {} px, ink within {tolerance_px} px counts as the same, {}",
                record.model.triangles, record.size, record.gl.renderer
            ),
        ),
    ]
}

/// One file, or a folder of four.
enum Output {
    File(Target),
    Folder([Target; 4]),
}

const NAMES: [&str; 4] = ["sheet.png", "left.png", "right.png", "lines.png"];

impl Output {
    fn check(path: &str) -> Result<Self> {
        let is_folder = path.ends_with(['/', std::path::MAIN_SEPARATOR]) || Path::new(path).is_dir();
        if !is_folder {
            return Target::check(path, false).map(Self::File);
        }
        std::fs::create_dir_all(path).map_err(|error| {
            Error::output(path, format!("the folder cannot be created ({error}); choose another")).because(&error)
        })?;
        let file = |name: &str| {
            let file: PathBuf = Path::new(path).join(name);
            Target::check(&file.to_string_lossy(), false)
        };
        Ok(Self::Folder([file(NAMES[0])?, file(NAMES[1])?, file(NAMES[2])?, file(NAMES[3])?]))
    }

    fn write(&self, sheet: &Picture, panels: [Panel; 3]) -> Result<()> {
        match self {
            Self::File(target) => target.write(sheet),
            Self::Folder(targets) => {
                let pictures = [sheet].into_iter().chain(panels.iter().map(|panel| &panel.picture));
                Target::write_all(targets.iter().zip(pictures))
            }
        }
    }
}
