//! A work-precision plot: error against run time, both logarithmic, a mark for each setting, the Pareto front as a step
//! line with its settings named.
//!
//! Drawn twice, for wide pages and for phones: text scaled down with a picture could not be read there.

use super::frame::{Layout, MARGIN, Scale, Shape, grid, short};
use super::labels::{Rectangle, place};
use super::marks;
use super::settings::{Machine, Measure, Point, Points, model_names, pareto, points};
use super::svg_canvas::{Anchor, Axes, MIDDLE, SvgCanvas, text_width, wrapped};
use crate::measure::{LineError, Row};
use plotters::style::RGBColor;
use std::collections::{BTreeMap, BTreeSet};
use tinta::error::Result;
use tinta::styles::StyleName;

/// Quartiles, and curves over picture sizes.
const BAR: RGBColor = RGBColor(205, 205, 205);
const CURVE: RGBColor = RGBColor(130, 130, 130);
/// The exact lines' own curve.
const CEILING: RGBColor = RGBColor(200, 60, 40);

/// Names with more characters get a number instead.
const LONGEST_LABEL: usize = 46;

/// The plot's subject: the models and the machine.
pub(super) fn subtitle(machine: &Machine<'_>, measure: Measure) -> String {
    let Points { points, models, left_out, .. } = points(&machine.rows, measure);
    let names = model_names(models.iter().map(String::as_str));
    let models: Vec<String> = models.iter().map(|model| names[model.as_str()].clone()).collect();
    let what = match &models[..] {
        [model] => model.clone(),
        _ => format!("Mean over {} models: {}", models.len(), models.join(", ")),
    };
    let missing = match left_out {
        0 => String::new(),
        1 => "; 1 setting not measured on all of them is left out".to_owned(),
        count => format!("; {count} settings not measured on all of them are left out"),
    };
    let lines = machine.rows.iter().filter_map(|row| row.lines.as_ref().map(|lines| (row, lines)));
    let share = |(row, lines): (&&Row, &LineError)| (f64::from(row.size[1]) / lines.tolerance_px).round() as u64;
    let shares: BTreeSet<u64> = lines.map(share).collect();
    let terms = match measure {
        Measure::Lines if points.iter().any(|point| point.has_own_reference) => {
            "; † draws the lines that it is judged by"
        }
        _ => "",
    };
    let tolerance: String = match measure {
        Measure::Lines => shares.iter().map(|share| format!("; ink counts within 1/{share} of the height")).collect(),
        _ => String::new(),
    };
    format!("{what}{missing}{tolerance}{terms}; on {}", machine.name)
}

/// Draws the points; `None` without any.
///
/// # Errors
///
/// [`tinta::Error::File`] should the drawing fail.
pub fn plot(points: &Points, measure: Measure, shape: Shape, subtitle: &str) -> Result<Option<String>> {
    let Points { points, clock, .. } = points;
    if points.is_empty() {
        return Ok(None);
    }
    let layout = shape.layout();
    let line_height = layout.line_height();
    let subtitle_lines = wrapped(subtitle, layout.text, layout.room());
    let top = MARGIN + layout.title * 1.4 + line_height * (subtitle_lines.len() as f64 + 1.5);
    let inner = Rectangle { left: layout.left, top, right: layout.width - MARGIN, bottom: top + layout.height };
    let marked = PlotMarks::of(points, &inner);
    let labels = labels(&marked, &inner, &layout, shape);

    let legend = legend(points, &layout);
    let numbered = labels.iter().filter(|label| label.number.is_some());
    let key: Vec<Vec<String>> = numbered.map(|label| layout.entry(&described(&points[label.index]))).collect();
    let legend_top = inner.bottom + line_height * 3.2;
    let key_top = legend_top + line_height * (legend.last().map_or(0, |item| item.line) as f64 + 1.4);
    let bottom = if key.is_empty() { key_top } else { layout.below_key(key_top, &key) };

    let mut svg = String::new();
    let canvas = SvgCanvas::new(&mut svg, layout.width as u32, bottom.ceil() as u32)?;
    let axes = [format!("↑ {}", measure.axis()), format!("time of a frame by {}, ms (median) →", clock.name())];
    layout.name(&canvas, &inner, measure.title(), &subtitle_lines, &axes)?;
    grid(&canvas, &marked.axes, &marked.scale, &inner, &layout)?;
    marked.draw(&canvas)?;
    for label in &labels {
        label.draw(&canvas, &marked, &layout)?;
    }
    for item in &legend {
        item.draw(&canvas, legend_top, &layout)?;
    }
    layout.draw_key(&canvas, key_top, &key)?;
    canvas.finish()?;
    let what =
        format!("<svg role=\"img\" aria-label=\"{}. {}\" ", measure.title(), tinta_geometry::markup::escaped(subtitle));
    Ok(Some(svg.replacen("<svg ", &what, 1)))
}

/// The marks of a plot and the lines between them, in pixels.
struct PlotMarks<'a> {
    points: &'a [Point],
    scale: Scale,
    axes: Axes,
    middles: Vec<(f64, f64)>,
    /// The settings on the front of their size.
    front: Vec<usize>,
    /// The border of each size.
    steps: Vec<Vec<(f64, f64)>>,
}

impl<'a> PlotMarks<'a> {
    fn of(points: &'a [Point], inner: &Rectangle) -> Self {
        let scale = Scale::of(points);
        let axes = scale.axes(inner);
        let middle = |point: &Point| axes.pixel(point.time_ms, scale.drawn_error(point.error));
        let middles: Vec<(f64, f64)> = points.iter().map(middle).collect();
        let fronts = fronts(points);
        let of_front =
            |front: &Vec<usize>| steps(&front.iter().map(|index| middles[*index]).collect::<Vec<_>>(), inner);
        let steps = fronts.iter().map(of_front).collect();
        Self { points, scale, axes, middles, front: fronts.concat(), steps }
    }

    /// Draws quartiles, curves, the front and the marks.
    fn draw(&self, canvas: &SvgCanvas<'_>) -> Result<()> {
        let Self { points, scale, axes, middles, front, steps } = self;
        for (point, (x, y)) in points.iter().zip(middles) {
            let [fast, slow] =
                point.times_ms.map(|ms| axes.pixel(ms.clamp(scale.time_ms.start, scale.time_ms.end), point.error).0);
            let [least, most] = point.errors.map(|error| {
                let drawn = scale.drawn_error(error).clamp(scale.error.start, scale.error.end);
                axes.pixel(point.time_ms, drawn).1
            });
            canvas.line(&[(fast, *y), (slow, *y)], BAR, 1)?;
            canvas.line(&[(*x, least), (*x, most)], BAR, 1)?;
        }
        for curve in curves(points) {
            let color = if is_ceiling(&points[curve[0]]) { CEILING } else { CURVE };
            canvas.line(&curve.iter().map(|index| middles[*index]).collect::<Vec<_>>(), color, 1)?;
        }
        steps.iter().try_for_each(|steps| canvas.line(steps, MIDDLE, 2))?;
        // Hollow marks first, to put the published settings above them.
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|index| (front.contains(index), points[*index].is_faithful));
        for index in order {
            marks::draw(canvas, &points[index].style, middles[index], points[index].is_faithful)?;
        }
        Ok(())
    }
}

/// Whether it draws the exact lines themselves: no lines by their pen score more.
fn is_ceiling(point: &Point) -> bool {
    point.style == StyleName::Lines.name() && point.has_own_reference
}

fn described(point: &Point) -> String {
    format!("{} ({} ms, {})", point.name, short(point.time_ms), short(point.error))
}

/// The points that differ only in the picture's size, and those that differ only in the numbers of their options: each a line of
/// the plot.
fn curves(points: &[Point]) -> Vec<Vec<usize>> {
    let mut curves: BTreeMap<(usize, &str), Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        for (axis, curve) in point.curves.iter().enumerate() {
            curves.entry((axis, curve)).or_default().push(index);
        }
    }
    let mut curves: Vec<Vec<usize>> = curves.into_values().filter(|curve| curve.len() > 1).collect();
    curves.iter_mut().for_each(|curve| curve.sort_by_key(|index| points[*index].size));
    curves
}

/// The points on the front of each size of pictures, from the fastest to the most exact; the first of equal ones.
pub(super) fn fronts(points: &[Point]) -> Vec<Vec<usize>> {
    let sizes: BTreeSet<[u32; 2]> = points.iter().map(|point| point.size).collect();
    let place = |index: usize| (points[index].time_ms, points[index].error);
    let of_size = |size: [u32; 2]| {
        let of_size: Vec<usize> = (0..points.len()).filter(|index| points[*index].size == size).collect();
        let is_on = pareto(&of_size.iter().map(|index| place(*index)).collect::<Vec<_>>());
        let mut front: Vec<usize> =
            of_size.into_iter().zip(is_on).filter_map(|(index, is_on)| is_on.then_some(index)).collect();
        front.sort_by(|a, b| place(*a).0.total_cmp(&place(*b).0).then(place(*b).1.total_cmp(&place(*a).1)));
        front.dedup_by(|later, earlier| place(*later) == place(*earlier));
        front
    };
    sizes.into_iter().map(of_size).collect()
}

/// The border between the reached and the unreached times and errors.
fn steps(front: &[(f64, f64)], inner: &Rectangle) -> Vec<(f64, f64)> {
    let mut line = Vec::new();
    let mut height = inner.top;
    for (x, y) in front {
        line.extend([(*x, height), (*x, *y)]);
        height = *y;
    }
    line.push((inner.right, height));
    line
}

/// A label on the front: the setting's name, or its number in the key below.
struct Label {
    index: usize,
    number: Option<usize>,
    place: Rectangle,
}

impl Label {
    fn draw(&self, canvas: &SvgCanvas<'_>, marked: &PlotMarks<'_>, layout: &Layout) -> Result<()> {
        let middle = marked.middles[self.index];
        let near = self.place.nearest(middle);
        if (near.0 - middle.0).hypot(near.1 - middle.1) > marks::RADIUS + 6.0 {
            canvas.line(&[middle, near], MIDDLE, 1)?;
        }
        let name = self.number.map_or_else(|| marked.points[self.index].name.clone(), |number| number.to_string());
        let y = (self.place.top + self.place.bottom) / 2.0;
        canvas.text((self.place.left + 2.0, y), Anchor::Start, &name, layout.text, self.number.is_some())
    }
}

fn labels(marked: &PlotMarks<'_>, inner: &Rectangle, layout: &Layout, shape: Shape) -> Vec<Label> {
    let PlotMarks { points, front, middles, steps, .. } = marked;
    let lines: Vec<Rectangle> = steps
        .iter()
        .flat_map(|steps| steps.windows(2))
        .map(|pair| Rectangle {
            left: pair[0].0.min(pair[1].0) - 1.0,
            top: pair[0].1.min(pair[1].1) - 1.0,
            right: pair[0].0.max(pair[1].0) + 1.0,
            bottom: pair[0].1.max(pair[1].1) + 1.0,
        })
        .collect();
    let marks: Vec<Rectangle> = middles.iter().map(|middle| Rectangle::around(*middle, marks::RADIUS + 1.0)).collect();
    let mut taken = marks.clone();
    let mut labels = Vec::new();
    let mut number = 0;
    for index in front.iter().copied() {
        let size = |text: &str| (text_width(text, layout.text) + 4.0, layout.text * 1.25);
        let name = &points[index].name;
        let has_room = shape == Shape::Wide && name.chars().count() <= LONGEST_LABEL;
        let named = has_room.then(|| place(middles[index], size(name), inner, &taken, &lines)).flatten();
        let label = named.map(|place| Label { index, number: None, place }).unwrap_or_else(|| {
            number += 1;
            let size = size(&number.to_string());
            // Where everything is full a number may lie on other marks, but never on other labels.
            let place = place(middles[index], size, inner, &taken, &lines)
                .or_else(|| place(middles[index], size, inner, &taken[marks.len()..], &[]))
                .unwrap_or(Rectangle::around(middles[index], 8.0));
            Label { index, number: Some(number), place }
        });
        taken.push(label.place);
        labels.push(label);
    }
    labels
}

enum Mark {
    Style(String, bool),
    Line(RGBColor),
    Front,
}

/// An entry of the legend.
struct Item {
    mark: Mark,
    text: String,
    left: f64,
    line: usize,
}

impl Item {
    fn draw(&self, canvas: &SvgCanvas<'_>, top: f64, layout: &Layout) -> Result<()> {
        let (x, y) = (self.left, top + layout.line_height() * self.line as f64);
        match &self.mark {
            Mark::Style(style, is_filled) => marks::draw(canvas, style, (x + 7.0, y), *is_filled)?,
            Mark::Line(color) => canvas.line(&[(x, y), (x + 14.0, y)], *color, 1)?,
            Mark::Front => canvas.line(&[(x, y), (x + 14.0, y)], MIDDLE, 2)?,
        }
        canvas.text((x + 20.0, y), Anchor::Start, &self.text, layout.text, false)
    }
}

fn legend(points: &[Point], layout: &Layout) -> Vec<Item> {
    let mut styles: Vec<&str> = points.iter().map(|point| point.style.as_str()).collect();
    styles.sort_by_key(|style| (marks::rank(style), *style));
    styles.dedup();
    let mut items: Vec<(Mark, String)> =
        styles.iter().map(|style| (Mark::Style((*style).to_owned(), true), (*style).to_owned())).collect();
    if points.iter().any(|point| !point.is_faithful) {
        items.push((Mark::Style(styles[0].to_owned(), false), "hollow: not the published settings".to_owned()));
    }
    items.push((Mark::Line(BAR), "quartiles: of a frame's time, and of the models' errors".to_owned()));
    let curves = curves(points);
    if !curves.is_empty() {
        items.push((Mark::Line(CURVE), "a setting at several sizes or values".to_owned()));
    }
    if curves.iter().any(|curve| is_ceiling(&points[curve[0]])) {
        items.push((Mark::Line(CEILING), "ceiling: the exact lines themselves, by the same pen".to_owned()));
    }
    items.push((Mark::Front, "Pareto front of a size: no setting is both faster and closer".to_owned()));
    let mut left = MARGIN;
    let mut line = 0;
    let mut placed = Vec::new();
    for (mark, text) in items {
        let width = 20.0 + text_width(&text, layout.text) + 14.0;
        if left > MARGIN && left + width > layout.width {
            left = MARGIN;
            line += 1;
        }
        placed.push(Item { mark, text, left, line });
        left += width;
    }
    placed
}
