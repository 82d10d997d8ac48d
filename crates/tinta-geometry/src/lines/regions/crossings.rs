//! The lines in which faces pass through one another, without tolerances: one too many does no harm, and none may be missing.

use crate::bvh::NodeSelection;
use crate::lines::eye::face_pair::FacePlane;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::threads::{cores, spread_chunks};
use glam::DVec3;

/// Returns the common lines of all pairs of these faces that have no side in common, in the eye's space. `is_seen` has a value for
/// each place. Incomplete once the time runs out.
pub(super) fn crossings(space: &Space, faces: &Faces, is_seen: &[bool], progress: &Progress) -> Vec<[DVec3; 2]> {
    let wanted = if is_seen.iter().all(|is| *is) { NodeSelection::default() } else { faces.tree.wanted(is_seen) };
    let node_pairs = faces.tree.node_pairs(&wanted);
    let found = spread_chunks(node_pairs.len(), 8, cores(), |range| {
        let (mut lines, mut pairs) = (Vec::new(), 0u32);
        let mut last: Option<FacePlane> = None;
        faces.tree.pairs_below(&node_pairs[range], &wanted, &mut |first, second| {
            pairs = pairs.wrapping_add(1);
            if is_seen[first as usize] && is_seen[second as usize] {
                let known = last.take().filter(|face_plane| face_plane.place == first);
                let face_plane = known.unwrap_or_else(|| FacePlane::exact(faces, first));
                let found = face_plane.meet(space, faces, second).filter(|found| found.is_line);
                lines.extend(found.map(|found| found.ends));
                last = Some(face_plane);
            }
            pairs.is_multiple_of(1024) && progress.is_over()
        });
        lines
    });
    found.concat()
}
