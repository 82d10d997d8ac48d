//! The page's answer in a sentence: the recommended setting.

use super::plot::short;
use super::settings::{Point, Points};

/// Loss of F1 that speed may cost.
const EQUALLY_GOOD: f64 = 0.002;

/// The fastest setting with an F1 within [`EQUALLY_GOOD`] of the best, and the same style as published.
pub(super) fn answer(lines: &Points) -> Option<String> {
    let Points { points, models, .. } = lines;
    let best = points.iter().map(|point| point.error).min_by(f64::total_cmp)?;
    // A little more, because two rounded numbers differ by rounding.
    let is_good = |point: &&Point| point.error - best <= EQUALLY_GOOD + 1e-12;
    let fastest = points.iter().filter(is_good).min_by(|a, b| a.time_ms.total_cmp(&b.time_ms))?;
    let mean = if models.len() > 1 { format!(", means over {} models", models.len()) } else { String::new() };
    let numbers = |point: &Point| format!("F1 {:.3} in {} ms a frame", 1.0 - point.error, short(point.time_ms));
    let first = format!("The best lines for the least time: {} ({}{mean}).", fastest.name, numbers(fastest));
    let published = points.iter().find(|point| point.style == fastest.style && point.is_faithful);
    Some(match published {
        Some(published) if published == fastest => format!("{first} These are the published settings."),
        Some(published) => format!("{first} As published, {} has {}.", fastest.style, numbers(published)),
        None => first,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(name: &str, is_faithful: bool, time_ms: f64, f1: f64) -> Point {
        let style = name.split(':').next().unwrap_or_default().to_owned();
        Point { name: name.to_owned(), style, is_faithful, time_ms, error: 1.0 - f1 }
    }

    fn of(points: &[Point], models: usize) -> Option<String> {
        let models = (0..models).map(|number| number.to_string()).collect();
        answer(&Points { points: points.to_vec(), models, left_out: 0 })
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
            "The best lines for the least time: inking: exact (F1 0.994 in 3.50 ms a frame, means over 9 models). \
             As published, inking has F1 0.959 in 3.62 ms a frame."
        );
        points[2].error = 1.0 - 0.9941;
        assert!(of(&points, 1).unwrap().contains("inking: exact, thin (F1 0.994 in 3.10 ms a frame). As"));
        points[3] = point("inking", true, 2.0, 0.996);
        assert!(
            of(&points, 1)
                .unwrap()
                .ends_with("inking (F1 0.996 in 2.00 ms a frame). These are the published settings.")
        );
        assert!(!of(&points[..1], 1).unwrap().contains("ublished"));
        assert_eq!(of(&[], 0), None);
    }
}
