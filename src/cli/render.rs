//! `tinta render`: models to a picture, an animation or lines.

mod animate;
mod explain;
mod keep;
mod lines;
mod prune;
mod rendering;
#[cfg(test)]
mod round_trip_tests;
mod watched;

pub use animate::views;

use super::Verdict;
use super::batch::JobOptions;
use super::inputs::Inputs;
use super::options::{Below, CameraFile, GivenOptions, Looks, NamedLooks, OfRequest, PresetFile};
use super::run_settings::{OfRun, RunSettings, is_of_one_run};
use super::{Command, given};
use rendering::{Rendering, pictures_of};
use std::path::Path;
use tinta::lines::{DrawingFormat, Progress};
use tinta::mesh::BUILTINS;
use tinta::picture::write_rgba_png;
use tinta::preset::{LOOKS, Look};
use tinta::record::{DrawingFacts, PictureMade, Summary};
use tinta::request::{DrawnPicture, Request, Session, Times};
use tinta::settings::refuse_exclusive;
use tinta::{Error, Recipe, Renderer, Result, Target};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta render cow.obj -o cow.png                 draw it into this file",
        "tinta render builtin:bust -o bust.png           draw a built-in model",
        "tinta render cow.obj -o cow.png --style ink     choose a style",
        "tinta render cow.obj -o cow.svg                 write it as vectors",
        "tinta render cow.obj -o cow.gif --turntable 60  turn the model once around",
        "tinta render cow.obj -o cow.png --preset a.toml read options from a file",
        "tinta render cow.obj -o looks --look all        draw it in every look",
    ],
    job: Some(|job| {
        let arguments = Arguments::of_job(job)?;
        let (request, _) = arguments.asked()?;
        animate::check_name(&request.animation, &job.output)?;
        request.drawing_format(&job.output)?;
        Ok(Box::new(move |session| run(&arguments, session)))
    }),
    told: is_drawn,
    has_in_jobs: |name| name == "look" || GivenOptions::<OfRun>::has(name) || GivenOptions::<OfRequest>::has(name),
    ..Command::new("render", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.session)
    })
};

/// Draw models into a picture, an animation or a line drawing
#[derive(clap::Args)]
#[command(after_help = after_help())]
pub(super) struct Arguments {
    /// Model files (FORMATS), built-in models, or - for standard input; several make one scene
    #[arg(required = true, value_name = "MODEL")]
    pub models: Vec<String>,

    /// File to write: .png .jpg .bmp .tga .ppm, or - for PNG on standard output; lines: DRAWINGS; animations: .gif .apng frame-%04d.png
    #[arg(short, long, value_name = "FILE")]
    pub output: String,

    #[command(flatten)]
    pub options: GivenOptions<OfRequest>,

    #[command(flatten)]
    pub run: GivenOptions<OfRun>,

    #[command(flatten)]
    pub look: NamedLooks,

    #[command(flatten)]
    pub preset: PresetFile,

    #[command(flatten)]
    pub camera: CameraFile,
}

impl Arguments {
    /// Reads a job's options.
    pub(super) fn of_job(job: &JobOptions) -> Result<Self> {
        Ok(Self {
            models: job.models.clone(),
            output: job.output.clone(),
            options: GivenOptions::of_options(&job.options),
            run: GivenOptions::of_options(&job.options),
            look: NamedLooks { looks: job.look()?.map(Looks::One) },
            preset: job.preset(),
            camera: job.camera(),
        })
    }

    /// Returns the request, and the options without effect.
    fn asked(&self) -> Result<(Request, Vec<String>)> {
        self.asked_in(self.look.looks.and_then(Looks::one), &self.output)
    }

    /// Returns the request for an output in a look, and the options without effect.
    pub(super) fn asked_in(&self, look: Option<Look>, output: &str) -> Result<(Request, Vec<String>)> {
        let below = Below {
            look,
            preset: self.preset.preset.as_deref(),
            camera: self.camera.camera.as_deref(),
            draws_lines: DrawingFormat::of_name(output).is_some_and(|format| {
                // Areas are drawn from one view.
                format.is_of_lines_alone || self.options.options.contains_key("turntable")
            }),
            has_looks: true,
            command: "render",
        };
        self.options.request(&self.models, &below)
    }
}

/// Frames drawn before measuring: the driver compiles in the first and settles in the second.
const WARM_UP: usize = 2;

/// Most frames drawn again to time single passes.
const PASS_FRAMES: usize = 21;

/// Returns the request of a command line of this command, the program's name first, and its output.
///
/// # Errors
///
/// Those of the options.
pub fn asked_by(words: &[String]) -> Result<(Request, String)> {
    let matches =
        <Arguments as clap::Args>::augment_args(clap::Command::new("render")).try_get_matches_from(&words[1..]);
    let matches = matches.map_err(|error| Error::CommandLine { problem: error.to_string() })?;
    let arguments: Arguments = given(&matches)?;
    Ok((arguments.asked()?.0, arguments.output))
}

/// Whether a job's picture says by its recipe that it need not be drawn; `None` where no recipe is there, or where it would not tell
/// all that the job does.
fn is_drawn(job: &JobOptions) -> Option<bool> {
    let recipe = Recipe::read(Path::new(&job.output)).ok()?;
    let (request, _) = Arguments::of_job(job).and_then(|arguments| arguments.asked()).ok()?;
    match job.options.keys().any(|option| is_of_one_run(option)) {
        true => None,
        false => keep::is_drawn(&request, &recipe, Path::new(&job.output)),
    }
}

/// Draws the arguments' models.
pub(super) fn run(arguments: &Arguments, session: &mut Session) -> Result<Verdict> {
    drawn(arguments, arguments.look.looks.and_then(Looks::one), &arguments.output, session)
}

/// Draws them in a look into a file.
pub(super) fn drawn(arguments: &Arguments, look: Option<Look>, output: &str, session: &mut Session) -> Result<Verdict> {
    let (request, remarks) = arguments.asked_in(look, output)?;
    let run = arguments.run.settings()?;
    let both = arguments.options.options.iter().chain(&arguments.run.options);
    refuse_exclusive(&both.map(|(name, value)| (name.clone(), value.clone())).collect())?;
    let presets = [arguments.preset.preset.as_deref(), arguments.camera.camera.as_deref().and_then(Path::to_str)];
    let verdict = render(&request, &run, output, &presets.into_iter().flatten().collect::<Vec<_>>(), session);
    let verdict = verdict.map_err(|error| request.attributed(error))?;
    // After drawing: a refusal prints one sentence only.
    remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    Ok(verdict)
}

/// Draws a request into a file; `presets` are files that it was made of.
pub(super) fn render(
    request: &Request,
    run: &RunSettings,
    output: &str,
    presets: &[&str],
    session: &mut Session,
) -> Result<Verdict> {
    super::messages::check_output(output)?;
    let is_folder = output.ends_with(std::path::is_separator) || Path::new(output).is_dir();
    if output.contains("{name}") || request.models.len() > 1 && is_folder {
        let problem = "tinta render makes one picture of all models; tinta batch in its place makes one of each";
        return Err(Error::output(output, problem));
    }
    if output != "-" {
        crate::output::check_name(Path::new(output))?;
    }
    let inputs = Inputs::new(&request.models, &request.options, presets);
    inputs.keep(output)?;
    let preset = keep::preset_target(run.save_preset.as_deref(), output, &inputs)?;
    let rendering = Rendering { request, run, output };
    let format = request.drawing_format(output)?;
    animate::check_name(&request.animation, output)?;
    let verdict = match format {
        Some(format) => lines::run(&rendering, format, session)?,
        None => picture(&rendering, session)?,
    };
    preset.map_or(Ok(()), |target| keep::save_preset(&target, &request.options)).map(|()| verdict)
}

fn picture(rendering: &Rendering<'_>, session: &mut Session) -> Result<Verdict> {
    let Rendering { request, run, output } = *rendering;
    run.refuse_for_pictures()?;
    let is_transparent = request.is_transparent();
    if let Some(target) = animate::target(&request.animation, output, is_transparent)? {
        return animate::run(rendering, &target, session);
    }
    let target = Target::check(output, is_transparent)?;
    if target == Target::Stdout && run.is_told() {
        return Err(Error::value(
            "o",
            "-",
            "the picture and --json or --explain cannot share standard output; name a file",
        ));
    }
    make_dump_folder(run.dump.as_deref(), output)?;
    session.submission = run.submission;
    let progress = Progress::default();
    let drawn = watched::watched(&progress, None, || request.picture(session, &progress))?;
    let DrawnPicture { resolved, files, published, picture, .. } = &drawn;
    let scene = resolved.lit();
    drawn.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    // Known only now.
    pictures_of(scene).keep(output)?;
    let renderer = request.renderer(session)?;
    let recipe = keep::recipe(rendering, resolved, files, Some(renderer.context()));
    target.write_with(picture, recipe.and_then(|recipe| recipe.note()).as_ref())?;
    if let Some(folder) = &run.dump {
        for (number, step) in renderer.step_pictures(scene, published)?.iter().enumerate() {
            let name = format!("{:02}-{}-{}.png", number + 1, step.pass, step.step);
            write_rgba_png(&step.picture, &folder.join(name))?;
        }
    }
    let verdict = match run.verify {
        true => prune::verify(output, renderer, resolved, (published, &drawn.around), picture)?,
        false => Verdict::Good,
    };
    if run.is_told() {
        tell(rendering, drawn, renderer)?;
    }
    Ok(verdict)
}

/// Says how the picture was made: as text, or as JSON. Draws again where frames are to be timed.
fn tell(rendering: &Rendering<'_>, drawn: DrawnPicture, renderer: &mut Renderer) -> Result<()> {
    let Rendering { request, run, .. } = *rendering;
    let DrawnPicture { resolved, published, plan, omissions, kept, remarks, times: first, .. } = drawn;
    let Times { load_ms, stages, arrays_ms, plan_ms, lines_ms, context_ms, warm_up_ms, first_frame_ms } = first;
    let scene = resolved.lit();
    let frames = run.frames.unwrap_or(u32::from(run.explain)) as usize;
    let timed = match frames {
        0 => None,
        _ => Some((
            Summary::new(renderer.time_frames(scene, &plan, WARM_UP, frames)?),
            renderer.time_passes(scene, &plan, frames.min(PASS_FRAMES))?,
        )),
    };
    if let (true, Some((times, passes))) = (run.explain, &timed) {
        let mut text = explain::frames(&plan, passes, times, frames);
        if let Some(pruning) = request.pruning.pruning(renderer) {
            text.push_str(&prune::explanation(renderer, scene, &published, &pruning, frames)?);
        }
        let start = [
            stages.iter().map(|(stage, ms)| (stage.name(), *ms)).collect(),
            vec![
                ("vertex arrays", arrays_ms),
                ("exact lines", lines_ms),
                ("context", context_ms),
                ("shaders, meanwhile", warm_up_ms.unwrap_or_default()),
                ("plan and pruning", plan_ms),
                ("first frame", first_frame_ms),
            ],
        ];
        text.push_str(&(explain::start(&start.concat()) + &explain::harmless(scene)));
        return super::print(&text);
    }
    let (frame_ms, passes) = timed.unzip();
    let made = DrawingFacts::Picture(Box::new(PictureMade {
        show: request.show,
        color: scene.color,
        recolor: scene.recolor,
        gl: renderer.context().clone(),
        passes,
        submission: plan.submission,
        omissions,
        kept,
        plan_ms,
        context_ms,
        warm_up_ms,
        first_frame_ms,
        frame_ms,
    }));
    super::print_json(&rendering.record(&resolved, load_ms, remarks, made))
}

fn make_dump_folder(folder: Option<&Path>, output: &str) -> Result<()> {
    let Some(folder) = folder else { return Ok(()) };
    let path = Path::new(output);
    let parent = path.parent().map(|parent| if parent.as_os_str().is_empty() { Path::new(".") } else { parent });
    let is_folder = |parent: &Path| {
        parent.canonicalize().is_ok_and(|parent| folder.canonicalize().is_ok_and(|folder| folder == parent))
    };
    // The steps' files are called 01-map-clear.png and so on.
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().as_bytes();
    let is_step = name.len() > 2 && name[0].is_ascii_digit() && name[1].is_ascii_digit() && name[2] == b'-';
    if is_step && parent.is_some_and(is_folder) {
        return Err(Error::output(output, "a picture in the --dump folder could overwrite it; give it another name"));
    }
    super::messages::make_folder_of("--dump", folder)
}

fn after_help() -> String {
    let names: Vec<String> =
        BUILTINS.iter().map(|builtin| format!("  builtin:{:<10} {}", builtin.name, builtin.what)).collect();
    format!(
        "Built-in models:\n{}\n\nLooks:\n{}\n\nWhere two defaults are given, the first is that of the look print, which tinta draws unless you give \
         --look, --style, --preset or a file of lines such as .dxf. The second counts with --style, --preset or \
         --look published.\n\nPublished borders are black and one or two pixels wide at any \
         size, and edges are not smoothed.\n\nIf facets show as thin lines, the file's normals are wrong: try --normals smooth.",
        names.join("\n"),
        LOOKS.map(|look| format!("  {:<18} {}", look.name, look.about)).join("\n")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use tinta::{Backend, LoadOptions, SceneSettings, Show, Style, StyleName};

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn without_options_the_command_line_means_the_librarys_defaults() {
        for (name, style) in StyleName::ALL {
            let words = ["tinta", "a.obj", "-o", "a.png", "--style", name];
            let arguments = Line::try_parse_from(words).unwrap().arguments;
            let request = arguments.asked().unwrap().0;
            assert_eq!(request.style, Style::named(style), "{name}");
            assert_eq!(request.read, LoadOptions::default());
            assert_eq!(request.scene, SceneSettings::default());
            assert_eq!((request.backend, request.show), (Backend::default(), Show::default()));
            assert_eq!(arguments.run.settings().unwrap(), RunSettings::default());
        }
    }
}
