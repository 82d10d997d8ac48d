//! `tinta render` of exact lines, into an SVG, PDF, DXF, JSON or picture's file. No OpenGL is opened.

mod turn;

use super::super::messages::is_captured;
use super::super::signals::Stop;
use super::super::{Verdict, say};
use super::rendering::Rendering;
use super::watched::{is_stopped, progress, watched};
use super::{explain, keep};
use std::time::Instant;
use tinta::lines::{DrawingContent, DrawingFormat, chain, strokes_of_paths};
use tinta::record::{DrawingFacts, LineCounts, LinesMade, Record};
use tinta::renderer::milliseconds_since;
use tinta::request::{DrawnLines, Session, WantedLines};
use tinta::{Error, Result, Show, Target, TextTarget};

/// Finds the lines and writes them.
pub(super) fn run(rendering: &Rendering<'_>, format: DrawingFormat, session: &mut Session) -> Result<Verdict> {
    let Rendering { request, output, .. } = *rendering;
    let turn = request.animation.turntable;
    let turn = turn.map(|views| turn::names(output, format).map(|names| (views, names))).transpose()?;
    let first = turn.as_ref().map_or_else(|| output.to_owned(), |(_, names)| names.with(1));
    match format.content {
        DrawingContent::Pixels => Target::check(&first, request.is_transparent()).map(drop)?,
        _ => TextTarget::check(&first).map(drop)?,
    }
    refuse_what_lines_have_not(rendering)?;
    // A job of a batch leaves signals to its run.
    let stop = (!is_captured()).then(Stop::on_signals);
    match turn {
        Some((views, names)) => turn::run(rendering, format, (views, &names), session, stop.as_ref()),
        None => one_view(rendering, format, session, stop.as_ref()),
    }
}

/// Draws the camera's view.
fn one_view(
    rendering: &Rendering<'_>,
    format: DrawingFormat,
    session: &mut Session,
    stop: Option<&Stop>,
) -> Result<Verdict> {
    let Rendering { request, run, output } = *rendering;
    let (progress, wanted) = (progress(rendering), WantedLines::of(format, run.is_told()));
    let drawn = match watched(&progress, stop, || request.lines(session, wanted, &progress)) {
        Err(Error::Cancelled) => return Ok(stopped(stop)),
        drawn => drawn?,
    };
    let phases = progress.times();
    drawn.remarks.iter().for_each(|remark| say(&format!("tinta: {remark}")));

    let start = Instant::now();
    let DrawnLines { resolved, lines, areas, load_ms, .. } = &drawn;
    let drawing = &resolved.contents.drawing;
    if format.lacks("areas").is_some() && areas.as_ref().is_some_and(|areas| !areas.drawn.fills.is_empty()) {
        say(&format!(
            "tinta: {output}: a .{} file has no fills, so only lines are written; --hatch draws tones as lines",
            format.ending
        ));
    }
    let has_recipe = !format.is_of_lines_alone;
    let recipe = if has_recipe { keep::recipe(rendering, resolved, &drawn.files, None) } else { None };
    let paths = match format.content {
        DrawingContent::Data if run.is_told() => chain(&lines.segments),
        DrawingContent::Data => Vec::new(),
        _ => drawn.paths(),
    };
    let counts = LineCounts::new(lines, &paths);
    if is_stopped(stop) {
        return Ok(stopped(stop));
    }
    let pens = match run.explain && drawing.is_for_pen {
        true => {
            let areas = areas.as_ref().map(|areas| &areas.drawn);
            explain::pens(&strokes_of_paths(lines, paths.clone(), areas, drawing)?)
        }
        false => String::new(),
    };
    drawn.written(format, Some(paths), recipe.as_ref())?.write(output, request.is_transparent())?;
    let lines_ms = milliseconds_since(start);
    if run.explain {
        let text = explain::lines(lines, &counts, &explain::parts(*load_ms, &phases, lines_ms));
        super::super::print(&(text + &explain::harmless(&resolved.scene) + &pens))?;
    }
    if !run.json {
        return Ok(Verdict::Good);
    }
    super::super::print_json(&record(rendering, drawn, counts, lines_ms)).map(|()| Verdict::Good)
}

/// The record of the drawing.
fn record(rendering: &Rendering<'_>, drawn: DrawnLines, counts: LineCounts, lines_ms: f64) -> Record {
    let DrawnLines { resolved, lines, remarks, load_ms, .. } = drawn;
    let made = DrawingFacts::Lines(Box::new(LinesMade {
        edges: lines.edges,
        changes: lines.changes.clone(),
        counts,
        times: lines.times,
        lines_ms,
    }));
    let mut record = rendering.record(&resolved, load_ms, remarks, made);
    record.model.defects.covered_triangles = lines.covered_triangles;
    record
}

/// The verdict after a signal.
fn stopped(stop: Option<&Stop>) -> Verdict {
    say("tinta: stopped by a signal; nothing was written");
    Verdict::Stopped { signal: stop.map_or(0, Stop::signal) }
}

fn refuse_what_lines_have_not(rendering: &Rendering<'_>) -> Result<()> {
    let Rendering { request, run, output } = *rendering;
    // A format without appearance leaves out what a look says of it.
    let is_given = |option: &str| request.options.contains_key(option) && !request.is_of_look(option);
    let refuse = |options: &[&str], problem: &str| match options.iter().find(|option| is_given(option)) {
        Some(option) => Err(Error::setting(*option, problem)),
        None => Ok(()),
    };
    run.refuse_for_lines()?;
    refuse(&["full", "keep"], "vectors are computed, not drawn by passes; leave it out here")?;
    let problem = "vectors have no passes and no model's frames; leave it out, or name a picture such as drawing.png";
    if request.show != Show::Final {
        return Err(Error::setting("show", problem));
    }
    refuse(&["animate"], problem)?;
    if run.explain && request.animation.turntable.is_some() {
        return Err(Error::setting("explain", "a turn has many views and this describes one; leave out --turntable"));
    }
    if output == "-" && run.is_told() {
        let problem = "the drawing and --json or --explain cannot share standard output; name a file";
        return Err(Error::value("o", "-", problem));
    }
    Ok(())
}
