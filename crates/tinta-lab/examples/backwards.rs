//! Whether the order of a run changes its numbers: measures the styles of each model forward and backward in turns, and lists the
//! settings whose processor times (the clock's, where a device draws) differ beyond their quartiles.
//!
//!     cargo run --release -p tinta-lab --example backwards -- builtin:gear builtin:bust

use std::process::ExitCode;
use std::sync::Arc;
use tinta::styles::Style;
use tinta::{Backend, LoadOptions, Renderer, Result, Scene, SceneSettings, StyleName, load};
use tinta_lab::measure::{MeasureSettings, MeasuredStyle, Subject, measure};

/// Runs in each direction, and frames of each setting in a run.
const RUNS: usize = 7;
const FRAMES: usize = 3;

fn main() -> ExitCode {
    let models: Vec<String> = std::env::args().skip(1).collect();
    match compare(&models) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn compare(models: &[String]) -> Result<()> {
    let mut renderer = Renderer::new(Backend::Auto)?;
    let settings: Vec<MeasuredStyle> = StyleName::of_passes()
        .map(|(name, style)| MeasuredStyle {
            style: Style::named(style),
            submission: Default::default(),
            options: format!("--style {name}"),
            is_faithful: true,
        })
        .collect();
    let backward: Vec<MeasuredStyle> = settings.iter().rev().cloned().collect();
    let how = MeasureSettings { frames: FRAMES, ..MeasureSettings::default() };
    let (mut all, mut apart) = (0, 0);
    for model in models {
        let mesh = Arc::new(load(model, &LoadOptions::default())?.mesh);
        let subject = Subject::new(model, Scene::new(vec![mesh], &SceneSettings::default())?, 0.0)?;
        // Of each setting the times forward and backward.
        let mut times: Vec<(String, [Vec<f64>; 2])> = Vec::new();
        for run in 0..2 * RUNS {
            let direction = run % 2;
            let order = if direction == 0 { &settings } else { &backward };
            for measured in measure(&mut renderer, &subject, order, &how, |_| {})?.0 {
                let time = measured.row.time;
                let frames = if time.processor_ms.is_empty() { time.frames_ms } else { time.processor_ms };
                match times.iter_mut().find(|(options, _)| *options == measured.row.options) {
                    Some((_, both)) => both[direction].extend(frames),
                    None => {
                        let mut both = [Vec::new(), Vec::new()];
                        both[direction].extend(frames);
                        times.push((measured.row.options, both));
                    }
                }
            }
        }
        for (options, both) in &times {
            let [forward, backward] = [0, 1].map(|direction| spread(&both[direction]));
            all += 1;
            let is_apart = forward[2] < backward[0] || backward[2] < forward[0];
            apart += usize::from(is_apart);
            let said = |[low, middle, high]: [f64; 3]| format!("{middle:8.2} ({low:.2} to {high:.2})");
            let mark = if is_apart { "  apart" } else { "" };
            println!("{model:<16} {options:<22} {} forward, {} backward, ms{mark}", said(forward), said(backward));
        }
    }
    println!("{} of {all} rows agree within their quartiles", all - apart);
    Ok(())
}

/// Lower quartile, median, upper quartile.
fn spread(times: &[f64]) -> [f64; 3] {
    let mut sorted = times.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| sorted.get(sorted.len() * quarter / 4).copied().unwrap_or_default())
}
