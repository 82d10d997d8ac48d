//! A pixel of a drawing against the exact lines, and the smallest change of a setting that turns ink into none or none into ink.

use super::explainer::Explainer;
use super::recomputation::Recomputation;
use super::tolerance::LineTolerance;
use crate::error::Result;
use crate::lines::VisibleLines;
use crate::plan::Plan;
use crate::renderer::StepValues;
use crate::scene::Scene;
use crate::settings::{OptionValue, Options};
use crate::styles::{Show, Style};
use glam::DVec2;
use serde::Serialize;

/// Least darkness of a pixel of ink, of 255: a quarter, to include faint lines.
pub const INK_FROM: u8 = 64;

/// A line this close to a pixel's middle runs through the pixel: half its diagonal.
const THROUGH_PX: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Whether a pixel is drawn as the exact lines are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Ink near a visible line, or a line whose ink lies beside this pixel.
    Right,
    /// Ink without a visible line near it.
    Invented,
    /// A visible line runs through the pixel, and no ink is near.
    Missed,
    /// Neither ink nor line.
    Empty,
}

/// A pixel of a drawing's lines, shown alone on white, against the exact lines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AgainstLines {
    /// What it is.
    pub verdict: Verdict,
    /// How dark the pixel is, of 255; ink from [`INK_FROM`].
    pub darkness: u8,
    /// The class of the nearest visible line.
    pub class: Option<&'static str>,
    /// Its distance from the pixel's middle, pixels.
    pub distance_px: Option<f64>,
    /// What would turn the verdict of ink over, for each setting that can ([`flips`]).
    pub flips: Vec<Flip>,
}

/// The smallest change of a setting that turns ink into none, or none into ink.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Flip {
    /// The setting's name.
    pub setting: &'static str,
    /// The first value that does it.
    pub value: f64,
}

/// Settings that decide on ink, with the values to try: from, to, step.
const DECIDING: [(&str, [f64; 3]); 3] =
    [("detection-factor", [0.0, 2.0, 0.001]), ("ink-threshold", [0.0, 1.0, 0.001]), ("border-width", [1.0, 16.0, 1.0])];

/// Compares a pixel, counted from the lower left, with the scene's visible lines. `values` are those of the steps of a plan that draws
/// the style's lines alone ([`Show::Borders`]).
pub(crate) fn against_lines(scene: &Scene, values: &[StepValues], lines: &VisibleLines, at: [u32; 2]) -> AgainstLines {
    let middle = DVec2::new(f64::from(at[0]) + 0.5, f64::from(scene.size.height - 1 - at[1]) + 0.5);
    let nearest = lines
        .segments
        .iter()
        .filter(|segment| segment.is_visible)
        .map(|segment| (segment.class, nearest_place(segment.ends_px, middle)))
        .min_by(|a, b| a.1.distance(middle).total_cmp(&b.1.distance(middle)));
    let distance_px = nearest.map(|(_, place)| place.distance(middle));
    let drawn = darkness_of(values, at).unwrap_or_default();
    let is_near = |limit: f64| distance_px.is_some_and(|distance| distance <= limit);
    let verdict = match drawn >= INK_FROM {
        true if is_near(LineTolerance::default().px(scene.size)) => Verdict::Right,
        true => Verdict::Invented,
        false if !is_near(THROUGH_PX) => Verdict::Empty,
        false if nearest.is_some_and(|(_, place)| has_ink_near(scene, values, place)) => Verdict::Right,
        false => Verdict::Missed,
    };
    let class = nearest.map(|(class, _)| class.name());
    AgainstLines { verdict, darkness: drawn, class, distance_px, flips: Vec::new() }
}

/// Finds the smallest changes of the style's settings that turn a pixel's ink over. `values` are those of the plan's steps around the pixel.
///
/// # Errors
///
/// As [`Explainer::pixel`].
pub fn flips(
    scene: &Scene,
    style: &Style,
    (plan, values): (&Plan, &[StepValues]),
    at: [u32; 2],
    how: Recomputation,
) -> Result<Vec<Flip>> {
    let is_ink = darkness_of(values, at).unwrap_or_default() >= INK_FROM;
    let flips = DECIDING.iter().filter_map(|(setting, range)| {
        flip(scene, style, (plan, values), (setting, *range), (at, is_ink), how).transpose()
    });
    flips.collect()
}

fn nearest_place([from, to]: [DVec2; 2], px: DVec2) -> DVec2 {
    let along = to - from;
    let share = if along == DVec2::ZERO { 0.0 } else { (px - from).dot(along) / along.length_squared() };
    from + along * share.clamp(0.0, 1.0)
}

/// Returns how dark the last step left a pixel, of 255; `None` outside of the part read back.
fn darkness_of(values: &[StepValues], [x, y]: [u32; 2]) -> Option<u8> {
    let StepValues { part, colors, .. } = values.last()?;
    let (x, y) = (x.checked_sub(part.x)?, y.checked_sub(part.y)?);
    let is_within = x < part.width && y < part.height;
    is_within.then(|| darkness(colors[0][(y * part.width + x) as usize].map(f64::from)))
}

/// How dark a colour is, of 255.
fn darkness([red, green, blue, _]: [f64; 4]) -> u8 {
    ((1.0 - red.min(green).min(blue)).clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Whether any pixel is ink whose middle is near a place of the picture, y down.
fn has_ink_near(scene: &Scene, values: &[StepValues], place: DVec2) -> bool {
    let tolerance_px = LineTolerance::default().px(scene.size);
    let reach = tolerance_px.ceil() as i64;
    let (column, row) = (place.x.floor() as i64, place.y.floor() as i64);
    (-reach..=reach).any(|dy| {
        (-reach..=reach).any(|dx| {
            let (x, y) = (column + dx, row + dy);
            let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let up = i64::from(scene.size.height) - 1 - y;
            let pixel = u32::try_from(x).ok().zip(u32::try_from(up).ok());
            let is_ink = pixel.and_then(|(x, y)| darkness_of(values, [x, y])).is_some_and(|dark| dark >= INK_FROM);
            is_ink && middle.distance(place) <= tolerance_px
        })
    })
}

/// Finds the value nearest to the present one that turns ink over; `None` if the style lacks the setting or no value does.
fn flip(
    scene: &Scene,
    style: &Style,
    (plan, values): (&Plan, &[StepValues]),
    (setting, [from, to, step]): (&'static str, [f64; 3]),
    (at, is_ink): ([u32; 2], bool),
    how: Recomputation,
) -> Result<Option<Flip>> {
    let options = style.to_options()?;
    let with = |value: f64| {
        let mut changed: Options = options.clone();
        changed.insert(setting.to_owned(), OptionValue::text(format!("{}", (value / step).round() * step)));
        Style::from_options(&changed)
    };
    let last = values.len() - 1;
    let turns = |value: f64| -> Result<bool> {
        let changed = with(value)?.plan(scene, Show::Borders)?;
        if changed.steps().count() != values.len() {
            return Ok(false);
        }
        let computed = Explainer::step(scene, &changed, values, how, (last, at))?.computed;
        Ok(computed.is_some_and(|colors| (darkness(colors[0]) >= INK_FROM) != is_ink))
    };
    // An option of another style changes nothing.
    if with(from)?.plan(scene, Show::Borders)? == *plan && with(to)?.plan(scene, Show::Borders)? == *plan {
        return Ok(None);
    }
    // More makes ink: search above the present value for ink, below for none, by whole steps.
    let steps = ((to - from) / step).round() as i64;
    let value_of = |number: i64| from + number as f64 * step;
    let (mut without, mut does) = if is_ink { (steps, 0) } else { (0, steps) };
    if !turns(value_of(does))? {
        return Ok(None);
    }
    while without.abs_diff(does) > 1 {
        let middle = i64::midpoint(without, does);
        if turns(value_of(middle))? { does = middle } else { without = middle }
    }
    Ok(Some(Flip { setting, value: (value_of(does) / step).round() * step }))
}
