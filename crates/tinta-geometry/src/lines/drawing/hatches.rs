//! Tones as hatching: the strokes of each tone, their directions and their distance on the page.
//!
//! Input: regions of tone, and the lines that go above. Output: a [`Hatch`] for each direction. The brightest tone stays empty. Strokes
//! along the form are twice as dense in a darker tone as in the next brighter one. Of straight strokes each darker tone has one more
//! direction; its strokes run through all tones that have it, so a stroke does not stop where a darker tone begins.
//!
//! Straight strokes lie on lines at whole multiples of the spacing from the image of the scene's centre. From view to view they move
//! with the scene, those along the form with each face.

use crate::error::{Error, Result};
use crate::limits::HATCH_STROKES;
use crate::lines::VisibleLines;
use crate::lines::drawing::areas::Areas;
use crate::lines::drawing::drawn_layers::page;
use crate::lines::drawing::form_strokes::form_strokes;
use crate::lines::drawing::hatch::{Hatch, Ruling};
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::length::Length;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::lines::regions::{Regions, ToneRule, TonedSurface};
use crate::lines::sight::Sight;
use crate::scene::Scene;
use glam::DVec2;

/// Returns the strokes of all tones but the brightest that the rule reaches; none if the settings ask for none.
///
/// Strokes shorter than [`DrawingSettings::min_length`] are left out.
///
/// # Errors
///
/// [`Error::Setting`] for settings that [`DrawingSettings::check`] refuses, and for more than [`HATCH_STROKES`] strokes; those of
/// [`Regions::toned`].
pub fn hatches(
    sight: &Sight<'_>,
    (rule, regions): (&ToneRule, &Regions<Option<TonedSurface>>),
    lines: &VisibleLines,
    settings: &DrawingSettings,
    progress: &Progress,
) -> Result<Vec<Hatch>> {
    let brightest = rule.brightest();
    settings.check()?;
    let Some(spacing) = settings.hatching.spacing else { return Ok(Vec::new()) };
    let units = page(lines, Some(&Areas::around(regions)), settings).units;
    let spacing_px = match spacing {
        Length::Times(widths) => widths * settings.width_px(Layer::Hatch(0), units),
        spacing => spacing.px(units).unwrap_or_default(),
    };
    let too_many = |count: String| {
        let problem =
            format!("this makes {count} strokes, and a drawing has at most {HATCH_STROKES}; choose a wider spacing");
        Error::value("hatch", spacing, problem)
    };
    let least_px = |tone: u8| settings.min_length_px(Layer::Hatch(tone), units);
    let Some(angle) = settings.hatching.angle_degrees else {
        if brightest == 0 {
            return Ok(Vec::new());
        }
        let tone = brightest - 1;
        let strokes = form_strokes(sight, rule, [spacing_px, least_px(tone)], progress)?;
        return Ok(vec![Hatch {
            tone,
            strokes: strokes.ok_or_else(|| too_many(format!("more than {HATCH_STROKES}")))?,
        }]);
    };
    let anchor_px = anchor_px(sight.scene);
    let of_tone = |tone: u8| {
        let turn = f64::from(brightest - 1 - tone) / f64::from(brightest);
        let ruling = Ruling::new(anchor_px, angle + 180.0 * turn, spacing_px);
        (tone, ruling, regions.joined(|seen| seen.filter(|surface| surface.tone <= tone).map(|_| ())))
    };
    let areas: Vec<(u8, Ruling, Regions<()>)> = (0..brightest).rev().map(of_tone).collect();
    let count: f64 = areas.iter().map(|(_, ruling, area)| ruling.count(area)).sum();
    if count > HATCH_STROKES as f64 {
        return Err(too_many(format!("{count:.0}")));
    }
    let hatch = |(tone, ruling, area): (u8, Ruling, Regions<()>)| {
        let strokes = ruling.strokes(&area, least_px(tone)).into_iter().map(Vec::from).collect();
        Hatch { tone, strokes }
    };
    Ok(areas.into_iter().map(hatch).collect())
}

/// The image of the scene's centre; the picture's middle where the centre lies before the near plane.
fn anchor_px(scene: &Scene) -> DVec2 {
    let space = Space::of(scene);
    let centre = space.view(scene.centre);
    if -centre.z > space.near { space.project(centre).0 } else { space.size * 0.5 }
}
