//! Judges any drawing of a scene by its exact visible lines: the share of lines it has, its false ink, and the hidden lines it
//! draws.
//!
//! Takes a picture or an SVG by any program, and its scene; returns a [`Judgement`]. docs/results/league.md explains the
//! numbers.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta_lab::judge::{InkColor, JudgeSettings, drawing, judge};
//! use tinta_lab::measure::Reference;
//! use tinta::{LineSettings, LoadOptions, Scene, SceneSettings, DrawingSettings, VisibleLines, lines, load};
//!
//! let gear = load("builtin:gear", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([gear], &SceneSettings::default())?;
//! let reference = Reference::with_hidden(&scene, &LineSettings::as_published())?;
//!
//! // The exact lines themselves, as an SVG that could be anyone's.
//! let svg = lines::svg(&reference.lines, &DrawingSettings::default())?;
//! let picture = drawing::of_bytes(svg.as_bytes(), "gear.svg", None)?;
//! let ink = InkColor::Dark.of(&picture);
//! let judgement = judge(&ink, &reference, &JudgeSettings::default())?;
//! assert!(judgement.lines.f1 > 0.999 && judgement.hidden.drawn_px < 1.0);
//! # Ok(())
//! # }
//! ```

mod distances;
mod doubt;
pub mod drawing;
mod entry;
mod fit;
mod ink_color;
mod matching;
mod thin;

pub use doubt::Doubt;
pub use entry::Entry;
pub use fit::Fit;
pub use ink_color::InkColor;
pub use matching::matched;
pub use thin::thinned;

use crate::compare::InkMask;
use crate::measure::{INK_FROM, Ink, LineError, Reference, samples_of};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use tinta::error::{Error, Result};
use tinta::lines::LineSegment;
use tinta::pixel::LineTolerance;

/// How a drawing is judged.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JudgeSettings {
    /// Distance within which ink and line count as the same.
    pub tolerance: LineTolerance,
    /// Whether to try a small shift, another scale and a mirror image first. Default no.
    pub fits: bool,
}

/// How well a drawing's lines are those of its scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// Recall, precision and distances, as `tinta measure` has them.
    pub lines: LineError,
    /// One pixel of ink to one of the lines: within 1 pixel, 2 pixels, and the benchmark's own distance.
    pub one_to_one: Vec<OneToOne>,
    /// Mean distance both ways, each way half, pixels; `None` without any ink or any line.
    pub chamfer_px: Option<f64>,
    /// The larger of both ways' 95th percentiles, pixels; `None` without any ink or any line.
    pub hausdorff_95_px: Option<f64>,
    /// Lines that were drawn though hidden.
    pub hidden: HiddenScore,
    /// How the lines were moved onto the drawing, if requested.
    pub fit: Option<Fit>,
    /// Why the numbers probably do not describe the drawing's lines.
    #[serde(default)]
    pub doubt: Option<Doubt>,
}

/// Boundary pixels matched one to one, as the Berkeley benchmark counts them (Martin, Fowlkes and Malik 2004): both drawings thinned to
/// a pixel's width, each pixel the partner of one at most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OneToOne {
    /// Farthest that partners may be apart, pixels.
    pub distance_px: f64,
    /// Share of the thinned lines with a partner.
    pub recall: f64,
    /// Share of the thinned ink with a partner.
    pub precision: f64,
    /// Harmonic mean of both.
    pub f1: f64,
    /// The largest such mean over all thresholds of ink.
    pub best_f1: f64,
    /// Precision averaged over recall, over all thresholds of ink.
    pub average_precision: f64,
}

/// Lines behind something, farther than twice the tolerance from every visible one; empty for a reference without hidden lines
/// ([`Reference::with_hidden`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HiddenScore {
    /// Their length, pixels.
    pub length_px: f64,
    /// How much of it has ink within the tolerance, pixels.
    pub drawn_px: f64,
}

/// The benchmark's distance, as a share of the picture's diagonal.
const BENCHMARK_DISTANCE: f64 = 0.0075;

/// Least darknesses of ink, of 255, that one-to-one matching tries beside [`INK_FROM`].
const THRESHOLDS: [u8; 7] = [1, 16, 32, 96, 128, 176, 224];

/// Distance within which a pixel of thinned ink is on a line, or on a crease that does not count, pixels.
const NEAR_PX: f64 = 2.0;

/// Judges a drawing's ink.
///
/// # Errors
///
/// [`Error::Setting`] for ink of another size than the reference.
pub fn judge(ink: &Ink, reference: &Reference, settings: &JudgeSettings) -> Result<Judgement> {
    let tolerance_px = settings.tolerance.px(reference.size);
    if ink.size != reference.size {
        let problem =
            format!("the drawing has {} px and the scene {} px; give the drawing's", ink.size, reference.size);
        return Err(Error::setting("size", problem));
    }
    let fit = settings.fits.then(|| Fit::of(ink, reference));
    let moved = fit.as_ref().map(|fit| reference.moved(|px| fit.apply(px)));
    let reference = moved.as_ref().unwrap_or(reference);
    let lines = ink.error(reference, tolerance_px);
    let both = lines.reference_to_ink_px.zip(lines.ink_to_reference_px);
    let hidden = hidden(ink, reference, fit.as_ref(), tolerance_px);
    Ok(Judgement {
        one_to_one: one_to_one(ink, reference),
        chamfer_px: both.map(|([there, _], [back, _])| (there + back) * 0.5),
        hausdorff_95_px: both.map(|([_, there], [_, back])| there.max(back)),
        hidden,
        fit,
        doubt: Doubt::of(ink, reference, &lines),
        lines,
    })
}

/// Hidden lines that are drawn.
fn hidden(ink: &Ink, reference: &Reference, fit: Option<&Fit>, tolerance_px: f64) -> HiddenScore {
    let mut hidden = HiddenScore { length_px: 0.0, drawn_px: 0.0 };
    let is_hidden = |segment: &&LineSegment| !segment.is_visible;
    for mut sample in reference.lines.segments.iter().filter(is_hidden).flat_map(samples_of) {
        if let Some(fit) = fit {
            sample.px = fit.apply(sample.px);
        }
        // Near a visible line, or a crease that does not count, its ink may be that one's.
        let nearest = reference.distance_px(sample.px).min(reference.distance_to_ignored_px(sample.px));
        if nearest <= 2.0 * tolerance_px {
            continue;
        }
        hidden.length_px += sample.length_px;
        if ink.darkest_within(sample.px, tolerance_px) >= INK_FROM {
            hidden.drawn_px += sample.length_px;
        }
    }
    hidden
}

fn one_to_one(ink: &Ink, reference: &Reference) -> Vec<OneToOne> {
    let lines = thinned(&InkMask::of_points(ink.size, reference.samples.iter().map(|sample| sample.px)));
    let mut thresholds: Vec<u8> = THRESHOLDS.into_iter().chain([INK_FROM]).collect();
    thresholds.sort_unstable_by(|a, b| b.cmp(a));
    // Ink on a soft crease is neither right nor wrong.
    let counts = |px: DVec2| reference.distance_px(px) <= NEAR_PX || reference.distance_to_ignored_px(px) > NEAR_PX;
    let counted = InkMask::of_darkness_from(ink.size, &ink.darkness, 1).kept(counts);
    let mask = |from: u8| thinned(&InkMask::of_darkness_from(ink.size, &ink.darkness, from)).and(&counted);
    let masks: Vec<(u8, InkMask)> = thresholds.iter().map(|from| (*from, mask(*from))).collect();
    let (width, height) = (f64::from(ink.size.width), f64::from(ink.size.height));
    let distances = [1.0, 2.0, BENCHMARK_DISTANCE * width.hypot(height)];
    let of_distance = |distance_px: f64| {
        let mut scores: Vec<(u8, Score)> = Vec::new();
        for (index, (from, mask)) in masks.iter().enumerate() {
            // A picture of one darkness is the same at every threshold.
            let same = index.checked_sub(1).filter(|before| masks[*before].1 == *mask).map(|before| scores[before].1);
            scores.push((*from, same.unwrap_or_else(|| Score::of(mask, &lines, distance_px))));
        }
        let here = scores.iter().find(|(from, _)| *from == INK_FROM).map(|(_, score)| *score).unwrap_or_default();
        let (mut average_precision, mut reached) = (0.0, 0.0);
        for (_, score) in &scores {
            average_precision += (score.recall - reached) * score.precision;
            reached = score.recall;
        }
        OneToOne {
            distance_px,
            recall: here.recall,
            precision: here.precision,
            f1: here.f1(),
            best_f1: scores.iter().map(|(_, score)| score.f1()).fold(0.0, f64::max),
            average_precision,
        }
    };
    distances.map(of_distance).into()
}

/// Recall and precision of a threshold.
#[derive(Debug, Clone, Copy, Default)]
struct Score {
    recall: f64,
    precision: f64,
}

impl Score {
    fn of(ink: &InkMask, lines: &InkMask, distance_px: f64) -> Self {
        let partners = matched(ink, lines, distance_px) as f64;
        let share = |all: usize| if all > 0 { partners / all as f64 } else { 1.0 };
        Self { recall: share(lines.count()), precision: share(ink.count()) }
    }

    fn f1(&self) -> f64 {
        let sum = self.recall + self.precision;
        if sum > 0.0 { 2.0 * self.recall * self.precision / sum } else { 0.0 }
    }
}
