//! Exact lines as a row beside the styles: measured as lines, not as pixels.

use super::ink::{Ink, mean_and_95th, recall_of_class};
use super::reference::{Reference, SOFT_CREASE_DEGREES, Sample, distance, fine_tree, samples_of};
use super::run::quartiles;
use super::{INK_FROM, LineError, MeasureSettings, Measured, Row, RunTime, Subject, error_picture};
use crate::edges::{Class, ClassSet, SilhouetteRule};
use crate::error::Result;
use crate::lines::{LineSettings, Raster, SvgSettings, VisibleLines, raster};
use crate::picture::Picture;
use crate::renderer::{median, milliseconds_since};
use crate::scene::{Scene, Size};
use crate::settings::Value;
use std::time::Instant;

/// Measures the silhouettes that style lines finds by a rule. A frame is finding them, nothing known before but what belongs to the mesh alone,
/// without drawing them.
///
/// # Errors
///
/// As [`VisibleLines::of`].
pub fn measure_lines(
    subject: &Subject,
    silhouette: SilhouetteRule,
    scene_options: &str,
    frames: usize,
    how: &MeasureSettings,
) -> Result<Measured> {
    let classes = ClassSet::of(&[Class::Silhouette]);
    let settings = LineSettings { classes, silhouette, finds_hidden: false, ..LineSettings::default() };
    let start = Instant::now();
    let lines = VisibleLines::of(&subject.scene, &settings)?;
    let first_frame_ms = milliseconds_since(start);
    let mut frames_ms = Vec::new();
    for _ in 0..frames {
        let start = Instant::now();
        VisibleLines::of(&subject.scene, &settings)?;
        frames_ms.push(milliseconds_since(start));
    }
    let Raster { size, pixels } = raster(&lines, &SvgSettings::default())?;
    let drawing = Picture { size, pixels };
    let error_picture = error_picture(&Ink::on_white(&drawing), &subject.reference, how.tolerance_px);
    let Size { width, height } = subject.scene.size;
    let row = Row {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        machine: how.machine.clone(),
        renderer: "none".to_owned(),
        model: subject.model.clone(),
        triangles: Scene::triangle_count(&subject.scene),
        size: [width, height],
        style: "lines".to_owned(),
        options: format!("--style lines --classes silhouette --silhouette {}{scene_options}", silhouette.text()),
        is_faithful: false,
        lines: Some(error(&lines, &subject.reference, how.tolerance_px)),
        tones: None,
        time: RunTime {
            load_ms: subject.load_ms,
            edges_ms: subject.edges_ms,
            plan_ms: 0.0,
            first_frame_ms,
            median_ms: median(frames_ms.clone()).unwrap_or_default(),
            quartiles_ms: quartiles(&frames_ms),
            frames_ms,
            passes: Vec::new(),
        },
    };
    Ok(Measured { row, drawing, error_picture: Some(error_picture) })
}

/// The error of lines: as that of ink, every point of a line as dark as any.
fn error(lines: &VisibleLines, reference: &Reference, tolerance_px: f64) -> LineError {
    let visible = lines.segments.iter().filter(|segment| segment.is_visible);
    let drawn: Vec<Sample> = visible.clone().flat_map(samples_of).collect();
    let drawn_tree = fine_tree(visible.map(|segment| segment.ends_px));
    let is_near = |distance: f64| distance <= tolerance_px;
    let to_drawn: Vec<(f64, f64)> =
        reference.samples.iter().map(|sample| (distance(&drawn_tree, sample.px), sample.length_px)).collect();
    let is_counted = |sample: &&Sample| {
        is_near(reference.distance_px(sample.px)) || !is_near(reference.distance_to_ignored_px(sample.px))
    };
    let to_reference: Vec<(f64, f64)> =
        drawn.iter().filter(is_counted).map(|sample| (reference.distance_px(sample.px), sample.length_px)).collect();
    let share = |distances: &[(f64, f64)]| {
        let all: f64 = distances.iter().map(|(_, length)| length).sum();
        let near: f64 = distances.iter().filter(|(px, _)| is_near(*px)).map(|(_, length)| length).sum();
        if all > 0.0 { near / all } else { 1.0 }
    };
    let (recall, precision) = (share(&to_drawn), share(&to_reference));
    let reach: Vec<u8> = to_drawn.iter().map(|(px, _)| if is_near(*px) { u8::MAX } else { 0 }).collect();
    LineError {
        against: reference.against,
        tolerance_px,
        ink_from: INK_FROM,
        ignored_creases_degrees: [SOFT_CREASE_DEGREES, reference.crease_angle.degrees()],
        reference_px: reference.length_px(),
        ink_px: drawn.iter().map(|sample| sample.length_px).sum(),
        recall,
        precision,
        precision_of_all: precision,
        f1: if recall + precision > 0.0 { 2.0 * recall * precision / (recall + precision) } else { 0.0 },
        average_precision: recall * precision,
        reference_to_ink_px: mean_and_95th(to_drawn),
        ink_to_reference_px: mean_and_95th(to_reference),
        recall_of_class: recall_of_class(reference, &reach),
    }
}
