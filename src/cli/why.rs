//! `tinta why`: why the line at a place of the picture is visible or hidden.

use super::models::load_meshes;
use super::options::{Below, CameraFile, Chosen, OfSubject, Selection};
use super::{Command, Verdict, given, plain};
use std::fmt::Write;
use tinta::glam::DVec2;
use tinta::lines::{Hider, Why, WhyLine, WhyPiece};
use tinta::request::{Layer, Request};
use tinta::settings::{HasSettings, Setting};
use tinta::{Error, LineSettings, Result, Scene, StyleName, VisibleLines};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta why cow.obj 240,310                       explain why a line is hidden"],
    ..Command::new("why", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// Explain why the line at a place of the picture is visible or hidden
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in model, or - for standard input
    #[arg(value_name = "MODEL")]
    model: String,

    /// Place in the picture, pixels to the right and down from its upper left corner; the line nearest to it is explained
    #[arg(value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    place: DVec2,

    /// Style whose lines are explained: lines [default: lines]
    #[arg(long, value_name = "STYLE", default_value = "lines", hide_default_value = true)]
    style: String,

    /// Print one JSON object [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    drawing: Chosen<OfLines>,
}

/// What is drawn as which line, from where, and how large.
struct OfLines;

impl Selection for OfLines {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        OfSubject::has(setting) || setting.name == "size" || LineSettings::table().has(setting.name)
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

/// Explains a line.
pub(super) fn run(arguments: &Arguments) -> Result<()> {
    if arguments.style != StyleName::Lines.name() {
        let problem = "only lines are explained so far; leave it out";
        return Err(Error::value("style", &arguments.style, problem));
    }
    let below = Below { camera: arguments.camera.camera.as_deref(), ..Below::default() };
    let style = Layer::Style(StyleName::Lines);
    let (request, _) = arguments.drawing.request_over(style, std::slice::from_ref(&arguments.model), &below)?;
    let scene = Scene::new(load_meshes(&request.models, &request.read)?, &request.scene)?;
    let settings = request.line_style().unwrap_or_default().lines;
    let why = VisibleLines::why(&scene, &settings, arguments.place).map_err(|error| match error {
        // The place is no option.
        Error::Setting { name, value: Some(place), problem } if name == "place" => {
            Error::CommandLine { problem: format!("{place}: {problem}") }
        }
        error => error,
    })?;
    if arguments.json { super::print_json(&why) } else { super::print(&in_words(&why)) }
}

/// Hiders named at a place, and those named at each piece.
const MOST: usize = 8;
const MOST_OF_PIECE: usize = 2;

fn in_words(why: &Why) -> String {
    let Why { asked_px, line, nearest_px, distance_px, is_visible, hidden_by, pieces } = why;
    let mut text = format!("The nearest line: {}.\n", of_line(line));
    let state = if *is_visible { "visible" } else { "hidden" };
    let _ = writeln!(text, "It is {state} at {}, {distance_px:.2} px from {}.", pixel(*nearest_px), pixel(*asked_px));
    let along = match (pieces.first(), pieces.last()) {
        (Some(first), Some(last)) => DVec2::from(last.to_px) - DVec2::from(first.from_px),
        _ => DVec2::X,
    };
    for hider in hidden_by.iter().take(MOST) {
        let _ = writeln!(text, "  {}", of_hider(hider, along));
    }
    if hidden_by.len() > MOST {
        let _ = writeln!(text, "  and {} more", hidden_by.len() - MOST);
    }
    text.push_str("\nAll of it, from one end to the other:\n");
    for WhyPiece { from_px, to_px, is_visible, hidden_by } in pieces {
        let state = if *is_visible { "visible" } else { "hidden" };
        let _ = write!(text, "  {} to {}  {state}", pixel(*from_px), pixel(*to_px));
        let named: Vec<String> = hidden_by.iter().take(MOST_OF_PIECE).map(name_of).collect();
        let more = hidden_by.len().saturating_sub(MOST_OF_PIECE);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        if !named.is_empty() {
            let _ = write!(text, " by {}{more}", named.join(", "));
        }
        text.push('\n');
    }
    text
}

fn pixel([x, y]: [f64; 2]) -> String {
    format!("{x:.2},{y:.2}")
}

fn of_line(line: &WhyLine) -> String {
    let WhyLine { class, name, edge, angle_degrees, .. } = line;
    let edge = edge.map_or_else(String::new, |[first, second]| format!(", from vertex {first} to {second}"));
    let angle = angle_degrees.map_or_else(String::new, |degrees| format!(", {degrees:.1} degrees between its faces"));
    format!("{class} of {}{edge}{angle}", plain(name))
}

fn name_of(hider: &Hider) -> String {
    match hider {
        Hider::Face { name, face: Some(face), .. } => format!("face {face} of {}", plain(name)),
        Hider::Face { name, vertices: [a, b, c], .. } => {
            format!("the face of vertices {a}, {b} and {c} of {}", plain(name))
        }
        Hider::Line { line, .. } => of_line(line),
    }
}

/// What hides a line, and which side of it: `along` is the line's direction in the picture.
fn of_hider(hider: &Hider, along: DVec2) -> String {
    let name = name_of(hider);
    match hider {
        Hider::Line { in_front: 0.0, .. } => format!("{name} is in the same place and is drawn for both"),
        Hider::Line { in_front, .. } => format!("{name} lies on it, nearer by {in_front:.6}"),
        Hider::Face { left: true, right: true, in_front, .. } => {
            format!("{name} is nearer by {in_front:.6}, on both sides")
        }
        Hider::Face { left, in_front, .. } => {
            // Left of a line that runs to the right is up, with y down.
            let side = if *left { DVec2::new(along.y, -along.x) } else { DVec2::new(-along.y, along.x) };
            let side = match (side.x.abs() > side.y.abs(), side.x > 0.0, side.y > 0.0) {
                (true, true, _) => "right",
                (true, false, _) => "left",
                (false, _, true) => "lower",
                (false, _, false) => "upper",
            };
            format!("{name} is nearer by {in_front:.6}, on the {side} side")
        }
    }
}
