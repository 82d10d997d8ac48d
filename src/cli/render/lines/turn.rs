//! `tinta render --turntable` of exact lines: numbered drawings.

use super::super::super::signals::Stop;
use super::super::super::{Verdict, print_json, say};
use super::super::animate::say_left_over;
use super::super::rendering::Rendering;
use super::super::watched::{is_stopped, progress, watched};
use serde_json::json;
use std::path::Path;
use std::time::Instant;
use tinta::animation::NumberedName;
use tinta::lines::DrawingFormat;
use tinta::record::Summary;
use tinta::renderer::milliseconds_since;
use tinta::request::{ReadModels, Request, Session, WantedLines};
use tinta::{Error, Result};

/// The names of the drawings.
///
/// # Errors
///
/// [`Error::File`] for a name without a place for a number, or without a format of lines.
pub(super) fn names(output: &str, format: DrawingFormat) -> Result<NumberedName> {
    NumberedName::parse(output).filter(|_| !format.is_of_lines_alone).ok_or_else(|| {
        let problem = "this names one drawing; a turn is a .gif or .apng, or numbered drawings such as frame-%04d.svg";
        Error::output(output, problem)
    })
}

/// Draws the views of a turn one after the other.
pub(super) fn run(
    rendering: &Rendering<'_>,
    format: DrawingFormat,
    (views, names): (u32, &NumberedName),
    session: &Session,
    stop: Option<&Stop>,
) -> Result<Verdict> {
    let whole = Instant::now();
    let Rendering { request, run, output } = *rendering;
    refuse_what_turns_have_not(request)?;
    let ReadModels { meshes, ms: load_ms, .. } = request.models(&session.models)?;
    let (mut bytes, mut is_empty, mut frame_ms) = (0, true, Vec::new());
    let turn = request.turn(request.placed(meshes)?, views, true)?;
    for (number, view) in (1..).zip(&turn) {
        let frame = Instant::now();
        let name = names.with(number);
        let progress = progress(rendering);
        let drawn = watched(&progress, stop, || view.drawn_lines(WantedLines::of(format, false), &progress));
        if is_stopped(stop) || matches!(drawn, Err(Error::Cancelled)) {
            return Ok(stopped(stop, number - 1, views));
        }
        let drawn = drawn?;
        is_empty &= drawn.lines.segments.is_empty();
        drawn.written(format, None, None)?.write(&name, request.is_transparent())?;
        bytes += Path::new(&name).metadata().map_or(0, |metadata| metadata.len());
        frame_ms.push(milliseconds_since(frame));
    }
    say_left_over(output, views);
    if is_empty {
        say("tinta: no line of these classes is visible in any view; see --classes, --eye and --target");
    }
    if !run.json {
        return Ok(Verdict::Good);
    }
    print_json(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "models": rendering.model_records(&turn[0].scene),
        "load": request.read,
        "style": request.style,
        "size": request.scene.size,
        "frames": views,
        "bytes": bytes,
        "load_ms": load_ms,
        "frame_ms": Summary::new(frame_ms),
        "whole_ms": milliseconds_since(whole),
    }))
    .map(|()| Verdict::Good)
}

fn refuse_what_turns_have_not(request: &Request) -> Result<()> {
    if request.style.lines().is_none_or(|style| style.areas.is_some()) {
        let problem = "areas are drawn from one view; leave it out, or draw lines alone";
        return Err(Error::setting("turntable", problem));
    }
    if request.options.contains_key("page") {
        let problem = "each view would be scaled to fill the paper, and the model change its size; leave it out, or say --width-mm";
        return Err(Error::setting("page", problem));
    }
    Ok(())
}

/// The verdict after a signal that came after some of the drawings.
fn stopped(stop: Option<&Stop>, done: u32, views: u32) -> Verdict {
    say(&format!("tinta: stopped by a signal; {done} of {views} drawings were written"));
    Verdict::Stopped { signal: stop.map_or(0, Stop::signal) }
}
