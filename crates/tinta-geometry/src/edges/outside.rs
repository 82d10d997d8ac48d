//! Finds the outside of each face, whatever its winding.
//!
//! In: a [`Mesh`] and its [`EdgeList`]. Out: for each face whether its front is outside. The faces of each closed shell are
//! turned to one orientation, and the sign of its volume tells the outside. A shell inside another one bounds a hollow: its
//! outside is the enclosed space. Open shells, and shells with an edge of three faces, keep the file's winding.

use super::{EdgeList, Incidence};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::Mesh;
use glam::DVec3;

/// A closed shell.
struct ClosedShell {
    /// Its faces, reversed where the second value says so.
    faces: Vec<(u32, bool)>,
    bounds: [DVec3; 2],
    /// Six times its volume, negative if its turned faces show their fronts inside.
    volume: f64,
}

/// Returns for each face whether its front is outside.
pub(super) fn fronts_outside(mesh: &Mesh, edges: &EdgeList) -> Vec<bool> {
    let mut is_outside = vec![true; mesh.triangles.len()];
    let shells = closed_shells(mesh, edges);
    for (number, shell) in shells.iter().enumerate() {
        let hollows =
            shells.iter().enumerate().filter(|(other, outer)| *other != number && outer.encloses(mesh, shell));
        let is_hollow = hollows.count() % 2 == 1;
        for (face, is_turned) in &shell.faces {
            is_outside[*face as usize] = ((shell.volume > 0.0) != *is_turned) != is_hollow;
        }
    }
    is_outside
}

/// Returns the closed shells that can be oriented by reversing some faces.
fn closed_shells(mesh: &Mesh, edges: &EdgeList) -> Vec<ClosedShell> {
    let count = mesh.triangles.len();
    // Each face twice, unchanged and reversed: connected ones share one orientation.
    let as_it_is = |face: u32| face;
    let turned = |face: u32| face + count as u32;
    let mut groups = DisjointSets::new(count * 2);
    let mut is_open = vec![false; count * 2];
    for edge in 0..edges.len() as u32 {
        match (edges.incidence()[edge as usize], edges.faces(edge)) {
            (Incidence::Inner, &[first, second]) => {
                groups.join([as_it_is(first), as_it_is(second)]);
                groups.join([turned(first), turned(second)]);
            }
            (Incidence::InnerReversed, &[first, second]) => {
                groups.join([as_it_is(first), turned(second)]);
                groups.join([turned(first), as_it_is(second)]);
            }
            (_, faces) => faces.iter().for_each(|face| is_open[*face as usize] = true),
        }
    }
    for face in 0..count as u32 {
        if is_open[face as usize] || groups.root(as_it_is(face)) == groups.root(turned(face)) {
            let [first, second] = [as_it_is(face), turned(face)].map(|node| groups.root(node));
            (is_open[first as usize], is_open[second as usize]) = (true, true);
        }
    }
    let (low, high) = mesh.bounds();
    let centre = low * 0.5 + high * 0.5;
    let mut shells: Vec<Option<ClosedShell>> = (0..count * 2).map(|_| None).collect();
    for face in 0..count as u32 {
        let roots = [as_it_is(face), turned(face)].map(|node| groups.root(node));
        if roots.into_iter().any(|root| is_open[root as usize]) {
            continue;
        }
        // Of a shell and its reverse one is enough: the one with the lower number.
        let is_turned = roots[1] < roots[0];
        let Some(corners) = mesh.corners(&mesh.triangles[face as usize]) else { continue };
        let [a, b, c] = corners.map(|corner| corner - centre);
        let volume = a.dot(b.cross(c)) * if is_turned { -1.0 } else { 1.0 };
        let [low, high] = [a.min(b).min(c) + centre, a.max(b).max(c) + centre];
        let new = || ClosedShell { faces: Vec::new(), bounds: [low, high], volume: 0.0 };
        let shell = shells[roots[0].min(roots[1]) as usize].get_or_insert_with(new);
        shell.faces.push((face, is_turned));
        shell.bounds = [shell.bounds[0].min(low), shell.bounds[1].max(high)];
        shell.volume += volume;
    }
    shells.into_iter().flatten().collect()
}

impl ClosedShell {
    /// Whether another shell lies within this one: whether a ray from one of its corners leaves this one an odd number of times.
    fn encloses(&self, mesh: &Mesh, other: &Self) -> bool {
        /// Along no axis and in no plane that models have.
        const AWAY: DVec3 = DVec3::new(0.537_912, 0.733_871, 0.414_877);
        let [[low, high], [other_low, other_high]] = [self.bounds, other.bounds];
        let is_within = low.cmple(other_low).all() && other_high.cmple(high).all();
        let Some((first, _)) = other.faces.first().filter(|_| is_within) else { return false };
        let of = |face: u32| mesh.corners(&mesh.triangles[face as usize]);
        let Some([from, ..]) = of(*first) else { return false };
        let is_crossed = |[a, b, c]: [DVec3; 3]| {
            let turn = |p: DVec3, q: DVec3| (p - from).cross(q - from).dot(AWAY);
            let turns = [turn(a, b), turn(b, c), turn(c, a)];
            let normal = (b - a).cross(c - a);
            let is_before = normal.dot(a - from) * normal.dot(AWAY) > 0.0;
            is_before && (turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0))
        };
        self.faces.iter().filter(|(face, _)| of(*face).is_some_and(is_crossed)).count() % 2 == 1
    }
}
