//! The text of `--explain`: a plan's times, the preparation before the first frame, and exact lines.

use tinta::edges::Class;
use tinta::lines::{InconsistencyKind, Phase, Polyline, Strokes, VisibleLines};
use tinta::mesh::Defects;
use tinta::plan::Plan;
use tinta::record::{LineCounts, Summary};
use tinta::renderer::PassTime;
use tinta::scene::Scene;

/// The plan, each pass's time, the whole picture's.
pub(super) fn frames(plan: &Plan, passes: &[PassTime], times: &Summary, frames: usize) -> String {
    let mut text = plan.to_string();
    text.push_str(&format!("\n{:<20}{:>10}{:>10}\n", "pass", "cpu ms", "gpu ms"));
    for pass in passes {
        let device = pass.gpu_ms.map_or("-".to_owned(), |ms| format!("{ms:.3}"));
        text.push_str(&format!("{:<20}{:>10.3}{:>10}\n", pass.name, pass.cpu_ms, device));
    }
    let count = if frames == 1 { "1 frame".to_owned() } else { format!("the median of {frames} frames") };
    text.push_str(&format!("{:<20}{:>10.3}            with read-back, {count}\n", "whole picture", times.median));
    text
}

/// Faults of the models' files that do not change the picture.
pub(super) fn harmless(scene: &Scene) -> String {
    let found = scene.originals().map(|object| (&object.mesh.name, object.mesh.defects.others()));
    let harmless = found.filter(|(_, others)| *others != Defects::default() && others.consequence().is_none());
    harmless.map(|(name, others)| format!("\n{name}: {others}; this does not change the picture\n")).collect()
}

/// How long it took from the start to the first frame, part by part.
pub(super) fn start(parts: &[(&str, f64)]) -> String {
    let rows: Vec<String> = parts.iter().map(|(name, ms)| format!("{name:<20}{ms:>10.3}\n")).collect();
    format!("\n{:<20}{:>10}  the model is read while the context opens\n{}", "start", "ms", rows.concat())
}

/// The pens that a plotter needs for the layers, in drawing order: one for each width and colour. Lengths are in millimetres on
/// paper, else in pixels.
pub(super) fn pens(layers: &[Strokes]) -> String {
    let mut pens: Vec<(&Strokes, Vec<&Strokes>)> = Vec::new();
    for layer in layers {
        match pens.iter_mut().find(|(first, _)| (first.width_px, first.color) == (layer.width_px, layer.color)) {
            Some((_, layers)) => layers.push(layer),
            None => pens.push((layer, vec![layer])),
        }
    }
    let has_paper = layers.iter().any(|layer| layer.width_mm.is_some());
    let length_name = if has_paper { "length mm" } else { "length px" };
    let mut text = format!("\n{:<20}{:>10}{:>12}{:>12}\n", "pen, layer", "strokes", length_name, "width");
    for (number, (first, layers)) in pens.iter().enumerate() {
        let width = first.width_mm.map_or_else(|| format!("{:.2} px", first.width_px), |mm| format!("{mm:.2} mm"));
        text.push_str(&format!("{:<44}{width:>10}\n", format!("pen {}", number + 1)));
        for layer in layers {
            let scale = layer.width_mm.map_or(1.0, |mm| mm / layer.width_px);
            let length = scale * layer.polylines.iter().map(Polyline::length_px).sum::<f64>();
            let name = format!("  {}", layer.layer.words().join("-"));
            text.push_str(&format!("{name:<20}{:>10}{length:>12.1}\n", layer.polylines.len()));
        }
    }
    text
}

/// The parts of a drawing's work and their milliseconds, in order.
pub(super) fn parts(load_ms: f64, phases: &[(Phase, f64)], written_ms: f64) -> Vec<(&'static str, f64)> {
    let phases = phases.iter().map(|(phase, ms)| (phase.words(), *ms));
    [("read", load_ms)].into_iter().chain(phases).chain([("join and write", written_ms)]).collect()
}

/// Explains a drawing's lines: their counts, the time of each part, and where visible smooth silhouettes end without a reason.
pub(super) fn lines(lines: &VisibleLines, counts: &LineCounts, parts: &[(&str, f64)]) -> String {
    let mut text = format!("{:<20}{:>10}{:>12}{:>12}\n", "class", "lines", "seen px", "hidden px");
    let mut edges = lines.edges;
    for (name, class) in Class::ALL {
        let length = |is_visible: bool| -> f64 {
            let of_it = |line: &&tinta::lines::LineSegment| line.class == class && line.is_visible == is_visible;
            let lengths = lines.segments.iter().filter(of_it).map(|line| line.ends_px[0].distance(line.ends_px[1]));
            // An empty sum is -0.
            lengths.sum::<f64>() + 0.0
        };
        if *edges.of(class) > 0 {
            text.push_str(&format!("{name:<20}{:>10}{:>12.1}{:>12.1}\n", edges.of(class), length(true), length(false)));
        }
    }
    text.push_str(&format!(
        "\n{} pieces are seen and {} hidden; joined they are {} and {} lines\n",
        counts.visible_segments, counts.hidden_segments, counts.visible_paths, counts.hidden_paths
    ));
    if let Some(changes) = &lines.changes {
        text.push_str(&format!(
            "\nsmooth silhouettes begin or end {} times where something comes before them, {} times at a cusp, {} times for no reason\n",
            changes.crossings, changes.cusps, changes.inconsistencies
        ));
        for place in &changes.places {
            let why = match place.kind {
                InconsistencyKind::Near => "faces within two edges hide the line",
                InconsistencyKind::Turn => "the contour turns towards the eye for less than two edges",
            };
            text.push_str(&format!("  at {:.1},{:.1} px: {why}\n", place.px[0], place.px[1]));
        }
    }
    text.push_str(&format!("\n{:<28}{:>10}\n", "part", "ms"));
    parts.iter().for_each(|(name, ms)| text.push_str(&format!("{name:<28}{ms:>10.3}\n")));
    text
}
