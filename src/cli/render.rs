//! `tinta render`: models to a picture.

mod animate;
mod explain;
mod keep;
mod lines;
#[cfg(test)]
mod option_pictures;
mod prune;
#[cfg(test)]
mod round_trip;

#[cfg(feature = "window")]
pub(super) use lines::StyleChoice;
pub(super) use lines::is_of_lines;

use super::Verdict;
use super::inputs::Inputs;
use super::model_cache::ModelCache;
use super::models::{ReadModels, load_models};
use super::options::{
    CameraArguments, FormArguments, LineArguments, ModelArguments, SceneArguments, StyleArguments, ignored,
};
use super::preset::Given;
use super::session::Session;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tinta::mesh::{BUILTINS, LoadStage};
use tinta::picture::write_rgba_png;
use tinta::plan::prune::Pruned;
use tinta::plan::{Plan, Submission};
use tinta::preset::Options;
use tinta::record::{CameraRecord, ModelRecord, Record, Summary};
use tinta::renderer::milliseconds_since;
use tinta::{Backend, Error, Renderer, Result, Scene, SceneSettings, Size, Style, StyleName, Target};

/// Draw models into a picture, an animation or a line drawing
#[derive(clap::Args)]
#[command(after_help = after_help())]
pub(super) struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in models, or - for standard input; several make one scene, each at its own coordinates
    #[arg(required = true, value_name = "MODEL")]
    models: Vec<String>,

    /// File to write: .png .jpg .bmp .tga .ppm, or - for PNG on standard output; lines: .svg .pdf .json; animations: .gif .apng frame-%04d.png
    #[arg(short, long, value_name = "FILE")]
    output: String,

    #[arg(long, help = format!("Style: {}, lines [default: three-pass; into .svg, .pdf and .json: lines]", StyleName::list()), value_name = "STYLE")]
    style: Option<lines::StyleChoice>,

    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    camera: CameraArguments,

    #[command(flatten)]
    styles: StyleArguments,

    #[command(flatten)]
    lines: LineArguments,

    #[command(flatten)]
    forms: FormArguments,

    #[command(flatten)]
    model: ModelArguments,

    #[command(flatten)]
    animation: animate::AnimationArguments,

    #[command(flatten)]
    prune: prune::PruneArguments,

    #[command(flatten)]
    keep: keep::KeepArguments,

    #[command(flatten)]
    run: RunArguments,
}

impl Arguments {
    /// The same picture into another file, by another way to OpenGL.
    pub(super) fn with_backend(self, backend: Backend) -> Self {
        Self { run: RunArguments { backend, ..self.run }, ..self }
    }

    /// How large the picture is to be.
    ///
    /// # Errors
    ///
    /// As for its settings.
    pub(super) fn size(&self) -> Result<Size> {
        Ok(self.scene_settings()?.size)
    }

    /// The scene's settings and the camera's.
    fn scene_settings(&self) -> Result<SceneSettings> {
        self.scene.settings(self.camera.settings()?)
    }

    /// What the style does for a scene, before anything is left out.
    fn plan(&self, style: &Style, scene: &Scene) -> Result<Plan> {
        let plan = style.plan(scene, self.styles.show)?;
        Ok(Plan { submission: self.run.submission, ..plan })
    }

    /// The style of a picture.
    fn style_name(&self) -> StyleName {
        match self.style {
            Some(lines::StyleChoice::Picture(name)) => name,
            _ => StyleName::ThreePass,
        }
    }
}

#[derive(clap::Args)]
#[command(next_help_heading = "Running")]
struct RunArguments {
    /// OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works) [default: auto]
    #[arg(long, hide_short_help = true, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Hand vertices to GL in buffers, or as programs of 2001 did, one by one (immediate) or in display lists (display-list); the picture is the same [default: buffers]
    #[arg(long, hide_short_help = true, value_name = "HOW", default_value = "buffers", hide_default_value = true)]
    submission: Submission,

    /// Frames to draw and time after warm-up, with --json or --explain [default: 1]
    #[arg(long, hide_short_help = true, value_name = "N", default_value = "1", hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    frames: u32,

    /// Print one JSON record: model, style, camera, GL, times [default: off]
    #[arg(long, hide_short_help = true)]
    json: bool,

    /// Print the plan, its passes and steps, with times; of exact lines their classes and where smooth silhouettes break [default: off]
    #[arg(long, hide_short_help = true, conflicts_with = "json")]
    explain: bool,

    /// End after this time with a sentence and no file, where exact lines are not found by then [default: no limit]
    #[arg(long, hide_short_help = true, value_name = "SECONDS", value_parser = seconds)]
    within: Option<f64>,

    /// With --within, write the lines that are certain by then, into a file that says that it is a part [default: off]
    #[arg(long, hide_short_help = true, requires = "within")]
    partial: bool,

    /// Write GL's buffers after every step of the published plan into this folder, as RGBA PNG [default: off]
    #[arg(long, hide_short_help = true, value_name = "DIR")]
    dump: Option<PathBuf>,
}

/// A time that may pass.
fn seconds(text: &str) -> std::result::Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| *seconds > 0.0 && seconds.is_finite());
    seconds.ok_or_else(|| "write seconds, a number above 0: 5".to_owned())
}

/// Frames drawn before measuring: the driver compiles in the first and settles in the second.
const WARM_UP: usize = 2;

/// Most frames drawn again to time single passes.
const PASS_FRAMES: usize = 21;

/// Draws what the arguments say, of which `given` has those that make the picture, by name.
pub(super) fn run(arguments: &Arguments, given: &Given, session: &mut Session) -> Result<Verdict> {
    super::messages::check_output(&arguments.output)?;
    if arguments.output != "-" {
        crate::output::check_name(Path::new(&arguments.output))?;
    }
    let inputs = given.inputs(&arguments.models);
    inputs.keep(&arguments.output)?;
    let preset = arguments.keep.preset_target(&arguments.output, &inputs)?;
    let verdict = draw(arguments, &given.options, session)?;
    // Said of what was drawn: a refusal is one sentence, and no other before it.
    let is_lines = lines::format(arguments)?.is_some();
    let style = if is_lines { "lines" } else { arguments.style_name().name() };
    ignored::remark(&given.as_given, &[style]).iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    preset.map_or(Ok(()), |target| keep::save_preset(&target, &given.options)).map(|()| verdict)
}

fn draw(arguments: &Arguments, options: &Options, session: &mut Session) -> Result<Verdict> {
    if let Some(format) = lines::format(arguments)? {
        arguments.prune.refuse()?;
        return lines::run(arguments, options, format, &session.model_cache);
    }
    if arguments.run.within.is_some() {
        return Err(Error::setting(
            "within",
            "only exact lines can end before they are done; leave it out, or write a .svg",
        ));
    }
    if let Some(option) = lines::OF_PAPER.into_iter().find(|option| arguments.lines.options.contains_key(*option)) {
        return Err(Error::setting(option, lines::pixels_on_paper(arguments)));
    }
    arguments.lines.refuse("only style lines has this; leave it out, or write a .svg")?;
    if let Some(target) = arguments.animation.target(&arguments.output, arguments.scene.is_transparent())? {
        return animate::run(arguments, &target, session);
    }
    let target = Target::check(&arguments.output, arguments.scene.is_transparent())?;
    if target == Target::Stdout && (arguments.run.json || arguments.run.explain) {
        return Err(Error::value(
            "o",
            "-",
            "the picture and --json or --explain cannot share standard output; name a file",
        ));
    }
    make_dump_folder(arguments)?;
    let style = arguments.styles.style(arguments.style_name())?;
    let (ready, loaded) = ready(arguments, &arguments.scene_settings()?, &style, session);
    let Loaded { scene, files, published, load_ms, stages, arrays_ms, plan_ms } = loaded?;
    let Ready { renderer, context_ms, warm_up_ms } = ready?;
    let pruning = Instant::now();
    renderer.choose_context(&scene, &published)?;
    let Pruned { plan, omissions, kept } = arguments.prune.pruned(&published, &scene, renderer, arguments.run.frames);
    let plan_ms = plan_ms + milliseconds_since(pruning);
    let remarks = [style.remarks(&scene), renderer.remarks(&plan)].concat();
    remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));

    let first_frame = Instant::now();
    let picture = renderer.draw(&scene, &plan)?;
    let first_frame_ms = milliseconds_since(first_frame);
    let files = keep::files(arguments, &scene, &files, Some(&style));
    let recipe = keep::recipe(arguments, options, scene.size, files, Some(renderer.context()));
    target.write_with(&picture, recipe.and_then(|recipe| recipe.note()).as_ref())?;
    if let Some(folder) = &arguments.run.dump {
        for (number, step) in renderer.step_pictures(&scene, &published)?.iter().enumerate() {
            let name = format!("{:02}-{}-{}.png", number + 1, step.pass, step.step);
            write_rgba_png(&step.picture, &folder.join(name))?;
        }
    }
    let verdict = match arguments.prune.verify {
        true => prune::verify(arguments, renderer, &scene, &published, &picture)?,
        false => Verdict::Good,
    };
    if !arguments.run.json && !arguments.run.explain {
        return Ok(verdict);
    }
    let frames = arguments.run.frames as usize;
    let times = Summary::new(renderer.time_frames(&scene, &plan, WARM_UP, frames)?);
    let passes = renderer.time_passes(&scene, &plan, frames.min(PASS_FRAMES))?;
    if arguments.run.explain {
        let mut text = explain::frames(&plan, &passes, &times, frames);
        if let Some(pruning) = arguments.prune.pruning(renderer, arguments.run.frames) {
            text.push_str(&prune::explanation(renderer, &scene, &published, &pruning, frames)?);
        }
        let start = [
            stages.iter().map(|(stage, ms)| (stage.name(), *ms)).collect(),
            vec![
                ("vertex arrays", arrays_ms),
                ("context", context_ms),
                ("shaders, meanwhile", warm_up_ms.unwrap_or_default()),
                ("plan and pruning", plan_ms),
                ("first frame", first_frame_ms),
            ],
        ];
        text.push_str(&explain::start(&start.concat()));
        return super::print(&text).map(|()| verdict);
    }
    let models = model_records(&scene, arguments.models.len());
    super::print_json(&Record {
        version: env!("CARGO_PKG_VERSION"),
        model: ModelRecord::together(&models),
        models,
        load: arguments.model.settings()?,
        copies: arguments.scene_settings()?.copies,
        triangles: scene.triangle_count(),
        style,
        show: arguments.styles.show,
        size: scene.size,
        background: scene.background,
        color: scene.color,
        recolor: scene.recolor,
        camera: CameraRecord::new(&scene),
        gl: renderer.context().clone(),
        passes,
        submission: plan.submission,
        omissions,
        kept,
        remarks,
        load_ms,
        plan_ms,
        context_ms,
        warm_up_ms,
        first_frame_ms,
        frame_ms: times,
    })
    .map(|()| verdict)
}

/// A renderer and how long it took to get ready.
struct Ready<R> {
    renderer: R,
    context_ms: f64,
    warm_up_ms: Option<f64>,
}

/// Reads the models and gets a renderer ready: the session's, or one that is opened meanwhile.
fn ready<'s>(
    arguments: &Arguments,
    settings: &SceneSettings,
    style: &Style,
    session: &'s mut Session,
) -> (Result<Ready<&'s mut Renderer>>, Result<Loaded>) {
    let (backend, model_cache) = (arguments.run.backend, &session.model_cache);
    let load = || load_scene(arguments, settings, style, model_cache);
    if session.has(backend) {
        let loaded = load();
        let renderer = session.renderer(backend);
        return (renderer.map(|renderer| Ready { renderer, context_ms: 0.0, warm_up_ms: None }), loaded);
    }
    let open = || session.open(backend);
    // Context and driver need as long as a large model: both at once. The renderer stays on this thread, as GL wants.
    let (opened, loaded) = std::thread::scope(|scope| {
        // Where no second thread can be had, one after the other.
        let Ok(loading) = std::thread::Builder::new().spawn_scoped(scope, load) else {
            let loaded = load();
            return (open_renderer(arguments, settings, style, open, || true), loaded);
        };
        let opened = open_renderer(arguments, settings, style, open, || loading.is_finished());
        match loading.join() {
            Ok(loaded) => (opened, loaded),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    let ready = opened.map(|Ready { renderer, context_ms, warm_up_ms }| Ready {
        renderer: session.keep(backend, renderer),
        context_ms,
        warm_up_ms,
    });
    (ready, loaded)
}

/// Opens the context and, if the models are not there yet, warms it up.
fn open_renderer(
    arguments: &Arguments,
    settings: &SceneSettings,
    style: &Style,
    open: impl Fn() -> Result<Renderer>,
    models_are_read: impl Fn() -> bool,
) -> Result<Ready<Renderer>> {
    let start = Instant::now();
    let mut renderer = open()?;
    let context_ms = milliseconds_since(start);
    let warm_up_ms = if models_are_read() {
        None
    } else {
        let start = Instant::now();
        let pruning = arguments.prune.pruning(&renderer, arguments.run.frames);
        renderer.warm_up(settings, style, arguments.styles.show, pruning.as_ref())?;
        Some(milliseconds_since(start))
    };
    Ok(Ready { renderer, context_ms, warm_up_ms })
}

/// A scene ready to be drawn, what is to be done for it, and how long both took.
struct Loaded {
    scene: Scene,
    /// What was read besides the models' own files.
    files: Vec<PathBuf>,
    /// As the style has it.
    published: Plan,
    load_ms: f64,
    /// Of reading, each stage's part, milliseconds.
    stages: Vec<(LoadStage, f64)>,
    arrays_ms: f64,
    plan_ms: f64,
}

/// Reads the models, puts the scene together and plans it, which finds its edges where the style draws them.
fn load_scene(
    arguments: &Arguments,
    settings: &SceneSettings,
    style: &Style,
    model_cache: &ModelCache,
) -> Result<Loaded> {
    let start = Instant::now();
    let ReadModels { meshes, files, stages } =
        load_models(model_cache, &arguments.models, &arguments.model.settings()?)?;
    let load_ms = milliseconds_since(start);
    let scene = Scene::new(meshes, settings)?;
    // Known only now.
    pictures_of(&scene).keep(&arguments.output)?;
    let start = Instant::now();
    scene.make_arrays();
    let arrays_ms = milliseconds_since(start);
    let start = Instant::now();
    let published = arguments.plan(style, &scene)?;
    Ok(Loaded { scene, files, published, load_ms, stages, arrays_ms, plan_ms: milliseconds_since(start) })
}

/// The pictures on the models of a scene.
fn pictures_of(scene: &Scene) -> Inputs {
    let materials = scene.objects.iter().flat_map(|object| &object.mesh.materials);
    Inputs::of_pictures(materials.filter_map(|material| material.texture.clone()))
}

fn make_dump_folder(arguments: &Arguments) -> Result<()> {
    let Some(folder) = &arguments.run.dump else { return Ok(()) };
    let output = Path::new(&arguments.output);
    let parent = output.parent().map(|parent| if parent.as_os_str().is_empty() { Path::new(".") } else { parent });
    let is_folder = |parent: &Path| {
        parent.canonicalize().is_ok_and(|parent| folder.canonicalize().is_ok_and(|folder| folder == parent))
    };
    // The steps' files are called 01-map-clear.png and so on.
    let name = output.file_name().and_then(|name| name.to_str()).unwrap_or_default().as_bytes();
    let is_step = name.len() > 2 && name[0].is_ascii_digit() && name[1].is_ascii_digit() && name[2] == b'-';
    if is_step && parent.is_some_and(is_folder) {
        return Err(Error::output(
            arguments.output.clone(),
            "a picture in the --dump folder could overwrite it; give it another name",
        ));
    }
    std::fs::create_dir_all(folder).map_err(|error| {
        let problem = if folder.is_file() {
            "this is a file; name a folder".to_owned()
        } else {
            format!("the folder cannot be created ({error}); choose another")
        };
        Error::output(format!("--dump {}", folder.display()), problem).because(&error)
    })
}

fn model_records(scene: &Scene, models: usize) -> Vec<ModelRecord> {
    scene.objects[..models].iter().map(|object| ModelRecord::new(&object.mesh)).collect()
}

fn after_help() -> String {
    let names: Vec<String> =
        BUILTINS.iter().map(|builtin| format!("  builtin:{:<10} {}", builtin.name, builtin.what)).collect();
    format!(
        "Built-in models:\n{}\n\nThe look print is drawn unless --style, --look or --preset is given (see tinta looks). Where it has a default of its \
         own, that comes first above; the one after \"published\" is that of a style that is named.\n\nAs published, borders are black and one or two pixels wide at any size, and edges are \
         not smoothed.\n\nIf facets show as thin lines, blame the file's normals and try --normals smooth.",
        names.join("\n")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use tinta::{LineSettings, LoadOptions, Show, SvgSettings};

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn without_options_the_command_line_means_the_librarys_defaults() {
        let arguments = Line::try_parse_from(["tinta", "a.obj", "-o", "a.png"]).unwrap().arguments;
        for (name, style) in StyleName::ALL {
            assert_eq!(arguments.styles.style(style).unwrap(), Style::named(style), "{name}");
        }
        assert_eq!(arguments.style_name(), StyleName::ThreePass);
        assert_eq!(arguments.styles.line_settings(&arguments.forms).unwrap(), LineSettings::default());
        let drawn = SvgSettings { title: String::new(), ..lines::svg_settings(&arguments, None).unwrap() };
        assert_eq!(drawn, SvgSettings::default());
        assert_eq!(arguments.model.settings().unwrap(), LoadOptions::default());
        let (asked, default) = (arguments.scene_settings().unwrap(), SceneSettings::default());
        assert_eq!(asked.camera, default.camera);
        assert_eq!((asked.copies, asked.size), (default.copies, default.size));
        assert_eq!((asked.background, asked.color), (default.background, default.color));
        assert_eq!(arguments.run.backend, Backend::default());
        assert_eq!(arguments.styles.show, Show::default());
    }
}
