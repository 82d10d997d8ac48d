//! Dials of the image-space styles: tones, border, map, ink.

use super::{Dial, Kind, joined, name_in, number, numbers, on_off, put, switch};
use crate::names::find;
use crate::styles::{
    Border, Cartoon, Filter, Ink, MapEncoding, MapTarget, Quality, Style, Supersample, ToneLookup, Tones,
};

fn tones(style: &mut Style) -> Option<&mut Tones> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(&mut cartoon.tones),
        Style::Mrt(mrt) => Some(&mut mrt.tones),
        Style::Ink(ink) => Some(&mut ink.tones),
        _ => None,
    }
}

fn optional_border(style: &mut Style) -> Option<&mut Option<Border>> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(&mut cartoon.border),
        Style::Mrt(mrt) => Some(&mut mrt.border),
        _ => None,
    }
}

fn border(style: &mut Style) -> Option<&mut Border> {
    optional_border(style)?.as_mut()
}

fn cartoon(style: &mut Style) -> Option<&mut Cartoon> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(cartoon),
        _ => None,
    }
}

fn ink(style: &mut Style) -> Option<&mut Ink> {
    if let Style::Ink(ink) = style { Some(ink) } else { None }
}

fn square(style: &mut Style) -> Option<&mut bool> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(&mut cartoon.background_square),
        Style::Mrt(mrt) => Some(&mut mrt.background_square),
        _ => None,
    }
}

fn supersample(style: &mut Style) -> Option<&mut Supersample> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(&mut cartoon.supersample),
        Style::Mrt(mrt) => Some(&mut mrt.supersample),
        _ => None,
    }
}

fn map_target(style: &mut Style) -> Option<&mut MapTarget> {
    match style {
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(&mut cartoon.map_target),
        Style::Ink(ink) => Some(&mut ink.map_target),
        _ => None,
    }
}

fn is_inked(style: &mut Style) -> Option<&mut bool> {
    match style {
        Style::Ink(ink) => Some(&mut ink.is_inked),
        Style::Inking(inking) => Some(&mut inking.is_inked),
        _ => None,
    }
}

fn read_lines(style: &mut Style) -> Option<String> {
    if let Some(border) = optional_border(style) {
        return Some(on_off(border.is_none()));
    }
    is_inked(style).map(|is_inked| on_off(!*is_inked))
}

fn turn_lines(style: &mut Style, text: &str) -> Result<(), String> {
    let without = switch(text)?;
    if let Some(border) = optional_border(style) {
        *border = if without { None } else { Some(border.unwrap_or_default()) };
    }
    put(is_inked(style), !without)
}

pub(super) const DIALS: &[Dial] = &[
    Dial {
        option: "--tones",
        label: "tones",
        help: "Number of tones; fewer leave out the brightest",
        kind: Kind::number(1.0, 3.0, 0),
        read: |style| tones(style).map(|tones| tones.count.to_string()),
        turn: |style, text| {
            let count = number::<u8>(text)?;
            put(tones(style).map(|tones| &mut tones.count), count)
        },
    },
    Dial {
        option: "--tone-thresholds",
        label: "tone thresholds",
        help: "Diffuse and specular light from which the second and third tone hold",
        kind: Kind::Numbers { count: 2, range: [0.0, 1.0], decimals: 3 },
        read: |style| tones(style).map(|tones| joined(&[tones.diffuse_threshold, tones.specular_threshold])),
        turn: |style, text| {
            let [diffuse, specular] = numbers(text)?;
            put(tones(style).map(|tones| &mut tones.diffuse_threshold), diffuse)?;
            put(tones(style).map(|tones| &mut tones.specular_threshold), specular)
        },
    },
    Dial {
        option: "--tone-levels",
        label: "tone levels",
        help: "What the tones multiply the colour by",
        kind: Kind::Numbers { count: 3, range: [0.0, 1.0], decimals: 3 },
        read: |style| tones(style).map(|tones| joined(&tones.levels)),
        turn: |style, text| {
            let levels = numbers(text)?;
            put(tones(style).map(|tones| &mut tones.levels), levels)
        },
    },
    Dial {
        option: "--tone-lookup",
        label: "tone lookup",
        help: "Find tones by comparing, or in a texture",
        kind: Kind::Choice(&["steps", "texture"]),
        read: |style| tones(style).and_then(|tones| name_in(&ToneLookup::ALL, &tones.lookup)),
        turn: |style, text| {
            let lookup = find(&ToneLookup::ALL, text)?;
            put(tones(style).map(|tones| &mut tones.lookup), lookup)
        },
    },
    Dial {
        option: "--no-borders",
        label: "no lines",
        help: "Tones or paint alone",
        kind: Kind::Flag,
        read: read_lines,
        turn: turn_lines,
    },
    Dial {
        option: "--filter",
        label: "edge filter",
        help: "What finds edges in the map",
        kind: Kind::Choice(&["laplacian4", "laplacian8", "mitchell", "sobel", "roberts"]),
        read: |style| border(style).and_then(|border| name_in(&Filter::ALL, &border.filter)),
        turn: |style, text| {
            let filter = find(&Filter::ALL, text)?;
            put(border(style).map(|border| &mut border.filter), filter)
        },
    },
    Dial {
        option: "--detection-factor",
        label: "detection factor",
        help: "What the filter's response is multiplied by; more darkens faint edges",
        kind: Kind::number(0.0, 2.0, 3),
        read: |style| border(style).map(|border| border.detection_factor.to_string()),
        turn: |style, text| {
            let factor = number(text)?;
            put(border(style).map(|border| &mut border.detection_factor), factor)
        },
    },
    Dial {
        option: "--border-width",
        label: "border width",
        help: "Width of the borders, pixels; paper is as the filter draws them",
        kind: Kind::Choice(&["paper", "1", "2", "3", "4", "5", "6", "8", "12", "16", "24", "32", "64"]),
        read: |style| border(style).map(|border| border.width_px.map_or("paper".to_owned(), |px| px.to_string())),
        turn: |style, text| {
            let width = if text == "paper" { None } else { Some(number::<u32>(text)?) };
            put(border(style).map(|border| &mut border.width_px), width)
        },
    },
    Dial {
        option: "--border-width",
        label: "line width",
        help: "Width of the lines, pixels",
        kind: Kind::number(1.0, 64.0, 0),
        read: |style| ink(style).map(|ink| ink.line_width_px.to_string()),
        turn: |style, text| {
            let width = number::<u32>(text)?;
            put(ink(style).map(|ink| &mut ink.line_width_px), width)
        },
    },
    Dial {
        option: "--slope-threshold",
        label: "slope threshold",
        help: "Let depth answer by a threshold that knows the surface's slope",
        kind: Kind::Switch,
        read: |style| border(style).map(|border| on_off(border.slope_threshold)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(border(style).map(|border| &mut border.slope_threshold), is_on)
        },
    },
    Dial {
        option: "--background-quad",
        label: "background square",
        help: "Draw a square behind the scene; without it outer borders are lost",
        kind: Kind::Switch,
        read: |style| square(style).map(|is_drawn| on_off(*is_drawn)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(square(style), is_on)
        },
    },
    Dial {
        option: "--map-encoding",
        label: "map encoding",
        help: "How normals and depth are kept between the passes",
        kind: Kind::Choice(&["paper", "biased", "float16", "float", "depth-texture"]),
        read: |style| cartoon(style).and_then(|cartoon| name_in(&MapEncoding::ALL, &cartoon.map_encoding)),
        turn: |style, text| {
            let encoding = find(&MapEncoding::ALL, text)?;
            put(cartoon(style).map(|cartoon| &mut cartoon.map_encoding), encoding)
        },
    },
    Dial {
        option: "--map-target",
        label: "map target",
        help: "Copy the map into its texture, or draw it there",
        kind: Kind::Choice(&["copy", "texture"]),
        read: |style| map_target(style).and_then(|target| name_in(&MapTarget::ALL, target)),
        turn: |style, text| {
            let target = find(&MapTarget::ALL, text)?;
            put(map_target(style), target)
        },
    },
    Dial {
        option: "--supersample",
        label: "supersample",
        help: "Draw so many times as wide and high, and shrink",
        kind: Kind::Choice(&["1", "2", "4"]),
        read: |style| supersample(style).and_then(|factor| name_in(&Supersample::ALL, factor)),
        turn: |style, text| {
            let factor = find(&Supersample::ALL, text)?;
            put(supersample(style), factor)
        },
    },
    Dial {
        option: "--supersample",
        label: "supersample",
        help: "Draw so many times as wide and high, and shrink; auto is as the quality has it",
        kind: Kind::Choice(&["auto", "1", "2", "4"]),
        read: |style| {
            let ink = ink(style)?;
            ink.supersample.map_or(Some("auto".to_owned()), |factor| name_in(&Supersample::ALL, &factor))
        },
        turn: |style, text| {
            let factor = if text == "auto" { None } else { Some(find(&Supersample::ALL, text)?) };
            put(ink(style).map(|ink| &mut ink.supersample), factor)
        },
    },
    Dial {
        option: "--quality",
        label: "quality",
        help: "How much time the ink may take",
        kind: Kind::Choice(&["standard", "best"]),
        read: |style| ink(style).and_then(|ink| name_in(&Quality::ALL, &ink.quality)),
        turn: |style, text| {
            let quality = find(&Quality::ALL, text)?;
            put(ink(style).map(|ink| &mut ink.quality), quality)
        },
    },
    Dial {
        option: "least-gap",
        label: "least gap",
        help: "Least step from one surface to another that is a line, widths of a pixel; more draws fewer lines",
        kind: Kind::number(0.0, 20.0, 2),
        read: |style| ink(style).map(|ink| ink.least_gap_px.to_string()),
        turn: |style, text| {
            let gap = number(text)?;
            put(ink(style).map(|ink| &mut ink.least_gap_px), gap)
        },
    },
    Dial {
        option: "gap-per-slope",
        label: "gap per slope",
        help: "What is added to it for each unit of slope; more draws fewer lines near outlines",
        kind: Kind::number(0.0, 5.0, 2),
        read: |style| ink(style).map(|ink| ink.gap_per_slope.to_string()),
        turn: |style, text| {
            let gap = number(text)?;
            put(ink(style).map(|ink| &mut ink.gap_per_slope), gap)
        },
    },
];
