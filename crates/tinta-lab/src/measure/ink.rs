//! The error of a picture's ink against the exact lines.

use super::LineError;
use super::reference::{Reference, SOFT_CREASE_DEGREES, distance, total, tree};
use crate::compare::InkMask;
use glam::DVec2;
use std::collections::BTreeMap;
use tinta::edges::Class;
use tinta::error::Result;
use tinta::picture::Picture;
use tinta::renderer::Renderer;
use tinta::scene::{Scene, Size};
use tinta::styles::{Show, Style};

pub use tinta::pixel::INK_FROM;

/// A picture's ink: how dark each pixel is, of 255, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ink {
    /// The picture's size.
    pub size: Size,
    /// Darkness.
    pub darkness: Vec<u8>,
}

/// Who has a pixel or a piece of line: for pictures of errors.
#[derive(Debug, Clone, PartialEq)]
pub struct InkVerdicts {
    /// For each pixel of ink, whether it is on a line, off every line, or on one that does not count.
    pub pixels: Vec<Option<Verdict>>,
    /// Points of the reference with no ink near them.
    pub missed: Vec<DVec2>,
}

/// The verdict on a pixel of ink.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// A visible line is near.
    Agreed,
    /// No line is near.
    Invented,
    /// Only a soft crease is.
    Ignored,
}

impl Ink {
    /// The lines that a style draws of a scene; `None` for a style without any.
    ///
    /// # Errors
    ///
    /// Those of [`Renderer::draw`], and the style's own.
    pub fn of_style(renderer: &mut Renderer, scene: &Scene, style: &Style) -> Result<Option<Self>> {
        if !style.has_lines() {
            return Ok(None);
        }
        if !matches!(style, Style::TwoPass(_)) {
            return Ok(Some(Self::on_white(&renderer.draw(scene, &style.plan(scene, Show::Borders)?)?)));
        }
        // Two passes never draw the border separately: it is the part of their picture darker than the tones.
        let whole = renderer.draw(scene, &style.plan(scene, Show::Final)?)?;
        let tones = renderer.draw(scene, &style.plan(scene, Show::Tones)?)?;
        Ok(Some(Self::over(&tones, &whole)))
    }

    /// The ink pixels.
    pub(crate) fn mask(&self) -> InkMask {
        InkMask::of_darkness(self.size, &self.darkness)
    }

    /// The ink of a picture of lines on white: how far a pixel is from white in its darkest channel.
    pub fn on_white(picture: &Picture) -> Self {
        let darkness = |pixel: &[u8]| u8::MAX - pixel[..3].iter().copied().min().unwrap_or(u8::MAX);
        Self { size: picture.size, darkness: picture.pixels.chunks_exact(4).map(darkness).collect() }
    }

    /// The ink of a picture over the same one without: the lost share of each pixel's light, if it had any.
    pub fn over(without: &Picture, with: &Picture) -> Self {
        let share = |(without, with): (&u8, &u8)| match without {
            0 => 0,
            before => ((f64::from(before.saturating_sub(*with)) / f64::from(*before)) * 255.0).round() as u8,
        };
        let pairs = without.pixels.chunks_exact(4).zip(with.pixels.chunks_exact(4));
        let darkness = pairs.map(|(without, with)| without[..3].iter().zip(&with[..3]).map(share).max().unwrap_or(0));
        Self { size: with.size, darkness: darkness.collect() }
    }

    /// Pixels with ink and their middles.
    pub(crate) fn pixels(&self, from: u8) -> impl Iterator<Item = (usize, DVec2)> {
        let width = self.size.width as usize;
        let is_ink = move |(_, darkness): &(usize, &u8)| **darkness >= from;
        let inked = self.darkness.iter().enumerate().filter(is_ink);
        inked.map(move |(index, _)| (index, DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5)))
    }

    /// The darkest ink whose pixel's middle lies within a distance of a place.
    pub(crate) fn darkest_within(&self, px: DVec2, tolerance_px: f64) -> u8 {
        let (low, high) = ((px - tolerance_px - 0.5).floor(), (px + tolerance_px + 0.5).ceil());
        let clamp = |value: f64, size: u32| value.clamp(0.0, f64::from(size)) as usize;
        let columns = clamp(low.x, self.size.width)..clamp(high.x, self.size.width);
        let mut darkest = 0;
        for y in clamp(low.y, self.size.height)..clamp(high.y, self.size.height) {
            for x in columns.clone() {
                let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                if middle.distance_squared(px) <= tolerance_px * tolerance_px {
                    darkest = darkest.max(self.darkness[y * self.size.width as usize + x]);
                }
            }
        }
        darkest
    }

    /// Its error against a reference of the same size.
    pub fn error(&self, reference: &Reference, tolerance_px: f64) -> LineError {
        let reach: Vec<u8> =
            reference.samples.iter().map(|sample| self.darkest_within(sample.px, tolerance_px)).collect();
        // Every ink pixel once: whether it is near a line, or ignored.
        let pixels: Vec<(u8, Verdict, f64)> = self
            .pixels(1)
            .map(|(index, middle)| {
                let distance = reference.distance_px(middle);
                (self.darkness[index], verdict(reference, middle, distance, tolerance_px), distance)
            })
            .collect();
        let recall = |from: u8| {
            let darkest = reach.iter().map(|darkest| *darkest >= from);
            share_of(darkest.zip(reference.samples.iter().map(|sample| sample.length_px)))
        };
        let precision = |from: u8| {
            let counted =
                pixels.iter().filter(|(darkness, verdict, _)| *darkness >= from && *verdict != Verdict::Ignored);
            share_of(counted.map(|(darkness, verdict, _)| (*verdict == Verdict::Agreed, f64::from(*darkness))))
        };
        let ink_tree = tree(self.pixels(INK_FROM).map(|(_, middle)| middle));
        let to_ink: Vec<f64> = reference.samples.iter().map(|sample| distance(&ink_tree, sample.px)).collect();
        let counted =
            |(darkness, verdict, _): &&(u8, Verdict, f64)| *darkness >= INK_FROM && *verdict != Verdict::Ignored;
        let to_line = pixels.iter().filter(counted).map(|(darkness, _, distance)| (*distance, f64::from(*darkness)));
        LineError {
            ink_px: total(self.pixels(INK_FROM).map(|(index, _)| f64::from(self.darkness[index]) / 255.0)),
            precision_of_all: precision(1),
            average_precision: average_precision(recall, precision),
            ..LineError::of_distances(reference, tolerance_px, &to_ink, to_line.collect())
        }
    }

    /// Each pixel's verdict, for a picture of the error.
    pub fn verdicts(&self, reference: &Reference, tolerance_px: f64) -> InkVerdicts {
        let mut pixels = vec![None; self.darkness.len()];
        for (index, middle) in self.pixels(INK_FROM) {
            pixels[index] = Some(verdict(reference, middle, reference.distance_px(middle), tolerance_px));
        }
        let is_missed = |px: &DVec2| self.darkest_within(*px, tolerance_px) < INK_FROM;
        InkVerdicts { pixels, missed: reference.samples.iter().map(|sample| sample.px).filter(is_missed).collect() }
    }
}

fn verdict(reference: &Reference, middle: DVec2, distance: f64, tolerance_px: f64) -> Verdict {
    match distance <= tolerance_px {
        true => Verdict::Agreed,
        false if reference.distance_to_ignored_px(middle) <= tolerance_px => Verdict::Ignored,
        false => Verdict::Invented,
    }
}

/// The area under precision over recall, as thresholds fall from the darkest ink to the faintest.
fn average_precision(recall: impl Fn(u8) -> f64, precision: impl Fn(u8) -> f64) -> f64 {
    /// Steps of darkness looked at.
    const STEP: usize = 5;
    let (mut area, mut reached) = (0.0, 0.0);
    for from in (1..=u8::MAX).rev().step_by(STEP) {
        let recall = recall(from);
        area += (recall - reached) * precision(from);
        reached = recall;
    }
    area
}

impl LineError {
    /// From the distance of each reference sample to the drawing, and of each drawn sample to the reference, with its weight.
    pub(super) fn of_distances(
        reference: &Reference,
        tolerance_px: f64,
        to_drawn: &[f64],
        to_reference: Vec<(f64, f64)>,
    ) -> Self {
        let is_near = |distance: f64| distance <= tolerance_px;
        let lengths = reference.samples.iter().map(|sample| sample.length_px);
        let recall = share_of(to_drawn.iter().map(|px| is_near(*px)).zip(lengths.clone()));
        let precision = share_of(to_reference.iter().map(|(px, weight)| (is_near(*px), *weight)));
        let mut of_class: BTreeMap<Class, Vec<(bool, f64)>> = BTreeMap::new();
        for (sample, px) in reference.samples.iter().zip(to_drawn) {
            of_class.entry(sample.class).or_default().push((is_near(*px), sample.length_px));
        }
        Self {
            against: reference.against,
            tolerance_px,
            ink_from: INK_FROM,
            ignored_creases_degrees: [SOFT_CREASE_DEGREES, reference.crease_angle.degrees()],
            reference_px: reference.length_px(),
            ink_px: total(to_reference.iter().map(|(_, weight)| *weight)),
            recall,
            precision,
            precision_of_all: precision,
            f1: if recall + precision > 0.0 { 2.0 * recall * precision / (recall + precision) } else { 0.0 },
            average_precision: recall * precision,
            reference_to_ink_px: mean_and_95th(to_drawn.iter().copied().zip(lengths).collect()),
            ink_to_reference_px: mean_and_95th(to_reference),
            recall_of_class: of_class
                .into_iter()
                .map(|(class, samples)| (class.name().to_owned(), share_of(samples.into_iter())))
                .collect(),
        }
    }
}

/// The share of all weight for which the flag holds; 1 without any.
fn share_of(weights: impl Iterator<Item = (bool, f64)>) -> f64 {
    let (held, all) = weights
        .fold((0.0, 0.0), |(held, all), (holds, weight)| (held + if holds { weight } else { 0.0 }, all + weight));
    if all > 0.0 { held / all } else { 1.0 }
}

/// Weighted mean and 95th percentile of values with their weights; `None` without values.
pub(super) fn mean_and_95th(mut values: Vec<(f64, f64)>) -> Option<[f64; 2]> {
    values.retain(|(value, _)| value.is_finite());
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = values.iter().map(|(_, weight)| weight).sum();
    let mean = values.iter().map(|(value, weight)| value * weight).sum::<f64>() / all;
    let mut passed = 0.0;
    let at_95th = values.iter().find(|(_, weight)| {
        passed += weight;
        passed >= 0.95 * all
    });
    at_95th.map(|(value, _)| [mean, *value])
}
