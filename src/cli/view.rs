//! `tinta view`: models in a window.

use super::options::{Chosen, FormArguments, ModelArguments, Selection, StyleArguments};
use super::preset::{LookArguments, PresetArguments};
use super::render::StyleChoice;
use super::standard_input;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tinta::mesh::refuse_address;
use tinta::settings::{HasSettings, Setting};
use tinta::window::{
    Buffer, LINE_SETTINGS, Layout, LineStyle, Orbit, Replay, SCENE_SETTINGS, Side, ViewerEvent, ViewerOptions,
    ViewerState, WindowOptions, open,
};
use tinta::{Backend, Error, Result, SceneSettings, Size, Style, StyleName, SvgSettings};

/// Show models in a window: turn them, compare styles, change every setting
#[derive(clap::Args)]
#[command(after_help = "Press H in the window for a list of keys. Drop a model file on the window to show it.")]
pub(super) struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS, glTF, GLB) or built-in models; several make one scene [default: builtin:bust]
    #[arg(value_name = "MODEL", default_value = "builtin:bust", hide_default_value = true)]
    models: Vec<String>,

    #[arg(long, help = format!("Style: {}, lines [default: three-pass]", StyleName::list()), value_name = "STYLE", default_value = "three-pass", hide_default_value = true)]
    style: StyleChoice,

    /// Second style, right of a divider [default: none]
    #[arg(long, value_name = "STYLE")]
    right: Option<StyleChoice>,

    #[command(flatten)]
    scene: Chosen<OfView>,

    /// Size of the window in points, or one number for a square [default: 1280x720]
    #[arg(long, hide_short_help = true, value_name = "WxH", default_value = "1280x720", hide_default_value = true)]
    window: Size,

    /// Draw at half the width and height while the model moves, without the faces that look away [default: off]
    #[arg(long, hide_short_help = true)]
    coarse: bool,

    /// OpenGL for the pictures from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works); the window has its own [default: auto]
    #[arg(long, hide_short_help = true, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Read shaders from this folder, laid out like glsl/, instead of the built-in ones; edits show at once [default: none]
    #[arg(long, hide_short_help = true, value_name = "DIR")]
    glsl: Option<PathBuf>,

    /// Folder for files saved from the window [default: the current one]
    #[arg(long, hide_short_help = true, value_name = "DIR", default_value = ".", hide_default_value = true)]
    folder: PathBuf,

    /// Play a recording of events, one JSON object a line, take its pictures and quit; docs/viewer.md has the format [default: none]
    #[arg(long, hide_short_help = true, value_name = "FILE")]
    replay: Option<PathBuf>,

    /// Print one JSON record of a recording: time to the first picture and of each frame [default: off]
    #[arg(long, hide_short_help = true, requires = "replay")]
    json: bool,

    #[command(flatten)]
    look: LookArguments,

    #[command(flatten)]
    preset: PresetArguments,

    #[command(flatten)]
    styles: StyleArguments,

    #[command(flatten)]
    lines: Chosen<OfLinesInView>,

    #[command(flatten)]
    forms: FormArguments,

    #[command(flatten)]
    models_are_read: ModelArguments,
}

/// What a viewer's scene can be from the start; the rest is done with the mouse.
struct OfView;

impl Selection for OfView {
    type Of = SceneSettings;
    const HAS_HEADINGS: bool = false;

    fn has(setting: &Setting<SceneSettings>) -> bool {
        SCENE_SETTINGS.contains(&setting.name)
    }
}

/// The settings of exact lines that a window shows and no other style has.
struct OfLinesInView;

impl Selection for OfLinesInView {
    type Of = SvgSettings;

    fn has(setting: &Setting<SvgSettings>) -> bool {
        LINE_SETTINGS.contains(&setting.name) && !Style::table().has(setting.name)
    }
}

/// Opens the window and returns when it is closed.
pub(super) fn run(arguments: &Arguments, started: Instant) -> Result<()> {
    for (option, folder) in [("glsl", arguments.glsl.as_ref()), ("folder", Some(&arguments.folder))] {
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Err(Error::value(option, folder.display(), "there is no such folder; check the name"));
        }
    }
    if arguments.models.iter().any(|model| model == standard_input::DASH) {
        return Err(Error::model(
            standard_input::NAME,
            "the window reads its models again; save it as a file and name that",
        ));
    }
    // What is broken in a file is said in the window; a name that is nothing at all need not open one.
    let is_missing = |model: &&String| !model.starts_with("builtin:") && !Path::new(model).exists();
    if let Some(path) = arguments.models.iter().find(is_missing) {
        refuse_address(path)?;
        let problem = "there is no such file; check the name".to_owned();
        return Err(Error::model(path.clone(), problem));
    }
    let replay = arguments.replay.as_deref().map(Replay::read).transpose()?;
    let viewer = ViewerOptions {
        state: state(arguments)?,
        load: arguments.models_are_read.settings()?,
        backend: arguments.backend,
        shaders: arguments.glsl.clone(),
        folder: arguments.folder.clone(),
    };
    let record = open(WindowOptions { viewer, size: arguments.window, replay, started })?;
    match record {
        Some(record) if arguments.json => super::print_json(&record),
        _ => Ok(()),
    }
}

/// How exact lines look.
fn line_style(arguments: &Arguments) -> Result<LineStyle> {
    let drawing = arguments.styles.svg_settings(&arguments.lines)?;
    drawing.check()?;
    Ok(LineStyle::new(arguments.styles.line_settings(&arguments.forms)?, drawing))
}

/// What is shown first.
fn state(arguments: &Arguments) -> Result<ViewerState> {
    let mut state = ViewerState::new(arguments.models.clone(), Orbit::default());
    state.put_scene(SceneSettings::from_options(&arguments.scene.options)?);
    // Options are for every style that has them, whichever is chosen later.
    let is_shown = |choice: StyleChoice| [Some(arguments.style), arguments.right].contains(&Some(choice));
    for (_, name) in StyleName::ALL {
        match arguments.styles.style(name) {
            Ok(style) => state.prepare_style(&style),
            Err(error) if is_shown(StyleChoice::Picture(name)) => return Err(error),
            Err(_) => state.prepare_style(&Style::named(name)),
        }
    }
    match line_style(arguments) {
        Ok(style) => state.put_line_style(style),
        Err(error) if is_shown(StyleChoice::Lines) => return Err(error),
        Err(_) => {}
    }
    state.update(ViewerEvent::Style(Side::Left, arguments.style.name().to_owned()));
    if let Some(right) = arguments.right {
        state.update(ViewerEvent::Style(Side::Right, right.name().to_owned()));
        state.update(ViewerEvent::Layout(Layout::Split));
    }
    state.buffer = Buffer::Show(arguments.styles.show);
    state.is_coarse_while_moving = arguments.coarse;
    Ok(state)
}
