//! The lines in which faces pass through one another, without tolerances: one too many does no harm, and none may be missing.

use crate::bvh::NodeSelection;
use crate::lines::progress::Progress;
use crate::lines::visible::faces::Faces;
use crate::threads::{cores, spread_chunks};
use glam::DVec3;

/// Returns the common lines of all pairs of these faces that have no side in common, in the eye's space. `is_seen` has a value for
/// each place. Incomplete once the time runs out.
pub(super) fn crossings(faces: &Faces, is_seen: &[bool], progress: &Progress) -> Vec<[DVec3; 2]> {
    let wanted = if is_seen.iter().all(|is| *is) { NodeSelection::default() } else { faces.tree.wanted(is_seen) };
    let node_pairs = faces.tree.node_pairs(&wanted);
    let found = spread_chunks(node_pairs.len(), 8, cores(), |range| {
        let (mut lines, mut pairs) = (Vec::new(), 0u32);
        faces.tree.pairs_below(&node_pairs[range], &wanted, &mut |first, second| {
            pairs = pairs.wrapping_add(1);
            if is_seen[first as usize] && is_seen[second as usize] {
                lines.extend(crossing(faces, first, second));
            }
            pairs.is_multiple_of(1024) && progress.is_over()
        });
        lines
    });
    found.concat()
}

/// The common line of two faces.
fn crossing(faces: &Faces, first: u32, second: u32) -> Option<[DVec3; 2]> {
    let (one, other) = (faces.triangles[first as usize], faces.triangles[second as usize]);
    if one.iter().filter(|corner| other.contains(corner)).count() > 1 {
        return None;
    }
    let (a, b) = (faces.corners(first), faces.corners(second));
    let [across_a, across_b] = [a, b].map(|[a, b, c]| (b - a).cross(c - a));
    // A common corner lies in both planes.
    let height = |corner: DVec3, number: u32, plane: DVec3, at: DVec3, of_plane: [u32; 3]| {
        if of_plane.contains(&number) { 0.0 } else { plane.dot(corner - at) }
    };
    let of_b = [0, 1, 2].map(|corner| height(b[corner], other[corner], across_a, a[0], one));
    let in_b = in_plane(b, of_b)?;
    let of_a = [0, 1, 2].map(|corner| height(a[corner], one[corner], across_b, b[0], other));
    let in_a = in_plane(a, of_a)?;
    let along = across_a.cross(across_b);
    let ordered = |[from, to]: [DVec3; 2]| if along.dot(from) <= along.dot(to) { [from, to] } else { [to, from] };
    let ([a_from, a_to], [b_from, b_to]) = (ordered(in_a), ordered(in_b));
    let from = if along.dot(a_from) >= along.dot(b_from) { a_from } else { b_from };
    let to = if along.dot(a_to) <= along.dot(b_to) { a_to } else { b_to };
    (along.dot(from) < along.dot(to)).then_some([from, to])
}

/// The part of a triangle in a plane, where the corners have these heights above it; `None` where it has no length.
fn in_plane(corners: [DVec3; 3], heights: [f64; 3]) -> Option<[DVec3; 2]> {
    if heights.iter().all(|height| *height > 0.0) || heights.iter().all(|height| *height < 0.0) {
        return None;
    }
    let mut points = [DVec3::NAN; 3];
    let mut count = 0;
    for (corner, next) in [(0, 1), (1, 2), (2, 0)] {
        let (above, below) = (heights[corner], heights[next]);
        let point = if above == 0.0 {
            corners[corner]
        } else if above * below < 0.0 {
            corners[corner] + (corners[next] - corners[corner]) * (above / (above - below))
        } else {
            continue;
        };
        points[count] = point;
        count += 1;
    }
    (count == 2).then_some([points[0], points[1]])
}
