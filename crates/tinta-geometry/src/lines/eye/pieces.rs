//! Pieces of lines or faces in a tree: the box of a long diagonal one is mostly empty, that of its pieces less so.

use crate::bvh::{Box3, BoxTree, Exclusion, Line3, NO_GROUP, Walk};
use crate::lines::progress::Progress;
use crate::ranges::meet;

/// Pieces of lines or faces with their boxes, and the number of each one's line or face.
#[derive(Default)]
pub(in crate::lines) struct Pieces {
    boxes: Vec<Box3>,
    numbers: Vec<u32>,
    /// The plane and the high-valence vertex of each; empty without groups.
    groups: [Vec<u32>; 2],
}

/// Pieces in a tree, for searches. One that meets several pieces of a line or face finds it as often.
pub(in crate::lines) struct PieceTree {
    tree: BoxTree,
    numbers: Vec<u32>,
}

impl Pieces {
    /// The count of pieces.
    pub(in crate::lines) fn len(&self) -> usize {
        self.boxes.len()
    }

    /// Adds another's pieces.
    pub(in crate::lines) fn append(&mut self, other: Self) {
        self.boxes.extend(other.boxes);
        self.numbers.extend(other.numbers);
        self.groups.iter_mut().zip(other.groups).for_each(|(all, more)| all.extend(more));
    }

    /// Adds a piece.
    pub(in crate::lines) fn add(&mut self, around: Box3, number: usize) {
        self.boxes.push(around);
        self.numbers.push(number as u32);
    }

    /// Adds a piece of a group of faces in a plane, and of one around a vertex.
    pub(in crate::lines) fn add_of_groups(&mut self, around: Box3, number: usize, of_piece: [u32; 2]) {
        self.add(around, number);
        self.groups.iter_mut().zip(of_piece).for_each(|(groups, group)| groups.push(group));
    }

    /// Builds their tree; an empty one if the time runs out.
    pub(in crate::lines) fn tree(self, progress: &Progress) -> PieceTree {
        let (mut tree, order) = BoxTree::new_unless(&self.boxes, || progress.is_over());
        if order.len() < self.boxes.len() {
            return PieceTree { tree, numbers: Vec::new() };
        }
        let [planes, vertices] = self.groups.map(|groups| {
            let has_some = groups.iter().any(|group| *group != NO_GROUP);
            order.iter().filter(|_| has_some).map(|index| groups[*index as usize]).collect::<Vec<u32>>()
        });
        tree.set_groups([&planes, &vertices]);
        PieceTree { tree, numbers: order.iter().map(|index| self.numbers[*index as usize]).collect() }
    }
}

impl PieceTree {
    /// Calls `visit` with the number of each piece in `query`, until it returns true; returns whether it did.
    pub(in crate::lines) fn any(&self, query: &Box3, visit: impl FnMut(usize) -> bool) -> bool {
        self.any_but(query, Exclusion::default(), visit)
    }

    /// The same without whole leaves of excluded groups.
    pub(in crate::lines) fn any_but(
        &self,
        query: &Box3,
        excluded: Exclusion,
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        self.tree.any_but(query, excluded, |place| visit(self.numbers[place as usize] as usize))
    }

    /// Shows a walk the numbers of pieces. Leaves out whole nodes of excluded groups.
    pub(in crate::lines) fn walk(&self, excluded: Exclusion, walk: &mut impl Walk) {
        self.tree.walk(excluded, &mut OfPieces { numbers: &self.numbers, walk });
    }

    /// Calls `visit` with each line that may cross a stretch of another, until it returns true; returns whether it did. Leaves out
    /// whole nodes of excluded groups.
    pub(in crate::lines) fn any_along(
        &self,
        line: Line3,
        stretch: [f64; 2],
        excluded: Exclusion,
        visit: impl FnMut(usize) -> bool,
    ) -> bool {
        let mut walk = StretchWalk { line, stretch, visit, is_found: false };
        self.walk(excluded, &mut walk);
        walk.is_found
    }
}

/// Adapts a walk over lines or faces to their pieces.
struct OfPieces<'a, W> {
    numbers: &'a [u32],
    walk: &'a mut W,
}

impl<W: Walk> Walk for OfPieces<'_, W> {
    fn enters(&self, around: &Box3) -> bool {
        self.walk.enters(around)
    }

    fn visit(&mut self, place: u32) -> bool {
        self.walk.visit(self.numbers[place as usize])
    }
}

/// The walk along a stretch of a line.
struct StretchWalk<F> {
    line: Line3,
    stretch: [f64; 2],
    visit: F,
    is_found: bool,
}

impl<F: FnMut(usize) -> bool> Walk for StretchWalk<F> {
    fn enters(&self, around: &Box3) -> bool {
        self.line.is_near(around) && self.line.range(around).is_some_and(|range| meet(self.stretch, range))
    }

    fn visit(&mut self, line: u32) -> bool {
        self.is_found = (self.visit)(line as usize);
        self.is_found
    }
}
