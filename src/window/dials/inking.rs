//! Dials of the styles whose lines come from edges or grazing views: inking, dietrich; and the crease angle.

use super::{Dial, Kind, joined, name_in, number, numbers, on_off, put, switch};
use crate::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use crate::names::find;
use crate::plan::LineDrawing;
use crate::scene::Color;
use crate::styles::{ClassColors, Inking, LightOn, PaintMode, Ramp, RampRow, Style};
use std::path::Path;

fn inking(style: &mut Style) -> Option<&mut Inking> {
    if let Style::Inking(inking) = style { Some(inking) } else { None }
}

fn crease_angle(style: &mut Style) -> Option<&mut CreaseAngle> {
    match style {
        Style::Inking(inking) => Some(&mut inking.crease_angle),
        Style::Ink(ink) => Some(&mut ink.crease_angle),
        _ => None,
    }
}

/// Degrees without the digits that rounding leaves.
fn degrees(angle: CreaseAngle) -> String {
    ((angle.degrees() * 1e9).round() / 1e9).to_string()
}

fn turn_crease_angle(style: &mut Style, text: &str) -> Result<(), String> {
    let angle = CreaseAngle::from_degrees(number(text)?).map_err(|error| error.to_string())?;
    // The paper's is a cosine, which its degrees do not give back to the last digit.
    let default = CreaseAngle::default();
    put(crease_angle(style), if degrees(angle) == degrees(default) { default } else { angle })
}

fn classes_text(classes: ClassSet) -> String {
    classes.classes().map(Class::name).collect::<Vec<_>>().join(",")
}

fn classes(text: &str) -> Result<ClassSet, String> {
    if text == "all" {
        return Ok(ClassSet::EDGES);
    }
    let names = text.split(',').map(str::trim).filter(|name| !name.is_empty());
    Ok(ClassSet::of(&names.map(str::parse).collect::<Result<Vec<Class>, String>>()?))
}

/// `CLASS=COLOUR` of each class that is not black.
fn colors_text(colors: &ClassColors) -> String {
    if *colors == ClassColors::figure_6() {
        return "figure-6".to_owned();
    }
    let hexadecimal = |Color(channels): Color| {
        let [red, green, blue] = channels.map(|channel| (channel * 255.0).round() as u8);
        format!("#{red:02x}{green:02x}{blue:02x}")
    };
    let colored = Class::ALL.iter().filter(|(_, class)| colors.0[*class as usize] != Color([0.0; 3]));
    let texts: Vec<String> =
        colored.map(|(name, class)| format!("{name}={}", hexadecimal(colors.0[*class as usize]))).collect();
    if texts.is_empty() { "black".to_owned() } else { texts.join(",") }
}

fn turn_ramp(style: &mut Style, text: &str) -> Result<(), String> {
    let ramp = match text {
        "built-in" => Ramp::default(),
        path => Ramp::read(Path::new(path)).map_err(|error| error.to_string())?,
    };
    put(inking(style).map(|inking| &mut inking.ramp), ramp)
}

fn ramp_row_text(row: RampRow) -> String {
    match row {
        RampRow::Material => "material".to_owned(),
        RampRow::Object => "object".to_owned(),
        RampRow::Row(row) => row.to_string(),
    }
}

const SILHOUETTES: [(&str, SilhouetteRule); 2] = [("paper", SilhouetteRule::Paper), ("exact", SilhouetteRule::Exact)];

const INK_DEPTH: [(&str, bool); 2] = [("write", true), ("test", false)];

pub(super) const DIALS: &[Dial] = &[
    Dial {
        option: "--classes",
        label: "classes",
        help: "Edges to draw: boundary, non-manifold, silhouette, crease, material, texture, normal, or all",
        kind: Kind::Text,
        read: |style| inking(style).map(|inking| classes_text(inking.classes)),
        turn: |style, text| {
            let classes = classes(text)?;
            put(inking(style).map(|inking| &mut inking.classes), classes)
        },
    },
    Dial {
        option: "--crease-angle",
        label: "crease angle",
        help: "Least angle between faces that makes their edge a crease, degrees; more draws fewer lines",
        kind: Kind::number(0.0, 180.0, 1),
        read: |style| crease_angle(style).map(|angle| degrees(*angle)),
        turn: turn_crease_angle,
    },
    Dial {
        option: "--silhouette",
        label: "silhouette",
        help: "Find silhouettes with one view vector for all edges (paper) or exactly",
        kind: Kind::Choice(&["paper", "exact"]),
        read: |style| inking(style).and_then(|inking| name_in(&SILHOUETTES, &inking.silhouette)),
        turn: |style, text| {
            let rule = find(&SILHOUETTES, text)?;
            put(inking(style).map(|inking| &mut inking.silhouette), rule)
        },
    },
    Dial {
        option: "--class-colors",
        label: "class colours",
        help: "CLASS=COLOUR with commas between, figure-6, or black",
        kind: Kind::Text,
        read: |style| inking(style).map(|inking| colors_text(&inking.colors)),
        turn: |style, text| {
            let colors = if text == "black" { ClassColors::default() } else { text.parse()? };
            put(inking(style).map(|inking| &mut inking.colors), colors)
        },
    },
    Dial {
        option: "--line-width",
        label: "line width",
        help: "Width of the lines, pixels",
        kind: Kind::number(0.5, 40.0, 1),
        read: |style| inking(style).map(|inking| inking.line_width_px.to_string()),
        turn: |style, text| {
            let width = number(text)?;
            put(inking(style).map(|inking| &mut inking.line_width_px), width)
        },
    },
    Dial {
        option: "--smooth",
        label: "smooth",
        help: "Smooth and blend the lines",
        kind: Kind::Switch,
        read: |style| inking(style).map(|inking| on_off(inking.is_smooth)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(inking(style).map(|inking| &mut inking.is_smooth), is_on)
        },
    },
    Dial {
        option: "--joints",
        label: "joints",
        help: "Join lines by points at their ends",
        kind: Kind::Switch,
        read: |style| inking(style).map(|inking| on_off(inking.has_joints)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(inking(style).map(|inking| &mut inking.has_joints), is_on)
        },
    },
    Dial {
        option: "--back-edges",
        label: "back edges",
        help: "Draw edges both of whose faces are turned away",
        kind: Kind::Switch,
        read: |style| inking(style).map(|inking| on_off(inking.back_edges)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(inking(style).map(|inking| &mut inking.back_edges), is_on)
        },
    },
    Dial {
        option: "--line-drawing",
        label: "line drawing",
        help: "As GL lines, or as quads of exactly their width",
        kind: Kind::Choice(&["gl", "quads"]),
        read: |style| inking(style).and_then(|inking| name_in(&LineDrawing::ALL, &inking.line_drawing)),
        turn: |style, text| {
            let drawing = find(&LineDrawing::ALL, text)?;
            put(inking(style).map(|inking| &mut inking.line_drawing), drawing)
        },
    },
    Dial {
        option: "--ink-depth",
        label: "ink depth",
        help: "Lines write depth, as in the text, or only test it",
        kind: Kind::Choice(&["write", "test"]),
        read: |style| inking(style).and_then(|inking| name_in(&INK_DEPTH, &inking.writes_depth)),
        turn: |style, text| {
            let writes = find(&INK_DEPTH, text)?;
            put(inking(style).map(|inking| &mut inking.writes_depth), writes)
        },
    },
    Dial {
        option: "--polygon-offset",
        label: "polygon offset",
        help: "How far faces are pushed behind the lines: factor and units",
        kind: Kind::Numbers { count: 2, range: [-10.0, 20.0], decimals: 1 },
        read: |style| inking(style).map(|inking| joined(&inking.polygon_offset)),
        turn: |style, text| {
            let offset = numbers(text)?;
            put(inking(style).map(|inking| &mut inking.polygon_offset), offset)
        },
    },
    Dial {
        option: "--paint",
        label: "paint",
        help: "Faces in the background's colour, their own, or by light and ramp",
        kind: Kind::Choice(&["none", "flat", "ramp"]),
        read: |style| inking(style).and_then(|inking| name_in(&PaintMode::ALL, &inking.paint)),
        turn: |style, text| {
            let paint = find(&PaintMode::ALL, text)?;
            put(inking(style).map(|inking| &mut inking.paint), paint)
        },
    },
    Dial {
        option: "--ramp",
        label: "ramp",
        help: "Picture of four gradients, one above the other, or built-in",
        kind: Kind::Text,
        read: |style| {
            let path = inking(style)?.ramp.path.as_ref();
            Some(path.map_or("built-in".to_owned(), |path| path.display().to_string()))
        },
        turn: turn_ramp,
    },
    Dial {
        option: "--ramp-row",
        label: "ramp row",
        help: "Which gradient: by material, one object after the other, or 0 to 3",
        kind: Kind::Choice(&["material", "object", "0", "1", "2", "3"]),
        read: |style| inking(style).map(|inking| ramp_row_text(inking.ramp_row)),
        turn: |style, text| {
            let row = text.parse()?;
            put(inking(style).map(|inking| &mut inking.ramp_row), row)
        },
    },
    Dial {
        option: "--light",
        label: "light on",
        help: "Where the light is computed",
        kind: Kind::Choice(&["cpu", "vertex-shader"]),
        read: |style| inking(style).and_then(|inking| name_in(&LightOn::ALL, &inking.light)),
        turn: |style, text| {
            let light = find(&LightOn::ALL, text)?;
            put(inking(style).map(|inking| &mut inking.light), light)
        },
    },
    Dial {
        option: "--texture",
        label: "texture",
        help: "Multiply the model's own picture in",
        kind: Kind::Switch,
        read: |style| inking(style).map(|inking| on_off(inking.has_texture)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(inking(style).map(|inking| &mut inking.has_texture), is_on)
        },
    },
    Dial {
        option: "--ink-threshold",
        label: "ink threshold",
        help: "Cosine between normal and view below which a pixel is ink; more makes wider lines",
        kind: Kind::number(0.0, 1.0, 3),
        read: |style| if let Style::Dietrich(dietrich) = style { Some(dietrich.threshold.to_string()) } else { None },
        turn: |style, text| {
            let threshold = number(text)?;
            put(if let Style::Dietrich(dietrich) = style { Some(&mut dietrich.threshold) } else { None }, threshold)
        },
    },
    Dial {
        option: "ink-color",
        label: "ink colour",
        help: "Red, green and blue of the ink",
        kind: Kind::Numbers { count: 3, range: [0.0, 1.0], decimals: 2 },
        read: |style| if let Style::Dietrich(dietrich) = style { Some(joined(&dietrich.ink.0)) } else { None },
        turn: |style, text| {
            let color = numbers(text)?;
            put(if let Style::Dietrich(dietrich) = style { Some(&mut dietrich.ink.0) } else { None }, color)
        },
    },
];
