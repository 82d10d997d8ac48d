//! The shortest way along other strokes between the two ends of a [sliver's side](super). Strokes continue each other where they touch.

use super::strokes::{Branch, Strokes};
use crate::tolerances::JOINED_PX;
use glam::DVec2;

/// Most strokes near a side. Beyond that it stays, which bounds the cost in dense drawings; the public models have fewer.
const MOST_STROKES: usize = 64;

/// The way's ends, among the places that it may pass.
const FROM: usize = 0;
const TO: usize = 1;

/// A way to a place: its length, and the place and the stroke before it.
#[derive(Clone, Copy)]
struct Way {
    length: f64,
    from: usize,
    stroke: usize,
}

impl Strokes<'_> {
    /// The strokes of the shortest way between two places beside a branch, if they are as wide as it and the way is also too short;
    /// `None` if none exists.
    pub(super) fn way_around(
        &self,
        branch: &Branch,
        [from, to]: [DVec2; 2],
        may_use: impl Fn(usize) -> bool,
    ) -> Option<Vec<usize>> {
        let least = self.least(branch, |stroke| stroke.least_side);
        let width = branch.strokes.iter().map(|stroke| self.strokes[*stroke].width).fold(0.0, f64::max);
        let mut near = self.within(from.midpoint(to), least / 2.0);
        near.retain(|stroke| self.strokes[*stroke].width >= width && may_use(*stroke));
        if near.len() > MOST_STROKES {
            return None;
        }
        let is_between = |end: &DVec2| from.distance(*end) + end.distance(to) < least;
        let ends = near.iter().flat_map(|stroke| self.strokes[*stroke].ends).filter(is_between);
        let places: Vec<DVec2> = [from, to].into_iter().chain(ends).collect();
        let reach = |place: usize| if place <= TO { 2.0 * JOINED_PX } else { JOINED_PX };
        let on_stroke = |stroke: &usize| -> Vec<usize> {
            let is_on = |place: &usize| self.strokes[*stroke].distance(places[*place]) <= reach(*place);
            (0..places.len()).filter(is_on).collect()
        };
        let on_strokes: Vec<Vec<usize>> = near.iter().map(on_stroke).collect();

        let mut ways = vec![Way { length: f64::INFINITY, from: FROM, stroke: 0 }; places.len()];
        ways[FROM].length = 0.0;
        let mut is_shorter = true;
        while std::mem::take(&mut is_shorter) {
            for (&stroke, on_it) in near.iter().zip(&on_strokes) {
                for (&from, &next) in on_it.iter().flat_map(|from| on_it.iter().map(move |next| (from, next))) {
                    let length = ways[from].length + places[from].distance(places[next]);
                    if length < ways[next].length && length + places[next].distance(to) < least {
                        ways[next] = Way { length, from, stroke };
                        is_shorter = true;
                    }
                }
            }
        }
        let back = std::iter::successors(Some(TO), |place| Some(ways[*place].from)).take_while(|place| *place != FROM);
        ways[TO].length.is_finite().then(|| back.map(|place| ways[place].stroke).collect())
    }

    /// The strokes within this distance of a place, in order.
    fn within(&self, place: DVec2, distance: f64) -> Vec<usize> {
        let mut within = Vec::new();
        self.any_near([place; 2], distance, |stroke| {
            if self.strokes[stroke].distance(place) <= distance {
                within.push(stroke);
            }
            false
        });
        within.sort_unstable();
        within.dedup();
        within
    }
}
