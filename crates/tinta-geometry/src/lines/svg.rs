//! Lines as SVG 1.1: a layer for each class and visibility, polylines in them, nothing else.
//!
//! In: [`VisibleLines`] and [`SvgSettings`]. Out: a text that is the same, byte for byte, for the same input: coordinates in
//! pixels with three decimals, y down, in the order of the pieces. The layers are groups that Inkscape shows as such, hidden
//! ones below visible ones.

mod settings;
mod text;

pub use settings::{ClassWidths, Hidden, PageSize, SvgSettings};

use super::chain::{LinePath, chain};
use super::pen::{dashes, in_pen_order};
use super::simplify::simplified;
use super::{LineSegment, VisibleLines};
use crate::edges::Class;
use crate::error::{Error, Result};
use crate::markup::escaped;
use crate::markup::recipe_element;
use crate::scene::{Background, Size};
use std::fmt::Write;
use text::{hexadecimal, number, path_data};

/// Opacity of hidden lines drawn as ghosts.
const GHOST_OPACITY: &str = "0.3";

/// Width of a pen's line, pixels: to look at; the pen has its own.
const PEN_WIDTH_PX: f64 = 0.5;

/// Dashes and the gaps between them, widths of their line; its round ends take one from each gap.
const DASH_WIDTHS: [f64; 2] = [3.0, 4.0];

/// A pen's dashes and gaps, shares of the picture's longer side: so many at most, however large the picture.
const PEN_DASHES: [f64; 2] = [1.0 / 128.0, 1.0 / 170.0];

/// The lines as an SVG file.
///
/// # Errors
///
/// [`Error::Setting`] for settings that [`SvgSettings::check`] refuses, [`Error::Lines`] for lines that are not finite or leave the
/// picture.
pub fn svg(lines: &VisibleLines, settings: &SvgSettings) -> Result<String> {
    svg_of_paths(lines, chain(&lines.segments), settings)
}

/// As [`svg`], for lines that [`chain`] has made `paths` of.
///
/// # Errors
///
/// As [`svg`].
pub fn svg_of_paths(lines: &VisibleLines, paths: Vec<LinePath>, settings: &SvgSettings) -> Result<String> {
    settings.check()?;
    lines.check()?;
    let mut out = String::new();
    begin(lines.size, settings, &mut out);
    let mut layers = layers(paths);
    for is_visible in [false, true] {
        // The first class last: an edge of several belongs to the first, which is drawn over the others.
        for (_, class) in Class::ALL.into_iter().rev() {
            let paths = std::mem::take(&mut layers[usize::from(is_visible)][class as usize]);
            if !paths.is_empty() && (is_visible || settings.hidden != Hidden::None) {
                let layer = Layer { class, is_visible, segments: &lines.segments, settings };
                layer.write(layer.prepared(paths, lines.size), &mut out);
            }
        }
    }
    out.push_str("</svg>\n");
    Ok(out)
}

impl VisibleLines {
    /// Refuses lines that no drawing can hold: not finite, or outside the picture.
    pub fn check(&self) -> Result<()> {
        let limits = [self.size.width, self.size.height].map(f64::from);
        // What rounds to the border is on it.
        let is_inside = |value: f64, limit: f64| value > -5e-4 && value < limit + 5e-4;
        for (number, segment) in self.segments.iter().enumerate() {
            let mut points = segment.ends_px.iter();
            let is_drawable = points.all(|point| is_inside(point.x, limits[0]) && is_inside(point.y, limits[1]));
            if !is_drawable || segment.angle_degrees.is_some_and(|angle| !angle.is_finite()) {
                let [a, b] = segment.ends_px;
                return Err(Error::Lines {
                    problem: format!(
                        "line {number} from {a} to {b}: it is not a number or leaves the picture; this is a bug in \
                         tinta: report it with the model"
                    ),
                });
            }
        }
        Ok(())
    }
}

/// Paths by visibility and class, in their order.
fn layers(paths: Vec<LinePath>) -> [[Vec<LinePath>; Class::ALL.len()]; 2] {
    let mut layers: [[Vec<LinePath>; Class::ALL.len()]; 2] = Default::default();
    for path in paths {
        layers[usize::from(path.is_visible)][path.class as usize].push(path);
    }
    layers
}

/// Everything before the layers.
fn begin(size: Size, settings: &SvgSettings, out: &mut String) {
    let [width, height] = settings.page_size.lengths(size);
    let Size { width: width_px, height: height_px } = size;
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
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1" width="{width}" height="{height}" viewBox="0 0 {width_px} {height_px}">
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
        let _ = writeln!(out, r#"<rect id="background" width="{width_px}" height="{height_px}" fill="{fill}"/>"#);
    }
}

/// The paths of a class and visibility.
struct Layer<'a> {
    class: Class,
    is_visible: bool,
    segments: &'a [LineSegment],
    settings: &'a SvgSettings,
}

impl Layer<'_> {
    /// The paths as they are drawn.
    fn prepared(&self, mut paths: Vec<LinePath>, size: Size) -> Vec<LinePath> {
        if !self.settings.is_for_pen {
            return paths;
        }
        if !self.is_visible && self.settings.hidden == Hidden::Dashed {
            let [dash, gap] = PEN_DASHES.map(|share| share * f64::from(size.width.max(size.height)));
            paths = paths.iter().flat_map(|path| dashes(path, dash, gap)).collect();
        }
        in_pen_order(paths)
    }

    fn write(&self, paths: Vec<LinePath>, out: &mut String) {
        let (class, settings) = (self.class, self.settings);
        let name = class.name();
        let visibility = if self.is_visible { "visible" } else { "hidden" };
        let width = if settings.is_for_pen { PEN_WIDTH_PX } else { settings.width_px(class) };
        let _ = write!(
            out,
            r#"<g id="{visibility}-{name}" inkscape:groupmode="layer" inkscape:label="{visibility} {name}" fill="none" stroke="{}" stroke-width="{}" stroke-linecap="round" stroke-linejoin="round""#,
            hexadecimal(settings.class_colors.0[class as usize]),
            number(width)
        );
        if !self.is_visible && !settings.is_for_pen {
            match settings.hidden {
                Hidden::None => (),
                Hidden::Dashed => {
                    let [dash, gap] = DASH_WIDTHS.map(|widths| number(widths * width));
                    let _ = write!(out, r#" stroke-dasharray="{dash} {gap}""#);
                }
                // Of the group, not of each line: where lines cross it would add up.
                Hidden::Ghost => {
                    let _ = write!(out, r#" opacity="{GHOST_OPACITY}""#);
                }
            }
        }
        out.push_str(">\n");
        for path in &paths {
            self.write_path(path, out);
        }
        out.push_str("</g>\n");
    }

    fn write_path(&self, path: &LinePath, out: &mut String) {
        out.push_str("<path");
        if self.settings.has_provenance {
            self.write_provenance(path, out);
            let _ = write!(out, r#" d="{}""#, path_data(&path.points_px, path.is_closed, true));
        } else {
            let _ = write!(out, r#" d="{}""#, path_data(&simplified(path), path.is_closed, false));
        }
        out.push_str("/>\n");
    }

    /// Class, object, and for each piece of the path its mesh edge and angle, or `-`.
    fn write_provenance(&self, path: &LinePath, out: &mut String) {
        let _ = write!(out, r#" data-class="{}" data-object="{}" data-edges=""#, self.class.name(), path.object);
        let pieces = || path.segments.iter().map(|piece| &self.segments[*piece]);
        for (index, piece) in pieces().enumerate() {
            out.push_str(if index > 0 { " " } else { "" });
            out.push_str(&piece.edge.map_or_else(|| "-".to_owned(), |[a, b]| format!("{a}-{b}")));
        }
        out.push_str(r#"" data-angles=""#);
        for (index, piece) in pieces().enumerate() {
            out.push_str(if index > 0 { " " } else { "" });
            out.push_str(&piece.angle_degrees.map_or_else(|| "-".to_owned(), number));
        }
        out.push('"');
    }
}
