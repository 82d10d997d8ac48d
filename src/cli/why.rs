//! `tinta why`: why a pixel has its colour, or why the line at a place is visible or hidden.

mod line;

use super::models::load_meshes;
use super::options::{Below, CameraFile, Chosen, OfSubject, Selection};
use super::{Command, Verdict, given};
use tinta::glam::DVec2;
use tinta::pixel::Explanation;
use tinta::request::{Layer, Request, Session};
use tinta::settings::{HasSettings, Setting};
use tinta::styles::is_of_lines_alone;
use tinta::{Error, LineSettings, Result, Scene, Style, StyleName, VisibleLines};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta why cow.obj 240,310                       explain why a line is hidden",
        "tinta why cow.obj 240,310 --style three-pass    explain a pixel",
    ],
    ..Command::new("why", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.session).map(|()| Verdict::Good)
    })
};

/// Explain a pixel of a style, or why a line is visible or hidden
///
/// Without --style, or with --style lines, the line nearest to the place is explained. In other styles every pass is recomputed for
/// the pixel: each statement of its shaders with its value, beside what the driver drew.
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in model, or - for standard input
    #[arg(value_name = "MODEL")]
    model: String,

    /// Place in the picture, pixels to the right and down from its upper left corner
    #[arg(value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    place: DVec2,

    /// Print one JSON object [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    drawing: Chosen<OfPicture>,
}

/// What is drawn in which style, from where, and how large.
struct OfPicture;

impl Selection for OfPicture {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        let is_drawn = Style::table().has(setting.name) && !is_of_lines_alone(setting.name);
        let is_other =
            ["style", "size", "backend", "glsl"].contains(&setting.name) || LineSettings::table().has(setting.name);
        OfSubject::has(setting) || is_other || (is_drawn && setting.name != "supersample")
    }
}

/// Two numbers.
fn place(text: &str) -> std::result::Result<DVec2, String> {
    let numbers: Vec<f64> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    match numbers[..] {
        [x, y] if text.split(',').count() == 2 && x.is_finite() && y.is_finite() => Ok(DVec2::new(x, y)),
        _ => Err("name a pixel by two numbers, such as 240,310".to_owned()),
    }
}

/// Explains a pixel or a line.
pub(super) fn run(arguments: &Arguments, session: &mut Session) -> Result<()> {
    let below = Below { camera: arguments.camera.camera.as_deref(), ..Below::default() };
    let style = Layer::Style(StyleName::Lines);
    let (request, _) = arguments.drawing.request_over(style, std::slice::from_ref(&arguments.model), &below)?;
    let scene = Scene::new(load_meshes(&request.models, &request.read)?, &request.scene)?;
    let Some(style) = request.line_style() else {
        let why = Explanation::of(&request.style, &scene, request.renderer(session)?, arguments.place)?;
        return if arguments.json { super::print_json(&why) } else { super::print(&why.to_string()) };
    };
    let why = VisibleLines::why(&scene, &style.lines, arguments.place).map_err(|error| match error {
        // The place is no option.
        Error::Setting { name, value: Some(place), problem } if name == "place" => {
            Error::CommandLine { problem: format!("{place}: {problem}") }
        }
        error => error,
    })?;
    if arguments.json { super::print_json(&why) } else { super::print(&line::in_words(&why)) }
}
