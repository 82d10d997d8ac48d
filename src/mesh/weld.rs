//! Vertices that lie on the same spot become one, so that faces share edges (errata D5).
//!
//! In: points and a distance. Out: for each point the first point (in the given order) it is welded to.
//! A sweep along one skew direction: a hash grid would be faster on huge clouds but needs 27 look-ups a point.

use crate::threads::{sort_by, threads_for};
use crate::tolerances::SWEEP_ROUNDING;
use glam::DVec3;

/// A direction no regular grid is aligned with, so that a flat or gridded model does not put all points in one window.
const SWEEP_DIRECTION: DVec3 = DVec3::new(0.577_215_664_9, 0.314_159_265_3, 0.753_664_137_1);

/// For each point the index of its representative: itself, or an earlier-swept point within `distance` of it.
///
/// `distance` is in the points' units; 0 welds only equal points. Non-finite points stay alone.
pub fn weld(points: &[DVec3], distance: f64) -> Vec<u32> {
    let mut representative: Vec<u32> = (0..points.len() as u32).collect();
    let mut sweep: Vec<(f64, u32)> = points
        .iter()
        .enumerate()
        .filter(|(_, point)| point.is_finite())
        .map(|(index, point)| (point.dot(SWEEP_DIRECTION), index as u32))
        .collect();
    // Ties go by index, so that the result does not depend on the sort.
    sort_by(&mut sweep, threads_for(points.len()), |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let largest = sweep.first().map_or(0.0, |first| first.0.abs()).max(sweep.last().map_or(0.0, |last| last.0.abs()));
    let reach = distance * SWEEP_DIRECTION.length() + largest * SWEEP_ROUNDING;
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
    lowest_first(&mut representative);
    representative
}

/// Renames every group after its lowest member, so that the first vertex of the file gives the position.
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
    fn non_finite_points_are_left_alone() {
        let nan = DVec3::new(f64::NAN, 0.0, 0.0);
        assert_eq!(weld(&[nan, DVec3::ZERO, nan, DVec3::ZERO], 1.0), [0, 1, 2, 1]);
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
