//! `tinta render` with pruning: the applied rules, the time they saved, and whether the picture is the same.

use super::super::Verdict;
use std::path::{Path, PathBuf};
use tinta::plan::Plan;
use tinta::plan::prune::{Omission, PrunedPlan, Pruning, prune};
use tinta::renderer::median;
use tinta::request::{Around, Resolved};
use tinta::{Picture, Renderer, Result, Scene, Target};

/// Least rounds that time an omission.
const LEAST_ROUNDS: usize = 5;

/// Most rounds.
const MOST_ROUNDS: usize = 101;

/// Draws the published plan and compares it with the picture of the shorter one; without a difference no picture of one stays.
pub(super) fn verify(
    output: &str,
    renderer: &mut Renderer,
    view: &Resolved,
    (published, around): (&Plan, &Around),
    picture: &Picture,
) -> Result<Verdict> {
    let full = around.drawn(view, published, renderer)?;
    let path = difference_path(output);
    if full.pixels == picture.pixels {
        // A file from an earlier run would be out of date.
        let _ = std::fs::remove_file(&path);
        return Ok(Verdict::Good);
    }
    let target = Target::check(&path.display().to_string(), false)?;
    let mut count = 0;
    let mut different = full.clone();
    for (pixel, other) in different.pixels.chunks_exact_mut(4).zip(picture.pixels.chunks_exact(4)) {
        let is_different = *pixel != *other;
        count += usize::from(is_different);
        pixel.copy_from_slice(if is_different { &[0, 0, 0, u8::MAX] } else { &[u8::MAX; 4] });
    }
    target.write(&different)?;
    super::super::say(&format!(
        "tinta: {count} of {} pixels differ from the full drawing, black in {}; --full draws as published, please report this",
        view.scene.size.pixel_count(),
        path.display()
    ));
    Ok(Verdict::Different)
}

/// `a/b.png` and `a/b-%04d.png` both become `a/b-difference.png`.
fn difference_path(output: &str) -> PathBuf {
    let path = Path::new(output);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let stem = stem.split('%').next().unwrap_or_default().trim_end_matches('-');
    let stem = if stem.is_empty() { "tinta" } else { stem };
    path.with_file_name(format!("{stem}-difference.png"))
}

/// The omissions and the time each saved, measured by drawing with and without each; and the rules that omitted nothing.
pub(super) fn explanation(
    renderer: &mut Renderer,
    scene: &Scene,
    published: &Plan,
    pruning: &Pruning,
    frames: usize,
) -> Result<String> {
    let PrunedPlan { plan, omissions, kept } = prune(published, scene, pruning);
    // Each is restored alone, because they build on one another.
    let with = |omission: &Omission| {
        let keep = pruning.keep.iter().copied().chain([omission.rule]).collect();
        prune(published, scene, &Pruning { keep, ..pruning.clone() }).plan
    };
    let mut plans = vec![published.clone(), plan];
    plans.extend(omissions.iter().map(with));
    let mut times = vec![Vec::new(); plans.len()];
    for _ in 0..frames.clamp(LEAST_ROUNDS, MOST_ROUNDS) {
        for (plan, times) in plans.iter().zip(&mut times) {
            times.extend(renderer.time_frames(scene, plan, 1, 1)?);
        }
    }
    let mut medians = times.into_iter().map(|times| median(times).unwrap_or_default());
    let (full_ms, pruned_ms) = (medians.next().unwrap_or_default(), medians.next().unwrap_or_default());
    let mut text = format!("\n{:<50}{full_ms:>10.3}\n", "whole picture as published (--full)");
    for (omission, with_ms) in omissions.iter().zip(medians) {
        let Omission { rule, what, reason, facts } = omission;
        text.push_str(&format!(
            "left out {rule}: {what}\n  {}; {reason}; {}\n",
            saved(with_ms, pruned_ms),
            facts.join("; ")
        ));
    }
    for one in kept {
        text.push_str(&format!("kept {}: {}\n", one.rule, one.reason));
    }
    Ok(text)
}

/// The time of restoring an omission, in words; medians of a busy machine vary by a twentieth.
fn saved(with_ms: f64, without_ms: f64) -> String {
    match with_ms - without_ms {
        saved if saved.abs() > 0.05 * without_ms && saved > 0.0 => format!("saved {saved:.2} ms"),
        _ => "saved too little to measure here (more --frames measure better)".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::messages::{capture, captured};
    use super::{Verdict, difference_path, saved, verify};
    use std::path::Path;
    use tinta::lines::Progress;
    use tinta::request::Request;
    use tinta::{LoadOptions, Renderer, Scene, SceneSettings, Size, load};

    #[test]
    fn pixels_that_differ_from_the_full_drawing_are_said_and_drawn_and_others_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("a.png").display().to_string();
        let request = Request::default();
        let mesh = load("builtin:gear", &LoadOptions::default()).unwrap().mesh;
        let size = Size { width: 32, height: 32 };
        let scene = Scene::new([mesh], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
        let mut renderer = Renderer::new(request.backend).unwrap();
        let view = request.still(scene, false).unwrap();
        let (plan, around) = (view.plan().unwrap(), view.around(&Progress::default()).unwrap());
        let mut picture = around.drawn(&view, &plan, &mut renderer).unwrap();
        let mut verified = |picture| {
            capture();
            let verdict = verify(&output, &mut renderer, &view, (&plan, &around), picture).unwrap();
            let said = captured().said.join("\n");
            (verdict, said, folder.path().join("a-difference.png").exists())
        };
        let right = picture.clone();
        picture.pixels[0] ^= 1;
        let (verdict, said, has_file) = verified(&picture);
        assert!(verdict == Verdict::Different && has_file);
        assert!(said.contains("1 of 1024 pixels differ from the full drawing, black in "), "{said}");
        let (verdict, said, has_file) = verified(&right);
        assert!(verdict == Verdict::Good && !has_file && !said.contains("differ"), "{said}");
    }

    #[test]
    fn what_is_within_the_noise_is_not_called_saved() {
        assert_eq!(saved(12.5, 10.0), "saved 2.50 ms");
        for with_ms in [10.3, 9.0, f64::NAN] {
            assert!(saved(with_ms, 10.0).contains("too little"), "{with_ms}");
        }
    }

    #[test]
    fn the_difference_lies_beside_the_picture() {
        for (output, expected) in [
            ("a/b.png", "a/b-difference.png"),
            ("b.gif", "b-difference.png"),
            ("a/b-%04d.png", "a/b-difference.png"),
            ("%04d.png", "tinta-difference.png"),
        ] {
            assert_eq!(difference_path(output), Path::new(expected));
        }
    }
}
