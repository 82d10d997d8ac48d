//! Building the edge list in linear time: half-edges sorted by their lower position with a counting sort, then matched
//! within each position.
//!
//! The text searches the whole list for every edge (errata D1). A hash table would be linear too, but would access a separate
//! place in memory for every edge; here a vertex's half-edges lie together.

use super::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::threads::{in_parallel, threads_for};

/// One side of a triangle: its higher position, and its face times two, plus 1 if it runs from high to low. An array rather
/// than a struct, which lets the system provide zeroed memory.
type HalfEdge = [u32; 2];

/// The edges of a range of lower positions.
#[derive(Default)]
struct EdgeRange {
    positions: Vec<[u32; 2]>,
    faces: Vec<[u32; 2]>,
    incidence: Vec<Incidence>,
    non_manifold: Vec<(u32, Vec<u32>)>,
}

/// Number of a position's edges up to which a search from the first is quicker than a table.
const SEARCHED: usize = 12;

const NO_EDGE: u32 = u32::MAX;

impl EdgeList {
    /// For each face of its mesh the edges from the first corner to the second, from that to the third, and back; `NONE` for a side
    /// without an edge.
    pub(super) fn of_faces(&self, mesh: &Mesh) -> Vec<[u32; 3]> {
        let mut of_faces = vec![[NONE; 3]; mesh.triangles.len()];
        for (edge, [a, b]) in self.positions.iter().enumerate() {
            for face in self.faces(edge as u32) {
                let corners = mesh.triangles[*face as usize];
                let ends = |side: usize| [corners[side], corners[(side + 1) % 3]];
                if let Some(side) = (0..3).find(|side| ends(*side) == [*a, *b] || ends(*side) == [*b, *a]) {
                    of_faces[*face as usize][side] = edge as u32;
                }
            }
        }
        of_faces
    }

    /// Builds the list in time linear in the faces, on as many threads as the machine has and the mesh is worth.
    pub fn new(mesh: &Mesh) -> Self {
        Self::with_threads(mesh, threads_for(mesh.triangles.len()))
    }

    /// Like [`EdgeList::new`] with a number of threads, at least 1, which does not affect the result.
    ///
    /// Faces that repeat a position or name one that does not exist have no edges; [`EdgeList::degenerate_faces`] counts them.
    pub fn with_threads(mesh: &Mesh, threads: usize) -> Self {
        edge_list(&mesh.triangles, mesh.positions.len() as u32, threads.max(1))
    }
}

fn edge_list(triangles: &[[u32; 3]], positions: u32, threads: usize) -> EdgeList {
    let is_degenerate = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a || *a.max(b).max(c) >= positions;
    // Half-edges are counted in 32 bits: a larger mesh has 30 GB of edges, and its further faces have none here.
    let (triangles, beyond) = triangles.split_at(triangles.len().min(u32::MAX as usize / 3));
    let degenerate_faces = in_parallel(triangles.len(), threads, |faces| {
        triangles[faces].iter().filter(|triangle| is_degenerate(triangle)).count()
    })
    .into_iter()
    .sum::<usize>();
    // Each thread sorts the half-edges of its share of the faces, then matches those of its share of the positions.
    let sorted = in_parallel(triangles.len(), threads, |faces| match degenerate_faces {
        0 => SortedHalfEdges::new(triangles, faces, positions as usize, |_| false),
        _ => SortedHalfEdges::new(triangles, faces, positions as usize, is_degenerate),
    });
    let shares = shares(&sorted, positions, threads);
    let parts = in_parallel(shares.len(), shares.len(), |share| part(&sorted, &shares[share.start]));
    join(parts, degenerate_faces + beyond.len())
}

/// Ranges of positions with about the same number of half-edges each, one a thread.
fn shares(sorted: &[SortedHalfEdges], positions: u32, threads: usize) -> Vec<std::ops::Range<u32>> {
    let before = |position: u32| match position {
        0 => 0,
        position => sorted.iter().map(|sorted| sorted.ends[position as usize - 1] as usize).sum::<usize>(),
    };
    let total = before(positions);
    let first_of = |share: usize| {
        let wanted = total * share / threads;
        let (mut low, mut high) = (0, positions);
        while low < high {
            let middle = low + (high - low) / 2;
            if before(middle) < wanted { low = middle + 1 } else { high = middle }
        }
        low
    };
    (0..threads)
        .map(|share| first_of(share)..if share + 1 == threads { positions } else { first_of(share + 1) })
        .collect()
}

fn join(parts: Vec<EdgeRange>, degenerate_faces: usize) -> EdgeList {
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    for part in parts {
        let first = all.positions.len() as u32;
        all.positions.extend_from_slice(&part.positions);
        all.faces.extend_from_slice(&part.faces);
        all.incidence.extend_from_slice(&part.incidence);
        all.non_manifold.extend(part.non_manifold.into_iter().map(|(edge, faces)| (edge + first, faces)));
    }
    let EdgeRange { positions, faces, incidence, non_manifold } = all;
    EdgeList { positions, faces, incidence, non_manifold, degenerate_faces }
}

/// The sides of a triangle in the listing's order, each with its lower and higher position and whether it runs downwards.
#[inline(always)]
fn sides(&[a, b, c]: &[u32; 3]) -> [(u32, u32, u32); 3] {
    let side = |from: u32, to: u32| (from.min(to), from.max(to), u32::from(from > to));
    [side(a, b), side(c, a), side(b, c)]
}

/// The half-edges of some faces, sorted by their lower position and, within one, in the faces' order.
struct SortedHalfEdges {
    /// Where each position's half-edges end; they begin where those of the one before end.
    ends: Vec<u32>,
    half_edges: Vec<HalfEdge>,
}

impl SortedHalfEdges {
    fn new(
        triangles: &[[u32; 3]],
        faces: std::ops::Range<usize>,
        positions: usize,
        is_left_out: impl Fn(&[u32; 3]) -> bool,
    ) -> Self {
        // First the number of half-edges of each position, then where they begin, and after the sorting where they end.
        let mut ends = vec![0u32; positions];
        for triangle in triangles[faces.clone()].iter().filter(|triangle| !is_left_out(triangle)) {
            for (low, ..) in sides(triangle) {
                ends[low as usize] += 1;
            }
        }
        let mut total = 0;
        for end in &mut ends {
            total += std::mem::replace(end, total);
        }
        let mut half_edges = vec![[0u32; 2]; total as usize];
        for (face, triangle) in faces.clone().zip(&triangles[faces]).filter(|(_, triangle)| !is_left_out(triangle)) {
            for (low, high, downwards) in sides(triangle) {
                let end = &mut ends[low as usize];
                half_edges[*end as usize] = [high, (face as u32) << 1 | downwards];
                *end += 1;
            }
        }
        Self { ends, half_edges }
    }
}

/// The edges whose lower positions are in a range.
fn part(sorted: &[SortedHalfEdges], low: &std::ops::Range<u32>) -> EdgeRange {
    let mut part = EdgeRange::default();
    let begin_of = |sorted: &SortedHalfEdges| match low.start {
        0 => 0,
        start => sorted.ends[start as usize - 1] as usize,
    };
    let mut begins: Vec<usize> = sorted.iter().map(begin_of).collect();
    let of_all: usize = sorted.iter().map(|sorted| sorted.half_edges.len()).sum();
    let of_range: usize = match low.end {
        0 => 0,
        end => sorted.iter().zip(&begins).map(|(sorted, begin)| sorted.ends[end as usize - 1] as usize - begin).sum(),
    };
    // A closed mesh has half as many edges as half-edges; the first part takes in the others, and room unused costs nothing.
    let expected = if low.start == 0 { of_all / 2 } else { of_range / 2 };
    let expected = expected + expected / 8;
    part.positions.reserve(expected);
    part.faces.reserve(expected);
    part.incidence.reserve(expected);
    let mut table = Table::default();
    for position in low.clone() {
        let first = part.positions.len();
        for (sorted, begin) in sorted.iter().zip(&mut begins) {
            let end = sorted.ends[position as usize] as usize;
            part.match_half_edges(position, first, &sorted.half_edges[*begin..end], &mut table);
            *begin = end;
        }
        part.finish(first);
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

impl EdgeRange {
    /// Adds half-edges of one position, whose edges begin at `first`.
    #[inline(always)]
    fn match_half_edges(&mut self, low: u32, first: usize, half_edges: &[HalfEdge], table: &mut Table) {
        for half_edge in half_edges {
            let known = &self.positions[first..];
            if known.len() > SEARCHED {
                self.match_in_table(low, first, *half_edge, table);
                continue;
            }
            match known.iter().position(|[_, high]| *high == half_edge[0]) {
                Some(index) => self.add_face(first + index, *half_edge),
                None => self.add_edge(low, *half_edge),
            }
        }
    }

    /// Puts in order the edges of one position, all of whose half-edges are added.
    #[inline(always)]
    fn finish(&mut self, first: usize) {
        for (faces, incidence) in self.faces[first..].iter_mut().zip(&self.incidence[first..]) {
            if matches!(incidence, Incidence::Boundary | Incidence::NonManifold) {
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
        match *table.edge(low, half_edge[0]) {
            NO_EDGE => {
                *table.edge(low, half_edge[0]) = self.positions.len() as u32;
                self.add_edge(low, half_edge);
            }
            edge => self.add_face(edge as usize, half_edge),
        }
    }

    #[inline(always)]
    fn add_edge(&mut self, low: u32, [high, face_and_direction]: HalfEdge) {
        self.positions.push([low, high]);
        // Until a second face comes, its place keeps the first one's direction.
        self.faces.push([face_and_direction >> 1, face_and_direction & 1]);
        self.incidence.push(Incidence::Boundary);
    }

    #[inline(always)]
    fn add_face(&mut self, edge: usize, [_, face_and_direction]: HalfEdge) {
        let face = face_and_direction >> 1;
        let [first, second] = self.faces[edge];
        match self.incidence[edge] {
            Incidence::Boundary => {
                self.faces[edge] = [first, face];
                let is_reversed = second == face_and_direction & 1;
                self.incidence[edge] = if is_reversed { Incidence::InnerReversed } else { Incidence::Inner };
            }
            Incidence::Inner | Incidence::InnerReversed => {
                // Until the position is finished, the second place keeps where the faces are listed.
                self.faces[edge] = [first, self.non_manifold.len() as u32];
                self.incidence[edge] = Incidence::NonManifold;
                self.non_manifold.push((edge as u32, vec![first, second, face]));
            }
            Incidence::NonManifold => self.non_manifold[second as usize].1.push(face),
        }
    }
}
