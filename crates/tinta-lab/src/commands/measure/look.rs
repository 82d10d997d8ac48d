//! A look or a style that draws exact lines, measured as `tinta render` draws it.

use crate::measure::{FrameTimes, Ink, MeasureSettings, Measurement, Row, RunTime, Subject, error_picture};
use tinta::lines::{DrawingFormat, Progress};
use tinta::request::{DrawingFile, Ground, Request, Resolved, WantedLines};
use tinta::styles::Below;
use tinta::{Error, Picture, Renderer, Result};

/// Measures a look that draws exact lines over a picture, or style lines, as `tinta render` draws it: a frame finds the lines and
/// prunes the plan.
/// Its row bears the look's name instead of a style's; `options` are the row's.
///
/// # Errors
///
/// Those of the drawing.
pub(super) fn measure_look(
    renderer: &mut Renderer,
    subject: &Subject,
    (look, request): (&str, &Request),
    options: String,
    how: &MeasureSettings,
) -> Result<Measurement> {
    let mut resolved = request.still(subject.scene.clone(), false)?;
    // A shadow has no lines.
    resolved.request.ground = Ground::None;
    let ink = Ink::on_white(&exact_lines(&resolved)?);
    let has_passes = matches!(resolved.contents.below, Below::Passes(_));
    let draw = |renderer: &mut Renderer| if has_passes { resolved.picture(renderer) } else { exact_lines(&resolved) };
    let (drawing, mut times) = (draw(renderer)?, FrameTimes::default());
    for _ in 0..how.frames {
        times.add_work(|| draw(renderer).map(drop))?;
    }
    if !renderer.context().is_software() {
        times.processor_ms.clear();
    }
    let tolerance_px = how.tolerance.px(resolved.scene.size);
    let row = Row {
        renderer: renderer.context().renderer.clone(),
        gl_version: renderer.context().version.clone(),
        style: look.to_owned(),
        options,
        is_pruned: true,
        has_own_reference: true,
        lines: Some(ink.error(&subject.reference, tolerance_px)),
        time: RunTime::new([subject.load_ms, 0.0, 0.0], times, Vec::new()),
        ..subject.row(how)
    };
    Ok(Measurement { row, drawing, error_picture: Some(error_picture(&ink, &subject.reference, tolerance_px)) })
}

/// The exact lines of a drawing, alone.
///
/// # Errors
///
/// As [`Resolved::drawn_lines`].
pub(in crate::commands) fn exact_lines(resolved: &Resolved) -> Result<Picture> {
    let lines = resolved.drawn_lines(WantedLines::default(), &Progress::default())?;
    match lines.written(DrawingFormat::PIXELS, None, None)? {
        DrawingFile::Picture(picture, _) => Ok(picture),
        DrawingFile::Bytes(_) => Err(Error::setting("o", "lines are compared as pixels")),
    }
}
