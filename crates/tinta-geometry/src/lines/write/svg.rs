//! Writes lines as SVG 1.1: a layer of polylines for each class and visibility, and one of texts if points have labels; below
//! them areas and the strokes of tones.
//!
//! Input: [`VisibleLines`] and [`DrawingSettings`]. Output: a text that is byte-identical for the same input.
//! Coordinates are pixels with three decimals, y down, in the order of the segments. The layers are groups that
//! Inkscape shows as layers, hidden ones below visible ones.

use crate::error::Result;
use crate::lines::VisibleLines;
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::curves::fitted;
use crate::lines::drawing::drawn_labels::height_px;
use crate::lines::drawing::drawn_layers::{Drawing, DrawnLayer, GHOST_OPACITY, points_of};
use crate::lines::drawing::fills::{FillGroup, GROUND, TRAP_PX};
use crate::lines::drawing::key::Key;
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::page::PAGE_DECIMALS;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::drawing::taper::outline;
use crate::lines::drawing::text::{curve_data, decimal, hexadecimal, number, path_data};
use crate::lines::regions::Surface;
use crate::lines::write::part_groups::{by_part, in_id, names};
use crate::markup::escaped;
use crate::markup::recipe_element;
use crate::mesh::NONE;
use crate::scene::Background;
use glam::DVec2;
use std::fmt::Write;

/// Returns the lines as an SVG file, without spurs and specks.
///
/// # Errors
///
/// [`crate::Error::Setting`] for settings that [`DrawingSettings::check`] refuses, [`crate::Error::Lines`] for lines
/// that are not finite or leave the picture.
pub fn svg(lines: &VisibleLines, settings: &DrawingSettings) -> Result<String> {
    let lines = lines.without_specks(settings)?;
    svg_of_paths(&lines, chain(&lines.segments), None, settings)
}

/// Returns the given lines as an SVG file, with the paths that [`chain`] made of them, above the given areas; lines
/// alone have none.
///
/// # Errors
///
/// Those of [`svg`].
pub fn svg_of_paths(
    lines: &VisibleLines,
    paths: Vec<LinePath>,
    areas: Option<&Areas>,
    settings: &DrawingSettings,
) -> Result<String> {
    let drawing = Drawing::new(lines, paths, areas, settings)?;
    // A pen goes the shortest way, whatever the parts.
    let names = if settings.is_for_pen { Vec::new() } else { names(&lines.parts) };
    let mut out = String::new();
    begin(&drawing, &mut out);
    for as_one in areas.map_or(&[][..], |areas| &areas.fills).chunk_by(|one, next| one.opacity == next.opacity) {
        let opacity = as_one[0].opacity;
        let is_clear = opacity < 1.0;
        if is_clear {
            let _ = writeln!(out, r#"<g opacity="{}">"#, number(f64::from(opacity)));
        }
        as_one.iter().for_each(|group| write_fills(group, &mut out));
        out.push_str(if is_clear { "</g>\n" } else { "" });
    }
    for layer in &drawing.layers {
        write_layer(&drawing, layer, &names, &mut out);
    }
    areas.into_iter().flat_map(|areas| &areas.keys).for_each(|key| write_key(key, &mut out));
    write_labels(&drawing, &mut out);
    out.push_str("</svg>\n");
    Ok(out)
}

/// Writes the rectangles of a key; its texts are labels.
fn write_key(key: &Key, out: &mut String) {
    out.push_str("<g inkscape:groupmode=\"layer\" inkscape:label=\"key\" shape-rendering=\"crispEdges\">\n");
    for ([low, high], color) in &key.boxes {
        let [x, y, width, height] = [low.x, low.y, high.x - low.x, high.y - low.y].map(number);
        let fill = hexadecimal(*color);
        let _ = writeln!(out, r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{fill}"/>"#);
    }
    out.push_str("</g>\n");
}

fn write_labels(drawing: &Drawing<'_>, out: &mut String) {
    if drawing.labels.is_empty() {
        return;
    }
    let usual = height_px(drawing.page.units);
    let height = number(usual);
    let _ = writeln!(
        out,
        r#"<g id="labels" inkscape:groupmode="layer" inkscape:label="labels" font-family="sans-serif" font-size="{height}">"#
    );
    for label in &drawing.labels {
        let [x, y] = label.at_px.to_array().map(number);
        let (fill, text) = (hexadecimal(label.color), escaped(label.text));
        let anchor = match label.left {
            0.0 => "",
            left if left < 1.0 => r#" text-anchor="middle""#,
            _ => r#" text-anchor="end""#,
        };
        let own = Some(label.height_px).filter(|height| *height != usual).map(number);
        let size = own.map(|height| format!(r#" font-size="{height}""#)).unwrap_or_default();
        let _ = writeln!(out, r#"<text x="{x}" y="{y}"{anchor}{size} fill="{fill}">{text}</text>"#);
    }
    out.push_str("</g>\n");
}

/// Writes everything before the layers.
pub(super) fn begin(drawing: &Drawing<'_>, out: &mut String) {
    let (settings, page) = (drawing.settings, &drawing.page);
    let [width, height] = page.lengths();
    let page_number = |value| decimal(value, PAGE_DECIMALS);
    let [x, y] = page.origin_px.to_array().map(page_number);
    let [width_px, height_px] = page.extent_px.to_array().map(page_number);
    let element = |name: &str, text: &str| match text {
        "" => String::new(),
        text => format!("<{name}>{}</{name}>\n", escaped(text)),
    };
    let [title, title_again] = ["title", "dc:title"].map(|name| element(name, &settings.title));
    let command = element("dc:description", &settings.command);
    let recipe = recipe_element(&settings.recipe);
    let _ = write!(
        out,
        r#"<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1" width="{width}" height="{height}" viewBox="{x} {y} {width_px} {height_px}">
{title}<metadata>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:cc="http://creativecommons.org/ns#" xmlns:dc="http://purl.org/dc/elements/1.1/">
<cc:Work rdf:about="">
<dc:format>image/svg+xml</dc:format>
{title_again}{command}</cc:Work>
</rdf:RDF>
{recipe}</metadata>
"#
    );
    if let (Background::Color(color), false) = (settings.background, settings.is_for_pen) {
        let fill = hexadecimal(color);
        let place = if [&x, &y] == ["0"; 2] { String::new() } else { format!(r#"x="{x}" y="{y}" "#) };
        let _ =
            writeln!(out, r#"<rect id="background" {place}width="{width_px}" height="{height_px}" fill="{fill}"/>"#);
    }
}

/// Writes an object's material as a layer of areas, each with the numbers of its tone and its face.
fn write_fills(group: &FillGroup, out: &mut String) {
    let object = group.object;
    let data = |polylines: &[Vec<DVec2>], is_closed: bool| {
        polylines.iter().map(|points| path_data(points, is_closed)).collect::<String>()
    };
    let (name, label) = match group.material {
        GROUND if object == NONE => ("fill-ground".to_owned(), "shadow on the ground".to_owned()),
        NONE if object == NONE => ("fill-seams".to_owned(), "below seams".to_owned()),
        view if object == NONE => (format!("fill-seams-{view}"), format!("below seams of view {view}")),
        NONE => (format!("fill-{object}"), format!("object {object}")),
        material => {
            let named = if group.name.is_empty() { format!("material {material}") } else { escaped(&group.name) };
            (format!("fill-{object}-{material}"), format!("object {object} {named}"))
        }
    };
    let edges = match group.is_crisp {
        true => r#"shape-rendering="crispEdges""#.to_owned(),
        false => format!(r#"stroke-width="{TRAP_PX}" stroke-linejoin="round""#),
    };
    let mut clip = String::new();
    if !group.clip.is_empty() {
        clip = format!(r#" clip-path="url(#{name}-clip)""#);
        let outline = data(&group.clip, true);
        let _ = writeln!(out, r#"<clipPath id="{name}-clip"><path clip-rule="evenodd" d="{outline}"/></clipPath>"#);
    }
    let _ = writeln!(
        out,
        r#"<g id="{name}" inkscape:groupmode="layer" inkscape:label="{label}" fill-rule="evenodd" stroke="none" {edges}{clip}>"#
    );
    for fill in &group.fills {
        let color = hexadecimal(fill.color);
        let Surface { tone, face, .. } = fill.surface;
        if !fill.loops.is_empty() {
            out.push_str("<path ");
            for (name, number) in [("tone", tone.map(u32::from)), ("face", face)] {
                let _ = number.map_or(Ok(()), |number| write!(out, r#"data-{name}="{number}" "#));
            }
            let _ = writeln!(out, r#"fill="{color}" d="{}"/>"#, data(&fill.loops, true));
        }
        if !fill.trap.is_empty() {
            let _ = writeln!(out, r#"<path fill="none" stroke="{color}" d="{}"/>"#, data(&fill.trap, false));
        }
    }
    out.push_str("</g>\n");
}

/// Writes a layer; in it each named part is a group with its name.
fn write_layer(drawing: &Drawing<'_>, drawn: &DrawnLayer, names: &[String], out: &mut String) {
    out.push_str(&layer_tag(drawn));
    for (part, paths) in by_part(drawing, drawn, names) {
        if !part.is_empty() {
            let (layer, id, name) = (drawn.id(), in_id(part), escaped(part));
            let _ = writeln!(out, "<g id=\"{layer}_{id}\" data-part=\"{name}\">\n<title>{name}</title>");
        }
        out.extend(paths.iter().map(|path| format!("<path d=\"{}\"/>\n", path_data_of(drawing, path))));
        out.push_str(if part.is_empty() { "" } else { "</g>\n" });
    }
    if !drawn.tips.is_empty() {
        let outlines = drawn.tips.iter().map(|tip| path_data(&outline(tip, drawn.width_px), true));
        let (fill, data) = (hexadecimal(drawn.color), outlines.collect::<String>());
        let _ = writeln!(out, r#"<path fill="{fill}" stroke="none" d="{data}"/>"#);
    }
    out.push_str("</g>\n");
}

/// The opening tag of a layer.
pub(super) fn layer_tag(drawn: &DrawnLayer) -> String {
    let (id, label) = (drawn.id(), escaped(&drawn.label()));
    let mut tag = format!(
        r#"<g id="{id}" inkscape:groupmode="layer" inkscape:label="{label}" fill="none" stroke="{}" stroke-width="{}" stroke-linecap="round" stroke-linejoin="round""#,
        hexadecimal(drawn.color),
        number(drawn.width_px)
    );
    if let Layer::Hatch(tone) = drawn.layer {
        let _ = write!(tag, r#" data-tone="{tone}""#);
    }
    if !drawn.dash_px.is_empty() {
        let lengths: Vec<String> = drawn.dash_px.iter().map(|length| number(*length)).collect();
        let _ = write!(tag, r#" stroke-dasharray="{}""#, lengths.join(" "));
    }
    if drawn.is_ghost {
        let _ = write!(tag, r#" opacity="{GHOST_OPACITY}""#);
    }
    tag.push_str(">\n");
    tag
}

/// A path's data, with curves where they are wanted.
pub(super) fn path_data_of(drawing: &Drawing<'_>, path: &LinePath) -> String {
    match drawing.settings.fit_px {
        Some(error_px) => curve_data(&fitted(path, error_px), path.is_closed),
        None => path_data(&points_of(path), path.is_closed),
    }
}
