//! A look that draws exact lines, measured as `tinta render` draws it.

use crate::measure::{FrameTimes, Ink, MeasureSettings, Measured, Row, RunTime, Subject, error_picture};
use tinta::lines::Progress;
use tinta::request::{DrawingFile, DrawingFormat, Request, Wanted};
use tinta::{Error, Picture, Renderer, Result, Scene};

/// Measures a look that draws exact lines over a picture, as `tinta render` draws it: a frame finds the lines and prunes the plan.
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
) -> Result<Measured> {
    let scene = request.lit(subject.scene.clone());
    let ink = Ink::on_white(&exact_lines(&scene, request)?);
    let drawing = request.picture_of(&scene, renderer)?;
    let mut times = FrameTimes::default();
    for _ in 0..how.frames {
        times.add_work(|| request.picture_of(&scene, renderer).map(drop))?;
    }
    if !renderer.context().is_software() {
        times.processor_ms.clear();
    }
    let tolerance_px = how.tolerance.px(scene.size);
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
    Ok(Measured { row, drawing, error_picture: Some(error_picture(&ink, &subject.reference, tolerance_px)) })
}

/// The exact lines that a request draws of a scene, alone.
///
/// # Errors
///
/// As [`Request::drawn_lines`].
pub(in crate::commands) fn exact_lines(scene: &Scene, request: &Request) -> Result<Picture> {
    let lines = request.drawn_lines(scene.clone(), Wanted::default(), &Progress::default())?;
    match lines.written(DrawingFormat::Picture, None, None)? {
        DrawingFile::Picture(picture, _) => Ok(picture),
        DrawingFile::Bytes(_) => Err(Error::setting("o", "lines are compared as pixels")),
    }
}
