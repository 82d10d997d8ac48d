//! Welds vertices at the same place, for faces to share edges (errata D5).
//!
//! In: points and a distance. Out: for each point the first point (in the given order) it is welded to. Points are swept along
//! one skew direction. If a model lies across that direction, a hash grid replaces the sweep, at 27 look-ups a point.

use crate::threads::{sort_by, threads_for};
use crate::tolerances::SWEEP_ROUNDING;
use glam::DVec3;
use std::collections::HashMap;

/// A direction not aligned with any regular grid, which keeps a flat or gridded model's points from sharing one window.
const SWEEP_DIRECTION: DVec3 = DVec3::new(0.577_215_664_9, 0.314_159_265_3, 0.753_664_137_1);

/// Most pairs per point compared in the sweep; with more, the grid is used, which is slower for ordinary models.
const PAIRS_A_POINT: usize = 64;

/// Narrowest cell of the grid, as a share of the points' extent: its coordinates are whole numbers that f64 holds.
const SMALLEST_CELL: f64 = 1e-15;

/// Returns for each point the index of its representative: itself, or an earlier-swept point within `distance` of it.
///
/// `distance` is in the points' units; 0 welds only equal points. Non-finite points stay alone.
pub(crate) fn weld(points: &[DVec3], distance: f64) -> Vec<u32> {
    // Equal points have the same representative, so one of them is enough.
    let mut representative = earlier_equals(points);
    let mut sweep: Vec<(f64, u32)> = points
        .iter()
        .enumerate()
        .filter(|(index, point)| representative[*index] as usize == *index && point.is_finite())
        .map(|(index, point)| (point.dot(SWEEP_DIRECTION), index as u32))
        .collect();
    // Ties go by index, which makes the result independent of the sort.
    let threads = threads_for(sweep.len());
    sort_by(&mut sweep, threads, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let largest = sweep.first().map_or(0.0, |first| first.0.abs()).max(sweep.last().map_or(0.0, |last| last.0.abs()));
    let reach = distance * SWEEP_DIRECTION.length() + largest * SWEEP_ROUNDING;
    if pairs_within(&sweep, reach) > sweep.len() * PAIRS_A_POINT {
        weld_by_cells(points, &sweep, distance, &mut representative);
    } else {
        weld_by_sweep(points, &sweep, reach, distance, &mut representative);
    }
    for index in 0..representative.len() {
        // The representative of the earlier equal point, or else its own.
        representative[index] = representative[representative[index] as usize];
    }
    lowest_first(&mut representative);
    representative
}

/// Returns for each point an earlier equal point that has none itself, or else the point. Only the latest points are compared,
/// because triangles that share a corner mostly follow one another; the welding does not depend on it.
fn earlier_equals(points: &[DVec3]) -> Vec<u32> {
    const SLOTS: usize = 1 << 16;
    // For each slot, the rest of its latest point's hash, and the point's number.
    let mut slots = vec![(0u32, u32::MAX); SLOTS];
    let mut equal = Vec::with_capacity(points.len());
    for (number, point) in (0u32..).zip(points) {
        // A zero has two signs.
        let mixed = (*point + DVec3::ZERO).to_array().into_iter().fold(0u64, |hash, x| {
            // 2^64 over the golden ratio.
            (hash.rotate_left(29) ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        });
        let (slot, rest) = (&mut slots[(mixed >> 48) as usize % SLOTS], (mixed >> 16) as u32);
        // A NaN equals no point.
        if slot.0 == rest && slot.1 != u32::MAX && points[slot.1 as usize] == *point {
            equal.push(slot.1);
        } else {
            *slot = (rest, number);
            equal.push(number);
        }
    }
    equal
}

/// Returns the number of pairs of points at most `reach` apart along the sweep.
fn pairs_within(sweep: &[(f64, u32)], reach: f64) -> usize {
    let (mut window_start, mut pairs) = (0, 0usize);
    for (current, (along, _)) in sweep.iter().enumerate() {
        while along - sweep[window_start].0 > reach {
            window_start += 1;
        }
        pairs = pairs.saturating_add(current - window_start);
    }
    pairs
}

fn weld_by_sweep(points: &[DVec3], sweep: &[(f64, u32)], reach: f64, distance: f64, representative: &mut [u32]) {
    let mut window_start = 0;
    for current in 0..sweep.len() {
        let (along, index) = sweep[current];
        while along - sweep[window_start].0 > reach {
            window_start += 1;
        }
        let found = sweep[window_start..current]
            .iter()
            .map(|&(_, earlier)| earlier)
            .filter(|&earlier| representative[earlier as usize] == earlier)
            .find(|&earlier| points[earlier as usize].distance(points[index as usize]) <= distance);
        if let Some(earlier) = found {
            representative[index as usize] = earlier;
        }
    }
}

/// Gives the same result with a hash grid, for many points side by side across the sweep.
fn weld_by_cells(points: &[DVec3], sweep: &[(f64, u32)], distance: f64, representative: &mut [u32]) {
    let low = sweep.iter().fold(DVec3::INFINITY, |low, (_, index)| low.min(points[*index as usize]));
    // Twice the necessary width: rounding never puts neighbours two cells apart. Without a distance only equal points are
    // welded, which lie in one cell of any grid.
    let high = sweep.iter().fold(low, |high, (_, index)| high.max(points[*index as usize]));
    let width = (2.0 * distance).max((high - low).max_element() * SMALLEST_CELL);
    let cell = |point: DVec3| ((point - low) / width).to_array().map(|coordinate| coordinate as i64);
    let mut kept: HashMap<[i64; 3], Vec<(u32, u32)>> = HashMap::new();
    for (rank, (_, index)) in (0u32..).zip(sweep) {
        let point = points[*index as usize];
        let [x, y, z] = cell(point);
        let neighbours = (0..27).map(|n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        let near = neighbours.filter_map(|cell| kept.get(&cell)).flatten();
        let near = near.filter(|(_, earlier)| points[*earlier as usize].distance(point) <= distance);
        match near.min() {
            Some((_, earlier)) => representative[*index as usize] = *earlier,
            None => kept.entry([x, y, z]).or_default().push((rank, *index)),
        }
    }
}

/// Renames every group after its lowest member: the first vertex of the file gives the position.
fn lowest_first(representative: &mut [u32]) {
    let mut lowest: Vec<u32> = (0..representative.len() as u32).collect();
    for (index, &group) in representative.iter().enumerate() {
        let slot = &mut lowest[group as usize];
        *slot = (*slot).min(index as u32);
    }
    for group in representative.iter_mut() {
        *group = lowest[*group as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_are_welded_to_the_first_of_them() {
        let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, 4.0));
        assert_eq!(weld(&[a, b, a, b, a], 0.0), [0, 1, 0, 1, 0]);
    }

    #[test]
    fn points_are_welded_up_to_the_distance_and_not_beyond() {
        let points = [DVec3::ZERO, DVec3::new(0.9e-3, 0.0, 0.0), DVec3::new(0.0, 1.1e-3, 0.0)];
        assert_eq!(weld(&points, 1e-3), [0, 0, 2]);
        assert_eq!(weld(&points, 0.5e-3), [0, 1, 2]);
    }

    #[test]
    fn points_of_which_most_are_repeated_are_welded_as_if_each_were_swept() {
        // Three times each, in clusters, with zeros of both signs and numbers that are not finite; then the same so far apart
        // in the list that equal ones are not found at once.
        let number = |i: i32, by: i32, of: i32| f64::from(i * by % of) * if i % 2 == 0 { -1e-3 } else { 1e-3 };
        let some = (0..300).map(|i| DVec3::new(number(i, 31, 97), number(i, 17, 5), number(i, 7, 83)));
        let mut points: Vec<DVec3> = some.flat_map(|point| [point, -(-point + 0.0), point]).collect();
        points.extend([DVec3::NAN, DVec3::INFINITY, DVec3::NAN]);
        let others: Vec<DVec3> = (0..1 << 20).map(|i| DVec3::new(9.0, f64::from(i), 0.0)).collect();
        let thirds = [0, 1, 2].map(|third| points.iter().skip(third).step_by(3).copied().collect::<Vec<DVec3>>());
        let apart = [&thirds[0][..], &others, &thirds[1], &others, &thirds[2]].concat();
        let place = |index: usize| index / 3 + (index % 3) * (thirds[0].len() + others.len());
        let found_at_once =
            |points: &[DVec3]| earlier_equals(points).into_iter().zip(0..).filter(|(a, b)| a != b).count();
        assert!(found_at_once(&points) >= 600);
        assert!(found_at_once(&apart) < others.len() + 10, "the others are equal to one another, and nothing else");
        for distance in [0.0, 1e-3, 0.02] {
            let (near, far) = (weld(&points, distance), weld(&apart, distance));
            for index in 0..points.len() {
                assert_eq!(place(near[index] as usize), far[place(index)] as usize, "{index} at {distance}");
            }
        }
    }

    #[test]
    fn non_finite_points_are_left_alone() {
        let nan = DVec3::new(f64::NAN, 0.0, 0.0);
        assert_eq!(weld(&[nan, DVec3::ZERO, nan, DVec3::ZERO], 1.0), [0, 1, 2, 1]);
    }

    #[test]
    fn sweep_and_grid_weld_the_same_points() {
        // Three dozen clusters of points that are a little apart: the order decides which are welded.
        let points: Vec<DVec3> = (0..600)
            .map(|i| {
                let at = DVec3::new(f64::from(i % 7), f64::from(i % 5), 0.0);
                at + DVec3::new(f64::from(i * 31 % 97), f64::from(i * 17 % 89), f64::from(i * 7 % 83)) * 1e-3
            })
            .collect();
        let mut sweep: Vec<(f64, u32)> =
            points.iter().zip(0..).map(|(point, index)| (point.dot(SWEEP_DIRECTION), index)).collect();
        sweep.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (distance, fewest, most) in [(0.0, 600, 600), (0.02, 40, 599), (0.3, 35, 80), (9.0, 1, 2)] {
            let whole: Vec<u32> = (0..600).collect();
            let (mut by_sweep, mut by_cells) = (whole.clone(), whole);
            weld_by_sweep(&points, &sweep, distance * SWEEP_DIRECTION.length() + 1e-12, distance, &mut by_sweep);
            weld_by_cells(&points, &sweep, distance, &mut by_cells);
            assert_eq!(by_sweep, by_cells, "{distance}");
            let groups = by_cells.iter().collect::<std::collections::BTreeSet<_>>().len();
            assert!((fewest..=most).contains(&groups), "{distance}: {groups} groups");
        }
    }

    #[test]
    fn a_hundred_thousand_points_across_the_sweep_are_not_compared_with_each_other() {
        let across = SWEEP_DIRECTION.normalize().any_orthonormal_pair();
        let at = |i: u32| across.0 * f64::from(i % 300) + across.1 * f64::from(i / 300);
        let points: Vec<DVec3> = (0..100_000).map(at).collect();
        let welded = weld(&points, 1e-5);
        assert!(welded.iter().zip(0..).all(|(to, index)| *to == index), "none lies near another");
    }

    #[test]
    fn welding_agrees_with_comparing_every_pair() {
        // Clusters far smaller than the distance, far apart: welding is then transitive and the answer unique.
        let points: Vec<DVec3> = (0..400)
            .map(|i| {
                let cluster = f64::from(i * 37 % 50);
                DVec3::new(cluster, (cluster * 1.7).sin() * 9.0, 0.0) + DVec3::splat(f64::from(i % 3) * 1e-9)
            })
            .collect();
        let expected: Vec<u32> = (0..points.len())
            .map(|i| (0..=i).find(|&j| points[j].distance(points[i]) < 1e-6).unwrap_or(i) as u32)
            .collect();
        assert_eq!(weld(&points, 1e-6), expected);
    }
}
