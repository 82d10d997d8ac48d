//! The page's answer in a sentence: the recommended setting.

use super::frame::short;
use super::plot::fronts;
use super::settings::{OWN_MARK, Point, Points};
use std::collections::BTreeSet;

/// Loss of F1 that speed may cost.
const EQUALLY_GOOD: f64 = 0.002;

/// The first of the settings that may be the fastest with an F1 within [`EQUALLY_GOOD`] of the best at each picture size, the others
/// of them, and the same style as published.
pub(super) fn answer(lines: &Points) -> Option<String> {
    let sizes: BTreeSet<[u32; 2]> = lines.points.iter().map(|point| point.size).collect();
    let of_size = |size: &[u32; 2]| {
        let points: Vec<&Point> = lines.points.iter().filter(|point| point.size == *size).collect();
        let place = if sizes.len() > 1 { format!("At {}×{}: ", size[0], size[1]) } else { String::new() };
        let text = best(&points, lines)?;
        let others: Vec<&Point> = points.iter().copied().filter(|point| !point.has_own_reference).collect();
        let other = match text.contains(OWN_MARK) {
            true => best(&others, lines).map(|best| format!(" {OWN} {best}")),
            false => None,
        };
        Some(place + &text + &other.unwrap_or_default())
    };
    let all: Vec<String> = sizes.iter().filter_map(of_size).collect();
    (!all.is_empty()).then(|| all.join(" "))
}

/// Explains [`OWN_MARK`], before the answer among the other settings.
const OWN: &str = "A setting with † draws the lines that it is judged by. Without these:";

/// The best lines for each time: every setting on the front, from the fastest, in a sentence.
pub(super) fn budgets(lines: &Points) -> Vec<(&Point, String)> {
    let sentence = |point: &Point| {
        let [fast, slow] = point.times_ms.map(short);
        let spread = match point.errors {
            [low, high] if low < high => format!(" (quartiles of the models {:.3} to {:.3})", 1.0 - high, 1.0 - low),
            _ => String::new(),
        };
        let place = format!("{}×{}", point.size[0], point.size[1]);
        format!(
            "{place}, for {} ms a frame by {} (quartiles {fast} to {slow}): {}, F1 {}{spread}",
            short(point.time_ms),
            lines.clock.name(),
            point.name,
            f1(point),
        )
    };
    let front = fronts(&lines.points).concat();
    front.into_iter().map(|index| (&lines.points[index], sentence(&lines.points[index]))).collect()
}

/// Not rounded up to 1, which only lines without error have.
fn f1(point: &Point) -> String {
    match point.error {
        error if error > 0.0 && error < 0.0005 => format!("{:.5}", 1.0 - error),
        error => format!("{:.3}", 1.0 - error),
    }
}

/// The answer at one size.
fn best(points: &[&Point], lines: &Points) -> Option<String> {
    let best = points.iter().map(|point| point.error).min_by(f64::total_cmp)?;
    // A little more, because two rounded numbers differ by rounding.
    let good: Vec<&Point> = points.iter().copied().filter(|point| point.error - best <= EQUALLY_GOOD + 1e-12).collect();
    // Of those that noise makes equal the first row: so the answer stays from run to run.
    let fastest = good.iter().copied().find(|point| good.iter().all(|other| point.is_as_fast_as(other)))?;
    let models = lines.models.len();
    let mean = if models > 1 { format!(", means over {models} models") } else { String::new() };
    let numbers = |point: &Point| format!("F1 {} in {} ms a frame", f1(point), short(point.time_ms));
    let (name, clock) = (&fastest.name, lines.clock.name());
    let mut text = format!("The best lines for the least time: {name} ({} by {clock}{mean}).", numbers(fastest));
    let noisy = good.iter().filter(|point| **point != fastest && point.is_as_fast_as(fastest));
    let names: Vec<&str> = noisy.map(|point| point.name.as_str()).collect();
    if !names.is_empty() {
        text += &format!(" As good and, within noise, as fast: {}.", names.join("; "));
    }
    match points.iter().find(|point| point.style == fastest.style && point.is_faithful) {
        Some(published) if *published == fastest => text += " These are the published settings.",
        Some(published) => text += &format!(" As published, {} has {}.", fastest.style, numbers(published)),
        None => {}
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::super::settings::Clock;
    use super::*;

    fn point(name: &str, is_faithful: bool, time_ms: f64, f1: f64) -> Point {
        let style = name.split(':').next().unwrap_or_default().to_owned();
        let (error, name) = (1.0 - f1, name.to_owned());
        let (times_ms, errors) = ([time_ms * 0.99, time_ms * 1.01], [error; 2]);
        Point {
            curves: [name.clone(), name.clone()],
            name,
            style,
            is_faithful,
            has_own_reference: false,
            options: String::new(),
            size: [512; 2],
            time_ms,
            times_ms,
            error,
            errors,
        }
    }

    fn of(points: &[Point], models: usize) -> Option<String> {
        let models = (0..models).map(|number| number.to_string()).collect();
        answer(&Points { points: points.to_vec(), models, left_out: 0, clock: Clock::Wall })
    }

    #[test]
    fn the_fastest_of_the_equally_good_is_named_beside_its_published_style() {
        let mut points = vec![
            point("ink: best", false, 27.7, 0.996),
            point("inking: exact", false, 3.5, 0.994),
            point("inking: exact, thin", false, 3.1, 0.9939),
            point("inking", true, 3.625, 0.9594),
        ];
        assert_eq!(
            of(&points, 9).unwrap(),
            "The best lines for the least time: inking: exact (F1 0.994 in 3.50 ms a frame by the clock, means over 9 models). \
             As published, inking has F1 0.959 in 3.62 ms a frame."
        );
        points[2].error = 1.0 - 0.9941;
        assert!(of(&points, 1).unwrap().contains("inking: exact, thin (F1 0.994 in 3.10 ms a frame by the clock). As"));
        points[3] = point("inking", true, 2.0, 0.996);
        assert!(
            of(&points, 1)
                .unwrap()
                .ends_with("inking (F1 0.996 in 2.00 ms a frame by the clock). These are the published settings.")
        );
        assert!(!of(&points[..1], 1).unwrap().contains("ublished"));
        assert_eq!(of(&[], 0), None);
    }

    #[test]
    fn what_noise_hides_is_said_and_each_size_has_its_own_answer() {
        let mut points =
            vec![point("ink", true, 8.4, 0.9996), point("mrt", false, 8.5, 0.9990), point("mrt", true, 9.9, 0.9)];
        let answer = of(&points, 1).unwrap();
        assert!(
            answer
                .contains("ink (F1 0.99960 in 8.40 ms a frame by the clock). As good and, within noise, as fast: mrt."),
            "{answer}"
        );
        // Whichever of the two a run finds faster.
        (points[0].time_ms, points[1].time_ms) = (8.5, 8.4);
        assert!(of(&points, 1).unwrap().contains("time: ink"));
        points[1].time_ms = 9.0;
        points[1].times_ms = [8.9, 9.1];
        assert!(!of(&points, 1).unwrap().contains("noise"));
        points[1].size = [1024; 2];
        assert!(
            of(&points, 1).unwrap().contains(" At 1024×1024: The best lines for the least time: mrt (F1 0.999 in 9.00")
        );
    }
}
