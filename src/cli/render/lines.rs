//! `tinta render` of exact lines, into an SVG, PDF, JSON or picture's file. No OpenGL is opened.

mod turn;

use super::super::messages::is_captured;
use super::super::model_cache::ModelCache;
use super::super::models::{ReadModels, load_models};
use super::super::progress::Progress;
use super::super::signals::Stop;
use super::super::{Verdict, say};
use super::{Arguments, explain, keep, model_records};
use crate::choice::meant_or;
use std::path::Path;
use std::str::FromStr;
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};
use tinta::edges::SilhouetteRule;
use tinta::lines::{
    Hidden, LinePath, LineSettings, Phase, Progress as LineProgress, Raster, chain, pdf_of_paths, raster_of_paths,
    strokes_of_paths, svg_of_paths,
};
use tinta::picture::{Note, PictureFormat};
use tinta::preset::Options;
use tinta::record::{CameraRecord, LineCounts, LinesRecord, LinesStyle, ModelRecord, lines_json};
use tinta::renderer::milliseconds_since;
use tinta::settings::names_of;
use tinta::{Error, Picture, Recipe, Result, Scene, Show, StyleName, SvgSettings, Target, TextTarget, VisibleLines};

/// What `--style` takes: a style that GL draws, or lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum StyleChoice {
    Picture(StyleName),
    Lines,
}

impl StyleChoice {
    /// As the user writes it.
    #[cfg(feature = "window")]
    pub(in crate::cli) fn name(self) -> &'static str {
        match self {
            Self::Picture(style) => style.name(),
            Self::Lines => "lines",
        }
    }
}

impl FromStr for StyleChoice {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        if text == "lines" {
            return Ok(Self::Lines);
        }
        let names: Vec<&str> = names_of::<StyleName>().into_iter().chain(["lines"]).collect();
        let otherwise = format!("choose one of {}", names.join(", "));
        text.parse().map(Self::Picture).map_err(|_| meant_or(text, &names, &otherwise))
    }
}

fn refuse_given(given: &[(&str, bool)], problem: &str) -> Result<()> {
    match given.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(Error::setting(*option, problem)),
        None => Ok(()),
    }
}

/// The files lines are written to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Pdf,
    Json,
    /// Pixels, in the format of the file's name.
    Picture,
}

impl Format {
    /// What a file of this name is, if it holds lines.
    fn of(output: &str) -> Option<Self> {
        match extension(output).map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => Some(Self::Svg),
            Some("pdf") => Some(Self::Pdf),
            Some("json") => Some(Self::Json),
            _ => None,
        }
    }
}

/// Whether a file of this name holds lines.
pub(in crate::cli) fn is_of_lines(output: &str) -> bool {
    Format::of(output).is_some()
}

fn extension(output: &str) -> Option<&str> {
    Path::new(output).extension().and_then(|extension| extension.to_str())
}

/// The format if lines are asked for: by the file's name, or by the style for standard output.
pub(super) fn format(arguments: &Arguments) -> Result<Option<Format>> {
    let output = &arguments.output;
    let (extension, format) = (extension(output), Format::of(output));
    let refuse = |problem: String| Err(Error::output(output.clone(), problem));
    match (arguments.style, format) {
        (None | Some(StyleChoice::Lines), Some(format)) => Ok(Some(format)),
        (Some(StyleChoice::Lines), None) if output == "-" => Ok(Some(Format::Svg)),
        (Some(StyleChoice::Lines), None) if PictureFormat::of(Path::new(output)).is_some() => Ok(Some(Format::Picture)),
        (Some(StyleChoice::Lines), None) => refuse(
            "style lines writes .svg, .pdf, .json or a still picture such as .png; name the file so, or leave out --style lines"
                .to_owned(),
        ),
        (Some(StyleChoice::Picture(name)), Some(_)) => refuse(format!(
            "{} draws pixels; --look technical in its place writes lines, or name a picture such as drawing.png",
            arguments.keep.said_style(name)
        )),
        // What is no picture either is refused with all there is to choose from.
        (_, None) if output == "-" || Path::new(output).is_dir() => Ok(None),
        (_, None) => match extension {
            Some(extension) if !is_of_a_picture(extension) => refuse(format!(
                "nothing is written as .{extension}; use .png, .jpg, .bmp, .tga or .ppm for a picture, .svg, .pdf or .json for \
                 lines, .gif or .apng for an animation"
            )),
            _ => Ok(None),
        },
    }
}

fn is_of_a_picture(extension: &str) -> bool {
    let extension = extension.to_ascii_lowercase();
    ["png", "jpg", "jpeg", "bmp", "tga", "ppm", "gif", "apng"].contains(&extension.as_str())
}

/// Finds the lines and writes them.
pub(super) fn run(
    arguments: &Arguments,
    options: &Options,
    format: Format,
    model_cache: &ModelCache,
) -> Result<Verdict> {
    let views = arguments.animation.turntable;
    match views {
        Some(_) => check_output(arguments, &turn::names(&arguments.output, format)?.with(1), format)?,
        None => check_output(arguments, &arguments.output, format)?,
    }
    refuse_what_lines_have_not(arguments, format)?;
    let progress = progress(arguments)?;
    // A job of a batch leaves signals to its run.
    let stop = (!is_captured()).then(Stop::on_signals);
    if let Some(views) = views {
        return turn::run(arguments, format, views, model_cache, stop.as_ref());
    }
    let mut settings = asked_lines(arguments, format)?;
    settings.finds_hidden |= arguments.run.json || arguments.run.explain;
    let is_told = arguments.run.json || arguments.run.explain;
    settings.counts_changes = is_told && settings.silhouette == SilhouetteRule::Smooth;
    let start = Instant::now();
    let ReadModels { meshes, files, .. } = load_models(model_cache, &arguments.models, &arguments.model.settings()?)?;
    let load_ms = milliseconds_since(start);
    let scene = Scene::new(meshes, &arguments.scene_settings()?)?;
    let lines = match watched(&progress, stop.as_ref(), || VisibleLines::with_progress(&scene, &settings, &progress)) {
        Err(Error::Cancelled) => return Ok(stopped(stop.as_ref())),
        found => found?,
    };
    scene.crack_remarks().iter().for_each(|remark| say(&format!("tinta: {remark}")));
    if let Some(healed) = lines.healed_note() {
        say(&format!("tinta: {}: {healed}", arguments.output));
    }
    if !lines.segments.iter().any(|segment| segment.is_visible) {
        say("tinta: no line of these classes is visible in this picture; see --classes, --eye and --target");
    }

    let start = Instant::now();
    let asked = svg_settings(arguments, None)?;
    let keeps_all = format == Format::Json && asked.min_length.is_none();
    let drawn_lines = || lines.without_specks_with_progress(&asked, &progress);
    let lines = match if keeps_all { None } else { Some(watched(&progress, stop.as_ref(), drawn_lines)) } {
        None => lines,
        Some(Err(Error::Cancelled)) => return Ok(stopped(stop.as_ref())),
        Some(drawn) => drawn?,
    };
    let note = lines.partial_note();
    if let Some(note) = &note {
        say(&format!("tinta: {}: {note}", arguments.output));
    }
    let recipe = match format {
        // What there is of a part depends on the machine: nothing makes it again.
        _ if note.is_some() => None,
        Format::Svg | Format::Pdf | Format::Picture => {
            let files = keep::files(arguments, &scene, &files, None);
            keep::recipe(arguments, options, scene.size, files, None)
        }
        Format::Json => None,
    };
    let drawn = svg_settings(arguments, recipe.as_ref())?;
    let is_chained = format != Format::Json || arguments.run.json || arguments.run.explain;
    let mut paths = if is_chained { chain(&lines.segments) } else { Vec::new() };
    if format != Format::Json && drawn.hidden == Hidden::None {
        paths.retain(|path| path.is_visible);
    }
    let counts = LineCounts::new(&lines, &paths);
    if is_stopped(stop.as_ref()) {
        return Ok(stopped(stop.as_ref()));
    }
    let pens = match arguments.run.explain && drawn.is_for_pen {
        true => explain::pens(&strokes_of_paths(&lines, paths.clone(), &drawn)?),
        false => String::new(),
    };
    let said = note.map(comment).or_else(|| recipe.as_ref().and_then(Recipe::note));
    write(arguments, format, &arguments.output, &scene, (&lines, paths), &drawn, said.as_ref())?;
    let lines_ms = milliseconds_since(start);
    if arguments.run.explain {
        super::super::print(&(explain::lines(&lines, &counts, load_ms, lines_ms) + &pens))?;
    }
    if !arguments.run.json {
        return Ok(Verdict::Good);
    }
    let models = model_records(&scene, arguments.models.len());
    let mut model = ModelRecord::together(&models);
    model.defects.covered_triangles = lines.covered_triangles;
    super::super::print_json(&LinesRecord {
        version: env!("CARGO_PKG_VERSION"),
        model,
        models,
        load: arguments.model.settings()?,
        copies: arguments.scene_settings()?.copies,
        triangles: scene.triangle_count(),
        style: LinesStyle { lines: settings, svg: (format != Format::Json).then_some(drawn) },
        size: scene.size,
        camera: CameraRecord::new(&scene),
        edges: lines.edges,
        changes: lines.changes,
        healed: lines.healed,
        undecided: lines.undecided,
        counts,
        load_ms,
        times: lines.times,
        lines_ms,
    })
    .map(|()| Verdict::Good)
}

/// The lines that a format needs: what is neither drawn nor told of is not looked for.
fn asked_lines(arguments: &Arguments, format: Format) -> Result<LineSettings> {
    let asked = svg_settings(arguments, None)?;
    asked.check()?;
    // A file of all pieces says of each; a drawing is cut only where that shows.
    let finds_outline = format == Format::Json || asked.tells_outline();
    let finds_hidden = format == Format::Json || asked.hidden != Hidden::None;
    Ok(LineSettings { finds_outline, finds_hidden, ..arguments.styles.line_settings(&arguments.forms)? })
}

/// Writes a drawing; a picture with what is said in it.
fn write(
    arguments: &Arguments,
    format: Format,
    output: &str,
    scene: &Scene,
    (lines, paths): (&VisibleLines, Vec<LinePath>),
    drawn: &SvgSettings,
    said: Option<&Note>,
) -> Result<()> {
    let write = |bytes: Vec<u8>| TextTarget::check(output)?.write_bytes(&bytes);
    match format {
        Format::Svg => write(svg_of_paths(lines, paths, drawn)?.into_bytes()),
        Format::Pdf => write(pdf_of_paths(lines, paths, drawn)?),
        Format::Json => write(lines_json(lines, scene)?.into_bytes()),
        Format::Picture => {
            let Raster { size, pixels } = raster_of_paths(lines, paths, drawn)?;
            let target = Target::check(output, arguments.scene.is_transparent())?;
            target.write_with(&Picture { size, pixels }, said)
        }
    }
}

/// What a picture says of lines that are a part.
fn comment(text: String) -> Note {
    Note { keyword: "Comment", text }
}

fn is_stopped(stop: Option<&Stop>) -> bool {
    stop.is_some_and(Stop::is_asked)
}

/// The time that the lines may take, from now on.
fn progress(arguments: &Arguments) -> Result<LineProgress> {
    let Some(seconds) = arguments.run.within else { return Ok(LineProgress::default()) };
    let limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
    Ok(if arguments.run.partial { LineProgress::within_or_part(limit) } else { LineProgress::within(limit) })
}

/// What a signal has ended.
fn stopped(stop: Option<&Stop>) -> Verdict {
    say("tinta: stopped by a signal; nothing was written");
    Verdict::Stopped { signal: stop.map_or(0, Stop::signal) }
}

/// Writes nothing yet: checks that the file can be written.
fn check_output(arguments: &Arguments, output: &str, format: Format) -> Result<()> {
    match format {
        Format::Picture => Target::check(output, arguments.scene.is_transparent()).map(drop),
        Format::Svg | Format::Pdf | Format::Json => TextTarget::check(output).map(drop),
    }
}

/// How often the progress bar is looked after, and how long work takes before it gets one.
const GLANCE: Duration = Duration::from_millis(200);

/// Work on lines, on a thread of its own so that this one can say how far it is.
fn watched<T: Send>(progress: &LineProgress, stop: Option<&Stop>, work: impl Fn() -> Result<T> + Sync) -> Result<T> {
    std::thread::scope(|scope| {
        let (sender, receiver) = std::sync::mpsc::channel();
        let work = &work;
        let start = std::thread::Builder::new().spawn_scoped(scope, move || {
            // Whoever waited may have given up.
            let _ = sender.send(work());
        });
        if start.is_err() {
            return work();
        }
        let mut bar: Option<(Phase, Progress)> = None;
        loop {
            match receiver.recv_timeout(GLANCE) {
                Ok(done) => return done,
                Err(RecvTimeoutError::Timeout) => {
                    if stop.is_some_and(Stop::is_asked) {
                        progress.cancel();
                    }
                    let (phase, (done, total)) = (progress.phase(), progress.state());
                    // Of each phase the time left is that of its own steps.
                    let (_, bar) = match bar.take().filter(|(known, _)| *known == phase) {
                        Some(known) => bar.insert(known),
                        None => bar.insert((phase, Progress::new(word(phase), 0))),
                    };
                    if total == 0 { bar.wait() } else { bar.set(done as u64, total as u64) }
                }
                // The thread has panicked; the scope passes that on.
                Err(RecvTimeoutError::Disconnected) => return work(),
            }
        }
    })
}

/// What is done in a phase.
fn word(phase: Phase) -> &'static str {
    match phase {
        Phase::Preparing => "preparing lines",
        Phase::Intersections => "finding intersections",
        Phase::Lines => "finding lines",
        Phase::Contours => "finding smooth silhouettes",
        Phase::TooShort => "leaving out specks",
    }
}

/// How the SVG is to be written. Its command has a name of its own for the output: the same drawing is the same bytes wherever
/// it is written.
pub(super) fn svg_settings(arguments: &Arguments, recipe: Option<&Recipe>) -> Result<SvgSettings> {
    let name = if arguments.output.to_ascii_lowercase().ends_with(".pdf") { "drawing.pdf" } else { "drawing.svg" };
    let names =
        arguments.models.iter().map(|path| Path::new(path).file_name().map_or(path.into(), |n| n.to_string_lossy()));
    Ok(SvgSettings {
        title: names.collect::<Vec<_>>().join(", "),
        command: recipe.map(|recipe| recipe.command_line(name)).unwrap_or_default(),
        recipe: recipe.and_then(Recipe::json).unwrap_or_default(),
        background: arguments.scene_settings()?.background,
        ..arguments.styles.svg_settings(&arguments.lines)?
    })
}

/// What to say of paper where pixels are written.
pub(super) fn pixels_on_paper(arguments: &Arguments) -> String {
    /// Dots an inch of a print.
    const DPI: f64 = 300.0;
    let page = svg_settings(arguments, None).map(|settings| settings.page_size.pixels(DPI));
    match page {
        Ok(Some(size)) => {
            format!("a picture has pixels and no paper; for {DPI} dpi say --size {size}, or write a .svg")
        }
        _ => "a picture has pixels and no paper; say --size, or write a .svg".to_owned(),
    }
}

/// The options that are about paper.
pub(super) const OF_PAPER: [&str; 4] = ["page", "width-mm", "dpi", "margin"];

fn refuse_what_lines_have_not(arguments: &Arguments, format: Format) -> Result<()> {
    let run = &arguments.run;
    refuse_given(
        &[
            ("dump", run.dump.is_some()),
            ("frames", run.frames != 1),
            ("show", arguments.styles.show != Show::Final),
            ("animate", arguments.animation.animate.is_some()),
        ],
        "style lines has no passes and no model's frames; leave it out, or name a picture such as drawing.png",
    )?;
    refuse_given(
        &[("explain", run.explain && arguments.animation.turntable.is_some())],
        "a turn has many views and it tells of one; leave out --turntable",
    )?;
    let holds_note = format != Format::Picture
        || arguments.output == "-"
        || PictureFormat::of(Path::new(&arguments.output)) == Some(PictureFormat::Png);
    refuse_given(
        &[("partial", run.partial && !holds_note)],
        "this format has no place to say that the drawing is a part; write a .svg, .pdf, .json or .png",
    )?;
    refuse_given(
        &[("no-borders", arguments.styles.are_without_borders())],
        "style lines draws nothing but lines; leave it out",
    )?;
    refuse_given(
        &[("-o -", arguments.output == "-" && (run.json || run.explain))],
        "the drawing and --json or --explain cannot share standard output; name a file",
    )?;
    match format {
        Format::Svg => Ok(()),
        Format::Pdf => {
            let is_given = arguments.lines.options.contains_key("provenance");
            refuse_given(&[("provenance", is_given)], "a .pdf file has no place for it; leave it out, or write a .svg")
        }
        Format::Picture => {
            let is_given = |name: &str| arguments.lines.options.contains_key(name);
            refuse_given(
                &["provenance", "pen", "fit-curves"].map(|name| (name, is_given(name))),
                "a picture has pixels and no paths; leave it out, or write a .svg",
            )?;
            refuse_given(&OF_PAPER.map(|name| (name, is_given(name))), &pixels_on_paper(arguments))
        }
        Format::Json => {
            let problem = "a .json file holds all lines but no appearance; leave it out, or write a .svg";
            arguments.lines.refuse_but("min-length", problem)
        }
    }
}
