//! A work-precision plot: error against run time, both logarithmic, a mark for each setting, the Pareto front as a step
//! line with its settings named.
//!
//! Drawn twice, for wide pages and for phones: text scaled down with a picture could not be read there.

use super::canvas::{Anchor, Axes, Canvas, FAINT, MIDDLE, text_width, wrapped};
use super::labels::{Rectangle, place};
use super::marks;
use super::settings::{Machine, Measure, Point, Points, Time, model_names, pareto, points};
use plotters::style::RGBColor;
use std::collections::BTreeMap;
use std::ops::Range;
use tinta::error::Result;

/// The destination of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A file, or a page on a screen: names stand beside their points.
    Wide,
    /// A phone: numbers stand beside the points, their names below.
    Narrow,
}

/// Sizes in pixels.
pub(super) struct Layout {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) left: f64,
    pub(super) text: f64,
    pub(super) title: f64,
}

pub(super) const MARGIN: f64 = 12.0;

/// Quartiles, and curves over picture sizes.
const BAR: RGBColor = RGBColor(205, 205, 205);
const CURVE: RGBColor = RGBColor(130, 130, 130);

/// Names with more characters get a number instead.
const LONGEST_LABEL: usize = 46;

impl Shape {
    pub(super) fn layout(self) -> Layout {
        match self {
            Self::Wide => Layout { width: 880.0, height: 420.0, left: 80.0, text: 14.0, title: 18.0 },
            Self::Narrow => Layout { width: 360.0, height: 300.0, left: 64.0, text: 12.0, title: 15.0 },
        }
    }
}

/// The plot's subject: the models and the machine.
pub(super) fn subtitle(machine: &Machine<'_>, measure: Measure) -> String {
    let Points { models, left_out, .. } = points(&machine.rows, measure, Time::Frame);
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
    format!("{what}{missing}; on {}", machine.name)
}

/// Draws the points; `None` without any.
///
/// # Errors
///
/// [`tinta::Error::File`] should the drawing fail.
pub fn plot(points: &Points, measure: Measure, shape: Shape, subtitle: &str) -> Result<Option<String>> {
    let (time, points) = (points.time, &points.points);
    if points.is_empty() {
        return Ok(None);
    }
    let layout = shape.layout();
    let room = layout.width - 2.0 * MARGIN;
    let subtitle_lines = wrapped(subtitle, layout.text, room);
    let line_height = layout.text * 1.4;
    let top = MARGIN + layout.title * 1.4 + line_height * (subtitle_lines.len() as f64 + 1.5);
    let inner = Rectangle { left: layout.left, top, right: layout.width - MARGIN, bottom: top + layout.height };

    let scale = Scale::of(points);
    let pixels = |range: Range<f64>| range.start as i32..range.end as i32;
    let axes = Axes::new(
        scale.time_ms.clone(),
        scale.error.clone(),
        pixels(inner.left..inner.right),
        pixels(inner.bottom..inner.top),
    );
    let middles: Vec<(f64, f64)> =
        points.iter().map(|point| axes.pixel(point.time_ms, scale.drawn_error(point.error))).collect();
    let front = front(points);
    let steps = steps(&front.iter().map(|index| middles[*index]).collect::<Vec<_>>(), &inner);
    let labels = labels(points, &front, &middles, &steps, &inner, &layout, shape);

    let legend = legend(points, &layout);
    let key: Vec<(usize, Vec<String>)> = labels
        .iter()
        .filter_map(|label| label.number.map(|number| (number, &points[label.index])))
        .map(|(number, point)| (number, wrapped(&described(point), layout.text, room - 26.0)))
        .collect();
    let legend_top = inner.bottom + line_height * 3.2;
    let key_top = legend_top + line_height * (legend.last().map_or(0, |item| item.line) as f64 + 1.4);
    let key_lines = key.iter().map(|(_, lines)| lines.len()).sum::<usize>();
    let bottom = key_top + line_height * if key_lines > 0 { key_lines as f64 + 0.3 } else { 0.0 };

    let mut svg = String::new();
    let canvas = Canvas::new(&mut svg, layout.width as u32, bottom.ceil() as u32)?;
    let text = |at: (f64, f64), anchor: Anchor, text: &str| canvas.text(at, anchor, text, layout.text, false);
    canvas.text((MARGIN, MARGIN + layout.title * 0.7), Anchor::Start, measure.title(), layout.title, true)?;
    for (line, words) in subtitle_lines.iter().enumerate() {
        let y = MARGIN + layout.title * 1.4 + line_height * (line as f64 + 0.6);
        text((MARGIN, y), Anchor::Start, words)?;
    }
    text((MARGIN, inner.top - line_height * 0.7), Anchor::Start, &format!("↑ {}", measure.axis()))?;
    text((inner.right, inner.bottom + line_height * 2.0), Anchor::End, &format!("{} →", time.axis()))?;
    grid(&canvas, &axes, &scale, &inner, &layout)?;
    for (point, (x, y)) in points.iter().zip(&middles) {
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
        canvas.line(&curve.iter().map(|index| middles[*index]).collect::<Vec<_>>(), CURVE, 1)?;
    }
    canvas.line(&steps, MIDDLE, 2)?;
    // Hollow marks first, to put the published settings above them.
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|index| (front.contains(index), points[*index].is_faithful));
    for index in order {
        marks::draw(&canvas, &points[index].style, middles[index], points[index].is_faithful)?;
    }
    for label in &labels {
        let middle = middles[label.index];
        let near = label.place.nearest(middle);
        if (near.0 - middle.0).hypot(near.1 - middle.1) > marks::RADIUS + 6.0 {
            canvas.line(&[middle, near], MIDDLE, 1)?;
        }
        let name = label.number.map_or_else(|| points[label.index].name.clone(), |number| number.to_string());
        let y = (label.place.top + label.place.bottom) / 2.0;
        canvas.text((label.place.left + 2.0, y), Anchor::Start, &name, layout.text, label.number.is_some())?;
    }
    for item in &legend {
        let at = (item.left, legend_top + line_height * item.line as f64);
        match &item.mark {
            Mark::Style(style, is_filled) => marks::draw(&canvas, style, (at.0 + 7.0, at.1), *is_filled)?,
            Mark::Line(color) => canvas.line(&[at, (at.0 + 14.0, at.1)], *color, 1)?,
            Mark::Front => canvas.line(&[at, (at.0 + 14.0, at.1)], MIDDLE, 2)?,
        }
        text((at.0 + 20.0, at.1), Anchor::Start, &item.text)?;
    }
    let mut y = key_top;
    for (number, lines) in &key {
        canvas.text((MARGIN + 18.0, y), Anchor::End, &number.to_string(), layout.text, true)?;
        for line in lines {
            text((MARGIN + 26.0, y), Anchor::Start, line)?;
            y += line_height;
        }
    }
    canvas.finish()?;
    let what =
        format!("<svg role=\"img\" aria-label=\"{}. {}\" ", measure.title(), tinta_geometry::markup::escaped(subtitle));
    Ok(Some(svg.replacen("<svg ", &what, 1)))
}

fn described(point: &Point) -> String {
    format!("{} ({} ms, {})", point.name, short(point.time_ms), short(point.error))
}

/// Three digits.
pub(super) fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let digits = 2 - number.abs().log10().floor() as i32;
    format!("{number:.*}", digits.clamp(0, 9) as usize)
}

/// The range of the axes.
pub(super) struct Scale {
    pub(super) time_ms: Range<f64>,
    pub(super) error: Range<f64>,
    /// The place of zero error, which a logarithmic axis lacks.
    pub(super) zero: Option<f64>,
}

impl Scale {
    fn of(points: &[Point]) -> Self {
        let time_ms = spread(points.iter().map(|point| point.time_ms));
        let mut error = spread(points.iter().map(|point| point.error).filter(|error| *error > 0.0));
        let mut zero = None;
        if points.iter().any(|point| point.error <= 0.0) {
            let decades = (error.end / error.start).log10();
            let below = 10_f64.powf(decades * 0.1);
            zero = Some(error.start / below);
            error.start /= below * below.sqrt();
        }
        Self { time_ms, error, zero }
    }

    fn drawn_error(&self, error: f64) -> f64 {
        self.zero.filter(|_| error <= 0.0).unwrap_or(error)
    }
}

/// From the least to the largest with some room, at least two thirds of a decade.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (least, largest) = values
        .map(f64::log10)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, largest), value| (least.min(value), largest.max(value)));
    if least > largest {
        return 0.001..1.0;
    }
    let room = ((largest - least) * 0.06).max(0.33 - (largest - least) / 2.0);
    10_f64.powf(least - room)..10_f64.powf(largest + room)
}

/// Round numbers in the range and their names; those between the named ones get a line only.
fn ticks(range: &Range<f64>) -> Vec<(f64, Option<String>)> {
    let decades = (range.end / range.start).log10();
    let mut ticks = Vec::new();
    for exponent in range.start.log10().floor() as i32..=range.end.log10().ceil() as i32 {
        for digit in 1..10 {
            let value = f64::from(digit) * 10_f64.powi(exponent);
            if !(range.start..=range.end).contains(&value) {
                continue;
            }
            let is_named = digit == 1 || decades < 0.9 || (decades < 2.5 && (digit == 2 || digit == 5));
            let decimals = (-exponent).max(0) as usize;
            ticks.push((value, is_named.then(|| format!("{value:.decimals$}"))));
        }
    }
    ticks
}

pub(super) fn grid(canvas: &Canvas<'_>, axes: &Axes, scale: &Scale, inner: &Rectangle, layout: &Layout) -> Result<()> {
    let text = |at: (f64, f64), anchor: Anchor, text: &str| canvas.text(at, anchor, text, layout.text, false);
    let (time, error) = (scale.time_ms.start, scale.error.start);
    let mut free_from = f64::NEG_INFINITY;
    for (value, name) in ticks(&scale.time_ms) {
        let (x, _) = axes.pixel(value, error);
        canvas.line(&[(x, inner.top), (x, inner.bottom)], FAINT, 1)?;
        let half = name.as_ref().map_or(0.0, |name| text_width(name, layout.text) / 2.0);
        if let Some(name) = name.filter(|_| x - half > free_from && x + half < layout.width) {
            canvas.line(&[(x, inner.bottom), (x, inner.bottom + 4.0)], MIDDLE, 1)?;
            text((x, inner.bottom + layout.text), Anchor::Middle, &name)?;
            free_from = x + half + 6.0;
        }
    }
    let first_error = scale.zero.map_or(error, |zero| zero * (zero / error));
    let errors = ticks(&(first_error..scale.error.end)).into_iter();
    let zero = scale.zero.map(|zero| (zero, Some("0".to_owned())));
    let mut free_below = f64::INFINITY;
    for (value, name) in zero.into_iter().chain(errors) {
        let (_, y) = axes.pixel(time, value);
        canvas.line(&[(inner.left, y), (inner.right, y)], FAINT, 1)?;
        if let Some(name) = name.filter(|_| y + layout.text / 2.0 < free_below) {
            canvas.line(&[(inner.left - 4.0, y), (inner.left, y)], MIDDLE, 1)?;
            text((inner.left - 8.0, y), Anchor::End, &name)?;
            free_below = y - layout.text / 2.0 - 2.0;
        }
    }
    canvas.line(&[(inner.left, inner.top), (inner.left, inner.bottom), (inner.right, inner.bottom)], MIDDLE, 1)
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

/// The front's points from the fastest to the most exact; the first of equal ones.
fn front(points: &[Point]) -> Vec<usize> {
    let all: Vec<(f64, f64)> = points.iter().map(|point| (point.time_ms, point.error)).collect();
    let mut front: Vec<usize> = (0..all.len()).zip(pareto(&all)).filter(|(_, is_on)| *is_on).map(|(i, _)| i).collect();
    front.sort_by(|a, b| all[*a].0.total_cmp(&all[*b].0).then(all[*b].1.total_cmp(&all[*a].1)));
    front.dedup_by(|later, earlier| all[*later] == all[*earlier]);
    front
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

fn labels(
    points: &[Point],
    front: &[usize],
    middles: &[(f64, f64)],
    steps: &[(f64, f64)],
    inner: &Rectangle,
    layout: &Layout,
    shape: Shape,
) -> Vec<Label> {
    let lines: Vec<Rectangle> = steps
        .windows(2)
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
    if !curves(points).is_empty() {
        items.push((Mark::Line(CURVE), "a setting at several sizes or values".to_owned()));
    }
    items.push((Mark::Front, "Pareto front: no setting is both faster and closer".to_owned()));
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
