//! Exact lines as a row like the styles': measured as lines, not as pixels.

use super::ink::Ink;
use super::reference::{Reference, Sample, distance, fine_tree, samples_of, total};
use super::{FrameTimes, LineError, MeasureSettings, Measurement, Row, RunTime, Subject, error_picture};
use tinta::edges::{Class, ClassSet, SilhouetteRule};
use tinta::error::Result;
use tinta::lines::{DrawingSettings, LineSettings, Raster, VisibleLines, raster};
use tinta::picture::Picture;
use tinta::settings::Value;
use tinta::styles::StyleName;

/// The options of `tinta render` for the silhouettes that a rule finds, with options of the scene.
pub fn line_options(silhouette: SilhouetteRule, scene_options: &str) -> String {
    format!("--style lines --classes silhouette --silhouette {}{scene_options}", silhouette.text())
}

/// Measures the silhouettes that style lines finds by a rule; `options` as by [`line_options`]. A frame is finding them, with
/// only the mesh's own data known before, without drawing them.
///
/// # Errors
///
/// As [`VisibleLines::of`].
pub fn measure_lines(
    subject: &Subject,
    silhouette: SilhouetteRule,
    options: String,
    frames: usize,
    how: &MeasureSettings,
) -> Result<Measurement> {
    let classes = ClassSet::of(&[Class::Silhouette]);
    let settings = LineSettings { classes, silhouette, finds_hidden: false, ..LineSettings::default() };
    let lines = VisibleLines::of(&subject.scene, &settings)?;
    let mut times = FrameTimes::default();
    for _ in 0..frames {
        times.add_work(|| VisibleLines::of(&subject.scene, &settings).map(drop))?;
    }
    let Raster { size, pixels } = raster(&lines, &DrawingSettings::default())?;
    let drawing = Picture { size, pixels };
    let tolerance_px = how.tolerance.px(size);
    let error_picture = error_picture(&Ink::on_white(&drawing), &subject.reference, tolerance_px);
    let row = Row {
        style: StyleName::Lines.name().to_owned(),
        options,
        has_own_reference: silhouette == SilhouetteRule::Exact,
        lines: Some(error(&lines, &subject.reference, tolerance_px)),
        time: RunTime::new([subject.load_ms, subject.edges_ms, 0.0], times, Vec::new()),
        ..subject.row(how)
    };
    Ok(Measurement { row, drawing, error_picture: Some(error_picture) })
}

/// The error of lines: as for ink, with every point of a line equally dark.
fn error(lines: &VisibleLines, reference: &Reference, tolerance_px: f64) -> LineError {
    let visible = lines.segments.iter().filter(|segment| segment.is_visible);
    let drawn: Vec<Sample> = visible.clone().flat_map(samples_of).collect();
    let drawn_tree = fine_tree(visible.map(|segment| segment.ends_px));
    let to_drawn: Vec<f64> = reference.samples.iter().map(|sample| distance(&drawn_tree, sample.px)).collect();
    let is_counted = |sample: &&Sample| {
        let is_near = |distance: f64| distance <= tolerance_px;
        is_near(reference.distance_px(sample.px)) || !is_near(reference.distance_to_ignored_px(sample.px))
    };
    let counted = drawn.iter().filter(is_counted);
    let to_reference = counted.map(|sample| (reference.distance_px(sample.px), sample.length_px)).collect();
    LineError {
        ink_px: total(drawn.iter().map(|sample| sample.length_px)),
        ..LineError::of_distances(reference, tolerance_px, &to_drawn, to_reference)
    }
}
