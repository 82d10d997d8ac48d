//! Building the edge list in linear time: half-edges sorted by their lower position with a counting sort, then matched
//! within each position.
//!
//! The text searches the whole list for every edge (errata D1). A hash table would be linear too, but misses the cache at
//! every edge of a large mesh: three times slower at a million triangles.

use super::{EdgeList, Incidence, in_parallel};

/// One side of a triangle as found: its higher position, and its face times two plus 1 if it runs from high to low.
#[derive(Clone, Copy, Default)]
struct HalfEdge {
    high: u32,
    face_and_direction: u32,
}

/// The edges of a range of lower positions.
#[derive(Default)]
struct Part {
    positions: Vec<[u32; 2]>,
    faces: Vec<[u32; 2]>,
    incidence: Vec<Incidence>,
    non_manifold: Vec<(u32, Vec<u32>)>,
}

/// Edges of one position among which a search from the first is quicker than a table.
const SEARCHED: usize = 12;

const NO_EDGE: u32 = u32::MAX;

pub(super) fn edge_list(triangles: &[[u32; 3]], positions: u32, threads: usize) -> EdgeList {
    let is_degenerate = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a || *a.max(b).max(c) >= positions;
    let degenerate_faces = triangles.iter().filter(|triangle| is_degenerate(triangle)).count();
    // Faces are numbered in 31 bits beside the direction; a mesh of more has 50 GB of edges.
    let triangles = &triangles[..triangles.len().min(1 << 31)];
    let parts = in_parallel(positions as usize, threads, |low| {
        let range = low.start as u32..low.end as u32;
        if degenerate_faces == 0 { part(triangles, &range, |_| false) } else { part(triangles, &range, is_degenerate) }
    });
    join(parts, degenerate_faces)
}

fn join(parts: Vec<Part>, degenerate_faces: usize) -> EdgeList {
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    for part in parts {
        let first = all.positions.len() as u32;
        all.positions.extend_from_slice(&part.positions);
        all.faces.extend_from_slice(&part.faces);
        all.incidence.extend_from_slice(&part.incidence);
        all.non_manifold.extend(part.non_manifold.into_iter().map(|(edge, faces)| (edge + first, faces)));
    }
    let Part { positions, faces, incidence, non_manifold } = all;
    EdgeList { positions, faces, incidence, non_manifold, degenerate_faces }
}

/// The sides of a triangle in the listing's order, each with its lower and higher position and whether it runs downwards.
#[inline(always)]
fn sides(&[a, b, c]: &[u32; 3]) -> [(u32, u32, u32); 3] {
    let side = |from: u32, to: u32| (from.min(to), from.max(to), u32::from(from > to));
    [side(a, b), side(c, a), side(b, c)]
}

fn part(triangles: &[[u32; 3]], low: &std::ops::Range<u32>, is_left_out: impl Fn(&[u32; 3]) -> bool) -> Part {
    let count = (low.end - low.start) as usize;
    // `ends[v]` is first the number of half-edges of v, then where they begin, and after the sorting where they end.
    let mut ends = vec![0u32; count];
    for triangle in triangles.iter().filter(|triangle| !is_left_out(triangle)) {
        for (side_low, ..) in sides(triangle) {
            if let Some(end) = ends.get_mut(side_low.wrapping_sub(low.start) as usize) {
                *end += 1;
            }
        }
    }
    let mut total = 0;
    for end in &mut ends {
        total += std::mem::replace(end, total);
    }
    let mut half_edges = vec![HalfEdge::default(); total as usize];
    for (face, triangle) in triangles.iter().enumerate().filter(|(_, triangle)| !is_left_out(triangle)) {
        for (side_low, high, downwards) in sides(triangle) {
            if let Some(end) = ends.get_mut(side_low.wrapping_sub(low.start) as usize) {
                half_edges[*end as usize] = HalfEdge { high, face_and_direction: (face as u32) << 1 | downwards };
                *end += 1;
            }
        }
    }
    let mut part = Part::default();
    // A closed mesh has half as many edges as half-edges.
    let expected = total as usize / 2 + total as usize / 16;
    part.positions.reserve(expected);
    part.faces.reserve(expected);
    part.incidence.reserve(expected);
    let mut table = Table::default();
    let mut begin = 0;
    for (vertex, end) in (low.start..).zip(ends) {
        part.match_half_edges(vertex, &half_edges[begin..end as usize], &mut table);
        begin = end as usize;
    }
    part
}

/// For positions with very many edges: the edge to each higher position, good while its owner is the position at hand.
#[derive(Default)]
struct Table {
    entries: Vec<(u32, u32)>,
}

impl Table {
    fn edge(&mut self, low: u32, high: u32) -> &mut u32 {
        if self.entries.len() <= high as usize {
            self.entries.resize((high as usize + 1).next_power_of_two(), (NO_EDGE, NO_EDGE));
        }
        let (owner, edge) = &mut self.entries[high as usize];
        if *owner != low {
            (*owner, *edge) = (low, NO_EDGE);
        }
        edge
    }
}

impl Part {
    #[inline(always)]
    fn match_half_edges(&mut self, low: u32, half_edges: &[HalfEdge], table: &mut Table) {
        let first = self.positions.len();
        for half_edge in half_edges {
            let known = &self.positions[first..];
            if known.len() > SEARCHED {
                self.match_in_table(low, first, *half_edge, table);
                continue;
            }
            match known.iter().position(|[_, high]| *high == half_edge.high) {
                Some(index) => self.add_face(first + index, *half_edge),
                None => self.add_edge(low, *half_edge),
            }
        }
        for (faces, incidence) in self.faces[first..].iter_mut().zip(&self.incidence[first..]) {
            if *incidence == Incidence::Boundary {
                faces[1] = faces[0];
            }
        }
        // Found in the order of their third faces.
        let found = self.non_manifold.partition_point(|(edge, _)| (*edge as usize) < first);
        self.non_manifold[found..].sort_unstable_by_key(|(edge, _)| *edge);
    }

    #[cold]
    fn match_in_table(&mut self, low: u32, first: usize, half_edge: HalfEdge, table: &mut Table) {
        // Edges found by searching are entered once, when the table takes over: it then knows the last of them.
        let newest = self.positions.len() - 1;
        if *table.edge(low, self.positions[newest][1]) == NO_EDGE {
            for index in first..=newest {
                *table.edge(low, self.positions[index][1]) = index as u32;
            }
        }
        match *table.edge(low, half_edge.high) {
            NO_EDGE => {
                *table.edge(low, half_edge.high) = self.positions.len() as u32;
                self.add_edge(low, half_edge);
            }
            edge => self.add_face(edge as usize, half_edge),
        }
    }

    #[inline(always)]
    fn add_edge(&mut self, low: u32, half_edge: HalfEdge) {
        self.positions.push([low, half_edge.high]);
        // Until a second face comes, its place keeps the first one's direction.
        self.faces.push([half_edge.face_and_direction >> 1, half_edge.face_and_direction & 1]);
        self.incidence.push(Incidence::Boundary);
    }

    #[inline(always)]
    fn add_face(&mut self, edge: usize, half_edge: HalfEdge) {
        let face = half_edge.face_and_direction >> 1;
        let [first, second] = self.faces[edge];
        match self.incidence[edge] {
            Incidence::Boundary => {
                self.faces[edge] = [first, face];
                let is_reversed = second == half_edge.face_and_direction & 1;
                self.incidence[edge] = if is_reversed { Incidence::InnerReversed } else { Incidence::Inner };
            }
            Incidence::Inner | Incidence::InnerReversed => {
                self.faces[edge] = [first; 2];
                self.incidence[edge] = Incidence::NonManifold;
                self.non_manifold.push((edge as u32, vec![first, second, face]));
            }
            Incidence::NonManifold => {
                let entry = self.non_manifold.iter_mut().rev().find(|(known, _)| *known == edge as u32);
                entry.into_iter().for_each(|(_, faces)| faces.push(face));
            }
        }
    }
}
