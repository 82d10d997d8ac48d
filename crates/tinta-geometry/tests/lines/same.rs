//! Compares two drawings.

use crate::support::lines::{distance, length};
use glam::DVec2;
use std::collections::{BTreeMap, BTreeSet};
use tinta::edges::Class;
use tinta::lines::{LineSegment, VisibleLines};

/// Largest difference of a class's visible length, pixels.
const LENGTH_PX: f64 = 0.05;

/// Largest distance of a point of a segment from a segment of the other drawing, pixels.
const PIECE_PX: f64 = 0.01;

/// The difference between two drawings; `None` if they are the same.
pub fn difference(expected: &VisibleLines, actual: &VisibleLines, is_mirrored: bool) -> Option<String> {
    let (expected, mut actual) = (visible(expected), visible_of(actual));
    if is_mirrored {
        let width = f64::from(actual.1);
        for (_, ends) in &mut actual.0 {
            ends.iter_mut().for_each(|end| end.x = width - end.x);
        }
    }
    let actual = actual.0;
    let sums = |pieces: &[(Class, [DVec2; 2])]| {
        let mut sums: BTreeMap<Class, f64> = BTreeMap::new();
        pieces.iter().for_each(|(class, [a, b])| *sums.entry(*class).or_default() += a.distance(*b));
        sums
    };
    let (before, after) = (sums(&expected), sums(&actual));
    let classes: BTreeSet<Class> = before.keys().chain(after.keys()).copied().collect();
    for class in classes {
        let [a, b] = [&before, &after].map(|sums| sums.get(&class).copied().unwrap_or_default());
        if (a - b).abs() > LENGTH_PX {
            let place = lost(&expected, &actual).or(lost(&actual, &expected));
            return Some(format!("{class:?} {b:.3} px instead of {a:.3}; {}", place.unwrap_or_default()));
        }
    }
    lost(&expected, &actual).or_else(|| lost(&actual, &expected))
}

fn visible(lines: &VisibleLines) -> Vec<(Class, [DVec2; 2])> {
    let pieces = lines.segments.iter().filter(|segment| segment.is_visible && length(segment) > 0.0);
    pieces.map(|segment: &LineSegment| (segment.class, segment.ends_px)).collect()
}

fn visible_of(lines: &VisibleLines) -> (Vec<(Class, [DVec2; 2])>, u32) {
    (visible(lines), lines.size.width)
}

/// A place on a segment of one drawing without a nearby segment of the same class in the other.
fn lost(pieces: &[(Class, [DVec2; 2])], others: &[(Class, [DVec2; 2])]) -> Option<String> {
    for (class, [a, b]) in pieces {
        for share in [0.0, 0.37, 0.5, 0.81, 1.0] {
            let point = a.lerp(*b, share);
            if !others.iter().any(|(other, ends)| other == class && distance(point, *ends) <= PIECE_PX) {
                return Some(format!("{class:?} from {a:.3} to {b:.3} has no like at {point:.3}"));
            }
        }
    }
    None
}
