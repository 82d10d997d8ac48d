//! `tinta view`: models in a window.

use super::models::refuse_missing;
use super::options::{Below, GivenOptions, NamedLook, PresetFile, Selection};
use super::standard_input;
use super::{Call, Command, Verdict, given};
use std::path::PathBuf;
use tinta::preset::StyleOrLook;
use tinta::request::Request;
use tinta::settings::{HasSettings, Setting};

use tinta::window::{
    Buffer, Layout, Orbit, Replay, SCENE_SETTINGS, Side, ViewerEvent, ViewerOptions, ViewerState, WindowOptions, open,
};
use tinta::{Error, LoadOptions, Result, Size, Style};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta view cow.obj                              turn it, try styles"],
    offers: |option| if option == "right" { StyleOrLook::names() } else { Vec::new() },
    ..Command::new("view", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call).map(|()| Verdict::Good)
    })
};

/// Show models in a window: turn them, compare styles, change every setting
#[derive(clap::Args)]
#[command(after_help = "Press H in the window for a list of keys. Drop a model file on the window to show it.")]
pub(super) struct Arguments {
    /// Model files (FORMATS) or built-in models; several make one scene [default: builtin:bust]
    #[arg(value_name = "MODEL", default_value = "builtin:bust", hide_default_value = true)]
    models: Vec<String>,

    /// Second style or look, right of a divider [default: none]
    #[arg(long, value_name = "STYLE|LOOK")]
    right: Option<StyleOrLook>,

    /// Size of the window in points, or one number for a square [default: 1280x720]
    #[arg(long, hide_short_help = true, value_name = "WxH", default_value = "1280x720", hide_default_value = true)]
    window: Size,

    /// Draw at half the width and height while the model moves, without the faces that look away [default: off]
    #[arg(long, hide_short_help = true)]
    coarse: bool,

    /// Folder for files saved from the window [default: the current one]
    #[arg(long, hide_short_help = true, value_name = "DIR", default_value = ".", hide_default_value = true)]
    folder: PathBuf,

    /// Play a recording of events, one JSON object a line, take its pictures and quit; docs/dev/testing.md has the format [default: none]
    #[arg(long, hide_short_help = true, value_name = "FILE")]
    replay: Option<PathBuf>,

    /// Print one JSON record of a recording: time to the first picture and of each frame [default: off]
    #[arg(long, hide_short_help = true, requires = "replay")]
    json: bool,

    #[command(flatten)]
    look: NamedLook,

    #[command(flatten)]
    preset: PresetFile,

    #[command(flatten)]
    options: GivenOptions<OfWindow>,
}

/// The viewer's initial settings; the mouse changes the rest.
struct OfWindow;

impl Selection for OfWindow {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        let name = setting.name;
        let is_of_style = Style::table().has(name);
        let is_other = ["style", "show", "backend", "glsl"].contains(&name) || SCENE_SETTINGS.contains(&name);
        is_of_style || is_other || LoadOptions::table().has(name)
    }
}

/// Opens the window and returns when it is closed.
pub(super) fn run(arguments: &Arguments, call: &Call<'_>) -> Result<()> {
    if !arguments.folder.is_dir() {
        return Err(Error::value("folder", arguments.folder.display(), "there is no such folder; check the name"));
    }
    if arguments.models.iter().any(|model| model == standard_input::DASH) {
        return Err(Error::model(
            standard_input::NAME,
            "the window reads its models again; save it as a file and name that",
        ));
    }
    // The window reports a broken file.
    arguments.models.iter().try_for_each(|model| refuse_missing(model))?;
    let below = Below {
        look: arguments.look.look,
        preset: arguments.preset.preset.as_deref(),
        has_looks: true,
        command: "view",
        ..Below::default()
    };
    let (request, _) = arguments.options.request(&arguments.models, &below)?;
    request.glsl.as_deref().map(crate::glsl::check_folder).transpose()?;
    let replay = arguments.replay.as_deref().map(Replay::read).transpose()?;
    let viewer = ViewerOptions {
        state: state(&request, arguments.right, arguments.coarse).map_err(|error| request.attributed(error))?,
        backend: request.backend,
        shaders: request.glsl.clone().map(PathBuf::from),
        folder: arguments.folder.clone(),
        line_measure: call.program.line_measure,
    };
    let record = open(WindowOptions { viewer, size: arguments.window, replay, started: call.started })?;
    match record {
        Some(record) if arguments.json => super::print_json(&record),
        _ => Ok(()),
    }
}

/// The first state.
fn state(request: &Request, right: Option<StyleOrLook>, is_coarse: bool) -> Result<ViewerState> {
    let mut state = ViewerState::new(request.models.clone(), Orbit::default());
    // Options apply to every style that has them, even one chosen later.
    state.put_request(request);
    request.contents(false)?;
    if let Some(right) = right {
        let named = match right {
            StyleOrLook::Style(style) => {
                request.in_style(style)?;
                ViewerEvent::Style(Side::Right, style.name().to_owned())
            }
            StyleOrLook::Look(look) => ViewerEvent::Look(look.name.to_owned()),
        };
        for event in [
            ViewerEvent::Layout(Layout::Split),
            ViewerEvent::Choose(Side::Right),
            named,
            ViewerEvent::Choose(Side::Left),
        ] {
            state.update(event);
        }
        // Two looks are seen as the left one is.
        if request.is_of_look("style") {
            state.put_scene(request.scene.clone());
        }
    }
    state.buffer = Buffer::Show(request.show);
    state.is_coarse_while_moving = is_coarse;
    Ok(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::StyleName;
    use tinta::preset::{LOOKS, Look};
    use tinta::request::OptionLayer;

    #[test]
    fn a_look_on_the_right_has_its_style_and_lines_and_the_scene_of_the_left_one() {
        let [print, sketch] = ["print", "sketch"].map(|name| Look::of_name(name).unwrap());
        let of = |layer| Request::from_layers(&[layer]).unwrap().0;
        let left = of(OptionLayer::Look(sketch));
        let shown = state(&left, Some(StyleOrLook::Look(print)), false).unwrap();
        assert_eq!(
            (shown.style(Side::Left), shown.style(Side::Right)),
            (&left.style, &of(OptionLayer::Look(print)).style)
        );
        assert_eq!((shown.layout, shown.active, shown.message), (Layout::Split, Side::Left, None));
        assert_eq!(shown.orbit.view, left.scene.camera.view);
        // A style says nothing of the scene: it is the look's.
        let inking = of(OptionLayer::Style(StyleName::Inking));
        let shown = state(&inking, Some(StyleOrLook::Look(LOOKS[0])), false).unwrap();
        assert_eq!(shown.orbit.view, of(OptionLayer::Look(LOOKS[0])).scene.camera.view);
    }
}
