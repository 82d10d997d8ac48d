//! Dials of phong, charcoal and sand; and culling, which every style has.

use super::{Dial, Kind, charcoal, joined, name_in, number, numbers, on_off, put, switch};
use crate::names::find;
use crate::styles::{CetCoordinate, CetFilter, ContrastOperator, Improvements, Noise, Paper, Phong, Style};
use std::path::Path;

fn phong(style: &mut Style) -> Option<&mut Phong> {
    if let Style::Phong(phong) = style { Some(phong) } else { None }
}

fn culls(style: &mut Style) -> &mut bool {
    match style {
        Style::Phong(phong) => &mut phong.cull_back_faces,
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => &mut cartoon.cull_back_faces,
        Style::Mrt(mrt) => &mut mrt.cull_back_faces,
        Style::Inking(inking) => &mut inking.cull_back_faces,
        Style::Dietrich(dietrich) => &mut dietrich.cull_back_faces,
        Style::Ink(ink) => &mut ink.cull_back_faces,
        Style::Charcoal(charcoal) | Style::Sand(charcoal) => &mut charcoal.cull_back_faces,
    }
}

const FACES: [(&str, bool); 2] = [("none", false), ("back", true)];

fn improvements(improve: Improvements) -> String {
    let Improvements { clamp, wrap, paper_coordinate, luminance } = improve;
    let named = [("clamp", clamp), ("wrap", wrap), ("paper-coordinate", paper_coordinate), ("luminance", luminance)];
    let chosen: Vec<&str> = named.iter().filter(|(_, is_mended)| *is_mended).map(|(name, _)| *name).collect();
    if chosen.is_empty() { "none".to_owned() } else { chosen.join(",") }
}

fn read_paper(style: &mut Style) -> Option<String> {
    charcoal(style).map(|charcoal| match &charcoal.paper {
        Paper::Made => "made".to_owned(),
        Paper::File { path, .. } => path.display().to_string(),
    })
}

fn turn_paper(style: &mut Style, text: &str) -> Result<(), String> {
    let paper = match text {
        "made" => Paper::Made,
        path => Paper::read(Path::new(path)).map_err(|error| error.to_string())?,
    };
    put(charcoal(style).map(|charcoal| &mut charcoal.paper), paper)
}

pub(super) const DIALS: &[Dial] = &[
    Dial {
        option: "ambient",
        label: "ambient",
        help: "Share of the colour seen where no light falls",
        kind: Kind::number(0.0, 1.0, 2),
        read: |style| phong(style).map(|phong| phong.ambient.to_string()),
        turn: |style, text| {
            let ambient = number(text)?;
            put(phong(style).map(|phong| &mut phong.ambient), ambient)
        },
    },
    Dial {
        option: "specular",
        label: "specular",
        help: "Weight of the white highlight",
        kind: Kind::number(0.0, 1.0, 2),
        read: |style| phong(style).map(|phong| phong.specular.to_string()),
        turn: |style, text| {
            let specular = number(text)?;
            put(phong(style).map(|phong| &mut phong.specular), specular)
        },
    },
    Dial {
        option: "shininess",
        label: "shininess",
        help: "Exponent of the highlight; more makes it smaller",
        kind: Kind::number(1.0, 200.0, 0),
        read: |style| phong(style).map(|phong| phong.shininess.to_string()),
        turn: |style, text| {
            let shininess = number(text)?;
            put(phong(style).map(|phong| &mut phong.shininess), shininess)
        },
    },
    Dial {
        option: "--density",
        label: "density",
        help: "Share of black in the grain's texture before grains are moved, percent; more is darker",
        kind: Kind::number(0.0, 100.0, 0),
        read: |style| charcoal(style).map(|charcoal| charcoal.density_percent.to_string()),
        turn: |style, text| {
            let density = number(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.density_percent), density)
        },
    },
    Dial {
        option: "--cet-exponent",
        label: "grain exponent",
        help: "Exponent that moves black pixels; more leaves fewer grains in light tones",
        kind: Kind::number(1.0, 20.0, 1),
        read: |style| charcoal(style).map(|charcoal| charcoal.cet_exponent.to_string()),
        turn: |style, text| {
            let exponent = number(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.cet_exponent), exponent)
        },
    },
    Dial {
        option: "--contrast-exponent",
        label: "contrast exponent",
        help: "Exponent of the light's contrast; more darkens all but the lights",
        kind: Kind::number(0.1, 6.0, 2),
        read: |style| charcoal(style).map(|charcoal| charcoal.contrast_exponent.to_string()),
        turn: |style, text| {
            let exponent = number(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.contrast_exponent), exponent)
        },
    },
    Dial {
        option: "--saturation",
        label: "saturation",
        help: "What the light is multiplied by; above 1 faint lines vanish",
        kind: Kind::number(0.0, 3.0, 2),
        read: |style| charcoal(style).map(|charcoal| charcoal.saturation.to_string()),
        turn: |style, text| {
            let saturation = number(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.saturation), saturation)
        },
    },
    Dial {
        option: "--smudge",
        label: "smudge",
        help: "Smudge the drawing, which darkens it",
        kind: Kind::Switch,
        read: |style| charcoal(style).map(|charcoal| on_off(charcoal.smudge)),
        turn: |style, text| {
            let is_on = switch(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.smudge), is_on)
        },
    },
    Dial {
        option: "--light-1",
        label: "first light",
        help: "Direction towards it, seen from the eye",
        kind: Kind::Numbers { count: 3, range: [-1.0, 1.0], decimals: 2 },
        read: |style| charcoal(style).map(|charcoal| joined(&charcoal.lights[0])),
        turn: |style, text| {
            let light = numbers(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.lights[0]), light)
        },
    },
    Dial {
        option: "--light-2",
        label: "second light",
        help: "Direction towards it, seen from the eye",
        kind: Kind::Numbers { count: 3, range: [-1.0, 1.0], decimals: 2 },
        read: |style| charcoal(style).map(|charcoal| joined(&charcoal.lights[1])),
        turn: |style, text| {
            let light = numbers(text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.lights[1]), light)
        },
    },
    Dial {
        option: "--seed",
        label: "seed",
        help: "Where the random numbers begin",
        kind: Kind::number(0.0, 1000.0, 0),
        read: |style| charcoal(style).map(|charcoal| charcoal.seed.to_string()),
        turn: |style, text| {
            let seed = text.parse().map_err(|_| "give a whole number from 0".to_owned())?;
            put(charcoal(style).map(|charcoal| &mut charcoal.seed), seed)
        },
    },
    Dial {
        option: "--texture-size",
        label: "texture size",
        help: "Size of grain, noise and paper, WxH; more is finer",
        kind: Kind::Text,
        read: |style| charcoal(style).map(|charcoal| charcoal.texture_size.to_string()),
        turn: |style, text| {
            let size = text.parse()?;
            put(charcoal(style).map(|charcoal| &mut charcoal.texture_size), size)
        },
    },
    Dial {
        option: "--paper",
        label: "paper",
        help: "Picture of the paper, or made",
        kind: Kind::Text,
        read: read_paper,
        turn: turn_paper,
    },
    Dial {
        option: "--cet-filter",
        label: "grain filter",
        help: "Filter of the grain's texture; mipmap blurs it away",
        kind: Kind::Choice(&["linear", "mipmap"]),
        read: |style| charcoal(style).and_then(|charcoal| name_in(&CetFilter::ALL, &charcoal.cet_filter)),
        turn: |style, text| {
            let filter = find(&CetFilter::ALL, text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.cet_filter), filter)
        },
    },
    Dial {
        option: "--cet-coordinate",
        label: "grain chosen by",
        help: "Light that chooses the grain",
        kind: Kind::Choice(&["original", "saturated"]),
        read: |style| charcoal(style).and_then(|charcoal| name_in(&CetCoordinate::ALL, &charcoal.cet_coordinate)),
        turn: |style, text| {
            let coordinate = find(&CetCoordinate::ALL, text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.cet_coordinate), coordinate)
        },
    },
    Dial {
        option: "--contrast-operator",
        label: "contrast operator",
        help: "What enhances contrast",
        kind: Kind::Choice(&["power", "sigmoid", "bias"]),
        read: |style| charcoal(style).and_then(|charcoal| name_in(&ContrastOperator::ALL, &charcoal.operator)),
        turn: |style, text| {
            let operator = find(&ContrastOperator::ALL, text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.operator), operator)
        },
    },
    Dial {
        option: "--noise",
        label: "noise",
        help: "Where the noise lies: on the picture, or on the model",
        kind: Kind::Choice(&["screen", "object"]),
        read: |style| charcoal(style).and_then(|charcoal| name_in(&Noise::ALL, &charcoal.noise)),
        turn: |style, text| {
            let noise = find(&Noise::ALL, text)?;
            put(charcoal(style).map(|charcoal| &mut charcoal.noise), noise)
        },
    },
    Dial {
        option: "--improve",
        label: "mended flaws",
        help: "clamp, wrap, paper-coordinate, luminance with commas between, all or none",
        kind: Kind::Text,
        read: |style| charcoal(style).map(|charcoal| improvements(charcoal.improve)),
        turn: |style, text| {
            let improve = text.parse()?;
            put(charcoal(style).map(|charcoal| &mut charcoal.improve), improve)
        },
    },
    Dial {
        option: "--cull",
        label: "cull",
        help: "Leave out faces turned away",
        kind: Kind::Choice(&["none", "back"]),
        read: |style| name_in(&FACES, culls(style)),
        turn: |style, text| {
            let is_left_out = find(&FACES, text)?;
            put(Some(culls(style)), is_left_out)
        },
    },
];
