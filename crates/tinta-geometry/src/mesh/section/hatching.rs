//! The hatching of a cut: parallel strokes over each solid, neighbours in other directions or farther apart (ISO 128-50).

use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Directions of the strokes on solids one after the other, degrees from the horizontal, and their distances in spacings.
const PATTERNS: [(f64, f64); 4] = [(45.0, 1.0), (135.0, 1.0), (45.0, 1.6), (135.0, 1.6)];

/// The most strokes of a solid; beyond, none are drawn.
const MOST: f64 = 100_000.0;

/// The upright and the horizontal direction of a plane with this normal, of length 1; seen from its front, the second points to the
/// right.
pub(super) fn upright(normal: DVec3) -> [DVec3; 2] {
    let vertical = if normal.y.abs() < 0.99 { DVec3::Y } else { DVec3::NEG_Z };
    let up = (vertical - normal * normal.dot(vertical)).normalize_or(normal.any_orthonormal_vector());
    [up, up.cross(normal)]
}

/// The strokes inside the rings that these sides make, by the even-odd rule; `number` is the solid's.
pub(super) fn strokes(
    sides: impl Iterator<Item = [DVec3; 2]>,
    [across, up]: [DVec3; 2],
    spacing: f64,
    number: usize,
) -> Vec<[DVec3; 2]> {
    let (degrees, factor) = PATTERNS[number % PATTERNS.len()];
    let along = DVec2::from_angle(degrees.to_radians());
    let (along, beside) = (across * along.x + up * along.y, up * along.x - across * along.y);
    let (spacing, sides): (f64, Vec<[DVec3; 2]>) = (spacing * factor, sides.collect());
    let rows = |point: DVec3| point.dot(beside) / spacing;
    let height = |end: fn(f64, f64) -> f64, from: f64| sides.iter().flatten().map(|point| rows(*point)).fold(from, end);
    let count = height(f64::max, f64::NEG_INFINITY) - height(f64::min, f64::INFINITY);
    if count.is_nan() || count > MOST {
        return Vec::new();
    }
    // For each row the points where sides cross it.
    let mut crossings: BTreeMap<i64, Vec<DVec3>> = BTreeMap::new();
    for [from, to] in sides {
        let [low, high] = if rows(from) < rows(to) { [from, to] } else { [to, from] };
        // From the first row above the lower end up to the upper end itself, so that a shared end counts once.
        for row in (rows(low).floor() as i64 + 1)..=(rows(high).floor() as i64) {
            let share = (row as f64 - rows(low)) / (rows(high) - rows(low));
            crossings.entry(row).or_default().push(low.lerp(high, share));
        }
    }
    let in_order = |mut points: Vec<DVec3>| {
        points.sort_by(|a, b| a.dot(along).total_cmp(&b.dot(along)));
        points.as_chunks::<2>().0.to_vec()
    };
    crossings.into_values().flat_map(in_order).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_fill_a_square_with_a_hole_by_their_spacing_and_neighbours_cross() {
        let ring = |low: f64, high: f64| {
            let corners = [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| DVec3::new(x, y, 3.0));
            (0..4).map(move |k| [corners[k], corners[(k + 1) % 4]])
        };
        let frame = [DVec3::X, DVec3::Y];
        let length = |strokes: &[[DVec3; 2]]| strokes.iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
        let spacing = 0.01;
        let all: Vec<Vec<[DVec3; 2]>> =
            (0..4).map(|number| strokes(ring(0.0, 1.0).chain(ring(0.25, 0.5)), frame, spacing, number)).collect();
        // Their length times their spacing is the area.
        for (strokes, (_, factor)) in all.iter().zip(PATTERNS) {
            let area = length(strokes) * spacing * factor;
            assert!((area - (1.0 - 0.0625)).abs() < 0.01, "{area}");
            assert!(strokes.iter().flatten().all(|end| (end.z - 3.0).abs() < 1e-12));
        }
        let direction = |strokes: &[[DVec3; 2]]| (strokes[3][1] - strokes[3][0]).normalize();
        assert!(direction(&all[0]).dot(direction(&all[1])).abs() < 1e-9);
        assert!(strokes(ring(0.0, 1.0), frame, 1e-9, 0).is_empty(), "too dense to draw");
    }

    #[test]
    fn a_cut_stands_upright() {
        let [up, across] = upright(DVec3::Z);
        assert_eq!((up, across), (DVec3::Y, DVec3::X));
        let [up, across] = upright(DVec3::Y);
        assert!(up.dot(DVec3::Y).abs() < 1e-12 && across.dot(up).abs() < 1e-12);
    }
}
