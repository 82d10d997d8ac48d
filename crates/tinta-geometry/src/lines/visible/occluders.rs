//! The faces that may hide lines, in small parts, for scenes with many overlapping faces.
//!
//! The box of a large diagonal face, or of a long thin one, is mostly empty: a search in front of a point would test most of the
//! scene. So faces are halved across their longest sides until their parts are short. Parts that the
//! [pyramid](crate::lines::eye::pyramid) hides are left out, because it hides everything behind them, too.
//!
//! The hierarchy leaves out faces seen edge-on. They have no image that could hide a line, and the lines in them overlap, where the
//! search for the nearest line finds them.

use crate::bvh::{Box3, BoxTree, Exclusion, Walk};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::pyramid::Pyramid;
use crate::lines::eye::space::Space;
use crate::threads::{cores, in_chunks};
use crate::thresholds::THRESHOLDS;
use glam::DVec3;

/// Parts of faces with the faces' places.
pub(in crate::lines) struct Occluders {
    tree: BoxTree,
    places: Vec<u32>,
}

impl Occluders {
    /// Collects the faces that are not edge-on, in parts.
    pub(in crate::lines) fn new(space: &Space, faces: &Faces, pyramid: Option<&Pyramid>) -> Self {
        let boxes = faces.tree.boxes();
        let longest = space.size.max_element() / THRESHOLDS.parts;
        let halvings = (THRESHOLDS.most_parts / boxes.len().max(1)).max(1).ilog2();
        let is_edge_on = |place: usize| faces.edge_on_for_sure.binary_search(&faces.numbers[place]).is_ok();
        let parts = in_chunks(boxes.len(), 256, cores(), |range| {
            let mut parts: Vec<(Box3, u32)> = Vec::new();
            for place in range.filter(|place| !is_edge_on(*place)) {
                if faces.cut_by_near.binary_search(&(place as u32)).is_ok() {
                    parts.push((boxes[place], place as u32));
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
                    let is_outside = low.truncate().cmpgt(space.size + 1.0).any()
                        || high.truncate().cmplt(glam::DVec2::splat(-1.0)).any();
                    if is_outside {
                        continue;
                    }
                    let lengths = [0, 1, 2].map(|side| corners[side].distance_squared(corners[(side + 1) % 3]));
                    let side = DVec3::from_array(lengths).max_position();
                    if count >= halvings || lengths[side] <= longest * longest {
                        parts.push((Box3::new(low, high), place as u32));
                        continue;
                    }
                    let [a, b, c] = [0, 1, 2].map(|step| corners[(side + step) % 3]);
                    let middle = (a + b) * 0.5;
                    open.extend([([a, middle, c], count + 1), ([middle, b, c], count + 1)]);
                }
            }
            parts
        })
        .concat();
        let (mut tree, order) = BoxTree::new(&parts.iter().map(|(around, _)| *around).collect::<Vec<Box3>>());
        let places: Vec<u32> = order.iter().map(|index| parts[*index as usize].1).collect();
        let groups = faces.groups().map(|of_places| {
            let has_some = !of_places.is_empty();
            let of_pieces = places.iter().filter(|_| has_some).map(|place| of_places[*place as usize]);
            of_pieces.collect::<Vec<u32>>()
        });
        tree.set_groups([&groups[0], &groups[1]]);
        Self { tree, places }
    }

    /// Walks as [`BoxTree::walk`] does in the faces' tree; a face may come several times.
    pub(in crate::lines) fn walk(&self, excluded: Exclusion, walk: &mut impl Walk) {
        self.tree.walk(excluded, &mut OfParts { places: &self.places, walk });
    }

    /// Searches as [`BoxTree::any_but`] does in the faces' tree; a face may come several times.
    pub(in crate::lines) fn any_but(
        &self,
        query: &Box3,
        excluded: Exclusion,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        self.tree.any_but(query, excluded, |part| visit(self.places[part as usize]))
    }
}

/// Adapts a walk over faces to their parts.
struct OfParts<'a, W> {
    places: &'a [u32],
    walk: &'a mut W,
}

impl<W: Walk> Walk for OfParts<'_, W> {
    fn enters(&self, around: &Box3) -> bool {
        self.walk.enters(around)
    }

    fn visit(&mut self, part: u32) -> bool {
        self.walk.visit(self.places[part as usize])
    }
}
