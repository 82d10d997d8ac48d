//! Writes lines as PDF: one page in true size, with the layers, paths and coordinates of the SVG.
//!
//! Input: [`VisibleLines`] and [`DrawingSettings`]. Output: bytes that depend on the input only, without time stamps
//! or identifiers. A matrix maps the picture's pixels, y down, to points, so the paths have the same numbers as in
//! the SVG. Layers are optional content (PDF 1.5), which viewers show as layers. Ghosts have the colour that their
//! opacity gives on plain paper.

use crate::error::{Error, Result};
use crate::lines::VisibleLines;
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::curves::{Step, fitted};
use crate::lines::drawing::drawn_layers::{Drawing, DrawnLayer, GHOST_OPACITY, points_of};
use crate::lines::drawing::fills::{Fill, FillGroup, TRAP_PX};
use crate::lines::drawing::settings::{DrawingSettings, mixed};
use crate::lines::drawing::taper::outline;
use crate::lines::drawing::text::{written_point, written_points};
use crate::lines::write::pdf_font::{self, LabelFont};
use crate::scene::{Background, Color};
use glam::DVec2;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Buf, Content, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

/// Returns the lines as a PDF file, without spurs and specks.
///
/// # Errors
///
/// Those of [`crate::lines::svg`], and [`Error::Setting`] for a page larger than PDF allows and for labels with letters
/// that DejaVu Sans lacks.
pub fn pdf(lines: &VisibleLines, settings: &DrawingSettings) -> Result<Vec<u8>> {
    let lines = lines.without_specks(settings)?;
    pdf_of_paths(&lines, chain(&lines.segments), None, settings)
}

/// Returns the given lines as a PDF file, with the paths that [`chain`] made of them, above the given areas.
///
/// # Errors
///
/// Those of [`pdf`].
pub(crate) fn pdf_of_paths(
    lines: &VisibleLines,
    paths: Vec<LinePath>,
    areas: Option<&Areas>,
    settings: &DrawingSettings,
) -> Result<Vec<u8>> {
    let drawing = Drawing::new(lines, paths, areas, settings)?;
    let nothing = Areas::default();
    let areas = areas.unwrap_or(&nothing);
    let scale = drawing.page.points_per_px();
    let page_points = drawing.page.extent_px * scale;
    if page_points.max_element() > LARGEST_PAGE || page_points.min_element() < SMALLEST_PAGE {
        let problem = "a page of a PDF is 3 to 14,400 points (5 metres) long on each side; choose another --page, \
                       --width-mm, --dpi or --size";
        return Err(Error::setting("page", problem));
    }
    let mut font = LabelFont::new()?;
    let mut labels = Vec::new();
    for label in &drawing.labels {
        let (glyphs, ems) = font.encoded(label.text)?;
        let at_px = label.at_px - DVec2::X * (label.left * ems * label.height_px);
        labels.push((glyphs, at_px, label.height_px, label.color));
    }
    written(&drawing, areas, &labels, &font, scale)
}

/// A text's glyphs, the left end of its base line and the height of its letters in pixels, its colour.
type Text = (Vec<u8>, DVec2, f64, Color);

/// The name of the labels' font on the page.
const FONT_NAME: &[u8] = b"F1";

/// Limits for the sides of a page, points (ISO 32000-1, annex C).
const LARGEST_PAGE: f64 = 14_400.0;
const SMALLEST_PAGE: f64 = 3.0;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFORMATION: Ref = Ref::new(5);
const FIRST_LAYER: Ref = Ref::new(6);

/// The numbers of a document's other objects.
struct Refs {
    layers: Vec<Ref>,
    /// Of the labels' font, if there are any.
    font: Option<[Ref; pdf_font::OBJECTS]>,
    /// The graphics state and the form of areas that are seen through together.
    clear: Vec<[Ref; 2]>,
}

impl Refs {
    fn new(layers: usize, areas: &Areas, has_labels: bool) -> Self {
        let mut next = FIRST_LAYER;
        let layers = (0..layers).map(|_| next.bump()).collect();
        let font = has_labels.then(|| std::array::from_fn(|_| next.bump()));
        Self { layers, font, clear: clear(areas).map(|_| [next.bump(), next.bump()]).collect() }
    }
}

/// Areas of one opacity, as they follow one another.
fn as_one(areas: &Areas) -> impl Iterator<Item = &[FillGroup]> {
    areas.fills.chunk_by(|one, next| one.opacity == next.opacity)
}

/// Those that are seen through.
fn clear(areas: &Areas) -> impl Iterator<Item = &[FillGroup]> {
    as_one(areas).filter(|groups| groups[0].opacity < 1.0)
}

fn written(drawing: &Drawing<'_>, areas: &Areas, labels: &[Text], font: &LabelFont, scale: f64) -> Result<Vec<u8>> {
    let (settings, page) = (drawing.settings, &drawing.page);
    let refs = Refs::new(drawing.layers.len(), areas, !labels.is_empty());
    let extent = (page.extent_px * scale).to_array().map(|side| side as f32);
    let mut pdf = Pdf::new();
    write_catalog(&refs, extent, &mut pdf);
    let content = written_content(drawing, areas, labels, extent, scale);
    pdf.stream(CONTENT, &content);
    if let Some(refs) = refs.font {
        font.write(refs, &mut pdf)?;
    }
    for (groups, [state, form]) in clear(areas).zip(&refs.clear) {
        pdf.ext_graphics(*state).non_stroking_alpha(groups[0].opacity);
        let mut content = Content::new();
        groups.iter().for_each(|group| write_fills(group, &mut content));
        let content = content.finish();
        let ends = [page.origin_px, page.origin_px + page.extent_px];
        let [low, high] = ends.map(|corner| corner.to_array().map(|side| side as f32));
        let mut form = pdf.form_xobject(*form, &content);
        form.bbox(Rect::new(low[0], low[1], high[0], high[1])).group().transparency().isolated(true);
    }
    for (layer, drawn) in refs.layers.iter().zip(&drawing.layers) {
        let label = drawn.label();
        pdf.indirect(*layer).dict().pair(Name(b"Type"), Name(b"OCG")).pair(Name(b"Name"), TextStr(&label));
    }
    let mut information = pdf.document_info(INFORMATION);
    information.creator(TextStr("tinta"));
    if !settings.title.is_empty() {
        information.title(TextStr(&settings.title));
    }
    if !settings.command.is_empty() {
        information.subject(TextStr(&settings.command));
    }
    information.finish();
    Ok(pdf.finish())
}

/// Writes the catalog with the layers, and the page with what its content names.
fn write_catalog(Refs { layers, font, clear }: &Refs, [width, height]: [f32; 2], pdf: &mut Pdf) {
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    if !layers.is_empty() {
        let mut content = catalog.insert(Name(b"OCProperties")).dict();
        content.insert(Name(b"OCGs")).array().items(layers.iter().copied());
        // Viewers list the layers in this order, the highest first.
        let mut shown = content.insert(Name(b"D")).dict();
        shown.insert(Name(b"Order")).array().items(layers.iter().rev().copied());
    }
    catalog.finish();
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut sheet = pdf.page(PAGE);
    sheet.parent(PAGES).media_box(Rect::new(0.0, 0.0, width, height)).contents(CONTENT);
    let mut resources = sheet.resources();
    let mut properties = resources.insert(Name(b"Properties")).dict();
    for (number, layer) in layers.iter().enumerate() {
        properties.pair(Name(layer_name(number).as_bytes()), *layer);
    }
    properties.finish();
    if let Some([font, ..]) = font {
        resources.fonts().pair(Name(FONT_NAME), *font);
    }
    if !clear.is_empty() {
        let mut states = resources.ext_g_states();
        for (number, [state, _]) in clear.iter().enumerate() {
            states.pair(Name(clear_name(number).as_bytes()), *state);
        }
        states.finish();
        let mut forms = resources.x_objects();
        for (number, [_, form]) in clear.iter().enumerate() {
            forms.pair(Name(clear_name(number).as_bytes()), *form);
        }
    }
}

/// Returns the content of the page: background, areas, lines, keys, labels.
fn written_content(
    drawing: &Drawing<'_>,
    areas: &Areas,
    labels: &[Text],
    [width, height]: [f32; 2],
    scale: f64,
) -> Buf {
    let (settings, page) = (drawing.settings, &drawing.page);
    let mut content = Content::new();
    if let (Background::Color(Color([red, green, blue])), false) = (settings.background, settings.is_for_pen) {
        content.set_fill_rgb(red, green, blue).rect(0.0, 0.0, width, height).fill_nonzero();
    }
    let origin = page.origin_px;
    let matrix = [scale, 0.0, 0.0, -scale, -origin.x * scale, (origin.y + page.extent_px.y) * scale];
    content.transform(matrix.map(|number| number as f32));
    let mut numbers_of_clear = 0..;
    for groups in as_one(areas) {
        if groups[0].opacity < 1.0 {
            let name = clear_name(numbers_of_clear.next().unwrap_or_default());
            content.save_state().set_parameters(Name(name.as_bytes())).x_object(Name(name.as_bytes())).restore_state();
        } else {
            groups.iter().for_each(|group| write_fills(group, &mut content));
        }
    }
    content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    for (number, layer) in drawing.layers.iter().enumerate() {
        write_layer(drawing, layer, number, &mut content);
    }
    for ([low, high], Color([red, green, blue])) in areas.keys.iter().flat_map(|key| &key.boxes) {
        let [x, y, width, height] = [low.x, low.y, high.x - low.x, high.y - low.y].map(|side| side as f32);
        content.set_fill_rgb(*red, *green, *blue).rect(x, y, width, height).fill_nonzero();
    }
    if !labels.is_empty() {
        content.begin_text();
        for (text, at, height, Color([red, green, blue])) in labels {
            content.set_font(Name(FONT_NAME), *height as f32);
            // Pixels have y down, letters up.
            content.set_fill_rgb(*red, *green, *blue).set_text_matrix([1.0, 0.0, 0.0, -1.0, at.x as f32, at.y as f32]);
            content.show(Str(text));
        }
        content.end_text();
    }
    content.finish()
}

/// The resource name of areas that are seen through, and of their opacity.
fn clear_name(number: usize) -> String {
    format!("C{number}")
}

/// The resource name of a layer on the page.
fn layer_name(number: usize) -> String {
    format!("L{number}")
}

fn write_layer(drawing: &Drawing<'_>, drawn: &DrawnLayer, number: usize, content: &mut Content) {
    content.begin_marked_content_with_properties(Name(b"OC")).properties_named(Name(layer_name(number).as_bytes()));
    let color = match drawn.is_ghost {
        true => mixed(drawn.color, drawing.settings.paper_color(), GHOST_OPACITY),
        false => drawn.color,
    };
    let [red, green, blue] = color.0;
    content.set_stroke_rgb(red, green, blue).set_line_width(drawn.width_px as f32);
    content.set_dash_pattern(drawn.dash_px.iter().map(|length| *length as f32), 0.0);
    for path in &drawn.paths {
        write_path(drawing.settings, path, content);
    }
    if !drawn.tips.is_empty() {
        content.set_fill_rgb(red, green, blue);
        drawn.tips.iter().for_each(|tip| write_polyline(&outline(tip, drawn.width_px), true, content));
        content.fill_nonzero();
    }
    content.end_marked_content();
}

/// Writes the areas of a group.
fn write_fills(group: &FillGroup, content: &mut Content) {
    if !group.clip.is_empty() {
        content.save_state();
        group.clip.iter().for_each(|corners| write_polyline(corners, true, content));
        content.clip_even_odd().end_path();
    }
    group.fills.iter().for_each(|fill| write_fill(fill, content));
    if !group.clip.is_empty() {
        content.restore_state();
    }
}

/// Writes an area and its trap.
fn write_fill(fill: &Fill, content: &mut Content) {
    let [red, green, blue] = fill.color.0;
    content.set_fill_rgb(red, green, blue);
    if !fill.loops.is_empty() {
        fill.loops.iter().for_each(|corners| write_polyline(corners, true, content));
        content.fill_even_odd();
    }
    if !fill.trap.is_empty() {
        content.set_stroke_rgb(red, green, blue).set_line_width(TRAP_PX as f32);
        fill.trap.iter().for_each(|points| write_polyline(points, false, content));
        content.stroke();
    }
}

fn write_polyline(points: &[DVec2], is_closed: bool, content: &mut Content) {
    write_points(&written_points(points, is_closed), content);
    if is_closed {
        content.close_path();
    }
}

fn write_points(points: &[[String; 2]], content: &mut Content) {
    for (index, point) in points.iter().enumerate() {
        let [x, y] = numbers(point);
        match index {
            0 => content.move_to(x, y),
            _ => content.line_to(x, y),
        };
    }
}

/// A point as it is written, exactly the numbers of the SVG.
fn numbers(point: &[String; 2]) -> [f32; 2] {
    [0, 1].map(|axis| point[axis].parse::<f32>().unwrap_or(0.0))
}

fn write_path(settings: &DrawingSettings, path: &LinePath, content: &mut Content) {
    if let Some(error_px) = settings.fit_px {
        let (first, steps) = fitted(path, error_px);
        let at = |point: DVec2| numbers(&written_point(point));
        let [x, y] = at(first);
        content.move_to(x, y);
        for step in steps {
            match step {
                Step::Line(to) => {
                    let [x, y] = at(to);
                    content.line_to(x, y)
                }
                Step::Curve(points) => {
                    let [[x1, y1], [x2, y2], [x3, y3]] = points.map(at);
                    content.cubic_to(x1, y1, x2, y2, x3, y3)
                }
            };
        }
    } else {
        write_points(&written_points(&points_of(path), path.is_closed), content);
    }
    if path.is_closed {
        content.close_and_stroke()
    } else {
        content.stroke()
    };
}
