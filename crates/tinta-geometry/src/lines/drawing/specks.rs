//! Removes lines that are too short to read: specks, barbs, and strokes covered by the ink of others.
//!
//! Input: line segments, their drawn widths and least lengths. Output: the segments that stay. Segments are connected
//! where they share an end bit for bit. They touch where an end of one is within [`JOINED_PX`](crate::tolerances::JOINED_PX) of the other, for
//! example where a line ends behind a nearer one. Four things are removed:
//!
//! - a *speck*: a connected set shorter than its least length that touches the rest in at most one place;
//! - a *barb*: a stretch from a free end, where nothing connects or touches, to the first fork, if it is as short;
//! - a *sliver's side*: a short stretch that touches the rest in two places, if other lines still join these. Those
//!   lines are as wide and also too short, so their ink covers it;
//! - a line that *doubles* an outline of the same style: its ink touches the outline's all along ([`doubled`]).
//!
//! Segments that close a line therefore stay: an outline has no free end, and loses a part only if another path
//! closes it. No removal leads to another, so a long line never disappears piece by piece.

mod doubled;
mod strokes;
mod way_around;

use crate::bvh::steps;
use crate::edges::ClassSet;
use crate::error::Result;
use crate::lines::VisibleLines;
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::outline_runs::readable;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::progress::{Phase, Progress};
use crate::threads::{cores, in_chunks};
use glam::DVec2;
use strokes::{Branch, Stroke, Strokes};

impl VisibleLines {
    /// Removes spurs and specks: lines shorter than [`DrawingSettings::min_length`]. If the settings style the
    /// outline, segments that do not read as outline lose that mark: those beside slits narrower than it, and runs
    /// shorter than four of its widths. Lines whose ink touches the outline's all along go too.
    ///
    /// # Errors
    ///
    /// Those of [`DrawingSettings::check`] and [`VisibleLines::check`].
    pub fn without_specks(&self, settings: &DrawingSettings) -> Result<Self> {
        self.without_specks_with_progress(settings, &Progress::default())
    }

    /// Like [`VisibleLines::without_specks`], and reports progress.
    ///
    /// # Errors
    ///
    /// Also [`Error::Cancelled`](crate::Error::Cancelled) and [`Error::OutOfTime`](crate::Error::OutOfTime).
    pub fn without_specks_with_progress(&self, settings: &DrawingSettings, progress: &Progress) -> Result<Self> {
        settings.check()?;
        self.check()?;
        let units = crate::lines::drawing::drawn_layers::page(self, None, settings).units;
        let segments = match settings.tells_outline() {
            true => readable(&self.segments, settings.width_px(Layer::Outline, units), progress),
            false => self.segments.clone(),
        };
        let looks = self.drawings(settings);
        let mut keeps = vec![true; segments.len()];
        // Hidden lines have separate layers, which may be switched off.
        for is_visible in [true, false] {
            let strokes: Vec<Stroke> = segments
                .iter()
                .enumerate()
                .filter(|(_, segment)| segment.is_visible == is_visible && !segment.is_covered)
                // A model's own curves and points are no noise, and connect nothing.
                .filter(|(_, segment)| !ClassSet::OF_NO_SURFACE.contains(segment.class))
                .map(|(number, segment)| Stroke::new(number, segment, &looks[segment.look as usize], units))
                .collect();
            let border = DVec2::new(f64::from(self.size.width), f64::from(self.size.height));
            let found = Strokes::new(&strokes, border);
            let mut gone = found.too_short(progress)?;
            if settings.tells_outline() {
                gone.extend(found.doubled(progress)?);
            }
            gone.into_iter().for_each(|stroke| keeps[strokes[stroke].number] = false);
        }
        let kept = segments.into_iter().zip(keeps).filter(|(_, keeps)| *keeps).map(|(segment, _)| segment);
        Ok(Self { segments: kept.collect(), ..self.clone() })
    }
}

/// Branches whose neighbours a thread tests at once.
const LOOKED_AT_ONCE: usize = 2048;

impl Strokes<'_> {
    /// All segments to remove.
    fn too_short(&self, progress: &Progress) -> Result<Vec<usize>> {
        progress.begin(Phase::TooShort, 0);
        progress.go_on()?;
        let mut is_gone = vec![false; self.strokes.len()];
        let wholes = self.small_wholes();
        let barbs = self.barbs();
        let loose: Vec<&Branch> = wholes.iter().chain(&barbs).collect();
        let goes = in_chunks(loose.len(), LOOKED_AT_ONCE, cores(), |range| {
            let goes = |branch: usize| !progress.is_over() && self.places_touched(loose[branch]).len() <= 1;
            range.map(goes).collect::<Vec<bool>>()
        });
        progress.go_on()?;
        for (branch, _) in loose.iter().zip(goes.concat()).filter(|(_, goes)| *goes) {
            branch.strokes.iter().for_each(|stroke| is_gone[*stroke] = true);
        }
        let spans = self.spans();
        let is_side = |branch: &&Branch| branch.length < self.least(branch, |stroke| stroke.least_side);
        let mut sides: Vec<&Branch> = wholes.iter().filter(is_side).chain(&spans).collect();
        sides.sort_by(|a, b| a.length.total_cmp(&b.length));
        let places_touched = in_chunks(sides.len(), LOOKED_AT_ONCE, cores(), |range| {
            let places = |side: usize| match progress.is_over() {
                true => None,
                false => <[DVec2; 2]>::try_from(self.places_touched(sides[side])).ok(),
            };
            range.map(places).collect::<Vec<_>>()
        });
        progress.go_on()?;
        let mut is_needed = vec![false; self.strokes.len()];
        progress.begin(Phase::TooShort, sides.len());
        let mut before = steps();
        for (branch, places) in sides.into_iter().zip(places_touched.into_iter().flatten()) {
            progress.go_on()?;
            let now = steps();
            progress.advance(1, now.wrapping_sub(before));
            before = now;
            if branch.strokes.iter().any(|stroke| is_needed[*stroke] || is_gone[*stroke]) {
                continue;
            }
            let Some(places) = places else { continue };
            let may_use = |stroke: usize| !is_gone[stroke] && !branch.strokes.contains(&stroke);
            if let Some(way) = self.way_around(branch, places, may_use) {
                way.into_iter().for_each(|stroke| is_needed[stroke] = true);
                branch.strokes.iter().for_each(|stroke| is_gone[*stroke] = true);
            }
        }
        Ok((0..self.strokes.len()).filter(|stroke| is_gone[*stroke]).collect())
    }

    fn meeting(&self, end: u32) -> &[u32] {
        &self.ends[self.meetings[end as usize]]
    }
}
