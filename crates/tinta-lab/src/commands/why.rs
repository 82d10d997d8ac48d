//! `tinta why`: why a pixel has its colour, or why the line at a place is visible or hidden, printed or on a sheet.

mod line;
mod sheet;

use serde_json::json;
use std::path::Path;
use tinta::cli::inputs::Inputs;
use tinta::cli::models::load_meshes;
use tinta::cli::options::{Below, CameraFile, GivenOptions, OfSubject, Selection};
use tinta::cli::{Command, Verdict, given, print, print_json, say};
use tinta::glam::DVec2;
use tinta::lines::{Progress, Why};
use tinta::pixel::Explanation;
use tinta::recipe::Recipe;
use tinta::request::{OptionLayer, Request, Resolved, Session};
use tinta::settings::{HasSettings, Options, Setting};
use tinta::styles::{Contents, is_of_lines_alone};
use tinta::{Error, LineSettings, Renderer, Result, Scene, Style, StyleName, Target, VisibleLines};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta why cow.obj 240,310                       explain why a line is hidden",
        "tinta why cow.obj 256,256 --style three-pass    explain a pixel",
        "tinta why cow.png 640,480                       explain a pixel of a picture by tinta",
    ],
    ..Command::new("why", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.session).map(|()| Verdict::Good)
    })
};

/// Explain a pixel of a style, or why a line is visible or hidden
///
/// Without --style, or with --style lines, the line nearest to the place is explained. In other styles every pass is recomputed for
/// the pixel: each statement of its shaders with its value, beside what the driver drew. A picture by tinta is explained as it was
/// drawn: its recipe gives model, view, style and size, and of exact lines over it the nearest is explained, too.
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file (FORMATS), built-in model, - for standard input, or a picture by tinta
    #[arg(value_name = "MODEL")]
    model: String,

    /// Place in the picture, pixels to the right and down from its upper left corner
    #[arg(value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    place: DVec2,

    /// Picture to write (.png .jpg .bmp .tga .ppm): a sheet that explains the pixel [default: none, print the explanation]
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,

    /// Print one JSON object [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    drawing: GivenOptions<OfPicture>,
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
    let camera = arguments.camera.camera.as_deref();
    let below = Below { camera, ..Below::default() };
    let (models, layers) = subject(&arguments.model, &arguments.drawing.options)?;
    let (mut request, _) = arguments.drawing.request_over(layers, &models, &below)?;
    let has_passes = matches!(request.contents(false)?.below, tinta::styles::Below::Passes(_));
    if !has_passes && arguments.output.is_some() {
        return Err(Error::setting("output", "it explains shaders; add a style, such as --style three-pass"));
    }
    let files: Vec<&str> = camera.and_then(Path::to_str).into_iter().collect();
    let inputs = Inputs::new(&request.models, &request.options, &files);
    let output = arguments.output.as_deref().map(|path| checked(path, arguments, &inputs)).transpose()?;
    if !has_passes {
        let resolved = request.resolve(load_meshes(&request.models, &request.read)?, true)?;
        return line_out(&resolved, arguments.place, arguments.json);
    }
    // Every step is explained.
    request.pruning.is_full = true;
    explain(arguments, &request, output, session).map_err(|error| request.attributed(error))
}

/// The models and the options below those given: a picture's by its recipe, else of lines.
fn subject(model: &str, given: &Options) -> Result<(Vec<String>, Vec<OptionLayer>)> {
    if ![".png", ".svg"].iter().any(|ending| model.to_ascii_lowercase().ends_with(ending)) {
        return Ok((vec![model.to_owned()], vec![OptionLayer::Style(StyleName::Lines)]));
    }
    let recipe = Recipe::read(Path::new(model))?;
    if let Some(problem) = recipe.not_granted(given) {
        return Err(Error::picture(model, problem));
    }
    let Recipe { models, options, style, .. } = recipe;
    let style = style.parse().map(OptionLayer::Style).ok();
    Ok((models, style.into_iter().chain([OptionLayer::Given(options)]).collect()))
}

/// Explains a pixel of the request's style.
fn explain(arguments: &Arguments, request: &Request, output: Option<Target>, session: &mut Session) -> Result<()> {
    let (resolved, renderer) = request.resolved_and_renderer(session)?;
    let (scene, Contents { below, lines, .. }) = (resolved.lit(), &resolved.contents);
    let tinta::styles::Below::Passes(style) = below else { return Ok(()) };
    if request.glsl.is_some() {
        let remarks = renderer.remarks(&resolved.plan()?);
        remarks.iter().for_each(|remark| say(&format!("tinta: {remark}")));
    }
    let near = lines.as_ref().map(|lines| nearest_line(&resolved.scene, lines, arguments.place)).transpose()?;
    let line =
        near.map(|near| with_lines(&resolved, renderer, arguments.place).map(|with| (near, with))).transpose()?;
    let why = Explanation::of(style, scene, renderer, arguments.place);
    let why = match (why, &line) {
        // Beside the model there is only a line to explain.
        (Err(Error::Text(_)), Some(_)) if output.is_none() => None,
        (why, _) => Some(why?),
    };
    if let Some((target, why)) = output.as_ref().zip(why.as_ref()) {
        target.write(&sheet::sheet(why, style, scene, renderer)?)?;
    }
    if arguments.json {
        let mut record = why.map_or_else(|| json!({}), |why| json!(why));
        if let Some((line, (color, share))) = line {
            record["line"] = json!(line);
            record["with_lines"] = json!({ "color": color, "share": share });
        }
        return print_json(&record);
    }
    if output.is_some() {
        return Ok(());
    }
    let above = line.map(|(line, (color, share))| {
        format!(
            "With its lines the pixel is {color:?}.\nTheir share of it is {:.0} %.\n\n{}\nBelow the lines:\n\n",
            share * 100.0,
            line::in_words(&line)
        )
    });
    print(&(above.unwrap_or_default() + &why.map_or_else(|| "background\n".to_owned(), |why| why.to_string())))
}

/// What exact lines make of a pixel: its red, green and blue, and the share of it that they cover, 0 to 1.
fn with_lines(resolved: &Resolved, renderer: &mut Renderer, place: DVec2) -> Result<([u8; 3], f64)> {
    let size = resolved.scene.size;
    let [x, y] = [place.x, place.y].map(|at| at.floor() as i64);
    let (plan, _) = resolved.plans(renderer)?;
    let around = resolved.around(&Progress::default())?;
    let [red, green, blue, _] = around.drawn(resolved, &plan, renderer)?.pixel(x, y);
    Ok(([red, green, blue], f64::from(around.lines_alone(&plan, size).pixel(x, y)[3]) / 255.0))
}

/// The file of a sheet.
fn checked(path: &str, arguments: &Arguments, inputs: &Inputs) -> Result<Target> {
    tinta::cli::messages::check_output(path)?;
    inputs.keep(path)?;
    if path == "-" && arguments.json {
        return Err(Error::value("output", "-", "the picture and --json cannot share standard output; name a file"));
    }
    Target::check(path, false)
}

/// Explains the line nearest to a place.
fn line_out(resolved: &Resolved, place: DVec2, is_json: bool) -> Result<()> {
    let lines = resolved.contents.lines.clone().unwrap_or_default();
    let why = nearest_line(&resolved.scene, &lines, place)?;
    if is_json { print_json(&why) } else { print(&line::in_words(&why)) }
}

fn nearest_line(scene: &Scene, lines: &LineSettings, place: DVec2) -> Result<Why> {
    VisibleLines::why(scene, lines, place).map_err(|error| match error {
        // The place is no option.
        Error::Setting { name, value: Some(place), problem } if name == "place" => {
            Error::CommandLine { problem: format!("{place}: {problem}") }
        }
        error => error,
    })
}
