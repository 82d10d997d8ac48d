//! Joins short gaps of smooth contours that nothing explains.
//!
//! In: the contours' pieces, told apart. Out: the same with gaps made visible, and how many these were. A gap is a run of hidden intervals along
//! one contour between two that are seen. It is joined if it is no longer than asked for, and if along all of it no face hides the line
//! that is more than two edges away from it or of another shell, and no cusp is within two edges: where something comes before the contour,
//! or it turns away, the gap is right. What `changes` counts is counted before.

use crate::lines::smooth::contour_visibility::{ContourIntervals, ContourLines};
use crate::lines::smooth::contours::Link;
use crate::lines::smooth::visibility_events::Cusps;
use serde::Serialize;

/// What was joined.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Healed {
    /// Gaps.
    pub gaps: usize,
    /// Their length together, pixels.
    pub length_px: f64,
}

/// A stretch by its piece's place among the decided and its own place in that.
type Place = (usize, usize);

impl ContourLines<'_> {
    /// Joins the gaps up to a length, pixels.
    pub(super) fn heal(&self, decided: &mut [ContourIntervals], longest_px: f64) -> Healed {
        let cusps = self.cusps();
        let mut by_piece: Vec<Option<usize>> = vec![None; self.contours.pieces.len()];
        for (index, decided) in decided.iter().enumerate() {
            by_piece[decided.piece] = Some(index);
        }
        let mut neighbours = vec![[None; 2]; self.contours.pieces.len()];
        for (number, Link { ends: [first, second], .. }) in self.contours.links.iter().enumerate() {
            if !cusps.links.contains(&number) {
                neighbours[first.0][first.1] = Some(*second);
                neighbours[second.0][second.1] = Some(*first);
            }
        }
        // The next stretch along the contour and the way on from there; none where the contour ends, has a cusp or leaves the picture.
        let next = |decided: &[ContourIntervals], (piece, interval): Place, forwards: bool| -> Option<(Place, bool)> {
            let of_piece = &decided[piece];
            let last = of_piece.intervals.len() - 1;
            match (forwards, interval) {
                (true, interval) if interval < last => return Some(((piece, interval + 1), true)),
                (false, 1..) => return Some(((piece, interval - 1), false)),
                _ => {}
            }
            let is_whole =
                if forwards { of_piece.intervals[last].to == 1.0 } else { of_piece.intervals[0].from == 0.0 };
            let (other, end) = neighbours[of_piece.piece][usize::from(forwards)].filter(|_| is_whole)?;
            let index = by_piece[other]?;
            let intervals = &decided[index].intervals;
            match end {
                0 if intervals[0].from == 0.0 => Some(((index, 0), true)),
                1 if intervals[intervals.len() - 1].to == 1.0 => Some(((index, intervals.len() - 1), false)),
                _ => None,
            }
        };
        let mut healed = Healed::default();
        for piece in 0..decided.len() {
            for interval in 0..decided[piece].intervals.len() {
                for forwards in [true, false] {
                    if !decided[piece].intervals[interval].is_visible {
                        continue;
                    }
                    let (mut gap, mut length_px) = (Vec::new(), 0.0);
                    let mut at = next(decided, (piece, interval), forwards);
                    let is_closed = loop {
                        let Some((place, way)) = at else { break false };
                        let of_piece = &decided[place.0];
                        let hidden = of_piece.intervals[place.1];
                        if hidden.is_visible {
                            break true;
                        }
                        length_px += of_piece.image.at(hidden.from).distance(of_piece.image.at(hidden.to));
                        if length_px > longest_px
                            || gap.contains(&place)
                            || !self.is_unexplained(of_piece, place.1, &cusps)
                        {
                            break false;
                        }
                        gap.push(place);
                        at = next(decided, place, way);
                    };
                    if is_closed && !gap.is_empty() {
                        gap.iter().for_each(|(piece, interval)| decided[*piece].intervals[*interval].is_visible = true);
                        healed.gaps += 1;
                        healed.length_px += length_px;
                    }
                }
            }
        }
        healed
    }

    /// Whether a hidden stretch is hidden for no reason that a smooth surface has.
    fn is_unexplained(&self, decided: &ContourIntervals, interval: usize, cusps: &Cusps) -> bool {
        let hidden = decided.intervals[interval];
        let piece = &self.contours.pieces[decided.piece];
        let probe = self.probe(piece, &decided.image, (hidden.from + hidden.to) * 0.5);
        let longest = self.contours.parts[piece.part as usize].longest_side(&self.lines.faces.positions, piece.face);
        let is_far = self.is_hidden_from_afar(&probe, piece.part, longest);
        !is_far && !cusps.are_near(probe.view, longest)
    }
}

#[cfg(test)]
mod tests {
    use crate::edges::{Class, SilhouetteRule};
    use crate::lines::smooth::closed_forms::ClosedForm;
    use crate::lines::smooth_tests::{camera, found, of_triangles, smooth};
    use crate::lines::{LineSettings, VisibleLines};
    use crate::mesh::Mesh;
    use crate::scene::{Scene, SceneSettings};
    use glam::DVec3;
    use std::sync::Arc;

    fn seen_px(lines: &VisibleLines) -> f64 {
        let seen = lines.segments.iter().filter(|line| line.class == Class::Silhouette && line.is_visible);
        seen.map(|line| line.ends_px[0].distance(line.ends_px[1])).sum()
    }

    fn scene(meshes: Vec<Mesh>, azimuth: f64, elevation: f64) -> Scene {
        let settings = SceneSettings { camera: camera(azimuth, elevation), ..SceneSettings::default() };
        Scene::new(meshes.into_iter().map(Arc::new).collect::<Vec<_>>(), &settings).unwrap()
    }

    fn healing(heal_px: f64) -> LineSettings {
        LineSettings { heal_px, ..smooth() }
    }

    #[test]
    fn joined_gaps_are_as_much_more_line_as_is_said_and_nothing_is_lost() {
        let mesh = ClosedForm::Torus { ring: 1.0, tube: 0.4 }.mesh(10_000, 0.2).unwrap();
        let mut gaps = 0;
        for view in 0..24 {
            let scene = scene(vec![mesh.clone()], f64::from(view) * 15.0 + 3.0, f64::from(view % 5) * 17.0 + 4.0);
            let (plain, healed) = (found(&scene, &healing(0.0)), found(&scene, &healing(8.0)));
            assert!(plain.healed.is_none());
            let what = healed.healed.unwrap();
            gaps += what.gaps;
            assert!(what.length_px <= 8.0 * what.gaps as f64, "{what:?}");
            assert!((seen_px(&healed) - seen_px(&plain) - what.length_px).abs() < 1e-6, "{what:?}");
            // Counted is what was found.
            assert_eq!(plain.changes, healed.changes);
        }
        assert!(gaps > 0);
    }

    #[test]
    fn what_comes_before_a_contour_keeps_its_gap() {
        let ball = ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(6_000, 0.0).unwrap();
        // A thin pole before it, across the view from the front.
        let corner = |x: f64, y: f64, z: f64| DVec3::new(x * 2.0, 0.02 * y, 1.6 + 0.02 * z);
        let corners: Vec<DVec3> = (0..8)
            .map(f64::from)
            .map(|n| {
                corner((n % 2.0) * 2.0 - 1.0, ((n / 2.0).floor() % 2.0) * 2.0 - 1.0, (n / 4.0).floor() * 2.0 - 1.0)
            })
            .collect();
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let scene = scene(vec![ball, of_triangles(corners, &triangles)], 0.0, 0.0);
        let (plain, healed) = (found(&scene, &healing(0.0)), found(&scene, &healing(50.0)));
        assert_eq!(plain.changes.as_ref().map(|changes| changes.crossings), Some(4));
        assert_eq!(healed.healed.map(|healed| healed.gaps), Some(0));
        assert_eq!(plain.segments, healed.segments);
    }

    #[test]
    fn lengths_that_are_none_and_other_rules_are_refused() {
        let scene = scene(vec![ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(500, 0.0).unwrap()], 0.0, 0.0);
        for heal_px in [-1.0, f64::NAN, f64::INFINITY] {
            let error = VisibleLines::of(&scene, &healing(heal_px)).unwrap_err().to_string();
            assert!(error.contains("heal"), "{error}");
        }
        let exact = LineSettings { silhouette: SilhouetteRule::Exact, ..healing(3.0) };
        let error = VisibleLines::of(&scene, &exact).unwrap_err().to_string();
        assert!(error.contains("silhouette"), "{error}");
    }
}
