//! Traces lines through a face from the values at its three corners.

use crate::lines::smooth::contours::between;
use crate::tolerances::{CREST_SHARPNESS, THROUGH_VERTEX};
use glam::DVec3;

pub(super) struct Corners {
    /// The vertices' numbers: a side begins at its lower vertex, whichever face it is traced from.
    pub numbers: [usize; 3],
    /// Positions in eye space.
    pub view: [DVec3; 3],
}

/// A point of a line, with the values that must be above 0 for the line to be drawn there.
#[derive(Clone, Copy)]
struct End {
    view: DVec3,
    tests: [f64; 2],
}

/// The curvature at a vertex for ridges.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Crest {
    /// The curvature, 1 / length.
    pub strength: f64,
    /// The direction of largest curvature, a unit vector with arbitrary sign.
    pub direction: DVec3,
    /// The growth of the strength along the direction. The sign of a 0 counts too, so a crest through vertices has no
    /// gaps.
    pub growth: f64,
}

impl Crest {
    /// Returns it with the strength times 1 or -1.
    pub(super) fn times(self, sign: f64) -> Self {
        Self { strength: self.strength * sign, growth: self.growth * sign, ..self }
    }
}

impl Corners {
    /// A side from its lower to its higher vertex.
    fn side(&self, corner: usize) -> [usize; 2] {
        let next = (corner + 1) % 3;
        if self.numbers[corner] <= self.numbers[next] { [corner, next] } else { [next, corner] }
    }

    /// A place on a side, or its end if that is close by. Segments around a vertex that are too short to draw then
    /// leave no gap.
    fn at(&self, [from, to]: [usize; 2], share: f64, tests: &[[f64; 3]; 2]) -> End {
        let share = match share {
            share if share < THROUGH_VERTEX => 0.0,
            share if share > 1.0 - THROUGH_VERTEX => 1.0,
            share => share,
        };
        let tests = tests.map(|test| test[from] + (test[to] - test[from]) * share);
        End { view: between(self.view[from], self.view[to], share), tests }
    }
}

/// The line in a face where a linear function with these corner values is 0, clipped to where both tests are above 0.
/// A corner value of 0 counts as above; a face with no value below 0 has no line.
pub(super) fn zero_set(corners: &Corners, values: [f64; 3], tests: [[f64; 3]; 2]) -> Option<[DVec3; 2]> {
    let is_above = values.map(|value| value >= 0.0);
    if is_above == [true; 3]
        || is_above == [false; 3]
        || tests.iter().any(|test| test.iter().all(|value| *value <= 0.0))
    {
        return None;
    }
    let mut ends = (0..3).filter_map(|corner| {
        let [from, to] = corners.side(corner);
        let share = values[from] / (values[from] - values[to]);
        (is_above[from] != is_above[to]).then(|| corners.at([from, to], share, &tests))
    });
    clipped([ends.next()?, ends.next()?])
}

/// The lines in a face where the strength is largest across them, clipped to where it is above `least` (Ohtake et al.
/// 2004). A line crosses a side if the strength stops growing between its ends. Three crossings meet in the middle.
/// `place` gives the corners in the mesh's space.
///
/// The whole face decides whether the strength has a maximum or a minimum, and whether it is significant. Along a
/// side that a crest follows, rounding alone would decide on which side it crosses.
pub(super) fn crests(
    corners: &Corners,
    place: impl Fn() -> [DVec3; 3],
    at: [Crest; 3],
    least: f64,
    mut add: impl FnMut([DVec3; 2]),
) {
    if at.iter().any(|at| at.strength <= 0.0) || at.iter().all(|at| at.strength <= least) {
        return;
    }
    let turns = |[from, to]: [usize; 2]| {
        // The signs of both directions are arbitrary.
        let is_turned = at[from].direction.dot(at[to].direction) < 0.0;
        (at[from].growth.is_sign_negative() != at[to].growth.is_sign_negative()) != is_turned
    };
    let sides = [0, 1, 2].map(|corner| corners.side(corner));
    let crossed = sides.map(turns);
    if crossed.iter().filter(|is_crossed| **is_crossed).count() < 2 {
        return;
    }
    let place = place();
    let (mut falls, mut sharpest) = (0.0, 0.0f64);
    for ([from, to], is_crossed) in sides.into_iter().zip(crossed) {
        let along = place[to] - place[from];
        let strength = 0.5 * (at[from].strength + at[to].strength);
        sharpest = sharpest.max((at[from].growth.abs() + at[to].growth.abs()) / (along.length() * strength.powi(3)));
        if is_crossed {
            falls += (at[from].direction * at[from].growth - at[to].direction * at[to].growth).dot(along);
        }
    }
    // If the curvature is almost constant along its own direction, as on pipes, a crest would be rounding only.
    if falls <= 0.0 || sharpest <= CREST_SHARPNESS {
        return;
    }
    let tests = [at.map(|at| at.strength - least), [1.0; 3]];
    let crossing = |[from, to]: [usize; 2]| {
        let (first, second) = (at[from].growth.abs(), at[to].growth.abs());
        let share = if first + second > 0.0 { first / (first + second) } else { 0.5 };
        corners.at([from, to], share, &tests)
    };
    let mut ends = sides.into_iter().zip(crossed).filter(|(_, is_crossed)| *is_crossed).map(|(side, _)| crossing(side));
    match (ends.next(), ends.next(), ends.next()) {
        (Some(first), Some(second), None) => clipped([first, second]).into_iter().for_each(add),
        (Some(a), Some(b), Some(c)) => {
            let strength = (a.tests[0] + b.tests[0] + c.tests[0]) / 3.0;
            let middle = End { view: (a.view + b.view + c.view) / 3.0, tests: [strength, 1.0] };
            [a, b, c].into_iter().filter_map(|end| clipped([end, middle])).for_each(&mut add);
        }
        _ => {}
    }
}

/// The part of a segment where both tests are above 0.
fn clipped([from, to]: [End; 2]) -> Option<[DVec3; 2]> {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for (first, second) in from.tests.into_iter().zip(to.tests) {
        let share = first / (first - second);
        match (first > 0.0, second > 0.0) {
            (true, true) => {}
            (true, false) => end = end.min(share),
            (false, true) => start = start.max(share),
            (false, false) => return None,
        }
    }
    (start < end).then(|| [start, end].map(|share| between(from.view, to.view, share)))
}
