//! A planar map: the cells into which segments cut the plane.
//!
//! In: segments of the grid that meet only at their ends. Out: half-edges, the loops they form, and the cells that the loops
//! bound. A half-edge has its cell on its left, with y up. A loop around a cell runs counter-clockwise; a loop around a hole, or
//! around a whole component from outside, runs clockwise.

use super::snap::{Point, Segment, turn};
use crate::bvh::{Box3, BoxTree};
use crate::disjoint_sets::DisjointSets;
use crate::threads::{cores, sort_by};
use glam::DVec2;
use std::cmp::Ordering;

/// Marks the plane outside all cells.
pub(super) const OUTSIDE: u32 = u32::MAX;

/// Half-edge `2 * e` runs along segment `e`, and `2 * e + 1` against it.
pub(super) struct PlanarMap {
    pub points: Vec<Point>,
    /// Two points each.
    pub edges: Vec<[u32; 2]>,
    /// For each half-edge the one that follows it around its cell.
    next: Vec<u32>,
    /// For each half-edge its cell, or [`OUTSIDE`].
    pub cells: Vec<u32>,
    /// A half-edge of each loop, cell by cell, the outer loop of a cell first. Loops that bound the outside are left out.
    loops: Vec<u32>,
    /// Where the loops of each cell begin, and their end.
    starts: Vec<u32>,
    /// Twice the area inside each cell's outer loop less that of its holes, grid steps squared.
    pub areas: Vec<i128>,
    /// Number of connected components.
    pub components: usize,
    /// By how much Euler's formula is missed: 0 unless segments cross.
    pub defect: usize,
}

impl PlanarMap {
    pub(super) fn new(segments: &[Segment]) -> Self {
        let mut ends: Vec<(Point, u32)> = segments.as_flattened().iter().copied().zip(0..).collect();
        sort_by(&mut ends, cores(), |(a, _), (b, _)| (a.x, a.y).cmp(&(b.x, b.y)));
        let mut points: Vec<Point> = Vec::with_capacity(segments.len());
        let mut edges = vec![[0; 2]; segments.len()];
        for (point, end) in ends {
            if points.last() != Some(&point) {
                points.push(point);
            }
            edges[end as usize / 2][end as usize % 2] = points.len() as u32 - 1;
        }
        let next = next_around(&points, &edges);
        let mut sets = DisjointSets::new(points.len());
        edges.iter().for_each(|edge| sets.join(*edge));
        let components = (0..points.len() as u32).filter(|point| sets.root(*point) == *point).count();
        let mut map = Self {
            points,
            cells: vec![OUTSIDE; next.len()],
            next,
            edges,
            loops: Vec::new(),
            starts: Vec::new(),
            areas: Vec::new(),
            components,
            defect: 0,
        };
        map.find_cells();
        map
    }

    /// Finds all loops, and the cell of each.
    fn find_cells(&mut self) {
        const UNKNOWN: u32 = u32::MAX;
        let mut loop_of = vec![UNKNOWN; self.next.len()];
        let (mut outer, mut around) = (Vec::new(), Vec::new());
        for first in 0..self.next.len() as u32 {
            if loop_of[first as usize] != UNKNOWN {
                continue;
            }
            let number = (outer.len() + around.len()) as u32;
            let (mut area, mut lowest) = (0, u32::MAX);
            for half in self.from(first) {
                loop_of[half as usize] = number;
                let [from, to] = self.ends(half).map(|point| self.points[point as usize]);
                area += i128::from(from.perp_dot(to));
                lowest = lowest.min(self.ends(half)[0]);
            }
            let found = FoundLoop { number, first, area, lowest };
            if area > 0 { outer.push(found) } else { around.push(found) }
        }
        let euler = self.edges.len() + 2 * self.components;
        self.defect = euler.abs_diff(self.points.len() + outer.len() + around.len());
        // Points are numbered in lexicographic order: the component left of a lowest point comes first.
        around.sort_unstable_by_key(|found| found.lowest);
        let mut cell_of_loop = vec![OUTSIDE; outer.len() + around.len()];
        outer.iter().zip(0..).for_each(|(found, cell)| cell_of_loop[found.number as usize] = cell);
        let mut of_cells: Vec<Vec<FoundLoop>> = outer.into_iter().map(|found| vec![found]).collect();
        let boxes =
            |edge: &[u32; 2]| Box3::around(edge.map(|point| self.points[point as usize].as_dvec2().extend(0.0)));
        // One component has nothing around it.
        let boxes: Vec<Box3> = if around.len() > 1 { self.edges.iter().map(boxes).collect() } else { Vec::new() };
        let (tree, order) = BoxTree::new(&boxes);
        for found in around {
            let half = self.left_of(found.lowest, &tree, &order);
            let cell = half.map_or(OUTSIDE, |half| cell_of_loop[loop_of[half as usize] as usize]);
            cell_of_loop[found.number as usize] = cell;
            if cell != OUTSIDE {
                of_cells[cell as usize].push(found);
            }
        }
        for (half, number) in loop_of.into_iter().enumerate() {
            self.cells[half] = cell_of_loop[number as usize];
        }
        self.starts.push(0);
        for loops in of_cells {
            self.areas.push(loops.iter().map(|found| found.area).sum());
            self.loops.extend(loops.iter().map(|found| found.first));
            self.starts.push(self.loops.len() as u32);
        }
    }

    /// The half-edge nearest to a point on its left, with its cell on the point's side.
    fn left_of(&self, point: u32, tree: &BoxTree, order: &[u32]) -> Option<u32> {
        let at = self.points[point as usize];
        let y = at.y as f64;
        let row = Box3::new(DVec2::new(f64::NEG_INFINITY, y).extend(0.0), DVec2::new(at.x as f64, y).extend(0.0));
        // Upwards, and then where each crosses the row just above the point.
        let mut nearest: Option<(Segment, u32)> = None;
        tree.any(&row, |place| {
            let edge = order[place as usize];
            let [mut a, mut b] = self.edges[edge as usize].map(|end| self.points[end as usize]);
            // The half-edge that runs down has the point on its left.
            let mut down = 2 * edge + 1;
            if a.y > b.y {
                (a, b, down) = (b, a, 2 * edge);
            }
            let is_left = a.y <= at.y && b.y > at.y && turn([a, b], at) < 0;
            if is_left && nearest.is_none_or(|(other, _)| order_in_row([a, b], other, at.y) == Ordering::Greater) {
                nearest = Some(([a, b], down));
            }
            false
        });
        nearest.map(|(_, half)| half)
    }

    /// The half-edges of a loop, from one of them.
    pub(super) fn from(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let half = next?;
            next = Some(self.next[half as usize]).filter(|next| *next != first);
            Some(half)
        })
    }

    /// The points at which a half-edge begins and ends.
    pub(super) fn ends(&self, half: u32) -> [u32; 2] {
        let [a, b] = self.edges[half as usize / 2];
        if half.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    /// Twice the area inside a ring of points, grid steps squared; negative if it runs clockwise.
    pub(super) fn area(&self, ring: &[u32]) -> i128 {
        let point = |at: usize| self.points[ring[at % ring.len()] as usize];
        (0..ring.len()).map(|at| i128::from(point(at).perp_dot(point(at + 1)))).sum()
    }

    pub(super) fn cell_count(&self) -> usize {
        self.areas.len()
    }

    /// A half-edge of each of a cell's loops, the outer one first.
    pub(super) fn loops(&self, cell: u32) -> &[u32] {
        &self.loops[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }

    /// A point well inside a cell, grid steps.
    pub(super) fn inside(&self, cell: u32) -> DVec2 {
        let loops = self.loops(cell);
        let corners: Vec<u32> = self.from(loops[0]).take(4).map(|half| self.ends(half)[0]).collect();
        if loops.len() == 1 && corners.len() == 3 {
            return corners.iter().map(|point| self.points[*point as usize].as_dvec2()).sum::<DVec2>() / 3.0;
        }
        let halves: Vec<Segment> = loops
            .iter()
            .flat_map(|first| self.from(*first))
            .map(|half| self.ends(half).map(|point| self.points[point as usize]))
            .collect();
        let low = halves.iter().map(|[from, _]| from.y).min().unwrap_or(0);
        let high = halves.iter().map(|[from, _]| from.y).max().unwrap_or(0);
        // Rows between those of the grid meet no point.
        let row =
            |share: f64| (low as f64 + (high - low) as f64 * share).floor().clamp(low as f64, high as f64 - 1.0) + 0.5;
        let widest = [0.5, 0.29, 0.83].map(|share| widest_in_row(&halves, row(share)));
        widest.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default().0
    }
}

/// The middle and the width of the widest stretch inside a cell in one row.
fn widest_in_row(halves: &[Segment], y: f64) -> (DVec2, f64) {
    let crosses = |[from, to]: &&Segment| (from.y as f64 > y) != (to.y as f64 > y);
    let place = |[from, to]: &Segment| {
        let [from, to] = [from.as_dvec2(), to.as_dvec2()];
        from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y))
    };
    let mut places: Vec<f64> = halves.iter().filter(crosses).map(place).collect();
    places.sort_unstable_by(f64::total_cmp);
    let stretches = places.chunks_exact(2).map(|pair| (DVec2::new((pair[0] + pair[1]) * 0.5, y), pair[1] - pair[0]));
    stretches.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

struct FoundLoop {
    number: u32,
    first: u32,
    /// Twice the area, grid steps squared.
    area: i128,
    /// Its lowest point in lexicographic order.
    lowest: u32,
}

/// Compares where two segments that run upwards cross a row just above `y`, from left to right.
fn order_in_row(one: Segment, other: Segment, y: i64) -> Ordering {
    // The crossing of a segment is at `from.x + along.x * (y - from.y) / along.y`.
    let fraction = |[from, to]: Segment| {
        let [x, along, rise, up] = [from.x, to.x - from.x, to.y - from.y, y - from.y].map(i128::from);
        (x * rise + along * up, rise, along)
    };
    let ((x, rise, along), (other_x, other_rise, other_along)) = (fraction(one), fraction(other));
    let at = (x * other_rise).cmp(&(other_x * rise));
    at.then((along * other_rise).cmp(&(other_along * rise)))
}

/// For each half-edge the one that follows it around the cell on its left.
fn next_around(points: &[Point], edges: &[[u32; 2]]) -> Vec<u32> {
    let mut starts = vec![0u32; points.len() + 1];
    edges.as_flattened().iter().for_each(|point| starts[*point as usize + 1] += 1);
    for point in 0..points.len() {
        starts[point + 1] += starts[point];
    }
    let mut places = starts.clone();
    let mut leaving = vec![0u32; 2 * edges.len()];
    for (half, point) in (0u32..).zip(edges.as_flattened()) {
        let place = &mut places[*point as usize];
        leaving[*place as usize] = half;
        *place += 1;
    }
    let way = |half: u32| {
        let edge = edges[half as usize / 2];
        let [from, to] = if half.is_multiple_of(2) { edge } else { [edge[1], edge[0]] };
        points[to as usize] - points[from as usize]
    };
    let mut next = vec![0u32; 2 * edges.len()];
    for range in starts.windows(2) {
        let around = &mut leaving[range[0] as usize..range[1] as usize];
        // Counter-clockwise.
        around.sort_unstable_by(|a, b| {
            let [a, b] = [*a, *b].map(way);
            let is_low = |way: Point| (way.y, way.x) < (0, 0);
            is_low(a).cmp(&is_low(b)).then(0.cmp(&a.perp_dot(b)))
        });
        // The one that arrives turns into the next one clockwise, which keeps the cell on the left.
        for (place, half) in around.iter().enumerate() {
            let before = around[(place + around.len() - 1) % around.len()];
            next[(*half ^ 1) as usize] = before;
        }
    }
    next
}
