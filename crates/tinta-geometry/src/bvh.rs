//! A bounding volume hierarchy: finds the boxes that overlap a given one. Only this module uses the BVH crate.
//!
//! Boxes are f32, rounded outwards: they only find candidates, f64 decides.

use crate::ranges::between;
use crate::threads::{cores, in_chunks};
use crate::thresholds::THRESHOLDS;
use glam::{DVec3, Vec3A};
use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::cell::Cell;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Box3(Aabb);

impl Box3 {
    /// Returns the smallest box around points, rounded outwards.
    pub(crate) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let (low, high) = points
            .into_iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| (low.min(point), high.max(point)));
        Self::new(low, high)
    }

    /// Returns the box between two corners, rounded outwards.
    pub(crate) fn new(low: DVec3, high: DVec3) -> Self {
        // Where numbers overflow, nobody knows the corner, and the box is everywhere.
        let down = |x: f64| clamped(x, -FARTHEST).next_down();
        let up = |x: f64| clamped(x, FARTHEST).next_up();
        Self(Aabb {
            min: Vec3A::new(down(low.x), down(low.y), down(low.z)),
            max: Vec3A::new(up(high.x), up(high.y), up(high.z)),
        })
    }

    /// The lowest and the highest corner.
    pub(crate) fn corners(&self) -> [DVec3; 2] {
        [self.0.min, self.0.max].map(|corner| corner.as_dvec3())
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        self.0.intersect_aabb(&other.0)
    }
}

impl Boundable for Box3 {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// Wide enough for any search, with finite squares.
const FARTHEST: f64 = 1e15;

/// Limits a coordinate, or takes another if it is no number.
fn clamped(x: f64, other: f64) -> f32 {
    (if x.is_nan() { other } else { x.clamp(-FARTHEST, FARTHEST) }) as f32
}

/// Numbered things with a box each, in a hierarchy of boxes.
pub(crate) struct BoxTree {
    nodes: Bvh2,
    /// The boxes, leaf by leaf.
    boxes: Vec<Box3>,
    /// Each node's plane and vertex, if all things below it have the same one, else [`NO_GROUP`]; each list is empty without such
    /// groups.
    groups: [Vec<u32>; 2],
}

/// A search through a hierarchy, front to back.
pub(crate) trait Walk {
    /// Whether anything in a box matters.
    fn enters(&self, around: &Box3) -> bool;

    /// Visits a thing; true ends the walk.
    fn visit(&mut self, place: u32) -> bool;
}

/// A straight line in the space of the boxes, its places from 0 to 1.
#[derive(Clone, Copy)]
pub(crate) struct Line3 {
    from: DVec3,
    along: DVec3,
    margin: f64,
    slack: f64,
    around: Box3,
}

impl Line3 {
    /// Creates a line. It meets boxes within `margin` of it in the first two directions. In the third it meets those that begin
    /// before it, or at most `slack` behind it.
    pub(crate) fn new([from, to]: [DVec3; 2], margin: f64, slack: f64) -> Self {
        let wide = DVec3::new(margin, margin, 0.0);
        let (low, high) = (from.min(to) - wide, from.max(to) + wide);
        let around = Box3::new(low.with_z(f64::NEG_INFINITY), high.with_z(high.z + slack));
        Self { from, along: to - from, margin, slack, around }
    }

    /// Whether the line's own box meets a box.
    pub(crate) fn is_near(&self, around: &Box3) -> bool {
        self.around.overlaps(around)
    }

    /// Returns the range of the line that is in a box or behind it.
    pub(crate) fn range(&self, around: &Box3) -> Option<[f64; 2]> {
        let [low, high] = around.corners();
        let (low, high) = (low - self.from, high - self.from);
        let mut range = [0.0, 1.0];
        for axis in 0..2 {
            let limits = [low[axis] - self.margin, high[axis] + self.margin];
            range = between(range, 0.0, self.along[axis], limits)?;
        }
        let (nearest, along) = (low.z - self.slack, self.along.z);
        match along {
            0.0 if nearest > 0.0 => return None,
            0.0 => {}
            _ if along > 0.0 => range[0] = range[0].max(nearest / along),
            _ => range[1] = range[1].min(nearest / along),
        }
        (range[0] <= range[1]).then_some(range)
    }
}

/// The nodes of a hierarchy with wanted things below them: all nodes by default.
#[derive(Default)]
pub(crate) struct NodeSelection(Vec<u32>);

impl NodeSelection {
    fn any_below(&self, node: u32) -> bool {
        group(&self.0, node) == NO_GROUP
    }
}

/// The group of things that belong to none.
pub(crate) const NO_GROUP: u32 = u32::MAX;

/// Two planes and two vertices whose things a search leaves out; [`NO_GROUP`] leaves out nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Exclusion(pub [[u32; 2]; 2]);

impl Default for Exclusion {
    fn default() -> Self {
        Self([[NO_GROUP; 2]; 2])
    }
}

impl Exclusion {
    /// Excludes things in planes.
    pub(crate) fn planes(planes: [u32; 2]) -> Self {
        Self([planes, [NO_GROUP; 2]])
    }
}

impl BoxTree {
    /// Builds the hierarchy over boxes in time n log n. Returns it with the boxes' numbers in its own order. The hierarchy refers
    /// to things by their places in that order: callers that store things in it keep neighbours together.
    pub(crate) fn new(boxes: &[Box3]) -> (Self, Vec<u32>) {
        Self::new_unless(boxes, || false)
    }

    /// Builds the hierarchy as [`BoxTree::new`] does, or an empty one once `is_over` returns true.
    pub(crate) fn new_unless(boxes: &[Box3], is_over: impl Fn() -> bool + Sync) -> (Self, Vec<u32>) {
        let batches = batches(boxes, &is_over);
        let mut batches = in_chunks(batches.len(), 1, cores(), |range| match is_over() {
            true => Bvh2::default(),
            false => built(boxes, &batches[range.start]),
        });
        if is_over() {
            return Self::new(&[]);
        }
        let mut nodes = if batches.len() == 1 { batches.swap_remove(0) } else { joined(&batches) };
        nodes.parents = Vec::new();
        let order = std::mem::take(&mut nodes.primitive_indices);
        let boxes = order.iter().map(|index| boxes[*index as usize]).collect();
        (Self { boxes, nodes, groups: Default::default() }, order)
    }

    /// The things' boxes, by their places.
    pub(crate) fn boxes(&self) -> &[Box3] {
        &self.boxes
    }

    /// Sets the plane and the high-valence vertex of the thing at each place; empty lists set nothing. [`BoxTree::pairs`]
    /// then leaves out pairs of one group, and takes no time over them. [`BoxTree::any_but`] leaves out things in given groups.
    pub(crate) fn set_groups(&mut self, groups: [&[u32]; 2]) {
        self.groups = groups.map(|of_places| if of_places.is_empty() { Vec::new() } else { self.of_nodes(of_places) });
    }

    /// Whether all below a node is in excluded groups.
    fn is_left_out(&self, node: u32, excluded: Exclusion) -> bool {
        self.groups.iter().zip(excluded.0).any(|(groups, excluded)| {
            let group = group(groups, node);
            group != NO_GROUP && excluded.contains(&group)
        })
    }

    /// Whether all below two nodes is in one group.
    fn are_of_one(&self, [first, second]: [u32; 2]) -> bool {
        let is_common = |groups: &Vec<u32>| {
            let group_of_first = group(groups, first);
            group_of_first != NO_GROUP && group_of_first == group(groups, second)
        };
        self.groups.iter().any(is_common)
    }

    /// Selects the nodes with wanted things below them. `is_wanted` has a value for each place.
    pub(crate) fn wanted(&self, is_wanted: &[bool]) -> NodeSelection {
        const UNWANTED: u32 = 0;
        let groups: Vec<u32> = is_wanted.iter().map(|is| if *is { NO_GROUP } else { UNWANTED }).collect();
        NodeSelection(self.of_nodes(&groups))
    }

    /// Returns each node's group, if all things below it are in that group, else [`NO_GROUP`].
    fn of_nodes(&self, group_of: &[u32]) -> Vec<u32> {
        let nodes = &self.nodes.nodes;
        let mut groups = vec![NO_GROUP; nodes.len()];
        let common = |first: u32, second: u32| if first == second { first } else { NO_GROUP };
        // Parents come before their children here. The next loop goes backwards and meets each node after its children.
        let mut order: Vec<u32> = if nodes.is_empty() { Vec::new() } else { vec![0] };
        let mut next = 0;
        while let Some(&index) = order.get(next) {
            let node = &nodes[index as usize];
            if !node.is_leaf() {
                order.extend([node.first_index, node.first_index + 1]);
            }
            next += 1;
        }
        for index in order.into_iter().rev() {
            let node = &nodes[index as usize];
            let first = node.first_index as usize;
            groups[index as usize] = if node.is_leaf() {
                let things = &group_of[range(node.first_index, node.prim_count)];
                things.iter().copied().reduce(common).unwrap_or(NO_GROUP)
            } else {
                common(groups[first], groups[first + 1])
            };
        }
        groups
    }

    /// Calls `visit` with each thing whose box overlaps `query` until it returns true; returns whether it did.
    pub(crate) fn any(&self, query: &Box3, visit: impl FnMut(u32) -> bool) -> bool {
        self.any_but(query, Exclusion::default(), visit)
    }

    /// Searches as [`BoxTree::any`] does, but leaves out whole leaves of excluded groups.
    pub(crate) fn any_but(&self, query: &Box3, excluded: Exclusion, mut visit: impl FnMut(u32) -> bool) -> bool {
        let nodes = &self.nodes.nodes;
        if nodes.is_empty() || !nodes[0].aabb().intersect_aabb(&query.0) {
            return false;
        }
        let mut open = Stack::default();
        if !self.is_left_out(0, excluded) {
            open.push(0);
        }
        let (mut steps, mut is_found) = (0, false);
        while let Some(index) = open.pop() {
            let node = &nodes[index as usize];
            steps += 1;
            if node.is_leaf() {
                steps += u64::from(node.prim_count);
                is_found = range(node.first_index, node.prim_count)
                    .any(|place| query.overlaps(&self.boxes[place]) && visit(place as u32));
                if is_found {
                    break;
                }
                continue;
            }
            for child in [node.first_index, node.first_index + 1] {
                if nodes[child as usize].aabb().intersect_aabb(&query.0) && !self.is_left_out(child, excluded) {
                    open.push(child);
                }
            }
        }
        add_steps(steps);
        is_found
    }

    /// Shows a walk the things whose boxes it enters, the nearer of two nodes first. Leaves out whole nodes of excluded groups.
    pub(crate) fn walk(&self, excluded: Exclusion, walk: &mut impl Walk) {
        let nodes = &self.nodes.nodes;
        let is_left_out = |node: u32| self.is_left_out(node, excluded);
        if nodes.is_empty() || is_left_out(0) || !walk.enters(&Box3(*nodes[0].aabb())) {
            return;
        }
        let mut open = Stack::default();
        open.push(0);
        let mut steps = 0;
        'walk: while let Some(index) = open.pop() {
            let node = &nodes[index as usize];
            steps += 1;
            if node.is_leaf() {
                steps += u64::from(node.prim_count);
                for place in range(node.first_index, node.prim_count) {
                    if walk.enters(&self.boxes[place]) && walk.visit(place as u32) {
                        break 'walk;
                    }
                }
                continue;
            }
            let (first, second) = (node.first_index, node.first_index + 1);
            let [one, other] = [first, second].map(|child| Box3(*nodes[child as usize].aabb()));
            let [enters_first, enters_second] =
                [walk.enters(&one) && !is_left_out(first), walk.enters(&other) && !is_left_out(second)];
            match (enters_first, enters_second) {
                (true, true) if one.0.min.z <= other.0.min.z => {
                    [second, first].into_iter().for_each(|child| open.push(child))
                }
                (true, true) => [first, second].into_iter().for_each(|child| open.push(child)),
                (true, false) => open.push(first),
                (false, true) => open.push(second),
                (false, false) => {}
            }
        }
        add_steps(steps);
    }

    /// Calls `visit` with each pair of things whose boxes overlap, the lower place first, once.
    pub(crate) fn pairs(&self, mut visit: impl FnMut(u32, u32) -> bool) -> bool {
        self.pairs_below(&[[0, 0]], &NodeSelection::default(), &mut visit)
    }

    /// Returns pairs of nodes that together hold all pairs of things with overlapping boxes: enough of them to share among
    /// threads.
    pub(crate) fn node_pairs(&self, wanted: &NodeSelection) -> Vec<[u32; 2]> {
        let mut pairs = vec![[0, 0]];
        while !self.nodes.nodes.is_empty() && pairs.len() < THRESHOLDS.node_pairs {
            let mut next = Vec::with_capacity(2 * pairs.len());
            for pair in &pairs {
                self.halves(*pair, wanted, |half| next.push(half));
            }
            if next.len() == pairs.len() {
                break;
            }
            pairs = next;
        }
        pairs
    }

    /// Pushes the pairs of nodes just below two nodes: the two themselves where both are leaves, none where no wanted pair lies
    /// below.
    fn halves(&self, [first, second]: [u32; 2], wanted: &NodeSelection, mut push: impl FnMut([u32; 2])) {
        let [a, b] = [first, second].map(|node| &self.nodes.nodes[node as usize]);
        let is_unwanted = !wanted.any_below(first) || !wanted.any_below(second);
        if is_unwanted || self.are_of_one([first, second]) || !a.aabb().intersect_aabb(b.aabb()) {
            return;
        }
        match (a.is_leaf(), b.is_leaf()) {
            (true, true) => push([first, second]),
            (false, _) if first == second => {
                let [left, right] = [a.first_index, a.first_index + 1];
                [[left, left], [right, right], [left, right]].into_iter().for_each(push);
            }
            (false, is_leaf) if is_leaf || a.aabb().half_area() >= b.aabb().half_area() => {
                [a.first_index, a.first_index + 1].into_iter().for_each(|child| push([child, second]));
            }
            _ => [b.first_index, b.first_index + 1].into_iter().for_each(|child| push([first, child])),
        }
    }

    /// Calls `visit` with each pair of things that overlap below the given pairs of nodes, the lower place first, until it
    /// returns true. Returns whether it did. Leaves out whole nodes around one high-valence vertex or in one plane, and nodes
    /// without wanted things.
    pub(crate) fn pairs_below(
        &self,
        node_pairs: &[[u32; 2]],
        wanted: &NodeSelection,
        visit: &mut impl FnMut(u32, u32) -> bool,
    ) -> bool {
        if self.nodes.nodes.is_empty() {
            return false;
        }
        let (mut open, mut steps, mut is_found) = (node_pairs.to_vec(), 0u64, false);
        while let Some(pair) = open.pop() {
            steps += 1;
            let [a, b] = pair.map(|node| &self.nodes.nodes[node as usize]);
            if !(a.is_leaf() && b.is_leaf()) {
                self.halves(pair, wanted, |half| open.push(half));
                continue;
            }
            let mut is_left_out = true;
            self.halves(pair, wanted, |_| is_left_out = false);
            if is_left_out {
                continue;
            }
            let (a, b) = if a.first_index <= b.first_index { (a, b) } else { (b, a) };
            let (firsts, seconds) = (range(a.first_index, a.prim_count), range(b.first_index, b.prim_count));
            steps += (firsts.len() + seconds.len()) as u64;
            let around = Box3(*b.aabb());
            is_found = firsts.filter(|first| self.boxes[*first].overlaps(&around)).any(|first| {
                (seconds.start.max(first + 1)..seconds.end)
                    .any(|second| self.boxes[first].overlaps(&self.boxes[second]) && visit(first as u32, second as u32))
            });
            if is_found {
                break;
            }
        }
        add_steps(steps);
        is_found
    }
}

/// A stack of node numbers. The first ones need no allocation.
struct Stack {
    few: [u32; 64],
    count: usize,
    more: Vec<u32>,
}

impl Default for Stack {
    fn default() -> Self {
        Self { few: [0; 64], count: 0, more: Vec::new() }
    }
}

impl Stack {
    fn push(&mut self, node: u32) {
        match self.few.get_mut(self.count) {
            Some(place) => {
                *place = node;
                self.count += 1;
            }
            None => self.more.push(node),
        }
    }

    fn pop(&mut self) -> Option<u32> {
        self.more.pop().or_else(|| {
            self.count = self.count.checked_sub(1)?;
            Some(self.few[self.count])
        })
    }
}

thread_local! {
    static STEPS: Cell<u64> = const { Cell::new(0) };
}

/// Adds other tests to the count of tested boxes.
pub(crate) fn add_steps(count: u64) {
    STEPS.set(STEPS.get().wrapping_add(count));
}

/// Returns the count of boxes that this thread has tested, in all hierarchies.
pub(crate) fn steps() -> u64 {
    STEPS.get()
}

/// Runs work on this thread. Returns its result and the count of boxes that it tested.
pub(crate) fn counting_steps<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = steps();
    let result = work();
    (result, steps().wrapping_sub(before))
}

/// Returns a node's group; [`NO_GROUP`] without groups.
fn group(groups: &[u32], node: u32) -> u32 {
    groups.get(node as usize).copied().unwrap_or(NO_GROUP)
}

/// Splits the things' numbers into batches that are built at once, neighbours together: halves them in the middle of their
/// longest extent.
fn batches(boxes: &[Box3], is_over: impl Fn() -> bool) -> Vec<Vec<u32>> {
    let middle = |number: &u32| boxes[*number as usize].0.center();
    let mut open: Vec<Vec<u32>> = vec![(0..boxes.len() as u32).collect()];
    let mut done = Vec::new();
    while let Some(mut numbers) = open.pop() {
        if numbers.len() <= THRESHOLDS.built_at_once || is_over() {
            done.push(numbers);
            continue;
        }
        let (low, high) = numbers
            .iter()
            .map(middle)
            .fold((Vec3A::INFINITY, Vec3A::NEG_INFINITY), |(low, high), middle| (low.min(middle), high.max(middle)));
        let axis = (high - low).max_position();
        let half = numbers.len() / 2;
        numbers.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
        let rest = numbers.split_off(half);
        open.extend([rest, numbers]);
    }
    done
}

/// Builds the hierarchy of some of the things.
fn built(boxes: &[Box3], numbers: &[u32]) -> Bvh2 {
    let own: Vec<Box3> = numbers.iter().map(|number| boxes[*number as usize]).collect();
    let mut nodes = hierarchy(&own);
    collapse(&mut nodes, THRESHOLDS.largest_leaf, THRESHOLDS.step_cost);
    // Until here, indices count within the batch.
    nodes.primitive_indices.iter_mut().for_each(|place| *place = numbers[*place as usize]);
    nodes
}

fn hierarchy(boxes: &[Box3]) -> Bvh2 {
    let numbers = (0..boxes.len() as u32).collect();
    PlocBuilder::with_capacity(boxes.len()).build(PlocSearchDistance::Minimum, boxes, numbers, SortPrecision::U64, 0)
}

/// Joins hierarchies: builds a hierarchy of their roots and puts one of them in place of each leaf.
fn joined(batches: &[Bvh2]) -> Bvh2 {
    let roots: Vec<Box3> = batches.iter().map(|batch| Box3(*batch.nodes[0].aabb())).collect();
    let mut whole = hierarchy(&roots);
    let batch_of = std::mem::take(&mut whole.primitive_indices);
    for top in 0..whole.nodes.len() {
        if !whole.nodes[top].is_leaf() {
            continue;
        }
        let batch = &batches[batch_of[whole.nodes[top].first_index as usize] as usize];
        // The batch's root replaces the leaf; its other nodes go to the end.
        let (first_node, first_thing) = (whole.nodes.len() as u32 - 1, whole.primitive_indices.len() as u32);
        let mut moved = batch.nodes.iter().map(|node| Bvh2Node {
            first_index: node.first_index + if node.is_leaf() { first_thing } else { first_node },
            ..*node
        });
        whole.nodes[top] = moved.next().unwrap_or_default();
        whole.nodes.extend(moved);
        whole.primitive_indices.extend_from_slice(&batch.primitive_indices);
    }
    whole
}

fn range(first: u32, count: u32) -> std::ops::Range<usize> {
    first as usize..(first + count) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_box_of_a_long_row_is_found_and_each_pair_of_neighbours_once() {
        // Each a little longer than the one before and touching the next.
        let ends: Vec<f64> = (0..=40_000).map(|step| 1.000_1f64.powi(step)).collect();
        let corner = |x: f64, side: f64| DVec3::new(x, side, side);
        let boxes: Vec<Box3> =
            ends.windows(2).map(|pair| Box3::new(corner(pair[0], -1.0), corner(pair[1], 1.0))).collect();
        let (tree, order) = BoxTree::new(&boxes);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..boxes.len() as u32).collect::<Vec<u32>>());
        for wanted in (0..boxes.len()).step_by(997) {
            let middle = corner((ends[wanted] + ends[wanted + 1]) * 0.5, 0.0);
            let mut found = Vec::new();
            tree.any(&Box3::around([middle]), |place| {
                found.push(order[place as usize] as usize);
                false
            });
            assert_eq!(found, [wanted]);
        }
        let mut pairs = Vec::new();
        tree.pairs(|first, second| {
            let [a, b] = [first, second].map(|place| order[place as usize]);
            pairs.push((a.min(b), a.max(b)));
            false
        });
        pairs.sort_unstable();
        assert_eq!(pairs, (1..boxes.len() as u32).map(|next| (next - 1, next)).collect::<Vec<_>>());
    }
}
