//! The faces that may hide lines, in small pieces, for scenes with many overlapping faces.
//!
//! The box of a large diagonal face, or of a long thin one, is mostly empty: a search in front of a point would test most of the
//! scene. So faces are halved across their longest sides until their pieces are short. Pieces that the
//! [pyramid](crate::lines::eye::pyramid) hides are left out, because it hides everything behind them, too.
//!
//! The hierarchy leaves out faces seen edge-on. They have no image that could hide a line, and the lines in them overlap, where the
//! search for the nearest line finds them.

use crate::bvh::{Box3, NO_GROUP};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::pieces::{PieceTree, Pieces};
use crate::lines::eye::pyramid::Pyramid;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::threads::{cores, in_chunks};
use crate::thresholds::THRESHOLDS;
use crate::tolerances::MARGIN_PX;
use glam::{DVec2, DVec3};

/// The faces that are not edge-on, in pieces.
pub(in crate::lines) fn occluders(
    space: &Space,
    faces: &Faces,
    pyramid: Option<&Pyramid>,
    progress: &Progress,
) -> PieceTree {
    let groups = faces.groups();
    let add = |pieces: &mut Pieces, around: Box3, place: usize| {
        let group = |of_places: &[u32]| of_places.get(place).copied().unwrap_or(NO_GROUP);
        pieces.add_of_groups(around, place, [group(&groups[0]), group(&groups[1])]);
    };
    let boxes = faces.tree.boxes();
    let longest = space.size.max_element() / THRESHOLDS.pieces;
    let halvings = (THRESHOLDS.most_pieces / boxes.len().max(1)).max(1).ilog2();
    let is_edge_on = |place: usize| faces.edge_on_for_sure.binary_search(&faces.numbers[place]).is_ok();
    let pieces = in_chunks(boxes.len(), 256, cores(), |range| {
        let mut pieces = Pieces::default();
        for place in range.filter(|place| !is_edge_on(*place)) {
            if faces.cut_by_near.binary_search(&(place as u32)).is_ok() {
                add(&mut pieces, boxes[place], place);
                continue;
            }
            let corners = faces.corners(place as u32).map(|corner| {
                let (px, key) = space.project(corner);
                px.extend(key)
            });
            let mut open = vec![(corners, 0)];
            while let Some((corners, count)) = open.pop() {
                let (low, high) = crate::mesh::bounds(&corners);
                if pyramid.is_some_and(|pyramid| pyramid.hides(low.truncate(), high.truncate(), low.z)) {
                    continue;
                }
                let is_outside = low.truncate().cmpgt(space.size + MARGIN_PX).any()
                    || high.truncate().cmplt(-DVec2::splat(MARGIN_PX)).any();
                if is_outside {
                    continue;
                }
                let lengths = [0, 1, 2].map(|side| corners[side].distance_squared(corners[(side + 1) % 3]));
                let side = DVec3::from_array(lengths).max_position();
                if count >= halvings || lengths[side] <= longest * longest {
                    add(&mut pieces, Box3::new(low, high), place);
                    continue;
                }
                let [a, b, c] = [0, 1, 2].map(|step| corners[(side + step) % 3]);
                let middle = (a + b) * 0.5;
                open.extend([([a, middle, c], count + 1), ([middle, b, c], count + 1)]);
            }
        }
        pieces
    });
    let mut all = Pieces::default();
    pieces.into_iter().for_each(|some| all.append(some));
    all.tree(progress)
}
