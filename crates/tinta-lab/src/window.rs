//! The measure of lines that the window shows.

use crate::measure::{Ink, LineError, Reference};
use tinta::lines::{LineSettings, Progress};
use tinta::window::{LineMeasure, LineScore};
use tinta::{Renderer, Result, Scene, Style};

/// Distance within which ink lies on a line, pixels: the default of `tinta measure`.
const TOLERANCE_PX: f64 = 2.0;

/// How the window measures the lines of a style.
pub fn line_measure() -> LineMeasure {
    LineMeasure { ink, scores }
}

fn ink(renderer: &mut Renderer, scene: &Scene, style: &Style) -> Result<Option<Vec<u8>>> {
    Ok(Ink::of_style(renderer, scene, style)?.map(|ink| ink.darkness))
}

fn scores(scene: &Scene, inks: Vec<Vec<u8>>, progress: &Progress) -> Result<Vec<LineScore>> {
    let reference = Reference::with_progress(scene, &LineSettings::as_published(), progress)?;
    let score = |darkness| {
        let error = Ink { size: scene.size, darkness }.error(&reference, TOLERANCE_PX);
        let LineError { f1, recall, precision, ink_to_reference_px, .. } = error;
        LineScore { f1, recall, precision, mean_px: ink_to_reference_px.map(|[mean, _]| mean) }
    };
    Ok(inks.into_iter().map(score).collect())
}
