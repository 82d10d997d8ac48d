//! `tinta judge`: any program's drawing of a model against the model's exact lines.

use super::measure::results::Results;
use crate::judge::{Entry, InkColor, JudgeSettings, Judgement, OneToOne, drawing, judge};
use crate::measure::{INK_FROM, Ink, MeasureSettings, Reference, error_picture};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::cli::camera_file;
use tinta::cli::inputs::Inputs;
use tinta::cli::models::load_meshes;
use tinta::cli::options::{Below, CameraFile, GivenOptions, OfSubject, Selection};
use tinta::cli::{Command, Verdict, given};
use tinta::glam::DVec2;
use tinta::pixel::LineTolerance;
use tinta::recipe::{Recipe, option_words};
use tinta::request::{Request, Session};
use tinta::settings::{HasSettings as _, Options, Setting};
use tinta::styles::{Contents, Inking};
use tinta::{Camera, Error, LineSettings, Mesh, Picture, Result, Scene, SceneSettings, Size, Style, StyleName};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta judge a.png --model cow.obj --view 30,15  judge any drawing of this view"],
    offers: |option| if option == "ink" { vec!["dark", "light", "alpha"] } else { Vec::new() },
    ..Command::new("judge", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.words, call.session)
    })
};

/// Judge any program's drawing of a model by the model's exact visible lines
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Drawings: PNG, BMP, TGA, JPEG, PPM or SVG files
    #[arg(value_name = "DRAWING", required = true)]
    drawings: Vec<PathBuf>,

    /// Model that they show: a file, a built-in model, or - for standard input
    #[arg(long, value_name = "MODEL")]
    model: String,

    /// Size of an SVG's picture, in pixels [default: its own]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// Which pixels are ink: dark (on white), light (on black), alpha, or the colour of the lines [default: dark]
    #[arg(long, value_name = "INK", default_value = "dark", hide_default_value = true)]
    ink: InkColor,

    /// Distance within which ink and line count as the same, as a share of the picture's height, at least a pixel [default: 1/256]
    #[arg(long, value_name = "SHARE", default_value = "1/256", hide_default_value = true, allow_hyphen_values = true)]
    tolerance: LineTolerance,

    /// Look for a shift of up to 5 % of the diagonal, a scale of up to 1.1 and a mirror image first, and print the result [default: off]
    #[arg(long)]
    fit: bool,

    /// Folder for results.jsonl (rows are added), plots, pictures of the errors and report.html [default: none]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Names of the drawings in the report, separated by commas [default: their files' names]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    names: Vec<String>,

    /// Seconds that each drawing took, separated by commas, for the plots of error against time [default: unknown]
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', allow_hyphen_values = true)]
    seconds: Vec<f64>,

    /// Name of this machine in the report [default: system, processor, threads]
    #[arg(long, hide_short_help = true, value_name = "NAME")]
    machine: Option<String>,

    /// Print one JSON record for each drawing [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    crease: GivenOptions<OfReference>,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    subject: GivenOptions<OfSubject>,
}

/// The settings of the exact lines, as in `tinta measure`.
struct OfReference;

impl Selection for OfReference {
    type Of = Style;

    fn has(setting: &Setting<Style>) -> bool {
        ["crease-angle", "classes"].contains(&setting.name)
    }
}

/// The record printed with `--json`.
#[derive(Serialize)]
struct Record<'a> {
    version: &'static str,
    drawing: &'a str,
    model: &'a str,
    size: Size,
    #[serde(flatten)]
    judgement: &'a Judgement,
}

/// Judges the drawings; exit code 1 if one looks like something other than lines of this view.
pub(super) fn run(arguments: &Arguments, command: &str, session: &mut Session) -> Result<Verdict> {
    let mut verdict = Verdict::Good;
    let names = names(arguments)?;
    let settings = JudgeSettings { tolerance: arguments.tolerance, fits: arguments.fit };
    let drawings = arguments.drawings.iter().map(|path| drawing::read(path, arguments.size));
    let drawings = drawings.collect::<Result<Vec<_>>>()?;
    // A picture by tinta is judged from where it was drawn.
    let has_recipe = |path: &&PathBuf| Recipe::read(path).is_ok();
    let by_tinta = arguments.drawings.first().filter(has_recipe).map(PathBuf::as_path);
    let camera = arguments.camera.camera.as_deref().or(by_tinta);
    let below = Below { camera, ..Below::default() };
    let (request, _) = arguments.subject.request(std::slice::from_ref(&arguments.model), &below)?;
    let meshes = load_meshes(&request.models, &request.read)?;
    let mut results = results(arguments, &request, &names)?;
    let mut subject: Option<Subject> = None;
    for (index, (name, picture)) in names.iter().zip(&drawings).enumerate() {
        if subject.as_ref().is_none_or(|subject| subject.scene.size != picture.size) {
            subject = Some(Subject::new(arguments, &request, meshes.clone(), picture.size)?);
        }
        let Some(Subject { scene, reference }) = &subject else { continue };
        let is_said = say_other_camera(&arguments.drawings[index], scene);
        let ink = match arguments.ink {
            InkColor::Dark => lines_over(&arguments.drawings[index], &arguments.model, picture, session)?,
            _ => None,
        };
        let ink = ink.unwrap_or_else(|| arguments.ink.of(picture));
        let judgement = judge(&ink, reference, &settings)?;
        if arguments.json {
            let version = env!("CARGO_PKG_VERSION");
            let record =
                Record { version, drawing: name, model: &arguments.model, size: scene.size, judgement: &judgement };
            tinta::cli::print_json(&record)?;
        } else {
            tinta::cli::print(&in_words(name, scene.size, &judgement))?;
        }
        if let Some(doubt) = &judgement.doubt {
            if !is_said {
                tinta::cli::say(&format!("tinta: {}: {doubt}", arguments.drawings[index].display()));
            }
            verdict = Verdict::Different;
        }
        if let Some(results) = &mut results {
            let entry = Entry {
                name: name.clone(),
                model: arguments.model.clone(),
                machine: arguments.machine.clone().unwrap_or_else(|| MeasureSettings::default().machine),
                seconds: arguments.seconds.get(index).copied().unwrap_or_default(),
            };
            let errors = match &judgement.fit {
                Some(fit) => error_picture(&ink, &reference.moved(|px| fit.apply(px)), settings.tolerance.px(ink.size)),
                None => error_picture(&ink, reference, settings.tolerance.px(ink.size)),
            };
            results.add(entry.row(scene, &judgement), [picture, &errors])?;
        }
    }
    if let Some(results) = results {
        tinta::cli::say(&format!("tinta: {}", results.report(command)?));
    }
    Ok(verdict)
}

/// The report's folder that the arguments name, if they name one; drawings of these names replace those of before.
fn results<'a>(arguments: &'a Arguments, request: &Request, names: &[String]) -> Result<Option<Results<'a>>> {
    let Some(path) = arguments.output.as_deref() else { return Ok(None) };
    let files: Vec<&str> = arguments.camera.camera.as_deref().and_then(Path::to_str).into_iter().collect();
    Inputs::new(&request.models, &request.options, &files).keep_in(path, super::measure::WRITTEN)?;
    let mut results = Results::open(path, true)?;
    results.show_known(|row| !names.contains(&row.style) || row.model != arguments.model);
    Ok(Some(results))
}

/// A scene of a drawing's size and its lines.
struct Subject {
    scene: Scene,
    reference: Reference,
}

impl Subject {
    fn new(arguments: &Arguments, request: &Request, meshes: Vec<Arc<Mesh>>, size: Size) -> Result<Self> {
        let style = Style::with_options(StyleName::Inking, &arguments.crease.options)?;
        let Inking { crease_angle, .. } = if let Style::Inking(inking) = style { inking } else { Inking::default() };
        let settings = SceneSettings { size, ..request.scene.clone() };
        let scene = Scene::new(meshes, &settings)?;
        let LineSettings { classes, .. } = LineSettings::from_options(&arguments.crease.options)?;
        let lines = LineSettings { classes, crease_angle, ..LineSettings::as_published() };
        let reference = Reference::with_hidden(&scene, &lines)?;
        Ok(Self { scene, reference })
    }
}

/// The ink of exact lines over a picture of a model by tinta: what darkens the picture that its recipe draws without them. `None` for
/// other pictures.
fn lines_over(path: &Path, model: &str, picture: &Picture, session: &mut Session) -> Result<Option<Ink>> {
    let Ok(recipe) = Recipe::read(path) else { return Ok(None) };
    // The recipe of an earlier version may have options that are gone.
    let Ok(request) = Request::from_given(&recipe.options) else { return Ok(None) };
    let mut request = request.with_models(vec![model.to_owned()]);
    let Contents { below: tinta::styles::Below::Passes(style), lines: Some(_), .. } = request.contents(false)? else {
        return Ok(None);
    };
    if !request.animation.is_still() || model == "-" {
        return Ok(None);
    }
    if recipe.not_granted(&Options::new()).is_some() {
        let problem = "its recipe has shaders, or files outside its model's folder, which this command does not use; judge lines alone";
        return Err(Error::picture(path, problem));
    }
    (request.style, request.exact_lines) = (*style, false);
    let (resolved, renderer) = request.resolved_and_renderer(session)?;
    let below = resolved.picture(renderer)?;
    Ok((below.size == picture.size).then(|| Ink::over(&below, picture)))
}

/// Warns if the recipe of a picture by tinta has another view than the judge; returns whether it does.
fn say_other_camera(drawing: &Path, scene: &Scene) -> bool {
    let Ok(recipe) = Recipe::read(drawing) else { return false };
    let options = camera_file::of_camera(recipe.options);
    let words: Vec<String> = options.iter().flat_map(|(name, value)| option_words(name, value)).collect();
    let Ok(settings) = SceneSettings::from_options(&options) else { return false };
    let meshes: Vec<Arc<Mesh>> = scene.objects.iter().map(|object| object.mesh.clone()).collect();
    let Ok(drawn) = Scene::new(meshes, &SceneSettings { size: scene.size, ..settings }) else { return false };
    let is_elsewhere = largest_shift_px(scene, &drawn.camera) > 1.0;
    if is_elsewhere {
        let from = if words.is_empty() { "the default view".to_owned() } else { words.join(" ") };
        let path = drawing.display();
        tinta::cli::say(&format!(
            "tinta: {path} was drawn from elsewhere ({from}); --camera {path} judges it from there"
        ));
    }
    is_elsewhere
}

/// How far a corner of the scene moves at most if another camera sees it, pixels.
fn largest_shift_px(scene: &Scene, other: &Camera) -> f64 {
    /// Number of positions tested for each object.
    const ASKED: usize = 256;
    let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
    let [own, other] =
        [&scene.camera, other].map(|camera| camera.clip_from_view(size.x / size.y) * camera.view_from_world());
    let shifts = scene.objects.iter().flat_map(|object| {
        let positions = object.mesh.positions.iter().step_by(object.mesh.positions.len() / ASKED + 1);
        positions.map(|position| {
            let [own, other] = [own, other].map(|clip| clip.project_point3(*position + object.offset).truncate());
            ((own - other) * size * 0.5).length()
        })
    });
    shifts.fold(0.0, f64::max)
}

/// The drawings' names, after checking that each list of values has one for each drawing.
fn names(arguments: &Arguments) -> Result<Vec<String>> {
    let count = arguments.drawings.len();
    let check = |option: &str, given: usize| match given {
        0 => Ok(()),
        given if given == count => Ok(()),
        given => Err(Error::setting(option, format!("{given} are given for {count} drawings; give one for each"))),
    };
    check("names", arguments.names.len())?;
    check("seconds", arguments.seconds.len())?;
    if let Some(seconds) = arguments.seconds.iter().find(|seconds| !(**seconds > 0.0 && seconds.is_finite())) {
        return Err(Error::value("seconds", seconds, "a time is a number of seconds above 0"));
    }
    let file = |path: &PathBuf| path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    Ok(match arguments.names.is_empty() {
        true => arguments.drawings.iter().map(file).collect(),
        false => arguments.names.clone(),
    })
}

fn in_words(name: &str, size: Size, judgement: &Judgement) -> String {
    let Judgement { lines, one_to_one, hidden, fit, .. } = judgement;
    let mut text = format!("{name}, {size} px\n");
    let mut line = |title: &str, words: String| text.push_str(&format!("  {title:<19}{words}\n"));
    let percent = |share: f64| format!("{:.1} %", share * 100.0);
    if judgement.doubt.is_some() {
        line("not scored", "these do not look like lines of this view; --json has the numbers".to_owned());
        return text;
    }
    line(
        "F1",
        format!(
            "{:.3}: {} of the lines found, {} of the ink on them, within {} px",
            lines.f1,
            percent(lines.recall),
            percent(lines.precision),
            lines.tolerance_px
        ),
    );
    line("average precision", format!("{:.3}", lines.average_precision));
    let score = |one: &OneToOne| format!("{:.3} within {:.3} px", one.f1, one.distance_px).replace(".000 px", " px");
    line("one to one", one_to_one.iter().map(score).collect::<Vec<_>>().join(", "));
    if let (Some(chamfer), Some(hausdorff)) = (judgement.chamfer_px, judgement.hausdorff_95_px) {
        line(
            "distance",
            format!("{chamfer:.2} px in the mean (Chamfer), {hausdorff:.2} px for 95 % of it (Hausdorff)"),
        );
    } else {
        line("distance", format!("none: no ink from darkness {INK_FROM} of 255 on, or no line"));
    }
    line("hidden lines", format!("{:.1} of {:.1} px are drawn", hidden.drawn_px, hidden.length_px));
    let classes: Vec<String> =
        lines.recall_of_class.iter().map(|(class, recall)| format!("{class} {}", percent(*recall))).collect();
    if !classes.is_empty() {
        line("found of", classes.join(", "));
    }
    if let Some(fit) = fit {
        line("fit", fit.to_string());
    }
    text
}
