//! Faces that come near another part of their own shell: of them it is never said that something else hides them.

use super::distance::{Triangle, come_near, cross_beyond_corner};
use super::shells::{Shells, Surface};
use crate::bvh::{Box3, BoxTree};
use crate::threads::{cores, in_chunks};
use glam::DVec3;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Groups of the hierarchy's boxes that a thread takes at a time.
const GROUPS_AT_A_TIME: usize = 512;

/// Caps that a thread takes at a time.
const CAPS_AT_A_TIME: usize = 64;

/// Boxes that all caps together may meet, and those one may meet in any case: a cap as large as the whole shell, which an
/// open sheet has, meets all of its faces, and nothing would be gained by asking them all.
const BOXES_OF_CAPS: usize = 4_000_000;
const BOXES_OF_A_CAP: usize = 256;

/// Pairs of boxes that meet, as a multiple of the faces, beyond which nothing is said to be hidden: a sound mesh has a dozen or
/// two, a fan of a hundred thousand faces around one point has as many thousands, and takes minutes.
const PAIRS_OF_A_FACE: usize = 200;

/// Pairs that a thread counts by itself before it says so.
const PAIRS_AT_A_TIME: usize = 4096;

/// The faces of sound shells by their boxes, which are half the thickness larger all around: where two overlap the faces
/// may come near each other.
pub(super) struct Hierarchy {
    pub tree: BoxTree,
    /// The face at each place of the tree.
    pub faces: Vec<u32>,
}

impl Hierarchy {
    pub(super) fn new(surface: &Surface, shells: &Shells, thickness: f64) -> Self {
        let faces: Vec<u32> = (0..surface.triangles.len() as u32).filter(|face| shells.is_sound(*face)).collect();
        let box_of = |face: &u32| inflated(&surface.corners(surface.triangles[*face as usize]), thickness * 0.5);
        let boxes: Vec<Box3> = faces.iter().map(box_of).collect();
        let (tree, order) = BoxTree::new(&boxes);
        Self { tree, faces: order.into_iter().map(|index| faces[index as usize]).collect() }
    }
}

fn inflated(corners: &[DVec3; 3], by: f64) -> Box3 {
    let (low, high) = crate::mesh::bounds(corners);
    Box3::new(low - by, high + by)
}

/// Each face that comes within `thickness` of a face or cap of its shell with which it shares no corner, or that passes
/// through one with which it shares one. A shell whose caps are too large to ask is no longer sound.
pub(super) fn flagged(surface: &Surface, shells: &mut Shells, hierarchy: &Hierarchy, thickness: f64) -> Vec<bool> {
    let flags: Vec<AtomicBool> = surface.triangles.iter().map(|_| AtomicBool::new(false)).collect();
    let is_set = |face: u32| flags[face as usize].load(Ordering::Relaxed);
    let set = |face: u32| flags[face as usize].store(true, Ordering::Relaxed);
    let face_of = |face: u32| {
        let points = surface.triangles[face as usize];
        (points, Triangle { corners: surface.corners(points), normal: surface.normals[face as usize] })
    };
    let Hierarchy { tree, faces } = hierarchy;
    let most_pairs = faces.len().saturating_mul(PAIRS_OF_A_FACE);
    let pairs = AtomicUsize::new(0);
    let too_many = in_chunks(tree.batch_count(), GROUPS_AT_A_TIME, cores(), |groups| {
        let mut own = 0;
        tree.pairs(groups, |first, second| {
            own += 1;
            if own % PAIRS_AT_A_TIME == 0 && pairs.fetch_add(PAIRS_AT_A_TIME, Ordering::Relaxed) > most_pairs {
                return true;
            }
            let [first, second] = [first, second].map(|place| faces[place as usize]);
            let is_one_shell = shells.of_face[first as usize] == shells.of_face[second as usize];
            let is_open = is_one_shell && !(is_set(first) && is_set(second));
            if is_open && are_too_near(&face_of(first), &face_of(second), thickness) {
                set(first);
                set(second);
            }
            false
        })
    });
    if too_many.contains(&true) {
        shells.list.iter_mut().for_each(|shell| shell.is_sound = false);
        return vec![true; surface.triangles.len()];
    }
    let most_boxes = (BOXES_OF_CAPS / shells.caps.len().max(1)).max(BOXES_OF_A_CAP);
    let too_large = in_chunks(shells.caps.len(), CAPS_AT_A_TIME, cores(), |caps| {
        let mut too_large = Vec::new();
        for cap in &shells.caps[caps] {
            let mut boxes = 0;
            let of_cap = (cap.corners, Triangle::new(surface.corners(cap.corners)));
            let is_too_large = tree.any(&inflated(&surface.corners(cap.corners), thickness * 0.5), |place| {
                let face = faces[place as usize];
                if shells.of_face[face as usize] == cap.shell
                    && !is_set(face)
                    && are_too_near(&face_of(face), &of_cap, thickness)
                {
                    set(face);
                }
                boxes += 1;
                boxes > most_boxes
            });
            if is_too_large {
                too_large.push(cap.shell);
            }
        }
        too_large
    });
    for shell in too_large.into_iter().flatten() {
        shells.list[shell as usize].is_sound = false;
    }
    flags.into_iter().map(AtomicBool::into_inner).collect()
}

/// By their points and where these lie.
fn are_too_near(first: &([u32; 3], Triangle), second: &([u32; 3], Triangle), thickness: f64) -> bool {
    let ((points_first, first), (points_second, second)) = (first, second);
    match points_first.iter().filter(|point| points_second.contains(point)).count() {
        0 => come_near(first, second, thickness),
        1 => {
            let opposite = |points: &[u32; 3], triangle: &Triangle, others: &[u32; 3]| {
                let shared = points.iter().position(|point| others.contains(point)).unwrap_or(0);
                [1, 2].map(|next| triangle.corners[(shared + next) % 3])
            };
            let opposite_first = opposite(points_first, first, points_second);
            let opposite_second = opposite(points_second, second, points_first);
            cross_beyond_corner(first, opposite_first, second, opposite_second)
        }
        // Over a shared side they meet elsewhere only if they lie on one another: then one shows its front.
        _ => false,
    }
}
