//! T-junctions: vertices of one face on the side of another.
//!
//! Input: a mesh and its edges. Output: the mesh with such faces split at these vertices, so that both sides become
//! the same edges. First come chains of edges that cover another edge from end to end, which are that edge cut on one
//! side. Then come vertices of an open rim on another rim, because surfaces side by side are one. Cracks wider than
//! `--weld` and six digits of a coordinate stay open.

use crate::bvh::{Box3, BoxTree};
use crate::edges::{EdgeList, Incidence};
use crate::lines::input::coplanar::{LARGEST_SINE, Planar};
use crate::lines::input::face_subset::with_faces;
use crate::mesh::Mesh;
use crate::tolerances::CONTACT;
use glam::DVec3;
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

/// Largest difference between the directions of collinear edges; between those of short ones [`LARGEST_SINE`].
const SAME_DIRECTION: f64 = 1e-4;

/// An edge that others cover from end to end, if it is a rim or they all are. Edges of solids that merely touch along
/// parts of them are not chains.
pub(in crate::lines) struct Chain {
    pub long: u32,
    /// From one end of the long edge to the other.
    pub edges: Vec<u32>,
}

/// All chains of a mesh.
pub(in crate::lines) fn chains(mesh: &Mesh, edges: &EdgeList) -> Vec<Chain> {
    let mut is_asked = vec![false; mesh.positions.len()];
    let planar = Planar::new(mesh);
    let rims = (0..edges.len()).filter(|edge| edges.incidence()[*edge] == Incidence::Boundary);
    rims.for_each(|rim| edges.positions()[rim].iter().for_each(|end| is_asked[*end as usize] = true));
    loop {
        let leaving = HalfEdges::new(&planar, edges, |position| is_asked[position as usize]);
        let pairs = leaving.along_one_another();
        let ends = pairs.iter().flatten().flat_map(|edge| edges.positions()[*edge as usize]);
        let new: Vec<u32> = ends.filter(|end| !is_asked[*end as usize]).collect();
        if new.is_empty() {
            return pairs.into_iter().filter_map(|pair| leaving.chain(pair)).collect();
        }
        new.into_iter().for_each(|end| is_asked[end as usize] = true);
    }
}

/// Edges as they leave some positions, sorted by position and direction.
struct HalfEdges<'a> {
    planar: &'a Planar<'a>,
    edges: &'a EdgeList,
    half_edges: Vec<HalfEdge>,
}

/// An edge as it leaves one of its ends.
#[derive(Clone, Copy)]
struct HalfEdge {
    from: u32,
    to: u32,
    edge: u32,
    direction: DVec3,
    length: f64,
    /// The component of its direction along an axis that no grid is aligned with.
    skewed: f64,
}

impl<'a> HalfEdges<'a> {
    fn new(planar: &'a Planar<'a>, edges: &'a EdgeList, is_asked: impl Fn(u32) -> bool) -> Self {
        let skew = DVec3::new(0.453_5, 0.711_7, 0.536_3);
        let mut half_edges = Vec::new();
        for (edge, [low, high]) in (0..).zip(edges.positions()) {
            for (from, to) in [(*low, *high), (*high, *low)].into_iter().filter(|(from, _)| is_asked(*from)) {
                let along = planar.mesh.positions[to as usize] - planar.mesh.positions[from as usize];
                let direction = along.normalize_or_zero();
                half_edges.push(HalfEdge {
                    from,
                    to,
                    edge,
                    direction,
                    length: along.length(),
                    skewed: direction.dot(skew),
                });
            }
        }
        let order = |a: &HalfEdge, b: &HalfEdge| {
            a.from.cmp(&b.from).then(a.skewed.total_cmp(&b.skewed)).then(a.edge.cmp(&b.edge))
        };
        half_edges.sort_unstable_by(order);
        Self { planar, edges, half_edges }
    }

    /// Whether the shorter of two half-edges lies along the other.
    fn are_along(&self, [one, other]: [&HalfEdge; 2]) -> bool {
        let (sine, shorter) = (one.direction.cross(other.direction).length(), one.length.min(other.length));
        let is_in_line = sine <= SAME_DIRECTION || self.planar.is_on_line(sine * shorter, shorter);
        is_in_line && one.direction.dot(other.direction) > 0.0
    }

    fn is_rim(&self, edge: u32) -> bool {
        self.edges.incidence()[edge as usize] == Incidence::Boundary
    }

    /// Pairs of edges that leave a position in the same direction, at least one of them a rim.
    fn along_one_another(&self) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        for (index, half_edge) in self.half_edges.iter().enumerate() {
            let near = self.half_edges[index + 1..]
                .iter()
                .take_while(|other| other.from == half_edge.from && other.skewed - half_edge.skewed <= LARGEST_SINE)
                .filter(|other| self.is_rim(half_edge.edge) || self.is_rim(other.edge))
                .filter(|other| self.are_along([half_edge, other]));
            pairs.extend(near.map(|other| {
                if half_edge.length > other.length {
                    [half_edge.edge, other.edge]
                } else {
                    [other.edge, half_edge.edge]
                }
            }));
        }
        pairs
    }

    /// The chain that begins with the second edge and covers the first.
    fn chain(&self, [long, short]: [u32; 2]) -> Option<Chain> {
        let from = self.edges.positions()[long as usize];
        let common = from.into_iter().find(|end| self.edges.positions()[short as usize].contains(end))?;
        let leaving = |position: u32| {
            let start = self.half_edges.partition_point(|half_edge| half_edge.from < position);
            self.half_edges[start..].iter().take_while(move |half_edge| half_edge.from == position)
        };
        let of = |edge: u32| leaving(common).find(|half_edge| half_edge.edge == edge);
        let (long_edge, mut last) = (of(long)?, of(short)?);
        let (mut chain, mut covered) = (vec![short], last.length);
        while last.to != long_edge.to {
            let left = long_edge.length - covered;
            last = leaving(last.to)
                .filter(|half_edge| half_edge.length <= left * (1.0 + SAME_DIRECTION))
                .filter(|half_edge| self.are_along([half_edge, long_edge]))
                .min_by(|a, b| a.length.total_cmp(&b.length))?;
            covered += last.length;
            chain.push(last.edge);
        }
        (self.is_rim(long) || chain.iter().all(|edge| self.is_rim(*edge))).then_some(Chain { long, edges: chain })
    }
}

pub(in crate::lines) struct SplitMesh {
    pub mesh: Mesh,
    /// For each face, the original face that contains it.
    pub whole_faces: Vec<u32>,
    /// The vertices on each split edge, in order.
    pub on_edges: BTreeMap<[u32; 2], Vec<u32>>,
}

/// The mesh with its faces split at all T-junctions; `None` if it has none.
pub(in crate::lines) fn split_at_junctions(mesh: &Mesh, edges: &EdgeList) -> Option<SplitMesh> {
    /// A chain may cover an edge of another chain.
    const MOST_ROUNDS: usize = 8;
    let mut split: Option<SplitMesh> = None;
    let mut edges = Cow::Borrowed(edges);
    for _ in 0..MOST_ROUNDS {
        let current = split.as_ref().map_or(mesh, |split| &split.mesh);
        let chains = chains(current, &edges);
        let Some(next) = split_at(current, on_bundles(current, &edges, &chains)) else { break };
        edges = Cow::Owned(EdgeList::new(&next.mesh));
        split = Some(SplitMesh::after(split, next));
    }
    let current = split.as_ref().map_or(mesh, |split| &split.mesh);
    let is_rim = |edge: &usize| edges.incidence()[*edge] == Incidence::Boundary;
    let rims: Vec<[u32; 2]> = (0..edges.len()).filter(is_rim).map(|edge| edges.positions()[edge]).collect();
    match split_at(current, vertices_on(&Planar::new(current), &rims, &ends_of(&rims))) {
        Some(next) => Some(SplitMesh::after(split, next)),
        None => split,
    }
}

/// The ends of edges, each once.
fn ends_of(edges: &[[u32; 2]]) -> Vec<u32> {
    let mut ends = edges.as_flattened().to_vec();
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// The vertices of chains on the edges that they cover, and on one another's edges.
fn on_bundles(mesh: &Mesh, edges: &EdgeList, chains: &[Chain]) -> BTreeMap<[u32; 2], Vec<u32>> {
    let mut bundles: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for Chain { long, edges } in chains {
        bundles.entry(*long).or_insert_with(|| vec![*long]).extend(edges);
    }
    let (planar, mut on_edges) = (Planar::new(mesh), BTreeMap::new());
    for mut bundle in bundles.into_values() {
        bundle.sort_unstable();
        bundle.dedup();
        let bundle: Vec<[u32; 2]> = bundle.into_iter().map(|edge| edges.positions()[edge as usize]).collect();
        on_edges.extend(vertices_on(&planar, &bundle, &ends_of(&bundle)));
    }
    on_edges
}

impl SplitMesh {
    /// Combines two successive splits.
    fn after(first: Option<Self>, then: Self) -> Self {
        let Some(first) = first else { return then };
        let Self { mesh, whole_faces, on_edges } = then;
        let whole_faces = whole_faces.into_iter().map(|face| first.whole_faces[face as usize]).collect();
        let mut of_both = on_edges.clone();
        for (edge, vertices) in first.on_edges {
            let ends = [[edge[0]].as_slice(), &vertices, &[edge[1]]].concat();
            let mut along = Vec::new();
            for pair in ends.windows(2) {
                let between =
                    on_edges.get(&[pair[0].min(pair[1]), pair[0].max(pair[1])]).map_or(&[][..], Vec::as_slice);
                match pair[0] < pair[1] {
                    true => along.extend(between),
                    false => along.extend(between.iter().rev()),
                }
                along.push(pair[1]);
            }
            along.pop();
            of_both.insert(edge, along);
        }
        Self { mesh, whole_faces, on_edges: of_both }
    }
}

/// The mesh with its faces split at the vertices on their sides; `None` if no side has any.
fn split_at(mesh: &Mesh, on_sides: BTreeMap<[u32; 2], Vec<u32>>) -> Option<SplitMesh> {
    if on_sides.is_empty() {
        return None;
    }
    let of_sides: HashMap<[u32; 2], &[u32]> = on_sides.iter().map(|(edge, on)| (*edge, on.as_slice())).collect();
    let mut faces = Vec::with_capacity(mesh.triangles.len() + on_sides.len());
    let mut is_split = false;
    for (face, corners) in mesh.triangles.iter().enumerate() {
        let before = faces.len();
        split(*corners, &of_sides, &mut |corners| faces.push((face, corners)));
        is_split |= faces.len() > before + 1;
    }
    let whole_faces = faces.iter().map(|(face, _)| *face as u32).collect();
    is_split.then(|| {
        let mesh = with_marks_split(with_faces(mesh, faces), &on_sides);
        SplitMesh { mesh, whole_faces, on_edges: on_sides }
    })
}

/// The mesh with the parts of a marked edge marked instead of it.
fn with_marks_split(mesh: Mesh, on_sides: &BTreeMap<[u32; 2], Vec<u32>>) -> Mesh {
    let parts = |[a, b]: &[u32; 2]| {
        let along = on_sides.get(&[*a, *b]).map_or(&[][..], Vec::as_slice);
        let along: Vec<u32> = [&[*a][..], along, &[*b]].concat();
        along.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]).collect::<Vec<_>>()
    };
    let mut marked: Vec<[u32; 2]> = mesh.marked.iter().flat_map(parts).collect();
    marked.sort_unstable();
    Mesh { marked, ..mesh }
}

/// Splits a face at the vertices on its sides: a fan around the corner opposite the first side with vertices, and
/// fans around the vertices next to that side's ends.
fn split(corners: [u32; 3], on_sides: &HashMap<[u32; 2], &[u32]>, add: &mut impl FnMut([u32; 3])) {
    // From corner to corner, with the vertices between them.
    let between = |side: usize| {
        let (from, to) = (corners[side], corners[(side + 1) % 3]);
        let mut between = on_sides.get(&[from.min(to), from.max(to)]).map_or_else(Vec::new, |between| between.to_vec());
        between.retain(|vertex| !corners.contains(vertex));
        if from > to {
            between.reverse();
        }
        between
    };
    let sides: [Vec<u32>; 3] = std::array::from_fn(between);
    let Some(first) = sides.iter().position(|side| !side.is_empty()) else { return add(corners) };
    let [a, b, c] = [0, 1, 2].map(|step| corners[(first + step) % 3]);
    let [on_ab, on_bc, on_ca] = [0, 1, 2].map(|step| sides[(first + step) % 3].as_slice());
    let (nearest_a, nearest_b) = (on_ab[0], on_ab[on_ab.len() - 1]);
    fan(nearest_a, &[&[c], on_ca, &[a]].concat(), add);
    fan(c, on_ab, add);
    fan(nearest_b, &[&[b], on_bc, &[c]].concat(), add);
}

/// A triangle with the apex for each pair of neighbours along a line.
fn fan(apex: u32, along: &[u32], add: &mut impl FnMut([u32; 3])) {
    along.windows(2).for_each(|pair| add([apex, pair[0], pair[1]]));
}

/// Length of the parts in which rims are searched, in radii of the mesh.
const LONGEST_PART: f64 = 0.1;

/// For each edge, given with its lower position first, the vertices that lie on it, in order; edges without vertices
/// are absent.
pub(super) fn vertices_on(planar: &Planar, edges: &[[u32; 2]], vertices: &[u32]) -> BTreeMap<[u32; 2], Vec<u32>> {
    let position = |index: u32| planar.mesh.positions[index as usize];
    let radius = planar.diagonal * 0.5;
    let scaled = |point: DVec3| (point - planar.middle) / radius;
    let (mut boxes, mut edge_of) = (Vec::new(), Vec::new());
    for (edge, ends) in edges.iter().enumerate() {
        let [a, b] = ends.map(|end| scaled(position(end)));
        let margin = DVec3::splat(CONTACT * a.distance(b) + planar.beside / radius);
        // Search in parts: the bounding box of a long edge contains too much.
        let count = (a.distance(b) / LONGEST_PART).ceil().max(1.0);
        for part in 0..count as u32 {
            let [from, to] = [part, part + 1].map(|place| a.lerp(b, f64::from(place) / count));
            boxes.push(Box3::new(from.min(to) - margin, from.max(to) + margin));
            edge_of.push(edge);
        }
    }
    let (tree, order) = BoxTree::new(&boxes);
    let mut places: BTreeMap<[u32; 2], Vec<(f64, u32)>> = BTreeMap::new();
    for vertex in vertices {
        let point = position(*vertex);
        tree.any(&Box3::around([scaled(point)]), |place| {
            let ends = edges[edge_of[order[place as usize] as usize]];
            let (start, along) = (position(ends[0]), position(ends[1]) - position(ends[0]));
            let place = (point - start).dot(along) / along.length_squared();
            let distance = (start + along * place).distance(point);
            let length = along.length();
            let from_end = place.min(1.0 - place) * length;
            // Nearer to an end, the vertex may lie on another edge from that end. A still nearer vertex is the end itself,
            // because it was welded.
            let touches = distance <= CONTACT * length && from_end > CONTACT * length;
            if (touches || planar.is_on_line(distance, from_end)) && from_end > planar.weld {
                places.entry(ends).or_default().push((place, *vertex));
            }
            false
        });
    }
    let in_order = |mut places: Vec<(f64, u32)>| {
        places.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        places.dedup();
        places.into_iter().map(|(_, vertex)| vertex).collect()
    };
    places.into_iter().map(|(ends, places)| (ends, in_order(places))).collect()
}
