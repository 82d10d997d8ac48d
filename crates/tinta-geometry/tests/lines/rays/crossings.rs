//! Whether lines are where faces pass through one another.

use super::{Face, RayFindings, Rays};
use crate::support::lines::{pierce, px};
use glam::DVec3;
use tinta::lines::VisibleLines;
use tinta::tolerances::CONTACT;

impl Rays<'_> {
    /// Asserts that a segment passes through the image of each point that two faces clearly have in common.
    pub(super) fn check_crossings(&self, lines: &VisibleLines, found: &mut RayFindings) {
        for (number, first) in self.faces.iter().enumerate() {
            for second in &self.faces[..number] {
                if first.low.cmpgt(second.high).any() || second.low.cmpgt(first.high).any() {
                    continue;
                }
                let Some(ends) = crossing(first, second).and_then(|ends| self.clipped(ends)) else { continue };
                for share in [0.02, 0.27, 0.5, 0.81, 0.98] {
                    let image = px(self.scene, self.at(ends, share));
                    found.crossings += 1;
                    if !lines.segments.iter().any(|piece| self.nearest(piece, image).is_some()) {
                        found.wrong.push(format!(
                            "no line where {:?} and {:?} cross at {image}",
                            first.numbers, second.numbers
                        ));
                    }
                }
            }
        }
    }
}

/// The line along which two faces pass through one another; `None` too where a corner of either touches the other, since the rule
/// for contacts then decides.
fn crossing(first: &Face, second: &Face) -> Option<[DVec3; 2]> {
    let shared: Vec<DVec3> = first.corners.into_iter().filter(|corner| second.corners.contains(corner)).collect();
    let touches = |one: &Face, other: &Face| {
        let reach = 3.0 * CONTACT * one.longest.max(other.longest).max(1.0);
        let near = |corner: &DVec3| other.normal.dot(*corner - other.corners[0]).abs() < reach;
        one.corners.iter().any(|corner| !shared.contains(corner) && near(corner))
    };
    if shared.len() > 1 || touches(first, second) || touches(second, first) {
        return None;
    }
    let mut points = shared.clone();
    for (own, other) in [(first, second), (second, first)] {
        for side in 0..3 {
            let [a, b] = [own.corners[side], own.corners[(side + 1) % 3]];
            if !shared.contains(&a) && !shared.contains(&b) {
                let share = pierce(a, b - a, other.corners).filter(|share| (0.0..=1.0).contains(share));
                points.extend(share.map(|share| a.lerp(b, share)));
            }
        }
    }
    let &[a, b] = points.as_slice() else { return None };
    (a.distance(b) > 2.0 * CONTACT).then_some([a, b])
}
