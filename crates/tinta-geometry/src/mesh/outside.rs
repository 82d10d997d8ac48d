//! Pairs of faces that lie on each other where an eye outside may see them: not inside a solid, as where closed boxes touch.
//!
//! In: a mesh's triangles, and pairs of them. Out: some of the pairs. A line through a point inside a solid leaves surfaces more often
//! than it enters them, by the same number at both ends.

use crate::bvh::{Box3, BoxTree};
use glam::{DMat3, DVec3};

/// Returns the pairs that are not inside the solids of the faces in no pair.
pub(super) fn pairs(triangles: &[[u32; 3]], positions: &[DVec3], all: Vec<[u32; 2]>) -> Vec<[u32; 2]> {
    if all.is_empty() {
        return all;
    }
    let mut is_paired = vec![false; triangles.len()];
    all.as_flattened().iter().for_each(|face| is_paired[*face as usize] = true);
    let rest: Vec<u32> = (0..triangles.len() as u32).filter(|face| !is_paired[*face as usize]).collect();
    if rest.is_empty() {
        return all;
    }
    // The line runs along no axis and in no plane that models have.
    let turn = DMat3::from_rotation_x(0.537_912) * DMat3::from_rotation_y(0.733_871);
    let origin = positions[triangles[0][0] as usize];
    let corners = |face: u32| triangles[face as usize].map(|corner| turn * (positions[corner as usize] - origin));
    let boxes: Vec<Box3> = rest.iter().map(|face| Box3::around(corners(*face))).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let is_outside = |pair: &[u32; 2]| {
        let middle = corners(pair[0]).into_iter().sum::<DVec3>() / 3.0;
        let line = Box3::new(middle.with_z(f64::NEG_INFINITY), middle.with_z(f64::INFINITY));
        // How often the line leaves surfaces more than it enters them, below the point and above.
        let mut left = [0; 2];
        tree.any(&line, |place| {
            let [a, b, c] = corners(rest[order[place as usize] as usize]).map(|corner| corner - middle);
            let turns = [(a, b), (b, c), (c, a)].map(|(p, q)| p.truncate().perp_dot(q.truncate()));
            let is_to_above = turns[0] > 0.0;
            if turns.iter().all(|turn| *turn != 0.0 && (*turn > 0.0) == is_to_above) {
                let is_above = (a.dot((b - a).cross(c - a)) > 0.0) == is_to_above;
                left[usize::from(is_above)] += if is_above == is_to_above { 1 } else { -1 };
            }
            false
        });
        left[0] == 0 || left[0] != left[1]
    };
    all.into_iter().filter(is_outside).collect()
}
