//! A drawing for its writers: its page, and its layers from lowest to highest with their styles and paths.
//!
//! Input: lines, their chained paths, areas below them, settings. Output: a [`Drawing`], which the SVG and PDF writers share.

use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::coincident::keep_once;
use crate::lines::drawing::drawn_labels::{DrawnLabel, drawn_labels, height_px};
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::page::Page;
use crate::lines::drawing::pen::{dashes, in_pen_order};
use crate::lines::drawing::settings::{DrawingSettings, HiddenLines};
use crate::lines::drawing::simplify::simplified;
use crate::lines::drawing::taper::{Lines, taper};
use crate::lines::parts::style::PartRole;
use crate::lines::{LineSegment, VisibleLines};
use crate::scene::{Color, Size};
use glam::DVec2;
use std::collections::BTreeMap;

/// Opacity of hidden lines drawn as ghosts.
pub const GHOST_OPACITY: f32 = 0.3;

/// Default line width for a pen, pixels: only for display, because the pen has its own.
const PEN_WIDTH_PX: f64 = 0.5;

/// Lengths of dashes and gaps in turn, in line widths; round ends take one width from each gap.
const DASHED: &[f64] = &[6.0, 5.0];

/// The same on paper, and of chain lines with one dot and with two: lines 02, 04 and 05 of ISO 128-2.
const DASHED_ON_PAPER: &[f64] = &[11.0, 4.0];
const CHAIN: &[f64] = &[23.0, 4.0, 0.5, 4.0];
const DOUBLE_CHAIN: &[f64] = &[23.0, 4.0, 0.5, 4.0, 0.5, 4.0];

/// A width that stands for a pen's in the lengths of its dashes, as a share of the picture's longer side: their number is limited, however
/// large the picture.
const PEN_WIDTH: f64 = 1.0 / 800.0;

pub(in crate::lines) struct Drawing<'a> {
    pub lines: &'a VisibleLines,
    pub settings: &'a DrawingSettings,
    pub page: Page,
    /// Non-empty layers, from the lowest to the highest.
    pub layers: Vec<DrawnLayer>,
    /// Texts above all layers.
    pub labels: Vec<DrawnLabel<'a>>,
}

/// The paths of a layer and their style.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLayer {
    /// The layer.
    pub layer: Layer,
    /// The number of the style of its parts in [`VisibleLines::looks`], and its name there.
    pub look: u32,
    /// The patterns that name its parts; empty for parts without a rule.
    pub part: String,
    /// The colour of its lines.
    pub color: Color,
    /// The width of its lines, pixels.
    pub width_px: f64,
    /// Lengths of dashes and gaps in turn, pixels; empty for whole lines.
    pub dash_px: Vec<f64>,
    /// Whether the whole layer has [`GHOST_OPACITY`], so that crossings do not add up.
    pub is_ghost: bool,
    /// Its paths, without their tips.
    pub paths: Vec<LinePath>,
    /// The middle lines of tapered ends, pixels, from the line's full width to the point.
    pub(in crate::lines) tips: Vec<Vec<DVec2>>,
}

/// Returns the drawing that an SVG file of these lines holds, as plain values: layers from lowest to highest, without
/// spurs and specks. Lines are whole, not tapered.
///
/// # Errors
///
/// Those of [`crate::lines::svg()`].
pub fn drawn_layers(lines: &VisibleLines, settings: &DrawingSettings) -> Result<Vec<DrawnLayer>> {
    let lines = lines.without_specks(settings)?;
    let settings = &DrawingSettings { tapers: false, ..settings.clone() };
    let mut layers = Drawing::new(&lines, chain(&lines.segments), None, settings)?.layers;
    for path in layers.iter_mut().flat_map(|layer| &mut layer.paths) {
        path.points_px = points_of(path);
    }
    Ok(layers)
}

impl<'a> Drawing<'a> {
    /// Sorts the paths and the strokes of areas into layers; `areas` is `None` for lines alone.
    ///
    /// # Errors
    ///
    /// Those of [`DrawingSettings::check`] and [`VisibleLines::check`]; [`Error::Setting`] for hatching of lines alone.
    pub(in crate::lines) fn new(
        lines: &'a VisibleLines,
        paths: Vec<LinePath>,
        areas: Option<&'a Areas>,
        settings: &'a DrawingSettings,
    ) -> Result<Self> {
        settings.check()?;
        lines.check()?;
        if settings.hatching.spacing.is_some() && areas.is_none() {
            return Err(Error::setting("hatch", "lines alone have no tones; leave it out, or choose --look print"));
        }
        let page = page(lines, areas, settings);
        let looks = lines.drawings(settings);
        looks.iter().try_for_each(|settings| settings.check())?;
        let mut paths_of: BTreeMap<(Layer, u32), Vec<LinePath>> = BTreeMap::new();
        for hatch in areas.into_iter().flat_map(|areas| &areas.hatches) {
            let strokes = hatch.strokes.iter().map(|points| LinePath::of_stroke(points.clone()));
            paths_of.entry((Layer::Hatch(hatch.tone), 0)).or_default().extend(strokes);
        }
        paths.into_iter().for_each(|path| paths_of.entry((path.layer(), path.look)).or_default().push(path));
        let mut drawn = Vec::with_capacity(paths_of.len());
        for layer in Layer::upwards() {
            for (look, _) in (0..).zip(&looks).filter(|(_, settings)| settings.draws(layer.is_visible())) {
                drawn.extend(paths_of.remove(&(layer, look)).map(|paths| (layer, look, paths)));
            }
        }
        keep_once(drawn.iter_mut().filter(|(layer, ..)| !matches!(layer, Layer::Hatch(_))).map(|(.., paths)| paths));
        drawn.retain(|(.., paths)| !paths.is_empty());
        let styled = |(layer, look, paths): (Layer, u32, Vec<LinePath>)| {
            let part = lines.looks.get(look as usize);
            let is_ghost = part.is_some_and(|part| part.role == Some(PartRole::Ghost));
            let part = part.map_or(String::new(), |part| part.name.clone());
            let drawn = DrawnLayer::new(layer, paths, &page, &looks[look as usize], (is_ghost, lines.size));
            DrawnLayer { look, part, ..drawn }
        };
        let mut layers: Vec<DrawnLayer> = drawn.into_iter().map(styled).collect();
        if settings.tapers && !settings.is_for_pen {
            taper_visible(&mut layers, lines.size);
        }
        let mut labels = drawn_labels(&lines.labels, settings, page.units);
        let texts = areas.into_iter().flat_map(|areas| &areas.keys).flat_map(|key| &key.texts);
        labels.extend(texts.map(|text| text.drawn(height_px(page.units))));
        Ok(Self { lines, settings, page, layers, labels })
    }
}

/// Tapers the free ends of visible lines; hidden ones and the strokes of tones stay.
fn taper_visible(layers: &mut [DrawnLayer], size: Size) {
    let tapers = |layer: &&mut DrawnLayer| layer.layer.is_visible() && !matches!(layer.layer, Layer::Hatch(_));
    let lines = |layer| {
        let DrawnLayer { width_px, paths, .. }: &mut DrawnLayer = layer;
        Lines { width_px: *width_px, paths }
    };
    let mut visible: Vec<Lines<'_>> = layers.iter_mut().filter(tapers).map(lines).collect();
    let tips = taper(&mut visible, size);
    layers.iter_mut().filter(tapers).zip(tips).for_each(|(layer, tips)| layer.tips = tips);
}

/// The drawing's page; if it is a sheet of paper, lines and areas fill it.
pub(in crate::lines) fn page(lines: &VisibleLines, areas: Option<&Areas>, settings: &DrawingSettings) -> Page {
    let looks = lines.drawings(settings);
    let is_drawn =
        |segment: &LineSegment| looks[segment.look as usize].draws(segment.is_visible) && !segment.is_covered;
    let drawn = lines.segments.iter().filter(|segment| is_drawn(segment));
    let corners = areas.and_then(|areas| areas.corners_px);
    Page::new(lines.size, drawn, corners, settings.page_size, settings.margin.0, lines.px_per_mm)
}

impl DrawnLayer {
    /// Its name in files, unique in a drawing: visibility, class, and the number of its style.
    pub(crate) fn id(&self) -> String {
        let of_part = if self.look == 0 { String::new() } else { format!("-{}", self.look) };
        self.layer.words().join("-") + &of_part
    }

    /// Its label in programs that show layers: visibility, class, and the patterns of its parts.
    pub(crate) fn label(&self) -> String {
        let between = if self.part.is_empty() { "" } else { " " };
        format!("{}{between}{}", self.layer.words().join(" "), self.part)
    }

    fn new(
        layer: Layer,
        mut paths: Vec<LinePath>,
        page: &Page,
        settings: &DrawingSettings,
        (is_of_ghost, size): (bool, Size),
    ) -> Self {
        let is_pens_own = settings.is_for_pen && !settings.says_width(layer);
        let width_px = if is_pens_own { PEN_WIDTH_PX } else { settings.width_px(layer, page.units) };
        let is_on_paper = settings.is_on_paper();
        let pattern = match layer {
            Layer::Visible(Class::Centre) | Layer::Hidden(Class::Centre) => CHAIN,
            Layer::Visible(Class::Point) | Layer::Hidden(Class::Point) => &[],
            Layer::Hidden(_) if settings.hidden == HiddenLines::Dashed && is_on_paper => DASHED_ON_PAPER,
            Layer::Hidden(_) if settings.hidden == HiddenLines::Dashed => DASHED,
            Layer::Visible(_) | Layer::Outline if is_of_ghost && is_on_paper => DOUBLE_CHAIN,
            _ => &[],
        };
        if settings.is_for_pen {
            if !pattern.is_empty() {
                let width = PEN_WIDTH * f64::from(size.width.max(size.height));
                let lengths: Vec<f64> = pattern.iter().map(|widths| widths * width).collect();
                paths = paths.iter().flat_map(|path| dashes(path, &lengths)).collect();
            }
            paths = in_pen_order(paths);
        }
        Self {
            layer,
            look: 0,
            part: String::new(),
            color: settings.color(layer),
            width_px,
            dash_px: pattern.iter().filter(|_| !settings.is_for_pen).map(|widths| widths * width_px).collect(),
            is_ghost: !layer.is_visible() && settings.hidden == HiddenLines::Ghost && !settings.is_for_pen,
            paths,
            tips: Vec::new(),
        }
    }
}

/// The points of a path that are written.
pub(in crate::lines) fn points_of(path: &LinePath) -> Vec<DVec2> {
    simplified(&path.points_px, path.is_closed)
}
