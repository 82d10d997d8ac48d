//! What `--explain` says of a plan's times, and of what came before the first frame.

use tinta::plan::Plan;
use tinta::record::Summary;
use tinta::renderer::PassTime;

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

/// How long it took from the start to the first frame, part by part.
pub(super) fn start(parts: &[(&str, f64)]) -> String {
    let rows: Vec<String> = parts.iter().map(|(name, ms)| format!("{name:<20}{ms:>10.3}\n")).collect();
    format!("\n{:<20}{:>10}  the model is read while the context opens\n{}", "start", "ms", rows.concat())
}
