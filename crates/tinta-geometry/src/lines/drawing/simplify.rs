//! Removes the points of a polyline that do not change its shape.
//!
//! A cone of directions starts at each kept point, and each point passed narrows it. The straight line to the next
//! kept point therefore passes all of them within [`STRAIGHT_PX`]. Each point is visited once, O(n), without
//! recursion.

use crate::tolerances::STRAIGHT_PX;
use glam::DVec2;

/// Returns a polyline's points without those within [`STRAIGHT_PX`] of the straight lines between the others. The first
/// point stays, and an open polyline's last.
pub(in crate::lines) fn simplified(points_px: &[DVec2], is_closed: bool) -> Vec<DVec2> {
    simplified_places(points_px, is_closed).into_iter().map(|place| points_px[place]).collect()
}

/// The numbers of the points that [`simplified`] keeps.
pub(in crate::lines) fn simplified_places(points_px: &[DVec2], is_closed: bool) -> Vec<usize> {
    let Some(first) = points_px.first() else { return Vec::new() };
    let mut kept = vec![0];
    let mut cone = Cone::at(*first);
    let mut previous = *first;
    for (place, point) in points_px.iter().skip(1).chain(is_closed.then_some(first)).enumerate() {
        if !cone.contains(*point) {
            kept.push(place);
            cone = Cone::at(previous);
        }
        cone.narrow(*point);
        previous = *point;
    }
    if !is_closed {
        kept.push(points_px.len() - 1);
    } else if kept.len() == 1 && points_px.len() > 1 {
        // All turns are within the tolerance; a path needs at least two points.
        kept.push(1);
    }
    kept
}

/// The directions from a kept point that pass close enough to every point since.
struct Cone {
    apex: DVec2,
    /// Both borders, the left one first with y up; `None` while every direction is allowed.
    borders: Option<[DVec2; 2]>,
    /// The farthest point so far: a line that turns back is not straight.
    reach: f64,
}

impl Cone {
    fn at(apex: DVec2) -> Self {
        Self { apex, borders: None, reach: 0.0 }
    }

    /// Whether the line may go straight to this point.
    fn contains(&self, point: DVec2) -> bool {
        let away = point - self.apex;
        let is_between = |[low, high]: [DVec2; 2]| low.perp_dot(away) >= 0.0 && away.perp_dot(high) >= 0.0;
        away.length() >= self.reach && self.borders.is_none_or(is_between)
    }

    /// Keeps only directions that pass close to this point.
    fn narrow(&mut self, point: DVec2) {
        let away = point - self.apex;
        let distance = away.length();
        self.reach = self.reach.max(distance);
        if distance <= STRAIGHT_PX {
            return;
        }
        // The tangents from the apex to a circle around the point with the tolerance as radius.
        let sine = STRAIGHT_PX / distance;
        let cosine = (1.0 - sine * sine).sqrt();
        let direction = away / distance;
        let [low, high] = [DVec2::new(cosine, -sine), DVec2::new(cosine, sine)].map(|turn| turn.rotate(direction));
        self.borders = Some(match self.borders {
            None => [low, high],
            Some([old_low, old_high]) => [
                if old_low.perp_dot(low) > 0.0 { low } else { old_low },
                if old_high.perp_dot(high) < 0.0 { high } else { old_high },
            ],
        });
    }
}

/// The distance of a point from a straight line between two ends.
pub(super) fn distance([a, b]: [DVec2; 2], point: DVec2) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let share = if square > 0.0 { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + along * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[[f64; 2]]) -> Vec<DVec2> {
        points.iter().map(|point| DVec2::from_array(*point)).collect()
    }

    fn kept(points: &[[f64; 2]], is_closed: bool) -> Vec<[f64; 2]> {
        simplified(&path(points), is_closed).into_iter().map(|point| point.to_array()).collect()
    }

    #[test]
    fn points_on_a_straight_line_are_left_out_and_corners_stay() {
        let line = [[0.0, 0.0], [1.0, 1.0], [2.5, 2.5], [7.0, 7.0]];
        assert_eq!(kept(&line, false), [[0.0, 0.0], [7.0, 7.0]]);
        let corner = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0]];
        assert_eq!(kept(&corner, false), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]);
        let bend = [[0.0, 0.0], [1.0, 0.0021], [2.0, 0.0]];
        assert_eq!(kept(&bend, false).len(), 3);
        assert_eq!(kept(&[[0.0, 0.0], [1.0, 0.0005], [2.0, 0.0]], false).len(), 2);
    }

    #[test]
    fn a_line_that_comes_back_keeps_its_turn() {
        let there_and_back = [[0.0, 0.0], [5.0, 0.0], [3.0, 0.0]];
        assert_eq!(kept(&there_and_back, false), there_and_back);
        assert_eq!(kept(&[[0.0, 0.0], [5.0, 0.0], [0.0, 0.0]], false).len(), 3);
    }

    #[test]
    fn a_closed_path_stays_closed_around_its_corners() {
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
        assert_eq!(kept(&square, true), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert!(kept(&[[0.0, 0.0], [1e-4, 0.0]], true).len() >= 2);
    }

    #[test]
    fn a_circle_of_many_points_stays_within_the_tolerance_of_all_of_them() {
        let at = |k: u32| DVec2::from_angle(f64::from(k) / 20_000.0 * std::f64::consts::TAU) * 200.0;
        let points: Vec<[f64; 2]> = (0..20_000).map(|k| at(k).to_array()).collect();
        let corners = simplified(&path(&points), true);
        assert!((100..2_000).contains(&corners.len()), "{}", corners.len());
        let distance = |point: DVec2, a: DVec2, b: DVec2| {
            let share = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            point.distance(a + (b - a) * share)
        };
        for point in points.iter().step_by(7).map(|point| DVec2::from_array(*point)) {
            let nearest = (0..corners.len()).map(|k| distance(point, corners[k], corners[(k + 1) % corners.len()]));
            let nearest = nearest.fold(f64::MAX, f64::min);
            assert!(nearest <= STRAIGHT_PX * 1.000_001, "{nearest}");
        }
    }
}
