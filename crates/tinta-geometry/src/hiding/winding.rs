//! How often a shell surrounds the space just outside its faces: 0 for one that is closed and the right way round, less for
//! one that is inside out.
//!
//! Faces that are not flagged form patches, and the number is the same everywhere outside a patch. It is counted along
//! lines parallel to the axes, in exact arithmetic: what a line meets above a point and what it meets below it must say the
//! same, and so must lines through several faces.

use super::flags::Hierarchy;
use super::groups::Groups;
use super::shells::{Shells, Surface};
use crate::bvh::{Box3, BoxTree};
use crate::threads::{cores, in_chunks};
use glam::DVec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Faces of a patch through which lines are tried, and lines that must agree.
const TRIED: usize = 24;
const AGREEING: usize = 3;

/// Faces below which a patch is not worth asking.
const SMALLEST_PATCH: usize = 4;

/// Patches that a thread takes at a time.
const PATCHES_AT_A_TIME: usize = 16;

/// Where in a face the line passes: no corner, no middle, so that it seldom meets another face's edge.
const WEIGHTS: [f64; 3] = [0.4142, 0.3173, 0.2685];

/// Whether each face lies in a patch whose outside its shell surrounds 0 times or more.
pub(super) fn faces_with_outside(
    surface: &Surface,
    shells: &Shells,
    hierarchy: &Hierarchy,
    flags: &[bool],
) -> Vec<bool> {
    let is_open = |face: u32| !flags[face as usize] && shells.is_sound(face);
    let mut groups = Groups::new(surface.triangles.len());
    for edge in 0..surface.edges.len() as u32 {
        if let [first, second] = *surface.edges.faces(edge)
            && is_open(first)
            && is_open(second)
        {
            groups.join(first, second);
        }
    }
    let (patch_of_face, count) = groups.numbers();
    // The faces of each patch together, by counting.
    let mut ends = vec![0usize; count + 1];
    patch_of_face.iter().for_each(|patch| ends[*patch as usize + 1] += 1);
    (0..count).for_each(|patch| ends[patch + 1] += ends[patch]);
    let starts = ends.clone();
    let mut faces = vec![0u32; patch_of_face.len()];
    for (face, patch) in patch_of_face.iter().enumerate() {
        faces[ends[*patch as usize]] = face as u32;
        ends[*patch as usize] += 1;
    }
    let large: Vec<usize> = (0..count).filter(|patch| starts[patch + 1] - starts[*patch] >= SMALLEST_PATCH).collect();
    let cap_boxes: Vec<Box3> = shells.caps.iter().map(|cap| Box3::around(surface.corners(cap.corners))).collect();
    let (caps, cap_order) = BoxTree::new(&cap_boxes);
    let lines = Lines { surface, shells, hierarchy, caps: &caps, cap_order: &cap_order };
    let is_outside = in_chunks(large.len(), PATCHES_AT_A_TIME, cores(), |patches| {
        let outside = |patch: &usize| lines.outside_of(&faces[starts[*patch]..starts[*patch + 1]]);
        large[patches].iter().map(|patch| outside(patch).is_some_and(|number| number >= 0)).collect::<Vec<_>>()
    });
    let mut may_hide = vec![false; surface.triangles.len()];
    for (patch, _) in large.iter().zip(is_outside.into_iter().flatten()).filter(|(_, is_outside)| *is_outside) {
        faces[starts[*patch]..starts[patch + 1]].iter().for_each(|face| may_hide[*face as usize] = is_open(*face));
    }
    may_hide
}

struct Lines<'a> {
    surface: &'a Surface,
    shells: &'a Shells,
    hierarchy: &'a Hierarchy,
    caps: &'a BoxTree,
    cap_order: &'a [u32],
}

impl Lines<'_> {
    /// How often the shell surrounds what is just outside a patch; `None` where lines disagree or too few can tell.
    fn outside_of(&self, patch: &[u32]) -> Option<i32> {
        let tried = TRIED.min(patch.len());
        let mut found = None;
        let mut agreeing = 0;
        for place in 0..tried {
            let Some(number) = self.outside_of_face(patch[place * patch.len() / tried]) else { continue };
            if *found.get_or_insert(number) != number {
                return None;
            }
            agreeing += 1;
            if agreeing == AGREEING {
                return found;
            }
        }
        None
    }

    /// Along the axis that is nearest to the face's normal; `None` where the line meets an edge, or counts differently above
    /// the face and below it.
    fn outside_of_face(&self, face: u32) -> Option<i32> {
        let corners = self.surface.corners(self.surface.triangles[face as usize]);
        let normal = self.surface.normals[face as usize];
        if normal == DVec3::ZERO {
            return None;
        }
        let axis = normal.abs().max_position();
        let point: DVec3 = corners.iter().zip(WEIGHTS).map(|(corner, weight)| *corner * weight).sum();
        let along = DVec3::AXES[axis] * f64::INFINITY;
        let along = DVec3::select(along.cmpgt(DVec3::ZERO), along, DVec3::ZERO);
        let column = Box3::new(point - along, point + along);
        let shell = self.shells.of_face[face as usize];
        let mut counts = Some([0, 0]);
        let mut meet = |triangle: [u32; 3]| {
            counts = counts.and_then(|[above, below]| {
                Some(match crossing(self.surface.corners(triangle), point, axis)? {
                    None => [above, below],
                    Some((true, turn)) => [above + turn, below],
                    Some((false, turn)) => [above, below - turn],
                })
            });
            counts.is_none()
        };
        self.hierarchy.tree.any(&column, |place| {
            let other = self.hierarchy.faces[place as usize];
            other != face
                && self.shells.of_face[other as usize] == shell
                && meet(self.surface.triangles[other as usize])
        });
        self.caps.any(&column, |place| {
            let cap = self.shells.caps[self.cap_order[place as usize] as usize];
            cap.shell == shell && meet(cap.corners)
        });
        let [above, below] = counts?;
        // On the side that the face turns its back to there is once more of the shell.
        let outside = if normal[axis] > 0.0 { [above, below - 1] } else { [above - 1, below] };
        (outside[0] == outside[1]).then_some(outside[0])
    }
}

/// How a line along an axis through a point meets a triangle: above the point or not, and 1 if it leaves through the
/// triangle's front upwards, else -1. `Some(None)` where it passes by, `None` where it passes through an edge.
fn crossing([a, b, c]: [DVec3; 3], point: DVec3, axis: usize) -> Option<Option<(bool, i32)>> {
    let flat = |p: DVec3| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] };
    let turn = |from, to| orient2d(flat(from), flat(to), flat(point));
    let turns = [turn(a, b), turn(b, c), turn(c, a)];
    if turns.iter().any(|turn| *turn > 0.0) && turns.iter().any(|turn| *turn < 0.0) {
        return Some(None);
    }
    if turns.contains(&0.0) {
        // In line with a side: passing by is certain only where the point is beyond the side's ends, which is rare enough.
        return None;
    }
    let [a, b, c, point] = [a, b, c, point].map(|DVec3 { x, y, z }| Coord3D { x, y, z });
    let behind = orient3d(a, b, c, point);
    if behind == 0.0 {
        return None;
    }
    let is_upwards = turns[0] > 0.0;
    // The point is behind a face that looks upwards, or in front of one that looks downwards: the face is above it.
    Some(Some(((behind > 0.0) == is_upwards, if is_upwards { 1 } else { -1 })))
}
