//! `tinta compare`: draws one scene in two styles and overlays their lines.

use super::models::load_meshes;
use super::options::{CameraArguments, ModelArguments, SceneArguments, StyleArguments, ignored};
use super::preset::{Given, PresetArguments};
use super::session::Session;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tinta::compare::{Agreement, AgreementNumbers, BOTH_COLOR, InkMask, LEFT_COLOR, RIGHT_COLOR};
use tinta::contact_sheet::{Caption, Panel, sheet};
use tinta::record::{CameraRecord, ComparisonRecord, DrawingRecord, ModelRecord, Summary};
use tinta::renderer::milliseconds_since;
use tinta::{Backend, Error, Picture, Result, Scene, Show, StyleName, Target};

/// Draw one scene in two styles side by side, and show which lines both drew
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in models, or - for standard input; several make one scene
    #[arg(required = true, value_name = "MODEL")]
    models: Vec<String>,

    /// Sheet to write (.png .jpg .bmp .tga .ppm), or, ending in /, a folder for the sheet and its three pictures
    #[arg(short, long, value_name = "FILE|DIR")]
    output: String,

    #[arg(long, help = format!("Style on the left: {} [default: three-pass]", StyleName::list_with_lines()), value_name = "STYLE", default_value = "three-pass", hide_default_value = true)]
    left: StyleName,

    /// Style on the right [default: inking]
    #[arg(long, value_name = "STYLE", default_value = "inking", hide_default_value = true)]
    right: StyleName,

    /// Distance within which two styles' ink counts as the same, in pixels, up to 64 [default: 2]
    #[arg(long, hide_short_help = true, value_name = "PIXELS", default_value = "2", hide_default_value = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    tolerance: u32,

    /// OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works) [default: auto]
    #[arg(long, hide_short_help = true, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Frames of each style to draw and time after warm-up [default: 11]
    #[arg(long, hide_short_help = true, value_name = "N", default_value = "11", hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    frames: u32,

    /// Print one JSON record [default: off]
    #[arg(long, hide_short_help = true)]
    json: bool,

    #[command(flatten)]
    preset: PresetArguments,

    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    camera: CameraArguments,

    #[command(flatten)]
    styles: StyleArguments,

    #[command(flatten)]
    model: ModelArguments,
}

/// Frames drawn before measuring.
const WARM_UP: usize = 2;

/// One style's part.
struct Drawing {
    picture: Picture,
    ink: InkMask,
    record: DrawingRecord,
}

pub(super) fn run(arguments: &Arguments, given: &Given, session: &mut Session) -> Result<()> {
    super::messages::check_output(&arguments.output)?;
    let inputs = given.inputs(&arguments.models);
    inputs.keep(&arguments.output)?;
    inputs.keep_in(Path::new(&arguments.output), NAMES)?;
    let output = Output::check(&arguments.output)?;
    if arguments.json && matches!(output, Output::File(Target::Stdout)) {
        return Err(Error::value("o", "-", "the sheet and --json cannot share standard output; name a file"));
    }
    if arguments.styles.are_without_borders() {
        return Err(Error::setting("no-borders", "compare needs the lines; leave it out"));
    }
    if arguments.styles.show != Show::Final {
        return Err(Error::setting("show", "a comparison shows finished pictures; leave it out"));
    }
    for (option, name) in [("left", arguments.left), ("right", arguments.right)] {
        if !name.has_lines() {
            return Err(Error::value(
                option,
                name.name(),
                format!("this style has no lines to compare; choose one of {}", StyleName::list_with_lines()),
            ));
        }
    }
    let styles = [arguments.left, arguments.right].map(|name| arguments.styles.style(name));
    let [left_style, right_style] = styles;
    let styles = [left_style?, right_style?];
    let meshes = load_meshes(&session.model_cache, &arguments.models, &arguments.model.settings()?)?;
    let count = meshes.len();
    let scene = Scene::new(meshes, &arguments.scene.settings(arguments.camera.settings()?)?)?;
    let renderer = session.renderer(arguments.backend)?;
    let mut draw = |style: &tinta::Style| -> Result<Drawing> {
        let start = Instant::now();
        let plan = style.plan(&scene, Show::Final)?;
        let plan_ms = milliseconds_since(start);
        let lines = style.plan(&scene, Show::Borders)?;
        renderer.remarks(&plan).iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        let ink = InkMask::of(&renderer.draw(&scene, &lines)?);
        let picture = renderer.draw(&scene, &plan)?;
        renderer.time_frames(&scene, &plan, WARM_UP, 1)?;
        // As when the view moves: silhouettes and light are due in every frame.
        let mut frame = || -> Result<f64> {
            let start = Instant::now();
            let plan = style.plan(&scene, Show::Final)?;
            renderer.time_frames(&scene, &plan, 0, 1)?;
            Ok(milliseconds_since(start))
        };
        let times: Result<Vec<f64>> = (0..arguments.frames).map(|_| frame()).collect();
        let record = DrawingRecord { style: style.clone(), plan_ms, frame_ms: Summary::new(times?) };
        Ok(Drawing { picture, ink, record })
    };
    let [left, right] = [draw(&styles[0])?, draw(&styles[1])?];
    let agreement = Agreement::of(&left.ink, &right.ink, arguments.tolerance)
        .ok_or_else(|| Error::setting("size", "the two pictures came out in different sizes; choose another"))?;
    let map = agreement.picture(scene.size);
    let models: Vec<ModelRecord> = scene.objects[..count].iter().map(|object| ModelRecord::new(&object.mesh)).collect();
    let record = ComparisonRecord {
        version: env!("CARGO_PKG_VERSION"),
        model: ModelRecord::together(&models),
        size: scene.size,
        camera: CameraRecord::new(&scene),
        gl: renderer.context().clone(),
        left: left.record,
        right: right.record,
        agreement: agreement.numbers,
    };
    let names = [arguments.left, arguments.right].map(StyleName::name);
    let panels = [
        panel(names[0], &record.left, left.picture),
        panel(names[1], &record.right, right.picture),
        Panel { title: "their lines".to_owned(), subtitle: String::new(), picture: map },
    ];
    let whole = sheet(&panels, &captions(&record, names, &arguments.models));
    output.write(&whole, panels)?;
    ignored::remark(&given.as_given, &names).iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    if arguments.json { super::print_json(&record) } else { Ok(()) }
}

fn panel(name: &str, record: &DrawingRecord, picture: Picture) -> Panel {
    Panel { title: name.to_owned(), subtitle: format!("{:.1} ms a frame", record.frame_ms.median), picture }
}

fn captions(record: &ComparisonRecord, [left, right]: [&str; 2], names_of_models: &[String]) -> Vec<Caption> {
    let AgreementNumbers { tolerance_px, left_px, right_px, only_left_px, only_right_px, .. } = record.agreement;
    let percent = |share: Option<f64>| share.map_or("nothing".to_owned(), |share| format!("{:.1} %", share * 100.0));
    let (left_shared, right_shared) = (percent(record.agreement.left_shared), percent(record.agreement.right_shared));
    let line = |swatch: Option<[u8; 3]>, text: String| Caption { swatch, text };
    let first = &names_of_models[0];
    let file = Path::new(first).file_name().map_or(first.as_str().into(), |name| name.to_string_lossy());
    let others = match names_of_models.len() - 1 {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    vec![
        line(Some(BOTH_COLOR), format!("both: {left_shared} of {left}'s ink, {right_shared} of {right}'s")),
        line(Some(LEFT_COLOR), format!("only {left}: {only_left_px} of its {left_px} px")),
        line(Some(RIGHT_COLOR), format!("only {right}: {only_right_px} of its {right_px} px")),
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
